//! The inputs in the normalised space, and all that both steps derive from them once.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::stage::start::enclosure;
use super::normalization::Frame;
use crate::stage::start::projection::{ProjectedAvatar, project};
use super::layer_skin::skin_with_layers;
use crate::stage::objective::{NO_DISTANCE, Objective, Shape};
use super::pin_targets::{self, AskedPin};
use super::fit_region::fit_region;
use crate::stage::start::repair;
use crate::stage::contact_distances::Gaps;
use crate::contact::{Avatar, Bodies, Configuration, Garment, Surface as ContactSurface};
use crate::control::Cancel;
use crate::energy::attachment::Attachment;
use crate::energy::curve::{Curvature, Torsion};
use crate::energy::fit::{Clearance, Fit};
use crate::energy::pin::Pins;
use crate::energy::position::Position;
use crate::energy::rigid::Rigid;
use crate::energy::surface::Surface;
use crate::error::{Error, ErrorKind, Result};
use crate::input::body::Body;
use crate::geometry::sliver_caps::without_caps;
use crate::input::diagnostic::{Element, Finding, FindingKind, Severity, Subject, describe};
use crate::stage::setup::loop_axis::choose_guides;
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::input::weld::Weld;
use crate::memory::bytes;
use crate::options::Options;
use crate::sdf::Field;
use crate::geometry::closest_point::ClosestPoint;
use crate::verify::intersections_unless;

/// The largest offset that can be meant, in the normalised space. A larger one is one in another unit.
const MOST_OFFSET: f64 = 1.0;

/// What a caller handed in, in the caller's own spaces.
pub struct Inputs<'a> {
    /// The garment, around the source skeleton, welded.
    pub garment: &'a TriangleMesh,
    /// The way from the welded garment's indices to the caller's.
    pub weld: Arc<Weld>,
    /// The skeleton that the garment was designed on.
    pub source_skeleton: &'a Skeleton,
    /// The body to dress, with the layers it wears.
    pub avatar: &'a Body,
    /// Its skeleton, bones in the order and direction of the source's.
    pub target_skeleton: &'a Skeleton,
    /// The skin of the avatar without its layers.
    pub skin: Option<&'a SkinWeights>,
    /// The body that the garment was designed on, in the garment's space.
    pub source_avatar: Option<&'a TriangleMesh>,
    /// How much each welded vertex should fit, 1 where not given.
    pub fit_weights: Option<&'a [f64]>,
    /// Pinned welded vertices, and their places in the target's space where named.
    pub pins: &'a [AskedPin],
    /// Lists of welded vertices that stay rigid, each vertex in one at most.
    pub rigid_groups: &'a [Vec<u32>],
    /// The clearance to aim at beside the designed one, in the target's space.
    pub offset: f64,
    /// The most that a coordinate of the result is moved where it is rounded to be read, in the target's space.
    pub coordinate_error: f64,
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
    /// The way to the caller's indices.
    pub weld: Arc<Weld>,
    /// The avatar with its layers at full size, their own vertices and triangles.
    pub avatar: Arc<TriangleMesh>,
    /// The avatar with its layers between skeleton and full size.
    pub projected: ProjectedAvatar,
    /// The shape terms.
    shape: Arc<Shape>,
    /// Fit weight of each garment vertex.
    fit_weights: Vec<f64>,
    /// The body that the garment was designed on.
    source_body: Option<ClosestPoint>,
    /// The clearance to aim at beside the designed one.
    offset: f64,
    /// Pairs of garment triangles that intersect at the start, the lower index first.
    tangled: Vec<[u32; 2]>,
    gaps: Gaps,
}

