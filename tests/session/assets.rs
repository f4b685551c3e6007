//! The real meshes, where they are at hand: ten pairs, the same defaults for all.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::{Options, Precision, Session};

use testing::obj::{assets, read_mesh, read_skeleton, read_skin};

/// A session with a real garment, changed by `change` first, on a real avatar; none where they are not at hand.
pub fn load(garment: &str, avatar: &str, options: Options, change: fn(&mut TriangleMesh)) -> Option<Session> {
    let folder = assets()?;
    let (garment, avatar) = (folder.join("garments").join(garment), folder.join("avatars").join(avatar));
    let mut session = Session::new();
    session.set_options(options).unwrap();
    let mut cloth = read_mesh(&garment.join("garment.obj"));
    change(&mut cloth);
    let body = read_mesh(&avatar.join("avatar.obj"));
    let skeleton = read_skeleton(&avatar.join("skeleton.obj"));
    if let Some(skin) = read_skin(&avatar.join("skin.txt"), skeleton.joints.len(), body.positions.len()) {
        session.set_target_skin(skin).unwrap();
    }
    if let Ok(text) = std::fs::read_to_string(garment.join("no-fit.txt")) {
        let mut weights = vec![1.0; cloth.positions.len()];
        text.split_whitespace().for_each(|v| weights[v.parse::<usize>().unwrap()] = 0.0);
        session.set_vertex_fit_weights(weights).unwrap();
    }
    session.set_garment(cloth, Precision::F32).unwrap();
    session.set_source_skeleton(read_skeleton(&garment.join("skeleton.obj"))).unwrap();
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    Some(session)
}

fn dress(garment: &str, avatar: &str, options: Options) {
    let Some(mut session) = load(garment, avatar, options, |_| {}) else { return };
    assert_eq!(session.run().unwrap(), Stage::Done);
    let report = session.report();
    assert!(report.verification.unwrap().is_clean());
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    // Generous bounds that a garment on the wrong limb, or inside out, is far beyond.
    let term = |name| report.terms.iter().find(|t| t.name == name).unwrap().value;
    assert!(term("surface") < 0.15, "surface {}", term("surface"));
    assert!(term("fit") < 0.02, "fit {}", term("fit"));
    assert!(term("position") < 1e-3, "position {}", term("position"));
}

macro_rules! pairs {
    ($($name:ident: $garment:literal on $avatar:literal),* $(,)?) => {
        $(#[test] fn $name() { dress($garment, $avatar, Options::default()); })*
    };
}

pairs! {
    coat_on_goblin: "Puffer_dense" on "Goblin",
    coat_on_fox_girl: "Puffer_dense" on "FoxGirl",
    coat_on_slim_adult: "Puffer_dense" on "slim_adult",
    coat_on_heavy_adult: "Puffer_dense" on "heavy_adult",
    coat_on_child: "Puffer_dense" on "child",
    jumpsuit_on_goblin: "jumpsuit_dense" on "Goblin",
    jumpsuit_on_fox_girl: "jumpsuit_dense" on "FoxGirl",
    jumpsuit_on_slim_adult: "jumpsuit_dense" on "slim_adult",
    jumpsuit_on_heavy_adult: "jumpsuit_dense" on "heavy_adult",
    jumpsuit_on_child: "jumpsuit_dense" on "child",
}

/// With so stiff and wide a barrier the continuation stalls at t = 0.8; the augmented Lagrangian gets the garment free.
#[test]
fn a_wedged_garment_gets_free() {
    dress("jumpsuit_dense", "Goblin", Options { inflation_barrier_weight: 1e8, ..Options::default() });
}
