//! Programs of calls with up to three sessions and controls.

use std::ptr::{null, null_mut};

use bespoke::capi::control::*;
use bespoke::capi::coordinate_system::*;
use bespoke::capi::fit::*;
use bespoke::capi::inputs::*;
use bespoke::capi::layers::*;
use bespoke::capi::options::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::shared::*;
use bespoke::capi::status::{BespokeStatus, bespoke_status_name};
use bespoke::capi::version::{BESPOKE_ABI_VERSION, bespoke_abi_version};
use bespoke::capi::view::{BespokeBuffer, BespokeView};

use super::array::Array;
use super::caller::{after, known, no_options};
use super::follow;
use super::rigs;
use super::shape::{Shape, bones, joints};
use super::source::Source;

/// Calls of one program at most.
const MOST_CALLS: usize = 96;
/// Calls that compute at most: they take nearly all of the time.
const MOST_WORK: usize = 12;
const JOINTS: usize = 3;

/// What a program holds.
struct Program {
    /// Null where there is none: calls are made all the same.
    sessions: [*mut BespokeSession; 3],
    controls: [*mut BespokeControl; 3],
    avatar: *mut BespokeAvatar,
    garment: *mut BespokeGarment,
    work: usize,
}

pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let mut program = Program {
        sessions: [null_mut(); 3],
        controls: [null_mut(); 3],
        avatar: null_mut(),
        garment: null_mut(),
        work: 0,
    };
    for _ in 0..MOST_CALLS {
        if source.is_empty() {
            break;
        }
        program.call(&mut source);
    }
    // Controls outlive their sessions in some programs, and go first in others.
    let controls_first = program.work.is_multiple_of(2);
    if controls_first {
        program.destroy_controls();
    }
    // So do avatars and garments.
    if controls_first {
        program.destroy_shared();
    }
    (0..3).for_each(|k| program.destroy_session(k));
    program.destroy_controls();
    program.destroy_shared();
}

/// A session's address, to hand to another thread.
#[derive(Clone, Copy)]
struct Shared(*mut BespokeSession);
// SAFETY: the functions that are called with it say that any thread may.
unsafe impl Send for Shared {}

impl Shared {
    fn session(self) -> *mut BespokeSession {
        self.0
    }
}

type SetPair = unsafe extern "C" fn(*mut BespokeSession, *const BespokeView, *const BespokeView) -> BespokeStatus;

/// `pointer`, or null in one case of sixteen.
fn or_null<T>(pointer: *const T, source: &mut Source) -> *const T {
    if source.one_in(16) { null() } else { pointer }
}

/// As [`or_null`], for what is written.
fn or_null_mut<T>(pointer: *mut T, source: &mut Source) -> *mut T {
    or_null(pointer, source).cast_mut()
}

/// A garment or a body, more or less in order.
fn shape(source: &mut Source, is_garment: bool) -> Shape {
    let (rings, sides) = (source.between(2, 5), source.between(3, 6));
    let radius = source.within(0.1, 0.5);
    let reach = if is_garment { 0.5 } else { 1.1 };
    let mut shape = Shape::tube(rings, sides, [-reach, reach], !is_garment, |_| radius, |_| [0.0; 2]);
    for _ in 0..source.byte().saturating_sub(160) / 32 {
        shape.damage(source);
    }
    shape
}

/// A call that cannot fail with a session, and cannot succeed without.
fn answers(session: *const BespokeSession, status: BespokeStatus) -> BespokeStatus {
    assert_eq!(status == BespokeStatus::Ok, !session.is_null());
    status
}

impl Program {
    fn destroy_session(&mut self, k: usize) {
        // SAFETY: null or alive, and not used again.
        known("destroy", unsafe { bespoke_session_destroy(self.sessions[k]) }, BespokeStatus::Ok);
        self.sessions[k] = null_mut();
    }

