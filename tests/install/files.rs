//! Which files are installed where, and what is in them.

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use crate::prefix::{command, folder, install, installer, library_file, library_name, tree};
use testing::process::{root, succeed};

/// All files of an installation with the folders for programs, libraries and headers.
fn expected(bin: &str, lib: &str, include: &str) -> BTreeSet<String> {
    let names = |folder: &str, wanted: &[&str]| -> Vec<String> {
        let entries = fs::read_dir(root().join(folder)).expect("a folder of the sources");
        let names = entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name"));
        names.filter(|name| wanted.is_empty() || wanted.iter().any(|end| name.ends_with(end))).collect()
    };
    let doc = "share/doc/bespoke";
    let mut all: BTreeSet<String> = BTreeSet::new();
    all.insert(format!("{bin}/bespoke-retarget"));
    all.extend(["libbespoke.so", &library_name(), &library_file()].map(|name| format!("{lib}/{name}")));
    all.insert(format!("{lib}/pkgconfig/bespoke.pc"));
    all.extend(["Config", "ConfigVersion"].map(|name| format!("{lib}/cmake/Bespoke/Bespoke{name}.cmake")));
    all.extend(names("include", &[".h", ".hpp"]).iter().map(|name| format!("{include}/{name}")));
    all.extend(names("", &[".md", "LICENSE-MIT", "LICENSE-APACHE"]).iter().map(|name| format!("{doc}/{name}")));
    all.extend(names("docs", &[]).iter().map(|name| format!("{doc}/docs/{name}")));
    all
}

fn read(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|reason| panic!("{}: {reason}", path.display()))
}

/// What readelf tells of a program or library.
fn elf(option: &str, path: &Path) -> String {
    succeed(command("readelf").args([option, "--wide"]).arg(path))
}

#[test]
fn every_file_has_its_place_and_permissions() {
    let prefix = folder("places");
    install(&prefix, &[]);
    let tree = tree(&prefix);
    assert_eq!(tree, expected("bin", "lib", "include"));
    assert!(tree.contains("include/bespoke.h"));
    for name in &tree {
        let path = prefix.join(name);
        let runs = name.starts_with("bin/") || name.ends_with(&library_file());
        if !path.is_symlink() {
            let mode = fs::metadata(&path).expect("a file").permissions().mode() & 0o7777;
            assert_eq!(mode, if runs { 0o755 } else { 0o644 }, "{name} has mode {mode:o}");
        }
    }
    for (link, target) in [("libbespoke.so", library_name()), (&library_name(), library_file())] {
        let found = fs::read_link(prefix.join("lib").join(link)).expect("a link");
        assert_eq!(found, Path::new(&target), "{link} leads elsewhere");
    }
}

/// Neither who may read files by default nor what is there already makes a difference.
#[test]
fn a_closed_umask_and_an_older_installation_change_nothing() {
    let prefix = folder("umask");
    fs::create_dir_all(prefix.join("include")).expect("a folder");
    fs::create_dir_all(prefix.join("lib")).expect("a folder");
    fs::write(prefix.join("include/bespoke.h"), "older").expect("an older header");
    fs::set_permissions(prefix.join("include/bespoke.h"), PermissionsExt::from_mode(0o400)).expect("its mode");
    std::os::unix::fs::symlink("nowhere", prefix.join("lib/libbespoke.so")).expect("an older link");
    let mut closed = command("sh");
    let installer = installer(&prefix, &[]);
    closed.args(["-c", "umask 077; exec sh \"$@\"", "sh"]).args(installer.get_args()).env("PREFIX", &prefix);
    succeed(&mut closed);
    assert_eq!(tree(&prefix), expected("bin", "lib", "include"));
    assert_eq!(read(&prefix.join("include/bespoke.h")), read(&root().join("include/bespoke.h")));
    for (name, mode) in [("include/bespoke.h", 0o644), ("share/doc/bespoke", 0o755), ("lib/cmake", 0o755)] {
        let found = fs::metadata(prefix.join(name)).expect("it is there").permissions().mode() & 0o7777;
        assert_eq!(found, mode, "{name} has mode {found:o}");
    }
    assert!(
        fs::canonicalize(prefix.join("lib/libbespoke.so")).expect("the link leads somewhere").ends_with(library_file())
    );
}

