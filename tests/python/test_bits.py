"""The same bits as in Rust, and as the program in C writes them."""

from __future__ import annotations

import os
import pathlib
import unittest

import numpy as np

import bespoke
import scenes


def read_obj(path: pathlib.Path) -> tuple[scenes.Array, scenes.Array, scenes.Array]:
    """Vertices as float32, triangles, lines."""
    lines = [line.split() for line in path.read_text().splitlines()]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], np.float32)
    faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]]
    bones = [[int(word) - 1 for word in line[1:]] for line in lines if line[:1] == ["l"]]
    return vertices, np.array(faces, np.uint32), np.array(bones, np.uint32)


class Bits(scenes.Case):
    def test_sample_with_all_that_is_optional(self) -> None:
        with scenes.sample().session() as session:
            session.set_source_avatar(
                scenes.sample_file("source.positions", np.float32, 3), scenes.sample_file("source.triangles", np.uint32, 3)
            )
            joints = len(scenes.sample_file("target.joints", np.float32, 3))
            skin = scenes.sample_file("skin", np.float32, None).reshape(joints, -1)
            session.set_target_skin_weights(skin)
            session.set_no_fit_vertices(scenes.sample_file("no_fit", np.uint32, None))
            session.run()
            report = session.read_report()
            self.assertTrue(report.is_verified)
            self.assertEqual(report.avatar_intersections, 0)
            counted = session.verify()
            self.assertEqual((counted.garment_avatar, counted.garment_garment), (0, counted.initial))
            dressed = session.read_garment_vertices()
            self.same_bits(dressed, scenes.sample_file("dressed", np.float32, 3))
            # The body is where it was set, and the garment moves with it.
            self.same_bits(session.read_avatar_vertices(), scenes.sample().avatar[0])
            influences, weights, count = session.read_garment_skin_influences(4)
            self.assertEqual((influences.shape, weights.shape, count), ((len(dressed), 4), (len(dressed), 4), joints))
            np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-6)
            self.assertTrue((np.diff(weights, axis=1) <= 0).all() and influences.max() < joints)
            self.assertEqual(session.read_added_joints(), ())
            distortion = session.read_distortion()
            self.assertEqual(distortion.shape, (report.garment_triangles,))
            self.assertTrue((distortion >= 0).all())
            names = [energy.name for energy in session.read_energies()]
            self.assertIn("surface", names)

    def test_files_of_the_program_in_c(self) -> None:
        folder = os.environ.get("BESPOKE_RETARGETED")
        if not folder:
            self.skipTest("tests/python/main.rs runs retarget, and names its files in BESPOKE_RETARGETED")
        read = {name: read_obj(pathlib.Path(folder, f"{name}.obj")) for name in
                ("garment", "source", "avatar", "target", "dressed")}
        dressed = bespoke.dress(
            read["garment"][:2],
            read["avatar"][:2],
            bespoke.Skeleton(read["source"][0], read["source"][2]),
            bespoke.Skeleton(read["target"][0], read["target"][2]),
        )
        self.same_bits(dressed.vertices, read["dressed"][0])


if __name__ == "__main__":
    unittest.main()
