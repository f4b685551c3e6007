//! What a caller can read: the last accepted iterate, apart from the run that goes on.

use std::sync::Arc;

use glam::DVec3;

use super::run::Run;
use super::verification::Verdict;
use crate::control::Cancel;
use crate::energy::distortion::distortion;
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::precision::Precision;
use crate::stage::setup::problem::Problem;

/// The last accepted iterate, with all that it takes to return it in the caller's coordinate system.
#[derive(Clone)]
pub(super) struct Snapshot {
    pub(super) problem: Arc<Problem>,
    /// As the caller gave it.
    pub(super) body: Arc<Body>,
    coordinate_system: CoordinateSystem,
    /// Pairs of garment triangles that intersected at the start.
    initial_intersections: Arc<[[u32; 2]]>,
    /// Welded garment vertices in the normalised space.
    pub(super) x: Vec<DVec3>,
    /// Inflation parameter.
    pub(super) t: f64,
    /// Iterations of the stage.
    pub(super) iteration: u32,
    /// The vertices of the avatar while it is on the way to its own pose.
    on_the_way: Option<Arc<[DVec3]>>,
}

impl Snapshot {
    /// The present iterate of `run`.
    pub(super) fn of(run: &Run) -> Self {
        Self {
            problem: run.problem.clone(),
            body: run.body.clone(),
            coordinate_system: run.target_coordinate_system,
            initial_intersections: run.initial_intersections.clone(),
            x: run.state.x.clone(),
            t: run.state.t,
            iteration: run.iterations(),
            on_the_way: None,
        }
    }

    /// Updates it to the present iterate of `run`.
    pub(super) fn update(&mut self, run: &Run) {
        self.x.clone_from(&run.state.x);
        self.t = run.state.t;
        self.iteration = run.iterations();
        if !Arc::ptr_eq(&self.problem, &run.problem) {
            (self.problem, self.body) = (run.problem.clone(), run.body.clone());
        }
        // Another attempt may begin as designed, where another leaves the garment untangled.
        self.initial_intersections.clone_from(&run.initial_intersections);
        self.on_the_way = run.avatar_on_the_way().map(Into::into);
    }

    /// Welded garment vertices with the caps of the openings, in the normalised space.
    pub(super) fn x_with_caps(&self) -> Vec<DVec3> {
        self.with_caps(&self.x)
    }

    /// The same where the others are at `x`.
    pub(super) fn with_caps(&self, x: &[DVec3]) -> Vec<DVec3> {
        let mut x = x.to_vec();
        self.problem.caps.iter().for_each(|cap| cap.carry(&self.problem.rest, &mut x));
        x
    }

    pub(super) fn garment_positions(&self) -> Vec<DVec3> {
        let welded: Vec<DVec3> = self.x_with_caps().iter().map(|&p| self.restored(p)).collect();
        self.problem.weld.scatter(&welded)
    }

    pub(super) fn avatar_positions(&self) -> Vec<DVec3> {
        if let Some(points) = &self.on_the_way {
            return points.to_vec();
        }
        if self.t >= 1.0 {
            // As it was set, to the bit, not through the normalised space and back.
            return self.body.avatar_positions().to_vec();
        }
        let between = self.problem.projected.shrunk.iter().zip(&self.problem.avatar.positions);
        let [vertices, _] = self.body.avatar_size();
        between.take(vertices).map(|(&a, &b)| self.restored(a.lerp(b, self.t))).collect()
    }

    /// One number for each of the caller's garment triangles.
    pub(super) fn distortion(&self) -> Vec<f64> {
        let problem = &self.problem;
        problem.weld.scatter_triangles(&distortion(&problem.rest, &self.x, &problem.triangles))
    }

    /// Pairs of garment triangles that intersected at the start.
    pub(super) fn initial_intersections(&self) -> &[[u32; 2]] {
        &self.initial_intersections
    }

    /// In which the target is read.
    pub(super) fn coordinate_system(&self) -> &CoordinateSystem {
        &self.coordinate_system
    }

    /// A point in the normalised space, in the caller's coordinates.
    pub(super) fn restored(&self, p: DVec3) -> DVec3 {
        self.coordinate_system.position_from_internal(self.problem.target_normalization.restore(p))
    }

    /// Verifies the garment as it is read in `precision`.
    pub(super) fn verify_as_read(&self, precision: Precision, cancel: &Cancel) -> Result<Verdict> {
        let positions = self.x.iter().map(|&p| precision.round(self.restored(p))).collect();
        let garment = TriangleMesh { positions, triangles: self.problem.triangles.clone() };
        Verdict::new(&garment, &self.problem.weld, &self.body, &self.initial_intersections, cancel)
    }
}
