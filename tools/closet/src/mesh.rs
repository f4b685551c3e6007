//! Triangle meshes and the edges of their triangles.

use glam::DVec3;

/// Marks the missing second triangle of a boundary edge.
pub const NONE: u32 = u32::MAX;

/// Vertices (metres) and counter-clockwise triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Position of each vertex.
    pub positions: Vec<DVec3>,
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// An edge of a manifold mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The two vertices, the smaller index first.
    pub vertices: [u32; 2],
    /// The triangles on both sides; the second is [`NONE`] at the boundary.
    pub triangles: [u32; 2],
}

impl Edge {
    /// True where only one triangle has this edge.
    pub fn is_boundary(&self) -> bool {
        self.triangles[1] == NONE
    }
}

impl Mesh {
    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// All the edges, sorted by their vertices. An edge of three triangles would appear twice.
    pub fn edges(&self) -> Vec<Edge> {
        // One bucket for each smaller vertex; the buckets are short, so sorting within them is cheap.
        let sides = |triangle: &[u32; 3]| {
            let [a, b, c] = *triangle;
            [(a, b), (b, c), (c, a)].map(|(v, w)| (v.min(w), v.max(w)))
        };
        let mut first = vec![0u32; self.positions.len() + 1];
        for (v, _) in self.triangles.iter().flat_map(sides) {
            first[v as usize + 1] += 1;
        }
        for v in 1..first.len() {
            first[v] += first[v - 1];
        }
        let mut next = first.clone();
        let mut others = vec![(0, 0); 3 * self.triangles.len()];
        for (index, triangle) in self.triangles.iter().enumerate() {
            for (v, w) in sides(triangle) {
                others[next[v as usize] as usize] = (w, index as u32);
                next[v as usize] += 1;
            }
        }
        let mut edges: Vec<Edge> = Vec::with_capacity(others.len() / 2 + 1);
        for v in 0..self.positions.len() {
            let bucket = &mut others[first[v] as usize..first[v + 1] as usize];
            bucket.sort_unstable();
            for &(w, triangle) in &*bucket {
                match edges.last_mut() {
                    Some(last) if last.vertices == [v as u32, w] && last.is_boundary() => last.triangles[1] = triangle,
                    _ => edges.push(Edge { vertices: [v as u32, w], triangles: [triangle, NONE] }),
                }
            }
        }
        edges
    }

    /// The area-weighted normal of each vertex, of length one.
    pub fn normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for &triangle in &self.triangles {
            let [a, b, c] = triangle.map(|v| self.positions[v as usize]);
            let normal = (b - a).cross(c - a);
            for v in triangle {
                normals[v as usize] += normal;
            }
        }
        normals.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// The number of the connected component of each vertex, and how many there are.
    pub fn components(&self) -> (Vec<u32>, usize) {
        let mut parent: Vec<u32> = (0..self.positions.len() as u32).collect();
        fn root(parent: &mut [u32], mut v: u32) -> u32 {
            while parent[v as usize] != v {
                parent[v as usize] = parent[parent[v as usize] as usize];
                v = parent[v as usize];
            }
            v
        }
        for &[a, b, c] in &self.triangles {
            for (v, w) in [(a, b), (b, c)] {
                let (v, w) = (root(&mut parent, v), root(&mut parent, w));
                parent[v.max(w) as usize] = v.min(w);
            }
        }
        let mut number = vec![NONE; parent.len()];
        let mut count = 0;
        for v in 0..parent.len() {
            let top = root(&mut parent, v as u32) as usize;
            if number[top] == NONE {
                number[top] = count;
                count += 1;
            }
            number[v] = number[top];
        }
        (number, count as usize)
    }

    /// Keeps the triangles that `keep` selects and the vertices they use; returns the old index of each vertex.
    pub fn retain(&mut self, keep: impl Fn(&[u32; 3]) -> bool) -> Vec<u32> {
        self.triangles.retain(keep);
        let mut new = vec![NONE; self.positions.len()];
        for v in self.triangles.iter().flatten() {
            new[*v as usize] = 0;
        }
        let old: Vec<u32> = (0..new.len() as u32).filter(|&v| new[v as usize] != NONE).collect();
        for (index, &v) in old.iter().enumerate() {
            new[v as usize] = index as u32;
        }
        self.positions = old.iter().map(|&v| self.positions[v as usize]).collect();
        for v in self.triangles.iter_mut().flatten() {
            *v = new[*v as usize];
        }
        old
    }

    /// Adds another mesh as separate components.
    pub fn append(&mut self, other: &Mesh) {
        let first = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|v| v + first)));
    }
}
