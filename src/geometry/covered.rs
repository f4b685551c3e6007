//! Which triangles of a body a garment covers, so that a game may hide them.
//!
//! A triangle is covered where no line of sight leads to it from outside. It is looked at from points on it, in directions
//! spread evenly over the side that it faces; in each of them there has to be the garment, or a part of the body that is in
//! the garment too. A hand does not close a sleeve, and an arm not the opening that it comes out of: in another pose it will
//! be elsewhere. What has the garment before it but not around it, such as an arm beside a vest, is not in it. Neither the
//! winding of the garment nor the number of its pieces makes a difference.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::closest_point::ClosestPoint;
use super::cover::direction;
use super::mesh::TriangleMesh;
use crate::control::{Cancel, Cancelled};

/// Directions in which a point looks, a bit each.
pub const DIRECTIONS: usize = 128;

/// A point is in the garment if it sees it in this many directions.
const AROUND: u32 = DIRECTIONS as u32 / 2;

/// The sine of ten degrees: at a flatter angle skin is not looked at. Along a straight sleeve one sees ever farther in, and ever
/// less of it.
pub const FLAT: f64 = 0.174;

/// Corners look from this far inside of their triangle, in its size: at the corner itself, a neighbour could be missed.
const INSET: f64 = 0.05;

/// Points to look from lie above the surface, by this share of the body's longest side: not in the triangles beside it.
const LIFT: f64 = 1e-7;

/// A triangle whose longest edge is above this share of the garment's longest side is looked at from points within too, one for
/// each such length along an edge.
const COARSE: f64 = 0.03;

/// Neighbours that are looked at one after the other. Fixed, so that the work is the same for any number of threads.
const CHUNK: usize = 64;

/// A triangle is cut into at most this many pieces along an edge.
const MAX_PIECES: usize = 6;

/// What counts as covered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoveredOptions {
    /// This many rings of triangles are left beside those that are not covered.
    pub margin: u32,
    /// The share of directions, from 0 to 1, in which a covered triangle may be seen: 0 where nobody must ever see it, more
    /// where nobody looks, as from the floor into a skirt.
    pub openness: f64,
}

impl Default for CoveredOptions {
    fn default() -> Self {
        Self { margin: 1, openness: 0.0 }
    }
}

/// What is dressed: a body, with what it wears beneath the garment.
#[derive(Clone, Debug)]
pub struct Wearer<'a> {
    /// All of it.
    pub mesh: &'a TriangleMesh,
    /// The triangles that are asked about.
    pub asked: Range<u32>,
    /// Whether these are seen from both sides, as cloth is; skin is seen from the side that it faces.
    pub is_cloth: bool,
}

/// The triangles of those that are asked about, ascending, that `garment` covers. Both meshes are in one coordinate system; the
/// triangles of a body face outwards, or all of them inwards. Triangles without area are covered where those around them are.
///
/// # Errors
/// [`Cancelled`].
pub fn covered_triangles(
    wearer: &Wearer<'_>,
    garment: &TriangleMesh,
    options: &CoveredOptions,
    cancel: &Cancel,
) -> Result<Vec<u32>, Cancelled> {
    let asked = &wearer.mesh.triangles[wearer.asked.start as usize..wearer.asked.end as usize];
    let scene = Scene::new(wearer, asked, garment, cancel)?;
    let triangles: Vec<u32> = wearer.asked.clone().collect();
    let are_covered = |triangles: &[u32]| {
        cancel.check()?;
        let (mut garment, mut inside) = (LastMet::default(), LastMet::default());
        let mut is_covered = |&t: &u32| !scene.is_seen(t, options.openness, &mut garment, &mut inside);
        Ok(triangles.iter().map(&mut is_covered).collect::<Vec<bool>>())
    };
    let parts = triangles.par_chunks(CHUNK).map(are_covered).collect::<Result<Vec<Vec<bool>>, Cancelled>>()?;
    let mut covered = parts.concat();
    if options.margin > 0 {
        let places = places(wearer.mesh);
        (0..options.margin).for_each(|_| take_ring_off(asked, &places, &mut covered));
    }
    Ok(wearer.asked.clone().zip(covered).filter(|(_, covered)| *covered).map(|(t, _)| t).collect())
}

/// The wearer in the garment.
struct Scene<'a> {
    wearer: &'a Wearer<'a>,
    garment: ClosestPoint,
    /// What of the wearer is in the garment.
    inside: ClosestPoint,
    is_inside: Vec<bool>,
    directions: Vec<DVec3>,
    /// In which of the directions that matter each vertex sees the garment.
    seen: Vec<u128>,
    /// 1, or -1 where the triangles that are asked about face inwards.
    side: f64,
    lift: f64,
    /// Triangles with a longer edge are looked at from points within.
    coarse: f64,
}

