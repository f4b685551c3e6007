# What goes in: setters, options, joints, and every way in which they are refused.
extends Checks


func test_version_and_constants() -> void:
	holds(BespokeRetarget.get_version().begins_with("0."), "the version is " + BespokeRetarget.get_version())
	same(BespokeRetarget.get_constant_name("STATUS", BespokeRetarget.STATUS_BUSY), "STATUS_BUSY", "the name")
	same(BespokeRetarget.get_constant_name("STAGE", 5), "STAGE_DONE", "the name")
	same(BespokeRetarget.get_constant_name("STAGE", 500), "", "a name of no stage")
	holds(BespokeRetarget.get_constant_text("STATUS", 8).contains("inflated"), "the text of a status")
	for constant in ClassDB.class_get_integer_constant_list("BespokeRetarget", true):
		var value := ClassDB.class_get_integer_constant("BespokeRetarget", constant)
		var prefix := constant.get_slice("_", 0)
		same(BespokeRetarget.get_constant_name(prefix, value), constant, "the name of a constant")
		holds(not BespokeRetarget.get_constant_text(prefix, value).is_empty(), constant + " has no text")


## Each status has its section in the document that the add-on brings.
func test_help_anchors() -> void:
	var text := FileAccess.get_file_as_string("res://addons/bespoke/docs/troubleshooting.md").to_lower()
	holds(not text.is_empty(), "the document is not in the add-on")
	for status in range(1, 16):
		var anchor := BespokeRetarget.get_help_anchor(status)
		holds(anchor.begins_with("troubleshooting.md#"), anchor)
		holds(text.contains("## " + anchor.get_slice("#", 1) + "\n"), "there is no section " + anchor)
	same(BespokeRetarget.get_help_anchor(77), "", "the section of no status")


func test_dials_and_options() -> void:
	var retarget := BespokeRetarget.new()
	same([retarget.fit, retarget.looseness, retarget.offset, retarget.influences], [2.0, 1.0, 0.0, 4], "the defaults")
	retarget.fit = 3.5
	retarget.looseness = 0.5
	retarget.offset = 0.01
	retarget.influences = 8
	same([retarget.fit, retarget.looseness, retarget.offset, retarget.influences], [3.5, 0.5, 0.01, 8], "what is set")
	same(retarget.get_option("fit_weight"), 3.5, "the option of fit")
	same(retarget.get_option("designed_clearance"), 0.5, "the option of looseness")
	same(retarget.set_option("fit_weight", null), BespokeRetarget.STATUS_OK, "taken back")
	same(retarget.fit, 2.0, "fit")
	same(retarget.set_option("strict", true), BespokeRetarget.STATUS_OK, "a flag")
	same(retarget.get_option("strict"), true, "a flag")
	same(retarget.set_option("fit_weight", 0), BespokeRetarget.STATUS_OK, "switched off")
	same(retarget.get_option("fit_weight"), 0.0, "switched off")
	var refusals := {
		"tightness": [1.0, "there is no option 'tightness'"],
		"fit_weight": [-1.0, "no finite number from 0 on"],
		"threads": ["many", "no finite number"],
		"dhat": [0.0, "must be above 0"],
		"offset": [NAN, "no finite number"],
	}
	for name: String in refusals:
		var status := retarget.set_option(name, refusals[name][0])
		refused(retarget, status, BespokeRetarget.STATUS_INVALID_ARGUMENT, [name, refusals[name][1]])
	same(retarget.get_option("tightness"), null, "an option that is none")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["tightness", "fit_weight"])


func test_table_of_options() -> void:
	var table := BespokeRetarget.get_options()
	holds(table.size() > 20, "there are %d options" % table.size())
	var retarget := BespokeRetarget.new()
	for option in table:
		holds(not option.text.is_empty() and not option.default_text.is_empty(), "%s says nothing" % option.name)
		same(retarget.get_option(option.name), option.default, option.name)
		if not option.is_expert and option.name != "threads":
			same(retarget.set_option(option.name, option.default), BespokeRetarget.STATUS_OK, option.name)


