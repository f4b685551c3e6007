//! Where pins go.

use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::pin_targets::resolve;
use glam::{DMat3, DVec3};

fn skeleton(joints: &[DVec3]) -> Skeleton {
    Skeleton { joints: joints.to_vec(), bones: vec![[0, 1], [1, 2]] }
}

fn source() -> Skeleton {
    skeleton(&[DVec3::ZERO, DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0)])
}

/// Two triangles near the first bone, one near the second.
fn garment() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut rest = vec![
        DVec3::new(0.2, 0.0, 0.3),
        DVec3::new(0.2, 0.1, 0.5),
        DVec3::new(0.2, 0.0, 0.7),
        DVec3::new(0.25, 0.1, 0.9),
    ];
    rest.extend([0.5, 0.6, 0.7].map(|x| DVec3::new(x, 0.3, 1.1 + 0.1 * (x - 0.5))));
    (rest, vec![[0, 1, 2], [1, 3, 2], [4, 5, 6]])
}

#[test]
fn on_the_same_skeleton_they_stay() {
    let (rest, triangles) = garment();
    let asked: Vec<(u32, Option<DVec3>)> = (0..7).map(|v| (v, None)).collect();
    for pin in resolve(&rest, &triangles, &asked, &source(), &source()) {
        assert_eq!(pin.start, rest[pin.vertex as usize]);
        assert!(pin.end.distance(pin.start) < 1e-14);
    }
}

#[test]
fn a_place_that_is_named_is_taken() {
    let (rest, triangles) = garment();
    let place = DVec3::new(4.0, 5.0, 6.0);
    let pins = resolve(&rest, &triangles, &[(2, Some(place)), (5, None)], &source(), &source());
    assert_eq!(pins.iter().map(|pin| pin.vertex).collect::<Vec<_>>(), [2, 5]);
    assert_eq!(pins[0].end, place);
    assert_eq!(pins[0].start, rest[2]);
}

#[test]
fn others_go_with_their_bone() {
    let (rest, triangles) = garment();
    let asked: Vec<(u32, Option<DVec3>)> = (0..7).map(|v| (v, None)).collect();
    // The skeleton turned and moved as a whole: so are the pins, for every bone turns by the same least rotation here.
    let turn = DMat3::from_rotation_y(0.7);
    let shift = DVec3::new(1.0, 2.0, 3.0);
    let target = skeleton(&source().joints.iter().map(|&p| turn * p + shift).collect::<Vec<_>>());
    for pin in resolve(&rest, &triangles, &asked, &source(), &target) {
        assert!(pin.end.distance(turn * pin.start + shift) < 1e-12, "vertex {}", pin.vertex);
    }
    // A bone twice as long: twice as far along it, and as far from it as before.
    let longer = skeleton(&[DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0), DVec3::new(1.0, 0.0, 2.0)]);
    let pins = resolve(&rest, &triangles, &asked, &source(), &longer);
    for pin in &pins[..4] {
        // Also vertex 3, which by itself is nearer to the other bone than its neighbours are: the four go together.
        assert!(pin.end.distance(pin.start * DVec3::new(1.0, 1.0, 2.0)) < 1e-14, "{pin:?}");
    }
    for pin in &pins[4..] {
        assert!(pin.end.distance(pin.start + DVec3::Z) < 1e-14, "{pin:?}");
    }
}
