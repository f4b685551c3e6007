//! What holds the garment where the inflation stalled.
//!
//! A contact resists the inflation where the barrier's energy rises with t. The contacts that resist are grouped by the part
//! of the avatar that they belong to; and where a contact of another part, or of the other side of the same one, pushes the
//! garment back against it, by both parts. A part is what moves with one bone and hangs together.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DVec3;

use super::full_size::{FullSize, Pair, Part};
use super::objective::Objective;
use super::setup::problem::Problem;
use crate::contact::{Bodies, CollisionGroup, Configuration, PairType};
use crate::energy::barrier::Barrier;
use crate::energy::{Direction, Energy as _, Sink};
use crate::input::body::Body;
use crate::input::diagnostic::{AvatarPart, Bone, Diagnostic, Element};

/// Diagnostics of one blockage, at most.
const MAX_DIAGNOSTICS: usize = 8;
/// Contacts that resist most: those that are examined.
const ANCHORS: usize = 1024;
/// Contacts that push most: those that may be on the other side of the garment.
const PARTNERS: usize = 4096;
/// Two contacts push against each other where the cosine between their directions is below this.
const OPPOSITE: f64 = -0.5;
/// What is on the garment's other side is farther away than the garment; less than that where contacts are aslant.
const BEYOND: f64 = 0.8;
/// Contacts are on two sides of one place of the garment where they are nearer than this many d-hat, or on triangles that
/// share a vertex.
const NEAR: f64 = 2.0;
/// What resists less than this share of the strongest is not reported.
const FAINT: f64 = 0.01;
/// The same for a part that pushes from one side only, as a share of all: every limb that wears the garment resists a little.
const FAINT_ALONE: f64 = 0.1;
/// Pairs of contacts of a group that are examined at full size.
const PAIRS: usize = 8;

/// The triangles of two parts of the avatar that touch each other at full size, where such parts hold the garment most at `at`. The
/// candidate pairs of `objective` stay.
pub fn shut(problem: &Problem, body: &Body, objective: &mut Objective, at: Configuration<'_>) -> Option<[Element; 2]> {
    let candidates = objective.contact.barrier().candidates().clone();
    let first = find(problem, body, objective, at).into_iter().next();
    objective.contact.restore_candidates(candidates);
    match first {
        Some(Diagnostic::InflationSqueezed { gap: None, parts, .. }) => Some(parts.map(|part| part.triangle)),
        _ => None,
    }
}

/// What holds the garment at `at`, the strongest first; nothing where no contact resists the inflation. The candidate
/// pairs of `objective` are rebuilt.
pub fn find(problem: &Problem, body: &Body, objective: &mut Objective, at: Configuration<'_>) -> Vec<Diagnostic> {
    objective.contact.rebuild_candidates(at);
    let barrier = objective.contact.barrier();
    let full = FullSize::new(problem, body, 2.0 * objective.contact.min_separation());
    let contacts = contacts(problem, &full, barrier, at);
    let (squeezed, held) =
        groups(&problem.triangles, &contacts, NEAR * barrier.settings().dhat(CollisionGroup::Avatar));
    let reporter = Reporter {
        problem,
        body,
        full: &full,
        contacts: &contacts,
        dhat: barrier.settings().dhat(CollisionGroup::Avatar),
    };

    let strongest = |groups: &[Group]| groups.first().map_or(0.0, |group| group.resistance);
    let (most_squeezed, most) = (strongest(&squeezed), strongest(&squeezed).max(strongest(&held)));
    let all: f64 = squeezed.iter().chain(&held).map(|group| group.resistance).sum();
    let squeezed =
        squeezed.iter().take(MAX_DIAGNOSTICS).map(|group| (reporter.squeezed(group, &full), group.resistance));
    // Parts that touch come first, however little they resist: there, no option can help.
    let touches = |d: &Diagnostic| matches!(d, Diagnostic::InflationSqueezed { gap: None, .. });
    let clear = squeezed.filter(|(d, resistance)| touches(d) || *resistance >= FAINT * most);
    let mut found: Vec<Diagnostic> = clear.map(|(diagnostic, _)| diagnostic).collect();
    found.sort_by_key(|d| !touches(d));
    let alone = held.iter().filter(|g| g.resistance > most_squeezed && g.resistance >= FAINT_ALONE * all);
    found.extend(alone.map(|group| reporter.held(group)));
    found.truncate(MAX_DIAGNOSTICS);
    found
}

