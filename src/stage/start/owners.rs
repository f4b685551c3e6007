//! Which bone each vertex of an avatar belongs to where no skin weights say it.
//!
//! The nearest bone is the right one only where the way to it leads through the body: the tip of a finger that hangs beside a
//! thigh is nearer to the bone of the thigh than to any of its own, and the thigh is near what lies straight beyond the hand. So
//! a vertex belongs to the nearest bone, beyond leaf joints too, to which it has a straight way that does not leave the body;
//! and one that has none, as curled fingers, belongs to the bone of the nearest vertex along the surface that has one.
//!
//! Bodies are open, in pieces and pass through themselves. Whether a way leaves the body is counted from the vertex on, from
//! one layer deep, up and down with each side of the surface that is crossed; nothing is asked of what is far away.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::{TriangleMesh, label_pieces};
use crate::input::diagnostic::Diagnostic;
use crate::input::skeleton::{BoneGraph, Skeleton};
use crate::input::skin::SkinWeights;
use crate::input::weld::weld_vertices;

/// As long a way outside of the body, in the normalised space, is none: surfaces that should meet leave gaps.
const GAP: f64 = 0.02;
/// A bone farther away than the nearest one by more than this factor is none of a vertex's own, whatever the way to it.
const TIMES_FARTHER: f64 = 2.5;
/// Bones to which ways are looked for.
const BONES: usize = 4;
/// A way begins so deep below the vertex, and not deeper than this share of it: its own triangles are not crossed.
const BELOW: f64 = 1e-3;
const SHARE_BELOW: f64 = 0.02;
/// A way that crosses the surface more often than this is taken to stay inside.
const MOST_CROSSINGS: usize = 32;
/// A piece encloses something where its triangles face all ways, so that their areas, as vectors, sum up to less than this
/// share of them.
const MOST_OPEN: f64 = 0.25;
/// Bones with so many others between them on the skeleton are parts of the body that no surface joins but through these.
const FAR_APART: usize = 3;

/// A part of the skeleton that a vertex belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Owner {
    /// A bone.
    Bone(u32),
    /// The bones at a joint, of which the nearest is taken.
    Joint(u32),
}

impl Owner {
    /// Whether `bone`, between these joints, is of this part.
    #[inline]
    pub fn has(self, bone: u32, ends: [u32; 2]) -> bool {
        match self {
            Self::Bone(own) => own == bone,
            Self::Joint(joint) => ends.contains(&joint),
        }
    }

    /// Whether two parts meet at a joint.
    fn meets(self, other: Self, skeleton: &Skeleton) -> bool {
        let (own, others) = (self.joints(skeleton), other.joints(skeleton));
        own.iter().any(|joint| others.contains(joint))
    }

    fn joints(self, skeleton: &Skeleton) -> [u32; 2] {
        match self {
            Self::Bone(bone) => skeleton.bones[bone as usize],
            Self::Joint(joint) => [joint; 2],
        }
    }
}

/// The parts of the skeleton that vertices belong to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Owners {
    /// For each vertex; none for one that no triangle uses.
    pub of: Vec<Option<Owner>>,
    /// Edges of the surface whose ends belong to parts of the skeleton far from each other, and to neither by skin weights.
    pub contested: Vec<[u32; 2]>,
}

impl Owners {
    /// The parts of `skeleton` that the vertices of its body `avatar` belong to; both are normalised. Where a vertex has a
    /// joint of largest weight in `skin`, that decides.
    pub fn find(avatar: &TriangleMesh, skeleton: &Skeleton, skin: Option<&SkinWeights>) -> Self {
        let count = avatar.positions.len();
        let used = avatar.used_vertices();
        let weighted = |v: usize| skin.and_then(|skin| skin.dominant_joint(v)).map(Owner::Joint);
        let asks: Vec<bool> = (0..count).map(|v| used[v] && weighted(v).is_none()).collect();
        if !asks.contains(&true) {
            return Self { of: (0..count).map(weighted).collect(), contested: Vec::new() };
        }
        let (welded, _) = weld_vertices(avatar);
        let pieces = Pieces::new(avatar, &welded);
        let avatar = pieces.turned_outwards(avatar, &welded);
        let normals = normals(&avatar, &welded);
        let tree = ClosestPoint::new(&avatar);
        let graph = BoneGraph::new(skeleton);
        let ways: Vec<Option<Ways>> = (0..count)
            .into_par_iter()
            .map(|v| {
                let place = welded[v];
                let inside = || pieces.encloses(place).then_some((normals[place as usize], &tree));
                asks[v].then(|| Ways::find(avatar.positions[v], &graph, skeleton, inside()))
            })
            .collect();
        // What is welded is one place of the surface, so the first that knows speaks for all.
        let mut seeds = vec![None; places(&welded)];
        for (v, (ways, &w)) in ways.iter().zip(&welded).enumerate() {
            let seed: &mut Option<Owner> = &mut seeds[w as usize];
            *seed = seed.or_else(|| weighted(v)).or(ways.as_ref().and_then(|ways| ways.open));
        }
        let spread = spread(&avatar, &welded, &seeds);
        let of = |(v, (ways, &w)): (usize, (&Option<Ways>, &u32))| match ways {
            Some(ways) => Some(ways.owner(spread[w as usize], skeleton)),
            None => weighted(v),
        };
        let of: Vec<Option<Owner>> = ways.iter().zip(&welded).enumerate().map(of).collect();
        let contested = contested(&avatar, &of, &asks, &graph, skeleton);
        Self { of, contested }
    }
}

