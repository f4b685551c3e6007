"""Who owns what, and until when."""

from __future__ import annotations

import gc
import os
import pathlib
import subprocess
import sys
import textwrap
import threading
import time
import unittest
from typing import Any, Callable

import bespoke
import scenes
from bespoke import Stage


def python(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs it in an interpreter of its own."""
    here = str(pathlib.Path(__file__).parent)
    path = os.pathsep.join([here, os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, "-X", "faulthandler", "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "PYTHONPATH": path, **environment},
    )


def threads_of_this_process() -> int:
    return len(os.listdir("/proc/self/task"))


class Shared(scenes.Case):
    def test_many_sessions_over_one_avatar_and_one_garment(self) -> None:
        with scenes.tubes().session() as source:
            avatar, garment = bespoke.Avatar(source), bespoke.Garment(source)
            source.run()
            expected = source.read_garment_vertices()
            with self.assertRaises(bespoke.BespokeError):
                source.use_avatar(avatar)
        sessions = [bespoke.Session(threads=1) for _ in range(6)]
        for make in (bespoke.Avatar, bespoke.Garment):
            with self.assertRaisesRegex(bespoke.BespokeError, "to share"):
                make(sessions[0])
        for session in sessions:
            session.use_avatar(avatar)
            session.use_garment(garment)
        avatar.close()
        avatar.close()
        del garment
        gc.collect()
        with self.assertRaisesRegex(ValueError, "closed"):
            sessions[0].use_avatar(avatar)
        threads = [threading.Thread(target=session.run) for session in sessions]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for session in sessions:
            result = session.read_garment_vertices()
            self.assertEqual(result.dtype, expected.dtype)
            self.same_bits(result, expected)
            session.close()


class Lifetime(scenes.Case):
    def test_close(self) -> None:
        session = scenes.tubes().session()
        session.run()
        control = session.create_control()
        session.close()
        session.close()
        calls: list[Callable[[], Any]] = [
            lambda: scenes.tubes().set_on(session), session.run, session.prepare, session.step, session.reset,
            session.cancel, session.verify, session.read_garment_vertices, session.read_diagnostics,
            session.read_report, session.read_energies, session.create_control, session.read_progress,
            lambda: session.stage, lambda: session.last_message, lambda: session.set_options(),
        ]
        for call in calls:
            with self.assertRaisesRegex(ValueError, "closed"):
                call()
        self.assertIn("closed", repr(session))
        # A control tells on.
        self.assertEqual(control.read_progress().stage, Stage.DONE)
        control.cancel()
        control.close()
        control.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            control.read_progress()

    def test_close_while_it_runs(self) -> None:
        for seconds in (0.0, 0.02, 0.2, 0.6):
            session = scenes.slow().session()
            failures: list[BaseException] = []

            def run() -> None:
                try:
                    session.run(lambda _: None)
                except BaseException as failure:
                    failures.append(failure)

            thread = threading.Thread(target=run)
            thread.start()
            time.sleep(seconds)
            session.close()
            thread.join(5.0)
            self.assertFalse(thread.is_alive())
            self.assertIsInstance(failures[0], (bespoke.CancelledError, ValueError))

    @unittest.skipUnless(os.path.isdir("/proc/self/task"), "counts threads as Linux shows them")
    def test_what_is_forgotten_is_freed(self) -> None:
        before = threads_of_this_process()
        for stage in (Stage.SETUP, Stage.PREPARED, Stage.INFLATE):
            session = scenes.slow().session(threads=3)
            if stage > Stage.SETUP:
                session.prepare()
                self.assertGreater(threads_of_this_process(), before)
            if stage > Stage.PREPARED:
                session.step(1)
            control = session.create_control()
            del session
            gc.collect()
            self.assertEqual(control.read_progress().stage >= Stage.SETUP, True)
            deadline = time.monotonic() + 10.0
            while threads_of_this_process() > before and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertEqual(threads_of_this_process(), before)

    @unittest.skipUnless(os.path.isdir("/proc/self/task"), "reads memory as Linux shows it")
    def test_nothing_leaks(self) -> None:
        scene = scenes.tubes()

        def work() -> None:
            with scene.session(threads=1) as session:
                session.run(lambda _: None)
                session.read_garment_vertices()
                session.read_diagnostics()
                session.create_control()
                try:
                    session.step()
                except bespoke.BespokeError:
                    pass

        def resident() -> int:
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        for _ in range(8):
            work()
        before = resident()
        for _ in range(24):
            work()
        # A session of this size has 4 MB or more.
        self.assertLess(resident() - before, 12 << 20)

    def test_the_interpreter_ends_in_the_middle(self) -> None:
        for code in (
            # Sessions in globals, half done.
            """
            import scenes
            session = scenes.tubes().session()
            session.prepare()
            control = session.create_control()
            other = scenes.tubes().session()
            """,
            # A thread that is thrown away in a call.
            """
            import scenes, threading, time
            session = scenes.slow().session()
            threading.Thread(target=session.run, daemon=True).start()
            time.sleep(0.3)
            """,
            # Cycles through the report.
            """
            import scenes
            class Holder:
                def __init__(self):
                    self.session = scenes.tubes().session()
                    self.session.run(self.hear)
                def hear(self, progress):
                    pass
            Holder().session.holder = Holder()
            """,
        ):
            ended = python(code)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""), code)

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork")
    def test_a_forked_process(self) -> None:
        ended = python(
            """
            import os, scenes, bespoke
            session = scenes.tubes().session()
            session.run()
            child = os.fork()
            if child == 0:
                try:
                    session.read_garment_vertices()
                except bespoke.BespokeError as failure:
                    os._exit(0 if failure.status == bespoke.Status.INVALID_STATE else 1)
                os._exit(2)
            assert os.waitpid(child, 0)[1] == 0
            session.read_garment_vertices()
            """
        )
        # Newer interpreters warn of a fork beside threads.
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_libraries_that_are_none(self) -> None:
        libc = next(p for p in ("/lib/x86_64-linux-gnu/libm.so.6", "/usr/lib/libSystem.dylib", sys.executable)
                    if os.path.exists(p))
        for path, words in (("/nowhere/libbespoke.so", "is not there"), (libc, "is not"), (__file__, "cannot be loaded")):
            code = "import bespoke\ntry:\n    bespoke.Session()\nexcept ImportError as reason:\n    print(reason)"
            ended = python(code, BESPOKE_LIBRARY=path)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertIn(words, ended.stdout)
            self.assertIn(path, ended.stdout)


if __name__ == "__main__":
    unittest.main()
