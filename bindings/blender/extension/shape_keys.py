"""Shape keys of the body that is dressed, such as a heavier one: garments follow those that are chosen, with shape keys
of their own."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from typing import Any

import bpy

from . import meshes
from .meshes import Array, Mesh, SceneError

# Blender keeps no names that a menu is told, so we do.
_MENU: list[tuple[str, str, str]] = []


def names(things: Sequence[bpy.types.Object]) -> list[str]:
    """Those of all meshes, each once."""
    found: dict[str, None] = {}
    for thing in things:
        if meshes.has_morphs(thing):
            found.update(dict.fromkeys(key.name for key in thing.data.shape_keys.key_blocks[1:]))
    return list(found)


def bodies(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """The meshes of the body that is dressed."""
    chosen = [item.object for item in scene.bespoke.target_bodies]
    return [thing for thing in chosen if thing is not None and thing.name in scene.objects]


def chosen(scene: bpy.types.Scene, things: Sequence[bpy.types.Object]) -> list[str]:
    """Those that garments are to follow, of a body of these meshes."""
    wanted = list(dict.fromkeys(item.name for item in scene.bespoke.followed_keys))
    there = names(things)
    missing = next((name for name in wanted if name not in there), None)
    if missing is not None:
        raise SceneError(
            f"no mesh of the body has a shape key {missing!r}, which the garments are to follow; take it off the list"
        )
    return wanted


@contextlib.contextmanager
def _aside(thing: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """A copy whose shape keys nothing else moves. What is left out of `thing` is left out of it, too."""
    mesh = thing.data.copy()
    aside = thing.copy()
    try:
        aside.data = mesh
        aside.show_only_shape_key, aside.hide_viewport = False, False
        mesh.shape_keys.animation_data_clear()
        bpy.context.scene.collection.objects.link(aside)
        yield aside
    finally:
        bpy.data.objects.remove(aside)
        bpy.data.meshes.remove(mesh)


def read(thing: bpy.types.Object, wanted: Sequence[str], frame: Any) -> tuple[Mesh, dict[str, Array]]:
    """A mesh without these of its shape keys, and what each adds to its vertices, as `meshes.read` has them. To be
    called within `meshes.as_modelled`."""
    with _aside(thing) as aside:
        keys = aside.data.shape_keys.key_blocks
        own = [name for name in wanted if name in keys]
        for name in own:
            key = keys[name]
            key.mute = False
            key.slider_min, key.slider_max = min(key.slider_min, 0.0), max(key.slider_max, 1.0)
            key.value = 0.0
        plain, offsets = _evaluated(thing, aside, frame), {}
        for name in own:
            keys[name].value = 1.0
            there = _evaluated(thing, aside, frame)
            keys[name].value = 0.0
            if there.vertices.shape != plain.vertices.shape:
                raise SceneError(
                    f"{thing.name}: its modifiers make other vertices with the shape key {name!r} than without, so that "
                    "no garment can follow it; apply them, or take it off the list"
                )
            offsets[name] = there.vertices - plain.vertices
        return plain, offsets


def _evaluated(thing: bpy.types.Object, aside: bpy.types.Object, frame: Any) -> Mesh:
    with meshes.evaluated(aside, bpy.context.evaluated_depsgraph_get()) as mesh:
        return meshes.read(thing, mesh, frame)


def follow(result: bpy.types.Object, name: str, offsets: Array, things: Sequence[bpy.types.Object]) -> None:
    """Gives a garment the shape key with which it answers to that of a body, whose value moves it. One of the garment's
    own that has the name takes this shape."""
    if result.data.shape_keys is None:
        result.shape_key_add(name="Basis", from_mix=False)
    keys = result.data.shape_keys
    key = keys.key_blocks.get(name) or result.shape_key_add(name=name, from_mix=False)
    key.relative_key = keys.reference_key
    key.data.foreach_set("co", (meshes.shape(keys.reference_key) + offsets).astype("f").ravel())
    body = next(thing for thing in things if name in names([thing]))
    of_body = body.data.shape_keys.key_blocks[name]
    key.slider_min, key.slider_max, key.mute = of_body.slider_min, of_body.slider_max, of_body.mute
    key.vertex_group = ""
    key.driver_remove("value")
    driver = key.driver_add("value").driver
    driver.type = "SUM"
    value = driver.variables.new()
    value.name, value.targets[0].id_type = "value", "KEY"
    value.targets[0].id = body.data.shape_keys
    value.targets[0].data_path = f'key_blocks["{bpy.utils.escape_identifier(name)}"].value'


def _menu(_self: Any, context: bpy.types.Context) -> list[tuple[str, str, str]]:
    there = {item.name for item in context.scene.bespoke.followed_keys}
    _MENU[:] = [(name, name, "") for name in names(bodies(context.scene)) if name not in there]
    return _MENU


class BESPOKE_OT_follow_key(bpy.types.Operator):
    """Adds a shape key of the body to those that garments follow."""

    bl_idname = "bespoke.follow_key"
    bl_label = "Follow a Shape Key"
    bl_description = (
        "Gives the garments a shape key of the same name, which moves with that of the body. Takes about as long as the "
        "fit, for each of them"
    )
    bl_options = {"UNDO", "INTERNAL"}

    key: bpy.props.EnumProperty(name="Shape Key", items=_menu)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Adds it."""
        context.scene.bespoke.followed_keys.add().name = self.key
        return {"FINISHED"}


class BESPOKE_OT_ignore_key(bpy.types.Operator):
    """Takes the shape key off the list"""

    bl_idname = "bespoke.ignore_key"
    bl_label = "Do Not Follow"
    bl_options = {"UNDO", "INTERNAL"}

    index: bpy.props.IntProperty()

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Removes it."""
        context.scene.bespoke.followed_keys.remove(self.index)
        return {"FINISHED"}


_CLASSES = (BESPOKE_OT_follow_key, BESPOKE_OT_ignore_key)


def register() -> None:
    """With the classes."""
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Without."""
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
