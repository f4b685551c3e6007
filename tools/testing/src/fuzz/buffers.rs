//! One session whose caller's memory is anything at all.

use std::ffi::c_void;
use std::mem::offset_of;

use bespoke::capi::control::{BespokeProgress, bespoke_session_read_progress};
use bespoke::capi::coordinate_system::*;
use bespoke::capi::fit::*;
use bespoke::capi::inputs::*;
use bespoke::capi::options::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeBuffer, BespokeView};

use super::array::{Array, size_of_component};
use super::caller::{Caller, no_options};
use super::shape::{Shape, bones, joints};
use super::source::Source;

const JOINTS: usize = 3;
/// What stands in memory that nobody may write to.
const GUARD: u8 = 0xA5;
/// Largest array that is really made.
const MOST: usize = 1 << 16;

pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let source = &mut source;
    let caller = Caller::new();
    caller.set_options(4, 0.1, 1);
    // A good scene first, so that what is odd afterwards is also looked at by the later stages.
    if !source.one_in(4) {
        sample(&caller);
    }
    for _ in 0..source.between(1, 12) {
        match source.below(18) {
            0 => pair(&caller, source, "set_garment", bespoke_session_set_garment, 3),
            1 => pair(&caller, source, "set_target_avatar", bespoke_session_set_target_avatar, 3),
            2 => pair(&caller, source, "set_source_avatar", bespoke_session_set_source_avatar, 3),
            3 => pair(&caller, source, "set_source_skeleton", bespoke_session_set_source_skeleton, 2),
            4 => pair(&caller, source, "set_target_skeleton", bespoke_session_set_target_skeleton, 2),
            5 => dense_skin(&caller, source),
            6 => sparse_skin(&caller, source),
            7 => single(&caller, source, "set_vertex_fit_weights", bespoke_session_set_vertex_fit_weights, true),
            8 => single(&caller, source, "set_no_fit_vertices", bespoke_session_set_no_fit_vertices, false),
            9 => options(&caller, source),
            10 => space(&caller, source, bespoke_session_set_source_coordinate_system),
            11 => space(&caller, source, bespoke_session_set_target_coordinate_system),
            12 => output(&caller, source, bespoke_session_read_garment_vertices),
            13 => output(&caller, source, bespoke_session_read_avatar_vertices),
            14 => filled_structs(&caller, source),
            15 => single(&caller, source, "add_rigid_group", bespoke_session_add_rigid_group, false),
            16 => single(&caller, source, "add_curve", add_curve, false),
            _ => damaged_pair(&caller, source),
        }
    }
    // SAFETY: the session is alive.
    let prepared = caller.after("prepare", unsafe { bespoke_session_prepare(caller.session) });
    output(&caller, source, bespoke_session_read_garment_vertices);
    if prepared == BespokeStatus::Ok {
        for _ in 0..source.below(4) {
            // SAFETY: the session is alive.
            let status = unsafe { bespoke_session_step(caller.session, 1, 0, std::ptr::null_mut()) };
            caller.after("step", status);
        }
        // SAFETY: the session is alive.
        caller.after("run", unsafe { bespoke_session_run(caller.session) });
        let mut counts = BespokeIntersections::default();
        let component = source.u32() % 6;
        // SAFETY: the session is alive and there is room for the counts.
        caller.after("verify", unsafe { bespoke_session_verify(caller.session, component, &mut counts) });
        output(&caller, source, bespoke_session_read_garment_vertices);
        output(&caller, source, bespoke_session_read_avatar_vertices);
        filled_structs(&caller, source);
    }
}

fn sleeve() -> Shape {
    Shape::tube(4, 5, [-0.5, 0.5], false, |_| 0.3, |_| [0.0; 2])
}

fn body() -> Shape {
    Shape::tube(4, 4, [-0.9, 0.9], true, |_| 0.2, |_| [0.0; 2])
}

fn sample(caller: &Caller) {
    set_shape(caller, &sleeve(), bespoke_session_set_garment);
    set_shape(caller, &body(), bespoke_session_set_target_avatar);
    let joints = Array::floats(&joints(JOINTS, || 0.0), 3, 0, true);
    let bones = Array::indices(&bones(JOINTS), 2, 0, true);
    for set in [bespoke_session_set_source_skeleton, bespoke_session_set_target_skeleton] {
        // SAFETY: the session is alive and the views tell the truth.
        let status = unsafe { set(caller.session, &joints.view(), &bones.view()) };
        assert_eq!(caller.after("set_skeleton", status), BespokeStatus::Ok);
    }
}