impl Owners {
    /// What is to be said where the surface of the avatar, its first so many vertices, does not tell parts of `skeleton` from
    /// each other.
    pub fn unclear(&self, vertices: usize, skeleton: &Skeleton) -> Option<Diagnostic> {
        let of_avatar = |edge: &&[u32; 2]| edge.iter().all(|&v| (v as usize) < vertices);
        let edges: Vec<&[u32; 2]> = self.contested.iter().filter(of_avatar).collect();
        let &&vertices = edges.first()?;
        let [Some(here), Some(there)] = vertices.map(|v| self.of[v as usize]) else { return None };
        let joints = [here, there].map(|owner| owner.joints(skeleton));
        Some(Diagnostic::BonesUnclear { edges: edges.len(), vertices, joints })
    }
}

/// The parts of the skeleton near a vertex.
struct Ways {
    /// The nearest.
    nearest: Owner,
    /// The nearest to which a way leads inside the body.
    open: Option<Owner>,
}

impl Ways {
    /// Of a vertex at `p`, `inside` of a surface with that normal there; on a sheet, every way is open.
    fn find(p: DVec3, graph: &BoneGraph, skeleton: &Skeleton, inside: Option<(DVec3, &ClosestPoint)>) -> Self {
        let place = |(bone, &ends): (u32, &[u32; 2])| {
            let along = graph.project(skeleton, bone, p);
            // Bones that meet at a joint are all the same to the vertex.
            let owner = match along {
                0.0 => Owner::Joint(ends[0]),
                1.0 => Owner::Joint(ends[1]),
                _ => Owner::Bone(bone),
            };
            let on_bone = skeleton.point_at(bone, along);
            (p.distance(on_bone), owner, on_bone)
        };
        let mut places: Vec<(f64, Owner, DVec3)> = (0u32..).zip(&skeleton.bones).map(place).collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        places.dedup_by_key(|place| place.1);
        let (least, nearest, _) = places[0];
        let near = places.iter().take(BONES).take_while(|(distance, ..)| *distance <= TIMES_FARTHER * least);
        let is_open = |on_bone| inside.is_none_or(|(normal, tree)| !leaves(p, normal, on_bone, tree));
        let open = near.copied().find(|&(.., on_bone)| is_open(on_bone)).map(|(_, owner, _)| owner);
        Self { nearest, open }
    }

    /// The owner, where the surface around belongs to `around`. It is the nearest, unless the right one is elsewhere: of bones
    /// that meet at a joint, either will do.
    fn owner(&self, around: Option<Owner>, skeleton: &Skeleton) -> Owner {
        let inside = self.open.or(around);
        inside.filter(|inside| !inside.meets(self.nearest, skeleton)).unwrap_or(self.nearest)
    }
}

/// How many places there are.
fn places(welded: &[u32]) -> usize {
    welded.iter().max().map_or(0, |&w| w as usize + 1)
}

/// The connected pieces of a mesh.
struct Pieces {
    /// The piece of each place.
    of: Vec<u32>,
    /// Which of them face inwards.
    is_turned: Vec<bool>,
    /// Which of them enclose something: not a sheet, such as a card with hair on it, inside of which nothing is.
    encloses: Vec<bool>,
}

impl Pieces {
    fn new(mesh: &TriangleMesh, welded: &[u32]) -> Self {
        let links = mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
        let (of, count) = label_pieces(places(welded), links.map(|link| link.map(|v| welded[v as usize])));
        let piece = |t: &[u32; 3]| of[welded[t[0] as usize] as usize] as usize;
        // About a point of the piece, so that one that is open counts as closed over it.
        let mut middles = vec![(DVec3::ZERO, 0.0); count];
        for t in &mesh.triangles {
            let middle = &mut middles[piece(t)];
            t.iter().for_each(|&v| *middle = (middle.0 + mesh.positions[v as usize], middle.1 + 1.0));
        }
        let (mut volumes, mut areas) = (vec![0.0; count], vec![(DVec3::ZERO, 0.0); count]);
        for t in &mesh.triangles {
            let (sum, corners) = middles[piece(t)];
            let [a, b, c] = t.map(|v| mesh.positions[v as usize] - sum / corners);
            volumes[piece(t)] += a.dot(b.cross(c));
            let (across, area) = &mut areas[piece(t)];
            let normal = (b - a).cross(c - a);
            (*across, *area) = (*across + normal, *area + normal.length());
        }
        Self {
            of,
            is_turned: volumes.iter().map(|&volume| volume < 0.0).collect(),
            encloses: areas.iter().map(|(across, area)| across.length() < MOST_OPEN * area).collect(),
        }
    }

