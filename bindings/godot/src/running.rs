//! Work that goes on, looked after with the frames of the engine, and what came out of it.

use std::sync::Arc;
use std::thread::JoinHandle;

use godot::classes::{ArrayMesh, Engine, SceneTree};
use godot::prelude::*;

use crate::findings::{self, Scene};
use crate::inputs::Inputs;
use crate::job::{self, Outcome, Worn};
use crate::native::*;
use crate::result::{self, AddedBone};
use crate::retarget::BespokeRetarget;
use crate::session::{Failure, Result, Session};

/// Work that goes on.
pub struct Running {
    /// The session that works.
    pub session: Arc<Session>,
    thread: Option<JoinHandle<Outcome>>,
    scene: Option<Scene>,
    /// What is connected to the frames of the engine.
    tick: Option<Callable>,
    told: (u32, f64),
    /// How far it was when it was last asked; it never goes back.
    share: f64,
    answers: bool,
}

/// What came out last.
#[derive(Default)]
pub struct Done {
    /// One of the library's statuses.
    pub status: u32,
    /// What, where, and what to do.
    pub message: String,
    /// What the library has to say.
    pub findings: Array<VarDictionary>,
    /// What was measured.
    pub report: VarDictionary,
    /// The result, where there is one.
    pub result: Option<Dressed>,
}

/// A result, and what is needed to show it.
pub struct Dressed {
    /// The session that it is from.
    pub session: Arc<Session>,
    /// What was read.
    pub scene: Scene,
    /// The garment and what goes along, as arrays.
    pub worn: Worn,
    /// The garment's mesh.
    pub mesh: Gd<ArrayMesh>,
    /// Meshes of what goes along.
    pub followers: Vec<Gd<ArrayMesh>>,
    /// Their skin.
    pub skin: Option<Gd<Resource>>,
    /// Bones that come along.
    pub added: Vec<AddedBone>,
}

/// What is to be emitted.
pub enum Event {
    /// The stage, and how far it is.
    Progress(u32, f64),
    /// There is a result.
    Finished,
    /// There is none.
    Failed,
}

impl Drop for Running {
    /// Whoever forgets it stops it, and no thread stays behind.
    fn drop(&mut self) {
        if let (Some(tick), Some(mut tree)) = (&self.tick, tree())
            && tree.is_connected("process_frame", tick)
        {
            tree.disconnect("process_frame", tick);
        }
        if let Some(thread) = self.thread.take() {
            self.session.cancel();
            let _ = thread.join();
        }
    }
}

impl Running {
    /// Reads the scene, and starts a thread for `this`.
    ///
    /// # Errors
    /// Inputs that cannot be used.
    pub fn begin(inputs: &Inputs, this: &Gd<BespokeRetarget>) -> Result<Self> {
        let scene = inputs.read_scene()?;
        let session = Arc::new(inputs.fill(&scene)?);
        let thread = job::start(session.clone(), inputs.wanted(&scene))?;
        let answers = !scene.avatar.answered.is_empty();
        Ok(Self {
            session,
            thread: Some(thread),
            scene: Some(scene),
            tick: tick(this),
            told: (u32::MAX, 0.0),
            share: 0.0,
            answers,
        })
    }

    /// How far it is as a whole, from 0 to 1.
    pub fn share(&mut self) -> f64 {
        let own = share(&self.session.progress());
        // Answers take about as long again, with stages that begin anew; that the fit is done is seen before they begin.
        let share = match (self.answers, self.session.has_begun_answers()) {
            (false, _) => own,
            (true, false) => own / 2.0,
            (true, true) => 0.5 + own.min(0.97) / 2.0,
        };
        self.share = self.share.max(share);
        self.share
    }

    /// News since the last look.
    pub fn news(&mut self) -> Option<Event> {
        let progress = self.session.progress();
        let now = (progress.stage, progress.t);
        (self.told != now).then(|| {
            self.told = now;
            Event::Progress(progress.stage, progress.t)
        })
    }

