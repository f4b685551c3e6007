//! A session of the library with an owner, and views of slices for it.

use std::ffi::{CStr, CString, c_void};
use std::ptr::{self, NonNull};

use crate::native::*;

/// A call that failed.
#[derive(Clone, Debug, Default)]
pub struct Failure {
    /// One of the library's statuses.
    pub status: u32,
    /// What, where, and what to do.
    pub message: String,
}

impl Failure {
    /// An argument that this add-on refuses before the library sees it.
    pub fn argument(message: impl Into<String>) -> Self {
        Self { status: BESPOKE_STATUS_INVALID_ARGUMENT, message: message.into() }
    }

    /// A mesh that this add-on refuses.
    pub fn mesh(message: impl Into<String>) -> Self {
        Self { status: BESPOKE_STATUS_INVALID_MESH, message: message.into() }
    }

    /// A skeleton that this add-on refuses.
    pub fn skeleton(message: impl Into<String>) -> Self {
        Self { status: BESPOKE_STATUS_INVALID_SKELETON, message: message.into() }
    }
}

/// What calls return here.
pub type Result<T> = std::result::Result<T, Failure>;

/// A number as the library takes it.
pub trait Component: Copy {
    /// One of BespokeComponent.
    const KIND: u32;
}

impl Component for f32 {
    const KIND: u32 = BESPOKE_COMPONENT_F32;
}

impl Component for u32 {
    const KIND: u32 = BESPOKE_COMPONENT_U32;
}

/// Rows of `N` numbers each.
pub fn view<T: Component, const N: usize>(rows: &[[T; N]]) -> BespokeView {
    BespokeView { data: rows.as_ptr().cast(), count: rows.len(), stride: 0, component: T::KIND }
}

/// `width` numbers to an element, packed.
fn wide<T: Component>(numbers: &[T], width: usize) -> BespokeView {
    BespokeView {
        data: numbers.as_ptr().cast(),
        count: numbers.len() / width.max(1),
        stride: size_of::<T>() * width,
        component: T::KIND,
    }
}

/// Where rows are written to.
pub fn buffer<const N: usize>(rows: &mut [[f32; N]]) -> BespokeBuffer {
    BespokeBuffer {
        data: rows.as_mut_ptr().cast::<c_void>(),
        capacity: rows.len(),
        stride: 0,
        component: BESPOKE_COMPONENT_F32,
    }
}

/// Skin weights, a few joints for each vertex.
#[derive(Clone, Debug, Default)]
pub struct Influences {
    /// How many joints a vertex has room for.
    pub width: usize,
    /// Joints, vertex after vertex.
    pub joints: Vec<u32>,
    /// Their weights.
    pub weights: Vec<f32>,
}

/// A joint of a rig.
#[derive(Clone, Debug)]
pub struct Joint {
    /// By which the library knows it.
    pub name: String,
    /// The joint that moves it.
    pub parent: Option<u32>,
    /// From its own space to that of the meshes, column after column.
    pub bind: [f64; BESPOKE_TRANSFORM_SIZE as usize],
}

/// A joint of the source and what corresponds to it.
#[derive(Clone, Debug)]
pub struct Mapped {
    /// The joint of the target.
    pub target: Option<u32>,
    /// One of BespokeJointReason.
    pub reason: u32,
    /// From 0, a guess, to 1.
    pub confidence: f64,
    /// Part of the body; empty where it is none.
    pub part: String,
}

/// Normals, and tangents with the handedness of the bitangent.
pub type Shading = (Vec<[f32; 3]>, Vec<[f32; 4]>);

/// A session of the library.
pub struct Session(NonNull<BespokeSession>);

// SAFETY: the library allows every call from every thread; two at once are refused with BUSY, and progress and cancel may be
// called at any time.
unsafe impl Send for Session {}
// SAFETY: as above.
unsafe impl Sync for Session {}

impl Drop for Session {
    fn drop(&mut self) {
        // SAFETY: it was made by the library and is destroyed once; nobody else holds it here.
        unsafe { bespoke_session_destroy(self.0.as_ptr()) };
    }
}

impl Session {
    /// An empty session.
    pub fn new() -> Result<Self> {
        // SAFETY: it takes nothing.
        let found = unsafe { bespoke_abi_version() };
        if found != BESPOKE_ABI_VERSION {
            return Err(Failure {
                status: BESPOKE_STATUS_INTERNAL,
                message: format!(
                    "the library beside the add-on has binary interface {found}, the add-on was built for \
                     {BESPOKE_ABI_VERSION}; take both from one folder"
                ),
            });
        }
        let mut session = ptr::null_mut();
        // SAFETY: the handle's place is valid.
        let status = unsafe { bespoke_session_create(&raw mut session) };
        NonNull::new(session).map(Self).ok_or(Failure { status, message: "no session could be made".into() })
    }

    fn pointer(&self) -> *mut BespokeSession {
        self.0.as_ptr()
    }

