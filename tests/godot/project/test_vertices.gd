# What is said of single vertices of the garment: numbers, lists, and what is painted on it.
extends Checks


func _far(one: PackedVector3Array, other: PackedVector3Array, vertices: PackedInt32Array) -> float:
	var far := 0.0
	for v in vertices:
		far = maxf(far, one[v].distance_to(other[v]))
	return far


## The vest with colours and a custom channel: red is 1 below the middle, green 1 on two patches, x as red.
func _painted(design: Mesh) -> ArrayMesh:
	var arrays := design.surface_get_arrays(0)
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var box := design.get_aabb()
	var middle := box.get_center().y
	var colors := PackedColorArray()
	var custom := PackedFloat32Array()
	for v in vertices:
		var low := 1.0 if v.y < middle else 0.0
		var left := v.distance_to(Vector3(box.position.x, middle, box.get_center().z)) < 0.12
		var right := v.distance_to(Vector3(box.end.x, middle, box.get_center().z)) < 0.12
		colors.append(Color(low, 1.0 if left or right else 0.0, 0.0))
		custom.append(low)
	arrays[Mesh.ARRAY_COLOR] = colors
	arrays[Mesh.ARRAY_CUSTOM0] = custom
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(
		Mesh.PRIMITIVE_TRIANGLES, arrays, [], {}, Mesh.ARRAY_CUSTOM_R_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT)
	return mesh


func _lit(mesh: Mesh, part: int) -> PackedInt32Array:
	var found := PackedInt32Array()
	var colors: PackedColorArray = mesh.surface_get_arrays(0)[Mesh.ARRAY_COLOR]
	for v in colors.size():
		if colors[v][part] > 0.5:
			found.append(v)
	return found


## The same numbers, in whatever way they are said.
func test_fit_weights() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	vest.mesh = _painted(vest.mesh)
	retarget.looseness = 0.0
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var tight := retarget.get_vertices()
	var numbers := PackedFloat32Array()
	for v in tight.size():
		numbers.append(0.0)
	for v in _lit(vest.mesh, 0):
		numbers[v] = 1.0
	retarget.set_fit_weights(numbers)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var loose := retarget.get_vertices()
	var upper := PackedInt32Array()
	for v in numbers.size():
		if numbers[v] == 0.0:
			upper.append(v)
	holds(_far(loose, tight, upper) > 0.005, "what does not fit is %f away" % _far(loose, tight, upper))
	for said: Variant in ["color.r", &"custom0.x", Array(numbers), PackedFloat64Array(Array(numbers))]:
		retarget.set_fit_weights(said)
		same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
		same(retarget.get_vertices(), loose, "by %s" % type_string(typeof(said)))
	retarget.set_fit_weights(null)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_vertices(), tight, "without")


func test_pins() -> void:
	var retarget := vest_and_avatar()
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var free := retarget.get_vertices()
	# Where they come without: pushed out by two centimetres.
	var held := PackedInt32Array([0, 40, 80])
	var targets := PackedVector3Array()
	var spine := skeleton_in(get_child(1)).get_bone_global_rest(skeleton_in(get_child(1)).find_bone("mixamorig_Spine")).origin
	for v in held:
		var out := Vector3(free[v].x - spine.x, 0.0, free[v].z - spine.z).normalized()
		targets.append(free[v] + 0.02 * out)
	retarget.set_pins(held, targets)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var pinned := retarget.get_vertices()
	for k in held.size():
		var away := pinned[held[k]].distance_to(targets[k])
		holds(away < 0.004, "vertex %d is %f from its target" % [held[k], away])
	holds(_far(pinned, free, held) > 0.015, "the pins have moved nothing")
	# Without targets they keep their place on the nearest bone.
	retarget.set_pins(held)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	holds(retarget.get_vertices() != pinned and retarget.get_vertices() != free, "pins without targets do nothing")
	retarget.set_pins(null)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_vertices(), free, "without pins")


