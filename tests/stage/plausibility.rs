//! Results that pass through nothing and that nobody would wear, built by hand, and good ones beside them.

use std::f64::consts::TAU;

use bespoke::control::Cancel;
use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::plausibility::{Disc, Findings, Misplacement, Outcome, compare, cover};
use bespoke::verify::intersections;
use glam::DVec3;
use testing::Random;

/// Rings of `sides` points about the x axis: places along it and radii; the body's ends are closed by fans.
fn tube(rings: &[[f64; 2]], sides: u32, is_closed: bool) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for &[x, radius] in rings {
        let point = |s: u32| {
            let angle = TAU * f64::from(s) / f64::from(sides);
            DVec3::new(x, radius * angle.cos(), radius * angle.sin())
        };
        mesh.positions.extend((0..sides).map(point));
    }
    let at = |r: u32, s: u32| r * sides + s % sides;
    let last = rings.len() as u32 - 1;
    for (r, s) in (0..last).flat_map(|r| (0..sides).map(move |s| (r, s))) {
        mesh.triangles.push([at(r, s), at(r + 1, s), at(r, s + 1)]);
        mesh.triangles.push([at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)]);
    }
    for (r, x) in [(0, rings[0][0]), (last, rings[last as usize][0])].into_iter().filter(|_| is_closed) {
        let tip = mesh.positions.len() as u32;
        mesh.positions.push(DVec3::X * x);
        mesh.triangles.extend(
            (0..sides).map(|s| if r == 0 { [at(r, s), at(r, s + 1), tip] } else { [at(r, s + 1), at(r, s), tip] }),
        );
    }
    mesh
}

/// Evenly spaced rings.
fn rings(from: f64, to: f64, count: u32, radius: f64) -> Vec<[f64; 2]> {
    (0..=count).map(|k| [from + (to - from) * f64::from(k) / f64::from(count), radius]).collect()
}

/// Trunk, upper arm and forearm, of which the hand goes on beyond.
fn skeleton() -> Skeleton {
    Skeleton { joints: [-1.0, 0.0, 0.5, 1.0].map(|x| DVec3::X * x).to_vec(), bones: vec![[0, 1], [1, 2], [2, 3]] }
}

fn arm() -> TriangleMesh {
    tube(&rings(-1.3, 1.3, 52, 0.1), 24, true)
}

/// A sleeve from the upper arm to the wrist.
fn sleeve(sides: u32, count: u32) -> TriangleMesh {
    tube(&rings(0.05, 0.95, count, 0.16), sides, false)
}

fn findings(design: &TriangleMesh, result: &TriangleMesh) -> Findings {
    findings_over(&TriangleMesh::default(), design, result)
}

/// The findings where the arm wears something already.
fn findings_over(worn: &TriangleMesh, design: &TriangleMesh, result: &TriangleMesh) -> Findings {
    let skeleton = skeleton();
    let (source, target, body) = (&skeleton, &skeleton, &arm());
    let outcome = Outcome { design, result, source, target, body, worn, collision_only: &[], intersecting: &[] };
    compare(&outcome, &Cancel::new()).expect("nobody cancels")
}

fn moved(mesh: &TriangleMesh, by: impl Fn(DVec3) -> DVec3) -> TriangleMesh {
    TriangleMesh { positions: mesh.positions.iter().map(|&p| by(p)).collect(), triangles: mesh.triangles.clone() }
}

#[test]
fn a_sleeve_that_fits_is_plausible() {
    for (sides, count) in [(3, 1), (8, 3), (40, 30)] {
        let design = sleeve(sides, count);
        // Thinner, thicker, and with the cuff a little up or down the arm.
        for (scale, shift) in [(0.7, 0.0), (1.0, 0.0), (3.0, 0.1), (1.0, -0.2)] {
            let worn = moved(&design, |p| DVec3::new(p.x + shift, scale * p.y / 0.9, scale * p.z / 0.9));
            // A coarse tube has to be around the arm.
            if scale > 0.7 || sides > 3 {
                assert_eq!(
                    findings(&design, &worn),
                    Findings::default(),
                    "{sides} sides, scale {scale}, shift {shift}"
                );
            }
        }
    }
}

