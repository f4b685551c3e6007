@tool
extends EditorPlugin
## In an editor that was started for it (--editor -- dock): opens the scene, uses the dock, and ends the editor with 0 where all
## holds. With "first" it switches the add-on on, in a project that was never opened before, and looks for the dock. With a window (--editor -- pictures) it leaves pictures of the dock in the project.

var _failures := 0


func _ready() -> void:
	if OS.get_cmdline_user_args().has("first"):
		_begin.call_deferred()
	for task: String in ["dock", "pictures"]:
		if OS.get_cmdline_user_args().has(task):
			_run.call_deferred(task)


func _holds(condition: bool, sentence: String) -> bool:
	if not condition:
		printerr("FAILED: ", sentence)
		_failures += 1
	return condition


func _frames(count: int) -> void:
	for frame in count:
		await get_tree().process_frame


func _scanned() -> void:
	await _frames(10)
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame


func _docks() -> Array[Node]:
	return EditorInterface.get_base_control().find_children("Bespoke", "ScrollContainer", true, false)


func _begin() -> void:
	await _scanned()
	_holds(_docks().is_empty() and not EditorInterface.is_plugin_enabled("bespoke"), "it is switched on already")
	EditorInterface.set_plugin_enabled("bespoke", true)
	await _frames(5)
	_holds(_docks().size() == 1, "there are %d docks" % _docks().size())
	# What an editor does as it begins is still going on, and one that ends meanwhile may crash.
	await _frames(100)
	print("ran the first start" if _failures == 0 else "the first start has failed")
	get_tree().quit(0 if _failures == 0 else 1)


func _run(task: String) -> void:
	await _scanned()
	EditorInterface.open_scene_from_path("res://stage.tscn")
	while EditorInterface.get_edited_scene_root() == null:
		await get_tree().process_frame
	await _frames(5)
	var docks := _docks()
	if _holds(docks.size() == 1, "there are %d docks" % docks.size()):
		var scene := EditorInterface.get_edited_scene_root()
		if task == "dock":
			await _use(docks[0], scene)
		else:
			await _show(docks[0], scene)
	print("ran the dock" if _failures == 0 else "the dock has failed")
	get_tree().quit(0 if _failures == 0 else 1)


func _use(dock: Control, scene: Node) -> void:
	var outfit: Node3D = scene.get_node("Outfit")
	var avatar: Node3D = scene.get_node("Avatar")
	var vest: MeshInstance3D = outfit.find_child("Mannequin_Vest")
	var bones: Skeleton3D = avatar.find_children("*", "Skeleton3D")[0]
	# Without anything chosen it says what is missing.
	dock.dress.pressed.emit()
	_holds(dock.state.visible and dock.state.text.begins_with("garment"), "what is missing: " + dock.state.text)
	_holds(dock.dress.visible and not dock.stop.is_visible_in_tree(), "it seems to run")

	dock.garment.choose(vest)
	dock.source.choose(outfit)
	dock.avatar.choose(avatar)
	_holds(dock.garment.button.text == "Mannequin_Vest", "the button says " + dock.garment.button.text)
	_holds(dock.source.meshes([vest]).size() == 1, "the source has other meshes")
	_holds(dock.avatar.skeleton() == bones, "the avatar has another skeleton")
	dock.garment.choose(outfit)
	_holds(dock.garment.node == null, "a character was taken for a garment")
	dock.garment.choose(vest)

	await _joints(dock)
	await _dials(dock)
	await _cancel(dock)
	await _dress(dock, bones)
	await _along(dock, vest, bones)
	await _over(dock, vest, bones)
	await _follow(dock, avatar.find_child("Body"))
	await _paint(dock, vest)
	await _finding(dock, vest)


