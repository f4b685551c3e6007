//! Signed distance of the target avatar as a twice continuously differentiable field, D(p) of Eq. 4.
//!
//! A uniform cubic B-spline over a lattice whose coefficients are the signed distances at the nodes, as the
//! published implementation does it. It reproduces planes exactly and smooths the rest: D is off by about
//! `voxel^2 / 6` times the Laplacian of the distance, `voxel^2 / (3 r)` outside a ball of radius r.
//!
//! The two halves of a node's value come from different places. The *sign* is OpenVDB's: it flood-fills the outside
//! from infinity, so that inner walls, cracks below a voxel and overlaps do no harm. The *distance* is exact, from
//! a tree of boxes, and so correct also where an open avatar has no inside, beyond any band, and the same
//! whatever the number of threads. Nodes are computed when a sample first touches them. As a node's value depends on
//! nothing but the node, it does not matter which thread does so: sampling needs no preparation, and no lock where the
//! nodes are known.
//!
//! Nodes are stored as single-precision numbers, in blocks that overlap, so that all the nodes of a sample are in one
//! block. The spline is then that of distances which are off by up to 6e-8 of themselves: just as smooth, with derivatives
//! that are consistent to the last digits.

mod block;
mod spline;
pub mod volume;

use std::sync::OnceLock;

use glam::DVec3;

use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::TriangleMesh;
use crate::simd::f64x4::{F64x4, Kernel, dispatch};
use block::{Block, Known, SIDE};
use volume::{BLOCK, Volume};

/// Blocks that can be stored, at most: their pointers alone take 32 MB.
const MAX_BLOCKS: usize = 1 << 21;

/// Smallest padding of the stored region around the avatar, in voxels: more than OpenVDB's band, so all beyond is outside.
const MIN_PADDING: f64 = 4.0;

/// Distance, in voxels, up to which OpenVDB keeps distances (the narrow band). Only the sign is used, which it
/// finds before it widens its band; up to 2 it does not widen.
const BAND: f32 = 2.0;

/// From so many voxels beyond the stored region on, a sample is the exact distance, which takes one search and not one for
/// each of 64 nodes, and there they agree to 1e-4 of a voxel; from the first to the second, the one passes into the other.
const SPLINE_TO: f64 = 25.0;
const EXACT_FROM: f64 = 50.0;

/// Layers of blocks around a surface that are in use, and bytes of a block: its nodes here, and what OpenVDB has there
/// while it works.
const LAYERS: f64 = 2.0;
const BLOCK_BYTES: f64 = (size_of::<Block>() + 8192) as f64;

/// How to build a [`Field`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldOptions {
    /// Spacing of the lattice, in the unit of the mesh.
    pub voxel: f64,
    /// Threads that voxelise: the calling one, and others that end with [`Field::build`]. At least 1.
    pub threads: u32,
}

impl Default for FieldOptions {
    fn default() -> Self {
        Self { voxel: 0.01, threads: 1 }
    }
}

/// Signed distance to a mesh: positive outside, negative inside, unit gradient but for the smoothing.
#[derive(Debug)]
pub struct Field {
    tree: ClosestPoint,
    volume: Volume,
    /// Position of node (0, 0, 0).
    origin: DVec3,
    voxel: f64,
    per_voxel: f64,
    /// Blocks along each axis.
    extent: [usize; 3],
    blocks: Vec<OnceLock<Box<Block>>>,
}

/// The cell of the lattice that holds a point.
struct Cell {
    /// The lowest of the 4^3 nodes that the spline needs, which is also the cell's index among those stored.
    base: [i64; 3],
    /// The point's local coordinates in the cell, in [0, 1).
    t: DVec3,
}

