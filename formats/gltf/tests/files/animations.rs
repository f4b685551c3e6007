//! Animations, compared with closed forms.

use bespoke_gltf::{Animation, Document, Interpolation, Pose, Property};
use glam::{DQuat, DVec3};

use crate::everything::{glb, open};

/// A file that is written for a test: accessors first, then the rest of the JSON.
#[derive(Default)]
struct Writer {
    binary: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl Writer {
    fn add(&mut self, bytes: &[u8], kind: u32, shape: &str, count: usize, more: &str) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let (from, view) = (self.binary.len(), self.views.len());
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{from},"byteLength":{}}}"#, bytes.len()));
        self.binary.extend(bytes);
        self.accessors
            .push(format!(r#"{{"bufferView":{view},"componentType":{kind},"type":"{shape}","count":{count}{more}}}"#));
        view
    }

    fn floats<const N: usize>(&mut self, rows: &[[f64; N]]) -> usize {
        let bytes: Vec<u8> = rows.as_flattened().iter().flat_map(|&x| (x as f32).to_le_bytes()).collect();
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.add(&bytes, 5126, shape, rows.len(), "")
    }

    fn file(&self, rest: &str) -> Vec<u8> {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{}],{rest}}}"#,
            self.binary.len(),
            self.views.join(","),
            self.accessors.join(",")
        );
        glb(&json, &self.binary, &[])
    }
}

const NODES: &str = r#""nodes":[{"name":"a","children":[1],"translation":[1,0,0]},{"name":"b","translation":[0,2,0]}]"#;

/// An animation with one channel, of the node 1.
fn channel(writer: &Writer, path: &str, [input, output]: [usize; 2], interpolation: &str) -> Document {
    open(&writer.file(&format!(
        r#"{NODES},"animations":[{{"channels":[{{"sampler":0,"target":{{"node":1,"path":"{path}"}}}}],
        "samplers":[{{"input":{input},"output":{output},"interpolation":"{interpolation}"}}]}}]"#
    )))
}

fn first(document: &Document) -> Animation {
    document.animations().unwrap_or_else(|error| panic!("{error}")).swap_remove(0)
}

#[track_caller]
fn near(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-6), "{a:?} instead of {b:?}");
}

/// The same rotation, by whichever of its two quaternions.
#[track_caller]
fn same_turn(a: [f64; 4], b: DQuat) {
    let (a, length) = (DQuat::from_array(a), DQuat::from_array(a).length());
    assert!((length - 1.0).abs() < 1e-12, "its length is {length}");
    assert!(a.dot(b).abs() > 1.0 - 1e-12, "{a} instead of {b}");
}

#[test]
fn steps_and_lines() {
    let mut writer = Writer::default();
    let input = writer.floats(&[[0.5], [1.0], [3.0]]);
    let output = writer.floats(&[[0.0, 0.0, 0.0], [1.0, -2.0, 4.0], [5.0, 0.0, 0.0]]);
    let linear = first(&channel(&writer, "translation", [input, output], "LINEAR"));
    assert_eq!((linear.span(), linear.keys()), (Some((0.5, 3.0)), vec![0.5, 1.0, 3.0]));
    assert_eq!(linear.samplers[0].interpolation, Interpolation::Linear);
    assert_eq!((linear.channels[0].node, linear.channels[0].property), (1, Property::Translation));
    // Before the first and after the last key it stays.
    for (time, value) in [
        (-1.0, [0.0, 0.0, 0.0]),
        (0.5, [0.0, 0.0, 0.0]),
        (0.75, [0.5, -1.0, 2.0]),
        (1.0, [1.0, -2.0, 4.0]),
        (1.5, [2.0, -1.5, 3.0]),
        (3.0, [5.0, 0.0, 0.0]),
        (9.0, [5.0, 0.0, 0.0]),
    ] {
        near(&linear.samplers[0].value(time), &value);
    }
    let step = first(&channel(&writer, "scale", [input, output], "STEP"));
    for (time, value) in [(0.0, 0.0), (0.999, 0.0), (1.0, 1.0), (2.999, 1.0), (3.0, 5.0), (4.0, 5.0)] {
        assert_eq!(step.samplers[0].value(time)[0], value, "at {time}");
    }
}

