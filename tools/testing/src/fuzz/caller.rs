//! A caller that checks after each call what has to hold then.

use std::ffi::CStr;

use bespoke::capi::control::{BespokeProgress, bespoke_session_read_progress};
use bespoke::capi::diagnostics::{
    BespokeDiagnostic, BespokeDiagnosticKind, BespokeSeverity, bespoke_session_read_diagnostics,
};
use bespoke::capi::options::{BespokeOptions, bespoke_session_set_options};
use bespoke::capi::results::{bespoke_session_read_avatar_vertices, bespoke_session_read_garment_vertices};
use bespoke::capi::running::BespokeStage;
use bespoke::capi::session::*;
use bespoke::capi::status::{BespokeStatus, bespoke_status_name};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

/// A session that checks itself, and is destroyed at the end.
pub struct Caller {
    pub session: *mut BespokeSession,
}

impl Caller {
    pub fn new() -> Self {
        let mut session = std::ptr::null_mut();
        // SAFETY: there is room for a pointer.
        known("create", unsafe { bespoke_session_create(&mut session) }, BespokeStatus::Ok);
        assert!(!session.is_null());
        Self { session }
    }

    /// The status of `call`, after a look at all that has to hold now.
    pub fn after(&self, call: &str, status: BespokeStatus) -> BespokeStatus {
        // SAFETY: the session is alive.
        unsafe { after(self.session, call, status) }
    }

    /// Where the session is.
    pub fn stage(&self) -> u32 {
        // SAFETY: the session is alive.
        unsafe { stage(self.session) }
    }

    /// The sentence of the last failure.
    pub fn message(&self) -> String {
        // SAFETY: the session is alive.
        unsafe { message(self.session) }
    }

    /// The garment's vertices in 32 or 64 bits. Empty in SETUP.
    pub fn garment(&self, is_double: bool) -> Vec<f64> {
        // SAFETY: the session is alive.
        unsafe { read(self.session, bespoke_session_read_garment_vertices, is_double) }
    }

    /// The first triangles of the parts of the avatar that are left out, as long as they are among the first findings.
    pub fn left_out(&self) -> Vec<u32> {
        // SAFETY: all fields are numbers, for which zero is a value.
        let mut list: [BespokeDiagnostic; 32] = unsafe { std::mem::zeroed() };
        list[0].struct_size = size_of::<BespokeDiagnostic>() as u32;
        let mut count = 0;
        // SAFETY: the session is alive, and there is room for as many as said.
        let status =
            unsafe { bespoke_session_read_diagnostics(self.session, list.as_mut_ptr(), list.len(), &mut count) };
        known("read_diagnostics", status, BespokeStatus::Ok);
        let is_foreign = |diagnostic: &&BespokeDiagnostic| diagnostic.kind == BespokeDiagnosticKind::ForeignPart as u32;
        list.iter().filter(is_foreign).map(|diagnostic| diagnostic.elements[0].index).collect()
    }

    /// Options under which a run takes milliseconds, and all triangles of the garment are kept off the body.
    pub fn set_options(&self, max_iterations: u32, voxel: f64, threads: u32) {
        let options = BespokeOptions { max_iterations, voxel_size: voxel, threads, keep_caps: 1, ..no_options() };
        // SAFETY: the session is alive and the struct as large as it says.
        let status = unsafe { bespoke_session_set_options(self.session, &options) };
        assert_eq!(self.after("set_options", status), BespokeStatus::Ok, "{}", self.message());
    }
}

impl Drop for Caller {
    fn drop(&mut self) {
        // SAFETY: the session is alive and nobody uses it any more.
        let status = unsafe { bespoke_session_destroy(self.session) };
        if !std::thread::panicking() {
            known("destroy", status, BespokeStatus::Ok);
        }
    }
}

/// Options that mean the defaults.
pub fn no_options() -> BespokeOptions {
    // SAFETY: all fields are numbers, for which zero is a value.
    let zero: BespokeOptions = unsafe { std::mem::zeroed() };
    BespokeOptions { struct_size: size_of::<BespokeOptions>() as u32, ..zero }
}

/// The status is one that the header knows, and this one.
pub fn known(call: &str, status: BespokeStatus, expected: BespokeStatus) {
    // SAFETY: the name is part of the library.
    let name = unsafe { CStr::from_ptr(bespoke_status_name(status as u32)) };
    assert_ne!(name, c"BESPOKE_STATUS_UNKNOWN", "{call}");
    assert_eq!(status, expected, "{call}");
}

/// Checks what has to hold after any call with `session`: the status is known and no defect, a failure has left a
/// sentence, and what can be read now can be read.
///
/// # Safety
/// `session` is null or alive, and no other thread uses it.
pub unsafe fn after(session: *const BespokeSession, call: &str, status: BespokeStatus) -> BespokeStatus {
    known(call, status, status);
    // SAFETY: passed on from the caller.
    unsafe {
        if session.is_null() {
            assert_ne!(status, BespokeStatus::Internal, "{call}");
            return status;
        }
        let text = message(session);
        assert_ne!(status, BespokeStatus::Internal, "{call}: {text}");
        assert_ne!(status, BespokeStatus::Busy, "{call} by the only thread there is");
        assert!(status == BespokeStatus::Ok || !text.is_empty(), "{call} failed without a sentence");
        let is_past_setup = stage(session) != BespokeStage::Setup as u32;
        for read_vertices in [bespoke_session_read_garment_vertices, bespoke_session_read_avatar_vertices] {
            let points = read(session, read_vertices, true);
            assert_eq!(!points.is_empty(), is_past_setup, "{call}: what was read does not fit the stage");
            assert!(points.iter().all(|x| x.is_finite()), "{call}: a coordinate that is not finite was read");
        }
        diagnostics(session);
    }
    status
}

