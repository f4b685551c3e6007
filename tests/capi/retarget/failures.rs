//! A run without a result says why, what the library found and where, and leaves the report and the partial meshes.

use std::fs;
use std::process::Output;

use serde_json::Value;

use testing::caller::Mesh;

use super::{Folder, numbers, obj, retarget, root, succeed, tube};

/// Vertices of a box.
const BOX: u32 = 8;

/// A box: eight corners and twelve triangles.
fn block(low: [f32; 3], high: [f32; 3]) -> Mesh {
    let corner = |k: usize| std::array::from_fn(|i| if k >> i & 1 == 0 { low[i] } else { high[i] });
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    ((0..8).map(corner).collect(), triangles.collect())
}

/// A garment around one of two boxes, each on a bone of its own. At full size they overlap, and nothing fits between.
fn wedged(name: &str) -> Folder {
    let folder = Folder::new(name);
    let garment = tube(0.3, -0.5, 0.5, 12, 20);
    let (mut positions, mut triangles) = block([-0.5, -0.9, -0.4], [0.5, 0.9, 0.4]);
    let (beside, more) = block([0.4, -0.7, -0.3], [1.4, 0.7, 0.3]);
    positions.extend(beside);
    triangles.extend(more.iter().map(|triangle| triangle.map(|v| v + BOX)));
    let joints = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let skeleton = obj(&joints, &[], &[[0, 1], [2, 3], [1, 3]]);
    folder.write("g.obj", &obj(&garment.0, &garment.1, &[]));
    folder.write("a.obj", &obj(&positions, &triangles, &[]));
    folder.write("s.obj", &skeleton);
    folder.write("t.obj", &skeleton);
    // The boxes belong to joints 0 and 2, which have one bone each.
    let row = |joint| (0..2 * BOX).map(|v| if joint == v / BOX * 2 { "1" } else { "0" }).collect::<Vec<_>>().join(" ");
    folder.write("skin.txt", &(0..4).map(row).collect::<Vec<_>>().join("\n"));
    folder
}

/// It ended with exit 1, a sentence with these words on top, and exactly these files more than before.
#[track_caller]
fn fails(folder: &Folder, further: &[&str], words: &[&str], left: &[&str]) -> String {
    let before = folder.names();
    let Output { status, stderr, .. } = folder.run(further);
    let said = String::from_utf8_lossy(&stderr).into_owned();
    assert_eq!(status.code(), Some(1), "{said}");
    let sentence = said.lines().next().unwrap_or_default();
    assert!(sentence.starts_with("retarget: "), "{said}");
    for word in words {
        assert!(sentence.contains(word), "\"{sentence}\" does not hold \"{word}\"");
    }
    let more: Vec<_> = folder.names().into_iter().filter(|name| !before.contains(name)).collect();
    assert_eq!(more, left, "{said}");
    said
}

fn report(folder: &Folder) -> Value {
    let text = folder.read("r.json");
    serde_json::from_str(&text).unwrap_or_else(|reason| panic!("{reason} in {text}"))
}

/// Whatever is written like an option of the library is one of the program.
#[track_caller]
fn names_options_that_exist(sentence: &str) {
    let help = succeed(retarget().arg("--help"));
    for word in sentence.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| word.contains('_')) {
        assert!(help.contains(&format!("  --{} ", word.replace('_', "-"))), "{word} is no option: {sentence}");
    }
}

/// A partial mesh is its input with other vertices and one comment more, which says what it is. Returns the comment's t.
#[track_caller]
fn partial(folder: &Folder, name: &str, input: &str, status: &str) -> f64 {
    let (text, input) = (folder.read(name), folder.read(input));
    let comment = text.lines().next().expect("a first line");
    let rest = comment.strip_prefix(&format!("# partial: {status}, t = ")).expect("the comment names the status");
    assert!(comment.contains("not verified"), "{comment}");
    let (found, given) = (numbers(&text, "v "), numbers(&input, "v "));
    assert!(found.len() == given.len() && found.iter().flatten().all(|c| c.is_finite()), "{name}");
    assert!(found != given, "{name} has not moved");
    let faces = |text: &str| text.lines().filter(|line| line.starts_with("f ")).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(faces(&text), faces(&input));
    rest.split(' ').next().and_then(|t| t.parse().ok()).expect("the comment has t")
}

