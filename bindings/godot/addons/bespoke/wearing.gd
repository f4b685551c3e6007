@tool
extends RefCounted
## Puts a result into the scene, and takes it out again when that is undone.

## Marks what was put on by us, with the garment that it is.
const MARK := &"bespoke_garment"
## Marks what goes along with one.
const ALONG := &"bespoke_goes_along"


## What a skeleton wears and shows, in the order in which it was put on, but for what the garment takes the place of.
static func worn_below(garment: Node3D, skeleton: Skeleton3D) -> Array[MeshInstance3D]:
	var worn: Array[MeshInstance3D] = []
	if not is_instance_valid(garment) or not is_instance_valid(skeleton):
		return worn
	for child in skeleton.get_children():
		if not child is MeshInstance3D or not child.has_meta(MARK) or child.has_meta(ALONG):
			continue
		if child.visible and child != garment and child.get_meta(MARK) != str(garment.name):
			worn.append(child)
	return worn


## Puts the result under the skeleton, with what goes along. An earlier one of the same garment there goes.
func put_on(retarget: BespokeRetarget, garment: Node3D, skeleton: Skeleton3D, undo_redo: EditorUndoRedoManager) -> void:
	if not is_instance_valid(skeleton) or not skeleton.is_inside_tree():
		return
	var worn: Array[Node3D] = [retarget.create_instance()]
	for k in retarget.get_follower_count():
		worn.append(retarget.create_follower(k))
	var root := skeleton.get_tree().edited_scene_root if skeleton.is_part_of_edited_scene() else skeleton.owner
	var name := str(garment.name) if is_instance_valid(garment) else "Garment"
	worn[0].name = name
	for k in worn.size():
		worn[k].set_meta(MARK, name)
		if k > 0:
			worn[k].set_meta(ALONG, true)
	undo_redo.create_action("Dress in " + name, UndoRedo.MERGE_DISABLE, root)
	for child in skeleton.get_children():
		if child.has_meta(MARK) and child.get_meta(MARK) == name:
			undo_redo.add_do_method(skeleton, &"remove_child", child)
			undo_redo.add_undo_method(skeleton, &"add_child", child, true)
			undo_redo.add_undo_property(child, &"owner", child.owner)
			undo_redo.add_undo_reference(child)
	if not retarget.get_added_bones().is_empty():
		undo_redo.add_do_method(retarget, &"add_bones", skeleton)
		undo_redo.add_undo_method(self, &"restore", skeleton, bones(skeleton))
	for instance in worn:
		undo_redo.add_do_method(skeleton, &"add_child", instance, true)
		undo_redo.add_do_property(instance, &"owner", root)
		undo_redo.add_do_reference(instance)
		undo_redo.add_undo_method(skeleton, &"remove_child", instance)
	undo_redo.commit_action()


## All that a skeleton holds.
static func bones(skeleton: Skeleton3D) -> Array[Dictionary]:
	var all: Array[Dictionary] = []
	for bone in skeleton.get_bone_count():
		all.append({
			"name": skeleton.get_bone_name(bone), "parent": skeleton.get_bone_parent(bone),
			"rest": skeleton.get_bone_rest(bone), "pose": skeleton.get_bone_pose(bone),
			"enabled": skeleton.is_bone_enabled(bone),
		})
	return all


## Makes it hold just these: a skeleton lets no single bone go.
func restore(skeleton: Skeleton3D, all: Array[Dictionary]) -> void:
	skeleton.clear_bones()
	for bone in all:
		skeleton.add_bone(bone.name)
	for k in all.size():
		skeleton.set_bone_parent(k, all[k].parent)
		skeleton.set_bone_rest(k, all[k].rest)
		skeleton.set_bone_pose(k, all[k].pose)
		skeleton.set_bone_enabled(k, all[k].enabled)
