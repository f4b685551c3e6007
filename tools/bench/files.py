"""Measures what the program takes beside the library: real pairs of OBJ files are made GLB files and dressed by one command each.

    python3 tools/bench/files.py PROGRAM ASSETS OUT [--repeat N]

ASSETS is a folder as `make pairs` takes it: garments/NAME with garment.obj, skeleton.obj and mannequin.obj, avatars/NAME with
avatar.obj, skeleton.obj and perhaps skin.txt. For each pair: seconds from the command to the file, the library's own seconds from the
report, and the difference, each the median of N runs with one thread. Where other programs take the processor, all three are longer by
the same factor, so the difference is also given times the share of the processor that the program had.
"""

import argparse
import json
import math
import os
import statistics
import struct
import subprocess
import sys
import time
from pathlib import Path

# The joints that these skeletons share, in their order.
NAMES = ["Hips", "Spine", "Neck", "LeftArm", "LeftForeArm", "LeftHand", "RightArm", "RightHand", "RightForeArm",
         "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg", "RightFoot"]
INFLUENCES = 4


def read_obj(path):
    points, faces, lines = [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append(tuple(map(float, words[1:4])))
        elif words[0] == "f":
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
        elif words[0] == "l":
            lines.append(tuple(int(word) - 1 for word in words[1:3]))
    return points, faces, lines


def distance(p, a, b):
    """Of a point from a segment."""
    along = [y - x for x, y in zip(a, b)]
    length = sum(x * x for x in along)
    t = min(1.0, max(0.0, sum((p[k] - a[k]) * along[k] for k in range(3)) / length)) if length else 0.0
    return math.dist(p, [a[k] + t * along[k] for k in range(3)])


def nearest_bones(points, joints, bones, above):
    """All of a vertex to the upper joint of its nearest bone."""
    def owner(p):
        a, b = min(bones, key=lambda bone: distance(p, joints[bone[0]], joints[bone[1]]))
        return [(a if above[b] == a else b, 1.0)]
    return [owner(p) for p in points]


def read_skin(path, vertices):
    rows = [[float(word) for word in line.split()] for line in path.read_text().splitlines() if line.strip()]
    influences = []
    for v in range(vertices):
        own = sorted(((row[v], k) for k, row in enumerate(rows) if row[v] > 0), reverse=True)[:INFLUENCES]
        total = sum(weight for weight, _ in own) or 1.0
        influences.append([(k, weight / total) for weight, k in own] or [(0, 1.0)])
    return influences


def parents(bones, count):
    above, reached = [None] * count, [0]
    for joint in reached:
        for pair in bones:
            for a, b in (pair, pair[::-1]):
                if a == joint and b not in reached:
                    above[b] = a
                    reached.append(b)
    return above


def write_glb(path, skeleton, meshes):
    """`meshes`: name, points, triangles, influences of each."""
    joints, _, bones = skeleton
    above = parents(bones, len(joints))
    binary, views, accessors = bytearray(), [], []

    def add(form, numbers, kind, shape, count, **more):
        binary.extend(b"\0" * (-len(binary) % 4))
        data = struct.pack(f"<{len(numbers)}{form}", *numbers)
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary.extend(data)
        accessors.append({"bufferView": len(views) - 1, "componentType": kind, "type": shape, "count": count, **more})
        return len(accessors) - 1

    nodes = []
    for k, joint in enumerate(joints):
        base = joints[above[k]] if above[k] is not None else (0.0, 0.0, 0.0)
        children = [c for c, parent in enumerate(above) if parent == k]
        nodes.append({"name": NAMES[k], "translation": [x - y for x, y in zip(joint, base)],
                      **({"children": children} if children else {})})
    inverse = [x for j in joints for x in (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -j[0], -j[1], -j[2], 1)]
    skin = {"joints": list(range(len(joints))), "inverseBindMatrices": add("f", inverse, 5126, "MAT4", len(joints))}
    entries, materials = [], []
    for name, points, triangles, influences in meshes:
        short = struct.unpack(f"<{3 * len(points)}f", struct.pack(f"<{3 * len(points)}f", *(x for p in points for x in p)))
        bounds = {"min": [min(short[k::3]) for k in range(3)], "max": [max(short[k::3]) for k in range(3)]}
        padded = [(row + [(0, 0.0)] * INFLUENCES)[:INFLUENCES] for row in influences]
        primitive = {
            "attributes": {
                "POSITION": add("f", short, 5126, "VEC3", len(points), **bounds),
                "JOINTS_0": add("B", [j for row in padded for j, _ in row], 5121, "VEC4", len(points)),
                "WEIGHTS_0": add("f", [w for row in padded for _, w in row], 5126, "VEC4", len(points)),
            },
            "indices": add("I", [v for t in triangles for v in t], 5125, "SCALAR", 3 * len(triangles)),
            "material": len(materials),
        }
        materials.append({"name": name})
        entries.append({"primitives": [primitive]})
        nodes.append({"name": name, "mesh": len(entries) - 1, "skin": 0})
    binary.extend(b"\0" * (-len(binary) % 4))
    roots = [k for k, parent in enumerate(above) if parent is None] + list(range(len(joints), len(nodes)))
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes,
                       "skins": [skin], "meshes": entries, "materials": materials, "accessors": accessors,
                       "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + bytes(binary)
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)


