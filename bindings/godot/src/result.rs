//! The result as the engine has it: a mesh, a skin, a node.

use glam::{DAffine3, DMat4};
use godot::builtin::{
    AnyArray, Array, PackedFloat32Array, PackedInt32Array, PackedVector3Array, StringName, VarArray, VarDictionary,
    Variant, Vector3,
};
use godot::classes::mesh::{ArrayFormat, ArrayType, BlendShapeMode, PrimitiveType};
use godot::classes::{ArrayMesh, Mesh, Node3D, Object, Resource};
use godot::obj::{EngineBitfield, EngineEnum, Gd, NewGd};

use crate::engine::{Node, make, transform};
use crate::figure::Figure;
use crate::job::Fitted;
use crate::mesh::Surface;
use crate::native::{BESPOKE_NO_JOINT, BespokeAddedJoint};
use crate::scene::Skeleton;

/// Bits of a format that go over: custom channels and dynamic updates. Not compression: it would round the vertices that are
/// verified.
const KEPT_FLAGS: u64 = (0xfff << 13) | (1 << 26);

/// Joints of the garment's own as bones: which are added behind those of the skeleton.
pub struct AddedBone {
    /// Its name, which no other bone has.
    pub name: String,
    /// The bone that moves it.
    pub parent: Option<usize>,
    /// Where it rests, in the space of the skeleton.
    pub place: DAffine3,
}

/// Names and places of `added`.
pub fn added_bones(added: &[BespokeAddedJoint], source: &Skeleton, target: &Skeleton) -> Vec<AddedBone> {
    let mut bones = Vec::<AddedBone>::new();
    for joint in added {
        let own = source.names.get(joint.source as usize).cloned().unwrap_or_default();
        let is_taken = |name: &str| target.find(name).is_some() || bones.iter().any(|bone| bone.name == name);
        let mut name = own.clone();
        let mut copy = 2;
        while is_taken(&name) {
            name = format!("{own}_{copy}");
            copy += 1;
        }
        bones.push(AddedBone {
            name,
            parent: (joint.parent != BESPOKE_NO_JOINT).then_some(joint.parent as usize),
            place: DAffine3::from_mat4(DMat4::from_cols_array(&joint.bind)),
        });
    }
    bones
}

fn packed(points: &[[f32; 3]]) -> PackedVector3Array {
    points.iter().map(|&[x, y, z]| Vector3::new(x, y, z)).collect()
}

/// The garment's mesh, with all that it had.
pub fn mesh(garment: &Figure, fitted: &Fitted) -> Gd<ArrayMesh> {
    let mut mesh = ArrayMesh::new_gd();
    let Some(part) = garment.parts.first() else { return mesh };
    let design = &part.arrays;
    mesh.set_name(&part.shown.mesh.get_name());
    mesh.set_lightmap_size_hint(part.shown.mesh.get_lightmap_size_hint());
    mesh.set_blend_shape_mode(if design.relative { BlendShapeMode::RELATIVE } else { BlendShapeMode::NORMALIZED });
    for shape in &fitted.shapes {
        mesh.add_blend_shape(&StringName::from(&shape.name));
    }
    let scale = size(&fitted.positions) / size(&design.positions).max(f32::MIN_POSITIVE);
    for (k, surface) in design.surfaces.iter().enumerate() {
        let rows = surface.first_vertex..surface.first_vertex + surface.vertices;
        let mut arrays = surface.arrays.duplicate_shallow();
        let mut put = |which: ArrayType, array: Variant| arrays.set(which.ord() as usize, &array);
        put(ArrayType::VERTEX, Variant::from(packed(&fitted.positions[rows.clone()])));
        if !fitted.normals.is_empty() {
            put(ArrayType::NORMAL, Variant::from(packed(&fitted.normals[rows.clone()])));
        }
        if !fitted.tangents.is_empty() {
            let tangents: PackedFloat32Array = fitted.tangents[rows.clone()].iter().flatten().copied().collect();
            put(ArrayType::TANGENT, Variant::from(tangents));
        }
        let mut flags = surface.format & KEPT_FLAGS;
        match &fitted.skin {
            Some(skin) => {
                let numbers = rows.start * skin.width..rows.end * skin.width;
                let joints: PackedInt32Array = skin.joints[numbers.clone()].iter().map(|&j| j as i32).collect();
                let weights: PackedFloat32Array = skin.weights[numbers].iter().copied().collect();
                put(ArrayType::BONES, Variant::from(joints));
                put(ArrayType::WEIGHTS, Variant::from(weights));
                if skin.width == 8 {
                    flags |= ArrayFormat::FLAG_USE_8_BONE_WEIGHTS.ord();
                }
            }
            None => {
                put(ArrayType::BONES, Variant::nil());
                put(ArrayType::WEIGHTS, Variant::nil());
            }
        }
        let shapes = shapes(surface, fitted, design.relative);
        mesh.add_surface_from_arrays_ex(PrimitiveType::TRIANGLES, &arrays)
            .blend_shapes(&shapes)
            .lods(&lods(surface, scale))
            .flags(ArrayFormat::from_ord(flags))
            .done();
        mesh.surface_set_name(k as i32, &surface.name);
        mesh.clone()
            .upcast::<Object>()
            .call("surface_set_material", &[Variant::from(k as i64), surface.material.clone()]);
    }
    copy_meta(&part.shown.mesh.clone().upcast::<Object>(), &mesh.clone().upcast::<Object>());
    mesh
}

