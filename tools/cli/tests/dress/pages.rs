//! What the guides say to type, typed as it stands there.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use bespoke_gltf::Vrm;
use testing::glb::{Part, glb};
use testing::process::root;

use super::animated::{body, vest, waving};
use super::files::folder;

/// Lines that begin with these are not tried here: they install, or start what tests of their own try.
const ELSEWHERE: [&str; 4] = ["pip", "make", "#!/bin/sh", "#SBATCH"];

fn page(name: &str) -> String {
    fs::read_to_string(root().join("docs").join(name)).unwrap()
}

/// The commands of a page: its indented lines, without what a program prints. One that ends with | goes on in the next line.
fn commands(page: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    let mut is_code = false;
    for line in page.lines() {
        is_code ^= line.starts_with("```");
        let Some(line) = line.strip_prefix("    ").filter(|_| !is_code) else { continue };
        match all.last_mut().filter(|last| last.ends_with('|')) {
            Some(last) => *last += line,
            None => all.push(line.to_string()),
        }
    }
    let first = |line: &String| line.split_whitespace().next().unwrap_or_default().to_string();
    let words = ["bespoke", "build/bespoke", "for"];
    let typed = |line: &String| words.contains(&first(line).as_str());
    let other: Vec<String> = all.iter().map(first).filter(|word| !ELSEWHERE.contains(&word.as_str())).collect();
    let listed = ["parts:", "Suit_Body:Suit:", "Suit_Body:Skin:", "Suit_Head:Hair:"];
    let known = |word: &String| words.contains(&word.as_str()) || listed.contains(&word.as_str());
    assert!(other.iter().all(known), "it is not known whether these are to be tried: {other:?}");
    all.into_iter().filter(typed).collect()
}

/// The text of the first block in a language.
fn block(page: &str, language: &str) -> String {
    let begin = format!("```{language}\n");
    let rest = &page[page.find(&begin).expect("a block of that language") + begin.len()..];
    rest[..rest.find("```").unwrap()].to_string()
}

/// In a shell that finds the program as `bespoke` and as `build/bespoke`.
fn shell(folder: &Path, line: &str) -> Output {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_bespoke"));
    if !folder.join("build").exists() {
        fs::create_dir(folder.join("build")).unwrap();
        symlink(&program, folder.join("build/bespoke")).unwrap();
    }
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("bash");
    command.args(["-c", line]).env("PATH", path).env("SLURM_ARRAY_TASK_ID", "1").current_dir(folder).output().unwrap()
}

/// Each line ends as it should: a check may find something in a pose.
fn try_lines(folder: &Path, page: &str) {
    let lines = commands(page);
    assert!(lines.len() >= 3, "{lines:?}");
    let has_jq = Command::new("jq").arg("--version").output().is_ok();
    for line in &lines {
        if line.contains("jq ") && !has_jq {
            println!("SKIPPED: '{line}', for there is no jq");
            continue;
        }
        let run = shell(folder, line);
        let said = String::from_utf8_lossy(&run.stderr);
        let may_count = line.contains("--animation");
        // jq's own answer is 1 where there is more than the limit.
        let expected: &[i32] = if line.contains("jq ") {
            &[0, 1]
        } else if may_count {
            &[0, 3]
        } else {
            &[0]
        };
        assert!(run.status.code().is_some_and(|code| expected.contains(&code)), "{line}: {:?} {said}", run.status);
        assert!(!may_count || !run.stdout.is_empty(), "{line} says nothing");
    }
}

/// The mannequin in clothes with these nodes.
fn outfit(nodes: &[&str]) -> Vec<u8> {
    let (body, vest) = (body(), vest());
    let mut parts = vec![Part { node: "Body", material: "Skin", mesh: &body }];
    parts.extend(nodes.iter().map(|node| Part { node, material: "Wool", mesh: &vest }));
    glb(&parts)
}

/// Somebody who moves.
fn hero(vrm: Option<Vrm>) -> Vec<u8> {
    let body = body();
    waving(&glb(&[Part { node: "Body", material: "Skin", mesh: &body }]), vrm, "Walking_A")
}

fn write(folder: &Path, files: &[(&str, Vec<u8>)]) {
    for (name, bytes) in files {
        fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        fs::write(folder.join(name), bytes).unwrap();
    }
}

/// docs/vrm.md.
#[test]
fn page_vrm() {
    let folder = folder("page-vrm");
    write(&folder, &[("outfit.glb", outfit(&["Suit_Body"])), ("me.vrm", hero(Some(Vrm::One)))]);
    try_lines(&folder, &page("vrm.md"));
}

/// docs/program.md.
#[test]
fn page_program() {
    let folder = folder("page-program");
    let page = page("program.md");
    write(
        &folder,
        &[
            ("suit.glb", outfit(&["Suit_Body"])),
            ("barbarian.glb", hero(None)),
            ("closet.json", block(&page, "json").into_bytes()),
            ("outfits/suit.glb", outfit(&["Suit_Body"])),
            ("outfits/coat.glb", outfit(&["Coat"])),
            ("mannequin.glb", outfit(&[])),
            ("avatars/hero.vrm", hero(Some(Vrm::Zero))),
            ("avatars/b17.glb", hero(None)),
        ],
    );
    super::obj::write_files(&folder);
    try_lines(&folder, &page);
    assert!(folder.join("dressed/coat-on-baker.glb").is_file());
}

/// docs/pipeline.md.
#[test]
fn page_pipeline() {
    let folder = folder("page-pipeline");
    let page = page("pipeline.md");
    write(
        &folder,
        &[
            ("outfit.glb", outfit(&["Vest"])),
            ("avatar.glb", hero(None)),
            ("closet.json", block(&page, "json").into_bytes()),
            ("outfits/suit.glb", outfit(&["Suit_Body"])),
            ("outfits/coat.glb", outfit(&["Coat"])),
            ("avatars/hero.glb", hero(None)),
            ("avatars/b17.glb", hero(None)),
            // As it comes out of the batch.
            ("hero.glb", waving(&outfit(&["Suit_Body"]), None, "Walking_A")),
        ],
    );
    try_lines(&folder, &page);
    for name in ["suit-on-hero", "suit-on-b17", "coat-on-hero", "coat-on-b17"] {
        for file in [format!("dressed/{name}.glb"), format!("dressed/{name}.glb.check.json")] {
            assert!(folder.join(&file).metadata().unwrap().len() > 0, "{file}");
        }
    }
    let script = block(&page, "python") + "\nassert dress(\"outfit.glb\", \"avatar.glb\", \"dressed.glb\")\n";
    fs::write(folder.join("script.py"), script).unwrap();
    let run = shell(&folder, "python3 script.py");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(folder.join("dressed.glb").is_file());
}
