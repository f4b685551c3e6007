//! Foreign projects that are built against the folder with MinGW: by its CMake package, in C and in C++.

use std::fs;
use std::process::Command;

use crate::shipped::{CROSS, folder};
use crate::wine::{said, same, wine};
use testing::process::{is_there, scratch, succeed};
use testing::{retarget, sample};

#[test]
fn examples_are_built_with_cmake_and_run() {
    let (Some(folder), Some(wine)) = (folder(), wine()) else { return };
    if !is_there("cmake") {
        return;
    }
    let place = scratch("windows-cmake");
    let project = "cmake_minimum_required(VERSION 3.16)\n\
                   project(example C CXX)\n\
                   set(CMAKE_CXX_STANDARD 17)\n\
                   find_package(Bespoke 0.1 REQUIRED)\n\
                   file(GLOB sources \"${FOLDER}/examples_c/*.c\")\n\
                   add_executable(example ${sources})\n\
                   target_compile_definitions(example PRIVATE __USE_MINGW_ANSI_STDIO=1)\n\
                   add_executable(dress \"${FOLDER}/bindings/cpp/dress.cpp\")\n\
                   foreach(program IN ITEMS example dress)\n\
                     target_link_libraries(${program} PRIVATE Bespoke::bespoke)\n\
                     target_link_options(${program} PRIVATE -static)\n\
                   endforeach()\n\
                   add_custom_command(TARGET dress POST_BUILD COMMAND ${CMAKE_COMMAND} -E copy\n\
                     $<TARGET_FILE:Bespoke::bespoke> $<TARGET_FILE_DIR:dress>)\n";
    fs::write(place.join("CMakeLists.txt"), project).expect("the project can be written");
    let mut configure = Command::new("cmake");
    configure.args(["-S", ".", "-B", "build", "-DCMAKE_SYSTEM_NAME=Windows", "-DCMAKE_BUILD_TYPE=Release"]);
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
