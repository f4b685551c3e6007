"""The run: progress, Esc, and what is changed meanwhile."""

from __future__ import annotations

import time
import types

import bpy
import numpy as np

import tubes
from case import MODULE, Case, part, stored


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
