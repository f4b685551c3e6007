"""What artists have on their garments: shape keys, modifiers, groups, layers, bones."""

from __future__ import annotations

import math

import bpy
import mathutils
import numpy as np

import bespoke
import tubes
from case import Case, part, seen, stored, triangles
from direct import directly


class Garments(Case):
    """What artists have on their garments."""

    def test_same_bits_and_wherever_they_stand(self) -> None:
        tubes.scene()
        plain = stored(self.dress().data).copy()
        with directly(bpy.data.objects["sleeve"], "", bpy.data.objects["other"], "other rig") as session:
            session.run()
            self.same_bits(plain, session.read_garment_vertices())
        # As FBX comes in: in centimetres, y up, under an armature that is turned and scaled; and away from the middle.
        rig = bpy.data.objects["other rig"]
        axes = mathutils.Matrix.Rotation(math.pi / 2, 4, "X") @ mathutils.Matrix.Scale(0.01, 4)
        rig.data.transform(axes.inverted())
        bpy.data.objects["other"].data.transform(axes.inverted())
        rig.matrix_world = mathutils.Matrix.Translation((30.0, -7.0, 2.0)) @ axes
        made = self.dress()
        self.near(seen(made) - [30.0, -7.0, 2.0], plain.astype(float), 2e-3)
        self.near(stored(made.data), plain, 2e-3)
        rig.location.x += 5.0
        self.near(seen(made) - [35.0, -7.0, 2.0], plain.astype(float), 2e-3)

    def test_shape_keys_come_along(self) -> None:
        tubes.scene()
        sleeve = bpy.data.objects["sleeve"]
        sleeve.shape_key_add(name="Basis")
        wide, wider = sleeve.shape_key_add(name="wide"), sleeve.shape_key_add(name="wider")
        wider.relative_key = wide
        for k, point in enumerate(sleeve.data.vertices):
            out = mathutils.Vector((point.co.x, point.co.y, 0.0)) * 0.1
            wide.data[k].co, wider.data[k].co = point.co + out, point.co + 2 * out
        wide.value = 0.5
        made = self.dress()
        keys = made.data.shape_keys.key_blocks
        self.assertEqual([key.name for key in keys], ["Basis", "wide", "wider"])
        self.assertEqual((keys["wide"].value, keys["wider"].relative_key), (0.5, keys["wide"]))
        shape = {key.name: np.array([point.co for point in key.data]) for key in keys}
        self.near(shape["Basis"], stored(made.data), 1e-7)
        with directly(sleeve, "", bpy.data.objects["other"], "other rig") as session:
            for key in sleeve.data.shape_keys.key_blocks[1:]:
                to, of = ([p.co for p in k.data] for k in (key, key.relative_key))
                session.add_garment_morph(np.array(to) - np.array(of), key.name)
            session.run()
            self.near(shape["Basis"], session.read_garment_vertices(), 1e-7)
            self.near(shape["wide"] - shape["Basis"], session.read_garment_morph(0), 1e-6)
            self.near(shape["wider"] - shape["wide"], session.read_garment_morph(1), 1e-6)
        self.assertGreater(np.abs(shape["wide"] - shape["Basis"]).max(), 0.02)

    def test_modifiers(self) -> None:
        tubes.scene()
        sleeve, other = bpy.data.objects["sleeve"], bpy.data.objects["other"]
        sleeve.modifiers.new("Fine", "SUBSURF").levels = 1
        cloth = sleeve.modifiers.new("Cloth", "CLOTH")
        other.shape_key_add(name="Basis")
        heavy = other.shape_key_add(name="heavy")
        for point in heavy.data:
            point.co.x, point.co.y = 1.3 * point.co.x, 1.3 * point.co.y
        # What a new one has is not the same in all versions.
        heavy.value = 0.0
        thin = stored(self.dress().data)
        made = bpy.context.object
        # What shapes is in the mesh now; what simulates comes along.
        self.assertGreater(len(made.data.vertices), 3 * len(sleeve.data.vertices))
        self.assertEqual([m.type for m in made.modifiers], ["ARMATURE", cloth.type])
        self.assertEqual([m.type for m in sleeve.modifiers], ["ARMATURE", "SUBSURF", "CLOTH"])
        self.assertTrue(all(m.show_viewport for m in sleeve.modifiers))
        self.assertEqual(len(made.data.uv_layers), 1)
        # The body is dressed in the shape that it has.
        heavy.value = 1.0
        thick = stored(self.dress().data)
        self.assertGreater(np.hypot(thick[:, 0], thick[:, 1]).min(), 1.1 * np.hypot(thin[:, 0], thin[:, 1]).min())

    def test_vertex_groups_say_how(self) -> None:
        tubes.scene()
        sleeve = bpy.data.objects["sleeve"]
        plain = stored(self.dress().data).copy()
        fit, pins, rigid = (sleeve.vertex_groups.new(name=name) for name in ("loose", "held", "plate"))
        fit.add(list(range(48)), 1.0, "REPLACE")
        pins.add([0, 1], 1.0, "REPLACE")
        rigid.add([64, 65, 80, 81, 72, 73, 88, 89], 1.0, "REPLACE")
        self.settings.garments[0].fit_group = "loose"
        changed = self.dress()
        self.assertGreater(np.abs(stored(changed.data) - plain).max(), 0.003)
        # They are no bones, and stay.
        self.assertLessEqual({"loose", "held", "plate"}, {group.name for group in changed.vertex_groups})
        self.settings.garments[0].fit_group, self.settings.garments[0].pin_group = "", "held"
        self.settings.garments[0].rigid_group = "plate"
        garment = part("inputs").gather(bpy.context).task.garments[0]
        self.assertEqual(garment.pins.tolist(), [0, 1])
        pieces = [group.tolist() for group in garment.rigid_groups]
        self.assertEqual(sorted(pieces), [[64, 65, 80, 81], [72, 73, 88, 89]])
        held = stored(self.dress().data)

        def sizes(points: np.ndarray) -> np.ndarray:
            plate = points[[64, 65, 80, 81]]
            return np.linalg.norm(plate[:, None] - plate[None], axis=2)

        ratio = sizes(held)[0, 1:] / sizes(stored(sleeve.data))[0, 1:]
        self.assertLess(ratio.max() - ratio.min(), 1e-3)
        self.settings.garments[0].pin_group = "nothing"
        self.refused("sleeve", "'nothing'")

    def test_one_over_the_other(self) -> None:
        tubes.scene()
        coat = tubes.tube("coat", 0.36, 0.4, 16, 9)
        tubes.bind(coat, bpy.data.objects["rig"])
        tubes.choose("coat")
        self.assertEqual([item.object.name for item in self.settings.garments], ["sleeve", "coat"])
        bpy.ops.bespoke.move_mesh(down=False)
        self.assertEqual([item.object.name for item in self.settings.garments], ["coat", "sleeve"])
        bpy.ops.bespoke.move_mesh(down=True)
        self.dress()
        inner, outer = (bpy.data.objects[f"{name} on other rig"] for name in ("sleeve", "coat"))
        with directly(coat, "", bpy.data.objects["other"], "other rig") as session:
            session.add_layer(stored(inner.data), triangles(inner.data))
            session.run()
            self.same_bits(stored(outer.data), session.read_garment_vertices())
            self.assertEqual(session.verify().garment_avatar, 0)

    def test_over_what_was_dressed_before(self) -> None:
        tubes.scene()
        self.dress()
        inner = bpy.data.objects["sleeve on other rig"]
        coat = tubes.tube("coat", 0.36, 0.4, 16, 9)
        tubes.bind(coat, bpy.data.objects["rig"])
        self.settings.garments.clear()
        tubes.choose("coat")
        self.settings.target_bodies.add().object = inner
        outer = self.dress()
        with directly(coat, "", bpy.data.objects["other"], "other rig") as session:
            session.add_layer(stored(inner.data), triangles(inner.data))
            session.run()
            self.same_bits(stored(outer.data), session.read_garment_vertices())

    def test_covered_skin_is_masked(self) -> None:
        tubes.scene()
        other = bpy.data.objects["other"]
        self.settings.mask_covered, self.settings.looseness = True, 0.0
        for _ in range(2):
            made = self.dress()
        with directly(bpy.data.objects["sleeve"], "", other, "other rig") as session:
            session.set_options(designed_clearance=0.0)
            session.run()
            covered = np.zeros(len(triangles(other.data)), bool)
            covered[session.read_covered_triangles()] = True
        self.assertTrue(covered.any())
        there = triangles(other.data)
        expected = set(there[covered].ravel().tolist()) - set(there[~covered].ravel().tolist())
        group = other.vertex_groups["Bespoke Covered"].index
        found = {v.index for v in other.data.vertices if any(g.group == group and g.weight == 1.0 for g in v.groups)}
        self.assertEqual(found, expected)
        self.assertEqual([m.type for m in other.modifiers], ["ARMATURE", "MASK"])
        self.assertEqual(len(seen(other)), len(other.data.vertices) - len(expected))
        # It is skin all the same: what is masked is dressed next time.
        self.assertEqual(made.name, "sleeve on other rig")

    def test_bones_of_its_own(self) -> None:
        for brings in (True, False):
            tubes.scene()
            rig, sleeve = bpy.data.objects["rig"], bpy.data.objects["sleeve"]
            bpy.context.view_layer.objects.active = rig
            bpy.ops.object.mode_set(mode="EDIT")
            tail = rig.data.edit_bones.new("skirt")
            tail.head, tail.tail = (0.0, -0.3, -0.3), (0.0, -0.3, -0.5)
            tail.parent = rig.data.edit_bones["Hips"]
            bpy.ops.object.mode_set(mode="OBJECT")
            below = [v.index for v in sleeve.data.vertices if v.co.z < -0.35]
            for group in sleeve.vertex_groups:
                group.remove(below)
            sleeve.vertex_groups.new(name="skirt").add(below, 1.0, "REPLACE")
            self.settings.add_bones = brings
            made = self.dress()
            bones = bpy.data.objects["other rig"].data.bones
            self.assertEqual("skirt" in bones, brings)
            self.assertEqual("skirt" in made.vertex_groups, brings)
            if brings:
                self.assertEqual(bones["skirt"].parent.name, "Hips")
                rest = seen(made)
                pose = bpy.data.objects["other rig"].pose.bones["skirt"]
                pose.location.x = 0.25
                self.assertGreater(np.linalg.norm((seen(made) - rest)[below], axis=1).min(), 0.1)
                self.dress()
                self.assertEqual(len(bones), 4)
