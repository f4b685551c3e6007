//! What tools do today where they have no solver: skinning, then a shrink-wrap to the designed offset.
//!
//! Each garment vertex takes the skin weights of the nearest point of the body that it was designed on, and goes where linear
//! blend skinning puts it, with one similarity a bone from the one skeleton to the other. What then lies nearer to the new
//! body than it lay to the old one is pushed out to that distance, along the direction from the nearest point of the surface.
//! Nothing looks at intersections.

use bespoke::geometry::closest_point::{Closest, ClosestPoint, barycentric};
use bespoke::geometry::mesh::TriangleMesh;
use glam::{DMat3, DQuat, DVec3};

use closet::Sample;
use closet::skeleton::{ARMS, JOINTS, LEGS, NECK, ROOT, Skeleton, WAIST};
use gallery::pair;

/// The bone that moves what each joint owns: from the joint to another one.
fn bone_of(joint: usize) -> [usize; 2] {
    for [a, b, c] in ARMS.into_iter().chain(LEGS) {
        if joint == a {
            return [a, b];
        }
        // Hands and feet go with forearm and shin.
        if joint == b || joint == c {
            return [b, c];
        }
    }
    match joint {
        ROOT => [ROOT, WAIST],
        NECK => [WAIST, NECK],
        _ => [WAIST, NECK],
    }
}

/// A similarity: `p -> to + matrix (p - from)`.
struct Similarity {
    from: DVec3,
    matrix: DMat3,
    to: DVec3,
}

impl Similarity {
    /// Takes the bone of `joint` from `source` to `target`: the least rotation, and the ratio of lengths.
    fn of(joint: usize, source: &Skeleton, target: &Skeleton) -> Self {
        let [a, b] = bone_of(joint);
        let [was, is] = [source, target].map(|s| s.joints[b] - s.joints[a]);
        let turn = DMat3::from_quat(DQuat::from_rotation_arc(was.normalize(), is.normalize()));
        let matrix = turn * (is.length() / was.length());
        // About the joint itself, which is the end of the bone for hands, feet and head.
        Self { from: source.joints[joint], matrix, to: target.joints[joint] }
    }

    fn apply(&self, p: DVec3) -> DVec3 {
        self.to + self.matrix * (p - self.from)
    }
}

/// Puts `garment`, designed on `mannequin`, on `body`.
pub fn transfer(garment: &Sample, mannequin: &Sample, body: &Sample) -> TriangleMesh {
    let maps: Vec<Similarity> =
        (0..JOINTS).map(|joint| Similarity::of(joint, &mannequin.skeleton, &body.skeleton)).collect();
    let (old, new) = (pair::mesh(&mannequin.mesh), pair::mesh(&body.mesh));
    let [old_tree, new_tree] = [&old, &new].map(ClosestPoint::new);
    let place = |&p: &DVec3| {
        let Some(near) = old_tree.closest(p) else { return p };
        let corners = old.triangles[near.triangle as usize];
        let shares = barycentric(near.point, corners.map(|v| old.positions[v as usize]));
        let weight =
            |joint: usize| corners.iter().zip(shares).map(|(&v, s)| s * mannequin.skin[joint][v as usize]).sum::<f64>();
        let skinned: DVec3 = (0..JOINTS).map(|joint| weight(joint) * maps[joint].apply(p)).sum();
        let Some(surface) = new_tree.closest(skinned) else { return skinned };
        pushed(skinned, &surface, &new, near.distance)
    };
    let positions = garment.mesh.positions.iter().map(place).map(|p| p.as_vec3().as_dvec3()).collect();
    TriangleMesh { positions, triangles: garment.mesh.triangles.clone() }
}

/// `p`, or the place at `offset` from the surface where p is nearer than that, or inside.
fn pushed(p: DVec3, surface: &Closest, body: &TriangleMesh, offset: f64) -> DVec3 {
    let [a, b, c] = body.triangles[surface.triangle as usize].map(|v| body.positions[v as usize]);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let outwards = p - surface.point;
    let is_inside = outwards.dot(normal) < 0.0;
    if !is_inside && surface.distance >= offset {
        return p;
    }
    let direction = if is_inside { -outwards } else { outwards }.try_normalize().unwrap_or(normal);
    surface.point + offset * direction
}
