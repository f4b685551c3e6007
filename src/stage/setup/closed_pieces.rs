//! Pieces that are closed around a bone and have no opening that would be a cuff, a hem or a collar, such as a hat that is modelled as
//! a solid body, its crown filled.
//!
//! No boundary holds their place along the bone, and no shape term their size, so that a growing head would push such a hat aside
//! and leave it as a speck. They are carried.

use glam::DVec3;

use super::carried_pieces::CarriedPiece;
use super::loop_axis::HOLE;
use super::loose_pieces::LoosePieces;
use super::shell_rims::{Rimless, ShellRims};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::geometry::piece::Piece;
use crate::input::skeleton::Skeleton;

/// This share of such a piece is nearest to its bone: what is closed around several, as a body suit is, is another thing.
const AT_BONE: f64 = 0.8;

/// The closed pieces of `garment` around single bones of `source`, in the order of their lowest vertices, but for those that are
/// `loose` or `carried` already. `source_body` is what it was designed on.
pub fn find(
    garment: &TriangleMesh,
    loose: &LoosePieces,
    carried: &[CarriedPiece],
    source: &Skeleton,
    source_body: Option<&ClosestPoint>,
) -> Vec<CarriedPiece> {
    let topology = Topology::new(garment.positions.len(), &garment.triangles);
    let mut is_held = vec![false; garment.positions.len()];
    loose.all().flat_map(|piece| &piece.vertices).for_each(|&v| is_held[v as usize] = true);
    carried.iter().flat_map(|piece| &piece.vertices).for_each(|&v| is_held[v as usize] = true);
    if !has_closed(garment, &topology, &is_held) {
        return Vec::new();
    }
    let without = ShellRims::find(garment, &topology, &is_held, source).without;
    // What is held to another piece goes with it.
    let holds = loose.all().map(|piece| [piece.vertices[0], garment.triangles[piece.host as usize][0]]);
    let parts = Piece::find(&garment.positions, &garment.triangles, holds);
    let of = |rimless: &Rimless| {
        let own = |part: &&Piece| part.triangles.binary_search(&rimless.triangle).is_ok();
        carry(garment, parts.iter().find(own)?, rimless.bone, source, source_body)
    };
    let mut found: Vec<CarriedPiece> = without.iter().filter_map(of).collect();
    found.sort_by_key(|piece| piece.vertices[0]);
    // Of two in one part, such as the sides of a shell that are not joined, one stands for both.
    found.dedup_by_key(|piece| piece.vertices[0]);
    found
}

/// Whether a piece is held by nothing and has no boundary that is wider than a hole: few garments have one, and to look for
/// rims takes long.
fn has_closed(garment: &TriangleMesh, topology: &Topology, is_held: &[bool]) -> bool {
    let width = |vertices: &[u32]| {
        let points = || vertices.iter().map(|&v| garment.positions[v as usize]);
        let centre = points().sum::<DVec3>() / vertices.len().max(1) as f64;
        2.0 * points().map(|p| p.distance(centre)).fold(0.0, f64::max)
    };
    let wide = topology.loops.iter().filter(|boundary| width(&boundary.vertices) >= HOLE);
    let mut is_open = vec![false; garment.positions.len()];
    wide.for_each(|boundary| is_open[boundary.vertices[0] as usize] = true);
    let pieces = Piece::find(&garment.positions, &garment.triangles, []);
    pieces.iter().any(|piece| {
        let is = |of: &[bool]| piece.vertices.iter().any(|&v| of[v as usize]);
        piece.size() >= HOLE && !is(is_held) && !is(&is_open)
    })
}

/// How `part` is carried, closed around `bone`; none where much of it is elsewhere.
fn carry(
    garment: &TriangleMesh,
    part: &Piece,
    bone: u32,
    source: &Skeleton,
    source_body: Option<&ClosestPoint>,
) -> Option<CarriedPiece> {
    let places = || part.vertices.iter().map(|&v| garment.positions[v as usize]);
    let nearest: Vec<(u32, f64)> = places().filter_map(|p| source.nearest_bone(p)).collect();
    let at_bone = nearest.iter().filter(|(nearest, _)| *nearest == bone).count();
    if (at_bone as f64) < AT_BONE * nearest.len() as f64 {
        return None;
    }
    let from_bone = nearest.iter().map(|(_, distance)| *distance).fold(f64::INFINITY, f64::min);
    let from_body = source_body.map(|body| places().map(|p| body.distance(p)).fold(f64::INFINITY, f64::min));
    Some(CarriedPiece {
        vertices: part.vertices.clone(),
        triangle: part.triangles[0],
        bone,
        distance: from_body.unwrap_or(from_bone),
        // Where the body is in its filling, that gives way to it.
        stiff: false,
        closed: true,
    })
}
