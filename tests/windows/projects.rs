//! Foreign projects that are built against the folder with MinGW: by its CMake package, in C and in C++.

use std::process::Command;

use crate::shipped::{CROSS, folder};
use crate::wine::{said, same, wine};
use testing::process::{is_there, root, scratch, succeed};
use testing::{retarget, sample};

#[test]
fn examples_are_built_with_cmake_and_run() {
    let (Some(folder), Some(wine)) = (folder(), wine()) else { return };
    if !is_there("cmake") {
        return;
    }
    let place = scratch("windows-cmake");
    let mut configure = Command::new("cmake");
    configure.arg("-S").arg(root().join("tests/windows/project"));
    configure.args(["-B", "build", "-DCMAKE_SYSTEM_NAME=Windows", "-DCMAKE_BUILD_TYPE=Release"]);
    configure.arg(format!("-DCMAKE_C_COMPILER={CROSS}gcc-posix")).arg(format!("-DCMAKE_CXX_COMPILER={CROSS}g++-posix"));
    configure.arg(format!("-DCMAKE_RC_COMPILER={CROSS}windres"));
    configure.arg(format!("-DCMAKE_PREFIX_PATH={}", folder.display())).arg(format!("-DFOLDER={}", folder.display()));
    succeed(configure.current_dir(&place));
    succeed(Command::new("cmake").args(["--build", "build"]).current_dir(&place));
    assert!(place.join("build/bespoke.dll").is_file(), "the package does not say where the DLL is");

    let files = sample::write_obj(&place);
    let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    let [garment, source, avatar, target, ..] = &names[..] else { panic!("the sample is {names:?}") };
    let words = ["--garment", garment, "--source-skeleton", source, "--avatar", avatar, "--target-skeleton", target];
    succeed(Command::new(retarget::program()).args(words).args(["--quiet", "-o", "linux.obj"]).current_dir(&place));
    let mut example = wine.program(&place.join("build/example.exe"), &place);
    let output = example.args(words).args(["--quiet", "-o", "c.obj"]).output().expect("wine runs");
    assert!(output.status.success(), "the example in C ended with {}", said(&output));
    same(&place.join("linux.obj"), &place.join("c.obj"));

    let mut dress = wine.program(&place.join("build/dress.exe"), &place);
    let output = dress.args([garment, source, avatar, target, "für c++.obj"]).output().expect("wine runs");
    assert!(output.status.success(), "the example in C++ ended with {}", said(&output));
    assert!(place.join("für c++.obj").is_file(), "the example in C++ wrote nothing");
}
