"""From meshes to a mesh in one call."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, Union, runtime_checkable

import numpy as np
import numpy.typing as npt

from ._enums import Status
from ._errors import ImplausibleResultError, error
from ._joints import CoordinateSystem, Joint
from ._options import Options
from ._session import Session
from ._values import Diagnostic, Progress, Report

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import OptionArguments


@runtime_checkable
class HasVerticesAndFaces(Protocol):
    """What trimesh and others have."""

    @property
    def vertices(self) -> Any:
        """Shape (n, 3)."""

    @property
    def faces(self) -> Any:
        """Shape (m, 3), vertices from 0."""


MeshLike = Union[HasVerticesAndFaces, "tuple[npt.ArrayLike, npt.ArrayLike]"]
"""A mesh: anything with `.vertices`, shape (n, 3), and `.faces`, shape (m, 3), such as a `trimesh.Trimesh` or what `dress`
returns; or a pair of two such arrays."""


class Skeleton(NamedTuple):
    """Joints with bones between them."""

    joints: npt.ArrayLike
    """Shape (n, 3)."""

    bones: npt.ArrayLike
    """Shape (m, 2), joints from 0; order and direction are free."""


SkeletonLike = Union[Skeleton, "tuple[npt.ArrayLike, npt.ArrayLike]", "Sequence[Joint]"]
"""A `Skeleton`, a pair of the same arrays, or a rig: a list of `Joint`."""


class Skin(NamedTuple):
    """Skin weights, a few joints with their weights for each vertex."""

    joints: npt.ArrayLike
    """Shape (vertices, influences), from 0."""

    weights: npt.ArrayLike
    """The same shape, finite and not negative."""


@dataclasses.dataclass(frozen=True, eq=False)
class Dressed:
    """A garment on a body. It is a mesh itself: a layer for the next garment, for one."""

    vertices: npt.NDArray[Any]
    """Shape (n, 3), in the order and precision in which the garment was given, in the coordinate system and unit of the
    avatar."""

    faces: npt.NDArray[Any]
    """Shape (m, 3): the garment's own."""

    diagnostics: tuple[Diagnostic, ...]
    """What was found about the inputs and the result."""

    report: Report
    """What it took, and what the verifier has counted."""

    skin: Skin | None
    """Skin weights of the garment, four joints a vertex, on the joints of the target; None where the avatar had none."""


