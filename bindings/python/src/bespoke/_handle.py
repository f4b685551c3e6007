"""The handle of a session: one call at a time, calls that Ctrl-C can stop, and an end that frees it once."""

from __future__ import annotations

import ctypes
import threading
import weakref
from typing import Any

from ._enums import Status
from ._errors import BespokeError, error
from ._library import load, status_name
from ._native import BespokeDiagnostic, BespokeProgress
from ._values import Diagnostic, Progress


class Control:
    """Cancel and progress of one session, for any thread at any time. It may outlive the session.

    `Session.create_control` makes it; `close`, the end of a `with` block or its own end frees it.
    """

    def __init__(self, session: ctypes.c_void_p) -> None:
        self._library = load()
        handle = ctypes.c_void_p()
        status = Status(self._library.bespoke_session_create_control(session, ctypes.byref(handle)))
        if status != Status.OK:
            raise error(status, f"no control could be made: {status_name(status)}")
        self._handle = handle
        # Its calls take no time: that `close` waits for one is not noticed.
        self._lock = threading.RLock()
        self._free = weakref.finalize(self, self._library.bespoke_control_destroy, handle)

    def cancel(self) -> None:
        """Cancels the session: see `Session.cancel`. Without effect once the session is closed."""
        with self._lock:
            self._check()
            self._library.bespoke_control_cancel(self._handle)

    def read_progress(self) -> Progress:
        """Progress of the session as of its last iteration; once the session is closed, the last."""
        native = BespokeProgress()
        native.struct_size = ctypes.sizeof(native)
        with self._lock:
            self._check()
            self._library.bespoke_control_read_progress(self._handle, ctypes.byref(native))
        return Progress._from_native(native)

    def close(self) -> None:
        """Frees the control; a second time does nothing. The session runs on."""
        with self._lock:
            self._free()

    def __enter__(self) -> Control:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _check(self) -> None:
        if not self._free.alive:
            raise ValueError("this control is closed")


class Handle:
    """A session of the library.

    It is freed by whoever leaves last: `close`, or the call that it has cancelled. So nobody waits for another, not even a
    signal handler that closes the session in the middle of a call.
    """

    def __init__(self) -> None:
        self.library = load()
        handle = ctypes.c_void_p()
        status = Status(self.library.bespoke_session_create(ctypes.byref(handle)))
        if status != Status.OK:
            raise error(status, f"no session could be made: {status_name(status)}")
        self._handle = handle
        # A handler may come between any two lines, in the thread that is inside already.
        self._lock = threading.RLock()
        self._users = 0
        self._closing = False
        # Also where it is forgotten, and at the end of the process, before the interpreter goes.
        self._free = weakref.finalize(self, self.library.bespoke_session_destroy, handle)
        self.control = Control(handle)

    def close(self) -> None:
        """Cancels what runs, and frees the session, at the latest when that returns."""
        with self._lock:
            if self._closing:
                return
            self._closing = True
            self.control.cancel()
            if self._users == 0:
                self._free()
            self.control.close()

    def check_open(self) -> None:
        """ValueError where the session is closed."""
        if self._closing:
            raise ValueError("this session is closed")

    def call(self, name: str, *arguments: Any, findings: bool = False) -> None:
        """Calls a function of the library with this session."""
        self._enter()
        try:
            status = Status(getattr(self.library, name)(self._handle, *arguments))
            if status != Status.OK:
                raise self._failure(status, findings)
        finally:
            self._leave()

    def call_long(self, name: str, *arguments: Any, findings: bool = False) -> None:
        """The same for a function that may take long and that a cancel ends. In the main thread, where Python hears of Ctrl-C,
        it runs in a thread of its own meanwhile: an exception of a signal handler, such as KeyboardInterrupt, cancels it."""
        if threading.current_thread() is not threading.main_thread():
            self.call(name, *arguments, findings=findings)
            return
        failures: list[BaseException] = []
        ended = threading.Event()
        # Taken once: by the thread as it begins, or by who gives up before that.
        turn = threading.Lock()

        def work() -> None:
            try:
                if turn.acquire(blocking=False):
                    self.call(name, *arguments, findings=findings)
            except BaseException as failure:
                failures.append(failure)
            finally:
                ended.set()

        thread = threading.Thread(target=work, name="bespoke call", daemon=True)
        try:
            thread.start()
            _wait(ended)
        except BaseException as reason:
            if not turn.acquire(blocking=False):
                self._stop(ended)
            elif isinstance(reason, RuntimeError):
                # The system starts no more threads. The library says so, too, where it cannot do with what it has.
                self.call(name, *arguments, findings=findings)
                return
            raise
        if failures:
            raise failures[0]

    def create_control(self) -> Control:
        """One for the caller."""
        self._enter()
        try:
            return Control(self._handle)
        finally:
            self._leave()

    def last_message(self) -> str:
        """The message of the last call that failed."""
        self._enter()
        try:
            return self._message()
        finally:
            self._leave()

    def read_diagnostics(self) -> tuple[Diagnostic, ...]:
        """All of them."""
        count = ctypes.c_size_t()
        self.call("bespoke_session_read_diagnostics", None, 0, ctypes.byref(count))
        native = (BespokeDiagnostic * count.value)()
        if count.value:
            native[0].struct_size = ctypes.sizeof(BespokeDiagnostic)
        self.call("bespoke_session_read_diagnostics", native, count.value, ctypes.byref(count))
        # Another call between the two may have left fewer of them, or more.
        return tuple(Diagnostic._from_native(one) for one in native[: count.value])

    def _enter(self) -> None:
        with self._lock:
            self.check_open()
            self._users += 1

    def _leave(self) -> None:
        with self._lock:
            self._users -= 1
            if self._closing and self._users == 0:
                self._free()

    def _message(self) -> str:
        needed = ctypes.c_size_t()
        self.library.bespoke_session_last_message(self._handle, None, 0, ctypes.byref(needed))
        # Another thread may have left a longer sentence meanwhile, which is cut then.
        text = ctypes.create_string_buffer(max(needed.value, 1))
        self.library.bespoke_session_last_message(self._handle, text, len(text), None)
        return text.value.decode("utf-8", "replace")

    def _failure(self, status: Status, findings: bool) -> BespokeError:
        # The library leaves no sentence then, for the last one is that of the other call.
        if status == Status.BUSY:
            return error(status, "another thread is inside a call with this session; nothing was done")
        message = self._message() or status_name(status)
        diagnostics: tuple[Diagnostic, ...] = ()
        # A session that was closed meanwhile tells no more.
        if findings and not self._closing:
            try:
                diagnostics = self.read_diagnostics()
            except (BespokeError, ValueError):
                pass
        return error(status, message, diagnostics)

    def _stop(self, ended: threading.Event) -> None:
        """Cancels the call that runs and waits for its end, a tenth of a second at most, through further signals."""
        while not ended.is_set():
            try:
                if not self._closing:
                    self.control.cancel()
                _wait(ended)
            except BaseException:
                continue


def _wait(ended: threading.Event) -> None:
    # With a limit, so that a signal is heard on every system.
    while not ended.wait(0.05):
        pass