    fn destroy_controls(&mut self) {
        for control in &mut self.controls {
            // SAFETY: null or alive, and not used again.
            unsafe { bespoke_control_destroy(*control) };
            *control = null_mut();
        }
    }

    fn destroy_shared(&mut self) {
        // SAFETY: null or alive, and not used again.
        unsafe {
            bespoke_avatar_destroy(self.avatar);
            bespoke_garment_destroy(self.garment);
        }
        (self.avatar, self.garment) = (null_mut(), null_mut());
    }

    /// Takes a session's avatar or garment to be shared, or lets the session use the one that was taken last.
    fn share(&mut self, session: *mut BespokeSession, source: &mut Source) {
        // SAFETY: the session is null or alive, and so are avatar and garment; there is room for a pointer, or null.
        unsafe {
            match source.below(4) {
                0 => {
                    bespoke_avatar_destroy(self.avatar);
                    self.avatar = null_mut();
                    let place = or_null_mut(&raw mut self.avatar, source);
                    after(session, "avatar_create", bespoke_avatar_create(session, place));
                }
                1 => {
                    bespoke_garment_destroy(self.garment);
                    self.garment = null_mut();
                    let place = or_null_mut(&raw mut self.garment, source);
                    after(session, "garment_create", bespoke_garment_create(session, place));
                }
                2 => drop(after(session, "use_avatar", bespoke_session_use_avatar(session, self.avatar))),
                _ => drop(after(session, "use_garment", bespoke_session_use_garment(session, self.garment))),
            }
        }
    }

    /// One call.
    fn call(&mut self, source: &mut Source) {
        let slot = source.below(3);
        let session = self.sessions[slot];
        match source.below(32) {
            0 | 1 => self.create(slot),
            2 => self.destroy_session(slot),
            // SAFETY: null or alive; so below.
            3 => drop(unsafe { after(session, "reset", bespoke_session_reset(session)) }),
            4 => self.set_mesh(session, source, bespoke_session_set_garment, true),
            5 => self.set_mesh(session, source, bespoke_session_set_target_avatar, false),
            6 => self.set_mesh(session, source, bespoke_session_set_source_avatar, false),
            7 => self.set_skeleton(session, source, bespoke_session_set_source_skeleton),
            8 => self.set_skeleton(session, source, bespoke_session_set_target_skeleton),
            9 => self.set_weights(session, source),
            10 => self.set_space(session, source),
            11 => self.set_options(session, source),
            12 | 13 => self.set_sample(session, source),
            14 => rigs::call(session, source),
            15..21 => self.work(session, source),
            21 => follow::call(session, source),
            22 => self.run_and_cancel(session, source),
            // SAFETY: as above.
            23 => drop(unsafe { after(session, "cancel", answers(session, bespoke_session_cancel(session))) }),
            24 => self.make_control(slot, source),
            25 => self.use_control(slot, source),
            26 | 27 => self.read(session, source),
            28 => self.read_report(session, source),
            29 => self.misread(session, source),
            30 => {
                // SAFETY: null or alive, and not used again.
                unsafe { bespoke_control_destroy(self.controls[slot]) };
                self.controls[slot] = null_mut();
            }
            _ => {
                // SAFETY: the name is part of the library.
                let name = unsafe { std::ffi::CStr::from_ptr(bespoke_status_name(source.u32())) };
                assert!(name.to_bytes().starts_with(b"BESPOKE_STATUS_"));
                assert_eq!(bespoke_abi_version(), BESPOKE_ABI_VERSION);
                self.share(session, source);
            }
        }
    }

