//! Skin weights of a fitted garment, from those of the body that it is on.
//!
//! Where the garment lies near the body and along it, its weights are *sure*: those of the closest point of the body.
//! Everywhere else they are inpainted: the smoothest ones, in the sense of the bilaplacian energy, that go on from the
//! sure ones (Abdrashitov, Raichstat, Monsen, Hill: Robust Skin Weights Transfer via Weight Inpainting, SIGGRAPH Asia
//! 2023). So a sleeve that stands off takes nothing from the trunk that it happens to be near.
//!
//! Pieces that move as one get one vector of weights, and joints that only the garment has keep what they had
//! ([`own_joints`]). Last, the number of influences is limited to what the host takes.

pub mod blend;
mod factor;
mod groups;
mod inpaint;
mod laplacian;
mod limit;
pub mod own_joints;
mod sure;

use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::skin::SkinWeights;

pub use groups::move_as_one;
pub use limit::limited;
pub use sure::{Sure, sure_weights};

/// How weights go from a body to a garment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransferOptions {
    /// A garment vertex farther from the body than this share of the diagonal of the body's bounding box is not sure.
    pub nearness: f64,
    /// A garment vertex is not sure where its normal and that of the body differ by more than this, in degrees. The side
    /// that the garment shows does not matter.
    pub normal_angle: f64,
    /// Over what length the weights of a vertex that is sure are smoothed, in multiples of its distance from the body. 0
    /// keeps them as they are.
    pub smoothing: f64,
}

impl Default for TransferOptions {
    fn default() -> Self {
        Self { nearness: 0.05, normal_angle: 45.0, smoothing: 1.0 }
    }
}

/// Skin weights for the vertices of `garment`, on the joints of `skin`, which are the weights of `body`. Both meshes are
/// in one space, the garment as fitted, with one vertex for each place (welded). Each vertex gets weights that are above
/// 0 and of sum 1, of any number of joints: see [`limited`].
///
/// A vertex of the body without weights has no say. The result has the same bits for any number of threads.
///
/// # Errors
/// [`ErrorKind::InvalidWeights`]: the weights are not for the body's vertices, or no triangle of the body has any.
/// [`ErrorKind::InvalidMesh`]: a coordinate is not finite, an index is out of range.
/// [`ErrorKind::Cancelled`]; the token is checked before and after the factorisation, and between chunks of vertices.
pub fn transfer(
    garment: &TriangleMesh,
    body: &TriangleMesh,
    skin: &SkinWeights,
    options: &TransferOptions,
    cancel: &Cancel,
) -> Result<SkinWeights> {
    check_mesh(garment, "garment")?;
    check_mesh(body, "body")?;
    if skin.vertex_count() != body.positions.len() {
        let (weights, vertices) = (skin.vertex_count(), body.positions.len());
        return Err(Error::new(
            ErrorKind::InvalidWeights,
            format!("the skin weights are for {weights} vertices, the body has {vertices}; hand over one row for each"),
        ));
    }
    let sure = sure_weights(garment, body, skin, options, cancel)?;
    inpaint::inpaint(garment, &sure, cancel)
}

/// Refuses what has no closest points.
fn check_mesh(mesh: &TriangleMesh, name: &str) -> Result<()> {
    let fail = |message| Err(Error::new(ErrorKind::InvalidMesh, message));
    if let Some(v) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return fail(format!("{name}: vertex {v} is {}, it must be finite", mesh.positions[v]));
    }
    let count = mesh.positions.len();
    if let Some(t) = mesh.triangles.iter().position(|t| t.iter().any(|&v| v as usize >= count)) {
        return fail(format!("{name}: triangle {t} has an index beyond its {count} vertices"));
    }
    Ok(())
}
