"""Everything that is set and read, and what is refused."""

from __future__ import annotations

import pickle
import unittest
from typing import Any, Callable

import numpy as np

import bespoke
import scenes
from bespoke import Axis, CoordinateSystem, DiagnosticKind, Joint, Stage, Status


class Inputs(scenes.Case):
    def test_every_input(self) -> None:
        scene = scenes.tubes()
        n = len(scene.garment[0])
        vertices = len(scene.avatar[0])
        with scene.session() as session:
            session.set_source_avatar(*scenes.tube(0.25, 0.9, 14, 15))
            session.set_target_skin_weights(np.tile(np.array([[0.0], [1.0], [0.0]], np.float32), vertices))
            weights = np.zeros((vertices, 2), np.float32)
            weights[:, 0] = 1.0
            session.set_target_skin_influences(np.ones((vertices, 2), np.uint16), weights, 3)
            session.set_vertex_fit_weights(np.linspace(0.5, 1.0, n))
            session.set_no_fit_vertices(range(16))
            session.set_pinned_vertices([0, 1])
            session.set_pinned_vertices([], None)
            session.set_pinned_vertices([3], scene.garment[0][3:4] * np.float32(1.1))
            session.add_rigid_group(np.arange(40, 44))
            session.clear_rigid_groups()
            session.add_rigid_group([n - 1, n - 2])
            session.add_curve(range(16), closed=True, curve_weight=2.0)
            session.clear_curves()
            session.add_curve([16, 17, 18], position_weight=0.5)
            session.add_layer(*scenes.tube(0.22, 0.3, 14, 9))
            session.clear_layers()
            session.set_avatar_parts([bespoke.PartRole.BODY] * len(scene.avatar[1]))
            session.set_avatar_parts(None)
            session.set_source_coordinate_system(CoordinateSystem(trusted=True))
            session.set_target_coordinate_system(CoordinateSystem.GLTF)
            session.run()
            self.assertEqual(session.stage, Stage.DONE)
            self.assertEqual(session.verify().garment_avatar, 0)
            np.testing.assert_allclose(
                session.read_garment_vertices()[3], scene.garment[0][3] * np.float32(1.1), atol=5e-3
            )
            self.assertEqual(session.read_garment_skin_influences(3)[0].max(), 1)
            self.assertGreater(session.read_report().memory_bytes, 0)
            self.assertEqual(session.last_message, "")
            # All is kept.
            session.reset()
            self.assertEqual((session.stage, session.read_diagnostics()), (Stage.SETUP, ()))
            session.prepare()
            self.assertEqual(session.stage, Stage.PREPARED)

    def test_what_goes_along(self) -> None:
        scene = scenes.tubes()
        garment, triangles = scene.garment
        vertices = len(scene.avatar[0])
        with scene.session() as session:
            session.add_garment_morph(garment)
            session.clear_garment_morphs()
            session.add_garment_morph(0.1 * garment, "larger")
            session.add_target_morph(scene.avatar[0])
            session.clear_target_morphs()
            session.add_target_morph(np.array([0.1, 0.0, 0.1]) * scene.avatar[0], "heavier")
            session.add_follower(garment, triangles)
            session.clear_followers()
            session.add_follower(garment, triangles)
            session.set_target_skin_weights(np.ones((3, vertices)) * np.array([[0.0], [1.0], [0.0]]))
            session.run()
            fitted = session.read_garment_vertices()
            np.testing.assert_allclose(session.read_follower_vertices(0), fitted, atol=1e-5)
            joints, weights, count = session.read_follower_skin_influences(0, 2)
            self.assertEqual((joints.shape, weights[0, 0], count), ((len(garment), 2), 1.0, 3))
            self.assertEqual(session.read_garment_morph(0).shape, fitted.shape)
            near = session.read_covered_triangles(margin=0)
            self.assertEqual(near.dtype, np.uint32)
            self.assertTrue(set(session.read_covered_triangles(margin=2)) <= set(near) < set(range(len(scene.avatar[1]))))
            with self.assertRaises(bespoke.BespokeError):
                session.read_covered_triangles(layer=0)
            with self.assertRaises(bespoke.BespokeError):
                session.read_target_morph(0)
            session.solve_target_morphs()
            answer = session.read_target_morph(0, dtype=np.float64)
            self.assertEqual((answer.shape, answer.dtype), (fitted.shape, np.float64))
            self.assertTrue(np.any(answer != 0.0))
            session.set_target_morph_weight(0, 0.0)
            with self.assertRaisesRegex(bespoke.InvalidInputError, "target morph 9"):
                session.set_target_morph_weight(9, 1.0)
            np.testing.assert_array_equal(session.read_garment_vertices(), fitted)
            normals, none = session.read_garment_normals()
            self.assertEqual((normals.shape, none.shape), (fitted.shape, (0, 4)))
            np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5)
            along = np.tile([0.0, 1.0, 0.0, -1.0], (len(garment), 1))
            again, tangents = session.read_garment_normals(normals, triangles=triangles, tangents=along)
            self.assertEqual((again.shape, tangents.shape), (normals.shape, along.shape))
            self.assertTrue(np.all(tangents[:, 3] == -1.0))
            with self.assertRaises(ValueError):
                session.read_garment_morph(-1)

    def test_a_layer_is_an_obstacle(self) -> None:
        scene = scenes.tubes()
        with scene.session() as session:
            session.run()
            alone = session.read_garment_vertices()
            session.reset()
            layer = scenes.tube(0.27, 0.4, 14, 9)
            session.add_layer(*layer)
            session.run()
            over = session.read_garment_vertices()
            self.assertEqual(session.read_report().avatar_intersections, 0)
            self.assertGreater(np.hypot(over[:, 0], over[:, 2]).max(), np.hypot(alone[:, 0], alone[:, 2]).max() + 0.01)

    def test_coordinate_systems(self) -> None:
        scene = scenes.tubes()
        with scene.session() as session:
            session.run()
            expected = session.read_garment_vertices()

        def unreal(points: scenes.Array) -> scenes.Array:
            return np.ascontiguousarray(np.float32(100) * np.stack([-points[:, 2], points[:, 0], points[:, 1]], axis=1))

        scene.target = unreal(scene.target)
        scene.avatar = (unreal(scene.avatar[0]), scene.avatar[1])
        with scene.session() as session:
            session.set_target_coordinate_system(CoordinateSystem.UNREAL)
            session.run()
            np.testing.assert_allclose(session.read_garment_vertices(), unreal(expected), atol=0.02)
            bad = CoordinateSystem(up=Axis.NEGATIVE_X)
            session.reset()
            self.refused(Status.INVALID_ARGUMENT, lambda: session.set_source_coordinate_system(bad))

    def test_options(self) -> None:
        defaults = bespoke.read_default_options()
        self.assertEqual((defaults.fit_weight, defaults.max_iterations, defaults.strict), (2.0, 500, False))
        with bespoke.Session(defaults, threads=1) as session:
            session.set_options(fit_weight=0, strict=True, surface_form=bespoke.SurfaceForm.PRINTED)
            self.refused(Status.INVALID_ARGUMENT, lambda: session.set_options(dhat=1.0), "dhat")
            self.refused(Status.INVALID_ARGUMENT, lambda: session.set_options(fit_weight=float("nan")), "fit_weight")
            for name, value in (("dhat", 0), ("threads", -1), ("max_iterations", 1 << 32), ("surface_weight", 0.0)):
                with self.assertRaisesRegex(ValueError, name):
                    session.set_options(**{name: value})  # type: ignore[arg-type]
            with self.assertRaises(TypeError):
                session.set_options(threads=1.5)  # type: ignore[arg-type]
            with self.assertRaises(TypeError):
                session.set_options(fit=1.0)  # type: ignore[call-arg]
        # Off is off, and single options win.
        scene = scenes.tubes()
        results = []
        for options in (bespoke.Options(fit_weight=0.0), bespoke.Options(fit_weight=0.0), bespoke.Options()):
            with bespoke.Session(options, threads=1) as session:
                scene.set_on(session)
                session.run()
                weights = {energy.name: energy.weight for energy in session.read_energies()}
                results.append(weights.get("fit", 0.0))
        self.assertEqual(results, [0.0, 0.0, 2.0])
        self.refused(Status.INVALID_ARGUMENT, lambda: bespoke.Session(threads=4096), "threads")


