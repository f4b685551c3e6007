//! Normals and tangents of render vertices, turned as the surface around them has turned.
//!
//! Render vertices are the garment's, split where normals or texture coordinates jump. Those in one place whose normals agree
//! in the design make a smoothing group: each keeps its own normal, turned by the mean over all triangles of the group. So a
//! smooth seam stays smooth, a hard edge hard, and a rigid motion turns every normal exactly. A triangle turns a normal by the
//! inverse transpose of its motion, and a tangent by the motion itself.

use glam::{DVec3, DVec4};

use super::surface::MovedSurface;
use crate::error::{Error, ErrorKind, Result};

/// Normals that were stored in a few bits agree within this: the cosine of 1.5 degrees.
const AGREE: f64 = 0.999_66;

/// Where no normals are given, an edge is hard where the normals of the vertices that meet there differ by more: the cosine of
/// 60 degrees.
const SMOOTH: f64 = 0.5;

/// Below this share of the sum of the weights, directions cancel out.
const CANCELLED: f64 = 1e-6;

/// Vertices as they are drawn.
pub struct RenderVertices {
    /// The vertex of the surface where each of them is; none where no triangle says so.
    places: Vec<Option<u32>>,
    /// Triangle of the surface and corner of it, for each render vertex.
    corners: Vec<Vec<(u32, u8)>>,
    /// Render vertices at each vertex of the surface.
    copies: Vec<Vec<u32>>,
}

