@tool
extends HBoxContainer
## A node of the scene that is chosen from a list, or dragged here from the scene tree.

signal changed

var node: Node3D
var button := Button.new()
var _clear := Button.new()
var _only_mesh: bool


func _init(title: String, about: String, only_mesh := false) -> void:
	_only_mesh = only_mesh
	var label := Label.new()
	label.text = title
	label.custom_minimum_size.x = 115 * EditorInterface.get_editor_scale()
	add_child(label)
	button.size_flags_horizontal = SIZE_EXPAND_FILL
	button.clip_text = true
	button.tooltip_text = about
	button.alignment = HORIZONTAL_ALIGNMENT_LEFT
	button.pressed.connect(_choose)
	button.set_drag_forwarding(Callable(), _can_drop, _drop)
	add_child(button)
	_clear.tooltip_text = "Choose none"
	_clear.flat = true
	_clear.pressed.connect(choose.bind(null))
	add_child(_clear)
	tooltip_text = about
	_show()


func _notification(what: int) -> void:
	if what == NOTIFICATION_THEME_CHANGED:
		_show()


## Takes this node, or none.
func choose(chosen: Node) -> void:
	node = chosen as Node3D
	if _only_mesh and not node is MeshInstance3D:
		node = null
	_show()
	changed.emit()


func forget_what_is_gone() -> void:
	if not is_instance_valid(node) or not node.is_inside_tree():
		node = null
		_show()


## The chosen node, where it is a mesh and still there.
func mesh() -> MeshInstance3D:
	return node as MeshInstance3D if is_instance_valid(node) else null


## The meshes that are meant, without those that are listed: the chosen one, or all that are shown below it. Garments that were
## put on by us are none, nor is what hangs on a bone, such as a weapon.
func meshes(without: Array) -> Array[MeshInstance3D]:
	var found: Array[MeshInstance3D] = []
	if not is_instance_valid(node):
		return found
	if node is MeshInstance3D:
		found.append(node)
		return found
	for child in node.find_children("*", "MeshInstance3D", true, false):
		if child.mesh and child.visible and not child in without and not child.has_meta(&"bespoke_garment") and not _hangs(child):
			found.append(child)
	return found


## The skeleton that is meant.
func skeleton() -> Skeleton3D:
	if not is_instance_valid(node):
		return null
	if node is Skeleton3D:
		return node
	for mesh in meshes([]):
		var moving := mesh.get_node_or_null(mesh.skeleton) as Skeleton3D
		if moving == null:
			moving = mesh.get_parent() as Skeleton3D
		if moving:
			return moving
	return null


func _hangs(child: Node) -> bool:
	while child != node:
		if child is BoneAttachment3D:
			return true
		child = child.get_parent()
	return false


func _choose() -> void:
	var types: Array[StringName] = [&"MeshInstance3D"]
	if not _only_mesh:
		types = [&"MeshInstance3D", &"Skeleton3D", &"Node3D"]
	EditorInterface.popup_node_selector(_chosen, types)


func _chosen(path: NodePath) -> void:
	if not path.is_empty():
		choose(EditorInterface.get_edited_scene_root().get_node_or_null(path))


func _can_drop(_at: Vector2, dropped: Variant) -> bool:
	var dragged := _dragged(dropped)
	return dragged is MeshInstance3D if _only_mesh else dragged is Node3D


func _drop(_at: Vector2, dropped: Variant) -> void:
	choose(_dragged(dropped))


func _dragged(dropped: Variant) -> Node:
	if not dropped is Dictionary or dropped.get("type") != "nodes" or dropped.nodes.size() != 1:
		return null
	return get_node_or_null(dropped.nodes[0])


func _show() -> void:
	var is_there := is_instance_valid(node)
	button.text = str(node.name) if is_there else "Choose …"
	_clear.visible = is_there
	if not has_theme_icon(&"Close", &"EditorIcons"):
		return
	_clear.icon = get_theme_icon(&"Close", &"EditorIcons")
	button.icon = null
	if is_there and has_theme_icon(node.get_class(), &"EditorIcons"):
		button.icon = get_theme_icon(node.get_class(), &"EditorIcons")
