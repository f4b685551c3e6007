//! The only file that calls the C++ shim: a triangle soup voxelised by OpenVDB, for the sign of the distance.

use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr::{self, NonNull};

use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};

/// Nodes along one side of a block.
pub const BLOCK: usize = 8;

/// Nodes in a block.
pub const BLOCK_NODES: usize = BLOCK * BLOCK * BLOCK;

const OK: c_int = 0;
const CANCELLED: c_int = 1;
const INVALID: c_int = 3;

#[repr(C)]
struct Opaque {
    _private: [u8; 0],
}

unsafe extern "C" {
    fn bespoke_volume_build(
        points: *const f32,
        point_count: usize,
        triangles: *const u32,
        triangle_count: usize,
        outside_band: f32,
        inside_band: f32,
        threads: u32,
        cancelled: extern "C" fn(*const c_void) -> c_int,
        context: *const c_void,
        volume: *mut *mut Opaque,
        message: *mut c_char,
        message_capacity: usize,
    ) -> c_int;
    fn bespoke_volume_read_block(volume: *const Opaque, origin: *const i32, values: *mut f32);
    fn bespoke_volume_memory(volume: *const Opaque) -> u64;
    fn bespoke_volume_destroy(volume: *mut Opaque);
}

extern "C" fn is_cancelled(context: *const c_void) -> c_int {
    // SAFETY: `build` passes a token that outlives the call, and it may be read from any thread.
    let cancel = unsafe { &*context.cast::<Cancel>() };
    c_int::from(cancel.is_requested())
}

/// A voxelised triangle soup. Lengths are in voxels: node (i, j, k) of the lattice is the point (i, j, k).
#[derive(Debug)]
pub struct Volume(NonNull<Opaque>);

// SAFETY: the volume is not tied to the thread that built it.
unsafe impl Send for Volume {}
// SAFETY: after `build` the grid is only read, and OpenVDB's trees may be read from several threads.
unsafe impl Sync for Volume {}

impl Volume {
    /// Voxelises `triangles` over `points` (in voxels), keeping distances up to `bands` (outside, inside; in
    /// voxels, at least 1), with at most `threads` threads.
    ///
    /// # Errors
    /// `InvalidMesh` for what cannot be voxelised, `Cancelled` soon after `cancel` is set, `Internal`.
    pub fn build(
        points: &[[f32; 3]],
        triangles: &[[u32; 3]],
        bands: [f32; 2],
        threads: u32,
        cancel: &Cancel,
    ) -> Result<Self> {
        let mut volume = ptr::null_mut();
        let mut message = [0 as c_char; 256];
        // SAFETY: the pointers and counts describe live slices, `cancel` outlives the call, and the shim
        // checks indices, writes a terminated message of at most the given size and throws nothing.
        let code = unsafe {
            bespoke_volume_build(
                points.as_ptr().cast(),
                points.len(),
                triangles.as_ptr().cast(),
                triangles.len(),
                bands[0],
                bands[1],
                threads,
                is_cancelled,
                ptr::from_ref(cancel).cast(),
                &mut volume,
                message.as_mut_ptr(),
                message.len(),
            )
        };
        if let (OK, Some(volume)) = (code, NonNull::new(volume)) {
            return Ok(Self(volume));
        }
        // SAFETY: zero-initialised, and the shim terminates what it writes.
        let text = unsafe { CStr::from_ptr(message.as_ptr()) }.to_string_lossy();
        Err(match code {
            CANCELLED => Error::new(ErrorKind::Cancelled, "cancelled while the avatar's distance field was built"),
            INVALID => Error::new(ErrorKind::InvalidMesh, format!("avatar: cannot be voxelised: {text}")),
            _ => Error::new(ErrorKind::Internal, format!("avatar: OpenVDB failed to voxelise it: {text}")),
        })
    }

    /// Distances (in voxels, negative inside, cut off at the bands) at the 8^3 nodes from `origin` on, each of
    /// whose coordinates is rounded down to a multiple of 8. Node (i, j, k) of the block is entry
    /// 64 i + 8 j + k.
    pub fn read_block(&self, origin: [i32; 3]) -> [f32; BLOCK_NODES] {
        let mut values = [0.0; BLOCK_NODES];
        let origin = origin.map(|o| o & !(BLOCK as i32 - 1));
        // SAFETY: a live volume, and an array of the size that the shim writes.
        unsafe { bespoke_volume_read_block(self.0.as_ptr(), origin.as_ptr(), values.as_mut_ptr()) };
        values
    }

    /// Memory it holds, in bytes.
    pub fn memory(&self) -> u64 {
        // SAFETY: a live volume.
        unsafe { bespoke_volume_memory(self.0.as_ptr()) }
    }
}

impl Drop for Volume {
    fn drop(&mut self) {
        // SAFETY: the only owner, and it is not used afterwards.
        unsafe { bespoke_volume_destroy(self.0.as_ptr()) }
    }
}
