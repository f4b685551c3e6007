//! Elementary functions: known values, and that no source asks the system for others.

use std::fs;
use std::path::{Path, PathBuf};

use bespoke::maths;
use testing::process::root;

/// Within two units in the last place of `expected`.
fn near(found: f64, expected: f64) -> bool {
    found.to_bits().abs_diff(expected.to_bits()) <= 2
}

#[test]
fn values_are_right_to_the_last_digits() {
    for k in 1..2000 {
        let x = 0.01 * f64::from(k);
        assert!(near(maths::ln(x), x.ln()), "ln {x}");
        assert!(near(maths::log2(x), x.log2()), "log2 {x}");
        assert!(near(maths::log10(x), x.log10()), "log10 {x}");
        assert!(near(maths::exp(x), x.exp()), "exp {x}");
        assert!(near(maths::powf(x, 0.37), x.powf(0.37)), "powf {x}");
        assert!(near(maths::cbrt(x), x.cbrt()), "cbrt {x}");
        assert!(near(maths::sin(x), x.sin()) && near(maths::cos(x), x.cos()), "sin and cos {x}");
        assert_eq!(maths::sin_cos(x), (maths::sin(x), maths::cos(x)));
        assert!(near(maths::atan2(x, -3.0), x.atan2(-3.0)), "atan2 {x}");
        assert!(near(maths::acos(x / 20.0), (x / 20.0).acos()), "acos {x}");
    }
}

/// Bits that are the same with every compiler, system and processor.
#[test]
fn bits_are_pinned() {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for k in 1..100_000 {
        let x = f64::from(k) / 4096.0;
        let powers =
            [maths::ln(x), maths::log2(x), maths::log10(x), maths::exp(x), maths::powf(x, 1.7), maths::cbrt(x)];
        let angles = [maths::sin(x), maths::cos(x), maths::atan2(x, 1.0 - x), maths::acos(x / 25.0)];
        for byte in powers.iter().chain(&angles).flat_map(|value| value.to_bits().to_le_bytes()) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
    assert_eq!(hash, 0x1f52_5c11_c4dc_a9e7, "the bits have changed: {hash:#x}");
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// What the standard library and glam have of the system's maths library; also what the compiler works out beforehand would
/// be of the system that it runs on.
const OF_THE_SYSTEM: [&str; 39] = [
    "ln",
    "ln_1p",
    "log",
    "log2",
    "log10",
    "exp",
    "exp2",
    "exp_m1",
    "powf",
    "cbrt",
    "hypot",
    "sin",
    "cos",
    "tan",
    "sin_cos",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
    "gamma",
    "angle_between",
    "angle_to",
    "slerp",
    "rotate_towards",
    "to_axis_angle",
    "to_scaled_axis",
    "to_euler",
    "from_axis_angle",
    "from_scaled_axis",
    "from_rotation_arc",
    "from_rotation_x",
    "from_rotation_y",
    "from_rotation_z",
];

#[test]
fn the_sources_take_none_of_the_system() {
    let (mut files, mut faults) = (Vec::new(), Vec::new());
    sources(&root().join("src"), &mut files);
    assert!(files.len() > 100, "only {} sources were found", files.len());
    for file in files {
        let text = fs::read_to_string(&file).expect("a source");
        for (number, line) in text.lines().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            // A name after a dot or after the name of a type, in a call or as a function to hand over.
            let is_called = |name: &&&str| {
                let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
                let types =
                    ["f64::", "f32::", "DQuat::", "Quat::", "DVec3::", "Vec3::", "Vec3A::", "DMat3::", "DAffine3::"];
                code.match_indices(&format!(".{name}(")).next().is_some()
                    || types.iter().any(|of| {
                        let call = format!("{of}{name}");
                        code.match_indices(&call).any(|(at, _)| ends(&code[at + call.len()..]))
                    })
            };
            let names: Vec<_> = OF_THE_SYSTEM.iter().filter(is_called).collect();
            if !names.is_empty() {
                faults.push(format!("{}:{}: {names:?}", file.display(), number + 1));
            }
        }
    }
    assert!(faults.is_empty(), "call what crate::maths and crate::geometry::turn have:\n{}", faults.join("\n"));
}