impl Field {
    /// The field of `mesh`, any soup of triangles with finite coordinates.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidMesh`] without triangles, [`ErrorKind::InvalidArgument`] for a voxel that is not positive or too
    /// small for the mesh, and [`ErrorKind::Cancelled`] soon after `cancel` is set.
    pub fn build(mesh: &TriangleMesh, options: FieldOptions, cancel: &Cancel) -> Result<Self> {
        let voxel = options.voxel;
        if !(voxel > 0.0 && voxel.is_finite()) {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("distance field: the voxel must be a positive number, not {voxel}"),
            ));
        }
        let (low, high) = used_bounds(mesh)?;
        let (origin, extent) = layout(low, high, voxel)?;
        let points: Vec<[f32; 3]> =
            mesh.positions.iter().map(|&p| ((p - origin) / voxel).as_vec3().to_array()).collect();
        let volume = Volume::build(&points, &mesh.triangles, BAND, options.threads, cancel)?;
        let mut blocks = Vec::new();
        blocks.resize_with(extent.iter().product(), OnceLock::new);
        Ok(Self { tree: ClosestPoint::new(mesh), volume, origin, voxel, per_voxel: voxel.recip(), extent, blocks })
    }

    /// About how many bytes the field of `mesh` takes at most, while it is built and in use.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidMesh`] without triangles, [`ErrorKind::InvalidArgument`] where the voxel is too small for the
    /// mesh: as [`Self::build`], but before the work.
    pub fn estimate(mesh: &TriangleMesh, voxel: f64) -> Result<u64> {
        let (low, high) = used_bounds(mesh)?;
        let (_, extent) = layout(low, high, voxel)?;
        let places: usize = extent.iter().product();
        // Blocks along the surface, and the neighbouring layers that OpenVDB and the samples touch; never more than all.
        let along = mesh.areas().iter().sum::<f64>() / (BLOCK as f64 * voxel).powi(2);
        let stored = (LAYERS * along + 64.0).min(places as f64);
        Ok((places * size_of::<OnceLock<Box<Block>>>()) as u64 + (stored * BLOCK_BYTES) as u64)
    }

    /// The search tree over the mesh: exact distances without a sign.
    pub fn closest_point(&self) -> &ClosestPoint {
        &self.tree
    }

    /// Spacing of the lattice.
    pub fn voxel(&self) -> f64 {
        self.voxel
    }

    /// Memory in use, in bytes, without the search tree. It grows as new cells are sampled.
    pub fn memory(&self) -> u64 {
        let stored = self.blocks.iter().filter(|b| b.get().is_some()).count();
        let places = self.blocks.len() * size_of::<OnceLock<Box<Block>>>();
        self.volume.memory() + (places + stored * size_of::<Block>()) as u64
    }

    /// D at `p`.
    pub fn value(&self, p: DVec3) -> f64 {
        let mut out = [0.0];
        self.values(&[p], &mut out);
        out[0]
    }

    /// D and its gradient at `p`.
    pub fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let mut out = [(0.0, DVec3::ZERO)];
        self.values_gradients(&[p], &mut out);
        out[0]
    }

    /// D at each of `points`, written to the entries of `out`; as many as the shorter of both.
    #[inline]
    pub fn values(&self, points: &[DVec3], out: &mut [f64]) {
        dispatch(Samples::<Value> { field: self, points, out });
    }

    /// D and its gradient at each of `points`, written to the entries of `out`; as many as the shorter of both. Values
    /// have the same bits as those of [`Self::values`].
    #[inline]
    pub fn values_gradients(&self, points: &[DVec3], out: &mut [(f64, DVec3)]) {
        dispatch(Samples::<ValueGradient> { field: self, points, out });
    }

    #[inline(always)]
    fn cell(&self, p: DVec3) -> Cell {
        let u = (p - self.origin) * self.per_voxel;
        let floor = u.floor();
        // Conversion saturates; points that far away make no sense, but must not overflow.
        let base = floor.to_array().map(|f| (f as i64).clamp(-(1 << 62), 1 << 62) - 1);
        Cell { base, t: u - floor }
    }

    /// The block of a cell and the cell's lowest node, where it is stored.
    #[inline(always)]
    fn stored(&self, cell: &Cell) -> Option<(&Block, [usize; 3])> {
        let stored = (0..3).all(|a| cell.base[a] >= 0 && cell.base[a] < (self.extent[a] * BLOCK) as i64);
        if !stored {
            return None;
        }
        let base = cell.base.map(|b| b as usize);
        let at = base.map(|b| b / BLOCK);
        let block = &self.blocks[self.block_index(at)];
        Some((if let Some(block) = block.get() { block } else { block.get_or_init(|| self.new_block(at)) }, base))
    }

    /// The nodes around a stored cell, computed where they are not yet known.
    #[inline(always)]
    fn nodes<'a>(&self, block: &'a Block, base: [usize; 3]) -> Known<'a> {
        if let Some(known) = block.known(base) { known } else { self.complete(block, base) }
    }

    /// Computes the unknown nodes around a stored cell, or copies them from a neighbouring block.
    #[cold]
    fn complete<'a>(&self, block: &'a Block, base: [usize; 3]) -> Known<'a> {
        // The neighbour's triangle is the best hint; a hint changes how long the search takes, not its result.
        let mut hint = block.hint;
        let mut distances = [0.0; 64];
        let missing = block.missing(base);
        for n in (0..64).filter(|n| missing >> n & 1 == 1) {
            let node = [0, 1, 2].map(|a| base[a] + [n / 16, (n / 4) % 4, n % 4][a]);
            distances[n] = self.find_in_neighbours(base, node).unwrap_or_else(|| {
                let (distance, triangle) = self.tree.distance_hinted(self.node(node.map(|i| i as f64)), hint);
                hint = triangle;
                distance as f32
            });
        }
        block.complete(base, &distances)
    }

    /// The distance at a node, where a block other than that of `base` has computed it.
    fn find_in_neighbours(&self, base: [usize; 3], node: [usize; 3]) -> Option<f32> {
        let own = base.map(|i| i / BLOCK);
        let last = node.map(|i| i / BLOCK);
        // Along an axis, a node is in one block, or in two.
        let first = node.map(|i| (i + 1).saturating_sub(SIDE).div_ceil(BLOCK));
        for x in first[0]..=last[0] {
            for y in first[1]..=last[1] {
                for z in first[2]..=last[2] {
                    if [x, y, z] == own || x >= self.extent[0] || y >= self.extent[1] || z >= self.extent[2] {
                        continue;
                    }
                    let inner = [0, 1, 2].map(|a| node[a] - [x, y, z][a] * BLOCK);
                    let found = self.blocks[self.block_index([x, y, z])].get().and_then(|block| block.node(inner));
                    if found.is_some() {
                        return found;
                    }
                }
            }
        }
        None
    }

    /// Index of a block.
    #[inline(always)]
    fn block_index(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.extent[1] + y) * self.extent[2] + z
    }

    /// A sample at `p` outside the stored region, where nothing is inside; `spline` is that of the nodes, which is slow there.
    #[cold]
    fn outside<S: Sample>(&self, p: DVec3, spline: impl FnOnce() -> S::Output) -> S::Output {
        let high = self.node(self.extent.map(|blocks| (blocks * BLOCK) as f64));
        let beyond = p - p.clamp(self.origin, high);
        let far = beyond.length() * self.per_voxel;
        let share = (far - SPLINE_TO) / (EXACT_FROM - SPLINE_TO);
        if share.is_nan() || share <= 0.0 {
            return spline();
        }
        let Some(closest) = self.tree.closest(p) else { return spline() };
        let exact = S::exact(closest.distance, (p - closest.point) / closest.distance);
        if share >= 1.0 {
            return exact;
        }
        // Twice differentiable at both ends.
        let weight = share * share * share * (10.0 + share * (6.0 * share - 15.0));
        let rise = 30.0 * share * share * (1.0 - share) * (1.0 - share) / (EXACT_FROM - SPLINE_TO);
        S::between(spline(), exact, weight, rise * self.per_voxel / beyond.length() * beyond)
    }

    /// The nodes around a cell outside the stored region.
    #[cold]
    fn nodes_outside(&self, cell: &Cell) -> [f32; 64] {
        let node = |n: usize| {
            let step = [n / 16, (n / 4) % 4, n % 4];
            self.node([0, 1, 2].map(|a| (cell.base[a] + step[a] as i64) as f64))
        };
        // A neighbour's closest triangle is nearly always a node's own: the search only has to confirm it.
        let mut hint = self.tree.hint(node(0));
        std::array::from_fn(|n| {
            let (distance, closest) = self.tree.distance_hinted(node(n), hint);
            hint = closest;
            distance as f32
        })
    }

    /// Position of a node.
    #[inline]
    fn node(&self, index: [f64; 3]) -> DVec3 {
        self.origin + DVec3::from_array(index) * self.voxel
    }

    /// A new block of the stored region, with the sign of its nodes but no distance.
    #[cold]
    fn new_block(&self, block: [usize; 3]) -> Box<Block> {
        let first = block.map(|b| b * BLOCK);
        // A block also has nodes of the next ones.
        let volumes: [_; 8] = std::array::from_fn(|n| {
            let next = [n / 4, (n / 2) % 2, n % 2];
            self.volume.block([0, 1, 2].map(|a| (first[a] + next[a] * BLOCK) as i32))
        });
        let inside = |[x, y, z]: [usize; 3]| {
            let volume = &volumes[(x / BLOCK) * 4 + (y / BLOCK) * 2 + z / BLOCK];
            volume[x % BLOCK] >> ((y % BLOCK) * BLOCK + z % BLOCK) & 1 == 1
        };
        let centre = self.node(first.map(|i| i as f64 + 0.5 * (BLOCK - 1) as f64));
        Box::new(Block::new(inside, self.tree.hint(centre)))
    }
}