#[test]
fn nothing_tells_where_it_was_built_or_installed() {
    let prefix = folder("secrets");
    install(&prefix, &[]);
    let secrets =
        [root().to_str(), prefix.to_str(), Some(env!("CARGO_TARGET_TMPDIR"))].map(|path| path.expect("UTF-8"));
    let mut texts = 0;
    for name in tree(&prefix) {
        if let Ok(text) = String::from_utf8(read(&prefix.join(&name))) {
            texts += 1;
            for secret in secrets {
                assert!(!text.contains(secret), "{name} mentions {secret}");
            }
            if name.ends_with(".pc") || name.ends_with(".cmake") {
                let forgotten = text.split('@').skip(1).find(|part| part.starts_with(|c: char| c.is_ascii_uppercase()));
                assert_eq!(forgotten, None, "{name} has a place that was not filled in");
            }
        }
    }
    assert!(texts > 6, "only {texts} of the files are text");
}

#[test]
fn library_and_program_name_what_they_need() {
    let prefix = folder("names");
    install(&prefix, &[]);
    let library = prefix.join("lib").join(library_file());
    let dynamic = elf("--dynamic", &library);
    assert!(dynamic.contains(&format!("soname: [{}]", library_name())), "{dynamic}");
    assert!(!dynamic.contains("RUNPATH") && !dynamic.contains("RPATH"), "{dynamic}");
    let needed = elf("--dynamic", &prefix.join("bin/bespoke-retarget"));
    assert!(needed.contains(&format!("Shared library: [{}]", library_name())), "{needed}");
    assert!(needed.contains("runpath: [$ORIGIN/../lib]"), "{needed}");
}

#[test]
fn debug_information_is_stripped_and_names_stay() {
    let (plain, whole) = (folder("strip"), folder("no strip"));
    install(&plain, &[]);
    install(&whole, &[("STRIP", "")]);
    let of = |prefix: &Path| prefix.join("lib").join(library_file());
    assert!(!elf("--sections", &of(&plain)).contains(".debug_"), "debug information is left");
    assert!(elf("--sections", &of(&whole)).contains(".debug_info"), "an empty STRIP does not keep it");
    // The names of functions, which the trace of a crash shows.
    assert!(elf("--sections", &of(&plain)).contains(".symtab"), "too much is stripped");
    let exported = |path: &Path| succeed(command("nm").args(["--dynamic", "--defined-only"]).arg(path));
    assert_eq!(exported(&of(&plain)), exported(&of(&whole)));
    assert!(exported(&of(&plain)).contains(" T bespoke_session_run\n"));
}

/// The program finds its library beside it, in a prefix that was staged, moved and whose folders have other names.
#[test]
fn staged_installation_with_other_folders_works_where_it_is_moved() {
    let place = folder("stage");
    let stage = place.join("stage");
    let staged = stage.to_str().expect("UTF-8");
    let folders = [
        ("DESTDIR", staged),
        ("BINDIR", "/opt/garments/programs/bin"),
        ("LIBDIR", "/opt/garments/programs/lib"),
        ("INCLUDEDIR", "/opt/garments//headers/"),
    ];
    install(Path::new("/opt/garments"), &folders);
    assert_eq!(tree(&stage), {
        let names = expected("programs/bin", "programs/lib", "headers");
        names.iter().map(|name| format!("opt/garments/{name}")).collect()
    });
    let moved = place.join("moved");
    fs::rename(stage.join("opt/garments"), &moved).expect("it can be moved");
    let said = succeed(command(moved.join("programs/bin/bespoke-retarget")).arg("--version"));
    assert!(said.contains(env!("CARGO_PKG_VERSION")), "{said}");
    let pc = String::from_utf8(read(&moved.join("programs/lib/pkgconfig/bespoke.pc"))).expect("text");
    assert!(pc.contains("includedir=${pcfiledir}/../../../headers\n"), "{pc}");
}
