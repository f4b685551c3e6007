//! The inputs in the normalised space, and all that is derived from them once, for inflation and fit.

use std::sync::Arc;

use glam::DVec3;

use super::bone_map::BoneMap;
use super::cap_motion::CapMotion;
use super::carried_pieces::CarriedPiece;
use super::carried_places::CarriedPlaces;
use super::contact_distances::ContactDistances;
use super::known_garment::{KnownGarment, Pieces};
use super::layer_skin::{skin_on_skeleton, skin_with_layers};
use super::normalization::Normalization;
use super::pin_targets::PinRequest;
use super::shape::{Asked, HeldPieces, Outline, Shape, rigid};
use super::source_body::SourceBody;
use super::wishes::{fit_weights, normalised_offset};
use crate::contact::{Avatar, Bodies, Garment, Surface};
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::geometry::t_junctions::{self, TJunction, touching_pairs};
use crate::input::body::Body;
use crate::input::curve::WeldedCurve;
use crate::input::diagnostic::{Bone, Diagnostic};
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::input::weld::Weld;
use crate::memo::MeshBits;
use crate::memory::bytes;
use crate::options::Options;
use crate::sdf::Field;
use crate::stage::start::beyond_openings::{self, Ends};
use crate::stage::start::caps::Caps;
use crate::stage::start::owners::Owners;
use crate::stage::start::projection::{ProjectedAvatar, project_with};
use crate::stage::start::untangle::{Untangled, begin_apart};
use crate::stage::start::weight_check::believed;
use crate::stage::start::{enclosure, open_ends, repair};

/// A vertex is on an edge within the rounding of coordinates that came in 32 bits.
const JUNCTION_REACH: f64 = 1e-6;

/// The clearance of carried pieces in d-hat, at least: beyond the barrier.
const CARRIED_IN_DHAT: f64 = 1.5;

/// What a caller handed in, in the internal coordinate system but not yet normalised.
pub struct Inputs<'a> {
    /// The garment, around the source skeleton, welded.
    pub garment: &'a TriangleMesh,
    /// Maps between the welded garment's indices and the caller's.
    pub weld: Arc<Weld>,
    /// The skeleton that the garment was designed on.
    pub source_skeleton: &'a Skeleton,
    /// The body to dress, with the layers it wears.
    pub avatar: &'a Body,
    /// Its skeleton, bones in the order and direction of the source's.
    pub target_skeleton: &'a Skeleton,
    /// The skin of the avatar without its layers.
    pub skin: Option<&'a SkinWeights>,
    /// What of the avatar without its layers and of the source avatar is the end of a limb, as weights on the joints at which limbs end
    /// and one more for the rest.
    pub ends: [Option<&'a SkinWeights>; 2],
    /// The body that the garment was designed on, in the garment's coordinate system.
    pub source_avatar: Option<&'a TriangleMesh>,
    /// How much each welded vertex should fit, 1 where not given.
    pub fit_weights: Option<&'a [f64]>,
    /// Pinned welded vertices, and their targets in the target's coordinate system where given.
    pub pins: &'a [PinRequest],
    /// Lists of welded vertices that stay rigid, each vertex in one at most.
    pub rigid_groups: &'a [Vec<u32>],
    /// Curves that the caller names.
    pub curves: &'a [WeldedCurve],
    /// The clearance to aim at in addition to the designed one, in the target's unit.
    pub offset: f64,
    /// The most that a coordinate of the result is moved where it is rounded to be read, in the target's unit.
    pub coordinate_error: f64,
    /// The target may be turned while it is solved for.
    pub turns: bool,
    /// What is known of the garment.
    pub known: Arc<KnownGarment>,
}