impl Problem {
    /// Normalises, projects the avatar, and sets up the shape terms. What is worth knowing goes to `findings`, in the
    /// caller's indices.
    ///
    /// # Errors
    /// `InvalidSkeleton` for a skeleton without size, `InvalidArgument` for an offset beyond it, `InvalidMesh` where the coordinates of the result are too coarse,
    /// `NotEnclosed` where the garment lies beside the skeleton or the shrunk avatar pokes through it and cannot be led
    /// around it, `Cancelled`.
    pub fn new(inputs: &Inputs<'_>, options: &Options, cancel: &Cancel, findings: &mut Vec<Finding>) -> Result<Self> {
        let source_frame = Frame::of(inputs.source_skeleton, "source skeleton")?;
        let target_frame = Frame::of(inputs.target_skeleton, "target skeleton")?;
        let offset = inputs.offset * target_frame.scale;
        if offset > MOST_OFFSET {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!(
                    "option offset is {}, which is more than half the size of the target skeleton; it is a length in the unit \
                     of the target space",
                    options.offset
                ),
            ));
        }
        let normalised = |frame: &Frame, points: &[DVec3]| points.iter().map(|&p| frame.normalise(p)).collect();
        let skeleton = |frame: &Frame, s: &Skeleton| Skeleton {
            joints: normalised(frame, &s.joints),
            bones: inputs.source_skeleton.bones.clone(),
        };
        let source = skeleton(&source_frame, inputs.source_skeleton);
        let target = skeleton(&target_frame, inputs.target_skeleton);
        let rest: Vec<DVec3> = normalised(&source_frame, &inputs.garment.positions);
        let mut avatar = TriangleMesh {
            positions: normalised(&target_frame, &inputs.avatar.mesh.positions),
            triangles: inputs.avatar.mesh.triangles.clone(),
        };
        gather_unused(&mut avatar);
        let avatar = inputs.avatar.with_mesh(avatar);
        cancel.check()?;
        let skin = inputs.skin.map(|skin| skin_with_layers(skin, &avatar));
        let mut projected = project(&avatar.mesh, &target, &source, skin.as_deref());
        cancel.check()?;
        let garment = TriangleMesh { positions: rest, triangles: inputs.garment.triangles.clone() };
        let gaps = Gaps::of(options).widened(inputs.coordinate_error * target_frame.scale, &garment)?;
        if gaps != Gaps::of(options) {
            findings.push(coarse_coordinates(&gaps));
        }
        let tangled = intersections_unless(cancel, &garment, None, usize::MAX)?.pairs;
        cancel.check()?;
        let callers = &inputs.weld.triangle_of;
        let wire = repair::resolve(&garment, &avatar, &mut projected, &source, callers, cancel, findings)?;
        cancel.check()?;
        enclosure::check(&garment, &wire)?;
        cancel.check()?;

        let topology = Topology::new(garment.positions.len(), &garment.triangles);
        let lengths = topology.mean_edge_lengths(&garment.positions);
        let attachment = Attachment::new(&garment.positions, &garment.triangles);
        findings.extend(attachment.findings(|t| inputs.weld.triangle_of[t as usize]));
        let mut held = vec![false; garment.positions.len()];
        attachment.pieces().iter().flat_map(|piece| &piece.vertices).for_each(|&v| held[v as usize] = true);
        let whole = without_caps(&garment.positions, &garment.triangles);
        let hinges = whole.map(|triangles| Topology::new(garment.positions.len(), &triangles).hinges);
        let mut guides = Vec::new();
        let mut constraints = Vec::new();
        for (curve, guide) in
            topology.loops.iter().zip(choose_guides(&garment.positions, &topology.loops, &source, &target))
        {
            // A piece that is held to another one, such as a button, has no place of its own along a bone.
            if let Some(guide) = guide
                && !held[curve.vertices[0] as usize]
            {
                constraints.extend(curve.vertices.iter().map(|&v| (v, guides.len() as u32)));
                guides.push(guide.guide);
            }
        }
        let place = |p: DVec3| target_frame.normalise(p);
        let asked: Vec<AskedPin> = inputs.pins.iter().map(|&(v, p)| (v, p.map(place))).collect();
        let shape = Shape {
            surface: Surface::new(
                &garment.positions,
                hinges.as_ref().unwrap_or(&topology.hinges),
                options.surface_form,
            ),
            attachment,
            curvature: Curvature::new(&garment.positions, &topology.loops),
            torsion: Torsion::new(&garment.positions, &topology.loops),
            position: Position::new(&garment.positions, &constraints, guides, &lengths),
            pins: Pins::new(pin_targets::resolve(&garment.positions, &garment.triangles, &asked, &source, &target)),
            rigid: Rigid::new(&garment.positions, inputs.rigid_groups),
        };
        let source_body = inputs.source_avatar.map(|mesh| {
            ClosestPoint::new(&TriangleMesh {
                positions: normalised(&source_frame, &mesh.positions),
                triangles: mesh.triangles.clone(),
            })
        });
        let fit_weights = match (inputs.fit_weights, &source_body) {
            (Some(weights), _) => weights.to_vec(),
            (None, Some(body)) => fit_region(&garment.positions, body, options.fit_distance),
            (None, None) => vec![1.0; garment.positions.len()],
        };
        Ok(Self {
            source_frame,
            target_frame,
            rest: garment.positions,
            triangles: garment.triangles,
            weld: inputs.weld.clone(),
            avatar: avatar.mesh,
            projected,
            shape: Arc::new(shape),
            fit_weights,
            source_body,
            offset,
            tangled,
            gaps,
        })
    }

    /// Bytes that it holds, but for the shape terms, which the objectives count.
    pub fn memory(&self) -> u64 {
        let avatar = &self.avatar;
        let projected = &self.projected;
        let points = [&self.rest, &avatar.positions, &projected.start, &projected.end, &projected.shrunk];
        let triangles = [&self.triangles, &avatar.triangles, &projected.triangles];
        points.into_iter().map(bytes).sum::<u64>()
            + triangles.into_iter().map(bytes).sum::<u64>()
            + bytes(&projected.bones)
            + bytes(&self.fit_weights)
            + self.source_body.as_ref().map_or(0, ClosestPoint::memory)
    }

    /// The objective of Step 2, the avatar moving with t, settled at its beginning. Its separation floor is lower than the
    /// option's where the garment is nearer to itself or the skeleton than that; its tangle holds the triangles that
    /// intersect or touch at the start.
    ///
    /// # Errors
    /// `NotEnclosed` where the distance to the shrunk avatar is lost in rounding; if the options are strict,
    /// `SelfIntersection` where the garment intersects or touches itself.
    pub fn begin(&self, options: &Options, findings: &mut Vec<Finding>) -> Result<Objective> {
        let at = Configuration { x: &self.rest, t: 0.0 };
        let motion = self.projected.start.iter().zip(&self.projected.end).map(|(&a, &b)| b - a).collect();
        let avatar = Avatar {
            surface: ContactSurface::new(self.projected.start.len(), self.projected.triangles.clone()),
            start: self.projected.start.clone(),
            motion,
        };
        let mut objective = Objective::new(self.shape.clone(), None, self.bodies(avatar), self.gaps, options);
        objective.begin(at, &self.tangled);
        let tangled = objective.tangle().triangle_pairs();
        self.report_tangle(tangled, options.strict, findings);
        if options.strict && !tangled.is_empty() {
            return Err(self.intersects_itself(tangled));
        }
        let near = objective.activity(at);
        if near.min_distance_avatar < NO_DISTANCE {
            return Err(Error::new(
                ErrorKind::NotEnclosed,
                format!(
                    "garment: at the start it is within {:e} of the shrunk avatar, in units in which the skeleton is 2 long; \
                     that is as good as touching. Move garment or skeleton by at least {NO_DISTANCE:e}",
                    near.min_distance_avatar
                ),
            ));
        }
        if objective.floor() < self.gaps.floor {
            let vertices: Vec<Element> = objective
                .nearest(at)
                .into_iter()
                .flat_map(|pair| objective.garment_vertices(pair))
                .map(|v| Element::vertex(Subject::Garment, self.weld.vertex_of[v as usize]))
                .collect();
            findings.push(Finding {
                distance: near.min_distance_self.min(near.min_distance_avatar),
                ..Finding::new(
                    FindingKind::NearContact,
                    Severity::Note,
                    &vertices,
                    format!(
                        "garment: at the start it is within {:.1e} of itself and {:.1e} of the shrunk avatar, so that the \
                         separation floor begins at {:.1e} and rises as they part",
                        near.min_distance_self,
                        near.min_distance_avatar,
                        objective.floor()
                    ),
                )
            });
        }
        Ok(objective)
    }

    fn report_tangle(&self, tangled: &[[u32; 2]], strict: bool, findings: &mut Vec<Finding>) {
        let finding = |pair: &[u32; 2]| {
            let how = if self.tangled.binary_search(pair).is_ok() { "intersect" } else { "touch within rounding" };
            let [s, t] = pair.map(|t| self.weld.triangle_of[t as usize]);
            let elements = [s, t].map(|t| Element::triangle(Subject::Garment, t));
            let (severity, fate) = match strict {
                true => (Severity::Error, "which the option strict refuses"),
                false => {
                    (Severity::Warning, "so they are let off until they come apart, and may still do so in the result")
                }
            };
            let sentence = format!("garment: triangles {s} and {t} {how} before anything has moved, {fate}");
            Finding::new(FindingKind::SelfIntersection, severity, &elements, sentence)
        };
        describe(findings, tangled, finding, "pairs of garment triangles intersect before anything has moved");
    }

    fn intersects_itself(&self, pairs: &[[u32; 2]]) -> Error {
        let named = |pair: &[u32; 2]| {
            let [a, b] = pair.map(|t| self.weld.triangle_of[t as usize]);
            format!("{a} and {b}")
        };
        let named: Vec<String> = pairs.iter().take(4).map(named).collect();
        Error::new(
            ErrorKind::SelfIntersection,
            format!(
                "garment: {} pairs of triangles intersect or touch before anything has moved (triangles {}{}); move them \
                 apart, or switch strict off",
                pairs.len(),
                named.join(", "),
                if pairs.len() > named.len() { ", ..." } else { "" },
            ),
        )
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
        let wanted = |designed: f64| {
            let least = if designed + self.offset > 0.0 { designed + self.offset } else { f64::NEG_INFINITY };
            Clearance { most: designed + self.offset, least }
        };
        if let Some(body) = &self.source_body {
            let designed = fit.sample_points(&self.rest);
            let designed = designed.par_iter().map(|&p| wanted(options.designed_clearance * body.distance(p)));
            fit.set_clearances(&designed.collect::<Vec<_>>())?;
        } else if self.offset > 0.0 {
            fit.set_clearances(&vec![wanted(0.0); fit.sample_points(&self.rest).len()])?;
        }
        Ok(Objective::new(self.shape.clone(), Some(fit), self.bodies(avatar), self.gaps, options))
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

fn coarse_coordinates(gaps: &Gaps) -> Finding {
    Finding {
        distance: gaps.floor,
        ..Finding::new(
            FindingKind::CoarseCoordinates,
            Severity::Warning,
            &[],
            format!(
                "target avatar: so far from the origin, the coordinates in which the garment is read are coarse, and it keeps a \
                 distance of {:.1e} at least, in units in which the skeleton is 2 long; a place nearer to the origin or 64 bits \
                 allow a closer fit",
                gaps.floor
            ),
        )
    }
}
