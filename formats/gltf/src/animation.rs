//! Animations: what their channels hold, and where the nodes stand at a time.

use std::collections::HashMap;

use glam::{DAffine3, DQuat, DVec3, DVec4};

use crate::document::Document;
use crate::error::{Error, Result};
use crate::json::At;
use crate::nodes::{Local, Matrix, Nodes, affine, columns};
use crate::reader::Reader;

/// Between quaternions that are nearer to each other than this, by the cosine, the arc is a straight line.
const STRAIGHT: f64 = 1.0 - 1e-9;

/// An animation.
#[derive(Clone, Debug, Default)]
pub struct Animation {
    /// Empty where it has none.
    pub name: String,
    /// What moves what.
    pub channels: Vec<Channel>,
    /// The curves that the channels name.
    pub samplers: Vec<Sampler>,
}

/// What moves one property of one node.
#[derive(Clone, Debug)]
pub struct Channel {
    /// The node.
    pub node: usize,
    /// Which of its properties.
    pub property: Property,
    /// The curve, an index of [`Animation::samplers`].
    pub sampler: usize,
}

/// A property of a node that an animation can move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Property {
    /// Its translation, three numbers.
    Translation,
    /// Its rotation, a quaternion x, y, z, w.
    Rotation,
    /// Its scale, three numbers.
    Scale,
    /// The weights of its mesh's morph targets, a number for each.
    Weights,
}

/// How the values between two keys come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// On a straight line; rotations on the shorter arc.
    Linear,
    /// The earlier key holds until the next.
    Step,
    /// On a cubic Hermite spline with the file's tangents.
    CubicSpline,
}

/// A curve: values at times.
#[derive(Clone, Debug)]
pub struct Sampler {
    /// Times of the keys in seconds; they rise, and there is at least one.
    pub times: Vec<f64>,
    /// Between them.
    pub interpolation: Interpolation,
    /// Numbers of a value.
    pub width: usize,
    /// For each key its value; in a cubic spline the tangent before it, the value, and the tangent after it.
    pub values: Vec<f64>,
}

/// Where the nodes stand at a time.
#[derive(Clone, Debug)]
pub struct Pose {
    /// For each node, from its own space to the file's.
    pub world: Vec<Matrix>,
    /// Weights of the morph targets of nodes whose weights are animated.
    pub weights: HashMap<usize, Vec<f64>>,
}

impl Sampler {
    /// The value at a time; before the first key that of the first, after the last that of the last. Of a rotation see
    /// [`Sampler::rotation`].
    #[must_use]
    pub fn value(&self, time: f64) -> Vec<f64> {
        let (key, share, seconds) = match self.between(time) {
            Between::At(key) => return self.own(key).to_vec(),
            Between::Keys { key, share, seconds } => (key, share, seconds),
        };
        let (a, b) = (self.own(key), self.own(key + 1));
        match self.interpolation {
            Interpolation::Step => a.to_vec(),
            Interpolation::Linear => a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect(),
            Interpolation::CubicSpline => {
                let (out, into) = (self.part(key, 2), self.part(key + 1, 0));
                let t = share;
                let (t2, t3) = (t * t, t * t * t);
                let hermite = [2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t, 3.0 * t2 - 2.0 * t3, t3 - t2];
                (0..self.width)
                    .map(|k| {
                        hermite[0] * a[k]
                            + hermite[1] * seconds * out[k]
                            + hermite[2] * b[k]
                            + hermite[3] * seconds * into[k]
                    })
                    .collect()
            }
        }
    }

    /// The rotation at a time, of length 1.
    ///
    /// # Panics
    /// Where a value has not four numbers.
    #[must_use]
    pub fn rotation(&self, time: f64) -> [f64; 4] {
        let of = |values: &[f64]| DVec4::from_slice(values);
        let turn = match (self.between(time), self.interpolation) {
            (Between::Keys { key, share, .. }, Interpolation::Linear) => {
                arc(of(self.own(key)), of(self.own(key + 1)), share)
            }
            _ => of(&self.value(time)),
        };
        turn.try_normalize().unwrap_or(DVec4::W).to_array()
    }

    /// Where `time` lies among the keys.
    fn between(&self, time: f64) -> Between {
        let later = self.times.partition_point(|key| *key <= time);
        if later == 0 {
            return Between::At(0);
        }
        let key = later - 1;
        if later == self.times.len() || self.times[key] == time {
            return Between::At(key);
        }
        let seconds = self.times[later] - self.times[key];
        Between::Keys { key, share: (time - self.times[key]) / seconds, seconds }
    }

    fn own(&self, key: usize) -> &[f64] {
        if self.interpolation == Interpolation::CubicSpline { self.part(key, 1) } else { self.row(key) }
    }

