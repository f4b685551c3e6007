"""What the library has to say, as a list whose lines select what they are about."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import bespoke
import bmesh
import bpy

from . import texts, troubleshooting, work
from .inputs import Inputs
from .meshes import Mesh

ICONS = {"NOTE": "INFO", "WARNING": "ERROR", "ERROR": "CANCEL"}


def tell(
    scene: bpy.types.Scene, inputs: Inputs, outcomes: list[work.Outcome], results: list[bpy.types.Object | None]
) -> None:
    """Fills the scene's list: failures first, then findings, those of one kind together."""
    items = scene.bespoke.findings
    items.clear()
    scene.bespoke.finding_index = 0
    for index, outcome in enumerate(outcomes):
        garment = inputs.task.garments[index].name
        if outcome.failure is not None:
            item = items.add()
            item.severity, item.kind, item.garment = "ERROR", outcome.failure.status.name, garment
            item.message = outcome.failure.message
            item.anchor = troubleshooting.anchor(outcome.failure.status)
        kinds: dict[tuple[str, str], list[bespoke.Diagnostic]] = {}
        for found in sorted(outcome.findings, key=lambda found: -found.severity):
            kinds.setdefault((found.severity.name, found.kind.name), []).append(found)
        for (severity, kind), several in kinds.items():
            item = items.add()
            item.severity, item.kind, item.garment = severity, kind, garment
            item.message, item.count = several[0].message, len(several)
            item.anchor = _anchor(severity, kind, outcome.failure)
            elements = [element for found in several for element in found.elements]
            _places(item, elements, inputs, index, results)


def _anchor(severity: str, kind: str, failure: bespoke.BespokeError | None) -> str:
    """Where there is something to read about a finding."""
    if failure is not None and severity == "ERROR":
        return troubleshooting.anchor(failure.status)
    if kind in bespoke.Status.__members__:
        return troubleshooting.anchor(bespoke.Status[kind])
    return troubleshooting.WARNINGS if severity == "WARNING" else ""


def _places(
    item: Any, elements: Iterable[bespoke.Element], inputs: Inputs, index: int, results: list[bpy.types.Object | None]
) -> None:
    chosen: dict[bpy.types.Object, set[int]] = {}
    for element in elements:
        meshes, shown = _meshes(element, inputs, index, results)
        for mesh, thing in zip(meshes, shown):
            if element.kind == bespoke.ElementKind.VERTEX:
                count, vertices = len(mesh.vertices), [element.index]
            elif element.kind == bespoke.ElementKind.TRIANGLE:
                count = len(mesh.triangles)
                vertices = mesh.triangles[element.index].tolist() if element.index < count else []
            else:
                break
            if element.index < count:
                if mesh.is_base or thing is not mesh.object:
                    chosen.setdefault(thing, set()).update(vertices)
                break
            element = bespoke.Element(element.subject, element.kind, element.index - count)
    for thing, vertices in chosen.items():
        place = item.places.add()
        place.object = thing
        place["vertices"] = sorted(vertices)


def _meshes(
    element: bespoke.Element, inputs: Inputs, index: int, results: list[bpy.types.Object | None]
) -> tuple[list[Mesh], list[bpy.types.Object]]:
    """The meshes that are counted through, and the objects in which they are seen."""
    worn = len(inputs.layers)
    if element.layer is not None and element.layer < worn:
        mesh = inputs.layers[element.layer]
        return [mesh], [mesh.object]
    if element.layer is not None:
        # The others are the garments before it that were dressed.
        index = [k for k, result in enumerate(results[:index]) if result is not None][element.layer - worn]
    if element.layer is not None or element.subject == bespoke.Subject.GARMENT:
        garment = inputs.garments[index]
        return [garment], [results[index] or garment.object]
    if element.follower is not None:
        follower = inputs.followers[index][element.follower]
        return [follower], [follower.object]
    if element.subject == bespoke.Subject.TARGET_AVATAR:
        return inputs.target_bodies, [mesh.object for mesh in inputs.target_bodies]
    if element.subject == bespoke.Subject.SOURCE_AVATAR:
        return inputs.source_bodies, [mesh.object for mesh in inputs.source_bodies]
    return [], []


class BESPOKE_UL_findings(bpy.types.UIList):
    """A line for each."""

    def draw_item(
        self, _context: Any, layout: Any, _data: Any, item: Any, _icon: int, _active: Any, _property: str, _index: int
    ) -> None:
        """A row."""
        name = texts.label(item.kind) + (f" ({item.count})" if item.count > 1 else "")
        layout.label(text=name, icon=ICONS[item.severity])


class BESPOKE_OT_select_finding(bpy.types.Operator):
    """Selects the vertices that it is about, in edit mode"""

    bl_idname = "bespoke.select_finding"
    bl_label = "Select"
    bl_options = {"UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Selects them."""
        settings = context.scene.bespoke
        if not 0 <= settings.finding_index < len(settings.findings):
            self.report({"ERROR"}, "there is no finding to select; dress a garment first")
            return {"CANCELLED"}
        finding = settings.findings[settings.finding_index]
        places = [place for place in finding.places if _is_there(context, place)]
        if not places:
            self.report({"ERROR"}, "it is about no vertices that are in the scene")
            return {"CANCELLED"}
        if context.object is not None and context.object.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        for thing in context.selected_objects:
            thing.select_set(False)
        context.scene.tool_settings.mesh_select_mode = (True, False, False)
        for place in places:
            place.object.hide_set(False)
            place.object.select_set(True)
        context.view_layer.objects.active = places[0].object
        # All of the selected ones.
        bpy.ops.object.mode_set(mode="EDIT")
        for place in places:
            _select(place.object.data, place["vertices"])
        if context.region_data is not None:
            bpy.ops.view3d.view_selected()
        return {"FINISHED"}


def _is_there(context: bpy.types.Context, place: Any) -> bool:
    thing = place.object
    vertices = place.get("vertices")
    if thing is None or vertices is None or thing.name not in context.view_layer.objects:
        return False
    return max(vertices) < len(thing.data.vertices)


def _select(mesh: bpy.types.Mesh, vertices: Any) -> None:
    """Those alone of a mesh in edit mode, and the edges and faces between them."""
    edited = bmesh.from_edit_mesh(mesh)
    edited.select_mode = {"VERT"}
    chosen = set(vertices)
    for face in edited.faces:
        face.select_set(False)
    for vertex in edited.verts:
        vertex.select_set(vertex.index in chosen)
    edited.select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


_CLASSES = (BESPOKE_UL_findings, BESPOKE_OT_select_finding)


def register() -> None:
    """With the classes."""
    for each in _CLASSES:
        bpy.utils.register_class(each)


def unregister() -> None:
    """Without."""
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
