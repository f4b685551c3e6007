"""The lists of meshes in the panel: garments, what goes along with them, and the bodies of both characters."""

from __future__ import annotations

from typing import Any

import bpy

from . import dials

# Which list of the scene, with its index.
LISTS = {
    "garments": "garment_index",
    "followers": "follower_index",
    "source_bodies": "source_body_index",
    "target_bodies": "target_body_index",
}
_WHICH = [(name, name.replace("_", " ").title(), "") for name in LISTS]


class BESPOKE_UL_meshes(bpy.types.UIList):
    """Meshes by their names."""

    def draw_item(
        self, _context: Any, layout: Any, _data: Any, item: Any, _icon: int, _active: Any, _property: str, _index: int
    ) -> None:
        """A row."""
        row = layout.row(align=True)
        row.prop(item, "object", text="", emboss=False, icon="OUTLINER_OB_MESH")
        if item.role != "AUTOMATIC":
            row.label(text=item.bl_rna.properties["role"].enum_items[item.role].name)


class BESPOKE_OT_add_meshes(bpy.types.Operator):
    """Adds the selected meshes to the list. Their armature is taken, where none is chosen yet"""

    bl_idname = "bespoke.add_meshes"
    bl_label = "Add Selected Meshes"
    bl_options = {"UNDO", "INTERNAL"}

    which: bpy.props.EnumProperty(items=_WHICH)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Adds them."""
        settings = context.scene.bespoke
        chosen = [thing for thing in context.selected_objects if thing.type == "MESH"]
        if not chosen:
            self.report({"ERROR"}, "no mesh is selected; select the meshes in the viewport, then add them")
            return {"CANCELLED"}
        items = getattr(settings, self.which)
        for empty in reversed([k for k, item in enumerate(items) if item.object is None]):
            items.remove(empty)
        there = {item.object for item in items}
        for thing in chosen:
            if thing not in there:
                items.add().object = thing
        setattr(settings, LISTS[self.which], len(items) - 1)
        side = "target" if self.which == "target_bodies" else "source"
        if self.which in ("garments", "followers"):
            # What is put on is no body.
            for bodies in (settings.source_bodies, settings.target_bodies):
                for k in reversed([k for k, item in enumerate(bodies) if item.object in chosen]):
                    bodies.remove(k)
        if getattr(settings, side) is None:
            armatures = [dials.armature_of(thing) for thing in chosen]
            setattr(settings, side, next((armature for armature in armatures if armature is not None), None))
        return {"FINISHED"}


class BESPOKE_OT_remove_mesh(bpy.types.Operator):
    """Takes the mesh off the list; the mesh itself stays"""

    bl_idname = "bespoke.remove_mesh"
    bl_label = "Remove"
    bl_options = {"UNDO", "INTERNAL"}

    which: bpy.props.EnumProperty(items=_WHICH)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Removes it."""
        settings = context.scene.bespoke
        items, index = getattr(settings, self.which), getattr(settings, LISTS[self.which])
        if not 0 <= index < len(items):
            return {"CANCELLED"}
        items.remove(index)
        setattr(settings, LISTS[self.which], max(0, min(index, len(items) - 1)))
        return {"FINISHED"}


class BESPOKE_OT_move_mesh(bpy.types.Operator):
    """Moves the garment in the order in which they are put on, the innermost first"""

    bl_idname = "bespoke.move_mesh"
    bl_label = "Move"
    bl_options = {"UNDO", "INTERNAL"}

    down: bpy.props.BoolProperty()

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Moves it."""
        settings = context.scene.bespoke
        index = settings.garment_index
        to = index + (1 if self.down else -1)
        if not (0 <= index < len(settings.garments) and 0 <= to < len(settings.garments)):
            return {"CANCELLED"}
        settings.garments.move(index, to)
        settings.garment_index = to
        return {"FINISHED"}


_CLASSES = (BESPOKE_UL_meshes, BESPOKE_OT_add_meshes, BESPOKE_OT_remove_mesh, BESPOKE_OT_move_mesh)


def register() -> None:
    """With the classes."""
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Without."""
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