def upright(points, is_up):
    """To glTF's axes from z up."""
    return points if is_up else [(x, z, -y) for x, y, z in points]


def y_is_up(joints):
    """The neck is above the hips."""
    return abs(joints[2][1] - joints[0][1]) > abs(joints[2][2] - joints[0][2])


def files_of(folder, body, clothes):
    joints, _, bones = read_obj(folder / "skeleton.obj")
    is_up = y_is_up(joints)
    joints = upright(joints, is_up)
    above = parents(bones, len(joints))
    meshes = []
    for name, file in [("Body Skin", body), *([("Garment", clothes)] if clothes else [])]:
        points, triangles, _ = read_obj(folder / file)
        points = upright(points, is_up)
        skin = folder / "skin.txt"
        rows = (read_skin(skin, len(points)) if name == "Body Skin" and skin.is_file()
                else nearest_bones(points, joints, bones, above))
        meshes.append((name, points, triangles, rows))
    return (joints, None, bones), meshes


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("assets", type=Path)
    arguments.add_argument("out", type=Path)
    arguments.add_argument("--repeat", type=int, default=3)
    args = arguments.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    garments, avatars = sorted(args.assets.glob("garments/*/")), sorted(args.assets.glob("avatars/*/"))
    if not garments or not avatars:
        sys.exit(f"{args.assets}: there are no pairs in it")
    for folder in garments:
        write_glb(args.out / f"{folder.name}.glb", *files_of(folder, "mannequin.obj", "garment.obj"))
    for folder in avatars:
        write_glb(args.out / f"{folder.name}.glb", *files_of(folder, "avatar.obj", None))
    print(f"{'garment':16} {'avatar':14} {'seconds':>8} {'library':>8} {'beside':>8} {'of CPU':>8}  exit")
    worst = 0.0
    for garment in garments:
        for avatar in avatars:
            runs, report = [], args.out / "report.json"
            for _ in range(args.repeat):
                report.unlink(missing_ok=True)
                begin, before = time.perf_counter(), os.times()
                run = subprocess.run(
                    [args.program, "dress", args.out / f"{garment.name}.glb", args.out / f"{avatar.name}.glb", "-o",
                     args.out / f"{garment.name}-on-{avatar.name}.glb", "--nodes", "Garment", "--threads", "1", "-q",
                     "--json", report], stderr=subprocess.PIPE, text=True)
                seconds, after = time.perf_counter() - begin, os.times()
                share = (after.children_user + after.children_system - before.children_user - before.children_system) / seconds
                results = json.loads(report.read_text())["garments"] if report.is_file() else []
                own = sum(line["result"]["seconds"] for line in results if "result" in line)
                runs.append((seconds, own, seconds - own, (seconds - own) * share, run.returncode, run.stderr))
            seconds, own, beside, scaled = (statistics.median(run[k] for run in runs) for k in range(4))
            status = runs[-1][4]
            print(f"{garment.name:16} {avatar.name:14} {seconds:8.2f} {own:8.2f} {beside:8.2f} {scaled:8.2f}  {status}", flush=True)
            if status in (0, 3):
                worst = max(worst, scaled)
            if status != 0:
                print("    " + runs[-1][5].strip()[:300])
    print(f"at most {worst:.2f} s of CPU beside the library")


main()
