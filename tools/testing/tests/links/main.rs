//! The project's texts: links lead somewhere, paths that are named exist, and retired names stay retired.
//!
//! Nothing here needs a network: links to other places are not followed.

mod retired;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use testing::process::root;

/// Folders that hold nothing of the project's own.
const FOREIGN: [&str; 5] = [".git", "target", "build", "node_modules", "artifacts"];

/// All files below `folder` that `wanted` takes, in a fixed order.
fn files(folder: &Path, wanted: &dyn Fn(&Path) -> bool) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let entries = fs::read_dir(folder).unwrap_or_else(|reason| panic!("{}: {reason}", folder.display()));
    for path in entries.map(|entry| entry.expect("an entry of a folder").path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_symlink() || FOREIGN.contains(&name.as_str()) {
            continue;
        }
        if path.is_dir() {
            found.extend(files(&path, wanted));
        } else if wanted(&path) {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|reason| panic!("{}: {reason}", path.display()))
}

/// Something at a place of a text.
struct Found {
    text: String,
    line: usize,
}

/// What matters of a text in Markdown.
#[derive(Default)]
struct Page {
    /// Anchors of its headings.
    anchors: BTreeSet<String>,
    /// Targets of links and images.
    links: Vec<Found>,
    /// Inline code.
    code: Vec<Found>,
    /// HTML, in which links would not be seen.
    html: Vec<Found>,
}

impl Page {
    fn new(text: &str) -> Self {
        let mut page = Self::default();
        let mut heading: Option<String> = None;
        let mut slugs = BTreeMap::new();
        let options = Options::ENABLE_TABLES | Options::ENABLE_GFM | Options::ENABLE_STRIKETHROUGH;
        for (event, range) in Parser::new_ext(text, options).into_offset_iter() {
            let found = |what: &str| Found { text: what.into(), line: 1 + text[..range.start].matches('\n').count() };
            match event {
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => {
                    let slug = slug(&heading.take().unwrap_or_default());
                    let count: &mut u32 = slugs.entry(slug.clone()).or_default();
                    page.anchors.insert(if *count == 0 { slug } else { format!("{slug}-{count}") });
                    *count += 1;
                }
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    page.links.push(found(&dest_url))
                }
                Event::Text(words) => heading.iter_mut().for_each(|heading| heading.push_str(&words)),
                Event::Code(words) => {
                    heading.iter_mut().for_each(|heading| heading.push_str(&words));
                    page.code.push(found(&words));
                }
                Event::Html(html) | Event::InlineHtml(html) => page.html.push(found(&html)),
                _ => {}
            }
        }
        page
    }
}

/// The anchor that GitHub gives a heading: lower case, no punctuation, a hyphen for each space.
fn slug(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).flat_map(char::to_lowercase).collect()
}

/// `path` without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut plain, part| {
        match part {
            Component::ParentDir => drop(plain.pop()),
            Component::CurDir => {}
            part => plain.push(part),
        }
        plain
    })
}

/// All texts, by their path from the top.
fn pages() -> BTreeMap<PathBuf, Page> {
    let root = root();
    let found = files(root, &|path| path.extension().is_some_and(|extension| extension == "md"));
    let pages = found.iter().map(|path| {
        let name = path.strip_prefix(root).expect("a file below the top").to_path_buf();
        (name, Page::new(&read(path)))
    });
    pages.collect()
}

/// Why `link` on the page `from` leads nowhere.
fn fault(pages: &BTreeMap<PathBuf, Page>, from: &Path, link: &str) -> Option<String> {
    if link.starts_with("https://") || link.starts_with("http://") || link.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = link.split_once('#').map_or((link, None), |(path, anchor)| (path, Some(anchor)));
    let target = match path {
        "" => from.to_path_buf(),
        _ => plain(&from.parent().unwrap_or(Path::new("")).join(path)),
    };
    if path.starts_with('/') || !root().join(&target).exists() {
        return Some(format!("there is no {}", target.display()));
    }
    let anchor = anchor?;
    match pages.get(&target) {
        Some(page) if page.anchors.contains(anchor) => None,
        Some(_) => Some(format!("{} has no heading #{anchor}", target.display())),
        None => Some(format!("{} is no text with headings", target.display())),
    }
}

#[test]
fn links_lead_somewhere() {
    let pages = pages();
    let mut faults = Vec::new();
    for (name, page) in &pages {
        for link in &page.links {
            if let Some(fault) = fault(&pages, name, &link.text) {
                faults.push(format!("{}:{}: {}: {fault}", name.display(), link.line, link.text));
            }
        }
        for html in page.html.iter().filter(|html| html.text.contains("href=") || html.text.contains("src=")) {
            faults.push(format!("{}:{}: a link in HTML is not checked, write Markdown", name.display(), html.line));
        }
    }
    let count: usize = pages.values().map(|page| page.links.len()).sum();
    assert!(count > 50, "only {count} links were found");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Inline code that begins with a folder of the project is the path of something that exists.
#[test]
fn paths_in_texts_exist() {
    const FOLDERS: [&str; 11] = [
        "benches/",
        "bindings/",
        "cpp_shim/",
        "docs/",
        "examples_c/",
        "include/",
        "packaging/",
        "src/",
        "tests/",
        "tools/",
        ".ci/",
    ];
    let is_path = |code: &str| {
        FOLDERS.iter().any(|folder| code.starts_with(folder))
            && !code.contains(|c: char| c.is_whitespace() || "<>*{}".contains(c))
    };
    let root = root();
    let mut faults = Vec::new();
    for (name, page) in &pages() {
        for code in page.code.iter().filter(|code| is_path(&code.text) && !root.join(&code.text).exists()) {
            faults.push(format!("{}:{}: there is no {}", name.display(), code.line, code.text));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn anchors_are_those_of_github() {
    for (heading, expected) in [
        ("What goes in, and what is done with bad input", "what-goes-in-and-what-is-done-with-bad-input"),
        ("  `make install`", "make-install"),
        ("Why a script, and not cargo-c", "why-a-script-and-not-cargo-c"),
        ("C & C++", "c--c"),
        ("min_separation", "min_separation"),
    ] {
        let page = Page::new(&format!("# {heading}\n"));
        assert_eq!(page.anchors.into_iter().collect::<Vec<_>>(), [expected]);
    }
    let twice = Page::new("# Same\n\n## Same\n");
    assert_eq!(twice.anchors.into_iter().collect::<Vec<_>>(), ["same", "same-1"]);
}

#[test]
fn links_that_lead_nowhere_are_found() {
    let page = || Page::new("# A\n\n[b](docs/b.md#c) ![d](d.png) [e](#a) [f](https://example.org/g) <!-- src= -->\n");
    let links: Vec<_> = page().links.into_iter().map(|link| link.text).collect();
    assert_eq!(links, ["docs/b.md#c", "d.png", "#a", "https://example.org/g"]);
    let here = PathBuf::from("README.md");
    let pages = BTreeMap::from([(here.clone(), page())]);
    let faults: Vec<_> = links.iter().map(|link| fault(&pages, &here, link).is_some()).collect();
    assert_eq!(faults, [true, true, false, false]);
}
