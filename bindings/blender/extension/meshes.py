"""From Blender's meshes to arrays.

All is taken in the rest pose, with every modifier but those that pose, hide or simulate: what an artist sees, standing
as the armature was built.
"""

from __future__ import annotations

import contextlib
import dataclasses
from collections.abc import Iterator, Sequence
from typing import Any

import bpy
import mathutils
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

# Modifiers that are not part of the shape that was modelled.
LEFT_OUT = ("ARMATURE", "MASK", "CLOTH", "SOFT_BODY", "COLLISION", "SURFACE", "PARTICLE_SYSTEM")


class SceneError(Exception):
    """Something in the scene that cannot be used. Says what, and what to do."""


@dataclasses.dataclass
class Mesh:
    """A mesh of an object."""

    object: bpy.types.Object
    vertices: Array
    """Shape (n, 3), float64, in the space that was asked for."""
    triangles: Array
    """Shape (m, 3), uint32."""
    polygons: Array
    """Shape (m,): the polygon that each triangle belongs to."""
    groups: list[list[tuple[int, float]]]
    """For each vertex its vertex groups with their weights."""
    is_base: bool
    """Whether these are the vertices that edit mode shows."""


def rest_matrix(thing: bpy.types.Object) -> mathutils.Matrix:
    """The transform of an object while all armatures are in their rest pose."""
    above = thing
    while above is not None and above.parent_type != "BONE":
        above = above.parent
    # Nothing on the way up moves with a pose.
    if above is None or thing.parent is None:
        return thing.matrix_world.copy()
    place = rest_matrix(thing.parent)
    if thing.parent_type == "BONE" and thing.parent.type == "ARMATURE":
        bone = thing.parent.data.bones.get(thing.parent_bone)
        if bone is not None and not bone.use_relative_parent:
            place = place @ bone.matrix_local @ mathutils.Matrix.Translation((0.0, bone.length, 0.0))
    return place @ thing.matrix_parent_inverse @ thing.matrix_basis


@contextlib.contextmanager
def as_modelled(things: Sequence[bpy.types.Object]) -> Iterator[bpy.types.Depsgraph]:
    """Without the modifiers that are left out."""
    off = [m for thing in things for m in thing.modifiers if m.type in LEFT_OUT and m.show_viewport]
    for modifier in off:
        modifier.show_viewport = False
    try:
        # What is edited is in the mesh only once it is asked for.
        for thing in things:
            if thing.mode == "EDIT":
                thing.update_from_editmode()
        yield bpy.context.evaluated_depsgraph_get()
    finally:
        for modifier in off:
            modifier.show_viewport = True


def shaping(thing: bpy.types.Object) -> list[bpy.types.Modifier]:
    """The modifiers that are part of the shape."""
    return [m for m in thing.modifiers if m.type not in LEFT_OUT and m.show_viewport]


def has_morphs(thing: bpy.types.Object) -> bool:
    """Whether there are shape keys beside the basis."""
    return thing.data.shape_keys is not None and len(thing.data.shape_keys.key_blocks) > 1


@contextlib.contextmanager
def evaluated(thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Iterator[bpy.types.Mesh]:
    """The mesh with its modifiers and the mix of its shape keys, for as long as it is looked at."""
    mesh = bpy.data.meshes.new_from_object(
        thing.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
    )
    try:
        yield mesh
    finally:
        bpy.data.meshes.remove(mesh)


def array(mesh: bpy.types.Mesh) -> Array:
    """The vertices of a mesh as they are stored, shape (n, 3), float32."""
    numbers = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", numbers)
    return numbers.reshape(-1, 3)


def shape(key: bpy.types.ShapeKey) -> Array:
    """The vertices of a shape key, shape (n, 3), float64."""
    numbers = np.empty(3 * len(key.data), np.float32)
    key.data.foreach_get("co", numbers)
    return numbers.reshape(-1, 3).astype(np.float64)


def moved(points: Array, matrix: mathutils.Matrix) -> Array:
    """Points by a matrix, float64."""
    numbers = np.array(matrix, np.float64)
    return points.astype(np.float64) @ numbers[:3, :3].T + numbers[:3, 3]


def read(thing: bpy.types.Object, mesh: bpy.types.Mesh, frame: mathutils.Matrix) -> Mesh:
    """A mesh of an object, in the space that `frame` leads to from the world."""
    if not mesh.polygons:
        raise SceneError(f"{thing.name}: it has no faces; take it off the list")
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    corners, polygons = np.empty(3 * count, np.int32), np.empty(count, np.int32)
    mesh.loop_triangles.foreach_get("vertices", corners)
    mesh.loop_triangles.foreach_get("polygon_index", polygons)
    matrix = rest_matrix(thing)
    triangles = corners.reshape(-1, 3).astype(np.uint32)
    if matrix.determinant() < 0.0:
        # A mirrored object shows its faces the other way round.
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    return Mesh(
        object=thing,
        vertices=moved(array(mesh), frame @ matrix),
        triangles=triangles,
        polygons=polygons,
        groups=[[(g.group, g.weight) for g in vertex.groups if g.weight > 0.0] for vertex in mesh.vertices],
        is_base=len(mesh.vertices) == len(thing.data.vertices) and not shaping(thing),
    )


def group_weights(mesh: Mesh, name: str) -> Array:
    """The weights of one vertex group, shape (n,)."""
    group = mesh.object.vertex_groups.get(name)
    if group is None:
        raise SceneError(f"{mesh.object.name}: it has no vertex group {name!r}; choose one that it has, or none")
    weights = np.zeros(len(mesh.vertices), np.float64)
    for vertex, groups in enumerate(mesh.groups):
        for index, weight in groups:
            if index == group.index:
                weights[vertex] = weight
    return weights


def islands(vertices: Array, triangles: Array) -> list[Array]:
    """The connected pieces of those vertices, by triangles that have two or more of them."""
    above = {int(v): int(v) for v in vertices}

    def root(v: int) -> int:
        while above[v] != v:
            above[v] = above[above[v]]
            v = above[v]
        return v

    for corners in triangles:
        inside = [int(v) for v in corners if int(v) in above]
        for v in inside[1:]:
            above[root(v)] = root(inside[0])
    pieces: dict[int, list[int]] = {}
    for v in above:
        pieces.setdefault(root(v), []).append(v)
    return [np.array(sorted(piece), np.uint32) for piece in pieces.values()]


@contextlib.contextmanager
def basis(thing: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """The mesh as it is without modifiers and shape keys, for as long as it is looked at."""
    mesh = thing.data.copy()
    try:
        if mesh.shape_keys is not None:
            numbers = np.empty(3 * len(mesh.vertices), np.float32)
            mesh.shape_keys.reference_key.data.foreach_get("co", numbers)
            mesh.vertices.foreach_set("co", numbers)
        yield mesh
    finally:
        bpy.data.meshes.remove(mesh)
