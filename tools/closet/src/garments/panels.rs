//! The pattern pieces of a garment: trunk, sleeves and trouser legs, each unrolled around its axis.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::super::mesh::Mesh;
use super::super::texture::{Panel, Texture, unwrap};
use super::limb::Limb;

/// Mean radius of a trunk and of a sleeve or trouser leg, in metres.
pub const TRUNK: f64 = 0.18;
pub const LIMB: f64 = 0.07;

/// The angle around the trunk: 0 in front, a quarter of a turn on the left.
pub fn trunk_angle(point: DVec3) -> f64 {
    point.x.atan2(-point.y)
}

/// Unrolls the trunk from the height `bottom` and each limb; `limb` tells which limb a point is on, if any.
pub fn panels(mesh: &Mesh, bottom: f64, limbs: &[Limb], limb: &dyn Fn(DVec3) -> Option<usize>) -> Texture {
    let trunk = Panel {
        coordinates: Box::new(|p| (trunk_angle(p), p.z)),
        radius: TRUNK,
        corner: [0.0; 2],
        origin: [-PI, bottom],
    };
    let mut panels = vec![trunk];
    for (number, limb) in limbs.iter().enumerate() {
        panels.push(Panel {
            coordinates: Box::new(move |p| {
                let place = limb.place(p);
                // The seam runs along the side of the trunk; right and left show the cloth's outside alike.
                let angle = place.angle - 0.5 * PI;
                let angle = if angle < -PI { angle + TAU } else { angle };
                (if limb.is_left() { angle } else { -angle }, -place.along)
            }),
            radius: LIMB,
            corner: [TAU * (TRUNK + number as f64 * LIMB) + 0.05 * (1 + number) as f64, 0.0],
            origin: [-PI, -limb.length()],
        });
    }
    unwrap(mesh, &panels, &|p| limb(p).map_or(0, |number| number + 1))
}
