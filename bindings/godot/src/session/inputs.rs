//! What goes into a session.

use std::ffi::CString;
use std::ptr;

use super::{Influences, Joint, Result, Session, c_text, view, wide};
use crate::native::*;

impl Session {
    /// Sets the garment.
    pub fn set_garment(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
        // SAFETY: the views are of slices that live through the call; so for all others here.
        self.check(unsafe { bespoke_session_set_garment(self.pointer(), &view(positions), &view(triangles)) })
    }

    /// Sets the body that the garment was made for.
    pub fn set_source_avatar(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_set_source_avatar(self.pointer(), &view(positions), &view(triangles)) })
    }

    /// Sets the body to dress.
    pub fn set_target_avatar(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_set_target_avatar(self.pointer(), &view(positions), &view(triangles)) })
    }

    /// Sets what each triangle of the body to dress is to the garment.
    pub fn set_avatar_parts(&self, roles: &[u32]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_set_avatar_parts(self.pointer(), &wide(roles, 1)) })
    }

    /// Adds what the body wears already.
    pub fn add_layer(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_add_layer(self.pointer(), &view(positions), &view(triangles)) })
    }

    /// Sets the joints of the garment's side.
    pub fn set_source_rig(&self, joints: &[Joint]) -> Result<()> {
        let (_names, rows) = rows(joints);
        // SAFETY: names and rows live through the call.
        self.check(unsafe { bespoke_session_set_source_rig(self.pointer(), rows.as_ptr(), rows.len()) })
    }

    /// Sets the joints of the body to dress.
    pub fn set_target_rig(&self, joints: &[Joint]) -> Result<()> {
        let (_names, rows) = rows(joints);
        // SAFETY: names and rows live through the call.
        self.check(unsafe { bespoke_session_set_target_rig(self.pointer(), rows.as_ptr(), rows.len()) })
    }

    /// Sets skin weights by one of the library's three functions for them.
    pub fn set_influences(&self, which: SetInfluences, skin: &Influences, joints: usize) -> Result<()> {
        let (indices, weights) = (wide(&skin.joints, skin.width), wide(&skin.weights, skin.width));
        // SAFETY: as above.
        self.check(unsafe { which(self.pointer(), &raw const indices, &raw const weights, skin.width, joints) })
    }

    /// Sets joints that correspond.
    pub fn set_joint_pairs(&self, pairs: &[[u32; 2]]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_set_joint_pairs(self.pointer(), &view(pairs)) })
    }

    /// Adds a morph of the garment.
    pub fn add_garment_morph(&self, name: &str, offsets: &[[f32; 3]]) -> Result<()> {
        let name = c_text(name);
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_add_garment_morph(self.pointer(), name.as_ptr(), &view(offsets)) })
    }

    /// Adds a morph of the body to dress, which the garment is to answer.
    pub fn add_target_morph(&self, name: &str, offsets: &[[f32; 3]]) -> Result<()> {
        let name = c_text(name);
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_add_target_morph(self.pointer(), name.as_ptr(), &view(offsets)) })
    }

    /// Sets how strongly each vertex of the garment is drawn to the body.
    pub fn set_vertex_fit_weights(&self, weights: &[f32]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_set_vertex_fit_weights(self.pointer(), &wide(weights, 1)) })
    }

    /// Sets vertices of the garment that are held, at these places or where they are on the nearest bone.
    pub fn set_pins(&self, vertices: &[u32], targets: Option<&[[f32; 3]]>) -> Result<()> {
        let targets = targets.map(view);
        let targets = targets.as_ref().map_or(ptr::null(), ptr::from_ref);
        // SAFETY: as above; null is allowed.
        self.check(unsafe { bespoke_session_set_pinned_vertices(self.pointer(), &wide(vertices, 1), targets) })
    }

    /// Adds vertices of the garment that stay one rigid body.
    pub fn add_rigid_group(&self, vertices: &[u32]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_add_rigid_group(self.pointer(), &wide(vertices, 1)) })
    }

    /// Adds a mesh that goes along with the garment.
    pub fn add_follower(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_add_follower(self.pointer(), &view(positions), &view(triangles)) })
    }

    /// Sets both coordinate systems to Godot's. What belongs to one skeleton is in one unit and has one set of axes; which way
    /// the body to dress faces is not said by that.
    pub fn set_godot_space(&self) -> Result<()> {
        let mut space = BespokeCoordinateSystem {
            struct_size: size_of::<BespokeCoordinateSystem>() as u32,
            right: 0,
            up: 0,
            forward: 0,
            metres_per_unit: 0.0,
            winding: BESPOKE_WINDING_CLOCKWISE,
            trusted: 1,
        };
        // SAFETY: the struct lives through the call.
        self.check(unsafe { bespoke_session_set_source_coordinate_system(self.pointer(), &raw const space) })?;
        space.trusted = 0;
        // SAFETY: as above.
        self.check(unsafe { bespoke_session_set_target_coordinate_system(self.pointer(), &raw const space) })
    }

    /// Sets all options.
    pub fn set_options(&self, options: &BespokeOptions) -> Result<()> {
        // SAFETY: the struct lives through the call and has its size.
        self.check(unsafe { bespoke_session_set_options(self.pointer(), options) })
    }
}

/// One of the library's functions for skin weights.
pub type SetInfluences =
    unsafe extern "C" fn(*mut BespokeSession, *const BespokeView, *const BespokeView, usize, usize) -> u32;

/// Joints as the library takes them, and the names that they point to.
fn rows(joints: &[Joint]) -> (Vec<CString>, Vec<BespokeJoint>) {
    let names: Vec<CString> = joints.iter().map(|joint| c_text(&joint.name)).collect();
    let row = |(joint, name): (&Joint, &CString)| BespokeJoint {
        name: name.as_ptr(),
        parent: joint.parent.unwrap_or(BESPOKE_NO_JOINT),
        reserved: 0,
        bind: joint.bind,
    };
    let rows = joints.iter().zip(&names).map(row).collect();
    (names, rows)
}
