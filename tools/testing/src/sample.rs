//! The jacket and the heavy body of the sample, as files for the programs and dressed here.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, OnceLock};

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::obj_text::obj;
use crate::process::{scratch, this_program_name};
use closet::mesh::Mesh;
use closet::skeleton::BONES;
use closet::{Kind, Sample, sample};

static JACKET: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Jacket));
static HEAVY: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Heavy));
static MANNEQUIN: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Mannequin));

/// A folder with arrays of 32-bit numbers: all inputs of `make demo`, and what they give here.
pub fn folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = scratch(&format!("{}-sample", this_program_name()));
        let write =
            |name: &str, bytes: Vec<u8>| fs::write(folder.join(name), bytes).expect("the folder can be written");
        write("garment.positions", points(&JACKET.mesh.positions));
        write("garment.triangles", indices(&JACKET.mesh.triangles));
        write("avatar.positions", points(&HEAVY.mesh.positions));
        write("avatar.triangles", indices(&HEAVY.mesh.triangles));
        write("source.positions", points(&MANNEQUIN.mesh.positions));
        write("source.triangles", indices(&MANNEQUIN.mesh.triangles));
        write("source.joints", points(&JACKET.skeleton.joints));
        write("target.joints", points(&HEAVY.skeleton.joints));
        write("bones", indices(&BONES));
        write("skin", HEAVY.skin.iter().flatten().flat_map(|&w| (w as f32).to_le_bytes()).collect());
        write("no_fit", JACKET.no_fit.iter().flat_map(|v| v.to_le_bytes()).collect());
        write("dressed", dressed().iter().flat_map(|x| x.to_le_bytes()).collect());
        folder
    })
}

fn points(points: &[DVec3]) -> Vec<u8> {
    points.iter().flat_map(|p| p.as_vec3().to_array()).flat_map(f32::to_le_bytes).collect()
}

fn indices<const N: usize>(elements: &[[u32; N]]) -> Vec<u8> {
    elements.iter().flatten().flat_map(|v| v.to_le_bytes()).collect()
}

/// As somebody reads it who stores 32-bit positions.
fn mesh(mesh: &Mesh) -> TriangleMesh {
    let positions = mesh.positions.iter().map(|&p| Precision::F32.round(p)).collect();
    TriangleMesh { positions, triangles: mesh.triangles.clone() }
}

fn skeleton(sample: &Sample) -> Skeleton {
    let joints = sample.skeleton.joints.iter().map(|&p| Precision::F32.round(p)).collect();
    Skeleton { joints, bones: BONES.to_vec() }
}

fn session() -> Session {
    let mut session = Session::new();
    session.set_garment(mesh(&JACKET.mesh), Precision::F32).expect("a garment");
    session.set_source_skeleton(skeleton(&JACKET)).expect("a skeleton");
    session.set_target_avatar(mesh(&HEAVY.mesh)).expect("a body");
    session.set_target_skeleton(skeleton(&HEAVY)).expect("a skeleton");
    session
}

fn result(mut session: Session) -> Vec<f32> {
    session.run().expect("a result");
    let read = session.garment_as_read(Precision::F32).expect("a result");
    read.into_iter().flat_map(|p| p.as_vec3().to_array()).collect()
}

/// The jacket on the heavy body with all optional inputs: x, y, z of each vertex.
fn dressed() -> Vec<f32> {
    let mut session = session();
    session.set_source_avatar(mesh(&MANNEQUIN.mesh)).expect("a body");
    let rows: Vec<f64> = HEAVY.skin.iter().flatten().map(|&w| f64::from(w as f32)).collect();
    let vertices = HEAVY.mesh.positions.len();
    let skin = SkinWeights::from_dense(&rows, HEAVY.skin.len(), vertices, "skin weights").expect("skin weights");
    session.set_target_skin(skin).expect("skin weights");
    let mut weights = vec![1.0; JACKET.mesh.positions.len()];
    JACKET.no_fit.iter().for_each(|&v| weights[v as usize] = 0.0);
    session.set_vertex_fit_weights(weights).expect("fit weights");
    result(session)
}

/// The same without the optional inputs.
pub fn plainly_dressed() -> Vec<f32> {
    result(session())
}

/// Garment, source skeleton, avatar and target skeleton as OBJ files; every 32-bit number survives.
pub fn write_obj(folder: &Path) -> Vec<PathBuf> {
    let rounded = |points: &[DVec3]| -> Vec<_> { points.iter().map(|p| p.as_vec3().to_array()).collect() };
    let mesh = |mesh: &Mesh| obj(&rounded(&mesh.positions), &mesh.triangles, &[]);
    let bones = |sample: &Sample| obj(&rounded(&sample.skeleton.joints), &[], &BONES);
    let files = [
        ("garment.obj", mesh(&JACKET.mesh)),
        ("source.obj", bones(&JACKET)),
        ("avatar.obj", mesh(&HEAVY.mesh)),
        ("target.obj", bones(&HEAVY)),
    ];
    let write = |(name, text)| {
        let path = folder.join(name);
        fs::write(&path, text).map(|()| path).expect("the folder can be written")
    };
    files.into_iter().map(write).collect()
}

/// What the program `retarget` is told to dress it: the files of [`write_obj`] with their options.
pub fn words(folder: &Path) -> Vec<String> {
    let options = ["--garment", "--source-skeleton", "--avatar", "--target-skeleton"];
    let files = write_obj(folder).into_iter().map(|file| file.display().to_string());
    options.into_iter().map(str::to_owned).zip(files).flat_map(|(option, file)| [option, file]).collect()
}