    /// Of the three that a key of a spline has.
    fn part(&self, key: usize, part: usize) -> &[f64] {
        self.row(3 * key + part)
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.width..][..self.width]
    }
}

/// Where a time lies among the keys.
enum Between {
    At(usize),
    /// After `key`, by `share` of the `seconds` to the next.
    Keys {
        key: usize,
        share: f64,
        seconds: f64,
    },
}

/// On the shorter arc of the unit sphere from `a` to `b`, as much of it as `share` says. Both are of length 1; a rotation is
/// both a quaternion and its negative.
fn arc(a: DVec4, b: DVec4, share: f64) -> DVec4 {
    let cosine = a.dot(b);
    let (b, cosine) = if cosine < 0.0 { (-b, -cosine) } else { (b, cosine) };
    if cosine > STRAIGHT {
        return a + share * (b - a);
    }
    let angle = cosine.acos();
    (a * ((1.0 - share) * angle).sin() + b * (share * angle).sin()) / angle.sin()
}

impl Animation {
    /// Times of the first and the last key of all channels; none where nothing is animated.
    #[must_use]
    pub fn span(&self) -> Option<(f64, f64)> {
        let used = || self.channels.iter().map(|channel| &self.samplers[channel.sampler].times);
        let first = used().map(|times| times[0]).reduce(f64::min)?;
        let last = used().map(|times| times[times.len() - 1]).reduce(f64::max)?;
        Some((first, last))
    }

    /// The times at which any channel has a key, each once, as they rise.
    #[must_use]
    pub fn keys(&self) -> Vec<f64> {
        let mut seen = vec![false; self.samplers.len()];
        let mut keys = Vec::new();
        for channel in &self.channels {
            if !std::mem::replace(&mut seen[channel.sampler], true) {
                keys.extend(&self.samplers[channel.sampler].times);
            }
        }
        keys.sort_by(f64::total_cmp);
        keys.dedup();
        keys
    }

    /// Where the nodes stand at a time in seconds; what is not animated rests.
    ///
    /// # Errors
    /// Where the place of a node is not finite.
    ///
    /// # Panics
    /// Where `nodes` are those of another file.
    pub fn pose(&self, nodes: &Nodes, time: f64) -> Result<Pose> {
        let mut moved: HashMap<usize, Local> = HashMap::new();
        let mut weights = HashMap::new();
        for channel in &self.channels {
            let sampler = &self.samplers[channel.sampler];
            if channel.property == Property::Weights {
                weights.insert(channel.node, sampler.value(time));
                continue;
            }
            let local = moved.entry(channel.node).or_insert_with(|| nodes.all[channel.node].as_local());
            match channel.property {
                Property::Translation => local.translation.copy_from_slice(&sampler.value(time)),
                Property::Scale => local.scale.copy_from_slice(&sampler.value(time)),
                Property::Rotation => local.rotation = sampler.rotation(time),
                Property::Weights => unreachable!("they are no transform"),
            }
        }
        let mut world: Vec<DAffine3> = vec![DAffine3::IDENTITY; nodes.all.len()];
        for &node in &nodes.order {
            let here = &nodes.all[node];
            let local = affine(&moved.get(&node).map_or(here.local_matrix, Local::matrix));
            world[node] = here.parent.map_or(local, |parent| world[parent] * local);
            if !world[node].is_finite() {
                let said = format!("at {time} s of the animation '{}' its place is not finite", self.name);
                return Err(Error::json(format!("/nodes/{node}"), said));
            }
        }
        Ok(Pose { world: world.iter().map(columns).collect(), weights })
    }
}

impl Pose {
    /// The pose in which the file's nodes stand.
    #[must_use]
    pub fn rest(nodes: &Nodes) -> Self {
        Self { world: nodes.all.iter().map(|node| node.world).collect(), weights: HashMap::new() }
    }
}

impl crate::nodes::Node {
    /// Its own transform in three parts. Of a matrix with shear there are none that make it; these come near.
    fn as_local(&self) -> Local {
        self.local.unwrap_or_else(|| {
            let (scale, rotation, translation) = affine(&self.local_matrix).to_scale_rotation_translation();
            let (rotation, scale) = if rotation.is_finite() && scale.is_finite() {
                (rotation, scale)
            } else {
                (DQuat::IDENTITY, DVec3::ONE)
            };
            Local { translation: translation.to_array(), rotation: rotation.to_array(), scale: scale.to_array() }
        })
    }
}

impl Document {
    /// The animations of the file. Channels without a node, and those that move what is no property of a node (an extension's
    /// pointer), are passed over.
    ///
    /// # Errors
    /// Where an index is none, times do not rise, or values are too few, too many or not finite.
    pub fn animations(&self) -> Result<Vec<Animation>> {
        let reader = Reader::new(self);
        self.root().list_of("animations")?.iter().map(|at| read(&reader, at)).collect()
    }
}

