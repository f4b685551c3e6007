//! The outfits that were put on last, of which the library knows what does not depend on who wears them.

use std::collections::VecDeque;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::SharedGarment;

use crate::args::Dress;
use crate::file_state::FileState;
use crate::obj;

/// As many are kept: each with its meshes, and what is known of them.
pub const MOST: usize = 8;

/// The latest few outfits.
#[derive(Default)]
pub struct KnownOutfits(VecDeque<(Source, KnownOutfit)>);

/// The garments of an outfit that were put on.
#[derive(Default)]
pub struct KnownOutfit(Vec<KnownGarment>);

struct KnownGarment {
    parts: Vec<usize>,
    mesh: TriangleMesh,
    shared: SharedGarment,
}

/// All that its garments depend on: another size or age of a file, and it is another outfit.
#[derive(PartialEq, Eq)]
struct Source {
    files: Vec<FileState>,
    words: [Option<String>; 3],
}

impl Source {
    fn of(args: &Dress) -> Self {
        let beside = &args.obj;
        let named = [&args.source, &beside.source_skeleton, &beside.source_skin, &beside.garment_skin];
        let mut files = vec![args.outfit.clone()];
        files.extend(named.into_iter().flatten().cloned());
        let found: Vec<_> = files.iter().flat_map(|file| obj::neighbours(file)).collect();
        files.extend(found);
        Self {
            files: files.iter().map(|file| FileState::of(file)).collect(),
            words: [args.nodes.clone(), args.source_nodes.clone(), beside.source_space.clone()],
        }
    }
}

impl KnownOutfits {
    /// The outfit that `args` are about; of one that is not known, nothing is.
    pub fn of(&mut self, args: &Dress) -> &mut KnownOutfit {
        let source = Source::of(args);
        let known = self.0.iter().position(|(known, _)| *known == source).and_then(|place| self.0.remove(place));
        self.0.truncate(MOST - 1);
        self.0.push_front(known.unwrap_or_else(|| (source, KnownOutfit::default())));
        &mut self.0[0].1
    }
}

impl KnownOutfit {
    /// The garment `mesh`, which is made of the outfit's `parts`, or what `make` gives.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn garment<E>(
        &mut self,
        parts: &[usize],
        mesh: &TriangleMesh,
        make: impl FnOnce() -> Result<SharedGarment, E>,
    ) -> Result<SharedGarment, E> {
        if let Some(known) = self.0.iter().find(|known| known.parts == parts && known.mesh == *mesh) {
            return Ok(known.shared.clone());
        }
        let shared = make()?;
        self.0.push(KnownGarment { parts: parts.to_vec(), mesh: mesh.clone(), shared: shared.clone() });
        Ok(shared)
    }
}
