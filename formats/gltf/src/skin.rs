//! Skins: which nodes are joints of a mesh, and where they were when it was bound to them.

use glam::DAffine3;

use crate::document::Document;
use crate::error::Result;
use crate::nodes::{Matrix, columns, from_sixteen};
use crate::reader::Reader;

/// A skin.
#[derive(Clone, Debug)]
pub struct Skin {
    /// Empty where it has none.
    pub name: String,
    /// The nodes that JOINTS_n counts.
    pub joints: Vec<usize>,
    /// For each, from the mesh's space to its own, in the bind pose.
    pub inverse_binds: Vec<Matrix>,
    /// The node that the file names as the top of the skeleton.
    pub skeleton: Option<usize>,
}

impl Document {
    /// The skins of the file. Where one has no bind matrices, they are the identity, as glTF says.
    ///
    /// # Errors
    /// Where an index is none, matrices are missing or not affine.
    pub fn skins(&self) -> Result<Vec<Skin>> {
        let reader = Reader::new(self);
        let (nodes, accessors) = (self.count("nodes")?, self.count("accessors")?);
        let mut skins = Vec::new();
        for at in self.root().list_of("skins")? {
            let joints_at = at.need("joints")?;
            let joints: Vec<usize> =
                joints_at.list()?.map(|joint| joint.index_into("nodes", nodes)).collect::<Result<_>>()?;
            if joints.is_empty() {
                return Err(joints_at.error("is empty"));
            }
            let mut seen = std::collections::HashMap::new();
            for (k, joint) in joints.iter().enumerate() {
                if let Some(first) = seen.insert(joint, k) {
                    return Err(joints_at.error(format!("joints {first} and {k} are one node, {joint}")));
                }
            }
            let matrices: Vec<DAffine3> = match at.index("inverseBindMatrices", "accessors", accessors)? {
                None => vec![DAffine3::IDENTITY; joints.len()],
                Some(accessor) => {
                    let rows = reader.numbers::<16>(accessor)?;
                    let matrix = |(k, row): (usize, &[f64; 16])| {
                        let message = || at.error(format!("the bind matrix of joint {k} is not affine"));
                        from_sixteen(row).ok_or_else(message)
                    };
                    rows.iter().enumerate().map(matrix).collect::<Result<_>>()?
                }
            };
            if matrices.len() < joints.len() {
                return Err(at.error(format!("{} joints and {} bind matrices", joints.len(), matrices.len())));
            }
            skins.push(Skin {
                name: at.text_of("name").to_owned(),
                inverse_binds: matrices[..joints.len()].iter().map(columns).collect(),
                joints,
                skeleton: at.index("skeleton", "nodes", nodes)?,
            });
        }
        Ok(skins)
    }
}
