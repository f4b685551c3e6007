//! A solid in the making: shapes are pressed onto it, each with the joints that move it and the triangles it needs.

use glam::{DMat3, DVec3};

use super::super::Sample;
use super::super::implicit::{Field, Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::mesh::Mesh;
use super::super::parts::Parts;
use super::super::skeleton::{JOINTS, Skeleton};
use super::super::skin::skin;
use super::super::surface::Design;
use super::sweep::spline;

/// Left (+x) and right.
pub const SIDES: [f64; 2] = [1.0, -1.0];

/// A place with its own directions and size, in which parts are modelled as on the mannequin.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Where its origin is, in metres.
    pub origin: DVec3,
    /// A rotation: its x, y and z directions in the world.
    pub rotation: DMat3,
    /// The length of its unit, in metres.
    pub size: f64,
}

impl Frame {
    /// Along the world's axes.
    pub fn upright(origin: DVec3, size: f64) -> Self {
        Self { origin, rotation: DMat3::IDENTITY, size }
    }

    /// The point with these coordinates.
    pub fn at(&self, x: f64, y: f64, z: f64) -> DVec3 {
        self.origin + self.rotation * (self.size * DVec3::new(x, y, z))
    }
}

/// A closed part of a body.
#[derive(Clone, Debug)]
pub struct Clay {
    field: Field,
    coarse: f64,
    cell: f64,
    /// Capsules of finer triangles: both ends of the axis, radius, edge length.
    fine: Vec<([DVec3; 2], f64, f64)>,
}

impl Clay {
    /// Nothing yet; its triangles will have edges of about `coarse` metres. Gaps finer than `cell` metres close up.
    pub fn new(coarse: f64, cell: f64) -> Self {
        Self { field: Field::default(), coarse, cell, fine: Vec::new() }
    }

    /// Asks for edges of about `edge` metres within `radius` of `centre`, growing slowly beyond.
    pub fn refine(&mut self, centre: DVec3, radius: f64, edge: f64) {
        self.refine_along([centre; 2], radius, edge);
    }

    /// Asks for edges of about `edge` metres within `radius` of a line, growing slowly beyond.
    pub fn refine_along(&mut self, line: [DVec3; 2], radius: f64, edge: f64) {
        self.fine.push((line, radius, edge));
    }

    /// Joins any shape, rounding the seam over about `blend` metres.
    pub fn add(&mut self, shape: Shape, blend: f64, owner: Owner) {
        self.field.add(shape, blend, owner);
    }

    /// Takes any shape away from what is there, rounding the rim over about `blend` metres.
    pub fn carve(&mut self, shape: Shape, blend: f64, owner: Owner) {
        self.field.carve(shape, blend, owner);
    }

    /// Joins an ellipsoid along the world's axes; all in metres.
    pub fn ball(&mut self, centre: DVec3, radii: [f64; 3], blend: f64, owner: Owner) {
        self.add(Shape::ellipsoid(centre, DVec3::from_array(radii)), blend, owner);
    }

    /// Joins a loft along a straight axis.
    pub fn loft(&mut self, from: DVec3, to: DVec3, sections: &[Section], blend: f64, owner: Owner) {
        self.add(Shape::Loft(Loft::new(from, to, DVec3::Y, sections)), blend, owner);
    }

    /// Joins a round tube along a smooth curve through `points` (at least two), with a radius at each of them.
    pub fn tube(&mut self, points: &[DVec3], radii: &[f64], blend: f64, owner: Owner) {
        const PIECES: usize = 4;
        let last = points.len() - 1;
        let smooth = |t: f64| {
            let i = (t as usize).min(last - 1);
            (spline(t, last, |i| points[i]), radii[i] + (radii[i + 1] - radii[i]) * (t - i as f64))
        };
        let pieces = if last == 1 { 1 } else { PIECES * last };
        for piece in 0..pieces {
            let [(p, r), (q, s)] = [piece, piece + 1].map(|k| smooth((k * last) as f64 / pieces as f64));
            let sections = [Section::circle(0.0, r), Section::circle(1.0, s)];
            // Pieces of one tube join seamlessly without rounding.
            let blend = if piece == 0 { blend } else { blend.min(0.4 * r.min(s)) };
            let back = if (q - p).normalize().y.abs() < 0.9 { DVec3::Y } else { DVec3::Z };
            self.add(Shape::Loft(Loft::new(p, q, back, &sections)), blend, owner);
        }
    }

    /// Joins an ellipsoid that is given in a frame.
    pub fn lump(&mut self, frame: &Frame, centre: [f64; 3], radii: [f64; 3], blend: f64, owner: Owner) {
        self.add(in_frame(frame, centre, radii), blend * frame.size, owner);
    }

    /// Takes an ellipsoid away that is given in a frame.
    pub fn hollow(&mut self, frame: &Frame, centre: [f64; 3], radii: [f64; 3], blend: f64, owner: Owner) {
        self.carve(in_frame(frame, centre, radii), blend * frame.size, owner);
    }

    /// The triangles and their skin.
    pub fn harden(self) -> Part {
        const GROWTH: f64 = 0.2;
        let Self { field, coarse, cell, fine } = self;
        let field = field.finish();
        let solid = |p: DVec3| field.value(p);
        let edge_length = |p: DVec3| {
            fine.iter().fold(coarse, |length, ([start, end], radius, edge)| {
                let axis = *end - *start;
                let t = ((p - *start).dot(axis) / axis.length_squared().max(1e-12)).clamp(0.0, 1.0);
                length.min(edge + GROWTH * (p.distance(*start + t * axis) - radius).max(0.0))
            })
        };
        let design = Design {
            solid: Box::new(solid),
            cuts: Vec::new(),
            edge_length: Box::new(edge_length),
            bounds: field.bounds(),
            cell,
            rounds: 4,
        };
        let mesh = design.mesh();
        let weights = skin(&mesh, &field);
        (mesh, weights)
    }
}

/// An ellipsoid given in a frame.
fn in_frame(frame: &Frame, [x, y, z]: [f64; 3], radii: [f64; 3]) -> Shape {
    let radii = frame.size * DVec3::from_array(radii);
    Shape::Ellipsoid { centre: frame.at(x, y, z), radii, rotation: frame.rotation }
}

/// A closed part of a body, with its skin: one row a joint, one weight a vertex.
pub type Part = (Mesh, Vec<Vec<f64>>);

/// A part that one joint moves.
pub fn rigid(mesh: Mesh, joint: usize) -> Part {
    let count = mesh.positions.len();
    let rows = (0..JOINTS).map(|row| vec![if row == joint { 1.0 } else { 0.0 }; count]).collect();
    (mesh, rows)
}

/// One body of several closed parts.
pub fn assemble(skeleton: Skeleton, parts: Vec<Part>) -> Sample {
    let mut body = Parts::default();
    for (mesh, weights) in parts {
        body.add_skinned(&mesh, weights);
    }
    body.sample(skeleton)
}
