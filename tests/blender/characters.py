"""The sample of `make demo` as characters in Blender: the mannequin in its jacket, and a body to be dressed, with
armatures in the names of two tools."""

from __future__ import annotations

import os
import pathlib

import bpy
import mathutils
import numpy as np

SAMPLE = pathlib.Path(os.environ["BESPOKE_SAMPLE"])

# The joints of the sample's skeletons, with what each hangs on.
PARENTS = [None, 0, 1, 1, 3, 4, 1, 8, 6, 0, 9, 10, 0, 12, 13]
_RIGIFY = """spine spine.001 neck upper_arm.L forearm.L hand.L upper_arm.R hand.R forearm.R
    thigh.L shin.L foot.L thigh.R shin.R foot.R"""
_MIXAMO = """Hips Spine Neck LeftArm LeftForeArm LeftHand RightArm RightHand RightForeArm
    LeftUpLeg LeftLeg LeftFoot RightUpLeg RightLeg RightFoot"""
RIGIFY = _RIGIFY.split()
MIXAMO = [f"mixamorig:{name}" for name in _MIXAMO.split()]


def lines(path: pathlib.Path, start: str) -> list[list[str]]:
    """The words of the lines of an OBJ file that begin so."""
    return [line.split()[1:] for line in path.read_text().splitlines() if line.startswith(f"{start} ")]


def armature(name: str, skeleton: pathlib.Path, names: list[str]) -> bpy.types.Object:
    """An armature with a bone for each joint, along to what hangs on it."""
    places = [mathutils.Vector(map(float, words)) for words in lines(skeleton, "v")]
    thing = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    bones = thing.data.edit_bones
    for joint, place in enumerate(places):
        bone = bones.new(names[joint])
        below = [places[k] for k, parent in enumerate(PARENTS) if parent == joint]
        parent = PARENTS[joint]
        along = below[0] - place if below else place - places[0 if parent is None else parent]
        bone.head, bone.tail = place, place + (along if below else along.normalized() * 0.1)
    for joint, parent in enumerate(PARENTS):
        if parent is not None:
            bones[names[joint]].parent = bones[names[parent]]
    bpy.ops.object.mode_set(mode="OBJECT")
    return thing


def mesh(name: str, path: pathlib.Path) -> bpy.types.Object:
    """A mesh as Blender imports it, in the order of the file."""
    bpy.ops.wm.obj_import(filepath=str(path), forward_axis="Y", up_axis="Z")
    thing = bpy.context.selected_objects[0]
    thing.name = thing.data.name = name
    return thing


def bind(thing: bpy.types.Object, to: bpy.types.Object, names: list[str], weights: np.ndarray) -> None:
    """Hangs a mesh on an armature. `weights`: a row a joint."""
    for joint, row in enumerate(weights):
        group = thing.vertex_groups.new(name=names[joint])
        for vertex in np.flatnonzero(row > 1e-4):
            group.add([int(vertex)], float(row[vertex]), "REPLACE")
    thing.parent = to
    thing.modifiers.new("Armature", "ARMATURE").object = to


def nearest(thing: bpy.types.Object, skeleton: pathlib.Path) -> np.ndarray:
    """Weights of a mesh that nobody has painted: a vertex goes with the nearest bone."""
    places = np.array([list(map(float, words)) for words in lines(skeleton, "v")])
    points = np.array([vertex.co for vertex in thing.data.vertices])
    distances = []
    for joint, place in enumerate(places):
        ends = [places[k] for k, parent in enumerate(PARENTS) if parent == joint]
        if not ends:
            # As far as the bone of the armature.
            along_parent = place - places[PARENTS[joint]]
            ends = [place + along_parent / np.linalg.norm(along_parent) * 0.1]
        along = []
        for end in ends:
            t = np.clip((points - place) @ (end - place) / ((end - place) @ (end - place)), 0.0, 1.0)
            along.append(np.linalg.norm(points - place - t[:, None] * (end - place), axis=1))
        distances.append(np.min(along, axis=0))
    return (np.argmin(distances, axis=0) == np.arange(len(places))[:, None]).astype(float)


def material(thing: bpy.types.Object, colour: tuple[float, float, float]) -> None:
    """One colour."""
    made = bpy.data.materials.new(thing.name)
    made.diffuse_color = (*colour, 1.0)
    thing.data.materials.clear()
    thing.data.materials.append(made)


def body(name: str, folder: str, names: list[str], place: tuple[float, float, float]) -> bpy.types.Object:
    """A body to dress on its armature, standing at a place."""
    thing = mesh(name, SAMPLE / folder / "avatar.obj")
    rig = armature(f"{name} rig", SAMPLE / folder / "skeleton.obj", names)
    bind(thing, rig, names, np.loadtxt(SAMPLE / folder / "skin.txt"))
    material(thing, (0.72, 0.55, 0.45))
    rig.location = place
    bpy.context.view_layer.update()
    return rig


def empty() -> None:
    """A file without anything."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def fill() -> None:
    """Objects "mannequin", "jacket", "mannequin rig", "heavy", "heavy rig"."""
    skeleton = SAMPLE / "skeleton.obj"
    mannequin, jacket = mesh("mannequin", SAMPLE / "mannequin.obj"), mesh("jacket", SAMPLE / "jacket/garment.obj")
    rig = armature("mannequin rig", skeleton, RIGIFY)
    for thing in (mannequin, jacket):
        bind(thing, rig, RIGIFY, nearest(thing, skeleton))
    material(mannequin, (0.7, 0.7, 0.68))
    jacket.data.materials[0].diffuse_color = (0.10, 0.22, 0.40, 1.0)
    jacket.data.edges[10].use_seam = True
    body("heavy", "heavy", MIXAMO, (0.0, 0.0, 0.0))


def choose() -> None:
    """As somebody does in the panel."""
    settings = bpy.context.scene.bespoke
    objects = bpy.data.objects
    for thing in bpy.context.selected_objects:
        thing.select_set(False)
    objects["jacket"].select_set(True)
    bpy.ops.bespoke.add_meshes(which="garments")
    settings.target = objects["heavy rig"]
