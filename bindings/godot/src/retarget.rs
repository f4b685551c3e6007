//! The class that scripts use. doc_classes/BespokeRetarget.xml is its manual.

use godot::classes::ArrayMesh;
use godot::prelude::*;
use godot::register::property::PhantomVar;

use crate::engine::{NodeArgument, is};
use crate::inputs::{Input, Inputs, Pins};
use crate::native::*;
use crate::options;
use crate::result;
use crate::running::{Done, Event, Running, emit, share};
use crate::session::{Failure, Result};
use crate::tracks;
use crate::words::{WORDS, Word};

/// Puts a garment that was made for one character on another, with no triangle through another.
#[derive(GodotClass)]
#[class(init, base = RefCounted)]
pub struct BespokeRetarget {
    inputs: Inputs,
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

#[godot_api]
impl BespokeRetarget {
    #[signal]
    pub fn progress(stage: i64, t: f64);

    #[signal]
    pub fn finished();

    #[signal]
    pub fn failed(status: i64, message: GString, findings: Array<VarDictionary>);

    #[func]
    fn set_garment(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.inputs.garment.set(mesh, skeleton.node);
    }

    #[func]
    fn set_source_body(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.inputs.source_body.set(mesh, skeleton.node);
    }

    #[func]
    fn set_avatar(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.inputs.avatar.set(mesh, skeleton.node);
    }

    #[func]
    fn set_avatar_role(&mut self, mesh: Variant, role: i64) {
        self.inputs.roles.retain(|(other, _)| *other != mesh);
        self.inputs.roles.push((mesh, role));
    }

    #[func]
    fn add_layer(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.inputs.layers.push(Input::new(mesh, skeleton.node));
    }

    #[func]
    fn clear_layers(&mut self) {
        self.inputs.layers.clear();
    }

    #[func]
    fn add_follower(&mut self, mesh: Variant, #[opt(default = NodeArgument::none())] skeleton: NodeArgument) {
        self.inputs.followers.push(Input::new(mesh, skeleton.node));
    }

    #[func]
    fn clear_followers(&mut self) {
        self.inputs.followers.clear();
    }

    #[func]
    fn set_fit_weights(&mut self, weights: Variant) {
        self.inputs.fit_weights = weights;
    }

    #[func]
    fn set_pins(
        &mut self,
        vertices: Variant,
        #[opt(default = &PackedVector3Array::new())] targets: PackedVector3Array,
    ) {
        self.inputs.pins = Pins { vertices, targets };
    }

    #[func]
    fn add_rigid_group(&mut self, vertices: Variant) {
        self.inputs.rigid_groups.push(vertices);
    }

    #[func]
    fn clear_rigid_groups(&mut self) {
        self.inputs.rigid_groups.clear();
    }

    #[func]
    fn set_answered_blend_shapes(&mut self, names: PackedStringArray) {
        self.inputs.answers = names.as_slice().iter().map(GString::to_string).collect();
    }

    #[func]
    fn set_source_bone_map(&mut self, bone_map: Option<Gd<Resource>>) {
        self.inputs.garment.bone_map = bone_map;
    }

    #[func]
    fn set_avatar_bone_map(&mut self, bone_map: Option<Gd<Resource>>) {
        self.inputs.avatar.bone_map = bone_map;
    }

    #[func]
    fn set_joint_pairs(&mut self, pairs: VarDictionary) {
        self.inputs.pairs = pairs.duplicate_shallow();
    }

    #[func]
    fn get_joint_pairs(&self) -> VarDictionary {
        self.inputs.pairs.duplicate_shallow()
    }

