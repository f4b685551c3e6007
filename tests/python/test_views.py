"""Arrays of every memory: which are read where they are, which are copied, which are refused."""

from __future__ import annotations

import unittest
from typing import Any

import numpy as np

import bespoke
import scenes
from bespoke import Status, _arrays


def run(session: bespoke.Session) -> scenes.Array:
    session.run()
    return session.read_garment_vertices()


class Views(scenes.Case):
    def test_what_is_read_without_a_copy(self) -> None:
        points = np.zeros((7, 3), np.float32)
        interleaved = np.zeros((7, 8), np.float64)
        vertices = np.zeros(7, [("normal", np.float32, 3), ("position", np.float32, 3), ("uv", np.float32, 2)])
        frozen = points.copy()
        frozen.flags.writeable = False
        wide = np.zeros((14, 3), np.float32)
        for array in (points, interleaved[:, 2:5], vertices["position"], frozen, wide[::2], points[:1], points[:0]):
            view = _arrays.floats(array, 3, "points", "(n, 3)")
            self.assertTrue(view.array is array or view.array.base is not None and np.shares_memory(view.array, array)
                            or array.size == 0)
            self.assertEqual(view.native.count, len(array))
            if len(array) > 1:
                self.assertEqual(view.native.data, array.ctypes.data)
                self.assertEqual(view.native.stride, array.strides[0])
        for kind in (np.uint16, np.uint32, np.int32):
            faces = np.arange(12, dtype=kind).reshape(4, 3)
            self.assertEqual(_arrays.indices(faces, 3, "faces", "(m, 3)").native.data, faces.ctypes.data)

    def test_what_is_copied(self) -> None:
        points = np.arange(21, dtype=np.float32).reshape(7, 3)
        faces = np.arange(21, dtype=np.int64).reshape(7, 3)
        for array in (
            np.asfortranarray(points),
            points[::-1],
            points[:, ::-1],
            points.astype(">f4"),
            points.astype(np.float16),
            points.astype(np.int64),
            np.broadcast_to(points[0], (7, 3)),
            np.lib.stride_tricks.sliding_window_view(points.reshape(-1), 3),
            points.tolist(),
        ):
            view = _arrays.floats(array, 3, "points", "(n, 3)")
            np.testing.assert_array_equal(view.array, np.asarray(array))
            self.assertTrue(view.array.flags.c_contiguous and view.array.dtype.isnative)
        self.assertEqual(_arrays.floats(points.astype(np.float16), 3, "points", "").array.dtype, np.float32)
        for other in (faces, faces.astype(np.uint64), faces.astype(np.int8), faces.tolist(), np.asfortranarray(faces)):
            view = _arrays.indices(other, 3, "faces", "(m, 3)")
            np.testing.assert_array_equal(view.array, faces)
            self.assertIn(view.array.dtype, (np.uint16, np.uint32))

    def test_every_memory_gives_the_same_bits(self) -> None:
        scene = scenes.tubes()
        with scene.session() as session:
            expected = run(session)
        points, faces = scene.garment
        wide = np.full((len(points), 11), np.nan, np.float32)
        wide[:, 5:8] = points
        frozen = points.copy()
        frozen.flags.writeable = False
        backwards = np.ascontiguousarray(points[::-1])[::-1]
        memories: list[tuple[Any, Any]] = [
            (np.asfortranarray(points), np.asfortranarray(faces)),
            (wide[:, 5:8], faces.astype(np.int64)),
            (frozen, faces.astype(np.uint16)),
            (backwards, faces.astype(np.int32)),
            (points.astype(">f4"), faces.astype(">u4")),
        ]
        for positions, triangles in memories:
            with bespoke.Session(threads=2) as session:
                session.set_source_skeleton(np.asfortranarray(scene.source), scene.bones.tolist())
                session.set_target_skeleton(scene.target.astype(np.float64), scene.bones.astype(np.int8))
                session.set_target_avatar(*scene.avatar)
                session.set_garment(positions, triangles)
                self.same_bits(run(session), expected)
        # The caller's arrays are not kept: what they hold later does not matter.
        garment = points.copy()
        with scene.session() as session:
            session.set_garment(garment, faces)
            garment[:] = np.nan
            self.same_bits(run(session), expected)

    def test_precision_is_that_of_the_garment(self) -> None:
        scene = scenes.tubes()
        with scene.session() as session:
            self.assertEqual(run(session).dtype, np.float32)
            self.assertEqual(session.read_garment_vertices(dtype=np.float64).dtype, np.float64)
        scene.garment = (scene.garment[0].astype(np.float64), scene.garment[1])
        with scene.session() as session:
            self.assertEqual(run(session).dtype, np.float64)
            self.assertEqual(session.verify(), session.verify(np.float64))

    def test_results_in_the_callers_memory(self) -> None:
        with scenes.tubes().session() as session:
            expected = run(session)
            n = len(expected)
            wide = np.full((n, 8), 7.0, np.float32)
            self.assertIs(session.read_garment_vertices(wide[:, 2:5]).base, wide)
            self.same_bits(np.ascontiguousarray(wide[:, 2:5]), expected)
            self.assertTrue((wide[:, :2] == 7.0).all() and (wide[:, 5:] == 7.0).all())
            doubles = np.empty((n, 3))
            self.assertIs(session.read_garment_vertices(doubles), doubles)
            self.same_bits(doubles.astype(np.float32), expected)
            frozen = np.empty((n, 3), np.float32)
            frozen.flags.writeable = False
            bad: list[tuple[Any, str]] = [
                (np.empty((n - 1, 3), np.float32), "shape"),
                (np.empty((n, 3), np.int32), "int32"),
                (np.empty((n, 3), np.float32, order="F"), "strides"),
                (np.empty((n, 3), np.float32)[::-1], "strides"),
                (np.broadcast_to(np.float32(0), (n, 3)), "read-only"),
                (frozen, "read-only"),
                (np.empty((n, 3), ">f4"), ">f4"),
                ([0.0] * n, "list"),
            ]
            for out, word in bad:
                self.refused(Status.INVALID_ARGUMENT, lambda: session.read_garment_vertices(out), word)
            self.refused(Status.INVALID_ARGUMENT, lambda: session.read_garment_vertices(dtype=np.int32), "int32")

    def test_what_is_refused(self) -> None:
        points, faces = scenes.tubes().garment
        masked = np.ma.masked_less(points, 0.0)
        bad: list[tuple[Any, Any, Status, tuple[str, ...]]] = [
            (points[:, :2], faces, Status.INVALID_ARGUMENT, ("vertices", "(n, 3)", "2)")),
            (points.reshape(-1), faces, Status.INVALID_ARGUMENT, ("(n, 3)",)),
            (points.astype(complex), faces, Status.INVALID_ARGUMENT, ("complex128",)),
            (points.astype(np.longdouble), faces, Status.INVALID_ARGUMENT, ("64 bits",)),
            (points.astype(str), faces, Status.INVALID_ARGUMENT, ("real numbers",)),
            (None, faces, Status.INVALID_ARGUMENT, ("(n, 3)",)),
            (masked, faces, Status.INVALID_ARGUMENT, ("masked",)),
            (points, faces.astype(np.float64), Status.INVALID_ARGUMENT, ("triangles", "float64")),
            (points, faces.astype(np.int64) - 1, Status.INVALID_MESH, ("element 0", "-1")),
            (points, faces.astype(np.int64) + (1 << 32), Status.INVALID_MESH, ("element 0", "32 bits")),
            (points, faces + 1, Status.INVALID_MESH, ("garment", str(len(points)))),
            (points, [], Status.INVALID_MESH, ()),
            ([], faces, Status.INVALID_MESH, ()),
            (points * np.float32(np.nan), faces, Status.INVALID_MESH, ()),
        ]
        with bespoke.Session() as session:
            for positions, triangles, status, words in bad:
                failure = self.refused(status, lambda: session.set_garment(positions, triangles), *words)
                self.assertIsInstance(failure, ValueError)
            self.assertEqual(session.stage, bespoke.Stage.SETUP)


if __name__ == "__main__":
    unittest.main()
