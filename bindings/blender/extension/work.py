"""The fitting itself: garments one over the other on one body, in a thread. Knows nothing of Blender."""

from __future__ import annotations

import dataclasses
import math
import threading
from collections.abc import Callable, Sequence
from typing import Any

import bespoke
import numpy as np
import numpy.typing as npt
from bespoke import Progress, Session, Stage

from . import turns

Array = npt.NDArray[Any]
Influences = tuple[Array, Array]


@dataclasses.dataclass
class Body:
    """Meshes of one character as one."""

    vertices: Array
    triangles: Array
    influences: Influences | None
    roles: Array | None = None


@dataclasses.dataclass
class Follower:
    """What goes along with a garment, as it was modelled: a trim, a badge, a level of detail."""

    name: str
    vertices: Array
    triangles: Array
    morphs: list[tuple[str, Array]] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Garment:
    """One garment as it was modelled."""

    name: str
    vertices: Array
    """Float32: in this precision the result is verified."""
    triangles: Array
    influences: Influences | None
    is_bound: bool
    """Whether it is on the source's armature, which then says where it belongs."""
    morphs: list[tuple[str, Array]] = dataclasses.field(default_factory=list)
    fit_weights: Array | None = None
    pins: Array | None = None
    rigid_groups: list[Array] = dataclasses.field(default_factory=list)
    followers: list[Follower] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Task:
    """All that is to be done."""

    garments: list[Garment]
    source_rig: list[bespoke.Joint]
    source: Body | None
    """The body that the garments were made for."""
    target_rig: list[bespoke.Joint]
    target: Body
    layers: list[tuple[Array, Array]]
    """Garments that the target wears already, from the inside outwards: vertices and triangles."""
    pairs: list[tuple[int, int]]
    options: bespoke.Options
    target_morphs: list[tuple[str, Array]] = dataclasses.field(default_factory=list)
    """What the garments are to follow: names, and offsets of all vertices of the target."""
    influences: int = 4
    asks_for_covered: bool = False


@dataclasses.dataclass
class Worn:
    """A mesh on the other body."""

    vertices: Array | None = None
    """None where it is not dressed."""
    morphs: list[Array] = dataclasses.field(default_factory=list)
    skin: Influences | None = None


@dataclasses.dataclass
class Outcome(Worn):
    """What became of one garment."""

    followers: list[Worn] = dataclasses.field(default_factory=list)
    answers: list[tuple[str, Array]] = dataclasses.field(default_factory=list)
    """How it follows the target's morphs; one that it cannot follow is left out, and told by a finding."""
    added: tuple[bespoke.AddedJoint, ...] = ()
    covered: Array | None = None
    """Triangles of the body that nobody sees now, where they were asked for."""
    findings: tuple[bespoke.Diagnostic, ...] = ()
    report: bespoke.Report | None = None
    failure: bespoke.BespokeError | None = None
    """Why it is not dressed, or with a result what is not as designed."""


def side_by_side(task: Task) -> Session:
    """A session with both rigs and what is known of their skins: enough for the joint map."""
    session = Session(task.options)
    session.set_target_coordinate_system(bespoke.CoordinateSystem.BLENDER)
    session.set_source_rig(task.source_rig)
    session.set_target_rig(task.target_rig)
    session.set_joint_pairs(np.array(task.pairs, np.int32).reshape(-1, 2))
    session.set_target_avatar(task.target.vertices, task.target.triangles)
    if task.target.influences is not None:
        session.set_target_skin_influences(*task.target.influences, joint_count=len(task.target_rig))
    if task.source is not None:
        session.set_source_avatar(task.source.vertices, task.source.triangles)
        if task.source.influences is not None:
            session.set_source_skin_influences(*task.source.influences, joint_count=len(task.source_rig))
    return session


