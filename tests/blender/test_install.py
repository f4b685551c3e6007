"""The extension as it lies in Blender, and what it says of itself."""

from __future__ import annotations

import os
import pathlib

import bpy

import bespoke
import tubes
from case import MODULE, ROOT, Case, part


class Install(Case):
    def test_the_package_is_the_one_of_the_extension(self) -> None:
        profile = pathlib.Path(os.environ["BLENDER_USER_RESOURCES"])
        self.assertTrue(bespoke.library_path().is_relative_to(profile), bespoke.library_path())
        self.assertIn(MODULE, bpy.context.preferences.addons)
        version = [line for line in (ROOT / "Cargo.toml").read_text().splitlines() if line.startswith("version")][0]
        self.assertIn(bespoke.library_version(), version)

    def test_disabled_it_leaves_nothing(self) -> None:
        bpy.ops.preferences.addon_disable(module=MODULE)
        try:
            self.assertFalse(hasattr(bpy.types.Scene, "bespoke"))
            self.assertFalse([name for name in dir(bpy.types) if name.startswith("BESPOKE_")])
        finally:
            bpy.ops.preferences.addon_enable(module=MODULE)
        tubes.scene()
        self.dress()

    def test_each_dial_is_an_option_with_its_default_and_words(self) -> None:
        tubes.scene()
        self.assertEqual(part("dials").chosen(bpy.context.scene), {})
        options = part("texts").options()
        main = part("dials").MAIN
        self.assertEqual([options[name].default for name in main.values()], [2.0, 1.0, 0.0])
        for name, option in options.items():
            self.assertGreater(len(option.comment), 10, name)
        for dial, option in main.items():
            setattr(self.settings, dial, 0.3)
            self.assertEqual(part("dials").chosen(bpy.context.scene), {option: 0.3})
            self.settings.property_unset(dial)
        self.settings.surface_form = "PRINTED"
        self.settings.max_iterations = 7
        chosen = {"surface_form": bespoke.SurfaceForm.PRINTED, "max_iterations": 7}
        self.assertEqual(part("dials").chosen(bpy.context.scene), chosen)

    def test_preferences(self) -> None:
        tubes.scene()
        user = bpy.context.preferences.addons[MODULE].preferences
        user.threads, user.memory_limit, user.influences = 1, 1, 2
        try:
            self.refused("memory", "bespoke_status_memory_limit")
            user.memory_limit = 0
            made = self.dress()
            self.assertLessEqual(max(len(vertex.groups) for vertex in made.data.vertices), 2)
            options = part("inputs").options(bpy.context)
            self.assertEqual((options.threads, options.memory_limit), (1, None))
        finally:
            user.threads, user.memory_limit, user.influences = 0, 0, 4

    def test_what_to_do_is_known_for_every_failure(self) -> None:
        page = part("troubleshooting")
        for status in bespoke.Status:
            if status != bespoke.Status.OK:
                lines = page.section(page.anchor(status))
                self.assertGreater(len(lines), 4, status)
                self.assertTrue(any(line.startswith("1. ") for line in lines), status)
        guess = (
            "which joints of the two rigs are hips, neck is a guess: the names do not say it; look at the joint map, "
            "and say which joints correspond, as pairs"
        )
        about = page.section(page.WARNINGS, guess)
        self.assertTrue(any(about))
        self.assertNotEqual(about, page.section(page.WARNINGS, "something else"))
        self.assertEqual(bpy.ops.bespoke.help(anchor="bespoke_status_not_enclosed"), {"FINISHED"})
        with self.assertRaises(RuntimeError):
            bpy.ops.bespoke.help(anchor="no-such-section")

    def test_every_class_is_documented_and_drawn_of_what_there_is(self) -> None:
        classes = [getattr(bpy.types, name) for name in dir(bpy.types) if name.startswith("BESPOKE_")]
        self.assertGreater(len(classes), 12)
        for each in classes:
            self.assertTrue(each.__doc__, each)
