# Characters of files, dressed in a scene. What comes out is written for the same in C.
extends Checks


func _array(mesh: Mesh, which: int) -> Variant:
	var all: Variant = mesh.surface_get_arrays(0)[which]
	return all


## A side of the scene as plain numbers, read without the add-on. In these files meshes are bound where the bones rest.
func _write_side(side: String, skeleton: Skeleton3D, meshes: Dictionary) -> void:
	var joints := []
	for bone in skeleton.get_bone_count():
		var rest := skeleton.get_bone_global_rest(bone)
		var numbers := []
		for column: Vector3 in [rest.basis.x, rest.basis.y, rest.basis.z, rest.origin]:
			numbers.append_array([column.x, column.y, column.z])
		joints.append({"name": skeleton.get_bone_name(bone), "parent": skeleton.get_bone_parent(bone)})
		write("%s.%d.rest" % [side, bone], PackedFloat32Array(numbers).to_byte_array())
	write(side + ".joints.json", JSON.stringify(joints).to_utf8_buffer())
	for name: String in meshes:
		var node: MeshInstance3D = meshes[name]
		var bones: PackedInt32Array = _array(node.mesh, Mesh.ARRAY_BONES)
		if node.skin:
			for k in bones.size():
				bones[k] = _bone(skeleton, node.skin, bones[k])
		write(name + ".positions", _array(node.mesh, Mesh.ARRAY_VERTEX).to_byte_array())
		write(name + ".triangles", _array(node.mesh, Mesh.ARRAY_INDEX).to_byte_array())
		write(name + ".bones", bones.to_byte_array())
		write(name + ".weights", _array(node.mesh, Mesh.ARRAY_WEIGHTS).to_byte_array())


func _bone(skeleton: Skeleton3D, skin: Skin, bind: int) -> int:
	var name := skin.get_bind_name(bind)
	return skin.get_bind_bone(bind) if name.is_empty() else skeleton.find_bone(name)


func test_rigged_gltf_is_dressed() -> void:
	var outfit := character("outfit.glb")
	var avatar := character("avatar.glb")
	var own_body := mesh_named(outfit, "Mannequin_Body")
	var garment: MeshInstance3D = null
	for node: MeshInstance3D in outfit.find_children("*", "MeshInstance3D", true, false):
		if node != own_body:
			garment = node
	var body := mesh_named(avatar, "Body")
	var retarget := BespokeRetarget.new()
	retarget.set_garment(garment)
	retarget.set_source_body(own_body)
	retarget.set_avatar(body)
	var status: int = await outcome(retarget)
	same(status, BespokeRetarget.STATUS_OK, "the status: " + retarget.get_message())
	_write_side("source", skeleton_in(outfit), {"garment": garment, "body": own_body})
	_write_side("target", skeleton_in(avatar), {"avatar": body})
	write("dressed", retarget.get_vertices().to_byte_array())
	var mesh := retarget.get_mesh()
	if not holds(mesh != null, "there is no mesh"):
		return
	# What is drawn is what was verified.
	same(_array(mesh, Mesh.ARRAY_VERTEX), retarget.get_vertices(), "the mesh")
	write("dressed.bones", _array(mesh, Mesh.ARRAY_BONES).to_byte_array())
	var node: MeshInstance3D = retarget.dress()
	same(node.get_parent(), skeleton_in(avatar), "the parent")
	same(node.get_node(node.skeleton), skeleton_in(avatar), "the skeleton")
	same(node.mesh, mesh, "the mesh of the node")
	same(node.skin, retarget.get_skin(), "the skin of the node")