func _joints(dock: Control) -> void:
	dock.joints.show.button_pressed = true
	await _frames(2)
	var table: Tree = dock.joints.table
	_holds(table.visible and table.get_root() != null, "there is no table: " + dock.state.text)
	var item := table.get_root().get_first_child()
	while item and item.get_text(0) != "hand_l":
		item = item.get_next()
	if not _holds(item != null, "hand_l is not in the table"):
		return
	_holds(item.get_text(1).get_slice(",", int(item.get_range(1))) == "LeftHand", "hand_l is something else")
	_holds(item.get_tooltip_text(1) == "mixamorig_LeftHand", "hand_l is " + item.get_tooltip_text(1))
	_holds(item.get_text(2).ends_with("%"), "the confidence is " + item.get_text(2))
	item.select(0)
	_holds(dock.joints._about.text.begins_with("Left Hand"), "the reason: " + dock.joints._about.text)
	# As if none had been chosen in the cell.
	dock.joints.pairs["hand_l"] = ""
	dock.joints.changed.emit()
	await _frames(2)
	item = table.get_selected()
	_holds(item and item.get_text(0) == "hand_l" and item.get_text(2) == "by hand", "the row was not mended")
	_holds(item and item.get_range(1) == 0.0, "the row shows another bone")
	dock.joints.forget.pressed.emit()
	await _frames(2)
	_holds(dock.joints.pairs.is_empty(), "it was not forgotten")
	dock.joints.show.button_pressed = false
	_holds(not table.visible, "the table is still there")


func _dials(dock: Control) -> void:
	var controls: Dictionary = dock.options.controls
	_holds([controls.fit_weight.value, controls.designed_clearance.value, controls.offset.value] == [2.0, 1.0, 0.0], "dials")
	_holds(controls.fit_weight.tooltip_text.contains("tighter"), "fit says " + controls.fit_weight.tooltip_text)
	_holds(not controls.has("dhat"), "an option for experts")
	controls.designed_clearance.value = 0.5
	controls.strict.button_pressed = true
	var retarget: BespokeRetarget = dock._retarget()
	_holds(retarget.looseness == 0.5 and retarget.get_option("strict"), "the dials do nothing")
	controls.designed_clearance.value = 1.0
	controls.strict.button_pressed = false


func _ended(dock: Control) -> void:
	while dock.retarget.is_running():
		await get_tree().process_frame


func _cancel(dock: Control) -> void:
	dock.dress.pressed.emit()
	_holds(not dock.dress.visible and dock.stop.get_parent().visible, "it does not run: " + dock.state.text)
	while dock.progress.value < 0.15 and dock.retarget.is_running():
		await get_tree().process_frame
	_holds(dock.state.text.begins_with("Growing"), "it says " + dock.state.text)
	dock.stop.pressed.emit()
	await _ended(dock)
	_holds(dock.state.text == "Stopped.", "it says " + dock.state.text)
	_holds(dock.dress.visible, "there is no button to begin anew")


func _worn(bones: Skeleton3D) -> Array[Node]:
	return bones.get_children().filter(func(child: Node) -> bool: return child.has_meta(&"bespoke_garment"))


func _dress(dock: Control, bones: Skeleton3D) -> void:
	var count := bones.get_bone_count()
	dock.dress.pressed.emit()
	await _ended(dock)
	await _frames(2)
	_holds(dock.state.text.begins_with("Dressed and verified"), "it says " + dock.state.text)
	var worn := _worn(bones)
	if not _holds(worn.size() == 1, "the avatar wears %d garments" % worn.size()):
		return
	_holds(worn[0].owner == EditorInterface.get_edited_scene_root(), "it would not be saved")
	_holds(worn[0].mesh == dock.retarget.get_mesh(), "it has another mesh")
	var history: UndoRedo = dock.undo_redo.get_history_undo_redo(dock.undo_redo.get_object_history_id(bones))
	_holds(history.get_current_action_name() == "Dress in Mannequin_Vest", "the action: " + history.get_current_action_name())
	history.undo()
	_holds(_worn(bones).is_empty() and bones.get_bone_count() == count, "it was not undone")
	history.redo()
	_holds(_worn(bones) == worn, "it was not done again")
	# Once more: the new one takes the place of the old one.
	dock.dress.pressed.emit()
	await _ended(dock)
	await _frames(2)
	var again := _worn(bones)
	_holds(again.size() == 1 and again != worn, "there are %d garments" % again.size())
	history.undo()
	_holds(_worn(bones) == worn, "the earlier one did not come back")
	history.undo()
	_holds(_worn(bones).is_empty(), "it was not undone")
	history.redo()
	history.redo()
	# It is saved with the scene.
	var packed := PackedScene.new()
	packed.pack(EditorInterface.get_edited_scene_root())
	var saved: Node = packed.instantiate()
	_holds(saved.find_children("*", "MeshInstance3D").any(
		func(node: Node) -> bool: return node.has_meta(&"bespoke_garment")), "it was not saved")
	saved.free()