class Errors(scenes.Case):
    def test_states(self) -> None:
        with bespoke.Session() as session:
            calls: list[Callable[[], Any]] = [
                session.run, session.prepare, session.step, session.verify, session.read_garment_vertices,
                session.read_avatar_vertices, session.read_distortion, session.read_joint_map, session.read_added_joints,
                session.read_pose_transforms, session.read_garment_skin_influences,
                lambda: session.set_no_fit_vertices([0]),
            ]
            for call in calls:
                self.refused(Status.INVALID_STATE, call)
            self.assertTrue(session.last_message)
            self.assertEqual(session.read_energies(), ())
            for budget in (-1, 1 << 32):
                with self.assertRaises(ValueError):
                    session.step(budget)
        with scenes.tubes().session() as session:
            session.run()
            self.refused(Status.INVALID_STATE, lambda: session.set_garment(*scenes.tubes().garment))
            self.refused(Status.INVALID_STATE, session.step)
            with self.assertRaises(ValueError):
                session.read_garment_skin_influences(0)
            self.refused(Status.INVALID_ARGUMENT, lambda: session.verify(np.int32), "int32")

    def test_findings_come_with_the_error(self) -> None:
        scene = scenes.tubes()
        # Not around the skeleton.
        scene.garment = (scene.garment[0] + np.array([0.0, 0.0, 3.0], np.float32), scene.garment[1])
        with scene.session() as session:
            failure = self.refused(Status.NOT_ENCLOSED, session.run)
            self.assertEqual(repr(failure.diagnostics), repr(session.read_diagnostics()))
            self.assertEqual(session.last_message, failure.message)
        # A garment that passes through itself, refused for it.
        points, faces = scenes.tubes().garment
        points = points.copy()
        points[20] *= np.float32(-1.0)
        scene.garment = (points, faces)
        with scene.session(strict=True) as session:
            failure = self.refused(Status.SELF_INTERSECTION, session.run)
        found = [one for one in failure.diagnostics if one.kind == DiagnosticKind.SELF_INTERSECTION]
        self.assertTrue(found)
        self.assertEqual(found[0].severity, bespoke.Severity.ERROR)
        element = found[0].elements[0]
        self.assertEqual((element.subject, element.kind), (bespoke.Subject.GARMENT, bespoke.ElementKind.TRIANGLE))
        self.assertIn(20, faces[element.index].tolist() + faces[found[0].elements[1].index].tolist())
        self.assertTrue(found[0].message)
        copied = pickle.loads(pickle.dumps(failure))
        self.assertEqual((type(copied), copied.status, str(copied)), (type(failure), failure.status, str(failure)))
        # As text, for a distance that is none equals nothing.
        self.assertEqual(repr(copied.diagnostics), repr(failure.diagnostics))

    def test_sizes(self) -> None:
        scene = scenes.tubes()
        setters: list[tuple[Callable[[bespoke.Session], None], Status, str]] = [
            (lambda s: s.set_vertex_fit_weights([1.0]), Status.INVALID_WEIGHTS, "fit weights"),
            (lambda s: s.set_target_skin_weights(np.ones((2, 9))), Status.INVALID_WEIGHTS, "skin weights"),
            (lambda s: s.set_pinned_vertices([99999]), Status.INVALID_ARGUMENT, "99999"),
            (lambda s: s.set_avatar_parts([1]), Status.INVALID_ARGUMENT, "role"),
            (lambda s: s.set_target_skeleton(scene.target, [[0, 1], [0, 2]]), Status.INVALID_SKELETON, "bone"),
        ]
        for change, status, word in setters:
            with scene.session() as session:
                change(session)
                self.refused(status, session.prepare, word)
        with scene.session() as session:
            refusals: list[tuple[Callable[[], None], Status, str]] = [
                (lambda: session.set_target_skin_influences([[0]], [[1.0, 2.0]], 3), Status.INVALID_ARGUMENT, "weights"),
                (lambda: session.set_target_skin_influences([[-1]], [[1.0]], 3), Status.INVALID_WEIGHTS, "-1"),
                (lambda: session.set_target_skin_influences([], [], 3), Status.INVALID_ARGUMENT, "influences"),
                (lambda: session.set_target_skin_weights([[-1.0]]), Status.INVALID_WEIGHTS, "-1"),
                (lambda: session.set_source_skeleton(scene.source, [[0, -1]]), Status.INVALID_SKELETON, "-1"),
                (lambda: session.set_avatar_parts([9]), Status.INVALID_ARGUMENT, "9"),
                (lambda: session.add_rigid_group([]), Status.INVALID_ARGUMENT, "rigid"),
                (lambda: session.add_curve([1]), Status.INVALID_ARGUMENT, "curve"),
                (lambda: session.add_layer(np.zeros((0, 3)), []), Status.INVALID_MESH, "layer"),
            ]
            for call, status, word in refusals:
                self.refused(status, call, word)


