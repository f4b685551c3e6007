"""What goes along with a garment: trims, badges, levels of detail."""

from __future__ import annotations

import bpy
import mathutils
import numpy as np

import tubes
from case import Case, seen, stored, triangles, weights
from direct import directly


class Followers(Case):
    def trim(self, name: str, radius: float) -> bpy.types.Object:
        """A band around the sleeve, chosen to go along."""
        band = tubes.tube(name, radius, 0.1, 24, 3)
        tubes.bind(band, bpy.data.objects["rig"])
        for thing in bpy.context.selected_objects:
            thing.select_set(False)
        band.select_set(True)
        self.assertEqual(bpy.ops.bespoke.add_meshes(which="followers"), {"FINISHED"})
        return band

    def test_it_is_where_the_package_takes_it(self) -> None:
        tubes.scene()
        band = self.trim("band", 0.305)
        band.data.materials.append(bpy.data.materials.new("gold"))
        self.assertEqual([item.object.name for item in self.settings.source_bodies], ["arm"])
        bpy.ops.ed.undo_push(message="chosen")
        made = self.dress()
        there = bpy.data.objects["band on other rig"]
        with directly(bpy.data.objects["sleeve"], "", bpy.data.objects["other"], "other rig") as session:
            session.add_follower(stored(band.data), triangles(band.data))
            session.run()
            self.same_bits(stored(there.data), session.read_follower_vertices(0))
            self.same_bits(stored(made.data), session.read_garment_vertices())
            bones, shares, _ = session.read_follower_skin_influences(0, 4)
        rows = weights(there, bpy.data.objects["other rig"])
        for slot in range(4):
            found = rows[bones[:, slot], np.arange(len(bones))]
            self.near(found, np.where(shares[:, slot] > 0, shares[:, slot], found), 1e-6)
        self.assertEqual([m.name for m in there.data.materials], ["gold"])
        self.assertEqual((there.parent, there.modifiers[0].object), (bpy.data.objects["other rig"],) * 2)
        self.near(seen(there), stored(there.data).astype(float), 1e-6)
        # Undo takes it off with the garment; dressed again it is replaced.
        bpy.ops.ed.undo()
        self.assertFalse([thing.name for thing in bpy.data.objects if "bespoke_garment" in thing])
        for _ in range(2):
            self.dress()
            self.assertEqual(len([thing for thing in bpy.data.objects if "bespoke_garment" in thing]), 2)

    def test_shape_keys_turn_along(self) -> None:
        tubes.scene()
        band = self.trim("band", 0.305)
        band.shape_key_add(name="Basis")
        out = band.shape_key_add(name="out")
        for point in out.data:
            point.co += mathutils.Vector((point.co.x, point.co.y, 0.0)).normalized() * 0.02
        # The other body lies: what was outwards is outwards there.
        rig, other = bpy.data.objects["other rig"], bpy.data.objects["other"]
        turn = mathutils.Matrix.Rotation(0.6, 4, "X")
        rig.data.transform(turn)
        other.data.transform(turn)
        self.dress()
        there = bpy.data.objects["band on other rig"]
        keys = there.data.shape_keys.key_blocks
        self.assertEqual([key.name for key in keys], ["Basis", "out"])
        basis, moved = (np.array([point.co for point in key.data]) for key in keys)
        axis = np.array(turn)[:3, 2]
        outwards = basis - (basis @ axis)[:, None] * axis
        outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
        offsets = moved - basis
        lengths = np.linalg.norm(offsets, axis=1)
        self.assertGreater(((offsets * outwards).sum(axis=1) / lengths).min(), 0.97)
        self.assertTrue(0.01 < lengths.min() and lengths.max() < 0.04, (lengths.min(), lengths.max()))

    def test_which_garment_it_follows(self) -> None:
        tubes.scene()
        coat = tubes.tube("coat", 0.36, 0.4, 16, 9)
        tubes.bind(coat, bpy.data.objects["rig"])
        tubes.choose("coat")
        self.trim("band", 0.365)
        self.dress()
        nearest = stored(bpy.data.objects["band on other rig"].data).copy()
        over = stored(bpy.data.objects["coat on other rig"].data)
        self.assertLess(np.hypot(*nearest.T[:2]).min() - np.hypot(*over.T[:2]).min(), 0.03)
        self.settings.followers[0].follows = bpy.data.objects["sleeve"]
        self.dress()
        self.assertGreater(np.abs(stored(bpy.data.objects["band on other rig"].data) - nearest).max(), 1e-4)
        self.settings.followers[0].follows = bpy.data.objects["arm"]
        self.refused("band", "arm", "no garment")

    def test_nothing_half_made_stays(self) -> None:
        tubes.scene()
        band = self.trim("band", 0.305)
        band.data.clear_geometry()
        before = {thing.name for thing in bpy.data.objects}
        self.refused("band", "no faces")
        self.assertEqual(before, {thing.name for thing in bpy.data.objects})
