//! The C++ shim: refused input, blocks as read, cancellation.

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
    // Message, points, triangles, bands.
    type Case<'a> = (&'a str, &'a [[f32; 3]], &'a [[u32; 3]], [f32; 2]);
    let cases: [Case<'_>; 6] = [
        ("no triangles", &triangle, &[], [3.0, 3.0]),
        ("index out of range", &triangle, &[[0, 1, 3]], [3.0, 3.0]),
        ("outside the lattice", &[[0.0; 3], [1e9, 0.0, 0.0], [0.0; 3]], &[[0, 1, 2]], [3.0, 3.0]),
        ("outside the lattice", &[[0.0; 3], [f32::NAN, 0.0, 0.0], [0.0; 3]], &[[0, 1, 2]], [3.0, 3.0]),
        ("band", &triangle, &[[0, 1, 2]], [0.5, 3.0]),
        ("band", &triangle, &[[0, 1, 2]], [3.0, f32::INFINITY]),
    ];
    for (message, points, triangles, bands) in cases {
        let error = Volume::build(points, triangles, bands, 1, &Cancel::new()).expect_err(message);
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
        let error =
            Volume::build(&points(&mesh), &mesh.triangles, [3.0, 3.0], threads, &stop).expect_err("the flag is set");
        assert_eq!(error.kind, ErrorKind::Cancelled);
    }
}

#[test]
fn reads_distances_within_the_band_and_the_sign_beyond() {
    let half = DVec3::new(20.3, 15.2, 12.7);
    let mesh = cuboid(half);
    let bands = [5.0, 3.0];
    let volume = Volume::build(&points(&mesh), &mesh.triangles, bands, 0, &Cancel::new()).expect("a box");
    let (mut near, mut far) = (0, 0);
    let blocks = || (-5..5).map(|b| b * BLOCK as i32);
    for origin in blocks().flat_map(|x| blocks().flat_map(move |y| blocks().map(move |z| [x, y, z]))) {
        for (i, value) in volume.read_block(origin).iter().enumerate() {
            let node = [i / 64, i / 8 % 8, i % 8];
            let p = DVec3::from_array([0, 1, 2].map(|a| f64::from(origin[a]) + node[a] as f64));
            let exact = cuboid_distance(half, p);
            assert_eq!(*value < 0.0, exact < 0.0, "side of {p}");
            // Beyond the band all that is stored is its width.
            if *value > -bands[1] && *value < bands[0] {
                near += 1;
                // To some triangle, not always the closest: OpenVDB passes candidates on from voxel to voxel.
                let excess = f64::from(value.abs()) - exact.abs();
                assert!((-1e-4..0.75).contains(&excess), "{p}: {value}, exact {exact}");
            } else {
                far += 1;
                let cut = if exact < 0.0 { -bands[1] } else { bands[0] };
                assert_eq!(*value, cut, "{p}");
                // OpenVDB widens its band over faces of voxels, so it falls a little short at corners.
                assert!(exact.abs() > f64::from(cut.abs()) - 1.0, "{p}: {exact} should be in the band");
            }
        }
    }
    assert!(near > 10_000 && far > 10_000);
    assert!(volume.memory() > 4 * near);
    // Any node of a block selects it.
    assert_eq!(volume.read_block([-17, 3, 9]), volume.read_block([-24, 0, 8]));
}
