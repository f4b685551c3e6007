//! Checks of meshes, and their connectivity.

use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::{Hinge, Topology, TriangleMesh};
use glam::DVec3;

use testing::Random;
use testing::obj::{assets, read_mesh};

fn message(mesh: &TriangleMesh) -> String {
    let error = mesh.check("garment").unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidMesh);
    error.message
}

fn loops(topology: &Topology) -> Vec<Vec<u32>> {
    topology.loops.iter().map(|l| l.vertices.clone()).collect()
}

/// The triangles of a rectangle of cells, without the cells in `holes`; vertex (x, y) is `y * (width + 1) + x`.
fn grid(width: u32, height: u32, holes: &[(u32, u32)]) -> Vec<[u32; 3]> {
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let v = |x: u32, y: u32| y * (width + 1) + x;
    cells
        .filter(|cell| !holes.contains(cell))
        .flat_map(|(x, y)| [[v(x, y), v(x + 1, y), v(x, y + 1)], [v(x + 1, y), v(x + 1, y + 1), v(x, y + 1)]])
        .collect()
}

#[test]
fn unusable_meshes_are_refused_by_name() {
    let mut mesh = TriangleMesh::default();
    assert_eq!(message(&mesh), "garment: the mesh has no vertices");
    mesh.positions = vec![DVec3::ZERO; 4];
    assert_eq!(message(&mesh), "garment: the mesh has 4 vertices but no triangles");
    mesh.triangles = vec![[0, 1, 2], [1, 9000, 3]];
    assert_eq!(message(&mesh), "garment: triangle 1 has index 9000, the mesh has 4 vertices");
    mesh.triangles[1] = [1, 1, 3];
    // Neither a repeated index nor an area of zero is an error.
    assert_eq!(mesh.check("garment"), Ok(()));
    for (value, text) in [(f64::NAN, "y = NaN"), (f64::NEG_INFINITY, "y = -inf"), (1e31, "y = 1000000")] {
        mesh.positions[2].y = value;
        let sentence = message(&mesh);
        assert!(sentence.starts_with(&format!("garment: vertex 2 has {text}")), "{sentence}");
    }
}

#[test]
fn hinge_over_one_edge() {
    let hinge = |vertices, triangles| Hinge { vertices, triangles };
    let made = |triangles: &[[u32; 3]]| Topology::new(4, triangles).hinges;
    assert_eq!(made(&[[0, 1, 2], [1, 0, 3]]), [hinge([0, 1, 2, 3], [0, 1])]);
    assert_eq!(made(&[[1, 0, 3], [0, 1, 2]]), [hinge([1, 0, 3, 2], [0, 1])]);
    // Rotated corners, and a neighbour wound the other way: the same hinge.
    assert_eq!(made(&[[2, 0, 1], [3, 1, 0]]), [hinge([0, 1, 2, 3], [0, 1])]);
    assert_eq!(made(&[[0, 1, 2], [0, 1, 3]]), [hinge([0, 1, 2, 3], [0, 1])]);
    // A triangle given twice has no fourth corner; one that repeats an index is left out.
    assert_eq!(made(&[[0, 1, 2], [1, 2, 0]]), []);
    assert_eq!(made(&[[0, 1, 2], [0, 0, 1]]), []);
    let degenerate = Topology::new(4, &[[0, 0, 1], [2, 2, 2]]);
    assert_eq!((degenerate.components, degenerate.edges.len(), degenerate.loops.len()), (0, 0, 0));
}

#[test]
fn an_edge_of_many_triangles() {
    let fan = |n: u32| (0..n).map(|i| [0, 1, i + 2]).collect::<Vec<_>>();
    for (n, hinges) in [(3, 3), (4, 6), (32, 496), (33, 32), (1000, 999)] {
        let topology = Topology::new(1002, &fan(n));
        assert_eq!(topology.hinges.len(), hinges, "{n} triangles");
        for h in &topology.hinges {
            assert_eq!(h.vertices[..2], [0, 1]);
            assert_eq!(h.triangles.map(|t| t + 2), h.vertices[2..]);
            assert!(h.triangles[0] < h.triangles[1]);
        }
    }
    // Its boundaries run from one end of the edge to the other: three chains, of which two make a loop.
    let topology = Topology::new(5, &fan(3));
    let chains =
        topology.loops.iter().map(|l| l.vertices.len()).chain(topology.open_boundaries.iter().map(|c| c.len() - 1));
    assert_eq!(chains.sum::<usize>(), 6);
    assert_eq!(topology.open_boundaries.len(), 1);
}

