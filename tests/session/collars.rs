//! Collars on a body whose head is wider than the shoulders and hangs in front of the neck: below the head, and as level as in
//! the design.

use bespoke::control::Stage;
use bespoke::geometry::mesh::Topology;
use bespoke::options::Options;
use bespoke::session::Precision;
use bespoke::stage::plausibility::Disc;
use closet::garments::{Garment, garment};
use closet::rigs::{Body, Character, Naming, Role, character};
use glam::DVec3;
use testing::character as dressing;

/// By how many degrees a collar may lean more than in the design.
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
fn a_collar_is_below_a_head_that_is_wider_than_the_shoulders_and_level() {
    let (source, target) = (body(Body::Mannequin, Naming::Mixamo), body(Body::BigHead, Naming::Vrm));
    for worn in [Garment::Sweater, Garment::Coat, Garment::Jumpsuit] {
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
            let area = Disc::new(&collar.iter().map(|&v| positions[v as usize]).collect::<Vec<DVec3>>()).area;
            (area.z.abs() / area.length()).acos().to_degrees()
        });
        println!("{name}: leans by {now:.1} degrees, {before:.1} in the design");
        assert!(now < before + LEVEL, "{name}: {now} {before}");

        // The bodies face -y. What of the head is as low as the front of the collar hangs in front of it.
        let front = collar.iter().map(|&v| result[v as usize]).min_by(|a, b| a.y.total_cmp(&b.y)).expect("a collar");
        let head = target.mesh.positions.iter().zip(&target.influences).filter(|(_, weights)| {
            let largest = weights.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("weights");
            target.joints[largest.0].role == Role::Head
        });
        let behind = head.map(|(p, _)| *p).filter(|p| p.z < front.z && p.y > front.y).count();
        assert_eq!(behind, 0, "{name}: vertices of the head in the collar, whose front is at {front}");
    }
}
