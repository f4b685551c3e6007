"""`dress`, on meshes of others, and the examples of the texts."""

from __future__ import annotations

import doctest
import importlib.util
import os
import pathlib
import types
import unittest

import numpy as np

import bespoke
import scenes
from bespoke import Joint, Options, Skeleton, Status, _dress

ROOT = pathlib.Path(__file__).resolve().parents[2]
HAS_TRIMESH = importlib.util.find_spec("trimesh") is not None


class Dress(scenes.Case):
    def test_meshes_of_every_kind(self) -> None:
        scene = scenes.tubes()
        with scene.session() as session:
            session.run()
            expected = session.read_garment_vertices()
            diagnostics = session.read_diagnostics()
        source, target = Skeleton(scene.source, scene.bones), (scene.target, scene.bones)
        garment = types.SimpleNamespace(vertices=scene.garment[0], faces=scene.garment[1])
        heard: list[bespoke.Progress] = []
        dressed = bespoke.dress(garment, scene.avatar, source, target, threads=2, progress=heard.append)
        self.same_bits(dressed.vertices, expected)
        self.same_bits(dressed.faces, scene.garment[1])
        self.assertEqual(repr(dressed.diagnostics), repr(diagnostics))
        self.assertTrue(dressed.report.is_verified)
        self.assertIsNone(dressed.skin)
        self.assertEqual(heard[-1].stage, bespoke.Stage.DONE)
        # What comes out goes in: as a layer.
        over = bespoke.dress(scenes.tube(0.34, 0.4, 16, 9), scene.avatar, source, target, layers=[dressed], threads=2)
        self.assertEqual(over.report.avatar_intersections, 0)

    def test_all_that_is_optional(self) -> None:
        scene = scenes.tubes()
        n, vertices = len(scene.garment[0]), len(scene.avatar[0])

        def rig(scale: float) -> list[Joint]:
            joints = []
            for k, name in enumerate(("Hips", "Spine", "Head")):
                bind = np.eye(4)
                bind[1, 3] = scale * (k - 1)
                joints.append(Joint(name, k - 1 if k else None, bind))
            return joints

        dressed = bespoke.dress(
            scene.garment,
            scene.avatar,
            rig(1.0),
            rig(1.1),
            source_avatar=scenes.tube(0.25, 0.9, 14, 15),
            skin=(np.ones((vertices, 1), np.int64), np.ones((vertices, 1))),
            fit_weights=np.ones(n),
            rigid_groups=[[0, 1, 2]],
            joint_pairs=[[0, 0], [1, 1], [2, 2]],
            source_coordinates=bespoke.CoordinateSystem.GLTF,
            target_coordinates=bespoke.CoordinateSystem(trusted=True),
            options=Options(threads=1, fit_weight=3.0),
            designed_clearance=0.5,
        )
        assert dressed.skin is not None
        np.testing.assert_array_equal(np.asarray(dressed.skin.joints)[:, 0], 1)
        np.testing.assert_array_equal(np.asarray(dressed.skin.weights)[:, 0], 1.0)

    def test_what_is_no_mesh(self) -> None:
        scene = scenes.tubes()
        skeleton = Skeleton(scene.source, scene.bones)
        with self.assertRaisesRegex(TypeError, "avatar.*str"):
            bespoke.dress(scene.garment, "body.obj", skeleton, skeleton)  # type: ignore[arg-type]
        with self.assertRaisesRegex(TypeError, "source_skeleton"):
            bespoke.dress(scene.garment, scene.avatar, [1, 2, 3], skeleton)  # type: ignore[list-item]
        self.refused(Status.INVALID_SKELETON, lambda: bespoke.dress(scene.garment, scene.avatar, [], skeleton))
        self.refused(
            Status.INVALID_MESH,
            lambda: bespoke.dress(scene.garment, scene.avatar, skeleton, skeleton, layers=[([], [])]),
        )

    def test_a_result_that_is_not_as_designed(self) -> None:
        # Two legs of trousers; that the right leg misses its own is not what this test makes: the error itself.
        scene = scenes.tubes()
        skeleton = (scene.source, scene.bones)
        target = (scene.target, scene.bones)
        original = bespoke.Session.run

        def run(session: bespoke.Session, progress: object = None) -> None:
            original(session)
            raise bespoke.ImplausibleResultError(Status.IMPLAUSIBLE_RESULT, "as if", session.read_diagnostics())

        bespoke.Session.run = run  # type: ignore[method-assign,assignment]
        try:
            with self.assertRaises(bespoke.ImplausibleResultError) as caught:
                bespoke.dress(scene.garment, scene.avatar, skeleton, target)
        finally:
            bespoke.Session.run = original  # type: ignore[method-assign]
        result = caught.exception.result
        assert result is not None
        self.assertEqual(result.report.avatar_intersections, 0)

    @unittest.skipUnless(HAS_TRIMESH, "there is no trimesh")
    def test_trimesh(self) -> None:
        import trimesh

        scene = scenes.tubes()
        garment, avatar = (trimesh.Trimesh(*mesh, process=False) for mesh in (scene.garment, scene.avatar))
        source, target = Skeleton(scene.source, scene.bones), Skeleton(scene.target, scene.bones)
        dressed = bespoke.dress(garment, avatar, source, target, threads=2)
        expected = bespoke.dress(
            (scene.garment[0].astype(np.float64), scene.garment[1]), scene.avatar, source, target, threads=2
        )
        self.same_bits(dressed.vertices, expected.vertices)
        garment.vertices = dressed.vertices
        self.assertEqual(garment.faces.shape, scene.garment[1].shape)


class Examples(unittest.TestCase):
    def test_docstrings(self) -> None:
        failed, tried = doctest.testmod(_dress)
        self.assertEqual(failed, 0)
        self.assertGreater(tried, 5)

    @unittest.skipUnless(HAS_TRIMESH, "there is no trimesh")
    def test_page(self) -> None:
        folder = os.environ.get("BESPOKE_DEMO")
        if not folder:
            self.skipTest("tests/python/main.rs writes what `make demo` makes, and names it in BESPOKE_DEMO")
        text = (ROOT / "docs/python.md").read_text()
        if importlib.util.find_spec("matplotlib") is None:
            print("skipped: the picture of docs/python.md, for there is no matplotlib")
            text = text[: text.index("## Draw it")]
        here = os.getcwd()
        os.chdir(folder)
        try:
            test = doctest.DocTestParser().get_doctest(text, {}, "python.md", "docs/python.md", 0)
            said: list[str] = []
            failed, tried = doctest.DocTestRunner().run(test, out=said.append)
        finally:
            os.chdir(here)
        self.assertEqual(failed, 0, "".join(said))
        self.assertGreater(tried, 20)


if __name__ == "__main__":
    unittest.main()
