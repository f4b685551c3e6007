# What comes out: the mesh keeps all that it had, the skin moves it, and the scene gets a node.
extends Checks


## The vest as two surfaces with all that a mesh can have.
func _rich(design: Mesh) -> ArrayMesh:
	var whole := design.surface_get_arrays(0)
	var surface := SurfaceTool.new()
	surface.create_from(design, 0)
	surface.generate_normals()
	surface.generate_tangents()
	whole = surface.commit_to_arrays()
	var vertices: PackedVector3Array = whole[Mesh.ARRAY_VERTEX]
	var indices: PackedInt32Array = whole[Mesh.ARRAY_INDEX]
	var colors := PackedColorArray()
	var custom := PackedFloat32Array()
	for k in vertices.size():
		colors.append(Color8(k % 256, 10, 20))
		custom.append_array([k, 0.5, 0.25, 1.0])
	whole[Mesh.ARRAY_COLOR] = colors
	whole[Mesh.ARRAY_TEX_UV2] = whole[Mesh.ARRAY_TEX_UV]
	whole[Mesh.ARRAY_CUSTOM0] = custom
	var mesh := ArrayMesh.new()
	mesh.resource_name = "Rich"
	mesh.set_meta(&"maker", "a test")
	mesh.blend_shape_mode = Mesh.BLEND_SHAPE_MODE_NORMALIZED
	mesh.add_blend_shape("wide")
	mesh.add_blend_shape("same")
	var half := indices.size() / 6 * 3
	for k in 2:
		var part := whole.duplicate()
		part[Mesh.ARRAY_INDEX] = indices.slice(0, half) if k == 0 else indices.slice(half)
		var shapes: Array[Array] = []
		for shape in 2:
			var moved := vertices.duplicate()
			for v in moved.size():
				moved[v] += Vector3(0.01 * (1 - shape), 0, 0)
			var arrays := []
			arrays.resize(Mesh.ARRAY_MAX)
			arrays[Mesh.ARRAY_VERTEX] = moved
			arrays[Mesh.ARRAY_NORMAL] = whole[Mesh.ARRAY_NORMAL]
			arrays[Mesh.ARRAY_TANGENT] = whole[Mesh.ARRAY_TANGENT]
			shapes.append(arrays)
		var lods := {}
		var detail: PackedInt32Array = part[Mesh.ARRAY_INDEX]
		lods[0.1 + k] = detail.slice(0, 30)
		mesh.add_surface_from_arrays(
			Mesh.PRIMITIVE_TRIANGLES, part, shapes, lods, Mesh.ARRAY_CUSTOM_RGBA_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT)
		mesh.surface_set_name(k, "Part %d" % k)
		var material := StandardMaterial3D.new()
		material.resource_name = "Cloth %d" % k
		mesh.surface_set_material(k, material)
	return mesh


func _lods(mesh: Mesh, surface: int) -> Array:
	return RenderingServer.mesh_get_surface(mesh.get_rid(), surface).get("lods", [])


