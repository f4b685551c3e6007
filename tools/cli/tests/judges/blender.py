"""Reads a file as Blender does, and says where the vertices are at times of its animation.

blender.py FILE TIME...: prints a line of JSON with, for each time and mesh, the node's name and its positions in the file's space.
"""

import json
import sys

import bpy

file, *times = sys.argv[1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=file)
scene = bpy.context.scene
# The importer shows bones by a shape of its own, which is in no file.
shapes = {bone.custom_shape for armature in bpy.data.objects if armature.pose for bone in armature.pose.bones}
meshes = [found for found in scene.objects if found.type == "MESH" and found not in shapes]
moments = []
for time in map(float, times):
    frame = time * scene.render.fps / scene.render.fps_base
    scene.frame_set(int(frame), subframe=frame - int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    entries = []
    for found in meshes:
        posed = found.evaluated_get(graph)
        places = [posed.matrix_world @ vertex.co for vertex in posed.data.vertices]
        # Blender's z is up, and its y goes back.
        entries.append({"node": found.name, "positions": [[x, z, -y] for x, y, z in places]})
    moments.append({"time": time, "meshes": entries})
print(json.dumps({"moments": moments}), flush=True)
