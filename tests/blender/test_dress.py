"""From the scene to a garment on another body, and back."""

from __future__ import annotations

import math
import time
import types
from typing import Any

import bpy
import mathutils
import numpy as np

import bespoke
import characters
import tubes
from case import MODULE, Case, joints, part, seen, stored, triangles, weights


def directly(garment: bpy.types.Object, source: str, body: bpy.types.Object, target: str) -> bespoke.Session:
    """The same by the package, of objects that have no transforms and no modifiers but armatures."""
    objects = bpy.data.objects
    session = bespoke.Session()
    session.set_source_coordinate_system(
        bespoke.CoordinateSystem(up=bespoke.Axis.POSITIVE_Z, forward=bespoke.Axis.POSITIVE_Y, trusted=True)
    )
    session.set_target_coordinate_system(bespoke.CoordinateSystem.BLENDER)
    session.set_garment(stored(garment.data), triangles(garment.data))
    rigs = objects[f"{source} rig" if source else "rig"], objects[target]
    session.set_source_rig(joints(rigs[0]))
    session.set_target_rig(joints(rigs[1]))

    def skin(thing: bpy.types.Object, rig: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, int]:
        rows = weights(thing, rig).T
        order = np.broadcast_to(np.arange(rows.shape[1], dtype=np.uint32), rows.shape)
        return order, rows.astype(np.float32), rows.shape[1]

    own = objects[source or "arm"]
    session.set_source_avatar(stored(own.data).astype(float), triangles(own.data))
    session.set_source_skin_influences(*skin(own, rigs[0]))
    session.set_garment_skin_influences(*skin(garment, rigs[0]))
    session.set_target_avatar(stored(body.data).astype(float), triangles(body.data))
    session.set_target_skin_influences(*skin(body, rigs[1]))
    return session


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


