//! The program `retarget`: good input leads to the same file with moved vertices; what else there is to say is in the
//! modules below.

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use testing::caller::{Sample, tube};
use testing::obj_text::obj;
use testing::process::{root, scratch, succeed};
use testing::retarget::program;

mod failures;
mod follow;
mod options;
mod refusals;
mod troubleshooting;

/// The program, without any search path for libraries: it has to find its own.
fn retarget() -> Command {
    // Who runs the tests may have Ctrl-C ignored, which is inherited and which the program respects.
    let mut command = Command::new("env");
    command.arg("--default-signal=INT").arg(program());
    command.env_remove("LD_LIBRARY_PATH").env_remove("DYLD_LIBRARY_PATH");
    command
}

/// A folder with good input files for one test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let (this, sample) = (Self(scratch(&format!("retarget-{name}"))), Sample::new());
        this.write("g.obj", &obj(&sample.garment.0, &sample.garment.1, &[]));
        this.write("a.obj", &obj(&sample.avatar.0, &sample.avatar.1, &[]));
        this.write("s.obj", &obj(&sample.source_joints, &[], &sample.bones));
        this.write("t.obj", &obj(&sample.target_joints, &[], &sample.bones));
        this
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("the folder can be written");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("the file is there")
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("the folder is there");
        let mut names: Vec<_> =
            entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    fn command(&self) -> Command {
        let mut command = retarget();
        command.current_dir(&self.0).args(["--garment", "g.obj", "--source-skeleton", "s.obj"]);
        command.args(["--avatar", "a.obj", "--target-skeleton", "t.obj", "-o", "out.obj"]);
        command
    }

    fn run(&self, further: &[&str]) -> Output {
        self.command().args(further).output().expect("retarget can be run")
    }

    /// It ends with this exit code and one sentence with these words, and leaves no file behind.
    #[track_caller]
    fn refuses(&self, further: &[&str], code: i32, words: &[&str]) {
        let before = self.names();
        let output = self.run(further);
        let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{sentence}");
        assert!(sentence.starts_with("retarget: ") && sentence.matches('\n').count() == 1, "no sentence: {sentence}");
        for word in words {
            assert!(sentence.contains(word), "\"{sentence}\" does not hold \"{word}\"");
        }
        assert_eq!(self.names(), before, "files were left behind");
    }

    #[track_caller]
    fn accepts(&self, further: &[&str]) {
        let output = self.run(further);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// Whatever else a file holds stays; vertex normals are new, and written as the faces use them.
#[test]
fn all_but_positions_and_normals_is_kept() {
    let folder = Folder::new("kept");
    let sample = Sample::new();
    let (positions, triangles) = &sample.garment;
    let mut text = String::from("# a comment\r\nmtllib cloth.mtl\r\no coat\r\n");
    for (k, [x, y, z]) in positions.iter().enumerate() {
        let tail = ["", " 1.0", " 0.5 0.25 0.75", "   # named"][k % 4];
        text += &format!("v  {x} {y} {z}{tail}\r\n");
        text += &format!("vn 0 {k} 1\r\nvt 0.{k} 0.5\r\n");
    }
    text += "g front\r\nusemtl red\r\ns 1\r\n";
    let count = positions.len() as i64;
    for (k, triangle) in triangles.iter().enumerate() {
        // All the ways to name the same corner.
        let corner = |v: u32| match (k % 3, i64::from(v)) {
            (0, v) => format!("{0}/{0}/{0}", v + 1),
            (1, v) => format!("{0}/{0}/{0}", v - count),
            (_, v) => format!("{}/{}", v + 1, v + 1),
        };
        text += &format!("f {}\r\n", triangle.map(corner).join(" "));
    }
    text += "l 1 2\r\nusemtl blue\r\n";
    folder.write("g.obj", &text);
    folder.accepts(&[]);

    let kept = |text: &str| -> Vec<String> {
        text.lines()
            .filter(|line| !line.starts_with("vn "))
            .map(|line| match line.strip_prefix("v ") {
                Some(rest) => {
                    let words: Vec<_> = rest.split_whitespace().skip(3).collect();
                    format!("v {}", words.join(" "))
                }
                None if line.starts_with("f ") => {
                    let corner = |word: &str| word.split('/').take(2).collect::<Vec<_>>().join("/");
                    format!("f {}", line[2..].split_whitespace().map(corner).collect::<Vec<_>>().join(" "))
                }
                None => line.to_owned(),
            })
            .collect()
    };
    let out = folder.read("out.obj");
    assert_eq!(kept(&out), kept(&text));
    assert!(out.lines().count() == out.matches("\r\n").count(), "line breaks stay what they were");

    // One normal for each vertex, of length 1, away from the axis of the tube.
    let vertices: Vec<Vec<f32>> = numbers(&out, "v ");
    let normals: Vec<Vec<f32>> = numbers(&out, "vn ");
    assert_eq!(normals.len(), positions.len());
    for line in out.lines().filter(|line| line.starts_with("f ")) {
        for corner in line[2..].split_whitespace() {
            let fields: Vec<i64> = corner.split('/').map(|f| f.parse().expect("an index")).collect();
            if let [v, _, n] = fields[..] {
                let vertex = &vertices[if v > 0 { v - 1 } else { v + count } as usize];
                let normal = &normals[n as usize - 1];
                assert!((normal.iter().map(|c| c * c).sum::<f32>() - 1.0).abs() < 1e-5);
                assert!(vertex[0] * normal[0] + vertex[2] * normal[2] > 0.0, "a normal points inwards");
            }
        }
    }
}

/// The numbers of all lines that begin with `key`, read as 32-bit floats.
fn numbers(text: &str, key: &str) -> Vec<Vec<f32>> {
    text.lines()
        .filter_map(|line| line.strip_prefix(key))
        .map(|rest| rest.split_whitespace().map_while(|word| word.parse().ok()).collect())
        .collect()
}

/// What some editors and exporters leave in a file: a byte order mark, a comment that ends with a path's backslash.
#[test]
fn marks_and_paths_in_comments_hide_no_line() {
    let folder = Folder::new("marks");
    let plain = folder.read("g.obj");
    folder.accepts(&["-o", "plain.obj"]);
    for before in ["\u{feff}", "# C:\\models\\\n"] {
        folder.write("g.obj", &format!("{before}{plain}"));
        folder.accepts(&[]);
        assert_eq!(numbers(&folder.read("out.obj"), "v "), numbers(&folder.read("plain.obj"), "v "));
    }
}

/// A limit on the size of files would end the program with a signal and leave the file under its other name.
#[test]
fn a_file_that_grows_too_large_leaves_nothing() {
    let folder = Folder::new("limit");
    let before = folder.names();
    let mut shell = Command::new("sh");
    shell.current_dir(&folder.0).args(["-c", "ulimit -f 1; exec \"$@\"", "sh"]).arg(program());
    shell.args(["--garment", "g.obj", "--source-skeleton", "s.obj", "--avatar", "a.obj", "--target-skeleton", "t.obj"]);
    let output = shell.args(["--quiet", "-o", "out.obj"]).output().expect("sh can be run");
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{sentence}");
    assert!(sentence.contains("out.obj") && sentence.matches('\n').count() == 1, "{sentence}");
    assert_eq!(folder.names(), before, "files were left behind");
}

/// Polygons are fans for the library and stay polygons in the file.
#[test]
fn polygons_stay_polygons() {
    let folder = Folder::new("polygons");
    let sample = Sample::new();
    let mut text = obj(&sample.garment.0, &[], &[]);
    for pair in sample.garment.1.chunks_exact(2) {
        let ([a, b, d], [_, _, c]) = (pair[0], pair[1]);
        text += &format!("f {} {} {} {}\n", a + 1, b + 1, d + 1, c + 1);
    }
    folder.write("g.obj", &text);
    folder.accepts(&["--report", "report.json"]);
    let faces = |text: &str| text.lines().filter(|l| l.starts_with('f')).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(faces(&folder.read("out.obj")), faces(&text));
    let report = folder.read("report.json");
    let size = format!(
        "\"garment\": {{ \"vertices\": {}, \"triangles\": {} }}",
        sample.garment.0.len(),
        sample.garment.1.len()
    );
    assert!(report.contains(&size), "{report}");
}

#[test]
fn a_good_run_writes_all_its_files() {
    let folder = Folder::new("good");
    folder.write("no-fit.txt", "# the hem\n0 1\n2\n");
    let rows = vec![vec!["1"; Sample::new().avatar.0.len()].join(" "); 3].join("\n");
    folder.write("skin.txt", &rows);
    let before = folder.names();
    folder.accepts(&[
        "--no-fit",
        "no-fit.txt",
        "--skin-weights",
        "skin.txt",
        "--report=report.json",
        "--output-avatar",
        "body.obj",
        "--threads",
        "1",
    ]);
    let mut expected = [&before[..], &["body.obj", "out.obj", "report.json"].map(String::from)].concat();
    expected.sort();
    assert_eq!(folder.names(), expected);
    // Every 32-bit float survives being written and read.
    assert_eq!(numbers(&folder.read("body.obj"), "v "), numbers(&folder.read("a.obj"), "v "));
    let report = folder.read("report.json");
    for key in
        ["library_version", "threads", "peak_memory_bytes", "\"fit\"", "energies", "min_distance", "\"verified\": true"]
    {
        assert!(report.contains(key), "{report}");
    }
    // A second run replaces what is there.
    folder.accepts(&["--quiet"]);
    assert_eq!(folder.names(), expected);
}

/// Names of objects, groups and materials say what takes part.
#[test]
fn groups_of_the_avatar_have_roles() {
    let folder = Folder::new("groups");
    folder.accepts(&["-o", "alone.obj"]);
    let body = folder.read("a.obj");
    let count = numbers(&body, "v ").len();
    let quad = |name: &str, z: f32| format!("{name}\nv -9 {z} -9\nv 9 {z} -9\nv 9 {z} 9\nv -9 {z} 9\nf -4 -3 -2 -1\n");
    let sheets = [quad("o Floor", 0.1), quad("g some Hair", 0.2), quad("g none\nusemtl Glass", 0.3)].concat();
    folder.write("a.obj", &format!("o Body\n{body}{sheets}"));
    folder.accepts(&["-o", "out.obj", "--ignore-groups", "Floor,Hair,Glass", "--report", "r.json"]);
    assert_eq!(folder.read("out.obj"), folder.read("alone.obj"));
    let report = folder.read("r.json");
    assert!(report.contains(&format!("\"vertices\": {}", count + 12)), "{report}");
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let folder = Folder::new("bytes");
    folder.accepts(&["-o", "one.obj"]);
    folder.accepts(&["-o", "two.obj", "--threads", "1"]);
    assert_eq!(folder.read("one.obj"), folder.read("two.obj"));
}

/// The garment comes through a pipe, so that the signal arrives while the program surely runs.
#[test]
fn ctrl_c_stops_without_a_file() {
    let folder = Folder::new("signal");
    let garment = folder.read("g.obj");
    fs::remove_file(folder.path("g.obj")).expect("the file is there");
    let made = Command::new("mkfifo").arg(folder.path("g.obj")).status().expect("mkfifo");
    assert!(made.success());
    let before = folder.names();
    let program = folder.command().stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("retarget can be run");
    // Waits until the program reads.
    let mut pipe = fs::OpenOptions::new().write(true).open(folder.path("g.obj")).expect("the pipe opens");
    let sent = Command::new("kill").args(["-INT", &program.id().to_string()]).status().expect("kill");
    assert!(sent.success());
    pipe.write_all(garment.as_bytes()).expect("the program reads on");
    drop(pipe);
    let output = program.wait_with_output().expect("the program ends");
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{sentence}");
    assert!(sentence.contains("Ctrl-C") && sentence.matches('\n').count() == 1, "{sentence}");
    assert_eq!(folder.names(), before, "files were left behind");
}

#[test]
fn layers_and_distortion() {
    let folder = Folder::new("layers");
    folder.accepts(&["-o", "inner.obj"]);
    folder.accepts(&["--layer", "inner.obj", "-o", "middle.obj"]);
    let before = folder.names();
    let further = ["--layer=inner.obj", "--layer", "middle.obj", "--distortion", "d.txt", "--report", "r.json"];
    folder.accepts(&[&further[..], &["--output-covered", "c.txt", "--covered-margin=0"]].concat());
    let mut expected = [&before[..], &["c.txt", "d.txt", "out.obj", "r.json"].map(String::from)].concat();
    expected.sort();
    assert_eq!(folder.names(), expected);
    let radius = |name: &str| {
        let points = numbers(&folder.read(name), "v ");
        points.iter().map(|p| p[0].hypot(p[2])).sum::<f32>()
    };
    assert!(radius("inner.obj") < radius("middle.obj") && radius("middle.obj") < radius("out.obj"));
    let values: Vec<f64> = folder.read("d.txt").lines().map(|line| line.parse().expect("a number a line")).collect();
    assert_eq!(values.len(), Sample::new().garment.1.len());
    assert!(values.iter().all(|&d| d >= 0.0) && values.iter().any(|&d| d > 0.0));
    assert!(folder.read("r.json").contains("\"distortion\": { \"mean\": "));
    let covered: Vec<usize> = folder.read("c.txt").lines().map(|line| line.parse().expect("a number a line")).collect();
    assert!(!covered.is_empty() && covered.is_sorted() && covered[covered.len() - 1] < Sample::new().avatar.1.len());
    folder.refuses(&["--covered-openness", "1.5"], 2, &["--covered-openness"]);

    folder.refuses(&["--layer"], 2, &["--layer", "value"]);
    folder.refuses(&["--layers", "inner.obj"], 2, &["--layers"]);
    folder.refuses(&["--layer", "inner.obj", "--layer", "nothing.obj"], 1, &["nothing.obj"]);
    folder.refuses(&["--distortion", "out.obj"], 2, &["out.obj"]);
    folder.refuses(&["--distortion", "nowhere/d.txt"], 1, &["nowhere/d.txt"]);
    folder.write("bad.obj", "v 0 0 0\nv 1 0 0\n");
    folder.refuses(&["--layer", "bad.obj"], 1, &["bad.obj", "layer 0"]);
}

/// Curves from a file: a boundary as it is gives the same result, let go another one.
#[test]
fn curves_are_read_from_a_file() {
    let folder = Folder::new("curves");
    let ring = (0..16).map(|v| v.to_string()).collect::<Vec<_>>().join(" ");
    folder.accepts(&["--quiet"]);
    let plain = folder.read("out.obj");
    folder.write("curves.txt", &format!("# the lower end\n\nclosed 1 1 {ring}\n"));
    folder.accepts(&["--quiet", "--curves", "curves.txt"]);
    assert!(folder.read("out.obj") == plain);
    folder.write("curves.txt", &format!("closed 0 0 {ring}\nopen 2 0.5 40 41 42\n"));
    folder.accepts(&["--quiet", "--curves", "curves.txt"]);
    assert!(folder.read("out.obj") != plain);
    let bad = [
        ("ring 1 1 0 1\n", "line 1: 'ring' is neither open nor closed"),
        ("open x 1 0 1\n", "line 1: 'x' is not a weight"),
        ("\nopen 1 1 0 -1\n", "line 2: '-1' is not a vertex"),
        ("open 1\n", "line 1: has 2 words"),
        ("open 1 1 7\n", "curve 0: has 1 places"),
        ("open 1 -1 7 8\n", "curve 0: its position weight is -1"),
        ("open 1 1 0 2\n", "curve 0: no edge of the garment joins vertices 0 and 2"),
    ];
    for (text, message) in bad {
        folder.write("curves.txt", text);
        folder.refuses(&["--curves", "curves.txt"], 1, &[message]);
    }
    folder.refuses(&["--curves", "nothing.txt"], 1, &["nothing.txt"]);
}

/// Pins and rigid groups from files; pins that are not reached are in the report.
#[test]
fn pins_and_rigid_groups_are_read_from_files() {
    let folder = Folder::new("controls");
    let sample = Sample::new();
    folder.write("pins.txt", "# vertex, place\n0 0.4 -0.4 0.1\n70 0 0.05 0\n");
    folder.write("rigid.txt", "40 41 56\n\n100 101 116\n");
    folder.accepts(&["--quiet", "--pins", "pins.txt", "--rigid", "rigid.txt", "--report", "r.json"]);
    let text = folder.read("out.obj");
    let numbers = |line: &str| line.split_whitespace().skip(1).map(|w| w.parse::<f32>().expect("a number")).collect();
    let x: Vec<Vec<f32>> = text.lines().filter(|l| l.starts_with("v ")).map(numbers).collect();
    let distance = |p: &[f32], q: &[f32]| p.iter().zip(q).map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt();
    assert!(distance(&x[0], &[0.4, -0.4, 0.1]) < 0.005, "{:?}", x[0]);
    // The other place is inside the body.
    assert!(distance(&x[70], &[0.0, 0.05, 0.0]) > 0.1, "{:?}", x[70]);
    assert!(folder.read("r.json").contains("\"pin_not_reached\""), "{}", folder.read("r.json"));
    for group in [[40, 41, 56], [100, 101, 116]] {
        for (v, w) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (group[i], group[j])) {
            let was = distance(&sample.garment.0[v], &sample.garment.0[w]);
            let is = distance(&x[v], &x[w]);
            assert!((is / was - 1.1).abs() < 1e-4, "vertices {v} and {w}: {is}, designed {was}");
        }
    }
}
