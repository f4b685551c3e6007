//! The shipped program on a machine that has nothing but the C library and GCC's runtime.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shipped::folder;
use testing::caller::tube;
use testing::obj_text::obj;
use testing::process::{scratch, succeed};

/// Writes what the program reads, and says its options for it.
pub fn inputs(place: &Path) -> [&'static str; 12] {
    for (name, radius, reach) in [("g.obj", 0.3, 0.55), ("a.obj", 0.4, 0.9)] {
        let (points, triangles) = tube(radius, -reach, reach, 12, 9);
        fs::write(place.join(name), obj(&points, &triangles, &[])).expect("the mesh can be written");
    }
    fs::write(place.join("s.obj"), "v 0 -1 0\nv 0 0 0\nv 0 1 0\nl 1 2\nl 2 3\n").expect("the skeleton can be written");
    let skeletons = ["--source-skeleton", "s.obj", "--target-skeleton", "s.obj"];
    let [a, b, c, d] = skeletons;
    [a, b, c, d, "--garment", "g.obj", "--avatar", "a.obj", "--voxel", "0.03", "-o", "out.obj"]
}

/// The program `retarget` of the folder, by whatever name it is installed.
pub fn program(folder: &Path) -> PathBuf {
    let entries = fs::read_dir(folder.join("bin")).expect("the folder bin");
    let mut programs = entries.map(|entry| entry.expect("an entry").path());
    programs.find(|path| path.to_string_lossy().ends_with("retarget")).expect("retarget is among the programs")
}

/// The program `bespoke` has the library inside.
#[test]
fn the_program_for_files_needs_no_library_of_ours() {
    let Some(folder) = folder() else { return };
    let alone = scratch("dist-alone").join("bespoke");
    fs::copy(folder.join("bin/bespoke"), &alone).expect("the program can be copied");
    let said = succeed(Command::new(&alone).arg("--version"));
    assert_eq!(said.trim(), concat!("bespoke ", env!("CARGO_PKG_VERSION")));
    let output = Command::new(&alone).args(["inspect", "no-such-file.glb"]).output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && said.contains("no-such-file.glb"), "{said}");
}

#[test]
fn it_dresses_where_nothing_is_installed() {
    let Some(folder) = folder() else { return };
    if succeed(Command::new("id").arg("-u")).trim() != "0" {
        println!("SKIPPED: the folder to ship on a bare machine, for only root can change the root of a process");
        return;
    }
    let machine = scratch("dist-bare");
    succeed(Command::new("cp").arg("-r").arg(folder).arg(machine.join("bespoke")));
    // The loader by its own name, and what it finds for the program here that is of the system.
    let listed = succeed(Command::new("ldd").arg(program(folder)));
    let system = listed.lines().filter_map(|line| line.split_whitespace().find(|word| word.starts_with('/')));
    let loaded = format!("libbespoke.so.{}", bespoke::capi::version::BESPOKE_ABI_VERSION);
    let mut names = Vec::new();
    for file in system.map(Path::new).filter(|file| !file.ends_with(&loaded) && !file.starts_with(folder)) {
        let name = file.file_name().expect("a file").to_string_lossy().into_owned();
        let place = if name.starts_with("ld-") {
            machine.join(&file.to_string_lossy()[1..])
        } else {
            machine.join("lib").join(&name)
        };
        fs::create_dir_all(place.parent().expect("a folder")).expect("a folder of the bare machine");
        fs::copy(file, place).expect("a file of the system can be copied");
        names.push(name);
    }
    names.sort();
    // Older C libraries have threads and the loader's functions in files of their own.
    let expected = ["ld-linux-x86-64.so.2", "libc.so.6", "libdl.so.2", "libgcc_s.so.1", "libm.so.6", "libpthread.so.0"];
    assert_eq!(names, expected);
    let options = inputs(&machine);
    let inside = Path::new("/bespoke").join(program(folder).strip_prefix(folder).expect("it lies in the folder"));
    // All that the loader reads of /proc: where the program lies, which is what $ORIGIN stands for.
    fs::create_dir_all(machine.join("proc/self")).expect("a folder of the bare machine");
    std::os::unix::fs::symlink(&inside, machine.join("proc/self/exe")).expect("a link to the program");
    let mut command = Command::new("chroot");
    command.arg(&machine).arg(inside).args(options).env_remove("LD_LIBRARY_PATH").current_dir(&machine);
    succeed(&mut command);
    let vertices = fs::read_to_string(machine.join("out.obj")).expect("the result").matches("v ").count();
    assert_eq!(vertices, 108, "the result has the vertices of the garment");
}
