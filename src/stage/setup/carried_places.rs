//! Where carried pieces go.
//!
//! Each vertex goes along with the bones around it ([`BoneMap`]). Then the piece is brought to its clearance,
//!
//! ```text
//! D(p_v) = c_v = max(s k max(0, D_s(rest_v)) + offset, 2 dhat),
//! ```
//!
//! D the signed distance to the target body with what it wears, D_s that to the source body, s the scale of the similarity
//! nearest to the map of the piece, and k the option `designed_clearance`. Without a source body the piece touches the target
//! body where it comes nearest to it, for it is worn, and is as much looser elsewhere as the map has it. A soft piece moves vertex
//! by vertex, along normals of the body that are smoothed over the piece. A stiff one keeps the shape of that similarity, and
//! moves and turns as a whole: what is near to the body decides.
//!
//! Of a piece that is closed around a bone, as a hat with its crown filled is, what lay outside of the source body keeps its
//! shape in this way, and what lay inside, the filling, is held nowhere and gives way. Where the body leaves no place for that
//! shape, all of the piece is soft.

use glam::{DQuat, DVec3};

use super::bone_map::BoneMap;
use super::carried_pieces::CarriedPiece;
use super::source_body::SourceBody;
use crate::energy::pin::{Pin, Pins};
use crate::geometry::alignment::Similarity;
use crate::geometry::mesh::{TriangleMesh, vertex_areas};
use crate::geometry::quantile::quantile;
use crate::geometry::turn;
use crate::sdf::Field;

/// A displacement by this share of a piece's size costs as much as a strain of 1.
const LEVER: f64 = 0.25;
/// A stiff piece goes along with the bones that are the nearest ones of this share of it.
const SUPPORTS: f64 = 0.3;
/// It turns by this angle at most to lie against the body, in radians: so that a ring beside an ear does not turn over.
const MAX_TURN: f64 = 0.3;
/// A hat whose head is turned by less than this, in radians, is not turned with it.
const UPRIGHT: f64 = 0.35;
/// Rounds in which normals are smoothed over a piece.
const SMOOTHINGS: usize = 6;
/// Rounds in which a piece is brought to its clearance.
const SOFT_ROUNDS: usize = 8;
const STIFF_ROUNDS: usize = 60;
/// Rounds in which a stiff piece is moved clear of the body.
const CLEARING_ROUNDS: usize = 40;
/// Where that does not help, as with glasses whose temples are narrower than the head, it grows by this factor and is settled
/// again, so often at most.
const GROWTH: f64 = 1.04;
const GROWTHS: usize = 15;
/// Between points of a stiff piece that are to be clear of the body, and parts of a triangle's side at most.
const SPACING: f64 = 0.02;
const MAX_PARTS: usize = 16;
/// The smallest cosine between the way of a vertex and the body's normal.
const MIN_COSINE: f64 = 0.5;
/// A vertex of a stiff piece counts for its clearance with 1 / (1 + (d / r)^2)^2, d its clearance beyond the least, and r this
/// share of its size; the rest of it stays.
const NEAR: f64 = 0.1;
const STAYS: f64 = 0.02;
/// Without a source body, this share of the vertices of a soft piece is nearer than where it touches: single ones may be inside of another
/// part of the body, such as an arm.
const OUTLIERS: f64 = 0.05;

/// What is outside of the source body by more than this is no filling; the skeleton is 2 long.
const OUTSIDE: f64 = 1e-4;
/// And a piece is more than its filling where so large a share of its vertices is outside.
const SHELL: f64 = 0.5;

/// A carried piece with its places.
#[derive(Clone)]
struct Piece {
    carried: CarriedPiece,
    /// Its vertices that have a place, ascending: all, or the shell around a filling.
    vertices: Vec<u32>,
    /// They keep their shape.
    stiff: bool,
    /// All of a closed piece, to be taken where the body leaves no place for its shell.
    soft: Option<Box<Self>>,
    /// Its triangles, by positions in `vertices`.
    triangles: Vec<[u32; 3]>,
    rest: Vec<DVec3>,
    /// Where its vertices go.
    places: Vec<DVec3>,
    /// The area around each vertex.
    areas: Vec<f64>,
    /// The distance of each vertex from the source body, times the scale.
    designed: Option<Vec<f64>>,
    size: f64,
    /// The similarity nearest to its map along the bones.
    similarity: Similarity,
}