## A trim goes along, and goes with the garment when that is undone.
func _along(dock: Control, vest: MeshInstance3D, bones: Skeleton3D) -> void:
	var before := _worn(bones)
	var trim: MeshInstance3D = vest.duplicate()
	trim.name = "Trim"
	vest.get_parent().add_child(trim)
	dock.along.choose(trim)
	dock.dress.pressed.emit()
	await _ended(dock)
	await _frames(2)
	_holds(dock.state.text.begins_with("Dressed and verified"), "it says " + dock.state.text)
	var names := _worn(bones).map(func(node: Node) -> String: return str(node.name))
	_holds(names == ["Mannequin_Vest", "Trim"], "the avatar wears %s" % [names])
	var history: UndoRedo = dock.undo_redo.get_history_undo_redo(dock.undo_redo.get_object_history_id(bones))
	history.undo()
	_holds(_worn(bones) == before, "the trim was not taken off")
	dock.along.choose(null)
	trim.free()


## What the avatar wears already is worn below the next garment, unless that takes its place or it is hidden.
func _over(dock: Control, vest: MeshInstance3D, bones: Skeleton3D) -> void:
	var coat: MeshInstance3D = vest.duplicate()
	coat.name = "Coat"
	var surface := SurfaceTool.new()
	surface.create_from(vest.mesh, 0)
	surface.generate_normals()
	var arrays := surface.commit_to_arrays()
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	for v in vertices.size():
		vertices[v] += 0.01 * PackedVector3Array(arrays[Mesh.ARRAY_NORMAL])[v]
	arrays[Mesh.ARRAY_VERTEX] = vertices
	var wider := ArrayMesh.new()
	wider.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	coat.mesh = wider
	vest.get_parent().add_child(coat)
	var worn: MeshInstance3D = _worn(bones)[0]
	var over: Array = dock.Wearing.worn_below(coat, bones)
	_holds(over == [worn], "below the coat are %s" % [over])
	_holds(dock.Wearing.worn_below(vest, bones).is_empty(), "the vest is worn below itself")
	dock.garment.choose(coat)
	# The vest is no body of the coat's, though it is shown.
	dock.source.choose(vest.get_parent().get_node("Mannequin_Body"))
	dock.options.controls.designed_clearance.value = 0.0
	dock.dress.pressed.emit()
	await _ended(dock)
	var outside: PackedVector3Array = dock.retarget.get_vertices()
	_holds(dock.state.text.begins_with("Dressed and verified"), "it says " + dock.state.text)
	var history: UndoRedo = dock.undo_redo.get_history_undo_redo(dock.undo_redo.get_object_history_id(bones))
	history.undo()
	worn.visible = false
	_holds(dock.Wearing.worn_below(coat, bones).is_empty(), "a garment that is hidden is worn below")
	dock.dress.pressed.emit()
	await _ended(dock)
	_holds(_width(outside) > _width(dock.retarget.get_vertices()) + 0.001, "the coat is no wider over the vest")
	history.undo()
	worn.visible = true
	coat.free()
	dock.options.controls.designed_clearance.value = 1.0
	dock.source.choose(vest.get_parent().get_parent())
	dock.garment.choose(vest)


func _width(vertices: PackedVector3Array) -> float:
	var sum := 0.0
	var center := Vector3.ZERO
	for v in vertices:
		center += v / vertices.size()
	for v in vertices:
		sum += Vector2(v.x - center.x, v.z - center.z).length() / vertices.size()
	return sum


