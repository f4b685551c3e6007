//! Reads rigged characters from GLB files into plain data: one list of joints, and every mesh in its bind pose on it.
//!
//! A file may hold one skin a mesh over the same nodes, each with inverse bind matrices of its own, a scale of 100 at a
//! node, a rest pose that is not the bind pose, and hats and axes that hang on a joint without weights. All of that is
//! resolved here, so that joints and vertices are in one space: the scene's, in the pose in which the meshes were bound.

use std::collections::HashMap;
use std::path::Path;

use glam::{DAffine3, DMat4, DVec3};
use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, Skin};

/// How far two transforms may differ that are meant to be one: files hold 32-bit numbers.
const TOLERANCE: f64 = 1e-3;

/// A joint: a node of a skin, or one below such a node, as the ends of chains are.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Of the node; empty where it has none.
    pub name: String,
    /// Index of the nearest node above that is a joint too; it comes before this one.
    pub parent: Option<usize>,
    /// From the joint's own space to the scene's, in the bind pose.
    pub bind: DAffine3,
    /// The same in the pose in which the file's nodes stand.
    pub rest: DAffine3,
}

impl Joint {
    /// From where the joint's own things stand in the rest pose to where they do in the bind pose.
    fn to_bind(&self) -> Result<DAffine3, String> {
        let inverse = self.rest.inverse();
        let extent = || format!("joint '{}': a scale of 0 above what is not in its skin", self.name);
        inverse.is_finite().then(|| self.bind * inverse).ok_or_else(extent)
    }
}

/// A mesh as it stands in the bind pose.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Name of its node; empty where it has none.
    pub node: String,
    /// Names of its materials, one for each of its primitives; empty where one has none.
    pub materials: Vec<String>,
    /// Positions in the scene's space.
    pub positions: Vec<DVec3>,
    /// Three vertex indices a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle, its index in `materials`.
    pub triangle_materials: Vec<usize>,
    /// For each vertex, joints (of the character's list) with weights that sum to 1; empty for a mesh that hangs on no
    /// joint.
    pub influences: Vec<Vec<(usize, f64)>>,
}

/// All of a file's scene.
#[derive(Clone, Debug, Default)]
pub struct Character {
    /// Parents before their children.
    pub joints: Vec<Joint>,
    /// One for each node that has a mesh.
    pub meshes: Vec<Mesh>,
}

impl Character {
    /// One mesh of all triangles whose node and material are `wanted`, with the vertices that they use.
    pub fn part(&self, wanted: impl Fn(&str, &str) -> bool) -> Mesh {
        let mut part = Mesh::default();
        for mesh in &self.meshes {
            let first_material = part.materials.len();
            part.materials.extend_from_slice(&mesh.materials);
            let mut new = vec![None; mesh.positions.len()];
            for (triangle, &material) in mesh.triangles.iter().zip(&mesh.triangle_materials) {
                if !wanted(&mesh.node, &mesh.materials[material]) {
                    continue;
                }
                part.triangles.push(triangle.map(|v| {
                    let v = v as usize;
                    *new[v].get_or_insert_with(|| {
                        part.positions.push(mesh.positions[v]);
                        part.influences.push(mesh.influences[v].clone());
                        index(part.positions.len() - 1)
                    })
                }));
                part.triangle_materials.push(first_material + material);
            }
        }
        part
    }

    /// The positions of a mesh in another pose, from the joints' transforms in it: linear blend skinning. Vertices without
    /// influences stay.
    pub fn posed(&self, mesh: &Mesh, joints: &[DAffine3]) -> Vec<DVec3> {
        let moves: Vec<DAffine3> =
            self.joints.iter().zip(joints).map(|(joint, &to)| to * joint.bind.inverse()).collect();
        let vertex = |(&p, influences): (&DVec3, &Vec<(usize, f64)>)| match influences.as_slice() {
            [] => p,
            influences => influences.iter().map(|&(joint, weight)| weight * moves[joint].transform_point3(p)).sum(),
        };
        mesh.positions.iter().zip(&mesh.influences).map(vertex).collect()
    }
}