/// The problem in the normalised space.
#[derive(Clone)]
pub struct Problem {
    /// From the source's coordinates.
    pub source_normalization: Normalization,
    /// From the target's coordinates.
    pub target_normalization: Normalization,
    /// The garment as designed.
    pub rest: Vec<DVec3>,
    /// The garment pulled apart where it passes through itself as designed, if that could be done.
    pub untangled: Option<Untangled>,
    /// Its triangles, without its caps.
    pub triangles: Vec<[u32; 3]>,
    /// The caps, which are left out.
    pub caps: Vec<CapMotion>,
    /// Maps to the caller's indices, whose caps are no triangles of the welded garment.
    pub weld: Arc<Weld>,
    /// The avatar with its layers at full size, their own vertices and triangles.
    pub avatar: Arc<TriangleMesh>,
    /// What of it the garment is fitted to.
    pub fitted: Arc<TriangleMesh>,
    /// The avatar with its layers between skeleton and full size.
    pub projected: ProjectedAvatar,
    /// The joints at the ends of each bone.
    pub bones: Vec<[u32; 2]>,
    /// The skeleton that the garment was designed on, and that of the body to dress.
    pub skeletons: [Skeleton; 2],
    /// The shape terms.
    pub shape: Arc<Shape>,
    /// Fit weight of each garment vertex.
    pub fit_weights: Vec<f64>,
    /// Vertices that do not fit unless the caller says so: they have their place from something else.
    pub placed: Vec<u32>,
    /// The body that the garment was designed on.
    pub source_body: Option<SourceBody>,
    /// What is known of the garment.
    pub known: Arc<KnownGarment>,
    /// The clearance to aim at in addition to the designed one.
    pub offset: f64,
    /// The pieces that are around no bone, and where they go.
    pub carried: CarriedPlaces,
    /// Rigid groups of the caller that are not empty: those of the shape that come first.
    pub callers_groups: Vec<Vec<u32>>,
    /// Pairs of garment triangles that intersect in the design, the lower index first.
    pub designed_intersections: Vec<[u32; 2]>,
    /// Pairs of garment triangles that touch at T-junctions, the lower index first, in ascending order.
    pub joined: Vec<[u32; 2]>,
    /// The distances that contact keeps.
    pub distances: ContactDistances,
    /// The avatar has skin weights; else the nearest bones decide.
    pub has_skin: bool,
}