/// A carried piece and its triangles, by vertices of the garment.
struct Own<'a> {
    positions: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    carried: &'a CarriedPiece,
}

/// The carried pieces of a garment.
#[derive(Clone, Default)]
pub struct CarriedPlaces {
    pieces: Vec<Piece>,
}

impl CarriedPlaces {
    /// The places of the `carried` pieces of `garment` by `map` alone. `source_body` is what it was designed on, and
    /// `looseness` the option `designed_clearance`.
    pub fn new(
        garment: &TriangleMesh,
        carried: &[CarriedPiece],
        map: &BoneMap,
        source_body: Option<&SourceBody>,
        looseness: f64,
    ) -> Self {
        let mut owner = vec![u32::MAX; garment.positions.len()];
        for (k, piece) in (0u32..).zip(carried) {
            piece.vertices.iter().for_each(|&v| owner[v as usize] = k);
        }
        let mut triangles: Vec<Vec<[u32; 3]>> = vec![Vec::new(); carried.len()];
        for t in &garment.triangles {
            if let Some(own) = triangles.get_mut(owner[t[0] as usize] as usize) {
                own.push(*t);
            }
        }
        let place = |(carried, triangles): (&CarriedPiece, &Vec<[u32; 3]>)| {
            let own = Own { positions: &garment.positions, triangles, carried };
            let soft = Piece::new(&own, &carried.vertices, carried.stiff, map, source_body, looseness);
            let outside =
                |&v: &u32| source_body?.signed_distance(garment.positions[v as usize]).gt(&OUTSIDE).then_some(v);
            let shell: Vec<u32> = carried.vertices.iter().filter_map(outside).collect();
            if !carried.closed || (shell.len() as f64) < SHELL * carried.vertices.len() as f64 {
                return soft;
            }
            let mut stiff = Piece::new(&own, &shell, true, map, source_body, looseness);
            stiff.stand_upright();
            Piece { soft: Some(Box::new(soft)), ..stiff }
        };
        Self { pieces: carried.iter().zip(&triangles).map(place).collect() }
    }

    /// True without any.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// The carried pieces.
    pub fn pieces(&self) -> impl Iterator<Item = &CarriedPiece> {
        self.pieces.iter().map(|piece| &piece.carried)
    }

    /// The vertices of each stiff piece, and its rest positions at the size that it has on the target body.
    pub fn stiff(&self) -> impl Iterator<Item = (&[u32], Vec<DVec3>)> {
        let scaled = |piece: &Piece| piece.rest.iter().map(|&p| piece.similarity.scale * p).collect();
        self.pieces.iter().filter(|piece| piece.stiff).map(move |piece| (&piece.vertices[..], scaled(piece)))
    }

    /// Vertices of fillings, which have no place.
    pub fn fillings(&self) -> impl Iterator<Item = u32> {
        let of = |piece: &Piece| -> Vec<u32> {
            let own = |v: &u32| piece.vertices.binary_search(v).is_err();
            piece.carried.vertices.iter().copied().filter(own).collect()
        };
        self.pieces.iter().flat_map(of)
    }

    /// Brings all pieces to their clearances from the body of `field`: `least` at least, and the designed one and `offset`.
    pub fn settle(&mut self, field: &Field, least: f64, offset: f64) {
        for piece in &mut self.pieces {
            piece.settle(field, least, offset);
        }
    }

    /// The term that draws the garment's vertices there.
    pub fn term(&self) -> Pins {
        let mut elements = Vec::new();
        for piece in &self.pieces {
            let lever = LEVER * piece.size;
            let vertices = piece.vertices.iter().zip(&piece.rest).zip(&piece.places).zip(&piece.areas);
            elements.extend(vertices.map(|(((&vertex, &start), &end), area)| {
                let weight = area / (lever * lever);
                Pin { vertex, start, end, weight }
            }));
        }
        Pins::carrying(elements)
    }
}

