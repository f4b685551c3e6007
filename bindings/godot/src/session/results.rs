//! What comes out of a session.

use std::ptr;

use super::{Influences, Result, Session, Shading, buffer, view};
use crate::native::*;

impl Session {
    /// The garment's vertices.
    pub fn read_vertices(&self, vertices: usize) -> Result<Vec<[f32; 3]>> {
        let mut points = vec![[0.0; 3]; vertices];
        // SAFETY: the buffer is of a slice that lives through the call; so for all others here.
        self.check(unsafe {
            bespoke_session_read_garment_vertices(self.pointer(), &buffer(&mut points), ptr::null_mut())
        })?;
        Ok(points)
    }

    /// Normals of the result and, where there are some of the design, tangents.
    pub fn read_normals(&self, normals: &[[f32; 3]], tangents: &[[f32; 4]]) -> Result<Shading> {
        let mut turned = vec![[0.0; 3]; normals.len()];
        let mut turned_tangents = vec![[0.0; 4]; tangents.len()];
        let (given, given_tangents) = (view(normals), view(tangents));
        let into = buffer(&mut turned);
        let into_tangents = buffer(&mut turned_tangents);
        let has_tangents = !tangents.is_empty();
        // SAFETY: as above.
        self.check(unsafe {
            bespoke_session_read_garment_normals(
                self.pointer(),
                ptr::null(),
                &raw const given,
                if has_tangents { &raw const given_tangents } else { ptr::null() },
                &raw const into,
                if has_tangents { &raw const into_tangents } else { ptr::null() },
                ptr::null_mut(),
            )
        })?;
        Ok((turned, turned_tangents))
    }

    /// Offsets of a morph of the garment in the result.
    pub fn read_morph(&self, morph: usize, vertices: usize) -> Result<Vec<[f32; 3]>> {
        let mut offsets = vec![[0.0; 3]; vertices];
        // SAFETY: as above.
        self.check(unsafe {
            bespoke_session_read_garment_morph(self.pointer(), morph as u32, &buffer(&mut offsets), ptr::null_mut())
        })?;
        Ok(offsets)
    }

    /// Skin weights of the result.
    pub fn read_influences(&self, width: usize, vertices: usize) -> Result<Influences> {
        let mut skin = Influences { width, joints: vec![0; vertices * width], weights: vec![0.0; vertices * width] };
        // SAFETY: there is room for so many.
        self.check(unsafe {
            bespoke_session_read_garment_skin_influences(
                self.pointer(),
                width,
                skin.joints.as_mut_ptr(),
                skin.weights.as_mut_ptr(),
                vertices,
                ptr::null_mut(),
            )
        })?;
        Ok(skin)
    }

    /// Finds what the garment answers to the morphs of the body with.
    pub fn solve_target_morphs(&self) -> Result<()> {
        // SAFETY: nothing but the handle goes in.
        self.check(unsafe { bespoke_session_solve_target_morphs(self.pointer()) })
    }

    /// The garment's answer to a morph of the body; none where it has none, which a finding tells.
    pub fn read_target_morph(&self, morph: usize, vertices: usize) -> Option<Vec<[f32; 3]>> {
        let mut offsets = vec![[0.0; 3]; vertices];
        // SAFETY: as above.
        let status = unsafe {
            bespoke_session_read_target_morph(self.pointer(), morph as u32, &buffer(&mut offsets), ptr::null_mut())
        };
        (status == BESPOKE_STATUS_OK).then_some(offsets)
    }

    /// Vertices of a follower.
    pub fn read_follower(&self, follower: usize, vertices: usize) -> Result<Vec<[f32; 3]>> {
        let mut points = vec![[0.0; 3]; vertices];
        // SAFETY: as above.
        self.check(unsafe {
            bespoke_session_read_follower_vertices(
                self.pointer(),
                follower as u32,
                &buffer(&mut points),
                ptr::null_mut(),
            )
        })?;
        Ok(points)
    }

    /// Skin weights of a follower.
    pub fn read_follower_influences(&self, follower: usize, width: usize, vertices: usize) -> Result<Influences> {
        let mut skin = Influences { width, joints: vec![0; vertices * width], weights: vec![0.0; vertices * width] };
        // SAFETY: there is room for so many.
        self.check(unsafe {
            bespoke_session_read_follower_skin_influences(
                self.pointer(),
                follower as u32,
                width,
                skin.joints.as_mut_ptr(),
                skin.weights.as_mut_ptr(),
                vertices,
                ptr::null_mut(),
            )
        })?;
        Ok(skin)
    }

    /// Joints of the garment's own that come along.
    pub fn read_added_joints(&self) -> Result<Vec<BespokeAddedJoint>> {
        let mut count = 0;
        // SAFETY: null is allowed with no capacity.
        self.check(unsafe { bespoke_session_read_added_joints(self.pointer(), ptr::null_mut(), 0, &raw mut count) })?;
        let mut joints = vec![BespokeAddedJoint { source: 0, parent: 0, bind: [0.0; _] }; count];
        // SAFETY: there is room for so many.
        self.check(unsafe {
            bespoke_session_read_added_joints(self.pointer(), joints.as_mut_ptr(), count, ptr::null_mut())
        })?;
        Ok(joints)
    }

    /// Whether the result is in the body's own pose.
    pub fn is_in_own_pose(&self, joints: usize) -> bool {
        let mut transforms = vec![0.0; joints * BESPOKE_TRANSFORM_SIZE as usize];
        // SAFETY: there is room for so many.
        let status = unsafe {
            bespoke_session_read_pose_transforms(self.pointer(), transforms.as_mut_ptr(), joints, ptr::null_mut())
        };
        let is_identity = |(k, number): (usize, &f64)| *number == if k % 16 % 5 == 0 { 1.0 } else { 0.0 };
        status == BESPOKE_STATUS_OK && transforms.iter().enumerate().all(is_identity)
    }

    /// Triangles of the body that the garment hides.
    pub fn read_covered(&self, margin: u32, openness: f64, triangles: usize) -> Result<Vec<u32>> {
        let mut found = vec![0; triangles];
        let mut count = 0;
        // SAFETY: there is room for so many.
        self.check(unsafe {
            bespoke_session_read_covered_triangles(
                self.pointer(),
                BESPOKE_NO_LAYER,
                margin,
                openness,
                found.as_mut_ptr(),
                triangles,
                &raw mut count,
            )
        })?;
        found.truncate(count);
        Ok(found)
    }
}