#[test]
fn a_hand_that_is_shut_up_in_its_sleeve_is_found_however_fine_the_sleeve() {
    for (sides, count) in [(6, 20), (12, 20), (40, 60)] {
        let design = sleeve(sides, count);
        // Drawn out beyond the tips of the fingers, and closed there.
        let shut = moved(&design, |p| {
            let x = 0.05 + (p.x - 0.05) * 1.5;
            let narrow = if x > 1.32 { 0.02 } else { 1.0 };
            DVec3::new(x, narrow * p.y, narrow * p.z)
        });
        let found = findings(&design, &shut);
        let cuff = count * sides;
        assert!(found.is_gross());
        assert!(
            matches!(found.misplaced[..], [
                Misplacement::OutOfOpening { bone: 2, vertex },
                Misplacement::Inside { bone: 2, share, .. },
            ] if vertex == cuff && share > 0.9),
            "{sides} sides: {found:?}"
        );
    }
}

#[test]
fn an_arm_beside_its_sleeve_is_found() {
    let design = sleeve(20, 20);
    let beside = moved(&design, |p| p + 0.6 * DVec3::Y);
    let found = findings(&design, &beside);
    let out = |bone, vertex| Misplacement::OutOfOpening { bone, vertex };
    assert_eq!(found.misplaced[..2], [out(1, 0), out(2, 400)], "both openings are empty");
    let beside: Vec<u32> = found.misplaced[2..]
        .iter()
        .map(|m| match m {
            Misplacement::Beside { bone, share, .. } if *share >= 0.9 => *bone,
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(beside.contains(&1), "the upper arm was covered over its whole length: {found:?}");
    assert!(found.is_gross() && found.resized.is_empty());
}

#[test]
fn what_is_covered_by_design_may_stay_so() {
    // A mitten: the hand is shut up in it, as it should be.
    let mitten = tube(&[rings(0.6, 1.35, 6, 0.16), vec![[1.36, 0.01]]].concat(), 16, false);
    assert_eq!(
        findings(&mitten, &moved(&mitten, |p| DVec3::new(p.x + 0.02, 0.9 * p.y, 0.9 * p.z))),
        Findings::default()
    );
}

/// The sleeve with a pouch above it, a square of 2 x 4 x 4 triangles, `scale` times as large about its middle.
fn with_pouch(scale: f64) -> TriangleMesh {
    let mut mesh = sleeve(20, 20);
    let first = mesh.positions.len() as u32;
    let side = |k: u32| scale * 0.1 * (f64::from(k) / 4.0 - 0.5);
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        mesh.positions.push(DVec3::new(0.5 + side(i), side(j), 0.18));
    }
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let a = first + 5 * i + j;
        mesh.triangles.extend([[a, a + 5, a + 1], [a + 1, a + 5, a + 6]]);
    }
    mesh
}

#[test]
fn a_pouch_goes_with_the_size_of_what_it_hangs_on() {
    let design = with_pouch(1.0);
    let sized = |scale: f64, thicker: f64| {
        let result = moved(&with_pouch(scale), |p| DVec3::new(p.x, thicker * p.y, thicker * p.z));
        findings(&design, &result).resized
    };
    assert!(sized(1.0, 1.0).is_empty() && sized(0.6, 1.0).is_empty() && sized(1.6, 1.0).is_empty());
    // Twice as thick is 1.4 times as large.
    assert!(sized(1.4, 2.0).is_empty());
    let triangle = 2 * 20 * 20;
    for (scale, thicker, is_gross) in [(0.06, 1.0, true), (0.4, 1.0, false), (8.0, 1.0, true), (0.1, 2.0, true)] {
        let found = sized(scale, thicker);
        assert_eq!(found.len(), 1, "{scale}");
        assert_eq!((found[0].triangle, found[0].triangles, found[0].is_gross), (triangle, 32, is_gross), "{scale}");
        assert!((found[0].scale / scale).ln().abs() < 0.7, "{} for {scale}", found[0].scale);
    }
}

