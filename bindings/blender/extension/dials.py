"""What a scene keeps of Bespoke: who is dressed in what, and how it is to fit."""

from __future__ import annotations

from typing import Any

import bespoke
import bpy

from . import shape_keys, texts

# The dials of the panel, as they are called in all programs of Bespoke, and the options that they are.
MAIN = {"fit": "fit_weight", "looseness": "designed_clearance", "offset": "offset"}
# What the preferences have.
_ELSEWHERE = ("threads", "memory_limit")


def _is_mesh(_self: Any, thing: bpy.types.Object) -> bool:
    return thing.type == "MESH"


def _is_armature(_self: Any, thing: bpy.types.Object) -> bool:
    return thing.type == "ARMATURE"


def armature_of(thing: bpy.types.Object) -> bpy.types.Object | None:
    """The armature that moves a mesh, by a modifier or as its parent."""
    for modifier in thing.modifiers:
        if modifier.type == "ARMATURE" and modifier.object is not None:
            return modifier.object
    return thing.parent if thing.parent is not None and thing.parent.type == "ARMATURE" else None


class BespokeMesh(bpy.types.PropertyGroup):
    """A mesh in one of the lists."""

    object: bpy.props.PointerProperty(name="Mesh", type=bpy.types.Object, poll=_is_mesh)
    role: bpy.props.EnumProperty(
        name="Role",
        description="What the mesh is to the garments",
        items=texts.described(bespoke.PartRole),
    )
    fit_group: bpy.props.StringProperty(
        name="Fit Group",
        description="A vertex group of the garment: how strongly it is drawn to the body there. Without: 1 everywhere",
    )
    pin_group: bpy.props.StringProperty(
        name="Pin Group", description="A vertex group of the garment that keeps its place on the nearest bone"
    )
    rigid_group: bpy.props.StringProperty(
        name="Rigid Group",
        description="A vertex group of buttons, buckles or plates: each connected piece of it keeps its shape",
    )
    follows: bpy.props.PointerProperty(
        name="Follows",
        description="The garment that it goes along with. Without: the nearest one",
        type=bpy.types.Object,
        poll=_is_mesh,
    )


def _fill(scene: bpy.types.Scene, armature: bpy.types.Object | None, bodies: Any) -> None:
    """Where nothing is chosen yet, all meshes that an armature bends, and that can be seen, are its body. What only
    hangs on a bone may be a prop. Meshes of another armature, which was chosen before, go."""
    if armature is None:
        return
    for k in reversed(range(len(bodies))):
        if bodies[k].object is not None and armature_of(bodies[k].object) not in (None, armature):
            bodies.remove(k)
    if any(item.object for item in bodies):
        return
    bodies.clear()
    worn = {item.object for item in (*scene.bespoke.garments, *scene.bespoke.followers)}
    for thing in scene.objects:
        if thing.type != "MESH" or thing in worn or "bespoke_garment" in thing or not thing.visible_get():
            continue
        if armature_of(thing) == armature and thing.parent_type != "BONE":
            bodies.add().object = thing


def _source_chosen(self: Any, context: bpy.types.Context) -> None:
    self.joints.clear()
    _fill(context.scene, self.source, self.source_bodies)


def _target_chosen(self: Any, context: bpy.types.Context) -> None:
    self.joints.clear()
    _fill(context.scene, self.target, self.target_bodies)
    there = shape_keys.names(shape_keys.bodies(context.scene))
    for k in reversed(range(len(self.followed_keys))):
        if self.followed_keys[k].name not in there:
            self.followed_keys.remove(k)


def _mended(self: Any, _context: bpy.types.Context) -> None:
    self.is_mended = True


class BespokeJoint(bpy.types.PropertyGroup):
    """A bone of the source, which is its name, and the one of the target that corresponds to it."""

    target: bpy.props.StringProperty(
        name="Target Bone",
        description="The bone of the target that corresponds; empty: none does. What is chosen here wins over names",
        update=_mended,
    )
    is_mended: bpy.props.BoolProperty(name="As Chosen", description="Keep what is chosen here; off: find it out again")
    reason: bpy.props.StringProperty()
    reason_comment: bpy.props.StringProperty()
    confidence: bpy.props.FloatProperty(name="Confidence", description="From 0, a guess, to 1, sure")
    part: bpy.props.StringProperty()


class BespokeShapeKey(bpy.types.PropertyGroup):
    """A shape key of the body to dress, which is its name."""


class BespokePlace(bpy.types.PropertyGroup):
    """Vertices of an object, in the custom property "vertices"."""

    object: bpy.props.PointerProperty(type=bpy.types.Object)


