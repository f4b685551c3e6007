//! A garment on the body of its own file.

use bespoke::error::Result;
use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::options::Options;
use bespoke::session::{PartRole, RenderMesh};

use crate::bodies::{self, joined};
use crate::figure::Figure;
use crate::fit::{Job, shared_avatar, shared_garment};
use crate::outfit::Garment;

/// Asks `see` about a garment as it would be dressed on the body that it is on; none where the file has no rig or no body.
///
/// # Errors
/// Where the library refuses the body.
pub fn on_own_body<T>(figure: &Figure, garment: &Garment, see: impl FnOnce(&Job) -> T) -> Result<Option<T>> {
    if figure.rig.joints.is_empty() {
        return Ok(None);
    }
    let parts = garment.parts.iter().map(|&part| &figure.parts[part]);
    let (cloth, _) = joined(parts, figure.rig.joints.len());
    let Some(body) = bodies::source(figure) else { return Ok(None) };
    let roles = vec![PartRole::Automatic; body.mesh.triangles.len()];
    let worn = shared_garment(&cloth, figure.has_skin(), &[], Some(&body), &figure.rig, figure.space())?;
    let shared = shared_avatar(&figure.rig, &body, &roles)?;
    let job = Job {
        name: &garment.name,
        garment: &cloth,
        drawn: &RenderMesh::default(),
        morphs: &[],
        has_skin: figure.has_skin(),
        source: Some(&body),
        source_rig: &figure.rig,
        avatar: &body,
        roles: &roles,
        target_rig: &figure.rig,
        shared_garment: &worn,
        shared_avatar: &shared,
        dispensable: &[],
        layers: &[],
        pairs: &[],
        skeletons: figure.skeleton().map(|skeleton| [skeleton, skeleton]),
        space: CoordinateSystem::default(),
        influences: 4,
        options: &Options::default(),
        quiet: true,
    };
    Ok(Some(see(&job)))
}
