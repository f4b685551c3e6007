"""Dresses skeletal meshes from the Python of the Unreal Editor: nothing has to be compiled.

    import bespoke_unreal
    bespoke_unreal.dress(
        ["/Game/Clothes/SK_Coat"], made_for="/Game/Mannequin/SKM_Manny", worn_by="/Game/Heroes/SK_Hero"
    )

`joint_map` shows which bones correspond, for `pairs` to mend; `take_back` deletes what was made last.

It goes by the editor's Geometry Script plugin, and by the package `bespoke`, which asks for NumPy.
"""

from __future__ import annotations

import contextlib
import dataclasses
import math
import posixpath
from collections.abc import Iterator, Sequence

import unreal

try:
    import bespoke
    import numpy as np
except ImportError as missing:
    raise ImportError(
        f"{missing}; install it with the editor's own interpreter: bindings/unreal/README.md of Bespoke has the line"
    ) from missing

# Geometry Script knows nothing of added bones, so a vertex has those of the body alone.
INFLUENCES = 8

# As in the program `bespoke`.
STAGES = {
    bespoke.Stage.SETUP: "preparing",
    bespoke.Stage.PREPARED: "preparing",
    bespoke.Stage.INFLATE: "growing the body inside",
    bespoke.Stage.REPOSE: "taking the body to its pose",
    bespoke.Stage.FIT: "fitting",
    bespoke.Stage.VERIFY: "verifying",
    bespoke.Stage.DONE: "done",
    bespoke.Stage.FAILED: "failed",
    bespoke.Stage.CANCELLED: "stopped",
}


# The assets that `dress` has made last.
_last: list[str] = []


class BespokeStopped(Exception):
    """The user has pressed Cancel. What was dressed before stays."""


@dataclasses.dataclass
class Figure:
    """A skeletal mesh as arrays, in the engine's axes and unit."""

    name: str
    mesh: unreal.DynamicMesh
    vertices: np.ndarray
    """Float32, as the engine stores them: in this precision the result is verified."""
    triangles: np.ndarray
    rig: list[bespoke.Joint]
    joints: np.ndarray
    """Shape (vertices, influences)."""
    weights: np.ndarray


@dataclasses.dataclass(frozen=True)
class Match:
    """A bone of the character that garments were made for, and the one that corresponds to it."""

    bone: str
    worn_by: str | None
    """The bone of the wearer; None: nothing corresponds."""
    reason: bespoke.JointReason
    confidence: float
    """From 0, a guess, to 1, sure."""
    part: str
    """The part of the body; empty where it is none."""


def joint_map(
    made_for: str, worn_by: str, pairs: Sequence[tuple[str, str | None]] = ()
) -> list[Match]:
    """Which bones correspond, as `dress` takes them, one entry for each bone of `made_for`. It goes to the output log as well; what is
    wrong there is mended by `pairs`. Errors: as for `dress`."""
    source, target = read(_load(made_for)), read(_load(worn_by))
    with _side_by_side(source, source, target, bespoke.Options(), pairs) as session:
        found = session.read_joint_map()
    matches = [
        Match(joint.name, None if m.target is None else target.rig[m.target].name, m.reason, m.confidence, m.part)
        for joint, m in zip(source.rig, found)
    ]
    width = max(len(match.bone) for match in matches)
    for match in matches:
        why = match.reason.name.replace("_", " ").lower()
        unreal.log(f"{match.bone:{width}}  {match.worn_by or '-'}  ({why}, {match.confidence:.0%})")
    return matches


def take_back() -> list[str]:
    """Deletes the assets that the last `dress` has made, which the editor's Undo does not reach. Returns their paths."""
    taken = [path for path in _last if unreal.EditorAssetLibrary.delete_asset(path)]
    _last.clear()
    return taken


