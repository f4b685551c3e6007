"""Meshes and rigs of USD stages, and the result as an over: all else is kept."""

from __future__ import annotations

import importlib.util
import pathlib
import tempfile
import unittest
from typing import Any

import numpy as np

import bespoke
import scenes

TEXT = """#usda 1.0
(
    defaultPrim = "Coat"
    metersPerUnit = 0.01
    upAxis = "Y"
    customLayerData = { string studio = "ours" }
)
def Mesh "Coat" (
    customData = { int version = 7 }
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    int[] faceVertexCounts = [3, 3]
    int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)] ( interpolation = "vertex" )
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] ( interpolation = "vertex" )
    custom string note = "kept"
    rel material:binding = </Cloth>
}
def Material "Cloth" {}
def Skeleton "Skeleton"
{
    uniform token[] joints = ["Hips", "Hips/Spine", "Hips/Spine/Head"]
    uniform matrix4d[] bindTransforms = [
        ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, -1, 0, 1)),
        ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
        ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 1, 0, 1))]
}
"""


@unittest.skipUnless(importlib.util.find_spec("pxr"), "there is no usd-core")
class UsdStages(scenes.Case):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def stage(self, text: str = TEXT, name: str = "original.usda") -> Any:
        """The caller keeps it: prims end with their stage."""
        from pxr import Usd  # type: ignore[import-untyped,import-not-found,unused-ignore]

        path = self.folder / name
        path.write_text(text)
        return Usd.Stage.Open(str(path))

    def set_mesh(self, stage: Any, path: str, mesh: tuple[scenes.Array, scenes.Array]) -> Any:
        from pxr import UsdGeom, Vt  # type: ignore[import-untyped,import-not-found,unused-ignore]

        prim = UsdGeom.Mesh.Define(stage, path)
        prim.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(mesh[0])))
        prim.GetFaceVertexCountsAttr().Set([3] * len(mesh[1]))
        prim.GetFaceVertexIndicesAttr().Set(mesh[1].ravel().tolist())
        return prim

    def test_a_garment_is_dressed_and_all_else_is_kept(self) -> None:
        from pxr import Usd, UsdGeom  # type: ignore[import-untyped,import-not-found,unused-ignore]

        import bespoke.usd

        scene = scenes.tubes()
        text = TEXT.replace("normal3f[] normals", "custom normal3f[] before")
        stage = self.stage(text)
        coat = self.set_mesh(stage, "/Coat", scene.garment)
        coat.CreateNormalsAttr().Set([(0, 0, 1)] * len(scene.garment[0]))
        body = self.set_mesh(stage, "/Body", scene.avatar)
        stage.GetRootLayer().Save()
        before = (self.folder / "original.usda").read_bytes()
        output = self.folder / "results" / "dressed.usda"
        output.parent.mkdir()
        target = [bespoke.Joint(name, k - 1 if k else None, np.array([[1, 0, 0, 0], [0, 1, 0, 1.1 * (k - 1)],
                  [0, 0, 1, 0], [0, 0, 0, 1]])) for k, name in enumerate(("hips", "spine", "head"))]
        skeleton = stage.GetPrimAtPath("/Skeleton")
        dressed = bespoke.usd.dress(coat, body.GetPrim(), skeleton, target, output, threads=1)
        self.assertEqual((self.folder / "original.usda").read_bytes(), before)
        # The same as without USD.
        metres = bespoke.CoordinateSystem(metres_per_unit=0.01)
        expected = bespoke.dress(
            scene.garment, scene.avatar, bespoke.usd.read_rig(skeleton), target,
            source_coordinates=metres, target_coordinates=metres, threads=1,
        )
        self.same_bits(dressed.vertices, expected.vertices)

        opened = Usd.Stage.Open(str(output))
        result = UsdGeom.Mesh(opened.GetPrimAtPath("/Coat"))
        self.same_bits(np.array(result.GetPointsAttr().Get(), np.float32), expected.vertices)
        extent = np.array(result.GetExtentAttr().Get())
        np.testing.assert_array_equal(extent, [expected.vertices.min(axis=0), expected.vertices.max(axis=0)])
        normals = np.array(result.GetNormalsAttr().Get())
        outward = expected.vertices * np.array([1.0, 0.0, 1.0])
        self.assertGreater(np.sum(normals * outward, axis=1).min(), 0.0)
        self.assertEqual((UsdGeom.GetStageMetersPerUnit(opened), UsdGeom.GetStageUpAxis(opened)), (0.01, "Y"))
        self.assertEqual(opened.GetDefaultPrim().GetPath(), "/Coat")
        # Every other property is the original's.
        changed = {"/Coat.points", "/Coat.extent", "/Coat.normals"}
        for prim in stage.Traverse():
            other = opened.GetPrimAtPath(prim.GetPath())
            self.assertEqual(other.GetTypeName(), prim.GetTypeName())
            self.assertEqual(other.GetAllMetadata().get("customData"), prim.GetAllMetadata().get("customData"))
            self.assertEqual(other.GetPropertyNames(), prim.GetPropertyNames())
            for attribute in prim.GetAttributes():
                if str(attribute.GetPath()) not in changed:
                    self.assertEqual(other.GetAttribute(attribute.GetName()).Get(), attribute.Get())
        targets = opened.GetPrimAtPath("/Coat").GetRelationship("material:binding").GetTargets()
        self.assertEqual([str(one) for one in targets], ["/Cloth"])
        # The layer itself holds nothing else, and names the original by the way to it.
        layer = opened.GetRootLayer()
        self.assertEqual(list(layer.subLayerPaths), ["../original.usda"])
        self.assertEqual([str(one.path) for one in layer.rootPrims], ["/Coat"])
        self.assertEqual({str(one.path) for one in layer.rootPrims[0].properties}, changed)

    def test_a_garment_moves_with_the_skeleton_that_it_was_dressed_on(self) -> None:
        from pxr import Usd, UsdGeom, UsdSkel  # type: ignore[import-untyped,import-not-found,unused-ignore]

        import bespoke.usd

        scene = scenes.tubes()
        stage = self.stage(TEXT.replace('def Skeleton "Skeleton"', """def SkelRoot "Hero"
{
    def Mesh "Coat" {}
    def Mesh "Body" {}
    def Skeleton "Rig" (prepend apiSchemas = ["SkelBindingAPI"])
    {
        uniform token[] joints = ["Hips", "Hips/Spine", "Hips/Spine/Head"]
        uniform matrix4d[] bindTransforms = [
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, -1.1, 0, 1)),
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 1.1, 0, 1))]
        uniform matrix4d[] restTransforms = [
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, -1.1, 0, 1)),
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 1.1, 0, 1)),
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 1.1, 0, 1))]
        rel skel:animationSource = </Hero/Bend>
    }
    def SkelAnimation "Bend"
    {
        uniform token[] joints = ["Hips/Spine"]
        float3[] translations = [(0, 1.1, 0)]
        quatf[] rotations.timeSamples = { 0: [(1, 0, 0, 0)], 10: [(0.9659258, 0, 0, 0.2588190)] }
        half3[] scales = [(1, 1, 1)]
    }
}
def Skeleton "Skeleton\""""))
        coat = self.set_mesh(stage, "/Hero/Coat", scene.garment)
        body = self.set_mesh(stage, "/Hero/Body", scene.avatar)
        # In an order of its own, with one joint or two.
        binding = UsdSkel.BindingAPI.Apply(body.GetPrim())
        binding.CreateJointsAttr().Set(["Hips/Spine", "Hips", "Hips/Spine/Head"])
        height = np.clip(scene.avatar[0][:, 1] + 0.5, 0, 1)
        binding.CreateJointIndicesPrimvar(False, 2).Set([0, 1] * len(height))
        binding.CreateJointWeightsPrimvar(False, 2).Set(np.stack([height, 1 - height], axis=1).ravel().tolist())
        coat_binding = UsdSkel.BindingAPI.Apply(coat.GetPrim())
        coat_binding.CreateJointsAttr().Set(["Other"])
        stage.GetRootLayer().Save()
        rig = stage.GetPrimAtPath("/Hero/Rig")
        skin = bespoke.usd.read_skin(body, rig)
        assert skin is not None
        self.assertEqual(np.asarray(skin.joints)[0].tolist(), [1, 0])
        self.assertIsNone(bespoke.usd.read_skin(coat, rig))
        output = self.folder / "dressed.usda"
        dressed = bespoke.usd.dress(coat, body, stage.GetPrimAtPath("/Skeleton"), rig, output, threads=1)
        assert dressed.skin is not None

        opened = Usd.Stage.Open(str(output))
        result = UsdGeom.Mesh(opened.GetPrimAtPath("/Hero/Coat"))
        joints, weights = np.asarray(dressed.skin.joints), np.asarray(dressed.skin.weights, np.float64)
        self.assertGreater(len(np.unique(joints[weights > 0.01])), 1)
        turn = np.eye(4)
        turn[:2, :2] = [[np.sqrt(0.75), 0.5], [-0.5, np.sqrt(0.75)]]
        moves = np.stack([np.eye(4), turn, turn])
        # USD's own skinning, at the end of the bend.
        cache = UsdSkel.Cache()
        root = UsdSkel.Root(opened.GetPrimAtPath("/Hero"))
        cache.Populate(root, Usd.PrimDefaultPredicate)
        skinning = cache.GetSkinningQuery(result.GetPrim())
        query = cache.GetSkelQuery(UsdSkel.Skeleton(opened.GetPrimAtPath("/Hero/Rig")))
        self.assertTrue(skinning and query)
        points = result.GetPointsAttr().Get()
        posed = np.array(points)
        self.same_bits(posed.astype(np.float32), dressed.vertices)
        self.assertTrue(skinning.ComputeSkinnedPoints(query.ComputeSkinningTransforms(Usd.TimeCode(10)), points, Usd.TimeCode(10)))
        homogeneous = np.concatenate([posed, np.ones((len(posed), 1))], axis=1)
        expected = np.einsum("vk,vkj->vj", weights, np.einsum("vi,vkij->vkj", homogeneous, moves[joints]))[:, :3]
        self.assertLess(np.abs(np.array(points) - expected).max(), 1e-5)
        self.assertGreater(np.abs(expected - posed).max(), 0.1)
        # Without a body that is on that skeleton nothing is bound.
        for skeleton, given in ((None, dressed.skin), (rig, None), (stage.GetPrimAtPath("/Cloth"), dressed.skin)):
            with self.assertRaises(ValueError):
                bespoke.usd.write_over(coat, dressed.vertices, output, skin=given, skeleton=skeleton)
        beyond = (joints + 9, weights)
        with self.assertRaisesRegex(ValueError, "joint"):
            bespoke.usd.write_over(coat, dressed.vertices, output, skin=beyond, skeleton=rig)

    def test_meshes(self) -> None:
        from pxr import Gf, UsdGeom  # type: ignore[import-untyped,import-not-found,unused-ignore]

        import bespoke.usd

        stage = self.stage()
        coat = UsdGeom.Mesh(stage.GetPrimAtPath("/Coat"))
        coat.GetFaceVertexCountsAttr().Set([4, 3, 3])
        coat.GetFaceVertexIndicesAttr().Set([0, 1, 2, 3, 3, 2, 1, 0, 1, 3])
        coat.CreateHoleIndicesAttr().Set([1])
        mesh = bespoke.usd.read_mesh(coat)
        self.assertEqual(mesh.faces.tolist(), [[0, 1, 2], [0, 2, 3], [0, 1, 3]])
        coat.CreateOrientationAttr().Set(UsdGeom.Tokens.leftHanded)
        self.assertEqual(bespoke.usd.read_mesh(coat.GetPrim()).faces.tolist(), [[2, 1, 0], [3, 2, 0], [3, 1, 0]])
        # Where it stands in the stage, and a result that stands there.
        coat.AddTranslateOp().Set(Gf.Vec3d(1, 2, 3))
        coat.AddScaleOp().Set(Gf.Vec3f(-1, 1, 1))
        mesh = bespoke.usd.read_mesh(coat)
        np.testing.assert_array_equal(mesh.vertices[2], [0, 3, 3])
        self.assertEqual(mesh.faces[0].tolist(), [0, 1, 2])
        coat.SetNormalsInterpolation(UsdGeom.Tokens.faceVarying)
        output = self.folder / "moved.usdc"
        points = mesh.vertices + np.float32(0.1)
        bespoke.usd.write_over(coat, points, output)
        from pxr import Usd

        opened = Usd.Stage.Open(str(output))
        over = UsdGeom.Mesh(opened.GetPrimAtPath("/Coat"))
        self.same_bits(bespoke.usd.read_mesh(over).vertices, points)
        self.assertTrue(over.GetResetXformStack())
        self.assertIsNone(over.GetNormalsAttr().Get())

    def test_rigs(self) -> None:
        import bespoke.usd

        stage = self.stage()
        rig = bespoke.usd.read_rig(stage.GetPrimAtPath("/Skeleton"))
        self.assertEqual([(one.name, one.parent) for one in rig], [("Hips", None), ("Spine", 0), ("Head", 1)])
        np.testing.assert_array_equal(np.asarray(rig[0].bind)[:3, 3], [0, -1, 0])
        upright = self.stage(TEXT.replace('upAxis = "Y"', 'upAxis = "Z"'), "z.usda")
        axes = bespoke.usd.coordinate_system(upright)
        self.assertEqual(axes, bespoke.CoordinateSystem(up=bespoke.Axis.POSITIVE_Z, forward=bespoke.Axis.POSITIVE_Y,
                                                        metres_per_unit=0.01))

    def test_what_is_refused(self) -> None:
        from pxr import Usd, UsdGeom  # type: ignore[import-untyped,import-not-found,unused-ignore]

        import bespoke.usd

        stage = self.stage()
        coat, cloth = stage.GetPrimAtPath("/Coat"), stage.GetPrimAtPath("/Cloth")
        for call, words in (
            (lambda: bespoke.usd.read_mesh(cloth), "/Cloth is no mesh"),
            (lambda: bespoke.usd.read_rig(coat), "/Coat is no skeleton"),
            (lambda: bespoke.usd.write_over(coat, np.zeros((3, 3)), self.folder / "x.usda"), "4 points"),
            (lambda: bespoke.usd.write_over(coat, np.zeros((4, 3)), self.folder / "original.usda"), "not written to"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                call()
        memory = Usd.Stage.CreateInMemory()
        mesh = self.set_mesh(memory, "/Mesh", scenes.tubes().garment)
        with self.assertRaisesRegex(ValueError, "memory"):
            bespoke.usd.write_over(mesh, scenes.tubes().garment[0], self.folder / "x.usda")
        empty = UsdGeom.Mesh.Define(memory, "/Empty")
        with self.assertRaisesRegex(ValueError, "no points"):
            bespoke.usd.read_mesh(empty)
        self.assertFalse((self.folder / "x.usda").exists())


if __name__ == "__main__":
    unittest.main()
