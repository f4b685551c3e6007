//! Memory of a session: estimated from sizes before it is allocated, counted while it is held, and limited.

use crate::error::{Error, ErrorKind, Result};
use crate::maths;

/// Bytes of a vector's capacity.
pub(crate) fn bytes<T>(v: &Vec<T>) -> u64 {
    (v.capacity() * size_of::<T>()) as u64
}

const MB: f64 = 1e6;

/// A limit on the memory of a session, and how much of it is reserved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryLimit {
    total: u64,
    held: u64,
}

impl MemoryLimit {
    /// No limit.
    pub const NONE: Self = Self { total: u64::MAX, held: 0 };

    /// A limit in bytes; 0 is no limit.
    pub fn new(bytes: u64) -> Self {
        if bytes == 0 { Self::NONE } else { Self { total: bytes, held: 0 } }
    }

    /// The same limit with `held` more bytes reserved.
    pub fn reserving(self, held: u64) -> Self {
        if self.total == u64::MAX { self } else { Self { held: self.held.saturating_add(held), ..self } }
    }

    /// How many items of `size` bytes fit in the remaining budget.
    pub fn room_for(self, size: usize) -> usize {
        if self.total == u64::MAX {
            return usize::MAX;
        }
        usize::try_from(self.total.saturating_sub(self.held) / size as u64).unwrap_or(usize::MAX)
    }

    /// # Errors
    /// `MemoryLimit` where the parts do not fit in the remaining budget; the message names the largest.
    pub fn check(self, parts: &[Part]) -> Result<()> {
        let needed = parts.iter().fold(self.held, |sum, part| sum.saturating_add(part.bytes));
        if needed <= self.total {
            return Ok(());
        }
        let largest = parts.iter().max_by_key(|part| part.bytes).map_or("", |part| part.name);
        Err(self.exceeded(&format!("about {:.1} MB", needed as f64 / MB), largest))
    }

    /// The error where `name` exceeded the limit and the total need is unknown.
    pub fn exceeded_error(self, name: &str) -> Error {
        self.exceeded("more", name)
    }

    fn exceeded(self, needed: &str, name: &str) -> Error {
        Error::new(
            ErrorKind::MemoryLimit,
            format!(
                "memory: {needed} would be needed, the limit is {:.1} MB; most of it is for {name}. Raise memory_limit, or use \
                 a coarser mesh, a larger voxel_size or a smaller dhat",
                self.total as f64 / MB
            ),
        )
    }
}

/// A part of the memory needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its purpose, for messages.
    pub name: &'static str,
    /// Its size in bytes.
    pub bytes: u64,
}

/// The sizes from which a session's memory is estimated before it is allocated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Garment vertices.
    pub garment_vertices: usize,
    /// Avatar triangles; those over several bones count after splitting, where that is known.
    pub avatar_triangles: usize,
    /// Bytes of the distance field; 0 where unknown.
    pub field: u64,
}

/// Scalars of the factor, divided by n log2 n for n vertices: the growth of fill for nested dissection of a planar
/// graph.
const FACTOR_SCALARS: f64 = 40.0;
/// Bytes for each garment vertex of Hessian and gradient, element derivatives, sparsity pattern and ordering.
const MATRIX_BYTES: f64 = 5200.0;
/// Bytes for each garment vertex of connectivity, bounding boxes, tree, energies, and its candidate pairs in a step;
/// the pairs are most of it where the garment lies on the body everywhere.
const CONTACT_BYTES: f64 = 20e3;
/// Bytes for each avatar triangle of the same, with its projection.
const AVATAR_BYTES: f64 = 1400.0;

impl Sizes {
    /// Estimate of a session's peak memory for these sizes. Measured with garments and bodies of 3,000 to 7,000
    /// vertices: from half of the estimate (loose) to a sixth more (tight everywhere).
    pub fn estimate(self) -> [Part; 4] {
        let n = self.garment_vertices as f64;
        let factor = 8.0 * FACTOR_SCALARS * n * maths::log2(n + 2.0);
        [
            Part { name: "the linear system of the garment", bytes: (factor + MATRIX_BYTES * n) as u64 },
            Part { name: "contacts of the garment", bytes: (CONTACT_BYTES * n) as u64 },
            Part { name: "the avatar", bytes: (AVATAR_BYTES * self.avatar_triangles as f64) as u64 },
            Part { name: "the distance field of the avatar", bytes: self.field },
        ]
    }
}