/// Reads a file, whose buffer it has to contain.
pub fn read(path: &Path) -> Character {
    let file = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    parse(&file).unwrap_or_else(|message| panic!("{}: {message}", path.display()))
}

/// Reads the bytes of a GLB file.
pub fn parse(file: &[u8]) -> Result<Character, String> {
    let Gltf { document, blob } = Gltf::from_slice(file).map_err(|e| e.to_string())?;
    let scene = Scene::of(&document, blob.as_deref().ok_or("the file has no binary chunk")?)?;
    let meshes = scene.order.iter().filter_map(|node| Some(scene.mesh(node, node.mesh()?)));
    Ok(Character { meshes: meshes.collect::<Result<_, _>>()?, joints: scene.joints })
}

/// What the meshes are read with.
struct Scene<'a> {
    blob: &'a [u8],
    /// The nodes, parents before their children.
    order: Vec<Node<'a>>,
    /// For each node of the file (also those below), its transform to the scene in the rest pose.
    rest: Vec<DAffine3>,
    /// The joint at or nearest above a node.
    joint_at: Vec<Option<usize>>,
    joints: Vec<Joint>,
    /// For each skin the inverse bind matrices of its joints.
    inverse_binds: Vec<Vec<DAffine3>>,
}

impl<'a> Scene<'a> {
    fn of(document: &'a Document, blob: &'a [u8]) -> Result<Self, String> {
        let scene = document.default_scene().or_else(|| document.scenes().next()).ok_or("the file has no scene")?;
        let count = document.nodes().count();
        let (mut order, mut rest, mut above) = (Vec::new(), vec![DAffine3::IDENTITY; count], vec![None; count]);
        let mut open: Vec<Node> = scene.nodes().collect();
        open.reverse();
        while let Some(node) = open.pop() {
            let parent: Option<usize> = above[node.index()];
            let local = affine(node.transform().matrix());
            rest[node.index()] = parent.map_or(DAffine3::IDENTITY, |parent| rest[parent]) * local;
            let children: Vec<Node> = node.children().collect();
            for child in children.into_iter().rev() {
                above[child.index()] = Some(node.index());
                open.push(child);
            }
            order.push(node);
        }
        let inverse_binds: Vec<Vec<DAffine3>> = document.skins().map(|skin| inverse_binds(&skin, blob)).collect();
        let binds = binds(document, &rest, &inverse_binds)?;

        let mut scene = Self { blob, order, rest, joint_at: vec![None; count], joints: Vec::new(), inverse_binds };
        for node in &scene.order {
            let parent = above[node.index()].and_then(|parent: usize| scene.joint_at[parent]);
            let is_end = || parent.is_some() && node.mesh().is_none();
            let bind = match (binds.get(&node.index()), parent) {
                (Some(bind), _) => *bind,
                (None, Some(parent)) if is_end() => {
                    let parent: &Joint = &scene.joints[parent];
                    parent.to_bind()? * scene.rest[node.index()]
                }
                _ => {
                    scene.joint_at[node.index()] = parent;
                    continue;
                }
            };
            let name = node.name().unwrap_or_default().to_owned();
            scene.joint_at[node.index()] = Some(scene.joints.len());
            scene.joints.push(Joint { name, parent, bind, rest: scene.rest[node.index()] });
        }
        Ok(scene)
    }