/// A pair of primitives of garment and avatar below d-hat.
struct Contact {
    /// A welded garment triangle that takes part.
    garment: u32,
    /// A piece of the projected avatar that takes part.
    piece: u32,
    part: Part,
    /// The normal of the garment triangle.
    normal: DVec3,
    /// The closest points.
    on_garment: DVec3,
    on_avatar: DVec3,
    /// That point of the avatar at full size.
    at_full_size: DVec3,
    /// How hard it pushes the garment.
    force: f64,
    /// The derivative of the barrier by t.
    resistance: f64,
}

impl Contact {
    fn distance(&self) -> f64 {
        self.on_garment.distance(self.on_avatar)
    }

    /// The direction in which the garment is pushed.
    fn direction(&self) -> DVec3 {
        (self.on_garment - self.on_avatar).normalize_or_zero()
    }

    /// Whether `other` pushes the garment back against it, within `near` straight across the garment, which is between both.
    fn is_opposed_across(&self, other: &Self, near: f64) -> bool {
        let (here, there, across) = (self.direction(), other.direction(), other.on_avatar - self.on_avatar);
        self.on_garment.distance_squared(other.on_garment) <= near * near
            && here.dot(there) < OPPOSITE
            && across.dot(here) > BEYOND * self.distance()
            && -across.dot(there) > BEYOND * other.distance()
    }

    /// Whether `other`, of another part, pushes back on a neighbouring triangle, on the other side of the same sheet.
    fn is_opposed_on_neighbour(&self, other: &Self, cloth: &[[u32; 3]]) -> bool {
        let corners = &cloth[other.garment as usize];
        self.part != other.part
            && self.direction().dot(other.direction()) < OPPOSITE
            && self.normal.dot(other.normal) > 0.0
            && cloth[self.garment as usize].iter().any(|v| corners.contains(v))
    }
}

/// Sums the force of a contact and its resistance to t.
#[derive(Default)]
struct Push {
    force: DVec3,
    resistance: f64,
}

impl Sink for Push {
    fn rank_one(&mut self, a: Direction<'_>, g: f64, _: f64) {
        self.force -= g * a.components.iter().sum::<DVec3>();
        self.resistance += g * a.t;
    }
}

/// How hard a vertex of the avatar pushes the garment, and how much that resists t.
pub struct VertexPush {
    /// The vertex.
    pub vertex: u32,
    /// How hard the contacts push of which it is a part.
    pub force: f64,
    /// The derivative of their barriers by t.
    pub resistance: f64,
}

/// What the vertices of the avatar that touch the garment do, once for each contact, in the order of the candidates.
pub fn pushes(barrier: &Barrier, at: Configuration<'_>) -> Vec<VertexPush> {
    let count = barrier.bodies().garment_count() as u32;
    let mut pushes = Vec::new();
    for range in barrier.candidates().ranges(0..barrier.len()).filter(|range| range.group == CollisionGroup::Avatar) {
        for (index, pair) in (range.first..).zip(range.pairs) {
            let mut push = Push::default();
            barrier.derivatives(at, index..index + 1, &mut push);
            if push.force == DVec3::ZERO {
                continue;
            }
            let [_, other] = sides(range.pair_type, *pair, count);
            let (force, resistance) = (push.force.length(), push.resistance);
            pushes.extend(pair[other].iter().map(|v| VertexPush { vertex: v - count, force, resistance }));
        }
    }
    pushes
}

