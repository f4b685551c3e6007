//! Characters and garments as OBJ files, with skeleton and skin weights in files beside them.
//!
//! Such a file is read as the glTF file that it would be, so that all else goes one way.

mod file;
mod joints;
mod materials;
mod write;

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use bespoke::input::coordinate_system::{Axis, CoordinateSystem};
use bespoke::input::skeleton::Skeleton;
use bespoke_gltf::{Document, Edit, Form, nothing_outside};
use glam::{DMat4, DVec3};
use serde_json::json;

pub use file::{Corner, ObjFile};
pub use joints::{Joints, Rows};
pub use write::write;

use self::materials::Materials;
use crate::failure::{Failure, Result};
use crate::figure::Part;
use crate::parts::Role;

/// Files beside an OBJ file; those that are not named are looked for by their names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Beside {
    /// Skeleton or rig.
    pub skeleton: Option<PathBuf>,
    /// Skin weights.
    pub skin: Option<PathBuf>,
    /// Axes and unit, as [`space`] reads them.
    pub space: Option<String>,
}

/// What is known of a figure that was an OBJ file.
pub struct Source {
    /// The file.
    pub file: ObjFile,
    /// For each primitive of each mesh, in order, the corner that each of its vertices is.
    pub corners: HashMap<[usize; 2], Vec<Corner>>,
    /// Which piece of the file each primitive of each mesh is.
    pieces: HashMap<[usize; 2], usize>,
    /// Its coordinate system.
    pub space: CoordinateSystem,
    /// Its joints where they have no names.
    pub skeleton: Option<Skeleton>,
    /// Whether it has skin weights.
    pub has_skin: bool,
    /// Names of nodes that were put on by this program.
    pub worn: Vec<String>,
    /// What was taken, in words.
    pub notes: Vec<String>,
    /// What of its materials could not be had, in words.
    pub material_notes: Vec<String>,
}

impl Source {
    /// Which piece of the file a part is.
    fn piece(&self, part: &Part) -> usize {
        self.pieces[&[part.mesh, part.primitive.index]]
    }
}

/// Whether a file is one by its name.
pub fn is_obj(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"))
}

/// Reads axes and unit: the axes that point right, up and forward, metres a unit where that is not 1, and `trusted` where nothing is
/// to be turned or refused for them, between commas.
///
/// # Errors
/// A sentence.
pub fn space(text: &str) -> Result<CoordinateSystem, String> {
    let wrong = || {
        format!("'{text}' are no axes; needed are those that point right, up and forward, such as x,y,-z or y,z,x,0.01")
    };
    let mut words = text.split(',').map(str::trim);
    let mut axis = || match words.next()? {
        "x" | "+x" => Some(Axis::PositiveX),
        "-x" => Some(Axis::NegativeX),
        "y" | "+y" => Some(Axis::PositiveY),
        "-y" => Some(Axis::NegativeY),
        "z" | "+z" => Some(Axis::PositiveZ),
        "-z" => Some(Axis::NegativeZ),
        _ => None,
    };
    let [right, up, forward] = [axis(), axis(), axis()].map(|axis| axis.ok_or_else(wrong));
    let mut space = CoordinateSystem { right: right?, up: up?, forward: forward?, ..CoordinateSystem::default() };
    for word in words {
        match word.parse::<f64>() {
            Ok(unit) => space.metres_per_unit = unit,
            Err(_) if word == "trusted" => space.trusted = true,
            Err(_) => return Err(wrong()),
        }
    }
    space.check("axes").map_err(|e| e.message)?;
    Ok(space)
}

/// Of the files beside `path` that are named as it with an ending, or plainly, the first that is there.
fn neighbour(path: &Path, ending: &str, plain: &[&str]) -> Option<PathBuf> {
    let own = path.with_extension(ending);
    let plain = plain.iter().map(|name| path.with_file_name(name));
    std::iter::once(own).chain(plain).find(|file| file != path && file.is_file())
}

/// The files that were not named and will be taken, for those who have to know whether one has changed.
pub fn neighbours(path: &Path) -> Vec<PathBuf> {
    let skeleton = neighbour(path, "skeleton.obj", &["skeleton.obj"]);
    let skin = neighbour(path, "skin.txt", &["skin.txt"]);
    if is_obj(path) { skeleton.into_iter().chain(skin).collect() } else { Vec::new() }
}

