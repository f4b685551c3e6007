"""Arrays of the caller as the library sees them, without a copy where their memory allows it."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import numpy.typing as npt

from ._enums import Status, _Component
from ._errors import error
from ._native import BespokeBuffer, BespokeView

_COMPONENTS = {
    np.dtype(np.float32): _Component.F32,
    np.dtype(np.float64): _Component.F64,
    np.dtype(np.uint16): _Component.U16,
    np.dtype(np.uint32): _Component.U32,
}


class View:
    """An array as the library reads it, with what keeps its memory alive."""

    def __init__(self, array: npt.NDArray[Any]) -> None:
        self.array = array
        self.native = BespokeView(
            data=array.ctypes.data or None,
            count=len(array),
            stride=array.strides[0] if len(array) > 1 else 0,
            component=_COMPONENTS[array.dtype],
        )

    @property
    def pointer(self) -> Any:
        """For the call; this object has to live as long."""
        return ctypes.byref(self.native)


def _readable(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The array itself, where the numbers of an element lie one after the other and elements at a distance that is positive;
    else a packed copy."""
    inner = array.itemsize
    for length, stride in zip(array.shape[:0:-1], array.strides[:0:-1]):
        if length > 1 and stride != inner:
            return np.ascontiguousarray(array)
        inner *= length
    # A stride of 0 would mean packed.
    return array if len(array) <= 1 or array.strides[0] >= inner else np.ascontiguousarray(array)


def _array(values: npt.ArrayLike, columns: int | None, what: str, shape: str) -> npt.NDArray[Any]:
    if isinstance(values, np.ma.MaskedArray) and np.ma.getmaskarray(values).any():  # type: ignore[no-untyped-call,unused-ignore]
        raise error(Status.INVALID_ARGUMENT, f"{what}: some values are masked; fill them or leave them out")
    array = np.asarray(values)
    if array.size == 0 and array.ndim <= 2:
        # What is empty has no shape of its own, as [] has not.
        array = array.reshape((0,) if columns is None else (0, columns))
    wanted = 1 if columns is None else 2
    if array.ndim != wanted or (columns is not None and array.shape[1] != columns):
        raise error(Status.INVALID_ARGUMENT, f"{what}: an array of shape {shape}, not {array.shape}")
    return array


def floats(values: npt.ArrayLike, columns: int | None, what: str, shape: str) -> View:
    """Numbers: float32 and float64 are read where they are, other real numbers become float64."""
    array = _array(values, columns, what, shape)
    if array.dtype.kind not in "fiub" or array.dtype.itemsize > 8:
        raise error(Status.INVALID_ARGUMENT, f"{what}: real numbers of at most 64 bits, not {array.dtype}")
    if array.dtype not in (np.float32, np.float64) or not array.dtype.isnative:
        narrow = array.dtype.kind == "f" and array.dtype.itemsize <= 4
        array = array.astype(np.float32 if narrow else np.float64)
    return View(_readable(array))


def indices(
    values: npt.ArrayLike,
    columns: int | None,
    what: str,
    shape: str,
    status: Status = Status.INVALID_ARGUMENT,
    none: bool = False,
) -> View:
    """Indices: uint16 and uint32, and int32 that has no negative number, are read where they are, other whole numbers become
    uint32. `none`: -1 means none."""
    array = _array(values, columns, what, shape)
    if array.size == 0:
        return View(np.zeros(array.shape, np.uint32))
    if array.dtype.kind not in "iu":
        raise error(Status.INVALID_ARGUMENT, f"{what}: whole numbers, not {array.dtype}")
    if array.dtype.kind == "i":
        lowest = -1 if none else 0
        if array.min() < lowest:
            place = np.argwhere(array < lowest)[0]
            raise error(
                status, f"{what}: element {place[0]} has {array[tuple(place)]}, and indices count from 0"
            )
    if array.dtype == np.int32 and array.dtype.isnative:
        # Its numbers are the same, and -1 is what stands for none.
        array = array.view(np.uint32)
    elif array.dtype not in (np.uint16, np.uint32) or not array.dtype.isnative:
        if array.max() > 0xFFFFFFFF:
            place = np.argwhere(array > 0xFFFFFFFF)[0]
            raise error(status, f"{what}: element {place[0]} has {array[tuple(place)]}, which 32 bits cannot hold")
        array = array.astype(np.uint32)
    return View(_readable(array))


def rows(values: npt.ArrayLike, what: str, shape: str) -> tuple[View, int]:
    """A matrix of numbers, and how many columns it has."""
    columns = _columns(values, what, shape)
    return floats(values, columns, what, shape), columns


def _columns(values: npt.ArrayLike, what: str, shape: str) -> int:
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] == 0:
        raise error(Status.INVALID_ARGUMENT, f"{what}: an array of shape {shape}, not {array.shape}")
    return int(array.shape[1])


def influences(joints: npt.ArrayLike, weights: npt.ArrayLike, what: str) -> tuple[View, View, int]:
    """Joints and weights of vertices, and how many of them a vertex has."""
    shape = "(vertices, influences)"
    columns = _columns(joints, f"{what} joints", shape)
    numbers = floats(weights, columns, f"{what} weights", f"(vertices, {columns}), as of its joints")
    return indices(joints, columns, f"{what} joints", shape, Status.INVALID_WEIGHTS), numbers, columns


def buffer(
    out: npt.NDArray[Any] | None, dtype: npt.DTypeLike, shape: tuple[int, ...], what: str
) -> tuple[npt.NDArray[Any], BespokeBuffer]:
    """An array to be written to: a new one, or the caller's where it can be written in place."""
    if out is None:
        kind = np.dtype(dtype)
        if kind not in (np.float32, np.float64) or not kind.isnative:
            raise error(Status.INVALID_ARGUMENT, f"{what}: they are read as float32 or float64, not {kind}")
        out = np.empty(shape, kind)
    elif not isinstance(out, np.ndarray) or out.dtype not in (np.float32, np.float64) or not out.dtype.isnative:
        found = out.dtype if isinstance(out, np.ndarray) else type(out).__name__
        raise error(Status.INVALID_ARGUMENT, f"{what}: `out` is an array of float32 or float64, not {found}")
    elif out.shape != shape:
        raise error(Status.INVALID_ARGUMENT, f"{what}: `out` has shape {shape}, not {out.shape}")
    elif not out.flags.writeable:
        raise error(Status.INVALID_ARGUMENT, f"{what}: `out` is read-only")
    elif _readable(out) is not out:
        raise error(
            Status.INVALID_ARGUMENT,
            f"{what}: the numbers of a row of `out` lie one after the other, and rows at a positive distance; with strides "
            f"{out.strides} they do not",
        )
    return out, BespokeBuffer(
        data=out.ctypes.data or None,
        capacity=shape[0],
        stride=out.strides[0] if shape[0] > 1 else 0,
        component=_COMPONENTS[out.dtype],
    )


# To ask how many elements there are.
NOTHING = BespokeBuffer(component=_Component.F64)
