//! Skin weights: which joints move a vertex, and which of them most. Only the latter is used: see `dominant_joint`.

use crate::error::{Error, ErrorKind, Result};
use crate::memory::bytes;

/// For each vertex of an avatar, the joints that move it.
#[derive(Clone, Debug, PartialEq)]
pub struct SkinWeights {
    joint_count: usize,
    /// Where the influences of each vertex end.
    ends: Vec<usize>,
    /// Joints with weights above 0, vertex after vertex, ascending and each once a vertex.
    influences: Vec<(u32, f64)>,
}

fn fail<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidWeights, message))
}

fn check_size(name: &str, array: &str, len: usize, [rows, columns]: [usize; 2], shape: [&str; 2]) -> Result<()> {
    match rows.checked_mul(columns) {
        Some(n) if n == len => Ok(()),
        _ => fail(format!(
            "{name}: there are {len} {array}, but {rows} {} times {columns} {} are needed",
            shape[0], shape[1]
        )),
    }
}

fn check_weight(name: &str, weight: f64, vertex: usize, joint: u32) -> Result<()> {
    if weight.is_finite() && weight >= 0.0 {
        return Ok(());
    }
    fail(format!(
        "{name}: the weight of vertex {vertex} for joint {joint} is {weight}, it must be finite and not negative"
    ))
}

impl SkinWeights {
    /// From a full matrix, one row a joint and one column a vertex, row after row. `name` names it in error messages
    /// ("target skin weights"). Rows of one vertex need not sum to 1.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidWeights`]: there are no joints, the size is not joints times vertices, or a weight is negative
    /// or not finite.
    pub fn from_dense(weights: &[f64], joint_count: usize, vertex_count: usize, name: &str) -> Result<Self> {
        if joint_count == 0 {
            // Without rows, the array's size does not bound the number of vertices.
            return fail(format!("{name}: there are no joints"));
        }
        check_size(name, "weights", weights.len(), [joint_count, vertex_count], ["joints", "vertices"])?;
        let mut counts = vec![0; vertex_count];
        // Rows may be empty.
        let width = vertex_count.max(1);
        for (joint, row) in (0u32..).zip(weights.chunks_exact(width)) {
            for (vertex, &weight) in row.iter().enumerate() {
                check_weight(name, weight, vertex, joint)?;
                counts[vertex] += usize::from(weight > 0.0);
            }
        }
        let mut ends = Vec::with_capacity(vertex_count);
        let mut total = 0;
        for count in counts {
            // Where the vertex begins; each entry that is written moves it on, to its end.
            ends.push(total);
            total += count;
        }
        let mut influences = vec![(0, 0.0); total];
        for (joint, row) in (0u32..).zip(weights.chunks_exact(width)) {
            for (end, &weight) in ends.iter_mut().zip(row).filter(|(_, weight)| **weight > 0.0) {
                influences[*end] = (joint, weight);
                *end += 1;
            }
        }
        Ok(Self { joint_count, ends, influences })
    }

    /// From `influences` pairs of joint and weight a vertex, vertex after vertex, as engines keep them. `name` names
    /// them in error messages. A joint listed twice for a vertex counts with the sum; the joint of a weight of 0 is
    /// padding and may be anything.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidWeights`]: a size is not vertices times influences, there are no influences, a weight is
    /// negative or not finite, a joint is out of range.
    pub fn from_sparse(
        joints: &[u32],
        weights: &[f64],
        influences: usize,
        joint_count: usize,
        vertex_count: usize,
        name: &str,
    ) -> Result<Self> {
        if influences == 0 {
            return fail(format!("{name}: the number of influences for each vertex is 0"));
        }
        let shape = ["vertices", "influences"];
        check_size(name, "joint indices", joints.len(), [vertex_count, influences], shape)?;
        check_size(name, "weights", weights.len(), [vertex_count, influences], shape)?;
        let mut skin = Self { joint_count, ends: Vec::with_capacity(vertex_count), influences: Vec::new() };
        let mut own: Vec<(u32, f64)> = Vec::new();
        for (vertex, (js, ws)) in joints.chunks_exact(influences).zip(weights.chunks_exact(influences)).enumerate() {
            own.clear();
            for (&joint, &weight) in js.iter().zip(ws) {
                check_weight(name, weight, vertex, joint)?;
                if weight == 0.0 {
                    continue;
                }
                if joint as usize >= joint_count {
                    return fail(format!(
                        "{name}: vertex {vertex} has a weight for joint {joint}, the skeleton has {joint_count} joints"
                    ));
                }
                own.push((joint, weight));
            }
            skin.push(&mut own);
        }
        Ok(skin)
    }

