//! One key pose: the body goes there by its skin weights and takes the garment along by its own, piece by piece, with the machine
//! of REPOSE. Where the garment has to give way, that becomes the correction of the pose.
//!
//! The garment is held to where its weights put it, and keeps the shape that it has in the result, so that it gives way where it
//! has to and nowhere else. Where the posed body passes through itself, as at the fold of a bent hip, no garment can lie between;
//! what of the body does so in the key pose does not take part.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use rayon::prelude::*;

use super::morph_solve::MorphSolve;
use crate::contact::{Avatar, Configuration, Surface};
use crate::control::Stage;
use crate::energy::curve::{Curvature, Polyline, Torsion};
use crate::energy::pin::{Pin, Pins};
use crate::energy::surface;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::{Topology, TriangleMesh, triangle_area};
use crate::geometry::solid_angle::winding;
use crate::input::skin::SkinWeights;
use crate::rig::pose_path::PosePath;
use crate::rig::weights::blend::linear_blend;
use crate::solver::newton::State;
use crate::stage::objective::Objective;
use crate::stage::repose::Repose;
use crate::stage::setup::problem::collapse_unused;
use crate::stage::setup::shape::Shape;
use crate::verify::intersections_with_cancel;

/// How strongly a unit of area is held to where the weights put it: the garment gives way within some 5 % of the skeleton's size
/// around what pushes it.
const HOLD: f64 = 100.0;
/// Newton steps at the end of the way, at most, and where they end: a squared Newton decrement below this share of the objective.
const RELAXING: u32 = 8;
const RELAXED: f64 = 1e-3;
/// So many rings of triangles around a fold of the body are looked at whether they lie in it.
const RINGS: u32 = 8;
/// What is left out beside the folds, in rings of triangles, in one attempt after the other: where the garment does not let the
/// body pass, a wider fold has to do.
const WIDER: [u32; 3] = [0, 2, 4];
/// Points from which it is looked whether a triangle lies in a fold are this far above it, in its size.
const LIFT: f64 = 1e-3;
/// Neither body nor garment goes farther from the skeleton, in the normalised space: farther off, coordinates are coarse.
const FARTHEST: f64 = 200.0;
/// What weights shrink to less than this share of its volume cannot be taken back by them.
const LEAST_VOLUME: f64 = 1e-3;
/// Offsets below these, in the normalised space, are left out where the pose is good without them.
const SMALL: [f64; 2] = [5e-4, 1e-6];

/// Pairs of triangles that pass through each other in a key pose and not in the result's own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PoseCounts {
    /// Within the garment.
    pub garment: u64,
    /// Of the garment and the body with its layers, where the body does not pass through itself.
    pub body: u64,
    /// Of the garment and the body where it does.
    pub folds: u64,
}

impl PoseCounts {
    /// What a correction is there for.
    pub fn avoidable(&self) -> u64 {
        self.garment + self.body
    }
}

/// The correction of a key pose.
#[derive(Clone, Debug, Default)]
pub struct PoseCorrection {
    /// Offsets of the caller's garment vertices in the bind pose, to be added before skin weights move them.
    pub offsets: Vec<DVec3>,
    /// By the weights alone.
    pub before: PoseCounts,
    /// With the offsets.
    pub after: PoseCounts,
}

/// All that it takes, apart from the session.
pub(super) struct PoseSolve {
    pub(super) solve: MorphSolve,
    /// In the caller's coordinates.
    pub(super) path: PosePath,
    /// The weights of the body with its layers.
    pub(super) body_skin: SkinWeights,
    /// The weights of the welded garment vertices, as a host has them.
    pub(super) garment_skin: SkinWeights,
    /// For each joint that the garment has beyond those of the path, the joint that moves it.
    pub(super) added: Vec<Option<u32>>,
}

/// Body and garment somewhere on the way, in the normalised space.
struct Place {
    body: Vec<DVec3>,
    garment: Vec<DVec3>,
}

