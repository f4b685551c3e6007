//! Names that the glossary has retired, in the sources.

use std::fs;
use std::path::Path;

use crate::{files, read, root};

/// The words of a name or of a text, with their lines: `SetSourceSpace`, `SOURCE_SPACE` and "source space" hold the same two in
/// a row, but for their letters' case.
fn words(text: &str) -> Vec<(String, usize)> {
    let mut words: Vec<(String, usize)> = Vec::new();
    let mut before = ' ';
    for (line, text) in (1..).zip(text.lines()) {
        for c in text.chars() {
            let begins = !before.is_alphanumeric() || (c.is_uppercase() && before.is_lowercase());
            if c.is_alphanumeric() {
                if begins {
                    words.push((String::new(), line));
                }
                words.last_mut().expect("a word has begun").0.push(c);
            }
            before = c;
        }
        before = ' ';
    }
    words
}

/// The first column of the glossary's table of retired names.
fn retired(glossary: &str) -> Vec<String> {
    let (_, section) = glossary.split_once("## Retired names\n").expect("the glossary has retired names");
    let section = section.split("\n## ").next().unwrap_or_default();
    let rows =
        section.lines().filter_map(|line| line.strip_prefix('|')).map(|row| row.split('|').next().unwrap_or_default());
    // Code is between every other pair of marks.
    rows.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(String::from).collect()
}

/// Where `text` holds one of `names`, in any case of letters: line and name. A single word with a capital, such as `Finding`, is
/// a type and meant as it is written: "finding" may be a verb.
fn uses<'a>(text: &str, names: &'a [String]) -> Vec<(usize, &'a str)> {
    let text = words(text);
    let mut found = Vec::new();
    for name in names {
        let wanted = words(name);
        let is_type = wanted.len() == 1 && name.starts_with(char::is_uppercase);
        let same = |a: &str, b: &str| if is_type { a == b } else { a.eq_ignore_ascii_case(b) };
        let hits =
            text.windows(wanted.len()).filter(|window| window.iter().zip(&wanted).all(|(a, b)| same(&a.0, &b.0)));
        found.extend(hits.map(|window| (window[0].1, name.as_str())));
    }
    found.sort_unstable();
    found
}

#[test]
fn retired_names_are_not_used() {
    let root = root();
    let names = retired(&read(&root.join("docs/glossary.md")));
    assert!(names.len() > 10, "only {} retired names were found", names.len());
    let mut faults = Vec::new();
    for folder in ["src", "include", "bindings"] {
        let is_text = |path: &Path| fs::read(path).is_ok_and(|bytes| std::str::from_utf8(&bytes).is_ok());
        for path in files(&root.join(folder), &is_text) {
            let name = path.strip_prefix(root).expect("a file below the top").display().to_string();
            faults.extend(uses(&read(&path), &names).iter().map(|(line, used)| format!("{name}:{line}: {used}")));
        }
    }
    assert!(faults.is_empty(), "{} uses of retired names:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn retired_names_are_found_in_any_spelling() {
    let names = retired(
        "## Retired names\n\nText with `code`.\n\n| retired | write |\n| --- | --- |\n| `source_space`, `let off`, `Finding` | `x` |\n\n## More\n\n| `y` |\n",
    );
    assert_eq!(names, ["source_space", "let off", "Finding"]);
    let text = "session.SetSourceSpace(s);\nSOURCE_SPACE source_spaces outsource_space\n/// the source\n/// space, let\toff\n\
                finding FindingKind";
    let found = uses(text, &names);
    assert_eq!(found, [(1, "source_space"), (2, "source_space"), (3, "source_space"), (4, "let off"), (5, "Finding")]);
}
