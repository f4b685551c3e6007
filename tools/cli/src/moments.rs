//! Poses of a file's animations, and where its parts are in them.

use bespoke_gltf::{Animation, Posable, Pose};
use glam::DVec3;

use crate::failure::{Failure, Result};
use crate::figure::Figure;

/// A pose of an animation.
pub struct Moment {
    /// Name of the animation, or its number where it has none.
    pub animation: String,
    /// Seconds from its start.
    pub time: f64,
    /// Where the nodes are.
    pub pose: Pose,
}

/// The meshes of a figure, ready to be posed.
pub struct Meshes(Vec<Posable>);

/// Poses of the animation `wanted`, or of all; `count` of each, evenly spaced among its keys.
///
/// # Errors
/// Where there is no such animation, or something is wrong with one.
pub fn moments(figure: &Figure, wanted: Option<&str>, count: usize) -> Result<Vec<Moment>> {
    let animations = figure.document.animations().map_err(|e| in_file(figure, e))?;
    let names: Vec<String> = animations.iter().enumerate().map(|(k, a)| name(k, a)).collect();
    let known = || if names.is_empty() { "none".to_string() } else { names.join(", ") };
    let is_wanted = |k: usize| match wanted {
        None => true,
        Some(wanted) => names[k] == wanted || (!names.iter().any(|name| name == wanted) && k.to_string() == wanted),
    };
    let chosen: Vec<usize> = (0..names.len()).filter(|&k| is_wanted(k)).collect();
    if chosen.is_empty() {
        let what = wanted.map_or("there is no animation in it".into(), |name| format!("it has no animation '{name}'"));
        return Err(Failure::no_result(format!("{}: {what}; its animations: {}", figure.file.display(), known())));
    }
    let mut moments = Vec::new();
    for k in chosen {
        for time in times(&animations[k].keys(), count) {
            let pose = animations[k].pose(&figure.scene.nodes, time).map_err(|e| in_file(figure, e))?;
            moments.push(Moment { animation: names[k].clone(), time, pose });
        }
    }
    Ok(moments)
}

/// `count` of an animation's keys: all where there are no more; else first, last, and those nearest to even steps between.
fn times(keys: &[f64], count: usize) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (keys.first(), keys.last()) else { return Vec::new() };
    if keys.len() <= count {
        return keys.to_vec();
    }
    let nearest = |time: f64| keys.iter().copied().min_by(|a, b| (a - time).abs().total_cmp(&(b - time).abs()));
    let even = |k: usize| first + (last - first) * k as f64 / (count - 1).max(1) as f64;
    let mut times: Vec<f64> = (0..count).filter_map(|k| nearest(even(k))).collect();
    times.dedup();
    times
}

fn name(index: usize, animation: &Animation) -> String {
    if animation.name.is_empty() { index.to_string() } else { animation.name.clone() }
}

fn in_file(figure: &Figure, error: bespoke_gltf::Error) -> Failure {
    Failure::no_result(error.in_file(figure.file.display().to_string()).to_string())
}

impl Meshes {
    /// Those of `figure`.
    ///
    /// # Errors
    /// Where one cannot be read.
    pub fn of(figure: &Figure) -> Result<Self> {
        let read = |instance| figure.document.posable(&figure.scene, instance).map_err(|e| in_file(figure, e));
        figure.instances().map(read).collect::<Result<_>>().map(Self)
    }

    /// The vertices of all meshes in a pose, by the weights of the file.
    ///
    /// # Errors
    /// Where one is nowhere.
    pub fn in_pose(&self, figure: &Figure, pose: &Pose) -> Result<Vec<Vec<DVec3>>> {
        let posed = |mesh: &Posable| {
            let positions = mesh.positions(pose).map_err(|e| in_file(figure, e))?;
            Ok(positions.into_iter().map(DVec3::from_array).collect())
        };
        self.0.iter().map(posed).collect()
    }
}