    /// The mesh of a node.
    fn mesh(&self, node: &Node, mesh: gltf::Mesh) -> Result<Mesh, String> {
        let mut read = Mesh { node: node.name().unwrap_or_default().to_owned(), ..Mesh::default() };
        for primitive in mesh.primitives() {
            let name = || format!("node '{}', primitive {}", read.node, primitive.index());
            let reader = primitive.reader(|_| Some(self.blob));
            let positions = reader.read_positions().ok_or_else(|| format!("{}: no positions", name()))?;
            let positions: Vec<DVec3> = positions.map(|p| DVec3::from_array(p.map(f64::from))).collect();
            let influences = match node.skin() {
                Some(skin) => self.influences(&primitive, &skin).map_err(|e| format!("{}: {e}", name()))?,
                None => {
                    vec![self.joint_at[node.index()].into_iter().map(|joint| (joint, 1.0)).collect(); positions.len()]
                }
            };
            if influences.len() != positions.len() {
                return Err(format!("{}: {} positions, weights for {}", name(), positions.len(), influences.len()));
            }
            // To the bind pose: for each joint of the list.
            let moves: HashMap<usize, DAffine3> = match (node.skin(), self.joint_at[node.index()]) {
                (Some(skin), _) => {
                    let binds = skin.joints().zip(&self.inverse_binds[skin.index()]);
                    let joint = |(node, inverse): (Node, &DAffine3)| {
                        let joint = self.joint_at[node.index()]?;
                        Some((joint, self.joints[joint].bind * *inverse))
                    };
                    binds.filter_map(joint).collect()
                }
                (None, Some(joint)) => {
                    HashMap::from([(joint, self.joints[joint].to_bind()? * self.rest[node.index()])])
                }
                (None, None) => HashMap::new(),
            };
            let first = index(read.positions.len());
            read.positions.extend(positions.iter().zip(&influences).map(
                |(&p, influences)| match influences.as_slice() {
                    [] => self.rest[node.index()].transform_point3(p),
                    some => some.iter().map(|&(joint, weight)| weight * moves[&joint].transform_point3(p)).sum(),
                },
            ));
            read.influences.extend(influences);

            let corners: Vec<u32> = match reader.read_indices() {
                Some(corners) => corners.into_u32().collect(),
                None => (0..index(positions.len())).collect(),
            };
            let mirrored = moves.values().next().unwrap_or(&self.rest[node.index()]).matrix3.determinant() < 0.0;
            for [a, b, c] in triangles(&corners, primitive.mode()) {
                let triangle = if mirrored { [a, c, b] } else { [a, b, c] };
                read.triangles.push(triangle.map(|v| first + v));
                read.triangle_materials.push(read.materials.len());
            }
            read.materials.push(primitive.material().name().unwrap_or_default().to_owned());
        }
        Ok(read)
    }

    /// The weights of a skinned primitive, on the common list of joints.
    fn influences(&self, primitive: &Primitive, skin: &Skin) -> Result<Vec<Vec<(usize, f64)>>, String> {
        let reader = primitive.reader(|_| Some(self.blob));
        let nodes: Vec<usize> = skin.joints().map(|node| node.index()).collect();
        let mut all: Vec<Vec<(usize, f64)>> = Vec::new();
        for set in 0.. {
            let (Some(joints), Some(weights)) = (reader.read_joints(set), reader.read_weights(set)) else { break };
            for (v, (joints, weights)) in joints.into_u16().zip(weights.into_f32()).enumerate() {
                if set == 0 {
                    all.push(Vec::new());
                }
                for (joint, weight) in joints.into_iter().zip(weights).filter(|(_, weight)| *weight > 0.0) {
                    let node = nodes.get(usize::from(joint)).ok_or("a weight on a joint that the skin lacks")?;
                    let joint = self.joint_at[*node].ok_or("a joint that is not in the scene")?;
                    match all[v].iter_mut().find(|(other, _)| *other == joint) {
                        Some((_, sum)) => *sum += f64::from(weight),
                        None => all[v].push((joint, f64::from(weight))),
                    }
                }
            }
        }
        for influences in &mut all {
            let sum: f64 = influences.iter().map(|(_, weight)| weight).sum();
            if influences.is_empty() {
                return Err("a vertex without weights in a mesh with a skin".into());
            }
            influences.iter_mut().for_each(|(_, weight)| *weight /= sum);
        }
        Ok(all)
    }
}

/// The inverse bind matrices of a skin's joints; where it has none they are the identity.
fn inverse_binds(skin: &Skin, blob: &[u8]) -> Vec<DAffine3> {
    match skin.reader(|_| Some(blob)).read_inverse_bind_matrices() {
        Some(matrices) => matrices.map(affine).collect(),
        None => vec![DAffine3::IDENTITY; skin.joints().len()],
    }
}

