"""What bespoke_unreal.py uses of the editor's module, over characters of testing::engine, so that it can be run without the editor.
The parameters are those of Epic's reference of the Python API (5.3 to 5.7); what the engine does with them is not here."""

from __future__ import annotations

import os
import pathlib

import numpy as np

FOLDER = pathlib.Path(os.environ["BESPOKE_CHARACTERS"])
# What was called, in order; assets that were made; whether Cancel is pressed after so many looks.
calls: list[str] = []
made: dict[str, "SkeletalMesh"] = {}
lines: list[str] = []
state = {"looks_until_cancel": None}


class Vector:
    def __init__(self, x=0.0, y=0.0, z=0.0, w=0.0):
        self.x, self.y, self.z, self.w = x, y, z, w


class Skeleton:
    pass


class SkeletalMaterial:
    def __init__(self, slot):
        self.material_slot_name, self.material_interface = slot, object()


class SkeletalMesh:
    def __init__(self, name):
        self.name, self.skeleton, self.materials = name, Skeleton(), [SkeletalMaterial("Cloth")]
        self.content: DynamicMesh | None = None

    def get_name(self):
        return self.name

    def get_all_morph_target_names(self):
        return state["morphs"]


class Matrix:
    def __init__(self, rows):
        self.x_plane, self.y_plane, self.z_plane, self.w_plane = (Vector(*row) for row in rows)


class Transform:
    def __init__(self, rows):
        self.rows = rows

    def to_matrix(self):
        return Matrix(self.rows)


class GeometryScriptBoneInfo:
    def __init__(self, index, name, parent, local):
        self.index, self.name, self.parent_index, self.local_transform = index, name, parent, Transform(local)


class GeometryScriptBoneWeight:
    def __init__(self, bone_index=0, weight=0.0):
        self.bone_index, self.weight = bone_index, weight


class DynamicMesh:
    def __init__(self):
        self.positions, self.triangles, self.infos, self.skin = [], [], [], []


class GeometryScriptOutcomePins:
    FAILURE, SUCCESS = 0, 1


class GeometryScriptCopyMeshFromAssetOptions:
    pass


class GeometryScriptMeshReadLOD:
    pass


class GeometryScriptCalculateNormalsOptions:
    pass


class GeometryScriptCreateNewSkeletalMeshAssetOptions:
    pass


def _numbers(name, kind):
    return np.fromfile(FOLDER / name, kind)


class GeometryScript_AssetUtils:
    @staticmethod
    def copy_mesh_from_skeletal_mesh(from_skeletal_mesh_asset, to_dynamic_mesh, asset_options, requested_lod, debug=None):
        name = from_skeletal_mesh_asset.name
        if name == "empty":
            return to_dynamic_mesh, GeometryScriptOutcomePins.FAILURE
        mesh = to_dynamic_mesh
        mesh.positions = [Vector(*map(float, p)) for p in _numbers(f"{name}.positions", np.float32).reshape(-1, 3)]
        mesh.triangles = [Vector(*map(int, t)) for t in _numbers(f"{name}.triangles", np.uint32).reshape(-1, 3)]
        # Vectors are rows in the engine, and these matrices are kept column after column.
        binds = _numbers(f"{name}.binds", np.float64).reshape(-1, 4, 4)
        for k, line in enumerate((FOLDER / f"{name}.names").read_text().splitlines()):
            parent, own = line.split("\t")
            local = binds[k] if int(parent) < 0 else binds[k] @ np.linalg.inv(binds[int(parent)])
            mesh.infos.append(GeometryScriptBoneInfo(k, own, int(parent), local))
        joints = _numbers(f"{name}.joints", np.uint32).reshape(len(mesh.positions), -1)
        weights = _numbers(f"{name}.weights", np.float32).reshape(joints.shape)
        mesh.skin = [
            [GeometryScriptBoneWeight(int(j), float(w)) for j, w in zip(*row) if w > 0] for row in zip(joints, weights)
        ]
        return mesh, GeometryScriptOutcomePins.SUCCESS


class GeometryScript_MeshQueries:
    @staticmethod
    def get_all_vertex_positions(target_mesh, skip_gaps):
        return target_mesh, list(target_mesh.positions), False

    @staticmethod
    def get_all_triangle_indices(target_mesh, skip_gaps):
        return target_mesh, list(target_mesh.triangles), False


class GeometryScript_List:
    @staticmethod
    def convert_vector_list_to_array(vector_list):
        return vector_list

    @staticmethod
    def convert_triangle_list_to_array(triangle_list):
        return triangle_list

    @staticmethod
    def convert_array_to_vector_list(vector_array):
        return vector_array


class GeometryScript_BoneWeights:
    @staticmethod
    def get_all_bones_info(target_mesh, debug=None):
        return target_mesh, list(reversed(target_mesh.infos))

    @staticmethod
    def get_vertex_bone_weights(target_mesh, vertex_id, profile=None):
        return target_mesh, target_mesh.skin[vertex_id], True

    @staticmethod
    def set_vertex_bone_weights(target_mesh, vertex_id, bone_weights, profile=None):
        target_mesh.skin[vertex_id] = bone_weights
        return target_mesh, True

    @staticmethod
    def copy_bones_from_mesh(source_mesh, target_mesh, debug=None):
        target_mesh.infos = source_mesh.infos
        return target_mesh


class GeometryScript_MeshEdits:
    @staticmethod
    def set_all_mesh_vertex_positions(target_mesh, position_list, debug=None):
        assert len(position_list) == len(target_mesh.positions)
        target_mesh.positions = position_list
        return target_mesh


class GeometryScript_Normals:
    @staticmethod
    def recompute_normals(target_mesh, calculate_options, defer_change_notifications=False, debug=None):
        calls.append("recompute_normals")
        return target_mesh


class GeometryScript_NewAssetUtils:
    @staticmethod
    def create_new_skeletal_mesh_asset_from_mesh(from_dynamic_mesh, skeleton, asset_path_and_name, options, debug=None):
        if asset_path_and_name.startswith("/Nowhere"):
            return None, GeometryScriptOutcomePins.FAILURE
        asset = SkeletalMesh(asset_path_and_name)
        asset.skeleton, asset.content, asset.options = skeleton, from_dynamic_mesh, options
        made[asset_path_and_name] = asset
        return asset, GeometryScriptOutcomePins.SUCCESS


class EditorAssetLibrary:
    @staticmethod
    def does_asset_exist(asset_path):
        return asset_path in made

    @staticmethod
    def delete_asset(asset_path_to_delete):
        return made.pop(asset_path_to_delete, None) is not None


class ScopedSlowTask:
    def __init__(self, work, desc="", enabled=True):
        self.work, self.done = work, 0.0

    def __enter__(self):
        return self

    def __exit__(self, type, value, traceback):
        return False

    def make_dialog(self, can_cancel=False, allow_in_pie=False):
        assert can_cancel

    def enter_progress_frame(self, work=1.0, desc=""):
        assert work >= 0.0
        self.done += work
        lines.append(desc)
        assert self.done <= self.work + 1e-9

    def should_cancel(self):
        if state["looks_until_cancel"] is None:
            return False
        state["looks_until_cancel"] -= 1
        return state["looks_until_cancel"] < 0


_assets: dict[str, SkeletalMesh] = {}


def load_asset(name, type=None, follow_redirectors=True):
    if name.startswith("/Game/Missing"):
        return None
    return _assets.setdefault(name, SkeletalMesh(name.rsplit("/", 1)[-1]))


def log(arg):
    lines.append(f"log: {arg}")


def log_warning(arg):
    lines.append(f"warning: {arg}")
