//! Garments with thickness, and the rims that the library finds of them.

use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::shell_rims::ShellRims;
use glam::DVec3;

use crate::garments::made;
use crate::{boundary_loops, euler_characteristic, longest_side};
use closet::Sample;
use closet::garments::Garment;
use closet::mesh::Mesh;
use closet::skeleton::BONES;
use closet::thickness::{Rim, thickened};

const RIMS: [Rim; 4] = [Rim::Fold, Rim::Strip, Rim::Round(2), Rim::Round(6)];

/// A mesh as the library has it, with its skeleton 2 long.
fn rims(sample: &Sample, mesh: &Mesh) -> ShellRims {
    let scale = 2.0 / longest_side(sample);
    let scaled = |points: &[DVec3]| points.iter().map(|&p| scale * p).collect();
    let mesh = TriangleMesh { positions: scaled(&mesh.positions), triangles: mesh.triangles.clone() };
    let skeleton = Skeleton { joints: scaled(&sample.skeleton.joints), bones: BONES.to_vec() };
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    ShellRims::find(&mesh, &topology, &vec![false; mesh.positions.len()], &skeleton)
}

#[test]
fn thickened_garments_are_closed() {
    for kind in Garment::ALL {
        let sample = made(kind);
        let openings = boundary_loops(&sample.mesh).len() as i64;
        for rim in RIMS {
            let shell = thickened(&sample.mesh, 0.006, rim);
            assert!(boundary_loops(&shell).is_empty(), "{kind:?} {rim:?}");
            // A sphere with as many handles as openings beyond the first.
            assert_eq!(euler_characteristic(&shell), 2 - 2 * (openings - 1), "{kind:?} {rim:?}");
            assert_eq!(shell.positions[..sample.mesh.positions.len()], sample.mesh.positions[..]);
        }
    }
}

#[test]
fn the_rims_are_where_the_openings_are() {
    for kind in Garment::ALL {
        let sample = made(kind);
        let openings = boundary_loops(&sample.mesh);
        for (rim, thickness) in RIMS.into_iter().flat_map(|rim| [0.001, 0.006, 0.015].map(|t| (rim, t))) {
            let mut shell = thickened(&sample.mesh, thickness, rim);
            let found = rims(sample, &shell);
            let name = format!("{kind:?} {rim:?} {thickness}");
            assert_eq!((found.loops.len(), found.without.len()), (openings.len(), 0), "{name}");
            for opening in &openings {
                let off = |curve: &[u32]| {
                    let to = |v: u32| {
                        let distances = opening
                            .iter()
                            .map(|&w| sample.mesh.positions[w as usize].distance(shell.positions[v as usize]));
                        distances.fold(f64::INFINITY, f64::min)
                    };
                    curve.iter().map(|&v| to(v)).fold(0.0, f64::max)
                };
                let nearest = found.loops.iter().map(|curve| off(&curve.vertices)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 0.03, "{name}: {nearest}");
            }
            // Whichever way it is wound.
            shell.triangles.iter_mut().for_each(|t| t.swap(1, 2));
            assert_eq!(rims(sample, &shell).loops.len(), openings.len(), "{name}");
        }
    }
}

#[test]
fn a_garment_without_thickness_has_none() {
    for kind in Garment::ALL {
        let sample = made(kind);
        assert_eq!(rims(sample, &sample.mesh), ShellRims::default(), "{kind:?}");
    }
}
