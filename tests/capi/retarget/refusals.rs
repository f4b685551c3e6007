//! Bad input leads to one sentence, exit 1 or 2, and no file.

use std::fs;

use super::{Folder, Sample, obj, retarget};

#[test]
fn wrong_command_lines_are_refused() {
    let folder = Folder::new("command-line");
    folder.refuses(&["--nonsense"], 2, &["--nonsense"]);
    folder.refuses(&["--fit-weight"], 2, &["--fit-weight", "value"]);
    folder.refuses(&["--fit-weight", "tight"], 2, &["--fit-weight", "tight"]);
    folder.refuses(&["--dhat=-1"], 2, &["--dhat", "-1"]);
    folder.refuses(&["--threads", "1.5"], 2, &["--threads"]);
    folder.refuses(&["--report", "out.obj"], 2, &["out.obj"]);
    folder.refuses(&["--target-space", "x,y"], 2, &["--target-space", "three axes"]);
    folder.refuses(&["--target-space", "x,y,z,far"], 2, &["--target-space", "far"]);
    folder.refuses(&["--source-space", "x,y,-x"], 1, &["perpendicular"]);
    folder.refuses(&["--dhat", "0"], 2, &["--dhat", "above 0"]);
    folder.refuses(&["--dhat", "1"], 1, &["dhat"]);
    folder.refuses(&["--designed-clearance", "3"], 1, &["designed_clearance"]);
    folder.refuses(&["--voxel", "1e300"], 1, &["voxel"]);
    folder.refuses(&["--voxel-size", "1e300"], 1, &["voxel"]);
    folder.refuses(&["--max-iterations", "1e10"], 2, &["--max-iterations", "4294967295"]);
    folder.refuses(&["--inflation-dhat", "0"], 2, &["--inflation-dhat", "above 0"]);
    folder.refuses(&["--quiet=yes"], 2, &["--quiet=yes"]);
    folder.refuses(&["--keep-partial", "out.obj"], 2, &["out.obj"]);
    folder.refuses(&["--keep-partial", "p.obj", "--report", "p.avatar.obj"], 2, &["p.avatar.obj"]);
    folder.refuses(&["--keep-partial", "no/such/folder/p.obj"], 1, &["no/such/folder/p.obj"]);
    let output = retarget().args(["--garment", "g.obj"]).output().expect("retarget can be run");
    assert_eq!(output.status.code(), Some(2));
    let help = retarget().arg("--help").output().expect("retarget can be run");
    assert!(help.status.success() && String::from_utf8_lossy(&help.stdout).contains("--source-skeleton"));
}

#[test]
fn a_group_that_the_avatars_file_has_not_is_named() {
    let folder = Folder::new("groups");
    for option in ["--ignore-groups", "--collision-groups", "--body-groups"] {
        folder.refuses(&[option, "Hair"], 1, &["a.obj", "no object, group or material 'Hair'", option]);
    }
}

#[test]
fn files_that_cannot_be_opened_are_named() {
    let folder = Folder::new("files");
    fs::create_dir(folder.path("folder.obj")).expect("a folder");
    for option in [
        "--garment",
        "--source-skeleton",
        "--avatar",
        "--target-skeleton",
        "--source-avatar",
        "--skin-weights",
        "--no-fit",
        "--pins",
        "--rigid",
    ] {
        folder.refuses(&[option, "missing.obj"], 1, &["missing.obj"]);
        folder.refuses(&[option, "folder.obj"], 1, &["folder.obj", "directory"]);
    }
    folder.refuses(&["-o", "folder.obj"], 1, &["folder.obj", "directory"]);
    folder.refuses(&["-o", "no/such/folder/out.obj"], 1, &["no/such/folder/out.obj"]);
    folder.refuses(&["--report", "folder.obj"], 1, &["folder.obj", "directory"]);
    folder.write("binary.obj", "v 1 2 3\0");
    folder.refuses(&["--garment", "binary.obj"], 1, &["binary.obj", "text"]);
    folder.write("empty.obj", "");
    folder.refuses(&["--garment", "empty.obj"], 1, &["empty.obj"]);
}

