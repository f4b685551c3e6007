//! Strided memory of the caller.

use std::ffi::c_void;

use bespoke::error::{ErrorKind, Result};
use bespoke::input::buffer::*;
use glam::DVec3;

/// A view of `bytes` from `offset` on; `count` elements must be within.
fn view<C>(bytes: &[u8], offset: usize, count: usize, stride: usize, component: C) -> View<C> {
    View { data: bytes[offset..].as_ptr().cast(), count, stride, component }
}

fn message<T: std::fmt::Debug>(result: Result<T>) -> String {
    let error = result.unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument);
    error.message
}

#[test]
fn packed_strided_and_unaligned_positions() {
    let expected = [DVec3::new(1.5, -2.0, 3.25), DVec3::new(0.5, 0.0625, -1e6)];
    for (offset, stride) in [(0, 0), (0, 12), (1, 0), (3, 29)] {
        let step = if stride == 0 { 12 } else { stride };
        let mut bytes = vec![0xAA; offset + 2 * step + 12];
        for (i, p) in expected.iter().enumerate() {
            for k in 0..3 {
                let at = offset + i * step + 4 * k;
                bytes[at..at + 4].copy_from_slice(&(p[k] as f32).to_ne_bytes());
            }
        }
        // SAFETY: two positions of `step` bytes are inside `bytes`.
        let read = unsafe { read_positions(&view(&bytes, offset, 2, stride, Component::F32), "garment positions") };
        assert_eq!(read.unwrap(), expected);
    }
}

#[test]
fn scalars_rows_and_indices() {
    let numbers: Vec<u8> = (0..12).flat_map(|i| f64::from(i).to_ne_bytes()).collect();
    let shorts: Vec<u8> = (0..12u16).flat_map(|i| (i + 65520).to_ne_bytes()).collect();
    let words: Vec<u8> = (0..12u32).flat_map(|i| (i + 70000).to_ne_bytes()).collect();
    // SAFETY: every view below stays inside the 12 numbers of its array.
    unsafe {
        let every_third = view(&numbers, 8, 4, 24, Component::F64);
        assert_eq!(read_scalars(&every_third, "weights").unwrap(), [1.0, 4.0, 7.0, 10.0]);
        let rows = view(&numbers, 0, 3, 32, Component::F64);
        assert_eq!(read_rows(&rows, 2, "weights").unwrap(), [0.0, 1.0, 4.0, 5.0, 8.0, 9.0]);
        let triangles = view(&shorts, 0, 4, 0, IndexComponent::U16);
        assert_eq!(read_triangles(&triangles, "triangles").unwrap()[3], [65529, 65530, 65531]);
        let pairs = view(&words, 4, 3, 16, IndexComponent::U32);
        assert_eq!(read_pairs(&pairs, "bones").unwrap(), [[70001, 70002], [70005, 70006], [70009, 70010]]);
        let list = view(&words, 0, 12, 0, IndexComponent::U32);
        assert_eq!(read_indices(&list, 1, "list").unwrap()[11], 70011);
        assert_eq!(read_indices(&view(&words, 0, 3, 0, IndexComponent::U32), 4, "list").unwrap().len(), 12);
    }
}

#[test]
fn unusable_views_are_named() {
    let bytes = [0u8; 64];
    let null = |count| View { data: std::ptr::null::<c_void>(), count, stride: 0, component: Component::F32 };
    // SAFETY: each of these is refused before anything is read, or is empty.
    unsafe {
        let read = |v: View<Component>| read_positions(&v, "garment positions");
        assert_eq!(message(read(null(3112))), "garment positions: the pointer is null but the count is 3112");
        assert_eq!(read(null(0)).unwrap(), []);
        assert_eq!(read_rows(&null(9), 0, "weights").unwrap(), [0.0; 0]);
        assert_eq!(
            message(read(view(&bytes, 0, 2, 8, Component::F32))),
            "garment positions: the stride is 8 bytes but an element takes 12"
        );
        let far = message(read(view(&bytes, 0, 3, usize::MAX / 2, Component::F64)));
        assert!(far.contains("are larger than memory"), "{far}");
        let many = message(read(view(&bytes, 0, u32::MAX as usize + 1, 0, Component::F64)));
        assert_eq!(many, "garment positions: the count is 4294967296, at most 4294967295 can be used");
        let wide = message(read_rows(&view(&bytes, 0, 2, 0, Component::F64), usize::MAX / 4, "weights"));
        assert!(wide.contains("larger than memory"), "{wide}");
        let indices = view(&bytes, 0, 2, 4, IndexComponent::U16);
        assert!(message(read_triangles(&indices, "triangles")).starts_with("triangles: the stride is 4"));
    }
}

#[test]
fn writing_leaves_the_rest_alone() {
    let positions = [DVec3::new(0.1, 2.0, -3.0), DVec3::new(4.0, 5.0, 1e-20)];
    for (component, size, offset, stride) in
        [(Component::F32, 4, 0, 0), (Component::F32, 4, 1, 17), (Component::F64, 8, 0, 0), (Component::F64, 8, 5, 40)]
    {
        let step = if stride == 0 { 3 * size } else { stride };
        let mut bytes = vec![0xAA; offset + 3 * step];
        let data = bytes[offset..].as_mut_ptr().cast();
        let target = PositionsViewMut { data, capacity: 3, stride, component };
        // SAFETY: three positions of `step` bytes fit in `bytes` behind the offset.
        unsafe { write_positions(&target, &positions, "result").unwrap() };
        // SAFETY: as above.
        let read = unsafe { read_positions(&view(&bytes, offset, 2, stride, component), "result").unwrap() };
        let rounded = |p: DVec3| if component == Component::F32 { p.as_vec3().as_dvec3() } else { p };
        assert_eq!(read, positions.map(rounded));
        let written = |b: usize| b >= offset && (b - offset) / step < 2 && (b - offset) % step < 3 * size;
        assert!((0..bytes.len()).all(|b| written(b) || bytes[b] == 0xAA));
    }
}

#[test]
fn writing_refuses_before_it_writes() {
    let mut bytes = [0xAAu8; 48];
    let data = bytes.as_mut_ptr().cast();
    let target = |capacity, stride, component| PositionsViewMut { data, capacity, stride, component };
    let positions = [DVec3::ONE, DVec3::new(1.0, 1e39, 1.0)];
    // SAFETY: two positions of 64-bit coordinates fit in 48 bytes; the other calls are refused before writing.
    unsafe {
        let write = |t: PositionsViewMut| message(write_positions(&t, &positions, "result"));
        assert_eq!(write(target(1, 0, Component::F64)), "result: the capacity is 1 but there are 2 positions");
        assert!(write(target(2, 0, Component::F32)).starts_with("result: position 1 is"));
        assert!(write(target(2, 20, Component::F64)).starts_with("result: the stride is 20"));
        let null = PositionsViewMut { data: std::ptr::null_mut(), ..target(2, 0, Component::F64) };
        assert_eq!(write(null), "result: the pointer is null but the count is 2");
        assert_eq!(bytes, [0xAA; 48]);
        write_positions(&target(2, 0, Component::F64), &positions, "result").unwrap();
        write_positions(&PositionsViewMut { capacity: 0, ..null }, &[], "result").unwrap();
    }
}
