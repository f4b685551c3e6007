//! The garment's morphs (blend shapes), and those of the target avatar.

use std::sync::Arc;

use glam::DVec3;

use super::Session;
use super::inputs::Inputs;
use crate::error::{Error, ErrorKind, Result};
use crate::input::morph::Morph;

pub(super) const GARMENT_MORPH: &str = "garment morph";

impl Session {
    /// A morph of the garment as it was designed, which goes over to the result; one more. They are numbered from 0.
    ///
    /// # Errors
    /// `InvalidArgument` for an offset that is not finite, `InvalidState`. The number of offsets is compared with the garment's
    /// vertices by `prepare`.
    pub fn add_garment_morph(&mut self, morph: Morph) -> Result<()> {
        self.setting("a garment morph")?;
        morph.check(GARMENT_MORPH, self.inputs.garment_morphs.len())?;
        self.inputs.garment_morphs.push(Arc::new(morph));
        Ok(())
    }

    /// Removes all morphs of the garment.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_garment_morphs(&mut self) -> Result<()> {
        self.setting("the garment morphs")?;
        self.inputs.garment_morphs.clear();
        Ok(())
    }

    /// A morph of the garment as it is now, in the target coordinate system: each offset goes along with the surface around its
    /// vertex, by the gradient of the deformation. A similarity of the garment takes the offsets along exactly.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`, `InvalidArgument` where there is no such morph.
    pub fn garment_morph(&self, index: usize) -> Result<Vec<DVec3>> {
        let snapshot = self.readable()?;
        let Some(morph) = self.inputs.garment_morphs.get(index) else {
            let count = self.inputs.garment_morphs.len();
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("{GARMENT_MORPH} {index}: there are {count}; they are added before prepare and count from 0"),
            ));
        };
        let motions = snapshot.surface_before_turn(&self.inputs)?.vertex_motions();
        let problem = &snapshot.problem;
        let forth = self.inputs.source_coordinate_system.affine_to_internal();
        let back = snapshot.coordinate_system().affine_to_internal().inverse();
        // From the source's unit to the target's, both through the normalised space.
        let scale = problem.source_normalization.scale / problem.target_normalization.scale;
        let moved = |(&welded, &offset): (&u32, &DVec3)| {
            let offset = forth.transform_vector3(offset) * scale;
            back.transform_vector3(motions[welded as usize].of_vector(offset))
        };
        Ok(problem.weld.to_welded.iter().zip(&morph.offsets).map(moved).collect())
    }
}

impl Inputs {
    /// Compares the morphs with a garment of so many vertices.
    pub(super) fn check_garment_morphs(&self, count: usize) -> Result<()> {
        for (index, morph) in self.garment_morphs.iter().enumerate() {
            check_size(morph, GARMENT_MORPH, index, "garment", count)?;
        }
        Ok(())
    }
}

pub(super) fn check_size(morph: &Morph, what: &str, index: usize, mesh: &str, count: usize) -> Result<()> {
    if morph.offsets.len() == count {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::InvalidArgument,
        format!(
            "{}: there are {} offsets, the {mesh} has {count} vertices",
            morph.title(what, index),
            morph.offsets.len()
        ),
    ))
}
