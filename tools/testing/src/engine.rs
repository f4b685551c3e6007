//! Rigged characters as a game engine has them, as files for the programs of the tests, and what the library gives for them here.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem, Winding};
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::session::{Morph, Precision, Session};
use closet::garments;
use closet::rigs::{Body, Character, Naming, character};
use glam::{DAffine3, DMat3, DVec3};

use crate::character::rig;
use crate::process::{scratch, this_program_name};

/// Joints of a vertex in the files.
pub const INFLUENCES: usize = 4;

/// An engine's axes, unit and winding.
#[derive(Clone, Copy, Debug)]
pub enum Engine {
    /// Left-handed, y up, z forwards, metres, clockwise.
    Unity,
    /// Left-handed, z up, x forwards, centimetres, counter-clockwise.
    Unreal,
}

impl Engine {
    fn system(self) -> CoordinateSystem {
        match self {
            Self::Unity => CoordinateSystem {
                forward: Axis::PositiveZ,
                winding: Winding::Clockwise,
                ..CoordinateSystem::default()
            },
            Self::Unreal => CoordinateSystem {
                right: Axis::PositiveY,
                up: Axis::PositiveZ,
                forward: Axis::PositiveX,
                metres_per_unit: 0.01,
                ..CoordinateSystem::default()
            },
        }
    }

    /// From the closet's space: z up, facing -y, metres.
    fn placed(self, figure: &Character) -> Character {
        let rows = match self {
            Self::Unity => [DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y],
            Self::Unreal => [DVec3::NEG_Y * 100.0, DVec3::NEG_X * 100.0, DVec3::Z * 100.0],
        };
        let frame = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
        let mut placed = figure.placed(DAffine3::from_mat3(frame));
        // A mirrored mesh is turned over, and seen from the other side it is as it was.
        if let Self::Unreal = self {
            placed.mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        placed
    }
}

/// A folder with a vest, the mannequin that wears it and a heavy body, all on rigs: of each `NAME.positions` (f32), `.triangles`
/// (u32), `.names` (a line for each joint: parent or -1, a tab, the name), `.binds` (f64), `.joints` and `.weights`
/// ([`INFLUENCES`] a vertex); `morph`, and the results that the library gives here: `dressed`, `dressed.joints`, `dressed.weights`,
/// `dressed.morph`.
pub fn folder(engine: Engine) -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| write(engine, &scratch(&format!("{}-characters", this_program_name()))))
}

fn write(engine: Engine, folder: &Path) -> PathBuf {
    let source = character(&Body::Mannequin.model(), Naming::Vrm);
    let vest = engine.placed(&source.wears(&garments::vest(2.5).mesh));
    let target = engine.placed(&character(&Body::Avatar(closet::avatars::Avatar::Heavy).model(), Naming::Vrm));
    let source = engine.placed(&source);
    let save = |name: &str, bytes: Vec<u8>| fs::write(folder.join(name), bytes).expect("the folder can be written");
    for (name, figure) in [("garment", &vest), ("source", &source), ("target", &target)] {
        save(&format!("{name}.positions"), points(&figure.mesh.positions));
        save(
            &format!("{name}.triangles"),
            figure.mesh.triangles.iter().flatten().flat_map(|v| v.to_le_bytes()).collect(),
        );
        let line = |joint: &closet::rigs::Joint| {
            format!("{}\t{}\n", joint.parent.map_or(-1, |parent| parent as i64), joint.name)
        };
        save(&format!("{name}.names"), figure.joints.iter().map(line).collect::<String>().into_bytes());
        let binds = rig(figure).joints.into_iter().flat_map(|joint| joint.bind.to_cols_array());
        save(&format!("{name}.binds"), binds.flat_map(f64::to_le_bytes).collect());
        let rows = padded(figure);
        save(&format!("{name}.joints"), rows.iter().flatten().flat_map(|(joint, _)| joint.to_le_bytes()).collect());
        save(&format!("{name}.weights"), rows.iter().flatten().flat_map(|(_, weight)| weight.to_le_bytes()).collect());
    }
    let size = engine.system().metres_per_unit.recip();
    let morph: Vec<DVec3> =
        (0..vest.mesh.positions.len()).map(|k| DVec3::new(0.02, 0.01 * (k as f64).sin(), 0.0) * size).collect();
    save("morph", points(&morph));
    dress(engine, [&vest, &source, &target], &morph, save);
    folder.to_path_buf()
}