/// What can be said of a session is well formed.
///
/// # Safety
/// `session` is alive.
unsafe fn diagnostics(session: *const BespokeSession) {
    // SAFETY: all fields are numbers, for which zero is a value.
    let mut list: [BespokeDiagnostic; 8] = unsafe { std::mem::zeroed() };
    list[0].struct_size = size_of::<BespokeDiagnostic>() as u32;
    let mut count = usize::MAX;
    // SAFETY: the session is alive, and there is room for as many as said.
    let status = unsafe { bespoke_session_read_diagnostics(session, list.as_mut_ptr(), list.len(), &mut count) };
    known("read_diagnostics", status, BespokeStatus::Ok);
    for (k, diagnostic) in list.iter().enumerate() {
        assert_eq!(diagnostic.kind != 0, k < count, "as many as there are, or as fit, are written");
        assert!(diagnostic.kind <= BespokeDiagnosticKind::TJunctions as u32);
        assert!(diagnostic.severity <= BespokeSeverity::Error as u32);
        let used = diagnostic.element_count as usize;
        assert!(used <= diagnostic.elements.len());
        for (k, element) in diagnostic.elements.iter().enumerate() {
            assert_eq!(element.subject != 0, k < used);
        }
        // SAFETY: the bytes of an array of characters.
        let sentence =
            unsafe { std::slice::from_raw_parts(diagnostic.message.as_ptr().cast(), diagnostic.message.len()) };
        let sentence = CStr::from_bytes_until_nul(sentence).expect("a zero byte ends a sentence");
        assert!(sentence.to_str().is_ok_and(|text| text.is_empty() == (k >= count)));
    }
}

/// # Safety
/// `session` is alive.
unsafe fn stage(session: *const BespokeSession) -> u32 {
    // SAFETY: all fields are numbers, for which zero is a value.
    let mut progress: BespokeProgress = unsafe { std::mem::zeroed() };
    progress.struct_size = size_of::<BespokeProgress>() as u32;
    // SAFETY: the session is alive and the struct as large as it says.
    known("read_progress", unsafe { bespoke_session_read_progress(session, &mut progress) }, BespokeStatus::Ok);
    assert!(progress.stage <= BespokeStage::Repose as u32);
    assert!((0.0..=1.0).contains(&progress.t) && progress.energy_count as usize <= progress.energies.len());
    progress.stage
}

/// The whole sentence, which is also right where it is cut.
///
/// # Safety
/// `session` is alive.
unsafe fn message(session: *const BespokeSession) -> String {
    let mut needed = 0;
    // SAFETY: the session is alive, and each buffer as large as said.
    unsafe {
        let status = bespoke_session_last_message(session, std::ptr::null_mut(), 0, &mut needed);
        known("last_message", status, BespokeStatus::Ok);
        let mut whole = vec![0xA5u8; needed];
        let status = bespoke_session_last_message(session, whole.as_mut_ptr().cast(), needed, std::ptr::null_mut());
        known("last_message", status, BespokeStatus::Ok);
        assert_eq!(whole.pop(), Some(0), "the sentence ends with a zero byte");
        assert!(!whole.contains(&0), "the sentence has a zero byte inside");
        let mut short = vec![0xA5u8; needed.div_ceil(2)];
        let status = bespoke_session_last_message(session, short.as_mut_ptr().cast(), short.len(), &mut needed);
        known("last_message", status, BespokeStatus::Ok);
        let cut = CStr::from_bytes_until_nul(&short).expect("a zero byte ends a sentence that is cut").to_bytes();
        assert!(std::str::from_utf8(cut).is_ok() && whole.starts_with(cut));
        String::from_utf8(whole).expect("the sentence is UTF-8")
    }
}

type ReadVertices = unsafe extern "C" fn(*const BespokeSession, *const BespokeBuffer, *mut usize) -> BespokeStatus;

/// All coordinates that `read_vertices` gives; none in SETUP, where it is refused.
///
/// # Safety
/// `session` is alive, and no other thread uses it.
unsafe fn read(session: *const BespokeSession, read_vertices: ReadVertices, is_double: bool) -> Vec<f64> {
    let component = if is_double { BespokeComponent::F64 } else { BespokeComponent::F32 } as u32;
    let mut count = usize::MAX;
    let nothing = BespokeBuffer { data: std::ptr::null_mut(), capacity: 0, stride: 0, component };
    // SAFETY: the session is alive, nothing is written but the count.
    let status = unsafe { read_vertices(session, &nothing, &mut count) };
    // SAFETY: the session is alive.
    if unsafe { stage(session) } == BespokeStage::Setup as u32 {
        known("read_vertices", status, BespokeStatus::InvalidState);
        return Vec::new();
    }
    if status == BespokeStatus::NotVerified {
        // SAFETY: the session is alive.
        assert_eq!(unsafe { stage(session) }, BespokeStage::Done as u32, "only a result can fail to be good");
        return vec![0.0];
    }
    known("read_vertices", status, BespokeStatus::Ok);
    let mut doubles = vec![0f64; if is_double { 3 * count } else { 0 }];
    let mut singles = vec![0f32; if is_double { 0 } else { 3 * count }];
    let data = if is_double { doubles.as_mut_ptr().cast() } else { singles.as_mut_ptr().cast() };
    let room = BespokeBuffer { data, capacity: count, stride: 0, component };
    // SAFETY: the session is alive, and there is room for `count` points.
    let status = unsafe { read_vertices(session, &room, std::ptr::null_mut()) };
    known("read_vertices", status, BespokeStatus::Ok);
    if !is_double {
        doubles = singles.iter().map(|&x| f64::from(x)).collect();
    }
    doubles
}
