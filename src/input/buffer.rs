//! The caller's memory: strided arrays of numbers and indices, copied once, and positions written back.
//!
//! The only file of the input layer with `unsafe` code. Every access goes through unaligned reads and writes, so
//! the caller's arrays need no alignment.

use std::ffi::c_void;

use glam::{DVec3, DVec4};

use crate::error::{Error, ErrorKind, Result};

/// How one number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// 32-bit floating point.
    F32,
    /// 64-bit floating point.
    F64,
}

/// How one index is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexComponent {
    /// 16 bits, unsigned.
    U16,
    /// 32 bits, unsigned.
    U32,
}

/// A way to store a number that has a size in bytes.
pub trait Stored: Copy {
    /// Bytes of one number.
    fn size(self) -> usize;
}

impl Stored for Component {
    fn size(self) -> usize {
        match self {
            Component::F32 => 4,
            Component::F64 => 8,
        }
    }
}

impl Stored for IndexComponent {
    fn size(self) -> usize {
        match self {
            IndexComponent::U16 => 2,
            IndexComponent::U32 => 4,
        }
    }
}

/// An array in the caller's memory, to be read. An element is a position, a triangle, a weight...: several numbers
/// one after the other.
#[derive(Clone, Copy, Debug)]
pub struct View<C> {
    /// The first element. May be null where `count` is 0.
    pub data: *const c_void,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next; 0 means that they are packed.
    pub stride: usize,
    /// How each number is stored.
    pub component: C,
}

/// Positions (3 numbers an element), or scalars (1).
pub type PositionsView = View<Component>;

/// Triangles (3 indices an element), bones (2), or plain indices (1).
pub type IndicesView = View<IndexComponent>;

/// Positions, or other numbers, in the caller's memory, to be written.
#[derive(Clone, Copy, Debug)]
pub struct PositionsViewMut {
    /// The first element. May be null where nothing is written.
    pub data: *mut c_void,
    /// Number of elements that fit.
    pub capacity: usize,
    /// Bytes from one element to the next; 0 means that they are packed.
    pub stride: usize,
    /// How each number is stored.
    pub component: Component,
}

fn invalid<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidArgument, message))
}

/// Checks what can be checked of a view of `count` elements of `width` numbers of `size` bytes each.
/// Returns the true stride, for which the offset of every byte is at most `isize::MAX`.
fn check_layout(null: bool, count: usize, stride: usize, width: usize, size: usize, name: &str) -> Result<usize> {
    let element = match width.checked_mul(size) {
        Some(bytes) if bytes <= isize::MAX as usize => bytes,
        _ => return invalid(format!("{name}: an element of {width} numbers is larger than memory")),
    };
    let stride = if stride == 0 { element } else { stride };
    if count == 0 || width == 0 {
        return Ok(stride);
    }
    if null {
        return invalid(format!("{name}: the pointer is null but the count is {count}"));
    }
    if count > u32::MAX as usize {
        return invalid(format!("{name}: the count is {count}, at most {} can be used", u32::MAX));
    }
    if stride < element {
        return invalid(format!("{name}: the stride is {stride} bytes but an element takes {element}"));
    }
    let bytes = stride.checked_mul(count - 1).and_then(|b| b.checked_add(element));
    if bytes.is_none_or(|b| b > isize::MAX as usize) {
        return invalid(format!("{name}: {count} elements of stride {stride} are larger than memory"));
    }
    Ok(stride)
}

/// Reads `view.count * width` numbers in order, each by `read` from its address.
///
/// # Safety
/// As for [`read_positions`], with `width` numbers an element; `read` may read `view.component.size()` bytes.
unsafe fn read<C: Stored, T>(
    view: &View<C>,
    width: usize,
    name: &str,
    read: impl Fn(*const u8) -> T,
) -> Result<Vec<T>> {
    let size = view.component.size();
    let stride = check_layout(view.data.is_null(), view.count, view.stride, width, size, name)?;
    let mut numbers = Vec::new();
    let total = view.count.checked_mul(width);
    if total.is_none_or(|n| numbers.try_reserve_exact(n).is_err()) {
        return invalid(format!("{name}: there is no memory for {} elements of {width} numbers", view.count));
    }
    for element in 0..view.count {
        for k in 0..width {
            // SAFETY: the offset is inside the caller's array (the caller's promise), and `check_layout` has made
            // sure that it neither overflows nor passes isize::MAX.
            let address = unsafe { view.data.cast::<u8>().add(element * stride + k * size) };
            numbers.push(read(address));
        }
    }
    Ok(numbers)
}

