//! Caps: triangles that close an opening through which a bone goes, as at the neck, the waist, the cuffs and the hems of
//! low-poly clothes.
//!
//! Where the shrunk avatar passes through the garment, the patch around that place is looked at: all that is reached over
//! edges that bend little. It is a cap where it is flat, small beside its piece of the garment, bounded by sharp edges, and
//! where a bone goes across it and more of the skeleton out through it than a hat or a mitten would leave outside. Where the
//! edges are bevelled, so that the cap goes over into the cloth in two bends or three, it is what faces as its middle does.
//! Anything else is cloth.

use glam::DVec3;

use crate::geometry::mesh::{Topology, TriangleMesh, label_pieces, triangle_area};
use crate::geometry::section::Section;
use crate::geometry::turn;
use crate::input::skeleton::Skeleton;
use crate::maths;

/// A patch ends at edges that bend by more than one of these, in degrees; of those that give a cap, the one with the
/// flattest patch and the sharpest rim is taken.
const BENDS: [f64; 3] = [40.0, 30.0, 20.0];
/// Edges that bend by more than this, in degrees, are sharp.
const SHARP: f64 = 35.0;
/// The share of the rim's length that must be sharp.
const MIN_SHARP: f64 = 0.5;
/// With bevelled edges a patch ends where triangles face elsewhere than its middle by more than this, in degrees. Bevels are around
/// this share of the middle's rim...
const BEVELLED: f64 = 50.0;
const MIN_BEVEL: f64 = 0.9;
/// ... and end, for this share of their own rim, at triangles that face elsewhere by more than this.
const CLOTH: f64 = 55.0;
const MIN_CLOTH: f64 = 0.8;
/// Its middle is flat, and is this share of it: a ball has no middle.
const MIN_MIDDLE: f64 = 0.3;
/// The length of a patch's area vector over its area must be this at least. 1 is flat, half a ball has 0.5.
const MIN_FLATNESS: f64 = 0.85;
/// And that of the middle of a bevelled one.
const FLAT: f64 = 0.98;
/// Triangles whose normals are farther than this from the patch's, in degrees, are walls...
const WALL: f64 = 60.0;
/// ... and have no more than this share of its area.
const MAX_WALL: f64 = 0.01;
/// A cap has at most this share of the area of its piece of the garment.
const MAX_AREA: f64 = 0.3;
/// The cosine between a cap's normal and a bone that leaves through it is this at least: one that was led aside meets walls too.
const MIN_ACROSS: f64 = 0.45;
/// And for a bevelled one: the wall of a coarse sleeve that a bone leaves sideways has bevels too.
const BEVELLED_ACROSS: f64 = 0.8;
/// What goes out through a cap is longer than its mean radius by this factor. Less is the closed end of a mitten or a hat.
const MIN_BEYOND: f64 = 1.25;

/// A patch that closes an opening.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cap {
    /// Its triangles, ascending.
    pub triangles: Vec<u32>,
    /// The bone that goes through it, the lowest where there are several.
    pub bone: u32,
}

/// Why a patch is no cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoCap {
    /// No sharp edges bound it: it goes over into the cloth.
    NoRim,
    /// It is not flat.
    Curved,
    /// It is not small beside its piece of the garment.
    Large,
    /// The bones that go through it lie along it.
    Along,
    /// What would go out through it is shorter than it is wide.
    ClosedEnd,
}

impl NoCap {
    /// The reason, as the end of a sentence about "what closes it there".
    pub fn reason(self) -> &'static str {
        match self {
            Self::NoRim => "has no sharp rim that tells it from the cloth",
            Self::Curved => "is not flat",
            Self::Large => "is not small beside the garment",
            Self::Along => "lies along the bone, not across it",
            Self::ClosedEnd => "has less of the skeleton beyond it than it is wide",
        }
    }
}

/// The caps of a garment, and why others that bones pass through are none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Caps {
    /// In the order of their lowest triangles.
    pub caps: Vec<Cap>,
    /// The first reason of those that are no caps.
    pub refused: Option<NoCap>,
}

/// What is looked at.
struct Search<'a> {
    garment: &'a TriangleMesh,
    source: &'a Skeleton,
    /// For each bone, the least and the largest parameter of anything on it, 0 and 1 included.
    extents: &'a [[f64; 2]],
    /// For each triangle its neighbours over an edge: the neighbour, the bend in degrees, the edge's length.
    neighbours: Vec<Vec<(u32, f64, f64)>>,
    /// Sides of each triangle that are borders: their length.
    borders: Vec<f64>,
    areas: Vec<f64>,
    piece_of: Vec<u32>,
    piece_areas: Vec<f64>,
}

