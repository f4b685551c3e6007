//! The inputs in the normalised space, and all that both steps derive from them once.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::enclosure;
use super::frame::Frame;
use super::initialize::{ProjectedAvatar, project};
use super::objective::{Objective, Shape};
use super::retreat;
use crate::contact::{Avatar, Bodies, Configuration, Garment, Surface as ContactSurface};
use crate::energy::curve::{Curvature, Torsion};
use crate::energy::fit::Fit;
use crate::energy::position::Position;
use crate::energy::surface::Surface;
use crate::error::{Error, ErrorKind, Result};
use crate::input::diagnosis::Finding;
use crate::input::guide::choose_guides;
use crate::input::mesh::{Topology, TriangleMesh};
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::options::Options;
use crate::sdf::Field;
use crate::sdf::closest_point::ClosestPoint;
use crate::verify::intersections;

/// The separation floor is at most this fraction of the smallest distance at the start.
const FLOOR_SHARE: f64 = 0.25;

/// A distance below this is lost in the rounding of coordinates of order 1.
const NO_DISTANCE: f64 = 1e-12;

/// What a caller handed in, in the caller's own spaces.
pub struct Inputs<'a> {
    /// The garment, around the source skeleton.
    pub garment: &'a TriangleMesh,
    /// The skeleton that the garment was designed on.
    pub source_skeleton: &'a Skeleton,
    /// The body to dress.
    pub avatar: &'a TriangleMesh,
    /// Its skeleton, bones in the order and direction of the source's.
    pub target_skeleton: &'a Skeleton,
    /// Its skin.
    pub skin: Option<&'a SkinWeights>,
    /// The body that the garment was designed on, in the garment's space.
    pub source_avatar: Option<&'a TriangleMesh>,
    /// How much each garment vertex should fit, 1 where not given.
    pub fit_weights: Option<&'a [f64]>,
}

/// The problem in the normalised space.
pub struct Problem {
    /// From the source's space.
    pub source_frame: Frame,
    /// From the target's space.
    pub target_frame: Frame,
    /// The garment as designed.
    pub rest: Vec<DVec3>,
    /// Its triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The avatar at full size, its own vertices and triangles.
    pub avatar: Arc<TriangleMesh>,
    /// The avatar between skeleton and full size.
    pub projected: ProjectedAvatar,
    /// The shape terms.
    shape: Arc<Shape>,
    /// Fit weight of each garment vertex.
    fit_weights: Vec<f64>,
    /// The body that the garment was designed on.
    source_body: Option<ClosestPoint>,
}

impl Problem {
    /// Normalises, projects the avatar, and sets up the shape terms. What is worth knowing of the way there is added to
    /// `findings`, in indices of these inputs; also where it fails.
    ///
    /// # Errors
    /// `InvalidSkeleton` for a skeleton without size, `NotEnclosed` where the garment lies beside the skeleton or the
    /// shrunk avatar pokes through it and cannot be led around it, `SelfIntersection` where the garment passes through itself.
    pub fn new(inputs: &Inputs<'_>, options: &Options, findings: &mut Vec<Finding>) -> Result<Self> {
        let source_frame = Frame::of(inputs.source_skeleton, "source skeleton")?;
        let target_frame = Frame::of(inputs.target_skeleton, "target skeleton")?;
        let normalised = |frame: &Frame, points: &[DVec3]| points.iter().map(|&p| frame.normalise(p)).collect();
        let skeleton = |frame: &Frame, s: &Skeleton| Skeleton {
            joints: normalised(frame, &s.joints),
            bones: inputs.source_skeleton.bones.clone(),
        };
        let source = skeleton(&source_frame, inputs.source_skeleton);
        let target = skeleton(&target_frame, inputs.target_skeleton);
        let rest: Vec<DVec3> = normalised(&source_frame, &inputs.garment.positions);
        let mut avatar = TriangleMesh {
            positions: normalised(&target_frame, &inputs.avatar.positions),
            triangles: inputs.avatar.triangles.clone(),
        };
        gather_unused(&mut avatar);
        let mut projected = project(&avatar, &target, &source, inputs.skin);
        let garment = TriangleMesh { positions: rest, triangles: inputs.garment.triangles.clone() };
        check_itself(&garment)?;
        let wire = retreat::resolve(&garment, &avatar, &mut projected, &source, findings)?;
        enclosure::check(&garment, &wire)?;

        let topology = Topology::new(garment.positions.len(), &garment.triangles);
        let lengths = topology.mean_edge_lengths(&garment.positions);
        let mut guides = Vec::new();
        let mut constraints = Vec::new();
        for (curve, guide) in
            topology.loops.iter().zip(choose_guides(&garment.positions, &topology.loops, &source, &target))
        {
            if let Some(guide) = guide {
                constraints.extend(curve.vertices.iter().map(|&v| (v, guides.len() as u32)));
                guides.push(guide.guide);
            }
        }
        let shape = Shape {
            surface: Surface::new(&garment.positions, &topology.hinges, options.surface_form),
            curvature: Curvature::new(&garment.positions, &topology.loops),
            torsion: Torsion::new(&garment.positions, &topology.loops),
            position: Position::new(&garment.positions, &constraints, guides, &lengths),
        };
        let source_body = inputs.source_avatar.map(|mesh| {
            ClosestPoint::new(&TriangleMesh {
                positions: normalised(&source_frame, &mesh.positions),
                triangles: mesh.triangles.clone(),
            })
        });
        let fit_weights = match inputs.fit_weights {
            Some(weights) => weights.to_vec(),
            None => vec![1.0; garment.positions.len()],
        };
        Ok(Self {
            source_frame,
            target_frame,
            rest: garment.positions,
            triangles: garment.triangles,
            avatar: Arc::new(avatar),
            projected,
            shape: Arc::new(shape),
            fit_weights,
            source_body,
        })
    }