impl PoseSolve {
    /// The correction.
    ///
    /// # Errors
    /// `InvalidArgument` for a pose far away, `Cancelled`, `MemoryLimit`, `Internal`.
    pub(super) fn run(self) -> Result<PoseCorrection> {
        let snapshot = &self.solve.snapshot;
        self.check()?;
        let motions = self.motions(1.0);
        let bound: Vec<DVec3> = snapshot.x_with_caps().iter().map(|&x| self.solve.read(x)).collect();
        let under = TriangleMesh {
            positions: linear_blend(&snapshot.body.mesh.positions, &self.body_skin, &motions),
            triangles: snapshot.body.mesh.triangles.clone(),
        };
        let folded = self.folded(&under)?;
        let still = vec![DVec3::ZERO; bound.len()];
        let before = self.count(&bound, &still, &motions, &under, &folded)?;
        let caller = |offsets: &[DVec3]| snapshot.problem.weld.scatter(offsets);
        let mut best = PoseCorrection { offsets: caller(&still), before, after: before };
        if before.avoidable() == 0 {
            return Ok(best);
        }
        let inner = self.inside(&under, &folded);
        for rings in WIDER {
            let ignored = grown(&under, inner.clone(), rings);
            let Some(x) = self.go(&ignored)? else { continue };
            for small in SMALL {
                let offsets = self.offsets(&x, &bound, &motions, small);
                let after = self.count(&bound, &offsets, &motions, &under, &folded)?;
                if after.avoidable() < best.after.avoidable() {
                    best = PoseCorrection { offsets: caller(&offsets), before, after };
                }
                if after.avoidable() == 0 {
                    return Ok(best);
                }
            }
        }
        Ok(best)
    }