/// # Safety
/// As for [`read_positions`], with `width` numbers an element.
unsafe fn read_floats(view: &PositionsView, width: usize, name: &str) -> Result<Vec<f64>> {
    match view.component {
        // SAFETY: the caller's promise, handed on; `read` passes addresses of 4 readable bytes, and any bits are
        // an f32.
        Component::F32 => unsafe { read(view, width, name, |p| f64::from(p.cast::<f32>().read_unaligned())) },
        // SAFETY: as above, with 8 bytes.
        Component::F64 => unsafe { read(view, width, name, |p| p.cast::<f64>().read_unaligned()) },
    }
}

/// # Safety
/// As for [`read_positions`], with `width` indices an element.
unsafe fn read_index_tuples(view: &IndicesView, width: usize, name: &str) -> Result<Vec<u32>> {
    match view.component {
        // SAFETY: the caller's promise, handed on; `read` passes addresses of 2 readable bytes, and any bits are
        // a u16.
        IndexComponent::U16 => unsafe { read(view, width, name, |p| u32::from(p.cast::<u16>().read_unaligned())) },
        // SAFETY: as above, with 4 bytes.
        IndexComponent::U32 => unsafe { read(view, width, name, |p| p.cast::<u32>().read_unaligned()) },
    }
}

/// Reads positions of three coordinates each. `name` names the array in error messages ("garment positions").
///
/// Values are not checked here: NaN is for [`TriangleMesh::check`](crate::geometry::mesh::TriangleMesh::check) to find.
///
/// # Errors
/// [`ErrorKind::InvalidArgument`]: a null pointer with a count, a count above `u32::MAX`, a stride smaller than an
/// element, an array larger than memory.
///
/// # Safety
/// Where `view.data` is not null, the `view.count` elements that it describes must be readable memory that nobody
/// writes during the call.
pub unsafe fn read_positions(view: &PositionsView, name: &str) -> Result<Vec<DVec3>> {
    // SAFETY: the caller's promise, handed on with 3 numbers an element.
    let numbers = unsafe { read_floats(view, 3, name)? };
    Ok(numbers.as_chunks::<3>().0.iter().map(|&p| DVec3::from_array(p)).collect())
}

/// Reads one number an element. `name` names the array in error messages.
///
/// # Errors
/// As for [`read_positions`].
///
/// # Safety
/// As for [`read_positions`], with one number an element.
pub unsafe fn read_scalars(view: &PositionsView, name: &str) -> Result<Vec<f64>> {
    // SAFETY: the caller's promise, handed on.
    unsafe { read_floats(view, 1, name) }
}

/// Reads a matrix: `view.count` rows of `columns` numbers each, `view.stride` bytes from row to row. The result is row
/// after row, packed. `name` names it in error messages.
///
/// # Errors
/// As for [`read_positions`].
///
/// # Safety
/// As for [`read_positions`], with `columns` numbers an element.
pub unsafe fn read_rows(view: &PositionsView, columns: usize, name: &str) -> Result<Vec<f64>> {
    // SAFETY: the caller's promise, handed on.
    unsafe { read_floats(view, columns, name) }
}

/// Reads triangles of three indices each. `name` names the array in error messages.
///
/// # Errors
/// As for [`read_positions`].
///
/// # Safety
/// As for [`read_positions`], with 3 indices an element.
pub unsafe fn read_triangles(view: &IndicesView, name: &str) -> Result<Vec<[u32; 3]>> {
    // SAFETY: the caller's promise, handed on.
    Ok(unsafe { read_index_tuples(view, 3, name)? }.as_chunks().0.to_vec())
}