## How far distances within a group are from those of the design, all scaled alike.
func _bent(group: PackedInt32Array, design: PackedVector3Array, result: PackedVector3Array) -> float:
	var low := INF
	var high := 0.0
	for one in group:
		for other in group:
			var was := design[one].distance_to(design[other])
			if was > 0.01:
				low = minf(low, result[one].distance_to(result[other]) / was)
				high = maxf(high, result[one].distance_to(result[other]) / was)
	return high / low - 1.0


func test_rigid_groups() -> void:
	var retarget := vest_and_avatar()
	var vest := mesh_named(get_child(0), "Mannequin_Vest")
	vest.mesh = _painted(vest.mesh)
	var design: PackedVector3Array = vest.mesh.surface_get_arrays(0)[Mesh.ARRAY_VERTEX]
	var left := PackedInt32Array()
	var right := PackedInt32Array()
	for v in _lit(vest.mesh, 1):
		(left if design[v].x < vest.mesh.get_aabb().get_center().x else right).append(v)
	if not holds(left.size() > 5 and right.size() > 5, "the patches have %d and %d vertices" % [left.size(), right.size()]):
		return
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var free := _bent(left, design, retarget.get_vertices())
	holds(free > 0.01, "the patch is bent by %f without" % free)
	# Two pieces that are painted are two groups.
	retarget.add_rigid_group("color.g")
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	var painted := retarget.get_vertices()
	for patch: PackedInt32Array in [left, right]:
		holds(_bent(patch, design, painted) < 1e-3, "a patch is bent by %f" % _bent(patch, design, painted))
	retarget.clear_rigid_groups()
	retarget.add_rigid_group(left)
	retarget.add_rigid_group(right)
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
	same(retarget.get_vertices(), painted, "by lists")


func test_refusals() -> void:
	var wrong := {
		"three numbers": [func(r: BespokeRetarget) -> void: r.set_fit_weights(PackedFloat32Array([1, 2, 3])), ["fit weights", "3 numbers"]],
		"a word in it": [func(r: BespokeRetarget) -> void: r.set_fit_weights(["a"]), ["fit weights", "no array of numbers"]],
		"an object": [func(r: BespokeRetarget) -> void: r.set_fit_weights(Node), ["fit weights", "no array of numbers"]],
		"no channel": [func(r: BespokeRetarget) -> void: r.set_fit_weights("paint"), ["fit weights", "'paint'", "color.r"]],
		"no colour": [func(r: BespokeRetarget) -> void: r.set_pins("color.r"), ["pins", "no surface", "'color.r'"]],
		"no part": [func(r: BespokeRetarget) -> void: r.set_pins("custom0.r"), ["pins", "'custom0.r' is no channel"]],
		"a vertex": [func(r: BespokeRetarget) -> void: r.set_pins([0, 1000000]), ["pins", "1000000"]],
		"before the first": [func(r: BespokeRetarget) -> void: r.set_pins([-1]), ["pins", "-1"]],
		"targets": [func(r: BespokeRetarget) -> void: r.set_pins([0, 1], [Vector3.ZERO]), ["pins", "1 targets for 2"]],
		"nothing rigid": [func(r: BespokeRetarget) -> void: r.add_rigid_group([]), ["rigid group", "no vertex"]],
		"twice": [
			func(r: BespokeRetarget) -> void:
				r.add_rigid_group([0, 1])
				r.add_rigid_group([1, 2]),
			["group"]],
		"no shape": [func(r: BespokeRetarget) -> void: r.set_answered_blend_shapes(["heavy"]), ["blend shapes", "'heavy'"]],
	}
	for what: String in wrong:
		var retarget := vest_and_avatar()
		wrong[what][0].call(retarget)
		refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, wrong[what][1])
		holds(not retarget.is_running(), what + ": it runs")
	var retarget := vest_and_avatar()
	retarget.set_fit_weights(PackedFloat32Array([]))
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["0 numbers"])
