//! The targets of pinned vertices.
//!
//! A caller may give the target. Where none is given, a vertex is carried along with the nearest bone: with A, B the ends of
//! that bone on the source skeleton, A', B' on the target's, and R the least rotation that turns B - A to where B' - A' points,
//!
//! ```text
//! p(1) = A' + w (B' - A') + R (p - A - w (B - A)),   w = (p - A) . (B - A) / |B - A|^2
//! ```
//!
//! so that its parameter along the bone and its distance from it stay, and on the same skeleton it stays where it is.

use glam::DVec3;

use crate::energy::pin::Pin;
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::{NO_PIECE, label_pieces};
use crate::geometry::turn;
use crate::input::skeleton::Skeleton;

/// A vertex to pin, and its target in the normalised space where the caller has given one.
pub type PinRequest = (u32, Option<DVec3>);

/// The pins of `asked`, at most one a vertex, for a garment with vertices `rest` and `triangles`. Neighbours that are carried
/// follow one bone: that which is nearest to the mean of them.
pub fn resolve(
    rest: &[DVec3],
    triangles: &[[u32; 3]],
    asked: &[PinRequest],
    source: &Skeleton,
    target: &Skeleton,
) -> Vec<Pin> {
    let mut is_carried = vec![false; rest.len()];
    asked.iter().filter(|(_, target)| target.is_none()).for_each(|&(v, _)| is_carried[v as usize] = true);
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let links = sides.filter(|edge| edge.iter().all(|&v| is_carried[v as usize]));
    let (labels, count) = label_pieces(rest.len(), links);
    let mut sums = vec![(DVec3::ZERO, 0.0); count];
    for (&p, &label) in rest.iter().zip(&labels).filter(|(_, label)| **label != NO_PIECE) {
        let (sum, number) = &mut sums[label as usize];
        *sum += p;
        *number += 1.0;
    }
    let bones: Vec<[u32; 2]> = sums.iter().map(|&(sum, number)| nearest_bone(source, sum / number)).collect();
    let pin = |&(vertex, given): &PinRequest| {
        let start = rest[vertex as usize];
        let end = given.unwrap_or_else(|| {
            let bone = match labels[vertex as usize] {
                // A carried vertex without a carried neighbour.
                NO_PIECE => nearest_bone(source, start),
                label => bones[label as usize],
            };
            carried(start, bone, source, target)
        });
        Pin { vertex, start, end, weight: 1.0 }
    };
    asked.iter().map(pin).collect()
}

/// The joints of the bone nearest to `p`, the first of equals.
fn nearest_bone(skeleton: &Skeleton, p: DVec3) -> [u32; 2] {
    let distance = |bone: &[u32; 2]| {
        let [a, b] = bone.map(|joint| skeleton.joints[joint as usize]);
        closest_on_segment(p, a, b - a).distance_squared(p)
    };
    skeleton.bones.iter().copied().min_by(|s, t| distance(s).total_cmp(&distance(t))).unwrap_or_default()
}

fn carried(p: DVec3, bone: [u32; 2], source: &Skeleton, target: &Skeleton) -> DVec3 {
    let [[a, b], [c, d]] = [source, target].map(|s| bone.map(|joint| s.joints[joint as usize]));
    let [span, turned] = [b - a, d - c];
    let (Some(from), Some(to)) = (span.try_normalize(), turned.try_normalize()) else {
        // A bone without a direction only moves.
        return c + (p - a);
    };
    let along = (p - a).dot(span) / span.length_squared();
    c + along * turned + turn::arc(from, to) * (p - a - along * span)
}
