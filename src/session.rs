//! TEMPORARY, until the real session is merged: the interface that the C API is written against, over a body that
//! checks its inputs and hands the garment back as it came.

use std::sync::Arc;

use glam::DVec3;

use crate::control::{Control, Progress};
use crate::error::{Error, ErrorKind, Result};
use crate::input::mesh::TriangleMesh;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::input::space::Space;
use crate::options::Options;

pub use crate::control::Stage;
pub use crate::report::{Report, StageReport, TermReport, Verification};

/// How a caller stores positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 32-bit floats.
    #[default]
    F32,
    /// 64-bit floats.
    F64,
}

/// How far one step goes at most.
#[derive(Clone, Copy, Debug, Default)]
pub struct Budget {
    /// Iterations; 0 = no limit.
    pub iterations: u32,
    /// Milliseconds; 0 = no limit.
    pub milliseconds: u32,
}

/// The session.
#[derive(Default)]
pub struct Session {
    garment: Option<TriangleMesh>,
    avatar: Option<TriangleMesh>,
    source: Option<Skeleton>,
    target: Option<Skeleton>,
    skin: Option<SkinWeights>,
    fit_weights: Option<Vec<f64>>,
    stage: Stage,
    control: Arc<Control>,
}

fn state(message: &str) -> Error {
    Error::new(ErrorKind::InvalidState, message)
}

#[allow(missing_docs)]
impl Session {
    pub fn new() -> Self {
        Self::default()
    }
    fn in_setup(&self) -> Result<()> {
        if self.stage == Stage::Setup { Ok(()) } else { Err(state("inputs are set before prepare or after reset")) }
    }
    fn enter(&mut self, stage: Stage) {
        self.stage = stage;
        self.control.publish(&Progress { stage, ..Progress::default() });
    }
    pub fn set_garment(&mut self, mesh: TriangleMesh, _: Precision) -> Result<()> {
        self.in_setup()?;
        mesh.check("garment")?;
        self.garment = Some(mesh);
        Ok(())
    }
    pub fn set_source_skeleton(&mut self, skeleton: Skeleton) -> Result<()> {
        self.in_setup()?;
        skeleton.check("source skeleton")?;
        self.source = Some(skeleton);
        Ok(())
    }
    pub fn set_target_avatar(&mut self, mesh: TriangleMesh, _: Precision) -> Result<()> {
        self.in_setup()?;
        mesh.check("target avatar")?;
        self.avatar = Some(mesh);
        Ok(())
    }
    pub fn set_target_skeleton(&mut self, skeleton: Skeleton) -> Result<()> {
        self.in_setup()?;
        skeleton.check("target skeleton")?;
        self.target = Some(skeleton);
        Ok(())
    }
    pub fn set_source_avatar(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.in_setup()?;
        mesh.check("source avatar")
    }
    pub fn set_target_skin(&mut self, skin: SkinWeights) -> Result<()> {
        self.in_setup()?;
        self.skin = Some(skin);
        Ok(())
    }
    pub fn set_fit_weights(&mut self, weights: Vec<f64>) -> Result<()> {
        self.in_setup()?;
        if let Some(i) = weights.iter().position(|w| !(w.is_finite() && *w >= 0.0)) {
            let message = format!("fit weights: vertex {i} has {}, it must be finite and not negative", weights[i]);
            return Err(Error::new(ErrorKind::InvalidWeights, message));
        }
        self.fit_weights = Some(weights);
        Ok(())
    }
    pub fn set_source_space(&mut self, space: Space) -> Result<()> {
        self.in_setup()?;
        space.check("source space")
    }
    pub fn set_target_space(&mut self, space: Space) -> Result<()> {
        self.in_setup()?;
        space.check("target space")
    }
    pub fn set_options(&mut self, options: Options) -> Result<()> {
        self.in_setup()?;
        options.check()
    }
    pub fn prepare(&mut self) -> Result<()> {
        self.in_setup()?;
        let missing = |what| state(&format!("prepare needs a {what}, which was not set"));
        let garment = self.garment.as_ref().ok_or_else(|| missing("garment"))?;
        let source = self.source.as_ref().ok_or_else(|| missing("source skeleton"))?;
        let avatar = self.avatar.as_ref().ok_or_else(|| missing("target avatar"))?;
        self.target.as_ref().ok_or_else(|| missing("target skeleton"))?.aligned_to(source)?;
        let wrong = |message: String| Err(Error::new(ErrorKind::InvalidWeights, message));
        if let Some(skin) = &self.skin
            && (skin.vertex_count() != avatar.positions.len() || skin.joint_count() != source.joints.len())
        {
            return wrong("target skin weights: wrong size".into());
        }
        if self.fit_weights.as_ref().is_some_and(|w| w.len() != garment.positions.len()) {
            return wrong("fit weights: wrong size".into());
        }
        self.enter(Stage::Prepared);
        Ok(())
    }
    pub fn step(&mut self, _: Budget) -> Result<Stage> {
        let next = match self.stage {
            Stage::Prepared => Stage::Inflate,
            Stage::Inflate => Stage::Fit,
            Stage::Fit => Stage::Done,
            _ => return Err(state("step needs prepare first, and reset after the end")),
        };
        if self.control.is_cancelled() {
            self.enter(Stage::Cancelled);
            return Err(Error::new(ErrorKind::Cancelled, "stopped, as asked"));
        }
        self.enter(next);
        Ok(next)
    }
    pub fn run(&mut self) -> Result<Stage> {
        if self.stage == Stage::Setup {
            self.prepare()?;
        }
        while self.step(Budget::default())? != Stage::Done {}
        Ok(Stage::Done)
    }
    pub fn stage(&self) -> Stage {
        self.stage
    }
    pub fn report(&self) -> Report {
        let size = |mesh: &Option<TriangleMesh>| {
            mesh.as_ref().map_or([0, 0], |mesh| [mesh.positions.len(), mesh.triangles.len()])
        };
        if self.stage == Stage::Setup {
            return Report::default();
        }
        Report {
            garment_size: size(&self.garment),
            avatar_size: size(&self.avatar),
            terms: vec![TermReport { name: "surface", value: 0.0, weight: 1.0 }],
            verification: (self.stage == Stage::Done).then(Verification::default),
            min_distance_self: f64::INFINITY,
            min_distance_avatar: f64::INFINITY,
            ..Report::default()
        }
    }
    pub fn control(&self) -> Arc<Control> {
        self.control.clone()
    }
    fn positions(&self, mesh: &Option<TriangleMesh>) -> Result<Vec<DVec3>> {
        match mesh {
            Some(mesh) if self.stage != Stage::Setup => Ok(mesh.positions.clone()),
            _ => Err(state("vertices can be read after prepare")),
        }
    }
    pub fn garment_positions(&self) -> Result<Vec<DVec3>> {
        self.positions(&self.garment)
    }
    pub fn avatar_positions(&self) -> Result<Vec<DVec3>> {
        self.positions(&self.avatar)
    }
    pub fn garment_vertex_count(&self) -> Option<usize> {
        self.garment.as_ref().map(|garment| garment.positions.len())
    }
    pub fn verify(&self, _: Precision) -> Result<Verification> {
        self.positions(&self.garment)?;
        Ok(Verification::default())
    }
    pub fn reset(&mut self) {
        self.control.clear_cancel();
        self.enter(Stage::Setup);
    }
}
