# The first scene of an exported game: dresses the character of the folder that it is given, and ends with 0 where that succeeds.
extends Checks


func _ready() -> void:
	data = OS.get_cmdline_user_args()[0]
	_dress.call_deferred()


func _dress() -> void:
	holds(not OS.has_feature("editor"), "this is no exported game")
	var retarget := vest_and_avatar()
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	holds(retarget.dress() != null, "nothing was put on")
	for failure in failures:
		printerr("FAILED: ", failure)
	print("dressed in ", OS.get_executable_path().get_file())
	get_tree().quit(0 if failures.is_empty() else 1)
