# Blend shapes of the bodies, and meshes that go along with the garment.
extends Checks


## The mesh with a blend shape "heavy": all around its middle goes outwards, up to `by`.
func _with_heavy(design: Mesh, by: float) -> ArrayMesh:
	var arrays := design.surface_get_arrays(0)
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var box := design.get_aabb()
	var waist := box.position.y + 0.62 * box.size.y
	var center := box.get_center()
	var moved := vertices.duplicate()
	for v in moved.size():
		var out := Vector3(moved[v].x - center.x, 0, moved[v].z - center.z)
		if out.length() < 0.25:
			moved[v] += by * exp(-pow((moved[v].y - waist) / 0.12, 2)) * out.normalized()
	var shape := []
	shape.resize(Mesh.ARRAY_MAX)
	shape[Mesh.ARRAY_VERTEX] = moved
	for which: int in [Mesh.ARRAY_NORMAL, Mesh.ARRAY_TANGENT]:
		arrays[which] = null
	var mesh := ArrayMesh.new()
	mesh.blend_shape_mode = Mesh.BLEND_SHAPE_MODE_NORMALIZED
	mesh.add_blend_shape("heavy")
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [shape] as Array[Array])
	return mesh


func _girth(vertices: PackedVector3Array) -> float:
	var box := AABB(vertices[0], Vector3.ZERO)
	for v in vertices:
		box = box.expand(v)
	return box.size.x + box.size.z


## The body is dressed in the shape that it has on.
func test_avatar_in_its_shape() -> void:
	var retarget := vest_and_avatar()
	var body := mesh_named(get_child(1), "Body")
	body.mesh = _with_heavy(body.mesh, 0.05)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var slim := retarget.get_vertices()
	body.set_blend_shape_value(0, 1.0)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var heavy := retarget.get_vertices()
	holds(_girth(heavy) > _girth(slim) + 0.05, "around %f, and around %f" % [_girth(slim), _girth(heavy)])
	# The same as of a mesh that is so.
	var arrays := body.mesh.surface_get_arrays(0)
	arrays[Mesh.ARRAY_VERTEX] = body.mesh.surface_get_blend_shape_arrays(0)[0][Mesh.ARRAY_VERTEX]
	var baked := ArrayMesh.new()
	baked.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	body.mesh = baked
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var far := 0.0
	for v in heavy.size():
		far = maxf(far, heavy[v].distance_to(retarget.get_vertices()[v]))
	holds(far < 1e-3, "a baked body is dressed %f elsewhere" % far)


## The garment gets a blend shape that goes with that of the body.
func test_answered_blend_shapes() -> void:
	var retarget := vest_and_avatar()
	var body := mesh_named(get_child(1), "Body")
	body.mesh = _with_heavy(body.mesh, 0.03)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var slim := retarget.get_vertices()
	body.set_blend_shape_value(0, 0.75)
	retarget.set_answered_blend_shapes(["heavy"])
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")
	var share := 0.0
	while retarget.is_running():
		holds(retarget.get_progress().share >= share, "the share went back to %f" % retarget.get_progress().share)
		share = retarget.get_progress().share
		await get_tree().process_frame
	same(retarget.get_status(), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_vertices(), slim, "without the shape it is the same")
	var mesh := retarget.get_mesh()
	same([mesh.get_blend_shape_count(), mesh.get_blend_shape_name(0)], [1, &"heavy"], "blend shapes")
	var shape: PackedVector3Array = mesh.surface_get_blend_shape_arrays(0)[0][Mesh.ARRAY_VERTEX]
	var far := 0.0
	for v in slim.size():
		var offset := shape[v] if mesh.blend_shape_mode == Mesh.BLEND_SHAPE_MODE_RELATIVE else shape[v] - slim[v]
		far = maxf(far, offset.length())
	holds(far > 0.01 and far < 0.06, "the answer moves by %f" % far)
	var node: MeshInstance3D = retarget.dress()
	same(node.get_blend_shape_value(0), 0.75, "the value of the body's shape")
	_animations(retarget, body, node)


## Animations of the body's shape move that of the garment, too.
func _animations(retarget: BespokeRetarget, body: MeshInstance3D, worn: MeshInstance3D) -> void:
	var scene := get_child(1)
	var player := AnimationPlayer.new()
	scene.add_child(player)
	var grows := Animation.new()
	var track := grows.add_track(Animation.TYPE_BLEND_SHAPE)
	grows.track_set_path(track, "%s:heavy" % scene.get_path_to(body))
	grows.blend_shape_track_insert_key(track, 0.0, 0.0)
	grows.blend_shape_track_insert_key(track, 1.0, 0.5)
	var other := grows.add_track(Animation.TYPE_VALUE)
	grows.track_set_path(other, "%s:transparency" % scene.get_path_to(body))
	grows.track_insert_key(other, 0.0, 0.25)
	var library := AnimationLibrary.new()
	library.add_animation("grows", grows)
	player.add_animation_library("", library)
	same(retarget.add_blend_shape_tracks(player, worn), 1, "tracks that were added")
	same(grows.track_get_path(2), NodePath("%s:heavy" % scene.get_path_to(worn)), "the track of the garment")
	same(retarget.add_blend_shape_tracks(player, worn), 0, "tracks that were added again")
	player.play("grows")
	player.seek(1.0, true)
	same([body.get_blend_shape_value(0), worn.get_blend_shape_value(0)], [0.5, 0.5], "the values")
	same(retarget.add_blend_shape_tracks(worn, worn), 0, "tracks of no player")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["no AnimationPlayer"])
	same(retarget.add_blend_shape_tracks(player, player.get_parent()), 0, "tracks of no mesh")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["no MeshInstance3D"])
	var aside: MeshInstance3D = retarget.create_instance()
	same(retarget.add_blend_shape_tracks(player, aside), 0, "tracks of a node aside")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["add the garment to it first"])
	aside.free()


