//! Surface shape term.

use bespoke::energy::surface::{Surface, SurfaceForm};
use bespoke::energy::{Configuration, Energy};
use bespoke::geometry::mesh::{Hinge, Topology};
use bespoke::geometry::sliver_caps::without_caps;
use glam::{DMat3, DVec2, DVec3};

use crate::harness::{check_gradient, check_hessian, check_semidefinite, dense};
use crate::patch::{Patch, rotation, shaken, sheet, similar, triangles, tube};
use testing::Random;

const FORMS: [SurfaceForm; 2] = [SurfaceForm::Similarity, SurfaceForm::Printed];

fn value(energy: &Surface, x: &[DVec3]) -> f64 {
    energy.value(Configuration { x, t: 0.0 }, 0..energy.len())
}

fn hinge() -> Hinge {
    Hinge { vertices: [0, 1, 2, 3], triangles: [0, 1] }
}

fn patches(random: &mut Random) -> [Patch; 2] {
    [sheet(4, 3, random), tube(5, 3, random)]
}

/// Eq. 2 as it is written: tau as a 3x3 matrix, by a matrix inverse.
fn by_matrices(rest: &[DVec3], x: &[DVec3], hinges: &[Hinge], form: SurfaceForm) -> f64 {
    let frame = |p: &[DVec3], [i, j, k]: [u32; 3]| {
        let (e1, e2) = (p[j as usize] - p[i as usize], p[k as usize] - p[i as usize]);
        let n = e1.cross(e2);
        let n = if form == SurfaceForm::Similarity { n / n.length().sqrt() } else { n };
        DMat3::from_cols(e1, e2, n)
    };
    let area = |[i, j, k]: [u32; 3]| {
        let p = [i, j, k].map(|v| rest[v as usize]);
        0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length()
    };
    let cost = |h: &Hinge| {
        let [v1, v2, v3, v4] = h.vertices;
        let (t1, t2) = ([v1, v2, v3], [v2, v1, v4]);
        let across = (rest[v4 as usize] - rest[v3 as usize]).normalize();
        let [tau1, tau2] = [t1, t2].map(|t| frame(x, t) * frame(rest, t).inverse());
        (area(t1) + area(t2)) * (tau1 * across - tau2 * across).length_squared()
    };
    hinges.iter().map(cost).sum()
}

#[test]
fn agrees_with_matrices() {
    let mut random = Random::new(1);
    for form in FORMS {
        for patch in patches(&mut random) {
            let energy = Surface::new(&patch.rest, &patch.hinges, form);
            assert_eq!(energy.len(), patch.hinges.len());
            for _ in 0..20 {
                let x = shaken(&patch.rest, 1.0, &mut random);
                let expected = by_matrices(&patch.rest, &x, &patch.hinges, form);
                assert!((value(&energy, &x) - expected).abs() <= 1e-10 * expected);
            }
        }
    }
}

#[test]
fn gradient_is_exact() {
    let mut random = Random::new(2);
    for form in FORMS {
        for patch in patches(&mut random) {
            for scale in [1e-2, 1.0, 1e2] {
                let rest: Vec<DVec3> = patch.rest.iter().map(|&p| p * scale).collect();
                let energy = Surface::new(&rest, &patch.hinges, form);
                let x = shaken(&rest, 0.3 * scale, &mut random);
                check_gradient(&energy, &x, 0.0, 1e-4 * scale, 1e-7);
            }
        }
    }
}