/// The contacts with the avatar, in the order of the candidates.
fn contacts(problem: &Problem, full: &FullSize<'_>, barrier: &Barrier, at: Configuration<'_>) -> Vec<Contact> {
    let bodies: &Bodies = barrier.bodies();
    let count = bodies.garment_count() as u32;
    let cloth = VertexTriangles::new(bodies.garment_count(), &problem.triangles);
    let avatar = VertexTriangles::new(problem.projected.start.len(), &problem.projected.triangles);
    let dhat = barrier.settings().dhat(CollisionGroup::Avatar);
    let mut contacts = Vec::new();
    for range in barrier.candidates().ranges(0..barrier.len()).filter(|range| range.group == CollisionGroup::Avatar) {
        for (index, &pair) in (range.first..).zip(range.pairs) {
            let x = bodies.positions(pair, at);
            if range.pair_type.is_beyond(&x, dhat) {
                continue;
            }
            let separation = range.pair_type.separation(&x);
            if separation.squared >= dhat * dhat {
                continue;
            }
            let [own, other] = sides(range.pair_type, pair, count);
            let vertices = |side: &Range<usize>, first: u32| pair[side.clone()].iter().map(|v| v - first).collect();
            let (on_cloth, on_avatar): (Vec<u32>, Vec<u32>) = (vertices(&own, 0), vertices(&other, count));
            let (Some(garment), Some(piece)) = (
                cloth.triangle_with(&problem.triangles, &on_cloth),
                avatar.triangle_with(&problem.projected.triangles, &on_avatar),
            ) else {
                continue;
            };
            // The weights of one side are all of one sign, and sum to 1 but for it.
            let point = |side: Range<usize>, of: &dyn Fn(usize) -> DVec3| -> DVec3 {
                side.map(|k| separation.weights[k].abs() * of(k)).sum()
            };
            let mut push = Push::default();
            barrier.derivatives(at, index..index + 1, &mut push);
            contacts.push(Contact {
                garment,
                piece,
                part: full.part(piece),
                normal: normal(problem.triangles[garment as usize].map(|v| at.x[v as usize])),
                on_garment: point(own, &|k| x[k]),
                on_avatar: point(other.clone(), &|k| x[k]),
                at_full_size: point(other, &|k| problem.projected.end[(pair[k] - count) as usize]),
                force: push.force.length(),
                resistance: push.resistance,
            });
        }
    }
    contacts
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// Which of the four vertices are the garment's, and which the avatar's.
fn sides(pair_type: PairType, pair: [u32; 4], garment_count: u32) -> [Range<usize>; 2] {
    let (first, second) = (0..pair_type.first_count(), pair_type.first_count()..4);
    if pair[0] < garment_count { [first, second] } else { [second, first] }
}

/// The triangles at each vertex.
struct VertexTriangles {
    ends: Vec<u32>,
    triangles: Vec<u32>,
}

impl VertexTriangles {
    fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut ends = vec![0; vertices + 1];
        triangles.iter().flatten().for_each(|&v| ends[v as usize + 1] += 1);
        (0..vertices).for_each(|v| ends[v + 1] += ends[v]);
        let mut next = ends.clone();
        let mut all = vec![0; 3 * triangles.len()];
        for (k, t) in (0u32..).zip(triangles) {
            for &v in t {
                all[next[v as usize] as usize] = k;
                next[v as usize] += 1;
            }
        }
        Self { ends, triangles: all }
    }

    /// The lowest triangle that has all of `vertices`.
    fn triangle_with(&self, corners: &[[u32; 3]], vertices: &[u32]) -> Option<u32> {
        let first = *vertices.first()? as usize;
        let around = &self.triangles[self.ends[first] as usize..self.ends[first + 1] as usize];
        around.iter().copied().find(|&t| vertices.iter().all(|v| corners[t as usize].contains(v)))
    }
}

/// Contacts that resist, of one part or of two that squeeze the garment between them.
#[derive(Default)]
struct Group {
    resistance: f64,
    /// A contact that resists, and the one against it; the one that resists most first.
    contacts: Vec<[usize; 2]>,
    /// The garment triangles, ascending.
    garment: Vec<u32>,
}

