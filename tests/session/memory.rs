//! The limit on memory, and the figure that is reported.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::memory::Sizes;
use bespoke::options::Options;
use bespoke::session::{Budget, Precision, Session};
use glam::DVec3;

use super::assets::load;
use super::cancel::{as_it_is, fine, finer};
use super::small::{arm, moved, session, sleeve, thick_arm, tube};

fn limited(memory_limit: u64) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_options(Options { memory_limit, ..Options::default() }).unwrap();
    session
}

fn bits(session: &Session) -> Vec<[u64; 3]> {
    session.garment_positions().unwrap().iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

#[test]
fn a_mesh_too_large_for_the_limit_is_refused_before_the_run() {
    let mut session = limited(1_000_000);
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::MemoryLimit);
    for words in ["MB", "the limit is 1.0 MB", "of the garment", "memory_limit"] {
        assert!(error.message.contains(words), "{error}");
    }
    assert_eq!(session.stage(), Stage::Setup);
    session.set_options(Options::default()).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
}

#[test]
fn a_limit_that_is_kept_changes_nothing() {
    let mut free = limited(0);
    assert_eq!(free.run().unwrap(), Stage::Done);
    let mut bound = limited(400_000_000);
    assert_eq!(bound.run().unwrap(), Stage::Done);
    assert_eq!(bits(&free), bits(&bound));
    let memory = bound.report().memory;
    assert!(memory > 100_000 && memory < 400_000_000, "{memory}");
}

/// Contacts that begin at a distance of many edges: no estimate from sizes tells how many pairs there are.
#[test]
fn pairs_beyond_the_limit_end_the_session() {
    let garment = tube(-0.6, 0.7, |_, _| 0.3, 40, 60, false);
    let estimate = |vertices: usize| {
        let sizes = Sizes { garment_vertices: vertices, avatar_triangles: 1000, field: 4_000_000 };
        sizes.estimate().iter().map(|part| part.bytes).sum::<u64>()
    };
    let options = Options {
        dhat: 0.1,
        inflation_dhat: 0.1,
        voxel_size: 0.05,
        memory_limit: estimate(garment.positions.len()) + 10_000_000,
        ..Options::default()
    };
    let mut session = Session::new();
    session.set_garment(garment, Precision::F64).unwrap();
    session.set_source_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    session.set_target_avatar(thick_arm()).unwrap();
    session.set_target_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    session.set_options(options).unwrap();
    let error = session.run().unwrap_err();
    assert_eq!(error.kind, ErrorKind::MemoryLimit, "{error}");
    let real = ["more pairs than there is budget for", "the factorisation of the garment's linear system"];
    assert!(real.iter().any(|what| error.message.contains(what)), "not from sizes: {error}");
}

/// The field of such an avatar exceeds the limit by its voxels: reported at once, not when the fit begins.
#[test]
fn an_avatar_too_large_for_the_voxels_is_refused_by_prepare() {
    let mut session = Session::new();
    let mut body = thick_arm();
    let far = moved(&thick_arm(), 1.0, DVec3::new(3000.0, 2500.0, 2000.0));
    let count = body.positions.len() as u32;
    body.positions.extend(far.positions);
    body.triangles.extend(far.triangles.iter().map(|t| t.map(|v| v + count)));
    session.set_garment(sleeve(), Precision::F64).unwrap();
    session.set_source_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    // Else what is so far away is left out.
    session.set_options(Options { strict: true, ..Options::default() }).unwrap();
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument, "{error}");
    assert!(error.message.contains("voxel"), "{error}");
}

/// Prints a line for each case: `cargo test --release --test session memory:: -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes and gigabytes"]
fn figures_of_finer_meshes() {
    for change in [as_it_is, finer, fine] {
        let Some(mut session) = load("jumpsuit_dense", "child", Options::default(), change) else { return };
        session.prepare().unwrap();
        let prepared = session.report();
        session.step(Budget { iterations: 2, milliseconds: 0 }).unwrap();
        let [garment_vertices, _] = prepared.garment_size;
        let sizes = Sizes { garment_vertices, avatar_triangles: prepared.projected_size[1], field: 0 };
        println!(
            "{garment_vertices} vertices: held {} prepared, {} after two iterations; estimated {:?}",
            prepared.memory,
            session.report().memory,
            sizes.estimate()
        );
    }
}

/// The estimate from sizes is above what real garments are found to hold, and not far above it.
#[test]
fn the_estimate_is_near_what_real_garments_take() {
    for (garment, avatar) in [("Puffer_dense", "child"), ("jumpsuit_dense", "Goblin")] {
        let refused = Options { memory_limit: 1, ..Options::default() };
        let Some(mut session) = load(garment, avatar, refused, |_| {}) else { return };
        assert_eq!(session.prepare().unwrap_err().kind, ErrorKind::MemoryLimit);
        session.set_options(Options::default()).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        let report = session.report();
        let sizes =
            Sizes { garment_vertices: report.garment_size[0], avatar_triangles: report.projected_size[1], field: 0 };
        let estimate: u64 = sizes.estimate().iter().map(|part| part.bytes).sum();
        assert!(estimate > report.memory, "{garment}: {estimate} for {}", report.memory);
        assert!(estimate < 3 * report.memory, "{garment}: {estimate} for {}", report.memory);
        println!("{garment} on {avatar}: estimate {estimate} without the field, held {}", report.memory);
    }
}
