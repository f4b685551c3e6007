//! Signed distance of the target avatar as a twice continuously differentiable field, D(p) of Eq. 4.
//!
//! A uniform cubic B-spline over a lattice whose coefficients are the signed distances at the nodes, as the
//! published implementation does it. It reproduces planes exactly and smooths the rest: D is off by about
//! `voxel^2 / 6` times the Laplacian of the distance, `voxel^2 / (3 r)` outside a ball of radius r.
//!
//! The two halves of a node's value come from different places. The *side* is OpenVDB's: it floods the outside
//! from infinity, so that inner walls, cracks below a voxel and overlaps do no harm. The *distance* is exact, from
//! a tree of boxes, and so right also where an open avatar has no inside, beyond any band, and the same
//! whatever the number of threads. Nodes are computed when a sample first touches them. As a node's value depends on
//! nothing but the node, it does not matter which thread does so: sampling needs no preparation and no lock.

pub mod closest_point;
mod spline;
pub mod volume;

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::{DMat3, DVec3};

use crate::error::{Error, ErrorKind, Result};
use crate::input::mesh::TriangleMesh;
use closest_point::ClosestPoint;
use spline::Coefficients;
use volume::{BLOCK, BLOCK_NODES, Volume};

/// Bits of a node not yet computed: not a number, and its sign tells the side (negative inside).
const UNKNOWN: u64 = 0x7FF8_0000_0000_0000;
const SIGN: u64 = 1 << 63;

/// Blocks that have a place to be stored, at most: 32 MB for the places themselves.
const MAX_BLOCKS: usize = 1 << 21;

/// Narrowest rim around the avatar that is stored, in voxels: more than OpenVDB's band, so all beyond is outside.
const MIN_RIM: f64 = 4.0;

/// Distance, in voxels, up to which OpenVDB keeps distances. Only the side is used, which it finds before
/// it widens its band; up to 2 it does not widen.
const BAND: f32 = 2.0;

/// Layers of blocks around a surface that are in use, and bytes of a block: its nodes here, and what OpenVDB has there
/// while it works.
const LAYERS: f64 = 2.0;
const BLOCK_BYTES: f64 = 3.0 * size_of::<Block>() as f64;

/// How to build a [`Field`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldOptions {
    /// Spacing of the lattice, in the unit of the mesh.
    pub voxel: f64,
    /// Threads that OpenVDB may use (it has its own pool). At least 1.
    pub threads: u32,
}

impl Default for FieldOptions {
    fn default() -> Self {
        Self { voxel: 0.01, threads: 1 }
    }
}

/// The 8^3 nodes of one block.
#[derive(Debug)]
struct Block {
    nodes: [AtomicU64; BLOCK_NODES],
    /// A triangle close to the block's centre, for the search tree.
    hint: u32,
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
    /// The lowest of the 4^3 nodes that the spline needs.
    base: [i64; 3],
    /// The point's place in the cell, in [0, 1).
    t: DVec3,
}

impl Field {
    /// The field of `mesh`, any soup of triangles with finite coordinates.
    ///
    /// Fails with [`ErrorKind::InvalidMesh`] without triangles, [`ErrorKind::InvalidArgument`] for a voxel that is
    /// not positive or too small for the mesh, and [`ErrorKind::Cancelled`] soon after `cancel` is set.
    pub fn build(mesh: &TriangleMesh, options: FieldOptions, cancel: &AtomicBool) -> Result<Self> {
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
        let volume = Volume::build(&points, &mesh.triangles, [BAND; 2], options.threads, cancel)?;
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
        // Blocks along the surface, and the layers beside them that OpenVDB and the samples touch; never more than all.
        let along = mesh.areas().iter().sum::<f64>() / (BLOCK as f64 * voxel).powi(2);
        let stored = (LAYERS * along + 64.0).min(places as f64);
        Ok((places * size_of::<OnceLock<Box<Block>>>()) as u64 + (stored * BLOCK_BYTES) as u64)
    }

    /// The search tree over the mesh: exact distances without a side.
    pub fn closest_point(&self) -> &ClosestPoint {
        &self.tree
    }

    /// Spacing of the lattice.
    pub fn voxel(&self) -> f64 {
        self.voxel
    }

    /// Memory in use, in bytes, without the search tree. It grows while new places are sampled.
    pub fn memory(&self) -> u64 {
        let stored = self.blocks.iter().filter(|b| b.get().is_some()).count();
        let places = self.blocks.len() * size_of::<OnceLock<Box<Block>>>();
        self.volume.memory() + (places + stored * size_of::<Block>()) as u64
    }

    /// D at `p`.
    #[inline]
    pub fn value(&self, p: DVec3) -> f64 {
        let cell = self.cell(p);
        spline::value(&self.coefficients(&cell), cell.t)
    }

