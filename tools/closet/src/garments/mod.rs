//! The six garments, each designed on the mannequin.

mod coat;
mod folds;
mod jumpsuit;
mod limb;
mod panels;
mod skirt;
mod sweater;
mod trousers;
mod upper;
mod vest;

use super::body;
use super::implicit::Field;
use super::mesh::Mesh;
use super::skeleton::Skeleton;
use super::texture::Texture;
use super::{Kind, Sample, shape};

/// A garment of the closet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Garment {
    /// Full body, tight.
    Jumpsuit,
    /// Quilted, with bulging rings and a collar.
    Coat,
    /// To the knees, flared, in folds.
    Skirt,
    /// With wrinkles at elbows and waist.
    Sweater,
    /// Without sleeves, with a V-neck.
    Vest,
    /// Two long legs.
    Trousers,
}

impl Garment {
    /// All of them, in the order of the gallery's rows.
    pub const ALL: [Self; 6] = [Self::Jumpsuit, Self::Coat, Self::Skirt, Self::Sweater, Self::Vest, Self::Trousers];

    /// A name for files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Jumpsuit => "jumpsuit",
            Self::Coat => "coat",
            Self::Skirt => "skirt",
            Self::Sweater => "sweater",
            Self::Vest => "vest",
            Self::Trousers => "trousers",
        }
    }
}

/// The body around which the garments are designed.
struct Mannequin {
    skeleton: Skeleton,
    body: Field,
}

/// A garment as its designer hands it over.
struct Piece {
    mesh: Mesh,
    texture: Texture,
    /// The vertices that hang or stand freely.
    no_fit: Vec<u32>,
}

/// Models a garment around the mannequin. The result depends on `garment` alone.
pub fn garment(garment: Garment) -> Sample {
    let design = match garment {
        Garment::Jumpsuit => jumpsuit::jumpsuit,
        Garment::Coat => coat::coat,
        Garment::Skirt => skirt::skirt,
        Garment::Sweater => sweater::sweater,
        Garment::Vest => vest::vest,
        Garment::Trousers => trousers::trousers,
    };
    designed(design)
}

/// The vest with its edge lengths times `coarseness`.
pub fn vest(coarseness: f64) -> Sample {
    designed(|mannequin| vest::with_edges(mannequin, coarseness))
}

fn designed(design: impl Fn(&Mannequin) -> Piece) -> Sample {
    let (proportions, build) = shape(Kind::Mannequin);
    let skeleton = proportions.skeleton();
    let body = body::body(&skeleton, &build);
    let mannequin = Mannequin { skeleton, body };
    let Piece { mesh, texture, no_fit } = design(&mannequin);
    Sample { mesh, skeleton: mannequin.skeleton, skin: Vec::new(), texture, no_fit }
}