    /// Whether the thread has ended.
    pub fn is_over(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Waits for the thread, and makes of what it leaves what the engine can show.
    pub fn end(mut self) -> Done {
        let panicked = || Outcome {
            status: BESPOKE_STATUS_INTERNAL,
            message: "a defect of the add-on, please report it: its thread has panicked".into(),
            worn: None,
            report: None,
            findings: Vec::new(),
        };
        let outcome = self.thread.take().and_then(|thread| thread.join().ok()).unwrap_or_else(panicked);
        let Some(scene) = self.scene.take() else { return Done::default() };
        let mut done = Done {
            status: outcome.status,
            message: outcome.message,
            findings: outcome.findings.iter().map(|found| scene.finding(found)).collect(),
            report: outcome.report.as_ref().map(findings::report).unwrap_or_default(),
            result: None,
        };
        if let Some(worn) = outcome.worn {
            let added = result::added_bones(&worn.added, &scene.source, &scene.target);
            let followers = scene.followers.iter().zip(&worn.followers);
            done.result = Some(Dressed {
                session: self.session.clone(),
                mesh: result::mesh(&scene.garment, &worn.garment),
                followers: followers.map(|(design, fitted)| result::mesh(design, fitted)).collect(),
                skin: worn.garment.skin.as_ref().and_then(|_| result::skin(&scene.target, &added)),
                scene,
                worn,
                added,
            });
        }
        done
    }
}

impl Dressed {
    /// A node that shows the garment as the design was shown.
    pub fn instance(&self) -> Option<Gd<Node3D>> {
        let instance = result::instance(&self.scene.garment, &self.mesh, self.skin.as_ref())?;
        result::take_answers(&instance, &self.scene.avatar);
        Some(instance)
    }

    /// The same for what goes along.
    pub fn follower(&self, index: usize) -> Option<Gd<Node3D>> {
        result::instance(self.scene.followers.get(index)?, self.followers.get(index)?, self.skin.as_ref())
    }

    /// Triangles of the avatar that the garment hides, as scripts read them.
    ///
    /// # Errors
    /// A margin or an openness out of range.
    pub fn read_covered(&self, margin: i64, openness: f64) -> Result<Array<VarDictionary>> {
        let margin =
            u32::try_from(margin).map_err(|_| Failure::argument(format!("margin: {margin} is no number of rings")))?;
        let avatar = &self.scene.avatar;
        let covered = self.session.read_covered(margin, openness, avatar.triangles.len())?;
        let mut rows = Array::new();
        for part in &avatar.parts {
            for (k, surface) in part.arrays.surfaces.iter().enumerate() {
                let first = part.first_triangle + surface.first_triangle;
                let own =
                    covered.iter().map(|&t| t as usize).filter(|&t| (first..first + surface.triangles).contains(&t));
                let own: PackedInt32Array = own.map(|t| (t - first) as i32).collect();
                if own.is_empty() {
                    continue;
                }
                let mut row = VarDictionary::new();
                row.set("mesh", &part.shown.mesh.clone());
                row.set("node", &part.shown.node.map_or(Variant::nil(), crate::engine::Node::to_variant));
                row.set("surface", k as i64);
                row.set("triangles", &own);
                rows.push(&row);
            }
        }
        Ok(rows)
    }
}

/// How far a session is as a whole, from 0 to 1, by what the stages of a usual run take. The fit has no end that is known before:
/// it comes nearer to its own with each iteration.
pub fn share(progress: &BespokeProgress) -> f64 {
    match progress.stage {
        BESPOKE_STAGE_PREPARED => 0.1,
        BESPOKE_STAGE_INFLATE => 0.1 + 0.3 * progress.t,
        BESPOKE_STAGE_REPOSE => 0.4 + 0.2 * progress.t,
        BESPOKE_STAGE_FIT => 0.6 + 0.35 * (1.0 - (-f64::from(progress.iteration) / 20.0).exp()),
        BESPOKE_STAGE_VERIFY => 0.97,
        BESPOKE_STAGE_DONE => 1.0,
        _ => 0.0,
    }
}

fn tree() -> Option<Gd<SceneTree>> {
    Engine::singleton().get_main_loop()?.try_cast::<SceneTree>().ok()
}

/// Looks after the work with each frame. What is bound keeps the object alive meanwhile, as long as the tree is there. Without
/// frames, `wait` does it.
fn tick(this: &Gd<BespokeRetarget>) -> Option<Callable> {
    let mut tree = tree()?;
    // A method by name: callables of Rust's own are kept by gdext until the editor ends.
    let tick = Callable::from_object_method(this, "_tick").bindv(&varray![this].upcast_any_array());
    tree.connect("process_frame", &tick);
    Some(tick)
}

/// With nothing of it borrowed: a script may call it while it listens.
pub fn emit(this: &Gd<BespokeRetarget>, events: Vec<Event>) {
    for event in events {
        match event {
            Event::Progress(stage, t) => this.signals().progress().emit(i64::from(stage), t),
            Event::Finished => this.signals().finished().emit(),
            Event::Failed => {
                let (status, message, findings) = {
                    let own = this.bind();
                    let done = own.done();
                    (done.status, GString::from(&done.message), done.findings.clone())
                };
                this.signals().failed().emit(i64::from(status), &message, &findings);
            }
        }
    }
}