fn read(reader: &Reader, at: &At) -> Result<Animation> {
    let document = reader.document;
    let nodes = document.count("nodes")?;
    let samplers = at.need("samplers")?.list()?.collect::<Vec<_>>();
    let mut animation = Animation { name: at.text_of("name").to_owned(), ..Animation::default() };
    // A curve is read once for each number of numbers that its values have.
    let mut known: HashMap<(usize, Property, usize), usize> = HashMap::new();
    for channel in at.need("channels")?.list()? {
        let target = channel.need("target")?;
        let Some(node) = target.index("node", "nodes", nodes)? else { continue };
        let path = target.need("path")?;
        let (property, width) = match path.text()? {
            "translation" => (Property::Translation, 3),
            "rotation" => (Property::Rotation, 4),
            "scale" => (Property::Scale, 3),
            "weights" => (Property::Weights, morph_targets(document, node, &path)?),
            _ => continue,
        };
        let sampler = channel.need("sampler")?.index_into("samplers", samplers.len())?;
        let sampler = match known.get(&(sampler, property, width)) {
            Some(known) => *known,
            None => {
                animation.samplers.push(read_sampler(reader, &samplers[sampler], property, width)?);
                known.insert((sampler, property, width), animation.samplers.len() - 1);
                animation.samplers.len() - 1
            }
        };
        animation.channels.push(Channel { node, property, sampler });
    }
    Ok(animation)
}

/// How many morph targets the mesh of a node has.
fn morph_targets(document: &Document, node: usize, path: &At) -> Result<usize> {
    let mesh = document.entry("nodes", node)?.index("mesh", "meshes", document.count("meshes")?)?;
    let Some(mesh) = mesh else { return Err(path.error(format!("is 'weights', and node {node} has no mesh"))) };
    let primitives = document.entry("meshes", mesh)?.need("primitives")?;
    let mut most = 0;
    for primitive in primitives.list()? {
        most = most.max(primitive.count_of("targets")?);
    }
    if most == 0 {
        return Err(path.error(format!("is 'weights', and mesh {mesh} has no morph targets")));
    }
    Ok(most)
}

fn read_sampler(reader: &Reader, at: &At, property: Property, width: usize) -> Result<Sampler> {
    let accessors = reader.document.count("accessors")?;
    let interpolation = match at.get("interpolation") {
        None => Interpolation::Linear,
        Some(kind) => match kind.text()? {
            "LINEAR" => Interpolation::Linear,
            "STEP" => Interpolation::Step,
            "CUBICSPLINE" => Interpolation::CubicSpline,
            other => return Err(kind.error(format!("is '{other}', not LINEAR, STEP or CUBICSPLINE"))),
        },
    };
    let input = at.need("input")?;
    let times: Vec<f64> =
        reader.numbers::<1>(input.index_into("accessors", accessors)?)?.into_iter().map(|[time]| time).collect();
    if times.is_empty() {
        return Err(input.error("has no times"));
    }
    if let Some(k) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(input.error(format!("time {} is {}, and the one before it {}", k + 1, times[k + 1], times[k])));
    }
    let output = at.need("output")?;
    let index = output.index_into("accessors", accessors)?;
    let mut values: Vec<f64> = match property {
        Property::Rotation => reader.numbers::<4>(index)?.into_flattened(),
        Property::Weights => reader.numbers::<1>(index)?.into_flattened(),
        Property::Translation | Property::Scale => reader.numbers::<3>(index)?.into_flattened(),
    };
    let rows = if interpolation == Interpolation::CubicSpline { 3 * times.len() } else { times.len() };
    if values.len() != rows * width {
        let said = format!("{} numbers for {} keys", values.len(), times.len());
        return Err(output.error(format!("{said}, which need {}", rows * width)));
    }
    if property == Property::Rotation {
        let is_tangent = |row: usize| interpolation == Interpolation::CubicSpline && row % 3 != 1;
        for (row, turn) in values.chunks_exact_mut(4).enumerate().filter(|(row, _)| !is_tangent(*row)) {
            let length = DVec4::from_slice(turn).length();
            // It is 1 but for the rounding of 32, 16 or 8 bits.
            if !(0.9..1.1).contains(&length) {
                return Err(output.error(format!("value {row} is no rotation: its length is {length}, not 1")));
            }
            // Splines are made of what the file says, as others do, and put to length 1 afterwards.
            if interpolation != Interpolation::CubicSpline {
                turn.iter_mut().for_each(|x| *x /= length);
            }
        }
    }
    Ok(Sampler { times, interpolation, width, values })
}
