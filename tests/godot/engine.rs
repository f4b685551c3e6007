//! Projects with the add-on, and the engine that runs them.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use testing::process::{root, scratch};

/// A project of its own for one test.
pub struct Project {
    engine: PathBuf,
    folder: PathBuf,
}

/// A file or folder that `make test-godot` leaves.
fn made(variable: &str, usual: &str) -> Option<PathBuf> {
    let path = env::var_os(variable).map_or_else(|| root().join(usual), PathBuf::from);
    let is_there = path.exists();
    if !is_there {
        println!("SKIPPED: there is no {} (make test-godot)", path.display());
    }
    is_there.then_some(path)
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder to copy") {
        let path = entry.expect("an entry").path();
        let there = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy(&path, &there);
        } else {
            fs::copy(&path, &there).expect("a file can be copied");
        }
    }
}

/// The project of the tests with the add-on in it, or none where engine or add-on are missing.
pub fn project(name: &str) -> Option<Project> {
    let engine = made("BESPOKE_GODOT", "build/godot/godot")?;
    let addon = made("BESPOKE_GODOT_ADDON", "build/godot-addon")?;
    let folder = scratch(&format!("godot-{name}"));
    copy(&root().join("tests/godot/project"), &folder);
    copy(&addon, &folder);
    fs::create_dir_all(folder.join("data")).expect("a folder");
    fs::write(folder.join("data/.gdignore"), "").expect("a file");
    // Known before the first start: one that imports a project with a new extension may crash as it ends, in 4.5 to 4.7.
    fs::create_dir_all(folder.join(".godot")).expect("a folder");
    fs::write(folder.join(".godot/extension_list.cfg"), "res://addons/bespoke/bespoke.gdextension\n").expect("a file");
    let classes = "list=[{\"base\": &\"Node\", \"class\": &\"Checks\", \"icon\": \"\", \"is_abstract\": false, \"is_tool\": \
                   false, \"language\": &\"GDScript\", \"path\": \"res://checks.gd\"}]\n";
    fs::write(folder.join(".godot/global_script_class_cache.cfg"), classes).expect("a file");
    Some(Project { engine, folder })
}

impl Project {
    /// As it is before anybody has opened it, with the add-on switched off.
    pub fn forget(&self) {
        fs::remove_dir_all(self.folder.join(".godot")).expect("what the engine remembers");
        let project = self.folder.join("project.godot");
        let text = fs::read_to_string(&project).expect("there is a project");
        let without = text.replace("\"res://addons/bespoke/plugin.cfg\", ", "");
        assert!(without != text, "the add-on is not switched on");
        fs::write(&project, without).expect("a file");
    }

    /// Where tests read and write.
    pub fn data(&self) -> PathBuf {
        self.folder.join("data")
    }

    /// Runs the engine in the project, for so many seconds at most: a script that fails early leaves it running for ever.
    pub fn run(&self, seconds: u32, arguments: &[&str]) -> Output {
        let mut all = vec![self.engine.as_os_str(), OsStr::new("--path"), self.folder.as_os_str()];
        all.extend(arguments.iter().map(OsStr::new));
        self.run_program(seconds, &all)
    }

    /// The game that is made of the project, in a folder of its own; none where there is no template for it.
    pub fn export(&self) -> Option<PathBuf> {
        let presets = self.folder.join("export_presets.cfg");
        let template = made("BESPOKE_GODOT_TEMPLATE", "build/godot/root/usr/bin/godot-template-release")?;
        let text = fs::read_to_string(&presets).expect("the project has a preset");
        fs::write(&presets, text.replace("TEMPLATE", template.to_str().expect("UTF-8"))).expect("a file");
        // The editor of the other tests is not to open it.
        let project = self.folder.join("project.godot");
        let text = fs::read_to_string(&project).expect("there is a project");
        let begins = "[application]\n\nrun/main_scene=\"res://exported.tscn\"";
        fs::write(&project, text.replace("[application]", begins)).expect("a file");
        fs::create_dir_all(self.folder.join("out")).expect("a folder");
        let output = self.run(120, &["--headless", "--export-release", "Linux", "out/game.x86_64"]);
        ends_well("the export", &output, "");
        let game = scratch("godot-game");
        copy(&self.folder.join("out"), &game);
        Some(game)
    }

    /// Runs a program of the engine's system, which is unpacked beside it: a game looks for its libraries beside itself, and by the
    /// loader it would not know where that is. None where this system has no name spaces.
    pub fn run_inside(&self, seconds: u32, arguments: &[&OsStr]) -> Option<Output> {
        let has_spaces = Command::new("unshare").args(["--map-root-user", "--mount", "true"]).output();
        if !has_spaces.is_ok_and(|output| output.status.success()) {
            println!("SKIPPED: a game that was exported, for this system gives no name spaces");
            return None;
        }
        let enter = made("BESPOKE_GODOT_ENTER", "build/godot/enter")?;
        Some(self.run_program(seconds, &[&[enter.as_os_str()], arguments].concat()))
    }

    fn run_program(&self, seconds: u32, arguments: &[&OsStr]) -> Output {
        let mut command = Command::new("timeout");
        command.arg("--kill-after=5").arg(seconds.to_string());
        // A home of its own: settings and caches of whoever runs the tests stay as they are.
        for variable in ["HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"] {
            command.env(variable, self.folder.join("home"));
        }
        command.args(arguments).output().expect("timeout is a program of every system")
    }
}

/// It ended with 0, said this, and had nothing to complain of: leaks, and errors in scripts that go on.
#[track_caller]
pub fn ends_well(what: &str, output: &Output, says: &str) {
    let [said, complained] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    let all = format!("{what}: {}\n{said}\n{complained}", output.status);
    assert!(output.status.success() && said.contains(says), "{all}");
    for line in complained.lines() {
        assert!(!line.contains("ERROR") && !line.contains("WARNING") && !line.contains("FAILED"), "{all}");
    }
}

/// All tests of one file pass.
#[track_caller]
pub fn passes(project: &Project, file: &str) {
    let output = project.run(240, &["--headless", "--script", "run.gd", "--", &format!("{file}.gd"), "data"]);
    ends_well(file, &output, "\nran ");
}