impl Problem {
    /// Normalises, projects the avatar, and sets up the shape terms. Adds to `diagnostics`, in the caller's indices.
    ///
    /// # Errors
    /// `InvalidSkeleton` for a skeleton without size, `InvalidArgument` for an offset beyond it and a curve along no edges, `InvalidMesh` where the
    /// coordinates of the result are too coarse, `NotEnclosed` where the garment does not enclose the skeleton, or
    /// the shrunk avatar penetrates it and no path around it was found, `Cancelled`.
    pub fn new(
        inputs: &Inputs<'_>,
        options: &Options,
        cancel: &Cancel,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Self> {
        let mut normalised = Normalised::new(inputs, options)?;
        cancel.check()?;
        let Normalised { source, target, avatar, .. } = &normalised;
        let believed = inputs.skin.map(|skin| believed(skin, &avatar.avatar(), target, options.strict, diagnostics));
        let skin = believed.as_deref().map(|skin| skin_on_skeleton(skin, avatar, target));
        let skin = skin.as_deref();
        let owners = Owners::find(&avatar.mesh, target, skin);
        diagnostics.extend(owners.unclear(avatar.avatar_positions().len(), target));
        cancel.check()?;
        let straight = project_with(&avatar.mesh, target, source, &owners, &[]);
        cancel.check()?;
        let caps = if options.keep_caps {
            Caps::default()
        } else {
            // As it begins; what comes later, such as a head that starts beyond the collar, needs the openings.
            repair::find_caps(&normalised.garment, &straight, source, cancel)?
        };
        cancel.check()?;
        let (weld, motions) = normalised.open(&caps, &inputs.weld, diagnostics);
        let Normalised {
            source_normalization,
            target_normalization,
            ref source,
            ref target,
            ref garment,
            ref avatar,
            offset,
        } = normalised;
        let skeletons = [target, source];
        let mut projected =
            open_ends::begin_beyond(straight, garment, &avatar.mesh, skeletons, &owners, options.strict, diagnostics)?;
        cancel.check()?;
        let source_body = inputs.source_avatar.map(|mesh| TriangleMesh {
            positions: source_normalization.normalise_all(&mesh.positions),
            triangles: mesh.triangles.clone(),
        });
        let mut moved = Vec::new();
        if let Some(ends) = inputs.ends[0] {
            let of_body =
                ends_of(&skin_with_layers(ends, avatar), |v| skin.and_then(|skin| skin.dominant_joint(v)).is_some());
            let of_source = inputs.ends[1].map(|ends| ends_of(ends, |_| true));
            let own = Ends { body: &avatar.mesh, joints: &of_body };
            let on_source = source_body.as_ref().zip(of_source.as_ref()).map(|(body, joints)| Ends { body, joints });
            (projected, moved) = beyond_openings::begin_beyond(projected, garment, skeletons, own, on_source);
            cancel.check()?;
        }
        let distances =
            ContactDistances::of(options).widened(inputs.coordinate_error * target_normalization.scale, garment)?;
        if distances != ContactDistances::of(options) {
            diagnostics.push(Diagnostic::CoarseCoordinates { min_separation: distances.min_separation });
        }
        let known = inputs.known.clone();
        let bits = MeshBits(Arc::new(garment.clone()));
        let designed_intersections = known.intersections(&bits, cancel)?.to_vec();
        let junctions = t_junctions::find(&garment.positions, &garment.triangles, JUNCTION_REACH);
        let joined = touching_pairs(&junctions, &garment.triangles);
        cancel.check()?;
        let callers = &weld.triangle_of;
        let segments = repair::resolve(garment, avatar, &mut projected, source, callers, cancel, diagnostics)
            .map_err(|error| with_reason(error, &caps))?;
        cancel.check()?;
        let designed_on = source_body.map(|body| SourceBody::new(body, source, target, &avatar.avatar()));
        let source_surface = designed_on.as_ref().map(|body| &body.surface);
        let pieces = known.pieces(&bits, &segments, source, designed_on.as_ref(), cancel)?;
        let Pieces { loose, sizes, carried: pieces, is_beside } = &*pieces;
        if *is_beside {
            return Err(enclosure::refused());
        }
        cancel.check()?;
        let carried = if pieces.is_empty() {
            CarriedPlaces::default()
        } else {
            let body = avatar.avatar();
            let bodies = designed_on.as_ref().map(|source_body| [&*source_body.mesh.0, &body]);
            let map = BoneMap::new(source, target, bodies);
            CarriedPlaces::new(garment, pieces, &map, designed_on.as_ref(), options.designed_clearance)
        };
        // A strict caller asks to be refused, so nothing is pulled apart for him.
        let untangled = if options.strict {
            None
        } else {
            begin_apart(garment, [&designed_intersections, &joined], &projected, cancel)?
        };

        let normalised_target = |p: DVec3| target_normalization.normalise(p);
        let pins: Vec<PinRequest> = inputs.pins.iter().map(|&(v, p)| (v, p.map(normalised_target))).collect();
        let held = HeldPieces { loose, sizes, carried: &carried };
        check_curves(inputs.curves, garment)?;
        let asked = Asked { pins: &pins, rigid_groups: inputs.rigid_groups, curves: inputs.curves };
        let outline = Outline::new(garment, &junctions, &held);
        let curves = known.curves(&bits, &outline, source, cancel)?;
        let shape = Shape::new(garment, (&outline, &curves), [source, target], &moved, &asked, &held, options);
        diagnostics.extend(loose.diagnostics(|t| weld.triangle_of[t as usize]));
        let (vertices, triangles) = (&weld.vertex_of, &weld.triangle_of);
        diagnostics.extend(curves.near.diagnostics(|v| vertices[v as usize], |t| triangles[t as usize]));
        diagnostics.extend(curves.rims.diagnostics(source, |t| triangles[t as usize]));
        diagnostics.extend(junctions_found(&junctions, &weld));
        Diagnostic::list(diagnostics, pieces, |piece: &CarriedPiece| Diagnostic::CarriedPiece {
            vertices: piece.vertices.len(),
            triangle: weld.triangle_of[piece.triangle as usize],
            bone: Bone { index: piece.bone, joints: source.bones[piece.bone as usize] },
            distance: piece.distance,
            from_body: source_surface.is_some(),
            stiff: piece.stiff,
            closed: piece.closed,
        });
        // What hangs on another piece has its place from that, and the place of what is carried has its clearance already.
        let placed =
            loose.hanging.iter().map(|piece| &piece.vertices).chain(pieces.iter().map(|piece| &piece.vertices));
        let placed: Vec<u32> = placed.flatten().copied().collect();
        let fit_weights = match inputs.fit_weights {
            Some(weights) => weights.to_vec(),
            None => fit_weights(&garment.positions, source_surface, options.fit_distance, &placed),
        };
        let Normalised { garment, avatar, source, target, .. } = normalised;
        let fitted = avatar.fitted().map_or_else(
            || avatar.mesh.clone(),
            |mut mesh| {
                collapse_unused(&mut mesh);
                mesh.into()
            },
        );
        Ok(Self {
            source_normalization,
            target_normalization,
            rest: garment.positions,
            untangled,
            triangles: garment.triangles,
            caps: motions,
            weld,
            avatar: avatar.mesh,
            fitted,
            projected,
            bones: inputs.source_skeleton.bones.clone(),
            skeletons: [source, target],
            shape: Arc::new(shape),
            fit_weights,
            placed,
            source_body: designed_on,
            known,
            offset,
            carried,
            callers_groups: inputs.rigid_groups.iter().filter(|group| !group.is_empty()).cloned().collect(),
            has_skin: inputs.skin.is_some(),
            designed_intersections,
            joined,
            distances,
        })
    }

    /// Brings the carried pieces to their clearances from the avatar, whose distance is `field`.
    pub fn settle_carried(&mut self, field: &Field) {
        self.carried.settle(field, CARRIED_IN_DHAT * self.distances.dhat, self.offset);
        let carry = self.carried.term();
        // Stiff ones may have grown.
        let rigid = rigid(&self.rest, &self.callers_groups, &self.carried);
        if let Some(shape) = Arc::get_mut(&mut self.shape) {
            (shape.carry, shape.rigid) = (carry, rigid);
        }
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
            + self.untangled.as_ref().map_or(0, |untangled| bytes(&untangled.start))
            + self.source_body.as_ref().map_or(0, SourceBody::memory)
    }

    /// Where the garment begins, and the pairs of its triangles that intersect there: pulled apart where that could be done and
    /// `as_designed` is not asked for.
    pub fn initial_state(&self, as_designed: bool) -> (&[DVec3], &[[u32; 2]]) {
        match &self.untangled {
            Some(untangled) if !as_designed => (&untangled.start, &untangled.remaining),
            _ => (&self.rest, &self.designed_intersections),
        }
    }

    /// The garment and `avatar`, as contact has them.
    pub fn bodies(&self, avatar: Avatar) -> Arc<Bodies> {
        let surface = Surface::new(self.rest.len(), self.triangles.clone()).with_joined(self.joined.clone());
        Arc::new(Bodies { garment: Garment { surface, rest: self.rest.clone() }, avatar })
    }
}

/// The inputs in the normalised space, in which both skeletons are 2 long.
struct Normalised {
    source_normalization: Normalization,
    target_normalization: Normalization,
    source: Skeleton,
    target: Skeleton,
    garment: TriangleMesh,
    avatar: Body,
    offset: f64,
}

impl Normalised {
    fn new(inputs: &Inputs<'_>, options: &Options) -> Result<Self> {
        let source_normalization = Normalization::of(inputs.source_skeleton, "source skeleton")?;
        let target_normalization = Normalization::of(inputs.target_skeleton, "target skeleton")?;
        let offset = normalised_offset(inputs.offset, &target_normalization, options)?;
        let target_normalization = if inputs.turns {
            let source = Skeleton {
                joints: source_normalization.normalise_all(&inputs.source_skeleton.joints),
                bones: Vec::new(),
            };
            target_normalization.turned_to(&source, inputs.target_skeleton)
        } else {
            target_normalization
        };
        let skeleton = |normalization: &Normalization, s: &Skeleton| Skeleton {
            joints: normalization.normalise_all(&s.joints),
            bones: inputs.source_skeleton.bones.clone(),
        };
        let mut avatar = TriangleMesh {
            positions: target_normalization.normalise_all(&inputs.avatar.mesh.positions),
            triangles: inputs.avatar.mesh.triangles.clone(),
        };
        collapse_unused(&mut avatar);
        Ok(Self {
            source: skeleton(&source_normalization, inputs.source_skeleton),
            target: skeleton(&target_normalization, inputs.target_skeleton),
            garment: TriangleMesh {
                positions: source_normalization.normalise_all(&inputs.garment.positions),
                triangles: inputs.garment.triangles.clone(),
            },
            avatar: inputs.avatar.with_mesh(avatar),
            source_normalization,
            target_normalization,
            offset,
        })
    }

