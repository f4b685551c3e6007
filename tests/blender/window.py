"""The extension in Blender's window: blender --enable-event-simulate --python window.py -- ZIP FOLDER

Draws the panel, presses Dress and then Esc, presses Dress again and waits, undoes it, and selects a finding. Blender as
a module draws no panels and knows no events, so this is the only place where both are seen to work. Ends with 0 where
all is well. BESPOKE_SAMPLE names the sample, BLENDER_USER_RESOURCES a profile that is new.

For a picture of the window it makes FOLDER/NAME.wanted and waits until somebody, who sees the screen, removes it.
"""

from __future__ import annotations

import os
import pathlib
import sys
import time
import traceback
from collections.abc import Iterator

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import characters

ARCHIVE, FOLDER = sys.argv[sys.argv.index("--") + 1 :][:2]
LIMIT = 240.0


def view() -> tuple[bpy.types.Area, bpy.types.Region]:
    """The 3D viewport."""
    area = max(
        (a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D"), key=lambda a: a.width
    )
    return area, next(region for region in area.regions if region.type == "WINDOW")


def picture(name: str, after: float = 1.0) -> Iterator[float]:
    """Asks for one of the whole window."""
    view()[0].tag_redraw()
    yield after
    wanted = pathlib.Path(FOLDER, f"{name}.wanted")
    wanted.touch()
    yield from until(f"a picture {wanted}", lambda: not wanted.exists())


def until(what: str, condition: object) -> Iterator[float]:
    """Lets Blender go on until it is so."""
    began = time.monotonic()
    while not condition():
        assert time.monotonic() - began < LIMIT, f"for {LIMIT} seconds in vain: {what}"
        yield 0.05


def names() -> set[str]:
    return {thing.name for thing in bpy.data.objects}


def press(kind: str) -> None:
    """A key in the viewport."""
    area, _ = view()
    at = {"x": area.x + area.width // 3, "y": area.y + area.height // 2}
    for value in ("PRESS", "RELEASE"):
        bpy.context.window.event_simulate(type=kind, value=value, **at)


def watch(panels: tuple[type, ...]) -> tuple[set[str], list[str]]:
    """From here on, which panels were drawn, and what went wrong: Blender prints that and goes on."""
    drawn: set[str] = set()
    failures: list[str] = []

    def watched(panel: type) -> None:
        draw = panel.draw

        def drawing(self: object, context: bpy.types.Context) -> None:
            try:
                draw(self, context)
                drawn.add(panel.__name__)
            except BaseException:
                failures.append(traceback.format_exc())
                raise

        panel.draw = drawing

    for panel in panels:
        watched(panel)
    return drawn, failures


def dress() -> None:
    area, region = view()
    with bpy.context.temp_override(area=area, region=region):
        assert bpy.ops.bespoke.dress("INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}


def steps() -> Iterator[float]:
    """All of it, with pauses in which Blender handles events and draws."""
    bpy.ops.extensions.package_install_files(filepath=ARCHIVE, repo="user_default", enable_on_install=True)
    from bl_ext.user_default.bespoke import dress as operator
    from bl_ext.user_default.bespoke import panel

    drawn, failures = watch(panel._CLASSES)
    characters.empty()
    yield 0.5
    characters.fill()
    bpy.context.preferences.view.show_splash = False
    characters.choose()
    bpy.data.objects["mannequin rig"].location.x = -1.25
    bpy.data.objects["heavy rig"].location.x = 0.1
    bpy.ops.bespoke.map_joints()
    area, region = view()
    space = area.spaces.active
    space.show_region_ui, space.show_region_toolbar = True, False
    space.shading.color_type = "MATERIAL"
    space.overlay.show_relationship_lines = False
    for thing in bpy.data.objects:
        if thing.type == "ARMATURE":
            thing.show_in_front, thing.data.display_type = True, "STICK"
    yield 0.5
    sidebar = next(region for region in area.regions if region.type == "UI")
    sidebar.active_panel_category = "Bespoke"
    space.region_3d.view_perspective = "ORTHO"
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_all()
    # Beside the sidebar, and not under it.
    space.region_3d.view_location.x += 0.5
    space.region_3d.view_location.z -= 0.3
    yield 1.0
    yield from picture("panel")
    assert "BESPOKE_PT_dress" in drawn, drawn

    bpy.ops.ed.undo_push(message="chosen")
    before = names()
    dress()
    yield from until("progress", lambda: operator.running() and operator.running().progress()[0] > 0.15)
    press("ESC")
    yield from until("an end after Esc", lambda: operator.running() is None)
    assert names() == before, names() - before
    print("esc: stopped, nothing changed", flush=True)

    dress()
    yield from until("progress", lambda: operator.running().progress()[0] > 0.15)
    yield from picture("running", 0.2)
    yield from until("an end", lambda: operator.running() is None)
    assert names() - before == {"jacket on heavy rig"}, names()
    yield 0.5
    yield from picture("dressed")
    print("dressed", flush=True)
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.ed.undo()
    yield 0.5
    assert names() == before, names()
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.ed.redo()
    yield 0.5
    assert names() - before == {"jacket on heavy rig"}, names()
    print("undone and redone", flush=True)

    # A body with a shape key, which the garment is to follow.
    heavy = bpy.data.objects["heavy"]
    for name in ("Basis", "heavier"):
        heavy.shape_key_add(name=name)
    for point in heavy.data.shape_keys.key_blocks["heavier"].data:
        point.co.y *= 1.1
    with bpy.context.temp_override(area=area, region=region):
        assert bpy.ops.bespoke.follow_key(key="heavier") == {"FINISHED"}
    yield 0.5
    yield from picture("keys")
    bpy.context.scene.bespoke.followed_keys.clear()

    # A jacket that passes through itself, for something to select.
    points = bpy.data.objects["jacket"].data.vertices
    for k in range(40, 44):
        points[k].co.y += 0.25
    dress()
    yield from until("an end", lambda: operator.running() is None)
    settings = bpy.context.scene.bespoke
    kinds = [finding.kind for finding in settings.findings]
    print("findings", kinds, flush=True)
    settings.finding_index = next(k for k, finding in enumerate(settings.findings) if finding.places)
    area, region = view()
    with bpy.context.temp_override(area=area, region=region):
        assert bpy.ops.bespoke.select_finding() == {"FINISHED"}
    yield 1.0
    assert bpy.context.mode == "EDIT_MESH"
    yield from picture("findings")
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.object.mode_set(mode="OBJECT")
        about = next((finding for finding in settings.findings if finding.anchor), None)
        anchor = about.anchor if about else "bespoke_status_not_enclosed"
        bpy.ops.bespoke.help("INVOKE_DEFAULT", anchor=anchor, message=about.message if about else "")
    yield 1.0
    yield from picture("help")
    press("ESC")

    # All that is folded up at first, which Blender remembers by its name.
    for each in (panel.BESPOKE_PT_joints, panel.BESPOKE_PT_more, panel.BESPOKE_PT_expert):
        bpy.utils.unregister_class(each)
        each.bl_options = set()
        each.bl_idname += "_open"
    panel.BESPOKE_PT_expert.bl_parent_id += "_open"
    for each in (panel.BESPOKE_PT_joints, panel.BESPOKE_PT_more, panel.BESPOKE_PT_expert):
        bpy.utils.register_class(each)
    yield from picture("unfolded")
    assert drawn == {each.__name__ for each in panel._CLASSES}, drawn
    bpy.ops.screen.userpref_show("INVOKE_DEFAULT")
    bpy.context.preferences.active_section = "ADDONS"
    bpy.context.window_manager.addon_search = "Bespoke"
    bpy.ops.preferences.addon_expand(module=operator.__package__)
    yield from picture("preferences")
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[1]):
        bpy.ops.wm.window_close()
    yield 0.5

    dress()
    yield from until("progress", lambda: operator.running().progress()[0] > 0.1)
    run = operator.running()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    yield from until("an end with another file", lambda: operator.running() is None and run.is_over)
    assert len(run.outcomes) == 0
    assert not failures, failures[0]
    print("another file stopped it", flush=True)


def main() -> float | None:
    """One step after the other."""
    global _todo
    try:
        # A timer belongs to no window.
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            return next(_todo)
    except StopIteration:
        print("all is well", flush=True)
        status = 0
    except BaseException:
        traceback.print_exc()
        status = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


_todo = steps()
# What is open at first has to be there.
bpy.app.timers.register(main, first_interval=1.0, persistent=True)
