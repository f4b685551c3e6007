//! Split vertices and faulty triangles of a garment.

use std::collections::{BTreeMap, BTreeSet};

use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, Element, Severity, Subject};
use bespoke::input::weld::Weld;
use glam::DVec3;

use testing::Random;
use testing::obj::{assets, read_mesh};

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh { positions: positions.iter().map(|&p| DVec3::from_array(p)).collect(), triangles: triangles.to_vec() }
}

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

fn of(diagnostics: &[Diagnostic], kind: DiagnosticKind) -> Vec<&Diagnostic> {
    diagnostics.iter().filter(|f| f.kind() == kind).collect()
}

fn triangles(indices: &[u32]) -> Vec<Element> {
    indices.iter().map(|&t| Element::triangle(Subject::Garment, t)).collect()
}

fn vertices(indices: &[u32]) -> Vec<Element> {
    indices.iter().map(|&v| Element::vertex(Subject::Garment, v)).collect()
}

/// The mesh with three own vertices a triangle, in an order shuffled by `random`.
fn exploded(mesh: &TriangleMesh, random: &mut Random) -> TriangleMesh {
    let mut corners: Vec<u32> = (0..3 * mesh.triangles.len() as u32).collect();
    for i in (1..corners.len()).rev() {
        corners.swap(i, (random.unit() * (i + 1) as f64) as usize);
    }
    let mut out = TriangleMesh { positions: vec![DVec3::ZERO; corners.len()], triangles: Vec::new() };
    for (k, t) in mesh.triangles.iter().enumerate() {
        out.triangles.push(std::array::from_fn(|i| corners[3 * k + i]));
        for i in 0..3 {
            out.positions[corners[3 * k + i] as usize] = mesh.positions[t[i] as usize];
        }
    }
    out
}

/// The triangles as sets of places, which no numbering changes.
fn places(mesh: &TriangleMesh) -> Vec<[[u64; 3]; 3]> {
    let place = |v: u32| mesh.positions[v as usize].to_array().map(f64::to_bits);
    mesh.triangles.iter().map(|t| t.map(place)).collect()
}

#[test]
fn a_clean_mesh_stays_as_it_is() {
    let garment = mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]);
    let (weld, diagnostics) = Weld::new(&garment);
    assert_eq!(weld.mesh, garment);
    assert_eq!((weld.to_welded, weld.vertex_of, weld.triangle_of), (vec![0, 1, 2, 3], vec![0, 1, 2, 3], vec![0, 1]));
    assert_eq!(diagnostics, []);
}

#[test]
fn a_seam_is_welded_and_answered_in_the_callers_order() {
    // The diagonal is a seam; -0 is 0; neighbours by one unit in the last place stay two.
    let near = 1.0 + f64::EPSILON;
    let positions = [SQUARE[2], SQUARE[0], SQUARE[1], [-0.0, 0.0, -0.0], SQUARE[2], SQUARE[3], [near, 0.0, 0.0]];
    let garment = mesh(&positions, &[[1, 2, 0], [3, 4, 5], [1, 6, 2]]);
    let (weld, diagnostics) = Weld::new(&garment);
    assert_eq!(weld.to_welded, [0, 1, 2, 1, 0, 3, 4]);
    assert_eq!(weld.vertex_of, [0, 1, 2, 5, 6]);
    assert_eq!(weld.mesh.triangles, [[1, 2, 0], [1, 0, 3], [1, 4, 2]]);
    let split = of(&diagnostics, DiagnosticKind::SplitVertices);
    assert_eq!(split.len(), 1);
    assert_eq!((split[0].severity(), &split[0].elements()), (Severity::Note, &vertices(&[0, 1, 3, 4])));
    assert!(
        split[0].to_string().starts_with("garment: 4 of the 7 vertices share their place with another, in 2 places")
    );
    assert!(split[0].to_string().contains("there are 5 vertices to place"), "{}", split[0].to_string());

    let moved: Vec<DVec3> = weld.mesh.positions.iter().map(|&p| p * (1.0 / 3.0) + DVec3::splat(0.1)).collect();
    let answer = weld.scatter(&moved);
    assert_eq!(answer.len(), positions.len());
    for (a, b) in [(0, 4), (1, 3)] {
        assert_eq!(answer[a].to_array().map(f64::to_bits), answer[b].to_array().map(f64::to_bits));
    }
    assert_eq!(answer[5], moved[3]);
}

