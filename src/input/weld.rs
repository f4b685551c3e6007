//! Vertex welding: from a garment as modelling tools store it, with split vertices, to one surface, and back.

use super::diagnostic::Diagnostic;
use super::near_seams::{close_seams, mean_edge};
use crate::geometry::mesh::{TriangleMesh, has_area};

/// A garment whose vertices at equal positions are one vertex, and the maps back to the caller's indices.
///
/// Vertices in the caller's order, triangles in the caller's order and winding: a garment without split vertices and
/// faulty triangles stays as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weld {
    /// The welded garment, without duplicate triangles.
    pub mesh: TriangleMesh,
    /// The welded vertex of each of the caller's vertices.
    pub to_welded: Vec<u32>,
    /// The caller's vertex that each welded vertex is, the lowest where there are several.
    pub vertex_of: Vec<u32>,
    /// The caller's triangle that each triangle of the welded garment is.
    pub triangle_of: Vec<u32>,
    /// The triangle of the welded garment that each of the caller's is, or is a duplicate of; none where it is left out.
    pub to_kept: Vec<Option<u32>>,
}

/// A triangle with two corners at one position.
struct Collapsed {
    triangle: u32,
    kept: bool,
}

impl Weld {
    /// Welds `garment`, which has passed [`TriangleMesh::check`], and reports diagnostics about it.
    ///
    /// Vertices at equal positions (to the last bit, but -0 is 0) become one. Of the triangles with the same three
    /// corners in any order, such as two sides modelled at the same positions, the first is kept. A triangle that
    /// repeats a corner is kept only where it is the first to hold an edge, as an edge for contact; no energy uses it.
    pub fn new(garment: &TriangleMesh) -> (Self, Vec<Diagnostic>) {
        Self::closing_seams(garment, 0.0)
    }

    /// The same, and open seams whose sides are nearer than `share` of the mean edge are closed (see
    /// [`super::near_seams`]): of the vertices there the lowest gives the position.
    pub fn closing_seams(garment: &TriangleMesh, share: f64) -> (Self, Vec<Diagnostic>) {
        let (mut to_welded, mut vertex_of) = weld_vertices(garment);
        let mut diagnostics = split_vertices(&to_welded, vertex_of.len());
        if share > 0.0 {
            diagnostics.extend(close_near_seams(garment, share, &mut to_welded, &mut vertex_of));
        }
        let corners: Vec<[u32; 3]> = garment.triangles.iter().map(|t| t.map(|v| to_welded[v as usize])).collect();
        let duplicates = duplicates(&corners);
        let mut keep: Vec<bool> = corners.iter().map(is_face).collect();
        duplicates.iter().for_each(|&[copy, _]| keep[copy as usize] = false);
        let (crowded, collapsed) = edges(&corners, &mut keep);

        let triangle_of: Vec<u32> = (0..corners.len() as u32).filter(|&t| keep[t as usize]).collect();
        let mesh = TriangleMesh {
            positions: vertex_of.iter().map(|&v| garment.positions[v as usize]).collect(),
            triangles: triangle_of.iter().map(|&t| corners[t as usize]).collect(),
        };
        let mut to_kept = vec![None; corners.len()];
        (0u32..).zip(&triangle_of).for_each(|(k, &t)| to_kept[t as usize] = Some(k));
        duplicates.iter().for_each(|&[copy, first]| to_kept[copy as usize] = to_kept[first as usize]);
        let weld = Self { mesh, to_welded, vertex_of, triangle_of, to_kept };
        Diagnostic::list(&mut diagnostics, &duplicates, |&[triangle, of]| Diagnostic::DuplicateTriangle {
            triangle,
            of,
        });
        weld.report_degenerate(&mut diagnostics, garment, &collapsed);
        weld.report_crowded(&mut diagnostics, &crowded);
        weld.report_unused(&mut diagnostics);
        (weld, diagnostics)
    }

    /// Scatters values of the welded vertices to the caller's: copies of one vertex get the same bits.
    pub fn scatter<T: Copy>(&self, welded: &[T]) -> Vec<T> {
        self.to_welded.iter().map(|&w| welded[w as usize]).collect()
    }

    /// Scatters values of the welded triangles to the caller's: duplicates get that of the one that counts, and
    /// triangles that are left out 0.
    pub fn scatter_triangles(&self, values: &[f64]) -> Vec<f64> {
        self.to_kept.iter().map(|kept| kept.map_or(0.0, |k| values[k as usize])).collect()
    }

