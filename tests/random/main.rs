//! Properties of random retargets and random meshes. A failure is kept as a seed in `regressions.txt` beside this file.

mod bad_meshes;
mod bad_rigs;
mod outcomes;
mod step_verifier;
mod steps;

use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};

use testing::scene::{Flaw, Recipe};

/// `cases` new cases after those that failed before. From a fixed seed, so that a run says something about the code and
/// not about luck; `PROPTEST_RNG_SEED` takes another.
fn config(cases: u32) -> Config {
    let regressions = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/random/regressions.txt");
    Config {
        cases,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(regressions))),
        rng_seed: match Config::default().rng_seed {
            RngSeed::Random => RngSeed::Fixed(3),
            chosen => chosen,
        },
        // Scenes take a second: a handful of attempts at a simpler one, not thousands.
        max_shrink_iters: 20,
        ..Config::default()
    }
}

fn sound() -> impl Strategy<Value = Recipe> {
    any::<u64>().no_shrink().prop_map(Recipe::sound)
}

/// Shrinks by leaving flaws out.
fn flawed() -> impl Strategy<Value = Recipe> {
    let flaws = prop::sample::subsequence(Flaw::ALL.to_vec(), 1..=3);
    (any::<u64>().no_shrink(), flaws).prop_map(|(seed, flaws)| Recipe { seed, flaws })
}
