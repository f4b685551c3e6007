//! A caller of the C API: a session that destroys itself, views of slices, and a small garment with all it needs.

use std::ffi::c_void;

use bespoke::capi::inputs::*;
use bespoke::capi::options::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeComponent, BespokeView};

/// A packed view of a slice of elements.
pub fn view<T>(elements: &[T], component: BespokeComponent) -> BespokeView {
    let data = elements.as_ptr().cast::<c_void>();
    BespokeView { data, count: elements.len(), stride: 0, component: component as u32 }
}

/// Packed points of three 32-bit floats.
pub fn points(elements: &[[f32; 3]]) -> BespokeView {
    view(elements, BespokeComponent::F32)
}

/// Packed triangles of three 32-bit indices.
pub fn triangles(elements: &[[u32; 3]]) -> BespokeView {
    view(elements, BespokeComponent::U32)
}

/// Packed bones of two 32-bit indices.
pub fn bones(elements: &[[u32; 2]]) -> BespokeView {
    view(elements, BespokeComponent::U32)
}

/// Options that mean the defaults.
pub fn no_options() -> BespokeOptions {
    // SAFETY: all fields are numbers, for which zero is a value.
    let zero: BespokeOptions = unsafe { std::mem::zeroed() };
    BespokeOptions { struct_size: size_of::<BespokeOptions>() as u32, ..zero }
}

/// A session of one test.
pub struct Caller {
    /// Alive as long as this is.
    pub session: *mut BespokeSession,
}

impl Default for Caller {
    fn default() -> Self {
        Self::new()
    }
}

impl Caller {
    /// A session without inputs.
    pub fn new() -> Self {
        let mut session = std::ptr::null_mut();
        // SAFETY: the pointer is good.
        assert_eq!(unsafe { bespoke_session_create(&mut session) }, BespokeStatus::Ok);
        assert!(!session.is_null());
        Self { session }
    }

    /// The sentence of the last failure.
    pub fn message(&self) -> String {
        let mut needed = 0;
        // SAFETY: the session is alive, the buffer as large as said.
        unsafe {
            assert_eq!(
                bespoke_session_last_message(self.session, std::ptr::null_mut(), 0, &mut needed),
                BespokeStatus::Ok
            );
            let mut text = vec![0u8; needed];
            let buffer = text.as_mut_ptr().cast();
            assert_eq!(
                bespoke_session_last_message(self.session, buffer, needed, std::ptr::null_mut()),
                BespokeStatus::Ok
            );
            assert_eq!(text.pop(), Some(0), "the sentence ends with a zero byte");
            String::from_utf8(text).expect("the sentence is UTF-8")
        }
    }

    /// The call was refused with this status and a sentence that holds these words.
    #[track_caller]
    pub fn refused(&self, got: BespokeStatus, expected: BespokeStatus, words: &[&str]) {
        let message = self.message();
        assert_eq!(got, expected, "{message}");
        for word in words {
            assert!(message.contains(word), "the sentence \"{message}\" does not hold \"{word}\"");
        }
    }

    /// The call was good; else this panics with its sentence.
    #[track_caller]
    pub fn accepted(&self, got: BespokeStatus) {
        assert_eq!(got, BespokeStatus::Ok, "{}", self.message());
    }

    /// `bespoke_session_set_garment`.
    pub fn set_garment(&self, positions: &BespokeView, triangles: &BespokeView) -> BespokeStatus {
        // SAFETY: the session is alive and the views tell the truth.
        unsafe { bespoke_session_set_garment(self.session, positions, triangles) }
    }

    /// `bespoke_session_set_target_avatar`.
    pub fn set_avatar(&self, positions: &BespokeView, triangles: &BespokeView) -> BespokeStatus {
        // SAFETY: the session is alive and the views tell the truth.
        unsafe { bespoke_session_set_target_avatar(self.session, positions, triangles) }
    }

    /// `bespoke_session_set_source_skeleton`.
    pub fn set_source_skeleton(&self, joints: &BespokeView, bones: &BespokeView) -> BespokeStatus {
        // SAFETY: the session is alive and the views tell the truth.
        unsafe { bespoke_session_set_source_skeleton(self.session, joints, bones) }
    }

    /// `bespoke_session_set_target_skeleton`.
    pub fn set_target_skeleton(&self, joints: &BespokeView, bones: &BespokeView) -> BespokeStatus {
        // SAFETY: the session is alive and the views tell the truth.
        unsafe { bespoke_session_set_target_skeleton(self.session, joints, bones) }
    }

    /// Sets all that has to be set.
    pub fn set_sample(&self, sample: &Sample) {
        self.accepted(self.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1)));
        self.accepted(self.set_avatar(&points(&sample.avatar.0), &triangles(&sample.avatar.1)));
        self.accepted(self.set_source_skeleton(&points(&sample.source_joints), &bones(&sample.bones)));
        self.accepted(self.set_target_skeleton(&points(&sample.target_joints), &bones(&sample.bones)));
    }

    /// A session with all that has to be set.
    pub fn with_sample() -> (Self, Sample) {
        let (caller, sample) = (Self::new(), Sample::new());
        caller.set_sample(&sample);
        (caller, sample)
    }
}

impl Drop for Caller {
    fn drop(&mut self) {
        // SAFETY: the session is alive and nobody uses it any more.
        assert_eq!(unsafe { bespoke_session_destroy(self.session) }, BespokeStatus::Ok);
    }
}

/// Vertices and triangles.
pub type Mesh = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// A tube for a garment, and a slimmer, longer tube to put it on.
pub struct Sample {
    /// Around the middle of the source skeleton.
    pub garment: Mesh,
    /// Around the target skeleton.
    pub avatar: Mesh,
    /// Three joints on the y axis.
    pub source_joints: [[f32; 3]; 3],
    /// The same, a little farther apart.
    pub target_joints: [[f32; 3]; 3],
    /// Of both skeletons.
    pub bones: [[u32; 2]; 2],
}

impl Default for Sample {
    fn default() -> Self {
        Self::new()
    }
}

impl Sample {
    /// The same every time.
    pub fn new() -> Self {
        Self {
            garment: tube(0.3, -0.55, 0.55, 16, 9),
            avatar: tube(0.2, -0.9, 0.9, 14, 15),
            source_joints: [[0.0, -1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            target_joints: [[0.0, -1.1, 0.0], [0.0, 0.0, 0.0], [0.0, 1.1, 0.0]],
            bones: [[0, 1], [1, 2]],
        }
    }
}

/// An open tube around the y axis.
pub fn tube(radius: f32, bottom: f32, top: f32, around: u32, rings: u32) -> Mesh {
    let positions = (0..rings * around).map(|k| {
        let angle = (k % around) as f32 / around as f32 * std::f32::consts::TAU;
        let y = bottom + (top - bottom) * (k / around) as f32 / (rings - 1) as f32;
        [radius * angle.sin(), y, radius * angle.cos()]
    });
    let triangles = (0..(rings - 1) * around).flat_map(|k| {
        let (ring, here, next) = (k / around * around, k % around, (k + 1) % around);
        let [a, b, c, d] = [ring + here, ring + next, ring + around + here, ring + around + next];
        [[a, b, d], [a, d, c]]
    });
    (positions.collect(), triangles.collect())
}