    fn create(&mut self, slot: usize) {
        self.destroy_session(slot);
        // SAFETY: there is room for a pointer, or null, which is refused.
        unsafe {
            known("create", bespoke_session_create(null_mut()), BespokeStatus::InvalidArgument);
            known("create", bespoke_session_create(&mut self.sessions[slot]), BespokeStatus::Ok);
        }
        let session = self.sessions[slot];
        let options = BespokeOptions { max_iterations: 8, voxel_size: 0.1, threads: 1, ..no_options() };
        // SAFETY: the session is alive and the struct as large as it says.
        let status = unsafe { after(session, "set_options", bespoke_session_set_options(session, &options)) };
        assert_eq!(status, BespokeStatus::Ok);
    }

    fn set_pair(
        &self,
        session: *mut BespokeSession,
        source: &mut Source,
        set: SetPair,
        [points, elements]: [&Array; 2],
    ) {
        let views = [points.view(), elements.view()];
        let [points, elements] = [or_null(&views[0], source), or_null(&views[1], source)];
        // SAFETY: the session is null or alive, the views null or true.
        unsafe { after(session, "set", set(session, points, elements)) };
    }

    fn set_mesh(&self, session: *mut BespokeSession, source: &mut Source, set: SetPair, is_garment: bool) {
        let shape = shape(source, is_garment);
        let points = Array::floats(&shape.points, 3, source.below(2) * 8, source.one_in(2));
        let triangles = Array::indices(&shape.triangles, 3, source.below(2) * 2, source.one_in(2));
        // The kinds exchanged, now and then.
        let both = if source.one_in(32) { [&triangles, &points] } else { [&points, &triangles] };
        self.set_pair(session, source, set, both);
    }

    fn set_skeleton(&self, session: *mut BespokeSession, source: &mut Source, set: SetPair) {
        let count = if source.one_in(8) { source.between(2, 6) } else { JOINTS };
        let mut points = joints(count, || 0.1 * source.signed());
        let mut pairs = bones(count);
        if source.one_in(8) {
            points[source.below(3 * count)] = source.number();
        }
        if source.one_in(8) {
            pairs[source.below(2 * (count - 1))] = u32::from(source.byte() % 8);
        }
        let points = Array::floats(&points, 3, 0, source.one_in(2));
        let pairs = Array::indices(&pairs, 2, 0, source.one_in(2));
        self.set_pair(session, source, set, [&points, &pairs]);
    }

    /// All that has to be set, and it fits together.
    fn set_sample(&self, session: *mut BespokeSession, source: &mut Source) {
        let [loose, thick] = [source.within(0.2, 0.5), source.within(0.05, 0.6)];
        let (rings, sides) = (source.between(2, 5), source.between(3, 6));
        let garment = Shape::tube(rings, sides, [-0.5, 0.5], false, |_| loose, |_| [0.0; 2]);
        let body = Shape::tube(4, 4, [-1.1, 1.1], true, |_| thick, |_| [0.0; 2]);
        let is_double = source.one_in(2);
        let skeleton = Array::floats(&joints(JOINTS, || 0.0), 3, 0, is_double);
        let pairs = Array::indices(&bones(JOINTS), 2, 0, true);
        // SAFETY: the session is null or alive, the views tell the truth.
        unsafe {
            for (set, shape) in
                [(bespoke_session_set_garment as SetPair, &garment), (bespoke_session_set_target_avatar, &body)]
            {
                let points = Array::floats(&shape.points, 3, 0, is_double);
                let triangles = Array::indices(&shape.triangles, 3, 0, true);
                after(session, "set_mesh", set(session, &points.view(), &triangles.view()));
            }
            for set in [bespoke_session_set_source_skeleton, bespoke_session_set_target_skeleton] {
                after(session, "set_skeleton", set(session, &skeleton.view(), &pairs.view()));
            }
        }
    }