    #[func]
    fn get_joint_map(&mut self) -> Array<VarDictionary> {
        match self.inputs.read_joint_map() {
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
        self.inputs.influences
    }

    #[func]
    fn set_influences(&mut self, influences: i64) {
        if influences == 4 || influences == 8 {
            self.inputs.influences = influences;
        } else {
            godot_error!("influences: it is {influences}; the engine takes 4 or 8");
        }
    }

    #[func]
    fn set_option(&mut self, name: GString, value: Variant) -> i64 {
        match self.inputs.options.set(&name.to_string(), &value) {
            Ok(()) => i64::from(BESPOKE_STATUS_OK),
            Err(failure) => self.fail(failure),
        }
    }

    #[func]
    fn get_option(&mut self, name: GString) -> Variant {
        match self.inputs.options.get(&name.to_string()) {
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
        let anchor = |word: &Word| format!("troubleshooting.md#bespoke_{}", word.name.to_lowercase());
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
    fn get_progress(&mut self) -> VarDictionary {
        let mut row = VarDictionary::new();
        let (progress, share) = match (&mut self.running, &self.done.result) {
            (Some(running), _) => (running.session.progress(), running.share()),
            (None, Some(result)) => {
                let progress = result.session.progress();
                (progress, share(&progress))
            }
            (None, None) => return row,
        };
        row.set("stage", i64::from(progress.stage));
        row.set("t", progress.t);
        row.set("iteration", i64::from(progress.iteration));
        row.set("share", share);
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
    fn get_follower_count(&self) -> i64 {
        self.done.result.as_ref().map_or(0, |result| result.followers.len() as i64)
    }

    #[func]
    fn get_follower_mesh(&mut self, index: i64) -> Option<Gd<ArrayMesh>> {
        let index = self.follower(index)?;
        Some(self.done.result.as_ref()?.followers[index].clone())
    }

    #[func]
    fn create_follower(&mut self, index: i64) -> Option<Gd<Node3D>> {
        let index = self.follower(index)?;
        self.done.result.as_ref()?.follower(index)
    }

    #[func]
    fn get_skin(&self) -> Option<Gd<Resource>> {
        self.done.result.as_ref()?.skin.clone()
    }

    #[func]
    fn get_vertices(&self) -> PackedVector3Array {
        let Some(result) = &self.done.result else { return PackedVector3Array::new() };
        result.worn.garment.positions.iter().map(|&[x, y, z]| Vector3::new(x, y, z)).collect()
    }

    #[func]
    fn get_covered_triangles(
        &mut self,
        #[opt(default = 1)] margin: i64,
        #[opt(default = 0.0)] openness: f64,
    ) -> Array<VarDictionary> {
        let covered = self.done.result.as_ref().ok_or_else(no_result);
        match covered.and_then(|result| result.read_covered(margin, openness)) {
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
    fn add_blend_shape_tracks(&mut self, player: Option<Gd<Node>>, garment: Option<Gd<Node3D>>) -> i64 {
        let result = self.done.result.as_ref().ok_or_else(no_result);
        match result.and_then(|result| tracks::add(player, garment, &result.scene)) {
            Ok(added) => added,
            Err(failure) => {
                self.fail(failure);
                0
            }
        }
    }

    #[func]
    fn create_instance(&mut self) -> Option<Gd<Node3D>> {
        let Some(result) = &self.done.result else {
            self.fail(no_result());
            return None;
        };
        result.instance()
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
        let owner = skeleton.get_owner().unwrap_or_else(|| skeleton.clone().upcast());
        let followers = (0..result.followers.len()).filter_map(|index| result.follower(index));
        for mut node in std::iter::once(instance.clone()).chain(followers) {
            skeleton.add_child(&node);
            node.set_owner(&owner);
        }
        Some(instance)
    }
}

impl BespokeRetarget {
    /// What came out last.
    pub fn done(&self) -> &Done {
        &self.done
    }

    fn fail(&mut self, failure: Failure) -> i64 {
        self.done.status = failure.status;
        self.done.message = failure.message;
        i64::from(failure.status)
    }

    fn dial(&self, name: &str) -> f64 {
        self.inputs.options.get(name).ok().and_then(|value| value.try_to().ok()).unwrap_or_default()
    }

    fn set_dial(&mut self, name: &str, number: f64) {
        if let Err(failure) = self.inputs.options.set(name, &Variant::from(number)) {
            godot_error!("{}", failure.message);
        }
    }

    /// The follower of this number, or a failure that says how many there are.
    fn follower(&mut self, index: i64) -> Option<usize> {
        let Some(result) = &self.done.result else {
            self.fail(no_result());
            return None;
        };
        let count = result.followers.len();
        let found = usize::try_from(index).ok().filter(|&index| index < count);
        if found.is_none() {
            self.fail(Failure::argument(format!("there is no follower {index}; there are {count}, counted from 0")));
        }
        found
    }

    fn begin(&mut self, this: &Gd<Self>) -> Result<()> {
        if self.running.is_some() {
            return Err(Failure {
                status: BESPOKE_STATUS_BUSY,
                message: "it runs already; wait for `finished` or `failed`, or take another BespokeRetarget".into(),
            });
        }
        self.done = Done::default();
        self.running = Some(Running::begin(&self.inputs, this)?);
        Ok(())
    }

    /// Looks after the thread; waits for its end where that is asked.
    fn poll(&mut self, wait: bool) -> Vec<Event> {
        let Some(running) = &mut self.running else { return Vec::new() };
        let mut events: Vec<Event> = running.news().into_iter().collect();
        if !wait && !running.is_over() {
            return events;
        }
        if let Some(running) = self.running.take() {
            self.done = running.end();
            events.push(if self.done.result.is_some() { Event::Finished } else { Event::Failed });
        }
        events
    }
}

fn no_result() -> Failure {
    Failure {
        status: BESPOKE_STATUS_INVALID_STATE,
        message: "there is no result; start, and wait for `finished`".into(),
    }
}

fn word(prefix: &str, value: i64) -> Option<&'static Word> {
    WORDS.iter().find(|word| {
        let rest = word.name.strip_prefix(prefix);
        i64::from(word.value) == value && rest.is_some_and(|rest| rest.starts_with('_'))
    })
}
