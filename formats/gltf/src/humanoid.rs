//! The humanoid map of a VRM file: which node is which bone.

use crate::document::Document;
use crate::error::Result;

/// Version of the VRM extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vrm {
    /// Extension `VRM`: the character looks along -z of the file.
    Zero,
    /// Extension `VRMC_vrm`: it looks along +z.
    One,
}

/// Which node is which bone.
#[derive(Clone, Debug)]
pub struct Humanoid {
    /// By which extension.
    pub version: Vrm,
    /// Names of VRM 1 (`leftUpperArm`), also for VRM 0, which calls two bones of the thumb differently, with the node of each.
    pub bones: Vec<(String, usize)>,
}

impl Humanoid {
    /// Where the character looks.
    #[must_use]
    pub fn front(&self) -> [f64; 3] {
        match self.version {
            Vrm::Zero => [0.0, 0.0, -1.0],
            Vrm::One => [0.0, 0.0, 1.0],
        }
    }

    /// The bone that a node is.
    #[must_use]
    pub fn bone(&self, node: usize) -> Option<&str> {
        self.bones.iter().find(|(_, n)| *n == node).map(|(bone, _)| bone.as_str())
    }
}

/// The name in VRM 1 of a bone of VRM 0: the thumb begins with its metacarpal there.
fn of_one(bone: &str) -> String {
    let side = |rest: &str| match rest {
        "ThumbProximal" => "ThumbMetacarpal".to_owned(),
        "ThumbIntermediate" => "ThumbProximal".to_owned(),
        rest => rest.to_owned(),
    };
    for prefix in ["left", "right"] {
        if let Some(rest) = bone.strip_prefix(prefix) {
            return prefix.to_owned() + &side(rest);
        }
    }
    bone.to_owned()
}

impl Document {
    /// The humanoid map, where the file is VRM 1 or 0.
    ///
    /// # Errors
    /// Where it names a node that is none.
    pub fn humanoid(&self) -> Result<Option<Humanoid>> {
        let nodes = self.count("nodes")?;
        if let Some(bones) = self.root().extension("VRMC_vrm").and_then(|vrm| vrm.get("humanoid")?.get("humanBones")) {
            let mut found = Vec::new();
            let names = bones.value.as_object().ok_or_else(|| bones.error("is no object"))?;
            for name in names.keys() {
                let node = bones.need(name)?.need("node")?.index_into("nodes", nodes)?;
                found.push((name.clone(), node));
            }
            return Ok(Some(Humanoid { version: Vrm::One, bones: found }));
        }
        let Some(humanoid) = self.root().extension("VRM").and_then(|vrm| vrm.get("humanoid")) else { return Ok(None) };
        let mut found = Vec::new();
        for bone in humanoid.list_of("humanBones")? {
            // Bones that a character lacks are listed as -1.
            let node = bone.need("node")?;
            if node.value.as_f64() == Some(-1.0) {
                continue;
            }
            found.push((of_one(bone.need("bone")?.text()?), node.index_into("nodes", nodes)?));
        }
        Ok(Some(Humanoid { version: Vrm::Zero, bones: found }))
    }
}
