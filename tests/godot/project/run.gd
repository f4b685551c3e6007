# Runs the tests of one file and ends with 0 where all pass: godot --headless --script run.gd -- FILE [DATA]
#
# A test is a method of that file whose name begins with test_. DATA is a folder for what it reads and writes.
extends SceneTree


func _initialize() -> void:
	var arguments := OS.get_cmdline_user_args()
	var file: GDScript = load("res://" + arguments[0])
	if file == null:
		printerr("FAILED: %s cannot be loaded" % arguments[0])
		quit(1)
		return
	run.call_deferred(file, arguments[1] if arguments.size() > 1 else "")


func run(file: GDScript, data: String) -> void:
	var failures := 0
	var ran := 0
	for method in file.get_script_method_list():
		if not method.name.begins_with("test_"):
			continue
		var tests: Node = file.new()
		tests.name = "Tests"
		tests.data = data
		root.add_child(tests)
		await tests.call(method.name)
		for failure in tests.failures:
			printerr("FAILED: %s: %s" % [method.name, failure])
		if tests.failures.is_empty():
			print("ok ", method.name)
		failures += tests.failures.size()
		ran += 1
		root.remove_child(tests)
		tests.free()
	print("ran ", ran)
	quit(0 if failures == 0 and ran > 0 else 1)
