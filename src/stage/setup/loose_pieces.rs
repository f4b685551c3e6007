//! Which pieces of a garment are loose, such as buttons and belts, and what holds them.
//!
//! A piece is held to another one, its host, if
//! - its area is at most a quarter of the host's, and
//! - nine tenths of its area are as near to the host as a twentieth of the host's size, and as its own size (sizes are
//!   diagonals of bounding boxes).
//!
//! With several hosts the nearest counts. Hosts are among the largest pieces only. Vertices that are farther away than
//! that, such as the hanging end of a belt, are free.

use glam::DVec3;
use rayon::prelude::*;

use crate::energy::attachment::Hold;
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::{TriangleMesh, is_wide, triangle_area};
use crate::geometry::piece::Piece;
use crate::input::diagnostic::Diagnostic;

/// A loose piece has at most this fraction of its host's area.
const SMALL: f64 = 0.25;

/// A loose piece is at most this fraction of its host's size away from it.
const NEAR: f64 = 0.05;

/// The fraction of a loose piece's area that must be near.
const MOST: f64 = 0.9;

/// Number of pieces, largest first, that can be hosts: it bounds the search in a garment of thousands of sequins.
const HOSTS: usize = 32;

/// A host triangle whose doubled area is below this share of its longest edge squared is too thin to hold anything.
pub(super) const THIN: f64 = 1e-2;

/// The area around a vertex counts as at least this fraction of the mean square of the edges there: a piece of single edges or
/// of slivers is held too.
const LEAST_AREA: f64 = 1e-2;

/// A piece that is held to another.
#[derive(Clone, Debug, PartialEq)]
pub struct LoosePiece {
    /// Its vertices, ascending.
    pub vertices: Vec<u32>,
    /// Its triangle of lowest index.
    pub triangle: u32,
    /// The triangle of its host that is nearest to it.
    pub host: u32,
    /// The distance to that, from its nearest vertex.
    pub distance: f64,
}

/// The loose pieces of a garment.
#[derive(Clone, Debug, Default)]
pub struct LoosePieces {
    /// Those that are held, in the order of their lowest vertices.
    pub pieces: Vec<LoosePiece>,
    /// Those that hang on others by a part of themselves, found by [`super::hanging_pieces`].
    pub hanging: Vec<LoosePiece>,
    /// What holds each of their vertices that is near enough.
    pub holds: Vec<Hold>,
}

/// A piece that others can be held to.
pub(super) struct Host {
    pub piece: u32,
    pub tree: ClosestPoint,
    /// The garment's index of each triangle in the tree.
    pub triangles: Vec<u32>,
}

/// Where a vertex of a piece would be held.
#[derive(Clone, Copy)]
struct Anchor {
    distance: f64,
    triangle: u32,
}

/// A host for a piece: where on it each vertex would be held, how far it reaches, and the mean distance of the piece.
struct Match {
    anchors: Vec<Anchor>,
    reach: f64,
    distance: f64,
}

impl LoosePieces {
    /// The loose pieces of a garment with vertices `rest` and `triangles`, whose indices are below the number of vertices.
    pub fn find(rest: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let pieces = Piece::find(rest, triangles, []);
        if pieces.len() < 2 {
            return Self::default();
        }
        let areas = vertex_areas(rest, triangles);
        let hosts = hosts(rest, triangles, &pieces);
        let held: Vec<(Vec<Hold>, Option<LoosePiece>)> =
            pieces.par_iter().map(|piece| hold(piece, &pieces, &hosts, rest, triangles, &areas)).collect();
        let mut found = Self::default();
        for (holds, piece) in held {
            found.holds.extend(holds);
            found.pieces.extend(piece);
        }
        found
    }

    /// Both kinds.
    pub fn all(&self) -> impl Iterator<Item = &LoosePiece> {
        self.pieces.iter().chain(&self.hanging)
    }

    /// What to report about the pieces; `caller` gives the caller's index of a triangle.
    pub fn diagnostics(&self, caller: impl Fn(u32) -> u32) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let all: Vec<&LoosePiece> = self.all().collect();
        Diagnostic::list(&mut diagnostics, &all, |piece| Diagnostic::LoosePiece {
            vertices: piece.vertices.len(),
            triangle: caller(piece.triangle),
            host: caller(piece.host),
            distance: piece.distance,
        });
        diagnostics
    }
}

