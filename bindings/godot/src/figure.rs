//! Meshes on a skeleton, joined to one, in the space of the skeleton as it rests.

use glam::{DAffine3, DMat3, DVec3};
use godot::builtin::Variant;
use godot::classes::Node3D;
use godot::obj::Gd;

use crate::engine::{self, ask};
use crate::mesh::{Arrays, BlendShape};
use crate::scene::{Binds, Shown, Skeleton, hung, place, skeleton_of};
use crate::session::{Failure, Influences, Result};

/// One mesh of a figure.
pub struct Part {
    /// Where it is from.
    pub shown: Shown,
    /// As it was read, in its own space.
    pub arrays: Arrays,
    /// Its vertices are these of the figure.
    pub first_vertex: usize,
    /// Its triangles are these of the figure.
    pub first_triangle: usize,
}

/// Meshes on a skeleton.
#[derive(Default)]
pub struct Figure {
    /// Its meshes.
    pub parts: Vec<Part>,
    /// Vertices of all meshes.
    pub positions: Vec<[f32; 3]>,
    /// Triangles of all meshes.
    pub triangles: Vec<[u32; 3]>,
    /// Skin weights on the bones of the skeleton; none where no mesh has any.
    pub skin: Option<Influences>,
    /// Normals of the first mesh, as it stands in the skeleton's space.
    pub normals: Vec<[f32; 3]>,
    /// Its tangents.
    pub tangents: Vec<[f32; 4]>,
    /// Its blend shapes.
    pub shapes: Vec<BlendShape>,
    /// Blend shapes of a body that are to be answered, over all its meshes.
    pub answered: Vec<BlendShape>,
}

/// In which shape meshes are read.
pub enum Taken<'a> {
    /// Without its blend shapes, as garments are: these come along.
    Basis,
    /// As the blend shapes of their nodes have them now, but for those of these names, which are to be answered.
    AsItIs(&'a [String]),
}

/// Binds that differ by less than this share of their size are the same: the skeleton rests as the mesh was bound.
const SAME: f64 = 1e-4;

impl Figure {
    /// Reads all meshes. One that another skeleton moves than `skeleton` comes onto its bones by their names, unless `given` says that
    /// the skeleton is that of the meshes.
    ///
    /// # Errors
    /// A mesh or a skin that cannot be used; a blend shape that is to be answered and is nowhere.
    pub fn read(shown: Vec<Shown>, skeleton: &Skeleton, given: &Variant, taken: &Taken) -> Result<Self> {
        let mut figure = Self::default();
        let mut skins = Vec::new();
        for shown in shown {
            let arrays = Arrays::read(&shown.mesh, &shown.name)?;
            let own = match given.try_to::<Gd<Node3D>>() {
                Ok(given) => Some(given),
                Err(_) => shown.node.and_then(engine::Node::get).and_then(|node| skeleton_of(&node)),
            };
            let placed = match own.filter(|own| engine::Node::new(own) != skeleton.node) {
                Some(own) => {
                    let own = Skeleton::read(&own, None, &shown.name)?;
                    let mut placed = Placed::new(&shown, &arrays, &own)?;
                    let there = own.onto(skeleton);
                    placed.bones.iter_mut().chain(&mut placed.hangs_on).for_each(|bone| *bone = there[*bone as usize]);
                    placed
                }
                None => Placed::new(&shown, &arrays, skeleton)?,
            };
            let first = figure.positions.len();
            let place = |(v, &p): (usize, &[f32; 3])| placed.point(v, p);
            match taken {
                Taken::Basis => figure.positions.extend(arrays.positions.iter().enumerate().map(place)),
                Taken::AsItIs(answered) => {
                    figure.positions.extend(shaped(&shown, &arrays, answered).iter().enumerate().map(place));
                    figure.take_answered(&arrays, &placed, first, answered);
                }
            }
            let first_triangle = figure.triangles.len();
            figure.triangles.extend(arrays.triangles.iter().map(|t| t.map(|v| v.saturating_add(first as u32))));
            if figure.parts.is_empty() {
                figure.take_shading(&arrays, &placed);
            }
            skins.push(match placed.hangs_on {
                Some(bone) => Weights::whole(bone, arrays.positions.len()),
                None => Weights { bones: placed.bones, weights: arrays.weights.clone(), width: arrays.width },
            });
            figure.parts.push(Part { shown, arrays, first_vertex: first, first_triangle });
        }
        figure.join_skins(skins);
        if let Taken::AsItIs(answered) = taken {
            figure.complete_answered(answered)?;
        }
        Ok(figure)
    }

