//! Pieces that are around no bone and not held as a whole, such as a pouch on a belt, a badge, or a bag of several parts:
//! what each hangs on, and what gives it its size.
//!
//! The surface term is zero for every similarity, a point included. The body within a piece keeps it from shrinking; a piece
//! with no body in it would shrink until it touches its own skin. So:
//!
//! - A piece that comes as near to another one as a loose piece may be (see `loose_pieces`) hangs on that: the host with the
//!   largest area of the piece within that reach. What is within reach is held to the nearest triangles; what sticks out is
//!   held to one larger triangle of the host's vertices, as wide as the place where it hangs. So the piece has the host's
//!   place, direction and scale there, and the surface term gives it its own shape.
//! - Hosts are the pieces around a bone and the loose pieces, then those that hang on them, and so on.
//! - Of what is left, nothing is near. The largest piece keeps its rest size (in the space in which both skeletons are
//!   2 long: the bodies' scale), others may hang on it, and so on.

use glam::DVec3;
use rayon::prelude::*;

use super::loose_pieces::{Host, LoosePiece, LoosePieces, as_host, reach, vertex_areas};
use crate::energy::attachment::{Hold, SizeHold};
use crate::geometry::closest_point::Closest;
use crate::geometry::piece::Piece;
use crate::geometry::section::Section;
use crate::input::skeleton::Skeleton;

/// Points along a bone at which a piece is tested for being around it.
const SAMPLES: u32 = 8;

/// How far a bone reaches beyond a leaf joint, as a share of its length: hands, feet and the head have no bones in many
/// skeletons.
const LEAF_REACH: f64 = 1.0;

/// Hosts that are searched in each round, largest first.
const HOSTS: usize = 32;

/// Vertices of a piece that are held to the frame of the place where it hangs, at most.
const FRAMED: usize = 96;

/// The frame is at least so many times as wide as the mean edge of the host there.
const FRAME_EDGES: f64 = 1.5;

/// A frame whose third corner is nearer than this share of its length to the line of the first two is a line.
const MIN_WIDTH: f64 = 0.2;

/// The pieces that hang on others, and those that keep a size of their own.
#[derive(Clone, Debug, Default)]
pub struct HangingPieces {
    /// Those that hang on others, in the order of their lowest vertices.
    pub pieces: Vec<LoosePiece>,
    /// What holds their vertices.
    pub holds: Vec<Hold>,
    /// What keeps the size of the pieces that are near nothing.
    pub sizes: Vec<SizeHold>,
}

/// A piece that hangs, by its index.
type Found = (usize, Vec<Hold>, LoosePiece);

impl HangingPieces {
    /// The hanging pieces of a garment with vertices `rest` around `skeleton`; `loose` are those that are held already.
    pub fn find(rest: &[DVec3], triangles: &[[u32; 3]], skeleton: &Skeleton, loose: &LoosePieces) -> Self {
        let pieces = Piece::find(rest, triangles, []);
        let mut is_loose = vec![false; rest.len()];
        loose.pieces.iter().for_each(|piece| is_loose[piece.vertices[0] as usize] = true);
        let bones = skeleton.lengthened(LEAF_REACH);
        let mut rooted: Vec<bool> = pieces
            .par_iter()
            .map(|piece| is_loose[piece.vertices[0] as usize] || is_around_a_bone(piece, rest, triangles, &bones))
            .collect();
        if rooted.iter().all(|&is_rooted| is_rooted) {
            return Self::default();
        }
        let areas = vertex_areas(rest, triangles);
        let garment = Garment { rest, triangles, areas: &areas, pieces: &pieces };
        let (mut found, mut sizes) = (Vec::new(), Vec::new());
        let mut hosts: Vec<usize> = (0..pieces.len()).filter(|&k| rooted[k]).collect();
        loop {
            // What hangs on the hosts, on what hangs on them, and so on.
            while !hosts.is_empty() {
                let more = garment.hang(&mut hosts, &rooted);
                hosts = more.iter().map(|&(k, ..)| k).collect();
                hosts.iter().for_each(|&k| rooted[k] = true);
                found.extend(more);
            }
            let left = (0..pieces.len()).filter(|&k| !rooted[k]);
            let Some(largest) = left.min_by(|&j, &k| pieces[k].area.total_cmp(&pieces[j].area)) else { break };
            rooted[largest] = true;
            sizes.extend(size_holds(&pieces[largest], rest));
            hosts = vec![largest];
        }
        found.sort_by_key(|&(k, ..)| k);
        let mut all = Self { sizes, ..Self::default() };
        for (_, holds, piece) in found {
            all.holds.extend(holds);
            all.pieces.push(piece);
        }
        all
    }
}

