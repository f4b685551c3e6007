"""The script for the editor's Python, over a module that stands for the editor's; and its calls against PyPI's unreal-stub."""

from __future__ import annotations

import ast
import inspect
import os
import pathlib
import re
import sys
import unittest

import numpy as np

import bespoke
import bespoke_unreal
import unreal

SCRIPT = pathlib.Path(bespoke_unreal.__file__)


def expected(name: str, kind: type) -> np.ndarray:
    return np.fromfile(unreal.FOLDER / name, kind)


class Dressing(unittest.TestCase):
    def setUp(self) -> None:
        unreal.made.clear()
        unreal.lines.clear()
        unreal.state["looks_until_cancel"] = None
        unreal.state["morphs"] = []

    def dress(self, garments: tuple[str, ...] = ("/Game/garment",), **arguments: object) -> list[str]:
        return bespoke_unreal.dress(list(garments), "/Game/source", "/Game/target", **arguments)

    def test_the_same_vest_as_in_rust(self) -> None:
        self.assertEqual(self.dress(), ["/Game/Bespoke/garment_on_target"])
        asset = unreal.made["/Game/Bespoke/garment_on_target"]
        self.assertIs(asset.skeleton, unreal.load_asset("/Game/target").skeleton)
        self.assertEqual(list(asset.options.materials), ["Cloth"])
        self.assertTrue(asset.options.use_mesh_bone_proportions)
        found = np.array([(p.x, p.y, p.z) for p in asset.content.positions], np.float32)
        wanted = expected("dressed", np.float32).reshape(-1, 3)
        # The bind transforms go by way of the bones' local ones: they differ in the last bits, and so the fit ends elsewhere, some
        # millimetres at most.
        distances = np.linalg.norm(found - wanted, axis=1)
        self.assertLess(distances.max(), 0.6)
        self.assertLess(distances.mean(), 0.1)
        for row in asset.content.skin:
            self.assertAlmostEqual(sum(w.weight for w in row), 1.0, places=5)
            self.assertLessEqual(len(row), 8)
        self.assertIn("garment: fitting", unreal.lines)
        self.assertIn("garment: done", unreal.lines)
        self.assertEqual(self.dress(), ["/Game/Bespoke/garment_on_target_2"])

    def test_the_same_bits_with_the_same_binds(self) -> None:
        figures = [bespoke_unreal.read(unreal.load_asset(f"/Game/{name}")) for name in ("garment", "source", "target")]
        for figure in figures:
            binds = expected(f"{figure.name}.binds", np.float64).reshape(-1, 4, 4).transpose(0, 2, 1)
            for joint, bind in zip(figure.rig, binds):
                np.testing.assert_allclose(joint.bind, bind, rtol=0, atol=1e-9)
            figure.rig = [bespoke.Joint(joint.name, joint.parent, bind) for joint, bind in zip(figure.rig, binds)]
        with bespoke_unreal._filled(*figures, [], bespoke.Options(), []) as session:
            session.run()
            np.testing.assert_array_equal(session.read_garment_vertices().ravel(), expected("dressed", np.float32))

    def test_dials_reach_the_library(self) -> None:
        self.dress(looseness=0.0, fit=4.0)
        tight = unreal.made["/Game/Bespoke/garment_on_target"].content.positions
        tight = np.array([(p.x, p.y, p.z) for p in tight], np.float32)
        self.assertGreater(np.abs(tight - expected("dressed", np.float32).reshape(-1, 3)).max(), 0.1)
        with self.assertRaises(bespoke.BespokeError):
            self.dress(looseness=3.0)

    def test_defaults_are_those_of_all_hosts(self) -> None:
        defaults = bespoke.read_default_options()
        dials = inspect.signature(bespoke_unreal.dress).parameters
        for dial, option in {"fit": "fit_weight", "looseness": "designed_clearance", "offset": "offset"}.items():
            self.assertEqual(dials[dial].default, getattr(defaults, option))

    def test_cancel(self) -> None:
        unreal.state["looks_until_cancel"] = 4
        with self.assertRaises(bespoke_unreal.BespokeStopped):
            self.dress()
        self.assertEqual(unreal.made, {})

    def test_what_cannot_be_used(self) -> None:
        for arguments, words in (
            ({"garments": ()}, "no garment"),
            ({"garments": ("/Game/Missing/Coat",)}, "/Game/Missing/Coat"),
            ({"garments": ("/Game/empty",)}, "empty cannot be read"),
            ({"pairs": [("Tail", None)]}, "source has no bone Tail"),
            ({"pairs": [("hips", "Tail")]}, "target has no bone Tail"),
            ({"folder": "/Nowhere"}, "/Nowhere/garment_on_target"),
        ):
            with self.assertRaises(ValueError) as failure:
                self.dress(**arguments)
            self.assertIn(words, str(failure.exception))

    def test_pairs_reach_the_library(self) -> None:
        self.dress(pairs=[("hips", "hips")])
        with self.assertRaises(bespoke.BespokeError):
            self.dress(pairs=[("hips", "hips"), ("spine", "hips")])

    def test_joint_map(self) -> None:
        found = bespoke_unreal.joint_map("/Game/source", "/Game/target")
        source, target = (bespoke_unreal.read(unreal.load_asset(f"/Game/{name}")) for name in ("source", "target"))
        self.assertEqual([match.bone for match in found], [joint.name for joint in source.rig])
        with bespoke.Session() as session:
            session.set_source_rig(source.rig)
            session.set_target_rig(target.rig)
            session.set_target_skin_influences(target.joints, target.weights, joint_count=len(target.rig))
            wanted = session.read_joint_map()
        names = [None if m.target is None else target.rig[m.target].name for m in wanted]
        self.assertEqual([match.worn_by for match in found], names)
        self.assertEqual([match.reason for match in found], [m.reason for m in wanted])
        self.assertGreater(sum(match.confidence > 0.5 for match in found), 2)
        self.assertEqual(len(unreal.lines), len(found))
        # What is chosen is there, and wins.
        bone = found[0].bone
        mended = bespoke_unreal.joint_map("/Game/source", "/Game/target", [(bone, None)])
        self.assertEqual((mended[0].worn_by, mended[0].reason), (None, bespoke.JointReason.CALLER))
        self.assertTrue(any(line.startswith(f"log: {bone} ") and "caller" in line for line in unreal.lines))

    def test_take_back(self) -> None:
        self.dress()
        second = self.dress()
        self.assertEqual(bespoke_unreal.take_back(), second)
        self.assertEqual(list(unreal.made), ["/Game/Bespoke/garment_on_target"])
        self.assertEqual(bespoke_unreal.take_back(), [])

    def test_what_does_not_come_along_is_told(self) -> None:
        unreal.state["morphs"] = ["wide", "long"]
        self.dress()
        self.assertTrue(any("morph targets" in line and "wide, long" in line for line in unreal.lines), unreal.lines)

    def test_every_stage_has_words(self) -> None:
        self.assertEqual(set(bespoke_unreal.STAGES), set(bespoke.Stage))


