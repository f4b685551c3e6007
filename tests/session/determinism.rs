//! The same input gives the same bits: from run to run, with any number of threads, beside other sessions, and on every
//! system the bits that are written down here.

use std::thread;

use bespoke::control::Stage;
use bespoke::options::Options;
use bespoke::session::Session;
use glam::DVec3;

use crate::small::session;

/// The bits of a small retarget for each class of processors that it was run on. Where the numbers change on purpose, the
/// test fails with the line to put here; on another class of processors it prints it.
///
/// Linear algebra chooses its kernels by the processor, and these round differently. Nothing depends on the system.
const PINNED: &[(&str, u64)] = &[("x86_64 avx512f", 0x52e4_c3f3_b319_d489)];

fn processor_class() -> String {
    #[cfg(target_arch = "x86_64")]
    let kernels = if is_x86_feature_detected!("avx512f") {
        "avx512f"
    } else if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        "avx2+fma"
    } else {
        "sse2"
    };
    #[cfg(not(target_arch = "x86_64"))]
    let kernels = "plain";
    format!("{} {kernels}", std::env::consts::ARCH)
}

/// FNV-1a over the bytes of the bits.
fn hash(bits: &[u64]) -> u64 {
    bits.iter()
        .flat_map(|word| word.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn finished_bits(mut session: Session, threads: u32) -> Vec<u64> {
    // Also more threads than this machine has cores.
    session.crowd();
    session.set_options(Options { threads, ..Options::default() }).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    session.garment_positions().unwrap().iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect()
}

#[test]
fn a_retarget_gives_the_pinned_bits_with_any_number_of_threads() {
    let run = |threads| finished_bits(session(1.0, DVec3::new(0.5, -2.0, 1.0)), threads);
    let first = run(1);
    for threads in [1, 2, 16] {
        assert!(first == run(threads), "other bits with {threads} threads");
    }
    let (class, found) = (processor_class(), hash(&first));
    match PINNED.iter().find(|(name, _)| *name == class) {
        Some(&(_, pinned)) => {
            assert_eq!(found, pinned, "the bits have changed; if they should, pin them: (\"{class}\", {found:#x})")
        }
        None => {
            eprintln!("skipped: the comparison with pinned bits, for there are none for (\"{class}\", {found:#x})")
        }
    }
}

#[test]
fn eight_sessions_at_once_give_the_same_bits_as_one_after_another() {
    // Each its own scale and place, so that one session's numbers in another's would show.
    let run = |k: u32| finished_bits(session(0.5 + f64::from(k) / 8.0, DVec3::splat(f64::from(k))), 1 + k % 3);
    let alone: Vec<_> = (0..8).map(run).collect();
    assert!((1..8).all(|k| alone[k] != alone[0]));
    let threads: Vec<_> = (0..8).map(|k| thread::spawn(move || run(k))).collect();
    for (k, thread) in threads.into_iter().enumerate() {
        assert!(thread.join().unwrap() == alone[k], "session {k} has other bits beside the others");
    }
}