#[test]
fn broken_lines_are_named_by_their_number() {
    let folder = Folder::new("lines");
    for (line, words) in [
        ("v 1 2", ["three coordinates", "line 4"]),
        ("v 1 2 x", ["'x'", "line 4"]),
        ("v 1 2 nan", ["'nan'", "line 4"]),
        ("v 1 2 1e39", ["'1e39'", "line 4"]),
        ("v 1 2 1e999", ["'1e999'", "line 4"]),
        ("f 1 2", ["three corners", "line 4"]),
        ("f 1 2 0", ["'0'", "line 4"]),
        ("f 1 2 4", ["'4'", "line 4"]),
        ("f 1 2 -4", ["'-4'", "line 4"]),
        ("f 1 2 3.5", ["'3.5'", "line 4"]),
        ("f 1 2 a/b", ["'a/b'", "line 4"]),
        ("f 1 2 99999999999999999999", ["'99999999999999999999'", "line 4"]),
        ("f 1 2 3//-1", ["'3//-1'", "line 4"]),
        ("l 1", ["two vertices", "line 4"]),
    ] {
        folder.write("bad.obj", &format!("v 0 0 0\r\nv 1 0 0\nv 0 1 0 # three\n{line}\nf 1 2 3\n"));
        folder.refuses(&["--garment", "bad.obj"], 1, &[&["bad.obj"], &words[..]].concat());
    }
    // A line that goes on in the next one counts as two.
    folder.write("bad.obj", "v 0 0 0\nv 1 \\\n 0 0\nv 0 1 0\nf 1 2 zwei\n");
    folder.refuses(&["--garment", "bad.obj"], 1, &["line 5", "'zwei'"]);
}

#[test]
fn bad_tables_are_named_by_their_line() {
    let folder = Folder::new("tables");
    let count = Sample::new().avatar.0.len();
    let row = vec!["0.5"; count].join(" ");
    folder.write("skin.txt", &format!("{row}\n{row} 1\n{row}\n"));
    folder.refuses(&["--skin-weights", "skin.txt"], 1, &["skin.txt", "line 2"]);
    folder.write("skin.txt", &format!("{row}\n{row}\n{}\n", row.replacen("0.5", "much", 1)));
    folder.refuses(&["--skin-weights", "skin.txt"], 1, &["skin.txt", "line 3", "much"]);
    folder.write("skin.txt", "0.5 0.5\n0.5 0.5\n0.5 0.5\n");
    folder.refuses(&["--skin-weights", "skin.txt"], 1, &["skin.txt", "2 columns", &count.to_string()]);
    folder.write("skin.txt", &format!("{row}\n{row}\n"));
    folder.refuses(&["--skin-weights", "skin.txt"], 1, &["skin weights"]);
    folder.write("no-fit.txt", "1 2\n3 four\n");
    folder.refuses(&["--no-fit", "no-fit.txt"], 1, &["no-fit.txt", "line 2", "four"]);
    folder.write("no-fit.txt", "1 2\n-3\n");
    folder.refuses(&["--no-fit", "no-fit.txt"], 1, &["no-fit.txt", "line 2", "-3"]);
    folder.write("pins.txt", "1 2 3\n");
    folder.refuses(&["--pins", "pins.txt"], 1, &["pins.txt", "3 numbers"]);
    folder.write("pins.txt", "1\n2.5\n");
    folder.refuses(&["--pins", "pins.txt"], 1, &["pins.txt", "pin 2", "2.5"]);
    folder.write("pins.txt", "1 0 0 0\n100000 0 0 0\n");
    folder.refuses(&["--pins", "pins.txt"], 1, &["pinned", "vertex 100000"]);
    folder.write("rigid.txt", "1 2 3\n\n4 5 2 # again\n");
    folder.refuses(&["--rigid", "rigid.txt"], 1, &["rigid.txt", "rigid group 1", "vertex 2"]);
    folder.write("no-fit.txt", "1 100000\n");
    folder.refuses(&["--no-fit", "no-fit.txt"], 1, &["no-fit.txt", "100000"]);
}

#[test]
fn meshes_that_do_not_go_together_are_refused() {
    let folder = Folder::new("meshes");
    let sample = Sample::new();
    folder.write("points.obj", &obj(&sample.garment.0, &[], &[]));
    folder.refuses(&["--garment", "points.obj"], 1, &["points.obj", "garment"]);
    folder.write("other.obj", &obj(&sample.target_joints, &[], &[[0, 1], [0, 2]]));
    folder.refuses(&["--target-skeleton", "other.obj"], 1, &["target skeleton"]);
}
