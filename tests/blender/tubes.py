"""A sleeve on an arm: characters that are dressed in a fraction of a second."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

JOINTS = ("Hips", "Spine", "Head")


def points(radius: float, half: float, around: int, rings: int) -> NDArray[np.float32]:
    """Open, around the z axis."""
    k = np.arange(rings * around)
    angle = 2.0 * np.pi * (k % around) / around
    z = half * (2.0 * (k // around) / (rings - 1) - 1.0)
    return np.stack([radius * np.sin(angle), -radius * np.cos(angle), z], axis=1).astype(np.float32)


def quads(around: int, rings: int) -> list[list[int]]:
    """Of `points`."""
    return [
        [k * around + j, k * around + (j + 1) % around, (k + 1) * around + (j + 1) % around, (k + 1) * around + j]
        for k in range(rings - 1)
        for j in range(around)
    ]


def tube(name: str, radius: float, half: float, around: int, rings: int) -> bpy.types.Object:
    """An object in the scene."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points(radius, half, around, rings).tolist(), [], quads(around, rings))
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def armature(name: str, size: float) -> bpy.types.Object:
    """Three joints on the z axis."""
    thing = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    above = None
    for k, joint in enumerate(JOINTS):
        bone = thing.data.edit_bones.new(joint)
        bone.head, bone.tail = (0.0, 0.0, size * (k - 1)), (0.0, 0.0, size * (k - 0.2 if k == 2 else k))
        bone.parent, above = above, bone
    bpy.ops.object.mode_set(mode="OBJECT")
    return thing


def bind(thing: bpy.types.Object, to: bpy.types.Object) -> None:
    """Hangs a mesh on an armature; weights go over from joint to joint."""
    z = np.array([vertex.co.z for vertex in thing.data.vertices])
    size = -to.data.bones["Hips"].head_local.z
    at = np.clip(z / size + 1.0, 0.0, 2.0)
    for k, joint in enumerate(JOINTS):
        group = thing.vertex_groups.new(name=joint)
        for vertex, weight in enumerate(np.maximum(0.0, 1.0 - np.abs(at - k)).tolist()):
            if weight > 0.0:
                group.add([vertex], weight, "REPLACE")
    thing.parent = to
    thing.modifiers.new("Armature", "ARMATURE").object = to


def scene(fine: bool = False) -> None:
    """An empty file with "sleeve", "arm" and "rig", made for each other, and "other" with "other rig", chosen.

    `fine`: so many triangles that it takes many seconds.
    """
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    sleeve = tube("sleeve", 0.3, 0.55, 96 if fine else 16, 72 if fine else 9)
    arm = tube("arm", 0.2, 0.9, 14, 15)
    rig, other_rig = armature("rig", 1.0), armature("other rig", 1.1)
    other = tube("other", 0.5 if fine else 0.24, 0.9, 96 if fine else 14, 96 if fine else 15)
    bind(sleeve, rig)
    bind(arm, rig)
    bind(other, other_rig)
    sleeve.data.materials.append(bpy.data.materials.new("cloth"))
    sleeve.data.uv_layers.new(name="UVMap")
    bpy.context.view_layer.update()
    choose("sleeve")
    bpy.context.scene.bespoke.target = other_rig


def choose(*garments: str) -> None:
    """Adds garments as somebody does in the panel."""
    for name in garments:
        for thing in bpy.context.selected_objects:
            thing.select_set(False)
        bpy.data.objects[name].select_set(True)
        bpy.ops.bespoke.add_meshes(which="garments")