func test_mesh_keeps_what_it_had() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	var design := _rich(vest.mesh)
	vest.mesh = design
	vest.layers = 5
	vest.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_DOUBLE_SIDED
	var other := StandardMaterial3D.new()
	vest.set_surface_override_material(1, other)
	vest.set_blend_shape_value(0, 0.5)
	vest.position = Vector3.ZERO
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var mesh := retarget.get_mesh()
	if not holds(mesh != null, "there is no mesh"):
		return
	same([mesh.get_surface_count(), mesh.resource_name, mesh.get_meta(&"maker")], [2, "Rich", "a test"], "the mesh")
	same([mesh.get_blend_shape_name(0), mesh.get_blend_shape_name(1)], [&"wide", &"same"], "blend shapes")
	same(mesh.blend_shape_mode, design.blend_shape_mode, "the mode of the blend shapes")
	var first := 0
	for k in 2:
		same(mesh.surface_get_name(k), "Part %d" % k, "the name")
		same(mesh.surface_get_material(k), design.surface_get_material(k), "the material")
		var was := design.surface_get_arrays(k)
		var is_now := mesh.surface_get_arrays(k)
		for which: int in [Mesh.ARRAY_COLOR, Mesh.ARRAY_TEX_UV, Mesh.ARRAY_TEX_UV2, Mesh.ARRAY_CUSTOM0, Mesh.ARRAY_INDEX]:
			same(is_now[which], was[which], "array %d" % which)
		var vertices: PackedVector3Array = is_now[Mesh.ARRAY_VERTEX]
		same(vertices, retarget.get_vertices().slice(first, first + vertices.size()), "the vertices")
		first += vertices.size()
		var normals: PackedVector3Array = is_now[Mesh.ARRAY_NORMAL]
		var tangents: PackedFloat32Array = is_now[Mesh.ARRAY_TANGENT]
		same(tangents.size(), 4 * vertices.size(), "the tangents")
		holds(_agree(is_now), "normals point away from their triangles")
		var wide: PackedVector3Array = mesh.surface_get_blend_shape_arrays(k)[0][Mesh.ARRAY_VERTEX]
		var unmoved: PackedVector3Array = mesh.surface_get_blend_shape_arrays(k)[1][Mesh.ARRAY_VERTEX]
		var widest := 0.0
		for v in vertices.size():
			widest = maxf(widest, wide[v].distance_to(vertices[v]))
			holds(unmoved[v].distance_to(vertices[v]) < 1e-5, "a blend shape that moves nothing moves vertex %d" % v)
		holds(widest > 0.005 and widest < 0.05, "the blend shape moves by %f" % widest)
		var lods := _lods(mesh, k)
		same(lods.size(), 1, "levels of detail")
		same(lods[0].index_data, _lods(design, k)[0].index_data, "a level of detail")
		holds(absf(lods[0].edge_length / _lods(design, k)[0].edge_length - 1.0) < 0.5, "its edge length")
		holds(mesh.surface_get_format(k) & Mesh.ARRAY_FLAG_COMPRESS_ATTRIBUTES == 0, "it is compressed")
	var node: MeshInstance3D = retarget.dress()
	same([node.layers, node.cast_shadow], [vest.layers, vest.cast_shadow], "how it is drawn")
	same(node.get_surface_override_material(1), other, "the override of a material")
	same(node.get_blend_shape_value(0), 0.5, "the value of a blend shape")
	same(node.transform, Transform3D.IDENTITY, "the place")


## Whether normals and triangles agree, for most: Godot draws clockwise triangles.
func _agree(arrays: Array) -> bool:
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
	var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	var good := 0
	for k in range(0, indices.size(), 3):
		var a := vertices[indices[k]]
		var across := (vertices[indices[k + 2]] - a).cross(vertices[indices[k + 1]] - a)
		good += 1 if across.dot(normals[indices[k]]) > 0.0 else 0
	return good > 0.95 * indices.size() / 3


## Blend shapes that are kept as offsets stay so.
func test_relative_blend_shapes() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	var arrays := vest.mesh.surface_get_arrays(0)
	var mesh := ArrayMesh.new()
	mesh.blend_shape_mode = Mesh.BLEND_SHAPE_MODE_RELATIVE
	mesh.add_blend_shape("wide")
	var offsets := PackedVector3Array()
	offsets.resize(arrays[Mesh.ARRAY_VERTEX].size())
	offsets.fill(Vector3(0.01, 0, 0))
	var shape := []
	shape.resize(Mesh.ARRAY_MAX)
	shape[Mesh.ARRAY_VERTEX] = offsets
	for which: int in [Mesh.ARRAY_NORMAL, Mesh.ARRAY_TANGENT]:
		arrays[which] = null
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [shape] as Array[Array])
	vest.mesh = mesh
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var moved: PackedVector3Array = retarget.get_mesh().surface_get_blend_shape_arrays(0)[0][Mesh.ARRAY_VERTEX]
	for v in moved.size():
		if not holds(moved[v].length() > 0.002 and moved[v].length() < 0.05, "an offset is %s" % moved[v]):
			return
	same(retarget.get_mesh().blend_shape_mode, Mesh.BLEND_SHAPE_MODE_RELATIVE, "the mode")


