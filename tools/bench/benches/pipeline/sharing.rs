//! What sessions that share an avatar or a garment cost, beside those that do not.

use std::collections::HashMap;

use bespoke::control::Stage;
use bespoke::error::Result;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::session::{Options, Precision, Session};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::BONES;
use closet::{Kind, Sample, sample};
use serde::Serialize;

use crate::cpu::own_seconds;
use crate::table;

type Failure = Box<dyn std::error::Error>;

/// The bits of a result, or why there is none.
type Outcome = std::result::Result<Vec<u64>, String>;

/// A row or a column of the closet.
#[derive(Clone, Debug, Serialize)]
pub struct Sharing {
    what: String,
    pairs: usize,
    /// User CPU seconds of all its pairs with one thread, each by itself and sharing: sums of the least of each pair.
    seconds: [f64; 2],
}

/// One sample as a caller has it.
struct Model {
    mesh: TriangleMesh,
    skeleton: Skeleton,
    skin: Option<SkinWeights>,
    no_fit: Vec<u32>,
}

impl Model {
    fn new(sample: &Sample) -> Self {
        let mut positions = sample.mesh.positions.clone();
        positions.iter_mut().for_each(|p| *p = Precision::F32.round(*p));
        let rows = (0..positions.len()).map(|v| {
            let of = |joint: usize| (joint as u32, sample.skin[joint][v]);
            (0..sample.skin.len()).map(of).filter(|(_, weight)| *weight > 0.0).collect::<Vec<_>>()
        });
        let skin = (!sample.skin.is_empty()).then(|| SkinWeights::from_rows(sample.skin.len(), rows));
        Self {
            skin,
            mesh: TriangleMesh { positions, triangles: sample.mesh.triangles.clone() },
            skeleton: Skeleton {
                joints: sample.skeleton.joints.iter().map(|&p| Precision::F32.round(p)).collect(),
                bones: BONES.to_vec(),
            },
            no_fit: sample.no_fit.clone(),
        }
    }

    fn set_as_garment(&self, session: &mut Session, source: &Self) -> Result<()> {
        session.set_garment(self.mesh.clone(), Precision::F32)?;
        session.set_source_skeleton(self.skeleton.clone())?;
        session.set_source_avatar(source.mesh.clone())?;
        let mut weights = vec![1.0; self.mesh.positions.len()];
        self.no_fit.iter().for_each(|&v| weights[v as usize] = 0.0);
        session.set_vertex_fit_weights(weights)
    }

    fn set_as_avatar(&self, session: &mut Session) -> Result<()> {
        session.set_target_avatar(self.mesh.clone())?;
        session.set_target_skeleton(self.skeleton.clone())?;
        self.skin.clone().map_or(Ok(()), |skin| session.set_target_skin(skin))
    }
}

impl Sharing {
    /// Measures two avatars with all garments, and one garment on all avatars, `runs` times. Each pair is dressed by itself and sharing
    /// right after each other, so that both have the same noise.
    pub fn measure(runs: usize) -> std::result::Result<Vec<Self>, Failure> {
        let source = Model::new(&sample(Kind::Mannequin));
        let garments: Vec<Model> = Garment::ALL.iter().map(|&it| Model::new(&garment(it))).collect();
        let avatars: Vec<Model> = Avatar::ALL.iter().map(|&it| Model::new(&avatar(it))).collect();
        let named = |name: &str| Avatar::ALL.iter().position(|avatar| avatar.name() == name).unwrap_or(0);
        let (heavy, tall) = (named("heavy"), named("tall"));
        let garment_name = |k: usize| Garment::ALL[k].name();
        let on = |avatar: usize| (0..garments.len()).map(|garment| (garment, avatar)).collect::<Vec<_>>();
        let of = |garment: usize| (0..avatars.len()).map(|avatar| (garment, avatar)).collect::<Vec<_>>();
        let mut measured = Vec::new();
        for (what, pairs) in [
            (format!("{} x all garments", Avatar::ALL[heavy].name()), on(heavy)),
            (format!("{} x all garments", Avatar::ALL[tall].name()), on(tall)),
            (format!("{} x all avatars", garment_name(0)), of(0)),
        ] {
            let mut least = vec![[f64::INFINITY; 2]; pairs.len()];
            for _ in 0..runs.max(1) {
                let closet = Closet { source: &source, garments: &garments, avatars: &avatars };
                let (mut shared_garments, mut shared_avatars) = (HashMap::new(), HashMap::new());
                for (&(garment, avatar), least) in pairs.iter().zip(&mut least) {
                    let by_itself = closet.dress(garment, avatar, |_| Ok(()))?;
                    let sharing = closet.dress(garment, avatar, |session| {
                        let known = shared_garments.entry(garment).or_insert(session.share_garment()?);
                        session.use_garment(known)?;
                        let known = shared_avatars.entry(avatar).or_insert(session.share_avatar()?);
                        session.use_avatar(known)
                    })?;
                    if by_itself.1 != sharing.1 {
                        return Err(format!("{what}: the results of pair {garment}, {avatar} differ").into());
                    }
                    *least = [least[0].min(by_itself.0), least[1].min(sharing.0)];
                }
            }
            let seconds = [0, 1].map(|way| least.iter().map(|least| least[way]).sum());
            measured.push(Self { what, pairs: pairs.len(), seconds });
        }
        Ok(measured)
    }
}

struct Closet<'a> {
    source: &'a Model,
    garments: &'a [Model],
    avatars: &'a [Model],
}

impl Closet<'_> {
    /// User seconds of a pair, whose session is told by `share` what it shares, and the bits of the result or why there is none.
    fn dress(
        &self,
        garment: usize,
        avatar: usize,
        share: impl FnOnce(&mut Session) -> Result<()>,
    ) -> std::result::Result<(f64, Outcome), Failure> {
        let begun = own_seconds()?;
        let mut session = Session::new();
        session.set_options(Options { threads: 1, ..Options::default() })?;
        self.garments[garment].set_as_garment(&mut session, self.source)?;
        self.avatars[avatar].set_as_avatar(&mut session)?;
        share(&mut session)?;
        let outcome = match session.run() {
            Ok(Stage::Done) => Ok(bits(&session)?),
            Ok(stage) => Err(format!("{stage:?}")),
            Err(error) => Err(error.message),
        };
        Ok((own_seconds()? - begun, outcome))
    }
}

fn bits(session: &Session) -> Result<Vec<u64>> {
    Ok(session.garment_positions()?.iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect())
}

/// Prints them.
pub fn print(measured: &[Sharing]) {
    let row = |m: &Sharing| {
        let [single, shared] = m.seconds;
        let cells = [m.pairs.to_string(), format!("{single:.2}"), format!("{shared:.2}")];
        [vec![m.what.clone()], cells.to_vec(), vec![format!("{:.3}", shared / single)]].concat()
    };
    table::print(
        "Sharing: user CPU seconds of single sessions and of those that share, one thread",
        1,
        &["closet", "pairs", "single", "shared", "ratio"],
        &measured.iter().map(row).collect::<Vec<_>>(),
    );
}