class Running(Case):
    """Progress, Esc and undo."""

    def operator(self) -> types.SimpleNamespace:
        """What Blender calls the operator with; there are no events in a module."""
        self.said: list[tuple[str, str]] = []
        kind = part("dress").BESPOKE_OT_dress
        stub = types.SimpleNamespace(_timer=None)
        stub.report = lambda level, text: self.said.append((next(iter(level)), text))
        for name in ("_begin", "_leave", "_end", "invoke", "modal", "cancel"):
            setattr(stub, name, types.MethodType(getattr(kind, name), stub))
        return stub

    def begin(self, stub: types.SimpleNamespace) -> None:
        # Only an operator of Blender's own can be a handler.
        given = stub._begin(bpy.context)
        running = part("dress")._Running
        running.run, running.inputs = part("work").Run(given.task), given
        running.run.start()

    def event(self, kind: str, value: str = "PRESS") -> types.SimpleNamespace:
        return types.SimpleNamespace(type=kind, value=value)

    def test_esc_stops_it_and_nothing_is_changed(self) -> None:
        tubes.scene(fine=True)
        before = {thing.name for thing in bpy.data.objects}, len(bpy.data.meshes)
        stub = self.operator()
        self.begin(stub)
        run = part("dress").running()
        shares = []
        while len(shares) < 5 or shares[-1] == 0.0:
            time.sleep(0.02)
            self.assertEqual(stub.modal(bpy.context, self.event("TIMER")), {"PASS_THROUGH"})
            shares.append(run.progress()[0])
        self.assertEqual(stub.modal(bpy.context, self.event("MOUSEMOVE")), {"PASS_THROUGH"})
        self.assertFalse(bpy.ops.bespoke.dress.poll())
        self.assertEqual(stub.modal(bpy.context, self.event("ESC")), {"RUNNING_MODAL"})
        began = time.monotonic()
        self.assertTrue(run.wait(5.0))
        self.assertLess(time.monotonic() - began, 1.0)
        self.assertEqual(stub.modal(bpy.context, self.event("TIMER")), {"CANCELLED"})
        self.assertEqual(self.said, [("INFO", "stopped; nothing was changed")])
        self.assertEqual(before, ({thing.name for thing in bpy.data.objects}, len(bpy.data.meshes)))
        self.assertTrue(bpy.ops.bespoke.dress.poll())
        self.assertEqual(shares, sorted(shares))

    def test_the_button_and_another_file_stop_it_too(self) -> None:
        tubes.scene(fine=True)
        for stop in (lambda stub: bpy.ops.bespoke.stop(), lambda stub: stub.cancel(bpy.context)):
            stub = self.operator()
            self.begin(stub)
            run = part("dress").running()
            time.sleep(0.1)
            stop(stub)
            self.assertTrue(run.wait(5.0))
            stub._leave(bpy.context)
            self.assertLess(len(run.outcomes), 1)

    def test_disabled_it_has_stopped(self) -> None:
        tubes.scene(fine=True)
        self.begin(self.operator())
        run = part("dress").running()
        time.sleep(0.1)
        bpy.ops.preferences.addon_disable(module=MODULE)
        try:
            self.assertTrue(run.is_over)
            self.assertEqual(run.outcomes, [])
        finally:
            bpy.ops.preferences.addon_enable(module=MODULE)

    def test_the_thread_leaves_what_a_script_gets(self) -> None:
        tubes.scene()
        at_once = stored(self.dress().data).copy()
        bpy.data.objects.remove(bpy.context.object)
        stub = self.operator()
        self.begin(stub)
        self.assertTrue(part("dress").running().wait(60.0))
        self.assertEqual(stub.modal(bpy.context, self.event("TIMER")), {"FINISHED"})
        self.assertEqual(self.said, [("INFO", "dressed and verified: sleeve on other rig")])
        self.same_bits(stored(bpy.context.object.data), at_once)
        self.assertIsNone(part("dress").running())

    def test_what_is_changed_meanwhile_is_noticed(self) -> None:
        for change, word in (
            (lambda: bpy.data.objects["sleeve"].data.vertices[3].co.__setitem__(0, 0.31), "changed while"),
            (lambda: bpy.data.objects.remove(bpy.data.objects["sleeve"]), "deleted or undone"),
        ):
            tubes.scene()
            stub = self.operator()
            self.begin(stub)
            change()
            part("dress").running().wait(60.0)
            self.assertEqual(stub.modal(bpy.context, self.event("TIMER")), {"CANCELLED"})
            self.assertEqual(self.said[0][0], "ERROR")
            self.assertIn(word, self.said[0][1])

    def test_again_replaces_or_keeps(self) -> None:
        tubes.scene()
        self.dress()
        self.settings.looseness = 0.0
        first = stored(bpy.context.object.data).copy()
        tight = self.dress()
        self.assertEqual(tight.name, "sleeve on other rig")
        self.assertEqual(len([thing for thing in bpy.data.objects if "bespoke_garment" in thing]), 1)
        self.assertLess(np.abs(stored(tight.data)[:, :2]).max(), np.abs(first[:, :2]).max())
        self.settings.keep_results = True
        self.dress()
        self.assertEqual(len([thing for thing in bpy.data.objects if "bespoke_garment" in thing]), 2)


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

    def test_where_the_skin_passes_through_it_the_garment_is_its_own_measure(self) -> None:
        tubes.scene()
        work = part("work")
        filled = work.filled
        # The refusal of a hat through which the head goes, which tubes have not.
        refusal = bespoke.BespokeError(bespoke.Status.NOT_ENCLOSED, "beside its bones")

        def refused(task: Any, *others: Any) -> bespoke.Session:
            if task.source is not task.whole:
                raise refusal
            return filled(task, *others)

        work.filled = refused
        try:
            made = self.dress()
        finally:
            work.filled = filled
        sleeve, arm = bpy.data.objects["sleeve"], bpy.data.objects["arm"]
        with directly(sleeve, "", bpy.data.objects["other"], "other rig") as session:
            both = np.concatenate([stored(arm.data), stored(sleeve.data)]).astype(float)
            first = len(arm.data.vertices)
            session.set_source_avatar(both, np.concatenate([triangles(arm.data), triangles(sleeve.data) + first]))
            rows = np.concatenate([weights(thing, bpy.data.objects["rig"]).T for thing in (arm, sleeve)])
            order = np.broadcast_to(np.arange(3, dtype=np.uint32), rows.shape)
            session.set_source_skin_influences(order, rows.astype(np.float32), 3)
            session.run()
            self.same_bits(stored(made.data), session.read_garment_vertices())

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


