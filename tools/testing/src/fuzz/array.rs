//! Arrays as a caller of the C API has them: exactly as many bytes as the view says, at an odd address.

use std::ffi::c_void;

use bespoke::capi::view::{BespokeComponent, BespokeView};

/// Elements in memory of their own.
pub struct Array {
    /// One byte, then the elements: a read beyond them leaves the allocation, which the sanitizer sees.
    bytes: Vec<u8>,
    count: usize,
    stride: usize,
    component: u32,
}

/// Bytes of one number.
pub fn size_of_component(component: u32) -> Option<usize> {
    match component {
        c if c == BespokeComponent::F32 as u32 || c == BespokeComponent::U32 as u32 => Some(4),
        c if c == BespokeComponent::F64 as u32 => Some(8),
        c if c == BespokeComponent::U16 as u32 => Some(2),
        _ => None,
    }
}

impl Array {
    /// `elements` numbers of `width` each, each number by `write`, which gives its bytes.
    fn of<T: Copy, const N: usize>(
        numbers: &[T],
        width: usize,
        padding: usize,
        component: BespokeComponent,
        write: impl Fn(T) -> [u8; N],
    ) -> Self {
        let count = numbers.len().checked_div(width).unwrap_or(0);
        let mut bytes = vec![0xA5];
        for (k, element) in numbers.chunks_exact(width.max(1)).enumerate() {
            if k > 0 {
                bytes.resize(bytes.len() + padding, 0xA5);
            }
            element.iter().for_each(|&number| bytes.extend(write(number)));
        }
        bytes.shrink_to_fit();
        let stride = if padding == 0 { 0 } else { width * N + padding };
        Self { bytes, count, stride, component: component as u32 }
    }

    /// Elements of `width` floating-point numbers with `padding` bytes between them.
    pub fn floats(numbers: &[f64], width: usize, padding: usize, is_double: bool) -> Self {
        if is_double {
            Self::of(numbers, width, padding, BespokeComponent::F64, f64::to_le_bytes)
        } else {
            Self::of(numbers, width, padding, BespokeComponent::F32, |x| (x as f32).to_le_bytes())
        }
    }

    /// Elements of `width` indices with `padding` bytes between them.
    pub fn indices(numbers: &[u32], width: usize, padding: usize, is_short: bool) -> Self {
        if is_short {
            Self::of(numbers, width, padding, BespokeComponent::U16, |x| (x as u16).to_le_bytes())
        } else {
            Self::of(numbers, width, padding, BespokeComponent::U32, u32::to_le_bytes)
        }
    }

    /// What the C API is told.
    pub fn view(&self) -> BespokeView {
        let data = self.bytes[1..].as_ptr().cast::<c_void>();
        BespokeView { data, count: self.count, stride: self.stride, component: self.component }
    }
}
