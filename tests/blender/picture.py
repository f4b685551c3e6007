"""Draws characters with Cycles, which needs no screen: front and back beside each other."""

from __future__ import annotations

import math
from collections.abc import Sequence

import bpy
import mathutils


def _corners(things: Sequence[bpy.types.Object]) -> list[mathutils.Vector]:
    return [thing.matrix_world @ mathutils.Vector(corner) for thing in things for corner in thing.bound_box]


def _shade(thing: bpy.types.Object) -> None:
    for slot in thing.material_slots:
        if slot.material is None or slot.material.node_tree is not None:
            continue
        colour = slot.material.diffuse_color[:]
        slot.material.use_nodes = True
        slot.material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = colour
        slot.material.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.8


def draw(
    things: Sequence[bpy.types.Object], path: str, turns: Sequence[float] = (-25.0, 155.0), height: int = 700
) -> None:
    """Draws `things` alone, seen from `turns` degrees around their middle (0: from the front), side by side.

    They are drawn as instances of one collection, turned, so that the scene stays as it is.
    """
    scene = bpy.data.scenes.new("picture")
    collection = bpy.data.collections.new("picture")
    for thing in things:
        _shade(thing)
        collection.objects.link(thing)
    corners = _corners(things)
    low = mathutils.Vector([min(c[k] for c in corners) for k in range(3)])
    high = mathutils.Vector([max(c[k] for c in corners) for k in range(3)])
    middle, size = (low + high) / 2, high - low
    across = 0.0
    for k, turn in enumerate(turns):
        empty = bpy.data.objects.new(f"turn {k}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        rotation = mathutils.Matrix.Rotation(math.radians(turn), 4, "Z")
        sides = [(rotation @ (corner - middle)).x for corner in corners]
        across += 0.04 * size.z - min(sides)
        place = mathutils.Matrix.Translation((across, 0.0, -low.z))
        across += max(sides)
        empty.matrix_world = place @ rotation @ mathutils.Matrix.Translation((-middle.x, -middle.y, 0.0))
        scene.collection.objects.link(empty)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.data.type = "ORTHO"
    across, up = across + 0.04 * size.z, size.z * 1.08
    camera.data.ortho_scale = max(across, up)
    camera.location, camera.rotation_euler = (across / 2, -20.0, size.z / 2), (math.pi / 2, 0.0, 0.0)
    scene.camera = camera
    for energy, angles in ((2.4, (50, 0, 30)), (0.9, (60, 0, -60))):
        sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
        sun.data.energy, sun.data.angle = energy, 0.3
        sun.rotation_euler = [math.radians(angle) for angle in angles]
        scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("picture")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.85, 0.87, 0.9, 1.0)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces = 24, False, 3
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = int(height * across / up), height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format, scene.render.filepath = "PNG", path
    bpy.ops.render.render(write_still=True, scene=scene.name)
    bpy.data.scenes.remove(scene)
    bpy.data.collections.remove(collection)
