//! From a function to the triangles of its zero set: marching tetrahedra, six to a cube.
//!
//! The cubes are cut alike along one diagonal, so the mesh is always a closed manifold.

use glam::DVec3;

use super::implicit::REACH;
use super::mesh::{Mesh, NONE};

/// The corner offsets of the tetrahedra: paths from (0,0,0) to (1,1,1), one axis at a time, positively oriented.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// Side of the blocks (in cubes) that are skipped as a whole where the surface is far.
const BLOCK: usize = 3;

/// A crossing stays this far (as part of the edge) from both ends, so that no triangle is degenerate.
const MARGIN: f64 = 0.1;

/// The zero set of `function` (negative inside, about a distance) between the corners of a box, normals outwards.
pub fn polygonize(function: &dyn Fn(DVec3) -> f64, [low, high]: [DVec3; 2], cell: f64) -> Mesh {
    let low = low - 2.0 * cell;
    let cubes = ((high + 2.0 * cell - low) / cell).ceil();
    let blocks = [cubes.x, cubes.y, cubes.z].map(|n| (n as usize).div_ceil(BLOCK));
    let count = blocks.map(|n| n * BLOCK + 1);
    let stride = [1, count[0], count[0] * count[1]];
    let place = |i: usize, j: usize, k: usize| low + cell * DVec3::new(i as f64, j as f64, k as f64);

    // Blocks far from the surface are skipped. The function may be steeper than a distance, hence the margin of half.
    let reach = 1.5 * 0.5 * BLOCK as f64 * cell * 3f64.sqrt();
    debug_assert!(reach <= REACH, "cells of {cell} m are too coarse");
    let mut values = vec![f64::NAN; count.iter().product()];
    let evaluate = |values: &mut [f64], corner: [usize; 3]| {
        for k in corner[2]..=corner[2] + BLOCK {
            for j in corner[1]..=corner[1] + BLOCK {
                for i in corner[0]..=corner[0] + BLOCK {
                    let value = &mut values[i + j * stride[1] + k * stride[2]];
                    if value.is_nan() {
                        *value = function(place(i, j, k));
                    }
                }
            }
        }
    };
    let mut near = Vec::new();
    let mut is_near = vec![false; blocks.iter().product()];
    let number = |corner: [usize; 3]| {
        let [i, j, k] = corner.map(|n| n / BLOCK);
        i + blocks[0] * (j + blocks[1] * k)
    };
    for bk in 0..blocks[2] {
        for bj in 0..blocks[1] {
            for bi in 0..blocks[0] {
                let corner = [bi * BLOCK, bj * BLOCK, bk * BLOCK];
                let middle = place(corner[0], corner[1], corner[2]) + 0.5 * BLOCK as f64 * cell;
                if function(middle).abs() <= reach {
                    near.push(corner);
                    is_near[number(corner)] = true;
                    evaluate(&mut values, corner);
                }
            }
        }
    }
    // Where the function is steeper still, the surface may leave the blocks found so far: it is followed.
    let mut next = 0;
    while next < near.len() {
        let corner: [usize; 3] = near[next];
        next += 1;
        for axis in 0..3 {
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            for ahead in [false, true] {
                let mut other = corner;
                if ahead {
                    other[axis] += BLOCK;
                } else if other[axis] >= BLOCK {
                    other[axis] -= BLOCK;
                }
                if other == corner || other[axis] + 1 >= count[axis] || is_near[number(other)] {
                    continue;
                }
                let face = corner[axis] + if ahead { BLOCK } else { 0 };
                let inside = |n: usize| {
                    let at = (corner[u] + n % (BLOCK + 1)) * stride[u] + (corner[v] + n / (BLOCK + 1)) * stride[v];
                    values[face * stride[axis] + at] < 0.0
                };
                if (1..(BLOCK + 1).pow(2)).any(|n| inside(n) != inside(0)) {
                    near.push(other);
                    is_near[number(other)] = true;
                    evaluate(&mut values, other);
                }
            }
        }
    }

    let mut mesh = Mesh::default();
    let mut crossings = vec![NONE; 7 * values.len()];
    let offsets: [usize; 8] = std::array::from_fn(|c| (c & 1) + (c >> 1 & 1) * stride[1] + (c >> 2) * stride[2]);
    for [i0, j0, k0] in near {
        for (k, j, i) in (0..BLOCK.pow(3)).map(|n| (k0 + n / BLOCK.pow(2), j0 + n / BLOCK % BLOCK, i0 + n % BLOCK)) {
            let base = i + j * stride[1] + k * stride[2];
            let inside = offsets.iter().filter(|&&offset| values[base + offset] < 0.0).count();
            if inside == 0 || inside == 8 {
                continue;
            }
            for tetrahedron in TETRAHEDRA {
                let mut crossing = |a: usize, b: usize| {
                    let (a, b) = (a.min(b), a.max(b));
                    let slot = &mut crossings[7 * (base + offsets[a]) + (a ^ b) - 1];
                    if *slot == NONE {
                        *slot = mesh.positions.len() as u32;
                        let (va, vb) = (values[base + offsets[a]], values[base + offsets[b]]);
                        let corner = |c: usize| place(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
                        let t = (va / (va - vb)).clamp(MARGIN, 1.0 - MARGIN);
                        mesh.positions.push(corner(a).lerp(corner(b), t));
                    }
                    *slot
                };
                let negative = tetrahedron.map(|c| values[base + offsets[c]] < 0.0);
                emit(tetrahedron, negative, &mut crossing, &mut mesh.triangles);
            }
        }
    }
    mesh
}

/// The triangles in one tetrahedron, seen counter-clockwise from the positive side.
fn emit(
    corners: [usize; 4],
    negative: [bool; 4],
    crossing: &mut dyn FnMut(usize, usize) -> u32,
    triangles: &mut Vec<[u32; 3]>,
) {
    // An even permutation that puts the negative corners first keeps the orientation.
    const EVEN: [[usize; 4]; 12] = [
        [0, 1, 2, 3],
        [0, 2, 3, 1],
        [0, 3, 1, 2],
        [1, 0, 3, 2],
        [1, 2, 0, 3],
        [1, 3, 2, 0],
        [2, 0, 1, 3],
        [2, 1, 3, 0],
        [2, 3, 0, 1],
        [3, 0, 2, 1],
        [3, 1, 0, 2],
        [3, 2, 1, 0],
    ];
    let count = negative.iter().filter(|&&n| n).count();
    let sorted = |order: &&[usize; 4]| (0..4).all(|i| negative[order[i]] == (i < count));
    let Some(order) = EVEN.iter().find(sorted) else { return };
    let [a, b, c, d] = order.map(|i| corners[i]);
    match count {
        1 => triangles.push([crossing(a, b), crossing(a, c), crossing(a, d)]),
        2 => {
            let quad = [crossing(a, c), crossing(a, d), crossing(b, d), crossing(b, c)];
            triangles.push([quad[0], quad[1], quad[2]]);
            triangles.push([quad[0], quad[2], quad[3]]);
        }
        3 => triangles.push([crossing(a, d), crossing(b, d), crossing(c, d)]),
        _ => {}
    }
}