impl Caps {
    /// The caps of `garment` among the patches that `penetrations`, each a triangle and a bone of `source`, lie in. `extents`
    /// has the least and the largest parameter of anything on each bone, 0 and 1 included.
    pub fn find(garment: &TriangleMesh, penetrations: &[(u32, u32)], source: &Skeleton, extents: &[[f64; 2]]) -> Self {
        let mut found = Self::default();
        if penetrations.is_empty() {
            return found;
        }
        let search = Search::new(garment, source, extents);
        let mut known = vec![false; garment.triangles.len()];
        for &(seed, bone) in penetrations {
            if std::mem::replace(&mut known[seed as usize], true) {
                continue;
            }
            match search.cap_at(seed, bone, penetrations) {
                Ok(cap) => {
                    cap.triangles.iter().for_each(|&t| known[t as usize] = true);
                    found.caps.push(cap);
                }
                Err(reason) => found.refused = found.refused.or(Some(reason)),
            }
        }
        found.caps.sort_by_key(|cap| cap.triangles[0]);
        found
    }
}

impl<'a> Search<'a> {
    fn new(garment: &'a TriangleMesh, source: &'a Skeleton, extents: &'a [[f64; 2]]) -> Self {
        let topology = Topology::new(garment.positions.len(), &garment.triangles);
        let at = |v: u32| garment.positions[v as usize];
        let count = garment.triangles.len();
        let mut neighbours = vec![Vec::new(); count];
        let mut inner: Vec<[u32; 2]> = Vec::new();
        for hinge in &topology.hinges {
            let [a, b, c, d] = hinge.vertices.map(at);
            let normals = [(b - a).cross(c - a), (a - b).cross(d - b)];
            // Without an area there is no bend.
            let bend = if normals.iter().all(|n| n.length_squared() > 0.0) {
                turn::angle_between(normals[0], normals[1]).to_degrees()
            } else {
                0.0
            };
            let [s, t] = hinge.triangles;
            neighbours[s as usize].push((t, bend, a.distance(b)));
            neighbours[t as usize].push((s, bend, a.distance(b)));
            let [v, w, ..] = hinge.vertices;
            inner.push([v.min(w), v.max(w)]);
        }
        inner.sort_unstable();
        let border = |&[a, b, c]: &[u32; 3]| -> f64 {
            let open = |[v, w]: [u32; 2]| inner.binary_search(&[v.min(w), v.max(w)]).is_err();
            [[a, b], [b, c], [c, a]].into_iter().filter(|&side| open(side)).map(|[v, w]| at(v).distance(at(w))).sum()
        };
        let areas = garment.areas();
        let links = garment.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
        let (piece_of, pieces) = label_pieces(garment.positions.len(), links);
        let mut piece_areas = vec![0.0; pieces];
        for (t, area) in garment.triangles.iter().zip(&areas) {
            piece_areas[piece_of[t[0] as usize] as usize] += area;
        }
        let borders = garment.triangles.iter().map(border).collect();
        Self { garment, source, extents, neighbours, borders, areas, piece_of, piece_areas }
    }

    /// The cap around `seed`, through which `bone` goes.
    fn cap_at(&self, seed: u32, bone: u32, penetrations: &[(u32, u32)]) -> Result<Cap, NoCap> {
        let (mut best, mut reason): (Option<(f64, Vec<u32>)>, _) = (None, NoCap::NoRim);
        for limit in BENDS {
            let patch = self.patch(seed, limit);
            match self.quality(&patch, penetrations) {
                Ok(quality) if best.as_ref().is_none_or(|(least, _)| quality > *least) => best = Some((quality, patch)),
                Ok(_) => {}
                // That of the smallest patch says most.
                Err(why) => reason = why,
            }
        }
        let patch = match best {
            Some((_, patch)) => patch,
            None => self.bevelled(seed, penetrations).map_err(|_| reason)?,
        };
        let through = penetrations.iter().filter(|(t, _)| patch.binary_search(t).is_ok()).map(|&(_, bone)| bone);
        Ok(Cap { bone: through.min().unwrap_or(bone), triangles: patch })
    }

