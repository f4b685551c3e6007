//! Whether a garment is turned against its skeleton by a right angle, though it lies as near to the bones as many a garment does.
//!
//! A sweater whose sleeves point forward, on a skeleton with its arms to the sides, is around the trunk all the same. But much more of
//! the bones is inside of it once it is turned.

use super::size::Surroundings;
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::cover::cover;
use crate::geometry::mesh::TriangleMesh;
use crate::input::coordinate_system::AxisTurn;
use crate::input::skeleton::Skeleton;

/// Points of each bone that are looked at, and of how many bones at most.
const PLACES: [f64; 3] = [0.25, 0.5, 0.75];
const MOST_BONES: usize = 40;
/// A point is inside where the garment covers it more than this.
const INSIDE: f64 = 0.7;
/// So many points are inside as it is: what is around no bone, such as a backpack, lies beside them in its own way.
const LEAST: usize = 2;
/// By how many times more points have to be inside, and how many more.
const TIMES: f64 = 1.5;
const MORE: usize = 4;

/// The turn of the garment by a right angle after which much more of the bones is inside of it; none where no turn does that.
pub fn turn(garment: &TriangleMesh, skeleton: &Skeleton, surroundings: &Surroundings) -> Option<AxisTurn> {
    let mut turns = surroundings.nearer_turns();
    turns.retain(|turn| turn.degrees() == 90.0);
    if turns.is_empty() {
        return None;
    }
    let tree = ClosestPoint::new(garment);
    let every = skeleton.bones.len().div_ceil(MOST_BONES).max(1);
    let bones = (0..skeleton.bones.len() as u32).step_by(every);
    let points: Vec<_> = bones.flat_map(|bone| PLACES.map(|s| skeleton.point_at(bone, s))).collect();
    let inside = |turn: &AxisTurn| {
        // The bones are turned the other way.
        let back = AxisTurn::rotations().into_iter().find(|back| back.after(*turn) == AxisTurn::IDENTITY);
        let back = back.unwrap_or(AxisTurn::IDENTITY);
        points.iter().filter(|&&p| cover(&tree, back.apply(p)) > INSIDE).count()
    };
    let now = inside(&AxisTurn::IDENTITY);
    if now < LEAST {
        return None;
    }
    // Of turns that are as good, the first: the smaller one.
    let best = turns.iter().map(|turn| (inside(turn), turn)).rev().max_by_key(|(count, _)| *count);
    let (count, turn) = best?;
    (count >= now + MORE && count as f64 >= TIMES * now as f64).then_some(*turn)
}
