# Characters that do not go together as they are: what is told, and what is left.
extends Checks


## The vest with a small sheet in front of it, whose first vertex is that after those of `design`.
func _with_sheet(design: Mesh) -> ArrayMesh:
	var arrays := design.surface_get_arrays(0)
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	var bones: PackedInt32Array = arrays[Mesh.ARRAY_BONES]
	var weights: PackedFloat32Array = arrays[Mesh.ARRAY_WEIGHTS]
	var first := vertices.size()
	var box := design.get_aabb()
	var middle := Vector3(box.get_center().x, box.get_center().y, box.end.z + 0.03)
	for k in 25:
		vertices.append(middle + 0.025 * Vector3(k % 5 - 2, k / 5 - 2, 0))
		bones.append_array(bones.slice(0, 4))
		weights.append_array(weights.slice(0, 4))
	for k in 16:
		var corner := first + k % 4 + k / 4 * 5
		indices.append_array([corner, corner + 5, corner + 1, corner + 1, corner + 5, corner + 6])
	arrays[Mesh.ARRAY_VERTEX] = vertices
	arrays[Mesh.ARRAY_INDEX] = indices
	arrays[Mesh.ARRAY_BONES] = bones
	arrays[Mesh.ARRAY_WEIGHTS] = weights
	for which: int in [Mesh.ARRAY_NORMAL, Mesh.ARRAY_TANGENT, Mesh.ARRAY_TEX_UV]:
		arrays[which] = null
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


## Verified, but not worn as designed: it is left to be looked at, and says so.
func test_implausible() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	var first: int = vest.mesh.surface_get_array_len(0)
	vest.mesh = _with_sheet(vest.mesh)
	# Its sheet is drawn together to a few millimetres, far before the body.
	var bones := skeleton_in(get_child(1))
	var before := bones.get_bone_global_rest(bones.find_bone("mixamorig_Spine")).origin + Vector3(0.5, 0, 0)
	var vertices := PackedInt32Array()
	var targets := PackedVector3Array()
	for k in 25:
		vertices.append(first + k)
		targets.append(before + 0.0015 * Vector3(0, k / 5 - 2, k % 5 - 2))
	retarget.set_pins(vertices, targets)
	retarget.set_option("pin_weight", 1e5)
	var told := []
	retarget.finished.connect(func() -> void: told.append("finished"))
	retarget.failed.connect(func(_status: int, _message: String, _findings: Array) -> void: told.append("failed"))
	same(await outcome(retarget), BespokeRetarget.STATUS_IMPLAUSIBLE_RESULT, retarget.get_message())
	same(told, ["finished"], "the signals")
	holds(not retarget.get_message().is_empty(), "there is no message")
	holds(retarget.get_report().is_verified and retarget.get_report().avatar_intersections == 0, "it is not verified")
	holds(retarget.has_result() and retarget.get_mesh() != null, "there is no result")
	var resized := retarget.get_findings().filter(
		func(one: Dictionary) -> bool: return one.kind == BespokeRetarget.KIND_PIECE_RESIZED)
	if holds(resized.size() == 1, "the piece is told %d times" % resized.size()):
		same(resized[0].severity, BespokeRetarget.SEVERITY_ERROR, "the severity")
		var element: Dictionary = resized[0].elements[0]
		same([element.node, element.kind], [vest, BespokeRetarget.ELEMENT_TRIANGLE], "what it is about")
	holds(retarget.dress() != null, "it cannot be looked at")


## A body whose arms are in the way of the garment: what there is, is in the pose of the design, and is no garment for the body.
func test_pose_blocked() -> void:
	var outfit := character("outfit.glb")
	var avatar := character("folded.glb")
	var retarget := BespokeRetarget.new()
	retarget.set_garment(mesh_named(outfit, "Mannequin_Vest"))
	retarget.set_avatar(mesh_named(avatar, "Body"))
	var told := []
	retarget.finished.connect(func() -> void: told.append("finished"))
	retarget.failed.connect(func(status: int, _message: String, _findings: Array) -> void: told.append(status))
	same(await outcome(retarget), BespokeRetarget.STATUS_IMPLAUSIBLE_RESULT, retarget.get_message())
	same(told, [BespokeRetarget.STATUS_IMPLAUSIBLE_RESULT], "the signals")
	holds(not retarget.has_result() and retarget.dress() == null, "there is a result")
	var kinds := retarget.get_findings().map(func(one: Dictionary) -> int: return one.kind)
	holds(BespokeRetarget.KIND_POSE_BLOCKED in kinds, "it was not told why, only %s" % [kinds])
