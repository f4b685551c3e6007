"""What is the same in all files of a user."""

from __future__ import annotations

import bpy

from . import texts


class BespokePreferences(bpy.types.AddonPreferences):
    """Edit > Preferences > Add-ons > Bespoke."""

    bl_idname = __package__

    threads: bpy.props.IntProperty(
        name="Threads",
        description=f"{texts.options()['threads'].comment} 0: the default",
        default=0,
        min=0,
        max=1024,
    )
    memory_limit: bpy.props.IntProperty(
        name="Memory Limit (MB)",
        description=f"{texts.options()['memory_limit'].comment} Here in megabytes; 0: no limit",
        default=0,
        min=0,
    )
    influences: bpy.props.IntProperty(
        name="Joints per Vertex",
        description="Joints with a weight at each vertex of the result, as many as the engine takes that it is for",
        default=4,
        min=1,
        max=8,
    )

    def draw(self, _context: bpy.types.Context) -> None:
        """The page of the add-on."""
        column = self.layout.column()
        column.use_property_split = True
        for name in ("threads", "memory_limit", "influences"):
            column.prop(self, name)


def read(context: bpy.types.Context) -> BespokePreferences:
    """Those of the user."""
    return context.preferences.addons[__package__].preferences


def register() -> None:
    """With the class."""
    bpy.utils.register_class(BespokePreferences)


def unregister() -> None:
    """Without."""
    bpy.utils.unregister_class(BespokePreferences)
