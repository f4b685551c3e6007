//! How long it takes until a request to stop is answered, on real and on finer meshes.

use std::collections::BTreeMap;
use std::thread;
use std::time::{Duration, Instant};

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::{Options, Session};

use super::assets::load;
use testing::Random;

/// Splits the triangles with an edge that `split` wants halved, so that neighbours fit.
fn refine(mesh: &mut TriangleMesh, split: impl Fn(u32, u32) -> bool) {
    let mut middles = BTreeMap::new();
    let mut triangles = Vec::new();
    for t in &mesh.triangles {
        let mut middle = |k: usize| {
            let (a, b) = (t[k].min(t[(k + 1) % 3]), t[k].max(t[(k + 1) % 3]));
            split(a, b).then(|| {
                *middles.entry((a, b)).or_insert_with(|| {
                    let p = mesh.positions[a as usize].midpoint(mesh.positions[b as usize]);
                    mesh.positions.push(p);
                    mesh.positions.len() as u32 - 1
                })
            })
        };
        // Around the triangle, corners and middles: an outline that is fanned from a middle, or cut into four.
        let [a, b, c] = *t;
        match [middle(0), middle(1), middle(2)] {
            [None, None, None] => triangles.push(*t),
            [Some(x), Some(y), Some(z)] => triangles.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]]),
            [Some(x), None, None] => triangles.extend([[a, x, c], [x, b, c]]),
            [None, Some(x), None] => triangles.extend([[b, x, a], [x, c, a]]),
            [None, None, Some(x)] => triangles.extend([[c, x, b], [x, a, b]]),
            [Some(x), Some(y), None] => triangles.extend([[x, b, y], [a, x, y], [a, y, c]]),
            [None, Some(x), Some(y)] => triangles.extend([[x, c, y], [b, x, y], [b, y, a]]),
            [Some(y), None, Some(x)] => triangles.extend([[x, a, y], [c, x, y], [c, y, b]]),
        }
    }
    mesh.triangles = triangles;
}

pub fn as_it_is(_: &mut TriangleMesh) {}

/// All edges halved.
pub fn finer(mesh: &mut TriangleMesh) {
    refine(mesh, |_, _| true);
}

/// About 30,000 vertices out of 3,600: all edges halved once, half of them twice.
pub fn fine(mesh: &mut TriangleMesh) {
    finer(mesh);
    let half = mesh.positions.len() as u32 * 6 / 10;
    refine(mesh, |a, b| a < half && b < half);
}

struct Answers {
    latencies: Vec<Duration>,
    drains: Vec<Duration>,
    stages: [usize; 2],
}

/// Cancels at random moments of the first `span` of a run.
fn measure(session: &mut Session, span: Duration, rounds: usize, seed: u64) -> Answers {
    let mut random = Random::new(seed);
    let mut answers = Answers { latencies: Vec::new(), drains: Vec::new(), stages: [0; 2] };
    for _ in 0..rounds {
        let control = session.control();
        let wait = span.mul_f64(random.unit());
        let other = thread::spawn(move || {
            thread::sleep(wait);
            let asked = Instant::now();
            control.cancel();
            asked
        });
        let outcome = session.run();
        let returned = Instant::now();
        let asked = other.join().unwrap();
        if let Err(error) = outcome {
            assert_eq!(error.kind, ErrorKind::Cancelled, "{error}");
            answers.latencies.push(returned.saturating_duration_since(asked));
            let prepared = session.stage() != Stage::Setup;
            answers.stages[usize::from(prepared)] += 1;
            assert_eq!(session.garment_positions().is_ok(), prepared);
        }
        let clock = Instant::now();
        session.reset();
        answers.drains.push(clock.elapsed());
    }
    answers
}

/// Prints a line for each case: `cargo test --release --test session cancel:: -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes, and its figures are only good on a quiet machine"]
fn figures_of_real_meshes() {
    /// A garment, what is done to its mesh, seconds of its run, and requests.
    type Case = (&'static str, fn(&mut TriangleMesh), u64, usize);
    let cases: [Case; 3] =
        [("Puffer_dense", as_it_is, 12, 16), ("jumpsuit_dense", as_it_is, 20, 16), ("jumpsuit_dense", fine, 60, 8)];
    for (garment, change, seconds, rounds) in cases {
        let Some(mut session) = load(garment, "Goblin", Options::default(), change) else { return };
        let vertices = session.garment_vertex_count().unwrap();
        let mut found = measure(&mut session, Duration::from_secs(seconds), rounds, 3);
        found.latencies.sort_unstable();
        found.drains.sort_unstable();
        let ms = |list: &[Duration], k: usize| list[k].as_secs_f64() * 1e3;
        let (l, d) = (&found.latencies, &found.drains);
        println!(
            "{garment} with {vertices} vertices on Goblin: {} of {rounds} answered ({} in prepare); median {:.1} ms, worst \
             {:.1} ms; work left behind ended after {:.0} ms in the median, {:.0} ms at worst",
            l.len(),
            found.stages[0],
            ms(l, l.len() / 2),
            ms(l, l.len() - 1),
            ms(d, d.len() / 2),
            ms(d, d.len() - 1),
        );
        assert!(ms(l, l.len() - 1) < 1000.0);
    }
}