    fn set_weights(&self, session: *mut BespokeSession, source: &mut Source) {
        let vertices = if source.one_in(2) { 18 } else { source.between(0, 40) };
        let numbers: Vec<f64> = (0..vertices * JOINTS)
            .map(|k| if source.one_in(32) { source.number() } else { ((7 * k) % 5) as f64 / 4.0 })
            .collect();
        let indices: Vec<u32> = (0..vertices * JOINTS).map(|_| u32::from(source.byte() % 4)).collect();
        let is_double = source.one_in(2);
        // SAFETY: the session is null or alive, the views tell the truth.
        let status = unsafe {
            match source.below(11) {
                0 => {
                    let rows = Array::floats(&numbers, vertices, 0, is_double);
                    let view = rows.view();
                    bespoke_session_set_target_skin_weights(session, or_null(&view, source), vertices)
                }
                1 => {
                    let (numbers, indices) =
                        (Array::floats(&numbers, JOINTS, 0, is_double), Array::indices(&indices, JOINTS, 0, is_double));
                    let (set, joint_count) = (bespoke_session_set_target_skin_influences, source.between(2, 5));
                    set(session, &indices.view(), &numbers.view(), JOINTS, joint_count)
                }
                2 => {
                    let view = Array::floats(&numbers, 1, 0, is_double);
                    bespoke_session_set_vertex_fit_weights(session, &view.view())
                }
                3 => {
                    let view = Array::indices(&indices, 1, 0, is_double);
                    bespoke_session_set_no_fit_vertices(session, &view.view())
                }
                4 => {
                    let count = source.between(0, 4);
                    let first = source.below(16) as u32;
                    let vertices: Vec<u32> =
                        (0..count as u32).map(|k| first + k * u32::from(source.byte() % 4)).collect();
                    let places: Vec<f64> = (0..3 * count).map(|_| f64::from(source.byte()) / 64.0 - 2.0).collect();
                    let vertices = Array::indices(&vertices, 1, 0, is_double);
                    let places = Array::floats(&places, 3, 0, is_double);
                    let view = places.view();
                    bespoke_session_set_pinned_vertices(session, &vertices.view(), or_null(&view, source))
                }
                5 => {
                    let view = Array::indices(&indices[..indices.len().min(source.between(0, 6))], 1, 0, is_double);
                    bespoke_session_add_rigid_group(session, &view.view())
                }
                6 => bespoke_session_clear_rigid_groups(session),
                7 => {
                    let around = f64::from(source.byte()) / 128.0;
                    let layer = Shape::tube(source.between(2, 4), 5, [-0.4, 0.4], false, |_| around, |_| [0.0; 2]);
                    let points = Array::floats(&layer.points, 3, 0, is_double);
                    let triangles = Array::indices(&layer.triangles, 3, 0, true);
                    bespoke_session_add_layer(session, &points.view(), &triangles.view())
                }
                8 => bespoke_session_clear_layers(session),
                9 => {
                    // Mostly a ring of the garment's tube, or a part of it.
                    let (first, count) = (source.below(24) as u32, source.between(0, 8) as u32);
                    let vertices: Vec<u32> = if source.one_in(4) { indices } else { (first..first + count).collect() };
                    let weight = |source: &mut Source| if source.one_in(8) { source.number() } else { 1.0 };
                    let view = Array::indices(&vertices, 1, 0, is_double);
                    let closed = u32::from(source.byte() % 3);
                    let weights = [weight(source), weight(source)];
                    bespoke_session_add_curve(session, &view.view(), closed, weights[0], weights[1])
                }
                _ => bespoke_session_clear_curves(session),
            }
        };
        // SAFETY: the session is null or alive.
        unsafe { after(session, "set_weights", status) };
    }

    fn set_space(&self, session: *mut BespokeSession, source: &mut Source) {
        let axis = |source: &mut Source| u32::from(source.byte() % 8);
        let space = BespokeCoordinateSystem {
            struct_size: size_of::<BespokeCoordinateSystem>() as u32 - u32::from(source.one_in(16)),
            right: axis(source),
            up: axis(source),
            forward: axis(source),
            metres_per_unit: [0.0, 0.01, 100.0, 1.0, source.number()][source.below(5)],
            winding: u32::from(source.byte() % 3),
            trusted: u32::from(source.byte() % 3),
        };
        let space = or_null(&space, source);
        let set = if source.one_in(2) {
            bespoke_session_set_source_coordinate_system
        } else {
            bespoke_session_set_target_coordinate_system
        };
        // SAFETY: the session is null or alive, the struct null or as large as it says.
        unsafe { after(session, "set_space", set(session, space)) };
    }

