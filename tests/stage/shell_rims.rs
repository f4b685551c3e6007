//! Where the openings of garments with two sides are found.

use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::shell_rims::ShellRims;
use glam::DVec3;

const SIDES: u32 = 24;

/// Upper arm and forearm along z.
fn arm() -> Skeleton {
    Skeleton { joints: [-1.0, 0.0, 1.0].map(|z| DVec3::Z * z).to_vec(), bones: vec![[0, 1], [1, 2]] }
}

/// A surface around z through rings, given by radius and height; the last is joined to the first where it is `closed`. Its front is
/// on the right of the way from ring to ring, in a plane whose axes are radius and height.
fn turned(rings: &[[f64; 2]], closed: bool) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for &[radius, z] in rings {
        mesh.positions.extend((0..SIDES).map(|s| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(s) / f64::from(SIDES)).sin_cos();
            DVec3::new(radius * cos, radius * sin, z)
        }));
    }
    let count = rings.len() as u32;
    let at = |r: u32, s: u32| (r % count) * SIDES + s % SIDES;
    for (r, s) in (0..count - u32::from(!closed)).flat_map(|r| (0..SIDES).map(move |s| (r, s))) {
        mesh.triangles.extend([[at(r, s), at(r, s + 1), at(r + 1, s)], [at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]]);
    }
    mesh
}

/// Rings in a row from one to another.
fn row(from: [f64; 2], to: [f64; 2], count: u32) -> Vec<[f64; 2]> {
    let share = |k: u32| f64::from(k) / f64::from(count);
    (0..=count).map(|k| [0, 1].map(|i| from[i] + share(k) * (to[i] - from[i]))).collect()
}

/// A sleeve from z = -0.5 to 0.7, so thick, whose sides are joined by strips.
fn sleeve(thickness: f64) -> TriangleMesh {
    let outer = row([0.2, -0.5], [0.2, 0.7], 20);
    let inner = row([0.2 - thickness, 0.7], [0.2 - thickness, -0.5], 20);
    turned(&[outer, inner].concat(), true)
}

fn find(mesh: &TriangleMesh) -> ShellRims {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    ShellRims::find(mesh, &topology, &vec![false; mesh.positions.len()], &arm())
}

/// The heights of the rims, all vertices of each at one.
fn heights(rims: &ShellRims, mesh: &TriangleMesh) -> Vec<f64> {
    let mut heights: Vec<f64> = rims
        .loops
        .iter()
        .map(|rim| {
            let z = mesh.positions[rim.vertices[0] as usize].z;
            assert!(rim.vertices.iter().all(|&v| (mesh.positions[v as usize].z - z).abs() < 1e-12));
            assert_eq!(rim.vertices.len(), SIDES as usize);
            z
        })
        .collect();
    heights.sort_by(f64::total_cmp);
    heights
}

#[test]
fn a_sleeve_ends_where_its_sides_meet() {
    for thickness in [1e-4, 1e-3, 0.01, 0.05] {
        let mut mesh = sleeve(thickness);
        let rims = find(&mesh);
        assert!(rims.without.is_empty());
        assert_eq!(heights(&rims, &mesh), [-0.5, 0.7], "{thickness}");
        // They are on the outer side, in the direction of its triangles.
        assert!(rims.loops.iter().flat_map(|rim| &rim.vertices).all(|&v| v < 21 * SIDES));
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        assert_eq!(heights(&find(&mesh), &mesh), [-0.5, 0.7], "{thickness}, inside out");
    }
}

#[test]
fn a_bracelet_is_a_shell_as_well() {
    let circle = |k: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 12.0).sin_cos();
        [0.15 + 0.02 * cos, 0.5 + 0.02 * sin]
    };
    let mesh = turned(&(0..12).map(circle).collect::<Vec<_>>(), true);
    let found = find(&mesh);
    let heights = heights(&found, &mesh);
    assert!(heights.len() == 2 && heights.iter().all(|z| (z - 0.5).abs() < 0.021), "{heights:?}");
}

#[test]
fn one_side_has_no_rims() {
    for radius in [0.01, 0.025, 0.2] {
        let mesh = turned(&row([radius, -0.5], [radius, 0.7], 20), false);
        assert_eq!(find(&mesh), ShellRims::default(), "{radius}");
    }
    // In pleats, of which each has two flanks a hair apart.
    let pleats: Vec<[f64; 2]> = (0..80).map(|k| [0.2 + 0.05 * f64::from(k % 2), 0.005 * f64::from(k)]).collect();
    assert_eq!(find(&turned(&pleats, false)), ShellRims::default());
}

#[test]
fn a_hem_that_is_turned_in_is_left_to_its_boundary() {
    // The upper end is closed by a fold, and turned in below the boundary at the lower one.
    let outer = row([0.2, -0.5], [0.2, 0.7], 20);
    let inner = row([0.19, 0.7], [0.19, -0.45], 20);
    let mesh = turned(&[outer.clone(), inner].concat(), false);
    assert_eq!(heights(&find(&mesh), &mesh), [0.7]);
    // Where only the hem is, the piece is no shell.
    let mesh = turned(&[outer, row([0.19, 0.7], [0.19, 0.65], 2)].concat(), false);
    assert_eq!(find(&mesh), ShellRims::default());
}

#[test]
fn what_is_thicker_than_cloth_is_reported() {
    let mesh = sleeve(0.12);
    let rims = find(&mesh);
    assert!(rims.loops.is_empty());
    let [piece] = rims.without[..] else { panic!("{:?}", rims.without) };
    assert_eq!((piece.triangle, piece.triangles, piece.bone), (0, mesh.triangles.len(), 0));
    let found = rims.diagnostics(&arm(), |t| t + 100);
    assert!(found[0].to_string().contains("with triangle 100 is closed"), "{}", found[0]);
}

#[test]
fn pieces_that_are_held_have_none() {
    let mesh = sleeve(0.01);
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let held = vec![true; mesh.positions.len()];
    assert_eq!(ShellRims::find(&mesh, &topology, &held, &arm()), ShellRims::default());
    // Beside another piece, each for itself.
    let mut both = mesh.clone();
    let count = both.positions.len() as u32;
    both.positions.extend(mesh.positions.iter().map(|&p| p * DVec3::new(1.5, 1.5, 1.0)));
    both.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + count)));
    assert_eq!(heights(&find(&both), &both), [-0.5, -0.5, 0.7, 0.7]);
}
