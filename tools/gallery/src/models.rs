//! The garments and the bodies that are asked for, modelled.

use rayon::prelude::*;

use crate::pair::Outcome;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::{Kind, Sample, sample};

/// Models, in the order of the gallery.
pub struct Closet {
    /// The body that the garments are designed on.
    pub mannequin: Sample,
    /// As they were designed.
    pub garments: Vec<(Garment, Sample)>,
    /// The bodies to dress.
    pub avatars: Vec<(Avatar, Sample)>,
}

impl Closet {
    /// Models the mannequin and what is listed, on all cores.
    pub fn new(garments: &[Garment], avatars: &[Avatar]) -> Self {
        let ((garments, avatars), mannequin) = rayon::join(
            || {
                rayon::join(
                    || garments.par_iter().map(|&g| (g, garment(g))).collect(),
                    || avatars.par_iter().map(|&a| (a, avatar(a))).collect(),
                )
            },
            || sample(Kind::Mannequin),
        );
        Self { mannequin, garments, avatars }
    }

    /// The garment and the body of `outcome`, which has to be of this closet.
    pub fn samples(&self, outcome: &Outcome) -> (&Sample, &Sample) {
        let worn = self.garments.iter().find(|(garment, _)| garment.name() == outcome.garment);
        let body = self.avatars.iter().find(|(avatar, _)| avatar.name() == outcome.avatar);
        match (worn, body) {
            (Some((_, worn)), Some((_, body))) => (worn, body),
            _ => panic!("{} on {} is of another closet", outcome.garment, outcome.avatar),
        }
    }
}
