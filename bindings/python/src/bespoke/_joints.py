"""Joints of a rig, and what corresponds to them in another; coordinate systems."""

from __future__ import annotations

import ctypes
import dataclasses
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from ._enums import Axis, JointReason, Status, Winding
from ._errors import error
from ._native import (
    BESPOKE_NO_JOINT,
    BESPOKE_TRANSFORM_SIZE,
    BespokeAddedJoint,
    BespokeCoordinateSystem,
    BespokeJoint,
    BespokeMappedJoint,
)


@dataclasses.dataclass(frozen=True, eq=False)
class Joint:
    """A joint of a rig."""

    name: str | None
    """Its name, as the tool has it; None or empty: it has none."""

    parent: int | None
    """The joint that moves it, from 0, in any order; None for a root."""

    bind: npt.ArrayLike
    """The bind transform, shape (4, 4): from the joint's own space to that in which the mesh is given, in the pose in which
    the mesh is given. Rows and columns as NumPy has them: the joint's place is `bind[:3, 3]`. It is the inverse of an
    inverse bind matrix; of 16 numbers of glTF in a row, column after column, it is `numpy.reshape(numbers, (4, 4)).T`.
    """


@dataclasses.dataclass(frozen=True)
class MappedJoint:
    """A joint of the source rig and what corresponds to it in the target rig."""

    target: int | None
    """The target rig's joint; None where there is none."""

    reason: JointReason
    """Why."""

    confidence: float
    """From 0, a guess, to 1, sure."""

    part: str
    """The part of the body, such as "left upper arm"; empty where it is none."""

    @classmethod
    def _from_native(cls, native: BespokeMappedJoint) -> MappedJoint:
        return cls(
            target=_joint(native.target),
            reason=JointReason(native.reason),
            confidence=native.confidence,
            part=native.part.decode("utf-8", "replace"),
        )


@dataclasses.dataclass(frozen=True, eq=False)
class AddedJoint:
    """A joint of the garment's own, which follows on those of the target rig."""

    source: int
    """The joint of the source rig that it is."""

    parent: int | None
    """The joint that moves it: one of the target rig, or an added one, which are numbered on from there; None for a root."""

    bind: npt.NDArray[np.float64]
    """Its bind transform in the coordinate system of the target, shape (4, 4), as in `Joint`."""

    @classmethod
    def _from_native(cls, native: BespokeAddedJoint) -> AddedJoint:
        return cls(source=native.source, parent=_joint(native.parent), bind=matrices(native.bind)[0])


@dataclasses.dataclass(frozen=True)
class CoordinateSystem:
    """A coordinate system. Handedness follows from the axes, which must be along three different coordinates.

    The default is that of glTF and Godot: right-handed, in metres, y up, seen from the front.
    """

    right: Axis = Axis.POSITIVE_X
    """The axis that points to the right."""

    up: Axis = Axis.POSITIVE_Y
    """The axis that points up."""

    forward: Axis = Axis.NEGATIVE_Z
    """The axis that points forward, away from the viewer."""

    metres_per_unit: float = 1.0
    """Length of the unit in metres [1e-9, 1e9]."""

    winding: Winding = Winding.COUNTER_CLOCKWISE
    """Of front faces."""

    trusted: bool = False
    """True: it is right as it is. What is given in it is not compared with the rest for unit, axes, facing and sides, and
    neither turned nor refused for them.
    """

    GLTF: ClassVar[CoordinateSystem]
    """glTF, Godot, and the default."""
    MAYA: ClassVar[CoordinateSystem]
    """As by default, in centimetres."""
    BLENDER: ClassVar[CoordinateSystem]
    """z up, +y forward, in metres."""
    UNITY: ClassVar[CoordinateSystem]
    """Left-handed, y up, +z forward, in metres, clockwise."""
    UNREAL: ClassVar[CoordinateSystem]
    """Left-handed, z up, +x forward, in centimetres."""

    def _to_native(self) -> BespokeCoordinateSystem:
        native = BespokeCoordinateSystem(
            right=self.right,
            up=self.up,
            forward=self.forward,
            metres_per_unit=self.metres_per_unit,
            winding=self.winding,
            trusted=1 if self.trusted else 0,
        )
        native.struct_size = ctypes.sizeof(native)
        return native


CoordinateSystem.GLTF = CoordinateSystem()
CoordinateSystem.MAYA = CoordinateSystem(metres_per_unit=0.01)
CoordinateSystem.BLENDER = CoordinateSystem(up=Axis.POSITIVE_Z, forward=Axis.POSITIVE_Y)
CoordinateSystem.UNITY = CoordinateSystem(forward=Axis.POSITIVE_Z, winding=Winding.CLOCKWISE)
CoordinateSystem.UNREAL = CoordinateSystem(
    right=Axis.POSITIVE_Y,
    up=Axis.POSITIVE_Z,
    forward=Axis.POSITIVE_X,
    metres_per_unit=0.01,
)


def _joint(number: int) -> int | None:
    return None if number == BESPOKE_NO_JOINT else number


def matrices(numbers: Any) -> npt.NDArray[np.float64]:
    """Numbers of C, column after column, as matrices: shape (n, 4, 4)."""
    columns = np.array(numbers, np.float64).reshape((-1, 4, 4))
    return np.ascontiguousarray(columns.transpose((0, 2, 1)))


def rig(joints: Sequence[Joint], what: str) -> tuple[Any, int]:
    """Joints as C has them, with what keeps their names alive, and how many they are."""
    native = (BespokeJoint * len(joints))()
    for k, joint in enumerate(joints):
        if joint.parent is not None and not 0 <= joint.parent < BESPOKE_NO_JOINT:
            raise error(
                Status.INVALID_SKELETON, f"{what}: joint {k} has parent {joint.parent}, and joints count from 0"
            )
        bind = np.asarray(joint.bind, np.float64)
        if bind.shape != (4, 4):
            raise error(
                Status.INVALID_ARGUMENT, f"{what}: the bind transform of joint {k} has shape (4, 4), not {bind.shape}"
            )
        # A zero byte would end the name for C; there is none in a name that tools read.
        native[k].name = joint.name.replace("\0", " ").encode("utf-8", "replace") if joint.name else None
        native[k].parent = BESPOKE_NO_JOINT if joint.parent is None else joint.parent
        native[k].bind = (ctypes.c_double * BESPOKE_TRANSFORM_SIZE)(*bind.T.flat)
    return native, len(joints)
