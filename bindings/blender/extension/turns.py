"""How a surface has turned and grown: for the shape keys of what goes along with a garment. Knows nothing of Blender."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]


def turns(triangles: Array, before: Array, after: Array) -> Array:
    """For each vertex the turn and growth of the triangles around it, shape (n, 3, 3); the identity where there are none.
    Vertices in one place turn alike."""
    _, place = np.unique(before, axis=0, return_inverse=True)
    place = place.reshape(-1)
    corners = place[triangles]
    (was, grown), (now, size) = (_frames(triangles, corners, points) for points in (before, after))
    with np.errstate(divide="ignore", invalid="ignore"):
        moved = np.einsum("vki,vkj->vij", now, was) * np.sqrt(size / grown)[:, None, None]
    known = np.isfinite(moved).all(axis=(1, 2))
    moved[~known] = np.eye(3)
    return moved[place]


def turned(moved: Array, offsets: Array) -> Array:
    """Offsets of vertices, turned and grown so."""
    return np.einsum("vij,vj->vi", moved, offsets)


def _frames(triangles: Array, corners: Array, points: Array) -> tuple[Array, Array]:
    """Axes of the surface at each place, as rows, and the area around it: not finite where there is none."""
    count = int(corners.max()) + 1
    corner = points.astype(np.float64)[triangles]
    across = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normals, areas, along = np.zeros((count, 3)), np.zeros(count), np.zeros((count, 3))
    for k in range(3):
        np.add.at(normals, corners[:, k], across)
        np.add.at(areas, corners[:, k], np.linalg.norm(across, axis=1))
    # The edge of one triangle, the same one before and after: a turn around the normal is seen by it.
    for k in range(3):
        along[corners[::-1, k]] = (corner[:, (k + 1) % 3] - corner[:, k])[::-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        along -= (along * normals).sum(axis=1, keepdims=True) * normals
        along /= np.linalg.norm(along, axis=1, keepdims=True)
    return np.stack([along, np.cross(normals, along), normals], axis=1), areas
