//! The curves that keep their shape and their place along the bones: boundary loops, rims of shells, and those that the caller
//! names, with their weights.

use glam::DVec3;

use super::loop_axis::{LoopAxis, choose_loop_axes, nearest_bone_axis};
use crate::energy::curve::Polyline;
use crate::energy::position::{MovingAxis, Position};
use crate::geometry::mesh::{BoundaryLoop, Topology};
use crate::input::curve::{Curve, WeldedCurve};
use crate::input::skeleton::Skeleton;
use crate::stage::start::beyond_openings::MovedEnd;

/// All curves of a garment that are held.
#[derive(Clone, Debug, Default)]
pub struct HeldCurves {
    curves: Vec<Curve>,
    /// Those that the caller names; a boundary loop that is one is there with its weights.
    is_named: Vec<bool>,
}

impl HeldCurves {
    /// The closed curves `loops`, in their order, with weights 1 or those of the curve in `named` that each is; after them the
    /// others of `named`.
    pub fn new<'a>(loops: impl IntoIterator<Item = &'a BoundaryLoop>, named: &[WeldedCurve]) -> Self {
        let mut held = Self::default();
        let mut is_loop = vec![false; named.len()];
        for boundary in loops {
            let own = named.iter().position(|named| named.curve.coincides(true, &boundary.vertices));
            let [curve_weight, position_weight] = own.map_or([1.0; 2], |k| {
                is_loop[k] = true;
                [named[k].curve.curve_weight, named[k].curve.position_weight]
            });
            let vertices = boundary.vertices.clone();
            held.curves.push(Curve { vertices, closed: true, curve_weight, position_weight });
            held.is_named.push(own.is_some());
        }
        for (named, _) in named.iter().zip(is_loop).filter(|(_, is_loop)| !is_loop) {
            held.curves.push(named.curve.clone());
            held.is_named.push(true);
        }
        held
    }

    /// Those whose shape is held, with the weights of curvature and torsion.
    pub fn polylines(&self) -> impl Iterator<Item = Polyline<'_>> + Clone {
        let held = self.curves.iter().filter(|curve| curve.curve_weight > 0.0);
        held.map(|curve| Polyline { vertices: &curve.vertices, closed: curve.closed, weight: curve.curve_weight })
    }

    /// The position term. A closed curve follows its [loop axis](super::loop_axis). Where it has none, and where it is open, each of
    /// its vertices follows the bone that is nearest to it; for a hole that nobody has named there is nothing. `is_held` says
    /// which vertices have their place from something else: curves there have no place of their own. Ends of limbs that `moved`
    /// beyond an opening say where along the limb it is on the target.
    pub fn position(
        &self,
        rest: &[DVec3],
        topology: &Topology,
        is_held: &[bool],
        [source, target]: [&Skeleton; 2],
        moved: &[MovedEnd],
    ) -> Position {
        let loops: Vec<BoundaryLoop> = self.curves.iter().map(as_loop).collect();
        let chosen = choose_loop_axes(rest, &loops, source, target);
        let mut axes: Vec<MovingAxis> = Vec::new();
        let mut constraints = Vec::new();
        // The axis of each bone that single vertices follow.
        let mut of_bone = vec![None; source.bones.len()];
        for ((curve, axis), named) in self.curves.iter().zip(chosen).zip(&self.is_named) {
            let factor = curve.position_weight;
            if factor == 0.0 || is_held[curve.vertices[0] as usize] {
                continue;
            }
            if let Some(LoopAxis { bones, mut axis }) = axis.filter(|_| curve.closed) {
                if let Some(end) = moved.iter().find(|end| bones == [end.opening.bone]) {
                    axis.end = axis.start.map(|p| end.place(p, source, target));
                }
                constraints.extend(curve.vertices.iter().map(|&v| (v, axes.len() as u32, factor)));
                axes.push(axis);
            } else if *named {
                for &v in &curve.vertices {
                    let Some((bone, axis)) = nearest_bone_axis(rest[v as usize], source, target) else { continue };
                    let index = *of_bone[bone as usize].get_or_insert_with(|| {
                        axes.push(axis);
                        axes.len() as u32 - 1
                    });
                    constraints.push((v, index, factor));
                }
            }
        }
        Position::weighted(rest, &constraints, axes, &topology.mean_edge_lengths(rest))
    }
}

/// An open curve has no axis, and is no loop.
fn as_loop(curve: &Curve) -> BoundaryLoop {
    BoundaryLoop { vertices: if curve.closed { curve.vertices.clone() } else { Vec::new() } }
}