#[test]
fn a_wedged_garment_leaves_a_report_and_what_was_reached() {
    let folder = wedged("wedged");
    folder.write("out.obj", "the result of an earlier run\n");
    let options = ["--skin-weights", "skin.txt", "--report", "r.json", "--keep-partial", "p.obj"];
    let words = ["the avatar cannot grow beyond"];
    let said = fails(&folder, &options, &words, &["p.avatar.obj", "p.obj", "r.json"]);
    names_options_that_exist(said.lines().next().unwrap_or_default());
    assert!(said.contains("p.obj") && said.contains("p.avatar.obj") && said.contains("not a result"), "{said}");
    assert_eq!(folder.read("out.obj"), "the result of an earlier run\n");

    let status = "BESPOKE_STATUS_INFLATION_STALLED";
    let report = report(&folder);
    assert_eq!(report["status"], status);
    let message = report["message"].as_str().expect("a sentence");
    assert!(said.lines().next().is_some_and(|line| line == format!("retarget: {message}")), "{said}\n{message}");
    assert!(report["verified"] == false && report["diagnostics"].is_array(), "{report}");
    for name in ["distortion", "min_distance", "stages", "energies", "garment", "avatar"] {
        assert!(report[name].is_object(), "no {name} in {report}");
    }

    let t = partial(&folder, "p.obj", "g.obj", status);
    assert!(t > 0.1 && t < 1.0, "{t}");
    assert_eq!(t, partial(&folder, "p.avatar.obj", "a.obj", status));
    let reported = report["t"].as_f64().expect("t is a number");
    assert!((reported - t).abs() < 1e-4, "{reported} {t}");

    // What was kept is where the avatar had grown to: nearer to its bone than at full size, and farther than at the start.
    let radius =
        |name: &str| numbers(&folder.read(name), "v ").iter().take(BOX as usize).map(|p| p[0].hypot(p[2])).sum::<f32>();
    assert!(radius("p.avatar.obj") < radius("a.obj"));
}

/// The options that the sentences name work, and the partial meshes are where the iterations ended.
#[test]
fn a_limit_of_iterations_is_a_failure_that_can_be_looked_at() {
    let folder = Folder::new("iterations");
    let options = ["--max-iterations", "2", "--quiet", "--keep-partial", "p", "--report", "r.json"];
    let words = ["did not end in 2 iterations", "max_iterations"];
    fails(&folder, &options, &words, &["p", "p.avatar.obj", "r.json"]);
    let report = report(&folder);
    let t = partial(&folder, "p", "g.obj", report["status"].as_str().expect("a name"));
    assert!(t > 0.0 && t < 1.0, "{t}");
}

/// The garment that the augmented Lagrangian gets free, were it not for a limit of iterations.
#[test]
fn a_real_garment_fails_on_purpose() {
    let Some(assets) = testing::obj::assets() else { return };
    let folder = Folder::new("real");
    for (name, path) in [
        ("g.obj", "garments/jumpsuit_dense/garment.obj"),
        ("s.obj", "garments/jumpsuit_dense/skeleton.obj"),
        ("a.obj", "avatars/Goblin/avatar.obj"),
        ("t.obj", "avatars/Goblin/skeleton.obj"),
    ] {
        fs::copy(assets.join(path), folder.path(name)).expect("a real mesh");
    }
    let options = ["--inflation-barrier-weight", "1e8", "--max-iterations", "12"];
    let files = ["--report", "r.json", "--keep-partial", "p.obj"];
    let left = ["p.avatar.obj", "p.obj", "r.json"];
    let said = fails(&folder, &[options, files].concat(), &["did not end in 12 iterations", "max_iterations"], &left);
    names_options_that_exist(said.lines().next().unwrap_or_default());
    let status = "BESPOKE_STATUS_INFLATION_STALLED";
    assert_eq!(report(&folder)["status"], status);
    let t = partial(&folder, "p.obj", "g.obj", status);
    assert!(t > 0.0 && t < 1.0 && t == partial(&folder, "p.avatar.obj", "a.obj", status), "{t}");
}

/// With a result nothing partial is written, and what an earlier run has left stays.
#[test]
fn a_result_leaves_nothing_partial() {
    let folder = Folder::new("no-partial");
    folder.write("old.obj", "an earlier one\n");
    folder.accepts(&["--keep-partial", "new.obj", "--inflation-barrier-weight", "1e4", "--inflation-dhat", "0.01"]);
    folder.accepts(&["--keep-partial", "old.obj", "--min-separation", "1e-6", "--max-iterations", "400"]);
    assert!(!folder.path("new.obj").exists() && !folder.path("new.avatar.obj").exists());
    assert!(!folder.path("old.avatar.obj").exists());
    assert_eq!(folder.read("old.obj"), "an earlier one\n");
}

