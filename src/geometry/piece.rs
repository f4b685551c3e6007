//! The connected pieces of a mesh.

use glam::DVec3;

use super::mesh::{NO_PIECE, TriangleMesh, label_pieces, triangle_area};

/// A connected part of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its vertices, ascending.
    pub vertices: Vec<u32>,
    /// Its triangles, ascending.
    pub triangles: Vec<u32>,
    /// The area of these.
    pub area: f64,
    /// The corner of its bounding box with the least coordinates.
    pub low: DVec3,
    /// The corner of its bounding box with the largest coordinates.
    pub high: DVec3,
}

impl Piece {
    /// The pieces of a mesh with vertices `positions`, triangles without area included, in the order of their lowest vertices.
    /// The vertices of a link belong to one piece, as those of a triangle do.
    pub fn find(positions: &[DVec3], triangles: &[[u32; 3]], links: impl IntoIterator<Item = [u32; 2]>) -> Vec<Self> {
        let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
        let (labels, count) = label_pieces(positions.len(), sides.chain(links));
        let (low, high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let empty = Self { vertices: Vec::new(), triangles: Vec::new(), area: 0.0, low, high };
        let mut pieces = vec![empty; count];
        for ((v, &label), &p) in (0u32..).zip(&labels).zip(positions) {
            if label != NO_PIECE {
                let piece = &mut pieces[label as usize];
                piece.vertices.push(v);
                (piece.low, piece.high) = (piece.low.min(p), piece.high.max(p));
            }
        }
        for (k, t) in (0u32..).zip(triangles) {
            let piece = &mut pieces[labels[t[0] as usize] as usize];
            piece.triangles.push(k);
            piece.area += triangle_area(t.map(|v| positions[v as usize]));
        }
        pieces
    }

    /// The diagonal of its bounding box.
    pub fn size(&self) -> f64 {
        self.low.distance(self.high)
    }

    /// The longest side of its bounding box.
    pub fn longest_side(&self) -> f64 {
        (self.high - self.low).max_element()
    }

    /// The distance between two bounding boxes.
    pub fn gap(&self, other: &Self) -> f64 {
        (self.low - other.high).max(other.low - self.high).max(DVec3::ZERO).length()
    }

    /// Its triangles, which share no vertices.
    pub fn mesh(&self, positions: &[DVec3], triangles: &[[u32; 3]]) -> TriangleMesh {
        let corners = |&t: &u32| triangles[t as usize].map(|v| positions[v as usize]);
        TriangleMesh::from_corners(self.triangles.iter().map(corners))
    }

    /// Makes one piece of two.
    pub fn merge(&mut self, other: Self) {
        self.vertices.extend(other.vertices);
        self.vertices.sort_unstable();
        self.triangles.extend(other.triangles);
        self.triangles.sort_unstable();
        self.area += other.area;
        (self.low, self.high) = (self.low.min(other.low), self.high.max(other.high));
    }
}
