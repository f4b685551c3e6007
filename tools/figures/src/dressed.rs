//! A garment put on a body, perhaps over others.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::session::{Precision, Report};

use crate::figure::Outcome;
use closet::Sample;
use gallery::pair;

/// A garment on a body, verified.
pub struct Dressed {
    /// As a caller with 32-bit coordinates reads it.
    pub mesh: TriangleMesh,
    /// Of each triangle.
    pub distortion: Vec<f64>,
    /// What the session has measured.
    pub report: Report,
}

impl Dressed {
    /// Mean and largest distortion.
    pub fn distortions(&self) -> [f64; 2] {
        pair::mean_and_largest(&self.distortion)
    }
}

/// Puts `garment` on `body`, which wears `layers` already. The fit aims at the looseness on the mannequin where that is
/// given.
pub fn dress(
    garment: &Sample,
    body: &Sample,
    layers: &[TriangleMesh],
    mannequin: Option<&Sample>,
    options: &Options,
) -> Outcome<Dressed> {
    let run = || {
        let mut session = pair::session(garment, body, mannequin, options)?;
        layers.iter().try_for_each(|layer| session.add_layer(layer.clone()))?;
        session.run()?;
        Ok(Dressed {
            mesh: TriangleMesh {
                positions: session
                    .garment_as_read(Precision::F32)?
                    .into_iter()
                    .map(|p| Precision::F32.round(p))
                    .collect(),
                triangles: garment.mesh.triangles.clone(),
            },
            distortion: session.distortion()?,
            report: session.report(),
        })
    };
    run().map_err(|error: bespoke::error::Error| error.message)
}
