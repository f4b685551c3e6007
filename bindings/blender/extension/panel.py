"""The tab Bespoke in the sidebar of the 3D viewport."""

from __future__ import annotations

import textwrap
from typing import Any

import bpy

from . import dials, dress, findings, shape_keys


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Bespoke"


def _list(layout: Any, settings: Any, which: str, index: str, rows: int, can_move: bool) -> None:
    row = layout.row()
    row.template_list("BESPOKE_UL_meshes", which, settings, which, settings, index, rows=rows)
    buttons = row.column(align=True)
    buttons.operator("bespoke.add_meshes", text="", icon="ADD").which = which
    buttons.operator("bespoke.remove_mesh", text="", icon="REMOVE").which = which
    if can_move and len(getattr(settings, which)) > 1:
        buttons.operator("bespoke.move_mesh", text="", icon="TRIA_UP").down = False
        buttons.operator("bespoke.move_mesh", text="", icon="TRIA_DOWN").down = True


class BESPOKE_PT_dress(_Panel, bpy.types.Panel):
    """Who is dressed in what."""

    bl_idname = "BESPOKE_PT_dress"
    bl_label = "Bespoke"

    def draw(self, context: bpy.types.Context) -> None:
        """The main panel."""
        layout, settings = self.layout, context.scene.bespoke
        column = layout.column()
        column.label(text="Garments, innermost first", icon="MOD_CLOTH")
        _list(column, settings, "garments", "garment_index", 2, can_move=True)
        self._groups(column, settings)
        column.separator()
        column.label(text="Goes along", icon="LINKED")
        _list(column, settings, "followers", "follower_index", 1, can_move=False)
        if len(settings.garments) > 1 and 0 <= settings.follower_index < len(settings.followers):
            column.prop(settings.followers[settings.follower_index], "follows")
        column.separator()
        column.label(text="Made for", icon="OUTLINER_OB_ARMATURE")
        column.prop(settings, "source", text="")
        _list(column, settings, "source_bodies", "source_body_index", 1, can_move=False)
        column.separator()
        column.label(text="To be worn by", icon="ARMATURE_DATA")
        column.prop(settings, "target", text="")
        _list(column, settings, "target_bodies", "target_body_index", 1, can_move=False)
        if 0 <= settings.target_body_index < len(settings.target_bodies):
            row = column.row()
            row.use_property_split = True
            row.prop(settings.target_bodies[settings.target_body_index], "role")
        self._keys(column, context.scene)
        column.separator()
        dial = column.column(align=True)
        dial.use_property_split = True
        for name in dials.MAIN:
            dial.prop(settings, name)
        column.separator()
        self._run(column)

    def _groups(self, layout: Any, settings: Any) -> None:
        if not 0 <= settings.garment_index < len(settings.garments):
            return
        item = settings.garments[settings.garment_index]
        if item.object is None or not item.object.vertex_groups:
            return
        column = layout.column(align=True)
        column.use_property_split = True
        for name in ("fit_group", "pin_group", "rigid_group"):
            column.prop_search(item, name, item.object, "vertex_groups")

    def _keys(self, layout: Any, scene: bpy.types.Scene) -> None:
        followed = scene.bespoke.followed_keys
        if not followed and not shape_keys.names(shape_keys.bodies(scene)):
            return
        column = layout.column(align=True)
        for index, item in enumerate(followed):
            row = column.row(align=True)
            row.label(text=f"Follows {item.name}", icon="SHAPEKEY_DATA")
            row.operator("bespoke.ignore_key", text="", icon="X").index = index
        if len(followed) < len(shape_keys.names(shape_keys.bodies(scene))):
            column.operator_menu_enum("bespoke.follow_key", "key", icon="SHAPEKEY_DATA")

    def _run(self, layout: Any) -> None:
        run = dress.running()
        if run is None:
            row = layout.row()
            row.scale_y = 1.5
            row.operator("bespoke.dress", icon="PLAY")
            return
        share, words = run.progress()
        row = layout.row(align=True)
        row.progress(factor=share, text=words)
        row.operator("bespoke.stop", text="", icon="X")