/// Longest side of the bounding box.
fn size(points: &[[f32; 3]]) -> f32 {
    let side = |axis: usize| {
        let along = points.iter().map(|p| p[axis]);
        along.clone().fold(f32::MIN, f32::max) - along.fold(f32::MAX, f32::min)
    };
    side(0).max(side(1)).max(side(2))
}

/// The vertices keep their numbers, so the same indices draw the same detail; from which size on goes by the garment's.
fn lods(surface: &Surface, scale: f32) -> VarDictionary {
    let mut lods = VarDictionary::new();
    for (length, indices) in &surface.lods {
        lods.set(&Variant::from(length * scale), &Variant::from(indices.clone()));
    }
    lods
}

fn shapes(surface: &Surface, fitted: &Fitted, relative: bool) -> Array<AnyArray> {
    let rows = surface.first_vertex..surface.first_vertex + surface.vertices;
    let mut all = Array::<AnyArray>::new();
    for shape in &fitted.shapes {
        let base = &fitted.positions[rows.clone()];
        let moved = shape.offsets[rows.clone()].iter().zip(base);
        let vertices: Vec<[f32; 3]> =
            moved.map(|(d, p)| if relative { *d } else { std::array::from_fn(|axis| p[axis] + d[axis]) }).collect();
        let mut arrays = VarArray::new();
        arrays.resize(ArrayType::MAX.ord() as usize, &Variant::nil());
        arrays.set(ArrayType::VERTEX.ord() as usize, &Variant::from(packed(&vertices)));
        if !fitted.normals.is_empty() {
            // A shape whose surface kept no normals is drawn with those of the garment.
            let normals = if shape.normals.is_empty() { &fitted.normals } else { &shape.normals };
            let turned = normals[rows.clone()].iter().zip(&fitted.normals[rows.clone()]);
            let normals: Vec<[f32; 3]> = turned
                .map(|(n, b)| if relative { std::array::from_fn(|axis| n[axis] - b[axis]) } else { *n })
                .collect();
            arrays.set(ArrayType::NORMAL.ord() as usize, &Variant::from(packed(&normals)));
        }
        if !fitted.tangents.is_empty() {
            let tangents = if shape.tangents.is_empty() { &fitted.tangents } else { &shape.tangents };
            let turned = tangents[rows.clone()].iter().zip(&fitted.tangents[rows.clone()]);
            let numbers =
                turned.flat_map(|(t, b)| if relative { [t[0] - b[0], t[1] - b[1], t[2] - b[2], b[3]] } else { *t });
            let numbers: PackedFloat32Array = numbers.collect();
            arrays.set(ArrayType::TANGENT.ord() as usize, &Variant::from(numbers));
        }
        all.push(arrays.upcast_any_array());
    }
    all
}

/// The binds of the result: every bone of the skeleton where it rests, then those that are added.
pub fn skin(target: &Skeleton, added: &[AddedBone]) -> Option<Gd<Resource>> {
    let skin = make::<Resource>("Skin")?;
    let mut object = skin.clone().upcast::<Object>();
    let bones = target.names.iter().zip(&target.rests).chain(added.iter().map(|bone| (&bone.name, &bone.place)));
    for (name, place) in bones {
        let pose = Variant::from(transform(place.inverse()));
        object.call("add_named_bind", &[Variant::from(StringName::from(name)), pose]);
    }
    Some(skin)
}

