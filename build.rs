//! Builds the C++ shim around OpenVDB and links it, and says what kind of shared library comes out.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folders to look in before the system's: `OPENVDB_ROOT` holds `include` and `lib`.
const ROOT: &str = "OPENVDB_ROOT";

/// Folder with `include` and `lib` that `packaging/dist/static.mk` made: OpenVDB and oneTBB become part of the library,
/// and the C++ runtime with them, so that it needs none of them on the machine it runs on.
const STATIC_ROOT: &str = "BESPOKE_STATIC_OPENVDB";

/// Folder that `packaging/dist/floor/stubs.sh` made: libraries to link against in place of the system's C library, so that
/// the library runs with older ones.
const FLOOR: &str = "BESPOKE_GLIBC_FLOOR";

/// The number in the name by which the loader finds the library, `BESPOKE_ABI_VERSION`; a test compares them.
const ABI: u32 = 2;

fn main() {
    shim();
    shared_library();
}

/// The C++ shim and the libraries beneath it.
fn shim() {
    for path in ["cpp_shim/volume.cpp", "cpp_shim/volume.h", "cpp_shim/team.h", "cpp_shim/probe.cpp", "build.rs"] {
        println!("cargo:rerun-if-changed={path}");
    }
    println!("cargo:rerun-if-env-changed={ROOT}");
    println!("cargo:rerun-if-env-changed={STATIC_ROOT}");
    println!("cargo:rerun-if-env-changed={FLOOR}");
    let static_root = env::var_os(STATIC_ROOT).map(PathBuf::from);
    let root = static_root.clone().or_else(|| env::var_os(ROOT).map(PathBuf::from));

    let mut build = cc::Build::new();
    // The voxeliser is two orders slower without optimisation, so the profile does not decide.
    build.cpp(true).std("c++17").opt_level(2).warnings(true).extra_warnings(true);
    // A product and a sum are rounded each, also where the processor could do both at once: the same bits everywhere.
    build.flag_if_supported("-ffp-contract=off");
    // Half floats are only named by the headers, never used: no need to link Imath for its table.
    build.define("IMATH_HALF_NO_LOOKUP_TABLE", None);
    if let Some(root) = &static_root {
        // As the headers of a system, whose warnings are not ours to see.
        build
            .flag("-isystem")
            .flag(root.join("include"))
            .flag("-fvisibility=hidden")
            .flag("-fvisibility-inlines-hidden");
        build.define("NDEBUG", None).cpp_link_stdlib(None);
        // Without it the headers take every name for one of a library to load, where the compiler is MinGW's.
        build.define("OPENVDB_STATICLIB", None);
    } else if let Some(root) = &root {
        build.include(root.join("include"));
    }
    let mut probe = build.clone();
    if probe.file("cpp_shim/probe.cpp").cargo_warnings(false).try_expand().is_err() {
        eprintln!(
            "error: the C++ compiler does not find the headers of OpenVDB 10 or later, oneTBB and Boost: install them \
             (Debian, Ubuntu: apt install g++ libopenvdb-dev libboost-dev), or set {ROOT} to the folder that holds their include and lib."
        );
        std::process::exit(1);
    }
    build.file("cpp_shim/volume.cpp").compile("bespoke_volume");

    if let Some(root) = &root {
        println!("cargo:rustc-link-search=native={}", root.join("lib").display());
    }
    if static_root.is_none() {
        println!("cargo:rustc-link-lib=openvdb");
        println!("cargo:rustc-link-lib=tbb");
        return;
    }
    println!("cargo:rustc-link-search=native={}", standard_library(&build).display());
    for library in ["openvdb", "tbb", "stdc++"] {
        println!("cargo:rustc-link-lib=static:-bundle={library}");
    }
    // GCC asks for it weakly, which draws nothing out of a static library, and leaves it to the host to have one.
    println!("cargo:rustc-cdylib-link-arg=-Wl,--undefined=__cxa_pure_virtual");
    if let Some(floor) = env::var_os(FLOOR) {
        println!("cargo:rustc-cdylib-link-arg=-L{}", Path::new(&floor).display());
        println!("cargo:rustc-cdylib-link-arg=-lfloor");
    }
}