class BESPOKE_PT_joints(_Panel, bpy.types.Panel):
    """Which bones correspond."""

    bl_idname = "BESPOKE_PT_joints"
    bl_label = "Matching Bones"
    bl_parent_id = "BESPOKE_PT_dress"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """The list, and why the chosen one is matched."""
        layout, settings = self.layout, context.scene.bespoke
        row = layout.row(align=True)
        row.operator("bespoke.map_joints", icon="FILE_REFRESH")
        if not settings.joints:
            return
        row.operator("bespoke.forget_joints", text="", icon="X")
        layout.template_list("BESPOKE_UL_joints", "", settings, "joints", settings, "joint_index", rows=6)
        if 0 <= settings.joint_index < len(settings.joints):
            joint = settings.joints[settings.joint_index]
            column = layout.column(align=True)
            if settings.target is not None:
                row = column.row(align=True)
                row.prop_search(joint, "target", settings.target.data, "bones", text="")
                row.prop(joint, "is_mended", text="", icon="PINNED" if joint.is_mended else "UNPINNED")
            if joint.part:
                column.label(text=joint.part.capitalize())
            column.label(text=f"{joint.reason} (confidence {joint.confidence:.0%})")
            _wrapped(column, joint.reason_comment, context)


class BESPOKE_PT_findings(_Panel, bpy.types.Panel):
    """What there is to say."""

    bl_idname = "BESPOKE_PT_findings"
    bl_label = "Findings"
    bl_parent_id = "BESPOKE_PT_dress"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Where there are some."""
        return len(context.scene.bespoke.findings) > 0

    def draw(self, context: bpy.types.Context) -> None:
        """The list, with the sentence of the chosen one."""
        layout, settings = self.layout, context.scene.bespoke
        layout.template_list("BESPOKE_UL_findings", "", settings, "findings", settings, "finding_index", rows=3)
        if not 0 <= settings.finding_index < len(settings.findings):
            return
        finding = settings.findings[settings.finding_index]
        box = layout.box()
        column = box.column(align=True)
        if len(settings.garments) > 1:
            column.label(text=finding.garment, icon=findings.ICONS[finding.severity])
        _wrapped(column, finding.message, context)
        row = layout.row(align=True)
        select = row.row(align=True)
        select.enabled = len(finding.places) > 0
        select.operator("bespoke.select_finding", icon="RESTRICT_SELECT_OFF")
        if finding.anchor:
            about = row.operator("bespoke.help", icon="HELP")
            about.anchor, about.message = finding.anchor, finding.message


class BESPOKE_PT_more(_Panel, bpy.types.Panel):
    """The other options for artists."""

    bl_idname = "BESPOKE_PT_more"
    bl_label = "More Options"
    bl_parent_id = "BESPOKE_PT_dress"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Each as the library has it."""
        column = _options(self.layout, context, is_expert=False)
        column.separator()
        column.prop(context.scene.bespoke, "add_bones")
        column.prop(context.scene.bespoke, "mask_covered")
        column.prop(context.scene.bespoke, "keep_results")


class BESPOKE_PT_expert(_Panel, bpy.types.Panel):
    """The options that tune the solver."""

    bl_idname = "BESPOKE_PT_expert"
    bl_label = "For Experts"
    bl_parent_id = "BESPOKE_PT_more"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Each as the library has it."""
        _options(self.layout, context, is_expert=True)


def _options(layout: Any, context: bpy.types.Context, is_expert: bool) -> Any:
    column = layout.column()
    column.use_property_split = True
    for name in dials.names(is_expert):
        column.prop(context.scene.bespoke, name)
    return column


def _wrapped(layout: Any, text: str, context: bpy.types.Context) -> None:
    """Text over as many lines as the sidebar's width asks for."""
    scale = context.preferences.system.ui_scale
    letters = max(20, int((context.region.width / scale - 40) / 6.2))
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in textwrap.wrap(text, letters):
        column.label(text=line)


_CLASSES = (BESPOKE_PT_dress, BESPOKE_PT_findings, BESPOKE_PT_joints, BESPOKE_PT_more, BESPOKE_PT_expert)


def register() -> None:
    """With the classes."""
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Without."""
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
