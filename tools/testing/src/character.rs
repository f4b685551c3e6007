//! Rigged characters of the closet as the library takes them.

use bespoke::error::Result;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::precision::Precision;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::session::Session;
use closet::rigs::Character;
use glam::DMat4;

/// The joints.
pub fn rig(character: &Character) -> Rig {
    let joint = |joint: &closet::rigs::Joint| RigJoint {
        name: joint.name.clone(),
        parent: joint.parent.map(|parent| parent as u32),
        bind: DMat4::from(joint.bind),
    };
    Rig { joints: character.joints.iter().map(joint).collect() }
}

/// The skin weights.
pub fn skin(character: &Character) -> SkinWeights {
    let row = |row: &Vec<(usize, f64)>| row.iter().map(|&(joint, weight)| (joint as u32, weight)).collect();
    SkinWeights::from_rows(character.joints.len(), character.influences.iter().map(row))
}

/// The mesh.
pub fn mesh(character: &Character) -> TriangleMesh {
    TriangleMesh { positions: character.mesh.positions.clone(), triangles: character.mesh.triangles.clone() }
}

/// A session in which the target is dressed in a garment that the source wears, by their rigs alone.
///
/// # Errors
/// Those of the inputs.
pub fn session(garment: &Character, source: &Character, target: &Character, options: Options) -> Result<Session> {
    let mut session = Session::new();
    session.set_options(options)?;
    session.set_garment(mesh(garment), Precision::F32)?;
    session.set_source_rig(rig(source))?;
    session.set_target_avatar(mesh(target))?;
    session.set_target_rig(rig(target))?;
    session.set_target_skin(skin(target))?;
    Ok(session)
}
