//! The cotangent Laplacian of a surface that may have slivers, triangles without area and edges of many triangles.
//!
//! A triangle is known by the lengths of its sides alone. All sides are made longer by one length, so small that nothing is
//! changed where triangles are well shaped, after which none is without area (intrinsic mollification: Sharp and Crane:
//! A Laplacian for nonmanifold triangle meshes, SGP 2020).

use glam::DVec3;

/// How cotangents are had.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// From the sides, after two of them are longer together than the third by at least this share of the mean side.
    Mollified(f64),
    /// All triangles count as equilateral and equally large: right for nothing, and good for everything.
    Equilateral,
}

/// A symmetric matrix whose rows sum to 0, and a mass for each vertex.
#[derive(Clone, Debug)]
pub struct Laplacian {
    /// Where the row of each vertex begins, and where the last one ends.
    start: Vec<usize>,
    /// Column and value, ascending by column, the diagonal included.
    entries: Vec<(u32, f64)>,
    /// A third of the area of the triangles at each vertex; above 0 for a vertex with a triangle.
    pub mass: Vec<f64>,
}

impl Laplacian {
    /// That of `triangles`; one that repeats an index takes no part.
    pub fn new(positions: &[DVec3], triangles: &[[u32; 3]], rule: Rule) -> Self {
        let proper = |t: &&[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        let triangles: Vec<[u32; 3]> = triangles.iter().filter(proper).copied().collect();
        let mut sides: Vec<[f64; 3]> = triangles.iter().map(|t| sides(t.map(|v| positions[v as usize]))).collect();
        mollify(&mut sides, rule);

        let mut mass = vec![0.0; positions.len()];
        let mut links = Vec::with_capacity(6 * triangles.len());
        for (t, &sides) in triangles.iter().zip(&sides) {
            let doubled_area = doubled_area(sides);
            for k in 0..3 {
                let (i, j) = (t[(k + 1) % 3], t[(k + 2) % 3]);
                let [opposite, a, b] = [sides[k], sides[(k + 1) % 3], sides[(k + 2) % 3]];
                // Half the cotangent of the angle at corner k, by the law of cosines.
                let half_cotangent = (a * a + b * b - opposite * opposite) / (4.0 * doubled_area);
                links.push((i, j, -half_cotangent));
                links.push((j, i, -half_cotangent));
                mass[t[k] as usize] += doubled_area / 6.0;
            }
        }
        // Stable, so that sums are in the order of the triangles.
        links.sort_by_key(|&(i, j, _)| (i, j));
        let mut entries: Vec<(u32, f64)> = Vec::with_capacity(links.len() / 2 + positions.len());
        let mut start = vec![0];
        let mut rows = links.chunk_by(|a, b| a.0 == b.0).peekable();
        for v in 0..positions.len() as u32 {
            if let Some(row) = rows.next_if(|row| row[0].0 == v) {
                let from = entries.len();
                let sums =
                    row.chunk_by(|a, b| a.1 == b.1).map(|same| (same[0].1, same.iter().map(|l| l.2).sum::<f64>()));
                entries.extend(sums);
                let diagonal = -entries[from..].iter().map(|e| e.1).sum::<f64>();
                let at = from + entries[from..].partition_point(|e| e.0 < v);
                entries.insert(at, (v, diagonal));
            }
            start.push(entries.len());
        }
        Self { start, entries, mass }
    }

    /// The row of a vertex, ascending by column; empty for one without a triangle.
    pub fn row(&self, vertex: usize) -> &[(u32, f64)] {
        &self.entries[self.start[vertex]..self.start[vertex + 1]]
    }
}

/// The lengths of the sides of a triangle, each opposite to its corner.
fn sides([a, b, c]: [DVec3; 3]) -> [f64; 3] {
    [b.distance(c), c.distance(a), a.distance(b)]
}

/// Makes all sides longer by the one length after which `rule` holds.
fn mollify(sides: &mut [[f64; 3]], rule: Rule) {
    let mean = sides.iter().flatten().sum::<f64>() / (3 * sides.len()).max(1) as f64;
    // In one place: any length will do.
    let mean = if mean > 0.0 { mean } else { 1.0 };
    match rule {
        Rule::Equilateral => sides.fill([mean; 3]),
        Rule::Mollified(share) => {
            let lacks = |s: &[f64; 3]| {
                let longest = s[0].max(s[1]).max(s[2]);
                share * mean - (s.iter().sum::<f64>() - 2.0 * longest)
            };
            let more = sides.iter().map(lacks).fold(0.0, f64::max);
            sides.iter_mut().flatten().for_each(|side| *side += more);
        }
    }
}

/// Twice the area of a triangle by the lengths of its sides (Kahan's formula, which is stable for needles).
fn doubled_area(mut sides: [f64; 3]) -> f64 {
    sides.sort_unstable_by(f64::total_cmp);
    let [c, b, a] = sides;
    let product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    0.5 * product.max(0.0).sqrt()
}