#[test]
fn every_hinge_is_a_pair_of_neighbours() {
    let mut random = Random::new(5);
    for _ in 0..50 {
        let triangles: Vec<[u32; 3]> = (0..40).map(|_| std::array::from_fn(|_| (random.unit() * 9.0) as u32)).collect();
        let topology = Topology::new(9, &triangles);
        for h in &topology.hinges {
            let [v1, v2, v3, v4] = h.vertices;
            let [t1, t2] = h.triangles.map(|t| triangles[t as usize]);
            assert!((0..3).any(|k| [t1[k], t1[(k + 1) % 3], t1[(k + 2) % 3]] == [v1, v2, v3]));
            let mut corners = [[v2, v1, v4], t2];
            corners.iter_mut().for_each(|c| c.sort_unstable());
            assert_eq!(corners[0], corners[1]);
        }
        // No boundary edge is lost, and none is used twice, whatever the mesh.
        let mut sides: Vec<[u32; 2]> = Vec::new();
        for l in &topology.loops {
            assert!(l.vertices.len() >= 3);
            sides.extend((0..l.vertices.len()).map(|i| [l.vertices[i], l.vertices[(i + 1) % l.vertices.len()]]));
        }
        sides.extend(topology.open_boundaries.iter().flat_map(|c| c.windows(2).map(|w| [w[0], w[1]])));
        sides.iter_mut().for_each(|s| s.sort_unstable());
        sides.sort_unstable();
        let has = |t: &[u32; 3], [a, b]: [u32; 2]| {
            t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && t.contains(&a) && t.contains(&b)
        };
        let single: Vec<[u32; 2]> =
            topology.edges.iter().copied().filter(|&e| triangles.iter().filter(|t| has(t, e)).count() == 1).collect();
        assert_eq!(sides, single);
    }
}

#[test]
fn boundary_of_a_sheet_with_holes() {
    let topology = Topology::new(30, &grid(5, 4, &[(1, 1), (3, 2)]));
    let outer = [0, 1, 2, 3, 4, 5, 11, 17, 23, 29, 28, 27, 26, 25, 24, 18, 12, 6].to_vec();
    assert_eq!(loops(&topology), [outer, vec![7, 13, 14, 8], vec![15, 21, 22, 16]]);
    assert_eq!((topology.components, topology.open_boundaries.len()), (1, 0));
    // Euler: vertices - edges + triangles = 1 - holes.
    assert_eq!(30 + 36 - (1 - 2), topology.edges.len() as i32);
}

#[test]
fn loops_that_meet_in_a_vertex_are_split() {
    // Two holes with a common corner (vertex 14), and two sheets that meet in one.
    let holes = Topology::new(30, &grid(5, 4, &[(1, 1), (2, 2)]));
    assert_eq!(loops(&holes)[1..], [vec![7, 13, 14, 8], vec![14, 20, 21, 15]]);
    let sheets = Topology::new(5, &[[0, 1, 2], [2, 3, 4]]);
    assert_eq!(loops(&sheets), [vec![0, 1, 2], vec![2, 3, 4]]);
    assert_eq!(sheets.components, 1);
    assert_eq!(Topology::new(6, &[[0, 1, 2], [3, 4, 5]]).components, 2);
}

#[test]
fn winding_does_not_break_loops() {
    let mut triangles = grid(5, 4, &[(1, 1)]);
    let expected = Topology::new(30, &triangles);
    let mut random = Random::new(8);
    for _ in 0..20 {
        for t in &mut triangles {
            if random.unit() < 0.4 {
                t.swap(1, 2);
            }
        }
        let topology = Topology::new(30, &triangles);
        assert_eq!(topology.edges, expected.edges);
        assert!(topology.open_boundaries.is_empty());
        let lengths = |t: &Topology| t.loops.iter().map(|l| (l.vertices[0], l.vertices.len())).collect::<Vec<_>>();
        assert_eq!(lengths(&topology), lengths(&expected));
    }
}

#[test]
fn areas_and_edge_lengths() {
    let positions = vec![DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 4.0, DVec3::Z];
    let mesh = TriangleMesh { positions, triangles: vec![[0, 1, 2], [0, 0, 1]] };
    assert_eq!(mesh.areas(), [6.0, 0.0]);
    let topology = Topology::new(4, &mesh.triangles);
    assert_eq!(topology.mean_edge_lengths(&mesh.positions), [3.5, 4.0, 4.5, 0.0]);
}

#[test]
fn real_garments() {
    let Some(assets) = assets() else { return };
    for (name, vertices, boundaries) in [("Puffer_dense", 3112, 4), ("jumpsuit_dense", 3637, 5)] {
        let mesh = read_mesh(&assets.join("garments").join(name).join("garment.obj"));
        assert_eq!((mesh.positions.len(), mesh.check(name)), (vertices, Ok(())));
        let topology = Topology::new(vertices, &mesh.triangles);
        assert_eq!((topology.loops.len(), topology.open_boundaries.len()), (boundaries, 0));
        // Each of the three sides of a triangle is in one hinge or on the boundary.
        let boundary: usize = topology.loops.iter().map(|l| l.vertices.len()).sum();
        assert_eq!(3 * mesh.triangles.len(), 2 * topology.hinges.len() + boundary);
    }
    let fox = read_mesh(&assets.join("avatars/FoxGirl/avatar.obj"));
    let topology = Topology::new(fox.positions.len(), &fox.triangles);
    println!(
        "FoxGirl: {} pieces, {} loops, {} open",
        topology.components,
        topology.loops.len(),
        topology.open_boundaries.len()
    );
    assert_eq!(topology.components, 40);
}
