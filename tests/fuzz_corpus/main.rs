//! The fuzz targets without a fuzzer: the committed corpus, then mutations of it from a fixed seed.
//!
//! Always the same inputs, so a failure here is a failure everywhere. The input under way is kept in
//! `CARGO_TARGET_TMPDIR`, where it is found after a crash. `FUZZ_INPUTS` sets the number of mutations; `make fuzz` goes
//! on from here with a fuzzer that looks at the code it reaches.

mod memory;

use std::fs;
use std::path::Path;

use testing::Random;

#[global_allocator]
static ALLOCATOR: memory::Counting = memory::Counting;

/// Longest input, but of files, which are longer.
const LONGEST: usize = 600;
const LONGEST_FILE: usize = 4096;

/// What reading a file may take: so much whatever its size, for small files may stand for something larger...
const FILE_MEMORY: usize = 1 << 26;
/// ... and so many times its size.
const FILE_TIMES: usize = 1024;

fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus").join(target);
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.expect("the corpus can be listed").path())
        .collect();
    paths.sort();
    assert!(!paths.is_empty(), "the corpus of {target} is empty");
    paths.iter().map(|path| fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))).collect()
}

/// Some of the bytes of one or two inputs of the corpus, with changes.
fn mutate(corpus: &[Vec<u8>], longest: usize, random: &mut Random) -> Vec<u8> {
    let mut below = |n: usize| (random.unit() * n as f64) as usize;
    let mut bytes = corpus[below(corpus.len())].clone();
    if below(3) == 0 {
        let other = &corpus[below(corpus.len())];
        bytes.truncate(below(bytes.len() + 1));
        bytes.extend(&other[below(other.len() + 1)..]);
    }
    for _ in 0..1 + below(8) {
        let place = below(bytes.len() + 1);
        match below(4) {
            0 => bytes.insert(place, below(256) as u8),
            1 if place < bytes.len() => drop(bytes.remove(place)),
            2 if place < bytes.len() => bytes[place] ^= 1 << below(8),
            _ if place < bytes.len() => bytes[place] = below(256) as u8,
            _ => bytes.extend((0..1 + below(32)).map(|_| below(256) as u8)),
        }
    }
    bytes.truncate(longest);
    bytes
}

/// Runs the corpus of `target`, then `mutations` more inputs of at most `longest` bytes.
fn replay(target: &str, longest: usize, mut run: impl FnMut(&[u8]), mutations: usize) {
    let mutations = match std::env::var("FUZZ_INPUTS") {
        Ok(number) => number.parse().expect("FUZZ_INPUTS is a number"),
        Err(_) => mutations,
    };
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{target}"));
    let corpus = corpus(target);
    let mut random = Random::new(1);
    let more: Vec<_> = (0..mutations).map(|_| mutate(&corpus, longest, &mut random)).collect();
    for bytes in corpus.iter().chain(&more) {
        fs::write(&kept, bytes).unwrap_or_else(|error| panic!("{}: {error}", kept.display()));
        run(bytes);
    }
    fs::remove_file(&kept).expect("the last input can be removed");
}

#[test]
fn any_sequence_of_calls_is_answered() {
    replay("calls", LONGEST, testing::fuzz::calls, 1000);
}

#[test]
fn any_memory_is_read_as_it_is_described_or_refused() {
    replay("buffers", LONGEST, testing::fuzz::buffers, 2500);
}

#[test]
fn any_garment_comes_out_without_an_intersection_or_is_refused() {
    let mut judged = 0;
    replay("meshes", LONGEST, |bytes| judged += u32::from(testing::fuzz::meshes(bytes)), 1000);
    assert!(judged > 0, "no input led to a result");
    println!("{judged} results were judged");
}

#[test]
fn any_file_is_read_or_refused_in_memory_of_its_size() {
    let (mut whole, mut most) = (0, 0);
    replay(
        "files",
        LONGEST_FILE,
        |bytes| {
            let (held, read) = memory::most_during(|| testing::fuzz::files(bytes));
            let may = FILE_MEMORY + FILE_TIMES * bytes.len();
            assert!(held <= may, "{held} bytes of memory for a file of {}", bytes.len());
            (whole, most) = (whole + read, most.max(held));
        },
        6000,
    );
    assert!(whole > 50, "only {whole} files were whole");
    println!("{whole} files were whole; at most {most} bytes of memory");
}

/// Each file of the corpus that lies is refused, with the place in it.
#[test]
fn files_that_lie_are_refused_with_the_place() {
    let right = [
        "character",
        "fan",
        "flat",
        "many_instances",
        "odd_corners",
        "strip",
        "text",
        "vrm_one",
        "vrm_zero",
        "zeros_as_padding",
    ];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus/files");
    for entry in fs::read_dir(folder).expect("the corpus can be listed") {
        let path = entry.expect("the corpus can be listed").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let said = testing::fuzz::file(&fs::read(&path).expect("it can be read"));
        match said {
            Ok(()) => assert!(right.contains(&name.as_str()), "{name} was read"),
            Err(error) => {
                assert!(!right.contains(&name.as_str()), "{name}: {error}");
                println!("{name}: {error}");
                let said = error.to_string();
                assert!(
                    said.starts_with('/') || said.starts_with("byte ") || said.starts_with("JSON: "),
                    "{name}: {said}"
                );
            }
        }
    }
}
