//! Messages in buffers of a fixed size.

/// The longest beginning of `text` that is whole characters and at most `bytes` long.
pub(super) fn cut(text: &str, bytes: usize) -> &str {
    let mut end = text.len().min(bytes);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}