    /// Gathers values of the caller's vertices, for each welded one the mean over the copies, so that no side of a seam
    /// outweighs the other. Equal copies give the same bits.
    pub fn gather(&self, values: &[f64]) -> Vec<f64> {
        let mut means = vec![0.0; self.vertex_of.len()];
        let mut counts = vec![0.0; self.vertex_of.len()];
        for (&w, &value) in self.to_welded.iter().zip(values) {
            let (mean, count): (&mut f64, &mut f64) = (&mut means[w as usize], &mut counts[w as usize]);
            *count += 1.0;
            // A running mean: a sum of large weights could overflow.
            *mean += (value - *mean) / *count;
        }
        means
    }

    /// Without the triangles of the welded garment that are `removed`; its vertices stay. Of the caller's triangles those that
    /// it had, and their duplicates, are left out.
    pub fn without(&self, removed: &[bool]) -> Self {
        let stay: Vec<u32> = (0u32..).zip(removed).filter(|(_, removed)| !**removed).map(|(t, _)| t).collect();
        let renumbered = |t: u32| stay.binary_search(&t).ok().map(|k| k as u32);
        Self {
            mesh: TriangleMesh {
                positions: self.mesh.positions.clone(),
                triangles: stay.iter().map(|&t| self.mesh.triangles[t as usize]).collect(),
            },
            to_welded: self.to_welded.clone(),
            vertex_of: self.vertex_of.clone(),
            triangle_of: stay.iter().map(|&t| self.triangle_of[t as usize]).collect(),
            to_kept: self.to_kept.iter().map(|kept| kept.and_then(renumbered)).collect(),
        }
    }

    fn report_degenerate(&self, diagnostics: &mut Vec<Diagnostic>, garment: &TriangleMesh, collapsed: &[Collapsed]) {
        Diagnostic::list(diagnostics, collapsed, |&Collapsed { triangle, kept }| Diagnostic::CollapsedTriangle {
            triangle,
            corners: garment.triangles[triangle as usize],
            kept,
        });
        let flat: Vec<u32> = (0..self.mesh.triangles.len())
            .filter(|&k| {
                let corners = self.mesh.triangles[k];
                is_face(&corners) && !has_area(corners.map(|v| self.mesh.positions[v as usize]))
            })
            .map(|k| self.triangle_of[k])
            .collect();
        Diagnostic::list(diagnostics, &flat, |&triangle| Diagnostic::FlatTriangle {
            triangle,
            corners: garment.triangles[triangle as usize],
        });
    }

    fn report_crowded(&self, diagnostics: &mut Vec<Diagnostic>, crowded: &[([u32; 2], u32)]) {
        Diagnostic::list(diagnostics, crowded, |&(edge, triangles)| Diagnostic::NonManifoldEdge {
            vertices: edge.map(|w| self.vertex_of[w as usize]),
            triangles,
        });
    }

    fn report_unused(&self, diagnostics: &mut Vec<Diagnostic>) {
        let used = self.mesh.used_vertices();
        let unused: Vec<u32> =
            (0..self.to_welded.len() as u32).filter(|&v| !used[self.to_welded[v as usize] as usize]).collect();
        Diagnostic::list(diagnostics, &unused, |&vertex| Diagnostic::UnusedVertex { vertex });
    }
}

