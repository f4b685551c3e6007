# What the tests check with, and scenes to try things with.
class_name Checks
extends Node

## A folder for what a test reads and writes.
var data := ""
## What did not hold.
var failures := PackedStringArray()


func holds(condition: bool, sentence: String) -> bool:
	if not condition:
		failures.append(sentence)
	return condition


func same(found: Variant, wanted: Variant, what: String) -> bool:
	return holds(typeof(found) == typeof(wanted) and found == wanted, "%s is %s and not %s" % [what, found, wanted])


## It was refused with this status and a message with these words.
func refused(retarget: BespokeRetarget, found: int, wanted: int, words: Array) -> void:
	var message := retarget.get_message()
	same(BespokeRetarget.get_constant_name("STATUS", found), BespokeRetarget.get_constant_name("STATUS", wanted), message)
	same(retarget.get_status(), found, "get_status")
	for word: String in words:
		holds(message.contains(word), "'%s' does not hold '%s'" % [message, word])


## The character in a GLB file of the data, under this node.
func character(file: String) -> Node3D:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	var status := document.append_from_file(data.path_join(file), state)
	if not holds(status == OK, "%s cannot be read: %s" % [file, error_string(status)]):
		return null
	var scene: Node3D = document.generate_scene(state)
	add_child(scene)
	# GLTFDocument makes meshes for the importer.
	for node in scene.find_children("*", "ImporterMeshInstance3D", true, false):
		holds(false, "%s was not converted" % node.name)
	return scene


func mesh_named(scene: Node, wanted: String) -> MeshInstance3D:
	for node in scene.find_children("*", "MeshInstance3D", true, false):
		if node.name == wanted:
			return node
	holds(false, "there is no mesh %s" % wanted)
	return null


func skeleton_in(scene: Node) -> Skeleton3D:
	return scene.find_children("*", "Skeleton3D", true, false)[0]


## The vest of outfit.glb on its way to avatar.glb.
func vest_and_avatar() -> BespokeRetarget:
	var outfit := character("outfit.glb")
	var avatar := character("avatar.glb")
	var retarget := BespokeRetarget.new()
	retarget.set_garment(mesh_named(outfit, "Mannequin_Vest"))
	retarget.set_source_body(mesh_named(outfit, "Mannequin_Body"))
	retarget.set_avatar(mesh_named(avatar, "Body"))
	return retarget


## The status with which it ends.
func outcome(retarget: BespokeRetarget) -> int:
	var status := retarget.start()
	if status != BespokeRetarget.STATUS_OK:
		return status
	while retarget.is_running():
		await get_tree().process_frame
	return retarget.get_status()


func write(file: String, bytes: PackedByteArray) -> void:
	var out := FileAccess.open(data.path_join(file), FileAccess.WRITE)
	if holds(out != null, "%s cannot be written" % file):
		out.store_buffer(bytes)


## A skinned mesh with a small tetrahedron that pokes through it at its first vertex.
func poked(mesh: Mesh) -> ArrayMesh:
	var arrays := mesh.surface_get_arrays(0)
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var at := vertices[0]
	var first := vertices.size()
	for corner: Vector3 in [Vector3(0, 0.02, 0), Vector3(0.02, -0.02, 0.02), Vector3(-0.02, -0.02, 0.02), Vector3(0, -0.02, -0.03)]:
		vertices.append(at + corner)
	arrays[Mesh.ARRAY_VERTEX] = vertices
	var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	for k: int in [0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]:
		indices.append(first + k)
	arrays[Mesh.ARRAY_INDEX] = indices
	for kind: int in [Mesh.ARRAY_NORMAL, Mesh.ARRAY_TANGENT, Mesh.ARRAY_TEX_UV]:
		arrays[kind] = null
	for k in 4:
		for n in 4:
			arrays[Mesh.ARRAY_BONES].append(arrays[Mesh.ARRAY_BONES][n])
			arrays[Mesh.ARRAY_WEIGHTS].append(arrays[Mesh.ARRAY_WEIGHTS][n])
	var changed := ArrayMesh.new()
	changed.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return changed
