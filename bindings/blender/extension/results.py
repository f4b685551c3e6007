"""From what the library leaves to objects: the garment as it is, on another body and another armature."""

from __future__ import annotations

import bpy
import mathutils
import numpy as np

from . import meshes, rigs, shape_keys, work
from .inputs import Inputs, cloth, garment_mesh
from .meshes import Array, SceneError

# Vertex group and mask modifier of what garments cover.
COVERED = "Bespoke Covered"


def check(inputs: Inputs) -> None:
    """Errors: SceneError, where something that takes part has gone, or a garment has changed, since they were read."""
    try:
        along = [mesh for meshes_of in inputs.followers for mesh in meshes_of]
        found = [*inputs.garments, *along, *inputs.source_bodies, *inputs.target_bodies, *inputs.layers]
        for thing in [inputs.source, inputs.target, *(mesh.object for mesh in found)]:
            _ = thing.name
    except ReferenceError:
        raise SceneError(
            "something that takes part was deleted or undone while it was fitted; dress it again"
        ) from None
    things = [mesh.object for mesh in [*inputs.garments, *along]]
    designs = [*inputs.task.garments, *(follower for garment in inputs.task.garments for follower in garment.followers)]
    with meshes.as_modelled(things) as depsgraph:
        for thing, design in zip(things, designs, strict=True):
            with garment_mesh(thing, depsgraph) as now:
                if not now.polygons or not np.array_equal(cloth(now, thing, inputs.source)[1], design.vertices):
                    raise SceneError(f"{thing.name}: it was changed while it was fitted; dress it again")


def write(context: bpy.types.Context, inputs: Inputs, index: int, outcome: work.Outcome) -> list[bpy.types.Object]:
    """New objects: the garment with its materials, UVs, seams, attributes and shape keys, on the target's armature, and
    what goes along with it. `check` was called before."""
    names = [bone.name for bone in inputs.target.data.bones]
    if outcome.skin is not None:
        names += _add_bones(context, inputs, outcome)
    made: list[bpy.types.Object] = []
    things = [mesh.object for mesh in [inputs.garments[index], *inputs.followers[index]]]
    try:
        for thing, worn in zip(things, [outcome, *outcome.followers], strict=True):
            made.append(_object(context, inputs, thing, worn, names))
        for name, offsets in outcome.answers:
            shape_keys.follow(made[0], name, offsets, [mesh.object for mesh in inputs.target_bodies])
    except BaseException:
        # Nothing half-made stays.
        for result in made:
            _remove(result)
        raise
    return made


def _remove(result: bpy.types.Object) -> None:
    mesh = result.data
    bpy.data.objects.remove(result)
    if mesh.users == 0:
        bpy.data.meshes.remove(mesh)


def _object(
    context: bpy.types.Context, inputs: Inputs, thing: bpy.types.Object, worn: work.Worn, names: list[str]
) -> bpy.types.Object:
    """A new object: `thing` as it is worn, with weights on bones of these names."""
    with meshes.as_modelled([thing]) as depsgraph:
        with garment_mesh(thing, depsgraph) as now:
            # With shape keys these come along; else with the modifiers applied.
            mesh = (thing.data if meshes.has_morphs(thing) else now).copy()
    mesh.name = thing.data.name
    result = thing.copy()
    try:
        result.data = mesh
        _set_shapes(mesh, worn)
        result.animation_data_clear()
        result.constraints.clear()
        if not meshes.has_morphs(thing):
            for name in [modifier.name for modifier in meshes.shaping(thing)]:
                result.modifiers.remove(result.modifiers[name])
        _bind(result, inputs, worn, names)
        result["bespoke_garment"], result["bespoke_avatar"] = thing.name, inputs.target.name
        result.name = _name(thing.name, inputs.target.name)
        _place(context, result, inputs.target)
    except BaseException:
        _remove(result)
        raise
    return result


def remove_earlier(scene: bpy.types.Scene, result: bpy.types.Object) -> None:
    """Takes earlier results of the same garment on the same character away, and their name."""
    mark = result["bespoke_garment"], result["bespoke_avatar"]
    for old in [thing for thing in scene.objects if thing != result]:
        if (old.get("bespoke_garment"), old.get("bespoke_avatar")) == mark:
            _remove(old)
    result.name = _name(*mark)


def _name(garment: str, avatar: str) -> str:
    return f"{garment} on {avatar}"


def _set_shapes(mesh: bpy.types.Mesh, worn: work.Worn) -> None:
    vertices = worn.vertices
    if mesh.shape_keys is not None:
        keys = mesh.shape_keys.key_blocks
        offsets = dict(zip([key.name for key in keys[1:]], worn.morphs))
        shapes: dict[str, Array] = {mesh.shape_keys.reference_key.name: vertices.astype(np.float64)}

        def shape(key: bpy.types.ShapeKey) -> Array:
            if key.name not in shapes:
                shapes[key.name] = shape(key.relative_key) + offsets[key.name]
            return shapes[key.name]

        for key in keys:
            key.data.foreach_set("co", shape(key).astype(np.float32).ravel())
    mesh.vertices.foreach_set("co", np.ascontiguousarray(vertices, np.float32).ravel())
    mesh.update()


