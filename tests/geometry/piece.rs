//! Connected pieces, against labels that are spread until nothing changes.

use bespoke::geometry::mesh::triangle_area;
use bespoke::geometry::piece::Piece;
use glam::DVec3;
use testing::Random;

/// The lowest vertex that each vertex is connected with; none for one that nothing uses.
fn spread(count: u32, groups: &[Vec<u32>]) -> Vec<Option<u32>> {
    let mut lowest: Vec<Option<u32>> = vec![None; count as usize];
    groups.iter().flatten().for_each(|&v| lowest[v as usize] = Some(v));
    loop {
        let before = lowest.clone();
        for group in groups {
            let least = group.iter().filter_map(|&v| lowest[v as usize]).min();
            group.iter().for_each(|&v| lowest[v as usize] = least);
        }
        if lowest == before {
            return lowest;
        }
    }
}

#[test]
fn pieces_are_what_triangles_and_links_connect() {
    let mut random = Random::new(23);
    let mut most = 0;
    for round in 0..200 {
        let count = 30;
        let mut vertex = || (random.unit() * f64::from(count)) as u32;
        let triangles: Vec<[u32; 3]> = (0..round % 16).map(|_| [vertex(), vertex(), vertex()]).collect();
        let links: Vec<[u32; 2]> = (0..round % 5).map(|_| [vertex(), vertex()]).collect();
        let positions: Vec<DVec3> = (0..count).map(|_| random.vector()).collect();
        let mut groups: Vec<Vec<u32>> = triangles.iter().map(|t| t.to_vec()).collect();
        groups.extend(links.iter().map(|link| link.to_vec()));
        let lowest = spread(count, &groups);
        let mut roots: Vec<u32> = lowest.iter().flatten().copied().collect();
        roots.sort_unstable();
        roots.dedup();

        let pieces = Piece::find(&positions, &triangles, links);
        assert_eq!(pieces.len(), roots.len());
        most = most.max(pieces.len());
        for (piece, root) in pieces.iter().zip(roots) {
            let own = |v: &u32| lowest[*v as usize] == Some(root);
            assert_eq!(piece.vertices, (0..count).filter(own).collect::<Vec<u32>>());
            let has = |k: &u32| own(&triangles[*k as usize][0]);
            assert_eq!(piece.triangles, (0..triangles.len() as u32).filter(has).collect::<Vec<u32>>());
            let corners = |&k: &u32| triangles[k as usize].map(|v| positions[v as usize]);
            let area: f64 = piece.triangles.iter().map(|k| triangle_area(corners(k))).sum();
            assert!((piece.area - area).abs() < 1e-12);
            let points = || piece.vertices.iter().map(|&v| positions[v as usize]);
            assert!(points().all(|p| p.cmpge(piece.low).all() && p.cmple(piece.high).all()));
            for axis in 0..3 {
                assert!(points().any(|p| p[axis] == piece.low[axis]) && points().any(|p| p[axis] == piece.high[axis]));
            }
            let mesh = piece.mesh(&positions, &triangles);
            assert_eq!(mesh.triangles.len(), piece.triangles.len());
            let copied = |(k, t): (u32, &u32)| mesh.corners(k) == corners(t);
            assert!((0..).zip(&piece.triangles).all(copied));
        }
    }
    assert!(most > 4, "there were never more than {most} pieces");
}