impl<'a> Scene<'a> {
    fn new(
        wearer: &'a Wearer<'a>,
        asked: &[[u32; 3]],
        garment: &TriangleMesh,
        cancel: &Cancel,
    ) -> Result<Self, Cancelled> {
        let mesh = wearer.mesh;
        let [(low, high), (mesh_low, mesh_high)] = [garment, mesh].map(bounds);
        let tree = ClosestPoint::new(garment);
        let directions: Vec<DVec3> = (0..DIRECTIONS).map(|k| direction(k, DIRECTIONS)).collect();
        let volume = mesh.with_triangles(asked.iter().copied()).signed_volume();
        let side = if volume < 0.0 { -1.0 } else { 1.0 };
        // Outside of the box a plane separates it from the garment, and it sees that in less than half of the directions.
        let is_used = mesh.used_vertices();
        let near = |(p, used): (&DVec3, &bool)| *used && p.cmpge(low).all() && p.cmple(high).all();
        let is_near: Vec<bool> = mesh.positions.iter().zip(&is_used).map(near).collect();
        // Into which directions the triangles at each vertex look.
        let mut wanted = vec![0u128; mesh.positions.len()];
        let of_asked = asked.par_iter().with_min_len(CHUNK).map(|t| {
            if !t.iter().all(|&v| is_near[v as usize]) {
                return 0;
            }
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            let normal = (side * (b - a).cross(c - a)).normalize_or_zero();
            let front = facing(&directions, normal);
            if wearer.is_cloth { front | facing(&directions, -normal) } else { front }
        });
        let of_asked: Vec<u128> = of_asked.collect();
        for (triangle, of) in asked.iter().zip(of_asked) {
            triangle.iter().for_each(|&v| wanted[v as usize] |= of);
        }
        let look = |((positions, are_near), wanted): ((&[DVec3], &[bool]), &[u128])| {
            cancel.check()?;
            let mut met = LastMet::default();
            let mut looks = |((&p, &near), &wanted): ((&DVec3, &bool), &u128)| {
                if near { met.directions_around(&tree, &directions, wanted, p) } else { 0 }
            };
            Ok(positions.iter().zip(are_near).zip(wanted).map(&mut looks).collect::<Vec<u128>>())
        };
        let places = mesh.positions.par_chunks(CHUNK).zip(is_near.par_chunks(CHUNK)).zip(wanted.par_chunks(CHUNK));
        let seen = places.map(look).collect::<Result<Vec<Vec<u128>>, Cancelled>>()?.concat();
        let is_around = |t: &[u32; 3]| t.iter().all(|&v| seen[v as usize].count_ones() >= AROUND);
        let is_inside: Vec<bool> = mesh.triangles.iter().map(is_around).collect();
        let inner = mesh.triangles.iter().zip(&is_inside).filter(|(_, inside)| **inside).map(|(&t, _)| t);
        let inner = mesh.with_triangles(inner);
        Ok(Self {
            inside: ClosestPoint::new(&inner),
            wearer,
            garment: tree,
            is_inside,
            directions,
            seen,
            side,
            lift: LIFT * (mesh_high - mesh_low).max_element(),
            coarse: COARSE * (high - low).max_element(),
        })
    }

    /// Whether a triangle can be seen from outside of the garment.
    fn is_seen(&self, triangle: u32, openness: f64, garment: &mut LastMet, inside: &mut LastMet) -> bool {
        if !self.is_inside[triangle as usize] {
            return true;
        }
        let [a, b, c] = self.wearer.mesh.corners(triangle);
        let normal = (self.side * (b - a).cross(c - a)).normalize_or_zero();
        let sides: &[DVec3] = if self.wearer.is_cloth { &[normal, -normal] } else { &[normal] };
        sides.iter().any(|&normal| self.is_seen_from(triangle, normal, openness, garment, inside))
    }

    /// The same from the side to which `normal` points.
    fn is_seen_from(
        &self,
        triangle: u32,
        normal: DVec3,
        openness: f64,
        garment: &mut LastMet,
        inside: &mut LastMet,
    ) -> bool {
        let corners = self.wearer.mesh.corners(triangle);
        let [a, b, c] = corners;
        let facing = facing(&self.directions, normal);
        let allowed = (openness * f64::from(facing.count_ones())) as u32;
        // In which of the directions without garment nothing of the wearer is in the way either.
        let mut is_open = |p: DVec3, without: u128| {
            let p = p + self.lift * normal;
            without.count_ones() > allowed
                && inside.directions_without(&self.inside, &self.directions, without, p).count_ones() > allowed
        };
        let middle = (a + b + c) / 3.0;
        let vertices = self.wearer.mesh.triangles[triangle as usize];
        if vertices.iter().zip(corners).any(|(&v, p)| is_open(p.lerp(middle, INSET), facing & !self.seen[v as usize])) {
            return true;
        }
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let pieces = ((longest / self.coarse) as usize).min(MAX_PIECES);
        points_within(corners, pieces)
            .any(|p| is_open(p, garment.directions_without(&self.garment, &self.directions, facing, p)))
    }
}

