//! The program with names of files, line ends and faults as people have them.

use std::fs;
use std::path::Path;

use crate::wine::{Wine, said, same, wine};
use testing::caller::tube;
use testing::obj_text::obj;
use testing::process::scratch;

/// Writes what the program reads; its lines end with `end`.
fn inputs(place: &Path, end: &str) {
    for (name, radius, reach) in [("g.obj", 0.3, 0.55), ("a.obj", 0.4, 0.9)] {
        let (points, triangles) = tube(radius, -reach, reach, 12, 9);
        fs::write(place.join(name), obj(&points, &triangles, &[]).replace('\n', end)).expect("the mesh can be written");
    }
    let skeleton = "v 0 -1 0\nv 0 0 0\nv 0 1 0\nl 1 2\nl 2 3\n";
    fs::write(place.join("s.obj"), skeleton.replace('\n', end)).expect("the skeleton can be written");
}

/// Dresses with files in `from`, and leaves the result in `out`.
#[track_caller]
fn dress(wine: &Wine, place: &Path, from: &str, out: &str) {
    let [garment, avatar, skeleton] = ["g.obj", "a.obj", "s.obj"].map(|file| format!("{from}{file}"));
    let words =
        ["--garment", &garment, "--avatar", &avatar, "--source-skeleton", &skeleton, "--target-skeleton", &skeleton];
    let output = wine.retarget(&[&words[..], &["--voxel", "0.03", "--quiet", "-o", out]].concat(), place);
    assert!(output.status.success(), "dressing {out} ended with {}", said(&output));
}

/// Nothing but these files lies there.
fn lies_there(place: &Path, expected: &[&str]) {
    let mut names: Vec<String> = fs::read_dir(place)
        .expect("the folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, expected, "in {}", place.display());
}

#[test]
fn files_may_be_called_anything() {
    let Some(wine) = wine() else { return };
    let place = scratch("windows-paths");
    inputs(&place, "\n");
    dress(wine, &place, "", "plain.obj");

    // Umlauts, blanks, and letters that no code page of Europe has.
    let odd = place.join("Kleid für 少女");
    fs::create_dir(&odd).expect("the folder can be made");
    inputs(&odd, "\n");
    dress(wine, &place, "Kleid für 少女\\", "Kleid für 少女\\Ärmel und Saum.obj");
    same(&place.join("plain.obj"), &odd.join("Ärmel und Saum.obj"));
    lies_there(&odd, &["a.obj", "g.obj", "s.obj", "Ärmel und Saum.obj"]);

    // Longer than the 260 characters that Windows once had.
    let part = "a folder with a name that is about sixty characters long now";
    let deep: std::path::PathBuf = std::iter::once(place.clone()).chain((0..6).map(|_| part.into())).collect();
    fs::create_dir_all(&deep).expect("the folders can be made");
    inputs(&deep, "\n");
    let from = format!("{}\\", [part; 6].join("\\"));
    assert!(from.len() > 300);
    dress(wine, &place, &from, &format!("{from}out.obj"));
    same(&place.join("plain.obj"), &deep.join("out.obj"));
    let whole = format!("Z:{}/", deep.display()).replace('/', "\\");
    dress(wine, &place, &whole, &format!("{whole}whole.obj"));
    same(&place.join("plain.obj"), &deep.join("whole.obj"));

    // Over what is there, also where it cannot be replaced.
    fs::write(place.join("old.obj"), "an old result\n").expect("a file");
    dress(wine, &place, "", "old.obj");
    same(&place.join("plain.obj"), &place.join("old.obj"));
}

#[test]
fn line_ends_are_those_of_the_garment() {
    let Some(wine) = wine() else { return };
    let (place, other) = (scratch("windows-lf"), scratch("windows-crlf"));
    inputs(&place, "\n");
    inputs(&other, "\r\n");
    dress(wine, &place, "", "out.obj");
    dress(wine, &other, "", "out.obj");
    let [plain, with_returns] =
        [&place, &other].map(|place| fs::read_to_string(place.join("out.obj")).expect("the result"));
    // Those of the garment's file, as on Linux.
    assert!(!plain.contains('\r'), "carriage returns are written");
    assert_eq!(plain.replace('\n', "\r\n"), with_returns);
}

#[test]
fn faults_have_their_exit_codes_and_leave_nothing() {
    let Some(wine) = wine() else { return };
    let place = scratch("windows-faults");
    inputs(&place, "\n");
    let run = |garment: &str, out: &str| {
        let words =
            ["--garment", garment, "--avatar", "a.obj", "--source-skeleton", "s.obj", "--target-skeleton", "s.obj"];
        wine.retarget(&[&words[..], &["--voxel", "0.03", "--quiet", "-o", out]].concat(), &place)
    };
    let missing = run("nothing für.obj", "out.obj");
    assert_eq!(missing.status.code(), Some(1), "{}", said(&missing));
    assert!(said(&missing).contains("nothing für.obj: cannot be opened"), "{}", said(&missing));
    let unknown = wine.retarget(&["--no-such-option"], &place);
    assert_eq!(unknown.status.code(), Some(2), "{}", said(&unknown));
    let folder = run("g.obj", ".");
    assert_eq!(folder.status.code(), Some(1), "{}", said(&folder));
    assert!(said(&folder).contains("is a directory"), "{}", said(&folder));
    let nowhere = run("g.obj", "no\\such\\folder\\out.obj");
    assert_eq!(nowhere.status.code(), Some(1), "{}", said(&nowhere));
    fs::write(place.join("broken.obj"), "v 0 0\n").expect("a file");
    let broken = run("broken.obj", "out.obj");
    assert_eq!(broken.status.code(), Some(1), "{}", said(&broken));
    assert!(said(&broken).contains("broken.obj: line 1: a vertex needs three coordinates"), "{}", said(&broken));
    lies_there(&place, &["a.obj", "broken.obj", "g.obj", "s.obj"]);
}