    /// Adds what a mesh has of the blend shapes that are to be answered.
    fn take_answered(&mut self, arrays: &Arrays, placed: &Placed, first: usize, names: &[String]) {
        for shape in arrays.shapes.iter().filter(|shape| names.contains(&shape.name)) {
            let known = self.answered.iter().position(|other| other.name == shape.name).unwrap_or_else(|| {
                self.answered.push(BlendShape { name: shape.name.clone(), ..BlendShape::default() });
                self.answered.len() - 1
            });
            let offsets = &mut self.answered[known].offsets;
            offsets.resize(first, [0.0; 3]);
            offsets.extend(shape.offsets.iter().enumerate().map(|(v, &d)| placed.direction(v, d)));
        }
    }

    fn complete_answered(&mut self, names: &[String]) -> Result<()> {
        for shape in &mut self.answered {
            shape.offsets.resize(self.positions.len(), [0.0; 3]);
        }
        self.answered.sort_by_key(|shape| names.iter().position(|name| *name == shape.name));
        let is_missing = |name: &&String| !self.answered.iter().any(|shape| shape.name == **name);
        match names.iter().find(is_missing) {
            Some(name) => Err(Failure::argument(format!("blend shapes: no mesh of the avatar has one named '{name}'"))),
            None => Ok(()),
        }
    }

    fn take_shading(&mut self, arrays: &Arrays, placed: &Placed) {
        let normal = |(v, &n): (usize, &[f32; 3])| placed.normal(v, n);
        let tangent = |(v, &t): (usize, &[f32; 4])| placed.tangent(v, t);
        self.normals = arrays.normals.iter().enumerate().map(normal).collect();
        self.tangents = arrays.tangents.iter().enumerate().map(tangent).collect();
        let shape = |shape: &BlendShape| BlendShape {
            name: shape.name.clone(),
            offsets: shape.offsets.iter().enumerate().map(|(v, &d)| placed.direction(v, d)).collect(),
            normals: shape.normals.iter().enumerate().map(normal).collect(),
            tangents: shape.tangents.iter().enumerate().map(tangent).collect(),
        };
        self.shapes = arrays.shapes.iter().map(shape).collect();
    }

    /// One width for all.
    fn join_skins(&mut self, skins: Vec<Weights>) {
        let width = skins.iter().map(|skin| skin.width).max().unwrap_or(0);
        if width == 0 {
            return;
        }
        let mut joined = Influences { width, ..Influences::default() };
        for (skin, part) in skins.into_iter().zip(&self.parts) {
            for v in 0..part.arrays.positions.len() {
                for k in 0..width {
                    let at = v * skin.width + k;
                    joined.joints.push(if k < skin.width { skin.bones[at] } else { 0 });
                    joined.weights.push(if k < skin.width { skin.weights[at] } else { 0.0 });
                }
            }
        }
        self.skin = joined.weights.iter().any(|&w| w > 0.0).then_some(joined);
    }
}

/// Vertices with the blend shapes that the node has on now.
fn shaped(shown: &Shown, arrays: &Arrays, without: &[String]) -> Vec<[f32; 3]> {
    let mut points = arrays.positions.clone();
    let Some(node) = shown.node.and_then(engine::Node::get) else { return points };
    for (k, shape) in arrays.shapes.iter().enumerate().filter(|(_, shape)| !without.contains(&shape.name)) {
        let value: f64 = ask(&node, "get_blend_shape_value", &[Variant::from(k as i64)]);
        if value != 0.0 {
            for (point, offset) in points.iter_mut().zip(&shape.offsets) {
                *point = narrow(wide(*point) + value * wide(*offset));
            }
        }
    }
    points
}

/// Bones of a mesh's vertices, so many each, with weights.
struct Weights {
    bones: Vec<u32>,
    weights: Vec<f32>,
    width: usize,
}

impl Weights {
    /// All of it on one bone.
    fn whole(bone: u32, vertices: usize) -> Self {
        Self { bones: vec![bone; vertices], weights: vec![1.0; vertices], width: 1 }
    }
}