/// Groups of two parts, and groups of one, each the strongest first.
fn groups(cloth: &[[u32; 3]], contacts: &[Contact], near: f64) -> (Vec<Group>, Vec<Group>) {
    let strongest = |of: fn(&Contact) -> f64, most: usize| {
        let mut order: Vec<usize> = (0..contacts.len()).filter(|&k| of(&contacts[k]) > 0.0).collect();
        order.sort_by(|&j, &k| of(&contacts[k]).total_cmp(&of(&contacts[j])).then(j.cmp(&k)));
        order.truncate(most);
        order
    };
    let partners = strongest(|contact| contact.force, PARTNERS);
    let mut squeezed: BTreeMap<[Part; 2], Group> = BTreeMap::new();
    let mut held: BTreeMap<Part, Group> = BTreeMap::new();
    for k in strongest(|contact| contact.resistance, ANCHORS) {
        let anchor = &contacts[k];
        // Straight across, or else on a neighbouring triangle; those that push harder come first.
        let others = || partners.iter().copied().filter(|&j| contacts[j].piece != anchor.piece);
        let partner = others()
            .find(|&j| anchor.is_opposed_across(&contacts[j], near))
            .or_else(|| others().find(|&j| anchor.is_opposed_on_neighbour(&contacts[j], cloth)));
        let group = match partner {
            Some(j) => {
                let (a, b) = (anchor.part, contacts[j].part);
                squeezed.entry([a.min(b), a.max(b)]).or_default()
            }
            None => held.entry(anchor.part).or_default(),
        };
        group.resistance += anchor.resistance;
        group.contacts.push([k, partner.unwrap_or(k)]);
        group.garment.push(anchor.garment);
    }
    let ordered = |groups: &mut dyn Iterator<Item = Group>| {
        let mut groups: Vec<Group> = groups.collect();
        groups.sort_by(|a, b| b.resistance.total_cmp(&a.resistance));
        for group in &mut groups {
            group.garment.sort_unstable();
            group.garment.dedup();
        }
        groups
    };
    (ordered(&mut squeezed.into_values()), ordered(&mut held.into_values()))
}

/// Makes diagnostics of groups, in the caller's indices.
struct Reporter<'a> {
    problem: &'a Problem,
    body: &'a Body,
    full: &'a FullSize<'a>,
    contacts: &'a [Contact],
    dhat: f64,
}

impl Reporter<'_> {
    fn held(&self, group: &Group) -> Diagnostic {
        let contact = &self.contacts[group.contacts[0][0]];
        Diagnostic::InflationHeld {
            garment: self.callers(contact),
            part: self.part(contact),
            held: group.garment.len(),
            distance: contact.distance(),
        }
    }

    fn squeezed(&self, group: &Group, full: &FullSize<'_>) -> Diagnostic {
        let [a, b] = group.contacts[0].map(|k| &self.contacts[k]);
        let pair = |contacts: &[usize; 2]| {
            let [a, b] = contacts.map(|k| &self.contacts[k]);
            Pair {
                triangles: [a, b].map(|c| self.problem.projected.origins[c.piece as usize]),
                parts: [a.part, b.part],
                points: [a.at_full_size, b.at_full_size],
            }
        };
        let pairs: Vec<Pair> = group.contacts.iter().take(PAIRS).map(pair).collect();
        Diagnostic::InflationSqueezed {
            garment: self.callers(a),
            parts: [self.part(a), self.part(b)],
            same: a.part == b.part,
            gap: full.gap(&pairs),
            inflation_dhat: self.dhat,
        }
    }

    fn callers(&self, contact: &Contact) -> u32 {
        self.problem.weld.triangle_of[contact.garment as usize]
    }

    fn part(&self, contact: &Contact) -> AvatarPart {
        let projected = &self.problem.projected;
        let bone = projected.bones[contact.piece as usize];
        AvatarPart {
            bone: bone.map(|index| Bone { index, joints: self.problem.bones[index as usize] }),
            triangle: self.body.triangle(projected.origins[contact.piece as usize]),
            loose: self.full.loose(contact.part),
        }
    }
}
