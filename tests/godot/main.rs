//! The Godot add-on in the real engine: what tests/godot/project/*.gd say of it holds, and characters of files come out with the
//! bits that the C API gives for the same arrays.
//!
//! `make test-godot` fetches the engine (engine.sh) and builds the add-on. Without these, all of this is skipped.

mod bits;
mod engine;

use std::fs;
use std::path::Path;

use closet::avatars::Avatar;
use closet::mesh::Mesh;
use closet::rigs::{Body, Character, Naming, Pose, character, y_up};
use closet::{Kind, garments};
use engine::{ends_well, passes, project};
use glam::{DAffine3, DQuat, DVec3};
use testing::glb::{Part, glb};
use testing::process::root;

/// The mannequin, whose joints have the names of Unreal.
fn source() -> Character {
    character(&Body::Mannequin.model(), Naming::Unreal).placed(y_up())
}

/// In the axes of the engine.
fn standing(mut mesh: Mesh) -> Mesh {
    mesh.positions.iter_mut().for_each(|p| *p = y_up().transform_point3(*p));
    mesh
}

/// Its vest.
fn vest() -> Character {
    source().wears(&standing(garments::vest(2.5).mesh))
}

/// The slim body, whose joints have the names of Mixamo, in another place and facing another way.
fn avatar() -> Character {
    let turn = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let frame = DAffine3::from_rotation_translation(turn, DVec3::new(0.3, 0.0, -0.2));
    character(&Body::Avatar(Avatar::Slim).model(), Naming::Mixamo).placed(y_up()).placed(frame)
}

/// The same, with arms that hang so near to the trunk that its sides pass through them: no garment lets them go there.
fn folded() -> Character {
    let arms = [DVec3::new(0.05, 0.0, -1.0), DVec3::new(0.1, -0.1, -1.0)];
    let slim = character(&Body::Avatar(Avatar::Slim).model(), Naming::Mixamo);
    slim.posed(&Pose { arms: Some(arms), ..Pose::BIND }).placed(y_up())
}

/// Characters as files: the one that wears a garment, and the one to dress.
fn write_characters(folder: &Path, name: &str, garment: &Character, avatar: &Character) {
    let write =
        |name: &str, parts: &[Part]| fs::write(folder.join(name), glb(parts)).expect("the folder can be written");
    write(
        "outfit.glb",
        &[
            Part { node: "Mannequin_Body", material: "Skin", mesh: &source() },
            Part { node: name, material: "Wool", mesh: garment },
        ],
    );
    write("avatar.glb", &[Part { node: "Body", material: "Body", mesh: avatar }]);
}

/// The characters that all files of tests take.
fn write_usual(folder: &Path) {
    write_characters(folder, "Mannequin_Vest", &vest(), &avatar());
    let part = Part { node: "Body", material: "Body", mesh: &folded() };
    fs::write(folder.join("folded.glb"), glb(&[part])).expect("the folder can be written");
    let help = "BespokeRetarget.xml";
    fs::copy(root().join("bindings/godot/doc_classes").join(help), folder.join(help)).expect("a file can be copied");
}

/// A test for each file.
macro_rules! files {
    ($($name:ident)*) => {
        const FILES: &[&str] = &[$(stringify!($name)),*, "test_scenes"];
        $(
            #[test]
            fn $name() {
                let Some(project) = project(stringify!($name)) else { return };
                write_usual(&project.data());
                passes(&project, stringify!($name));
            }
        )*
    };
}

files! { test_flaws test_help test_inputs test_results test_running test_shapes test_vertices }

#[test]
fn same_bits_as_in_c() {
    let Some(project) = project("test_scenes") else { return };
    write_usual(&project.data());
    passes(&project, "test_scenes");
    bits::compare(&project.data());
}

/// The jacket of `make demo` on its heavy body.
#[test]
fn sample_has_the_bits_of_c() {
    let Some(project) = project("sample") else { return };
    let jacket = source().wears(&standing(closet::sample(Kind::Jacket).mesh));
    let heavy = character(&Body::Avatar(Avatar::Heavy).model(), Naming::Mixamo).placed(y_up());
    write_characters(&project.data(), "Jacket", &jacket, &heavy);
    passes(&project, "test_scenes");
    bits::compare(&project.data());
}

/// The editor without a window: the dock is there, and its buttons do what they say.
#[test]
fn dock() {
    let Some(project) = project("dock") else { return };
    write_usual(&project.data());
    ends_well("the stage", &project.run(60, &["--headless", "--script", "stage.gd", "--", "data"]), "");
    let output = project.run(240, &["--headless", "--editor", "--", "dock"]);
    ends_well("the dock", &output, "ran the dock");
}

/// A user's first start: a project that was never opened before, in which the add-on is copied and switched on.
#[test]
fn first_start() {
    let Some(project) = project("first") else { return };
    project.forget();
    let output = project.run(240, &["--headless", "--editor", "--", "first"]);
    ends_well("the first start", &output, "ran the first start");
}

/// A game that was exported finds the library, and dresses.
#[test]
fn exported_game() {
    let Some(project) = project("exported") else { return };
    write_usual(&project.data());
    let Some(game) = project.export() else { return };
    for file in ["game.pck", "libbespoke_godot.so"] {
        assert!(game.join(file).exists(), "{file} was not exported");
    }
    let arguments = [game.join("game.x86_64"), "--headless".into(), "--".into(), project.data()];
    let Some(output) = project.run_inside(120, &arguments.each_ref().map(|one| one.as_os_str())) else { return };
    let [said, complained] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    // The engine's system has no shell, which it complains of as it begins.
    let is_good = output.status.success() && said.contains("dressed in game.x86_64");
    assert!(is_good && !complained.contains("FAILED") && !complained.contains("SCRIPT ERROR"), "{said}\n{complained}");
}

/// What the class has, by its help, is tried somewhere.
#[test]
fn every_method_and_signal_is_tried() {
    let help = fs::read_to_string(root().join("bindings/godot/doc_classes/BespokeRetarget.xml")).expect("the help");
    let folder = root().join("tests/godot/project");
    let tests =
        FILES.iter().map(|name| fs::read_to_string(folder.join(format!("{name}.gd"))).expect("a file of tests"));
    let tests = tests.collect::<Vec<_>>().join("\n");
    let mut count = 0;
    for kind in ["method", "signal", "member"] {
        for rest in help.split(&format!("<{kind} name=\"")).skip(1) {
            let name = rest.split('"').next().expect("a name");
            let uses = [format!(".{name}("), format!(".{name}."), format!(".{name} ")];
            assert!(uses.iter().any(|used| tests.contains(used)), "no test tries {kind} {name}");
            count += 1;
        }
    }
    assert!(count > 50, "the help has {count} methods, signals and properties");
}

#[test]
fn every_file_is_run() {
    let files = fs::read_dir(root().join("tests/godot/project")).expect("the folder");
    let mut found: Vec<_> = files
        .filter_map(|entry| entry.expect("an entry").file_name().into_string().ok())
        .filter_map(|name| name.strip_suffix(".gd").map(str::to_string))
        .filter(|name| name.starts_with("test_"))
        .collect();
    let mut run_here = FILES.to_vec();
    found.sort_unstable();
    run_here.sort_unstable();
    assert_eq!(found, run_here);
}