class Errors(Case):
    def test_what_is_not_chosen(self) -> None:
        tubes.scene()
        self.settings.target_bodies.clear()
        self.refused("other rig", "body")
        self.settings.target = None
        self.refused("armature")
        self.settings.garments.clear()
        self.refused("no garment")
        for thing in bpy.context.selected_objects:
            thing.select_set(False)
        with self.assertRaises(RuntimeError):
            bpy.ops.bespoke.add_meshes(which="garments")

    def test_what_cannot_be_used(self) -> None:
        tubes.scene()
        self.settings.dhat = 0.5
        self.refused("dhat", "bespoke_status_invalid_argument")
        self.settings.property_unset("dhat")
        bpy.data.objects["sleeve"].data.clear_geometry()
        self.refused("sleeve", "no faces")
        tubes.scene()
        bpy.data.objects["other rig"].scale = (0.0, 0.0, 0.0)
        self.refused("other rig", "scale")

    def test_a_garment_beside_its_body(self) -> None:
        tubes.scene()
        sleeve = bpy.data.objects["sleeve"]
        sleeve.location.x = 4.0
        before = {thing.name for thing in bpy.data.objects}
        self.refused("sleeve", "docs/troubleshooting.md#bespoke_status_not_enclosed")
        self.assertEqual(before, {thing.name for thing in bpy.data.objects})
        first = self.settings.findings[0]
        self.assertEqual((first.severity, first.kind, first.garment), ("ERROR", "NOT_ENCLOSED", "sleeve"))
        self.assertEqual(first.anchor, "bespoke_status_not_enclosed")
        # One that fails keeps no other from being dressed.
        coat = tubes.tube("coat", 0.36, 0.4, 16, 9)
        tubes.bind(coat, bpy.data.objects["rig"])
        tubes.choose("coat")
        self.refused("sleeve")
        self.assertIn("coat on other rig", bpy.data.objects)

    def test_nothing_half_made_stays(self) -> None:
        tubes.scene()
        results = part("results")
        before = {thing.name for thing in bpy.data.objects}, {mesh.name for mesh in bpy.data.meshes}
        place = results._place
        results._place = lambda *_: 1 / 0
        try:
            self.refused("ZeroDivisionError")
        finally:
            results._place = place
        self.assertEqual(before, ({thing.name for thing in bpy.data.objects}, {mesh.name for mesh in bpy.data.meshes}))
        self.dress()


class Findings(Case):
    def test_they_select_vertices(self) -> None:
        tubes.scene()
        sleeve = bpy.data.objects["sleeve"]
        # A vertex through the cloth opposite.
        sleeve.data.vertices[68].co.x, sleeve.data.vertices[68].co.y = -0.5, 0.02
        made = self.dress()
        kinds = [finding.kind for finding in self.settings.findings]
        self.assertIn("SELF_INTERSECTION", kinds)
        self.settings.finding_index = kinds.index("SELF_INTERSECTION")
        finding = self.settings.findings[self.settings.finding_index]
        self.assertGreater(finding.count, 1)
        self.assertEqual([place.object for place in finding.places], [made])
        self.assertEqual(bpy.ops.bespoke.select_finding(), {"FINISHED"})
        self.assertEqual((bpy.context.object, bpy.context.mode), (made, "EDIT_MESH"))
        bpy.ops.object.mode_set(mode="OBJECT")
        chosen = [vertex.index for vertex in made.data.vertices if vertex.select]
        self.assertEqual(chosen, list(finding.places[0]["vertices"]))
        self.assertIn(68, chosen)
        self.assertLess(len(chosen), len(made.data.vertices))
        # Of what is gone nothing can be selected.
        bpy.data.objects.remove(made)
        with self.assertRaises(RuntimeError):
            bpy.ops.bespoke.select_finding()


class Joints(Case):
    def test_seen_and_mended(self) -> None:
        tubes.scene()
        self.assertEqual(bpy.ops.bespoke.map_joints(), {"FINISHED"})
        found = {joint.name: joint for joint in self.settings.joints}
        self.assertEqual({name: joint.target for name, joint in found.items()}, {name: name for name in tubes.JOINTS})
        self.assertFalse(any(joint.is_mended for joint in self.settings.joints))
        self.assertTrue(all(joint.reason_comment for joint in self.settings.joints))
        self.settings.joints[1].target = ""
        self.assertEqual(part("inputs").gather(bpy.context).task.pairs, [(1, -1)])
        bpy.ops.bespoke.map_joints()
        self.assertEqual((self.settings.joints[1].target, self.settings.joints[1].reason), ("", "Caller"))
        self.assertTrue(self.settings.joints[1].is_mended)
        self.settings.joints[1].target = "Nobody"
        self.refused("other rig", "'Nobody'", "'Spine'")
        bpy.ops.bespoke.forget_joints()
        bpy.ops.bespoke.map_joints()
        self.assertEqual(self.settings.joints[1].target, "Spine")