/// The same bent sheet in squares of 1/n: deformed smoothly, it costs as much at every resolution, and as printed ever less.
#[test]
fn the_cost_does_not_depend_on_the_resolution() {
    let costs = |n: u32| {
        let columns = n + 1;
        let at = |k: u32| DVec2::new(f64::from(k % columns), f64::from(k / columns)) / f64::from(n);
        let flat: Vec<DVec2> = (0..columns * columns).map(at).collect();
        let rest: Vec<DVec3> = flat.iter().map(|p| DVec3::new(p.x, p.y, 0.2 * (2.0 * p.x).sin())).collect();
        let x: Vec<DVec3> = rest
            .iter()
            .zip(&flat)
            .map(|(r, p)| *r + 0.1 * DVec3::new((3.0 * p.y).sin(), p.x * p.y, (2.0 * p.x + 3.0 * p.y).cos()))
            .collect();
        let hinges = Topology::new(rest.len(), &triangles(columns, columns, false)).hinges;
        let form = SurfaceForm::Similarity;
        let printed = Surface::new(&rest, &hinges, form);
        [value(&Surface::at_any_resolution(&rest, &hinges, form, 0.3), &x), value(&printed, &x)]
    };
    let [reference, coarse] = costs(10);
    for n in [20, 40, 80] {
        let [cost, printed] = costs(n);
        assert!((cost / reference - 1.0).abs() < 0.1, "{n}: {cost} instead of {reference}");
        let falls = coarse / printed * (10.0 / f64::from(n)).powi(2);
        assert!((falls - 1.0).abs() < 0.2, "{n}: {printed} beside {coarse}");
    }
}

/// The weight of one hinge against the formula, laid flat by its angles; folded over, and of a needle, it stays what it is.
#[test]
fn a_hinge_weighs_its_area_where_it_has_the_length() {
    let ratio = |rest: [DVec3; 4], length: f64| {
        let x = shaken(&rest, 0.3, &mut Random::new(21));
        let form = SurfaceForm::Similarity;
        let [any, printed] =
            [Surface::at_any_resolution(&rest, &[hinge()], form, length), Surface::new(&rest, &[hinge()], form)];
        value(&any, &x) / value(&printed, &x)
    };
    let mut random = Random::new(22);
    for _ in 0..50 {
        let fold = 3.0 * random.signed();
        let (along, heights) = ([random.unit(), random.unit()], [0.3 + random.unit(), 0.3 + random.unit()]);
        let rest = [
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(along[0], heights[0], 0.0),
            DVec3::new(along[1], -heights[1] * fold.cos(), heights[1] * fold.sin()),
        ];
        let across = (heights[0] + heights[1]).powi(2) + (along[1] - along[0]).powi(2);
        assert!((ratio(rest, across.sqrt()) - 1.0).abs() < 1e-9);
        assert!((ratio(rest, 1.2 * across.sqrt()) / 1.44 - 1.0).abs() < 1e-9);
        // Of very few triangles, the garment is not soft.
        assert!((ratio(rest, 1e-3) - 1.0).abs() < 1e-9);
    }
    let needle = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1e-3, 0.0), DVec3::new(0.5, -1e-3, 0.0)];
    assert!((ratio(needle, 0.1) - 2.0 * 0.01 / 1e-3).abs() < 1e-6);
}

#[test]
fn soft_hinges_weigh_less_and_the_others_what_they_did() {
    let mut random = Random::new(9);
    for patch in patches(&mut random) {
        let form = SurfaceForm::Similarity;
        let x = shaken(&patch.rest, 1.0, &mut random);
        let is_soft = |v: u32| v.is_multiple_of(5);
        let at_soft = |hinge: &&Hinge| hinge.vertices.into_iter().any(is_soft);
        let soft: Vec<Hinge> = patch.hinges.iter().filter(at_soft).copied().collect();
        assert!(!soft.is_empty() && soft.len() < patch.hinges.len());
        let whole = Surface::new(&patch.rest, &patch.hinges, form);
        let mut energy = whole.clone();
        energy.soften(is_soft, 0.25);
        let expected = value(&whole, &x) - 0.75 * value(&Surface::new(&patch.rest, &soft, form), &x);
        assert!((value(&energy, &x) - expected).abs() <= 1e-12 * expected);
    }
}

#[test]
fn gradient_is_exact_at_any_resolution() {
    let mut random = Random::new(23);
    for form in FORMS {
        for patch in patches(&mut random) {
            let energy = Surface::at_any_resolution(&patch.rest, &patch.hinges, form, 0.05);
            let x = shaken(&patch.rest, 0.3, &mut random);
            check_gradient(&energy, &x, 0.0, 1e-4, 1e-7);
            check_semidefinite(&energy, &x, 0.0, &mut || random.signed());
        }
    }
}

