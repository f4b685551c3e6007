"""Which bone is which in a VRM character, as the VRM add-on keeps it in the armature. The add-on need not be there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

import bpy

# The group of its properties, on armatures and on bones.
_GROUP = "vrm_addon_extension"
# VRM 0 calls two bones of the thumb otherwise.
_OF_ZERO = {"ThumbProximal": "ThumbMetacarpal", "ThumbIntermediate": "ThumbProximal"}
# Add-ons before 2.0 kept each bone in a property of its own: names that every humanoid has.
_NEEDED = ("hips", "spine", "head", "leftUpperArm", "rightUpperArm", "leftUpperLeg", "rightUpperLeg")


def names(armature: bpy.types.Object) -> dict[str, str]:
    """The name in VRM 1, such as `leftUpperArm`, of each bone that has one; empty: the armature is no VRM character."""
    kept = _kept(armature.data)
    bones = armature.data.bones
    of_mark = {str(mark): bone.name for bone in bones if (mark := _kept(bone).get("uuid"))}
    one, zero = dict(_of_one(kept, of_mark)), dict(_of_zero(kept, of_mark))
    found = (zero or one) if kept.get("spec_version", 1) == 0 else (one or zero)
    if not found:
        found = dict(_of_properties(armature.data))
    return {bone: name for bone, name in found.items() if bone in bones}


def _kept(thing: bpy.types.Armature | bpy.types.Bone) -> Mapping[str, Any]:
    """The properties of the add-on as they are stored. From Blender 5.0 on those of add-ons are apart from a user's."""
    stored = thing.bl_system_properties_get() if hasattr(thing, "bl_system_properties_get") else thing
    group = stored.get(_GROUP) if stored is not None else None
    return group if hasattr(group, "keys") else {}


def _below(group: Any, *path: str) -> Any:
    for name in path:
        group = group.get(name) if hasattr(group, "keys") else None
    return group


def _bone(human: Any, of_mark: Mapping[str, str]) -> str | None:
    node = _below(human, "node")
    return of_mark.get(str(_below(node, "bone_uuid"))) or _below(node, "bone_name") or _below(node, "value")


def _of_one(kept: Mapping[str, Any], of_mark: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    humans = _below(kept, "vrm1", "humanoid", "human_bones")
    for name in humans.keys() if hasattr(humans, "keys") else ():
        if bone := _bone(humans[name], of_mark):
            yield bone, re.sub(r"_(\w)", lambda letter: letter[1].upper(), name)


def _of_zero(kept: Mapping[str, Any], of_mark: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    for human in _below(kept, "vrm0", "humanoid", "human_bones") or ():
        name = _below(human, "bone")
        if name and (bone := _bone(human, of_mark)):
            yield bone, _as_one(str(name))


def _of_properties(data: bpy.types.Armature) -> Iterator[tuple[str, str]]:
    said = {name: bone for name, bone in data.items() if isinstance(bone, str) and bone in data.bones}
    if all(name in said for name in _NEEDED):
        for name, bone in said.items():
            yield bone, _as_one(name)


def _as_one(name: str) -> str:
    """A name of VRM 0 in VRM 1."""
    for old, new in _OF_ZERO.items():
        if name.endswith(old):
            return name.removesuffix(old) + new
    return name
