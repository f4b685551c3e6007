//! Bodies of the closet, as the stages take them.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::normalization::Normalization;
use closet::Sample;
use closet::skeleton::BONES;

/// The mesh of a body, in metres, z up.
pub fn mesh(body: &Sample) -> TriangleMesh {
    TriangleMesh { positions: body.mesh.positions.clone(), triangles: body.mesh.triangles.clone() }
}

/// The skeleton of a body, in metres, z up.
pub fn skeleton(body: &Sample) -> Skeleton {
    Skeleton { joints: body.skeleton.joints.to_vec(), bones: BONES.to_vec() }
}

/// A body in the normalised space, z up, with its skeleton.
pub fn normalised(body: &Sample) -> (TriangleMesh, Skeleton) {
    let (mut mesh, mut skeleton) = (mesh(body), skeleton(body));
    let normalization = Normalization::of(&skeleton, "").unwrap();
    mesh.positions = normalization.normalise_all(&mesh.positions);
    skeleton.joints = normalization.normalise_all(&skeleton.joints);
    (mesh, skeleton)
}
