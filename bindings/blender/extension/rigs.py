"""From armatures to rigs, and from vertex groups to skin weights."""

from __future__ import annotations

from collections.abc import Sequence

import bespoke
import bpy
import mathutils
import numpy as np

from . import humanoid
from .meshes import Array, Mesh, SceneError, rest_matrix


# How Rigify begins the names of bones that move the body, and of those that it was made of.
_DEFORMS, _ORIGINAL = "DEF-", "ORG-"


def frame(armature: bpy.types.Object) -> mathutils.Matrix:
    """From the world to the space in which a character is handed over: the world's axes and unit, around its armature,
    so that numbers stay small wherever it stands."""
    return mathutils.Matrix.Translation(-armature.matrix_world.translation)


def joints(armature: bpy.types.Object) -> list[bespoke.Joint]:
    """All bones in the rest pose, in the order of the armature, named as in VRM where that is known."""
    if armature.mode == "EDIT":
        armature.update_from_editmode()
    bones = armature.data.bones
    if not bones:
        raise SceneError(f"{armature.name}: the armature has no bones")
    place = frame(armature) @ rest_matrix(armature)
    if abs(place.determinant()) < 1e-12:
        raise SceneError(f"{armature.name}: the armature is scaled to nothing; give it a scale")
    number = {bone.name: k for k, bone in enumerate(bones)}
    called = humanoid.names(armature)
    parents = _parents(bones)
    return [
        bespoke.Joint(
            called.get(bone.name, bone.name),
            number[parents[bone.name].name] if parents[bone.name] is not None else None,
            np.array(place @ bone.matrix_local, np.float64),
        )
        for bone in bones
    ]


def _parents(bones: bpy.types.ArmatureBones) -> dict[str, bpy.types.Bone | None]:
    """What each bone hangs on. In rigs that Rigify makes, bones that move the body hang on such that move bones, and so
    shoulders on no bone of the trunk that moves the body: the one that does so in the place of that counts."""
    found = {bone.name: bone.parent for bone in bones}
    for bone in bones:
        if bone.name.startswith(_DEFORMS):
            found[bone.name] = _above(bones, bone) or bone.parent
    for name in found:
        seen = set()
        while name is not None and name not in seen:
            seen.add(name)
            name = found[name].name if found[name] is not None else None
        if name is not None:
            # In a circle: somebody else's names.
            return {bone.name: bone.parent for bone in bones}
    return found


def _above(bones: bpy.types.ArmatureBones, bone: bpy.types.Bone) -> bpy.types.Bone | None:
    above = bone.parent
    while above is not None and not above.use_deform:
        instead = bones.get(_DEFORMS + above.name.removeprefix(_ORIGINAL))
        if instead is not None and instead != bone:
            return instead
        above = above.parent
    return above


def influences(meshes: Sequence[Mesh], armature: bpy.types.Object) -> tuple[Array, Array] | None:
    """Joints and weights of all vertices, mesh after mesh, each of shape (n, influences); None: none is on a bone."""
    number = {bone.name: k for k, bone in enumerate(armature.data.bones)}
    rows: list[list[tuple[int, float]]] = []
    for mesh in meshes:
        bone = mesh.object.parent_bone if mesh.object.parent_type == "BONE" else None
        if bone in number and mesh.object.parent == armature:
            rows.extend([[(number[bone], 1.0)]] * len(mesh.vertices))
            continue
        of_group = {group.index: number.get(group.name) for group in mesh.object.vertex_groups}
        for groups in mesh.groups:
            rows.append([(of_group[g], weight) for g, weight in groups if of_group.get(g) is not None])
    most = max((len(row) for row in rows), default=0)
    if most == 0:
        return None
    bones, weights = np.zeros((len(rows), most), np.uint32), np.zeros((len(rows), most), np.float32)
    for vertex, row in enumerate(rows):
        for k, (joint, weight) in enumerate(row):
            bones[vertex, k], weights[vertex, k] = joint, weight
    return bones, weights