def _bind(result: bpy.types.Object, inputs: Inputs, worn: work.Worn, names: list[str]) -> None:
    target = inputs.target
    bones = {bone.name for bone in inputs.source.data.bones}.union(names)
    for group in [group for group in result.vertex_groups if group.name in bones]:
        result.vertex_groups.remove(group)
    if worn.skin is not None:
        joints, weights = worn.skin
        for joint in np.unique(joints[weights > 0.0]):
            group = result.vertex_groups.new(name=names[joint])
            vertex, slot = np.nonzero((joints == joint) & (weights > 0.0))
            for v, weight in zip(vertex.tolist(), weights[vertex, slot].tolist()):
                group.add([v], weight, "REPLACE")
    posing = [modifier for modifier in result.modifiers if modifier.type == "ARMATURE"]
    for modifier in posing[1:]:
        result.modifiers.remove(modifier)
    if posing:
        modifier = posing[0]
    else:
        modifier = result.modifiers.new("Armature", "ARMATURE")
        result.modifiers.move(len(result.modifiers) - 1, 0)
    modifier.object = target
    modifier.use_vertex_groups, modifier.use_bone_envelopes = True, False
    modifier.show_viewport = modifier.show_render = True


def _place(context: bpy.types.Context, result: bpy.types.Object, target: bpy.types.Object) -> None:
    """Below the target's armature, with no transform of its own but the place of that armature, so that every vertex is
    stored as it was verified."""
    result.parent, result.parent_type, result.parent_bone = target, "OBJECT", ""
    frame = rigs.frame(target).inverted()
    result.matrix_parent_inverse = target.matrix_world.inverted() @ frame
    result.matrix_basis = mathutils.Matrix.Identity(4)
    result.hide_viewport = result.hide_render = False
    collections = [c for c in target.users_collection if c.library is None] or [context.scene.collection]
    collections[0].objects.link(result)
    # That collection may be left out of the view layer.
    context.view_layer.update()
    if result.name not in context.view_layer.objects:
        context.scene.collection.objects.link(result)
    result.hide_set(False)


def mask_covered(inputs: Inputs, outcomes: list[work.Outcome]) -> None:
    """Masks what all garments together cover of the body. A vertex is left out where no triangle at it can be seen."""
    covered = np.zeros(sum(len(mesh.triangles) for mesh in inputs.target_bodies), bool)
    for outcome in outcomes:
        if outcome.covered is not None:
            covered[outcome.covered] = True
    first = 0
    for mesh in inputs.target_bodies:
        of_mesh = covered[first : first + len(mesh.triangles)]
        first += len(mesh.triangles)
        # Through modifiers that make vertices, nobody knows which they come from.
        if not mesh.is_base:
            continue
        hidden = np.zeros(len(mesh.vertices), bool)
        hidden[mesh.triangles[of_mesh]] = True
        hidden[mesh.triangles[~of_mesh]] = False
        thing = mesh.object
        group = thing.vertex_groups.get(COVERED) or thing.vertex_groups.new(name=COVERED)
        group.remove(range(len(mesh.vertices)))
        group.add(np.flatnonzero(hidden).tolist(), 1.0, "REPLACE")
        modifier = thing.modifiers.get(COVERED) or thing.modifiers.new(COVERED, "MASK")
        modifier.vertex_group, modifier.invert_vertex_group = group.name, True


def _add_bones(context: bpy.types.Context, inputs: Inputs, outcome: work.Outcome) -> list[str]:
    """Adds the garment's own bones to the target's armature, where they are not there yet. Their names, in order."""
    if not outcome.added:
        return []
    target, source = inputs.target, inputs.source
    names = [bone.name for bone in target.data.bones]
    there = len(names)
    to_armature = np.linalg.inv(np.array(rigs.frame(target) @ target.matrix_world, np.float64))
    bones = source.data.bones
    before = context.view_layer.objects.active
    hidden = target.hide_get()
    target.hide_set(False)
    context.view_layer.objects.active = target
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        edited = target.data.edit_bones
        for added in outcome.added:
            own = bones[added.source]
            name = own.name
            if name in names[:there] and not edited[name].get("bespoke_own"):
                name = f"{name} ({source.name})"
            bone = edited.get(name)
            if bone is None:
                bone = edited.new(name)
                bone["bespoke_own"] = True
                bind = to_armature @ added.bind
                size = np.cbrt(abs(np.linalg.det(bind[:3, :3])))
                bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, max(own.length * size, 1e-4), 0.0)
                axes = bind[:3, :3] / max(size, 1e-12)
                bone.matrix = mathutils.Matrix.Translation(bind[:3, 3]) @ mathutils.Matrix(axes.tolist()).to_4x4()
                if added.parent is not None:
                    bone.parent = edited[names[added.parent]]
                bone.use_deform = True
            names.append(bone.name)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
        target.hide_set(hidden)
        context.view_layer.objects.active = before
    return names[there:]
