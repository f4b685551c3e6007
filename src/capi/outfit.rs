//! Garments that are worn together: in which order, and whether they pass through each other.

use crate::capi::inputs::mesh;
use crate::capi::list::List;
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::BespokeView;
use crate::geometry::outfit::WornPair;

/// Optional: a garment of an outfit as it was modelled, so that the order in which the outfit is worn can be read:
/// bespoke_session_read_outfit_order. Each call adds one; they are numbered from 0. All of the outfit is added, also what is
/// dressed in this session; none of it takes part in the run.
///
/// To dress an outfit: add its garments and read the order; then for each garment from the innermost outwards,
/// bespoke_session_reset, bespoke_session_set_garment, run, read the result, and add it as a layer with bespoke_session_add_layer.
///
/// `positions`: points in the coordinate system of the garment and the source avatar, F32 or F64. `triangles`: three vertices
/// each, U16 or U32. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE,
/// BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_outfit_garment(
    session: *mut BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let name = format!("outfit garment {}", session.outfit_size());
            session.add_outfit_garment(mesh(positions, triangles, &name)?.0)
        })
    }
}

/// Removes all garments of the outfit.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_outfit(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_outfit()) }
}

/// Writes the order in which the garments of the outfit are worn, from the innermost outwards, as their geometry tells: of two
/// garments the inner one is that of which more lies in the other, and where neither does, that which is nearer to the source
/// avatar, if one is set. Of garments that do not meet, the one that was added first comes first.
///
/// `order`: room for `capacity` numbers of garments; the first that fit are written. May be null where `capacity` is 0.
/// `*count`, unless null: garments of the outfit. State: any. Errors: INVALID_ARGUMENT (null with a capacity), CANCELLED (the
/// state does not change), NO_THREAD, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_outfit_order(
    session: *mut BespokeSession,
    order: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` numbers and for one more.
    unsafe {
        call(session, |session| {
            let list = List::new(order, capacity, count, "outfit order")?;
            let found = session.outfit_order()?;
            list.write(found.order.iter().copied());
            Ok(())
        })
    }
}

/// Of two garments of an outfit that meet, which is worn beneath the other.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeWornPair {
    /// The garment beneath, by its number.
    pub inner: u32,
    /// The garment above it.
    pub outer: u32,
    /// From 0, as much speaks for the other order, to 1, nothing does; at most 0.5 where neither encloses the other and the
    /// distance from the source avatar decides.
    pub confidence: f64,
    /// 1 where the order does not follow this pair, for with surer pairs it would have gone around in a circle, else 0.
    pub is_overruled: u32,
    /// Always 0.
    pub reserved: u32,
}

impl From<&WornPair> for BespokeWornPair {
    fn from(pair: &WornPair) -> Self {
        Self {
            inner: pair.inner,
            outer: pair.outer,
            confidence: pair.confidence,
            is_overruled: u32::from(pair.is_overruled),
            reserved: 0,
        }
    }
}

/// Writes what the order of bespoke_session_read_outfit_order is made of: the pairs of garments that meet, the surest first, so
/// that an editor can show where it is a guess.
///
/// `pairs`: room for `capacity` of them; the first that fit are written. May be null where `capacity` is 0. `*count`, unless
/// null: how many there are. All else as for bespoke_session_read_outfit_order.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_worn_pairs(
    session: *mut BespokeSession,
    pairs: *mut BespokeWornPair,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` pairs and for one number.
    unsafe {
        call(session, |session| {
            let list = List::new(pairs, capacity, count, "worn pairs")?;
            let found = session.outfit_order()?;
            list.write(found.pairs.iter().map(BespokeWornPair::from));
            Ok(())
        })
    }
}

/// Finds the pairs of triangles of two meshes that touch or cross each other, such as two garments that hang beside each other, or
/// those within one mesh; by the exact verifier. The inputs and the result of the session have no part in it.
///
/// `positions`, `triangles`: a mesh. `other_positions`, `other_triangles`: another one in the same coordinate system; both null:
/// pairs within the first. There, triangles that share a vertex count where they touch elsewhere too, and vertices in one place
/// with different indices are a contact. `pairs`: room for `capacity` pairs, two numbers each: the triangle of the first
/// mesh and that of the other, ascending; the first that fit are written. May be null where `capacity` is 0. `*count`, unless
/// null: how many there are. Ownership: copied during the call. State: any. Errors: INVALID_ARGUMENT (null with a capacity, one of
/// the second mesh null), INVALID_MESH, CANCELLED (the state does not change), NO_THREAD, BUSY, INTERNAL. Threads: any, one at a
/// time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_find_intersections(
    session: *const BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
    other_positions: *const BespokeView,
    other_triangles: *const BespokeView,
    pairs: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` pairs and for one number.
    unsafe {
        call(session, |session| {
            let list = List::new(pairs.cast::<[u32; 2]>(), capacity, count, "intersections")?;
            let (first, _) = mesh(positions, triangles, "first mesh")?;
            let other = match (other_positions.is_null(), other_triangles.is_null()) {
                (true, true) => None,
                _ => Some(mesh(other_positions, other_triangles, "second mesh")?.0),
            };
            let found = session.intersecting_pairs(first, other)?;
            list.write(found.into_iter());
            Ok(())
        })
    }
}