## A mesh beside the garment, out of some of its triangles, a little outside.
func _trim(vest: MeshInstance3D) -> MeshInstance3D:
	var surface := SurfaceTool.new()
	surface.create_from(vest.mesh, 0)
	surface.generate_normals()
	surface.generate_tangents()
	var arrays := surface.commit_to_arrays()
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
	for v in vertices.size():
		vertices[v] += 0.004 * normals[v]
	arrays[Mesh.ARRAY_VERTEX] = vertices
	arrays[Mesh.ARRAY_INDEX] = PackedInt32Array(arrays[Mesh.ARRAY_INDEX]).slice(0, 90)
	var moved := vertices.duplicate()
	for v in moved.size():
		moved[v] += 0.01 * normals[v]
	var shape := []
	shape.resize(Mesh.ARRAY_MAX)
	shape[Mesh.ARRAY_VERTEX] = moved
	shape[Mesh.ARRAY_NORMAL] = normals
	shape[Mesh.ARRAY_TANGENT] = arrays[Mesh.ARRAY_TANGENT]
	var mesh := ArrayMesh.new()
	mesh.blend_shape_mode = Mesh.BLEND_SHAPE_MODE_NORMALIZED
	mesh.add_blend_shape("out")
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [shape] as Array[Array])
	var material := StandardMaterial3D.new()
	mesh.surface_set_material(0, material)
	var trim := MeshInstance3D.new()
	trim.name = "Trim"
	trim.mesh = mesh
	trim.skin = vest.skin
	vest.get_parent().add_child(trim)
	trim.skeleton = vest.skeleton
	trim.visibility_range_begin = 5.0
	return trim


func test_followers() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	var trim := _trim(vest)
	retarget.add_follower([trim, vest])
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_follower_count(), 2, "followers")
	var mesh := retarget.get_follower_mesh(0)
	var arrays := mesh.surface_get_arrays(0)
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
	var moved: PackedVector3Array = mesh.surface_get_blend_shape_arrays(0)[0][Mesh.ARRAY_VERTEX]
	var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	var design: PackedVector3Array = trim.mesh.surface_get_arrays(0)[Mesh.ARRAY_VERTEX]
	var cloth: PackedVector3Array = vest.mesh.surface_get_arrays(0)[Mesh.ARRAY_VERTEX]
	for v in indices:
		# As far from the garment as it was designed, as much as the garment has grown.
		var below := 0
		for k in cloth.size():
			if cloth[k].distance_to(design[v]) < cloth[below].distance_to(design[v]):
				below = k
		var beside := vertices[v].distance_to(retarget.get_vertices()[below])
		if not holds(beside > 0.001 and beside < 0.012, "vertex %d is %f away" % [v, beside]):
			break
		var out := moved[v] - vertices[v]
		if not holds(out.length() > 0.004 and out.length() < 0.03, "its blend shape moves by %f" % out.length()):
			break
		if not holds(out.normalized().dot(normals[v]) > 0.95, "it moves along %s, and its normal is %s" % [out, normals[v]]):
			break
	same(mesh.surface_get_material(0), trim.mesh.surface_get_material(0), "its material")
	# A copy of the garment comes to the same place.
	var far := 0.0
	var copy: PackedVector3Array = retarget.get_follower_mesh(1).surface_get_arrays(0)[Mesh.ARRAY_VERTEX]
	for v in copy.size():
		far = maxf(far, copy[v].distance_to(retarget.get_vertices()[v]))
	holds(far < 1e-4, "a copy of the garment is %f away" % far)
	var avatar := skeleton_in(get_child(1))
	var node: MeshInstance3D = retarget.dress()
	var worn: MeshInstance3D = avatar.get_node("Trim")
	same([worn.mesh, worn.skin, worn.visibility_range_begin], [mesh, node.skin, 5.0], "the node of the trim")
	same(worn.get_node(worn.skeleton), avatar, "its skeleton")
	var single: MeshInstance3D = retarget.create_follower(1)
	same(single.mesh, retarget.get_follower_mesh(1), "a node of one")
	single.free()
	holds(retarget.create_follower(2) == null, "there is a third")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["no follower 2", "there are 2"])
	retarget.clear_followers()
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_follower_count(), 0, "followers that were taken away")


## One that ends up in the body is told, with its own triangles.
func test_follower_in_the_body() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	var trim := _trim(vest)
	var arrays := trim.mesh.surface_get_arrays(0)
	# Inwards, so that a trim beside loose cloth is in a body with less room.
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	for v in vertices.size():
		vertices[v] -= 0.012 * PackedVector3Array(arrays[Mesh.ARRAY_NORMAL])[v]
	arrays[Mesh.ARRAY_VERTEX] = vertices
	var inner := ArrayMesh.new()
	inner.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	trim.mesh = inner
	retarget.looseness = 0.0
	retarget.add_follower(trim)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var found := retarget.get_findings().filter(
		func(one: Dictionary) -> bool: return one.kind == BespokeRetarget.KIND_FOLLOWER_INTERSECTS)
	if not holds(found.size() == 1, "it is told %d times" % found.size()):
		return
	var element: Dictionary = found[0].elements[0]
	same(element.subject, BespokeRetarget.SUBJECT_FOLLOWER, "whose it is")
	same([element.node, element.points.size()], [trim, 3], "its triangle")