## Blend shapes of the body are offered, and what is chosen is followed.
func _follow(dock: Control, body: MeshInstance3D) -> void:
	_holds(not dock.followed.visible, "a body without blend shapes has some")
	var design := body.mesh
	var arrays := design.surface_get_arrays(0)
	var shape := []
	shape.resize(Mesh.ARRAY_MAX)
	shape[Mesh.ARRAY_VERTEX] = arrays[Mesh.ARRAY_VERTEX].duplicate()
	for which: int in [Mesh.ARRAY_NORMAL, Mesh.ARRAY_TANGENT]:
		arrays[which] = null
	var mesh := ArrayMesh.new()
	mesh.blend_shape_mode = Mesh.BLEND_SHAPE_MODE_NORMALIZED
	mesh.add_blend_shape("same")
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [shape] as Array[Array])
	body.mesh = mesh
	dock.avatar.changed.emit()
	_holds(dock.followed.visible and dock.followed.boxes.keys() == ["same"], "the shapes are not offered")
	dock.followed.boxes["same"].button_pressed = true
	dock.avatar.changed.emit()
	_holds(dock.followed.chosen() == PackedStringArray(["same"]), "the choice was forgotten")
	var retarget: BespokeRetarget = dock._retarget()
	_holds(retarget.start() == BespokeRetarget.STATUS_OK and retarget.wait() == BespokeRetarget.STATUS_OK, retarget.get_message())
	_holds(retarget.get_mesh() and retarget.get_mesh().get_blend_shape_count() == 1, "the garment does not follow")
	body.mesh = design
	dock.avatar.changed.emit()
	_holds(not dock.followed.visible, "shapes that are gone are still there")


## What is painted on the garment is offered, and is used.
func _paint(dock: Control, vest: MeshInstance3D) -> void:
	_holds(not dock.painted.visible, "a garment without paint has channels")
	var design := vest.mesh
	var arrays := design.surface_get_arrays(0)
	var colors := PackedColorArray()
	for v: Vector3 in arrays[Mesh.ARRAY_VERTEX]:
		colors.append(Color.RED if v.y < design.get_aabb().get_center().y else Color.BLACK)
	arrays[Mesh.ARRAY_COLOR] = colors
	var painted := ArrayMesh.new()
	painted.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	vest.mesh = painted
	dock.garment.choose(vest)
	_holds(dock.painted.visible, "a garment with paint has no channels")
	var plain: BespokeRetarget = dock._retarget()
	var choice: OptionButton = dock.painted.choices["fit"]
	_holds(choice.get_item_text(1) == "color.r" and choice.item_count == 5, "the channels are not offered")
	choice.select(1)
	var loose: BespokeRetarget = dock._retarget()
	for retarget: BespokeRetarget in [plain, loose]:
		_holds(retarget.start() == BespokeRetarget.STATUS_OK and retarget.wait() == BespokeRetarget.STATUS_OK, retarget.get_message())
	_holds(plain.get_vertices() != loose.get_vertices(), "the paint does nothing")
	vest.mesh = design
	dock.garment.choose(vest)
	_holds(dock.painted.chosen("fit") == "", "paint that is gone is still chosen")


## A garment that passes through itself, told by its triangles.
func _finding(dock: Control, vest: MeshInstance3D) -> void:
	var design := vest.mesh
	vest.mesh = load("res://poked.tres")
	dock.options.controls.strict.button_pressed = true
	dock.dress.pressed.emit()
	await _ended(dock)
	_holds(dock.findings.visible and dock.findings.list.item_count > 0, "there are no findings: " + dock.state.text)
	_holds(dock.findings.what_to_do.visible, "no help")
	dock.findings.what_to_do.pressed.emit()
	_holds(dock.findings._help_text.text.contains("strict"), "the help: " + dock.findings._help_text.text)
	dock.findings._help.hide()
	dock.findings.list.item_selected.emit(0)
	_holds(dock.findings._text.text.contains("triangle"), "the sentence: " + dock.findings._text.text)
	_holds(dock.findings.marks.size() == 1, "%d marks in the viewport" % dock.findings.marks.size())
	if not dock.findings.marks.is_empty():
		var mark: MeshInstance3D = dock.findings.marks[0]
		var title: String = dock.findings.list.get_item_text(0)
		var pairs := int(title.trim_prefix("Self Intersection ("))
		_holds(pairs > 1, "the list says " + title)
		_holds(mark.mesh.surface_get_array_len(0) == 6 * pairs, "it marks %d corners" % mark.mesh.surface_get_array_len(0))
		_holds(mark.owner == null, "the marks would be saved")
	_holds(EditorInterface.get_selection().get_selected_nodes() == ([vest] as Array[Node]), "the garment is not selected")
	_holds(dock.findings.what_to_do.visible, "no help for an error")
	dock.options.controls.strict.button_pressed = false
	_help(dock)
	vest.mesh = design


