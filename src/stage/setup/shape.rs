//! The shape terms: what holds the garment to its design.

use std::collections::HashSet;

use glam::DVec3;

use super::carried_places::CarriedPlaces;
use super::curves::HeldCurves;
use super::loose_pieces::LoosePieces;
use super::near_borders::NearBorders;
use super::pin_targets::{self, PinRequest};
use super::shell_rims::ShellRims;
use crate::energy::attachment::{Attachment, SizeHold};
use crate::energy::curve::{Curvature, Torsion};
use crate::energy::pin::Pins;
use crate::energy::position::Position;
use crate::energy::rigid::Rigid;
use crate::energy::surface::Surface;
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::geometry::sliver_caps::without_caps;
use crate::geometry::t_junctions::TJunction;
use crate::input::curve::WeldedCurve;
use crate::input::skeleton::Skeleton;
use crate::options::Options;
use crate::stage::start::beyond_openings::MovedEnd;

/// The shape terms, which inflation and fit share.
#[derive(Clone)]
pub struct Shape {
    /// Surface shape (Eq. 2).
    pub surface: Surface,
    /// Loose pieces, held to their hosts.
    pub attachment: Attachment,
    /// Borders held to what they lie on, in the fit.
    pub borders: Attachment,
    /// Carried pieces.
    pub carry: Pins,
    /// Curvature (Eq. 5) of the boundary curves, the rims of shells and the curves that the caller names.
    pub curvature: Curvature,
    /// Torsion of the same curves.
    pub torsion: Torsion,
    /// Position of the same curves along their bones (Eq. 3).
    pub position: Position,
    /// Pinned vertices.
    pub pins: Pins,
    /// Rigid groups: the caller's, and after them the carried pieces that are stiff.
    pub rigid: Rigid,
}

/// How the triangles of a garment hang together, and which of its vertices something else than a bone holds.
pub struct Outline {
    /// Its triangles; slits without width, which are no boundaries and whose sides keep their angle, are closed.
    closed: Vec<[u32; 3]>,
    /// Their connectivity.
    topology: Topology,
    /// Whether each vertex is held with its piece.
    pub is_held: Vec<bool>,
}

/// The curves of a garment that were found beside its boundary loops.
pub struct Curves {
    /// The borders that are held to others.
    pub near: NearBorders,
    /// The rims of its shells.
    pub rims: ShellRims,
}

/// What the caller asks of a garment's vertices.
pub struct Asked<'a> {
    /// Pins, at most one a vertex.
    pub pins: &'a [PinRequest],
    /// Lists of vertices that stay rigid, each vertex in one at most.
    pub rigid_groups: &'a [Vec<u32>],
    /// Curves along edges.
    pub curves: &'a [WeldedCurve],
}

/// What fills a hat keeps this share of its stiffness: the head comes into it.
const FILLING: f64 = 0.01;

/// Pieces of a garment that have their place from something else than the bones inside of them.
pub struct HeldPieces<'a> {
    /// Those that are held to others.
    pub loose: &'a LoosePieces,
    /// What keeps the size of those that are near nothing.
    pub sizes: &'a [SizeHold],
    /// Those that the body carries.
    pub carried: &'a CarriedPlaces,
}

impl HeldPieces<'_> {
    /// What keeps sizes, but for those of carried pieces, whose size is the body's.
    fn sizes(&self) -> Vec<SizeHold> {
        let carried: HashSet<u32> = self.carried.pieces().flat_map(|piece| piece.vertices.iter().copied()).collect();
        self.sizes.iter().filter(|size| !carried.contains(&size.vertices[0])).copied().collect()
    }
}

impl Outline {
    /// That of `garment` with its T-junctions; `held` are its pieces that something else holds.
    pub fn new(garment: &TriangleMesh, junctions: &[TJunction], held: &HeldPieces<'_>) -> Self {
        let (vertices, triangles) = (garment.positions.len(), &garment.triangles);
        let closed: Vec<[u32; 3]> =
            triangles.iter().copied().chain(junctions.iter().flat_map(TJunction::caps)).collect();
        let topology = Topology::new(vertices, &closed);
        let mut is_held = vec![false; vertices];
        held.loose.all().flat_map(|piece| &piece.vertices).for_each(|&v| is_held[v as usize] = true);
        held.carried.pieces().flat_map(|piece| &piece.vertices).for_each(|&v| is_held[v as usize] = true);
        Self { closed, topology, is_held }
    }
}

impl Curves {
    /// Those of `garment` around `source`.
    pub fn find(garment: &TriangleMesh, outline: &Outline, source: &Skeleton) -> Self {
        let Outline { topology, is_held, .. } = outline;
        Self {
            near: NearBorders::find(&garment.positions, &garment.triangles, topology, is_held),
            rims: ShellRims::find(garment, topology, is_held, source),
        }
    }
}

impl Shape {
    /// The terms of `garment` as designed, with its `outline` and `found` curves, between source and target skeleton, of which these ends of
    /// limbs `moved`. `held` are its pieces that something else holds.
    pub fn new(
        garment: &TriangleMesh,
        (outline, found): (&Outline, &Curves),
        [source, target]: [&Skeleton; 2],
        moved: &[MovedEnd],
        asked: &Asked<'_>,
        held: &HeldPieces<'_>,
        options: &Options,
    ) -> Self {
        let (rest, triangles) = (&garment.positions, &garment.triangles);
        let Outline { closed, topology, is_held } = outline;
        let curves = HeldCurves::new(topology.loops.iter().chain(&found.rims.loops), asked.curves);
        let whole = without_caps(rest, closed);
        let hinges = whole.map(|triangles| Topology::new(rest.len(), &triangles).hinges);
        let hinges = hinges.as_ref().unwrap_or(&topology.hinges);
        let mut surface = if options.surface_length > 0.0 {
            Surface::at_any_resolution(rest, hinges, options.surface_form, options.surface_length)
        } else {
            Surface::new(rest, hinges, options.surface_form)
        };
        let fillings: HashSet<u32> = held.carried.fillings().collect();
        if !fillings.is_empty() {
            surface.soften(|v| fillings.contains(&v), FILLING);
        }
        Self {
            surface,
            attachment: Attachment::new(rest, &held.loose.holds, &held.sizes()),
            borders: Attachment::of_borders(rest, &found.near.holds),
            carry: held.carried.term(),
            curvature: Curvature::new(rest, curves.polylines(), options.curve_chord),
            torsion: Torsion::new(rest, curves.polylines(), options.curve_chord),
            position: curves.position(rest, topology, is_held, [source, target], moved),
            pins: Pins::new(pin_targets::resolve(rest, triangles, asked.pins, source, target)),
            rigid: rigid(rest, asked.rigid_groups, held.carried),
        }
    }
}

/// The term of the caller's groups and of the stiff carried pieces, but for those of which a part is in a group already. The
/// pieces have the size that they have on the target body.
pub(super) fn rigid(rest: &[DVec3], groups: &[Vec<u32>], carried: &CarriedPlaces) -> Rigid {
    let mut is_grouped = vec![false; rest.len()];
    groups.iter().flatten().for_each(|&v| is_grouped[v as usize] = true);
    let (mut rest, mut groups) = (rest.to_vec(), groups.to_vec());
    for (vertices, scaled) in carried.stiff() {
        if vertices.iter().any(|&v| is_grouped[v as usize]) {
            continue;
        }
        vertices.iter().zip(scaled).for_each(|(&v, p)| rest[v as usize] = p);
        groups.push(vertices.to_vec());
    }
    Rigid::new(&rest, &groups)
}
