//! The files of `src` use each other one way: no circle, and no room uses one that uses it (ARCHITECTURE.md).

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use testing::process::root;

/// A module by its path, such as `["stage", "setup", "shape"]`; the crate itself is empty.
type Module = Vec<String>;

/// What each module uses.
type Uses = BTreeMap<Module, BTreeSet<Module>>;

/// All modules below `folder`, with their files.
fn modules(folder: &Path, above: &Module, found: &mut BTreeMap<Module, PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let own = [above.as_slice(), std::slice::from_ref(&name)].concat();
        if path.is_dir() {
            modules(&path, &own, found);
        } else if name == "mod" || name == "lib" {
            found.insert(above.clone(), path);
        } else {
            found.insert(own, path);
        }
    }
}

/// The paths that a `use` declaration without `use` and `;` stands for.
fn expand(declaration: &str) -> Vec<String> {
    let Some((before, list)) = declaration.split_once('{') else { return vec![declaration.trim().to_owned()] };
    let list = list.trim().strip_suffix('}').expect("a list that ends");
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in list.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        match c {
            ',' if depth == 0 => parts.push(String::new()),
            c => parts.last_mut().expect("a part").push(c),
        }
    }
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| expand(&format!("{}{}", before.trim(), part.trim()))).collect()
}

/// The modules that the source `text` of `own` imports. What a module takes from the one that it belongs to is no use of
/// another file: `mod.rs` stands for its folder.
fn imports(text: &str, own: &Module, is_folder: bool, modules: &BTreeMap<Module, PathBuf>) -> BTreeSet<Module> {
    let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    // A declaration begins its line; "use" within a line is a word of a message.
    let begins = |line: &str| {
        let line = line.trim_start();
        ["use ", "pub use ", "pub(crate) use ", "pub(super) use "].iter().any(|word| line.starts_with(word))
    };
    let declared: Vec<String> = (0..code.len())
        .filter(|&k| begins(code[k]))
        .map(|k| code[k..].join(" "))
        .filter_map(|rest| Some(rest.split_once("use ")?.1.split_once(';')?.0.to_owned()))
        .flat_map(|declaration| expand(&declaration))
        .collect();
    let code = code.join(" ");
    let inline = code.match_indices("crate::").map(|(at, _)| {
        let path: String = code[at..].chars().take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':').collect();
        path
    });
    let mut found = BTreeSet::new();
    for path in declared.into_iter().chain(inline) {
        let mut words: Vec<String> = path.split("::").map(|word| word.trim().to_owned()).collect();
        let mut base = match words[0].as_str() {
            "crate" => Module::new(),
            "super" | "self" => own.clone(),
            word if is_folder && modules.contains_key(&[own.as_slice(), &[word.to_owned()]].concat()) => own.clone(),
            _ => continue,
        };
        while let Some("super" | "crate" | "self") = words.first().map(String::as_str) {
            if words.remove(0) == "super" {
                base.pop();
            }
        }
        base.extend(words);
        while !modules.contains_key(&base) {
            base.pop();
        }
        let is_above = own.starts_with(&base);
        if !is_above {
            found.insert(base);
        }
    }
    found
}

fn uses() -> Uses {
    let source = root().join("src");
    let mut files = BTreeMap::new();
    modules(&source, &Module::new(), &mut files);
    let of = |(module, path): (&Module, &PathBuf)| {
        let text = fs::read_to_string(path).expect("a source file");
        let is_folder = path.file_stem().is_some_and(|name| name == "mod" || name == "lib");
        (module.clone(), imports(&text, module, is_folder, &files))
    };
    let uses: Uses = files.iter().map(of).collect();
    assert!(uses.len() > 100, "only {} modules were found", uses.len());
    uses
}

/// A way from `from` to `to`, if there is one.
fn way(graph: &Uses, from: &Module, to: &Module) -> Option<Vec<Module>> {
    let mut before: BTreeMap<&Module, &Module> = BTreeMap::new();
    let mut waiting = vec![from];
    while let Some(at) = waiting.pop() {
        for next in graph.get(at).into_iter().flatten() {
            if next == to {
                let mut way = vec![to.clone(), at.clone()];
                let mut back = at;
                while back != from {
                    back = before[back];
                    way.push(back.clone());
                }
                way.reverse();
                return Some(way);
            }
            if next != from && !before.contains_key(next) {
                before.insert(next, at);
                waiting.push(next);
            }
        }
    }
    None
}

fn circles(graph: &Uses) -> Vec<String> {
    let circle = |module| way(graph, module, module);
    let name = |way: Vec<Module>| way.iter().map(|module| module.join("::")).collect::<Vec<_>>().join(" -> ");
    graph.keys().filter_map(circle).map(name).collect()
}

/// Folders are left out: what `mod.rs` declares and hands on is no import.
#[test]
fn no_files_use_each_other_in_a_circle() {
    let uses = uses();
    let is_folder = |module: &Module| uses.keys().any(|other| other.len() > module.len() && other.starts_with(module));
    let files: Uses =
        uses.iter().filter(|(module, _)| !is_folder(module)).map(|(m, u)| (m.clone(), u.clone())).collect();
    let circles = circles(&files);
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

/// The room of a module: its folder of the first level, and those two that have rooms of their own.
fn room(module: &Module) -> Module {
    let deep = matches!(module.iter().map(String::as_str).collect::<Vec<_>>()[..], ["stage", "start" | "setup", ..]);
    module[..if deep { 2 } else { 1 }].to_vec()
}

#[test]
fn no_rooms_use_each_other_in_a_circle() {
    let mut rooms = Uses::new();
    for (module, used) in uses().iter().filter(|(module, _)| !module.is_empty()) {
        let own = room(module);
        // A folder declares its rooms, which is no import.
        let others =
            used.iter().map(room).filter(|other| *other != own && !(module.len() == 1 && other.starts_with(module)));
        rooms.entry(own.clone()).or_default().extend(others);
    }
    let circles = circles(&rooms);
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

#[test]
fn a_circle_is_found() {
    let module = |name: &str| vec![name.to_owned()];
    let uses = |names: &[&str]| names.iter().map(|name| module(name)).collect::<BTreeSet<_>>();
    let mut graph =
        Uses::from([(module("a"), uses(&["b", "c"])), (module("b"), uses(&["c"])), (module("c"), uses(&[]))]);
    assert!(circles(&graph).is_empty());
    graph.insert(module("c"), uses(&["a"]));
    assert_eq!(circles(&graph).len(), 3);
    assert_eq!(expand("crate::{a::{b, c as d}, e}"), ["crate::a::b", "crate::a::c as d", "crate::e"]);
}