/// Reads an OBJ file with what is beside it, as the glTF file that it would be.
///
/// # Errors
/// With file and line.
pub fn open(path: &Path, role: Role, beside: &Beside) -> Result<(Document, Source, Option<Joints>)> {
    let space = match &beside.space {
        Some(text) => space(text).map_err(Failure::usage)?,
        None => CoordinateSystem::default(),
    };
    let file = ObjFile::open(path)?;
    if file.faces.is_empty() {
        return Err(Failure::no_result(format!("{}: there are no faces in it", path.display())));
    }
    let mut notes = Vec::new();
    let mut taken = |named: &Option<PathBuf>, found: Option<PathBuf>, what: &str| {
        if named.is_none()
            && let Some(found) = &found
        {
            notes.push(format!("{}: {what} from {}", path.display(), found.display()));
        }
        named.clone().or(found)
    };
    let skeleton = neighbour(path, "skeleton.obj", &["skeleton.obj"]);
    let joints = taken(&beside.skeleton, skeleton, "skeleton").map(|file| Joints::open(&file, &space)).transpose()?;
    let rows = match &joints {
        Some(joints) => {
            // The plain name is the body's.
            let plain: &[&str] = if role == Role::Avatar { &["skin.txt"] } else { &[] };
            let skin = neighbour(path, "skin.txt", plain);
            let skin = taken(&beside.skin, skin, "skin weights");
            let count = (joints.rig().joints.len(), file.positions.len());
            skin.map(|skin| joints::skin(&skin, count.0, count.1)).transpose()?
        }
        None if beside.skin.is_some() => {
            return Err(Failure::usage(format!(
                "{}: skin weights are given and no skeleton; name that too, or put it beside the file as skeleton.obj",
                path.display()
            )));
        }
        None => None,
    };
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let fail = |e: bespoke_gltf::Error| Failure::no_result(e.in_file(path.display().to_string()).to_string());
    let empty = br#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]}"#;
    let document = Document::from_bytes(empty.to_vec(), nothing_outside()).map_err(fail)?;
    let mut source = Source {
        file,
        corners: HashMap::new(),
        pieces: HashMap::new(),
        space,
        skeleton: match &joints {
            Some(Joints::Skeleton(skeleton)) => Some(skeleton.clone()),
            _ => None,
        },
        has_skin: rows.is_some(),
        worn: Vec::new(),
        notes,
        material_notes: Vec::new(),
    };
    let mut materials = Materials::of(path, &source.file.text);
    let mut edit = Edit::new(&document, Form::Glb).map_err(fail)?;
    fill(&mut edit, &mut source, joints.as_ref(), rows.as_ref(), &mut materials, &stem).map_err(fail)?;
    source.material_notes = materials.notes;
    let glb = edit.output(&stem).map_err(fail)?.file;
    let document = Document::from_bytes(glb, nothing_outside()).map_err(fail)?;
    Ok((document, source, joints))
}

