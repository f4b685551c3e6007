"""A session: one garment on its way to one avatar."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from ._enums import Stage, Status, _Component
from ._errors import error
from ._handle import Control, Handle
from ._joints import AddedJoint, CoordinateSystem, Joint, MappedJoint, matrices, rig
from ._library import load
from ._native import (
    BESPOKE_NO_LAYER,
    BESPOKE_TRANSFORM_SIZE,
    BespokeAddedJoint,
    BespokeEnergy,
    BespokeIntersections,
    BespokeMappedJoint,
    BespokeOptions,
    BespokePoseIntersections,
    BespokeReport,
    BespokeWornPair,
)
from ._options import Options
from ._values import Diagnostic, Energy, Intersections, PoseIntersections, Progress, Report, WornPair

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import OptionArguments
    from ._shared import Avatar, Garment

# Time between two reports: a person sees it move, and nobody is kept busy by it.
_REPORT_MILLISECONDS = 50

_POINTS = "(n, 3)"
_LIST = "(n,)"


class Session:
    """The fitting of one garment to one avatar.

    `set_garment`, `set_source_skeleton`, `set_target_avatar`, `set_target_skeleton`, then `run` (or `prepare` and `step`),
    then `read_garment_vertices`. All else is optional. With rigs (`set_source_rig`, `set_target_rig`) in place of the
    skeletons, nothing has to correspond.

        with bespoke.Session(threads=4) as session:
            session.set_garment(vertices, triangles)
            ...
            session.run()
            fitted = session.read_garment_vertices()

    Arrays are anything that NumPy takes for one. They are read during the call only, and without a copy where their memory
    allows it: float32 or float64, uint16, uint32 or int32, the numbers of a row one after the other, rows at any positive
    distance; read-only is fine. All else is copied first, such as int64 or Fortran's order. A wrong shape, or numbers of the
    wrong kind, are an `InvalidInputError`, as all that the library refuses.

    Errors: what a call may fail with is listed without its class; it is the `status` of a `BespokeError`. Besides, every
    call may fail with BUSY, INVALID_STATE (each says in which stages it can be called) and INTERNAL (a defect of the
    library; the session can only be closed), and every call after `close` is a ValueError. A call that failed because of its
    arguments or of the state has changed nothing.

    Threads: from any thread, but one call at a time; a second one while the first runs fails with BUSY at once and does
    nothing. `cancel`, `read_progress`, `stage`, `last_message`, `create_control` and `close` may be called at any time.
    Different sessions are independent, and all calls free the interpreter for other threads. Ctrl-C, as any exception of a
    signal handler, cancels `prepare`, `step`, `run` and `verify` within some 100 ms.

    A session that is forgotten is closed. A process that was forked cannot use the sessions of its parent; with
    multiprocessing take the start method "spawn".
    """

    def __init__(self, options: Options | None = None, **arguments: Unpack[OptionArguments]) -> None:
        """An empty session.

        `options`, `arguments`: as for `set_options`. Errors: INVALID_ARGUMENT (an option out of its range); ImportError, where
        there is no native library, or one of another binary interface.
        """
        self._handle = Handle()
        self._vertices = 0
        self._triangles = 0
        self._dtype: np.dtype[Any] = np.dtype(np.float64)
        if options is not None or arguments:
            self.set_options(options, **arguments)

    def close(self) -> None:
        """Ends the session and frees all that it holds; a second time does nothing.

        A call that runs in another thread is cancelled first. Controls stay usable.
        """
        self._handle.close()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        try:
            return f"<bespoke.Session {self.stage.name}>"
        except ValueError:
            return "<bespoke.Session closed>"

    def reset(self) -> None:
        """Takes the session back to SETUP: inputs, coordinate systems and options stay, results and a request to cancel are
        dropped. It waits for work that a cancelled call has left. Stage: any.
        """
        self._handle.call("bespoke_session_reset")

    # What is shared. It needs the stage SETUP.

    def use_avatar(self, avatar: Avatar) -> None:
        """Dresses a shared avatar, which takes the place of all that was set of a target.

        What is set of the target afterwards holds for this session alone, and another target avatar ends the sharing.
        Stage: SETUP.
        """
        avatar._give(self)

    def use_garment(self, garment: Garment) -> None:
        """Fits a shared garment, which takes the place of all that was set of a garment and its source.

        What is set of them afterwards holds for this session alone, and another garment ends the sharing. Stage: SETUP.
        """
        garment._give(self)
        self._vertices, self._triangles, self._dtype = garment._shape

    # What is set. All of it needs the stage SETUP.

    def set_garment(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """The garment as it was modelled, enclosing the source skeleton. It may be open and in pieces.

        `vertices`: shape (n, 3), in the source's unit; the result is verified in this precision, float32 or else float64.
        `triangles`: shape (m, 3), vertices from 0. A second call replaces the first. Stage: SETUP. Errors: INVALID_ARGUMENT,
        INVALID_MESH (no vertices, no triangles, an index out of range, a coordinate that is not finite).
        """
        points, corners = self._mesh("set_garment", vertices, triangles, "garment")
        self._vertices, self._triangles = points.native.count, corners.native.count
        self._dtype = points.array.dtype

    def set_source_skeleton(self, joints: npt.ArrayLike, bones: npt.ArrayLike) -> None:
        """The skeleton that the garment was modelled around, in the coordinate system of the garment.

        `joints`: shape (n, 3). `bones`: shape (m, 2), joints from 0; order and direction are free. Stage: SETUP. Errors:
        INVALID_ARGUMENT, INVALID_SKELETON.
        """
        self._skeleton("source", joints, bones)

    def set_target_avatar(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """The body to dress. It may be open, non-manifold, in pieces, and may intersect itself.

        `vertices`: shape (n, 3), in the target's unit. `triangles`: shape (m, 3), vertices from 0. Stage: SETUP. Errors:
        INVALID_ARGUMENT, INVALID_MESH.
        """
        self._mesh("set_target_avatar", vertices, triangles, "target avatar")

    def set_target_skeleton(self, joints: npt.ArrayLike, bones: npt.ArrayLike) -> None:
        """The skeleton of the body to dress, in its coordinate system and in the pose of the source skeleton. Joint i
        corresponds to joint i of the source skeleton, and the same pairs of joints are bones.

        `joints`, `bones`: as for `set_source_skeleton`. Stage: SETUP. Errors: INVALID_ARGUMENT, INVALID_SKELETON (another
        topology is found by `prepare`).
        """
        self._skeleton("target", joints, bones)

    def set_source_avatar(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """Optional: the body on which the garment was designed, in the coordinate system of the garment. With it, the fit
        aims at the clearance of the design.

        `vertices`: shape (n, 3). `triangles`: shape (m, 3), vertices from 0. Stage: SETUP. Errors: INVALID_ARGUMENT,
        INVALID_MESH.
        """
        self._mesh("set_source_avatar", vertices, triangles, "source avatar")

    def set_target_skin_weights(self, rows: npt.ArrayLike) -> None:
        """Optional: skin weights of the target avatar as a full matrix. They assign each vertex to the joint with its largest
        weight. Without them, and for a vertex whose weights are all 0, the nearest bone decides.

        `rows`: shape (joints, vertices), finite and not negative; those of a vertex need not sum to 1. A matrix of
        (vertices, joints) is handed over as its transpose, `weights.T`. Stage: SETUP. Errors: INVALID_ARGUMENT,
        INVALID_WEIGHTS (a wrong size is found by `prepare`).
        """
        view, vertices = arrays.rows(rows, "skin weights", "(joints, vertices)")
        self._handle.call("bespoke_session_set_target_skin_weights", view.pointer, vertices)

    def set_target_skin_influences(self, joints: npt.ArrayLike, weights: npt.ArrayLike, joint_count: int) -> None:
        """Optional: skin weights of the target avatar as engines keep them, a few joints with their weights for each vertex.

        `joints`: shape (vertices, influences), from 0. `weights`: the same shape, finite and not negative; those of a joint
        that is listed twice are added, and one with weight 0 is ignored. `joint_count`: joints of the target skeleton or
        rig. It replaces what `set_target_skin_weights` has set. Stage: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a
        wrong size is found by `prepare`).
        """
        self._influences("target", joints, weights, joint_count, "target skin")

    def set_source_skin_influences(self, joints: npt.ArrayLike, weights: npt.ArrayLike, joint_count: int) -> None:
        """Optional: skin weights of the source avatar on the source rig. They tell which of its joints move nothing, and
        where the top of the head is in a rig that has no joint there.

        `joints`, `weights`, `joint_count`: as for `set_target_skin_influences`, of the source avatar and the source rig.
        Stage: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size is found by `prepare`).
        """
        self._influences("source", joints, weights, joint_count, "source skin")

    def set_garment_skin_influences(self, joints: npt.ArrayLike, weights: npt.ArrayLike, joint_count: int) -> None:
        """Optional: skin weights of the garment as it was modelled, on the source rig.

        `joints`, `weights`, `joint_count`: as for `set_target_skin_influences`, of the garment and the source rig. Stage:
        SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size is found by `prepare`).
        """
        self._influences("garment", joints, weights, joint_count, "garment skin")

    def set_source_coordinate_system(self, coordinate_system: CoordinateSystem) -> None:
        """Optional: the coordinate system of garment, source skeleton and source avatar; by default right-handed, in metres,
        y up.

        Stage: SETUP. Errors: INVALID_ARGUMENT (two axes along one coordinate, a unit outside [1e-9, 1e9] metres).
        """
        native = coordinate_system._to_native()
        self._handle.call("bespoke_session_set_source_coordinate_system", ctypes.byref(native))

    def set_target_coordinate_system(self, coordinate_system: CoordinateSystem) -> None:
        """Optional: the coordinate system of target avatar and target skeleton, and so of the vertices that are read.

        Stage, errors: as for `set_source_coordinate_system`.
        """
        native = coordinate_system._to_native()
        self._handle.call("bespoke_session_set_target_coordinate_system", ctypes.byref(native))

    def set_source_rig(self, joints: Sequence[Joint]) -> None:
        """In place of a source skeleton: the rig of the body on which the garment was designed, in the coordinate system of
        the garment. With a rig on both sides no skeletons have to correspond: which joints do follows from their names, from
        their places and from `set_joint_pairs`, and can be read with `read_joint_map`. A skeleton beside a rig is read as a
        rig without names. The later one of skeleton and rig counts.

        `joints`: at most 65535. Stage: SETUP. Errors: INVALID_ARGUMENT, INVALID_SKELETON (no joints, a parent that is no
        joint, parents in a circle, a number that is not finite, a last row that is not 0, 0, 0, 1; that nothing corresponds
        is found by `prepare`).
        """
        native, count = rig(joints, "source rig")
        self._handle.call("bespoke_session_set_source_rig", native, count)

    def set_target_rig(self, joints: Sequence[Joint]) -> None:
        """In place of a target skeleton: the rig of the body to dress, in its coordinate system and in the pose in which it is
        given. Skin weights of the target are then on its joints. That source and target stand in different poses, such as an
        A-pose and a T-pose, needs nothing.

        `joints`, stage, errors: as for `set_source_rig`.
        """
        native, count = rig(joints, "target rig")
        self._handle.call("bespoke_session_set_target_rig", native, count)

    def set_joint_pairs(self, pairs: npt.ArrayLike) -> None:
        """Optional: joints of the two rigs that correspond. They win over names and places. Replaces earlier pairs.

        `pairs`: shape (n, 2), a joint of the source rig and one of the target rig each, from 0; -1 as the second: nothing
        corresponds to it. Each joint is in one pair at most. Stage: SETUP. Errors: INVALID_ARGUMENT (a joint that a rig does
        not have, or one in two pairs, is found by `prepare` and `read_joint_map`).
        """
        view = arrays.indices(pairs, 2, "joint pairs", "(n, 2)", none=True)
        self._handle.call("bespoke_session_set_joint_pairs", view.pointer)

    def set_vertex_fit_weights(self, weights: npt.ArrayLike) -> None:
        """Optional: how strongly each garment vertex is drawn to the body, relative to the others. 1 everywhere by default;
        0: not at all.

        `weights`: shape (n,), one for each garment vertex, finite and not negative. Stage: SETUP. Errors: INVALID_ARGUMENT,
        INVALID_WEIGHTS (a wrong size is found by `prepare`).
        """
        view = arrays.floats(weights, None, "fit weights", _LIST)
        self._handle.call("bespoke_session_set_vertex_fit_weights", view.pointer)

    def set_no_fit_vertices(self, vertices: npt.ArrayLike) -> None:
        """Optional: the garment vertices that are not drawn to the body: `set_vertex_fit_weights` with 0 for these and 1 for
        all others, which this replaces.

        `vertices`: shape (n,), from 0, in any order. Stage: SETUP, with the garment set. Errors: INVALID_ARGUMENT (a vertex out
        of range as well).
        """
        view = arrays.indices(vertices, None, "no-fit vertices", _LIST)
        self._handle.call("bespoke_session_set_no_fit_vertices", view.pointer)

    def set_pinned_vertices(self, vertices: npt.ArrayLike, targets: npt.ArrayLike | None = None) -> None:
        """Optional: garment vertices that are held at targets. Replaces earlier pins.

        `vertices`: shape (n,), from 0, each once; none: no pins. `targets`: shape (n, 3), in the target's coordinate system;
        without, a vertex keeps its position relative to the nearest bone. A pin is a stiff spring (see `Options.pin_weight`):
        one that cannot reach its target is reported as a diagnostic. Stage: SETUP. Errors: INVALID_ARGUMENT (a vertex that
        the garment does not have is found by `prepare`).
        """
        view = arrays.indices(vertices, None, "pins", _LIST)
        if targets is None:
            self._handle.call("bespoke_session_set_pinned_vertices", view.pointer, None)
            return
        points = arrays.floats(targets, 3, "pins: targets", _POINTS)
        self._handle.call("bespoke_session_set_pinned_vertices", view.pointer, points.pointer)

    def add_rigid_group(self, vertices: npt.ArrayLike) -> None:
        """Optional: garment vertices that stay one rigid body, such as a button, a buckle or an armour plate: it moves, turns
        and keeps its shape. Its size scales with the skeletons. Each call adds a group; they are numbered from 0.

        `vertices`: shape (n,), from 0, in any order; at least one, none of another group. Stage: SETUP. Errors:
        INVALID_ARGUMENT (a vertex that the garment does not have is found by `prepare`).
        """
        view = arrays.indices(vertices, None, "rigid group", _LIST)
        self._handle.call("bespoke_session_add_rigid_group", view.pointer)

    def clear_rigid_groups(self) -> None:
        """Removes all rigid groups. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_rigid_groups")

    def add_curve(
        self,
        vertices: npt.ArrayLike,
        *,
        closed: bool = False,
        curve_weight: float = 1.0,
        position_weight: float = 1.0,
    ) -> None:
        """Optional: a curve along edges of the garment, such as a neckline, a seam line or the rim of a lined sleeve, that
        keeps its shape and its place along the bones. Each call adds one; they are numbered from 0. One that runs through the
        vertices of a boundary curve takes its place: so a neckline can be held more, and a cuff less.

        `vertices`: shape (n,), from 0, in the order of the curve, each once; of vertices in one place any will do. `closed`:
        the last is joined to the first. `curve_weight`: factor on `Options.curvature_weight` and `torsion_weight`, up to
        1e6; 1 as for a boundary curve, 0 for none. `position_weight`: the same for `Options.position_weight`. Stage: SETUP.
        Errors: INVALID_ARGUMENT (fewer than two vertices, or three where it is closed, one listed twice, a weight out of
        range; found by `prepare`: a vertex that the garment does not have, two in a row that no edge joins, a place passed
        twice, an earlier curve once more).
        """
        view = arrays.indices(vertices, None, "curve", _LIST)
        self._handle.call(
            "bespoke_session_add_curve", view.pointer, 1 if closed else 0, float(curve_weight), float(position_weight)
        )

    def clear_curves(self) -> None:
        """Removes all curves that were added. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_curves")

    def add_layer(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """Optional: a garment that the avatar wears already, such as one that was read from another session. The garment of
        this session fits over avatar and layers, and is verified against both. Each call adds one layer; they are numbered
        from 0, and stay until `clear_layers`, also when another avatar is set and after `reset`.

        `vertices`: shape (n, 3), in the coordinate system of the target avatar; used exactly as they are. `triangles`: shape
        (m, 3), vertices from 0. Stage: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH.
        """
        self._mesh("add_layer", vertices, triangles, "layer")

    def clear_layers(self) -> None:
        """Takes all layers off the avatar. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_layers")

    def add_outfit_garment(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """Optional: a garment of an outfit as it was modelled, so that the order in which the outfit is worn can be read:
        `read_outfit_order`. Each call adds one; they are numbered from 0. All of the outfit is added, also what is dressed in
        this session; none of it takes part in the run.

        `vertices`: shape (n, 3), in the coordinate system of the garment and the source avatar. `triangles`: shape (m, 3),
        vertices from 0. Stage: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH.
        """
        self._mesh("add_outfit_garment", vertices, triangles, "outfit garment")

    def clear_outfit(self) -> None:
        """Removes all garments of the outfit. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_outfit")

    def read_outfit_order(self) -> npt.NDArray[np.uint32]:
        """The order in which the garments of the outfit are worn, from the innermost outwards, by their numbers, shape (n,), as
        their geometry tells: of two garments the inner one is that of which more lies in the other, and where neither does,
        that which is nearer to the source avatar, if one is set. Of garments that do not meet, the first comes first.

        Stage: any. Errors: CANCELLED, NO_THREAD.
        """
        return np.array(self._list("bespoke_session_read_outfit_order", ctypes.c_uint32), np.uint32)

    def read_worn_pairs(self) -> tuple[WornPair, ...]:
        """What that order is made of: the pairs of garments that meet, the surest first, so that an editor can show where it is
        a guess. Stage and errors: as there.
        """
        native = self._list("bespoke_session_read_worn_pairs", BespokeWornPair)
        return tuple(WornPair._from_native(one) for one in native)

    def find_intersections(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        other_vertices: npt.ArrayLike | None = None,
        other_triangles: npt.ArrayLike | None = None,
    ) -> npt.NDArray[np.uint32]:
        """Finds the pairs of triangles of two meshes that touch or cross each other, such as two garments that hang beside each
        other, or those within one mesh; by the exact verifier. The inputs and the result of the session have no part in it.

        `vertices`, `triangles`: a mesh. `other_vertices`, `other_triangles`: another one in the same coordinate system; both
        None: pairs within the first. Returns the triangle of the first mesh and that of the other, shape (pairs, 2),
        ascending. Stage: any. Errors: INVALID_ARGUMENT, INVALID_MESH, CANCELLED, NO_THREAD; ValueError, where one of the
        others is None.
        """
        if (other_vertices is None) != (other_triangles is None):
            raise ValueError("the other mesh has vertices and triangles, or is left out")
        meshes = [("first mesh", vertices, triangles)]
        if other_vertices is not None and other_triangles is not None:
            meshes.append(("second mesh", other_vertices, other_triangles))
        views = []
        for what, points, corners in meshes:
            views.append(arrays.floats(points, 3, f"{what}: vertices", _POINTS))
            views.append(arrays.indices(corners, 3, f"{what}: triangles", "(m, 3)", Status.INVALID_MESH))
        given = [view.pointer for view in views] + [None] * (4 - len(views))
        name = "bespoke_session_find_intersections"
        count = ctypes.c_size_t()
        self._handle.call_long(name, *given, None, 0, ctypes.byref(count))
        pairs = np.empty((count.value, 2), np.uint32)
        into = pairs.ctypes.data_as(ctypes.POINTER(ctypes.c_uint32))
        self._handle.call(name, *given, into, count.value, ctypes.byref(count))
        return pairs

    def add_key_pose(self, transforms: npt.ArrayLike, name: str = "") -> None:
        """Optional: a pose of the target rig in which the garment is to keep out of the body, such as a bent arm or a crouch.
        Each call adds one; they are numbered from 0.

        `transforms`: shape (joints, 4, 4), for each joint of the target rig how it moves what it moves from the bind pose to
        this pose, in the coordinate system of the target, to be multiplied from the left: its posed matrix times the inverse
        of its bind matrix. `name`: for messages. Stage: SETUP or DONE, with a target rig. Errors: INVALID_ARGUMENT (another
        number of joints, a number that is not finite, a transform without inverse).
        """
        given = np.asarray(transforms, np.float64)
        if given.ndim != 3 or given.shape[1:] != (4, 4):
            raise error(Status.INVALID_ARGUMENT, f"key pose: transforms have shape (joints, 4, 4), not {given.shape}")
        # Not empty, so that there is a pointer to it.
        numbers = np.zeros(16 * len(given) + 1)
        numbers[:-1] = given.transpose((0, 2, 1)).ravel()
        first = numbers.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        # A zero byte would end the name for C.
        text = name.replace("\0", " ").encode("utf-8", "replace") if name else None
        self._handle.call("bespoke_session_add_key_pose", text, first, len(given))

    def clear_key_poses(self) -> None:
        """Removes all key poses. Stage: SETUP or DONE."""
        self._handle.call("bespoke_session_clear_key_poses")

    def solve_pose_corrections(self, influences: int = 4) -> None:
        """Finds the correction of each key pose: offsets of the garment's vertices in the bind pose, a blend shape to be added
        before the skin weights move them, at full weight in that pose and at none in the bind pose. The result stays as it
        is; corrections that are there already are not sought again.

        `influences`: joints a vertex, as in `read_garment_skin_influences`. Stage: DONE, with a target rig and skin weights of
        the target avatar set. Errors: INVALID_WEIGHTS, CANCELLED (what was found is kept), MEMORY_LIMIT.
        """
        self._handle.call_long("bespoke_session_solve_pose_corrections", influences)

    def read_pose_correction(
        self, pose: int, *, dtype: npt.DTypeLike | None = None
    ) -> tuple[npt.NDArray[Any], PoseIntersections, PoseIntersections]:
        """The correction of a key pose: offsets from the result, shape (n, 3), in the coordinate system of the target, and what
        passes through what in that pose by the weights alone, and with the offsets.

        `pose`: its number. `dtype`: as for `read_garment_vertices`. Stage: DONE, after `solve_pose_corrections`. Errors:
        INVALID_ARGUMENT (no such pose).
        """
        if pose < 0:
            raise ValueError(f"key poses count from 0, and {pose} is below")
        name = "bespoke_session_read_pose_correction"
        count = ctypes.c_size_t()
        before, after = BespokePoseIntersections(), BespokePoseIntersections()
        counts = (ctypes.byref(before), ctypes.byref(after))
        self._handle.call(name, pose, ctypes.byref(arrays.NOTHING), ctypes.byref(count), *counts)
        kind = self._dtype if dtype is None else dtype
        array, buffer = arrays.buffer(None, kind, (count.value, 3), "pose correction")
        self._handle.call(name, pose, ctypes.byref(buffer), None, None, None)
        return array, PoseIntersections._from_native(before), PoseIntersections._from_native(after)

    def add_follower(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> None:
        """Optional: a mesh that follows the garment without being solved, such as a level of detail, a trim, a badge or a
        collision proxy. It is bound to the nearest points of the garment as it was modelled and carried to the result. Each
        call adds one; they are numbered from 0. Where one is in the avatar or passes through the garment in the result, and
        did not in the design, the diagnostic FOLLOWER_INTERSECTS says so.

        `vertices`: shape (n, 3), in the coordinate system of the garment. `triangles`: shape (m, 3), vertices from 0. Stage:
        SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH.
        """
        self._mesh("add_follower", vertices, triangles, "follower")

    def clear_followers(self) -> None:
        """Removes all followers. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_followers")

    def add_garment_morph(self, offsets: npt.ArrayLike, name: str = "") -> None:
        """Optional: a morph of the garment as it was modelled, which goes over to the result: `read_garment_morph`. Each call
        adds one; they are numbered from 0.

        `offsets`: shape (n, 3), one for each vertex of the garment, in its coordinate system. `name`: for messages. Stage:
        SETUP. Errors: INVALID_ARGUMENT (another number of offsets than the garment has vertices is found by `prepare`).
        """
        view = arrays.floats(offsets, 3, "garment morph", _POINTS)
        self._handle.call("bespoke_session_add_garment_morph", name.encode(), view.pointer)

    def clear_garment_morphs(self) -> None:
        """Removes all morphs of the garment. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_garment_morphs")

    def add_target_morph(self, offsets: npt.ArrayLike, name: str = "") -> None:
        """Optional: a morph of the target avatar, such as a heavier body, to which the garment is to have an answer:
        `solve_target_morphs`. Each call adds one; they are numbered from 0.

        `offsets`: shape (n, 3), one for each vertex of the target avatar, in its coordinate system. `name`: for messages.
        Stage: SETUP. Errors: INVALID_ARGUMENT (another number of offsets than the avatar has vertices is found by `prepare`).
        """
        view = arrays.floats(offsets, 3, "target morph", _POINTS)
        self._handle.call("bespoke_session_add_target_morph", name.encode(), view.pointer)

    def clear_target_morphs(self) -> None:
        """Removes all morphs of the target avatar. Stage: SETUP."""
        self._handle.call("bespoke_session_clear_target_morphs")

    def set_target_morph_weight(self, morph: int, weight: float) -> None:
        """How much of a target morph the avatar is to have from the next `refit` on: the body changes its shape, takes the garment
        along, with no triangle through another on the way, and the garment is fitted to it.

        `morph`: its number. `weight`: any finite number; 0.5 is half of the morph. Morphs add up; at first, and after `reset`,
        all weights are 0. Stage: DONE, or FIT after `refit`. Errors: INVALID_ARGUMENT (no such morph, not finite).
        """
        self._handle.call("bespoke_session_set_target_morph_weight", morph, weight)

    def set_avatar_parts(self, roles: npt.ArrayLike | None) -> None:
        """Optional: what each triangle of the avatar is to the garment. Without it the library leaves out pieces that are no
        part of the body, with a diagnostic, and takes all else for body.

        `roles`: shape (m,), one `PartRole` for each triangle of the avatar; None takes all roles back. They stay with
        another avatar and after `reset`. Stage: SETUP. Errors: INVALID_ARGUMENT (no role has that number; another count than
        the avatar's is found by `prepare`, as is INVALID_MESH where no body is left).
        """
        if roles is None:
            self._handle.call("bespoke_session_set_avatar_parts", None)
            return
        view = arrays.indices(roles, None, "avatar parts", _LIST)
        self._handle.call("bespoke_session_set_avatar_parts", view.pointer)

    def set_options(self, options: Options | None = None, **arguments: Unpack[OptionArguments]) -> None:
        """Replaces all options by these.

        `options`: those to begin with; None: the defaults. `arguments`: single ones, which win. `Options` says what they
        are. Stage: SETUP. Errors: INVALID_ARGUMENT (an option out of its range, which the message names); TypeError (no
        option has that name), ValueError.
        """
        native = _options(options, arguments)._to_native()
        self._handle.call("bespoke_session_set_options", ctypes.byref(native))

    # The way to the result.

    def prepare(self) -> None:
        """Checks the inputs against each other and shrinks the avatar onto the source skeleton. SETUP becomes PREPARED; where
        it fails or is cancelled, the session stays in SETUP and keeps its inputs. Diagnostics about the inputs can be read
        with `read_diagnostics`, also where it fails.

        Stage: SETUP, with garment, target avatar, and skeletons or rigs set. Errors: INVALID_ARGUMENT (a voxel too small for
        the avatar), INVALID_MESH (also: too far from the origin for its precision), INVALID_SKELETON (another topology),
        INVALID_WEIGHTS (a wrong size), SELF_INTERSECTION (with the option `strict`), NOT_ENCLOSED, MEMORY_LIMIT, NO_THREAD,
        CANCELLED.
        """
        self._handle.call_long("bespoke_session_prepare", findings=True)

    def step(self, max_iterations: int = 0, max_milliseconds: int = 0) -> Stage:
        """Continues the run until it ends or the budget is spent, whichever is first, and returns the stage afterwards.

        `max_iterations`, `max_milliseconds`: the budget; 0: no limit. It is checked after each iteration, so a step does at
        least one and may take somewhat longer. At DONE the result is verified; until then what can be read is a preview.
        Stage: PREPARED, INFLATE, REPOSE or FIT. Errors: INVALID_STATE (a session that has ended continues only after
        `reset`), INFLATION_STALLED, NOT_VERIFIED, IMPLAUSIBLE_RESULT (the stage is DONE, and the result can be read),
        MEMORY_LIMIT, CANCELLED; ValueError, where a budget is negative or above 2^32 - 1.
        """
        for budget in (max_iterations, max_milliseconds):
            if not 0 <= budget <= 0xFFFFFFFF:
                raise ValueError(f"a budget is from 0, for no limit, to 2^32 - 1, not {budget}")
        stage = ctypes.c_uint32()
        self._handle.call_long(
            "bespoke_session_step", max_iterations, max_milliseconds, ctypes.byref(stage), findings=True
        )
        return Stage(stage.value)

    def refit(self, options: Options | None = None, **arguments: Unpack[OptionArguments]) -> None:
        """Fits a result again: with these options, and with the fit weights and pins that were set since. `step` or `run` then
        go on from the result, to another one with the same guarantee, in a small part of the time where little has changed.

        `options`, `arguments`: all of them, as for `set_options`; those that are used before the fit have to stay as they
        were. Stage: DONE, or FIT after it. Errors: INVALID_ARGUMENT (an option out of its range or one that has to stay, which
        the message names), INVALID_WEIGHTS, INVALID_STATE, after all of which the result stays; MEMORY_LIMIT, CANCELLED;
        TypeError (no option has that name), ValueError.
        """
        native = _options(options, arguments)._to_native()
        self._handle.call_long("bespoke_session_refit", ctypes.byref(native), findings=True)

    def run(self, progress: Callable[[Progress], object] | None = None) -> None:
        """Runs the session to its end: prepares where needed, then steps. When it returns, the session is DONE and the result
        verified.

        `progress`: called some twenty times a second at most, in this thread, and a last time when the session is done. It
        may read the session. What it raises ends this call, and another one continues from there. Stage, errors: as for
        `prepare` or `step`.
        """
        if progress is None:
            self._handle.call_long("bespoke_session_run", findings=True)
            return
        now = self.read_progress()
        progress(now)
        if now.stage == Stage.SETUP:
            self.prepare()
            progress(self.read_progress())
        while self.step(max_milliseconds=_REPORT_MILLISECONDS) != Stage.DONE:
            progress(self.read_progress())
        progress(self.read_progress())

    def verify(self, dtype: npt.DTypeLike | None = None) -> Intersections:
        """Counts the intersections of the vertices as they would be read now, with exact predicates.

        `dtype`: the precision of reading, float32 or float64; None: that of the garment. A session that is DONE has, in the
        precision of its garment, no others than initial self-intersections. Stage: PREPARED or later. Errors:
        INVALID_ARGUMENT, CANCELLED (by a request that no call has answered yet; the stage does not change).
        """
        kind = np.dtype(self._dtype if dtype is None else dtype)
        if kind not in (np.float32, np.float64):
            raise error(Status.INVALID_ARGUMENT, f"verify: vertices are read as float32 or float64, not {kind}")
        native = BespokeIntersections()
        component = _Component.F32 if kind == np.float32 else _Component.F64
        self._handle.call_long("bespoke_session_verify", int(component), ctypes.byref(native))
        return Intersections._from_native(native)

    def cancel(self) -> None:
        """Cancels the session. The call that runs in another thread, if it is `prepare`, `step`, `run` or `verify`, fails with
        CANCELLED within 100 ms, whatever it is doing; otherwise the next one does. The request stays until `reset`. What can
        be read afterwards is the last complete iteration. At any time, from any thread or signal handler.
        """
        self._handle.check_open()
        self._handle.control.cancel()

    def create_control(self) -> Control:
        """A control of the session: cancel and progress, which may outlive it. At any time, from any thread."""
        return self._handle.create_control()

    # What is read.

    @property
    def stage(self) -> Stage:
        """Where the session is. At any time, from any thread."""
        return self.read_progress().stage

    @property
    def last_message(self) -> str:
        """The message of the last call that failed; empty where none did. At any time, from any thread."""
        return self._handle.last_message()

    def read_progress(self) -> Progress:
        """Progress of the session as of its last iteration. At any time, from any thread."""
        self._handle.check_open()
        return self._handle.control.read_progress()

    def read_garment_vertices(
        self, out: npt.NDArray[Any] | None = None, *, dtype: npt.DTypeLike | None = None
    ) -> npt.NDArray[Any]:
        """The garment's current vertices, shape (n, 3), in the order in which they were set, in the target's coordinate
        system and unit.

        `out`: where to, float32 or float64 of that shape, also with gaps between its rows; None: a new array. `dtype`: of a
        new array; None: float32 where the garment was set so, else float64. With DONE they are verified in this precision;
        otherwise they are a preview. Stage: PREPARED or later. Errors: INVALID_ARGUMENT (an `out` of another shape, or that
        cannot be written in place), NOT_VERIFIED (DONE, but clean only in the precision in which the garment was set; nothing
        is written).
        """
        return self._read("bespoke_session_read_garment_vertices", out, dtype, 3, "garment vertices")

    def read_avatar_vertices(
        self, out: npt.NDArray[Any] | None = None, *, dtype: npt.DTypeLike | None = None
    ) -> npt.NDArray[Any]:
        """The target avatar's current vertices, shape (n, 3), without its layers: shrunk onto the source skeleton at first, as
        they were set at the end.

        `out`, `dtype`, stage, errors: as for `read_garment_vertices`.
        """
        return self._read("bespoke_session_read_avatar_vertices", out, dtype, 3, "avatar vertices")

    def read_distortion(
        self, out: npt.NDArray[Any] | None = None, *, dtype: npt.DTypeLike | None = None
    ) -> npt.NDArray[Any]:
        """How much each garment triangle is distorted now, shape (m,), in the order in which the triangles were set: how
        differently it and its neighbours deform, over the ratio of the garment's area to that of the design. Without unit, 0
        or above; 0 for any similarity of the garment as a whole.

        `out`, `dtype`: as for `read_garment_vertices`, one number a triangle. Stage: PREPARED or later. Errors:
        INVALID_ARGUMENT.
        """
        return self._read("bespoke_session_read_distortion", out, dtype, None, "distortion")

    def read_garment_normals(
        self,
        normals: npt.ArrayLike | None = None,
        *,
        triangles: npt.ArrayLike | None = None,
        tangents: npt.ArrayLike | None = None,
        dtype: npt.DTypeLike | None = None,
    ) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """Unit normals of the garment as it is now, shape (n, 3), and tangents, shape (n, 4), for the vertices with which it is
        drawn: those of the design, turned as the surface around them has turned. Vertices in one place whose normals agree in
        the design stay smooth; where they differ, the edge stays hard. A rigid motion turns each normal exactly.

        `normals`: those of the design, shape (n, 3), in the garment's coordinate system; None: they follow from the
        triangles, and vertices in one place are smooth where they differ by no more than 60 degrees. `triangles`: the garment's
        in their order, by those vertices, shape (m, 3); None: the vertices of `set_garment`. `tangents`: x, y, z and the
        handedness of the bitangent, shape (n, 4); None: the second array is empty. `dtype`: as for `read_garment_vertices`.
        Stage: PREPARED or later. Errors: INVALID_ARGUMENT (other triangles than the garment's, arrays of different length).
        """
        name = "bespoke_session_read_garment_normals"
        views = [
            None if triangles is None else arrays.indices(triangles, 3, "triangles of the render vertices", "(m, 3)"),
            None if normals is None else arrays.floats(normals, 3, "garment normals", _POINTS),
            None if tangents is None else arrays.floats(tangents, 4, "garment tangents", "(n, 4)"),
        ]
        given = [None if view is None else view.pointer for view in views]
        count = ctypes.c_size_t()
        self._handle.call(name, *given, ctypes.byref(arrays.NOTHING), None, ctypes.byref(count))
        kind = self._dtype if dtype is None else dtype
        turned, first = arrays.buffer(None, kind, (count.value, 3), "garment normals")
        along, second = arrays.buffer(None, kind, (count.value if tangents is not None else 0, 4), "garment tangents")
        to_tangents = None if tangents is None else ctypes.byref(second)
        self._handle.call(name, *given, ctypes.byref(first), to_tangents, None)
        return turned, along

    def read_garment_morph(self, morph: int, *, dtype: npt.DTypeLike | None = None) -> npt.NDArray[Any]:
        """A morph of the garment as it is now, shape (n, 3): each offset turned, stretched and scaled as the surface around its
        vertex has been, in the target's coordinate system.

        `morph`: its number. `dtype`: as for `read_garment_vertices`. Stage: PREPARED or later. Errors: INVALID_ARGUMENT (no
        such morph).
        """
        return self._read_one("bespoke_session_read_garment_morph", morph, dtype, "garment morph")

    def solve_target_morphs(self) -> None:
        """Finds what the garment answers to each morph of the target avatar with: from the result on, the body goes to the
        morph at weight 1 and takes the garment along, with no triangle through another on the way, and the garment is fitted
        there, which takes about as long as the fit. The result stays as it is. A morph without an answer is told by the
        diagnostic MORPH_NOT_SOLVED, and one whose answer intersects halfway by MORPH_INTERSECTS.

        Stage: DONE. Errors: INVALID_ARGUMENT (a morph that is far larger than the body), CANCELLED (the stage stays DONE),
        MEMORY_LIMIT.
        """
        self._handle.call_long("bespoke_session_solve_target_morphs")

    def read_target_morph(self, morph: int, *, dtype: npt.DTypeLike | None = None) -> npt.NDArray[Any]:
        """The garment's answer to a morph of the target avatar, shape (n, 3): offsets from the result. With both at weight 1
        the garment is verified as the result is.

        `morph`: the number of the avatar's morph. `dtype`: as for `read_garment_vertices`. Stage: DONE, after
        `solve_target_morphs`. Errors: INVALID_ARGUMENT (no such morph), INVALID_STATE (also where there is no answer).
        """
        return self._read_one("bespoke_session_read_target_morph", morph, dtype, "target morph")

    def read_follower_vertices(self, follower: int, *, dtype: npt.DTypeLike | None = None) -> npt.NDArray[Any]:
        """The vertices of a follower where the result takes them, shape (n, 3), in the target's coordinate system.

        `follower`: its number. `dtype`: as for `read_garment_vertices`. Stage: DONE. Errors: INVALID_ARGUMENT (no such
        follower).
        """
        return self._read_one("bespoke_session_read_follower_vertices", follower, dtype, "follower vertices")

    def read_follower_skin_influences(
        self, follower: int, influences: int = 4
    ) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.float32], int]:
        """Skin weights of a follower: those of the garment where it is bound to it; else as `read_garment_skin_influences`.

        `follower`: its number. Errors: INVALID_ARGUMENT (no such follower), and as there.
        """
        if influences < 1:
            raise ValueError(f"a vertex has at least one influence, not {influences}")
        vertices = len(self.read_follower_vertices(follower))
        joints = np.zeros((vertices, influences), np.uint32)
        weights = np.zeros((vertices, influences), np.float32)
        count = ctypes.c_size_t()
        self._handle.call_long(
            "bespoke_session_read_follower_skin_influences",
            follower,
            influences,
            joints.ctypes.data_as(ctypes.POINTER(ctypes.c_uint32)),
            weights.ctypes.data_as(ctypes.POINTER(ctypes.c_float)),
            vertices,
            ctypes.byref(count),
        )
        return joints, weights, count.value

    def read_report(self) -> Report:
        """Measurements of the session so far. Stage: any."""
        native = BespokeReport()
        native.struct_size = ctypes.sizeof(native)
        self._handle.call("bespoke_session_read_report", ctypes.byref(native))
        return Report._from_native(native)

    def read_energies(self) -> tuple[Energy, ...]:
        """The terms of the objective with their values and weights. Stage: any; there are none before `prepare`."""
        energies = []
        for index in range(self.read_report().energy_count):
            native = BespokeEnergy()
            native.struct_size = ctypes.sizeof(native)
            self._handle.call("bespoke_session_read_energy", index, ctypes.byref(native))
            energies.append(Energy._from_native(native))
        return tuple(energies)

    def read_diagnostics(self) -> tuple[Diagnostic, ...]:
        """What was found about the inputs and the result: what `prepare` found, also where it failed, what holds the garment
        where the inflation stalled, and what the verifier found in the end. Of one kind, the first thousand or so are listed,
        and the last one says how many more there are. Stage: any; there are none before `prepare`.
        """
        return self._handle.read_diagnostics()

    def read_joint_map(self) -> tuple[MappedJoint, ...]:
        """Which joint of the target rig corresponds to each joint of the source rig, in its order, why, and how sure that is:
        for an editor to show, and to mend with `set_joint_pairs`.

        Stage: any, with rig or skeleton set on both sides. Errors: INVALID_ARGUMENT (a pair that suits no joints),
        INVALID_WEIGHTS (weights that do not suit their rig), INVALID_STATE (a rig is missing).
        """
        native = self._list("bespoke_session_read_joint_map", BespokeMappedJoint)
        return tuple(MappedJoint._from_native(one) for one in native)

    def read_garment_skin_influences(
        self, influences: int = 4
    ) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.float32], int]:
        """Skin weights of the result on the joints of the target rig, or of the target skeleton where no rig was set: those
        of the body beneath, smoothly continued where the garment stands off. Vertices of a rigid group have the same. With
        weights of the garment on joints of its own, these come along: see `read_added_joints`.

        `influences`: joints a vertex, such as 4 or 8. Returns joints, shape (n, influences), the largest weight first;
        weights of the same shape, not negative, of sum 1 for each vertex; and how many joints there are, those of the target
        rig and added ones together. Stage: DONE, with skin weights of the target avatar set. Errors: INVALID_WEIGHTS (the
        avatar's weights are all 0), CANCELLED; ValueError, where `influences` is below 1.
        """
        if influences < 1:
            raise ValueError(f"a vertex has at least one influence, not {influences}")
        joints = np.zeros((self._vertices, influences), np.uint32)
        weights = np.zeros((self._vertices, influences), np.float32)
        count = ctypes.c_size_t()
        self._handle.call_long(
            "bespoke_session_read_garment_skin_influences",
            influences,
            joints.ctypes.data_as(ctypes.POINTER(ctypes.c_uint32)),
            weights.ctypes.data_as(ctypes.POINTER(ctypes.c_float)),
            self._vertices,
            ctypes.byref(count),
        )
        return joints, weights, count.value

    def read_added_joints(self) -> tuple[AddedJoint, ...]:
        """The garment's own joints, such as those of a skirt or a cape, in the order of their numbers: the first is the number
        of joints of the target rig. They are placed where the result has taken what they move.

        Stage: DONE, with skin weights of the target avatar set. Errors: INVALID_WEIGHTS, CANCELLED.
        """
        native = self._list("bespoke_session_read_added_joints", BespokeAddedJoint)
        return tuple(AddedJoint._from_native(one) for one in native)

    def read_pose_transforms(self) -> npt.NDArray[np.float64]:
        """How each joint of the target rig moves from its bind pose to the pose that the result is in, shape (joints, 4, 4), to
        be multiplied from the left. They are all the identity, but where the diagnostic POSE_BLOCKED says that the result is
        in the pose of the design: there, garment and avatar that are read are in that pose.

        Stage: DONE, with a target rig.
        """
        name = "bespoke_session_read_pose_transforms"
        return matrices(self._list(name, ctypes.c_double * BESPOKE_TRANSFORM_SIZE, ctypes.c_double))

    def read_covered_triangles(
        self, layer: int | None = None, *, margin: int = 1, openness: float = 0.0
    ) -> npt.NDArray[np.uint32]:
        """The triangles of the avatar, or of a layer, that the garment covers, ascending, shape (n,): from outside nobody sees
        them in the pose that the result is in, so that a game may leave them out while the garment is worn.

        `layer`: None for the avatar, or a layer, from 0; of a layer both sides have to be covered. `margin`: so many rings of
        triangles are left beside those that are not covered; 0 is for nothing that moves. `openness`: the share of directions,
        from 0 to 1, in which a covered triangle may be seen all the same; 0.2 is for what is seen from the floor alone.
        Stage: DONE. Errors: INVALID_ARGUMENT (no such layer, an openness that is no share), CANCELLED.
        """
        name = "bespoke_session_read_covered_triangles"
        given = (BESPOKE_NO_LAYER if layer is None else layer, margin, openness)
        count = ctypes.c_size_t()
        self._handle.call(name, *given, None, 0, ctypes.byref(count))
        covered = np.empty(count.value, np.uint32)
        into = covered.ctypes.data_as(ctypes.POINTER(ctypes.c_uint32))
        self._handle.call(name, *given, into, count.value, ctypes.byref(count))
        return covered

    # What these share.

    def _mesh(
        self, function: str, vertices: npt.ArrayLike, triangles: npt.ArrayLike, what: str
    ) -> tuple[arrays.View, arrays.View]:
        points = arrays.floats(vertices, 3, f"{what}: vertices", _POINTS)
        corners = arrays.indices(triangles, 3, f"{what}: triangles", "(m, 3)", Status.INVALID_MESH)
        self._handle.call(f"bespoke_session_{function}", points.pointer, corners.pointer)
        return points, corners

    def _skeleton(self, side: str, joints: npt.ArrayLike, bones: npt.ArrayLike) -> None:
        points = arrays.floats(joints, 3, f"{side} skeleton: joints", _POINTS)
        pairs = arrays.indices(bones, 2, f"{side} skeleton: bones", "(m, 2)", Status.INVALID_SKELETON)
        self._handle.call(f"bespoke_session_set_{side}_skeleton", points.pointer, pairs.pointer)

    def _influences(
        self, side: str, joints: npt.ArrayLike, weights: npt.ArrayLike, joint_count: int, what: str
    ) -> None:
        numbers, shares, influences = arrays.influences(joints, weights, what)
        self._handle.call(
            f"bespoke_session_set_{side}_skin_influences",
            numbers.pointer,
            shares.pointer,
            influences,
            joint_count,
        )

    def _read(
        self,
        function: str,
        out: npt.NDArray[Any] | None,
        dtype: npt.DTypeLike | None,
        columns: int | None,
        what: str,
    ) -> npt.NDArray[Any]:
        count = ctypes.c_size_t()
        self._handle.call(function, ctypes.byref(arrays.NOTHING), ctypes.byref(count))
        shape = (count.value,) if columns is None else (count.value, columns)
        array, buffer = arrays.buffer(out, self._dtype if dtype is None else dtype, shape, what)
        self._handle.call(function, ctypes.byref(buffer), None)
        return array

    def _read_one(self, function: str, index: int, dtype: npt.DTypeLike | None, what: str) -> npt.NDArray[Any]:
        if index < 0:
            raise ValueError(f"{what}: they count from 0, and {index} is below")
        count = ctypes.c_size_t()
        self._handle.call(function, index, ctypes.byref(arrays.NOTHING), ctypes.byref(count))
        array, buffer = arrays.buffer(None, self._dtype if dtype is None else dtype, (count.value, 3), what)
        self._handle.call(function, index, ctypes.byref(buffer), None)
        return array

    def _list(self, function: str, kind: Any, pointed: Any = None) -> Any:
        """A list whose length is asked for first."""
        count = ctypes.c_size_t()
        self._handle.call(function, None, 0, ctypes.byref(count))
        native = (kind * count.value)()
        capacity = count.value
        first = ctypes.cast(native, ctypes.POINTER(pointed or kind))
        self._handle.call(function, first, capacity, ctypes.byref(count))
        return native


def _options(options: Options | None, arguments: Any) -> Options:
    given = {} if options is None else {name: getattr(options, name) for name in Options.__dataclass_fields__}
    return Options(**{**given, **arguments})


def read_default_options() -> Options:
    """The defaults written out. Errors: ImportError, where there is no native library."""
    native = BespokeOptions()
    native.struct_size = ctypes.sizeof(native)
    status = Status(load().bespoke_options_read_defaults(ctypes.byref(native)))
    if status != Status.OK:
        raise error(status, "the library refuses to write into a BespokeOptions of this package's size")
    return Options._from_native(native)