/// Reads pairs of indices, such as bones. `name` names the array in error messages.
///
/// # Errors
/// As for [`read_positions`].
///
/// # Safety
/// As for [`read_positions`], with 2 indices an element.
pub unsafe fn read_pairs(view: &IndicesView, name: &str) -> Result<Vec<[u32; 2]>> {
    // SAFETY: the caller's promise, handed on.
    Ok(unsafe { read_index_tuples(view, 2, name)? }.as_chunks().0.to_vec())
}

/// Reads `width` indices an element, row after row: 1 for a plain list, k for the joints of k influences a vertex.
/// `name` names the array in error messages.
///
/// # Errors
/// As for [`read_positions`].
///
/// # Safety
/// As for [`read_positions`], with `width` indices an element.
pub unsafe fn read_indices(view: &IndicesView, width: usize, name: &str) -> Result<Vec<u32>> {
    // SAFETY: the caller's promise, handed on.
    unsafe { read_index_tuples(view, width, name) }
}

/// Writes `positions` from the view's first element on, rounding each coordinate to the nearest number that the view's
/// component can hold. Bytes between elements are left as they are. `name` names the array in error messages.
///
/// # Errors
/// [`ErrorKind::InvalidArgument`], and nothing is written: as for [`read_positions`], the capacity is smaller than
/// the number of positions, or a coordinate is too large for 32 bits.
///
/// # Safety
/// Where `view.data` is not null, the `view.capacity` elements that it describes must be writable memory that nobody
/// else accesses during the call.
pub unsafe fn write_positions(view: &PositionsViewMut, positions: &[DVec3], name: &str) -> Result<()> {
    // SAFETY: the caller's promise, handed on with 3 numbers an element.
    unsafe { write_floats(view, positions.iter().map(DVec3::to_array), "position", name) }
}

/// Writes one number an element, otherwise as [`write_positions`].
///
/// # Errors
/// As for [`write_positions`].
///
/// # Safety
/// As for [`write_positions`].
pub unsafe fn write_scalars(view: &PositionsViewMut, values: &[f64], name: &str) -> Result<()> {
    // SAFETY: the caller's promise, handed on with one number an element.
    unsafe { write_floats(view, values.iter().map(|&value| [value]), "number", name) }
}

/// Writes four numbers an element, otherwise as [`write_positions`].
///
/// # Errors
/// As for [`write_positions`].
///
/// # Safety
/// As for [`write_positions`].
pub unsafe fn write_quadruples(view: &PositionsViewMut, values: &[DVec4], name: &str) -> Result<()> {
    // SAFETY: the caller's promise, handed on with four numbers an element.
    unsafe { write_floats(view, values.iter().map(DVec4::to_array), "element", name) }
}

/// # Safety
/// As for [`write_positions`], with `N` numbers an element.
unsafe fn write_floats<const N: usize>(
    view: &PositionsViewMut,
    elements: impl ExactSizeIterator<Item = [f64; N]> + Clone,
    noun: &str,
    name: &str,
) -> Result<()> {
    let count = elements.len();
    let size = view.component.size();
    if view.capacity < count {
        return invalid(format!("{name}: the capacity is {} but there are {count} {noun}s", view.capacity));
    }
    let stride = check_layout(view.data.is_null(), count, view.stride, N, size, name)?;
    let too_large =
        |element: &[f64; N]| element.iter().all(|v| v.is_finite()) && element.iter().any(|&v| !(v as f32).is_finite());
    if view.component == Component::F32
        && let Some((i, element)) = elements.clone().enumerate().find(|(_, element)| too_large(element))
    {
        return invalid(format!("{name}: {noun} {i} is {element:?}, too large for 32-bit numbers"));
    }
    for (i, element) in elements.enumerate() {
        for (k, value) in element.into_iter().enumerate() {
            // SAFETY: element i < count <= capacity is inside the caller's array (the caller's promise), and
            // `check_layout` has made sure that the offset neither overflows nor passes isize::MAX.
            let address = unsafe { view.data.cast::<u8>().add(i * stride + k * size) };
            match view.component {
                // SAFETY: the 4 bytes of this number are writable, by the same promise.
                Component::F32 => unsafe { address.cast::<f32>().write_unaligned(value as f32) },
                // SAFETY: the 8 bytes of this number are writable, by the same promise.
                Component::F64 => unsafe { address.cast::<f64>().write_unaligned(value) },
            }
        }
    }
    Ok(())
}