def filled(task: Task, garment: Garment, layers: Sequence[tuple[Array, Array]]) -> Session:
    """A session for one garment, over what is worn already."""
    session = side_by_side(task)
    # What is bound to an armature is in its place, whatever it looks like.
    axes = dataclasses.replace(bespoke.CoordinateSystem.BLENDER, trusted=garment.is_bound)
    session.set_source_coordinate_system(axes)
    session.set_garment(garment.vertices, garment.triangles)
    if garment.influences is not None:
        session.set_garment_skin_influences(*garment.influences, joint_count=len(task.source_rig))
    if task.target.roles is not None:
        session.set_avatar_parts(task.target.roles)
    if garment.fit_weights is not None:
        session.set_vertex_fit_weights(garment.fit_weights)
    if garment.pins is not None:
        session.set_pinned_vertices(garment.pins)
    for group in garment.rigid_groups:
        session.add_rigid_group(group)
    for name, offsets in garment.morphs:
        session.add_garment_morph(offsets, name)
    for name, offsets in task.target_morphs:
        session.add_target_morph(offsets, name)
    for follower in garment.followers:
        session.add_follower(follower.vertices, follower.triangles)
    for vertices, triangles in layers:
        session.add_layer(vertices, triangles)
    return session


def share(progress: Progress) -> float:
    """How far a session is, from 0 to 1, by what the stages of a usual run take. The fit has no end that is known
    before: it comes nearer to its own with each iteration. As in the program `bespoke`."""
    if progress.stage == Stage.PREPARED:
        return 0.1
    if progress.stage == Stage.INFLATE:
        return 0.1 + 0.3 * progress.t
    if progress.stage == Stage.REPOSE:
        return 0.4 + 0.2 * progress.t
    if progress.stage == Stage.FIT:
        return 0.6 + 0.35 * (1.0 - math.exp(-progress.iteration / 20.0))
    return {Stage.VERIFY: 0.97, Stage.DONE: 1.0}.get(progress.stage, 0.0)


# As in the program `bespoke`.
STAGES = {
    Stage.SETUP: "preparing",
    Stage.PREPARED: "preparing",
    Stage.INFLATE: "growing the body inside",
    Stage.REPOSE: "taking the body to its pose",
    Stage.FIT: "fitting",
    Stage.VERIFY: "verifying",
    Stage.DONE: "done",
    Stage.FAILED: "failed",
    Stage.CANCELLED: "stopped",
}


