//! The kernels of an iteration, one by one, with one thread: the closet's jacket half way through its fit.
//!
//!     cargo bench -p bench --bench kernels -- [part of a name]

mod moment;

use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

use bespoke::control::Cancel;
use bespoke::sdf::{Field, FieldOptions};
use bespoke::solver::Term;
use bespoke::solver::assembly::{System, values};
use bespoke::solver::newton::Model;
use bespoke::solver::pattern::{PairCollector, Pattern};
use bespoke::solver::profile::{Profile, TermTime};
use bespoke::verify::intersections;
use criterion::{Bencher, Criterion};
use moment::Moment;

/// The terms that take time.
const TERMS: [&str; 3] = ["surface", "barrier", "fit"];

fn main() -> Result<(), Box<dyn Error>> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let mut criterion = Criterion::default()
        .without_plots()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3))
        .configure_from_args();
    let mut moment = Moment::new()?;
    assembly(&mut criterion, &moment);
    term_values(&mut criterion, &moment);
    linear_algebra(&mut criterion, &mut moment)?;
    contact(&mut criterion, &mut moment);
    whole_meshes(&mut criterion, &moment);
    criterion.final_summary();
    Ok(())
}

/// Measures by the library's own clocks: `once` does the work, and tells how much of the time counts.
fn clocked(bencher: &mut Bencher<'_>, mut once: impl FnMut() -> Duration) {
    bencher.iter_custom(|iterations| (0..iterations).map(|_| once()).sum());
}

/// The whole linear system, and the derivatives of one term with their way into it.
fn assembly(criterion: &mut Criterion, moment: &Moment) {
    let at = moment.state.configuration();
    let terms = moment.objective.terms();
    let pattern = pattern(moment, &terms);
    let mut system = System::default();
    criterion.bench_function("assembly", |bencher| {
        bencher.iter(|| system.assemble(&pattern, black_box(&terms), at));
    });
    for name in TERMS {
        criterion.bench_function(&format!("derivatives/{name}"), |bencher| {
            clocked(bencher, || {
                let term = one(&terms, name);
                system.assemble(&pattern, black_box(&term), at).expect("nobody cancels");
                let mut profile = Profile::default();
                system.note_times(&term, &mut profile);
                total(&profile, |time| time.derivatives)
            });
        });
    }
}

/// The value of one term, as the line search asks for it.
fn term_values(criterion: &mut Criterion, moment: &Moment) {
    let terms = moment.objective.terms();
    for name in TERMS {
        let term = one(&terms, name);
        criterion.bench_function(&format!("value/{name}"), |bencher| {
            bencher.iter(|| values(black_box(&term), moment.state.configuration(), &mut Profile::default()));
        });
    }
}

/// Factorisation and solve, as the session's solver does them.
fn linear_algebra(criterion: &mut Criterion, moment: &mut Moment) -> Result<(), Box<dyn Error>> {
    let terms = moment.objective.terms();
    let newton = &mut moment.newton;
    let mut failed = None;
    criterion.bench_function("factorisation and solve", |bencher| {
        clocked(bencher, || {
            failed = newton.linearise(black_box(&terms), moment.state.configuration(), false).err().or(failed.take());
            let profile = std::mem::take(&mut newton.counters).profile;
            profile.factorisation + profile.solve
        });
    });
    failed.map_or(Ok(()), |error| Err(error.into()))
}

/// What a step goes through before it is taken.
fn contact(criterion: &mut Criterion, moment: &mut Moment) {
    let Moment { objective, state, direction, .. } = moment;
    let mut bound = |bencher: &mut Bencher<'_>, part: fn(&Profile) -> Duration| {
        clocked(bencher, || {
            objective.contact.take_profile();
            black_box(objective.max_feasible_step(state.configuration(), direction, 0.0, 1.0)).ok();
            part(&objective.contact.take_profile())
        });
    };
    criterion.bench_function("broad phase", |bencher| bound(bencher, |profile| profile.broad_phase));
    criterion.bench_function("CCD", |bencher| bound(bencher, |profile| profile.ccd));
}

/// What is done once: the distance field, and the judgement.
fn whole_meshes(criterion: &mut Criterion, moment: &Moment) {
    let (garment, avatar) = (&moment.garment, &*moment.avatar);
    criterion.bench_function("exact verifier", |bencher| {
        bencher.iter(|| [intersections(garment, None, 0), intersections(garment, Some(avatar), 0)]);
    });
    criterion.bench_function("distance field", |bencher| {
        bencher.iter(|| Field::build(avatar, FieldOptions::default(), &Cancel::new()));
    });
}

/// The pattern of all terms, with what contact adds at this moment.
fn pattern(moment: &Moment, terms: &[Term<'_>]) -> Pattern {
    let mut pairs = PairCollector::default();
    for term in terms {
        term.energy.stencils(&mut |vertices| pairs.add_clique(vertices));
    }
    let pattern = Pattern::new(moment.state.x.len(), pairs);
    let missing = System::default().assemble(&pattern, terms, moment.state.configuration()).expect("nobody cancels");
    pattern.extended(missing)
}

/// The term of a name.
fn one<'a>(terms: &[Term<'a>], name: &str) -> Vec<Term<'a>> {
    terms.iter().copied().filter(|term| term.energy.name() == name).collect()
}

fn total(profile: &Profile, of: fn(&TermTime) -> Duration) -> Duration {
    profile.terms.iter().map(of).sum()
}
