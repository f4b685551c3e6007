"""What a user writes, for the type checker alone: it is never run. A line that is wrong says so, and is counted on."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import bespoke


def right(mesh: bespoke.MeshLike, skeleton: bespoke.Skeleton, rig: list[bespoke.Joint]) -> npt.NDArray[np.float32]:
    options = bespoke.Options(fit_weight=3.0, strict=True)
    dressed = bespoke.dress(mesh, ([[0.0, 0.0, 0.0]], [[0, 0, 0]]), skeleton, rig, options=options, offset=0.01)
    with bespoke.Session(threads=2) as session:
        session.set_garment(dressed.vertices, dressed.faces)
        session.run(lambda progress: print(progress.stage.name, progress.t))
        vertices: npt.NDArray[np.float32] = session.read_garment_vertices()
        kinds: list[bespoke.DiagnosticKind] = [one.kind for one in session.read_diagnostics()]
        stage: bespoke.Stage = session.step(max_iterations=3)
        print(kinds, stage, session.read_joint_map()[0].target)
    try:
        bespoke.dress(dressed, dressed, skeleton, skeleton)
    except bespoke.BespokeError as failure:
        status: bespoke.Status = failure.status
        print(status, [element.index for one in failure.diagnostics for element in one.elements])
    return vertices


def wrong(session: bespoke.Session, skeleton: bespoke.Skeleton) -> None:
    session.set_options(fit_wieght=3.0)  # type: ignore[call-arg]
    session.set_options(threads="two")  # type: ignore[arg-type]
    session.run(progress=3)  # type: ignore[arg-type]
    session.stage = bespoke.Stage.DONE  # type: ignore[misc]
    bespoke.dress("garment.obj", "avatar.obj", skeleton, skeleton)  # type: ignore[arg-type]
    message: int = session.last_message  # type: ignore[assignment]
    print(message)