def dress(
    garments: Sequence[str],
    made_for: str | None,
    worn_by: str,
    *,
    fit: float = 2.0,
    looseness: float = 1.0,
    offset: float = 0.0,
    folder: str = "/Game/Bespoke",
    pairs: Sequence[tuple[str, str | None]] = (),
    **options: float,
) -> list[str]:
    """Puts garments that were made for one character on another, with no triangle through another.

    `garments`: paths of skeletal meshes, innermost first, on bones of their own or of `made_for`. `made_for`: the body that they
    were made for; None: it is not there, and the fit is tight. `worn_by`: the body to dress. `fit`: how tight. `looseness`: how much
    of the looseness on its own body to aim at, up to 2; 0 is tight. `offset`: clearance to aim at everywhere beside that, in
    centimetres. `folder`: where the new assets go. `pairs`: bones of the garments' skeleton and those of the wearer that
    correspond where names and places do not say it; None as the second: nothing does. `options`: further ones of docs/options.md.

    Returns the paths of the new assets, whose skeleton is that of `worn_by`. Findings go to the output log. Errors:
    `bespoke.BespokeError` with the reason, as docs/troubleshooting.md lists them; `BespokeStopped`; ValueError for an asset that
    cannot be read.
    """
    if not garments:
        raise ValueError("no garment is chosen")
    settings = bespoke.Options(fit_weight=fit, designed_clearance=looseness, offset=offset, **options)
    target_asset = _load(worn_by)
    target = read(target_asset)
    source = None if made_for is None else read(_load(made_for))
    layers: list[tuple[np.ndarray, np.ndarray]] = []
    made = _last
    made.clear()
    with unreal.ScopedSlowTask(len(garments), "Bespoke") as task:
        task.make_dialog(True)
        for path in garments:
            asset = _load(path)
            garment = read(asset)
            with _fitted(garment, source, target, layers, settings, pairs, task) as session:
                made.append(_write(session, asset, garment, target_asset, target, folder))
                layers.append((session.read_garment_vertices(), garment.triangles))
            # Geometry Script can read and write no morph targets.
            if lost := [str(name) for name in asset.get_all_morph_target_names()]:
                unreal.log_warning(f"{garment.name}: its morph targets do not come along: {', '.join(lost)}")
    return list(made)


def read(asset: unreal.SkeletalMesh) -> Figure:
    """The first level of detail of a skeletal mesh, in its reference pose. Errors: ValueError."""
    queries, lists, bones = unreal.GeometryScript_MeshQueries, unreal.GeometryScript_List, unreal.GeometryScript_BoneWeights
    mesh, outcome = unreal.GeometryScript_AssetUtils.copy_mesh_from_skeletal_mesh(
        asset, unreal.DynamicMesh(), unreal.GeometryScriptCopyMeshFromAssetOptions(), unreal.GeometryScriptMeshReadLOD()
    )
    name = asset.get_name()
    if outcome != unreal.GeometryScriptOutcomePins.SUCCESS:
        raise ValueError(f"{name} cannot be read; it is no skeletal mesh with geometry of its own")
    _, positions, has_gaps = queries.get_all_vertex_positions(mesh, False)
    _, corners, _ = queries.get_all_triangle_indices(mesh, False)
    if has_gaps:
        raise ValueError(f"{name} has gaps in the numbers of its vertices; import it again")
    vertices = [(p.x, p.y, p.z) for p in lists.convert_vector_list_to_array(positions)]
    triangles = [(t.x, t.y, t.z) for t in lists.convert_triangle_list_to_array(corners)]
    _, infos = bones.get_all_bones_info(mesh)
    infos = sorted(infos, key=lambda info: info.index)
    rows = []
    for vertex in range(len(vertices)):
        _, weights, is_bound = bones.get_vertex_bone_weights(mesh, vertex)
        rows.append([(w.bone_index, w.weight) for w in weights] if is_bound else [])
    width = max(1, max((len(row) for row in rows), default=1))
    joints = np.zeros((len(rows), width), np.int32)
    weights = np.zeros((len(rows), width), np.float32)
    for vertex, row in enumerate(rows):
        for k, (bone, weight) in enumerate(row):
            joints[vertex, k], weights[vertex, k] = bone, weight
    return Figure(
        name=name,
        mesh=mesh,
        vertices=np.array(vertices, np.float32).reshape(-1, 3),
        triangles=np.array(triangles, np.int32).reshape(-1, 3),
        rig=_rig(infos),
        joints=joints,
        weights=weights,
    )


def _rig(infos: Sequence[unreal.GeometryScriptBoneInfo]) -> list[bespoke.Joint]:
    binds: list[np.ndarray] = []
    for info in infos:
        local = _matrix(info.local_transform)
        # Parents come first in a reference skeleton.
        binds.append(local if info.parent_index < 0 else binds[info.parent_index] @ local)
    return [
        bespoke.Joint(str(info.name), None if info.parent_index < 0 else info.parent_index, bind)
        for info, bind in zip(infos, binds)
    ]