impl RenderVertices {
    /// The `count` vertices that `triangles` name, one triangle for each of `surface`.
    ///
    /// # Errors
    /// `InvalidArgument` for another number of triangles, an index out of range, and a render vertex in two places of the
    /// garment.
    pub fn new(surface: &MovedSurface, triangles: &[[u32; 3]], count: usize) -> Result<Self> {
        let fail = |message: String| Err(Error::new(ErrorKind::InvalidArgument, message));
        if triangles.len() != surface.triangles.len() {
            return fail(format!(
                "triangles of the render vertices: there are {}, the garment has {}; they are those of the garment, in its order",
                triangles.len(),
                surface.triangles.len()
            ));
        }
        let mut places = vec![None; count];
        let mut corners = vec![Vec::new(); count];
        let mut copies = vec![Vec::new(); surface.rest.len()];
        for (t, (own, under)) in triangles.iter().zip(&surface.triangles).enumerate() {
            for corner in 0..3 {
                let (vertex, place) = (own[corner], under[corner]);
                let Some(known) = places.get_mut(vertex as usize) else {
                    return fail(format!(
                        "triangles of the render vertices: triangle {t} names vertex {vertex}, there are {count}"
                    ));
                };
                match *known {
                    None => {
                        *known = Some(place);
                        copies[place as usize].push(vertex);
                    }
                    Some(other) if other != place => {
                        return fail(format!(
                            "triangles of the render vertices: vertex {vertex} is in two places of the garment, in triangle {t} \
                             and in one before it; the triangles are to be in the order in which the garment has them"
                        ));
                    }
                    Some(_) => {}
                }
                corners[vertex as usize].push((t as u32, corner as u8));
            }
        }
        Ok(Self { places, corners, copies })
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// Normals of the design, of unit length, where none are given: of each vertex the mean over its triangles by their angles,
    /// and one for vertices in one place that differ by no more than a smooth edge does. Zero where there is no triangle.
    pub fn designed_normals(&self, surface: &MovedSurface) -> Vec<DVec3> {
        let sum_of = |vertex: u32| -> DVec3 {
            let corners = self.corners[vertex as usize].iter();
            let normals = corners.filter_map(|&(t, k)| {
                Some(surface.angle_at_rest(t as usize, usize::from(k)) * surface.normal_at_rest(t as usize)?)
            });
            normals.sum()
        };
        let sums: Vec<DVec3> = (0..self.count() as u32).map(sum_of).collect();
        let own: Vec<DVec3> = sums.iter().map(|sum| sum.normalize_or_zero()).collect();
        let mut normals = own.clone();
        for group in self.groups(|a, b| own[a].dot(own[b]) >= SMOOTH) {
            let shared: DVec3 = group.iter().map(|&v| sums[v as usize]).sum();
            if let Some(shared) = shared.try_normalize() {
                group.iter().for_each(|&v| normals[v as usize] = shared);
            }
        }
        normals
    }

    /// Vertices in one place that agree with the first of their group.
    fn groups(&self, agree: impl Fn(usize, usize) -> bool) -> Vec<Vec<u32>> {
        let mut all: Vec<Vec<u32>> = Vec::new();
        for copies in &self.copies {
            let first = all.len();
            for &v in copies {
                match all[first..].iter_mut().find(|group| agree(group[0] as usize, v as usize)) {
                    Some(group) => group.push(v),
                    None => all.push(vec![v]),
                }
            }
        }
        all
    }

    /// The unit normals of the vertices now, from those of the design, of any length. One of length 0, and one of a vertex
    /// without triangles, stays as it is.
    pub fn normals(&self, surface: &MovedSurface, designed: &[DVec3]) -> Vec<DVec3> {
        let unit: Vec<DVec3> = designed.iter().map(|n| n.normalize_or_zero()).collect();
        let mut turned = unit.clone();
        for group in self.groups(|a, b| unit[a].dot(unit[b]) >= AGREE) {
            let corners = self.weighed(surface, &group);
            for &v in &group {
                let normal = unit[v as usize];
                let images =
                    corners.iter().filter_map(|&(weight, t)| Some((weight, surface.motions[t]?.of_normal(normal))));
                if let Some(image) = mean_direction(images) {
                    turned[v as usize] = image;
                }
            }
        }
        turned
    }

    /// The unit tangents of the vertices now, perpendicular to `normals`, which are those of now; `w`, the handedness of the
    /// bitangent, stays. `designed` are the normals of the design.
    pub fn tangents(
        &self,
        surface: &MovedSurface,
        designed: &[DVec3],
        tangents: &[DVec4],
        normals: &[DVec3],
    ) -> Vec<DVec4> {
        let unit: Vec<DVec3> = designed.iter().map(|n| n.normalize_or_zero()).collect();
        let along: Vec<DVec3> = tangents.iter().map(|t| t.truncate().normalize_or_zero()).collect();
        let mut turned = along.clone();
        let agree = |a: usize, b: usize| {
            unit[a].dot(unit[b]) >= AGREE && along[a].dot(along[b]) >= AGREE && tangents[a].w == tangents[b].w
        };
        for group in self.groups(agree) {
            let corners = self.weighed(surface, &group);
            for &v in &group {
                let images = corners
                    .iter()
                    .filter_map(|&(weight, t)| Some((weight, surface.motions[t]?.of_vector(along[v as usize]))));
                if let Some(image) = mean_direction(images) {
                    turned[v as usize] = image;
                }
            }
        }
        let within = |(v, &tangent): (usize, &DVec3)| {
            let normal = normals[v];
            let flat = tangent - normal * normal.dot(tangent);
            let unit = flat
                .try_normalize()
                .unwrap_or_else(|| normal.try_normalize().unwrap_or(DVec3::Z).any_orthonormal_vector());
            unit.extend(tangents[v].w)
        };
        turned.iter().enumerate().map(within).collect()
    }

    /// The triangles at these vertices with their angles now.
    fn weighed(&self, surface: &MovedSurface, group: &[u32]) -> Vec<(f64, usize)> {
        let corners = group.iter().flat_map(|&v| &self.corners[v as usize]);
        corners.map(|&(t, k)| (surface.angle_now(t as usize, usize::from(k)), t as usize)).collect()
    }
}

/// The direction of the weighted mean of these directions, or the heaviest where they cancel out; none without any.
fn mean_direction(images: impl Iterator<Item = (f64, DVec3)>) -> Option<DVec3> {
    let (mut sum, mut total, mut heaviest) = (DVec3::ZERO, 0.0, (0.0, None));
    for (weight, image) in images {
        let Some(image) = image.try_normalize() else { continue };
        sum += weight * image;
        total += weight;
        if weight > heaviest.0 {
            heaviest = (weight, Some(image));
        }
    }
    if sum.length() <= CANCELLED * total { heaviest.1 } else { sum.try_normalize().or(heaviest.1) }
}