    fn set_options(&self, session: *mut BespokeSession, source: &mut Source) {
        let mut options = BespokeOptions {
            threads: source.between(1, 3) as u32,
            max_iterations: source.between(1, 16) as u32,
            voxel_size: source.within(0.05, 0.2),
            surface_form: u32::from(source.byte() % 3),
            ..no_options()
        };
        let numbers = [
            &mut options.fit_weight,
            &mut options.designed_clearance,
            &mut options.surface_weight,
            &mut options.curvature_weight,
            &mut options.torsion_weight,
            &mut options.position_weight,
            &mut options.barrier_weight,
            &mut options.dhat,
            &mut options.inflation_dhat,
            &mut options.inflation_barrier_weight,
            &mut options.min_separation,
            &mut options.tolerance,
            &mut options.surface_length,
            &mut options.curve_chord,
        ];
        for number in numbers {
            match source.byte() {
                0..200 => {}
                200..220 => *number = BESPOKE_WEIGHT_OFF,
                220..250 => *number = 10f64.powf(6.0 * source.signed()),
                250.. => *number = source.number(),
            }
        }
        if source.one_in(16) {
            options.threads = 1025;
        }
        let options = or_null(&options, source);
        // SAFETY: the session is null or alive, the struct null or as large as it says.
        unsafe {
            after(session, "set_options", bespoke_session_set_options(session, options));
            after(session, "refit", bespoke_session_refit(session, options));
        }
    }

    /// A call that computes.
    fn work(&mut self, session: *mut BespokeSession, source: &mut Source) {
        self.work += 1;
        if self.work > MOST_WORK {
            return;
        }
        let mut stage = u32::MAX;
        // SAFETY: the session is null or alive; there is room for what is written.
        unsafe {
            match source.below(6) {
                0 | 1 => drop(after(session, "prepare", bespoke_session_prepare(session))),
                2 | 3 => {
                    let (iterations, milliseconds) = (source.below(6) as u32, source.below(4) as u32);
                    let status = bespoke_session_step(session, iterations, milliseconds, &mut stage);
                    after(session, "step", status);
                    assert_eq!(stage == u32::MAX, session.is_null());
                    assert!(session.is_null() || stage <= BespokeStage::Repose as u32);
                }
                4 => drop(after(session, "run", bespoke_session_run(session))),
                _ => {
                    let mut counts = BespokeIntersections::default();
                    let component = source.u32() % 6;
                    let counts = or_null_mut(&mut counts, source);
                    after(session, "verify", bespoke_session_verify(session, component, counts));
                }
            }
        }
    }

    /// A run on one thread, a look at it and a cancel from another.
    fn run_and_cancel(&mut self, session: *mut BespokeSession, source: &mut Source) {
        self.work += 1;
        if self.work > MOST_WORK || session.is_null() {
            return;
        }
        let (shared, looks) = (Shared(session), source.byte());
        let status = std::thread::scope(|scope| {
            // SAFETY: the session is alive until the thread has ended.
            let runner = scope.spawn(move || unsafe { bespoke_session_run(shared.session()) });
            for _ in 0..looks {
                let mut progress: BespokeProgress = no_progress();
                // SAFETY: the session is alive and the struct as large as it says.
                let status = unsafe { bespoke_session_read_progress(session, &mut progress) };
                known("read_progress", status, BespokeStatus::Ok);
                std::thread::yield_now();
            }
            // SAFETY: as above.
            known("cancel", unsafe { bespoke_session_cancel(session) }, BespokeStatus::Ok);
            runner.join().expect("no panic gets out")
        });
        // SAFETY: the session is alive.
        unsafe { after(session, "run", status) };
    }

