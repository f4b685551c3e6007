//! Pins and rigid groups, as a caller has set them and as vertices of the welded garment.

use std::collections::HashSet;

use glam::DVec3;

use super::Session;
use super::inputs::Inputs;
use super::pin::Pin;
use crate::error::{Error, ErrorKind, Result};
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::weld::Weld;
use crate::stage::setup::pin_targets::PinRequest;

impl Session {
    /// Garment vertices to hold at targets; replaces those before. Optional.
    ///
    /// # Errors
    /// `InvalidArgument` for a vertex given twice or a target that is not finite, `InvalidState`. Vertices are compared with
    /// the garment's by `prepare`.
    pub fn set_pins(&mut self, pins: Vec<Pin>) -> Result<()> {
        self.adjusting("the pins")?;
        if let Some(Pin { vertex, .. }) = pins.iter().find(|pin| pin.target.is_some_and(|p| !p.is_finite())) {
            return invalid(format!("pinned vertices: the place of vertex {vertex} is not finite"));
        }
        let mut vertices: Vec<u32> = pins.iter().map(|pin| pin.vertex).collect();
        vertices.sort_unstable();
        if let Some(twice) = vertices.windows(2).find(|pair| pair[0] == pair[1]) {
            return invalid(format!("pinned vertices: vertex {} is listed twice", twice[0]));
        }
        self.inputs.pins = pins;
        Ok(())
    }

    /// Garment vertices that are to stay one rigid body, such as a button or an armour plate; one more group.
    ///
    /// # Errors
    /// `InvalidArgument` for an empty group and for a vertex that a group before it holds, `InvalidState`. Vertices are
    /// compared with the garment's by `prepare`.
    pub fn add_rigid_group(&mut self, vertices: Vec<u32>) -> Result<()> {
        self.setting("a rigid group")?;
        let group = self.inputs.rigid_groups.len();
        if vertices.is_empty() {
            return invalid(format!("rigid group {group}: lists no vertices"));
        }
        let own: HashSet<u32> = vertices.iter().copied().collect();
        for (earlier, others) in self.inputs.rigid_groups.iter().enumerate() {
            if let Some(v) = others.iter().find(|v| own.contains(v)) {
                return invalid(format!("rigid group {group}: vertex {v} is in rigid group {earlier} already"));
            }
        }
        self.inputs.rigid_groups.push(vertices.into());
        Ok(())
    }

    /// Removes all rigid groups.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_rigid_groups(&mut self) -> Result<()> {
        self.setting("the rigid groups")?;
        self.inputs.rigid_groups.clear();
        Ok(())
    }
}

impl Inputs {
    /// Compares fit weights, pins and groups with the garment.
    pub(super) fn check_wishes(&self) -> Result<()> {
        let count = self.garment.as_ref().map_or(0, |garment| garment.0.positions.len());
        if let Some(weights) = self.fit_weights.as_ref().filter(|weights| weights.len() != count) {
            return Err(Error::new(
                ErrorKind::InvalidWeights,
                format!("fit weights: there are {} weights, the garment has {count} vertices", weights.len()),
            ));
        }
        if let Some(pin) = self.pins.iter().find(|pin| pin.vertex as usize >= count) {
            return invalid(format!("pinned vertices: lists vertex {}, the garment has {count} vertices", pin.vertex));
        }
        for (group, vertices) in self.rigid_groups.iter().enumerate() {
            if let Some(v) = vertices.iter().find(|v| **v as usize >= count) {
                return invalid(format!("rigid group {group}: lists vertex {v}, the garment has {count} vertices"));
            }
        }
        Ok(())
    }

    /// The pins, one for each welded vertex that has any; targets, which are given in `system`, in the internal one.
    pub(super) fn welded_pins(&self, weld: &Weld, system: &CoordinateSystem) -> Result<Vec<PinRequest>> {
        let mut pins: Vec<(u32, &Pin)> =
            self.pins.iter().map(|pin| (weld.to_welded[pin.vertex as usize], pin)).collect();
        pins.sort_by_key(|&(welded, pin)| (welded, pin.vertex));
        for copies in pins.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let [(_, a), (_, b)] = [copies[0], copies[1]];
            if a.target != b.target {
                return invalid(format!(
                    "pinned vertices: vertices {} and {} share their place in the garment and move as one, but are pinned to \
                     different places",
                    a.vertex, b.vertex
                ));
            }
        }
        pins.dedup_by_key(|pin| pin.0);
        let internal = |target: Option<DVec3>| target.map(|p| system.position_to_internal(p));
        Ok(pins.into_iter().map(|(welded, pin)| (welded, internal(pin.target))).collect())
    }

    /// The rigid groups as lists of welded vertices.
    pub(super) fn welded_groups(&self, weld: &Weld) -> Result<Vec<Vec<u32>>> {
        let mut group_of = vec![None; weld.vertex_of.len()];
        let mut groups = Vec::new();
        for (group, vertices) in self.rigid_groups.iter().enumerate() {
            let mut welded = Vec::new();
            for &v in vertices.iter() {
                let w = weld.to_welded[v as usize];
                match group_of[w as usize] {
                    None => {
                        group_of[w as usize] = Some(group);
                        welded.push(w);
                    }
                    Some(earlier) if earlier == group => {}
                    Some(earlier) => {
                        return invalid(format!(
                            "rigid group {group}: vertex {v} shares its place in the garment with a vertex of rigid group \
                             {earlier}, and the two move as one; make one group of both"
                        ));
                    }
                }
            }
            groups.push(welded);
        }
        Ok(groups)
    }
}

fn invalid<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidArgument, message))
}