    /// The cap around `seed` where its edges are bevelled.
    fn bevelled(&self, seed: u32, penetrations: &[(u32, u32)]) -> Result<Vec<u32>, NoCap> {
        let flat = self.patch(seed, BENDS[BENDS.len() - 1]);
        let normal = self.vector(&flat).0.normalize_or_zero();
        let angle = |t: u32| {
            let cosine = self.own_vector(t).normalize_or_zero().dot(normal).abs();
            maths::acos(cosine.min(1.0)).to_degrees()
        };
        // All around: a collar between shoulders that slope and a chest that does not has no bevel.
        let (mut bevel, mut length) = (0.0, 0.0);
        for (next, _, edge) in self.rim(&flat) {
            length += edge;
            bevel += next.filter(|&t| angle(t) <= BEVELLED).map_or(0.0, |_| edge);
        }
        if bevel < MIN_BEVEL * length {
            return Err(NoCap::NoRim);
        }
        let patch = self.reached(seed, |t, _| angle(t) <= BEVELLED);
        self.check_size(&patch)?;
        let (mut cloth, mut length) = (0.0, 0.0);
        for (next, _, edge) in self.rim(&patch) {
            length += edge;
            cloth += next.filter(|&t| angle(t) >= CLOTH).map_or(0.0, |_| edge);
        }
        if length == 0.0 || cloth < MIN_CLOTH * length {
            return Err(NoCap::NoRim);
        }
        let (area, middle) = (self.area(&patch), self.area(&flat));
        let is_flat = |part: &[u32], area: f64, least: f64| self.vector(part).0.length() >= least * area;
        if middle < MIN_MIDDLE * area || !is_flat(&flat, middle, FLAT) || !is_flat(&patch, area, MIN_FLATNESS) {
            return Err(NoCap::Curved);
        }
        self.check_bones(&patch, penetrations, BEVELLED_ACROSS)?;
        Ok(patch)
    }

    /// The triangles that are reached from `seed` over edges that bend by no more than `limit`, ascending.
    fn patch(&self, seed: u32, limit: f64) -> Vec<u32> {
        self.reached(seed, |_, bend| bend <= limit)
    }

    /// The triangles that are reached from `seed` by way of those of which `belongs` says so, from their index and the bend of the
    /// edge before them, ascending.
    fn reached(&self, seed: u32, belongs: impl Fn(u32, f64) -> bool) -> Vec<u32> {
        let mut reached = vec![false; self.neighbours.len()];
        reached[seed as usize] = true;
        let mut patch = vec![seed];
        let mut done = 0;
        while let Some(&t) = patch.get(done) {
            done += 1;
            for &(next, bend, _) in &self.neighbours[t as usize] {
                if belongs(next, bend) && !std::mem::replace(&mut reached[next as usize], true) {
                    patch.push(next);
                }
            }
        }
        patch.sort_unstable();
        patch
    }

    fn area(&self, patch: &[u32]) -> f64 {
        patch.iter().map(|&t| self.areas[t as usize]).sum()
    }

    /// Its edges: the triangle on the other side, none at a border, the bend there and the length.
    fn rim<'b>(&'b self, patch: &'b [u32]) -> impl Iterator<Item = (Option<u32>, f64, f64)> + 'b {
        patch.iter().flat_map(move |&t| {
            let is_out = |(next, ..): &&(u32, f64, f64)| patch.binary_search(next).is_err();
            let inner = self.neighbours[t as usize].iter().filter(is_out);
            std::iter::once((None, 0.0, self.borders[t as usize]))
                .chain(inner.map(|&(t, bend, edge)| (Some(t), bend, edge)))
        })
    }

    fn check_size(&self, patch: &[u32]) -> Result<(), NoCap> {
        let piece = self.piece_of[self.garment.triangles[patch[0] as usize][0] as usize];
        if self.area(patch) > MAX_AREA * self.piece_areas[piece as usize] { Err(NoCap::Large) } else { Ok(()) }
    }

    /// How well `patch` can be told from the cloth, up to 1, or why it is no cap.
    fn quality(&self, patch: &[u32], penetrations: &[(u32, u32)]) -> Result<f64, NoCap> {
        self.check_size(patch)?;
        let (mut sharp, mut length) = (0.0, 0.0);
        for (_, bend, edge) in self.rim(patch) {
            length += edge;
            sharp += if bend >= SHARP { edge } else { 0.0 };
        }
        if length == 0.0 || sharp < MIN_SHARP * length {
            return Err(NoCap::NoRim);
        }
        let area = self.area(patch);
        let (vector, walls) = self.vector(patch);
        let flatness = vector.length();
        if flatness < MIN_FLATNESS * area || walls > MAX_WALL * area {
            return Err(NoCap::Curved);
        }
        self.check_bones(patch, penetrations, MIN_ACROSS)?;
        Ok(sharp / length * flatness / area)
    }

    /// Whether a bone goes across the patch, with this cosine at `least`, and enough of the skeleton out through it.
    fn check_bones(&self, patch: &[u32], penetrations: &[(u32, u32)], least: f64) -> Result<(), NoCap> {
        let is_in = |t: u32| patch.binary_search(&t).is_ok();
        let radius = (self.area(patch) / std::f64::consts::PI).sqrt();
        let mut crossing: Vec<(u32, u32)> = penetrations.iter().filter(|p| is_in(p.0)).map(|&(t, b)| (b, t)).collect();
        crossing.dedup_by_key(|p| p.0);
        let bones: Vec<u32> = crossing.iter().map(|p| p.0).collect();
        let normal = self.vector(patch).0.normalize_or_zero();
        let across = |&bone: &u32| {
            let [a, b] = self.source.bones[bone as usize].map(|j| self.source.joints[j as usize]);
            (b - a).normalize_or_zero().dot(normal).abs() >= least
        };
        if !bones.iter().any(across) {
            return Err(NoCap::Along);
        }
        let leaves = |&(bone, t): &(u32, u32)| self.beyond(bone, t, &bones, radius) >= MIN_BEYOND * radius;
        if crossing.iter().all(leaves) { Ok(()) } else { Err(NoCap::ClosedEnd) }
    }