class BespokeDiagnostic(bpy.types.PropertyGroup):
    """Something that the library has to say."""

    severity: bpy.props.EnumProperty(items=texts.described(bespoke.Severity))
    kind: bpy.props.StringProperty()
    garment: bpy.props.StringProperty()
    message: bpy.props.StringProperty()
    anchor: bpy.props.StringProperty(description="Of docs/troubleshooting.md")
    count: bpy.props.IntProperty(default=1)
    places: bpy.props.CollectionProperty(type=BespokePlace)


def _option(name: str, option: texts.Option) -> Any:
    """The property for an option of the library, under a name."""
    about = {"name": texts.label(name), "description": texts.description(option.comment)}
    if option.name == "surface_form":
        return bpy.props.EnumProperty(items=texts.described(bespoke.SurfaceForm), **about)
    if isinstance(option.default, bool):
        return bpy.props.BoolProperty(default=option.default, **about)
    if isinstance(option.default, int):
        return bpy.props.IntProperty(default=option.default, min=0, **about)
    if option.name == "offset":
        about["subtype"] = "DISTANCE"
    digits = 6 if option.default and option.default < 0.001 else 4 if option.default and option.default < 0.01 else 3
    return bpy.props.FloatProperty(default=option.default, min=0.0, precision=digits, **about)


class BespokeScene(bpy.types.PropertyGroup):
    """`scene.bespoke`."""

    garments: bpy.props.CollectionProperty(type=BespokeMesh)
    garment_index: bpy.props.IntProperty()
    followers: bpy.props.CollectionProperty(type=BespokeMesh)
    follower_index: bpy.props.IntProperty()
    source: bpy.props.PointerProperty(
        name="Armature",
        description="The armature of the character that the garments were made for",
        type=bpy.types.Object,
        poll=_is_armature,
        update=_source_chosen,
    )
    source_bodies: bpy.props.CollectionProperty(type=BespokeMesh)
    source_body_index: bpy.props.IntProperty()
    target: bpy.props.PointerProperty(
        name="Armature",
        description="The armature of the character to dress",
        type=bpy.types.Object,
        poll=_is_armature,
        update=_target_chosen,
    )
    target_bodies: bpy.props.CollectionProperty(type=BespokeMesh)
    target_body_index: bpy.props.IntProperty()
    followed_keys: bpy.props.CollectionProperty(type=BespokeShapeKey)
    joints: bpy.props.CollectionProperty(type=BespokeJoint)
    joint_index: bpy.props.IntProperty()
    findings: bpy.props.CollectionProperty(type=BespokeDiagnostic)
    finding_index: bpy.props.IntProperty()
    add_bones: bpy.props.BoolProperty(
        name="Bring Own Bones",
        description="Bones of the garment's own, such as those of a skirt or a cape, are added to the armature of the "
        "character that is dressed. Off: what they move goes with the body beneath",
        default=True,
    )
    mask_covered: bpy.props.BoolProperty(
        name="Mask Covered Skin",
        description="Give the body a vertex group and a mask modifier for what nobody sees under the garments",
    )
    keep_results: bpy.props.BoolProperty(
        name="Keep Earlier Results",
        description="Leave earlier results of the same garment on the same character, instead of replacing them",
    )


def _settings() -> dict[str, Any]:
    dials = {option: dial for dial, option in MAIN.items()}
    called = {dials.get(name, name): option for name, option in texts.options().items() if name not in _ELSEWHERE}
    return {name: _option(name, option) for name, option in called.items()}


def names(is_expert: bool) -> list[str]:
    """The options beside the main ones."""
    main = (*MAIN.values(), *_ELSEWHERE)
    return [o.name for o in texts.options().values() if o.is_expert == is_expert and o.name not in main]


def chosen(scene: bpy.types.Scene) -> dict[str, Any]:
    """What differs from the defaults, as arguments of `bespoke.Options`."""
    dials = {option: dial for dial, option in MAIN.items()}
    found = {}
    for name, option in texts.options().items():
        if name in _ELSEWHERE:
            continue
        value = getattr(scene.bespoke, dials.get(name, name))
        if isinstance(value, float):
            # Blender keeps 32 bits; what was typed is the shortest number that gives these.
            value = float(f"{value:.7g}")
        if name == "surface_form":
            value = bespoke.SurfaceForm[value]
        if value != option.default:
            found[name] = value
    return found


_CLASSES = (BespokeMesh, BespokeJoint, BespokeShapeKey, BespokePlace, BespokeDiagnostic, BespokeScene)


def register() -> None:
    """With `scene.bespoke`."""
    for name, setting in _settings().items():
        BespokeScene.__annotations__[name] = setting
    for each in _CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.bespoke = bpy.props.PointerProperty(type=BespokeScene)


def unregister() -> None:
    """Without."""
    del bpy.types.Scene.bespoke
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
