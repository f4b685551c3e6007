"""From what is chosen in the scene to what the library is asked."""

from __future__ import annotations

import dataclasses

import bespoke
import bpy
import mathutils
import mathutils.kdtree
import numpy as np

from . import dials, meshes, preferences, rigs, shape_keys, work
from .meshes import Array, Mesh, SceneError


@dataclasses.dataclass
class Inputs:
    """A task, and which objects it is about."""

    task: work.Task
    garments: list[Mesh]
    followers: list[list[Mesh]]
    """What goes along with each of them."""
    source: bpy.types.Object
    source_bodies: list[Mesh]
    target: bpy.types.Object
    target_bodies: list[Mesh]
    layers: list[Mesh]
    """Earlier results that the target wears."""


def _objects(scene: bpy.types.Scene, items: bpy.types.CollectionProperty) -> list[bpy.types.Object]:
    # One that was deleted from the scene is still there for who points to it.
    return [item.object for item in items if item.object is not None and item.object.name in scene.objects]


def _armature(scene: bpy.types.Scene, chosen: bpy.types.Object | None, whose: str) -> bpy.types.Object:
    if chosen is None or chosen.name not in scene.objects:
        raise SceneError(
            f"{whose}: no armature is chosen; choose that of the character, which cannot be dressed without one"
        )
    return chosen


def _body(found: list[Mesh], armature: bpy.types.Object, roles: list[str] | None) -> work.Body:
    first, corners, parts = 0, [], []
    for k, mesh in enumerate(found):
        corners.append(mesh.triangles + np.uint32(first))
        first += len(mesh.vertices)
        if roles is not None:
            parts.append(np.full(len(mesh.triangles), int(bespoke.PartRole[roles[k]]), np.uint32))
    has_roles = roles is not None and any(role != "AUTOMATIC" for role in roles)
    return work.Body(
        vertices=np.concatenate([mesh.vertices for mesh in found]),
        triangles=np.concatenate(corners),
        influences=rigs.influences(found, armature),
        roles=np.concatenate(parts) if has_roles else None,
    )


def pairs(scene: bpy.types.Scene, source: bpy.types.Object, target: bpy.types.Object) -> list[tuple[int, int]]:
    """The joints that somebody has said correspond; -1: nothing does."""
    there = {bone.name: k for k, bone in enumerate(source.data.bones)}
    here = {bone.name: k for k, bone in enumerate(target.data.bones)}
    mended = [joint for joint in scene.bespoke.joints if joint.is_mended and joint.name in there]
    wrong = next((joint for joint in mended if joint.target and joint.target not in here), None)
    if wrong is not None:
        raise SceneError(
            f"{target.name}: it has no bone {wrong.target!r}, which was chosen for {wrong.name!r}; choose another one"
        )
    return [(there[joint.name], here[joint.target] if joint.target else -1) for joint in mended]


def options(context: bpy.types.Context) -> bespoke.Options:
    """The dials and the preferences."""
    chosen = dials.chosen(context.scene)
    user = preferences.read(context)
    if user.threads:
        chosen["threads"] = user.threads
    if user.memory_limit:
        chosen["memory_limit"] = user.memory_limit * 1_000_000
    return bespoke.Options(**chosen)


def cloth(mesh: bpy.types.Mesh, thing: bpy.types.Object, source: bpy.types.Object) -> tuple[Mesh, Array]:
    """A garment, and its vertices in the precision in which they are kept."""
    found = meshes.read(thing, mesh, rigs.frame(source))
    return found, found.vertices.astype(np.float32)


def _garment(
    item: dials.BespokeMesh, mesh: bpy.types.Mesh, source: bpy.types.Object, brings_bones: bool
) -> tuple[Mesh, work.Garment]:
    thing = item.object
    found, vertices = cloth(mesh, thing, source)
    skin = rigs.influences([found], source)
    garment = work.Garment(
        name=thing.name,
        vertices=vertices,
        triangles=found.triangles,
        influences=skin if brings_bones else None,
        is_bound=skin is not None,
    )
    garment.morphs = _morphs(thing, source)
    if item.fit_group:
        garment.fit_weights = meshes.group_weights(found, item.fit_group)
    if item.pin_group:
        garment.pins = np.flatnonzero(meshes.group_weights(found, item.pin_group) > 0.0).astype(np.uint32)
    if item.rigid_group:
        rigid = np.flatnonzero(meshes.group_weights(found, item.rigid_group) > 0.5)
        garment.rigid_groups = meshes.islands(rigid, found.triangles)
    return found, garment


def _morphs(thing: bpy.types.Object, source: bpy.types.Object) -> list[tuple[str, Array]]:
    """Its shape keys, as offsets from what each is relative to."""
    if not meshes.has_morphs(thing):
        return []
    turn = np.array(rigs.frame(source) @ meshes.rest_matrix(thing), np.float64)[:3, :3].T
    keys = thing.data.shape_keys.key_blocks[1:]
    return [(key.name, (meshes.shape(key) - meshes.shape(key.relative_key)) @ turn) for key in keys]