#[test]
fn a_piece_around_a_bone_has_the_size_of_the_body_there() {
    // A hat on a head that is five times as large, beside a shoe that became smaller.
    let design = sleeve(20, 20);
    assert_eq!(findings(&design, &moved(&design, |p| DVec3::new(p.x, 5.0 * p.y, 5.0 * p.z))), Findings::default());
    assert!(findings(&design, &moved(&design, |p| 0.02 * p + 0.5 * DVec3::X)).is_gross());
}

#[test]
fn a_section_has_the_area_of_what_goes_through() {
    for sides in [3_u32, 8, 60] {
        let ring = |s: u32| {
            let angle = TAU * (f64::from(s) + 0.31) / f64::from(sides);
            DVec3::new(0.203, angle.cos(), angle.sin())
        };
        let disc = Disc::new(&(0..sides).map(ring).collect::<Vec<_>>());
        let section = disc.section(&arm());
        let (area, length) = (24.0 * 0.5 * 0.01 * (TAU / 24.0).sin(), 48.0 * 0.1 * (TAU / 48.0).sin());
        assert!((section.area.length() - area).abs() < 1e-9, "{} {area}", section.area.length());
        assert!((section.length - length).abs() < 1e-9, "{} {length}", section.length);
        assert_eq!(disc.section(&moved(&arm(), |p| p + 5.0 * DVec3::Y)).length, 0.0);
    }
}

#[test]
fn cover_falls_from_the_middle_of_a_sleeve_to_beyond_its_cuff() {
    let tree = ClosestPoint::new(&sleeve(20, 1));
    let at = |x: f64| cover(&tree, DVec3::X * x);
    assert!(at(0.5) > 0.9 && (0.35..0.65).contains(&at(0.95)) && at(1.4) < 0.1 && at(5.0) == 0.0);
}

/// The sleeve that was modelled bent at x = 0.65, so that the bone of the forearm leaves it through the cloth.
fn bent_sleeve() -> TriangleMesh {
    let (sin, cos) = 70_f64.to_radians().sin_cos();
    moved(&sleeve(24, 40), |p| {
        let x = (p.x - 0.65).max(0.0);
        DVec3::new(
            p.x - x + x * cos - if x > 0.0 { p.y * sin } else { 0.0 },
            if x > 0.0 { p.y * cos } else { p.y } + x * sin,
            p.z,
        )
    })
}

#[test]
fn a_hand_that_is_shut_up_in_a_bent_sleeve_is_found() {
    let design = bent_sleeve();
    let straight = sleeve(24, 40);
    let longer = |by: f64, narrow: f64| {
        moved(&straight, |p| {
            let x = 0.05 + (p.x - 0.05) * by;
            let narrow = if x > 1.32 { narrow } else { 1.0 };
            DVec3::new(x, narrow * p.y, narrow * p.z)
        })
    };
    let found = findings(&design, &longer(1.5, 0.02));
    assert!(found.is_gross(), "{found:?}");
    assert!(matches!(found.misplaced[..], [Misplacement::Inside { bone: 2, share, .. }] if share > 0.9), "{found:?}");
    // The hand comes out of the cuff.
    assert_eq!(findings(&design, &longer(1.0, 1.0)), Findings::default());
}

/// The arm with a horn on its forearm, a piece of its own, `length` long and `radius` thick.
fn with_horn(length: f64, radius: f64) -> TriangleMesh {
    let mut body = arm();
    let horn = tube(&rings(0.0, length, 20, radius), 12, true);
    let first = body.positions.len() as u32;
    body.positions.extend(horn.positions.iter().map(|p| DVec3::new(0.5 + p.y, p.x, p.z)));
    body.triangles.extend(horn.triangles.iter().map(|t| t.map(|v| first + v)));
    body
}

/// `cloth` drawn out above the horn.
fn tented(cloth: &TriangleMesh, height: f64) -> TriangleMesh {
    moved(cloth, |p| {
        let away = DVec3::new(p.x - 0.5, 0.0, p.z).length();
        if p.y > 0.0 && away < 0.12 { DVec3::new(p.x, p.y.max(height), p.z) } else { p }
    })
}

