//! The C++ shim: refused input, the side of each node, cancellation.

use bespoke::control::Cancel;
use bespoke::error::ErrorKind;
use bespoke::sdf::volume::{BLOCK, Volume};
use glam::DVec3;

use crate::shapes::{cuboid, cuboid_distance, sphere};

fn points(mesh: &bespoke::geometry::mesh::TriangleMesh) -> Vec<[f32; 3]> {
    mesh.positions.iter().map(|p| p.as_vec3().to_array()).collect()
}

#[test]
fn refuses_what_it_cannot_use() {
    let triangle = [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 5.0, 0.0]];
    // Message, points, triangles, band.
    type Case<'a> = (&'a str, &'a [[f32; 3]], &'a [[u32; 3]], f32);
    let cases: [Case<'_>; 6] = [
        ("no triangles", &triangle, &[], 3.0),
        ("index out of range", &triangle, &[[0, 1, 3]], 3.0),
        ("outside the lattice", &[[0.0; 3], [1e9, 0.0, 0.0], [0.0; 3]], &[[0, 1, 2]], 3.0),
        ("outside the lattice", &[[0.0; 3], [f32::NAN, 0.0, 0.0], [0.0; 3]], &[[0, 1, 2]], 3.0),
        ("band", &triangle, &[[0, 1, 2]], 0.5),
        ("band", &triangle, &[[0, 1, 2]], f32::INFINITY),
    ];
    for (message, points, triangles, band) in cases {
        let error = Volume::build(points, triangles, band, 1, &Cancel::new()).expect_err(message);
        assert_eq!(error.kind, ErrorKind::InvalidMesh, "{error}");
        assert!(error.message.contains(message), "{error}");
    }
}

#[test]
fn stops_when_asked() {
    let mesh = sphere(DVec3::ZERO, 100.0, 40, 2.0);
    let stop = Cancel::new();
    stop.request();
    for threads in [1, 2] {
        let error = Volume::build(&points(&mesh), &mesh.triangles, 3.0, threads, &stop).expect_err("the flag is set");
        assert_eq!(error.kind, ErrorKind::Cancelled);
    }
}

/// With any number of threads, none included. The larger box has cubes of 128 nodes that lie inside as a whole.
#[test]
fn finds_the_side_of_every_node() {
    for (half, reach) in [(DVec3::new(20.3, 15.2, 12.7), 5), (DVec3::new(200.3, 210.2, 205.7), 28)] {
        let mesh = cuboid(half);
        let build =
            |threads| Volume::build(&points(&mesh), &mesh.triangles, 2.0, threads, &Cancel::new()).expect("a box");
        let volumes = [0, 1, 2, 5].map(build);
        let (mut inside, mut outside) = (0u64, 0u64);
        let blocks = || (-reach..reach).map(|b| b * BLOCK as i32);
        for origin in blocks().flat_map(|x| blocks().flat_map(move |y| blocks().map(move |z| [x, y, z]))) {
            let found = volumes[0].block(origin);
            assert!(volumes.iter().all(|volume| volume.block(origin) == found), "{origin:?}");
            for n in 0..512 {
                let node = [n / 64, n / 8 % 8, n % 8];
                let p = DVec3::from_array([0, 1, 2].map(|a| f64::from(origin[a]) + node[a] as f64));
                let is_inside = found[n / 64] >> (n % 64) & 1 == 1;
                assert_eq!(is_inside, cuboid_distance(half, p) < 0.0, "side of {p}");
                *if is_inside { &mut inside } else { &mut outside } += 1;
            }
        }
        assert!(inside > 10_000 && outside > 10_000);
        // Bits along the surface, a few numbers for the rest.
        let area = 8.0 * (half.x * half.y + half.y * half.z + half.z * half.x);
        assert!((volumes[0].memory() as f64) < 16.0 * area + 50_000.0, "{} bytes", volumes[0].memory());
        // Any node of a block selects it.
        assert_eq!(volumes[0].block([-17, 3, 9]), volumes[0].block([-24, 0, 8]));
    }
}