/// What was met last in each direction: a point beside mostly meets the same.
struct LastMet([u32; DIRECTIONS]);

impl Default for LastMet {
    fn default() -> Self {
        Self([u32::MAX; DIRECTIONS])
    }
}

impl LastMet {
    /// Those of the directions `of`, a bit each, in which `p` does not see `mesh`.
    fn directions_without(&mut self, mesh: &ClosestPoint, directions: &[DVec3], of: u128, p: DVec3) -> u128 {
        let mut without = 0;
        for (k, (&d, last)) in directions.iter().zip(&mut self.0).enumerate() {
            if of >> k & 1 == 1 && !mesh.meets_ray_near(p, d, last) {
                without |= 1 << k;
            }
        }
        without
    }

    /// The directions in which `p` sees `mesh`; none where these are too few for being in it. Of those that are not `wanted`, only
    /// as many as it takes to know that.
    fn directions_around(&mut self, mesh: &ClosestPoint, directions: &[DVec3], wanted: u128, p: DVec3) -> u128 {
        let (mut seen, mut left) = (0u128, DIRECTIONS as u32 - AROUND);
        for of in [wanted, !wanted] {
            for (k, (&d, last)) in directions.iter().zip(&mut self.0).enumerate().filter(|(k, _)| of >> k & 1 == 1) {
                if wanted >> k & 1 == 0 && seen.count_ones() >= AROUND {
                    return seen;
                }
                if mesh.meets_ray_near(p, d, last) {
                    seen |= 1 << k;
                } else if left == 0 {
                    return 0;
                } else {
                    left -= 1;
                }
            }
        }
        seen
    }
}

/// The directions in which a surface with this normal is looked at, a bit each.
fn facing(directions: &[DVec3], normal: DVec3) -> u128 {
    let bits = directions.iter().enumerate().map(|(k, d)| u128::from(d.dot(normal) > FLAT) << k);
    bits.fold(0, |all, bit| all | bit)
}

/// The middles of the pieces into which a triangle is cut, so many along each edge.
pub fn points_within([a, b, c]: [DVec3; 3], pieces: usize) -> impl Iterator<Item = DVec3> {
    let step = 1.0 / pieces as f64;
    let at = move |i: usize, j: usize, share: f64| {
        a + ((i as f64 + share) * step) * (b - a) + ((j as f64 + share) * step) * (c - a)
    };
    let upright = (0..pieces).flat_map(move |i| (0..pieces - i).map(move |j| at(i, j, 1.0 / 3.0)));
    let turned = (1..pieces).flat_map(move |i| (0..pieces - i).map(move |j| at(i - 1, j, 2.0 / 3.0)));
    upright.chain(turned)
}

fn bounds(mesh: &TriangleMesh) -> (DVec3, DVec3) {
    let points = || mesh.triangles.iter().flatten().map(|&v| mesh.positions[v as usize]);
    (points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max))
}

/// The lowest vertex in the place of each vertex: where texture seams split a mesh, its rings go on.
fn places(mesh: &TriangleMesh) -> Vec<u32> {
    let key = |v: u32| mesh.positions[v as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    order.sort_unstable_by_key(|&v| (key(v), v));
    let mut places = vec![0; order.len()];
    for one in order.chunk_by(|&a, &b| key(a) == key(b)) {
        one.iter().for_each(|&v| places[v as usize] = one[0]);
    }
    places
}

/// Takes back what shares a vertex with a triangle that is not covered.
fn take_ring_off(triangles: &[[u32; 3]], places: &[u32], covered: &mut [bool]) {
    let mut is_open = vec![false; places.len()];
    let place = |v: &u32| places[*v as usize] as usize;
    for (triangle, _) in triangles.iter().zip(covered.iter()).filter(|(_, covered)| !**covered) {
        triangle.iter().for_each(|v| is_open[place(v)] = true);
    }
    for (triangle, covered) in triangles.iter().zip(covered.iter_mut()) {
        *covered &= !triangle.iter().any(|v| is_open[place(v)]);
    }
}