/// A spline through the values and derivatives of a polynomial of third degree is that polynomial.
#[test]
fn a_cubic_spline_is_the_cubic_that_it_is_made_of() {
    let cubic = |t: f64| DVec3::new(t * t * t - 2.0 * t, 0.5 * t * t + 1.0, 3.0 - t);
    let slope = |t: f64| DVec3::new(3.0 * t * t - 2.0, t, -1.0);
    let times = [0.0, 0.25, 1.5, 2.0];
    let mut writer = Writer::default();
    let input = writer.floats(&times.map(|t| [t]));
    let rows: Vec<[f64; 3]> =
        times.iter().flat_map(|&t| [slope(t), cubic(t), slope(t)]).map(|v| v.to_array()).collect();
    let output = writer.floats(&rows);
    let spline = first(&channel(&writer, "translation", [input, output], "CUBICSPLINE"));
    for k in 0..=200 {
        let t = 2.0 * f64::from(k) / 200.0;
        near(&spline.samplers[0].value(t), &cubic(t).to_array());
    }
    // Of rotations the spline is put to length 1.
    let turns: Vec<[f64; 4]> = [0.2f64, 1.0]
        .iter()
        .flat_map(|angle| [[0.0; 4], [0.0, 0.0, (0.5 * angle).sin(), (0.5 * angle).cos()], [0.0; 4]])
        .collect();
    let mut writer = Writer::default();
    let (input, output) = (writer.floats(&[[0.0], [1.0]]), writer.floats(&turns));
    let spline = first(&channel(&writer, "rotation", [input, output], "CUBICSPLINE"));
    same_turn(spline.samplers[0].rotation(0.0), DQuat::from_rotation_z(0.2));
    // Half-way, without tangents, it is the mean.
    same_turn(spline.samplers[0].rotation(0.5), DQuat::from_rotation_z(0.6));
}