/// The rest area around each vertex.
pub(super) fn vertex_areas(rest: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut areas = vec![0.0; rest.len()];
    let mut squares = vec![(0.0, 0.0); rest.len()];
    for t in triangles {
        let share = triangle_area(t.map(|v| rest[v as usize])) / 3.0;
        for k in 0..3 {
            let [v, w] = [t[k], t[(k + 1) % 3]].map(|v| v as usize);
            areas[v] += share;
            if v != w {
                let square = rest[v].distance_squared(rest[w]);
                for end in [v, w] {
                    squares[end].0 += square;
                    squares[end].1 += 1.0;
                }
            }
        }
    }
    let around = |(area, (sum, count)): (f64, (f64, f64))| area.max(LEAST_AREA * sum / f64::max(count, 1.0));
    areas.into_iter().zip(squares).map(around).collect()
}

/// The largest pieces that can hold others.
fn hosts(rest: &[DVec3], triangles: &[[u32; 3]], pieces: &[Piece]) -> Vec<Host> {
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    let area = |k: u32| pieces[k as usize].area;
    order.sort_by(|&j, &k| area(k).total_cmp(&area(j)).then(j.cmp(&k)));
    order.truncate(HOSTS);
    let host = |&k: &u32| {
        let piece = &pieces[k as usize];
        pieces.iter().any(|other| may_hold(piece, other)).then(|| as_host(k, rest, triangles, pieces))?
    };
    order.par_iter().filter_map(host).collect()
}

/// The piece of index `k` with a tree over its triangles that are no slivers; none without any.
pub(super) fn as_host(k: u32, rest: &[DVec3], triangles: &[[u32; 3]], pieces: &[Piece]) -> Option<Host> {
    let corners = |&t: &u32| triangles[t as usize].map(|v| rest[v as usize]);
    let usable: Vec<u32> = pieces[k as usize].triangles.iter().filter(|t| is_wide(corners(t), THIN)).copied().collect();
    // The tree sees the vertices of its own triangles only.
    let mesh = TriangleMesh::from_corners(usable.iter().map(corners));
    (!usable.is_empty()).then(|| Host { piece: k, tree: ClosestPoint::new(&mesh), triangles: usable })
}

/// How far `host` reaches for `piece`.
pub(super) fn reach(host: &Piece, piece: &Piece) -> f64 {
    (NEAR * host.size()).min(piece.size())
}

/// The rule, as far as areas and bounding boxes decide it. A piece is never its own host.
fn may_hold(host: &Piece, piece: &Piece) -> bool {
    host.area > 0.0 && piece.area <= SMALL * host.area && host.gap(piece) <= reach(host, piece)
}

/// Holds `piece` to the nearest host, if it is loose.
fn hold(
    piece: &Piece,
    pieces: &[Piece],
    hosts: &[Host],
    rest: &[DVec3],
    triangles: &[[u32; 3]],
    areas: &[f64],
) -> (Vec<Hold>, Option<LoosePiece>) {
    let mut best: Option<Match> = None;
    for host in hosts {
        let body = &pieces[host.piece as usize];
        if may_hold(body, piece)
            && let Some(found) = match_host(piece, body, host, rest, areas)
            && best.as_ref().is_none_or(|b| found.distance < b.distance)
        {
            best = Some(found);
        }
    }
    let Some(best) = best else { return (Vec::new(), None) };
    let near = piece.vertices.iter().zip(&best.anchors).filter(|(_, anchor)| anchor.distance <= best.reach);
    let holds = near
        .map(|(&v, anchor)| Hold {
            vertex: v,
            triangle: triangles[anchor.triangle as usize],
            distance: anchor.distance,
            area: areas[v as usize],
        })
        .collect();
    let nearest = best.anchors.iter().min_by(|a, b| a.distance.total_cmp(&b.distance));
    let loose = piece.triangles.first().zip(nearest).map(|(&triangle, anchor)| LoosePiece {
        vertices: piece.vertices.clone(),
        triangle,
        host: anchor.triangle,
        distance: anchor.distance,
    });
    (holds, loose)
}

/// How `host` would hold `piece`; none where too much of the piece is out of reach.
fn match_host(piece: &Piece, body: &Piece, host: &Host, rest: &[DVec3], areas: &[f64]) -> Option<Match> {
    let reach = reach(body, piece);
    let anchors: Vec<Anchor> = piece
        .vertices
        .iter()
        .map(|&v| host.tree.closest(rest[v as usize]))
        .map(|found| found.map(|c| Anchor { distance: c.distance, triangle: host.triangles[c.triangle as usize] }))
        .collect::<Option<_>>()?;
    let (mut all, mut near, mut moment) = (0.0, 0.0, 0.0);
    for (&v, anchor) in piece.vertices.iter().zip(&anchors) {
        let area = areas[v as usize];
        all += area;
        if anchor.distance <= reach {
            near += area;
            moment += area * anchor.distance;
        }
    }
    (near > 0.0 && near >= MOST * all).then(|| Match { anchors, reach, distance: moment / near })
}
