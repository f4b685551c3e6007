//! What became of one retarget, judged on the values that a caller would read.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use bespoke::error::{Error, ErrorKind};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind};
use bespoke::verify::intersections;

use testing::scene::{Recipe, Scene};

#[derive(Debug)]
pub struct Outcome {
    pub recipe: Recipe,
    /// Why there is no result; a crash is told as `Internal`.
    pub error: Option<Error>,
    /// Pairs of triangles that intersect in the result and did not in the input.
    pub intersections: u64,
    pub seconds: f64,
    pub iterations: u32,
    /// Whether the fit ended by its tolerance, and not by the limit of iterations or where no step made it better.
    pub converged: bool,
    /// Vertices of garment and avatar.
    pub size: [usize; 2],
}

impl Outcome {
    pub fn of(recipe: Recipe) -> Self {
        let scene = Scene::new(&recipe);
        let size = [scene.garment.positions.len(), scene.avatar.positions.len()];
        let clock = Instant::now();
        let mut outcome =
            Self { recipe, error: None, intersections: 0, seconds: 0.0, iterations: 0, converged: false, size };
        let ran = catch_unwind(AssertUnwindSafe(|| run(&scene, &mut outcome)));
        outcome.seconds = clock.elapsed().as_secs_f64();
        match ran {
            Ok(Ok(())) => {}
            Ok(Err(error)) => outcome.error = Some(error),
            Err(_) => outcome.error = Some(Error::new(ErrorKind::Internal, "it panicked")),
        }
        outcome
    }

    /// All about it in one line.
    pub fn line(&self) -> String {
        let ([garment, avatar], flaws) = (self.size, &self.recipe.flaws);
        let ended = self.error.as_ref().map_or("Done".to_string(), |e| format!("{:?}: {}", e.kind, e.message));
        format!(
            "SEED={} ({garment} and {avatar} vertices, flaws {flaws:?}, {:.1} s, {} iterations) {ended}",
            self.recipe.seed, self.seconds, self.iterations
        )
    }

    pub fn is_crash(&self) -> bool {
        self.error.as_ref().is_some_and(|e| e.kind == ErrorKind::Internal)
    }
}

/// Fills in iterations, and intersections that are new.
fn run(scene: &Scene, outcome: &mut Outcome) -> Result<(), Error> {
    let mut session = scene.session()?;
    let ended = session.run();
    let report = session.report();
    outcome.iterations = report.inflate.iterations + report.fit.iterations;
    outcome.converged = report.converged;
    ended?;
    let positions = session.garment_positions()?.into_iter().map(|p| scene.precision.round(p)).collect();
    let result = TriangleMesh { positions, triangles: scene.garment.triangles.clone() };
    let within = intersections(&result, None, usize::MAX)?;
    outcome.intersections = intersections(&result, Some(&scene.avatar), 0)?.count;
    if within.count > 0 {
        // What is let off is what intersects at the start, or touches within rounding and is told.
        let before = intersections(&scene.garment, None, usize::MAX)?.pairs;
        let told = |pair: &[u32; 2]| {
            let of_pair = |f: &Diagnostic| {
                f.kind() == DiagnosticKind::SelfIntersection && f.elements().iter().all(|e| pair.contains(&e.index))
            };
            session.diagnostics().iter().any(of_pair)
        };
        let new = within.pairs.iter().filter(|pair| before.binary_search(pair).is_err() && !told(pair));
        outcome.intersections += new.count() as u64;
    }
    Ok(())
}
