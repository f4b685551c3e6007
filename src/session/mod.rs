//! One garment on its way to one avatar: the state machine that a caller sees.

mod field_task;
mod work;

use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;

pub use crate::control::Stage;
use crate::control::{Control, MAX_TERMS, Progress};
use crate::error::{Error, ErrorKind, Result};
use crate::input::mesh::TriangleMesh;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::input::space::Space;
pub use crate::options::Options;
pub use crate::report::{Report, StageReport, TermReport, Verification};
use crate::solver::newton::{Model, Newton, State};
use crate::stage::inflate::Inflation;
use crate::stage::problem::{Inputs, Problem};
use crate::verify::intersections;
use field_task::FieldTask;
use work::{Step, Work};

/// Floating-point format of a caller's positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 32-bit.
    #[default]
    F32,
    /// 64-bit.
    F64,
}

impl Precision {
    /// `p` as a caller reads it who stores this format.
    pub fn round(self, p: DVec3) -> DVec3 {
        match self {
            Self::F32 => p.as_vec3().as_dvec3(),
            Self::F64 => p,
        }
    }
}

/// How much a call of [`Session::step`] may do; 0 is no limit. At least one iteration is done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Budget {
    /// Newton iterations.
    pub iterations: u32,
    /// Wall milliseconds; checked between iterations.
    pub milliseconds: u32,
}

/// One retargeting: inputs, then `prepare`, then `step` or `run`, then results.
#[derive(Default)]
pub struct Session {
    garment: Option<(TriangleMesh, Precision)>,
    source_skeleton: Option<Skeleton>,
    avatar: Option<TriangleMesh>,
    target_skeleton: Option<Skeleton>,
    source_avatar: Option<TriangleMesh>,
    skin: Option<SkinWeights>,
    fit_weights: Option<Vec<f64>>,
    source_space: Space,
    target_space: Space,
    options: Options,
    control: Arc<Control>,
    work: Option<Work>,
    stage: Stage,
    report: Report,
}

fn mesh_to_ours(space: &Space, mesh: &TriangleMesh) -> TriangleMesh {
    TriangleMesh {
        positions: mesh.positions.iter().map(|&p| space.position_to_ours(p)).collect(),
        triangles: mesh.triangles.iter().map(|&t| space.triangle(t)).collect(),
    }
}

fn skeleton_to_ours(space: &Space, skeleton: &Skeleton) -> Skeleton {
    Skeleton {
        joints: skeleton.joints.iter().map(|&p| space.position_to_ours(p)).collect(),
        bones: skeleton.bones.clone(),
    }
}

fn missing<T>(what: &str, call: &str) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidState, format!("{what} is missing: call {call} before prepare")))
}

impl Session {
    /// A session without inputs.
    pub fn new() -> Self {
        Self::default()
    }