/// The folder in which the compiler has its C++ runtime as a static library.
fn standard_library(build: &cc::Build) -> PathBuf {
    let output = build.get_compiler().to_command().arg("-print-file-name=libstdc++.a").output();
    let file = output.ok().and_then(|output| String::from_utf8(output.stdout).ok()).unwrap_or_default();
    match Path::new(file.trim()).parent() {
        Some(folder) if folder.is_absolute() => folder.to_path_buf(),
        _ => {
            eprintln!(
                "error: the C++ compiler has no libstdc++.a, which {STATIC_ROOT} asks for: take GCC's with its libraries."
            );
            std::process::exit(1);
        }
    }
}

/// What Windows shows of a DLL in its properties, and installers compare.
fn version_resource() {
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo says where to write"));
    let version = env::var("CARGO_PKG_VERSION").expect("cargo says the version");
    let numbers = format!("{},0", version.split(['-', '+']).next().unwrap_or_default().replace('.', ","));
    let [description, licence] =
        ["CARGO_PKG_DESCRIPTION", "CARGO_PKG_LICENSE"].map(|name| env::var(name).unwrap_or_default());
    let text = format!(
        "1 VERSIONINFO\nFILEVERSION {numbers}\nPRODUCTVERSION {numbers}\nFILEOS 0x40004\nFILETYPE 0x2\nBEGIN\n\
         BLOCK \"StringFileInfo\"\nBEGIN\nBLOCK \"040904b0\"\nBEGIN\n\
         VALUE \"ProductName\", \"Bespoke\"\nVALUE \"FileDescription\", \"{description}\"\n\
         VALUE \"FileVersion\", \"{version}\"\nVALUE \"ProductVersion\", \"{version}\"\n\
         VALUE \"Comments\", \"binary interface {ABI}\"\nVALUE \"LegalCopyright\", \"{licence}\"\n\
         VALUE \"OriginalFilename\", \"bespoke.dll\"\nVALUE \"InternalName\", \"bespoke\"\nEND\nEND\n\
         BLOCK \"VarFileInfo\"\nBEGIN\nVALUE \"Translation\", 0x409, 1200\nEND\nEND\n"
    );
    let (source, object) = (folder.join("version.rc"), folder.join("version.o"));
    std::fs::write(&source, text).expect("OUT_DIR can be written to");
    let made = Command::new("x86_64-w64-mingw32-windres").arg(&source).arg(&object).status();
    // Elsewhere than on a cross-compiling machine it has no prefix.
    let made = made.or_else(|_| Command::new("windres").arg(&source).arg(&object).status());
    match made {
        Ok(status) if status.success() => println!("cargo:rustc-cdylib-link-arg={}", object.display()),
        _ => {
            eprintln!("error: windres, which belongs to MinGW's tools, did not make the version of the library");
            std::process::exit(1);
        }
    }
}

/// Name and manners of the shared library.
fn shared_library() {
    if env::var("TARGET").is_ok_and(|target| target.ends_with("-windows-gnu")) {
        version_resource();
        // The same bytes for the same sources.
        println!("cargo:rustc-link-arg=-Wl,--no-insert-timestamp");
    }
    let arguments: &[&str] = match env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("linux") => &[
            &format!("-soname,libbespoke.so.{ABI}"),
            // What the threads of the host have to destroy as they end outlives the last session: a library that were
            // really unloaded would take the code from under them.
            "-z,nodelete",
            // Two copies in one process, of two plugins, must never call into each other.
            "-Bsymbolic",
        ],
        Ok("macos") => &[&format!("-install_name,@rpath/libbespoke.{ABI}.dylib")],
        _ => &[],
    };
    for argument in arguments {
        println!("cargo:rustc-cdylib-link-arg=-Wl,{argument}");
    }
}
