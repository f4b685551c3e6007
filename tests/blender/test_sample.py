"""The jacket of `make demo` on the heavy body: what comes out, and undo."""

from __future__ import annotations

import time

import bpy
import mathutils
import numpy as np

import characters
from case import Case, seen, stored, weights
from direct import directly


class Sample(Case):
    """The jacket of `make demo` on the heavy body."""

    @classmethod
    def setUpClass(cls) -> None:
        characters.empty()
        characters.fill()
        characters.choose()
        bpy.ops.ed.undo_push(message="chosen")
        cls.objects = {thing.name for thing in bpy.data.objects}
        cls.began = time.monotonic()
        assert bpy.ops.bespoke.dress("EXEC_DEFAULT", True) == {"FINISHED"}

    def test_what_is_chosen(self) -> None:
        self.assertEqual([item.object.name for item in self.settings.garments], ["jacket"])
        self.assertEqual(self.settings.source.name, "mannequin rig")
        self.assertEqual([item.object.name for item in self.settings.source_bodies], ["mannequin"])
        self.assertEqual([item.object.name for item in self.settings.target_bodies], ["heavy"])

    def test_same_bits_as_the_package(self) -> None:
        jacket, made = bpy.data.objects["jacket"], bpy.data.objects["jacket on heavy rig"]
        with directly(jacket, "mannequin", bpy.data.objects["heavy"], "heavy rig") as session:
            session.run()
            self.same_bits(stored(made.data), session.read_garment_vertices())
            self.assertEqual(session.verify().garment_avatar, 0)
            bones, shares, _ = session.read_garment_skin_influences(4)
        self.assertEqual(made.matrix_world, mathutils.Matrix.Identity(4))
        rows = weights(made, bpy.data.objects["heavy rig"])
        for slot in range(4):
            found = rows[bones[:, slot], np.arange(len(bones))]
            self.near(found, np.where(shares[:, slot] > 0, shares[:, slot], found), 1e-6)
        self.near(rows.sum(axis=0), np.ones(rows.shape[1]), 1e-5)

    def test_what_belongs_to_the_garment_is_kept(self) -> None:
        jacket, made = bpy.data.objects["jacket"], bpy.data.objects["jacket on heavy rig"]
        self.assertIsNot(jacket.data, made.data)
        self.assertEqual(
            [list(p.vertices) for p in jacket.data.polygons], [list(p.vertices) for p in made.data.polygons]
        )
        self.assertEqual([m.name for m in jacket.data.materials], [m.name for m in made.data.materials])
        for layer in jacket.data.uv_layers:
            there = made.data.uv_layers[layer.name].uv
            self.assertEqual([tuple(uv.vector) for uv in layer.uv], [tuple(uv.vector) for uv in there])
        seams = [edge.use_seam for edge in jacket.data.edges]
        self.assertTrue(any(seams))
        self.assertEqual(seams, [edge.use_seam for edge in made.data.edges])
        self.assertEqual([m.type for m in made.modifiers], ["ARMATURE"])
        self.assertEqual(made.modifiers[0].object, bpy.data.objects["heavy rig"])
        self.assertTrue(made.select_get() and bpy.context.object == made)
        names = {bone.name for bone in bpy.data.objects["heavy rig"].data.bones}
        self.assertLessEqual({group.name for group in made.vertex_groups}, names)

    def test_it_follows_the_armature(self) -> None:
        made, rig = bpy.data.objects["jacket on heavy rig"], bpy.data.objects["heavy rig"]
        rest = seen(made)
        pose = rig.pose.bones["mixamorig:LeftArm"]
        pose.rotation_mode, pose.rotation_euler = "XYZ", (0.5, 0.2, 0.4)
        try:
            posed = seen(made)
            rows = weights(made, rig)
            moves = [np.array(bone.matrix @ bone.bone.matrix_local.inverted()) for bone in rig.pose.bones]
            own = np.zeros_like(rest)
            for move, row in zip(moves, rows / rows.sum(axis=0)):
                own += row[:, None] * (rest @ move[:3, :3].T + move[:3, 3])
            self.near(posed, own, 1e-5)
            self.assertGreater(np.abs(posed - rest).max(), 0.05)
        finally:
            pose.rotation_euler = (0.0, 0.0, 0.0)

    def test_undo_and_redo(self) -> None:
        before = stored(bpy.data.objects["jacket on heavy rig"].data).copy()
        bpy.ops.ed.undo()
        self.assertEqual({thing.name for thing in bpy.data.objects}, self.objects)
        self.assertEqual(len(bpy.context.scene.bespoke.findings), 0)
        bpy.ops.ed.redo()
        self.same_bits(stored(bpy.data.objects["jacket on heavy rig"].data), before)