impl Piece {
    /// The places of `vertices` of a carried piece by `map` alone.
    fn new(
        own: &Own<'_>,
        vertices: &[u32],
        stiff: bool,
        map: &BoneMap,
        source_body: Option<&SourceBody>,
        looseness: f64,
    ) -> Self {
        let local = |v: u32| vertices.binary_search(&v).ok().map(|at| at as u32);
        let corners = |t: &[u32; 3]| Some([local(t[0])?, local(t[1])?, local(t[2])?]);
        let triangles: Vec<[u32; 3]> = own.triangles.iter().filter_map(corners).collect();
        let rest: Vec<DVec3> = vertices.iter().map(|&v| own.positions[v as usize]).collect();
        let areas = padded_areas(&rest, &triangles);
        let stiff_map = stiff.then(|| map.around(&rest, &areas, SUPPORTS));
        let map = stiff_map.as_ref().unwrap_or(map);
        let mapped: Vec<DVec3> = rest.iter().map(|&p| map.apply(p)).collect();
        let similarity = Similarity::nearest(&rest, &mapped, &areas, None);
        let outside = |body: &SourceBody, p: DVec3| body.signed_distance(p).max(0.0);
        let designed = |body: &SourceBody| -> Vec<f64> {
            rest.iter().map(|&p| similarity.scale * looseness * outside(body, p)).collect()
        };
        Self {
            carried: own.carried.clone(),
            vertices: vertices.to_vec(),
            stiff,
            soft: None,
            designed: source_body.map(designed),
            size: size(&rest),
            triangles,
            places: if stiff { rest.iter().map(|&p| similarity.apply(p)).collect() } else { mapped },
            rest,
            areas,
            similarity,
        }
    }

    /// Takes back a small turn: the bone of a head ends in the middle of what moves with it, hair and all, and says no more of
    /// how the head stands.
    fn stand_upright(&mut self) {
        if turn::angle_apart(DQuat::IDENTITY, self.similarity.rotation) < UPRIGHT {
            self.similarity.rotation = DQuat::IDENTITY;
            self.places = self.rest.iter().map(|&p| self.similarity.apply(p)).collect();
        }
    }

    fn settle(&mut self, field: &Field, least: f64, offset: f64) {
        let wanted = self.wanted(field, least, offset);
        if !self.stiff {
            self.settle_soft(field, &wanted);
            return;
        }
        self.settle_stiff(field, &wanted);
        for _ in 0..GROWTHS {
            if self.clear(field, least) {
                return;
            }
            self.similarity.scale *= GROWTH;
            self.settle_stiff(field, &wanted);
        }
        if let Some(soft) = self.soft.take() {
            *self = *soft;
            self.settle(field, least, offset);
        }
    }

    /// The distance from the body that each vertex is to have.
    fn wanted(&self, field: &Field, least: f64, offset: f64) -> Vec<f64> {
        if let Some(designed) = &self.designed {
            return designed.iter().map(|d| (d + offset).max(least)).collect();
        }
        let distances: Vec<f64> = self.places.iter().map(|&p| field.value(p)).collect();
        let outliers = if self.stiff { 0.0 } else { OUTLIERS };
        let touching = quantile(distances.iter().map(|&d| (d, 1.0)).collect(), outliers).unwrap_or(0.0);
        distances.iter().map(|d| (d - touching).max(0.0) + offset.max(least)).collect()
    }

    fn settle_soft(&mut self, field: &Field, wanted: &[f64]) {
        for _ in 0..SOFT_ROUNDS {
            let now: Vec<(f64, DVec3)> = self.places.iter().map(|&p| field.value_gradient(p)).collect();
            let slopes: Vec<DVec3> = now.iter().map(|(_, slope)| slope.normalize_or_zero()).collect();
            let normals = self.smoothed(slopes.clone());
            for (k, place) in self.places.iter_mut().enumerate() {
                // Where the two disagree the way leans towards the body's own normal: along one that points away from it the
                // distance would go the other way, and more with each round.
                let cosine = normals[k].dot(slopes[k]);
                let direction = normals[k] + (MIN_COSINE - cosine).max(0.0) * slopes[k];
                *place += direction * ((wanted[k] - now[k].0) / cosine.max(MIN_COSINE));
            }
        }
    }