class Calls(unittest.TestCase):
    """What the script uses is in the editor's module, as far as PyPI's stub of 5.6 has it: it lacks Geometry Script."""

    def chains(self) -> set[tuple[str, ...]]:
        found = set()
        for node in ast.walk(ast.parse(SCRIPT.read_text(encoding="utf-8"))):
            names: list[str] = []
            while isinstance(node, ast.Attribute):
                names.insert(0, node.attr)
                node = node.value
            if isinstance(node, ast.Name) and node.id == "unreal" and names:
                found.add(tuple(names))
        return found

    def test_stub(self) -> None:
        folder = os.environ.get("BESPOKE_UNREAL_STUB")
        if not folder or not pathlib.Path(folder, "unreal.py").is_file():
            self.skipTest("unreal-stub cannot be had from PyPI")
        text = pathlib.Path(folder, "unreal.py").read_text(encoding="utf-8")
        checked = 0
        for names in self.chains():
            if names[0].startswith("GeometryScript"):
                continue
            if names[0].startswith("log") or names[0] == "load_asset":
                self.assertRegex(text, rf"(?m)^def {names[0]}\(", names)
            else:
                self.assertRegex(text, rf"(?m)^class {names[0]}\(", names)
                if len(names) > 1:
                    body = text.split(f"\nclass {names[0]}(", 1)[1].split("\nclass ", 1)[0]
                    self.assertRegex(body, rf"def {names[1]}\(", names)
            checked += 1
        self.assertGreater(checked, 8)
        # What is used of objects.
        for owner, member in (
            ("ScopedSlowTask", "make_dialog"),
            ("ScopedSlowTask", "enter_progress_frame"),
            ("ScopedSlowTask", "should_cancel"),
            ("SkeletalMesh", "skeleton"),
            ("SkeletalMesh", "materials"),
            ("SkeletalMesh", "get_all_morph_target_names"),
            ("SkeletalMaterial", "material_slot_name"),
            ("SkeletalMaterial", "material_interface"),
            ("Transform", "to_matrix"),
            ("Matrix", "w_plane"),
        ):
            body = text.split(f"\nclass {owner}(", 1)[1].split("\nclass ", 1)[0]
            self.assertTrue(re.search(rf"def {member}\(", body), f"{owner}.{member}")

    def test_everything_is_in_the_module_that_stands_for_it(self) -> None:
        for names in self.chains():
            thing: object = unreal
            for name in names:
                self.assertTrue(hasattr(thing, name), ".".join(names))
                thing = getattr(thing, name)


if __name__ == "__main__":
    sys.exit(unittest.main())
