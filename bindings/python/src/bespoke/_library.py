"""Finds the native library and loads it, when something of it is needed first."""

from __future__ import annotations

import ctypes
import os
import pathlib
import sys
import threading

from . import _native
from ._enums import Status

# Names the library to load instead of the one in the package, such as one that was just built.
VARIABLE = "BESPOKE_LIBRARY"

_lock = threading.Lock()
_loaded: ctypes.CDLL | None = None


def path() -> pathlib.Path:
    """The file that is loaded: the one that the environment variable BESPOKE_LIBRARY names, else the package's own."""
    named = os.environ.get(VARIABLE)
    if named:
        return pathlib.Path(named)
    suffix = {"darwin": "libbespoke.dylib", "win32": "bespoke.dll"}.get(sys.platform, "libbespoke.so")
    return pathlib.Path(__file__).with_name(suffix)


def load() -> ctypes.CDLL:
    """The library.

    Errors: ImportError, where it is not there, cannot be loaded, or has another binary interface than this package.
    """
    global _loaded
    if _loaded is not None:
        return _loaded
    with _lock:
        if _loaded is None:
            _loaded = _open(path())
    return _loaded


def _open(file: pathlib.Path) -> ctypes.CDLL:
    if not file.is_file():
        raise ImportError(
            f"bespoke: the native library {file} is not there; install a wheel, which `make wheel` builds, or name a "
            f"library in the environment variable {VARIABLE}"
        )
    try:
        library = ctypes.CDLL(str(file))
    except OSError as reason:
        raise ImportError(f"bespoke: the native library {file} cannot be loaded: {reason}") from reason
    try:
        library.bespoke_abi_version.restype = ctypes.c_uint32
        interface = int(library.bespoke_abi_version())
        if interface == _native.BESPOKE_ABI_VERSION:
            _native.declare(library)
            return library
    except AttributeError as reason:
        raise ImportError(f"bespoke: {file} is not the library that this package is for: {reason}") from reason
    raise ImportError(
        f"bespoke: {file} has binary interface {interface}, and this package was written for "
        f"{_native.BESPOKE_ABI_VERSION}: put the library that it came with in its place"
    )


def version() -> str:
    """The version of the library that is loaded, such as "0.1.0". Errors: ImportError, where there is none."""
    return _text(load().bespoke_version_text())


def status_name(status: int) -> str:
    """The name of a status in C, such as "BESPOKE_STATUS_BUSY"; "BESPOKE_STATUS_UNKNOWN" for any other number."""
    return _text(load().bespoke_status_name(Status(status)))


def _text(text: bytes) -> str:
    return text.decode("utf-8", "replace")
