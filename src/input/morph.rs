//! Morphs (blend shapes) as a caller hands them in.

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};
use crate::memory::bytes;

/// Offsets of the vertices of a mesh, in its coordinate system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Morph {
    /// What it is called; for messages.
    pub name: String,
    /// One for each vertex.
    pub offsets: Vec<DVec3>,
}

impl Morph {
    /// What messages call it: `garment morph 2 ("smile")`.
    pub fn title(&self, what: &str, index: usize) -> String {
        if self.name.is_empty() { format!("{what} {index}") } else { format!("{what} {index} (\"{}\")", self.name) }
    }

    /// Refuses an offset that is not finite.
    ///
    /// # Errors
    /// `InvalidArgument`.
    pub fn check(&self, what: &str, index: usize) -> Result<()> {
        match self.offsets.iter().position(|p| !p.is_finite()) {
            None => Ok(()),
            Some(v) => Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("{}: the offset of vertex {v} is not finite", self.title(what, index)),
            )),
        }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.offsets) + self.name.len() as u64
    }
}
