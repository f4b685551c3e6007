"""Armatures as rigs: what each bone hangs on."""

from __future__ import annotations

import bpy

from case import Case, part

# As Rigify makes them: a bone, what it hangs on, and whether it moves the body.
_RIGIFY = """root - 0
torso root 0
ORG-spine torso 0
DEF-spine root 1
DEF-spine.001 DEF-spine 1
ORG-spine.001 torso 0
tweak_spine.001 ORG-spine.001 0
ORG-shoulder.L tweak_spine.001 0
DEF-shoulder.L ORG-shoulder.L 1
DEF-upper_arm.L ORG-shoulder.L 1
DEF-upper_arm.L.001 DEF-upper_arm.L 1
ORG-forearm.L DEF-upper_arm.L.001 0
DEF-thigh.L ORG-spine 1
DEF-tail torso 1
hat DEF-spine.001 1"""


class Rigs(Case):
    def parents(self, text: str) -> dict[str, str]:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        thing = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
        bpy.context.scene.collection.objects.link(thing)
        bpy.context.view_layer.objects.active = thing
        bpy.ops.object.mode_set(mode="EDIT")
        rows = [line.split() for line in text.splitlines()]
        for k, (name, above, deforms) in enumerate(rows):
            bone = thing.data.edit_bones.new(name)
            bone.head, bone.tail, bone.use_deform = (0.1 * k, 0.0, 0.0), (0.1 * k, 0.0, 0.1), deforms == "1"
            bone.parent = thing.data.edit_bones.get(above)
        bpy.ops.object.mode_set(mode="OBJECT")
        joints = part("rigs").joints(thing)
        self.assertEqual([joint.name for joint in joints], [bone.name for bone in thing.data.bones])
        return {joint.name: "-" if joint.parent is None else joints[joint.parent].name for joint in joints}

    def test_bones_of_rigify_hang_on_what_moves_the_body(self) -> None:
        found = self.parents(_RIGIFY)
        expected = {line.split()[0]: line.split()[1] for line in _RIGIFY.splitlines()}
        expected["DEF-shoulder.L"], expected["DEF-upper_arm.L"] = "DEF-spine.001", "DEF-shoulder.L"
        expected["DEF-thigh.L"] = "DEF-spine"
        self.assertEqual(found, expected)

    def test_in_a_circle_they_stay(self) -> None:
        rig = """ORG-a - 0
ORG-b ORG-a 0
DEF-c ORG-a 1
DEF-a ORG-b 1
DEF-b ORG-a 1"""
        self.assertEqual(self.parents(rig), {line.split()[0]: line.split()[1] for line in rig.splitlines()})