    /// Refuses a pose that is far away.
    fn check(&self) -> Result<()> {
        let Place { body, garment } = self.place(1.0);
        let is_near = |p: &DVec3| p.abs().max_element() <= FARTHEST;
        if body.iter().chain(&garment).all(is_near) {
            return Ok(());
        }
        let message = format!(
            "it takes a vertex more than {} times the size of the target skeleton away; transforms are in the unit of the \
             target, and take the bind pose to the pose",
            0.5 * FARTHEST
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    }

    /// The motion of each joint, those of the garment's own with what moves them.
    fn motions(&self, share: f64) -> Vec<DAffine3> {
        let mut motions = self.path.motions(share);
        for parent in &self.added {
            let above = parent.and_then(|parent| motions.get(parent as usize).copied());
            motions.push(above.unwrap_or(DAffine3::IDENTITY));
        }
        motions
    }

    fn normalised(&self, p: DVec3) -> DVec3 {
        let snapshot = &self.solve.snapshot;
        snapshot.problem.target_normalization.normalise(snapshot.coordinate_system().position_to_internal(p))
    }

    fn place(&self, share: f64) -> Place {
        let snapshot = &self.solve.snapshot;
        let motions = self.motions(share);
        let normalised = |points: Vec<DVec3>| points.into_iter().map(|p| self.normalised(p)).collect();
        let garment: Vec<DVec3> = snapshot.x.iter().map(|&x| snapshot.restored(x)).collect();
        Place {
            body: normalised(linear_blend(&snapshot.body.mesh.positions, &self.body_skin, &motions)),
            garment: normalised(linear_blend(&garment, &self.garment_skin, &motions)),
        }
    }

    /// Takes body and garment into the key pose, without the triangles of the body in `ignored`. None where the garment does not
    /// let the body pass.
    fn go(&self, ignored: &[bool]) -> Result<Option<Vec<DVec3>>> {
        let solve = &self.solve;
        let problem = &solve.snapshot.problem;
        let kept = problem.avatar.triangles.iter().zip(ignored).filter(|(_, ignored)| !**ignored);
        let kept: Vec<[u32; 3]> = kept.map(|(&t, _)| t).collect();
        if kept.is_empty() {
            return Ok(None);
        }
        let (shape, areas) = (Arc::new(self.shape()), self.areas());
        let mut state = State { x: solve.snapshot.x.clone(), t: 0.0 };
        let mut exempt = solve.exempt.clone();
        let pieces = self.path.pieces();
        let mut from = self.place(0.0);
        for piece in 1..=pieces {
            let to = self.place(f64::from(piece) / f64::from(pieces));
            let mut objective = self.objective(&shape, &areas, [&from, &to], &kept);
            state.t = 0.0;
            objective.contact.initialise(Configuration { x: &state.x, t: 0.0 }, &exempt);
            let mut newton = solve.newton(&objective, &state)?;
            let along = from.garment.iter().zip(&to.garment).map(|(&a, &b)| b - a).collect();
            let mut step = Repose::new(along);
            let mut arrived = false;
            for iteration in 1..=solve.options.max_iterations {
                solve.say(Stage::Repose, (f64::from(piece - 1) + state.t) / f64::from(pieces), iteration);
                match step.iterate(&mut objective, &mut newton, &mut state) {
                    Ok(ended) => arrived = ended,
                    Err(error) if error.kind == ErrorKind::InflationStalled => return Ok(None),
                    Err(error) => return Err(error),
                }
                if objective.contact.update_exemptions(state.configuration())? {
                    newton.forget_values();
                }
                solve.check_contacts(&objective)?;
                if arrived {
                    break;
                }
            }
            if !arrived {
                return Ok(None);
            }
            let last = piece == pieces;
            for _ in 0..if last { RELAXING } else { 0 } {
                let step = newton.newton_step(&mut objective, &mut state, false)?;
                if objective.contact.update_exemptions(state.configuration())? {
                    newton.forget_values();
                }
                if step.is_none_or(|step| step.decrement <= RELAXED * step.after.abs()) {
                    break;
                }
            }
            exempt = objective.contact.exempt_pairs().triangle_pairs().to_vec();
            from = to;
        }
        Ok(Some(state.x))
    }

    fn objective(&self, shape: &Arc<Shape>, areas: &[f64], [from, to]: [&Place; 2], kept: &[[u32; 3]]) -> Objective {
        let solve = &self.solve;
        let problem = &solve.snapshot.problem;
        let [start, end] = [from, to].map(|place| {
            let mut mesh = TriangleMesh { positions: place.body.clone(), triangles: kept.to_vec() };
            collapse_unused(&mut mesh);
            mesh.positions
        });
        let motion = start.iter().zip(&end).map(|(&a, &b)| b - a).collect();
        let surface = Surface::new(start.len(), kept.to_vec());
        let bodies = problem.bodies(Avatar { surface, start, motion });
        let mut objective =
            Objective::new(shape.clone(), None, bodies, solve.distances, &solve.options, solve.cancel.clone());
        let ends = from.garment.iter().zip(&to.garment).zip(areas);
        let pin = |(vertex, ((&start, &end), &area))| Pin { vertex, start, end, weight: HOLD * area };
        objective.release_places();
        objective.hold(Pins::holding((0u32..).zip(ends).map(pin).collect()));
        objective.contact.set_intersecting_at_rest(&problem.designed_intersections);
        objective.set_contact(solve.distances.dhat, solve.options.barrier_weight);
        objective
    }

    /// The shape terms of the garment as it is in the result. Its openings are held by nothing but the weights.
    fn shape(&self) -> Shape {
        let snapshot = &self.solve.snapshot;
        let (x, triangles, options) = (&snapshot.x, &snapshot.problem.triangles, &self.solve.options);
        let hinges = Topology::new(x.len(), triangles).hinges;
        let surface = if options.surface_length > 0.0 {
            surface::Surface::at_any_resolution(x, &hinges, options.surface_form, options.surface_length)
        } else {
            surface::Surface::new(x, &hinges, options.surface_form)
        };
        let no_curves = std::iter::empty::<Polyline<'_>>;
        Shape {
            surface,
            curvature: Curvature::new(x, no_curves(), options.curve_chord),
            torsion: Torsion::new(x, no_curves(), options.curve_chord),
            ..Shape::clone(&snapshot.problem.shape)
        }
    }

    /// The area of the result around each welded vertex.
    fn areas(&self) -> Vec<f64> {
        let snapshot = &self.solve.snapshot;
        let mut areas = vec![0.0; snapshot.x.len()];
        for triangle in &snapshot.problem.triangles {
            let third = triangle_area(triangle.map(|v| snapshot.x[v as usize])) / 3.0;
            triangle.iter().for_each(|&v| areas[v as usize] += third);
        }
        // What has none, such as a vertex of a cap, is held all the same.
        let mean = areas.iter().sum::<f64>() / areas.len().max(1) as f64;
        areas.iter().map(|&area| area.max(1e-3 * mean)).collect()
    }

    /// Triangles of the body that pass through others in the pose and not in the bind pose.
    fn folded(&self, under: &TriangleMesh) -> Result<Vec<bool>> {
        let cancel = &self.solve.cancel;
        let bound = intersections_with_cancel(&self.solve.snapshot.body.mesh, None, usize::MAX, cancel)?.pairs;
        let mut folded = vec![false; under.triangles.len()];
        for pair in intersections_with_cancel(under, None, usize::MAX, cancel)?.pairs {
            if bound.binary_search(&pair).is_err() {
                pair.iter().for_each(|&t| folded[t as usize] = true);
            }
        }
        Ok(folded)
    }

    /// Those, and triangles near them that lie in another part of the body in the pose.
    fn inside(&self, under: &TriangleMesh, folded: &[bool]) -> Vec<bool> {
        let near = grown(under, folded.to_vec(), RINGS);
        let own = self.solve.snapshot.body.triangles_of(None).map_or(0, |range| range.end as usize);
        let avatar = TriangleMesh { positions: under.positions.clone(), triangles: under.triangles[..own].to_vec() };
        let side = if avatar.signed_volume() < 0.0 { -1.0 } else { 1.0 };
        let is_in = |t: usize| {
            if folded[t] || t >= own || !near[t] {
                return folded[t];
            }
            let [a, b, c] = avatar.corners(t as u32);
            let across = (b - a).cross(c - a);
            let lift = LIFT * across.length().sqrt();
            let p = (a + b + c) / 3.0 + side * lift * across.normalize_or_zero();
            side * winding(&avatar, 0..own as u32, p) > 0.5
        };
        (0..under.triangles.len()).into_par_iter().map(is_in).collect()
    }

    /// From the bind pose to where `x` is in the key pose, taken back by the weights; 0 where that is less than `small` of what
    /// the weights alone give.
    fn offsets(&self, x: &[DVec3], bound: &[DVec3], motions: &[DAffine3], small: f64) -> Vec<DVec3> {
        let snapshot = &self.solve.snapshot;
        let with_caps = snapshot.with_caps(x);
        let offset = |(vertex, (&x, &p)): (usize, (&DVec3, &DVec3))| {
            let blend = blended(self.garment_skin.weights(vertex), motions);
            let has_inverse = blend.matrix3.determinant().abs() > LEAST_VOLUME;
            if !has_inverse || x.distance(self.normalised(blend.transform_point3(p))) < small {
                return DVec3::ZERO;
            }
            self.solve.precision.round(blend.inverse().transform_point3(snapshot.restored(x)) - p)
        };
        with_caps.iter().zip(bound).enumerate().map(offset).collect()
    }

    /// What passes through what in the key pose, in the garment as a host has it.
    fn count(
        &self,
        bound: &[DVec3],
        offsets: &[DVec3],
        motions: &[DAffine3],
        under: &TriangleMesh,
        folded: &[bool],
    ) -> Result<PoseCounts> {
        let (solve, snapshot) = (&self.solve, &self.solve.snapshot);
        let corrected: Vec<DVec3> = bound.iter().zip(offsets).map(|(&p, &d)| p + d).collect();
        let posed = linear_blend(&corrected, &self.garment_skin, motions);
        let garment = TriangleMesh {
            positions: posed.into_iter().map(|p| solve.precision.round(p)).collect(),
            triangles: snapshot.problem.triangles.clone(),
        };
        let initial = snapshot.initial_intersections();
        let own = intersections_with_cancel(&garment, None, usize::MAX, &solve.cancel)?.pairs;
        let with_body = intersections_with_cancel(&garment, Some(under), usize::MAX, &solve.cancel)?.pairs;
        let folds = with_body.iter().filter(|pair| folded[pair[1] as usize]).count();
        Ok(PoseCounts {
            garment: own.iter().filter(|pair| initial.binary_search(pair).is_err()).count() as u64,
            body: (with_body.len() - folds) as u64,
            folds: folds as u64,
        })
    }
}

/// What linear blend skinning does to a vertex with these weights.
fn blended(weights: &[(u32, f64)], motions: &[DAffine3]) -> DAffine3 {
    let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
    if sum == 0.0 {
        return DAffine3::IDENTITY;
    }
    let (mut matrix3, mut translation) = (DMat3::ZERO, DVec3::ZERO);
    for &(joint, weight) in weights {
        let motion = &motions[joint as usize];
        matrix3 += motion.matrix3 * (weight / sum);
        translation += motion.translation * (weight / sum);
    }
    DAffine3 { matrix3, translation }
}

/// `marked` with so many rings of triangles around it.
fn grown(mesh: &TriangleMesh, mut marked: Vec<bool>, rings: u32) -> Vec<bool> {
    for _ in 0..rings {
        let mut touched = vec![false; mesh.positions.len()];
        for (triangle, _) in mesh.triangles.iter().zip(&marked).filter(|(_, marked)| **marked) {
            triangle.iter().for_each(|&v| touched[v as usize] = true);
        }
        for (triangle, marked) in mesh.triangles.iter().zip(&mut marked) {
            *marked |= triangle.iter().any(|&v| touched[v as usize]);
        }
    }
    marked
}
