"""Garments and bodies of USD stages: what is read of their prims, and the result as an `over` in a new layer.

It needs the package `usd-core` (`pip install bespoke[usd]`), or the `pxr` of a host. Nothing of the original is written to:
the new layer has it as a sublayer and holds an opinion on the garment's points, and on what follows from them, alone.

    stage = Usd.Stage.Open("character.usda")
    garment, body = stage.GetPrimAtPath("/Coat"), stage.GetPrimAtPath("/Hero/Body")
    bespoke.usd.dress(garment, body, source_rig, stage.GetPrimAtPath("/Hero/Skeleton"), "dressed.usda")
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel, Vt  # type: ignore[import-untyped,import-not-found,unused-ignore]

from ._dress import Dressed, MeshLike, SkeletonLike, Skin
from ._dress import dress as _dress
from ._enums import Axis
from ._errors import ImplausibleResultError
from ._joints import CoordinateSystem, Joint

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import OptionArguments


class Mesh(NamedTuple):
    """The triangles of a mesh prim."""

    vertices: npt.NDArray[np.float32]
    """Shape (n, 3), in the space of the stage; the prim's own bits where it stands there untransformed."""

    faces: npt.NDArray[np.int32]
    """Shape (m, 3), vertices from 0: faces with more corners are fans, holes are left out, front faces are
    counter-clockwise."""


