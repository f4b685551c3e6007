"""Which bones of the two armatures correspond: to be seen, and to be mended."""

from __future__ import annotations

from typing import Any

import bespoke
import bpy

from . import inputs, texts, work
from .meshes import SceneError

# What is less sure than this is worth a look.
SURE = 0.5


def fill(context: bpy.types.Context) -> None:
    """Reads the map into the scene, keeping what was chosen.

    Errors: SceneError, BespokeError, ImportError.
    """
    found = inputs.gather(context, needs_garments=False)
    with work.side_by_side(found.task) as session:
        mapped = session.read_joint_map()
    items = context.scene.bespoke.joints
    mended = {joint.name for joint in items if joint.is_mended}
    comments = texts.members(bespoke.JointReason)
    source, target = found.source.data.bones, found.target.data.bones
    items.clear()
    for bone, joint in zip(source, mapped):
        item = items.add()
        item.name = bone.name
        item.target = target[joint.target].name if joint.target is not None else ""
        # Setting it counts as choosing it.
        item.is_mended = bone.name in mended
        item.part, item.confidence = joint.part, joint.confidence
        item.reason = texts.label(joint.reason.name)
        item.reason_comment = comments.get(joint.reason.name, "")


class BESPOKE_UL_joints(bpy.types.UIList):
    """A row a bone."""

    only_unsure: bpy.props.BoolProperty(
        name="Only What Is Unsure", description="Leave out what follows from names, and what corresponds to nothing"
    )

    def draw_item(
        self, _context: Any, layout: Any, _data: Any, item: Any, _icon: int, _active: Any, _property: str, _index: int
    ) -> None:
        """A row."""
        split = layout.split(factor=0.5, align=True)
        split.label(text=item.name, icon="BONE_DATA")
        split.label(text=item.target or "nothing", icon=_icon_of(item))

    def draw_filter(self, _context: Any, layout: Any) -> None:
        """The line below the list."""
        row = layout.row(align=True)
        row.prop(self, "filter_name", text="")
        row.prop(self, "only_unsure", icon="QUESTION", text="")

    def filter_items(self, _context: Any, data: Any, property_name: str) -> tuple[list[int], list[int]]:
        """By name, and by how sure it is."""
        items = getattr(data, property_name)
        flags = [self.bitflag_filter_item] * len(items)
        if self.filter_name:
            helper = bpy.types.UI_UL_list
            flags = helper.filter_items_by_name(self.filter_name, self.bitflag_filter_item, items, "name")
        if self.only_unsure:
            flags = [flag if is_unsure(item) else 0 for flag, item in zip(flags, items)]
        return flags, []


def _icon_of(item: Any) -> str:
    if item.is_mended:
        return "PINNED"
    return "QUESTION" if is_unsure(item) else "BLANK1"


def is_unsure(item: Any) -> bool:
    """Whether a person should look at it."""
    return bool(item.target) and not item.is_mended and item.confidence < SURE


class BESPOKE_OT_map_joints(bpy.types.Operator):
    """Finds out which bones correspond, by names, places and weights, and by what was chosen here"""

    bl_idname = "bespoke.map_joints"
    bl_label = "Match Bones"
    bl_options = {"UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Fills the list."""
        try:
            fill(context)
        except (SceneError, bespoke.BespokeError, ImportError) as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        unsure = sum(is_unsure(item) for item in context.scene.bespoke.joints)
        if unsure:
            self.report({"WARNING"}, f"{unsure} bones are matched by a guess; look at those with a question mark")
        return {"FINISHED"}


class BESPOKE_OT_forget_joints(bpy.types.Operator):
    """Takes back all that was chosen in the list"""

    bl_idname = "bespoke.forget_joints"
    bl_label = "Forget Choices"
    bl_options = {"UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Empties the list."""
        context.scene.bespoke.joints.clear()
        return {"FINISHED"}


_CLASSES = (BESPOKE_UL_joints, BESPOKE_OT_map_joints, BESPOKE_OT_forget_joints)


def register() -> None:
    """With the classes."""
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Without."""
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
