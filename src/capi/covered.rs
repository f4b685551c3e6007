//! Which triangles of the body the result covers.

use crate::capi::list::List;
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::session::CoveredOptions;

/// What is asked about is no layer but the avatar itself.
pub const BESPOKE_NO_LAYER: u32 = 0xFFFF_FFFF;

/// Writes the triangles of the avatar, or of a layer, that the garment covers: from outside nobody sees them in the pose that the
/// result is in, so that a game may leave them out while the garment is worn. It does not count as covering that a part of the
/// body beyond the garment is in the way, such as a hand before a sleeve.
///
/// `layer`: BESPOKE_NO_LAYER for the avatar, or a layer, numbered from 0; of a layer both sides have to be covered. `margin`: so
/// many rings of triangles are left beside those that are not covered; 1 is for games, 0 is for nothing that moves. `openness`:
/// the share of directions, from 0 to 1, in which a covered triangle may be seen all the same: 0 is for all, more for what
/// nobody looks at, as from the floor into a skirt (0.2). `triangles`: room for `capacity` triangles, which are written
/// ascending, as they were numbered when they were set; the first that fit. May be null where `capacity` is 0. `*count`, unless
/// null: how many there are. State: DONE. Errors: INVALID_ARGUMENT (null with a capacity, no such layer, an openness that is no
/// share), INVALID_STATE, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_covered_triangles(
    session: *const BespokeSession,
    layer: u32,
    margin: u32,
    openness: f64,
    triangles: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` numbers and for one more.
    unsafe {
        call(session, |session| {
            let list = List::new(triangles, capacity, count, "covered triangles")?;
            let layer = (layer != BESPOKE_NO_LAYER).then_some(layer as usize);
            let covered = session.covered_triangles(layer, &CoveredOptions { margin, openness })?;
            list.write(covered.iter().copied());
            Ok(())
        })
    }
}
