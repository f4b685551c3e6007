@tool
extends EditorPlugin
## The dock, while the plugin is switched on.

var _dock: Control


func _enter_tree() -> void:
	# Its scripts cannot be read without the class.
	if not ClassDB.class_exists("BespokeRetarget"):
		push_error("Bespoke: its library was not loaded: it is for Linux x86_64, and lies in addons/bespoke/bin.")
		return
	_dock = load("res://addons/bespoke/dock.gd").new()
	_dock.name = "Bespoke"
	_dock.undo_redo = get_undo_redo()
	add_control_to_dock(DOCK_SLOT_RIGHT_UL, _dock)
	scene_changed.connect(func(_root: Node) -> void: _dock.scene_changed())


func _exit_tree() -> void:
	if _dock == null:
		return
	remove_control_from_docks(_dock)
	_dock.queue_free()
	_dock = null
