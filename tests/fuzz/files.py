"""Writes the corpus of the target `files`, small GLB files that are right or that lie: python3 files.py FOLDER"""

import copy
import json
import struct
import sys
from pathlib import Path

FOLDER = Path(sys.argv[1])


def glb(document, binary=b"", total=None, json_length=None, binary_length=None):
    text = document if isinstance(document, bytes) else json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text) if json_length is None else json_length, b"JSON") + text
    chunks += struct.pack("<I4s", len(binary) if binary_length is None else binary_length, b"BIN\0") + binary
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks) if total is None else total) + chunks


class Writer:
    def __init__(self):
        self.binary, self.views, self.accessors = b"", [], []

    def add(self, form, numbers, kind, shape, count, **more):
        self.binary += b"\0" * (-len(self.binary) % 4)
        data = struct.pack(f"<{len(numbers)}{form}", *numbers)
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        entry = {"bufferView": len(self.views) - 1, "componentType": kind, "type": shape, "count": count, **more}
        self.accessors.append(entry)
        return len(self.accessors) - 1


def character():
    """A square on two joints with a morph target and an animation of each kind."""
    w = Writer()
    points = [-0.5, 0, 0, 0.5, 0, 0, -0.5, 1, 0, 0.5, 1, 0.125]
    w.add("f", points, 5126, "VEC3", 4, min=[-0.5, 0, 0], max=[0.5, 1, 0.125])
    w.add("B", [0, 1, 0, 0] * 4, 5121, "VEC4", 4)
    w.add("B", [204, 51, 0, 0] * 4, 5121, "VEC4", 4, normalized=True)
    w.add("H", [0, 1, 2, 2, 1, 3], 5123, "SCALAR", 6)
    one = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    w.add("f", one + one[:12] + [0, -1, 0, 1], 5126, "MAT4", 2)
    w.add("f", [0, 1], 5126, "SCALAR", 2, min=[0], max=[1])
    w.add("f", [0, 0, 0, 1, 0, 0, 1, 0], 5126, "VEC4", 2)
    w.add("f", [0] * 9 + [1] * 9, 5126, "VEC3", 6)
    w.add("f", [0, 1], 5126, "SCALAR", 2)
    at = len(w.binary)
    w.binary += struct.pack("<HH3f", 2, 0, 0, 0, 1)
    w.views.append({"buffer": 0, "byteOffset": at, "byteLength": 16})
    view = len(w.views) - 1
    sparse = {"count": 1, "indices": {"bufferView": view, "componentType": 5123},
              "values": {"bufferView": view, "byteOffset": 4}}
    w.accessors.append({"componentType": 5126, "type": "VEC3", "count": 4, "sparse": sparse})
    channel = lambda node, path, k: {"sampler": k, "target": {"node": node, "path": path}}
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 2]}],
        "nodes": [{"name": "a", "children": [1]}, {"name": "b", "translation": [0, 1, 0]}, {"mesh": 0, "skin": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3,
                                    "targets": [{"POSITION": 9}]}]}],
        "skins": [{"joints": [0, 1], "inverseBindMatrices": 4}],
        "animations": [{"channels": [channel(1, "rotation", 0), channel(0, "translation", 1), channel(2, "weights", 2)],
                        "samplers": [{"input": 5, "output": 6}, {"input": 5, "output": 7, "interpolation": "CUBICSPLINE"},
                                     {"input": 5, "output": 8, "interpolation": "STEP"}]}],
        "accessors": w.accessors,
        "bufferViews": w.views,
        "buffers": [{"byteLength": len(w.binary)}],
    }
    return document, w.binary


DOCUMENT, BINARY = character()


def triangle(mode=4, corners=3):
    w = Writer()
    w.add("f", [x for k in range(corners) for x in (k % 2, k // 2, 0)], 5126, "VEC3", corners)
    return {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": mode}]}],
            "accessors": w.accessors, "bufferViews": w.views, "buffers": [{"byteLength": len(w.binary)}]}, w.binary


def changed(*steps):
    """The character with values replaced: (path, value), paths as lists of keys."""
    document = copy.deepcopy(DOCUMENT)
    for path, value in steps:
        at = document
        for key in path[:-1]:
            at = at[key]
        if value is None:
            del at[path[-1]]
        else:
            at[path[-1]] = value
    return glb(document, BINARY)


whole = glb(DOCUMENT, BINARY)
bones = {"hips": {"node": 0}, "head": {"node": 1}}
old_bones = [{"bone": "hips", "node": 0}, {"bone": "leftThumbProximal", "node": 1}, {"bone": "head", "node": -1}]
not_a_number = bytearray(BINARY)
not_a_number[0:4] = struct.pack("<f", float("nan"))
infinite_bind = bytearray(BINARY)
start = DOCUMENT["bufferViews"][4]["byteOffset"]
infinite_bind[start:start + 4] = struct.pack("<f", float("inf"))
strip, fan, points, odd = triangle(5, 6), triangle(6, 5), triangle(0), triangle(4, 4)
many = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0} for _ in range(60)], **{
    key: DOCUMENT[key] for key in ("meshes", "accessors", "bufferViews", "buffers")}}