def _matrix(transform: unreal.Transform) -> np.ndarray:
    """As NumPy has it; the engine's vectors are rows."""
    m = transform.to_matrix()
    return np.array([[p.x, p.y, p.z, p.w] for p in (m.x_plane, m.y_plane, m.z_plane, m.w_plane)], np.float64).T


def _side_by_side(
    made_for: Figure,
    source: Figure | None,
    target: Figure,
    options: bespoke.Options,
    pairs: Sequence[tuple[str, str | None]],
) -> bespoke.Session:
    """Both characters, which is enough for the joint map."""
    session = bespoke.Session(options)
    # What is bound to a skeleton is in its place, whatever it looks like.
    session.set_source_coordinate_system(dataclasses.replace(bespoke.CoordinateSystem.UNREAL, trusted=True))
    session.set_target_coordinate_system(bespoke.CoordinateSystem.UNREAL)
    session.set_source_rig(made_for.rig)
    if source is not None:
        session.set_source_avatar(source.vertices, source.triangles)
        session.set_source_skin_influences(source.joints, source.weights, joint_count=len(source.rig))
    session.set_target_rig(target.rig)
    session.set_target_avatar(target.vertices, target.triangles)
    session.set_target_skin_influences(target.joints, target.weights, joint_count=len(target.rig))
    session.set_joint_pairs(_pairs(pairs, made_for, target))
    return session


def _filled(
    garment: Figure,
    source: Figure | None,
    target: Figure,
    layers: Sequence[tuple[np.ndarray, np.ndarray]],
    options: bespoke.Options,
    pairs: Sequence[tuple[str, str | None]],
) -> bespoke.Session:
    made_for = source or garment
    session = _side_by_side(made_for, source, target, options, pairs)
    session.set_garment(garment.vertices, garment.triangles)
    joints, weights = _on_rig(garment, made_for)
    session.set_garment_skin_influences(joints, weights, joint_count=len(made_for.rig))
    for vertices, triangles in layers:
        session.add_layer(vertices, triangles)
    return session


@contextlib.contextmanager
def _fitted(
    garment: Figure,
    source: Figure | None,
    target: Figure,
    layers: Sequence[tuple[np.ndarray, np.ndarray]],
    options: bespoke.Options,
    pairs: Sequence[tuple[str, str | None]],
    task: unreal.ScopedSlowTask,
) -> Iterator[bespoke.Session]:
    """A session that has run."""
    with _filled(garment, source, target, layers, options, pairs) as session:
        _run(session, _Told(garment.name, task))
        yield session


def _on_rig(garment: Figure, made_for: Figure) -> tuple[np.ndarray, np.ndarray]:
    """Its skin on the bones of the body, by their names; what that lacks goes with the bone above."""
    if garment is made_for:
        return garment.joints, garment.weights
    numbers = {joint.name: k for k, joint in enumerate(made_for.rig)}
    places = []
    for joint in garment.rig:
        above = 0 if joint.parent is None else places[joint.parent]
        places.append(numbers.get(joint.name, above))
    return np.array(places, np.int32)[garment.joints], garment.weights


def _pairs(pairs: Sequence[tuple[str, str | None]], source: Figure, target: Figure) -> np.ndarray:
    numbers = []
    for own, other in pairs:
        for name, figure in ((own, source), (other, target)):
            if name is not None and all(joint.name != name for joint in figure.rig):
                raise ValueError(f"{figure.name} has no bone {name}")
        find = {joint.name: k for k, joint in enumerate(target.rig)}
        numbers.append(([joint.name for joint in source.rig].index(own), -1 if other is None else find[other]))
    return np.array(numbers, np.int32).reshape(-1, 2)


def share(progress: bespoke.Progress) -> float:
    """How far a session is, from 0 to 1, as in the program `bespoke`."""
    stage = progress.stage
    if stage == bespoke.Stage.PREPARED:
        return 0.1
    if stage == bespoke.Stage.INFLATE:
        return 0.1 + 0.3 * progress.t
    if stage == bespoke.Stage.REPOSE:
        return 0.4 + 0.2 * progress.t
    if stage == bespoke.Stage.FIT:
        return 0.6 + 0.35 * (1.0 - math.exp(-progress.iteration / 20.0))
    return {bespoke.Stage.VERIFY: 0.97, bespoke.Stage.DONE: 1.0}.get(stage, 0.0)


