//! Writes a changed JSON value over its old text: what has not changed stays as it was, character by character.

use serde_json::{Map, Value};

/// The text of `new`, where `text` is that of `old`.
pub(crate) fn update(text: &str, old: &Value, new: &Value) -> String {
    let start = text.len() - text.trim_start_matches(is_space).len();
    let end = value_end(text.as_bytes(), start);
    let mut out = text[..start].to_owned();
    write(&mut out, &text[start..end], old, new);
    out + &text[end..]
}

fn is_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r')
}

fn skip_space(text: &[u8], at: usize) -> usize {
    at + text[at..].iter().take_while(|b| matches!(b, b' ' | b'\t' | b'\n' | b'\r')).count()
}

/// The place after the string that begins at `at`.
fn string_end(text: &[u8], at: usize) -> usize {
    let mut k = at + 1;
    while k < text.len() && text[k] != b'"' {
        k += if text[k] == b'\\' { 2 } else { 1 };
    }
    (k + 1).min(text.len())
}

/// The place after the value that begins at `at`. The text is known to be JSON.
fn value_end(text: &[u8], at: usize) -> usize {
    let (mut k, mut depth) = (at, 0);
    while k < text.len() {
        match text[k] {
            b'"' => k = string_end(text, k) - 1,
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth -= 1,
            _ if depth == 0 => {
                let ends = |b: &u8| matches!(b, b',' | b'}' | b']' | b' ' | b'\t' | b'\n' | b'\r');
                return k + text[k..].iter().position(ends).unwrap_or(text.len() - k);
            }
            _ => {}
        }
        k += 1;
        if depth == 0 {
            break;
        }
    }
    k
}

/// An entry of an object or array: its key with all until the value (empty in an array), and its value.
struct Entry<'a> {
    key: Option<String>,
    head: &'a str,
    value: &'a str,
    /// What stands before the entry, after the bracket or comma.
    before: &'a str,
}

/// The entries between the brackets of `text`, and the space before the last bracket.
fn entries(text: &str) -> (Vec<Entry<'_>>, &str) {
    let bytes = text.as_bytes();
    let is_object = bytes[0] == b'{';
    let (mut found, mut at) = (Vec::new(), 1);
    loop {
        let start = skip_space(bytes, at);
        if start >= bytes.len() || matches!(bytes[start], b'}' | b']') {
            return (found, &text[at..start]);
        }
        let mut value = start;
        let mut key = None;
        if is_object {
            let end = string_end(bytes, start);
            key = serde_json::from_str(&text[start..end]).ok();
            let colon = skip_space(bytes, end);
            value = skip_space(bytes, (colon + 1).min(bytes.len()));
        }
        let end = value_end(bytes, value);
        found.push(Entry { key, head: &text[start..value], value: &text[value..end], before: &text[at..start] });
        let next = skip_space(bytes, end);
        if bytes.get(next) != Some(&b',') {
            return (found, &text[end..next.min(text.len())]);
        }
        at = next + 1;
    }
}

fn write(out: &mut String, text: &str, old: &Value, new: &Value) {
    match (old, new) {
        (old, new) if old == new => out.push_str(text),
        (Value::Object(old), Value::Object(new)) => write_object(out, text, old, new),
        (Value::Array(old), Value::Array(new)) => {
            let (entries, last) = entries(text);
            let apart = entries.get(1).or(entries.first()).map_or("", |entry| entry.before);
            out.push('[');
            for (k, value) in new.iter().enumerate() {
                out.push_str(if k == 0 { "" } else { "," });
                match (entries.get(k), old.get(k)) {
                    (Some(entry), Some(old)) => {
                        out.push_str(entry.before);
                        write(out, entry.value, old, value);
                    }
                    _ => {
                        out.push_str(apart);
                        out.push_str(&value.to_string());
                    }
                }
            }
            out.push_str(last);
            out.push(']');
        }
        (_, new) => out.push_str(&new.to_string()),
    }
}

fn write_object(out: &mut String, text: &str, old: &Map<String, Value>, new: &Map<String, Value>) {
    let (entries, last) = entries(text);
    let apart = entries.get(1).or(entries.first()).map_or("", |entry| entry.before);
    let mut first = true;
    let mut comma = |out: &mut String| {
        out.push_str(if std::mem::replace(&mut first, false) { "" } else { "," });
    };
    // Of a key that stands there twice, the last is the one that counts.
    let mut counts = std::collections::HashMap::new();
    for (k, entry) in entries.iter().enumerate() {
        counts.insert(entry.key.as_deref(), k);
    }
    out.push('{');
    for (k, entry) in entries.iter().enumerate() {
        let Some(key) = entry.key.as_deref() else { continue };
        let (Some(old), Some(new)) = (old.get(key), new.get(key)) else { continue };
        comma(out);
        out.push_str(entry.before);
        out.push_str(entry.head);
        if counts[&Some(key)] == k {
            write(out, entry.value, old, new);
        } else {
            out.push_str(entry.value);
        }
    }
    for (key, value) in new.iter().filter(|(key, _)| !old.contains_key(*key)) {
        comma(out);
        out.push_str(apart);
        out.push_str(&format!("{}:{value}", Value::from(key.as_str())));
    }
    out.push_str(last);
    out.push('}');
}
