"""Shape keys of the body that is dressed, which garments follow."""

from __future__ import annotations

import bpy
import mathutils
import numpy as np

import tubes
from case import Case, part, seen, stored, triangles
from direct import directly


def heavy(thing: bpy.types.Object, by: float, name: str = "heavy") -> bpy.types.ShapeKey:
    """A shape key that is wider all around the middle."""
    if thing.data.shape_keys is None:
        thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name=name)
    key.value = 0.0
    for point in key.data:
        share = by * np.exp(-((point.co.z / 0.3) ** 2))
        point.co.x, point.co.y = (1.0 + share) * point.co.x, (1.0 + share) * point.co.y
    return key


def shape(key: bpy.types.ShapeKey) -> np.ndarray:
    return np.array([point.co for point in key.data])


class ShapeKeys(Case):
    def offsets(self, key: bpy.types.ShapeKey) -> np.ndarray:
        return shape(key) - shape(key.relative_key)

    def test_the_garment_follows_the_body(self) -> None:
        tubes.scene()
        other = bpy.data.objects["other"]
        key, slim = heavy(other, 0.4), heavy(other, -0.1, "slim")
        slim.value = 0.5
        plain = stored(self.dress().data).copy()
        # The value that it has now makes no difference to the garment without it.
        key.value = 0.75
        self.assertEqual(bpy.ops.bespoke.follow_key(key="heavy"), {"FINISHED"})
        made = self.dress()
        self.same_bits(stored(made.data), plain)
        keys = made.data.shape_keys.key_blocks
        self.assertEqual([one.name for one in keys], ["Basis", "heavy"])
        with directly(bpy.data.objects["sleeve"], "", other, "other rig") as session:
            body = shape(other.data.shape_keys.reference_key)
            body = body + 0.5 * self.offsets(slim)
            session.set_target_avatar(body, triangles(other.data))
            session.add_target_morph(self.offsets(key), "heavy")
            session.run()
            session.solve_target_morphs()
            self.near(self.offsets(keys["heavy"]), session.read_target_morph(0).astype(float), 2e-3)
        # It goes with the body, and nothing is through another there.
        for value in (0.0, 1.0):
            key.value = value
            worn, below = seen(made), seen(other)
            self.assertAlmostEqual(keys["heavy"].value, value, 5)
            middle = np.abs(worn[:, 2]) < 0.4
            widest = np.hypot(*below[np.abs(below[:, 2]) < 0.05].T[:2]).max()
            self.assertGreater(np.hypot(*worn[middle & (np.abs(worn[:, 2]) < 0.05)].T[:2]).min(), widest)

    def test_progress_goes_on_while_it_finds_them(self) -> None:
        tubes.scene()
        heavy(bpy.data.objects["other"], 0.4)
        self.settings.followed_keys.add().name = "heavy"
        task = part("inputs").gather(bpy.context).task
        run = part("work").Run(task)
        run.start()
        shares = [0.0]
        while not run.wait(0.001):
            shares.append(run.progress()[0])
        self.assertIsNone(run.defect)
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(any(0.5 < share < 1.0 for share in shares), shares[-5:])
        self.assertEqual([name for name, _ in run.outcomes[0].answers], ["heavy"])

    def test_modifiers_drivers_and_keys_of_one_mesh_of_two(self) -> None:
        tubes.scene()
        other = bpy.data.objects["other"]
        key = heavy(other, 0.4)
        other.modifiers.new("Fine", "SUBSURF").levels = 1
        # Something else moves the key now, and it is muted.
        key.driver_add("value").driver.expression = "0.6"
        key.mute = True
        far = tubes.tube("far", 0.05, 0.1, 8, 3)
        tubes.bind(far, bpy.data.objects["other rig"])
        far.data.transform(mathutils.Matrix.Translation((0.0, 0.0, 1.5)))
        self.settings.target_bodies.add().object = far
        self.settings.followed_keys.add().name = "heavy"
        before = {thing.name for thing in bpy.data.objects}, len(bpy.data.meshes)
        task = part("inputs").gather(bpy.context).task
        self.assertEqual(before, ({thing.name for thing in bpy.data.objects}, len(bpy.data.meshes)))
        ((name, offsets),) = task.target_morphs
        self.assertEqual((name, len(offsets)), ("heavy", len(task.target.vertices)))
        self.assertGreater(np.linalg.norm(offsets[: -len(far.data.vertices)], axis=1).max(), 0.05)
        self.assertEqual(np.abs(offsets[-len(far.data.vertices) :]).max(), 0.0)
        made = self.dress()
        self.assertIn("heavy", made.data.shape_keys.key_blocks)
        self.assertTrue(key.mute and key.id_data.animation_data.drivers)

    def test_one_of_its_own_of_the_same_name(self) -> None:
        tubes.scene()
        sleeve = bpy.data.objects["sleeve"]
        heavy(sleeve, -0.1)
        heavy(sleeve, 0.05, "puffed")
        heavy(bpy.data.objects["other"], 0.4)
        self.settings.followed_keys.add().name = "heavy"
        made = self.dress()
        keys = made.data.shape_keys.key_blocks
        self.assertEqual([one.name for one in keys], ["Basis", "heavy", "puffed"])
        outwards = (self.offsets(keys["heavy"]) * shape(keys["Basis"]))[:, :2].sum(axis=1)
        self.assertGreater(outwards.max(), 0.01)

    def test_what_is_not_there(self) -> None:
        tubes.scene()
        heavy(bpy.data.objects["other"], 0.4)
        self.settings.followed_keys.add().name = "lean"
        self.refused("'lean'", "take it off the list")
        self.assertEqual(bpy.ops.bespoke.ignore_key(index=0), {"FINISHED"})
        self.assertEqual(len(self.settings.followed_keys), 0)
        # Without an answer the garment is there all the same, and the reason is said.
        heavy(bpy.data.objects["other"], 1e4, "vast")
        self.settings.followed_keys.add().name = "vast"
        made = self.dress()
        self.assertIsNone(made.data.shape_keys)
        said = [finding.message for finding in self.settings.findings if "vast" in finding.message]
        self.assertTrue(said, [finding.message for finding in self.settings.findings])

    def test_another_body(self) -> None:
        """What was chosen for one armature does not stay for the next."""
        tubes.scene()
        heavy(bpy.data.objects["other"], 0.4)
        self.settings.followed_keys.add().name = "heavy"
        third_rig = tubes.armature("third rig", 1.0)
        third = tubes.tube("third", 0.22, 0.9, 14, 15)
        tubes.bind(third, third_rig)
        self.settings.target = third_rig
        self.assertEqual([item.object.name for item in self.settings.target_bodies], ["third"])
        self.assertEqual(len(self.settings.followed_keys), 0)