    /// Takes the caps out of the garment. Returns the weld without them and how they move, and adds to `diagnostics`.
    fn open(
        &mut self,
        found: &Caps,
        weld: &Arc<Weld>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> (Arc<Weld>, Vec<CapMotion>) {
        if found.caps.is_empty() {
            return (weld.clone(), Vec::new());
        }
        let garment = &mut self.garment;
        let mut removed = vec![false; garment.triangles.len()];
        found.caps.iter().flat_map(|cap| &cap.triangles).for_each(|&t| removed[t as usize] = true);
        let mut kept = vec![false; garment.positions.len()];
        let stays = garment.triangles.iter().zip(&removed).filter(|(_, removed)| !**removed).map(|(t, _)| *t);
        let triangles: Vec<[u32; 3]> = stays.collect();
        triangles.iter().flatten().for_each(|&v| kept[v as usize] = true);
        let motions = found.caps.iter().map(|cap| CapMotion::new(garment, &cap.triangles, &kept)).collect();
        Diagnostic::list(diagnostics, &found.caps, |cap| Diagnostic::OpeningCap {
            bone: Bone { index: cap.bone, joints: self.source.bones[cap.bone as usize] },
            triangles: cap.triangles.iter().map(|&t| weld.triangle_of[t as usize]).collect(),
        });
        garment.triangles = triangles;
        (Arc::new(weld.without(&removed)), motions)
    }
}

/// The joint of the limb's end that each vertex belongs to by weights on these and on one more for the rest, where they are `believed`.
fn ends_of(weights: &SkinWeights, believed: impl Fn(usize) -> bool) -> Vec<Option<u32>> {
    let rest = weights.joint_count() as u32 - 1;
    let end = |v: usize| weights.dominant_joint(v).filter(|&joint| joint < rest && believed(v));
    (0..weights.vertex_count()).map(end).collect()
}

/// Refuses curves that leave the edges of the garment, which has no caps any more.
fn check_curves(curves: &[WeldedCurve], garment: &TriangleMesh) -> Result<()> {
    if curves.is_empty() {
        return Ok(());
    }
    let edges = Topology::new(garment.positions.len(), &garment.triangles).edges;
    curves.iter().enumerate().try_for_each(|(name, curve)| curve.check_edges(name, &edges))
}

/// What is said of T-junctions, in the caller's indices.
fn junctions_found(junctions: &[TJunction], weld: &Weld) -> Option<Diagnostic> {
    let first = junctions.first()?;
    let on = |junction: &TJunction| junction.between.first().map(|&v| weld.vertex_of[v as usize]);
    Some(Diagnostic::TJunctions {
        count: junctions.iter().map(|junction| junction.between.len()).sum(),
        first: junctions.iter().filter_map(on).take(4).collect(),
        triangle: weld.triangle_of[first.triangle as usize],
    })
}

/// Says why what closes the garment at a bone was not taken for a cap.
fn with_reason(mut error: Error, caps: &Caps) -> Error {
    if let Some(reason) = caps.refused
        && error.kind == ErrorKind::NotEnclosed
    {
        error.message +=
            &format!("; what closes it there is not taken for the cap of an opening: it {}", reason.reason());
    }
    error
}

/// Moves vertices that no triangle uses onto one that is used: they are no part of the body, wherever they are.
pub fn collapse_unused(mesh: &mut TriangleMesh) {
    let used = mesh.used_vertices();
    let Some(&first) = mesh.triangles.iter().flatten().next() else { return };
    let target = mesh.positions[first as usize];
    for (p, _) in mesh.positions.iter_mut().zip(used).filter(|(_, used)| !used) {
        *p = target;
    }
}