/// How a mesh comes into the space of its skeleton.
struct Placed {
    /// Where all vertices go alike.
    all: Option<DAffine3>,
    /// Each on its own, where the skeleton rests otherwise than the mesh was bound.
    each: Vec<DAffine3>,
    /// Bones in place of binds.
    bones: Vec<u32>,
    /// The bone that takes it along as a whole, where it has no weights.
    hangs_on: Option<u32>,
}

impl Placed {
    fn new(shown: &Shown, arrays: &Arrays, skeleton: &Skeleton) -> Result<Self> {
        if arrays.width == 0 {
            let hung = shown.node.and_then(|node| hung(node, skeleton));
            let (bone, all) = match hung {
                Some((bone, place)) => (Some(bone as u32), place),
                None => (None, shown.node.map_or(DAffine3::IDENTITY, |node| place(node, skeleton.node))),
            };
            return Ok(Self { all: Some(snapped(all)), each: Vec::new(), bones: Vec::new(), hangs_on: bone });
        }
        let binds = Binds::read(shown, skeleton)?;
        let known = |bind: u32| (bind as usize).min(binds.bones.len().saturating_sub(1));
        let bones =
            arrays.binds.iter().map(|&bind| binds.bones.get(known(bind)).map_or(0, |&bone| bone as u32)).collect();
        let used = || {
            let influences = arrays.binds.iter().zip(&arrays.weights);
            influences.filter(|&(_, &weight)| weight > 0.0).map(|(&bind, _)| binds.places[known(bind)])
        };
        let Some(first) = used().next() else {
            return Ok(Self { all: Some(DAffine3::IDENTITY), each: Vec::new(), bones, hangs_on: None });
        };
        let size = arrays.positions.iter().flatten().fold(0.0_f64, |size, &x| size.max(f64::from(x).abs()));
        if used().all(|other| difference(first, other, size) <= SAME * size) {
            return Ok(Self { all: Some(snapped(first)), each: Vec::new(), bones, hangs_on: None });
        }
        let vertex = |v: usize| {
            let (mut matrix, mut translation, mut sum) = (DMat3::ZERO, DVec3::ZERO, 0.0);
            for k in v * arrays.width..(v + 1) * arrays.width {
                let weight = f64::from(arrays.weights[k]);
                if weight > 0.0 {
                    let place = binds.places[known(arrays.binds[k])];
                    matrix += place.matrix3 * weight;
                    translation += place.translation * weight;
                    sum += weight;
                }
            }
            if sum == 0.0 { first } else { DAffine3 { matrix3: matrix * (1.0 / sum), translation: translation / sum } }
        };
        Ok(Self { all: None, each: (0..arrays.positions.len()).map(vertex).collect(), bones, hangs_on: None })
    }

    fn of(&self, v: usize) -> DAffine3 {
        self.all.unwrap_or_else(|| self.each[v])
    }

    fn point(&self, v: usize, p: [f32; 3]) -> [f32; 3] {
        let place = self.of(v);
        if place == DAffine3::IDENTITY { p } else { narrow(place.transform_point3(wide(p))) }
    }

    fn direction(&self, v: usize, d: [f32; 3]) -> [f32; 3] {
        let place = self.of(v);
        if place == DAffine3::IDENTITY { d } else { narrow(place.matrix3 * wide(d)) }
    }

    fn normal(&self, v: usize, n: [f32; 3]) -> [f32; 3] {
        let place = self.of(v);
        if place == DAffine3::IDENTITY {
            return n;
        }
        narrow((place.matrix3.inverse().transpose() * wide(n)).normalize_or_zero())
    }

    fn tangent(&self, v: usize, t: [f32; 4]) -> [f32; 4] {
        let [x, y, z] = self.direction(v, [t[0], t[1], t[2]]);
        let turned = narrow(wide([x, y, z]).normalize_or_zero());
        if self.of(v) == DAffine3::IDENTITY { t } else { [turned[0], turned[1], turned[2], t[3]] }
    }
}

/// How far two places of a mesh of this size are apart.
fn difference(a: DAffine3, b: DAffine3, size: f64) -> f64 {
    let columns = a.matrix3 - b.matrix3;
    let turned = columns.x_axis.length().max(columns.y_axis.length()).max(columns.z_axis.length());
    (a.translation - b.translation).length() + size * turned
}

/// What is the identity but for rounding is the identity, so that numbers stay as they are.
fn snapped(place: DAffine3) -> DAffine3 {
    if place.abs_diff_eq(DAffine3::IDENTITY, 1e-5) { DAffine3::IDENTITY } else { place }
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}