func test_skin_and_influences() -> void:
	var retarget := vest_and_avatar()
	retarget.influences = 8
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var avatar := skeleton_in(get_child(1))
	var skin: Skin = retarget.get_skin()
	same(skin.get_bind_count(), avatar.get_bone_count(), "the binds")
	for bone in skin.get_bind_count():
		same(skin.get_bind_name(bone), StringName(avatar.get_bone_name(bone)), "a bind")
		holds((avatar.get_bone_global_rest(bone) * skin.get_bind_pose(bone)).is_equal_approx(Transform3D.IDENTITY), "its pose")
	var mesh := retarget.get_mesh()
	holds(mesh.surface_get_format(0) & Mesh.ARRAY_FLAG_USE_8_BONE_WEIGHTS != 0, "it has not 8 bones a vertex")
	var arrays := mesh.surface_get_arrays(0)
	var weights: PackedFloat32Array = arrays[Mesh.ARRAY_WEIGHTS]
	same(weights.size(), 8 * retarget.get_vertices().size(), "the weights")
	for v in range(0, weights.size(), 8):
		var sum := 0.0
		for k in 8:
			sum += weights[v + k]
		if not holds(absf(sum - 1.0) < 1e-3, "the weights of a vertex sum to %f" % sum):
			return
	same(retarget.get_added_bones(), PackedStringArray(), "bones that come along")


## Bones of the garment's own, which move some of it and no body.
func test_own_bones_come_along() -> void:
	var retarget := vest_and_avatar()
	var outfit := get_child(0)
	var vest := mesh_named(outfit, "Mannequin_Vest")
	var bones := skeleton_in(outfit)
	var own := bones.get_bone_count()
	bones.add_bone("lapel")
	bones.set_bone_parent(own, bones.find_bone("spine_03"))
	bones.set_bone_rest(own, Transform3D(Basis.IDENTITY, Vector3(0.05, 0.1, 0.1)))
	vest.skin = vest.skin.duplicate()
	vest.skin.add_named_bind("lapel", bones.get_bone_global_rest(own).affine_inverse())
	var arrays := vest.mesh.surface_get_arrays(0)
	for v in 12:
		for k in 4:
			arrays[Mesh.ARRAY_BONES][4 * v + k] = vest.skin.get_bind_count() - 1
			arrays[Mesh.ARRAY_WEIGHTS][4 * v + k] = 1.0 if k == 0 else 0.0
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	vest.mesh = mesh
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_added_bones(), PackedStringArray(["lapel"]), "bones that come along")
	var avatar := skeleton_in(get_child(1))
	var count := avatar.get_bone_count()
	retarget.dress()
	same(avatar.get_bone_count(), count + 1, "the bones of the avatar")
	var added := avatar.find_bone("lapel")
	var rest := avatar.get_bone_global_rest(added)
	holds((rest * retarget.get_skin().get_bind_pose(count)).is_equal_approx(Transform3D.IDENTITY), "where it rests")
	holds(avatar.get_bone_parent(added) >= 0, "it has no parent")
	retarget.add_bones(avatar)
	same(avatar.get_bone_count(), count + 1, "the bones after a second time")


func test_covered_triangles() -> void:
	var retarget := vest_and_avatar()
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var body := mesh_named(get_child(1), "Body")
	var covered := retarget.get_covered_triangles()
	same(covered.size(), 1, "surfaces with covered triangles")
	same([covered[0].mesh, covered[0].node, covered[0].surface], [body.mesh, body, 0], "the surface")
	var some: int = covered[0].triangles.size()
	var all: int = body.mesh.surface_get_array_index_len(0) / 3
	holds(some > 50 and some < all / 2, "%d of %d triangles are covered" % [some, all])
	var fewer: int = retarget.get_covered_triangles(3)[0].triangles.size()
	holds(fewer < some, "a margin of 3 rings leaves %d of %d" % [fewer, some])
	same(retarget.get_covered_triangles(-1), [] as Array[Dictionary], "a margin below 0")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["margin"])
	same(retarget.get_covered_triangles(1, 7.0), [] as Array[Dictionary], "an openness above 1")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["openness"])


