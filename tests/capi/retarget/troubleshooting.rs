//! docs/troubleshooting.md has every status, and what it quotes is what library and program say.

use std::fs;
use std::path::Path;

use super::root;

fn page() -> String {
    fs::read_to_string(root().join("docs/troubleshooting.md")).expect("the page is there")
}

/// All sources of a folder in one text, strings that go on in the next line joined.
fn sources(folder: &Path, text: &mut String) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, text);
        } else if path.extension().is_some_and(|end| end == "rs" || end == "c") {
            let source = fs::read_to_string(&path).expect("a source is text");
            for line in source.lines() {
                match line.trim().strip_suffix('\\') {
                    Some(begun) => text.push_str(begun),
                    None => *text += &format!("{}\n", line.trim()),
                }
            }
        }
    }
}

#[test]
fn every_status_has_a_chapter_with_three_remedies() {
    let header = fs::read_to_string(root().join("include/bespoke.h")).expect("the header is committed");
    let statuses: Vec<&str> = header
        .lines()
        .filter_map(|line| line.trim().strip_prefix("BESPOKE_STATUS_")?.split_once(" = "))
        .map(|(name, _)| name)
        .filter(|name| *name != "OK")
        .collect();
    assert!(statuses.len() >= 13, "{statuses:?}");
    let page = page();
    for status in statuses {
        let (_, chapter) =
            page.split_once(&format!("## BESPOKE_STATUS_{status}\n")).unwrap_or_else(|| panic!("no chapter {status}"));
        let (chapter, _) = chapter.split_once("\n## ").expect("another chapter follows");
        assert!(chapter.contains("See where: "), "{status}: where?");
        for number in ["\n1. ", "\n2. ", "\n3. "] {
            assert!(chapter.contains(number), "{status}: no remedy {number}");
        }
    }
}

#[test]
fn quoted_messages_are_those_of_the_sources() {
    let mut text = String::new();
    sources(&root().join("src"), &mut text);
    sources(&root().join("examples_c"), &mut text);
    let page = page();
    let quotes: Vec<&str> =
        page.lines().filter_map(|line| line.strip_prefix("> `").and_then(|line| line.strip_suffix('`'))).collect();
    assert!(quotes.len() > 20, "{quotes:?}");
    for quote in quotes {
        for words in quote.split("...").map(str::trim).filter(|words| !words.is_empty()) {
            assert!(text.contains(words), "nothing says \"{words}\", which is quoted in \"{quote}\"");
        }
    }
}