def _followers(
    scene: bpy.types.Scene,
    source: bpy.types.Object,
    found: list[tuple[Mesh, work.Garment]],
    depsgraph: bpy.types.Depsgraph,
) -> list[list[Mesh]]:
    """What goes along with each garment, which is told of it."""
    meshes_of: list[list[Mesh]] = [[] for _ in found]
    worn = [mesh.object for mesh, _ in found]
    for item in scene.bespoke.followers:
        thing = item.object
        if thing is None or thing.name not in scene.objects or thing in worn or not found:
            continue
        with garment_mesh(thing, depsgraph) as now:
            mesh, vertices = cloth(now, thing, source)
        if item.follows is not None and item.follows not in worn:
            raise SceneError(f"{thing.name}: it follows {item.follows.name}, which is no garment in the list")
        index = worn.index(item.follows) if item.follows is not None else _nearest(vertices, found)
        follower = work.Follower(thing.name, vertices, mesh.triangles, _morphs(thing, source))
        found[index][1].followers.append(follower)
        meshes_of[index].append(mesh)
    return meshes_of


def _nearest(vertices: Array, found: list[tuple[Mesh, work.Garment]]) -> int:
    """The garment whose vertices are nearest, in the mean."""
    distances = []
    for _, garment in found:
        tree = mathutils.kdtree.KDTree(len(garment.vertices))
        for k, point in enumerate(garment.vertices.tolist()):
            tree.insert(point, k)
        tree.balance()
        distances.append(float(np.mean([tree.find(point)[2] for point in vertices.tolist()])))
    return int(np.argmin(distances))


def gather(context: bpy.types.Context, needs_garments: bool = True) -> Inputs:
    """What the scene asks for.

    Errors: SceneError, ImportError.
    """
    scene = context.scene
    settings = scene.bespoke
    chosen = [item for item in settings.garments if item.object is not None and item.object.name in scene.objects]
    if needs_garments and not chosen:
        raise SceneError("no garment is chosen; select it in the viewport and add it to the list")
    source = _armature(scene, settings.source, "made for")
    target = _armature(scene, settings.target, "to be worn by")
    worn = {item.object for item in chosen}
    along = [] if not needs_garments else _objects(scene, settings.followers)
    worn.update(along)
    source_bodies = [thing for thing in _objects(scene, settings.source_bodies) if thing not in worn]
    roles = {item.object: item.role for item in settings.target_bodies}
    target_bodies = [thing for thing in _objects(scene, settings.target_bodies) if thing not in worn]
    layers = [thing for thing in target_bodies if "bespoke_garment" in thing]
    target_bodies = [thing for thing in target_bodies if thing not in layers]
    if not target_bodies:
        raise SceneError(f"{target.name}: no mesh is chosen as its body; select the body in the viewport and add it")
    # Transforms of what was moved by a script are old until somebody asks.
    context.view_layer.update()
    to_source, to_target = rigs.frame(source), rigs.frame(target)
    found: list[tuple[Mesh, work.Garment]] = []
    brings_bones = settings.add_bones and target.library is None and target.data.library is None
    with meshes.as_modelled([*worn, *source_bodies, *target_bodies, *layers]) as depsgraph:

        def bodies(things: list[bpy.types.Object], frame: object) -> list[Mesh]:
            read = []
            for thing in things:
                with meshes.evaluated(thing, depsgraph) as mesh:
                    read.append(meshes.read(thing, mesh, frame))
            return read

        bodies_there = bodies(source_bodies, to_source)
        followed = shape_keys.chosen(scene, target_bodies) if needs_garments else []
        bodies_here, morphs = _body_to_dress(target_bodies, to_target, followed, depsgraph)
        layers_here = bodies(layers, to_target)
        for item in chosen if needs_garments else ():
            with garment_mesh(item.object, depsgraph) as mesh:
                found.append(_garment(item, mesh, source, brings_bones))
        followers = _followers(scene, source, found, depsgraph)
    task = work.Task(
        garments=[garment for _, garment in found],
        source_rig=rigs.joints(source),
        source=_body(bodies_there, source, None) if bodies_there else None,
        target_rig=rigs.joints(target),
        target=_body(bodies_here, target, [roles[thing] for thing in target_bodies]),
        target_morphs=morphs,
        layers=[(mesh.vertices, mesh.triangles) for mesh in layers_here],
        pairs=pairs(scene, source, target),
        options=options(context),
        influences=preferences.read(context).influences,
        asks_for_covered=settings.mask_covered,
    )
    return Inputs(task, [mesh for mesh, _ in found], followers, source, bodies_there, target, bodies_here, layers_here)


def _body_to_dress(
    things: list[bpy.types.Object], frame: mathutils.Matrix, followed: list[str], depsgraph: bpy.types.Depsgraph
) -> tuple[list[Mesh], list[tuple[str, Array]]]:
    """Its meshes without the shape keys that garments are to follow, and what each of these adds to all vertices."""
    read: list[Mesh] = []
    of_mesh: list[dict[str, Array]] = []
    for thing in things:
        if set(followed).intersection(shape_keys.names([thing])):
            mesh, offsets = shape_keys.read(thing, followed, frame)
        else:
            with meshes.evaluated(thing, depsgraph) as now:
                mesh, offsets = meshes.read(thing, now, frame), {}
        read.append(mesh)
        of_mesh.append(offsets)
    parts = list(zip(read, of_mesh))
    return read, [
        (name, np.concatenate([offsets.get(name, np.zeros_like(mesh.vertices)) for mesh, offsets in parts]))
        for name in followed
    ]


def garment_mesh(thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> object:
    """The mesh of a garment that is fitted: with its modifiers, or, where it has shape keys, which Blender loses with
    modifiers, its basis."""
    return meshes.basis(thing) if meshes.has_morphs(thing) else meshes.evaluated(thing, depsgraph)