#[test]
fn gradient_is_exact_on_nasty_hinges() {
    let mut random = Random::new(7);
    let (o, x, y) = (DVec3::ZERO, DVec3::X, DVec3::Y);
    let rest = [o, x, y, DVec3::new(0.4, -0.8, 0.3)];
    let thin = [o, x, DVec3::new(0.5, 1e-2, 0.0), DVec3::new(0.2, -1.0, 0.1)];
    let folded = [o, x, y, DVec3::new(0.3, 0.9, 0.02)];
    let inside_out = [o, x, -y, DVec3::new(0.4, 0.8, 0.3)];
    for form in FORMS {
        for (from, to) in
            [(rest, thin), (rest, folded), (rest, inside_out), (thin, rest), (folded, rest), (thin, folded)]
        {
            for scale in [1e-2, 1.0, 1e2] {
                let energy = Surface::new(&from, &[hinge()], form);
                check_gradient(&energy, &to.map(|p| p * scale), 0.0, 1e-5 * scale, 1e-6);
                check_semidefinite(&energy, &to, 0.0, &mut || random.signed());
            }
        }
    }
}

#[test]
fn hessian_is_exact_without_residual_and_semidefinite_with() {
    let mut random = Random::new(3);
    for form in FORMS {
        for patch in patches(&mut random) {
            let energy = Surface::new(&patch.rest, &patch.hinges, form);
            check_hessian(&energy, &patch.rest, 0.0, 1e-4, 1e-7);
            let scales: &[f64] = if form == SurfaceForm::Similarity { &[0.5, 1.0, 3.0] } else { &[1.0] };
            for &scale in scales {
                let x = similar(&patch.rest, scale, &mut random);
                check_hessian(&energy, &x, 0.0, 1e-4, 1e-7);
            }
            let x = shaken(&patch.rest, 1.0, &mut random);
            check_semidefinite(&energy, &x, 0.0, &mut || random.signed());
        }
    }
}

#[test]
fn similarities_cost_nothing() {
    let mut random = Random::new(4);
    for patch in patches(&mut random) {
        let similarity = Surface::new(&patch.rest, &patch.hinges, SurfaceForm::Similarity);
        let printed = Surface::new(&patch.rest, &patch.hinges, SurfaceForm::Printed);
        for _ in 0..20 {
            let scale = 0.2 + 2.0 * random.unit();
            assert!(value(&similarity, &similar(&patch.rest, scale, &mut random)) < 1e-20);
            assert!(value(&printed, &similar(&patch.rest, 1.0, &mut random)) < 1e-20);
        }
        let scaled = similar(&patch.rest, 1.3, &mut random);
        assert!(value(&similarity, &scaled) < 1e-20);
        assert!(value(&printed, &scaled) > 1e-3);
    }
}

#[test]
fn an_affine_map_costs_nothing_on_a_flat_sheet() {
    let mut random = Random::new(5);
    let mut patch = sheet(4, 4, &mut random);
    patch.rest.iter_mut().for_each(|p| p.z = 0.0);
    let turn = rotation(&mut random);
    let stretched: Vec<DVec3> =
        patch.rest.iter().map(|p| turn * DVec3::new(1.7 * p.x + 0.4 * p.y, 0.6 * p.y, 0.0)).collect();
    for form in FORMS {
        let energy = Surface::new(&patch.rest, &patch.hinges, form);
        assert!(value(&energy, &stretched) < 1e-20);
        // Bending it does cost.
        let bent: Vec<DVec3> = patch.rest.iter().map(|p| *p + DVec3::Z * 0.2 * p.x * p.x).collect();
        assert!(value(&energy, &bent) > 1e-3);
    }
}

