//! What the meshes of a character's file are: body, hair, garments, props. By the names of nodes and materials, for that is
//! where their makers say it; what a name does not say follows from the other parts of the file.

pub mod garments;
pub mod pattern;
mod words;

use std::fmt;

use words::{Said, said, words};

/// What a part of a character is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// The body's own surface, eyes and teeth included.
    Body,
    /// Hair and beards.
    Hair,
    /// What is worn.
    Garment,
    /// What is held or carried: no garment goes around it, and it is fitted to nothing.
    Prop,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Body => "body",
            Self::Hair => "hair",
            Self::Garment => "garment",
            Self::Prop => "prop",
        })
    }
}

/// The names of a part, and how it hangs in its file.
#[derive(Clone, Debug, Default)]
pub struct Named<'a> {
    /// Of its node.
    pub node: &'a str,
    /// Of its material.
    pub material: &'a str,
    /// The joint that it hangs on without skin weights, if it does.
    pub hangs_on: Option<&'a str>,
    /// Whether this program has put it on: then it is a garment, whatever its names say.
    pub is_put_on: bool,
}

/// What the file is to the command: it decides about parts whose names say nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It brings the outfit: what no name explains is worn, unless it is all there is beside garments.
    Outfit,
    /// It is dressed: what no name explains is body.
    Avatar,
}

/// What a part is, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sorted {
    /// What it is.
    pub kind: Kind,
    /// In words, for `inspect`.
    pub reason: String,
    /// The name of its material says it.
    pub by_material: bool,
}

/// What each of `parts` is.
pub fn sort(parts: &[Named], role: Role) -> Vec<Sorted> {
    let common = common_first_word(parts);
    let spoken: Vec<_> = parts.iter().map(|part| Spoken::of(part, common.as_deref())).collect();
    let names_skin = spoken.iter().any(|s| s.material == Said::Skin || s.node == Said::Skin);
    let put_on = |part: &Named| {
        let reason = "bespoke has put it on".to_string();
        part.is_put_on.then_some(Sorted { kind: Kind::Garment, reason, by_material: false })
    };
    let firm: Vec<_> = parts.iter().zip(&spoken).map(|(part, s)| put_on(part).or_else(|| s.kind(names_skin))).collect();
    let has = |kind: Kind| firm.iter().flatten().any(|sorted| sorted.kind == kind);
    let rest = match role {
        Role::Outfit if has(Kind::Body) || !has(Kind::Garment) => Sorted {
            kind: Kind::Garment,
            reason: "no name says what it is, and the file brings an outfit".into(),
            by_material: false,
        },
        Role::Outfit => Sorted {
            kind: Kind::Body,
            reason: "no name says what it is, and others are garments".into(),
            by_material: false,
        },
        Role::Avatar => {
            Sorted { kind: Kind::Body, reason: "no name says that it is anything else".into(), by_material: false }
        }
    };
    firm.into_iter().map(|sorted| sorted.unwrap_or_else(|| rest.clone())).collect()
}

/// The names of one part, read.
struct Spoken {
    material: Said,
    node: Said,
    /// The words that said it, material's and node's.
    by: [String; 2],
    /// The joint of a hand or a slot for props that it hangs on.
    slot: Option<String>,
}

impl Spoken {
    fn of(part: &Named, common: Option<&str>) -> Self {
        let mut node_words = words(part.node);
        if node_words.first().map(String::as_str) == common && node_words.len() > 1 {
            node_words.remove(0);
        }
        let material_words = words(part.material);
        let (material, by_material) = said(&material_words);
        let (node, by_node) = said(&node_words);
        let is_slot = |joint: &&str| {
            let words = words(joint);
            words
                .iter()
                .any(|w| ["slot", "handslot", "prop", "weapon", "holder", "socket", "attach"].contains(&w.as_str()))
        };
        Self {
            material,
            node,
            by: [by_material.to_string(), by_node.to_string()],
            slot: part.hangs_on.filter(is_slot).map(str::to_string),
        }
    }

    /// What the part is, as far as its own names and those of the whole file say. Materials are nearer to a surface than
    /// nodes, which may hold several; where a file names its skin, other materials of a region cover it.
    fn kind(&self, names_skin: bool) -> Option<Sorted> {
        let sorted = |kind, reason: String| {
            let by_material = reason.starts_with("material");
            Some(Sorted { kind, reason, by_material })
        };
        if let Some(slot) = &self.slot {
            return sorted(Kind::Prop, format!("it hangs on '{slot}'"));
        }
        let [material, node] = &self.by;
        match (self.material, self.node) {
            // Glass and metal are named so on garments too: of a thing that is carried the node must not say otherwise.
            (Said::Known(Kind::Prop), Said::Known(kind)) if kind != Kind::Prop => sorted(kind, format!("node: {node}")),
            (Said::Known(kind), _) => sorted(kind, format!("material: {material}")),
            (Said::Skin, _) => sorted(Kind::Body, format!("material: {material}")),
            (_, Said::Known(kind)) => sorted(kind, format!("node: {node}")),
            (_, Said::Skin) => sorted(Kind::Body, format!("node: {node}")),
            (Said::Region, _) | (_, Said::Region) => {
                let word = if self.node == Said::Region { node } else { material };
                if names_skin && self.material != Said::Region {
                    sorted(
                        Kind::Garment,
                        format!("node: {word}, in a file that names its skin, and this is another material"),
                    )
                } else {
                    sorted(
                        Kind::Body,
                        format!("{}: {word}", if self.node == Said::Region { "node" } else { "material" }),
                    )
                }
            }
            (Said::Nothing, Said::Nothing) => None,
        }
    }
}

/// The word with which the names of at least half of the nodes begin: that of the character, not of the part.
fn common_first_word(parts: &[Named]) -> Option<String> {
    let mut nodes: Vec<&str> = parts.iter().map(|part| part.node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let firsts: Vec<String> = nodes.iter().filter_map(|node| words(node).into_iter().next()).collect();
    let shares = |word: &String| firsts.iter().filter(|other| *other == word).count();
    firsts.iter().find(|word| nodes.len() > 1 && 2 * shares(word) >= nodes.len() && shares(word) > 1).cloned()
}
