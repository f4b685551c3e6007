//! The class that scripts use. doc_classes/BespokeRetarget.xml is its manual.

use std::sync::Arc;
use std::thread::JoinHandle;

use godot::classes::{ArrayMesh, Engine, SceneTree};
use godot::prelude::*;
use godot::register::property::PhantomVar;

use crate::engine::{Node, NodeArgument, is};
use crate::figure::Figure;
use crate::findings::{self, Scene};
use crate::job::{self, Fitted, Outcome, Wanted};
use crate::native::*;
use crate::options::{self, Options};
use crate::result::{self, AddedBone};
use crate::scene::{Skeleton, meshes, skeleton_of};
use crate::session::{Failure, Influences, Result, Session};
use crate::words::WORDS;

/// A mesh that was set, with the skeleton that it was set with.
#[derive(Default)]
struct Input {
    mesh: Variant,
    skeleton: Variant,
    bone_map: Option<Gd<Resource>>,
}

/// Work that goes on.
struct Running {
    session: Arc<Session>,
    thread: Option<JoinHandle<Outcome>>,
    scene: Option<Scene>,
    /// What is connected to the frames of the engine.
    tick: Option<Callable>,
    told: (u32, f64),
}

/// What came out last.
#[derive(Default)]
struct Done {
    status: u32,
    message: String,
    findings: Array<VarDictionary>,
    report: VarDictionary,
    result: Option<Dressed>,
}

/// A result, and what is needed to show it.
struct Dressed {
    session: Arc<Session>,
    scene: Scene,
    fitted: Fitted,
    mesh: Gd<ArrayMesh>,
    skin: Option<Gd<Resource>>,
    added: Vec<AddedBone>,
}

/// Puts a garment that was made for one character on another, with no triangle through another.
#[derive(GodotClass)]
#[class(init, base = RefCounted)]
pub struct BespokeRetarget {
    garment: Input,
    source_body: Input,
    avatar: Input,
    layers: Vec<Input>,
    pairs: VarDictionary,
    options: Options,
    #[init(val = 4)]
    influences: i64,
    running: Option<Running>,
    done: Done,
    /// `fit_weight` of the options.
    #[var(get = get_fit, set = set_fit)]
    fit: PhantomVar<f64>,
    /// `designed_clearance` of the options.
    #[var(get = get_looseness, set = set_looseness)]
    looseness: PhantomVar<f64>,
    /// `offset` of the options.
    #[var(get = get_offset, set = set_offset)]
    offset: PhantomVar<f64>,
    /// Joints for each vertex of the result.
    #[var(get = get_influences, set = set_influences, rename = influences)]
    _influences: PhantomVar<i64>,
    base: Base<RefCounted>,
}

/// What is to be emitted.
enum Event {
    Progress(u32, f64),
    Finished,
    Failed,
}

#[godot_api]
impl BespokeRetarget {
    #[signal]
    fn progress(stage: i64, t: f64);

    #[signal]
    fn finished();

    #[signal]
    fn failed(status: i64, message: GString, findings: Array<VarDictionary>);

    #[func]
    fn set_garment(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.garment.set(mesh, skeleton.node);
    }

    #[func]
    fn set_source_body(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.source_body.set(mesh, skeleton.node);
    }

    #[func]
    fn set_avatar(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.avatar.set(mesh, skeleton.node);
    }

    #[func]
    fn add_layer(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        let mut layer = Input::default();
        layer.set(mesh, skeleton.node);
        self.layers.push(layer);
    }

    #[func]
    fn clear_layers(&mut self) {
        self.layers.clear();
    }

    #[func]
    fn set_source_bone_map(&mut self, bone_map: Option<Gd<Resource>>) {
        self.garment.bone_map = bone_map;
    }

    #[func]
    fn set_avatar_bone_map(&mut self, bone_map: Option<Gd<Resource>>) {
        self.avatar.bone_map = bone_map;
    }

    #[func]
    fn set_joint_pairs(&mut self, pairs: VarDictionary) {
        self.pairs = pairs.duplicate_shallow();
    }

    #[func]
    fn get_joint_pairs(&self) -> VarDictionary {
        self.pairs.duplicate_shallow()
    }

    #[func]
    fn get_joint_map(&mut self) -> Array<VarDictionary> {
        match self.read_joint_map() {
            Ok(map) => map,
            Err(failure) => {
                self.fail(failure);
                Array::new()
            }
        }
    }

    #[func]
    fn get_fit(&self) -> f64 {
        self.dial("fit_weight")
    }

    #[func]
    fn set_fit(&mut self, fit: f64) {
        self.set_dial("fit_weight", fit);
    }