#[test]
fn a_horn_that_is_shut_up_in_the_sleeve_is_found() {
    let design = sleeve(60, 90);
    let skeleton = skeleton();
    let found = |design: &TriangleMesh, result: &TriangleMesh, body: &TriangleMesh, collision_only: &[u32]| {
        let (source, target, worn) = (&skeleton, &skeleton, &TriangleMesh::default());
        let outcome = Outcome { design, result, source, target, body, worn, collision_only, intersecting: &[] };
        compare(&outcome, &Cancel::new()).expect("nobody cancels")
    };
    let first = arm().triangles.len() as u32;
    for (length, radius, is_gross) in [(0.75, 0.03, true), (0.75, 0.0015, false)] {
        let body = with_horn(length, radius);
        let findings = found(&design, &tented(&design, length + 0.03), &body, &[]);
        assert!(
            matches!(findings.misplaced[..], [Misplacement::Swallowed { bone: 1 | 2, triangle, times, is_gross: gross }]
                if triangle >= first && times > 3.7 && gross == is_gross),
            "{length}: {findings:?}"
        );
        assert_eq!(findings.is_gross(), is_gross);
        // There is room for it in the design, or it was said that the garment is not meant to fit it.
        let tent = tented(&design, 0.9 * length);
        assert_eq!(found(&tent, &tented(&design, length + 0.03), &body, &[]), Findings::default());
        let horn: Vec<u32> = (first..body.triangles.len() as u32).collect();
        assert_eq!(found(&design, &tented(&design, length + 0.03), &body, &horn), Findings::default());
        // It goes through a hole in the sleeve.
        let mut open = design.clone();
        open.triangles.retain(|t| {
            let middle = t.iter().map(|&v| open.positions[v as usize]).sum::<DVec3>() / 3.0;
            middle.y < 0.0 || DVec3::new(middle.x - 0.5, 0.0, middle.z).length() > 0.05
        });
        assert_eq!(found(&open, &open, &body, &[]), Findings::default());
    }
    // A body three times as thick widens the sleeve as a whole.
    let thick = |mesh: &TriangleMesh| moved(mesh, |p| DVec3::new(p.x, 3.0 * p.y, 3.0 * p.z));
    assert_eq!(found(&design, &thick(&design), &thick(&arm()), &[]), Findings::default());
}