#[test]
fn values_are_gathered_by_their_mean() {
    let garment = mesh(&[SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[0], SQUARE[0]], &[[0, 1, 2], [3, 1, 2], [4, 2, 1]]);
    let (weld, _) = Weld::new(&garment);
    assert_eq!(weld.gather(&[1.0, 5.0, 7.0, 0.0, 0.5]), [0.5, 5.0, 7.0]);
    // Equal copies keep their bits, and large ones do not overflow.
    for same in [0.1, f64::MAX, 0.0] {
        assert_eq!(weld.gather(&[same, 5.0, 7.0, same, same]), [same, 5.0, 7.0]);
    }
}

#[test]
fn both_sides_count_once() {
    // The back has its own vertices and the other winding; triangle 4 repeats the first as it is.
    let mut positions = SQUARE.to_vec();
    positions.extend(SQUARE);
    let garment = mesh(&positions, &[[0, 1, 2], [0, 2, 3], [6, 5, 4], [7, 6, 4], [1, 2, 0]]);
    let (weld, diagnostics) = Weld::new(&garment);
    assert_eq!(weld.mesh, mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]));
    assert_eq!(weld.triangle_of, [0, 1]);
    let found: Vec<_> = of(&diagnostics, DiagnosticKind::DuplicateTriangle).iter().map(|f| f.elements()).collect();
    assert_eq!(found, [triangles(&[2, 0]), triangles(&[3, 1]), triangles(&[4, 0])]);
    assert_eq!(diagnostics.len(), 4);
}

#[test]
fn collapsed_triangles_stay_only_as_wires() {
    // 4 is a copy of 1: triangle 1 collapses onto an edge of triangle 0. 5-6 is a wire, given twice; 7 is a point.
    let mut positions = SQUARE.to_vec();
    positions.extend([SQUARE[1], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [9.0, 0.0, 0.0]]);
    let garment = mesh(&positions, &[[1, 4, 2], [0, 1, 2], [5, 6, 6], [6, 5, 5], [7, 7, 7], [2, 3, 3]]);
    let (weld, diagnostics) = Weld::new(&garment);
    assert_eq!(weld.triangle_of, [1, 2, 5]);
    assert_eq!(weld.mesh.triangles, [[0, 1, 2], [4, 5, 5], [2, 3, 3]]);
    let found = of(&diagnostics, DiagnosticKind::DegenerateTriangle);
    let elements: Vec<_> = found.iter().map(|f| f.elements()).collect();
    assert_eq!(elements, [0, 2, 3, 4, 5].map(|t| triangles(&[t])));
    let wires: Vec<bool> = found.iter().map(|f| f.to_string().contains("counts as a wire")).collect();
    assert_eq!(wires, [false, true, false, false, true]);
    let unused = of(&diagnostics, DiagnosticKind::UnusedVertex);
    assert_eq!(unused.iter().map(|f| f.elements()).collect::<Vec<_>>(), [vertices(&[7])]);
}

#[test]
fn slivers_unused_vertices_and_crowded_edges_are_named() {
    let positions = [SQUARE[0], SQUARE[1], [0.5, 0.0, 0.0], SQUARE[3], [0.0, -1.0, 1.0], [0.0, -1.0, -1.0], [7.0; 3]];
    let garment = mesh(&positions, &[[1, 0, 2], [0, 1, 3], [0, 1, 4], [1, 0, 5]]);
    let (weld, diagnostics) = Weld::new(&garment);
    assert_eq!(weld.mesh, garment);
    assert_eq!(of(&diagnostics, DiagnosticKind::DegenerateTriangle)[0].elements(), triangles(&[0]));
    assert_eq!(of(&diagnostics, DiagnosticKind::UnusedVertex)[0].elements(), vertices(&[6]));
    let crowded = of(&diagnostics, DiagnosticKind::NonManifoldEdge);
    assert_eq!((crowded[0].elements(), crowded[0].severity()), (vertices(&[0, 1]), Severity::Warning));
    assert!(crowded[0].to_string().contains("vertices 0 and 1 has 4 triangles"), "{}", crowded[0].to_string());
    assert_eq!(diagnostics.len(), 3);
}

#[test]
fn many_findings_of_a_kind_are_counted() {
    let garment = mesh(&SQUARE, &vec![[0, 1, 2]; 1037]);
    let (weld, diagnostics) = Weld::new(&garment);
    assert_eq!(weld.mesh.triangles.len(), 1);
    let copies = of(&diagnostics, DiagnosticKind::DuplicateTriangle);
    assert_eq!(copies.len(), 1001);
    assert_eq!(
        (copies[1000].to_string().as_str(), copies[1000].elements().len()),
        ("36 more garment triangles have the corners of another", 0)
    );
}

