//! Meshes of solids: the zero set of a function, cut open by other functions, in regular triangles.

use glam::DVec3;

use super::clip::{clip, score};
use super::implicit::value_and_gradient;
use super::mesh::Mesh;
use super::polygonize::polygonize;
use super::remesh::{Surface, remesh};

/// A function of points in space.
pub type Function<'a> = Box<dyn Fn(DVec3) -> f64 + Sync + 'a>;

/// What is to be meshed.
pub struct Design<'a> {
    /// Negative inside, about the distance near the surface.
    pub solid: Function<'a>,
    /// The surface is kept where all of these are negative; they become the boundary curves, at most 32.
    pub cuts: Vec<Function<'a>>,
    /// The wanted edge length at a point, in metres.
    pub edge_length: Function<'a>,
    /// The corners of a box around the solid.
    pub bounds: [DVec3; 2],
    /// Cell of the first, coarse mesh in metres: parts and gaps must be wider.
    pub cell: f64,
    /// Rounds of remeshing: three for good triangles, four where cuts leave slivers.
    pub rounds: usize,
}

/// A line on the surface along which edges run, so that it can bend sharply there.
pub struct Seam<'a> {
    /// The seam is where this is zero; about a distance.
    pub function: Function<'a>,
    /// Where the seam exists.
    pub within: Box<dyn Fn(DVec3) -> bool + Sync + 'a>,
}

impl Design<'_> {
    /// Makes the mesh: the largest component of the surface.
    pub fn mesh(&self) -> Mesh {
        self.sewn(&[], &[])
    }

    /// The same with seams (with the cuts at most 32), and with a vertex of the boundary at the point of the surface
    /// nearest to each of `corners`: where a cut turns sharply.
    pub fn sewn(&self, seams: &[Seam], corners: &[DVec3]) -> Mesh {
        let mut mesh = polygonize(&self.solid, self.bounds, self.cell);
        let mut marks = vec![0; mesh.positions.len()];
        for (index, cut) in self.cuts.iter().enumerate() {
            clip(&mut mesh, &mut marks, 1 << index, cut);
        }
        let sewn = Sewn { design: self, seams };
        for (index, seam) in seams.iter().enumerate() {
            let mark = 1 << (self.cuts.len() + index);
            score(&mut mesh, &mut marks, mark, sewn.seams(), &seam.function, &seam.within);
        }
        let (component, count) = mesh.components();
        let mut sizes = vec![0; count];
        for &c in &component {
            sizes[c as usize] += 1;
        }
        let largest = (0..count as u32).max_by_key(|&c| (sizes[c as usize], std::cmp::Reverse(c)));
        let old = mesh.retain(|triangle| Some(component[triangle[0] as usize]) == largest);
        marks = old.iter().map(|&v| marks[v as usize]).collect();
        for &corner in corners {
            let mut point = corner;
            for _ in 0..5 {
                let (f, df) = value_and_gradient(&self.solid, point);
                point -= f * df / df.length_squared().max(1e-3);
            }
            let cuts = !sewn.seams();
            let on_boundary = (0..marks.len()).filter(|&v| marks[v] & cuts != 0);
            let distance = |v: &usize| mesh.positions[*v].distance_squared(point);
            if let Some(nearest) = on_boundary.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
                mesh.positions[nearest] = point;
                // A vertex on several curves stays where it is, and is an end for each of them.
                marks[nearest] |= cuts;
            }
        }
        remesh(&mut mesh, &mut marks, &sewn, self.rounds);
        mesh
    }
}

/// A design with its seams, whose bits follow those of the cuts.
struct Sewn<'a> {
    design: &'a Design<'a>,
    seams: &'a [Seam<'a>],
}

impl Surface for Sewn<'_> {
    fn edge_length(&self, point: DVec3) -> f64 {
        (self.design.edge_length)(point)
    }

    fn settle(&self, point: DVec3, mark: u32) -> DVec3 {
        const LARGEST_STEP: f64 = 0.02;
        let mut point = point;
        for _ in 0..if mark == 0 { 1 } else { 3 } {
            let (f, df) = value_and_gradient(&self.design.solid, point);
            let mut step = -f * df / df.length_squared().max(1e-3);
            if mark.count_ones() == 1 {
                // The shortest step to where both functions are zero to first order.
                let (index, cuts) = (mark.trailing_zeros() as usize, &self.design.cuts);
                let curve = cuts.get(index).unwrap_or_else(|| &self.seams[index - cuts.len()].function);
                let (g, dg) = value_and_gradient(curve, point);
                let (ff, fg, gg) = (df.length_squared(), df.dot(dg), dg.length_squared());
                let determinant = ff * gg - fg * fg;
                if determinant > 1e-3 * ff * gg {
                    step = ((fg * g - gg * f) * df + (fg * f - ff * g) * dg) / determinant;
                }
            }
            point += step.clamp_length_max(LARGEST_STEP);
        }
        point
    }

    fn seams(&self) -> u32 {
        (0..self.seams.len()).fold(0, |bits, index| bits | 1 << (self.design.cuts.len() + index))
    }
}
