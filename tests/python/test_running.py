"""Progress, steps, threads, and every way to stop."""

from __future__ import annotations

import signal
import threading
import time
import unittest
from typing import Any, Callable

import numpy as np

import bespoke
import scenes
from bespoke import Progress, Stage, Status

# Machines that run tests are busy: far above what is promised, and far below a run that is not stopped.
PROMPT = 1.5


class Failed(Exception):
    pass


def later(seconds: float, call: Callable[[], object]) -> threading.Timer:
    timer = threading.Timer(seconds, call)
    timer.daemon = True
    timer.start()
    return timer


class Running(scenes.Case):
    def test_progress(self) -> None:
        heard: list[Progress] = []
        with scenes.tubes().session() as session:
            before = time.monotonic()
            session.run(heard.append)
            seconds = time.monotonic() - before
            expected = session.read_garment_vertices()
            stages = [one.stage for one in heard]
            self.assertEqual(stages, sorted(stages))
            self.assertEqual((stages[0], stages[-1]), (Stage.SETUP, Stage.DONE))
            self.assertEqual((heard[-1].t, len(heard[-1].energies)), (1.0, session.read_report().energy_count))
            self.assertLessEqual(len(heard), 4 + 20 * seconds)
            self.assertGreaterEqual(len(heard), 3)
            session.reset()
            session.run()
            self.same_bits(session.read_garment_vertices(), expected)

    def test_what_a_report_raises_ends_the_call_alone(self) -> None:
        with scenes.tubes().session() as session:
            session.run()
            expected = session.read_garment_vertices()
            for wanted in (Stage.SETUP, Stage.PREPARED, Stage.DONE):
                session.reset()

                def fail(progress: Progress) -> None:
                    if progress.stage == wanted:
                        raise Failed(wanted.name)

                with self.assertRaisesRegex(Failed, wanted.name):
                    session.run(fail)
                self.assertEqual(session.stage, wanted)
                if wanted != Stage.DONE:
                    session.run()
                self.same_bits(session.read_garment_vertices(), expected)

    def test_steps(self) -> None:
        with scenes.tubes().session() as session:
            session.run()
            expected = session.read_garment_vertices()
            session.reset()
            session.prepare()
            count = 0
            stage = session.stage
            while stage != Stage.DONE:
                stage = session.step(max_iterations=1)
                self.assertEqual(stage, session.stage)
                self.assertTrue(np.isfinite(session.read_garment_vertices()).all())
                count += 1
            self.assertGreater(count, 5)
            self.same_bits(session.read_garment_vertices(), expected)

    def test_a_session_in_a_report(self) -> None:
        # It may be read there, and closed.
        previews: list[scenes.Array] = []
        with scenes.tubes().session() as session:

            def look(progress: Progress) -> None:
                if progress.stage > Stage.SETUP:
                    previews.append(session.read_garment_vertices())

            session.run(look)
            self.same_bits(previews[-1], session.read_garment_vertices())
            session.reset()
            with self.assertRaisesRegex(ValueError, "closed"):
                session.run(lambda _: session.close())

    def test_cancel(self) -> None:
        for seconds in (0.0, 0.05, 0.3, 0.8):
            with scenes.slow().session() as session:
                control = session.create_control()
                stopped: list[float] = []

                def stop() -> None:
                    stopped.append(time.monotonic())
                    control.cancel()

                later(seconds, stop)
                failure = self.refused(Status.CANCELLED, session.run)
                self.assertIsInstance(failure, bespoke.CancelledError)
                self.assertLess(time.monotonic() - stopped[0], PROMPT)
                # The request stays until it is taken back.
                self.refused(Status.CANCELLED if session.stage == Stage.SETUP else Status.INVALID_STATE, session.run)
                session.reset()
                self.assertEqual(session.stage, Stage.SETUP)

    def test_cancel_while_it_verifies(self) -> None:
        with scenes.tubes().session() as session:
            session.prepare()
            session.cancel()
            self.refused(Status.CANCELLED, session.verify)
            self.assertEqual(session.stage, Stage.PREPARED)

    def interrupted(self, call: Callable[[], Any], seconds: float, error: type[BaseException]) -> None:
        sent: list[float] = []

        def send() -> None:
            sent.append(time.monotonic())
            signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)

        timer = later(seconds, send)
        with self.assertRaises(error):
            call()
        self.assertLess(time.monotonic() - sent[0], PROMPT)
        timer.join()

    def test_ctrl_c(self) -> None:
        # Who runs the tests may have it ignored.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        try:
            for seconds in (0.02, 0.3, 0.8):
                with scenes.slow().session() as session:
                    self.interrupted(session.run, seconds, KeyboardInterrupt)
                    self.assertIn(session.stage, (Stage.SETUP, Stage.CANCELLED))
                    session.reset()
                    self.interrupted(lambda: session.run(lambda _: None), seconds, KeyboardInterrupt)
            # All that `dress` has made is gone with it.
            scene = scenes.slow()
            source, target = (scene.source, scene.bones), (scene.target, scene.bones)
            self.interrupted(lambda: bespoke.dress(scene.garment, scene.avatar, source, target), 0.3, KeyboardInterrupt)
            # The interpreter is as before.
            with scenes.tubes().session() as session:
                session.run()
        finally:
            signal.signal(signal.SIGINT, before)

    def test_signal_handlers_of_the_caller(self) -> None:
        heard: list[int] = []
        before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
        try:
            # One that raises nothing stops nothing.
            with scenes.tubes().session() as session:
                later(0.02, lambda: signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)).join()
                session.run()
                self.assertEqual((session.stage, heard), (Stage.DONE, [signal.SIGINT]))
            # One may close the session under the call that runs.
            session = scenes.slow().session()
            signal.signal(signal.SIGINT, lambda *_: session.close())
            self.interrupted(session.run, 0.3, bespoke.CancelledError)
            with self.assertRaisesRegex(ValueError, "closed"):
                session.run()
        finally:
            signal.signal(signal.SIGINT, before)

    def test_two_threads_in_one_session(self) -> None:
        with scenes.slow().session() as session:
            failures: list[BaseException] = []

            def run() -> None:
                try:
                    session.run()
                except BaseException as failure:
                    failures.append(failure)

            thread = threading.Thread(target=run)
            thread.start()
            while session.read_progress().prepare_seconds == 0.0 and thread.is_alive():
                time.sleep(0.001)
            for call in (session.run, session.step, session.read_report, session.reset, session.verify,
                         session.read_garment_vertices, lambda: session.set_options(threads=1)):
                self.refused(Status.BUSY, call, "another thread")
            # These are for any time.
            self.assertIsInstance(session.stage, Stage)
            self.assertEqual(session.last_message, "")
            session.create_control().close()
            session.cancel()
            thread.join()
            self.assertIsInstance(failures[0], bespoke.CancelledError)

    def test_the_interpreter_is_free_meanwhile(self) -> None:
        with scenes.slow().session() as session:
            thread = threading.Thread(target=lambda: self.assertRaises(bespoke.CancelledError, session.run))
            thread.start()
            longest, before = 0.0, time.monotonic()
            begin = before
            while before - begin < 0.8:
                time.sleep(0.002)
                now = time.monotonic()
                longest, before = max(longest, now - before), now
            self.assertTrue(thread.is_alive())
            session.cancel()
            thread.join()
            self.assertLess(longest, 0.5)

    def test_a_system_without_another_thread(self) -> None:
        original = threading.Thread.start

        def start(self: threading.Thread) -> None:
            raise RuntimeError("can't start new thread")

        with scenes.tubes().session(threads=1) as session:
            threading.Thread.start = start  # type: ignore[method-assign]
            try:
                session.run()
            finally:
                threading.Thread.start = original  # type: ignore[method-assign]
            self.assertEqual(session.stage, Stage.DONE)

    def test_many_sessions_at_once(self) -> None:
        scene = scenes.tubes()
        with scene.session() as session:
            session.run()
            expected = session.read_garment_vertices()
        results: list[scenes.Array] = []

        def dress() -> None:
            with scene.session(threads=1) as session:
                session.run()
                results.append(session.read_garment_vertices())

        threads = [threading.Thread(target=dress) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 6)
        for result in results:
            self.same_bits(result, expected)


if __name__ == "__main__":
    unittest.main()