/// Whether the body passes through `piece`: it encloses a point of one of `bones`, in the plane across that.
fn is_around_a_bone(piece: &Piece, rest: &[DVec3], triangles: &[[u32; 3]], bones: &[[DVec3; 2]]) -> bool {
    let mesh = piece.mesh(rest, triangles);
    bones.iter().any(|&[a, b]| {
        let Some([from, to]) = clipped(a, b, piece) else { return false };
        (0..SAMPLES).any(|k| {
            let point = a.lerp(b, from + (to - from) * (f64::from(k) + 0.5) / f64::from(SAMPLES));
            Section::cut(&mesh, point, b - a).encloses(point)
        })
    })
}

/// The part of the segment from `a` to `b` that lies in the bounding box of `piece`, in shares of the segment.
fn clipped(a: DVec3, b: DVec3, piece: &Piece) -> Option<[f64; 2]> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for k in 0..3 {
        let step = b[k] - a[k];
        let [low, high] = [piece.low[k] - a[k], piece.high[k] - a[k]];
        if step == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
        } else {
            let (s, t) = (low / step, high / step);
            (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
        }
    }
    (from <= to).then_some([from, to])
}

/// A garment and its pieces.
struct Garment<'a> {
    rest: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    areas: &'a [f64],
    pieces: &'a [Piece],
}

/// A host for a piece: the point on it that is closest to each vertex, and how far it reaches.
struct Place<'a> {
    host: &'a Host,
    closest: Vec<Closest>,
    reach: f64,
    /// The area of the piece that is within reach.
    area: f64,
}

