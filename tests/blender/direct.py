"""The same by the package alone, for comparison."""

from __future__ import annotations

import bpy
import numpy as np

import bespoke
from case import joints, stored, triangles, weights


def directly(garment: bpy.types.Object, source: str, body: bpy.types.Object, target: str) -> bespoke.Session:
    """The same by the package, of objects that have no transforms and no modifiers but armatures."""
    objects = bpy.data.objects
    session = bespoke.Session()
    session.set_source_coordinate_system(
        bespoke.CoordinateSystem(up=bespoke.Axis.POSITIVE_Z, forward=bespoke.Axis.POSITIVE_Y, trusted=True)
    )
    session.set_target_coordinate_system(bespoke.CoordinateSystem.BLENDER)
    session.set_garment(stored(garment.data), triangles(garment.data))
    rigs = objects[f"{source} rig" if source else "rig"], objects[target]
    session.set_source_rig(joints(rigs[0]))
    session.set_target_rig(joints(rigs[1]))

    def skin(thing: bpy.types.Object, rig: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, int]:
        rows = weights(thing, rig).T
        order = np.broadcast_to(np.arange(rows.shape[1], dtype=np.uint32), rows.shape)
        return order, rows.astype(np.float32), rows.shape[1]

    own = objects[source or "arm"]
    session.set_source_avatar(stored(own.data).astype(float), triangles(own.data))
    session.set_source_skin_influences(*skin(own, rigs[0]))
    session.set_garment_skin_influences(*skin(garment, rigs[0]))
    session.set_target_avatar(stored(body.data).astype(float), triangles(body.data))
    session.set_target_skin_influences(*skin(body, rigs[1]))
    return session