/// Joint k becomes node k.
fn fill(
    edit: &mut Edit,
    source: &mut Source,
    joints: Option<&Joints>,
    rows: Option<&Rows>,
    materials: &mut Materials,
    stem: &str,
) -> bespoke_gltf::Result<()> {
    let rig = joints.map(Joints::rig).unwrap_or_default();
    for (k, joint) in rig.joints.iter().enumerate() {
        let above = joint.parent.map_or(DMat4::IDENTITY, |parent| rig.joints[parent as usize].bind);
        let name = if joint.name.is_empty() { format!("joint_{k}") } else { joint.name.clone() };
        let mut node = json!({ "name": name, "matrix": (above.inverse() * joint.bind).to_cols_array() });
        let below: Vec<usize> =
            (0..rig.joints.len()).filter(|&other| rig.joints[other].parent == Some(k as u32)).collect();
        if !below.is_empty() {
            node["children"] = below.into();
        }
        edit.push("nodes", node)?;
    }
    for (k, joint) in rig.joints.iter().enumerate() {
        if joint.parent.is_none()
            && let Some(roots) = edit.json_mut().pointer_mut("/scenes/0/nodes").and_then(|nodes| nodes.as_array_mut())
        {
            roots.push(k.into());
        }
    }
    let inverse: Vec<_> = rig.joints.iter().map(|joint| joint.bind.inverse().to_cols_array_2d()).collect();
    let places: Vec<usize> = (0..inverse.len()).collect();
    let skin = if inverse.is_empty() { None } else { Some(edit.add_skin("skeleton", &places, &inverse)?) };

    // Objects in their order, and in them materials in theirs.
    let mut objects: Vec<(&str, Vec<usize>)> = Vec::new();
    for (piece, known) in source.file.pieces.iter().enumerate() {
        match objects.iter_mut().find(|(name, _)| *name == known.object) {
            Some((_, pieces)) => pieces.push(piece),
            None => objects.push((&known.object, vec![piece])),
        }
    }
    let mut written: BTreeMap<&str, usize> = BTreeMap::new();
    for (mesh, (object, pieces)) in objects.iter().enumerate() {
        let mut primitives = Vec::new();
        for (primitive, &piece) in pieces.iter().enumerate() {
            let (mut new, mut corners, mut triangles) = (HashMap::new(), Vec::new(), Vec::new());
            for face in source.file.faces.iter().filter(|face| face.piece == piece) {
                let own = |corner: &Corner| {
                    *new.entry(*corner).or_insert_with(|| {
                        corners.push(*corner);
                        corners.len() as u32 - 1
                    })
                };
                let fan: Vec<u32> = face.corners.iter().map(own).collect();
                triangles.extend(fan[1..].windows(2).map(|pair| [fan[0], pair[0], pair[1]]));
            }
            let mut attributes = attributes(edit, source, &corners)?;
            if skin.is_some() {
                // Without weights, any put the mesh on its joints; they are left out where they are read.
                let any = vec![(0, 1.0)];
                let row = |&(v, ..): &Corner| rows.map_or_else(|| any.clone(), |rows| rows[v as usize].clone());
                let rows: Rows = corners.iter().map(row).collect();
                for (set, (joints, weights)) in edit.add_influences(&rows)?.into_iter().enumerate() {
                    attributes[format!("JOINTS_{set}")] = joints.into();
                    attributes[format!("WEIGHTS_{set}")] = weights.into();
                }
            }
            let mut entry = json!({ "attributes": attributes, "indices": edit.add_triangles(&triangles)? });
            let name = source.file.pieces[piece].material.as_str();
            if !name.is_empty() {
                let material = match written.get(name) {
                    Some(&known) => known,
                    None => {
                        let material = materials.entry(edit, name)?;
                        edit.push("materials", material)?
                    }
                };
                written.insert(name, material);
                entry["material"] = material.into();
            }
            primitives.push(entry);
            source.corners.insert([mesh, primitive], corners);
            source.pieces.insert([mesh, primitive], piece);
        }
        let name = if object.is_empty() { stem } else { object };
        if pieces.iter().any(|&piece| source.file.pieces[piece].is_worn) {
            source.worn.push(name.to_string());
        }
        edit.push("meshes", json!({ "name": name, "primitives": primitives }))?;
        edit.add_node(name, mesh, skin, None)?;
    }
    Ok(())
}

/// Positions, and texture coordinates and normals where all corners have them.
fn attributes(edit: &mut Edit, source: &Source, corners: &[Corner]) -> bespoke_gltf::Result<serde_json::Value> {
    let wide = |row: [f32; 3]| DVec3::from_array(row.map(f64::from));
    let place = |&(v, ..): &Corner| source.space.position_to_internal(wide(source.file.positions[v as usize]));
    let positions: Vec<[f64; 3]> = corners.iter().map(|corner| place(corner).to_array()).collect();
    let mut attributes = json!({ "POSITION": edit.add_positions(&positions)? });
    // Below the origin of glTF's, which is at the upper left.
    let texture = |&(_, vt, _): &Corner| {
        let [u, v] = source.file.texture[vt? as usize];
        Some([f64::from(u), 1.0 - f64::from(v)])
    };
    if let Some(texture) = corners.iter().map(texture).collect::<Option<Vec<_>>>() {
        attributes["TEXCOORD_0"] = edit.add_attribute(&texture)?.into();
    }
    let turned = |&(.., vn): &Corner| {
        let turned = source.space.position_to_internal(wide(source.file.normals[vn? as usize])).normalize_or_zero();
        (turned != DVec3::ZERO).then(|| turned.to_array())
    };
    if let Some(normals) = corners.iter().map(turned).collect::<Option<Vec<_>>>() {
        attributes["NORMAL"] = edit.add_attribute(&normals)?.into();
    }
    Ok(attributes)
}