impl Garment<'_> {
    /// The pieces that are not `rooted` and hang on one of `hosts`, of which the largest are searched.
    fn hang(&self, hosts: &mut Vec<usize>, rooted: &[bool]) -> Vec<Found> {
        hosts.sort_by(|&j, &k| self.pieces[k].area.total_cmp(&self.pieces[j].area).then(j.cmp(&k)));
        hosts.truncate(HOSTS);
        let near = |piece: &Piece, host: &Piece| host.area > 0.0 && host.gap(piece) <= reach(host, piece);
        let left: Vec<usize> = (0..self.pieces.len()).filter(|&k| !rooted[k]).collect();
        let hosts: Vec<Host> = hosts
            .par_iter()
            .filter(|&&h| left.iter().any(|&k| near(&self.pieces[k], &self.pieces[h])))
            .filter_map(|&h| as_host(h as u32, self.rest, self.triangles, self.pieces))
            .collect();
        let one = |&k: &usize| {
            let piece = &self.pieces[k];
            let mut best: Option<Place<'_>> = None;
            for host in &hosts {
                let body = &self.pieces[host.piece as usize];
                if near(piece, body)
                    && let Some(place) = self.place(piece, body, host)
                    && best.as_ref().is_none_or(|b| place.area > b.area)
                {
                    best = Some(place);
                }
            }
            best.and_then(|place| self.held(k, &place))
        };
        left.par_iter().filter_map(one).collect()
    }

    /// How `piece` would hang on `host`, if anything of it is within reach.
    fn place<'h>(&self, piece: &Piece, body: &Piece, host: &'h Host) -> Option<Place<'h>> {
        let reach = reach(body, piece);
        let closest: Vec<Closest> =
            piece.vertices.iter().map(|&v| host.tree.closest(self.rest[v as usize])).collect::<Option<_>>()?;
        let near = piece.vertices.iter().zip(&closest).filter(|(_, c)| c.distance <= reach);
        let area = near.map(|(&v, _)| self.areas[v as usize]).sum();
        (area > 0.0).then_some(Place { host, closest, reach, area })
    }

    /// What holds the piece of index `k` there.
    fn held(&self, k: usize, place: &Place<'_>) -> Option<Found> {
        let piece = &self.pieces[k];
        let nearest = place.closest.iter().min_by(|a, b| a.distance.total_cmp(&b.distance))?;
        let triangle_of = |c: &Closest| place.host.triangles[c.triangle as usize];
        let hold = |v: u32, triangle: [u32; 3], distance: f64, area: f64| Hold { vertex: v, triangle, distance, area };
        let (near, far): (Vec<_>, Vec<_>) =
            piece.vertices.iter().zip(&place.closest).partition(|(_, c)| c.distance <= place.reach);
        let mut holds: Vec<Hold> = near
            .iter()
            .map(|&(&v, c)| hold(v, self.triangles[triangle_of(c) as usize], c.distance, self.areas[v as usize]))
            .collect();
        let frame = self.frame(place, near.iter().map(|(_, c)| c.point));
        let frame = frame.unwrap_or(self.triangles[triangle_of(nearest) as usize]);
        let middle = frame.iter().map(|&v| self.rest[v as usize]).sum::<DVec3>() / 3.0;
        let step = far.len().div_ceil(FRAMED).max(1);
        for some in far.chunks(step) {
            let (&v, _) = some[0];
            let area = some.iter().map(|(v, _)| self.areas[**v as usize]).sum();
            holds.push(hold(v, frame, self.rest[v as usize].distance(middle), area));
        }
        let piece = LoosePiece {
            vertices: piece.vertices.clone(),
            triangle: *piece.triangles.first()?,
            host: triangle_of(nearest),
            distance: nearest.distance,
        };
        Some((k, holds, piece))
    }

    /// Three vertices of the host, far apart, around the place where a piece hangs, whose points on the host are `points`.
    fn frame(&self, place: &Place<'_>, points: impl Iterator<Item = DVec3> + Clone) -> Option<[u32; 3]> {
        let count = points.clone().count();
        let centre = points.clone().sum::<DVec3>() / count as f64;
        let host = &place.host.triangles;
        let corners = |t: &u32| self.triangles[*t as usize];
        let foot = host[place.host.tree.closest(centre)?.triangle as usize];
        let [a, b, c] = corners(&foot).map(|v| self.rest[v as usize]);
        let edge = (a.distance(b) + b.distance(c) + c.distance(a)) / 3.0;
        let radius = points.map(|p| p.distance(centre)).fold(FRAME_EDGES * edge, f64::max);
        let normal = |t: &u32| {
            let [a, b, c] = corners(t).map(|v| self.rest[v as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let outward = normal(&foot);
        // The side of the host that faces the same way: not the back of a thin one.
        let mut around: Vec<u32> = host.iter().filter(|t| normal(t).dot(outward) > 0.0).flat_map(corners).collect();
        around.sort_unstable();
        around.dedup();
        around.retain(|&v| self.rest[v as usize].distance(centre) <= radius);
        let at = |v: u32| self.rest[v as usize];
        let farthest = |from: &dyn Fn(DVec3) -> f64| {
            // The first of equals.
            around.iter().rev().copied().max_by(|&v, &w| from(at(v)).total_cmp(&from(at(w))))
        };
        let a = farthest(&|p| p.distance(centre))?;
        let b = farthest(&|p| p.distance(at(a)))?;
        let span = at(b) - at(a);
        let away = |p: DVec3| (p - at(a)).reject_from(span).length();
        let c = farthest(&away)?;
        (away(at(c)) > MIN_WIDTH * span.length()).then_some([a, b, c])
    }
}

/// The distances between three vertices of `piece`, far apart.
fn size_holds(piece: &Piece, rest: &[DVec3]) -> Vec<SizeHold> {
    let at = |v: u32| rest[v as usize];
    let farthest = |from: &dyn Fn(DVec3) -> f64| {
        piece.vertices.iter().rev().copied().max_by(|&v, &w| from(at(v)).total_cmp(&from(at(w)))).unwrap_or(0)
    };
    let centre = 0.5 * (piece.low + piece.high);
    let a = farthest(&|p| p.distance(centre));
    let b = farthest(&|p| p.distance(at(a)));
    let c = farthest(&|p| p.distance(at(a)).min(p.distance(at(b))));
    let hold = |vertices| SizeHold { vertices, area: piece.area };
    [[a, b], [b, c], [c, a]].map(hold).into()
}
