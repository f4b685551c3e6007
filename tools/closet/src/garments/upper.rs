//! What all garments for the upper body share: trunk, yoke and sleeves as lofts, and where they are cut open.

use glam::DVec3;

use super::super::implicit::{Field, Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::skeleton::{ARMS, NECK, Skeleton, WAIST};
use super::super::surface::Function;
use super::folds::step;
use super::limb::Limb;

/// Trunk and sleeves of a garment.
pub struct Upper {
    /// All parts, smoothly joined.
    pub cloth: Field,
    trunk: Loft,
    sleeves: Vec<[Loft; 2]>,
}

impl Upper {
    /// Joins a trunk, the yoke over the shoulders of about `yoke` metres half its thickness, and the sleeves (upper and
    /// lower half, left and right).
    pub fn new(skeleton: &Skeleton, trunk: Loft, yoke: f64, sleeves: Vec<[Loft; 2]>) -> Self {
        let j = &skeleton.joints;
        let own = Owner::Joint(WAIST);
        let mut cloth = Field::default();
        cloth.add(Shape::Loft(trunk.clone()), 0.02, own);
        for [shoulder, ..] in ARMS {
            let sections = [
                Section::circle(0.0, yoke),
                Section::ellipse(0.5, yoke + 0.002, yoke + 0.016),
                Section::ellipse(1.0, yoke + 0.004, yoke + 0.016),
            ];
            let tip = j[shoulder] + DVec3::new(0.01 * j[shoulder].x.signum(), 0.0, -0.010);
            let yoke = Loft::new(j[NECK] - DVec3::Z * 0.075, tip, DVec3::Y, &sections);
            cloth.add(Shape::Loft(yoke), 0.05, own);
        }
        for [upper, lower] in &sleeves {
            cloth.add(Shape::Loft(upper.clone()), 0.045, own);
            cloth.add(Shape::Loft(lower.clone()), 0.012, own);
        }
        Self { cloth: cloth.finish(), trunk, sleeves }
    }

    /// The number of the sleeve that a point of the cloth belongs to.
    pub fn sleeve(&self, point: DVec3) -> Option<usize> {
        let trunk = self.trunk.distance(point);
        self.sleeves.iter().position(|[upper, lower]| {
            upper.local(point)[0] > 0.12 && upper.distance(point).min(lower.distance(point)) < trunk
        })
    }

    /// From 0 on the trunk to 1 on a sleeve, passing over about 3 cm around the armhole.
    pub fn on_sleeve(&self, point: DVec3) -> f64 {
        step(self.apart(point), 0.016)
    }

    /// How much farther the trunk is than the sleeves, in metres: on the trunk, the distance to the sleeves, negative.
    pub fn apart(&self, point: DVec3) -> f64 {
        let sleeve = self.sleeves.iter().flatten().map(|half| half.distance(point)).fold(f64::INFINITY, f64::min);
        self.trunk.distance(point) - sleeve
    }
}

/// A trunk around the vertical axis: height, half the width, depth to the front and to the back, from below.
pub fn trunk(table: &[[f64; 4]]) -> Loft {
    let (bottom, top) = (table[0][0], table[table.len() - 1][0]);
    let sections: Vec<Section> = table
        .iter()
        .map(|&[z, width, front, back]| Section {
            t: (z - bottom) / (top - bottom),
            centre: [0.0; 2],
            width,
            front,
            back,
        })
        .collect();
    Loft::new(DVec3::Z * bottom, DVec3::Z * top, DVec3::Y, &sections).capped(0.3)
}

/// A sleeve along each arm: for the upper and the lower half its sections as place from 0 to 1, half width, half depth.
pub fn sleeves(skeleton: &Skeleton, upper: &[[f64; 3]], lower: &[[f64; 3]]) -> Vec<[Loft; 2]> {
    let half = |from: usize, to: usize, table: &[[f64; 3]]| {
        let sections: Vec<Section> = table.iter().map(|&[t, width, depth]| Section::ellipse(t, width, depth)).collect();
        Loft::new(skeleton.joints[from], skeleton.joints[to], DVec3::Y, &sections)
    };
    ARMS.iter().map(|&[shoulder, elbow, wrist]| [half(shoulder, elbow, upper), half(elbow, wrist, lower)]).collect()
}

/// Cuts across the lower arms at `end` from 0 to 1.
pub fn cuffs<'a>(arms: &[Limb; 2], end: f64) -> Vec<Function<'a>> {
    let cut = |arm: &Limb| -> Function<'a> {
        let (centre, axis) = arm.bone(true, end);
        // Beyond the reach the plane would also cut the hip.
        Box::new(move |p| if p.distance(centre) < 0.2 { axis.dot(p - centre) } else { -1.0 })
    };
    arms.iter().map(cut).collect()
}

/// A round neck: negative outside an upright ellipse around the neck, in about metres, and far below it.
pub fn round_neck(skeleton: &Skeleton, [wide, deep]: [f64; 2], forward: f64) -> impl Fn(DVec3) -> f64 + Copy + use<> {
    let neck = skeleton.joints[NECK];
    move |p: DVec3| {
        let (x, y) = (p.x / wide, (p.y - neck.y + forward) / deep);
        // All that the head adds in front of it goes too.
        let head = p.z - (neck.z + 0.03 + p.y - neck.y);
        if p.z < neck.z - 0.16 { -1.0 } else { ((1.0 - x.hypot(y)) * wide.min(deep)).max(head) }
    }
}