func test_what_is_missing() -> void:
	var outfit := character("outfit.glb")
	var retarget := BespokeRetarget.new()
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["garment", "no MeshInstance3D"])
	retarget.set_garment(mesh_named(outfit, "Mannequin_Vest"))
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["avatar", "no MeshInstance3D"])
	retarget.set_avatar(BoxMesh.new())
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_SKELETON, ["avatar", "no Skeleton3D"])
	retarget.set_avatar(BoxMesh.new(), self_as_node())
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_SKELETON, ["avatar", "no Skeleton3D"])
	var both: Array[MeshInstance3D] = [mesh_named(outfit, "Mannequin_Vest"), mesh_named(outfit, "Mannequin_Body")]
	retarget.set_garment(both)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["2 meshes", "layers"])
	retarget.set_garment(outfit)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["garment"])
	retarget.set_garment("a jacket")
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["garment"])
	holds(not retarget.is_running(), "it runs")
	holds(retarget.get_mesh() == null, "there is a mesh")
	holds(retarget.get_skin() == null, "there is a skin")
	same(retarget.get_vertices(), PackedVector3Array(), "vertices")
	holds(retarget.create_instance() == null, "there is a node")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_STATE, ["no result"])
	holds(retarget.dress() == null, "there is a node")
	same(retarget.get_covered_triangles(), [] as Array[Dictionary], "covered triangles")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_STATE, ["no result"])
	same(retarget.get_progress(), {}, "progress")
	same(retarget.get_added_bones(), PackedStringArray(), "bones")
	retarget.add_bones(null)
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["no Skeleton3D"])


func self_as_node() -> Node3D:
	var node := Node3D.new()
	add_child(node)
	return node


func test_nodes_that_are_gone() -> void:
	var outfit := character("outfit.glb")
	var retarget := BespokeRetarget.new()
	retarget.set_garment(mesh_named(outfit, "Mannequin_Vest"))
	outfit.free()
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["garment", "freed"])
	var avatar := character("avatar.glb")
	retarget = BespokeRetarget.new()
	retarget.set_garment(BoxMesh.new(), skeleton_in(avatar))
	avatar.free()
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_SKELETON, ["garment", "freed"])


func test_bad_meshes_and_skeletons() -> void:
	var avatar := character("avatar.glb")
	var bones := skeleton_in(avatar)
	var retarget := BespokeRetarget.new()
	retarget.set_avatar(mesh_named(avatar, "Body"))
	var lines := ArrayMesh.new()
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array([Vector3.ZERO, Vector3.ONE])
	lines.add_surface_from_arrays(Mesh.PRIMITIVE_LINES, arrays)
	retarget.set_garment(lines, bones)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["surface 0", "triangles"])
	retarget.set_garment(ArrayMesh.new(), bones)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["garment", "no triangles"])
	var empty := MeshInstance3D.new()
	empty.name = "Empty"
	add_child(empty)
	retarget.set_garment(empty, bones)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_MESH, ["'Empty'", "no mesh"])
	var boneless := Skeleton3D.new()
	add_child(boneless)
	retarget.set_garment(BoxMesh.new(), boneless)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_SKELETON, ["no bones"])
	var body: MeshInstance3D = mesh_named(avatar, "Body")
	body.skin = body.skin.duplicate()
	body.skin.set_bind_name(3, "Tail")
	retarget.set_garment(BoxMesh.new(), bones)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_SKELETON, ["bind 3", "Tail", "skeleton"])


func test_joint_map_and_pairs() -> void:
	var retarget := vest_and_avatar()
	var map := retarget.get_joint_map()
	var rows := {}
	for row in map:
		rows[row.source] = row
	# The engine's reader of glTF takes no colon in the name of a bone.
	same(rows["upperarm_l"].target, "mixamorig_LeftArm", "the arm")
	same(rows["upperarm_l"].reason, BespokeRetarget.REASON_NAME, "the reason")
	same(rows["upperarm_l"].part, "left upper arm", "the part")
	holds(rows["upperarm_l"].confidence > 0.9, "the confidence")
	var other: String = rows["lowerarm_l"].target
	retarget.set_joint_pairs({"upperarm_l": other, "hand_r": ""})
	same(retarget.get_joint_pairs(), {"upperarm_l": other, "hand_r": ""}, "the pairs")
	for row in retarget.get_joint_map():
		if row.source == "upperarm_l":
			same([row.target, row.reason], [other, BespokeRetarget.REASON_CALLER], "the pair")
		if row.source == "hand_r":
			same([row.target, row.reason], ["", BespokeRetarget.REASON_CALLER], "no pair")
	retarget.set_joint_pairs({"tail": other})
	same(retarget.get_joint_map(), [] as Array[Dictionary], "the map")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["'tail'", "garment"])
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["'tail'", "garment"])
	retarget.set_joint_pairs({"hand_r": "paw"})
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["'paw'", "avatar"])
	retarget.set_joint_pairs({"hand_r": other, "hand_l": other})
	refused(retarget, await outcome(retarget), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["each joint can be in one"])