    #[func]
    fn get_looseness(&self) -> f64 {
        self.dial("designed_clearance")
    }

    #[func]
    fn set_looseness(&mut self, looseness: f64) {
        self.set_dial("designed_clearance", looseness);
    }

    #[func]
    fn get_offset(&self) -> f64 {
        self.dial("offset")
    }

    #[func]
    fn set_offset(&mut self, offset: f64) {
        self.set_dial("offset", offset);
    }

    #[func]
    fn get_influences(&self) -> i64 {
        self.influences
    }

    #[func]
    fn set_influences(&mut self, influences: i64) {
        if influences == 4 || influences == 8 {
            self.influences = influences;
        } else {
            godot_error!("influences: it is {influences}; the engine takes 4 or 8");
        }
    }

    #[func]
    fn set_option(&mut self, name: GString, value: Variant) -> i64 {
        match self.options.set(&name.to_string(), &value) {
            Ok(()) => i64::from(BESPOKE_STATUS_OK),
            Err(failure) => self.fail(failure),
        }
    }

    #[func]
    fn get_option(&mut self, name: GString) -> Variant {
        match self.options.get(&name.to_string()) {
            Ok(value) => value,
            Err(failure) => {
                self.fail(failure);
                Variant::nil()
            }
        }
    }

    #[func]
    fn get_options() -> Array<VarDictionary> {
        options::table()
    }

    #[func]
    fn get_version() -> GString {
        GString::from(&crate::session::version())
    }

    #[func]
    fn get_constant_name(prefix: GString, value: i64) -> GString {
        GString::from(word(&prefix.to_string(), value).map_or("", |word| word.name))
    }

    #[func]
    fn get_constant_text(prefix: GString, value: i64) -> GString {
        GString::from(word(&prefix.to_string(), value).map_or("", |word| word.text))
    }

    #[func]
    fn get_help_anchor(status: i64) -> GString {
        let anchor = |word: &crate::words::Word| format!("troubleshooting.md#bespoke_{}", word.name.to_lowercase());
        GString::from(&word("STATUS", status).map(anchor).unwrap_or_default())
    }

    #[func(gd_self)]
    fn start(this: Gd<Self>) -> i64 {
        let mut own = this.clone();
        let mut own = own.bind_mut();
        match own.begin(&this) {
            Ok(()) => i64::from(BESPOKE_STATUS_OK),
            Err(failure) => own.fail(failure),
        }
    }

    #[func(gd_self)]
    fn wait(mut this: Gd<Self>) -> i64 {
        let events = this.bind_mut().poll(true);
        emit(&this, events);
        let status = this.bind().done.status;
        i64::from(status)
    }

    /// For the tree; what it is bound to is the object itself.
    #[func(gd_self, rename = _tick)]
    fn tick(mut this: Gd<Self>, _held: Variant) {
        let events = this.bind_mut().poll(false);
        emit(&this, events);
    }

    #[func]
    fn cancel(&self) {
        if let Some(running) = &self.running {
            running.session.cancel();
        }
    }

    #[func]
    fn is_running(&self) -> bool {
        self.running.is_some()
    }

    #[func]
    fn get_progress(&self) -> VarDictionary {
        let mut row = VarDictionary::new();
        let session = self.running.as_ref().map(|running| &running.session);
        let session = session.or(self.done.result.as_ref().map(|result| &result.session));
        let Some(session) = session else { return row };
        let progress = session.progress();
        row.set("stage", i64::from(progress.stage));
        row.set("t", progress.t);
        row.set("iteration", i64::from(progress.iteration));
        row.set("share", share(&progress));
        row.set("energy", progress.energy);
        row.set("min_distance", progress.min_distance);
        row.set("active_contacts", progress.active_contacts as i64);
        row
    }

    #[func]
    fn get_status(&self) -> i64 {
        i64::from(self.done.status)
    }

    #[func]
    fn get_message(&self) -> GString {
        GString::from(&self.done.message)
    }

    #[func]
    fn get_findings(&self) -> Array<VarDictionary> {
        self.done.findings.clone()
    }

    #[func]
    fn get_report(&self) -> VarDictionary {
        self.done.report.clone()
    }

    #[func]
    fn has_result(&self) -> bool {
        self.done.result.is_some()
    }

    #[func]
    fn get_mesh(&self) -> Option<Gd<ArrayMesh>> {
        self.done.result.as_ref().map(|result| result.mesh.clone())
    }

    #[func]
    fn get_skin(&self) -> Option<Gd<Resource>> {
        self.done.result.as_ref()?.skin.clone()
    }

