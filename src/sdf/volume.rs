//! The only file that calls the C++ shim: a triangle soup voxelised by OpenVDB, for the sign of the distance.
//!
//! The shim hands over where nodes lie inside, and keeps nothing: reading and dropping a volume is plain Rust.

use std::collections::{HashMap, HashSet};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr;

use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};

/// Nodes along one side of a block.
pub const BLOCK: usize = 8;

/// Which nodes of a block lie inside: bit 8 j + k of entry i is that of node (i, j, k).
pub type Inside = [u64; BLOCK];

/// Nodes along one side of the cubes that lie inside as a whole: the nodes of OpenVDB's trees.
const SIDES: [u32; 2] = [128, 4096];

const OK: c_int = 0;
const CANCELLED: c_int = 1;
const INVALID: c_int = 3;

unsafe extern "C" {
    fn bespoke_volume_build(
        points: *const f32,
        point_count: usize,
        triangles: *const u32,
        triangle_count: usize,
        band: f32,
        threads: u32,
        cancelled: extern "C" fn(*const c_void) -> c_int,
        context: *const c_void,
        cube: extern "C" fn(*mut c_void, *const [i32; 3], u32, *const Inside),
        cubes: *mut c_void,
        message: *mut c_char,
        message_capacity: usize,
    ) -> c_int;
}

extern "C" fn is_cancelled(context: *const c_void) -> c_int {
    // SAFETY: `build` passes a token that outlives the call, and it may be read from any thread.
    let cancel = unsafe { &*context.cast::<Cancel>() };
    c_int::from(cancel.is_requested())
}

extern "C" fn take_cube(volume: *mut c_void, origin: *const [i32; 3], side: u32, inside: *const Inside) {
    // SAFETY: `build` passes a volume that outlives the call and that nobody else uses meanwhile; the origin is there.
    let (volume, origin) = unsafe { (&mut *volume.cast::<Volume>(), *origin) };
    // SAFETY: null, or the nodes of a block.
    match unsafe { inside.as_ref() } {
        Some(inside) => drop(volume.blocks.insert(origin, *inside)),
        None => drop(volume.cubes.insert((side, origin))),
    }
}

/// A voxelised triangle soup. Lengths are in voxels: node (i, j, k) of the lattice is the point (i, j, k).
#[derive(Debug, Default)]
pub struct Volume {
    /// Blocks with nodes inside, by the lowest node.
    blocks: HashMap<[i32; 3], Inside>,
    /// Larger cubes that lie inside, by their side and lowest node.
    cubes: HashSet<(u32, [i32; 3])>,
}

impl Volume {
    /// Voxelises `triangles` over `points` (in voxels), with at most `threads` threads. OpenVDB computes distances up to
    /// `band` (in voxels, at least 1) from the surface, and finds the sign everywhere from these.
    ///
    /// # Errors
    /// `InvalidMesh` for what cannot be voxelised, `Cancelled` soon after `cancel` is set, `Internal`.
    pub fn build(
        points: &[[f32; 3]],
        triangles: &[[u32; 3]],
        band: f32,
        threads: u32,
        cancel: &Cancel,
    ) -> Result<Self> {
        let mut volume = Self::default();
        let mut message = [0 as c_char; 256];
        // SAFETY: the pointers and counts describe live slices, `cancel` and the volume outlive the call, and the shim
        // checks indices, writes a terminated message of at most the given size and throws nothing.
        let code = unsafe {
            bespoke_volume_build(
                points.as_ptr().cast(),
                points.len(),
                triangles.as_ptr().cast(),
                triangles.len(),
                band,
                threads,
                is_cancelled,
                ptr::from_ref(cancel).cast(),
                take_cube,
                (&raw mut volume).cast(),
                message.as_mut_ptr(),
                message.len(),
            )
        };
        if code == OK {
            return Ok(volume);
        }
        // SAFETY: zero-initialised, and the shim terminates what it writes.
        let text = unsafe { CStr::from_ptr(message.as_ptr()) }.to_string_lossy();
        Err(match code {
            CANCELLED => Error::new(ErrorKind::Cancelled, "cancelled while the avatar's distance field was built"),
            INVALID => Error::new(ErrorKind::InvalidMesh, format!("avatar: cannot be voxelised: {text}")),
            _ => Error::new(ErrorKind::Internal, format!("avatar: OpenVDB failed to voxelise it: {text}")),
        })
    }

    /// Which of the 8^3 nodes from `origin` on lie inside. Its coordinates are rounded down to multiples of 8.
    pub fn block(&self, origin: [i32; 3]) -> Inside {
        let below = |side: u32| origin.map(|o| o & !(side as i32 - 1));
        if let Some(inside) = self.blocks.get(&below(BLOCK as u32)) {
            return *inside;
        }
        let is_inside = SIDES.iter().any(|&side| self.cubes.contains(&(side, below(side))));
        if is_inside { [u64::MAX; BLOCK] } else { [0; BLOCK] }
    }

    /// Memory it holds, in bytes.
    pub fn memory(&self) -> u64 {
        // A byte of the table's for each entry.
        let block = size_of::<([i32; 3], Inside)>() + 1;
        let cube = size_of::<(u32, [i32; 3])>() + 1;
        (self.blocks.capacity() * block + self.cubes.capacity() * cube) as u64
    }
}
