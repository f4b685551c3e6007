//! What the parts of the avatar are to the garment.

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeView, invalid};
use crate::input::buffer;
use crate::session::PartRole;

/// What a triangle of the avatar is to the garment.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokePartRole {
    /// Body, unless its connected piece is recognised as no part of the body, such as a floor or a dome: then it is
    /// ignored, and a diagnostic says so. The default.
    Automatic = 0,
    /// Body: the garment is fitted to it and does not pass through it. It is left out in no case.
    Body = 1,
    /// The garment does not pass through it, but is not drawn to it, such as hair that hangs over a coat.
    Collision = 2,
    /// It takes no part: the garment may pass through it, and it is not verified.
    Ignored = 3,
}

const ROLES: &str = "avatar parts";

/// Optional: what each triangle of the avatar is to the garment. Without it, or with BESPOKE_PART_ROLE_AUTOMATIC, the library
/// leaves out pieces that are no part of the body, with a diagnostic, and takes all else for body. With the option strict
/// it leaves nothing out.
///
/// `roles`: one BespokePartRole for each triangle of the avatar, U16 or U32; null takes all roles back. Whatever their
/// role, vertices keep their numbers, and BespokeReport counts the triangles that take part. Ownership: copied during
/// the call. State: SETUP; they stay with another avatar and after bespoke_session_reset. Errors: INVALID_ARGUMENT (no
/// role has that number; another count than the avatar's may be found only by bespoke_session_prepare, as may
/// INVALID_MESH where no body is left), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_avatar_parts(
    session: *mut BespokeSession,
    roles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            if roles.is_null() {
                return session.clear_avatar_parts();
            }
            let numbers = buffer::read_indices(&view::indices(roles, ROLES)?, 1, ROLES)?;
            let mut parsed = Vec::with_capacity(numbers.len());
            for (triangle, number) in numbers.into_iter().enumerate() {
                parsed.push(match number {
                    0 => PartRole::Automatic,
                    1 => PartRole::Body,
                    2 => PartRole::Collision,
                    3 => PartRole::Ignored,
                    _ => {
                        return invalid(format!(
                            "avatar parts: triangle {triangle} has role {number}; roles go from 0 to 3"
                        ));
                    }
                });
            }
            session.set_avatar_parts(parsed)
        })
    }
}
