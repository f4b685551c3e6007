//! What the figures measure, and the transfer that they compare with, where the answer is known.

use bespoke::geometry::mesh::TriangleMesh;
use glam::DVec3;

use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::{Kind, sample};
use figures::measure::{Neckline, loop_height, middle_loops, waist_clearance};
use figures::transfer::transfer;
use gallery::pair;

#[test]
fn the_angle_of_a_v_is_that_of_its_sides() {
    let vest = garment(Garment::Vest);
    let neckline = Neckline::of(&vest.mesh).unwrap();
    let designed = neckline.shape(&vest.mesh.positions);
    assert!((40.0..56.0).contains(&designed.angle) && designed.bend < 0.01, "{} {}", designed.angle, designed.bend);
    // Twice as wide, the tangent of half the angle doubles, also where the vest is moved and turned towards the ground.
    let wide: Vec<DVec3> = vest.mesh.positions.iter().map(|p| *p * DVec3::new(2.0, 3.0, 1.0) + DVec3::ONE).collect();
    let expected = 2.0 * (2.0 * (0.5 * designed.angle).to_radians().tan()).atan().to_degrees();
    let shape = neckline.shape(&wide);
    assert!((shape.angle - expected).abs() < 0.3, "{} instead of {expected}", shape.angle);
    assert!((shape.at_point - expected).abs() < 2.0, "{} instead of {expected}", shape.at_point);
}

#[test]
fn collar_and_hem_are_the_ends_of_the_trunk() {
    let coat = garment(Garment::Coat);
    let [collar, hem] = middle_loops(&coat.mesh).unwrap();
    let [top, bottom] = [&collar, &hem].map(|curve| loop_height(&coat.mesh.positions, curve));
    let heights = coat.mesh.positions.iter().map(|p| p.z);
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(z), high.max(z)));
    assert!(top > high - 0.08 && bottom < low + 0.08, "{top} of {high}, {bottom} of {low}");
}

#[test]
fn clearance_is_measured_at_the_waist() {
    let mannequin = sample(Kind::Mannequin);
    let skin = pair::mesh(&mannequin.mesh);
    assert!(waist_clearance(&skin, &mannequin) < 1e-6);
    let jumpsuit = pair::mesh(&garment(Garment::Jumpsuit).mesh);
    let coat = pair::mesh(&garment(Garment::Coat).mesh);
    let [tight, loose] = [&jumpsuit, &coat].map(|worn| waist_clearance(worn, &mannequin));
    assert!((0.005..0.02).contains(&tight) && loose > 2.0 * tight, "{tight} {loose}");
}

#[test]
fn transfer_to_the_same_body_changes_nothing_and_to_others_little_more_than_it_must() {
    let mannequin = sample(Kind::Mannequin);
    let sweater = garment(Garment::Sweater);
    let apart = |mesh: &TriangleMesh| {
        let pairs = mesh.positions.iter().zip(&sweater.mesh.positions);
        pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
    };
    assert!(apart(&transfer(&sweater, &mannequin, &mannequin)) < 1e-6);
    // On a much smaller body it is smaller, and around that body's waist.
    let child = avatar(Avatar::Child);
    let moved = transfer(&sweater, &mannequin, &child);
    let size = |points: &[DVec3]| {
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        (high - low).max_element()
    };
    let ratio = size(&moved.positions) / size(&sweater.mesh.positions);
    assert!((0.3..0.9).contains(&ratio), "{ratio}");
    assert!(waist_clearance(&moved, &child) < 0.1);
}
