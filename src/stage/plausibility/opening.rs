//! What goes through the openings of a garment.
//!
//! An opening is a boundary loop, and what goes through it is what passes through a surface that the loop spans: the fan
//! from the loop's middle. Bones go through where the loop is linked with the skeleton ([`windings_of_loops`]), the body where its
//! surface cuts the fan.

use glam::DVec3;

use super::{LEAF_REACH, Misplacement, Outcome};
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::geometry::missing_faces::are_missing_faces;
use crate::input::placement::evidence::Threaded;
use crate::input::placement::limb::{self, TurnedLimb};
use crate::stage::start::winding::{Winding, windings_of_loops};

/// Nothing goes through an opening where what the body's surface cuts out of it is below this share of its area, and the
/// curve in which it cuts is below this share of its length.
const NOTHING: [f64; 2] = [0.02, 0.1];

/// A limb of the source skeleton that is turned by less than this, in degrees, is in its sleeve or leg.
const BESIDE: f64 = 15.0;
/// One that is turned by more than this and was not refused before the work is what the caller trusts.
const ELSEWHERE: f64 = 60.0;

/// A surface that a closed curve spans.
pub struct Disc {
    /// Triangles from the middle to each edge.
    fan: Vec<[DVec3; 3]>,
    /// The mean along the curve.
    pub middle: DVec3,
    /// Half the sum of the cross products along the curve: the largest area under which it is seen, and along the line of
    /// sight.
    pub area: DVec3,
    /// The length of the curve.
    pub length: f64,
}

/// The curves in which a surface cuts a [`Disc`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    /// The area that they enclose, as that of the disc.
    pub area: DVec3,
    /// Their length.
    pub length: f64,
}

impl Disc {
    /// The fan over the closed curve through `points`, in their order.
    pub fn new(points: &[DVec3]) -> Self {
        let edges = || points.iter().zip(points.iter().cycle().skip(1)).map(|(&p, &q)| [p, q]);
        let length: f64 = edges().map(|[p, q]| p.distance(q)).sum();
        let moment: DVec3 = edges().map(|[p, q]| 0.5 * p.distance(q) * (p + q)).sum();
        let middle = if length > 0.0 { moment / length } else { points.first().copied().unwrap_or_default() };
        let fan: Vec<[DVec3; 3]> = edges().map(|[p, q]| [middle, p, q]).collect();
        let area = fan.iter().map(|[m, p, q]| 0.5 * (*p - *m).cross(*q - *m)).sum();
        Self { fan, middle, area, length }
    }

    /// The curves in which the surface of `body` cuts the disc.
    pub fn section(&self, body: &TriangleMesh) -> Section {
        let corners = || self.fan.iter().flatten().copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let mut section = Section::default();
        for triangle in &body.triangles {
            let [a, b, c] = triangle.map(|v| body.positions[v as usize]);
            if a.min(b).min(c).cmpgt(high).any() || a.max(b).max(c).cmplt(low).any() {
                continue;
            }
            for [p, q] in self.fan.iter().filter_map(|part| common_segment(part, &[a, b, c])) {
                section.area += 0.5 * (p - self.middle).cross(q - self.middle);
                section.length += p.distance(q);
            }
        }
        section
    }
}

/// The segment that two triangles share, along the cross product of their normals.
fn common_segment(s: &[DVec3; 3], t: &[DVec3; 3]) -> Option<[DVec3; 2]> {
    let normal = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a);
    let (across_s, across_t) = (normal(s), normal(t));
    let along = across_s.cross(across_t);
    let cut = |triangle: &[DVec3; 3], origin: DVec3, normal: DVec3| -> Option<[DVec3; 2]> {
        let heights = triangle.map(|p| (p - origin).dot(normal));
        let on_edge = |(i, j): (usize, usize)| {
            let passes = (heights[i] < 0.0) != (heights[j] < 0.0);
            passes.then(|| triangle[i].lerp(triangle[j], heights[i] / (heights[i] - heights[j])))
        };
        let mut ends = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(on_edge);
        let (first, last) = (ends.next()?, ends.next()?);
        Some(if (last - first).dot(along) < 0.0 { [last, first] } else { [first, last] })
    };
    let (first, second) = (cut(s, t[0], across_t)?, cut(t, s[0], across_s)?);
    let place = |p: DVec3| p.dot(along);
    let from = if place(first[0]) > place(second[0]) { first[0] } else { second[0] };
    let to = if place(first[1]) < place(second[1]) { first[1] } else { second[1] };
    (place(from) < place(to)).then_some([from, to])
}