    fn settle_stiff(&mut self, field: &Field, wanted: &[f64]) {
        let nearest = wanted.iter().copied().fold(f64::INFINITY, f64::min);
        let reach = NEAR * self.similarity.scale * self.size;
        let counts = |wanted: &f64| {
            let ratio = (wanted - nearest) / reach;
            1.0 / (1.0 + ratio * ratio).powi(2)
        };
        let counts: Vec<f64> = wanted.iter().map(counts).collect();
        let weights: Vec<f64> = counts.iter().zip(&self.areas).map(|(c, area)| (c + STAYS) * area).collect();
        for _ in 0..STIFF_ROUNDS {
            let moved: Vec<DVec3> = (0..self.places.len())
                .map(|k| {
                    let (distance, slope) = field.value_gradient(self.places[k]);
                    let share = counts[k] / (counts[k] + STAYS);
                    self.places[k] + share * (wanted[k] - distance) * slope.normalize_or_zero()
                })
                .collect();
            let mut placed = Similarity::nearest(&self.rest, &moved, &weights, Some(self.similarity.scale));
            // A hat stands level, whatever the hair beneath it is like.
            let most = if self.soft.is_some() { 0.0 } else { MAX_TURN };
            placed.rotation = turned(self.similarity.rotation, placed.rotation, most);
            self.places = self.rest.iter().map(|&p| placed.apply(p)).collect();
        }
    }

    /// Moves a stiff piece as a whole until nothing of its surface is nearer than `least`, each time as its nearest point asks
    /// for: an edge of the body may be inside of a triangle whose corners are outside. False where that is not to be had; then
    /// it stays where it was.
    fn clear(&mut self, field: &Field, least: f64) -> bool {
        let mut points = self.samples();
        let mut moved = DVec3::ZERO;
        for _ in 0..CLEARING_ROUNDS {
            let distances = points.iter().map(|&p| field.value(p)).enumerate();
            let Some((nearest, distance)) = distances.min_by(|a, b| a.1.total_cmp(&b.1)) else { return true };
            if distance >= least {
                self.places.iter_mut().for_each(|p| *p += moved);
                return true;
            }
            let (_, slope) = field.value_gradient(points[nearest]);
            let step = slope.normalize_or_zero() * (1.1 * least - distance);
            points.iter_mut().for_each(|p| *p += step);
            moved += step;
        }
        false
    }

    /// Its vertices, and points of its triangles at most [`SPACING`] apart.
    fn samples(&self) -> Vec<DVec3> {
        let mut points = self.places.clone();
        for t in &self.triangles {
            let [a, b, c] = t.map(|v| self.places[v as usize]);
            let longest = (b - a).length().max((c - b).length()).max((a - c).length());
            let parts = ((longest / SPACING).ceil() as usize).clamp(1, MAX_PARTS);
            for i in 0..=parts {
                for j in 0..=parts - i {
                    let [v, w] = [i, j].map(|k| k as f64 / parts as f64);
                    points.push(a + v * (b - a) + w * (c - a));
                }
            }
        }
        points
    }

    /// Unit vectors of the vertices, averaged over the triangles at them.
    fn smoothed(&self, mut vectors: Vec<DVec3>) -> Vec<DVec3> {
        for _ in 0..SMOOTHINGS {
            let mut sums = vectors.clone();
            for t in &self.triangles {
                let mean = t.iter().map(|&v| vectors[v as usize]).sum::<DVec3>();
                t.iter().for_each(|&v| sums[v as usize] += mean);
            }
            vectors = sums.into_iter().map(|sum| sum.normalize_or_zero()).collect();
        }
        vectors
    }
}

/// `to`, or where that is farther from `from` than `most`, the rotation so far on the way.
fn turned(from: DQuat, to: DQuat, most: f64) -> DQuat {
    let angle = turn::angle_apart(from, to);
    if angle > most { turn::between(from, to, most / angle) } else { to }
}

/// The diagonal of the bounding box.
fn size(points: &[DVec3]) -> f64 {
    let low = points.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = points.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    low.distance(high)
}

/// A third of the triangles at each vertex, and a little of the mean: a vertex of slivers is carried too.
fn padded_areas(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let areas = vertex_areas(points, triangles);
    let mean = areas.iter().sum::<f64>() / areas.len().max(1) as f64;
    areas.iter().map(|area| area.max(0.01 * mean)).collect()
}
