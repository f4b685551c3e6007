//! A random garment on a random body, from the inputs to the end.

use bespoke::capi::inputs::*;
use bespoke::capi::running::*;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeComponent, BespokeView};
use bespoke::geometry::mesh::{TriangleMesh, label_pieces};
use bespoke::input::weld::weld_vertices;
use bespoke::verify::intersections;
use glam::DVec3;

use super::array::Array;
use super::caller::Caller;
use super::reported::Reported;
use super::shape::{Shape, bones, joints};
use super::source::Source;

pub fn run(bytes: &[u8]) -> bool {
    let mut source = Source::new(bytes);
    let mut scene = Scene::new(&mut source);
    let caller = Caller::new();
    let iterations = source.between(1, 40) as u32;
    caller.set_options(iterations, source.within(0.04, 0.2), source.between(1, 2) as u32);
    let budget = source.below(4) as u32;
    let Scene { garment, body, joints, skin, has_junctions, .. } = &mut scene;
    let mut reported = Reported { garment, body, joints, skin, has_junctions };
    (0..3).for_each(|_| reported.afflict(&mut source));
    if !scene.hand_over(&caller) {
        return false;
    }
    // SAFETY: the session is alive.
    let status = caller.after("prepare", unsafe { bespoke_session_prepare(caller.session) });
    if status != BespokeStatus::Ok {
        assert_eq!(caller.stage(), BespokeStage::Setup as u32, "a session that could not prepare still takes inputs");
        return false;
    }
    let mut stage = caller.stage();
    while stage != BespokeStage::Done as u32 {
        // SAFETY: the session is alive, there is room for a stage.
        let status = caller.after("step", unsafe { bespoke_session_step(caller.session, budget, 0, &mut stage) });
        if status == BespokeStatus::ImplausibleResult {
            assert_eq!(stage, BespokeStage::Done as u32, "{}", caller.message());
        } else if status != BespokeStatus::Ok {
            assert_eq!(stage, BespokeStage::Failed as u32, "{}", caller.message());
            return false;
        }
    }
    scene.judge(&caller);
    true
}

/// What is handed in, as the caller stores it.
struct Scene {
    garment: Shape,
    body: Shape,
    joints: [Vec<f64>; 2],
    bones: Vec<u32>,
    source_body: Option<Shape>,
    /// Rows of skin weights of the body, a row a joint; empty for none.
    skin: Vec<f64>,
    has_junctions: bool,
    is_double: bool,
    padding: usize,
}

/// A chain of joints as a curve over its height.
fn along(joints: &[f64]) -> impl Fn(f64) -> [f64; 2] {
    move |z| {
        let points = joints.as_chunks::<3>().0;
        let upper = points.iter().position(|p| p[2] >= z).unwrap_or(points.len() - 1).max(1);
        let ([x, y, from], [u, v, to]) = (points[upper - 1], points[upper]);
        let s = (z - from) / (to - from);
        [x + s * (u - x), y + s * (v - y)]
    }
}

impl Scene {
    fn new(source: &mut Source) -> Self {
        let joint_count = source.between(2, 5);
        let bend = source.within(0.0, 0.2);
        let designed = joints(joint_count, || bend * source.signed());
        let mut target = joints(joint_count, || bend * source.signed());

        let [radius, ripple] = [source.within(0.1, 0.5), source.within(0.0, 0.15)];
        let ends = [source.within(-0.95, -0.1), source.within(0.1, 0.95)];
        let (rings, sides) = (source.between(2, 7), source.between(3, 8));
        let sleeve = |source: &mut Source, radius: f64| {
            Shape::tube(rings, sides, ends, false, |_| radius + ripple * source.signed(), along(&designed))
        };
        let mut garment = sleeve(source, radius);
        if source.one_in(4) {
            let inner = radius * source.within(0.8, 1.0);
            let lining = sleeve(source, inner);
            garment.join(&lining);
        }
        let [thickness, lumps] = [source.within(0.02, 0.7), source.within(0.0, 0.3)];
        let (rings, sides) = (source.between(2, 7), source.between(3, 8));
        let span = [source.within(-1.4, -0.5), source.within(0.5, 1.4)];
        let is_closed = !source.one_in(4);
        let mut body =
            Shape::tube(rings, sides, span, is_closed, |_| thickness + lumps * source.signed(), along(&target));
        let mut source_body =
            source.one_in(4).then(|| Shape::tube(3, 4, [-1.1, 1.1], true, |_| 0.3 * radius, along(&designed)));

        for _ in 0..source.below(4) {
            garment.damage(source);
        }
        for _ in 0..source.below(4) {
            body.damage(source);
        }
        let place = |source: &mut Source| {
            let scale = if source.one_in(3) { 10f64.powf(4.0 * source.signed()) } else { 1.0 };
            let distance = if source.one_in(4) { 10f64.powf(5.0 * source.signed()) } else { 0.0 };
            (scale, [0; 3].map(|_| distance * source.signed()))
        };
        let (scale, away) = place(source);
        for shape in [Some(&mut garment), source_body.as_mut()].into_iter().flatten() {
            shape.scale(scale, away);
        }
        let mut skeletons = [designed.clone(), std::mem::take(&mut target)];
        skeletons[0].iter_mut().enumerate().for_each(|(k, x)| *x = scale * *x + away[k % 3]);
        let (scale, away) = place(source);
        body.scale(scale, away);
        skeletons[1].iter_mut().enumerate().for_each(|(k, x)| *x = scale * *x + away[k % 3]);
        Self {
            garment,
            body,
            joints: skeletons,
            bones: bones(joint_count),
            source_body,
            skin: Vec::new(),
            has_junctions: false,
            is_double: source.one_in(2),
            padding: source.below(3) * 4,
        }
    }