    /// D and its gradient at `p`.
    #[inline]
    pub fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let cell = self.cell(p);
        let (value, gradient) = spline::value_gradient(&self.coefficients(&cell), cell.t);
        (value, gradient * self.per_voxel)
    }

    /// D, its gradient and its Hessian at `p`.
    #[inline]
    pub fn value_gradient_hessian(&self, p: DVec3) -> (f64, DVec3, DMat3) {
        let cell = self.cell(p);
        let (value, gradient, hessian) = spline::value_gradient_hessian(&self.coefficients(&cell), cell.t);
        (value, gradient * self.per_voxel, hessian * (self.per_voxel * self.per_voxel))
    }

    #[inline]
    fn cell(&self, p: DVec3) -> Cell {
        let u = (p - self.origin) * self.per_voxel;
        let floor = u.floor();
        // Conversion saturates; nothing sensible is that far away, but nothing may overflow either.
        let base = floor.to_array().map(|f| (f as i64).clamp(-(1 << 62), 1 << 62) - 1);
        Cell { base, t: u - floor }
    }

    /// Node values around a cell, computed where they are not yet known.
    #[inline]
    fn coefficients(&self, cell: &Cell) -> Coefficients {
        let stored = (0..3).all(|a| cell.base[a] >= 0 && cell.base[a] + 3 < (self.extent[a] * BLOCK) as i64);
        if !stored {
            return self.beyond(cell);
        }
        let base = cell.base.map(|b| b as usize);
        let near = base.map(|b| b / BLOCK);
        let far = base.map(|b| (b + 3) / BLOCK);
        let blocks: [[[&Block; 2]; 2]; 2] =
            [near[0], far[0]].map(|x| [near[1], far[1]].map(|y| [near[2], far[2]].map(|z| self.block(x, y, z))));
        let inner = base.map(|b| b % BLOCK);
        let mut out = [0.0; 64];
        let mut unknown = false;
        for i in 0..4 {
            let x = inner[0] + i;
            for j in 0..4 {
                let y = inner[1] + j;
                let pair = &blocks[(x / BLOCK) & 1][(y / BLOCK) & 1];
                for k in 0..4 {
                    let z = inner[2] + k;
                    let bits = pair[(z / BLOCK) & 1].nodes[offset(x, y, z)].load(Ordering::Relaxed);
                    unknown |= bits & !SIGN >= UNKNOWN;
                    out[16 * i + 4 * j + k] = f64::from_bits(bits);
                }
            }
        }
        if unknown {
            self.complete(base, &blocks, &mut out);
        }
        out
    }

    /// Computes and stores the unknown nodes among the 4^3 from `base` on.
    #[cold]
    fn complete(&self, base: [usize; 3], blocks: &[[[&Block; 2]; 2]; 2], out: &mut Coefficients) {
        let inner = base.map(|b| b % BLOCK);
        // The neighbour's triangle is the best hint; a hint changes how long the search takes, not its result.
        let mut hint = None;
        for (n, value) in out.iter_mut().enumerate() {
            if !value.is_nan() {
                continue;
            }
            let step = [n / 16, (n / 4) % 4, n % 4];
            let [x, y, z] = [0, 1, 2].map(|a| inner[a] + step[a]);
            let block = blocks[(x / BLOCK) & 1][(y / BLOCK) & 1][(z / BLOCK) & 1];
            let node = self.node([0, 1, 2].map(|a| (base[a] + step[a]) as f64));
            let (distance, triangle) = self.tree.distance_hinted(node, hint.unwrap_or(block.hint));
            hint = Some(triangle);
            *value = distance.copysign(*value);
            block.nodes[offset(x, y, z)].store(value.to_bits(), Ordering::Relaxed);
        }
    }

    /// Node values around a cell outside the stored region, where nothing is inside: slow, but the same field.
    #[cold]
    fn beyond(&self, cell: &Cell) -> Coefficients {
        std::array::from_fn(|n| {
            let step = [n / 16, (n / 4) % 4, n % 4];
            self.tree.distance(self.node([0, 1, 2].map(|a| (cell.base[a] + step[a] as i64) as f64)))
        })
    }

    /// Position of a node.
    #[inline]
    fn node(&self, index: [f64; 3]) -> DVec3 {
        self.origin + DVec3::from_array(index) * self.voxel
    }

    /// The block at a place within the stored region; when new, with the side of its nodes but no distance.
    #[inline]
    fn block(&self, x: usize, y: usize, z: usize) -> &Block {
        self.blocks[(x * self.extent[1] + y) * self.extent[2] + z].get_or_init(|| {
            let first = [x, y, z].map(|b| b * BLOCK);
            let (values, _) = self.volume.read_block(first.map(|i| i as i32));
            let nodes = values.map(|v| AtomicU64::new(if v < 0.0 { UNKNOWN | SIGN } else { UNKNOWN }));
            let centre = self.node(first.map(|i| i as f64 + 0.5 * (BLOCK - 1) as f64));
            Box::new(Block { nodes, hint: self.tree.hint(centre) })
        })
    }
}

/// Place of a node in its block; whole blocks are left out of the coordinates.
#[inline]
fn offset(x: usize, y: usize, z: usize) -> usize {
    (((x % BLOCK) * BLOCK) + y % BLOCK) * BLOCK + z % BLOCK
}

/// The box around the vertices that triangles use.
fn used_bounds(mesh: &TriangleMesh) -> Result<(DVec3, DVec3)> {
    if mesh.triangles.is_empty() {
        return Err(Error::new(ErrorKind::InvalidMesh, "distance field: the avatar has no triangles"));
    }
    let corners = mesh.triangles.iter().flatten().map(|&v| mesh.positions[v as usize]);
    Ok(corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p))))
}

/// Node (0, 0, 0) and the number of blocks along each axis: the avatar with a rim of half its longest side,
/// less where that would be too many.
fn layout(low: DVec3, high: DVec3, voxel: f64) -> Result<(DVec3, [usize; 3])> {
    let size = (high - low) / voxel;
    let longest = size.max_element();
    let mut rim = (0.5 * longest).max(MIN_RIM);
    loop {
        let blocks = ((size + 2.0 * rim) / BLOCK as f64).ceil() + 1.0;
        if blocks.x * blocks.y * blocks.z <= MAX_BLOCKS as f64 {
            return Ok((low - rim * voxel, blocks.to_array().map(|b| b as usize)));
        }
        if rim <= MIN_RIM || !longest.is_finite() {
            let longest = longest * voxel;
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!(
                    "distance field: a voxel of {voxel} is too small for an avatar of size {longest}: choose a larger one"
                ),
            ));
        }
        rim = (0.5 * rim).max(MIN_RIM);
    }
}
