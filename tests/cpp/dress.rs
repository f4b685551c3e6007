//! The example: it dresses what lies in files as the C API dresses it, says what is wrong, and stops.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::ptr::null_mut;

use bespoke::capi::results::bespoke_session_read_garment_vertices;
use bespoke::capi::running::bespoke_session_run;
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use glam::DVec3;

use crate::{CLANG, CLANG_20, CLANG_WITHOUT, Flavour, GCC, GCC_20, GCC_WITHOUT, command};
use testing::caller::{Caller, Mesh, Sample, tube};
use testing::process::{root, scratch};

fn dress(flavour: &Flavour) -> Option<PathBuf> {
    flavour.compile("dress", &[root().join("bindings/cpp/dress.cpp")], &root().join("include"))
}

fn vertices(points: &[[f32; 3]]) -> String {
    points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect()
}

/// Pairs of triangles as the quads that they were, in the ways in which corners can be named.
fn quads(triangles: &[[u32; 3]], count: usize) -> String {
    let line = |(k, pair): (usize, &[[u32; 3]])| {
        let corners = [pair[0][0], pair[0][1], pair[0][2], pair[1][2]];
        let name = |v: u32| match k % 3 {
            0 => format!(" {}", v + 1),
            1 => format!(" {0}/{0}/{0}", v + 1),
            _ => format!(" {}", i64::from(v) - count as i64),
        };
        format!("f{}\n", corners.map(name).concat())
    };
    triangles.chunks_exact(2).enumerate().map(line).collect()
}

fn mesh((points, triangles): &Mesh) -> String {
    vertices(points) + &quads(triangles, points.len())
}

/// A folder with the files of one test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, sample: &Sample) -> Self {
        let this = Self(scratch(&format!("cpp-files-{name}")));
        this.write("garment.obj", &format!("# a garment\no coat\n{}", mesh(&sample.garment)));
        this.write("avatar.obj", &mesh(&sample.avatar));
        this.write("skeleton.obj", &(vertices(&sample.source_joints) + "l 1 2\nl 2 3\n"));
        // One line for both bones.
        this.write("avatar_skeleton.obj", &(vertices(&sample.target_joints) + "l 1 2 3\n"));
        this
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).expect("the folder can be written");
    }

    fn command(&self, program: &Path) -> Command {
        let mut command = command(program);
        command.current_dir(&self.0);
        command.args(["garment.obj", "skeleton.obj", "avatar.obj", "avatar_skeleton.obj", "dressed.obj"]);
        command
    }

    fn run(&self, program: &Path) -> Output {
        self.command(program).output().expect("what was compiled can be run")
    }

    fn result(&self) -> Vec<[f32; 3]> {
        let text = fs::read_to_string(self.0.join("dressed.obj")).expect("a result");
        let lines = text.lines().filter_map(|line| line.strip_prefix("v "));
        lines
            .map(|line| {
                let numbers: Vec<f32> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
                numbers.try_into().expect("three numbers")
            })
            .collect()
    }
}

/// What the C API makes of the same.
fn expected(sample: &Sample) -> Vec<[f32; 3]> {
    let caller = Caller::new();
    caller.set_sample(sample);
    let mut room = vec![[0.0f32; 3]; sample.garment.0.len()];
    let component = BespokeComponent::F32 as u32;
    let buffer = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len(), stride: 0, component };
    // SAFETY: the session is alive and the buffer as large as said.
    unsafe {
        caller.accepted(bespoke_session_run(caller.session));
        caller.accepted(bespoke_session_read_garment_vertices(caller.session, &buffer, null_mut()));
    }
    room
}

fn solid(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
    let positions = points.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    TriangleMesh { positions, triangles: triangles.to_vec() }
}

#[test]
fn it_dresses_as_the_c_api_does_in_every_flavour() {
    let sample = Sample::new();
    let expected = expected(&sample);
    for flavour in [GCC, GCC_WITHOUT, GCC_20, CLANG, CLANG_WITHOUT, CLANG_20] {
        let Some(program) = dress(&flavour) else { continue };
        let folder = Folder::new(flavour.name, &sample);
        let output = folder.run(&program);
        assert!(output.status.success(), "{}: {}", flavour.name, String::from_utf8_lossy(&output.stderr));
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(said.starts_with("prepare\ninflate\n") && said.contains("\ndone\n"), "{said}");
        assert!(said.ends_with("intersections: 0 of the garment with itself, 0 with the avatar\n"), "{said}");
        let points = folder.result();
        assert_eq!(points, expected, "{}", flavour.name);
        let garment = solid(&points, &sample.garment.1);
        let avatar = solid(&sample.avatar.0, &sample.avatar.1);
        assert_eq!(intersections(&garment, Some(&avatar), 0).unwrap().count, 0);
    }
}

#[test]
fn what_is_wrong_is_said_in_one_sentence() {
    let sample = Sample::new();
    let folder = Folder::new("wrong", &sample);
    let Some(program) = dress(&Flavour { name: "wrong", ..GCC }) else { return };
    let refused = |words: &[&str]| {
        let output = folder.run(&program);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.starts_with("dress: ") && said.matches('\n').count() == 1, "{said}");
        for word in words {
            assert!(said.contains(word), "\"{said}\" does not hold \"{word}\"");
        }
        assert!(!folder.0.join("dressed.obj").exists(), "a file was left behind");
    };
    let good = mesh(&sample.garment);
    for (text, words) in [
        ("v 0 0\n", &["garment.obj, line 1", "three coordinates"][..]),
        ("v 0 0 0\n\nf 1 x 1\n", &["garment.obj, line 3", "vertex"]),
        ("v 0 0 0\nf 1 0 1\n", &["garment.obj, line 2", "vertex"]),
        ("", &["garment", "no "]),
        (&good.replacen("f 1 ", "f 9000 ", 1), &["garment", "triangle 0", "8999"]),
        (&good.replacen("f 1 ", "f -9000 ", 1), &["garment", "triangle 0"]),
    ] {
        folder.write("garment.obj", text);
        refused(words);
    }
    folder.write("garment.obj", &good);
    folder.write("avatar_skeleton.obj", &(vertices(&sample.target_joints) + "l 1 3\nl 3 2\n"));
    refused(&["skeleton"]);
    fs::remove_file(folder.0.join("avatar.obj")).expect("the file is there");
    refused(&["avatar.obj", "opened"]);
    let usage = crate::run(&program, &["garment.obj"]);
    assert_eq!(usage.status.code(), Some(2));
}

#[test]
fn ctrl_c_stops_it() {
    // Takes seconds, so that the signal comes in time.
    let sample = Sample { garment: tube(0.3, -0.55, 0.55, 60, 80), ..Sample::new() };
    let folder = Folder::new("signal", &sample);
    let Some(program) = dress(&Flavour { name: "signal", ..GCC }) else { return };
    let mut command = folder.command(&program);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("dress can be run");
    let said = BufReader::new(child.stdout.take().expect("its output"));
    let mut lines = said.lines().map(|line| line.expect("text"));
    assert!(lines.by_ref().any(|line| line == "inflate"), "it does not come to inflate");
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
    assert!(!lines.any(|line| line == "done"), "the signal came too late");
    let output = child.wait_with_output().expect("the program ends");
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{sentence}");
    assert!(sentence.contains("cancelled") && sentence.matches('\n').count() == 1, "{sentence}");
    assert!(!folder.0.join("dressed.obj").exists(), "a file was left behind");
}