    /// Sets all inputs; false where one is refused.
    fn hand_over(&self, caller: &Caller) -> bool {
        type Set = unsafe extern "C" fn(
            *mut bespoke::capi::session::BespokeSession,
            *const BespokeView,
            *const BespokeView,
        ) -> BespokeStatus;
        let set = |name: &str, call: Set, points: &[f64], elements: &[u32], width: usize| {
            let points = Array::floats(points, 3, self.padding, self.is_double);
            let elements = Array::indices(elements, width, self.padding, false);
            // SAFETY: the session is alive and the views tell the truth.
            caller.after(name, unsafe { call(caller.session, &points.view(), &elements.view()) }) == BespokeStatus::Ok
        };
        let mesh = |name: &str, call: Set, shape: &Shape| set(name, call, &shape.points, &shape.triangles, 3);
        mesh("set_garment", bespoke_session_set_garment, &self.garment)
            && mesh("set_target_avatar", bespoke_session_set_target_avatar, &self.body)
            && set("set_source_skeleton", bespoke_session_set_source_skeleton, &self.joints[0], &self.bones, 2)
            && set("set_target_skeleton", bespoke_session_set_target_skeleton, &self.joints[1], &self.bones, 2)
            && self
                .source_body
                .as_ref()
                .is_none_or(|shape| mesh("set_source_avatar", bespoke_session_set_source_avatar, shape))
            && self.hand_over_skin(caller)
    }

    /// Sets the skin weights; false where they are refused.
    fn hand_over_skin(&self, caller: &Caller) -> bool {
        if self.skin.is_empty() {
            return true;
        }
        let vertices = self.body.vertex_count();
        let rows = Array::floats(&self.skin, vertices, 0, self.is_double);
        // SAFETY: the session is alive and the view tells the truth.
        let status = unsafe { bespoke_session_set_target_skin_weights(caller.session, &rows.view(), vertices) };
        caller.after("set_target_skin_weights", status) == BespokeStatus::Ok
    }

    /// The numbers as they were stored.
    fn stored(&self, points: &[f64], triangles: &[u32]) -> TriangleMesh {
        let round = |x: f64| if self.is_double { x } else { f64::from(x as f32) };
        TriangleMesh {
            positions: points.as_chunks::<3>().0.iter().map(|p| DVec3::from_array(p.map(round))).collect(),
            triangles: triangles.as_chunks::<3>().0.to_vec(),
        }
    }

    /// The body without the connected pieces of these triangles.
    fn body_without(&self, triangles: &[u32]) -> TriangleMesh {
        let mut body = self.stored(&self.body.points, &self.body.triangles);
        let (to_welded, places) = weld_vertices(&body);
        let links =
            body.triangles.iter().map(|t| t.map(|v| to_welded[v as usize])).flat_map(|[a, b, c]| [[a, b], [b, c]]);
        let (labels, _) = label_pieces(places.len(), links);
        let piece = |t: &[u32; 3]| labels[to_welded[t[0] as usize] as usize];
        let left_out: Vec<u32> = triangles.iter().map(|&t| piece(&body.triangles[t as usize])).collect();
        body.triangles.retain(|t| !left_out.contains(&piece(t)));
        body
    }

    /// A result that is done does not touch the body, but for what of it was left out, and touches itself nowhere that the design
    /// did not.
    fn judge(&self, caller: &Caller) {
        let count = |a: &TriangleMesh, b: Option<&TriangleMesh>| {
            intersections(a, b, 0).expect("what is done can be judged").count
        };
        let body = self.body_without(&caller.left_out());
        let before = self.stored(&self.garment.points, &self.garment.triangles);
        let result = self.stored(&caller.garment(self.is_double), &self.garment.triangles);
        assert_eq!(result.positions.len(), before.positions.len());
        assert_eq!(count(&result, Some(&body)), 0, "the garment touches the body");
        if self.has_junctions {
            return;
        }
        let (now, then) = (count(&result, None), count(&before, None));
        assert!(now <= then, "{now} pairs of garment triangles touch, {then} did at the start");
        let mut own = BespokeIntersections::default();
        let component = if self.is_double { BespokeComponent::F64 } else { BespokeComponent::F32 } as u32;
        // SAFETY: the session is alive, there is room for the counts.
        let status = unsafe { bespoke_session_verify(caller.session, component, &mut own) };
        assert_eq!(caller.after("verify", status), BespokeStatus::Ok);
        assert_eq!(own.garment_avatar, 0);
        assert!(own.garment_garment <= now, "the library counts {} pairs of {now}", own.garment_garment);
    }
}