/// A line each for the first of what the library found, with the vertices and triangles in the report.
#[test]
fn a_refusal_names_what_the_library_found() {
    let folder = Folder::new("findings");
    // Beyond its end the tube is closed, right across the skeleton.
    let garment = tube(0.3, -0.55, 0.55, 16, 9);
    let (mut positions, mut triangles) = garment;
    for (ring, y) in [(0, -0.55), (8 * 16, 0.55)] {
        let middle = positions.len() as u32;
        positions.push([0.0, y, 0.0]);
        triangles.extend((0..16).map(|k| [ring + k, ring + (k + 1) % 16, middle]));
    }
    // Twice, so that the way out is closed, too, and the garment passes through itself.
    let (more, corners) = tube(0.25, -0.5, 0.5, 16, 9);
    let count = positions.len() as u32;
    positions.extend(more.iter().map(|[x, y, z]| [x + 0.2, *y, *z]));
    triangles.extend(corners.iter().map(|triangle| triangle.map(|v| v + count)));
    folder.write("g.obj", &obj(&positions, &triangles, &[]));
    let said =
        fails(&folder, &["--strict", "--report", "r.json", "--keep-partial", "p.obj"], &["garment: "], &["r.json"]);
    let lines = said.lines().filter(|line| line.starts_with("error: ")).count();
    assert!((1..=8).contains(&lines) && said.contains("; --report lists all"), "{said}");
    assert!(said.contains("no partial garment"), "{said}");
    let report = report(&folder);
    let listed = report["diagnostics"].as_array().expect("a list");
    assert!(listed.len() > lines, "{report}");
    for item in listed {
        let is_named = item["kind"].is_string() && item["severity"].is_string() && item["message"].is_string();
        assert!(is_named && item["elements"].is_array() && item.get("distance").is_some(), "{item}");
    }
    let worst = listed.iter().find(|item| item["severity"] == "error").expect("an error");
    assert!(worst["elements"][0]["of"] == "garment" && worst["elements"][0]["triangle"].is_u64(), "{worst}");

    // Quiet: still the sentence and the errors, and no warnings.
    let quiet = fails(&folder, &["--strict", "--quiet"], &["garment: "], &[]);
    assert!(quiet.contains("\nerror: ") && !quiet.contains("\nwarning: ") && !quiet.contains("\nnote: "), "{quiet}");
}

/// A file that cannot be read is no failure of the library, and the report is there all the same.
#[test]
fn a_report_of_a_missing_file() {
    let folder = Folder::new("missing");
    fails(&folder, &["--avatar", "nothing.obj", "--report", "r.json"], &["nothing.obj"], &["r.json"]);
    let found = report(&folder);
    assert_eq!(found["status"], "FILE_ERROR");
    assert!(found["message"].as_str().is_some_and(|s| s.starts_with("nothing.obj: cannot be opened")), "{found}");
    fs::remove_file(folder.path("r.json")).expect("the report is there");
    fails(&folder, &["--dhat", "1", "--report", "r.json"], &["dhat"], &["r.json"]);
    assert_eq!(report(&folder)["status"], "BESPOKE_STATUS_INVALID_ARGUMENT");
}

/// The report names every kind of diagnostic that the header has.
#[test]
fn every_kind_of_diagnostic_has_a_name() {
    let read = |path: &str| fs::read_to_string(root().join(path)).expect("a source of the project");
    let (header, program) = (read("include/bespoke.h"), read("examples_c/diagnostics.c"));
    let kinds =
        header.lines().filter_map(|line| line.trim().strip_prefix("BESPOKE_DIAGNOSTIC_KIND_")?.split_once(" = "));
    let kinds: Vec<&str> = kinds.map(|(kind, _)| kind).collect();
    assert!(kinds.len() >= 13, "{kinds:?}");
    for kind in kinds {
        let entry = format!("[BESPOKE_DIAGNOSTIC_KIND_{kind}] = \"{}\"", kind.to_lowercase());
        assert!(program.contains(&entry), "examples_c/diagnostics.c has no {entry}");
    }
}
