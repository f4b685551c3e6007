//! What is wrong with inputs as they come: one flaw each.

use bespoke::geometry::mesh::TriangleMesh;
use glam::DVec3;

use super::{below, between, direction};
use crate::Random;

/// One thing that keeps a scene from being sound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Flaw {
    /// Some triangles have vertices of their own, as along a UV seam.
    Seam,
    /// Every triangle has vertices of its own, as in a mesh exported flat.
    FlatShaded,
    /// A small piece beside the garment.
    Button,
    /// A triangle that stands on an edge that has two already.
    Fin,
    /// A triangle given twice.
    DuplicateTriangle,
    /// A triangle that repeats an index, or whose corners are in one place, or on one line.
    DegenerateTriangle,
    /// A triangle turned over.
    TurnedTriangle,
    /// A vertex that no triangle uses.
    UnusedVertex,
    /// A vertex drawn through the other side.
    Crossing,
    /// The whole garment once more, shifted a little.
    SecondLayer,
    /// The garment moved away from its bones.
    OffCentre,
    /// Limbs that run into each other, with the garment between them.
    ThickBody,
    /// A piece of the body far from the rest.
    FarPiece,
    /// A target in quite another pose.
    OtherPose,
    /// Coordinates so far from the origin that 32 bits are coarse.
    FarAway,
    /// Options at the ends of their ranges.
    HardOptions,
}

impl Flaw {
    /// All of them.
    pub const ALL: [Flaw; 16] = [
        Flaw::Seam,
        Flaw::FlatShaded,
        Flaw::Button,
        Flaw::Fin,
        Flaw::DuplicateTriangle,
        Flaw::DegenerateTriangle,
        Flaw::TurnedTriangle,
        Flaw::UnusedVertex,
        Flaw::Crossing,
        Flaw::SecondLayer,
        Flaw::OffCentre,
        Flaw::ThickBody,
        Flaw::FarPiece,
        Flaw::OtherPose,
        Flaw::FarAway,
        Flaw::HardOptions,
    ];

    /// Does to the meshes what the flaw does to meshes.
    pub(super) fn spoil(self, random: &mut Random, garment: &mut TriangleMesh, avatar: &mut TriangleMesh) {
        let triangle = below(random, garment.triangles.len());
        let corners = garment.triangles[triangle].map(|v| garment.positions[v as usize]);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let edge = a.distance(b);
        match self {
            Flaw::Seam => {
                let middle = garment.positions.iter().sum::<DVec3>() / garment.positions.len() as f64;
                let side = direction(random);
                split(garment, |t| (t.iter().sum::<DVec3>() / 3.0 - middle).dot(side) > 0.0);
            }
            Flaw::FlatShaded => {
                let positions = garment.triangles.iter().flatten().map(|&v| garment.positions[v as usize]).collect();
                garment.positions = positions;
                garment.triangles =
                    (0..garment.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
            }
            Flaw::Button => {
                let place = (a + b + c) / 3.0 + normal * 0.2 * edge;
                let piece = corners.map(|p| place + 0.2 * (p - a));
                add(garment, &[piece[0], piece[1], piece[2], place + 0.1 * edge * normal], &[[0, 1, 2], [1, 0, 3]]);
            }
            Flaw::Fin => {
                let [v, w, _] = garment.triangles[triangle];
                let tip = garment.positions.len() as u32;
                garment.positions.push(a.lerp(b, 0.5) + normal * 0.5 * edge);
                garment.triangles.push([v, w, tip]);
            }
            Flaw::DuplicateTriangle => {
                let [u, v, w] = garment.triangles[triangle];
                garment.triangles.push(if random.unit() < 0.5 { [u, v, w] } else { [w, v, u] });
            }
            Flaw::DegenerateTriangle => {
                let [u, v, w] = garment.triangles[triangle];
                match below(random, 3) {
                    0 => garment.triangles.push([u, v, u]),
                    1 => add(garment, &[a, a, a], &[[0, 1, 2]]),
                    _ => {
                        // A vertex on an edge of one triangle, and the gap filled.
                        let middle = garment.positions.len() as u32;
                        garment.positions.push(a.lerp(b, 0.5));
                        garment.triangles[triangle] = [u, middle, w];
                        garment.triangles.extend([[middle, v, w], [u, v, middle]]);
                    }
                }
            }
            Flaw::TurnedTriangle => garment.triangles[triangle].swap(0, 1),
            Flaw::UnusedVertex => garment.positions.push(10.0 * random.vector()),
            Flaw::Crossing => {
                let far = garment.positions[below(random, garment.positions.len())];
                let v = garment.triangles[triangle][0] as usize;
                garment.positions[v] = a.lerp(far, between(random, 0.3, 1.1));
            }
            Flaw::SecondLayer => {
                let shift = direction(random) * edge * 10f64.powf(-4.0 * random.unit());
                let layer: Vec<DVec3> = garment.positions.iter().map(|&p| p + shift).collect();
                add(garment, &layer, &garment.triangles.clone());
            }
            Flaw::OffCentre => {
                let shift = direction(random) * between(random, 0.02, 0.3);
                garment.positions.iter_mut().for_each(|p| *p += shift);
            }
            Flaw::FarPiece => {
                let place = avatar.positions[0] + direction(random) * 10f64.powf(2.0 * random.unit());
                let piece: Vec<DVec3> = (0..3).map(|_| place + 0.1 * random.vector()).collect();
                add(avatar, &piece, &[[0, 1, 2]]);
            }
            // These are done where the part is made.
            Flaw::ThickBody | Flaw::OtherPose | Flaw::FarAway | Flaw::HardOptions => {}
        }
    }
}

fn add(mesh: &mut TriangleMesh, positions: &[DVec3], triangles: &[[u32; 3]]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend_from_slice(positions);
    mesh.triangles.extend(triangles.iter().map(|t| t.map(|v| first + v)));
}

/// Gives the triangles that `chosen` takes vertices of their own.
fn split(mesh: &mut TriangleMesh, chosen: impl Fn([DVec3; 3]) -> bool) {
    let mut copies = vec![u32::MAX; mesh.positions.len()];
    for t in &mut mesh.triangles {
        if !chosen(t.map(|v| mesh.positions[v as usize])) {
            continue;
        }
        for v in t {
            let copy = &mut copies[*v as usize];
            if *copy == u32::MAX {
                *copy = mesh.positions.len() as u32;
                mesh.positions.push(mesh.positions[*v as usize]);
            }
            *v = *copy;
        }
    }
}
