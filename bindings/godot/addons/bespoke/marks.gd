@tool
extends RefCounted
## Shows triangles and vertices of findings in the viewport, in front of everything.

const COLOR := Color(1.0, 0.45, 0.1)


## A node for each skeleton that `elements` are in. They are under it, and no part of the scene.
static func of(elements: Array) -> Array[MeshInstance3D]:
	var triangles := {}
	var points := {}
	for element: Dictionary in elements:
		var skeleton: Variant = element.get("skeleton")
		var corners: PackedVector3Array = element.get("points", PackedVector3Array())
		if not is_instance_valid(skeleton) or corners.is_empty():
			continue
		var there: Dictionary = triangles if corners.size() == 3 else points
		there.get_or_add(skeleton, PackedVector3Array())
		var all: PackedVector3Array = there[skeleton]
		all.append_array(corners)
		there[skeleton] = all
	var marks: Array[MeshInstance3D] = []
	for skeleton: Skeleton3D in triangles:
		marks.append(_node(skeleton, triangles[skeleton], points.get(skeleton, PackedVector3Array())))
	for skeleton: Skeleton3D in points:
		if not triangles.has(skeleton):
			marks.append(_node(skeleton, PackedVector3Array(), points[skeleton]))
	return marks


static func _node(skeleton: Skeleton3D, triangles: PackedVector3Array, points: PackedVector3Array) -> MeshInstance3D:
	var mesh := ArrayMesh.new()
	if not triangles.is_empty():
		_add(mesh, Mesh.PRIMITIVE_TRIANGLES, triangles, 0.55)
		var edges := PackedVector3Array()
		for k in range(0, triangles.size(), 3):
			for edge in 3:
				edges.append_array([triangles[k + edge], triangles[k + (edge + 1) % 3]])
		_add(mesh, Mesh.PRIMITIVE_LINES, edges, 1.0)
	# A small triangle may be smaller than a pixel: its corners are dots.
	points.append_array(triangles)
	_add(mesh, Mesh.PRIMITIVE_POINTS, points, 1.0)
	var node := MeshInstance3D.new()
	node.name = "BespokeMarks"
	node.mesh = mesh
	node.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	skeleton.add_child(node, false, Node.INTERNAL_MODE_BACK)
	return node


static func _add(mesh: ArrayMesh, primitive: Mesh.PrimitiveType, vertices: PackedVector3Array, alpha: float) -> void:
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = vertices
	mesh.add_surface_from_arrays(primitive, arrays)
	var material := StandardMaterial3D.new()
	material.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	material.transparency = BaseMaterial3D.TRANSPARENCY_ALPHA
	material.cull_mode = BaseMaterial3D.CULL_DISABLED
	material.no_depth_test = true
	material.use_point_size = true
	material.point_size = 6.0
	material.albedo_color = Color(COLOR, alpha)
	mesh.surface_set_material(mesh.get_surface_count() - 1, material)
