//! Views of the caller's memory.

use std::ffi::c_void;

use crate::error::{Error, ErrorKind, Result};
use crate::input::buffer::{Component, IndexComponent, IndicesView, PositionsView, PositionsViewMut};
use crate::session::Precision;

/// How one number of an array is stored. 0 is none of them, so that a forgotten field is noticed.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeComponent {
    /// float
    F32 = 1,
    /// double
    F64 = 2,
    /// uint16_t
    U16 = 3,
    /// uint32_t
    U32 = 4,
}

/// An array of the caller that is read during a call and never kept. Alignment does not matter.
///
/// An element is what the parameter is said to hold: a point (x, y, z), a triangle (three vertices, from 0), a bone
/// (two joints, from 0), a number.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BespokeView {
    /// The first element. May be null where `count` is 0.
    pub data: *const c_void,
    /// Elements.
    pub count: usize,
    /// Bytes from one element to the next; 0: they are packed.
    pub stride: usize,
    /// One of BespokeComponent.
    pub component: u32,
}

/// An array of the caller that points, or what else the parameter is said to hold, are written to. Bytes between them stay
/// as they are.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BespokeBuffer {
    /// The first element. May be null where `capacity` is 0.
    pub data: *mut c_void,
    /// Elements that fit.
    pub capacity: usize,
    /// Bytes from one element to the next; 0: they are packed.
    pub stride: usize,
    /// BESPOKE_COMPONENT_F32 or BESPOKE_COMPONENT_F64.
    pub component: u32,
}

pub(super) fn invalid<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidArgument, message))
}

fn float_component(component: u32, name: &str) -> Result<Component> {
    match component {
        c if c == BespokeComponent::F32 as u32 => Ok(Component::F32),
        c if c == BespokeComponent::F64 as u32 => Ok(Component::F64),
        c => invalid(format!("{name}: the component is {c}; it must be BESPOKE_COMPONENT_F32 or _F64")),
    }
}

fn index_component(component: u32, name: &str) -> Result<IndexComponent> {
    match component {
        c if c == BespokeComponent::U16 as u32 => Ok(IndexComponent::U16),
        c if c == BespokeComponent::U32 as u32 => Ok(IndexComponent::U32),
        c => invalid(format!("{name}: the component is {c}; it must be BESPOKE_COMPONENT_U16 or _U32")),
    }
}

/// The precision of points that are stored so.
pub(super) fn precision_of(component: Component) -> Precision {
    match component {
        Component::F32 => Precision::F32,
        Component::F64 => Precision::F64,
    }
}

/// The precision that a component number stands for.
pub(super) fn precision(component: u32, name: &str) -> Result<Precision> {
    float_component(component, name).map(precision_of)
}

/// # Safety
/// `view` is null or points to a `T`.
unsafe fn dereference<T: Copy>(view: *const T, name: &str) -> Result<T> {
    if view.is_null() {
        return invalid(format!("{name}: the pointer to its description is null"));
    }
    // SAFETY: not null, and the caller vouches for a `T` behind it.
    Ok(unsafe { view.read_unaligned() })
}

/// # Safety
/// `view` is null or points to a view.
pub(super) unsafe fn floats(view: *const BespokeView, name: &str) -> Result<PositionsView> {
    // SAFETY: passed on from the caller.
    let BespokeView { data, count, stride, component } = unsafe { dereference(view, name)? };
    Ok(PositionsView { data, count, stride, component: float_component(component, name)? })
}

/// # Safety
/// `view` is null or points to a view.
pub(super) unsafe fn indices(view: *const BespokeView, name: &str) -> Result<IndicesView> {
    // SAFETY: passed on from the caller.
    let BespokeView { data, count, stride, component } = unsafe { dereference(view, name)? };
    Ok(IndicesView { data, count, stride, component: index_component(component, name)? })
}

/// # Safety
/// `buffer` is null or points to a buffer.
pub(super) unsafe fn points_out(buffer: *const BespokeBuffer, name: &str) -> Result<PositionsViewMut> {
    // SAFETY: passed on from the caller.
    let BespokeBuffer { data, capacity, stride, component } = unsafe { dereference(buffer, name)? };
    Ok(PositionsViewMut { data, capacity, stride, component: float_component(component, name)? })
}

/// The largest index that is stored so: it stands for none.
pub(super) fn largest_index(component: IndexComponent) -> u32 {
    match component {
        IndexComponent::U16 => u32::from(u16::MAX),
        IndexComponent::U32 => u32::MAX,
    }
}