/// A MeshInstance3D that shows the result as the design was shown, to be put under the skeleton.
pub fn instance(garment: &Figure, mesh: &Gd<ArrayMesh>, skin: Option<&Gd<Resource>>) -> Option<Gd<Node3D>> {
    let mut node = make::<Node3D>("MeshInstance3D")?;
    let design = garment.parts.first()?.shown.node.and_then(Node::get);
    let mut object = node.clone().upcast::<Object>();
    object.set("mesh", &Variant::from(mesh.clone().upcast::<Mesh>()));
    if let Some(skin) = skin {
        object.set("skin", &Variant::from(skin.clone()));
        object.set("skeleton", &Variant::from(godot::builtin::NodePath::from("..")));
    }
    let Some(design) = design else {
        node.set_name("Garment");
        return Some(node);
    };
    node.set_name(&design.get_name().to_string());
    let from = design.clone().upcast::<Object>();
    // All that says how it is drawn, and nothing that says where.
    let own = [
        "mesh",
        "skin",
        "skeleton",
        "script",
        "name",
        "owner",
        "multiplayer",
        "scene_file_path",
        "unique_name_in_owner",
    ];
    for property in from.get_property_list().iter_shared() {
        let name = property.get("name").map(|name| name.to_string()).unwrap_or_default();
        let usage: i64 = property.get("usage").and_then(|usage| usage.try_to().ok()).unwrap_or(0);
        let is_stored = usage & 2 != 0;
        let is_place = ["transform", "position", "rotation", "scale", "quaternion", "basis", "global_", "top_level"];
        if is_stored && !own.contains(&name.as_str()) && !is_place.iter().any(|begin| name.starts_with(begin)) {
            object.set(&StringName::from(&name), &from.get(&StringName::from(&name)));
        }
    }
    Some(node)
}

fn copy_meta(from: &Gd<Object>, to: &Gd<Object>) {
    let mut to = to.clone();
    for name in from.get_meta_list().iter_shared() {
        to.set_meta(&name, &from.get_meta(&name));
    }
}

/// Adds bones behind those of a Skeleton3D, where it has none of their names.
pub fn add_bones(skeleton: &Gd<Node3D>, target: &Skeleton, added: &[AddedBone]) {
    let mut object = skeleton.clone().upcast::<Object>();
    let find = |object: &mut Gd<Object>, name: &str| {
        object.call("find_bone", &[Variant::from(name)]).try_to::<i64>().unwrap_or(-1)
    };
    for bone in added {
        if find(&mut object, &bone.name) >= 0 {
            continue;
        }
        object.call("add_bone", &[Variant::from(bone.name.as_str())]);
        let index = find(&mut object, &bone.name);
        let above = bone.parent.and_then(|parent| {
            let own = parent.checked_sub(target.names.len()).and_then(|own| added.get(own));
            let name = own.map(|own| own.name.clone()).or_else(|| target.names.get(parent).cloned())?;
            let place = own.map(|own| own.place).or_else(|| target.rests.get(parent).copied())?;
            Some((name, place))
        });
        let mut rest = bone.place;
        if let Some((name, place)) = above {
            let parent = find(&mut object, &name);
            object.call("set_bone_parent", &[Variant::from(index), Variant::from(parent)]);
            rest = place.inverse() * bone.place;
        }
        let index = Variant::from(index);
        object.call("set_bone_rest", &[index.clone(), Variant::from(transform(rest))]);
        object.call("reset_bone_pose", &[index]);
    }
}

/// Gives a garment that answers blend shapes of the avatar the values that these have now.
pub fn take_answers(instance: &Gd<Node3D>, avatar: &Figure) {
    for shape in &avatar.answered {
        let name = StringName::from(&format!("blend_shapes/{}", shape.name));
        let nodes = avatar.parts.iter().filter(|part| part.arrays.shapes.iter().any(|own| own.name == shape.name));
        if let Some(node) = nodes.filter_map(|part| part.shown.node?.get()).next() {
            instance.clone().upcast::<Object>().set(&name, &node.get(&name));
        }
    }
}
