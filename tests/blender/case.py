"""What the tests share."""

from __future__ import annotations

import importlib
import pathlib
import types
import unittest
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

import bespoke

MODULE = "bl_ext.user_default.bespoke"
ROOT = pathlib.Path(__file__).resolve().parents[2]


def part(name: str) -> types.ModuleType:
    """A module of the extension as Blender has it."""
    return importlib.import_module(f"{MODULE}.{name}")


def stored(mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    """Vertices as they are in the file."""
    numbers = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", numbers)
    return numbers.reshape(-1, 3)


def seen(thing: bpy.types.Object) -> NDArray[np.float64]:
    """Vertices in the world, posed."""
    bpy.context.view_layer.update()
    there = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    matrix = np.array(there.matrix_world)
    return stored(there.data).astype(float) @ matrix[:3, :3].T + matrix[:3, 3]


def joints(armature: bpy.types.Object) -> list[bespoke.Joint]:
    """A rig, for who calls the package without the extension."""
    bones = list(armature.data.bones)
    world = np.array(armature.matrix_world)
    return [
        bespoke.Joint(bone.name, bones.index(bone.parent) if bone.parent else None, world @ np.array(bone.matrix_local))
        for bone in bones
    ]


def weights(thing: bpy.types.Object, armature: bpy.types.Object) -> NDArray[np.float64]:
    """A row a bone, a column a vertex."""
    names = [bone.name for bone in armature.data.bones]
    rows = np.zeros((len(names), len(thing.data.vertices)))
    for vertex in thing.data.vertices:
        for group in vertex.groups:
            name = thing.vertex_groups[group.group].name
            if name in names:
                rows[names.index(name), vertex.index] += group.weight
    return rows


def triangles(mesh: bpy.types.Mesh) -> NDArray[np.uint32]:
    """As Blender cuts the polygons."""
    mesh.calc_loop_triangles()
    return np.array([triangle.vertices[:] for triangle in mesh.loop_triangles], np.uint32)


class Case(unittest.TestCase):
    @property
    def settings(self) -> Any:
        return bpy.context.scene.bespoke

    def dress(self) -> bpy.types.Object:
        """Presses the button, in the way of a script. The last garment on the body."""
        self.assertEqual(bpy.ops.bespoke.dress("EXEC_DEFAULT", True), {"FINISHED"})
        return bpy.context.object

    def refused(self, *words: str) -> str:
        """The button says so."""
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.bespoke.dress("EXEC_DEFAULT", True)
        for word in words:
            self.assertIn(word, str(caught.exception))
        return str(caught.exception)

    def same_bits(self, one: NDArray[Any], other: NDArray[Any]) -> None:
        self.assertEqual((one.dtype, one.shape), (other.dtype, other.shape))
        self.assertEqual(one.tobytes(), other.tobytes())

    def near(self, one: NDArray[Any], other: NDArray[Any], tolerance: float) -> None:
        self.assertEqual(one.shape, other.shape)
        self.assertLess(np.abs(one - other).max(), tolerance)
