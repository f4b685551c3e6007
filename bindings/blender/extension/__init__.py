"""Bespoke in Blender: takes garments that were made for one character and puts them on another.

The library is in the wheel that comes with this extension, the package `bespoke`; all that is known of Blender is here:

    dials, preferences     what is asked for
    lists, joint_map       the choice of meshes and of joints that correspond
    shape_keys             those of the body that garments follow
    meshes, rigs, humanoid from objects and armatures to arrays
    work, turns            the fitting itself, in a thread; knows nothing of Blender
    results, findings      back: objects, and what is to be looked at
    dress, panel           the operator and the sidebar
    texts, troubleshooting what is said, from the package and its pages
"""

from . import dials, dress, findings, joint_map, lists, panel, preferences, shape_keys, troubleshooting

_MODULES = (preferences, dials, lists, shape_keys, joint_map, findings, troubleshooting, dress, panel)


def register() -> None:
    """Called by Blender where the extension is enabled."""
    for module in _MODULES:
        module.register()


def unregister() -> None:
    """Called by Blender where it is disabled; a run is stopped."""
    for module in reversed(_MODULES):
        module.unregister()