def read_mesh(prim: Any) -> Mesh:
    """The triangles of a `UsdGeom.Mesh`, as it stands in its stage at the default time.

    `prim`: the mesh, or its prim. Errors: ValueError, where it is no mesh, or has no points or faces.
    """
    mesh = _mesh(prim)
    points, counts, indices = (
        attribute.Get()
        for attribute in (mesh.GetPointsAttr(), mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
    )
    if not points or not counts or not indices:
        raise ValueError(f"{mesh.GetPath()} has no points or no faces at the default time")
    vertices = np.array(points, np.float32).reshape(-1, 3)
    to_stage = _to_stage(mesh)
    if to_stage is not None:
        vertices = (vertices.astype(np.float64) @ to_stage[:3, :3] + to_stage[3, :3]).astype(np.float32)
    is_left = mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded
    if to_stage is not None and np.linalg.det(to_stage[:3, :3]) < 0.0:
        is_left = not is_left
    faces = _triangles(np.array(counts), np.array(indices), np.array(mesh.GetHoleIndicesAttr().Get() or [], np.int64))
    return Mesh(vertices, faces[:, ::-1] if is_left else faces)


def read_rig(prim: Any) -> list[Joint]:
    """The joints of a `UsdSkel.Skeleton` in their bind pose, in the order of the skeleton.

    `prim`: the skeleton, or its prim. Errors: ValueError, where it is no skeleton, or has no bind transform for each joint.
    """
    skeleton = UsdSkel.Skeleton(prim)
    if not skeleton:
        raise ValueError(f"{prim.GetPath()} is no skeleton")
    joints = list(skeleton.GetJointsAttr().Get() or [])
    binds = skeleton.GetBindTransformsAttr().Get() or []
    if not joints or len(binds) != len(joints):
        raise ValueError(f"{prim.GetPath()} has {len(joints)} joints and {len(binds)} bind transforms")
    parents = UsdSkel.Topology(joints).GetParentIndices()
    # A vector is a row in USD.
    return [
        Joint(str(joint).rsplit("/", 1)[-1], parent if parent >= 0 else None, np.array(bind, np.float64).T)
        for joint, parent, bind in zip(joints, parents, binds)
    ]


def read_skin(prim: Any, skeleton: Any) -> Skin | None:
    """The skin weights of a mesh on the joints of a skeleton, in the order of that; None where the mesh has none.

    `prim`: the mesh, or its prim. `skeleton`: the skeleton, or its prim. One joint for all of the mesh (constant
    interpolation) is so for each vertex. Errors: ValueError, where the mesh names joints that the skeleton does not have, or
    has not as many influences as points.
    """
    mesh, skeleton = _mesh(prim), UsdSkel.Skeleton(skeleton)
    binding = UsdSkel.BindingAPI(mesh)
    indices, weights = binding.GetJointIndicesPrimvar(), binding.GetJointWeightsPrimvar()
    if not indices or not weights or not indices.HasValue() or not weights.HasValue():
        return None
    width = indices.GetElementSize()
    rows = [np.array(primvar.ComputeFlattened(), kind) for primvar, kind in ((indices, np.int64), (weights, np.float32))]
    count = len(mesh.GetPointsAttr().Get() or [])
    if width < 1 or weights.GetElementSize() != width or any(len(row) not in (width, count * width) for row in rows):
        raise ValueError(f"{mesh.GetPath()} has not {width} joints with weights for each of {count} points")
    joints, shares = (np.broadcast_to(row.reshape(-1, width), (count, width)).copy() for row in rows)
    known = [str(joint) for joint in skeleton.GetJointsAttr().Get() or []]
    order = [str(joint) for joint in binding.GetJointsAttr().Get() or known]
    missing = next((joint for joint in order if joint not in known), None)
    if missing is not None or joints.size and not 0 <= joints.min() <= joints.max() < len(order):
        what = f"the joint {missing}" if missing is not None else f"{len(order)} joints and an index beyond"
        raise ValueError(f"{mesh.GetPath()} is on {what}, which {skeleton.GetPath()} does not have")
    place = np.array([known.index(joint) for joint in order], np.uint32)
    return Skin(place[joints] if joints.size else joints.astype(np.uint32), shares)


def coordinate_system(stage: Any) -> CoordinateSystem:
    """The one of a stage: its up axis and its metres a unit; z up is seen along +y."""
    up = UsdGeom.GetStageUpAxis(stage)
    metres = UsdGeom.GetStageMetersPerUnit(stage)
    if up == UsdGeom.Tokens.z:
        return CoordinateSystem(up=Axis.POSITIVE_Z, forward=Axis.POSITIVE_Y, metres_per_unit=metres)
    return CoordinateSystem(metres_per_unit=metres)


def write_over(
    prim: Any,
    vertices: npt.ArrayLike,
    output: str | os.PathLike[str],
    *,
    skin: Skin | tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    skeleton: Any = None,
) -> None:
    """Writes a new layer over the stage of a mesh, in which the mesh has other points.

    `prim`: the mesh, or its prim. `vertices`: shape (n, 3), as many as it has, in the space of the stage; they are written
    as float32, bit by bit, so a mesh that stands transformed in its stage does not in the new layer
    (`!resetXformStack!`). `output`: the file, .usda, .usdc or .usd, which replaces another one. Its sublayer is the root
    layer of the stage. With the points come their extent and, where the mesh has normals a vertex, these; other normals are
    blocked, so that they are computed. `skin` and `skeleton`, both or none: skin weights on the joints of a skeleton of that stage,
    bound in the pose of the vertices; the mesh is then bound to it, and moves with it where it is below a SkelRoot. Errors:
    ValueError, where it is no mesh, has another number of points, or is part of an instance; where the skeleton is none of the
    stage, or the weights are not as many as the points; where the stage is in memory alone, or `output` is its own file.
    """
    mesh = _mesh(prim)
    points = np.ascontiguousarray(vertices, np.float32)
    count = len(mesh.GetPointsAttr().Get() or [])
    if points.shape != (count, 3):
        raise ValueError(f"{mesh.GetPath()} has {count} points, and these are of shape {points.shape}")
    if mesh.GetPrim().IsInstanceProxy():
        raise ValueError(f"{mesh.GetPath()} is part of an instance, which no layer can change alone: switch off its instancing")
    output = os.path.abspath(os.fspath(output))
    original = mesh.GetPrim().GetStage().GetRootLayer()
    if original.realPath and os.path.realpath(output) == os.path.realpath(original.realPath):
        raise ValueError(f"{output} is the original, which is not written to")
    bound = _bound(mesh, count, skin, skeleton)
    # A layer of this name that is open somewhere is not changed beneath its user.
    layer = Sdf.Layer.CreateAnonymous(os.path.basename(output))
    layer.subLayerPaths.append(_place(original, os.path.dirname(output)))
    for name in ("upAxis", "metersPerUnit", "defaultPrim", "startTimeCode", "endTimeCode", "timeCodesPerSecond"):
        if original.pseudoRoot.HasInfo(name):
            layer.pseudoRoot.SetInfo(name, original.pseudoRoot.GetInfo(name))
    over = Sdf.CreatePrimInLayer(layer, mesh.GetPath())
    _write(over, mesh.GetPointsAttr(), Vt.Vec3fArray.FromNumpy(points))
    extent = np.stack([points.min(axis=0), points.max(axis=0)])
    _write(over, mesh.GetExtentAttr(), Vt.Vec3fArray.FromNumpy(extent))
    if _to_stage(mesh) is not None:
        _write(over, mesh.GetXformOpOrderAttr(), Vt.TokenArray([UsdGeom.XformOpTypes.resetXformStack]))
    _write_normals(mesh, over, points)
    if bound is not None:
        _write_skin(mesh, over, *bound)
    if not layer.Export(output):
        raise OSError(f"{output} cannot be written")


def dress(
    garment: Any,
    avatar: Any,
    source_skeleton: SkeletonLike | Any,
    target_skeleton: SkeletonLike | Any,
    output: str | os.PathLike[str],
    *,
    source_avatar: Any = None,
    layers: Sequence[Any] = (),
    **arguments: Unpack[OptionArguments],
) -> Dressed:
    """Dresses one prim in another, and writes the result as `write_over` does.

    `garment`, `avatar`, `source_avatar`, `layers`: meshes, or prims of such; all but the garment may be what `bespoke.dress`
    takes for a mesh, too. The skeletons: prims of skeletons, or what `bespoke.dress` takes. The coordinate systems are those of
    the stages. The result is in the space of the avatar's stage. Where the avatar has skin weights on the target skeleton, these
    take part, and where both are in the garment's stage too, the result is bound to that skeleton with weights of its own, see
    `write_over`. A result that is not as designed is written nevertheless, and
    then is an error. Errors: as for `bespoke.dress` and `write_over`.
    """
    source = coordinate_system(_mesh(garment).GetPrim().GetStage())
    target = coordinate_system(avatar.GetPrim().GetStage()) if hasattr(avatar, "GetPrim") else source
    rig: Any = target_skeleton if hasattr(avatar, "GetPath") and hasattr(target_skeleton, "GetPath") else None
    skin = None if rig is None else read_skin(avatar, rig)
    stage = _mesh(garment).GetPrim().GetStage()
    own = rig if skin is not None and rig.GetPrim().GetStage() == stage else None
    try:
        dressed = _dress(
            read_mesh(garment),
            _mesh_like(avatar),
            _skeleton_like(source_skeleton),
            _skeleton_like(target_skeleton),
            source_avatar=None if source_avatar is None else _mesh_like(source_avatar),
            layers=[_mesh_like(layer) for layer in layers],
            skin=skin,
            source_coordinates=source,
            target_coordinates=target,
            **arguments,
        )
    except ImplausibleResultError as implausible:
        if implausible.result is not None:
            _write_dressed(garment, implausible.result, output, own)
        raise
    _write_dressed(garment, dressed, output, own)
    return dressed


def _write_dressed(garment: Any, dressed: Dressed, output: str | os.PathLike[str], skeleton: Any) -> None:
    is_bound = skeleton is not None and dressed.skin is not None
    write_over(
        garment,
        dressed.vertices,
        output,
        skin=dressed.skin if is_bound else None,
        skeleton=skeleton if is_bound else None,
    )


def _bound(
    mesh: Any, count: int, skin: Any, skeleton: Any
) -> tuple[Any, npt.NDArray[np.int32], npt.NDArray[np.float32]] | None:
    """Skeleton, joints and weights of a mesh with so many points, checked."""
    if skin is None and skeleton is None:
        return None
    if skin is None or skeleton is None:
        raise ValueError("skin weights are on the joints of a skeleton: give both, or neither")
    rig = UsdSkel.Skeleton(skeleton)
    if not rig or rig.GetPrim().GetStage() != mesh.GetPrim().GetStage():
        raise ValueError(f"{skeleton.GetPath()} is no skeleton of the stage that {mesh.GetPath()} is in")
    joints, weights = np.ascontiguousarray(skin[0], np.int32), np.ascontiguousarray(skin[1], np.float32)
    if joints.ndim != 2 or joints.shape != weights.shape or len(joints) != count or joints.shape[1] < 1:
        raise ValueError(f"{mesh.GetPath()} has {count} points; joints are of shape {joints.shape}, weights {weights.shape}")
    names = rig.GetJointsAttr().Get() or []
    if joints.size and not 0 <= joints.min() <= joints.max() < len(names):
        raise ValueError(f"a weight is on joint {joints.max()}, and {rig.GetPath()} has {len(names)}")
    return rig, joints, weights


def _write_skin(mesh: Any, over: Any, skeleton: Any, joints: npt.NDArray[np.int32], weights: npt.NDArray[np.float32]) -> None:
    """Binds the mesh to a skeleton with points that stand in the stage as the skeleton was bound."""
    schemas = Sdf.TokenListOp()
    schemas.prependedItems = ["SkelBindingAPI"]
    over.SetInfo("apiSchemas", schemas)
    target = Sdf.RelationshipSpec(over, "skel:skeleton", custom=False)
    target.targetPathList.explicitItems = [skeleton.GetPath()]
    types = Sdf.ValueTypeNames
    for name, kind, values in (
        ("primvars:skel:jointIndices", types.IntArray, Vt.IntArray.FromNumpy(joints.ravel())),
        ("primvars:skel:jointWeights", types.FloatArray, Vt.FloatArray.FromNumpy(weights.ravel())),
    ):
        spec = Sdf.AttributeSpec(over, name, kind)
        spec.SetInfo("interpolation", UsdGeom.Tokens.vertex)
        spec.SetInfo("elementSize", joints.shape[1])
        spec.default = values
    Sdf.AttributeSpec(over, "primvars:skel:geomBindTransform", types.Matrix4d).default = Gf.Matrix4d(1.0)
    # Joints of its own were those of another skeleton.
    if UsdSkel.BindingAPI(mesh).GetJointsAttr().HasAuthoredValue():
        uniform = Sdf.VariabilityUniform
        Sdf.AttributeSpec(over, "skel:joints", types.TokenArray, uniform).default = Sdf.ValueBlock()


def _mesh(prim: Any) -> Any:
    mesh = UsdGeom.Mesh(prim)
    if not mesh:
        raise ValueError(f"{prim.GetPath()} is no mesh")
    return mesh


def _mesh_like(mesh: Any) -> MeshLike:
    return read_mesh(mesh) if hasattr(mesh, "GetPath") else mesh


def _skeleton_like(skeleton: Any) -> SkeletonLike:
    return read_rig(skeleton) if hasattr(skeleton, "GetPath") else skeleton


def _to_stage(mesh: Any) -> npt.NDArray[np.float64] | None:
    """Rows times this are in the space of the stage; None where they are already."""
    matrix = UsdGeom.Xformable(mesh).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
    return None if matrix == Gf.Matrix4d(1.0) else np.array(matrix, np.float64)


def _triangles(
    counts: npt.NDArray[Any], indices: npt.NDArray[Any], holes: npt.NDArray[Any]
) -> npt.NDArray[np.int32]:
    begins = np.cumsum(counts) - counts
    fans = np.maximum(counts - 2, 0)
    fans[holes] = 0
    begin = np.repeat(begins, fans)
    # The number of each triangle within its fan.
    k = np.arange(len(begin)) - np.repeat(np.cumsum(fans) - fans, fans)
    return np.stack([indices[begin], indices[begin + k + 1], indices[begin + k + 2]], axis=1).astype(np.int32)


def _write_normals(mesh: Any, over: Any, points: npt.NDArray[np.float32]) -> None:
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
    attributes = [(mesh.GetNormalsAttr(), mesh.GetNormalsInterpolation())]
    if primvar:
        attributes.append((primvar.GetAttr(), primvar.GetInterpolation()))
    for attribute, interpolation in attributes:
        values = attribute.Get() if attribute else None
        if values is None:
            continue
        is_of_vertices = interpolation in (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying) and len(values) == len(points)
        new = Vt.Vec3fArray.FromNumpy(_normals(mesh, points)) if is_of_vertices else Sdf.ValueBlock()
        _write(over, attribute, new)


def _write(over: Any, attribute: Any, value: Any) -> None:
    """An opinion of the layer on an attribute, for every time."""
    uniform = attribute.GetVariability()
    Sdf.AttributeSpec(over, attribute.GetName(), attribute.GetTypeName(), uniform).default = value


def _normals(mesh: Any, points: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
    """Of vertices: the mean of their triangles', by area."""
    faces = read_mesh(mesh).faces
    corners = points.astype(np.float64)[faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros(points.shape)
    for corner in range(3):
        np.add.at(sums, faces[:, corner], areas)
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    normals: npt.NDArray[np.float64] = np.divide(sums, lengths, out=np.zeros_like(sums), where=lengths > 0.0)
    return normals.astype(np.float32)


def _place(layer: Any, folder: str) -> str:
    """How a layer in this folder names it: by the way there, so that both can be moved together."""
    if not layer.realPath:
        raise ValueError("the stage is in memory alone: save it first, for the new layer is over its file")
    try:
        way = os.path.relpath(layer.realPath, os.path.realpath(folder)).replace(os.sep, "/")
    except ValueError:
        # On another drive.
        return str(layer.realPath)
    return way if way.startswith("../") else f"./{way}"
