//! A real pair of garment and body, as it lies in a folder of its own.
//!
//! A folder has `garment.obj`, `source_skeleton.obj`, `avatar.obj`, its skeleton as `target_skeleton.obj` or `skeleton.obj`,
//! and may have `source_avatar.obj` and `skin.txt`; y is up, the front towards +z.

use std::path::Path;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use testing::obj::{read_mesh, read_skeleton, read_skin};

/// A garment and the body to dress.
pub struct Pair {
    /// The folder's name, as words.
    pub name: String,
    /// As designed.
    pub garment: TriangleMesh,
    /// On the body on which it was designed.
    pub source_skeleton: Skeleton,
    /// That body.
    pub source_avatar: Option<TriangleMesh>,
    /// To dress.
    pub avatar: TriangleMesh,
    /// Its skeleton, with the joints of the source's.
    pub skeleton: Skeleton,
    /// Its weights on these joints.
    pub skin: Option<SkinWeights>,
}

impl Pair {
    /// None where the folder holds none.
    pub fn read(folder: &Path) -> Option<Self> {
        let file = |name: &str| Some(folder.join(name)).filter(|path| path.is_file());
        let mesh = |name: &str| file(name).map(|path| read_mesh(&path));
        let avatar = mesh("avatar.obj")?;
        let skeleton = read_skeleton(&file("target_skeleton.obj").or_else(|| file("skeleton.obj"))?);
        Some(Self {
            name: folder.file_name()?.to_string_lossy().replace('-', " "),
            garment: mesh("garment.obj")?,
            source_skeleton: read_skeleton(&file("source_skeleton.obj")?),
            source_avatar: mesh("source_avatar.obj"),
            skin: read_skin(&folder.join("skin.txt"), skeleton.joints.len(), avatar.positions.len()),
            avatar,
            skeleton,
        })
    }
}
