"""What the tests dress: a small tube on a slimmer one, and the sample that tests/python/main.rs has written."""

from __future__ import annotations

import dataclasses
import os
import pathlib
import unittest
from typing import Any

import numpy as np
import numpy.typing as npt

import bespoke

Array = npt.NDArray[Any]
BONES = np.array([[0, 1], [1, 2]], np.uint32)


@dataclasses.dataclass
class Scene:
    garment: tuple[Array, Array]
    avatar: tuple[Array, Array]
    source: Array
    target: Array
    bones: Array

    def set_on(self, session: bespoke.Session) -> None:
        session.set_garment(*self.garment)
        session.set_source_skeleton(self.source, self.bones)
        session.set_target_avatar(*self.avatar)
        session.set_target_skeleton(self.target, self.bones)

    def session(self, **options: Any) -> bespoke.Session:
        session = bespoke.Session(**{"threads": 2, **options})
        self.set_on(session)
        return session


def tube(radius: float, half: float, around: int, rings: int) -> tuple[Array, Array]:
    """Open, around the y axis; float32 and uint32."""
    k = np.arange(rings * around)
    angle = 2.0 * np.pi * (k % around) / around
    y = half * (2.0 * (k // around) / (rings - 1) - 1.0)
    positions = np.stack([radius * np.sin(angle), y, radius * np.cos(angle)], axis=1).astype(np.float32)
    k = np.arange((rings - 1) * around)
    a = k // around * around + k % around
    b = k // around * around + (k + 1) % around
    corners = np.stack([a, b, b + around, a, b + around, a + around], axis=1)
    return positions, corners.reshape(-1, 3).astype(np.uint32)


def tubes() -> Scene:
    """Dressed in a fraction of a second."""
    source: Array = np.array([[0, -1, 0], [0, 0, 0], [0, 1, 0]], np.float32)
    return Scene(tube(0.3, 0.55, 16, 9), tube(0.2, 0.9, 14, 15), source, np.float32(1.1) * source, BONES)


def slow() -> Scene:
    """Takes many seconds, if it is not stopped."""
    source = np.array([[0, -1, 0], [0, 0, 0], [0, 1, 0]], np.float32)
    return Scene(tube(0.3, 0.55, 96, 72), tube(0.5, 0.9, 96, 96), source, np.float32(1.1) * source, BONES)


def sample_file(name: str, dtype: type, columns: int | None) -> Array:
    """An array of the sample."""
    folder = os.environ.get("BESPOKE_SAMPLE")
    if not folder:
        raise unittest.SkipTest("there is no sample: tests/python/main.rs writes it, and names it in BESPOKE_SAMPLE")
    numbers: Array = np.frombuffer(pathlib.Path(folder, name).read_bytes(), dtype)
    return numbers if columns is None else numbers.reshape(-1, columns)


def sample() -> Scene:
    """The jacket and the heavy body: a few seconds. The arrays are read-only."""
    return Scene(
        (sample_file("garment.positions", np.float32, 3), sample_file("garment.triangles", np.uint32, 3)),
        (sample_file("avatar.positions", np.float32, 3), sample_file("avatar.triangles", np.uint32, 3)),
        sample_file("source.joints", np.float32, 3),
        sample_file("target.joints", np.float32, 3),
        sample_file("bones", np.uint32, 2),
    )


class Case(unittest.TestCase):
    def same_bits(self, one: Array, other: Array) -> None:
        self.assertEqual((one.dtype, one.shape), (other.dtype, other.shape))
        self.assertEqual(one.tobytes(), other.tobytes())

    def refused(self, status: bespoke.Status, call: Any, *words: str) -> bespoke.BespokeError:
        """The call fails so, with a sentence that has these words."""
        with self.assertRaises(bespoke.BespokeError) as caught:
            call()
        self.assertEqual(caught.exception.status, status, caught.exception.message)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertTrue(caught.exception.message)
        return caught.exception