#[test]
fn rotations_go_the_shorter_arc_at_an_even_pace() {
    let axis = DVec3::new(1.0, 2.0, -0.5).normalize();
    let turn = |angle: f64| DQuat::from_axis_angle(axis, angle);
    for (from, to) in [(0.0, 3.0), (0.3, 0.3 + 1e-6), (-1.0, 2.0), (0.5, 0.5)] {
        for sign in [1.0, -1.0] {
            let mut writer = Writer::default();
            let input = writer.floats(&[[2.0], [4.0]]);
            // A quaternion and its negative are one rotation.
            let output = writer.floats(&[turn(from).to_array(), (turn(to) * sign).to_array()]);
            let linear = first(&channel(&writer, "rotation", [input, output], "LINEAR"));
            for k in 0..=8 {
                let share = f64::from(k) / 8.0;
                same_turn(linear.samplers[0].rotation(2.0 + 2.0 * share), turn(from + share * (to - from)));
            }
        }
    }
    // As 16-bit numbers, which are near to length 1 only.
    let mut writer = Writer::default();
    let input = writer.floats(&[[0.0], [1.0]]);
    let short: Vec<u8> = [turn(0.0), turn(1.0)]
        .iter()
        .flat_map(|q| q.to_array())
        .flat_map(|x| ((x * 32767.0).round() as i16).to_le_bytes())
        .collect();
    let output = writer.add(&short, 5122, "VEC4", 2, r#","normalized":true"#);
    let linear = first(&channel(&writer, "rotation", [input, output], "LINEAR"));
    let half = DQuat::from_array(linear.samplers[0].rotation(0.5));
    assert!(half.dot(turn(0.5)).abs() > 1.0 - 1e-8);
}

/// An arm of two bones that bends, and a mesh that grows by its morph targets, are where they must be.
#[test]
fn vertices_follow() {
    let mut writer = Writer::default();
    let tip = [[0.0, 3.0, 0.0], [0.0, 1.0, 0.0], [0.5, 2.0, 0.0]];
    let positions = writer.floats(&tip);
    let joints = writer.add(&[1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0], 5121, "VEC4", 3, "");
    let weights = writer.floats(&[[1.0, 0.0, 0.0, 0.0], [0.75, 0.25, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]);
    let delta = writer.floats(&[[0.0, 0.0, 1.0], [0.0; 3], [0.0; 3]]);
    // The joints were bound at the origin and at (0, 2, 0).
    let mut binds = [[0.0; 4]; 8];
    for (k, y) in [0.0, -2.0].into_iter().enumerate() {
        for d in 0..4 {
            binds[4 * k + d][d] = 1.0;
        }
        binds[4 * k + 3][1] = y;
    }
    let bytes: Vec<u8> = binds.as_flattened().iter().flat_map(|&x| (x as f32).to_le_bytes()).collect();
    let binds = writer.add(&bytes, 5126, "MAT4", 2, "");
    let input = writer.floats(&[[0.0], [1.0]]);
    let quarter = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    let bend = writer.floats(&[DQuat::IDENTITY.to_array(), quarter.to_array()]);
    let grow = writer.floats(&[[0.0], [2.0]]);
    let document = open(&writer.file(&format!(
        r#""nodes":[{{"children":[1],"translation":[1,0,0]}},{{"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,2,0,1]}},
        {{"mesh":0,"skin":0,"translation":[9,9,9]}},{{"mesh":0,"translation":[0,0,-1]}}],
        "skins":[{{"joints":[0,1],"inverseBindMatrices":{binds}}}],
        "meshes":[{{"weights":[0.5],"primitives":[{{"attributes":{{"POSITION":{positions},"JOINTS_0":{joints},"WEIGHTS_0":{weights}}},
        "targets":[{{"POSITION":{delta}}}]}}]}}],
        "animations":[{{"name":"bend","channels":[{{"sampler":0,"target":{{"node":1,"path":"rotation"}}}},
        {{"sampler":1,"target":{{"node":2,"path":"weights"}}}},{{"sampler":1,"target":{{"path":"weights"}}}},
        {{"sampler":1,"target":{{"node":0,"path":"pointer","extensions":{{}}}}}}],
        "samplers":[{{"input":{input},"output":{bend}}},{{"input":{input},"output":{grow}}}]}}]"#
    )));
    let scene = document.scene().expect("a scene");
    let animation = first(&document);
    assert_eq!((animation.name.as_str(), animation.channels.len()), ("bend", 2), "others are passed over");
    let posable = |node: usize| {
        let all = scene.characters[0].meshes.iter().chain(&scene.loose);
        let instance = all.into_iter().find(|instance| instance.node == node).expect("the mesh");
        document.posable(&scene, instance).expect("a mesh to pose")
    };
    let (arm, still) = (posable(2), posable(3));
    for angle in [0.0, 30.0f64, 90.0] {
        let share = angle / 90.0;
        let pose = animation.pose(&scene.nodes, share).expect("a pose");
        let turn = DQuat::from_rotation_z(angle.to_radians());
        let elbow = DVec3::new(1.0, 2.0, 0.0);
        let at = |p: DVec3| elbow + turn * (p - DVec3::new(0.0, 2.0, 0.0));
        let grown = DVec3::new(0.0, 3.0, 2.0 * share);
        let lower = DVec3::new(0.0, 1.0, 0.0);
        let expected = [at(grown), 0.75 * (lower + DVec3::X) + 0.25 * at(lower), at(DVec3::new(0.5, 2.0, 0.0))];
        let found = arm.positions(&pose).expect("positions");
        found.iter().zip(expected).for_each(|(p, q)| near(p, &q.to_array()));
        // Without a skin it is at its node, and no weight of its own is animated.
        near(&still.positions(&pose).expect("positions")[0], &[0.0, 3.0, -0.5]);
    }
    let rest = arm.positions(&Pose::rest(&scene.nodes)).expect("positions");
    near(&rest[0], &[1.0, 3.0, 0.5]);
}

#[test]
fn animations_that_lie_are_refused() {
    let mut writer = Writer::default();
    let input = writer.floats(&[[0.0], [1.0]]);
    let back = writer.floats(&[[1.0], [1.0]]);
    let three = writer.floats(&[[0.0; 3], [1.0; 3]]);
    let short = writer.floats(&[[0.0; 3]]);
    let turn = writer.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0]]);
    let numbers = writer.floats(&[[0.0], [1.0]]);
    for (path, accessors, interpolation, says) in [
        ("translation", [back, three], "LINEAR", "/animations/0/samplers/0/input: time 1 is 1"),
        (
            "translation",
            [input, short],
            "LINEAR",
            "/animations/0/samplers/0/output: 3 numbers for 2 keys, which need 6",
        ),
        ("translation", [input, three], "CUBICSPLINE", "which need 18"),
        ("translation", [input, three], "SMOOTH", "is 'SMOOTH'"),
        ("translation", [input, turn], "LINEAR", "4 numbers an element"),
        ("translation", [input, 99], "LINEAR", "is 99"),
        ("rotation", [input, turn], "STEP", "value 1 is no rotation"),
        ("weights", [input, numbers], "STEP", "node 1 has no mesh"),
    ] {
        let said = channel(&writer, path, accessors, interpolation).animations().expect_err("a lie").to_string();
        assert!(said.contains(says), "{said}");
    }
}