## What to do about findings that are no errors.
func _help(dock: Control) -> void:
	var findings: Control = dock.findings
	var half := "target morph 0 (\"fat\"): the garment's answer is good at weight 1, but halfway 3 pairs of triangles intersect; divide the morph into smaller ones"
	var rows := [[BespokeRetarget.KIND_MORPH_INTERSECTS, BespokeRetarget.SEVERITY_WARNING, half, "cuts a corner"],
		[BespokeRetarget.KIND_SELF_INTERSECTION, BespokeRetarget.SEVERITY_WARNING, "", "strict"],
		[BespokeRetarget.KIND_SPLIT_VERTICES, BespokeRetarget.SEVERITY_NOTE, "", ""]]
	var found := rows.map(func(row: Array) -> Dictionary:
		return {"kind": row[0], "severity": row[1], "message": row[2], "elements": []})
	findings.show_findings(found, BespokeRetarget.STATUS_OK)
	_holds(not findings.what_to_do.visible, "help for nothing")
	for k in findings.list.item_count:
		findings.list.item_selected.emit(k)
		var row: Array = rows.filter(func(one: Array) -> bool: return one[0] == findings._findings[k].kind)[0]
		_holds(findings.what_to_do.visible == (row[3] != ""), "help for a note, or none")
		if row[3]:
			findings.what_to_do.pressed.emit()
			_holds(findings._help_text.text.contains(row[3]), "the help: " + findings._help_text.text)
			_holds(not findings._help_text.text.contains("JOINTS_UNSURE"), "all warnings are shown")
			findings._help.hide()
	findings.clear()


func _picture(file: String) -> void:
	await _frames(30)
	get_tree().root.get_texture().get_image().save_png("res://%s.png" % file)


func _look_at(nodes: Array) -> void:
	EditorInterface.get_selection().clear()
	for node: Node in nodes:
		EditorInterface.get_selection().add_node(node)
	var focus := InputEventKey.new()
	focus.keycode = KEY_F
	focus.pressed = true
	for control in EditorInterface.get_editor_viewport_3d().get_parent().get_parent().find_children("*", "Control", false, false):
		control.gui_input.emit(focus)
	await _frames(40)


func _show(dock: Control, scene: Node) -> void:
	EditorInterface.set_main_screen_editor("3D")
	var outfit: Node3D = scene.get_node("Outfit")
	var avatar: Node3D = scene.get_node("Avatar")
	var vest: MeshInstance3D = outfit.find_child("Mannequin_Vest")
	var cloth := StandardMaterial3D.new()
	cloth.albedo_color = Color(0.25, 0.42, 0.62)
	cloth.cull_mode = BaseMaterial3D.CULL_DISABLED
	vest.material_override = cloth
	var tab: Node = dock
	while not tab.get_parent() is TabContainer:
		tab = tab.get_parent()
	tab.get_parent().current_tab = tab.get_index()
	await _look_at([outfit.find_child("Mannequin_Body"), avatar.find_child("Body")])
	EditorInterface.get_selection().clear()
	await _picture("empty")
	dock.garment.choose(vest)
	dock.source.choose(outfit)
	dock.avatar.choose(avatar)
	dock.joints.show.button_pressed = true
	await _picture("joints")
	dock.joints.show.button_pressed = false
	dock.dress.pressed.emit()
	while dock.progress.value < 0.2 and dock.retarget.is_running():
		await get_tree().process_frame
	get_tree().root.get_texture().get_image().save_png("res://running.png")
	await _ended(dock)
	EditorInterface.get_selection().clear()
	await _picture("dressed")
	vest.mesh = load("res://poked.tres")
	dock.options.controls.strict.button_pressed = true
	dock.dress.pressed.emit()
	await _ended(dock)
	dock.findings.list.select(0)
	dock.findings.list.item_selected.emit(0)
	await _look_at([vest])
	await _picture("finding")
	dock.findings.what_to_do.pressed.emit()
	await _picture("help")