/// The arm with a loose sheet along it, from the place `from` to `to` along it, `above` its axis.
fn with_sheet([from, to]: [f64; 2], above: f64) -> TriangleMesh {
    let mut body = arm();
    let first = body.positions.len() as u32;
    for k in 0..=20 {
        let x = from + (to - from) * f64::from(k) / 20.0;
        body.positions.extend([DVec3::new(x, -0.04, above), DVec3::new(x, 0.04, above)]);
    }
    for k in 0..20 {
        let a = first + 2 * k;
        body.triangles.extend([[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]);
    }
    body
}

#[test]
fn a_sheet_that_ends_under_the_sleeve_is_found() {
    let skeleton = skeleton();
    let found = |cloth: &TriangleMesh, body: &TriangleMesh, collision_only: &[u32]| {
        let (source, target, worn) = (&skeleton, &skeleton, &TriangleMesh::default());
        let outcome =
            Outcome { design: cloth, result: cloth, source, target, body, worn, collision_only, intersecting: &[] };
        compare(&outcome, &Cancel::new()).expect("nobody cancels")
    };
    let first = arm().triangles.len() as u32;
    let sleeve = tube(&rings(-0.9, 0.6, 40, 0.16), 40, false);
    let body = with_sheet([1.2, 0.0], 0.13);
    let findings = found(&sleeve, &body, &[]);
    let [Misplacement::Under { bone: 0 | 1, triangle, share }] = findings.misplaced[..] else { panic!("{findings:?}") };
    assert!(triangle >= first && (0.2..0.6).contains(&share) && !findings.is_gross(), "{findings:?}");
    // Both sides of it are modelled.
    let mut both = body.clone();
    both.triangles.extend(body.triangles[first as usize..].iter().map(|&[a, b, c]| [a, c, b]));
    assert_eq!(found(&sleeve, &both, &[]).misplaced.len(), 1);
    // It hangs over the sleeve, does not come to it, or is not meant to be fitted.
    let sheet: Vec<u32> = (first..body.triangles.len() as u32).collect();
    for (body, collision_only) in
        [(with_sheet([1.2, 0.0], 0.2), &[][..]), (with_sheet([1.2, 0.7], 0.13), &[]), (body.clone(), &sheet)]
    {
        assert_eq!(found(&sleeve, &body, collision_only), Findings::default());
    }
    // What a mitten or a hat covers comes out of it, and what is under the sleeve altogether is no hair.
    let mitten = tube(&[rings(0.55, 1.3, 20, 0.16), vec![[1.36, 0.01]]].concat(), 40, false);
    assert_eq!(found(&mitten, &with_sheet([1.25, -0.3], 0.13), &[]), Findings::default());
    assert_eq!(found(&sleeve, &with_sheet([0.4, -0.4], 0.13), &[]), Findings::default());
    // A cuff that the body has on, half under the sleeve.
    let mut cuffed = arm();
    let cuff = tube(&rings(0.3, 0.9, 12, 0.13), 24, false);
    cuffed.triangles.extend(cuff.triangles.iter().map(|t| t.map(|v| v + cuffed.positions.len() as u32)));
    cuffed.positions.extend(cuff.positions);
    assert_eq!(found(&sleeve, &cuffed, &[]), Findings::default());
}

/// Noise passes through what is beside it; two layers that pass through each other do not.
#[test]
fn a_crumpled_result_is_found_and_layers_are_not() {
    let skeleton = skeleton();
    let found = |cloth: &TriangleMesh| {
        let intersecting = &intersections(cloth, None, usize::MAX).unwrap().pairs[..];
        let (source, target, body, worn) = (&skeleton, &skeleton, &arm(), &TriangleMesh::default());
        let outcome =
            Outcome { design: cloth, result: cloth, source, target, body, worn, collision_only: &[], intersecting };
        (intersecting.len(), compare(&outcome, &Cancel::new()).expect("nobody cancels"))
    };
    let design = sleeve(48, 40);
    for (amount, told) in [(0.0, None), (0.011, None), (0.014, Some(false)), (0.02, Some(true))] {
        let mut random = Random::new(9);
        let mut noisy = design.clone();
        noisy.positions.iter_mut().for_each(|p| *p += amount * random.vector());
        let (pairs, findings) = found(&noisy);
        println!("{amount}: {pairs} pairs, {:?}", findings.crumpled);
        assert_eq!(findings.crumpled.as_ref().map(|crumpled| crumpled.1), told);
        assert_eq!(findings.is_gross(), told == Some(true));
    }
    // A lining that comes out of the sleeve everywhere.
    let mut lined = design.clone();
    let lining = moved(&sleeve(47, 39), |p| {
        let times = 1.0 + 0.05 * (40.0 * p.x).sin();
        DVec3::new(p.x, times * p.y, times * p.z)
    });
    lined.triangles.extend(lining.triangles.iter().map(|t| t.map(|v| v + design.positions.len() as u32)));
    lined.positions.extend(lining.positions);
    let (pairs, findings) = found(&lined);
    assert!(pairs > 1000 && findings == Findings::default(), "{pairs}: {findings:?}");
}

#[test]
fn cloth_that_is_drawn_out_here_and_shrunk_there_is_found() {
    let design = sleeve(20, 40);
    let scale = |least: f64, most: f64| {
        moved(&design, |p| {
            let times = least + (most - least) * ((p.x - 0.05) / 0.9).powi(2);
            DVec3::new(0.05 + (p.x - 0.05) * times, p.y * times, p.z * times)
        })
    };
    let found = findings(&design, &scale(0.1, 8.0)).distorted.expect("it is distorted");
    assert!(found.scales[1] > 15.0 * found.scales[0] && found.triangles[0] < found.triangles[1], "{found:?}");
    assert_eq!(findings(&design, &scale(0.8, 3.0)).distorted, None);
    assert_eq!(findings(&design, &scale(9.0, 9.0)).distorted, None);
}

/// Two bands around the elbow, of which one half stands off. Neither is large in the design, and one is in the result.
#[test]
fn a_small_piece_that_became_large_is_judged_as_such() {
    let lifted = |half: f64, times: f64| {
        let design = tube(&rings(0.5 - half, 0.5 + half, 6, 0.16), 48, false);
        let out = |p: DVec3| if p.y > 0.0 { DVec3::new(p.x, times * p.y, times * p.z) } else { p };
        let result = moved(&design, out);
        let [before, now] = [&design, &result].map(|mesh| mesh.areas().iter().sum::<f64>());
        println!("{half} {times}: area {before} then, {now} now");
        assert!(before < 0.2, "{before}");
        findings(&design, &result).lifted
    };
    assert!(lifted(0.05, 6.0).is_some());
    assert_eq!(lifted(0.05, 2.0), None);
    assert_eq!(lifted(0.008, 6.0), None, "a necklace lies where it finds room");
}

/// A sleeve whose cuff is drawn out over something, at the end of the limb and before it.
#[test]
fn a_cuff_may_lie_over_what_ends_the_limb() {
    let lifted = |from: f64, to: f64, ends: [f64; 2]| {
        let design = tube(&rings(ends[0], ends[1], 40, 0.16), 48, false);
        let out = |p: DVec3| {
            let is_over = p.y > 0.0 && (from..=to).contains(&p.x);
            if is_over { DVec3::new(p.x, 6.0 * p.y, 6.0 * p.z) } else { p }
        };
        findings(&design, &moved(&design, out)).lifted
    };
    let whole = [0.4, 1.2];
    assert_eq!(lifted(0.92, 1.2, whole), None);
    assert!(lifted(0.45, 0.8, whole).is_some());
    // Most of a mitten is there.
    assert!(lifted(0.92, 1.2, [0.85, 1.2]).is_some());
}

/// A sleeve that is drawn out over a bracelet that the arm wears, as trousers are over shoes; and one beside that.
#[test]
fn cloth_may_stand_off_over_what_is_worn() {
    let design = tube(&rings(0.4, 1.2, 40, 0.16), 48, false);
    let drawn_out = |mesh: &TriangleMesh, times: f64| {
        let is_over = |p: DVec3| p.y > 0.0 && (0.45..=0.8).contains(&p.x);
        moved(mesh, |p| if is_over(p) { DVec3::new(p.x, times * p.y, times * p.z) } else { p })
    };
    let result = drawn_out(&design, 6.0);
    let over = |from: f64, to: f64, times: f64| {
        let bracelet = tube(&rings(from, to, 20, 0.15), 48, false);
        findings_over(&drawn_out(&bracelet, times), &design, &result).lifted
    };
    assert_eq!(over(0.42, 0.82, 6.0), None);
    assert!(over(0.42, 0.82, 1.0).is_some(), "the bracelet lies on the arm, and something else is between");
    assert!(over(1.0, 1.2, 1.0).is_some(), "the bracelet is elsewhere");
}

#[test]
fn cloth_that_stands_off_over_a_fin_is_found() {
    let design = sleeve(48, 40);
    let findings = |height: f64, share: f64| {
        // Of the round of the sleeve a share is drawn out: all along, as over a fin.
        let out = |p: DVec3| {
            let angle = p.z.atan2(p.y).abs() / std::f64::consts::PI;
            let times = if angle < share { height } else { 1.0 };
            DVec3::new(p.x, times * p.y, times * p.z)
        };
        findings(&design, &moved(&design, out)).lifted
    };
    assert_eq!(findings(1.0, 1.0), None);
    assert_eq!(findings(4.0, 1.0), None, "a thicker arm");
    assert_eq!(findings(2.5, 0.4), None, "a hump");
    let lifted = findings(3.6, 0.4).expect("a fin");
    assert!((3.0..4.0).contains(&lifted.times), "{lifted:?}");
    assert!(design.centre(lifted.triangle).y > 0.0);
    assert_eq!(findings(3.6, 0.05), None, "too little to be seen");
}