    /// From the joints with weights of each vertex, in any order; a joint may be listed several times, and counts with the
    /// sum. The weights are finite and above 0, the joints below `joint_count`.
    pub fn from_rows(joint_count: usize, rows: impl IntoIterator<Item = Vec<(u32, f64)>>) -> Self {
        let mut skin = Self { joint_count, ends: Vec::new(), influences: Vec::new() };
        rows.into_iter().for_each(|mut row| skin.push(&mut row));
        skin
    }

    /// Adds a vertex. A joint may be listed several times.
    fn push(&mut self, own: &mut [(u32, f64)]) {
        own.sort_by_key(|&(joint, _)| joint);
        let sums = own.chunk_by(|a, b| a.0 == b.0).map(|same| (same[0].0, same.iter().map(|&(_, w)| w).sum::<f64>()));
        self.influences.extend(sums);
        self.ends.push(self.influences.len());
    }

    /// These, and after them those of further vertices, as [`Self::at`] has them.
    pub fn extended(&self, places: &[Option<([u32; 3], [f64; 3])>]) -> Self {
        let mut extended = self.clone();
        let further = self.at(places);
        let first = extended.influences.len();
        extended.influences.extend(further.influences);
        extended.ends.extend(further.ends.iter().map(|end| first + end));
        extended
    }

    /// The weights of further vertices: each lies in a triangle of vertices that are here, at barycentric coordinates, or
    /// nowhere, and then has no weights.
    pub fn at(&self, places: &[Option<([u32; 3], [f64; 3])>]) -> Self {
        let mut further =
            Self { joint_count: self.joint_count, ends: Vec::with_capacity(places.len()), influences: Vec::new() };
        let mut own = Vec::new();
        for place in places {
            own.clear();
            for (vertex, share) in place.iter().flat_map(|(corners, shares)| corners.iter().zip(shares)) {
                let weights = self.weights(*vertex as usize);
                // Those of one vertex need not sum to 1.
                let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
                own.extend(weights.iter().map(|&(joint, weight)| (joint, share * weight / sum)));
            }
            own.retain(|&(_, weight)| weight > 0.0);
            further.push(&mut own);
        }
        further
    }

    /// These without weights for `vertices`, which are ascending: the nearest bone decides for them.
    pub fn without(&self, vertices: &[u32]) -> Self {
        let mut kept =
            Self { joint_count: self.joint_count, ends: Vec::with_capacity(self.ends.len()), influences: Vec::new() };
        for vertex in 0..self.vertex_count() {
            if vertices.binary_search(&(vertex as u32)).is_err() {
                kept.influences.extend(self.weights(vertex));
            }
            kept.ends.push(kept.influences.len());
        }
        kept
    }

    /// These on `count` other joints: each joint's weights go to its `owner`, and are left out where it has none.
    pub fn contracted(&self, owner: &[Option<u32>], count: usize) -> Self {
        let mut contracted =
            Self { joint_count: count, ends: Vec::with_capacity(self.ends.len()), influences: Vec::new() };
        let mut own = Vec::new();
        for vertex in 0..self.vertex_count() {
            own.clear();
            let owned =
                self.weights(vertex).iter().filter_map(|&(joint, weight)| Some((owner[joint as usize]?, weight)));
            own.extend(owned);
            contracted.push(&mut own);
        }
        contracted
    }

    /// Joints with their weights, ascending, each once.
    pub fn weights(&self, vertex: usize) -> &[(u32, f64)] {
        let first = if vertex == 0 { 0 } else { self.ends[vertex - 1] };
        &self.influences[first..self.ends[vertex]]
    }

    /// Bytes that they hold.
    pub fn memory(&self) -> u64 {
        bytes(&self.ends) + bytes(&self.influences)
    }

    /// Number of joints that the weights are for.
    pub fn joint_count(&self) -> usize {
        self.joint_count
    }

    /// Number of vertices that the weights are for.
    pub fn vertex_count(&self) -> usize {
        self.ends.len()
    }

    /// The joint of largest weight (the lowest of several), or `None` where all weights of the vertex are 0 and
    /// the nearest bone decides.
    pub fn dominant_joint(&self, vertex: usize) -> Option<u32> {
        // Strictly larger: of equal weights, the lowest joint stays.
        let best = self.weights(vertex).iter().reduce(|best, next| if next.1 > best.1 { next } else { best });
        best.map(|&(joint, _)| joint)
    }
}