/// For each node that is in a skin, its transform to the scene in the bind pose.
///
/// A skin says where its joints are beside its mesh. Where that mesh stands in the scene follows from each joint that is
/// at rest as it was bound: most are, so the place that most joints name is taken. A further skin is placed by the joints
/// that it shares with those before.
fn binds(
    document: &Document,
    rest: &[DAffine3],
    inverse_binds: &[Vec<DAffine3>],
) -> Result<HashMap<usize, DAffine3>, String> {
    let mut binds: HashMap<usize, DAffine3> = HashMap::new();
    let mut skins: Vec<Skin> = document.skins().collect();
    // The one that says most comes first.
    skins.sort_by_key(|skin| std::cmp::Reverse(skin.joints().count()));
    for skin in skins {
        let joints: Vec<usize> = skin.joints().map(|node| node.index()).collect();
        let inverse = &inverse_binds[skin.index()];
        let name = skin.name().unwrap_or_default();
        if inverse.len() != joints.len() || inverse.iter().any(|m| !m.inverse().is_finite()) {
            return Err(format!("skin '{name}': not an invertible bind matrix for each joint"));
        }
        let bound: Vec<DAffine3> = inverse.iter().map(DAffine3::inverse).collect();
        let place = |known: &dyn Fn(&usize) -> Option<DAffine3>| {
            let places = joints.iter().zip(inverse).filter_map(|(joint, inverse)| Some(known(joint)? * *inverse));
            most_agreed(&places.collect::<Vec<_>>(), &bound)
        };
        let shared = place(&|joint| binds.get(joint).copied());
        let Some(place) = shared.or_else(|| place(&|joint| Some(rest[*joint]))) else { continue };
        for (joint, bound) in joints.iter().zip(bound) {
            binds.entry(*joint).or_insert(place * bound);
        }
    }
    Ok(binds)
}

/// The transform of a skin with which most of the others agree on where its joints are; the earliest of those.
fn most_agreed(places: &[DAffine3], joints: &[DAffine3]) -> Option<DAffine3> {
    let low = joints.iter().fold(DVec3::INFINITY, |low, joint| low.min(joint.translation));
    let high = joints.iter().fold(DVec3::NEG_INFINITY, |high, joint| high.max(joint.translation));
    // Joints in one place have no extent; any does then.
    let extent = Some(low.distance(high)).filter(|extent| *extent > 0.0).unwrap_or(1.0);
    let frame = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|axis| low + extent * axis);
    let carried: Vec<[DVec3; 4]> = places.iter().map(|place| frame.map(|p| place.transform_point3(p))).collect();
    let agree = |a: &[DVec3; 4], b: &[DVec3; 4]| {
        let size = a.iter().map(|p| p.distance(a[0])).fold(0.0, f64::max);
        a.iter().zip(b).all(|(p, q)| p.distance(*q) <= TOLERANCE * size)
    };
    let votes: Vec<usize> = carried.iter().map(|a| carried.iter().filter(|b| agree(a, b)).count()).collect();
    let most = *votes.iter().max()?;
    Some(places[votes.iter().position(|&v| v == most)?])
}

/// The triangles of a primitive; none of lines and points.
fn triangles(corners: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    let turned = |(k, w): (usize, &[u32])| if k % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
    match mode {
        Mode::Triangles => corners.as_chunks().0.to_vec(),
        Mode::TriangleStrip => corners.windows(3).enumerate().map(turned).collect(),
        Mode::TriangleFan => corners.windows(2).skip(1).map(|w| [corners[0], w[0], w[1]]).collect(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
    }
}

fn affine(columns: [[f32; 4]; 4]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array_2d(&columns.map(|column| column.map(f64::from))))
}

fn index(count: usize) -> u32 {
    u32::try_from(count).expect("32 bits are enough for a vertex")
}
