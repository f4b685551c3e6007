//! The shape terms: what holds the garment to its design.

use super::hanging_pieces::HangingPieces;
use super::loop_axis::choose_loop_axes;
use super::loose_pieces::LoosePieces;
use super::near_borders::NearBorders;
use super::pin_targets::{self, PinRequest};
use crate::energy::attachment::{Attachment, Borders};
use crate::energy::curve::{Curvature, Torsion};
use crate::energy::pin::Pins;
use crate::energy::position::{MovingAxis, Position};
use crate::energy::rigid::Rigid;
use crate::energy::surface::Surface;
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::geometry::sliver_caps::without_caps;
use crate::input::skeleton::Skeleton;
use crate::options::Options;

/// The shape terms, which inflation and fit share.
pub struct Shape {
    /// Surface shape (Eq. 2).
    pub surface: Surface,
    /// Loose pieces, held to their hosts.
    pub attachment: Attachment,
    /// Borders held to what they lie on, in the fit.
    pub borders: Borders,
    /// Curvature of the boundary curves (Eq. 5).
    pub curvature: Curvature,
    /// Torsion of the boundary curves.
    pub torsion: Torsion,
    /// Position of the boundary curves along their bones (Eq. 3).
    pub position: Position,
    /// Pinned vertices.
    pub pins: Pins,
    /// Rigid groups.
    pub rigid: Rigid,
}

impl Shape {
    /// The terms of `garment` as designed, between the skeletons `source` and `target`; and the pieces and borders that are
    /// held to others. `pins` has at most one entry a vertex, `rigid_groups` each vertex in one group at most.
    pub fn new(
        garment: &TriangleMesh,
        source: &Skeleton,
        target: &Skeleton,
        pins: &[PinRequest],
        rigid_groups: &[Vec<u32>],
        options: &Options,
    ) -> (Self, LoosePieces, NearBorders) {
        let (rest, triangles) = (&garment.positions, &garment.triangles);
        let topology = Topology::new(rest.len(), triangles);
        let mut loose = LoosePieces::find(rest, triangles);
        let hanging = HangingPieces::find(rest, triangles, source, &loose);
        loose.holds.extend(hanging.holds);
        loose.hanging = hanging.pieces;
        let mut is_held = vec![false; rest.len()];
        loose.all().flat_map(|piece| &piece.vertices).for_each(|&v| is_held[v as usize] = true);
        let near = NearBorders::find(rest, triangles, &topology, &is_held);
        let whole = without_caps(rest, triangles);
        let hinges = whole.map(|triangles| Topology::new(rest.len(), &triangles).hinges);
        let shape = Self {
            surface: Surface::new(rest, hinges.as_ref().unwrap_or(&topology.hinges), options.surface_form),
            attachment: Attachment::new(rest, &loose.holds, &hanging.sizes),
            borders: Borders(Attachment::new(rest, &near.holds, &[])),
            curvature: Curvature::new(rest, &topology.loops),
            torsion: Torsion::new(rest, &topology.loops),
            position: position(garment, &topology, &is_held, source, target),
            pins: Pins::new(pin_targets::resolve(rest, triangles, pins, source, target)),
            rigid: Rigid::new(rest, rigid_groups),
        };
        (shape, loose, near)
    }
}

/// The position term of the boundary loops that follow bones.
fn position(
    garment: &TriangleMesh,
    topology: &Topology,
    is_held: &[bool],
    source: &Skeleton,
    target: &Skeleton,
) -> Position {
    let rest = &garment.positions;
    let mut axes: Vec<MovingAxis> = Vec::new();
    let mut constraints = Vec::new();
    for (curve, axis) in topology.loops.iter().zip(choose_loop_axes(rest, &topology.loops, source, target)) {
        // A piece that is held to another one, such as a button, has no place of its own along a bone.
        if let Some(axis) = axis
            && !is_held[curve.vertices[0] as usize]
        {
            constraints.extend(curve.vertices.iter().map(|&v| (v, axes.len() as u32)));
            axes.push(axis.axis);
        }
    }
    Position::new(rest, &constraints, axes, &topology.mean_edge_lengths(rest))
}
