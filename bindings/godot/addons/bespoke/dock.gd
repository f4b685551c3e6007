@tool
extends ScrollContainer
## Dresses characters of the open scene: chooses meshes, shows which bones correspond, has the dials, and puts the result under
## the avatar's skeleton, to be undone.

const NodePicker := preload("node_picker.gd")
const JointTable := preload("joint_table.gd")
const Options := preload("options.gd")
const Painted := preload("painted.gd")
const Followed := preload("followed.gd")
const Findings := preload("findings.gd")
const Wearing := preload("wearing.gd")

const STAGES := {
	BespokeRetarget.STAGE_SETUP: "preparing",
	BespokeRetarget.STAGE_PREPARED: "preparing",
	BespokeRetarget.STAGE_INFLATE: "growing the body inside",
	BespokeRetarget.STAGE_REPOSE: "taking the body to its pose",
	BespokeRetarget.STAGE_FIT: "fitting",
	BespokeRetarget.STAGE_VERIFY: "verifying",
}

var undo_redo: EditorUndoRedoManager
var garment := NodePicker.new("Garment", "The mesh to put on: a MeshInstance3D.", true)
var source := NodePicker.new(
	"Made for", "The body that the garment was made for: its mesh, its skeleton, or the whole character. Best to have.")
var avatar := NodePicker.new(
	"To be worn by",
	"The body to dress: its mesh, its skeleton, or the whole character. What it was dressed in before, and shows, is worn below.")
var along := NodePicker.new(
	"Goes along", "Trims, badges, levels of detail of the garment: a mesh, or all meshes below a node. They follow it without being fitted.")
var options := Options.new()
var painted := Painted.new()
var followed := Followed.new()
var joints := JointTable.new()
var findings := Findings.new()
var dress := Button.new()
var stop := Button.new()
var progress := ProgressBar.new()
var state := Label.new()
var retarget: BespokeRetarget


func _init() -> void:
	horizontal_scroll_mode = SCROLL_MODE_DISABLED
	custom_minimum_size = Vector2(320, 200)
	var column := VBoxContainer.new()
	column.size_flags_horizontal = SIZE_EXPAND_FILL
	column.size_flags_vertical = SIZE_EXPAND_FILL
	add_child(column)
	for picker: NodePicker in [garment, along, source, avatar]:
		column.add_child(picker)
		picker.changed.connect(_inputs_changed)
	column.add_child(HSeparator.new())
	column.add_child(options)
	column.add_child(painted)
	column.add_child(followed)
	column.add_child(joints)
	joints.changed.connect(_mended)
	joints.asked.connect(show_joints)
	column.add_child(HSeparator.new())
	dress.text = "Dress"
	dress.tooltip_text = "Puts the garment on. The result is a mesh under the avatar's skeleton."
	dress.pressed.connect(start)
	column.add_child(dress)
	var row := HBoxContainer.new()
	progress.max_value = 1.0
	progress.size_flags_horizontal = SIZE_EXPAND_FILL
	progress.size_flags_vertical = SIZE_SHRINK_CENTER
	progress.step = 0.001
	row.add_child(progress)
	stop.text = "Stop"
	stop.pressed.connect(func() -> void: retarget.cancel())
	row.add_child(stop)
	column.add_child(row)
	state.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	column.add_child(state)
	column.add_child(findings)
	_show_running(false)


func _exit_tree() -> void:
	findings.clear()


## Nodes of another scene mean nothing here.
func scene_changed() -> void:
	for picker: NodePicker in [garment, along, source, avatar]:
		picker.forget_what_is_gone()
	findings.clear()


## Begins with what is chosen.
func start() -> void:
	findings.clear()
	_say("")
	if retarget != null and retarget.is_running():
		return
	retarget = _retarget()
	retarget.progress.connect(_progressed)
	retarget.finished.connect(_finished)
	retarget.failed.connect(_failed)
	var status := retarget.start()
	if status != BespokeRetarget.STATUS_OK:
		_failed(status, retarget.get_message(), [])
		return
	progress.value = 0.0
	_show_running(true)


## Fills the table of bones that correspond.
func show_joints() -> void:
	var found := _retarget()
	var map := found.get_joint_map()
	if map.is_empty():
		_say(found.get_message(), &"error_color")
		return
	var skeleton := avatar.skeleton()
	joints.show_map(map, skeleton.get_concatenated_bone_names().split(",") if skeleton else PackedStringArray())


func _retarget() -> BespokeRetarget:
	var one := BespokeRetarget.new()
	var worn := garment.mesh()
	one.set_garment(worn)
	var followers := along.meshes([worn])
	if not followers.is_empty():
		one.add_follower(followers)
	# What goes along is no body.
	var bodies := source.meshes([worn] + followers)
	if not bodies.is_empty():
		one.set_source_body(bodies, source.skeleton())
	one.set_avatar(avatar.meshes([worn]), avatar.skeleton())
	for layer in Wearing.worn_below(worn, avatar.skeleton()):
		one.add_layer(layer)
	one.set_joint_pairs(joints.pairs)
	options.apply(one)
	painted.apply(one)
	followed.apply(one)
	return one


func _inputs_changed() -> void:
	var worn := garment.mesh()
	painted.show_channels(worn.mesh if worn else null)
	followed.show_shapes(avatar.meshes([worn]))
	joints.clear()
	findings.clear()
	_say("")


func _mended() -> void:
	show_joints()


func _progressed(stage: int, _t: float) -> void:
	progress.value = retarget.get_progress().get("share", 0.0)
	_say(STAGES.get(stage, "").capitalize() + " …" if STAGES.has(stage) else "")


func _finished() -> void:
	_show_running(false)
	var report := retarget.get_report()
	var seconds: float = (
		report.prepare.seconds + report.inflate.seconds + report.repose.seconds + report.fit.seconds + report.verify_seconds)
	if retarget.get_status() == BespokeRetarget.STATUS_OK:
		_say("Dressed and verified in %.1f s: no triangle passes through another." % seconds, &"success_color")
	else:
		_say(retarget.get_message(), &"warning_color")
	findings.show_findings(retarget.get_findings(), retarget.get_status())
	Wearing.new().put_on(retarget, garment.mesh(), avatar.skeleton(), undo_redo)


func _failed(status: int, message: String, found: Array) -> void:
	_show_running(false)
	if status == BespokeRetarget.STATUS_CANCELLED:
		_say("Stopped.")
		return
	_say(message, &"error_color")
	findings.show_findings(found, status)


func _show_running(is_running: bool) -> void:
	dress.visible = not is_running
	stop.get_parent().visible = is_running


func _say(text: String, color := &"") -> void:
	state.text = text
	state.visible = not text.is_empty()
	if color and has_theme_color(color, &"Editor"):
		state.add_theme_color_override(&"font_color", get_theme_color(color, &"Editor"))
	else:
		state.remove_theme_color_override(&"font_color")