/// A quantity computed from the nodes around a point.
trait Sample {
    type Output: Copy;

    /// The same of an exact distance with its gradient.
    fn exact(distance: f64, gradient: DVec3) -> Self::Output;

    /// From `near` to `far`, by the weight of `far` and the gradient of that.
    fn between(near: Self::Output, far: Self::Output, weight: f64, slope: DVec3) -> Self::Output;

    /// From `row(i, j)`, nodes (i, j, 0..4), at `t` in the cell. Inlined, to be compiled for the processor.
    fn compute<V: F64x4>(row: impl Fn(usize, usize) -> [f32; 4], t: DVec3, per_voxel: f64) -> Self::Output;
}

struct Value;

impl Sample for Value {
    type Output = f64;

    #[inline]
    fn exact(distance: f64, _: DVec3) -> f64 {
        distance
    }

    #[inline]
    fn between(near: f64, far: f64, weight: f64, _: DVec3) -> f64 {
        near + weight * (far - near)
    }

    #[inline(always)]
    fn compute<V: F64x4>(row: impl Fn(usize, usize) -> [f32; 4], t: DVec3, _: f64) -> f64 {
        spline::value::<V>(row, t)
    }
}

struct ValueGradient;

impl Sample for ValueGradient {
    type Output = (f64, DVec3);

