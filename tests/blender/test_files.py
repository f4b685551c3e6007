"""Characters that come out of files and go into files: FBX and glTF, as Blender reads and writes them."""

from __future__ import annotations

import os
import pathlib

import bpy
import numpy as np

import tubes
from case import ROOT, Case, part, seen, weights

FOLDER = pathlib.Path(os.environ["BLENDER_USER_RESOURCES"]) / "files"


def save(path: pathlib.Path, *names: str) -> None:
    """Writes objects, as with "selected objects" in the dialog."""
    for thing in bpy.data.objects:
        thing.select_set(thing.name in names)
    FOLDER.mkdir(exist_ok=True)
    if path.suffix == ".fbx":
        bpy.ops.export_scene.fbx(filepath=str(path), use_selection=True)
    else:
        bpy.ops.export_scene.gltf(filepath=str(path), use_selection=True)


def load(path: pathlib.Path) -> None:
    """Reads a file with the defaults of the dialog."""
    if path.suffix == ".fbx":
        bpy.ops.import_scene.fbx(filepath=str(path))
    else:
        bpy.ops.import_scene.gltf(filepath=str(path))


def places(points: np.ndarray) -> np.ndarray:
    """Each once, for a file may hold a vertex for each corner."""
    return np.unique(np.round(points, 3), axis=0)


class Files(Case):
    def there_and_back(self, ending: str) -> None:
        tubes.scene()
        for name in ("rig", "other rig"):
            bpy.data.objects[name].name = f"{name} armature"
        plain = places(seen(self.dress()))
        bpy.data.objects.remove(bpy.data.objects["sleeve on other rig armature"])
        source, target, dressed = (FOLDER / f"{name}{ending}" for name in ("source", "target", "dressed"))
        save(source, "sleeve", "arm", "rig armature")
        save(target, "other", "other rig armature")

        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        load(source)
        load(target)
        rig = bpy.data.objects["other rig armature"]
        tubes.choose("sleeve")
        self.settings.target = rig
        self.assertEqual([item.object.name for item in self.settings.source_bodies], ["arm"])
        self.assertEqual([item.object.name for item in self.settings.target_bodies], ["other"])
        made = self.dress()
        found = places(seen(made))
        # What was rounded otherwise on the way may come out in another row.
        distances = np.linalg.norm(found[:, None] - plain[None], axis=2).min(axis=1)
        self.assertLess(distances.max(), 5e-3)
        rows = weights(made, rig)
        self.near(rows.sum(axis=0), np.ones(rows.shape[1]), 1e-5)

        name = made.name
        save(dressed, "other", name, rig.name)
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        load(dressed)
        again = bpy.data.objects[name]
        rig = part("dials").armature_of(again)
        self.assertEqual(rig.name, "other rig armature")
        self.assertLess(np.linalg.norm(places(seen(again))[:, None] - found[None], axis=2).min(axis=1).max(), 2e-3)
        rest = seen(again)
        pose = rig.pose.bones["Head"]
        pose.rotation_mode, pose.rotation_euler = "XYZ", (0.6, 0.0, 0.0)
        above = rest[:, 2] > 0.5
        self.assertGreater(np.linalg.norm(seen(again) - rest, axis=1)[above].max(), 0.02)

    def test_gltf(self) -> None:
        self.there_and_back(".glb")

    def test_fbx(self) -> None:
        self.there_and_back(".fbx")

    def test_the_script_of_the_page(self) -> None:
        """docs/blender.md, "From a script", as it stands there."""
        tubes.scene()
        for old, new in (("sleeve", "Suit"), ("rig", "SuitArmature"), ("other rig", "Rig")):
            bpy.data.objects[old].name = new
        save(FOLDER / "suit.fbx", "Suit", "arm", "SuitArmature")
        save(FOLDER / "barbarian.glb", "other", "Rig")
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        page = (ROOT / "docs/blender.md").read_text()
        script = page[page.index("## From a script") :].split("```python\n")[1].split("```")[0]
        folder = os.getcwd()
        os.chdir(FOLDER)
        try:
            exec(compile(script, "docs/blender.md", "exec"), {})
        finally:
            os.chdir(folder)
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        load(FOLDER / "dressed.glb")
        rig = bpy.data.objects["Rig"]
        worn = [thing for thing in rig.children if thing.type == "MESH" and thing.name.startswith("Suit")]
        self.assertEqual(len(worn), 1, [thing.name for thing in bpy.data.objects])
        self.near(weights(worn[0], rig).sum(axis=0), np.ones(len(worn[0].data.vertices)), 1e-5)

    def test_what_is_no_body_is_not_taken_for_one(self) -> None:
        tubes.scene()
        for name, parent_type in (("sword", "BONE"), ("hidden", "OBJECT")):
            thing = tubes.tube(name, 0.05, 0.4, 8, 3)
            thing.parent, thing.parent_type = bpy.data.objects["other rig"], parent_type
            thing.parent_bone = "Spine" if parent_type == "BONE" else ""
        thing.hide_set(True)
        self.settings.target_bodies.clear()
        self.settings.target = bpy.data.objects["other rig"]
        self.assertEqual([item.object.name for item in self.settings.target_bodies], ["other"])

    def test_what_hangs_on_a_bone_goes_with_it(self) -> None:
        tubes.scene()
        band = tubes.tube("band", 0.34, 0.1, 16, 3)
        band.parent, band.parent_type, band.parent_bone = bpy.data.objects["rig"], "BONE", "Spine"
        bpy.context.view_layer.update()
        # Where it was before it hung on the bone.
        band.matrix_world = band.matrix_world.Identity(4)
        bpy.context.view_layer.update()
        rest = seen(band)
        self.settings.garments.clear()
        tubes.choose("band")
        pose = bpy.data.objects["rig"].pose.bones["Spine"]
        pose.rotation_mode, pose.rotation_euler = "XYZ", (0.9, 0.0, 0.0)
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(seen(band) - rest).max(), 0.1)
        garment = part("inputs").gather(bpy.context).task.garments[0]
        self.near(garment.vertices.astype(float), rest, 1e-6)
        self.assertEqual(set(garment.influences[0].ravel().tolist()), {1})
        made = self.dress()
        self.assertEqual((made.parent.name, made.parent_type), ("other rig", "OBJECT"))