/// An opening of the design.
pub(super) struct Opening {
    /// Its vertices, in order.
    pub(super) vertices: Vec<u32>,
    /// The bone that goes through; where it is around a joint and no bone, as a sash is, the nearest. None where nothing does.
    pub(super) bone: Option<u32>,
}

impl Opening {
    /// The surface that it spans in `garment`.
    pub(super) fn disc(&self, garment: &TriangleMesh) -> Disc {
        Disc::new(&points(garment, &self.vertices))
    }
}

/// All openings of the design. Where a few faces are missing there is none: what went through there by chance needs not do so again.
pub(super) fn openings(outcome: &Outcome<'_>, topology: &Topology) -> Vec<Opening> {
    let all = topology.loops.iter().zip(are_missing_faces(outcome.design, topology));
    let loops: Vec<&[u32]> = all.filter(|(_, is_missing)| !is_missing).map(|(l, _)| l.vertices.as_slice()).collect();
    let segments = outcome.source.lengthened(LEAF_REACH);
    let opening = |(vertices, winding): (&[u32], Winding)| {
        let middle = Disc::new(&points(outcome.design, vertices)).middle;
        let distance = |&bone: &u32| {
            let [a, b] = segments[bone as usize];
            middle.distance_squared(closest_on_segment(middle, a, b - a))
        };
        let nearest = |bones: &mut dyn Iterator<Item = u32>| {
            bones.map(|bone| (distance(&bone), bone)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, bone)| bone)
        };
        let bone = match winding.segments[..] {
            _ if !winding.linked => None,
            [] => nearest(&mut (0..segments.len() as u32)),
            ref wound => nearest(&mut wound.iter().copied()),
        };
        Opening { vertices: vertices.to_vec(), bone }
    };
    let wound = windings_of_loops(outcome.design, &loops, &segments);
    loops.into_iter().zip(wound).map(opening).collect()
}

/// The openings through which bones went in the design, and through which neither a bone nor anything of the body goes now.
pub(super) fn empty_openings(outcome: &Outcome<'_>, openings: &[Opening]) -> Vec<Misplacement> {
    let around: Vec<(&Opening, u32)> = openings.iter().filter_map(|opening| Some((opening, opening.bone?))).collect();
    let loops: Vec<&[u32]> = around.iter().map(|(opening, _)| opening.vertices.as_slice()).collect();
    let now = windings_of_loops(outcome.result, &loops, &outcome.target.lengthened(LEAF_REACH));
    let is_empty = |opening: &Opening, winding: Winding| !winding.linked && nothing_goes_through(opening, outcome);
    around
        .into_iter()
        .zip(now)
        .filter_map(|((opening, bone), winding)| {
            is_empty(opening, winding).then(|| Misplacement::OutOfOpening { bone, vertex: opening.vertices[0] })
        })
        .collect()
}

/// The limbs that pass beside the opening that they were made for in the design, where nothing of the body goes through it in the
/// result: they have not found their way.
pub(super) fn missed_openings(outcome: &Outcome<'_>, openings: &[Opening]) -> Vec<Misplacement> {
    let missed = |limb: TurnedLimb| {
        let distance = |opening: &Opening| opening.disc(outcome.design).middle.distance_squared(limb.opening);
        let own = openings.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let vertex = own.vertices[0];
        nothing_goes_through(own, outcome).then_some(Misplacement::OutOfOpening { bone: limb.bone, vertex })
    };
    let limbs = limb::turned(&Threaded::new(outcome.design), outcome.source, BESIDE);
    limbs.into_iter().filter(|limb| limb.degrees < ELSEWHERE).filter_map(missed).collect()
}

/// Whether no part of the body goes through the opening in the result.
pub(super) fn nothing_goes_through(opening: &Opening, outcome: &Outcome<'_>) -> bool {
    let disc = opening.disc(outcome.result);
    let section = disc.section(outcome.body);
    section.area.length() < NOTHING[0] * disc.area.length() && section.length < NOTHING[1] * disc.length
}

fn points(mesh: &TriangleMesh, vertices: &[u32]) -> Vec<DVec3> {
    vertices.iter().map(|&v| mesh.positions[v as usize]).collect()
}