/// The vest on the heavy body.
fn dress(engine: Engine, figures: [&Character; 3], morph: &[DVec3], save: impl Fn(&str, Vec<u8>)) {
    let [vest, source, target] = figures;
    let mut session = Session::new();
    session.set_options(Options::default()).expect("options");
    session.set_source_coordinate_system(CoordinateSystem { trusted: true, ..engine.system() }).expect("axes");
    session.set_target_coordinate_system(engine.system()).expect("axes");
    session.set_source_rig(rig(source)).expect("a rig");
    session.set_source_avatar(mesh(source)).expect("a body");
    session.set_source_skin(skin(source)).expect("a skin");
    session.set_target_rig(rig(target)).expect("a rig");
    session.set_target_avatar(mesh(target)).expect("a body");
    session.set_target_skin(skin(target)).expect("a skin");
    session.set_garment(mesh(vest), Precision::F32).expect("a garment");
    session.set_garment_skin(skin(vest)).expect("a skin");
    let offsets = morph.iter().map(|&offset| Precision::F32.round(offset)).collect();
    session.add_garment_morph(Morph { name: "wide".into(), offsets }).expect("a morph");
    session.run().expect("a result");
    save("dressed", points(&session.garment_as_read(Precision::F32).expect("a result")));
    save("dressed.morph", points(&session.garment_morph(0).expect("a morph")));
    let rows = session.garment_skin(INFLUENCES).expect("a skin");
    let vertices = 0..vest.mesh.positions.len();
    let mut rows: Vec<Vec<(u32, f64)>> = vertices.map(|v| rows.weights(v).to_vec()).collect();
    rows.iter_mut().for_each(|row| row.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0))));
    let numbers = |k: usize, row: &[(u32, f64)]| row.get(k).copied().unwrap_or((0, 0.0));
    let each = |number: &dyn Fn((u32, f64)) -> [u8; 4]| -> Vec<u8> {
        rows.iter().flat_map(|row| (0..INFLUENCES).flat_map(|k| number(numbers(k, row))).collect::<Vec<_>>()).collect()
    };
    save("dressed.joints", each(&|(joint, _)| joint.to_le_bytes()));
    save("dressed.weights", each(&|(_, weight)| (weight as f32).to_le_bytes()));
}

fn points(points: &[DVec3]) -> Vec<u8> {
    points.iter().flat_map(|p| p.as_vec3().to_array()).flat_map(f32::to_le_bytes).collect()
}

fn mesh(figure: &Character) -> TriangleMesh {
    let positions = figure.mesh.positions.iter().map(|&p| Precision::F32.round(p)).collect();
    TriangleMesh { positions, triangles: figure.mesh.triangles.clone() }
}

/// For each vertex as many joints with their weights.
fn padded(figure: &Character) -> Vec<[(u32, f32); INFLUENCES]> {
    let row = |row: &Vec<(usize, f64)>| {
        std::array::from_fn(|k| row.get(k).map_or((0, 0.0), |&(joint, weight)| (joint as u32, weight as f32)))
    };
    figure.influences.iter().map(row).collect()
}

fn skin(figure: &Character) -> SkinWeights {
    let known = |&(_, weight): &(u32, f32)| weight > 0.0;
    let row = |row: [(u32, f32); INFLUENCES]| {
        row.into_iter().filter(known).map(|(joint, weight)| (joint, f64::from(weight))).collect()
    };
    SkinWeights::from_rows(figure.joints.len(), padded(figure).into_iter().map(row))
}