class Run:
    """Dresses one garment after the other, in a thread of its own (`start`) or in the caller's (`work`).

    `cancel`, `progress` and `is_over` are for any thread. When it is over, `outcomes` has one for each garment, or
    fewer where it was cancelled.
    """

    def __init__(self, task: Task) -> None:
        self.task = task
        self.outcomes: list[Outcome] = []
        self.defect: BaseException | None = None
        self._cancelled = threading.Event()
        self._over = threading.Event()
        self._lock = threading.Lock()
        self._session: Session | None = None
        self._answers = False
        self._told = 0.0
        self._thread = threading.Thread(target=self._guarded, name="bespoke run", daemon=True)

    def start(self) -> None:
        """In a thread of its own."""
        self._thread.start()

    def work(self, progress: Callable[[float, str], object] | None = None) -> None:
        """In this thread; `progress` is called some twenty times a second."""
        tell = None if progress is None else lambda _: progress(*self.progress())
        try:
            self._dress_all(tell)
        finally:
            self._over.set()

    def cancel(self) -> None:
        """Stops it; a running call ends within 100 ms."""
        self._cancelled.set()
        with self._lock:
            if self._session is not None:
                self._session.cancel()

    def wait(self, seconds: float | None = None) -> bool:
        """Until it is over; whether it is."""
        return self._over.wait(seconds)

    @property
    def is_over(self) -> bool:
        """Whether all is done."""
        return self._over.is_set()

    @property
    def is_cancelled(self) -> bool:
        """Whether somebody has asked it to stop."""
        return self._cancelled.is_set()

    def progress(self) -> tuple[float, str]:
        """From 0 to 1, and in words."""
        done, count = len(self.outcomes), len(self.task.garments)
        if done >= count:
            return 1.0, STAGES[Stage.DONE]
        with self._lock:
            now = self._session.read_progress() if self._session is not None else None
        part, stage = (0.0, STAGES[Stage.SETUP]) if now is None else (self._share(now), STAGES.get(now.stage, ""))
        self._told = max(self._told, (done + part) / count)
        return self._told, f"{self.task.garments[done].name}: {stage}"

    def _share(self, now: Progress) -> float:
        own = share(now)
        if not self.task.target_morphs:
            return own
        # To follow takes about as long again, with stages that begin anew.
        if not self._answers:
            return own / 2.0
        return 0.5 + (own / 2.0 if now.stage in (Stage.REPOSE, Stage.FIT) else 0.0)

    def _guarded(self) -> None:
        try:
            self.work()
        except BaseException as defect:
            self.defect = defect

    def _dress_all(self, progress: Callable[[Progress], object] | None) -> None:
        layers = list(self.task.layers)
        for garment in self.task.garments:
            try:
                outcome = self._try(garment, layers, progress)
            except bespoke.CancelledError:
                return
            self.outcomes.append(outcome)
            if outcome.vertices is not None:
                layers.append((outcome.vertices, garment.triangles))

    def _try(
        self,
        garment: Garment,
        layers: Sequence[tuple[Array, Array]],
        progress: Callable[[Progress], object] | None,
    ) -> Outcome:
        outcome = Outcome()
        try:
            with filled(self.task, garment, layers) as session:
                self._watch(session)
                try:
                    self._dress(session, garment, outcome, progress)
                finally:
                    self._watch(None)
        except bespoke.CancelledError:
            raise
        except bespoke.BespokeError as failure:
            outcome.failure, outcome.findings = failure, failure.diagnostics
        return outcome

    def _watch(self, session: Session | None) -> None:
        with self._lock:
            self._session, self._answers = session, False
            if session is not None and self._cancelled.is_set():
                session.cancel()

    def _dress(
        self, session: Session, garment: Garment, outcome: Outcome, progress: Callable[[Progress], object] | None
    ) -> None:
        try:
            session.run(progress)
        except bespoke.ImplausibleResultError as implausible:
            outcome.failure = implausible
            outcome.findings = session.read_diagnostics()
            identity = np.broadcast_to(np.eye(4), (len(self.task.target_rig), 4, 4))
            if not np.array_equal(session.read_pose_transforms(), identity):
                # In the pose of the design it is no garment on the armature as it is.
                return
        if outcome.failure is None and self.task.target_morphs:
            self._follow(session, outcome)
        if self.task.target.influences is not None:
            bones, weights, _ = session.read_garment_skin_influences(self.task.influences)
            outcome.skin = (bones, weights)
            outcome.added = session.read_added_joints()
        outcome.morphs = [session.read_garment_morph(k) for k in range(len(garment.morphs))]
        outcome.followers = [self._follower(session, k, follower) for k, follower in enumerate(garment.followers)]
        if self.task.asks_for_covered:
            outcome.covered = session.read_covered_triangles()
        outcome.findings = session.read_diagnostics()
        outcome.report = session.read_report()
        outcome.vertices = session.read_garment_vertices()

    def _follow(self, session: Session, outcome: Outcome) -> None:
        self._answers = True
        try:
            session.solve_target_morphs()
        except bespoke.CancelledError:
            raise
        except bespoke.BespokeError as failure:
            # The result is good as it is.
            outcome.failure = failure
        for k, (name, _) in enumerate(self.task.target_morphs):
            try:
                outcome.answers.append((name, session.read_target_morph(k)))
            except bespoke.BespokeError as failure:
                if failure.status != bespoke.Status.INVALID_STATE:
                    raise

    def _follower(self, session: Session, number: int, design: Follower) -> Worn:
        worn = Worn(vertices=session.read_follower_vertices(number))
        if self.task.target.influences is not None:
            worn.skin = session.read_follower_skin_influences(number, self.task.influences)[:2]
        moved = turns.turns(design.triangles, design.vertices, worn.vertices)
        worn.morphs = [turns.turned(moved, offsets) for _, offsets in design.morphs]
        return worn
