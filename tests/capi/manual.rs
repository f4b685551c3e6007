//! The committed header as a manual: nothing in it is without a comment, and no function without what its callers ask.

use std::fs;

use testing::process::root;

/// One documented thing of the header: the comment above it, without its marks, and its text up to `;`, `,` or the end of
/// the line.
struct Entry {
    comment: String,
    text: String,
}

fn header() -> String {
    let path = root().join("include/bespoke.h");
    fs::read_to_string(path).expect("include/bespoke.h is committed")
}

/// Everything that a program can name: `#define`s with a value, structs, enums, their fields and numbers, functions.
fn entries(header: &str) -> Vec<Entry> {
    let mut entries = Vec::new();
    let mut comment = String::new();
    let mut lines = header.lines();
    while let Some(line) = lines.next() {
        let line = line.trim();
        if let Some(words) = line.strip_prefix("///") {
            comment.push_str(words.trim());
            comment.push(' ');
            continue;
        }
        let is_guard =
            line.starts_with("//") || line.starts_with("#if") || line.starts_with("#e") || line.starts_with("#include");
        let is_type = line.starts_with("typedef struct") || line.starts_with("enum ");
        let is_define = line.starts_with("#define") && line != "#define BESPOKE_H";
        let is_member = line.ends_with(';') && !line.starts_with('}') && !line.starts_with("typedef")
            || line.ends_with(',') && line.starts_with("BESPOKE_") && line.contains(" = ");
        let is_function = line.contains(" *bespoke_") || line.contains(" bespoke_");
        if is_guard || !(is_type || is_define || is_member || is_function) {
            // An enum is followed by the guards of its type; whatever else stands between ends a comment.
            comment.clear();
            continue;
        }
        let mut text = line.to_string();
        while is_function && !text.ends_with(';') {
            text.push(' ');
            text.push_str(lines.next().expect("a declaration ends").trim());
        }
        entries.push(Entry { comment: std::mem::take(&mut comment), text });
    }
    entries
}

#[test]
fn every_function_field_and_constant_has_a_comment() {
    let header = header();
    let entries = entries(&header);
    for entry in &entries {
        assert!(!entry.comment.trim().is_empty(), "{} has no comment", entry.text);
    }
    // Nothing was overlooked: as many entries as other ways of counting find.
    let count = |found: fn(&str) -> bool| header.lines().filter(|line| found(line.trim())).count();
    let functions = entries.iter().filter(|entry| entry.text.contains('(')).count();
    let layout = fs::read_to_string(root().join("tests/capi/layout.inc")).expect("the layout is committed");
    let pinned = |mark: &str| layout.lines().filter(|line| line.starts_with(mark)).count();
    assert_eq!(functions, count(|line| line.contains("bespoke_") && line.contains('(') && !line.starts_with('/')));
    let enums = count(|line| line.starts_with("enum "));
    let opaque = count(|line| line.starts_with("typedef struct") && line.ends_with(';'));
    // The number that is not whole is BESPOKE_WEIGHT_OFF.
    let all = functions + pinned("STRUCT(") + pinned("FIELD(") + pinned("VALUE(") + enums + opaque + 1;
    assert_eq!(entries.len(), all, "something of the header is not in tests/capi/layout.inc, or the other way round");
}

/// The comment of a function, with those of the functions that it refers to for the rest.
fn with_references(entry: &Entry, entries: &[Entry]) -> String {
    let named = ["as for ", "The same as "]
        .iter()
        .flat_map(|lead| entry.comment.match_indices(lead).map(|(at, lead)| at + lead.len()));
    named.fold(entry.comment.clone(), |all, at| {
        let name: String = entry.comment[at..].chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
        match entries.iter().find(|other| other.text.contains(&format!("{name}("))) {
            Some(other) => format!("{all} {}", with_references(other, entries)),
            None => all,
        }
    })
}

#[test]
fn every_function_says_what_its_callers_ask() {
    let header = header();
    let entries = entries(&header);
    let functions: Vec<_> = entries.iter().filter(|entry| entry.text.contains('(')).collect();
    assert!(functions.len() > 30, "only {} functions were found", functions.len());
    for entry in functions {
        let (comment, text) = (with_references(entry, &entries), &entry.text);
        let says = |topic: &str| comment.contains(&format!("{topic}:"));
        assert!(says("Threads"), "{text} does not say which threads may call it");
        assert!(says("Errors") || !text.starts_with("BespokeStatus"), "{text} does not list its errors");
        assert!(
            says("State") || !text.contains("BespokeSession *session"),
            "{text} does not say in which states it may be called"
        );
        assert!(
            says("Ownership") || !text.contains("struct BespokeView *"),
            "{text} does not say who owns what it is given"
        );
        // All else that is handed over is described: a handle and a struct speak for themselves.
        let parameters = text.split_once('(').expect("a function").1.trim_end_matches(");");
        for parameter in parameters.split(',').map(str::trim).filter(|parameter| *parameter != "void") {
            let (kind, name) = parameter.rsplit_once([' ', '*']).expect("a type and a name");
            let is_described = kind.starts_with("struct Bespoke") || kind.starts_with("const struct Bespoke");
            let is_view = kind.contains("BespokeView") || kind.contains("BespokeBuffer");
            let is_named = comment.contains(&format!("`{name}`")) || comment.contains(&format!("`*{name}`"));
            assert!(is_named || is_described && !is_view, "{text} does not explain `{name}`");
        }
    }
}