type SetPair = unsafe extern "C" fn(*mut BespokeSession, *const BespokeView, *const BespokeView) -> BespokeStatus;
type SetSingle = unsafe extern "C" fn(*mut BespokeSession, *const BespokeView) -> BespokeStatus;

fn set_shape(caller: &Caller, shape: &Shape, set: SetPair) {
    let points = Array::floats(&shape.points, 3, 0, false);
    let triangles = Array::indices(&shape.triangles, 3, 0, false);
    // SAFETY: the session is alive and the views tell the truth.
    caller.after("set_mesh", unsafe { set(caller.session, &points.view(), &triangles.view()) });
}

/// A good mesh with a few things wrong.
fn damaged_pair(caller: &Caller, source: &mut Source) {
    let is_garment = source.one_in(2);
    let mut shape = if is_garment { sleeve() } else { body() };
    for _ in 0..source.between(1, 6) {
        shape.damage(source);
    }
    set_shape(caller, &shape, if is_garment { bespoke_session_set_garment } else { bespoke_session_set_target_avatar });
}

/// A view of any layout, and the memory that it needs.
struct Any {
    /// Kept alive for the view. One byte more in front, so that nothing is aligned.
    memory: Vec<u8>,
    view: BespokeView,
    /// Whether the documented checks have to refuse it.
    is_bad: bool,
}

impl Any {
    /// Elements of `width` numbers: floating-point ones, or indices.
    fn new(source: &mut Source, width: usize, is_float: bool) -> Self {
        let component = match source.byte() {
            0..224 => 1 + u32::from(source.one_in(2)) + if is_float { 0 } else { 2 },
            224.. => source.u32() % 8,
        };
        let is_kind = if is_float { 1..3 } else { 3..5 }.contains(&component);
        let size = size_of_component(component).unwrap_or(1);
        let count = source.size();
        let stride = if source.one_in(2) { source.size() } else { 0 };
        let layout = Self::layout(count, stride, width, size);
        // Memory for what would be read. A layout that is fine but too large to be made is made smaller.
        let (count, needed) = match layout {
            Some(bytes) if bytes > MOST => (0, 0),
            Some(bytes) => (count, bytes),
            None => (count, 0),
        };
        let is_null = source.one_in(12);
        let mut memory = vec![GUARD];
        fill(&mut memory, if is_null { 0 } else { needed }, component, source);
        let data = if is_null { std::ptr::null() } else { memory[1..].as_ptr().cast::<c_void>() };
        let is_bad = !is_kind || (count > 0 && width > 0 && (layout.is_none() || is_null));
        Self { memory, view: BespokeView { data, count, stride, component }, is_bad }
    }

    /// Bytes from the first to the end of the last element; `None` where the documented checks have to refuse it.
    fn layout(count: usize, stride: usize, width: usize, size: usize) -> Option<usize> {
        let element = width.checked_mul(size).filter(|&bytes| bytes <= isize::MAX as usize)?;
        if count == 0 || width == 0 {
            return Some(0);
        }
        if count > u32::MAX as usize || (stride != 0 && stride < element) {
            return None;
        }
        let step = if stride == 0 { element } else { stride };
        step.checked_mul(count - 1)?.checked_add(element).filter(|&bytes| bytes <= isize::MAX as usize)
    }

    fn check(&self, name: &str, status: BespokeStatus) {
        assert!(self.memory[0] == GUARD);
        if self.is_bad {
            assert_eq!(status, BespokeStatus::InvalidArgument, "{name} took {:?}", self.view);
        }
    }
}

/// `needed` bytes: any at all, or numbers that make sense.
fn fill(memory: &mut Vec<u8>, needed: usize, component: u32, source: &mut Source) {
    let end = memory.len() + needed;
    memory.reserve_exact(needed);
    let style = source.below(4);
    while memory.len() < end {
        let bytes = match (style, component) {
            (0, _) => vec![source.byte()],
            (1, 1) => (source.number() as f32).to_le_bytes().to_vec(),
            (1, 2) => source.number().to_le_bytes().to_vec(),
            (_, 1) => (source.signed() as f32).to_le_bytes().to_vec(),
            (_, 2) => source.signed().to_le_bytes().to_vec(),
            (1 | 2, 3) => u16::from(source.byte() % 8).to_le_bytes().to_vec(),
            (1 | 2, 4) => u32::from(source.byte() % 8).to_le_bytes().to_vec(),
            _ => vec![source.byte(), 0, 0, 0],
        };
        memory.extend(&bytes[..bytes.len().min(end - memory.len())]);
    }
}

