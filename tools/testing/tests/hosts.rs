//! The same words and defaults in all hosts: dials, labels, stages and the page about failures are those of bindings/words.json, and
//! what a dial says and begins with is what bindings/bespoke.json has of its option.

use std::fs;
use std::path::Path;

use serde_json::Value;
use testing::process::root;

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|reason| panic!("{path}: {reason}"))
}

fn json(path: &str) -> Value {
    serde_json::from_str(&read(path)).expect("JSON")
}

/// All sources below a folder, one after the other.
fn sources(folder: &str) -> String {
    fn add(folder: &Path, text: &mut String) {
        let entries = fs::read_dir(folder).unwrap_or_else(|reason| panic!("{}: {reason}", folder.display()));
        let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
        paths.sort();
        for path in paths {
            let is_source = |ending| ["gd", "rs", "py", "cs", "h", "cpp"].iter().any(|known| ending == *known);
            if path.is_dir() {
                add(&path, text);
            } else if path.extension().is_some_and(is_source) {
                *text += &fs::read_to_string(&path).expect("a source is UTF-8");
            }
        }
    }
    let mut text = String::new();
    add(&root().join(folder), &mut text);
    text
}

const GODOT: &str = "bindings/godot/addons";
const BLENDER: &str = "bindings/blender/extension";
const UNITY: &str = "bindings/unity";
const UNREAL: &str = "bindings/unreal/Bespoke";

fn texts<'a>(words: &'a Value, key: &str) -> Vec<&'a str> {
    words[key].as_array().expect("a list").iter().map(|word| word.as_str().expect("a text")).collect()
}

/// The option behind a dial, as the header describes it.
fn option<'a>(described: &'a Value, name: &str) -> &'a Value {
    let options = described["options"].as_array().expect("options");
    options.iter().find(|known| known["name"] == *name).unwrap_or_else(|| panic!("there is no option {name}"))
}

/// The number behind the first `before` of a text.
fn number(text: &str, before: &str) -> f64 {
    let (_, rest) = text.split_once(before).unwrap_or_else(|| panic!("'{before}' is nowhere"));
    let end = rest.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|_| panic!("'{}' after '{before}' is no number", &rest[..end]))
}

#[test]
fn dials_have_the_names_and_defaults_of_their_options() {
    let (words, described) = (json("bindings/words.json"), json("bindings/bespoke.json"));
    let (unity, script) = (read("bindings/unity/Runtime/Core/Dials.cs"), sources("bindings/unreal/Bespoke/Content"));
    let header = read("bindings/unreal/Bespoke/Source/Bespoke/Public/BespokeRetarget.h");
    let program = read("docs/program.md");
    let dials = words["dials"].as_object().expect("dials");
    assert!(dials.len() == 3);
    for (dial, name) in dials {
        let name = name.as_str().expect("an option");
        let option = option(&described, name);
        let default = option["default_value"].as_f64().expect("a number");
        let lower = dial.to_lowercase();
        // In these two it is the library that says what the default is.
        for host in [GODOT, BLENDER] {
            assert!(sources(host).contains(&format!("\"{lower}\": \"{name}\"")), "{host}: {dial}");
        }
        if default == 0.0 {
            assert!(unity.contains(&format!("public double {dial};")), "Unity: {dial}");
        } else {
            assert_eq!(number(&unity, &format!("public double {dial} = ")), default, "Unity: {dial}");
        }
        assert_eq!(number(&script, &format!("{lower}: float = ")), default, "Unreal's script: {dial}");
        assert_eq!(number(&header, &format!("double {dial} = ")), default, "Unreal: {dial}");
        assert!(program.contains(&format!("`--{lower}`")), "the program: {dial}");
        // What the editor shows beside it is the comment above it.
        let above = header.split(&format!("double {dial} = ")).next().expect("what is before");
        let comment = above.rsplit("/**").next().and_then(|rest| rest.split("*/").next()).expect("a comment");
        let said = comment.split_whitespace().filter(|word| *word != "*").collect::<Vec<_>>().join(" ");
        let doc = option["doc"].as_str().expect("a text").replace("BESPOKE_WEIGHT_OFF", "0");
        assert_eq!(said, doc, "Unreal: {dial}");
    }
}

#[test]
fn labels_are_the_same() {
    let words = json("bindings/words.json");
    for host in [GODOT, BLENDER, UNITY, UNREAL] {
        let text = sources(host).to_lowercase();
        let windows = if host == UNREAL { Vec::new() } else { texts(&words, "window_labels") };
        for label in texts(&words, "labels").into_iter().chain(windows) {
            assert!(text.contains(&format!("\"{}", label.to_lowercase())), "{host} has no label '{label}'");
        }
    }
}

/// Where a stage is named, its words come next.
fn says(text: &str, stage: &str, words: &str) -> bool {
    let after = |(at, _)| {
        let rest: &str = &text[at..];
        rest.split('"').nth(1) == Some(words)
    };
    text.match_indices(stage).any(after)
}

#[test]
fn stages_have_the_same_words() {
    let words = json("bindings/words.json");
    let hosts = [
        (read("bindings/godot/addons/bespoke/dock.gd"), "STAGE_", str::to_uppercase as fn(&str) -> String),
        (read("bindings/blender/extension/work.py"), "Stage.", str::to_uppercase),
        (read("bindings/unity/Runtime/Core/Stages.cs"), "Stage.", capital),
        (read("bindings/unreal/Bespoke/Content/Python/bespoke_unreal.py"), "Stage.", str::to_uppercase),
        (read("bindings/unreal/Bespoke/Source/Bespoke/Public/BespokeCore.h"), "Stage::", str::to_string),
        (read("tools/cli/src/progress.rs"), "Stage::", capital),
    ];
    for (stage, said) in words["stages"].as_object().expect("stages") {
        let said = said.as_str().expect("words");
        for (k, (text, prefix, spelling)) in hosts.iter().enumerate() {
            assert!(
                says(text, &format!("{prefix}{}", spelling(stage)), said),
                "host {k} does not say '{said}' of {stage}"
            );
        }
    }
}

fn capital(word: &str) -> String {
    word[..1].to_uppercase() + &word[1..]
}

/// Each host leads to the sections of one page, and brings it.
#[test]
fn failures_lead_to_the_same_page() {
    let words = json("bindings/words.json");
    let page = words["page"].as_str().expect("a page");
    let text = read(&format!("docs/{page}"));
    for anchor in ["bespoke_status_not_enclosed", "bespoke_status_inflation_stalled"] {
        assert!(text.to_lowercase().contains(&format!("\n## {anchor}\n")), "{page} has no section {anchor}");
    }
    for host in [GODOT, BLENDER, UNITY, UNREAL] {
        assert!(
            sources(host).contains(page) || sources("bindings/godot/src").contains(page),
            "{host} does not name {page}"
        );
    }
    for script in
        ["bindings/godot/build.sh", "packaging/blender/pack.sh", "packaging/unity/pack.sh", "packaging/unreal/pack.sh"]
    {
        assert!(read(script).contains(&format!("docs/{page}")), "{script} does not bring {page}");
    }
}
