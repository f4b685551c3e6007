//! A garment and an avatar in two folders of files, and a session with them.

use std::fs;
use std::path::{Path, PathBuf};

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::session::{Options, Precision, Session};

use testing::obj::{read_mesh, read_skeleton, read_skin};

type Failure = Box<dyn std::error::Error>;

/// Two folders: `garment.obj`, `skeleton.obj` and perhaps `no-fit.txt`; `avatar.obj`, `skeleton.obj` and perhaps
/// `skin.txt`.
#[derive(Clone, Debug)]
pub struct Case {
    /// The garment's folder.
    pub garment: PathBuf,
    /// The avatar's folder.
    pub avatar: PathBuf,
}

impl Case {
    /// Every garment of a folder of real meshes on every avatar of it.
    pub fn pairs(assets: &Path) -> Vec<Self> {
        let avatars = folders(&assets.join("avatars"));
        let garments = folders(&assets.join("garments"));
        let on_all = |garment: PathBuf| {
            avatars.iter().map(move |avatar| Self { garment: garment.clone(), avatar: avatar.clone() })
        };
        garments.into_iter().flat_map(on_all).collect()
    }

    /// "garment avatar".
    pub fn name(&self) -> String {
        let last = |path: &Path| path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        format!("{} {}", last(&self.garment), last(&self.avatar))
    }
}

fn folders(parent: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(parent).into_iter().flatten().flatten();
    let mut folders: Vec<PathBuf> = entries.map(|e| e.path()).filter(|path| path.is_dir()).collect();
    folders.sort();
    folders
}

/// What a caller of the library has in memory, in 32 bits.
pub struct Inputs {
    /// As in the file.
    pub garment: TriangleMesh,
    /// The body to dress.
    pub avatar: TriangleMesh,
    /// The skeleton of the garment.
    pub source: Skeleton,
    /// That of the body.
    pub target: Skeleton,
    skin: Option<SkinWeights>,
    fit_weights: Option<Vec<f64>>,
}

impl Inputs {
    /// Reads the files of `case`. Panics on a mesh that is none.
    pub fn read(case: &Case) -> Result<Self, Failure> {
        let mut garment = read_mesh(&case.garment.join("garment.obj"));
        let mut avatar = read_mesh(&case.avatar.join("avatar.obj"));
        let (mut source, mut target) =
            (read_skeleton(&case.garment.join("skeleton.obj")), read_skeleton(&case.avatar.join("skeleton.obj")));
        for points in [&mut garment.positions, &mut avatar.positions, &mut source.joints, &mut target.joints] {
            points.iter_mut().for_each(|p| *p = Precision::F32.round(*p));
        }
        let skin = read_skin(&case.avatar.join("skin.txt"), target.joints.len(), avatar.positions.len());
        let fit_weights = match fs::read_to_string(case.garment.join("no-fit.txt")) {
            Ok(text) => {
                let mut weights = vec![1.0; garment.positions.len()];
                for word in text.split_whitespace() {
                    *weights.get_mut(word.parse::<usize>()?).ok_or("no-fit.txt: no such vertex")? = 0.0;
                }
                Some(weights)
            }
            Err(_) => None,
        };
        Ok(Self { garment, avatar, source, target, skin, fit_weights })
    }

    /// A session with all of it set.
    pub fn session(&self, options: Options) -> bespoke::error::Result<Session> {
        let mut session = Session::new();
        session.set_options(options)?;
        session.set_garment(self.garment.clone(), Precision::F32)?;
        session.set_source_skeleton(self.source.clone())?;
        session.set_target_avatar(self.avatar.clone())?;
        session.set_target_skeleton(self.target.clone())?;
        if let Some(skin) = &self.skin {
            session.set_target_skin(skin.clone())?;
        }
        if let Some(weights) = &self.fit_weights {
            session.set_vertex_fit_weights(weights.clone())?;
        }
        Ok(session)
    }
}