    fn check(&self, status: u32) -> Result<()> {
        if status == BESPOKE_STATUS_OK {
            return Ok(());
        }
        let message = if status == BESPOKE_STATUS_BUSY { "the session is busy".into() } else { self.message() };
        Err(Failure { status, message })
    }

    /// The message of the last call that failed.
    pub fn message(&self) -> String {
        let mut needed = 0;
        // SAFETY: null is allowed with no capacity.
        unsafe { bespoke_session_last_message(self.pointer(), ptr::null_mut(), 0, &raw mut needed) };
        let mut bytes = vec![0_u8; needed];
        // SAFETY: the buffer has the capacity that is told.
        unsafe { bespoke_session_last_message(self.pointer(), bytes.as_mut_ptr().cast(), needed, ptr::null_mut()) };
        text(&bytes)
    }

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

    /// Which joints correspond, one entry for each of the source.
    pub fn joint_map(&self) -> Result<Vec<Mapped>> {
        let mut count = 0;
        // SAFETY: null is allowed with no capacity.
        self.check(unsafe { bespoke_session_read_joint_map(self.pointer(), ptr::null_mut(), 0, &raw mut count) })?;
        let empty = BespokeMappedJoint { target: 0, reason: 0, confidence: 0.0, part: [0; _] };
        let mut found = vec![empty; count];
        // SAFETY: there is room for so many.
        self.check(unsafe {
            bespoke_session_read_joint_map(self.pointer(), found.as_mut_ptr(), count, ptr::null_mut())
        })?;
        let mapped = |one: &BespokeMappedJoint| Mapped {
            target: (one.target != BESPOKE_NO_JOINT).then_some(one.target),
            reason: one.reason,
            confidence: one.confidence,
            part: text(&one.part.map(|letter| letter as u8)),
        };
        Ok(found.iter().map(mapped).collect())
    }

    /// Runs it to its end.
    pub fn run(&self) -> Result<()> {
        // SAFETY: nothing but the handle goes in.
        self.check(unsafe { bespoke_session_run(self.pointer()) })
    }

    /// Asks it to stop; from any thread.
    pub fn cancel(&self) {
        // SAFETY: as above, at any time.
        unsafe { bespoke_session_cancel(self.pointer()) };
    }

    /// How far it is; from any thread.
    pub fn progress(&self) -> BespokeProgress {
        // SAFETY: all fields are numbers.
        let mut progress: BespokeProgress = unsafe { std::mem::zeroed() };
        progress.struct_size = size_of::<BespokeProgress>() as u32;
        // SAFETY: the struct has its size.
        unsafe { bespoke_session_read_progress(self.pointer(), &raw mut progress) };
        progress
    }

    /// What was measured.
    pub fn report(&self) -> Result<BespokeReport> {
        // SAFETY: all fields are numbers.
        let mut report: BespokeReport = unsafe { std::mem::zeroed() };
        report.struct_size = size_of::<BespokeReport>() as u32;
        // SAFETY: the struct has its size.
        self.check(unsafe { bespoke_session_read_report(self.pointer(), &raw mut report) })?;
        Ok(report)
    }

    /// What it has to say of inputs and result.
    pub fn diagnostics(&self) -> Vec<BespokeDiagnostic> {
        let mut count = 0;
        // SAFETY: null is allowed with no capacity.
        unsafe { bespoke_session_read_diagnostics(self.pointer(), ptr::null_mut(), 0, &raw mut count) };
        // SAFETY: all fields are numbers.
        let mut found = vec![unsafe { std::mem::zeroed::<BespokeDiagnostic>() }; count];
        // SAFETY: there is room for so many.
        let status =
            unsafe { bespoke_session_read_diagnostics(self.pointer(), found.as_mut_ptr(), count, ptr::null_mut()) };
        if status == BESPOKE_STATUS_OK { found } else { Vec::new() }
    }

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

fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "")).unwrap_or_default()
}

/// Up to the zero byte.
pub fn text(bytes: &[u8]) -> String {
    CStr::from_bytes_until_nul(bytes).map(|text| text.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The options as they are by default, written out.
pub fn default_options() -> BespokeOptions {
    // SAFETY: all fields are numbers.
    let mut options: BespokeOptions = unsafe { std::mem::zeroed() };
    options.struct_size = size_of::<BespokeOptions>() as u32;
    // SAFETY: the struct has its size.
    unsafe { bespoke_options_read_defaults(&raw mut options) };
    options
}

/// All zeros: every option by default.
pub fn unset_options() -> BespokeOptions {
    // SAFETY: all fields are numbers.
    let mut options: BespokeOptions = unsafe { std::mem::zeroed() };
    options.struct_size = size_of::<BespokeOptions>() as u32;
    options
}

/// The library's version.
pub fn version() -> String {
    // SAFETY: the text is part of the library.
    unsafe { CStr::from_ptr(bespoke_version_text()) }.to_string_lossy().into_owned()
}
