//! A session of the library with an owner, and views of slices for it.

mod inputs;
mod results;

use std::ffi::{CStr, CString, c_void};
use std::ptr::{self, NonNull};
use std::sync::atomic::{AtomicBool, Ordering};

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
pub struct Session {
    handle: NonNull<BespokeSession>,
    /// Whether it has a result, and looks for answers to blend shapes of the body.
    answers: AtomicBool,
}

// SAFETY: the library allows every call from every thread; two at once are refused with BUSY, and progress and cancel may be
// called at any time.
unsafe impl Send for Session {}
// SAFETY: as above.
unsafe impl Sync for Session {}

impl Drop for Session {
    fn drop(&mut self) {
        // SAFETY: it was made by the library and is destroyed once; nobody else holds it here.
        unsafe { bespoke_session_destroy(self.pointer()) };
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
        let handle = NonNull::new(session).ok_or(Failure { status, message: "no session could be made".into() })?;
        Ok(Self { handle, answers: AtomicBool::new(false) })
    }

    fn pointer(&self) -> *mut BespokeSession {
        self.handle.as_ptr()
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

    /// From here on it looks for answers: its stages begin anew.
    pub fn begin_answers(&self) {
        self.answers.store(true, Ordering::Relaxed);
    }

    /// Whether it looks for answers.
    pub fn has_begun_answers(&self) -> bool {
        self.answers.load(Ordering::Relaxed)
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
        if let Some(first) = found.first_mut() {
            first.struct_size = size_of::<BespokeDiagnostic>() as u32;
        }
        // SAFETY: there is room for so many, each as large as the first says.
        let status =
            unsafe { bespoke_session_read_diagnostics(self.pointer(), found.as_mut_ptr(), count, ptr::null_mut()) };
        if status == BESPOKE_STATUS_OK { found } else { Vec::new() }
    }
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