fn pair(caller: &Caller, source: &mut Source, name: &str, set: SetPair, width: usize) {
    let (points, elements) = (Any::new(source, 3, true), Any::new(source, width, false));
    // SAFETY: the session is alive and the views tell the truth, or have to be refused.
    let status = caller.after(name, unsafe { set(caller.session, &points.view, &elements.view) });
    points.check(name, status);
    elements.check(name, status);
}

fn single(caller: &Caller, source: &mut Source, name: &str, set: SetSingle, is_float: bool) {
    let any = Any::new(source, 1, is_float);
    // SAFETY: the session is alive and the view tells the truth, or has to be refused.
    let status = caller.after(name, unsafe { set(caller.session, &any.view) });
    if any.is_bad && name == "set_no_fit_vertices" && status == BespokeStatus::InvalidState {
        // The garment is missing: that is looked at first.
        return;
    }
    any.check(name, status);
}

/// An open curve with the weights of a boundary curve.
///
/// # Safety
/// As for [`bespoke_session_add_curve`].
unsafe extern "C" fn add_curve(session: *mut BespokeSession, vertices: *const BespokeView) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { bespoke_session_add_curve(session, vertices, 0, 1.0, 1.0) }
}

fn dense_skin(caller: &Caller, source: &mut Source) {
    let vertices = source.size();
    let rows = Any::new(source, vertices, true);
    // SAFETY: the session is alive and the view tells the truth, or has to be refused.
    let status = unsafe { bespoke_session_set_target_skin_weights(caller.session, &rows.view, vertices) };
    rows.check("set_target_skin_weights", caller.after("set_target_skin_weights", status));
}

fn sparse_skin(caller: &Caller, source: &mut Source) {
    let influences = source.size();
    let (joints, mut weights) = (Any::new(source, influences, false), Any::new(source, influences, true));
    if source.one_in(2) && weights.view.count > joints.view.count && !weights.is_bad {
        // Fewer elements of the same memory, so that both have as many. A bad view has no memory for any.
        weights.view.count = joints.view.count;
    }
    let (set, joint_count) = (bespoke_session_set_target_skin_influences, source.size());
    // SAFETY: the session is alive and the views tell the truth, or have to be refused.
    let status = unsafe { set(caller.session, &joints.view, &weights.view, influences, joint_count) };
    let status = caller.after("set_target_skin_influences", status);
    joints.check("set_target_skin_influences", status);
    weights.check("set_target_skin_influences", status);
}

/// A struct of `T`'s size or another, its size in front, then any bytes over `base`.
fn any_struct<T>(source: &mut Source, base: &T) -> Vec<u64> {
    let size = match source.byte() {
        0..160 => size_of::<T>(),
        160.. => usize::from(source.byte()) * 2,
    };
    // Whole words, for the alignment that the type has; what is beyond the size is not to be touched.
    let mut words = vec![0u64; size.max(size_of::<T>()).div_ceil(8)];
    // SAFETY: both hold as many bytes, and they are apart.
    unsafe {
        std::ptr::copy_nonoverlapping((&raw const *base).cast::<u8>(), words.as_mut_ptr().cast(), size_of::<T>())
    };
    let length = words.len();
    for _ in 0..source.below(4) {
        let number = source.number();
        words[source.below(length)] = if source.one_in(2) { number.to_bits() } else { source.u64() };
    }
    words[0] = words[0] & !0xFFFF_FFFF | size as u64;
    words
}

fn options(caller: &Caller, source: &mut Source) {
    let base = BespokeOptions { threads: 1, voxel_size: 0.1, max_iterations: 4, ..no_options() };
    let mut words = any_struct(source, &base);
    let pointer = words.as_mut_ptr().cast::<BespokeOptions>();
    // SAFETY: the words hold at least one struct.
    let given = unsafe { &mut *pointer };
    // Good values under which a run takes longer than a fuzzer can wait are made small.
    if given.threads <= 1024 {
        given.threads = 1 + given.threads % 3;
    }
    given.max_iterations = 1 + given.max_iterations % 16;
    if given.voxel_size == 0.0 || (1e-3..0.05).contains(&given.voxel_size) {
        given.voxel_size = 0.05;
    }
    // SAFETY: the session is alive and the struct as large as it says.
    caller.after("set_options", unsafe { bespoke_session_set_options(caller.session, pointer) });
}