    #[func]
    fn get_vertices(&self) -> PackedVector3Array {
        let Some(result) = &self.done.result else { return PackedVector3Array::new() };
        result.fitted.positions.iter().map(|&[x, y, z]| Vector3::new(x, y, z)).collect()
    }

    #[func]
    fn get_covered_triangles(
        &mut self,
        #[opt(default = 1)] margin: i64,
        #[opt(default = 0.0)] openness: f64,
    ) -> Array<VarDictionary> {
        match self.read_covered(margin, openness) {
            Ok(covered) => covered,
            Err(failure) => {
                self.fail(failure);
                Array::new()
            }
        }
    }

    #[func]
    fn get_added_bones(&self) -> PackedStringArray {
        let added = self.done.result.iter().flat_map(|result| &result.added);
        added.map(|bone| GString::from(&bone.name)).collect()
    }

    #[func]
    fn add_bones(&mut self, skeleton: Option<Gd<Node3D>>) {
        match (skeleton.filter(|node| is(node, "Skeleton3D")), &self.done.result) {
            (Some(skeleton), Some(result)) => result::add_bones(&skeleton, &result.scene.target, &result.added),
            (None, _) => {
                self.fail(Failure::argument("add_bones: it is no Skeleton3D"));
            }
            (_, None) => {
                self.fail(no_result());
            }
        }
    }

    #[func]
    fn create_instance(&mut self) -> Option<Gd<Node3D>> {
        let Some(result) = &self.done.result else {
            self.fail(no_result());
            return None;
        };
        result::instance(&result.scene.garment, &result.mesh, result.skin.as_ref())
    }

    #[func]
    fn dress(&mut self) -> Option<Gd<Node3D>> {
        let instance = self.create_instance()?;
        let result = self.done.result.as_ref()?;
        let Some(mut skeleton) = result.scene.target.node.get() else {
            instance.free();
            self.fail(Failure::skeleton("dress: the skeleton of the avatar was freed"));
            return None;
        };
        result::add_bones(&skeleton, &result.scene.target, &result.added);
        skeleton.add_child(&instance);
        let owner = skeleton.get_owner().unwrap_or_else(|| skeleton.clone().upcast());
        instance.clone().set_owner(&owner);
        Some(instance)
    }
}

impl Input {
    fn set(&mut self, mesh: Variant, skeleton: Option<Gd<Node3D>>) {
        self.mesh = mesh;
        self.skeleton = skeleton.map_or(Variant::nil(), |node| node.to_variant());
    }

    /// The Skeleton3D that was given, or that of the first mesh that has one.
    fn skeleton(&self, what: &str) -> Result<Option<Gd<Node3D>>> {
        if !self.skeleton.is_nil() {
            let node = self.skeleton.try_to::<Gd<Node3D>>().ok().filter(Gd::is_instance_valid);
            return match node.filter(|node| is(node, "Skeleton3D")) {
                Some(node) => Ok(Some(node)),
                None => Err(Failure::skeleton(format!(
                    "{what}: its skeleton is no Skeleton3D, or it was freed; set it again"
                ))),
            };
        }
        let shown = meshes(&self.mesh, what)?;
        Ok(shown.iter().filter_map(|one| skeleton_of(&one.node?.get()?)).next())
    }

    fn need_skeleton(&self, what: &str) -> Result<Skeleton> {
        let node = self.skeleton(what)?.ok_or_else(|| {
            Failure::skeleton(format!("{what}: no Skeleton3D moves its mesh; say which one its bones are in"))
        })?;
        Skeleton::read(&node, self.bone_map.as_ref(), what)
    }
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

impl BespokeRetarget {
    fn fail(&mut self, failure: Failure) -> i64 {
        self.done.status = failure.status;
        self.done.message = failure.message;
        i64::from(failure.status)
    }

    fn dial(&self, name: &str) -> f64 {
        self.options.get(name).ok().and_then(|value| value.try_to().ok()).unwrap_or_default()
    }

    fn set_dial(&mut self, name: &str, number: f64) {
        if let Err(failure) = self.options.set(name, &Variant::from(number)) {
            godot_error!("{}", failure.message);
        }
    }

    /// The skeleton that the garment was made around: its own, or that of the body that it was made for.
    fn source_skeleton(&self) -> Result<Skeleton> {
        let (garment, body) = (&self.garment, &self.source_body);
        let own = match garment.skeleton("garment")? {
            None if !body.mesh.is_nil() => body.skeleton("source body")?,
            own => own,
        };
        let node = own.ok_or_else(|| {
            Failure::skeleton(
                "garment: no Skeleton3D moves its mesh; say which one it was made around, or set the body that it was made for",
            )
        })?;
        Skeleton::read(&node, garment.bone_map.as_ref(), "garment")
    }

