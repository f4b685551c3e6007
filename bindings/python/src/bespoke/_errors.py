"""What goes wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._enums import Status
from ._values import Diagnostic

if TYPE_CHECKING:
    from ._dress import Dressed


class BespokeError(Exception):
    """A call that failed. It says what, where and which element.

    The library's own sentence is `message`, and the text of the exception.
    """

    def __init__(self, status: Status, message: str, diagnostics: tuple[Diagnostic, ...] = ()) -> None:
        super().__init__(message)
        self.status = status
        """Which error it is."""
        self.message = message
        """One sentence."""
        self.diagnostics = diagnostics
        """What was found about inputs and result until then, where the call was one that works on them: `prepare`, `step`
        and `run`."""

    def __reduce__(self) -> tuple[type[BespokeError], tuple[Status, str, tuple[Diagnostic, ...]]]:
        return (type(self), (self.status, self.message, self.diagnostics))


class InvalidInputError(BespokeError, ValueError):
    """An argument, mesh, skeleton or weights that cannot be used: INVALID_ARGUMENT, INVALID_MESH, INVALID_SKELETON,
    INVALID_WEIGHTS. It is a ValueError, too.
    """


class CancelledError(BespokeError):
    """The caller has cancelled. The last garment can be read; `Session.reset` begins anew."""


class ImplausibleResultError(BespokeError):
    """There is a result, verified, but it is not as designed: `diagnostics` name limbs and pieces.

    A session can be read like any other that is done; `dress` leaves what it made in `result`.
    """

    result: Dressed | None = None
    """What `dress` made; None with a session."""


_CLASSES: dict[Status, type[BespokeError]] = {
    Status.INVALID_ARGUMENT: InvalidInputError,
    Status.INVALID_MESH: InvalidInputError,
    Status.INVALID_SKELETON: InvalidInputError,
    Status.INVALID_WEIGHTS: InvalidInputError,
    Status.CANCELLED: CancelledError,
    Status.IMPLAUSIBLE_RESULT: ImplausibleResultError,
}


def error(status: Status, message: str, diagnostics: tuple[Diagnostic, ...] = ()) -> BespokeError:
    """The exception of the class for this status."""
    return _CLASSES.get(status, BespokeError)(status, message, diagnostics)