def dress(
    garment: MeshLike,
    avatar: MeshLike,
    source_skeleton: SkeletonLike,
    target_skeleton: SkeletonLike,
    *,
    source_avatar: MeshLike | None = None,
    skin: Skin | tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    layers: Iterable[MeshLike] = (),
    fit_weights: npt.ArrayLike | None = None,
    rigid_groups: Iterable[npt.ArrayLike] = (),
    joint_pairs: npt.ArrayLike | None = None,
    source_coordinates: CoordinateSystem | None = None,
    target_coordinates: CoordinateSystem | None = None,
    progress: Callable[[Progress], object] | None = None,
    options: Options | None = None,
    **arguments: Unpack[OptionArguments],
) -> Dressed:
    """Fits a garment that was modelled on one body to another body, with no triangle through another.

    `garment`: as it was modelled, around `source_skeleton`. `avatar`: the body to dress, around `target_skeleton`.
    Skeletons have the same joints and bones, or one of them is a rig: then names and places of the joints say which
    correspond. Optional: `source_avatar`, the body on which the garment was designed, for its clearance; `skin`, the avatar's
    skin weights on the joints of `target_skeleton`; `layers`, garments that the avatar wears already; `fit_weights`, shape
    (n,), how strongly each garment vertex is drawn to the body; `rigid_groups`, lists of garment vertices that stay rigid;
    `joint_pairs`, shape (k, 2), joints of the two rigs that correspond; the coordinate system of each side. `progress`: as in
    `Session.run`. `options`, `arguments`: as in `Session.set_options`.

    Errors: `BespokeError` with its `status`, as `Session` lists them; `InvalidInputError` for what cannot be used;
    `ImplausibleResultError`, whose `result` is what would have been returned; TypeError, where something is no mesh. Ctrl-C
    ends it within some 100 ms.

        >>> import bespoke, numpy as np
        >>> turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        >>> def tube(radius, low, high, rings=9):
        ...     y = np.linspace(low, high, rings)[:, None]
        ...     x, z = radius * np.cos(turn), radius * np.sin(turn)
        ...     vertices = np.stack(np.broadcast_arrays(x, y, z), axis=2).reshape(-1, 3)
        ...     i, j = np.mgrid[0 : rings - 1, 0:24]
        ...     a, b = i * 24 + j, i * 24 + (j + 1) % 24
        ...     faces = np.stack([[a, a + 24, b], [b, a + 24, b + 24]]).transpose(2, 3, 0, 1).reshape(-1, 3)
        ...     return vertices, faces
        >>> sleeve, arm = tube(0.12, -0.3, 0.3), tube(0.15, -0.5, 0.5)
        >>> bone = bespoke.Skeleton([[0, -0.5, 0], [0, 0, 0], [0, 0.5, 0]], [[0, 1], [1, 2]])
        >>> dressed = bespoke.dress(sleeve, arm, bone, bone, threads=1)
        >>> dressed.vertices.shape, dressed.report.avatar_intersections
        ((216, 3), 0)
        >>> bool(np.hypot(dressed.vertices[:, 0], dressed.vertices[:, 2]).min() > 0.14)
        True
    """
    vertices, faces = _mesh(garment, "garment")
    with Session(options, **arguments) as session:
        session.set_garment(vertices, faces)
        session.set_target_avatar(*_mesh(avatar, "avatar"))
        if source_coordinates is not None:
            session.set_source_coordinate_system(source_coordinates)
        if target_coordinates is not None:
            session.set_target_coordinate_system(target_coordinates)
        _set_skeleton(source_skeleton, "source_skeleton", session.set_source_rig, session.set_source_skeleton)
        joints = _set_skeleton(target_skeleton, "target_skeleton", session.set_target_rig, session.set_target_skeleton)
        if source_avatar is not None:
            session.set_source_avatar(*_mesh(source_avatar, "source_avatar"))
        if skin is not None:
            session.set_target_skin_influences(*skin, joint_count=joints)
        if joint_pairs is not None:
            session.set_joint_pairs(joint_pairs)
        if fit_weights is not None:
            session.set_vertex_fit_weights(fit_weights)
        for group in rigid_groups:
            session.add_rigid_group(group)
        for k, layer in enumerate(layers):
            session.add_layer(*_mesh(layer, f"layer {k}"))
        try:
            session.run(progress)
        except ImplausibleResultError as implausible:
            implausible.result = _result(session, faces, skin is not None)
            raise
        return _result(session, faces, skin is not None)


def _result(session: Session, faces: npt.ArrayLike, has_skin: bool) -> Dressed:
    skin = Skin(*session.read_garment_skin_influences(4)[:2]) if has_skin else None
    return Dressed(
        vertices=session.read_garment_vertices(),
        faces=np.asarray(faces),
        diagnostics=session.read_diagnostics(),
        report=session.read_report(),
        skin=skin,
    )


def _mesh(mesh: MeshLike, what: str) -> tuple[npt.ArrayLike, npt.ArrayLike]:
    if isinstance(mesh, HasVerticesAndFaces):
        return mesh.vertices, mesh.faces
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return mesh[0], mesh[1]
    raise TypeError(
        f"{what}: a mesh has .vertices and .faces, or is a pair of both, and {type(mesh).__name__} is neither"
    )


def _set_skeleton(
    skeleton: SkeletonLike,
    what: str,
    set_rig: Callable[[Sequence[Joint]], None],
    set_skeleton: Callable[[npt.ArrayLike, npt.ArrayLike], None],
) -> int:
    """How many joints it has."""
    parts: Any = skeleton
    if len(parts) > 0 and all(isinstance(joint, Joint) for joint in parts):
        set_rig(parts)
        return len(parts)
    if len(parts) == 0:
        raise error(Status.INVALID_SKELETON, f"{what}: a rig without joints")
    if len(parts) != 2:
        raise TypeError(f"{what}: joints and bones, or a list of bespoke.Joint")
    set_skeleton(parts[0], parts[1])
    return len(np.asarray(parts[0]))