    /// The objective of Step 2, the avatar moving with t, settled at its beginning; and the options with the separation
    /// floor that this problem allows, which is lower where the garment is nearer to itself or the skeleton than that.
    ///
    /// # Errors
    /// `SelfIntersection` where the distance at the start is lost in rounding.
    pub fn begin(&self, options: &Options) -> Result<(Objective, Options)> {
        let at = Configuration { x: &self.rest, t: 0.0 };
        let mut objective = self.inflation_objective(options);
        objective.settle(at);
        let near = objective.activity(at);
        let nearest = near.min_distance_self.min(near.min_distance_avatar);
        if nearest > FLOOR_SHARE.recip() * options.separation_floor {
            return Ok((objective, options.clone()));
        }
        if nearest < NO_DISTANCE {
            return Err(Error::new(
                ErrorKind::SelfIntersection,
                format!(
                    "garment: at the start it is within {nearest:e} of itself or of the skeleton, in units in which the \
                     skeleton is 2 long; that is as good as touching. Move the parts at least {NO_DISTANCE:e} apart"
                ),
            ));
        }
        let options = Options { separation_floor: FLOOR_SHARE * nearest, ..options.clone() };
        objective = self.inflation_objective(&options);
        objective.settle(at);
        Ok((objective, options))
    }

    fn inflation_objective(&self, options: &Options) -> Objective {
        let motion = self.projected.start.iter().zip(&self.projected.end).map(|(&a, &b)| b - a).collect();
        let avatar = Avatar {
            surface: ContactSurface::new(self.projected.start.len(), self.projected.triangles.clone()),
            start: self.projected.start.clone(),
            motion,
        };
        let weights = Options { barrier_weight: options.inflation_barrier_weight, ..options.clone() };
        Objective::new(self.shape.clone(), None, self.bodies(avatar), options.inflation_dhat, &weights)
    }

    /// The objective of Step 3: the avatar stands still, as the caller gave it, with `field` as its distance. The integral
    /// of Eq. 4 is over the current surface; its measure is taken from the garment at the beginning of the step, `x`, and
    /// then kept, for a measure that follows the garment would pay for shrinking it. Where the source body is known, each
    /// point aims at the clearance that it had there, without regard to the side; both bodies are measured in units of
    /// their skeletons.
    ///
    /// # Errors
    /// `InvalidArgument` for a clearance that is not finite.
    pub fn fit_objective(&self, field: Arc<Field>, x: &[DVec3], options: &Options) -> Result<Objective> {
        let areas = TriangleMesh { positions: x.to_vec(), triangles: self.triangles.clone() }.areas();
        let positions = &self.avatar.positions;
        let avatar = Avatar {
            surface: ContactSurface::new(positions.len(), self.avatar.triangles.clone()),
            start: positions.clone(),
            motion: vec![DVec3::ZERO; positions.len()],
        };
        let mut fit = Fit::new(field, &self.triangles, &areas, &self.fit_weights);
        if let Some(body) = &self.source_body {
            let designed = fit.sample_points(&self.rest);
            let aims: Vec<f64> = designed.par_iter().map(|&p| options.designed_clearance * body.distance(p)).collect();
            fit.set_aims(&aims)?;
        }
        Ok(Objective::new(self.shape.clone(), Some(fit), self.bodies(avatar), options.dhat, options))
    }

    fn bodies(&self, avatar: Avatar) -> Arc<Bodies> {
        let surface = ContactSurface::new(self.rest.len(), self.triangles.clone());
        Arc::new(Bodies { garment: Garment { surface, rest: self.rest.clone() }, avatar })
    }
}

/// Moves vertices that no triangle uses to one that is used: they are no part of the body, wherever they are.
fn gather_unused(mesh: &mut TriangleMesh) {
    let mut used = vec![false; mesh.positions.len()];
    mesh.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let Some(&first) = mesh.triangles.iter().flatten().next() else { return };
    let place = mesh.positions[first as usize];
    for (p, _) in mesh.positions.iter_mut().zip(used).filter(|(_, used)| !used) {
        *p = place;
    }
}

/// The barrier keeps apart what is apart; it cannot part what has met.
fn check_itself(garment: &TriangleMesh) -> Result<()> {
    let found = intersections(garment, None, 4)?;
    if found.count == 0 {
        return Ok(());
    }
    let named: Vec<String> = found.pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect();
    Err(Error::new(
        ErrorKind::SelfIntersection,
        format!(
            "garment: {} pairs of triangles intersect or touch before anything has moved (triangles {}); move them apart, \
             and merge vertices that lie at one point",
            found.count,
            named.join(", ")
        ),
    ))
}
