"""Avatars and garments that several sessions share."""

from __future__ import annotations

import ctypes
import threading
import weakref
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from ._library import load

if TYPE_CHECKING:
    from ._session import Session

_Self = TypeVar("_Self", bound="_Shared")


class _Shared:
    """A handle that sessions are told to use."""

    _kind = ""
    _create = ""
    _use = ""
    _destroy = ""

    def __init__(self, session: Session) -> None:
        handle = ctypes.c_void_p()
        session._handle.call(self._create, ctypes.byref(handle))
        self._handle = handle
        # Its calls take no time: that `close` waits for one is not noticed.
        self._lock = threading.RLock()
        self._free = weakref.finalize(self, getattr(load(), self._destroy), handle)

    def close(self) -> None:
        """Frees it; a second time does nothing. Sessions that use it go on."""
        with self._lock:
            self._free()

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _give(self, session: Session) -> None:
        with self._lock:
            if not self._free.alive:
                raise ValueError(f"this {self._kind} is closed")
            session._handle.call(self._use, self._handle)


class Avatar(_Shared):
    """A body to dress, for many sessions at once in any threads: `Session.use_avatar`.

        avatar = bespoke.Avatar(session)    # of all that was set of its target
        for garment in garments:
            with bespoke.Session() as other:
                other.use_avatar(avatar)
                ...

    What the sessions need of it alone, above all the distance field, is computed by the first of them and taken by the others; the
    results are those without sharing. `close`, the end of a `with` block or its own end frees it, and sessions keep what they
    use.
    """

    _kind = "avatar"
    _create = "bespoke_avatar_create"
    _use = "bespoke_session_use_avatar"
    _destroy = "bespoke_avatar_destroy"

    def __init__(self, session: Session) -> None:
        """The target of `session` as it was set so far: mesh, skeleton or rig, skin weights, parts, layers, morphs and coordinate
        system. The session itself shares it only once it is told to. Stage: any. Errors: INVALID_STATE without a target
        avatar."""
        super().__init__(session)


class Garment(_Shared):
    """A garment to fit, for many sessions at once in any threads: `Session.use_garment`. Otherwise as `Avatar`, but less is saved:
    most of the work depends on the avatar, too.
    """

    _kind = "garment"
    _create = "bespoke_garment_create"
    _use = "bespoke_session_use_garment"
    _destroy = "bespoke_garment_destroy"

    def __init__(self, session: Session) -> None:
        """The garment of `session` as it was set so far, with source skeleton or rig, source avatar, the skin weights of both, fit weights,
        pins, rigid groups, curves, morphs, followers and the source coordinate system. Stage: any. Errors: INVALID_STATE without
        a garment."""
        super().__init__(session)
        self._shape: tuple[int, int, np.dtype[Any]] = (session._vertices, session._triangles, session._dtype)