    fn setting(&self, what: &str) -> Result<()> {
        if self.stage == Stage::Setup {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::InvalidState,
            format!("{what} cannot be set after prepare; call reset first, which keeps the inputs"),
        ))
    }

    /// The garment, in the source space, around the source skeleton.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn set_garment(&mut self, mesh: TriangleMesh, precision: Precision) -> Result<()> {
        self.setting("the garment")?;
        mesh.check("garment")?;
        self.garment = Some((mesh, precision));
        Ok(())
    }

    /// Vertices of the garment, once it is set.
    pub fn garment_vertex_count(&self) -> Option<usize> {
        self.garment.as_ref().map(|g| g.0.positions.len())
    }

    /// The skeleton that the garment was designed on, in the source space.
    ///
    /// # Errors
    /// `InvalidSkeleton`, `InvalidState`.
    pub fn set_source_skeleton(&mut self, skeleton: Skeleton) -> Result<()> {
        self.setting("the source skeleton")?;
        skeleton.check("source skeleton")?;
        self.source_skeleton = Some(skeleton);
        Ok(())
    }

    /// The body to dress, in the target space. It may be open, non-manifold, in pieces and pass through itself.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn set_target_avatar(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.setting("the target avatar")?;
        mesh.check("target avatar")?;
        self.avatar = Some(mesh);
        Ok(())
    }

    /// The skeleton of the body to dress, in the target space: the same joints and bones as the source skeleton, the bones
    /// in any order and direction.
    ///
    /// # Errors
    /// `InvalidSkeleton`, `InvalidState`.
    pub fn set_target_skeleton(&mut self, skeleton: Skeleton) -> Result<()> {
        self.setting("the target skeleton")?;
        skeleton.check("target skeleton")?;
        self.target_skeleton = Some(skeleton);
        Ok(())
    }

    /// The body that the garment was designed on, in the source space. Optional: with it, each point of the garment aims
    /// at the clearance that it had there (see [`Options::designed_clearance`]); without it, at none.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn set_source_avatar(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.setting("the source avatar")?;
        mesh.check("source avatar")?;
        self.source_avatar = Some(mesh);
        Ok(())
    }

    /// Skin weights of the target avatar. Optional: without them the nearest bone decides.
    ///
    /// # Errors
    /// `InvalidState`. The size is compared with the avatar's by `prepare`.
    pub fn set_target_skin(&mut self, skin: SkinWeights) -> Result<()> {
        self.setting("the skin weights")?;
        self.skin = Some(skin);
        Ok(())
    }

    /// How much each garment vertex should fit: 0 not at all, 1 as the others. Optional: 1 everywhere.
    ///
    /// # Errors
    /// `InvalidWeights` for a negative weight or one that is not finite, `InvalidState`.
    pub fn set_fit_weights(&mut self, weights: Vec<f64>) -> Result<()> {
        self.setting("the fit weights")?;
        if let Some((v, w)) = weights.iter().enumerate().find(|(_, w)| !(w.is_finite() && **w >= 0.0)) {
            return Err(Error::new(
                ErrorKind::InvalidWeights,
                format!("fit weights: vertex {v} has weight {w}; it must be finite and not negative"),
            ));
        }
        self.fit_weights = Some(weights);
        Ok(())
    }

    /// Axes, unit and winding of garment, source skeleton and source avatar.
    ///
    /// # Errors
    /// `InvalidArgument`, `InvalidState`.
    pub fn set_source_space(&mut self, space: Space) -> Result<()> {
        self.setting("the source space")?;
        space.check("source space")?;
        self.source_space = space;
        Ok(())
    }

    /// Axes, unit and winding of target avatar and target skeleton, and of the result.
    ///
    /// # Errors
    /// `InvalidArgument`, `InvalidState`.
    pub fn set_target_space(&mut self, space: Space) -> Result<()> {
        self.setting("the target space")?;
        space.check("target space")?;
        self.target_space = space;
        Ok(())
    }

    /// Weights, distances and limits.
    ///
    /// # Errors
    /// `InvalidArgument`, `InvalidState`.
    pub fn set_options(&mut self, options: Options) -> Result<()> {
        self.setting("the options")?;
        options.check()?;
        self.options = options;
        Ok(())
    }

    /// Step 1: checks the inputs against each other, projects the avatar onto the skeleton, begins to build the distance
    /// field.
    ///
    /// # Errors
    /// `InvalidState` where an input is missing or the session is past this, `InvalidSkeleton`, `InvalidWeights`,
    /// `NotEnclosed`. The session then still takes inputs.
    pub fn prepare(&mut self) -> Result<()> {
        self.setting("prepare was called already: the inputs")?;
        let clock = Instant::now();
        let threads = match self.options.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            n => n as usize,
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|k| format!("bespoke-{k}"))
            .build()
            .map_err(|e| Error::new(ErrorKind::Internal, format!("no thread pool: {e}")))?;
        let problem = pool.install(|| self.pose_problem())?;
        let field = FieldTask::start(problem.avatar.clone(), self.options.voxel, threads)?;
        let (objective, options, newton, state) = pool.install(|| {
            let state = State { x: problem.rest.clone(), t: 0.0 };
            let (objective, options) = problem.begin(&self.options)?;
            let newton = Newton::new(state.x.len(), &objective.terms())?;
            Ok((objective, options, newton, state))
        })?;
        self.report = Report {
            garment_size: [problem.rest.len(), problem.triangles.len()],
            avatar_size: [problem.avatar.positions.len(), problem.avatar.triangles.len()],
            projected_size: [problem.projected.start.len(), problem.projected.triangles.len()],
            separation_floor: options.separation_floor,
            threads,
            ..Report::default()
        };
        self.report.prepare.seconds = clock.elapsed().as_secs_f64();
        let step = Step::Inflate(Inflation::default());
        self.work = Some(Work { pool: Arc::new(pool), options, problem, state, objective, newton, step, field });
        self.enter(Stage::Prepared);
        Ok(())
    }

    fn pose_problem(&self) -> Result<Problem> {
        let Some((garment, _)) = &self.garment else { return missing("the garment", "set_garment") };
        let Some(source) = &self.source_skeleton else {
            return missing("the source skeleton", "set_source_skeleton");
        };
        let Some(avatar) = &self.avatar else { return missing("the target avatar", "set_target_avatar") };
        let Some(target) = &self.target_skeleton else {
            return missing("the target skeleton", "set_target_skeleton");
        };
        let target = target.aligned_to(source)?;
        if let Some(skin) = &self.skin {
            check_skin(skin, &target, avatar)?;
        }
        if let Some(weights) = &self.fit_weights
            && weights.len() != garment.positions.len()
        {
            return Err(Error::new(
                ErrorKind::InvalidWeights,
                format!(
                    "fit weights: there are {} weights, the garment has {} vertices",
                    weights.len(),
                    garment.positions.len()
                ),
            ));
        }
        Problem::new(
            &Inputs {
                garment: &mesh_to_ours(&self.source_space, garment),
                source_skeleton: &skeleton_to_ours(&self.source_space, source),
                avatar: &mesh_to_ours(&self.target_space, avatar),
                target_skeleton: &skeleton_to_ours(&self.target_space, &target),
                skin: self.skin.as_ref(),
                source_avatar: self.source_avatar.as_ref().map(|mesh| mesh_to_ours(&self.source_space, mesh)).as_ref(),
                fit_weights: self.fit_weights.as_deref(),
            },
            &self.options,
            &mut Vec::new(),
        )
    }

    /// Goes on within `budget`. Returns the stage that is reached; at [`Stage::Done`] the result is verified.
    ///
    /// # Errors
    /// `InvalidState` before `prepare` or after the end, `Cancelled`, `InflationStalled`, `NotVerified`, `Internal`. The
    /// garment can still be read.
    pub fn step(&mut self, budget: Budget) -> Result<Stage> {
        if !matches!(self.stage, Stage::Prepared | Stage::Inflate | Stage::Fit) {
            return Err(Error::new(
                ErrorKind::InvalidState,
                match self.stage {
                    Stage::Setup => "step was called before prepare",
                    _ => "the session has ended; call reset to begin again with the same inputs",
                },
            ));
        }
        let outcome = self.iterate(budget);
        if let Err(error) = &outcome {
            self.enter(if error.kind == ErrorKind::Cancelled { Stage::Cancelled } else { Stage::Failed });
        }
        outcome
    }

    fn iterate(&mut self, budget: Budget) -> Result<Stage> {
        let clock = Instant::now();
        let mut iterations = 0;
        loop {
            if self.control.is_cancelled() {
                return Err(Error::new(ErrorKind::Cancelled, "cancelled on request"));
            }
            let Some(work) = &mut self.work else {
                return Err(Error::new(ErrorKind::Internal, "there is no work in a running session"));
            };
            let pool = work.pool.clone();
            let (control, report) = (&self.control, &mut self.report);
            let stage = pool.install(|| work.iterate(control, report))?;
            self.enter(stage);
            if stage == Stage::Verify {
                return self.finish();
            }
            iterations += 1;
            let spent = clock.elapsed().as_millis() >= u128::from(budget.milliseconds);
            if budget.iterations != 0 && iterations >= budget.iterations || budget.milliseconds != 0 && spent {
                return Ok(stage);
            }
        }
    }

    /// The exact verifier has the last word, on the values as the caller will read them.
    fn finish(&mut self) -> Result<Stage> {
        let clock = Instant::now();
        let precision = self.garment.as_ref().map_or(Precision::F32, |g| g.1);
        let counted = self.verify(precision)?;
        self.report.verify_seconds = clock.elapsed().as_secs_f64();
        self.report.verification = Some(counted);
        if !counted.is_clean() {
            return Err(Error::new(
                ErrorKind::NotVerified,
                format!(
                    "the result, in the precision and space in which it would be read, has {} intersecting pairs of \
                     garment triangles and {} of garment and avatar triangles; it is not handed out as good. Read it in \
                     64 bits, or move the avatar nearer to the origin",
                    counted.garment_garment, counted.garment_avatar
                ),
            ));
        }
        self.enter(Stage::Done);
        Ok(Stage::Done)
    }

    /// From wherever the session is to the verified end.
    ///
    /// # Errors
    /// As [`Self::prepare`] and [`Self::step`].
    pub fn run(&mut self) -> Result<Stage> {
        if self.stage == Stage::Setup {
            self.prepare()?;
        }
        self.step(Budget::default())
    }

    /// Where the session is.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// What was measured so far.
    pub fn report(&self) -> Report {
        self.report.clone()
    }

    /// Progress and cancel, for any thread; may outlive the session.
    pub fn control(&self) -> Arc<Control> {
        self.control.clone()
    }

    fn enter(&mut self, stage: Stage) {
        self.stage = stage;
        let mut progress = Progress { stage, ..Progress::default() };
        if let Some(work) = &self.work {
            progress.t = work.state.t;
            progress.iteration = match &work.step {
                Step::Inflate(s) => s.iterations,
                Step::Fit(s) => s.iterations,
            };
            let report = &self.report;
            progress.gradient_norm = report.gradient_norm;
            progress.min_distance = report.min_distance_self.min(report.min_distance_avatar);
            progress.active_contacts = report.active_contacts as u64;
            progress.seconds =
                [report.prepare.seconds, report.inflate.seconds, report.fit.seconds, report.verify_seconds];
            progress.energy_count = report.terms.len().min(MAX_TERMS) as u32;
            for (slot, term) in progress.energies.iter_mut().zip(&report.terms) {
                *slot = term.weight * term.value;
            }
            progress.energy = progress.energies.iter().sum();
        }
        self.control.publish(&progress);
    }

    fn working(&self) -> Result<&Work> {
        self.work.as_ref().ok_or_else(|| {
            Error::new(ErrorKind::InvalidState, "there is nothing to read yet: call prepare first".to_string())
        })
    }

    /// The garment as it is now, in the caller's vertex order and the target space.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`.
    pub fn garment_positions(&self) -> Result<Vec<DVec3>> {
        let work = self.working()?;
        Ok(work.state.x.iter().map(|&p| self.restored(work, p)).collect())
    }

    /// The avatar as far as it is inflated now, in the caller's vertex order and the target space.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`.
    pub fn avatar_positions(&self) -> Result<Vec<DVec3>> {
        let work = self.working()?;
        let problem = &work.problem;
        if work.state.t >= 1.0 {
            // To the bit as it came, not through the normalised space and back.
            return Ok(self.avatar.as_ref().map(|avatar| avatar.positions.clone()).unwrap_or_default());
        }
        let between = problem.projected.shrunk.iter().zip(&problem.avatar.positions);
        Ok(between.map(|(&a, &b)| self.restored(work, a.lerp(b, work.state.t))).collect())
    }

    fn restored(&self, work: &Work, p: DVec3) -> DVec3 {
        self.target_space.position_from_ours(work.problem.target_frame.restore(p))
    }

    /// Counts intersections exactly, of the garment as a caller reads it in `precision`, against itself and the avatar at
    /// full size.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`.
    pub fn verify(&self, precision: Precision) -> Result<Verification> {
        let work = self.working()?;
        let positions = self.garment_positions()?.into_iter().map(|p| precision.round(p)).collect();
        let garment = TriangleMesh { positions, triangles: work.problem.triangles.clone() };
        let Some(avatar) = &self.avatar else { return missing("the target avatar", "set_target_avatar") };
        work.pool.install(|| {
            Ok(Verification {
                garment_garment: intersections(&garment, None, 0)?.count,
                garment_avatar: intersections(&garment, Some(avatar), 0)?.count,
            })
        })
    }

    /// Back to where inputs can be set; the inputs stay.
    pub fn reset(&mut self) {
        self.work = None;
        self.report = Report::default();
        self.control.clear_cancel();
        self.enter(Stage::Setup);
    }
}

fn check_skin(skin: &SkinWeights, skeleton: &Skeleton, avatar: &TriangleMesh) -> Result<()> {
    let (have, want) = ((skin.joint_count(), skin.vertex_count()), (skeleton.joints.len(), avatar.positions.len()));
    if have == want {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::InvalidWeights,
        format!(
            "skin weights: they are for {} joints and {} vertices, the target skeleton has {} joints and the avatar {} \
             vertices",
            have.0, have.1, want.0, want.1
        ),
    ))
}