    fn read_scene(&self) -> Result<Scene> {
        let source = self.source_skeleton()?;
        let garment = meshes(&self.garment.mesh, "garment")?;
        if garment.len() != 1 {
            return Err(Failure::argument(format!(
                "garment: there are {} meshes; dress them one after the other, each with those before it as layers",
                garment.len()
            )));
        }
        let garment = Figure::read(garment, &source, &self.garment.skeleton)?;
        let source_body = match self.source_body.mesh.is_nil() {
            true => None,
            false => {
                let shown = meshes(&self.source_body.mesh, "source body")?;
                Some(Figure::read(shown, &source, &self.source_body.skeleton)?)
            }
        };
        let target = self.avatar.need_skeleton("avatar")?;
        let avatar = Figure::read(meshes(&self.avatar.mesh, "avatar")?, &target, &self.avatar.skeleton)?;
        let layer = |layer: &Input| Figure::read(meshes(&layer.mesh, "layer")?, &target, &layer.skeleton);
        let layers = self.layers.iter().map(layer).collect::<Result<_>>()?;
        Ok(Scene { source, target, garment, source_body, avatar, layers })
    }

    /// A session with all that is in the scene.
    fn fill(&self, scene: &Scene) -> Result<Session> {
        let session = Session::new()?;
        let (source, target) = (scene.source.joints.len(), scene.target.joints.len());
        let influences = |which, skin: &Option<Influences>, joints| match skin {
            Some(skin) => session.set_influences(which, skin, joints),
            None => Ok(()),
        };
        session.set_options(&self.options.to_native())?;
        session.set_godot_space()?;
        session.set_garment(&scene.garment.positions, &scene.garment.triangles)?;
        influences(bespoke_session_set_garment_skin_influences, &scene.garment.skin, source)?;
        for shape in &scene.garment.shapes {
            session.add_garment_morph(&shape.name, &shape.offsets)?;
        }
        session.set_source_rig(&scene.source.joints)?;
        if let Some(body) = &scene.source_body {
            session.set_source_avatar(&body.positions, &body.triangles)?;
            influences(bespoke_session_set_source_skin_influences, &body.skin, source)?;
        }
        session.set_target_rig(&scene.target.joints)?;
        session.set_target_avatar(&scene.avatar.positions, &scene.avatar.triangles)?;
        influences(bespoke_session_set_target_skin_influences, &scene.avatar.skin, target)?;
        for layer in &scene.layers {
            session.add_layer(&layer.positions, &layer.triangles)?;
        }
        session.set_joint_pairs(&self.pairs(&scene.source, &scene.target)?)?;
        Ok(session)
    }

    fn pairs(&self, source: &Skeleton, target: &Skeleton) -> Result<Vec<[u32; 2]>> {
        let find = |skeleton: &Skeleton, name: &Variant, whose: &str| {
            let unknown = || {
                Failure::argument(format!("joint pairs: '{name}' is no bone of {whose}'s skeleton '{}'", skeleton.name))
            };
            skeleton.find(&name.to_string()).map(|bone| bone as u32).ok_or_else(unknown)
        };
        let pair = |(from, to): (Variant, Variant)| {
            let from = find(source, &from, "the garment")?;
            let is_none = to.is_nil() || to.to_string().is_empty();
            Ok([from, if is_none { BESPOKE_NO_JOINT } else { find(target, &to, "the avatar")? }])
        };
        self.pairs.iter_shared().map(pair).collect()
    }

    fn read_joint_map(&self) -> Result<Array<VarDictionary>> {
        let (source, target) = (self.source_skeleton()?, self.avatar.need_skeleton("avatar")?);
        let session = Session::new()?;
        session.set_source_rig(&source.joints)?;
        session.set_target_rig(&target.joints)?;
        session.set_joint_pairs(&self.pairs(&source, &target)?)?;
        let map = session.joint_map()?;
        let row = |(name, mapped): (&String, &crate::session::Mapped)| {
            let mut row = VarDictionary::new();
            let found = mapped.target.and_then(|bone| target.names.get(bone as usize));
            row.set("source", name.as_str());
            row.set("target", found.map_or("", String::as_str));
            row.set("reason", i64::from(mapped.reason));
            row.set("confidence", mapped.confidence);
            row.set("part", mapped.part.as_str());
            row
        };
        Ok(source.names.iter().zip(&map).map(row).collect())
    }

