//! A garment on the body of its own file.

use bespoke::options::Options;
use bespoke::session::{PartRole, RenderMesh};

use crate::bodies::{self, joined};
use crate::figure::Figure;
use crate::fit::Job;
use crate::outfit::Garment;

/// Asks `see` about a garment as it would be dressed on the body that it is on; none where the file has no rig or no body.
pub fn on_own_body<T>(figure: &Figure, garment: &Garment, see: impl FnOnce(&Job) -> T) -> Option<T> {
    if figure.rig.joints.is_empty() {
        return None;
    }
    let parts = garment.parts.iter().map(|&part| &figure.parts[part]);
    let (cloth, _) = joined(parts, figure.rig.joints.len());
    let body = bodies::sources(figure).into_iter().next()?;
    let roles = vec![PartRole::Automatic; body.mesh.triangles.len()];
    let job = Job {
        name: &garment.name,
        garment: &cloth,
        drawn: &RenderMesh::default(),
        morphs: &[],
        has_skin: true,
        source: Some(&body),
        source_rig: &figure.rig,
        avatar: &body,
        roles: &roles,
        target_rig: &figure.rig,
        layers: &[],
        pairs: &[],
        influences: 4,
        options: &Options::default(),
        quiet: true,
    };
    Some(see(&job))
}
