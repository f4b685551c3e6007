//! The curves that a caller has named.

use super::Session;
use super::inputs::Inputs;
use crate::error::{Error, ErrorKind, Result};
use crate::input::curve::{Curve, WeldedCurve};
use crate::input::weld::Weld;

impl Session {
    /// A curve along edges of the garment that keeps its shape and its place along the bones, with weights of its own; one more.
    /// One that coincides with a boundary loop takes its place. Curves are numbered from 0.
    ///
    /// # Errors
    /// `InvalidArgument` for fewer than two vertices, or three where it is closed, a vertex listed twice, or a weight that is not
    /// from 0 to a million, `InvalidState`. Vertices are compared with the garment by `prepare`, which refuses a vertex that
    /// the garment does not have, two in a row that no edge joins, a place passed twice, and a curve that was named before.
    pub fn add_curve(&mut self, curve: Curve) -> Result<()> {
        self.setting("a curve")?;
        curve.check(self.inputs.curves.len())?;
        self.inputs.curves.push(curve.into());
        Ok(())
    }

    /// Removes all curves.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_curves(&mut self) -> Result<()> {
        self.setting("the curves")?;
        self.inputs.curves.clear();
        Ok(())
    }
}

impl Inputs {
    /// The curves on the welded garment.
    pub(super) fn welded_curves(&self, weld: &Weld) -> Result<Vec<WeldedCurve>> {
        let mut curves: Vec<WeldedCurve> = Vec::new();
        for (name, curve) in self.curves.iter().enumerate() {
            let welded = curve.welded(name, weld)?;
            let (closed, vertices) = (welded.curve.closed, &welded.curve.vertices);
            if let Some(earlier) = curves.iter().position(|other| other.curve.coincides(closed, vertices)) {
                let message = format!("curve {name}: runs through the vertices of curve {earlier}");
                return Err(Error::new(ErrorKind::InvalidArgument, message));
            }
            curves.push(welded);
        }
        Ok(curves)
    }
}