    fn own_vector(&self, t: u32) -> DVec3 {
        let [a, b, c] = self.garment.triangles[t as usize].map(|v| self.garment.positions[v as usize]);
        0.5 * (b - a).cross(c - a)
    }

    /// The sum of the area vectors, each turned to the side of the largest: a patch that is wound both ways counts as if it were
    /// wound one way. And the area of what stands across it.
    fn vector(&self, patch: &[u32]) -> (DVec3, f64) {
        let vector = |&t: &u32| self.own_vector(t);
        let largest = patch.iter().map(vector).max_by(|a, b| a.length().total_cmp(&b.length())).unwrap_or_default();
        let turned = |v: DVec3| if v.dot(largest) < 0.0 { -v } else { v };
        let sum: DVec3 = patch.iter().map(vector).map(turned).sum();
        let normal = sum.normalize_or_zero();
        let is_wall = |v: &DVec3| v.dot(normal).abs() < maths::cos(WALL.to_radians()) * v.length();
        (sum, patch.iter().map(vector).filter(is_wall).map(DVec3::length).sum())
    }

    /// How much of the skeleton lies beyond the patch of triangle `t`, through which `bone` goes: the longest way outwards,
    /// none of the `bones` that go through the patch being crossed. Outside is the side on which the garment does not
    /// surround the bone; where that is not clear, the side on which there is less.
    fn beyond(&self, bone: u32, t: u32, bones: &[u32], radius: f64) -> f64 {
        let [low, high] = self.extents[bone as usize];
        let ends = self.source.bones[bone as usize];
        let [a, b] = ends.map(|j| self.source.joints[j as usize]);
        let length = a.distance(b);
        let corners = self.garment.triangles[t as usize].map(|v| self.garment.positions[v as usize]);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        // Where the bone meets the triangle's plane; where it runs along it, at the foot of its middle.
        let steep = normal.dot(b - a);
        let at = if triangle_area(corners) > 0.0 && steep.abs() > 1e-9 * normal.length() * length {
            normal.dot(middle - a) / steep
        } else {
            (middle - a).dot(b - a) / (length * length)
        };
        let at = at.clamp(low, high);
        let sides = [0, 1].map(|end| {
            let (own, own_extent) = if end == 0 { (at, low) } else { (1.0 - at, 1.0 - high) };
            // Beyond a leaf the bone goes on as far as its extent.
            let to_end = (own - own_extent.min(0.0)).max(0.0) * length;
            to_end.max(own.max(0.0) * length + self.longest_way(ends[end], bones))
        });
        let p = a + at * (b - a);
        let step = 0.5 * radius * (b - a).normalize_or_zero();
        let surrounded = [p - step, p + step].map(|p| Section::cut(self.garment, p, b - a).encloses(p));
        match surrounded {
            [true, false] => sides[1],
            [false, true] => sides[0],
            _ => sides[0].min(sides[1]),
        }
    }

    /// The longest way from a joint along bones other than `cut`, the extents of leaves included.
    fn longest_way(&self, joint: u32, cut: &[u32]) -> f64 {
        let joints = &self.source.joints;
        let mut distance = vec![f64::INFINITY; joints.len()];
        distance[joint as usize] = 0.0;
        let mut longest = 0.0_f64;
        // Relaxed until nothing changes: skeletons are small, and nearly trees.
        let mut changed = true;
        while changed {
            changed = false;
            for (k, &[a, b]) in (0u32..).zip(&self.source.bones) {
                if cut.contains(&k) {
                    continue;
                }
                let length = joints[a as usize].distance(joints[b as usize]);
                for (from, to) in [(a, b), (b, a)] {
                    let sum = distance[from as usize] + length;
                    if sum < distance[to as usize] {
                        distance[to as usize] = sum;
                        changed = true;
                    }
                }
            }
        }
        for (k, (&[a, b], &[low, high])) in (0u32..).zip(self.source.bones.iter().zip(self.extents)) {
            let length = joints[a as usize].distance(joints[b as usize]);
            for (end, beyond) in [(a, -low), (b, high - 1.0)] {
                let to_end = distance[end as usize];
                if to_end.is_finite() {
                    let beyond = if cut.contains(&k) { 0.0 } else { beyond.max(0.0) * length };
                    longest = longest.max(to_end + beyond);
                }
            }
        }
        longest
    }
}