## With bones that nobody knows by name, the map of the profile says what they are.
func test_bone_maps() -> void:
	var retarget := vest_and_avatar()
	var avatar: Skeleton3D = skeleton_in(get_child(1))
	var wanted := {}
	for row in retarget.get_joint_map():
		wanted[row.source] = avatar.find_bone(row.target) if row.target else -1
	var profile := SkeletonProfileHumanoid.new()
	var bone_map := BoneMap.new()
	bone_map.profile = profile
	var humanoid := {
		"Hips": "pelvis", "LeftUpperArm": "upperarm_l", "LeftLowerArm": "lowerarm_l", "RightUpperArm": "upperarm_r",
		"RightLowerArm": "lowerarm_r", "LeftUpperLeg": "thigh_l", "LeftLowerLeg": "calf_l", "RightUpperLeg": "thigh_r",
		"RightLowerLeg": "calf_r", "Head": "head",
	}
	for bone in avatar.get_bone_count():
		avatar.set_bone_name(bone, "b%d" % bone)
	for part: String in humanoid:
		bone_map.set_skeleton_bone_name(part, "b%d" % wanted[humanoid[part]])
	retarget.set_avatar_bone_map(bone_map)
	for row in retarget.get_joint_map():
		if row.source in humanoid.values():
			same(row.target, "b%d" % wanted[row.source], "the bone for " + row.source)
			same(row.reason, BespokeRetarget.REASON_NAME, "the reason for " + row.source)
	retarget.set_avatar_bone_map(BoneMap.new())
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["bone map", "profile"])
	retarget.set_avatar_bone_map(Skin.new())
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["no BoneMap"])
	retarget.set_avatar_bone_map(null)
	retarget.set_source_bone_map(Skin.new())
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["garment", "no BoneMap"])


## The library looks at ranges when it begins, and names the option.
func test_ranges() -> void:
	var retarget := vest_and_avatar()
	retarget.looseness = 5.0
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["designed_clearance"])
	retarget.looseness = 1.0
	retarget.set_option("threads", 5000)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["threads"])


## What a part of the avatar is to the garment: a collar of armour that the vest does not pass through, and is not drawn to.
func test_roles_of_the_avatar() -> void:
	var retarget := vest_and_avatar()
	var bones := skeleton_in(get_child(1))
	var spine := bones.get_bone_global_rest(bones.find_bone("mixamorig_Spine1")).origin
	var armour := MeshInstance3D.new()
	armour.name = "Armour"
	var ring := TorusMesh.new()
	ring.inner_radius = 0.19
	ring.outer_radius = 0.21
	armour.mesh = ring
	bones.add_child(armour)
	armour.position = spine
	var found := {}
	for role: int in [BespokeRetarget.ROLE_BODY, BespokeRetarget.ROLE_COLLISION, BespokeRetarget.ROLE_IGNORED]:
		retarget.set_avatar([mesh_named(get_child(1), "Body"), armour])
		retarget.set_avatar_role(armour, role)
		same(await outcome(retarget), BespokeRetarget.STATUS_OK, retarget.get_message())
		same(retarget.get_report().avatar_intersections, 0, "intersections")
		found[role] = retarget.get_vertices()
	holds(found[BespokeRetarget.ROLE_COLLISION] != found[BespokeRetarget.ROLE_IGNORED], "the role changes nothing")
	holds(found[BespokeRetarget.ROLE_COLLISION] != found[BespokeRetarget.ROLE_BODY], "the vest is drawn to what it only meets")
	# Without it, the same as ignored.
	var plain := vest_and_avatar()
	plain.set_avatar(mesh_named(get_child(1), "Body"))
	same(await outcome(plain), BespokeRetarget.STATUS_OK, plain.get_message())
	same(found[BespokeRetarget.ROLE_IGNORED], plain.get_vertices(), "an armour that is ignored")
	plain.set_avatar_role(armour, BespokeRetarget.ROLE_COLLISION)
	refused(plain, plain.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["'Armour'", "no mesh of the avatar"])
	retarget.set_avatar_role(armour, 77)
	refused(retarget, retarget.start(), BespokeRetarget.STATUS_INVALID_ARGUMENT, ["77"])
