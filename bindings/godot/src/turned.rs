//! How a surface has turned: normals, tangents and blend shapes of what goes along with the garment.

use std::collections::HashMap;

use glam::{DMat3, DVec3};

use crate::mesh::BlendShape;

/// For each vertex, how the surface around it has turned and grown.
pub struct Turns(Vec<(DMat3, f64)>);

/// What is summed up around a place.
#[derive(Clone, Copy, Default)]
struct Around {
    /// Area and direction of the triangles.
    across: [DVec3; 2],
    area: [f64; 2],
    /// An edge, so that a turn around the normal is seen.
    along: Option<[DVec3; 2]>,
}

impl Turns {
    /// From one shape of a mesh to another one. Vertices in one place turn alike.
    pub fn new(triangles: &[[u32; 3]], before: &[[f32; 3]], after: &[[f32; 3]]) -> Self {
        let mut places = HashMap::new();
        let place: Vec<usize> = before
            .iter()
            .map(|point| {
                let next = places.len();
                *places.entry(point.map(f32::to_bits)).or_insert(next)
            })
            .collect();
        let mut around = vec![Around::default(); places.len()];
        for corners in triangles {
            let corner = |points: &[[f32; 3]], k: usize| points.get(corners[k] as usize).copied().map(wide);
            let shape = |points| Some([corner(points, 0)?, corner(points, 1)?, corner(points, 2)?]);
            let (Some(was), Some(is)) = (shape(before), shape(after)) else { continue };
            for k in 0..3 {
                let there = &mut around[place[corners[k] as usize]];
                for (side, [a, b, c]) in [was, is].into_iter().enumerate() {
                    let across = (b - a).cross(c - a);
                    there.across[side] += across;
                    there.area[side] += across.length();
                }
                let next = (k + 1) % 3;
                there.along.get_or_insert([was[next] - was[k], is[next] - is[k]]);
            }
        }
        let turn = |around: &Around| {
            let along = around.along?;
            let [was, is] = [0, 1].map(|side| frame(around.across[side], along[side]));
            let size = (around.area[1] / around.area[0]).sqrt();
            size.is_finite().then_some((is? * was?.transpose(), size))
        };
        let turns: Vec<_> = around.iter().map(|one| turn(one).unwrap_or((DMat3::IDENTITY, 1.0))).collect();
        Self(place.into_iter().map(|place| turns[place]).collect())
    }

    /// Normals that have turned so.
    pub fn normals(&self, normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        normals.iter().zip(&self.0).map(|(&normal, (turn, _))| narrow(*turn * wide(normal))).collect()
    }

    /// Tangents that have turned so.
    pub fn tangents(&self, tangents: &[[f32; 4]]) -> Vec<[f32; 4]> {
        let turned = |(&[x, y, z, w], (turn, _)): (&[f32; 4], &(DMat3, f64))| {
            let [x, y, z] = narrow(*turn * wide([x, y, z]));
            [x, y, z, w]
        };
        tangents.iter().zip(&self.0).map(turned).collect()
    }

    /// A blend shape that has turned and grown so.
    pub fn shape(&self, shape: &BlendShape) -> BlendShape {
        let offset = |(&offset, (turn, size)): (&[f32; 3], &(DMat3, f64))| narrow(*turn * wide(offset) * *size);
        BlendShape {
            name: shape.name.clone(),
            offsets: shape.offsets.iter().zip(&self.0).map(offset).collect(),
            normals: self.normals(&shape.normals),
            tangents: self.tangents(&shape.tangents),
        }
    }
}

/// Axes of a surface: its normal, and an edge as far as it is perpendicular to that.
fn frame(across: DVec3, along: DVec3) -> Option<DMat3> {
    let normal = across.try_normalize()?;
    let side = along.reject_from_normalized(normal).try_normalize()?;
    Some(DMat3::from_cols(side, normal.cross(side), normal))
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}
