"""VRM characters: which bone is which, as the VRM add-on keeps it in the armature, without that add-on."""

from __future__ import annotations

from typing import Any

import bpy

import tubes
from case import Case, part

# Bones that nobody knows by their names.
STRANGE = ("alpha", "beta", "gamma")


def stored(thing: Any) -> Any:
    """Where Blender keeps the properties of an add-on that is not there."""
    return thing.bl_system_properties_get(do_create=True) if hasattr(thing, "bl_system_properties_get") else thing


class Humanoid(Case):
    def rename(self) -> bpy.types.Armature:
        tubes.scene()
        data = bpy.data.objects["other rig"].data
        for old, new in zip(tubes.JOINTS, STRANGE):
            data.bones[old].name = new
        return data

    def names(self) -> dict[str, str]:
        return part("humanoid").names(bpy.data.objects["other rig"])

    def mark(self, data: bpy.types.Armature) -> None:
        for name in STRANGE:
            stored(data.bones[name])["vrm_addon_extension"] = {"uuid": f"mark of {name}"}

    def test_vrm_1(self) -> None:
        data = self.rename()
        self.assertEqual(self.names(), {})
        self.mark(data)
        humans = {
            "hips": {"node": {"bone_uuid": "mark of alpha"}},
            "spine": {"node": {"bone_uuid": "mark of beta"}},
            "upper_chest": {"node": {}},
            "head": {"node": {"bone_uuid": "mark of gamma"}},
            "left_upper_arm": {"node": {"bone_uuid": "a bone that was deleted"}},
        }
        stored(data)["vrm_addon_extension"] = {"spec_version": 1, "vrm1": {"humanoid": {"human_bones": humans}}}
        self.assertEqual(self.names(), {"alpha": "hips", "beta": "spine", "gamma": "head"})
        self.assertEqual(bpy.ops.bespoke.map_joints(), {"FINISHED"})
        found = {joint.name: (joint.target, joint.reason) for joint in self.settings.joints}
        self.assertEqual(found["Hips"], ("alpha", "Name"))
        self.assertEqual(found["Head"], ("gamma", "Name"))
        self.dress()

    def test_vrm_0(self) -> None:
        data = self.rename()
        self.mark(data)
        humans = [
            {"bone": "hips", "node": {"bone_uuid": "mark of alpha"}},
            {"bone": "leftThumbProximal", "node": {"bone_name": "beta"}},
            {"bone": "head", "node": {"value": "gamma"}},
            {"bone": "jaw", "node": {}},
        ]
        stored(data)["vrm_addon_extension"] = {"spec_version": 0, "vrm0": {"humanoid": {"human_bones": humans}}}
        self.assertEqual(self.names(), {"alpha": "hips", "beta": "leftThumbMetacarpal", "gamma": "head"})

    def test_properties_of_old_add_ons(self) -> None:
        data = self.rename()
        named = {"hips": "alpha", "spine": "beta", "head": "gamma"}
        for name, bone in named.items():
            data[name] = bone
        # So few are somebody else's properties.
        self.assertEqual(self.names(), {})
        bpy.context.view_layer.objects.active = bpy.data.objects["other rig"]
        bpy.ops.object.mode_set(mode="EDIT")
        for name in ("leftUpperArm", "rightUpperArm", "leftUpperLeg", "rightUpperLeg"):
            bone = data.edit_bones.new(f"{name} bone")
            bone.tail = (0.0, 0.0, 0.1)
            data[name] = f"{name} bone"
        bpy.ops.object.mode_set(mode="OBJECT")
        found = self.names()
        self.assertEqual((found["alpha"], found["leftUpperArm bone"], len(found)), ("hips", "leftUpperArm", 7))