#[test]
fn an_imperfect_fit_grows_with_the_square_of_scale() {
    let mut random = Random::new(6);
    let patch = tube(6, 4, &mut random);
    let energy = Surface::new(&patch.rest, &patch.hinges, SurfaceForm::Similarity);
    let x = shaken(&patch.rest, 0.1, &mut random);
    let larger: Vec<DVec3> = x.iter().map(|&p| 1.5 * p).collect();
    let ratio = value(&energy, &larger) / value(&energy, &x);
    assert!((ratio - 2.25).abs() < 1e-12);
}

#[test]
fn degenerate_rest_shapes_get_no_element() {
    let good = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.4, -0.8, 0.3)];
    let flat_first = [DVec3::ZERO, DVec3::X, 0.5 * DVec3::X, good[3]];
    let flat_second = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.5, -1e-11, 0.0)];
    let closed = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Y];
    let point = [DVec3::ONE; 4];
    for form in FORMS {
        for (rest, left_out) in [(good, 0), (flat_first, 1), (flat_second, 1), (closed, 1), (point, 1)] {
            let energy = Surface::new(&rest, &[hinge()], form);
            assert_eq!(energy.len(), 1 - left_out);
        }
    }
}

#[test]
fn a_collapsed_triangle_gives_finite_derivatives() {
    let rest = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.4, -0.8, 0.3)];
    for form in FORMS {
        let energy = Surface::new(&rest, &[hinge()], form);
        for offset in [0.0, 1e-300, 1e-31, 1e-29] {
            let x = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, offset, 0.0), DVec3::new(0.2, -offset, 0.0)];
            let d = dense(&energy, &x, 0.0);
            assert!(value(&energy, &x).is_finite());
            assert!(d.gradient.iter().chain(d.hessian.iter().flatten()).all(|v| v.is_finite()));
        }
    }
}

#[test]
fn ranges_add_up_and_stencils_cover_the_hessian() {
    let mut random = Random::new(8);
    let patch = sheet(4, 3, &mut random);
    let energy = Surface::new(&patch.rest, &patch.hinges, SurfaceForm::default());
    let x = shaken(&patch.rest, 0.5, &mut random);
    let at = Configuration { x: &x, t: 0.0 };
    let parts = energy.value(at, 0..5) + energy.value(at, 5..energy.len());
    assert!((parts - value(&energy, &x)).abs() < 1e-12);
    let mut stencils = Vec::new();
    energy.stencils(&mut |v| stencils.push(v.to_vec()));
    assert_eq!(stencils, patch.hinges.iter().map(|h| h.vertices.to_vec()).collect::<Vec<_>>());
}

/// A strip of long cells below the line y = 0, of short cells above it: every other vertex of the line lies inside an
/// edge of the lower strip. With `caps` these distances hold a triangle, without, the lower strip is split there.
fn t_junctions(caps: bool) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    const CELLS: u32 = 3;
    let columns = 2 * CELLS + 1;
    // Rows at y = 0, 1, 2 of short cells, then one at y = -1 of long ones.
    let bump = |x: f64, y: f64| if y == 0.0 { 0.0 } else { 0.2 * (1.3 * x + y).sin() };
    let point = |x: f64, y: f64| DVec3::new(x, y, bump(x, y));
    let mut rest: Vec<DVec3> =
        (0..3 * columns).map(|k| point(f64::from(k % columns), f64::from(k / columns))).collect();
    rest.extend((0..=CELLS).map(|k| point(2.0 * f64::from(k), -1.0)));
    let mut all = triangles(columns, 3, false);
    for k in 0..CELLS {
        let (left, middle, right) = (2 * k, 2 * k + 1, 2 * k + 2);
        let (below, beside) = (3 * columns + k, 3 * columns + k + 1);
        all.push([below, beside, left]);
        if caps {
            all.extend([[beside, right, left], [left, right, middle]]);
        } else {
            all.extend([[beside, right, middle], [beside, middle, left]]);
        }
    }
    (rest, all)
}