    #[inline]
    fn exact(distance: f64, gradient: DVec3) -> (f64, DVec3) {
        (distance, gradient)
    }

    #[inline]
    fn between(near: (f64, DVec3), far: (f64, DVec3), weight: f64, slope: DVec3) -> (f64, DVec3) {
        let apart = far.0 - near.0;
        (near.0 + weight * apart, near.1.lerp(far.1, weight) + apart * slope)
    }

    #[inline(always)]
    fn compute<V: F64x4>(row: impl Fn(usize, usize) -> [f32; 4], t: DVec3, per_voxel: f64) -> (f64, DVec3) {
        let (value, gradient) = spline::value_gradient::<V>(row, t);
        (value, gradient * per_voxel)
    }
}

/// A sample at each of many points.
struct Samples<'a, S: Sample> {
    field: &'a Field,
    points: &'a [DVec3],
    out: &'a mut [S::Output],
}

impl<S: Sample> Kernel for Samples<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run<V: F64x4>(self) {
        let field = self.field;
        for (&p, out) in self.points.iter().zip(self.out) {
            let cell = field.cell(p);
            *out = if let Some((block, base)) = field.stored(&cell) {
                let nodes = field.nodes(block, base);
                S::compute::<V>(|i, j| nodes.row(i, j), cell.t, field.per_voxel)
            } else {
                field.outside::<S>(p, || {
                    let nodes = field.nodes_outside(&cell);
                    S::compute::<V>(|i, j| row(&nodes, i, j), cell.t, field.per_voxel)
                })
            };
        }
    }
}

/// Nodes (i, j, 0..4) of the 4^3.
#[inline(always)]
fn row(nodes: &[f32; 64], i: usize, j: usize) -> [f32; 4] {
    std::array::from_fn(|k| nodes[16 * i + 4 * j + k])
}

/// The box around the vertices that triangles use.
fn used_bounds(mesh: &TriangleMesh) -> Result<(DVec3, DVec3)> {
    if mesh.triangles.is_empty() {
        return Err(Error::new(ErrorKind::InvalidMesh, "distance field: the avatar has no triangles"));
    }
    let corners = mesh.triangles.iter().flatten().map(|&v| mesh.positions[v as usize]);
    Ok(corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p))))
}

/// Node (0, 0, 0) and the number of blocks along each axis: the avatar with a padding of half its longest
/// side, less where that would be too many.
fn layout(low: DVec3, high: DVec3, voxel: f64) -> Result<(DVec3, [usize; 3])> {
    let size = (high - low) / voxel;
    let longest = size.max_element();
    let mut padding = (0.5 * longest).max(MIN_PADDING);
    loop {
        let blocks = ((size + 2.0 * padding) / BLOCK as f64).ceil() + 1.0;
        if blocks.x * blocks.y * blocks.z <= MAX_BLOCKS as f64 {
            return Ok((low - padding * voxel, blocks.to_array().map(|b| b as usize)));
        }
        if padding <= MIN_PADDING || !longest.is_finite() {
            let longest = longest * voxel;
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!(
                    "distance field: a voxel of {voxel} is too small for an avatar of size {longest}: choose a larger voxel_size"
                ),
            ));
        }
        padding = (0.5 * padding).max(MIN_PADDING);
    }
}