    fn begin(&mut self, this: &Gd<Self>) -> Result<()> {
        if self.running.is_some() {
            return Err(Failure {
                status: BESPOKE_STATUS_BUSY,
                message: "it runs already; wait for `finished` or `failed`, or take another BespokeRetarget".into(),
            });
        }
        self.done = Done::default();
        let scene = self.read_scene()?;
        let session = Arc::new(self.fill(&scene)?);
        let has_skin = scene.avatar.skin.is_some();
        let wanted = Wanted {
            vertices: scene.garment.positions.len(),
            normals: scene.garment.normals.clone(),
            tangents: scene.garment.tangents.clone(),
            shapes: scene.garment.shapes.clone(),
            influences: if has_skin { self.influences as usize } else { 0 },
            joints: scene.target.joints.len(),
        };
        let thread = job::start(session.clone(), wanted)?;
        self.running = Some(Running {
            session,
            thread: Some(thread),
            scene: Some(scene),
            tick: tick(this),
            told: (u32::MAX, 0.0),
        });
        Ok(())
    }

    /// Looks after the thread; waits for its end where that is asked.
    fn poll(&mut self, wait: bool) -> Vec<Event> {
        let mut events = Vec::new();
        let Some(running) = &mut self.running else { return events };
        let progress = running.session.progress();
        if running.told != (progress.stage, progress.t) {
            running.told = (progress.stage, progress.t);
            events.push(Event::Progress(progress.stage, progress.t));
        }
        if !wait && running.thread.as_ref().is_some_and(|thread| !thread.is_finished()) {
            return events;
        }
        if let Some(mut running) = self.running.take()
            && let (Some(thread), Some(scene)) = (running.thread.take(), running.scene.take())
        {
            events.push(self.end(running.session.clone(), thread, scene));
        }
        events
    }

    fn end(&mut self, session: Arc<Session>, thread: JoinHandle<Outcome>, scene: Scene) -> Event {
        let outcome = thread.join().unwrap_or_else(|_| Outcome {
            status: BESPOKE_STATUS_INTERNAL,
            message: "a defect of the add-on, please report it: its thread has panicked".into(),
            fitted: None,
            report: None,
            findings: Vec::new(),
        });
        self.done = Done {
            status: outcome.status,
            message: outcome.message,
            findings: outcome.findings.iter().map(|found| scene.finding(found)).collect(),
            report: outcome.report.as_ref().map(findings::report).unwrap_or_default(),
            result: None,
        };
        let Some(fitted) = outcome.fitted else { return Event::Failed };
        let mesh = result::mesh(&scene.garment, &fitted);
        let added = result::added_bones(&fitted.added, &scene.source, &scene.target);
        let skin = fitted.skin.as_ref().and_then(|_| result::skin(&scene.target, &added));
        self.done.result = Some(Dressed { session, scene, fitted, mesh, skin, added });
        Event::Finished
    }

    fn read_covered(&self, margin: i64, openness: f64) -> Result<Array<VarDictionary>> {
        let result = self.done.result.as_ref().ok_or_else(no_result)?;
        let margin =
            u32::try_from(margin).map_err(|_| Failure::argument(format!("margin: {margin} is no number of rings")))?;
        let avatar = &result.scene.avatar;
        let covered = result.session.read_covered(margin, openness, avatar.triangles.len())?;
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
                row.set("node", &part.shown.node.map_or(Variant::nil(), Node::to_variant));
                row.set("surface", k as i64);
                row.set("triangles", &own);
                rows.push(&row);
            }
        }
        Ok(rows)
    }
}

fn no_result() -> Failure {
    Failure {
        status: BESPOKE_STATUS_INVALID_STATE,
        message: "there is no result; start, and wait for `finished`".into(),
    }
}

fn word(prefix: &str, value: i64) -> Option<&'static crate::words::Word> {
    WORDS.iter().find(|word| {
        let rest = word.name.strip_prefix(prefix);
        i64::from(word.value) == value && rest.is_some_and(|rest| rest.starts_with('_'))
    })
}

/// How far a session is as a whole, from 0 to 1, by what the stages of a usual run take. The fit has no end that is known before:
/// it comes nearer to its own with each iteration.
fn share(progress: &BespokeProgress) -> f64 {
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
fn emit(this: &Gd<BespokeRetarget>, events: Vec<Event>) {
    for event in events {
        match event {
            Event::Progress(stage, t) => this.signals().progress().emit(i64::from(stage), t),
            Event::Finished => this.signals().finished().emit(),
            Event::Failed => {
                let done =
                    (this.bind().done.status, this.bind().done.message.clone(), this.bind().done.findings.clone());
                this.signals().failed().emit(i64::from(done.0), &GString::from(&done.1), &done.2);
            }
        }
    }
}
