//! Skin weights, as far as the projection onto the skeleton needs them: each vertex's joint of largest weight.

use crate::error::{Error, ErrorKind, Result};

/// For each vertex of an avatar, the joint that moves it most.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkinWeights {
    joint_count: usize,
    dominant: Vec<Option<u32>>,
}

fn fail<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidWeights, message))
}

fn check_size(what: &str, name: &str, len: usize, [rows, columns]: [usize; 2], shape: [&str; 2]) -> Result<()> {
    match rows.checked_mul(columns) {
        Some(n) if n == len => Ok(()),
        _ => fail(format!(
            "{what}: there are {len} {name}, but {rows} {} times {columns} {} are needed",
            shape[0], shape[1]
        )),
    }
}

fn check_weight(what: &str, weight: f64, vertex: usize, joint: u32) -> Result<()> {
    if weight.is_finite() && weight >= 0.0 {
        return Ok(());
    }
    fail(format!(
        "{what}: the weight of vertex {vertex} for joint {joint} is {weight}, it must be finite and not negative"
    ))
}

impl SkinWeights {
    /// From a full matrix, one row a joint and one column a vertex, row after row. `what` names it in the sentence
    /// ("target skin weights"). Rows of one vertex need not sum to 1.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidWeights`]: there are no joints, the size is not joints times vertices, or a weight is negative
    /// or not finite.
    pub fn from_dense(weights: &[f64], joint_count: usize, vertex_count: usize, what: &str) -> Result<Self> {
        if joint_count == 0 {
            // Without rows, no size of the array vouches for the number of vertices.
            return fail(format!("{what}: there are no joints"));
        }
        check_size(what, "weights", weights.len(), [joint_count, vertex_count], ["joints", "vertices"])?;
        let mut largest = vec![0.0; vertex_count];
        let mut dominant = vec![None; vertex_count];
        if vertex_count > 0 {
            for (joint, row) in (0u32..).zip(weights.chunks_exact(vertex_count)) {
                for (vertex, &weight) in row.iter().enumerate() {
                    check_weight(what, weight, vertex, joint)?;
                    // Strictly larger: of equal weights, the lowest joint stays.
                    if weight > largest[vertex] {
                        largest[vertex] = weight;
                        dominant[vertex] = Some(joint);
                    }
                }
            }
        }
        Ok(Self { joint_count, dominant })
    }

    /// From `influences` pairs of joint and weight a vertex, vertex after vertex, as engines keep them. `what` names
    /// them in the sentence. A joint listed twice for a vertex counts with the sum; the joint beside a weight of 0
    /// is padding and may be anything.
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
        what: &str,
    ) -> Result<Self> {
        if influences == 0 {
            return fail(format!("{what}: the number of influences for each vertex is 0"));
        }
        let shape = ["vertices", "influences"];
        check_size(what, "joint indices", joints.len(), [vertex_count, influences], shape)?;
        check_size(what, "weights", weights.len(), [vertex_count, influences], shape)?;
        let mut dominant = Vec::with_capacity(vertex_count);
        let mut own: Vec<(u32, f64)> = Vec::new();
        for (vertex, (js, ws)) in joints.chunks_exact(influences).zip(weights.chunks_exact(influences)).enumerate() {
            own.clear();
            for (&joint, &weight) in js.iter().zip(ws) {
                check_weight(what, weight, vertex, joint)?;
                if weight == 0.0 {
                    continue;
                }
                if joint as usize >= joint_count {
                    return fail(format!(
                        "{what}: vertex {vertex} has a weight for joint {joint}, the skeleton has {joint_count} joints"
                    ));
                }
                own.push((joint, weight));
            }
            own.sort_by_key(|&(joint, _)| joint);
            let sums =
                own.chunk_by(|a, b| a.0 == b.0).map(|same| (same[0].0, same.iter().map(|&(_, w)| w).sum::<f64>()));
            // Strictly larger: of equal weights, the lowest joint stays.
            let best = sums.reduce(|best, next| if next.1 > best.1 { next } else { best });
            dominant.push(best.map(|(joint, _)| joint));
        }
        Ok(Self { joint_count, dominant })
    }

    /// Number of joints that the weights are for.
    pub fn joint_count(&self) -> usize {
        self.joint_count
    }

    /// Number of vertices that the weights are for.
    pub fn vertex_count(&self) -> usize {
        self.dominant.len()
    }

    /// The joint of largest weight (the lowest of several), or `None` where all weights of the vertex are 0 and
    /// the nearest bone decides.
    #[inline]
    pub fn dominant_joint(&self, vertex: usize) -> Option<u32> {
        self.dominant[vertex]
    }
}