## Over what is worn already.
func test_layers() -> void:
	var first := vest_and_avatar()
	first.looseness = 0.0
	same(await outcome(first), BespokeRetarget.STATUS_OK, first.get_message())
	var shirt: MeshInstance3D = first.dress()
	var second := vest_and_avatar()
	second.set_avatar(mesh_named(get_child(1), "Body"))
	second.add_layer(shirt)
	second.offset = 0.005
	same(await outcome(second), BespokeRetarget.STATUS_OK, second.get_message())
	var over := second.get_vertices()
	same([second.get_report().avatar_intersections, over == first.get_vertices()], [0, false], "over the layer")
	second.clear_layers()
	same(await outcome(second), BespokeRetarget.STATUS_OK, second.get_message())
	holds(second.get_vertices() != over, "the layer has changed nothing")


## A skeleton whose bones rest elsewhere than where the mesh was bound: the mesh is taken as it looks at rest.
func test_rest_is_not_bind() -> void:
	var retarget := vest_and_avatar()
	var avatar := skeleton_in(get_child(1))
	var arm := avatar.find_bone("mixamorig_LeftArm")
	var rest := avatar.get_bone_rest(arm)
	avatar.set_bone_rest(arm, rest * Transform3D(Basis(Vector3(0, 0, 1), 0.2), Vector3.ZERO))
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var report := retarget.get_report()
	same([report.garment_intersections, report.avatar_intersections], [0, 0], "intersections")


## A mesh that no skin moves lies where its node is.
func test_rigid_garment() -> void:
	var outfit := character("outfit.glb")
	var avatar := character("avatar.glb")
	var bones := skeleton_in(outfit)
	var vest := mesh_named(outfit, "Mannequin_Vest")
	var arrays := vest.mesh.surface_get_arrays(0)
	arrays[Mesh.ARRAY_BONES] = null
	arrays[Mesh.ARRAY_WEIGHTS] = null
	var shift := Vector3(0, 0.5, 0)
	for v in arrays[Mesh.ARRAY_VERTEX].size():
		arrays[Mesh.ARRAY_VERTEX][v] -= shift
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var node := MeshInstance3D.new()
	node.mesh = mesh
	node.position = shift
	bones.add_child(node)
	var retarget := BespokeRetarget.new()
	retarget.set_garment(node, bones)
	retarget.set_avatar(mesh_named(avatar, "Body"))
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_skin().get_bind_count(), skeleton_in(avatar).get_bone_count(), "the result has a skin")
	# Without the body that it was made for, the same as the vest itself.
	var other := BespokeRetarget.new()
	other.set_garment(vest.mesh, bones)
	other.set_avatar(mesh_named(avatar, "Body"))
	same(await outcome(other), BespokeRetarget.STATUS_OK, other.get_message())
	var far := 0.0
	for v in retarget.get_vertices().size():
		far = maxf(far, retarget.get_vertices()[v].distance_to(other.get_vertices()[v]))
	holds(far < 0.01, "the vest is %f elsewhere" % far)


## What hangs on a bone goes with it, from where the bone rests, however the skeleton is posed now.
func test_garment_on_a_bone() -> void:
	var outfit := character("outfit.glb")
	var bones := skeleton_in(outfit)
	var spine := bones.find_bone("spine_02")
	var vest := mesh_named(outfit, "Mannequin_Vest")
	var attachment := BoneAttachment3D.new()
	attachment.bone_name = "spine_02"
	bones.add_child(attachment)
	var node := MeshInstance3D.new()
	node.mesh = vest.mesh.duplicate()
	var arrays := node.mesh.surface_get_arrays(0)
	var into := bones.get_bone_global_rest(spine).affine_inverse()
	for v in arrays[Mesh.ARRAY_VERTEX].size():
		arrays[Mesh.ARRAY_VERTEX][v] = into * arrays[Mesh.ARRAY_VERTEX][v]
	arrays[Mesh.ARRAY_BONES] = null
	arrays[Mesh.ARRAY_WEIGHTS] = null
	node.mesh.clear_surfaces()
	node.mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	attachment.add_child(node)
	bones.set_bone_pose_position(spine, Vector3(0, 3, 0))
	await get_tree().process_frame
	var retarget := BespokeRetarget.new()
	retarget.set_garment(node)
	retarget.set_avatar(mesh_named(character("avatar.glb"), "Body"))
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
