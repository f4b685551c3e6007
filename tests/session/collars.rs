//! Collars on a body whose head is wider than the shoulders: as level as in the design.

use bespoke::control::Stage;
use bespoke::geometry::mesh::Topology;
use bespoke::options::Options;
use bespoke::session::Precision;
use bespoke::stage::plausibility::Disc;
use closet::garments::{Garment, garment};
use closet::rigs::{Body, Character, Naming, character};
use glam::DVec3;
use testing::character as dressing;

/// By how many degrees a collar may lean more than in the design, to any side.
const LEVEL: f64 = 6.0;

fn body(body: Body, naming: Naming) -> Character {
    character(&body.model(), naming)
}

/// The highest of the borders of a garment.
fn collar(design: &Character) -> Vec<u32> {
    let topology = Topology::new(design.mesh.positions.len(), &design.mesh.triangles);
    let height = |vertices: &[u32]| {
        vertices.iter().map(|&v| design.mesh.positions[v as usize].z).sum::<f64>() / vertices.len() as f64
    };
    let loops = topology.loops.into_iter().map(|border| border.vertices);
    loops.max_by(|a, b| height(a).total_cmp(&height(b))).expect("it has borders")
}

#[test]
fn a_collar_under_a_head_that_is_wider_than_the_shoulders_is_level() {
    let (source, target) = (body(Body::Mannequin, Naming::Mixamo), body(Body::BigHead, Naming::Vrm));
    for worn in [Garment::Sweater, Garment::Coat] {
        let name = worn.name();
        let design = source.wears(&garment(worn).mesh);
        let options = Options { threads: 2, voxel_size: 0.04, ..Options::default() };
        let mut session = dressing::session(&design, &source, &target, options).unwrap();
        session.set_source_avatar(dressing::mesh(&source)).unwrap();
        session.set_source_skin(dressing::skin(&source)).unwrap();
        let ended = session.run();
        assert!(matches!(ended, Ok(Stage::Done)), "{name}: {ended:?}");
        assert!(session.verify(Precision::F32).unwrap().is_clean(), "{name}");
        let (collar, result) = (collar(&design), session.garment_positions().unwrap());
        let [before, now] = [&design.mesh.positions, &result].map(|positions| {
            Disc::new(&collar.iter().map(|&v| positions[v as usize]).collect::<Vec<DVec3>>()).area.normalize()
        });
        let leans = before.angle_between(now).to_degrees();
        println!("{name}: leans by {leans:.1} degrees more than in the design");
        assert!(leans < LEVEL, "{name}: {leans}");
    }
}