/// The welded vertex of each vertex, and the lowest vertex of each welded one, in the order of those.
pub fn weld_vertices(garment: &TriangleMesh) -> (Vec<u32>, Vec<u32>) {
    // Adding 0 turns -0 into 0.
    let key = |v: u32| garment.positions[v as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut order: Vec<([u64; 3], u32)> = (0..garment.positions.len() as u32).map(|v| (key(v), v)).collect();
    order.sort_unstable();
    let mut lowest = vec![0; order.len()];
    for place in order.chunk_by(|a, b| a.0 == b.0) {
        place.iter().for_each(|&(_, v)| lowest[v as usize] = place[0].1);
    }
    let mut to_welded = Vec::with_capacity(lowest.len());
    let mut vertex_of = Vec::new();
    for (v, &low) in lowest.iter().enumerate() {
        if low as usize == v {
            to_welded.push(vertex_of.len() as u32);
            vertex_of.push(low);
        } else {
            to_welded.push(to_welded[low as usize]);
        }
    }
    (to_welded, vertex_of)
}

/// Vertices that share their place with another; `to_welded` leads to one of `places` places.
fn split_vertices(to_welded: &[u32], places: usize) -> Vec<Diagnostic> {
    let vertices = to_welded.len();
    if vertices == places {
        return Vec::new();
    }
    let mut copies = vec![0u32; places];
    to_welded.iter().for_each(|&w| copies[w as usize] += 1);
    let shared_places = copies.iter().filter(|&&n| n > 1).count();
    let split = (0..vertices as u32).filter(|&v| copies[to_welded[v as usize] as usize] > 1);
    let (sharing, first) = (vertices - places + shared_places, split.take(4).collect());
    vec![Diagnostic::SplitVertices { sharing, vertices, shared_places, places, first }]
}

/// Closes the seams of `garment`, welded as in the two maps, whose sides are nearer than `share` of the mean edge: changes
/// the maps.
fn close_near_seams(
    garment: &TriangleMesh,
    share: f64,
    to_welded: &mut [u32],
    vertex_of: &mut Vec<u32>,
) -> Option<Diagnostic> {
    let corners: Vec<[u32; 3]> = garment.triangles.iter().map(|t| t.map(|v| to_welded[v as usize])).collect();
    // A copy of a triangle is no other side of its edges.
    let mut copies = duplicates(&corners).into_iter().map(|[copy, _]| copy).peekable();
    let triangles = (0u32..).zip(corners).filter(|&(t, _)| copies.next_if_eq(&t).is_none()).map(|(_, t)| t).collect();
    let exact =
        TriangleMesh { positions: vertex_of.iter().map(|&v| garment.positions[v as usize]).collect(), triangles };
    let lowest = close_seams(&exact, share * mean_edge(&exact));
    let welded: Vec<u32> = (0u32..).zip(&lowest).filter(|&(v, &low)| v != low).map(|(v, _)| v).collect();
    let &first = welded.first()?;
    let at = |v: u32| exact.positions[v as usize];
    let gap = welded.iter().map(|&v| at(v).distance(at(lowest[v as usize]))).fold(0.0, f64::max);
    let mut places: Vec<u32> = welded.iter().map(|&v| lowest[v as usize]).collect();
    places.sort_unstable();
    places.dedup();
    let named = |v: &u32| lowest[*v as usize] == lowest[first as usize];
    let named = (0..exact.positions.len() as u32).filter(named).map(|v| vertex_of[v as usize]).take(4).collect();
    // The lowest keep their order.
    let mut number = vec![0; lowest.len()];
    let mut kept = Vec::new();
    for (v, &low) in lowest.iter().enumerate() {
        number[v] = if low as usize == v { kept.len() as u32 } else { number[low as usize] };
        if low as usize == v {
            kept.push(vertex_of[v]);
        }
    }
    to_welded.iter_mut().for_each(|w| *w = number[*w as usize]);
    *vertex_of = kept;
    Some(Diagnostic::WeldedNear { places: places.len(), first: named, gap })
}

fn is_face(&[a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

/// Faces with the corners of an earlier one, each with that, in ascending order.
fn duplicates(corners: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sorted = |mut t: [u32; 3]| {
        t.sort_unstable();
        t
    };
    let mut faces: Vec<([u32; 3], u32)> =
        (0u32..).zip(corners).filter(|(_, t)| is_face(t)).map(|(k, &t)| (sorted(t), k)).collect();
    faces.sort_unstable();
    let same = faces.chunk_by(|a, b| a.0 == b.0);
    let mut copies: Vec<[u32; 2]> = same.flat_map(|c| c[1..].iter().map(|&(_, k)| [k, c[0].1])).collect();
    copies.sort_unstable();
    copies
}

/// Edges with more than two of the kept faces and how many these are; and what becomes of triangles that repeat a corner,
/// of which those that are the first to hold an edge are added to `keep`.
fn edges(corners: &[[u32; 3]], keep: &mut [bool]) -> (Vec<([u32; 2], u32)>, Vec<Collapsed>) {
    let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| [a.min(b), a.max(b)]);
    let mut edges: Vec<[u32; 2]> =
        corners.iter().zip(&*keep).filter(|(_, keep)| **keep).flat_map(|(t, _)| sides(t)).collect();
    edges.sort_unstable();
    let crowded = edges.chunk_by(|a, b| a == b).filter(|e| e.len() > 2).map(|e| (e[0], e.len() as u32)).collect();
    edges.dedup();

    // The one edge of a triangle that repeats a corner, none for a point.
    let wire = |t: &[u32; 3]| sides(t).into_iter().find(|[a, b]| a != b);
    let mut wires: Vec<([u32; 2], u32)> = (0u32..)
        .zip(corners)
        .filter(|(_, t)| !is_face(t))
        .filter_map(|(k, t)| wire(t).filter(|e| edges.binary_search(e).is_err()).map(|e| (e, k)))
        .collect();
    wires.sort_unstable();
    wires.chunk_by(|a, b| a.0 == b.0).for_each(|same| keep[same[0].1 as usize] = true);
    let collapsed = (0u32..)
        .zip(corners)
        .filter(|(_, t)| !is_face(t))
        .map(|(k, _)| Collapsed { triangle: k, kept: keep[k as usize] })
        .collect();
    (crowded, collapsed)
}