/// Against sets: what welding means, on meshes that have every fault many times.
#[test]
fn random_soups_keep_their_meaning() {
    let mut random = Random::new(3);
    for round in 0..200 {
        let (count, extent) = (20 + round % 30, 3.0);
        let positions: Vec<DVec3> =
            (0..count).map(|_| (random.vector() * extent).trunc() * DVec3::new(1.0, 1.0, 0.0)).collect();
        let corner = |random: &mut Random| (random.unit() * f64::from(count)) as u32;
        let soup: Vec<[u32; 3]> = (0..60).map(|_| std::array::from_fn(|_| corner(&mut random))).collect();
        let garment = TriangleMesh { positions, triangles: soup };
        let (weld, _) = Weld::new(&garment);

        for (v, &w) in weld.to_welded.iter().enumerate() {
            assert_eq!(weld.mesh.positions[w as usize], garment.positions[v]);
            assert!(weld.vertex_of[w as usize] as usize <= v);
        }
        for (w, p) in weld.mesh.positions.iter().enumerate() {
            assert!(weld.mesh.positions[..w].iter().all(|q| q != p));
            assert_eq!(weld.to_welded[weld.vertex_of[w] as usize] as usize, w);
        }
        let set = |t: [u32; 3]| BTreeSet::from(t);
        let wanted: Vec<BTreeSet<u32>> =
            garment.triangles.iter().map(|t| set(t.map(|v| weld.to_welded[v as usize]))).collect();
        let kept: Vec<BTreeSet<u32>> = weld.mesh.triangles.iter().map(|&t| set(t)).collect();
        for (k, &t) in weld.triangle_of.iter().enumerate() {
            assert_eq!(kept[k], wanted[t as usize]);
        }
        assert!(weld.triangle_of.is_sorted());
        // Every face is kept exactly once, every edge is held by something, and no wire doubles anything.
        let faces: BTreeSet<_> = wanted.iter().filter(|s| s.len() == 3).collect();
        assert_eq!(kept.iter().filter(|s| s.len() == 3).count(), faces.len());
        let held = |s: &BTreeSet<u32>| kept.iter().filter(|k| k.is_superset(s)).count();
        assert!(wanted.iter().filter(|s| s.len() == 2).all(|s| held(s) >= 1));
        assert!(kept.iter().filter(|s| s.len() == 2).all(|s| held(s) == 1));
        assert!(kept.iter().all(|s| s.len() >= 2));
    }
}

#[test]
fn real_garments_come_together_again() {
    let Some(folder) = assets() else { return };
    for name in ["Puffer_dense", "jumpsuit_dense"] {
        let garment = read_mesh(&folder.join(format!("garments/{name}/garment.obj")));
        let (whole, diagnostics) = Weld::new(&garment);
        assert_eq!((&whole.mesh, diagnostics.len()), (&garment, 0), "{name}");
        let split = exploded(&garment, &mut Random::new(11));
        let (weld, diagnostics) = Weld::new(&split);
        assert_eq!(weld.mesh.positions.len(), garment.positions.len());
        assert_eq!(places(&weld.mesh), places(&garment));
        assert_eq!(diagnostics.len(), 1);
        let number: BTreeMap<[u64; 3], usize> =
            weld.mesh.positions.iter().enumerate().map(|(w, p)| (p.to_array().map(f64::to_bits), w)).collect();
        assert_eq!(number.len(), weld.mesh.positions.len());
        let [one, other] = [&weld.mesh, &garment].map(|m| Topology::new(m.positions.len(), &m.triangles));
        assert_eq!(
            (one.components, one.hinges.len(), one.loops.len()),
            (other.components, other.hinges.len(), other.loops.len())
        );
        assert_eq!(weld.scatter(&weld.mesh.positions), split.positions);
    }
}

