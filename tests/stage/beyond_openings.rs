//! A head that hangs below the collar, by its weights.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::{BoneGraph, Location, Skeleton};
use bespoke::input::skin::SkinWeights;
use bespoke::stage::start::beyond_openings::{Ends, MovedEnd, begin_beyond, openings};
use bespoke::stage::start::projection::{ProjectedAvatar, project};
use glam::DVec3;

/// The bone of the head, and the joint at its top.
const HEAD: u32 = 1;
const TOP: u32 = 2;

/// A trunk with shoulders a tenth below the neck and a head, one long each.
fn skeleton() -> Skeleton {
    let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    Skeleton {
        joints: vec![at(0.0, 0.0), at(0.0, 1.0), at(0.0, 2.0), at(0.4, 0.9), at(-0.4, 0.9)],
        bones: vec![[0, 1], [1, 2], [1, 3], [1, 4]],
    }
}

/// A tube around the trunk's axis.
fn tube(low: f64, high: f64) -> TriangleMesh {
    const SIDES: u32 = 12;
    let ring = |z: f64| {
        (0..SIDES).map(move |k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
            DVec3::new(0.2 * cos, 0.2 * sin, z)
        })
    };
    let sides = (0..SIDES).flat_map(|k| {
        let next = (k + 1) % SIDES;
        [[k, next, SIDES + k], [next, SIDES + next, SIDES + k]]
    });
    TriangleMesh { positions: ring(low).chain(ring(high)).collect(), triangles: sides.collect() }
}

/// A body of small triangles at these heights: those of the head, and one of the chest.
struct Flesh {
    mesh: TriangleMesh,
    joints: Vec<Option<u32>>,
    skin: SkinWeights,
}

impl Flesh {
    fn new(head: &[f64]) -> Self {
        let corner = |z: f64| [0.0, 0.01, 0.02].map(|x| DVec3::new(x, -0.3 + x * x, z));
        let mesh = TriangleMesh::from_corners(head.iter().map(|&z| corner(z)).chain([corner(0.8)]));
        let count = 3 * head.len();
        let joints: Vec<Option<u32>> = (0..count + 3).map(|v| (v < count).then_some(TOP)).collect();
        let rows = joints.iter().map(|joint| vec![(joint.unwrap_or(0), 1.0)]);
        Self { skin: SkinWeights::from_rows(5, rows), mesh, joints }
    }

    fn ends(&self) -> Ends<'_> {
        Ends { body: &self.mesh, joints: &self.joints }
    }

    /// On the same skeleton, before and after.
    fn begin(&self, garment: &TriangleMesh, source: Option<&Self>) -> [(ProjectedAvatar, Vec<MovedEnd>); 2] {
        let skeleton = skeleton();
        let straight = project(&self.mesh, &skeleton, &skeleton, Some(&self.skin));
        let source = source.map(Self::ends);
        let beyond = begin_beyond(straight.clone(), garment, [&skeleton; 2], self.ends(), source);
        [(straight, Vec::new()), beyond]
    }
}

fn parameter(location: Location) -> f64 {
    let Location::Bone { bone: HEAD, parameter } = location else { panic!("{location:?}") };
    parameter
}

#[test]
fn a_garment_ends_at_its_collar_and_not_at_the_brim_of_a_hat() {
    let (skeleton, graph) = (skeleton(), BoneGraph::new(&skeleton()));
    let found = |garment: &TriangleMesh| {
        let found = openings(garment, &skeleton, &graph);
        found.into_iter().find(|opening| opening.bone == HEAD)
    };
    let collar = found(&tube(0.5, 1.1)).expect("a collar");
    assert_eq!(collar.leaf, 1);
    assert!(collar.at.iter().all(|at| (at - 0.1).abs() < 1e-12), "{collar:?}");
    // Of a hat without a crown the upper border is one beyond which nothing is.
    assert!((found(&tube(1.5, 1.8)).expect("its upper border").at[0] - 0.8).abs() < 1e-12);
    let hat = {
        let mut hat = tube(1.5, 1.8);
        let top = hat.positions.len() as u32;
        hat.positions.push(DVec3::new(0.0, 0.0, 2.3));
        hat.triangles.extend((0..12).map(|k| [12 + k, 12 + (k + 1) % 12, top]));
        hat
    };
    assert_eq!(found(&hat), None);
}

#[test]
fn a_chin_below_the_neck_starts_beyond_the_collar_and_keeps_its_order() {
    let (head, own) = (Flesh::new(&[0.95, 1.05, 1.3, 1.9]), Flesh::new(&[1.25, 1.5, 1.9]));
    let [(before, _), (after, moved)] = head.begin(&tube(0.5, 1.1), Some(&own));
    let [first, last, beyond] = [-0.05, 0.9, 0.12];
    for (v, p) in head.mesh.positions.iter().enumerate().filter(|(v, _)| head.joints[*v].is_some()) {
        let expected = beyond + (p.z - 1.0 - first) * (last - beyond) / (last - first);
        let now = parameter(after.locations[v]);
        assert!((now - expected).abs() < 1e-9, "{p}: {now} {expected}");
        assert!((after.shrunk[v].z - 1.0 - now).abs() < 1e-9);
    }
    // The rest stays, and without this the chin is in the collar.
    for v in (0..before.locations.len()).filter(|&v| head.joints[v].is_none()) {
        assert_eq!(before.locations[v], after.locations[v]);
    }
    assert_eq!(parameter(before.locations[0]), 0.0);

    // Half of the free neck is half of it.
    let [moved] = moved[..] else { panic!("{moved:?}") };
    let skeleton = skeleton();
    for share in [0.0, 0.5, 1.0, 1.2] {
        let height = |begins: f64| 0.9 + share * (begins - 0.9);
        let place = moved.place(DVec3::new(0.3, 0.1, height(1.25)), &skeleton, &skeleton);
        assert!((place - DVec3::Z * height(0.95)).length() < 1e-9, "{share}: {place}");
    }
}

#[test]
fn what_lies_as_in_the_design_stays() {
    let collar = tube(0.5, 1.1);
    let low = Flesh::new(&[0.95, 1.05, 1.3, 1.9]);
    let high = Flesh::new(&[1.25, 1.5, 1.9]);
    // The same chin; a head that begins beyond the collar; a garment that covers the head; a mane down to below the shoulders.
    let mane = Flesh::new(&[0.7, 0.85, 1.3, 1.9]);
    for (what, flesh, garment, source) in [
        ("the same", &low, &collar, &low),
        ("high", &high, &collar, &Flesh::new(&[1.5, 1.7, 1.9])),
        ("covered", &low, &tube(0.5, 1.7), &high),
        ("mane", &mane, &collar, &high),
    ] {
        let [(before, _), (after, moved)] = flesh.begin(garment, Some(source));
        assert!(moved.is_empty(), "{what}: {moved:?}");
        assert_eq!(before.locations, after.locations, "{what}");
    }
    // Without a source body the opening alone says it.
    assert_eq!(low.begin(&collar, None)[1].1.len(), 1);
}