class _Told:
    """What the dialog says of one garment; it never goes back."""

    def __init__(self, name: str, task: unreal.ScopedSlowTask) -> None:
        self.name = name
        self._task, self._done = task, 0.0

    def __call__(self, progress: bespoke.Progress) -> None:
        now = max(self._done, share(progress))
        self._task.enter_progress_frame(now - self._done, f"{self.name}: {STAGES.get(progress.stage, '')}")
        self._done = now
        if self._task.should_cancel():
            raise BespokeStopped(self.name)


def _run(session: bespoke.Session, told: _Told) -> None:
    name = told.name
    try:
        session.run(told)
    except bespoke.ImplausibleResultError as implausible:
        # It is verified, but not as designed. In the pose of the design it would be no garment on the wearer's bones.
        identity = np.broadcast_to(np.eye(4), session.read_pose_transforms().shape)
        if not np.array_equal(session.read_pose_transforms(), identity):
            raise
        unreal.log_warning(f"{name}: {implausible}")
    for found in session.read_diagnostics():
        say = unreal.log if found.severity == bespoke.Severity.NOTE else unreal.log_warning
        say(f"{name}: {found.message}")


def _write(
    session: bespoke.Session,
    asset: unreal.SkeletalMesh,
    garment: Figure,
    target_asset: unreal.SkeletalMesh,
    target: Figure,
    folder: str,
) -> str:
    """A new asset: the garment's own mesh with its materials and UVs, moved and on other bones."""
    edits, bones = unreal.GeometryScript_MeshEdits, unreal.GeometryScript_BoneWeights
    vertices = session.read_garment_vertices()
    joints, weights, _ = session.read_garment_skin_influences(INFLUENCES)
    # Bones of the garment's own cannot be added to another's skeleton: what they move goes with the one above.
    parents = list(range(len(target.rig)))
    for added in session.read_added_joints():
        parents.append(0 if added.parent is None else parents[added.parent])
    joints = np.array(parents, np.int32)[joints]
    moved = unreal.GeometryScript_List.convert_array_to_vector_list([unreal.Vector(*map(float, v)) for v in vertices])
    edits.set_all_mesh_vertex_positions(garment.mesh, moved)
    bones.copy_bones_from_mesh(target.mesh, garment.mesh)
    for vertex in range(len(vertices)):
        sums: dict[int, float] = {}
        for joint, weight in zip(joints[vertex], weights[vertex]):
            if weight > 0.0:
                sums[int(joint)] = sums.get(int(joint), 0.0) + float(weight)
        bones.set_vertex_bone_weights(
            garment.mesh, vertex, [unreal.GeometryScriptBoneWeight(bone, weight) for bone, weight in sums.items()]
        )
    # Hard edges stay hard.
    unreal.GeometryScript_Normals.recompute_normals(garment.mesh, unreal.GeometryScriptCalculateNormalsOptions())
    options = unreal.GeometryScriptCreateNewSkeletalMeshAssetOptions()
    options.materials = {slot.material_slot_name: slot.material_interface for slot in asset.materials}
    options.use_mesh_bone_proportions = True
    path = _free_path(posixpath.join(folder, f"{garment.name}_on_{target.name}"))
    _, outcome = unreal.GeometryScript_NewAssetUtils.create_new_skeletal_mesh_asset_from_mesh(
        garment.mesh, target_asset.skeleton, path, options
    )
    if outcome != unreal.GeometryScriptOutcomePins.SUCCESS:
        raise ValueError(f"the asset {path} could not be made; the output log says why")
    return path


def _free_path(path: str) -> str:
    """This one, or with the first number that is not taken: nothing is replaced."""
    free, number = path, 1
    while unreal.EditorAssetLibrary.does_asset_exist(free):
        number += 1
        free = f"{path}_{number}"
    return free


def _load(path: str) -> unreal.SkeletalMesh:
    asset = unreal.load_asset(path)
    if not isinstance(asset, unreal.SkeletalMesh):
        raise ValueError(f"{path} is no skeletal mesh of this project")
    return asset
