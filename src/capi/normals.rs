//! Normals and tangents of a result.

use glam::DVec4;

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeBuffer, BespokeView, invalid};
use crate::input::buffer::{self, PositionsViewMut};
use crate::session::RenderMesh;

const TRIANGLES: &str = "triangles of the render vertices";
const NORMALS: &str = "garment normals";
const TANGENTS: &str = "garment tangents";

/// Writes unit normals of the garment as it is now, and tangents, for the vertices with which it is drawn: those of the design,
/// turned as the surface around them has turned. Vertices in one place whose normals agree in the design, as along a seam of
/// texture coordinates, are turned by all the triangles there and stay smooth; where they differ, the edge stays hard. Where the
/// garment moves rigidly, exactly the given normals come back, turned.
///
/// `triangles`: the garment's triangles in their order, three render vertices each, from 0, U16 or U32; null: the vertices of
/// bespoke_session_set_garment are those that are drawn. `normals`: those of the design, one for each render vertex, in the
/// garment's coordinate system, of any length, F32 or F64. Null: they follow from the triangles, and vertices in one place
/// are smooth where they differ by no more than 60 degrees. `tangents`: four numbers for each render vertex, x, y, z and the
/// handedness of the bitangent, as in glTF; null: none. `result_normals`: where to, three numbers a vertex, F32 or F64, in the
/// target's coordinate system. `result_tangents`: the same with four, perpendicular to the normals; the fourth number is the one
/// given, with the other sign where one coordinate system is the mirror image of the other. Null: none. With null data and
/// capacity 0 nothing is written. `*count`, unless null: render vertices, also where they do not fit. What is given as 0, and
/// without normals what no triangle uses, comes out as 0. Ownership: what is given is read during the call and not kept. State: PREPARED or later; until DONE it is that of a preview. Errors:
/// INVALID_ARGUMENT (a capacity that is too small, arrays of different length, other triangles than the garment's, a
/// number that is not finite, room for tangents without any given), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_garment_normals(
    session: *const BespokeSession,
    triangles: *const BespokeView,
    normals: *const BespokeView,
    tangents: *const BespokeView,
    result_normals: *const BespokeBuffer,
    result_tangents: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for one number.
    unsafe {
        call(session, |session| {
            let mut mesh = RenderMesh::default();
            if !triangles.is_null() {
                mesh.triangles = Some(buffer::read_triangles(&view::indices(triangles, TRIANGLES)?, TRIANGLES)?);
            }
            if !normals.is_null() {
                mesh.normals = Some(buffer::read_positions(&view::floats(normals, NORMALS)?, NORMALS)?);
            }
            if !tangents.is_null() {
                let numbers = buffer::read_rows(&view::floats(tangents, TANGENTS)?, 4, TANGENTS)?;
                mesh.tangents = Some(numbers.as_chunks().0.iter().map(|&t| DVec4::from_array(t)).collect());
            } else if !result_tangents.is_null() {
                return invalid(format!("{TANGENTS}: there is room for them, but none of the design are given"));
            }
            let (own_normals, own_tangents) = session.garment_normals(&mesh)?;
            if !count.is_null() {
                count.write(own_normals.len());
            }
            let normals_out = view::points_out(result_normals, NORMALS)?;
            let tangents_out = match result_tangents.is_null() {
                true => None,
                false => Some(view::points_out(result_tangents, TANGENTS)?),
            };
            let wanted = |out: &PositionsViewMut| !(out.capacity == 0 && out.data.is_null());
            // Nothing is written where one of the two does not fit.
            for (out, name) in [(Some(&normals_out), NORMALS), (tangents_out.as_ref(), TANGENTS)] {
                let Some(out) = out.filter(|out| wanted(out)) else { continue };
                if out.capacity < own_normals.len() || out.data.is_null() {
                    let found = if out.data.is_null() { "null" } else { "too small" };
                    return invalid(format!(
                        "{name}: the buffer, of capacity {}, is {found}: there are {} vertices",
                        out.capacity,
                        own_normals.len()
                    ));
                }
            }
            if wanted(&normals_out) {
                buffer::write_positions(&normals_out, &own_normals, NORMALS)?;
            }
            match tangents_out.filter(wanted) {
                Some(out) => buffer::write_quadruples(&out, &own_tangents, TANGENTS),
                None => Ok(()),
            }
        })
    }
}