/// A sheet of unit cells, 6 by 4, cut along x = 3; the right half is `apart` from the left one, a little differently at
/// every vertex.
fn cut_sheet(apart: f64) -> TriangleMesh {
    let mut random = Random::new(8);
    let mut sheet = TriangleMesh::default();
    for half in 0..2 {
        let first = sheet.positions.len() as u32;
        for (j, i) in (0..5).flat_map(|j| (0..4).map(move |i| (j, i))) {
            let shift = if half == 1 && i == 0 { apart * (DVec3::X + 0.3 * random.vector()) } else { DVec3::ZERO };
            sheet.positions.push(DVec3::new(f64::from(3 * half + i), f64::from(j), 0.0) + shift);
        }
        for (j, i) in (0..4).flat_map(|j| (0..3).map(move |i| (j, i))) {
            let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| first + 4 * j + i);
            sheet.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    sheet
}

#[test]
fn a_seam_apart_by_a_hair_is_closed() {
    let garment = cut_sheet(1e-3);
    let (weld, diagnostics) = Weld::closing_seams(&garment, 0.01);
    assert_eq!((weld.mesh.positions.len(), weld.mesh.triangles.len()), (35, 48));
    assert_eq!(Topology::new(35, &weld.mesh.triangles).loops.len(), 1);
    let found = of(&diagnostics, DiagnosticKind::WeldedNear);
    assert_eq!((diagnostics.len(), found.len(), found[0].severity()), (1, 1, Severity::Note));
    assert_eq!(found[0].elements(), vertices(&[3, 20]));
    assert!(found[0].to_string().contains("closed in 5 places"), "{}", found[0].to_string());
    // The lowest gives the position, the others keep theirs, and both sides get the same bits.
    for (v, p) in garment.positions.iter().enumerate() {
        let seam = v >= 20 && v % 4 == 0;
        let wanted = if seam { garment.positions[v - 17] } else { *p };
        assert_eq!(weld.scatter(&weld.mesh.positions)[v], wanted);
    }
    assert!(weld.vertex_of.is_sorted());
    // A wider gap stays open, as does every gap without the option.
    assert_eq!(Weld::closing_seams(&cut_sheet(0.02), 0.01).0, Weld::new(&cut_sheet(0.02)).0);
    assert_eq!(Weld::closing_seams(&garment, 0.0), Weld::new(&garment));
    assert_eq!(Weld::new(&garment).0.mesh.positions.len(), 40);
}

#[test]
fn two_sides_of_a_thin_sheet_stay_two() {
    let mut garment = mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]);
    garment.positions.extend(SQUARE.map(|p| DVec3::from_array(p) + 1e-4 * DVec3::Z));
    garment.triangles.extend([[6, 5, 4], [7, 6, 4]]);
    assert_eq!(Weld::closing_seams(&garment, 0.25).0, Weld::new(&garment).0);
    // Nor do vertices that meet at a point become one: a bow tie closes no seam.
    let tie = mesh(
        &[SQUARE[0], SQUARE[1], SQUARE[2], [-1e-4, 0.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, -1.0, 0.0]],
        &[[0, 1, 2], [3, 4, 5]],
    );
    assert_eq!(Weld::closing_seams(&tie, 0.25).0, Weld::new(&tie).0);
}

/// Sheets of triangles without common vertices, all a hair apart, come together as they were; triangles of any size keep their
/// corners.
#[test]
fn what_came_apart_comes_together_and_no_triangle_is_lost() {
    let mut random = Random::new(21);
    for round in 0..20 {
        let sheet = Weld::closing_seams(&cut_sheet(1e-3), 0.01).0.mesh;
        let mut split = exploded(&sheet, &mut random);
        split.positions.iter_mut().for_each(|p| *p += 2e-3 * random.vector());
        let (weld, _) = Weld::closing_seams(&split, 0.02);
        let topology = Topology::new(weld.mesh.positions.len(), &weld.mesh.triangles);
        assert_eq!((weld.mesh.positions.len(), topology.loops.len(), topology.components), (35, 1, 1), "{round}");

        // Stretched, so that edges are of all lengths and many are shorter than the distance.
        split.positions.iter_mut().for_each(|p| *p = DVec3::new(p.x.powi(5) * 1e-3, p.y.powi(4) * 1e-2, p.z));
        let (weld, _) = Weld::closing_seams(&split, 0.25);
        let exact = Weld::new(&split).0;
        assert_eq!(weld.triangle_of, exact.triangle_of);
        for t in &split.triangles {
            assert_eq!(BTreeSet::from(t.map(|v| weld.to_welded[v as usize])).len(), 3);
        }
        let sides = split.triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
        let length = |[v, w]: [u32; 2]| split.positions[v as usize].distance(split.positions[w as usize]);
        let limit = 0.25 * sides.clone().map(length).sum::<f64>() / sides.count() as f64;
        for (v, &w) in weld.to_welded.iter().enumerate() {
            assert!(weld.mesh.positions[w as usize].distance(split.positions[v]) <= limit);
        }
    }
}