fn space(
    caller: &Caller,
    source: &mut Source,
    set: unsafe extern "C" fn(*mut BespokeSession, *const BespokeCoordinateSystem) -> BespokeStatus,
) {
    let axes = [[0, 0, 0], [1, 3, 6], [1, 5, 3], [2, 3, 5], [4, 5, 1], [1, 2, 3]][source.below(6)];
    let base = BespokeCoordinateSystem {
        struct_size: 0,
        right: axes[0],
        up: axes[1],
        forward: axes[2],
        metres_per_unit: if source.one_in(2) { 10f64.powf(8.0 * source.signed()) } else { 0.0 },
        winding: u32::from(source.one_in(2)),
        trusted: u32::from(source.one_in(2)),
    };
    let words = any_struct(source, &base);
    // SAFETY: the session is alive and the struct as large as it says.
    caller.after("set_space", unsafe { set(caller.session, words.as_ptr().cast()) });
}

/// Structs that the library fills: what is beyond the size that the caller gives stays as it is.
fn filled_structs(caller: &Caller, source: &mut Source) {
    /// `first` is the size that the struct had at first, which an old program still gives.
    fn fill<T>(source: &mut Source, first: usize, call: impl FnOnce(*mut T) -> BespokeStatus) {
        let size = match source.byte() {
            0..128 => size_of::<T>(),
            128.. => usize::from(source.byte()) * 4,
        };
        let room = size.max(4);
        let mut bytes = vec![GUARD; room + 64];
        bytes[..4].copy_from_slice(&(size as u32).to_le_bytes());
        let status = call(bytes.as_mut_ptr().cast());
        assert_eq!(status == BespokeStatus::Ok, size >= first);
        assert_eq!(bytes[..4], (size as u32).to_le_bytes(), "struct_size stays");
        assert!(bytes[room..].iter().all(|&b| b == GUARD), "bytes beyond struct_size were written");
    }
    // SAFETY: the session is alive, each struct as large as it says; none of them needs an alignment.
    unsafe {
        fill::<BespokeOptions>(source, offset_of!(BespokeOptions, surface_weight), |to| {
            bespoke_options_read_defaults(to)
        });
        fill::<BespokeProgress>(source, size_of::<BespokeProgress>(), |to| {
            bespoke_session_read_progress(caller.session, to)
        });
        fill::<BespokeReport>(source, offset_of!(BespokeReport, memory_bytes), |to| {
            caller.after("read_report", bespoke_session_read_report(caller.session, to))
        });
        let mut energy: BespokeEnergy = std::mem::zeroed();
        energy.struct_size = size_of::<BespokeEnergy>() as u32;
        let index = source.u32() % 16;
        if caller.after("read_energy", bespoke_session_read_energy(caller.session, index, &mut energy))
            == BespokeStatus::Ok
        {
            assert!(energy.name.contains(&0) && energy.name[0] != 0);
        }
    }
}

type ReadVertices = unsafe extern "C" fn(*const BespokeSession, *const BespokeBuffer, *mut usize) -> BespokeStatus;

/// Reads into any layout: points are written to their places and nowhere else, or nothing is.
fn output(caller: &Caller, source: &mut Source, read: ReadVertices) {
    let mut count = 0;
    let nothing = BespokeBuffer { data: std::ptr::null_mut(), capacity: 0, stride: 0, component: 1 };
    // SAFETY: the session is alive, nothing but the count is written.
    let can_read = unsafe { read(caller.session, &nothing, &mut count) } == BespokeStatus::Ok;
    let component = if source.one_in(8) { source.u32() % 8 } else { 1 + u32::from(source.one_in(2)) };
    let size = size_of_component(component).unwrap_or(1);
    let capacity = match source.byte() {
        0..128 => count,
        128..192 => count + source.below(4),
        192.. => source.size(),
    };
    let stride = match source.byte() {
        0..128 => 0,
        128..224 => 3 * size + source.below(24),
        224.. => source.size(),
    };
    let step = if stride == 0 { 3 * size } else { stride };
    // Only `count` points are written, whatever the capacity; a layout that nobody could provide is refused.
    let layout = Any::layout(count, stride, 3, size);
    let Some(needed) = layout.or(Some(0)).filter(|&bytes| bytes <= MOST) else { return };
    let mut memory = vec![GUARD; 1 + needed];
    let data = memory[1..].as_mut_ptr().cast::<c_void>();
    let room = BespokeBuffer { data, capacity: if layout.is_some() { capacity } else { 0 }, stride, component };
    // SAFETY: the session is alive, there is room for all points that fit into the capacity.
    let status = caller.after("read_vertices", unsafe { read(caller.session, &room, std::ptr::null_mut()) });
    assert!(can_read || status != BespokeStatus::Ok);
    let is_written = |k: usize| status == BespokeStatus::Ok && k % step < 3 * size;
    let bytes = &memory[1..];
    assert!(memory[0] == GUARD && bytes.iter().enumerate().all(|(k, &b)| is_written(k) || b == GUARD));
}