    fn make_control(&mut self, slot: usize, source: &mut Source) {
        let of = self.sessions[source.below(3)];
        // SAFETY: null or alive, and not used again; there is room for a pointer.
        unsafe {
            bespoke_control_destroy(self.controls[slot]);
            let status = answers(of, bespoke_session_create_control(of, &mut self.controls[slot]));
            assert_eq!(status == BespokeStatus::Ok, !self.controls[slot].is_null());
            known("create_control", bespoke_session_create_control(of, null_mut()), BespokeStatus::InvalidArgument);
        }
    }

    fn use_control(&mut self, slot: usize, source: &mut Source) {
        let control = self.controls[slot];
        let mut progress = no_progress();
        // SAFETY: the control is null or alive, the struct null or as large as it says.
        unsafe {
            let status = bespoke_control_read_progress(control, &mut progress);
            assert_eq!(status == BespokeStatus::Ok, !control.is_null());
            known("read_progress", bespoke_control_read_progress(control, null_mut()), BespokeStatus::InvalidArgument);
            if source.one_in(2) {
                let status = bespoke_control_cancel(control);
                assert_eq!(status == BespokeStatus::Ok, !control.is_null());
            }
        }
    }

    /// Reads vertices, into too little room as well.
    fn read(&self, session: *mut BespokeSession, source: &mut Source) {
        let capacity = source.below(64);
        let mut numbers = vec![0.0f64; 3 * capacity];
        let component = source.u32() % 4;
        let room = BespokeBuffer { data: numbers.as_mut_ptr().cast(), capacity, stride: 0, component };
        let room = or_null(&room, source);
        let mut count = 0;
        let count = or_null_mut(&mut count, source);
        let read =
            if source.one_in(2) { bespoke_session_read_garment_vertices } else { bespoke_session_read_avatar_vertices };
        // SAFETY: the session is null or alive, the pointers are null or as large as said.
        unsafe { after(session, "read_vertices", read(session, room, count)) };
    }

    fn read_report(&self, session: *mut BespokeSession, source: &mut Source) {
        // SAFETY: all fields are numbers, for which zero is a value.
        let (mut report, mut energy): (BespokeReport, BespokeEnergy) = unsafe { std::mem::zeroed() };
        report.struct_size = size_of::<BespokeReport>() as u32;
        energy.struct_size = size_of::<BespokeEnergy>() as u32;
        let index = source.u32() % 10;
        // SAFETY: the session is null or alive, the structs are as large as they say.
        unsafe {
            let status = after(session, "read_report", bespoke_session_read_report(session, &mut report));
            answers(session, status);
            let status = after(session, "read_energy", bespoke_session_read_energy(session, index, &mut energy));
            assert_eq!(status == BespokeStatus::Ok, index < report.energy_count);
        }
    }

    /// Null where something is to be written.
    fn misread(&self, session: *mut BespokeSession, source: &mut Source) {
        // SAFETY: the session is null or alive; null is refused.
        let status = unsafe {
            match source.below(5) {
                0 => bespoke_session_read_report(session, null_mut()),
                1 => bespoke_session_read_progress(session, null_mut()),
                2 => bespoke_session_read_energy(session, 0, null_mut()),
                3 => bespoke_session_last_message(session, null_mut(), 1, null_mut()),
                _ => bespoke_options_read_defaults(null_mut()),
            }
        };
        known("with null", status, BespokeStatus::InvalidArgument);
    }
}

fn no_progress() -> BespokeProgress {
    // SAFETY: all fields are numbers, for which zero is a value.
    let mut progress: BespokeProgress = unsafe { std::mem::zeroed() };
    progress.struct_size = size_of::<BespokeProgress>() as u32;
    progress
}
