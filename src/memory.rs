//! How much memory a session takes: counted where it is held, estimated from sizes before it is, and limited.

use crate::error::{Error, ErrorKind, Result};

/// Bytes that a vector has reserved.
pub(crate) fn bytes<T>(v: &Vec<T>) -> u64 {
    (v.capacity() * size_of::<T>()) as u64
}

const MB: f64 = 1e6;

/// What a session may take at most, and what of it is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryLimit {
    total: u64,
    held: u64,
}

impl MemoryLimit {
    /// No limit.
    pub const NONE: Self = Self { total: u64::MAX, held: 0 };

    /// A limit of so many bytes; 0 is none.
    pub fn new(bytes: u64) -> Self {
        if bytes == 0 { Self::NONE } else { Self { total: bytes, held: 0 } }
    }

    /// The same limit where `held` bytes more are taken.
    pub fn reserving(self, held: u64) -> Self {
        if self.total == u64::MAX { self } else { Self { held: self.held.saturating_add(held), ..self } }
    }

    /// How many things of `size` bytes have room.
    pub fn room_for(self, size: usize) -> usize {
        if self.total == u64::MAX {
            return usize::MAX;
        }
        usize::try_from(self.total.saturating_sub(self.held) / size as u64).unwrap_or(usize::MAX)
    }

    /// # Errors
    /// `MemoryLimit` where the parts do not fit beside what is held; the sentence names the largest.
    pub fn check(self, parts: &[Part]) -> Result<()> {
        let needed = parts.iter().fold(self.held, |sum, part| sum.saturating_add(part.bytes));
        if needed <= self.total {
            return Ok(());
        }
        let largest = parts.iter().max_by_key(|part| part.bytes).map_or("", |part| part.what);
        Err(self.exceeded(&format!("about {:.1} MB", needed as f64 / MB), largest))
    }

    /// The failure where nobody knows how much more would be needed for `what`.
    pub fn exceeded_error(self, what: &str) -> Error {
        self.exceeded("more", what)
    }

    fn exceeded(self, needed: &str, what: &str) -> Error {
        Error::new(
            ErrorKind::MemoryLimit,
            format!(
                "memory: {needed} would be needed, the limit is {:.1} MB; most of it is for {what}. Raise memory_limit, or use \
                 a coarser mesh, a larger voxel_size or a smaller dhat",
                self.total as f64 / MB
            ),
        )
    }
}

/// A part of what is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// What it is for.
    pub what: &'static str,
    /// Its size.
    pub bytes: u64,
}

/// The sizes from which a session's memory can be told before it is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Garment vertices.
    pub garment_vertices: usize,
    /// Avatar triangles, those over several bones split where that is known.
    pub avatar_triangles: usize,
    /// Bytes of the distance field, where known.
    pub field: u64,
}

/// The factor's scalars grow a little faster than the vertices: with 2.5 log2 of their number, as nested dissection of a
/// surface has it.
const FACTOR_SCALARS: f64 = 40.0;
/// Hessian and gradient, the records of the assembly, their pattern, the ordering.
const MATRIX_BYTES: f64 = 5200.0;
/// Connectivity, boxes, tree and energies of a garment vertex, and the pairs that it is in during a step: most of it where
/// the garment lies on the body all over.
const CONTACT_BYTES: f64 = 20e3;
/// The same of an avatar triangle, with its projection.
const AVATAR_BYTES: f64 = 1400.0;

impl Sizes {
    /// An estimate of the most that a session of these sizes ever takes. Garments and bodies of 3,000 to 7,000 vertices were
    /// measured to take between half of it (loose) and a sixth more (tight everywhere).
    pub fn estimate(self) -> [Part; 4] {
        let n = self.garment_vertices as f64;
        let factor = 8.0 * FACTOR_SCALARS * n * (n + 2.0).log2();
        [
            Part { what: "the linear system of the garment", bytes: (factor + MATRIX_BYTES * n) as u64 },
            Part { what: "contacts of the garment", bytes: (CONTACT_BYTES * n) as u64 },
            Part { what: "the avatar", bytes: (AVATAR_BYTES * self.avatar_triangles as f64) as u64 },
            Part { what: "the distance field of the avatar", bytes: self.field },
        ]
    }
}