def at(name: str | None, parent: int | None, x: float, y: float) -> Joint:
    bind = np.eye(4)
    bind[:2, 3] = x, y
    return Joint(name, parent, bind)


def legs(scale: float, *names: str) -> list[Joint]:
    """Two of them."""
    joints = [at(names[0], None, 0, scale)]
    for k in range(1, 7):
        down = (k - 1) % 3
        side = 0.1 if k < 4 else -0.1
        joints.append(at(names[k], 0 if down == 0 else k - 1, scale * side, scale * (0.95 - 0.45 * down)))
    return joints


def source() -> list[Joint]:
    return legs(1.0, "Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg", "RightFoot")


def target() -> list[Joint]:
    """In the opposite order."""
    names = ("hips", "leftUpperLeg", "leftLowerLeg", "leftFoot", "rightUpperLeg", "rightLowerLeg", "rightFoot")
    joints = legs(1.3, *names)
    turned = [Joint(one.name, None if one.parent is None else 6 - one.parent, one.bind) for one in joints]
    return turned[::-1]


class Rigs(scenes.Case):
    def test_maps(self) -> None:
        with bespoke.Session() as session:
            session.set_source_rig(source())
            session.set_target_rig(target())
            joints = session.read_joint_map()
            self.assertEqual([one.target for one in joints], [6, 5, 4, 3, 2, 1, 0])
            self.assertEqual({one.reason for one in joints}, {bespoke.JointReason.NAME})
            self.assertEqual([one.part for one in joints[:3]], ["hips", "left upper leg", "left lower leg"])
            for pairs in ([[3, 4], [6, -1]], np.array([[3, 4], [6, -1]], np.int32), np.array([[3, 4], [6, 0xFFFFFFFF]], np.uint32),
                          np.array([[3, 4], [6, 65535]], np.uint16)):
                session.set_joint_pairs(pairs)
                mended = session.read_joint_map()
                self.assertEqual((mended[3].target, mended[3].confidence, mended[6].target), (4, 1.0, None))
                self.assertEqual(mended[6].reason, bespoke.JointReason.CALLER)
            session.set_joint_pairs([])
            self.assertEqual(session.read_joint_map()[3].target, 3)

    def test_refusals(self) -> None:
        with bespoke.Session() as session:
            self.refused(Status.INVALID_SKELETON, lambda: session.set_target_rig([]), "target rig")

            def changed(status: Status, joint: Joint, *words: str) -> None:
                joints = source()
                joints[2] = joint
                self.refused(status, lambda: session.set_source_rig(joints), *words)

            changed(Status.INVALID_ARGUMENT, Joint("a", 1, np.eye(3)), "joint 2", "(3, 3)")
            changed(Status.INVALID_SKELETON, Joint("a", 1, np.full((4, 4), np.nan)), "joint 2", '"a"')
            changed(Status.INVALID_SKELETON, Joint("a", -1, np.eye(4)), "joint 2", "-1")
            changed(Status.INVALID_SKELETON, Joint("a", 70, np.eye(4)), "joint 2", "70")
            # The last row would be the place where the matrix of C is handed over as it is.
            changed(Status.INVALID_SKELETON, Joint("a", 1, np.array(at("a", 1, 1.0, 2.0).bind).T), "joint 2")
            self.refused(Status.INVALID_ARGUMENT, lambda: session.set_joint_pairs([0, 1]), "joint pairs")
            self.refused(Status.INVALID_ARGUMENT, lambda: session.set_joint_pairs([[0, -2]]), "-2")
            session.set_source_rig(source())
            session.set_target_rig(target())
            session.set_joint_pairs([[0, 9]])
            self.refused(Status.INVALID_ARGUMENT, session.read_joint_map, "joint 9 of the target rig")

    def test_outfits(self) -> None:
        jacket, shirt = scenes.tube(0.4, 0.6, 20, 9), scenes.tube(0.35, 0.5, 18, 8)
        with bespoke.Session(threads=1) as session:
            self.assertEqual(session.read_outfit_order().tolist(), [])
            session.add_outfit_garment(*jacket)
            session.clear_outfit()
            session.add_outfit_garment(*jacket)
            session.add_outfit_garment(*shirt)
            order = session.read_outfit_order()
            self.assertEqual((order.tolist(), order.dtype), ([1, 0], np.uint32))
            (pair,) = session.read_worn_pairs()
            self.assertEqual((pair.inner, pair.outer, pair.is_overruled), (1, 0, False))
            self.assertGreater(pair.confidence, 0.9)
            self.refused(Status.INVALID_MESH, lambda: session.add_outfit_garment(jacket[0][:3], jacket[1]), "outfit garment 2")

            self.assertEqual(session.find_intersections(*jacket, *shirt).shape, (0, 2))
            across = np.array([[-1, 0.01, -1], [3, 0.02, -1], [-1, 0.03, 3]]), [[0, 1, 2]]
            cut = session.find_intersections(*jacket, *across)
            self.assertTrue(len(cut) >= 20 and np.all(cut[:, 1] == 0) and np.all(np.diff(cut[:, 0].astype(int)) > 0))
            both = np.concatenate([jacket[0], across[0]]), np.concatenate([jacket[1], [[len(jacket[0]) + k for k in range(3)]]])
            self.assertEqual(len(session.find_intersections(*both)), len(cut))
            with self.assertRaises(ValueError):
                session.find_intersections(*jacket, shirt[0])
            self.refused(Status.INVALID_MESH, lambda: session.find_intersections(*jacket, shirt[0][:3], shirt[1]), "second mesh")

    def test_key_poses(self) -> None:
        scene = scenes.tubes()
        vertices = len(scene.avatar[0])
        bones = [at("Hips", None, 0, -1), at("Spine", 0, 0, 0), at("Head", 1, 0, 1)]
        with scene.session() as session:
            session.set_source_rig(bones)
            session.set_target_rig([at(one.name, one.parent, 0, 1.1 * (k - 1)) for k, one in enumerate(bones)])
            above = (np.asarray(scene.avatar[0])[:, 1:2] > 0.0).astype(np.int64)
            session.set_target_skin_influences(above, np.ones((vertices, 1)), 3)
            session.add_key_pose(np.tile(np.eye(4), (3, 1, 1)), "still")
            session.run()
            self.refused(Status.INVALID_STATE, lambda: session.read_pose_correction(0), "still")
            turn = np.eye(4)
            turn[0, 0], turn[0, 1], turn[1, 0], turn[1, 1] = np.cos(0.6), -np.sin(0.6), np.sin(0.6), np.cos(0.6)
            session.add_key_pose([np.eye(4), turn, turn])
            session.solve_pose_corrections(1)
            offsets, before, after = session.read_pose_correction(0)
            self.assertEqual((offsets.shape, offsets.dtype), ((len(scene.garment[0]), 3), np.float32))
            self.assertFalse(np.any(offsets))
            self.assertEqual((before, after), (bespoke.PoseIntersections(0, 0, 0),) * 2)
            offsets, before, after = session.read_pose_correction(1, dtype=np.float64)
            pairs = [one.garment_garment + one.garment_avatar for one in (before, after)]
            self.assertTrue(pairs[1] < pairs[0] or (pairs == [0, 0] and not np.any(offsets)), pairs)
            self.refused(Status.INVALID_ARGUMENT, lambda: session.read_pose_correction(2), "key pose 2")
            self.refused(Status.INVALID_ARGUMENT, lambda: session.add_key_pose(np.eye(4)), "(joints, 4, 4)")
            self.refused(Status.INVALID_ARGUMENT, lambda: session.add_key_pose([np.eye(4)] * 2), "2 joints")
            with self.assertRaises(ValueError):
                session.read_pose_correction(-1)
            session.clear_key_poses()

    def test_own_joints_come_along(self) -> None:
        scene = scenes.tubes()
        n, vertices = len(scene.garment[0]), len(scene.avatar[0])
        bones = [at("Hips", None, 0, -1), at("Spine", 0, 0, 0), at("Head", 1, 0, 1)]
        hanging = at("cape", 1, 0.2, 0.3)
        with scene.session() as session:
            session.set_source_rig([*bones, hanging])
            session.set_target_rig([at(one.name, one.parent, 0, 1.1 * (k - 1)) for k, one in enumerate(bones)])
            session.set_target_skin_influences(np.ones((vertices, 1), np.int64), np.ones((vertices, 1)), 3)
            session.set_source_avatar(*scenes.tube(0.2, 0.9, 14, 15))
            session.set_source_skin_influences(np.ones((vertices, 1), np.int64), np.ones((vertices, 1)), 4)
            session.set_garment_skin_influences(np.full((n, 1), 3), np.ones((n, 1)), 4)
            session.run()
            added = session.read_added_joints()
            self.assertEqual([(one.source, one.parent) for one in added], [(3, 1)])
            np.testing.assert_allclose(added[0].bind[3], [0, 0, 0, 1])
            self.assertGreater(added[0].bind[0, 3], 0.05)
            joints, weights, count = session.read_garment_skin_influences(2)
            self.assertEqual((count, joints[0, 0], weights[0, 0]), (4, 3, 1.0))
            np.testing.assert_array_equal(session.read_pose_transforms(), np.tile(np.eye(4), (3, 1, 1)))


if __name__ == "__main__":
    unittest.main()