    /// `mesh` with all of its pieces facing outwards, as far as they enclose something.
    fn turned_outwards(&self, mesh: &TriangleMesh, welded: &[u32]) -> TriangleMesh {
        let is_turned = |v: u32| self.is_turned[self.of[welded[v as usize] as usize] as usize];
        let turned = |&[a, b, c]: &[u32; 3]| if is_turned(a) { [a, c, b] } else { [a, b, c] };
        TriangleMesh { positions: mesh.positions.clone(), triangles: mesh.triangles.iter().map(turned).collect() }
    }

    fn encloses(&self, place: u32) -> bool {
        self.encloses[self.of[place as usize] as usize]
    }
}

/// Whether the way from a vertex at `p` with `normal` to `to` leaves the body.
fn leaves(p: DVec3, normal: DVec3, to: DVec3, tree: &ClosestPoint) -> bool {
    let length = p.distance(to);
    if length <= GAP {
        return false;
    }
    let from = p - BELOW.min(SHARE_BELOW * length) * normal;
    let direction = to - from;
    let (mut depth, mut at, mut outside) = (1, 0.0, 0.0);
    for _ in 0..MOST_CROSSINGS {
        let next = tree.next_hit(from, direction, at).filter(|(along, _)| *along < 1.0);
        if depth <= 0 {
            outside += next.map_or(1.0, |(along, _)| along) - at;
        }
        let Some((along, across)) = next else { break };
        depth += if across.dot(direction) > 0.0 { -1 } else { 1 };
        at = along;
    }
    outside * length > GAP
}

/// The outward normal of each welded vertex.
fn normals(mesh: &TriangleMesh, welded: &[u32]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; places(welded)];
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        let normal = (b - a).cross(c - a);
        t.iter().for_each(|&v| sums[welded[v as usize] as usize] += normal);
    }
    sums.into_iter().map(DVec3::normalize_or_zero).collect()
}

/// A place of the surface that is reached from a seed.
#[derive(PartialEq)]
struct Reached {
    distance: f64,
    place: u32,
    owner: Owner,
}

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        self.distance.total_cmp(&other.distance).then((self.place, self.owner).cmp(&(other.place, other.owner)))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// For each place of the surface the owner of the seed that is nearest along the edges; none on a piece without one.
fn spread(mesh: &TriangleMesh, welded: &[u32], seeds: &[Option<Owner>]) -> Vec<Option<Owner>> {
    let mut edges: Vec<(u32, u32, f64)> = Vec::with_capacity(6 * mesh.triangles.len());
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let length = mesh.positions[from as usize].distance(mesh.positions[to as usize]);
            let (from, to) = (welded[from as usize], welded[to as usize]);
            edges.extend([(from, to, length), (to, from, length)]);
        }
    }
    // Ends at one place are equally far from each other, to the bit.
    edges.sort_unstable_by_key(|&(from, to, _)| (from, to));
    edges.dedup_by_key(|&mut (from, to, _)| (from, to));
    let mut owners = vec![None; seeds.len()];
    let start =
        |(place, seed): (u32, &Option<Owner>)| seed.map(|owner| Reverse(Reached { distance: 0.0, place, owner }));
    let mut front: BinaryHeap<Reverse<Reached>> = (0u32..).zip(seeds).filter_map(start).collect();
    while let Some(Reverse(Reached { distance, place, owner })) = front.pop() {
        if owners[place as usize].is_some() {
            continue;
        }
        owners[place as usize] = Some(owner);
        let first = edges.partition_point(|&(from, ..)| from < place);
        for &(_, to, length) in edges[first..].iter().take_while(|&&(from, ..)| from == place) {
            if owners[to as usize].is_none() {
                front.push(Reverse(Reached { distance: distance + length, place: to, owner }));
            }
        }
    }
    owners
}

/// Edges whose ends both `ask` for an owner and have such that are far apart on the skeleton; ascending, the lower vertex first.
fn contested(
    mesh: &TriangleMesh,
    owners: &[Option<Owner>],
    asks: &[bool],
    graph: &BoneGraph,
    skeleton: &Skeleton,
) -> Vec<[u32; 2]> {
    let are_far_apart = |a: Owner, b: Owner| {
        let (a, b) = (a.joints(skeleton), b.joints(skeleton));
        a.iter().all(|&j| b.iter().all(|&k| graph.joint_distance(j, k) >= FAR_APART))
    };
    let far = |&[v, w]: &[u32; 2]| {
        let [v, w] = [v, w].map(|v| owners[v as usize].filter(|_| asks[v as usize]));
        v.zip(w).is_some_and(|(a, b)| are_far_apart(a, b))
    };
    let edges = mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut found: Vec<[u32; 2]> = edges.map(|[v, w]| [v.min(w), v.max(w)]).filter(far).collect();
    found.sort_unstable();
    found.dedup();
    found
}