FILES = {
    "character": whole,
    "strip": glb(*strip),
    "fan": glb(*fan),
    "points": glb(*points),
    "odd_corners": glb(*odd),
    "vrm_one": changed((["extensions"], {"VRMC_vrm": {"humanoid": {"humanBones": bones}}})),
    "vrm_zero": changed((["extensions"], {"VRM": {"humanoid": {"humanBones": old_bones}, "materialProperties": []}})),
    "text": json.dumps({**strip[0], "buffers": [{"byteLength": 72, "uri": "data:;base64," + "A" * 96}]}).encode(),
    "outside": json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "../secret.bin"}]}).encode(),
    "empty": b"",
    "header_only": whole[:12],
    "no_chunks": b"glTF" + struct.pack("<II", 2, 12),
    "version_one": b"glTF" + struct.pack("<II", 1, len(whole)) + whole[12:],
    "cut_in_json": whole[:300],
    "cut_in_data": whole[:-40],
    "total_above": glb(DOCUMENT, BINARY, total=0xFFFFFFFF),
    "total_below": glb(DOCUMENT, BINARY, total=20),
    "json_above": glb(DOCUMENT, BINARY, json_length=0xFFFFFFFC),
    "json_below": glb(DOCUMENT, BINARY, json_length=8),
    "data_above": glb(DOCUMENT, BINARY, binary_length=0xFFFFFFFC),
    "data_empty": glb(DOCUMENT, BINARY, binary_length=0),
    "cycle": changed((["nodes", 1, "children"], [0])),
    "own_child": changed((["nodes", 1, "children"], [1])),
    "two_parents": changed((["nodes", 2, "children"], [1])),
    "child_beyond": changed((["nodes", 0, "children"], [4294967295])),
    "scene_beyond": changed((["scene"], 7)),
    "not_a_number": glb(DOCUMENT, bytes(not_a_number)),
    "infinite_bind": glb(DOCUMENT, bytes(infinite_bind)),
    "far_away": changed((["nodes", 0, "translation"], [1e308, 0, 0]), (["nodes", 1, "translation"], [1e308, 0, 0])),
    "flat": changed((["nodes", 0, "scale"], [0, 0, 0])),
    "no_rotation": changed((["nodes", 0, "rotation"], [0, 0, 0, 0])),
    "four_gigabytes": changed((["accessors", 0, "count"], 357913941)),
    "four_gigabytes_of_nothing": changed((["accessors", 0, "count"], 4294967295), (["accessors", 0, "bufferView"], None)),
    "four_gigabytes_buffer": changed((["buffers", 0, "byteLength"], 4294967295)),
    "four_gigabytes_view": changed((["bufferViews", 0, "byteLength"], 4294967295)),
    "four_gigabytes_sparse": changed((["accessors", 9, "sparse", "count"], 4294967295)),
    "sum_overflows": changed((["bufferViews", 0, "byteOffset"], 9007199254740992)),
    "stride_of_none": changed((["bufferViews", 0, "byteStride"], 0)),
    "stride_of_all": changed((["bufferViews", 0, "byteStride"], 4294967295)),
    "sparse_beyond": changed((["accessors", 9, "count"], 2)),
    "index_beyond": changed((["accessors", 0, "count"], 2)),
    "joint_beyond": changed((["skins", 0, "joints"], [0])),
    "joints_twice": changed((["skins", 0, "joints"], [1, 1])),
    "no_joints": changed((["skins", 0, "joints"], [])),
    "negative": changed((["meshes", 0, "primitives", 0, "attributes", "POSITION"], -1)),
    "half": changed((["meshes", 0, "primitives", 0, "attributes", "POSITION"], 0.5)),
    "mode_seven": changed((["meshes", 0, "primitives", 0, "mode"], 7)),
    "many_instances": glb(many, BINARY),
    "times_back": changed((["animations", 0, "samplers", 0, "input"], 0)),
    "values_missing": changed((["animations", 0, "samplers", 1, "output"], 6)),
    "weights_of_none": changed((["animations", 0, "channels", 2, "target", "node"], 0)),
    "sampler_beyond": changed((["animations", 0, "channels", 0, "sampler"], 99)),
    "draco": changed((["meshes", 0, "primitives", 0, "extensions"], {"KHR_draco_mesh_compression": {"bufferView": 0}}),
                     (["accessors", 0, "bufferView"], None)),
    "meshopt": changed((["bufferViews", 0, "extensions"], {"EXT_meshopt_compression": {"buffer": 0}}),
                       (["buffers"], [{"byteLength": 16, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}])),
    "deep": glb(b'{"asset":' + b"[" * 1000, b""),
    "lists_are_none": glb({"asset": {"version": "2.0"}, "nodes": {}, "meshes": 4, "accessors": "many"}),
    "zeros_as_padding": glb(json.dumps(strip[0]).encode() + b"\0" * (4 + -len(json.dumps(strip[0])) % 4), strip[1]),
}

FOLDER.mkdir(parents=True, exist_ok=True)
for name, data in FILES.items():
    (FOLDER / name).write_bytes(data)
