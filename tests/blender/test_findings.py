"""What is refused, what is found, and which bones correspond."""

from __future__ import annotations

import bpy

import tubes
from case import Case, part


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