/// Holds the lowest row, pulls one vertex of the highest, and lets the rest find its place: Gauss-Newton with dense
/// matrices. Returns the energy that this has cost, and how far the vertices inside an edge have left it, as a fraction of
/// its length, at most.
fn pulled(rest: &[DVec3], energy: &Surface) -> (f64, f64) {
    let mut x: Vec<DVec3> = rest.to_vec();
    let tip = rest.iter().position(|p| p.x == 3.0 && p.y == 2.0).unwrap();
    x[tip] += DVec3::new(0.06, 0.3, 0.3);
    let held: Vec<bool> = (0..rest.len()).map(|v| rest[v].y < -0.5 || v == tip).collect();
    let free: Vec<usize> = (0..3 * x.len()).filter(|&i| !held[i / 3]).collect();
    for _ in 0..40 {
        let d = dense(energy, &x, 0.0);
        let mut rows: Vec<Vec<f64>> = free
            .iter()
            .map(|&i| {
                let row = free.iter().map(|&j| d.hessian[i][j] + if i == j { 1e-6 } else { 0.0 });
                row.chain([-d.gradient[i]]).collect()
            })
            .collect();
        for k in 0..free.len() {
            let pivot = rows[k].clone();
            for row in rows.iter_mut().skip(k + 1) {
                let factor = row[k] / pivot[k];
                row.iter_mut().zip(&pivot).skip(k).for_each(|(a, b)| *a -= factor * b);
            }
        }
        let mut step = vec![0.0; free.len()];
        for k in (0..free.len()).rev() {
            let known: f64 = (k + 1..free.len()).map(|j| rows[k][j] * step[j]).sum();
            step[k] = (rows[k][free.len()] - known) / rows[k][k];
        }
        for (&i, s) in free.iter().zip(&step) {
            x[i / 3][i % 3] += s;
        }
    }
    let slope = dense(energy, &x, 0.0).gradient;
    assert!(free.iter().all(|&i| slope[i].abs() < 1e-9), "it has not come to rest");
    let inside = (1..6).step_by(2);
    let off = |k: usize| x[k].distance(0.5 * (x[k - 1] + x[k + 1])) / x[k - 1].distance(x[k + 1]);
    (value(energy, &x), inside.map(off).fold(0.0, f64::max))
}

#[test]
fn t_junctions_hold_together() {
    let (rest, caps) = t_junctions(true);
    let (_, conforming) = t_junctions(false);
    let surface = |triangles: &[[u32; 3]]| {
        let hinges = Topology::new(rest.len(), triangles).hinges;
        let surface = Surface::new(&rest, &hinges, SurfaceForm::default());
        let left_out = hinges.len() - surface.len();
        (surface, left_out)
    };
    let (whole, _) = surface(&conforming);
    let (mended, left_out) = surface(&without_caps(&rest, &caps).unwrap());
    assert_eq!((mended.len(), left_out), (whole.len(), 0));
    let (torn, left_out) = surface(&caps);
    assert_eq!(left_out, 9);

    let [mended, whole, torn] = [mended, whole, torn].map(|energy| pulled(&rest, &energy));
    assert!((mended.0 / whole.0 - 1.0).abs() < 1e-9 && (mended.1 - whole.1).abs() < 1e-9, "{mended:?} {whole:?}");
    assert!(mended.1 < 0.01, "{mended:?}");
    // The upper strip would fold away as along a cut.
    assert!(torn.0 < 0.05 * whole.0, "{torn:?} {whole:?}");
}

#[test]
fn an_edge_of_three_triangles_bends_in_every_pair() {
    let wing = |angle: f64| DVec3::new(0.5, angle.cos(), angle.sin());
    let rest = [DVec3::ZERO, DVec3::X, wing(0.3), wing(2.0), wing(4.4)];
    let hinges = Topology::new(5, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).hinges;
    let energy = Surface::new(&rest, &hinges, SurfaceForm::default());
    assert_eq!((energy.len(), hinges.len()), (3, 3));
    let mut seen = Vec::new();
    energy.stencils(&mut |v| seen.push([v[2], v[3]]));
    assert_eq!(seen, [[2, 3], [2, 4], [3, 4]]);
    for wing in 2..5 {
        let mut x = rest;
        x[wing] += 0.2 * DVec3::X;
        assert!(value(&energy, &x) > 1e-3);
    }
}
