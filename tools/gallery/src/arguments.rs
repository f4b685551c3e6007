//! The command line.

use std::path::PathBuf;
use std::str::FromStr;

use bespoke::options::Options;

use closet::avatars::Avatar;
use closet::garments::Garment;

/// How to call it.
pub const USAGE: &str = "usage: gallery [options]

  --garments LIST           names, separated by commas; default all
  --avatars LIST            the same for the bodies
  --out DIR                 where everything is written; default build/gallery
  --keep                    leave the dressed meshes as OBJ files in DIR/meshes
  --source-avatar           give the mannequin, so that garments aim at the clearance that they were designed with
  --threads N               threads of a session; default all cores
  --fit-weight X            these are options of the library; see the README
  --designed-clearance X
  --surface-weight X
  --curve-weight X
  --position-weight X
  --barrier-weight X
  --dhat X
  --voxel X
  --tolerance X
  --help";

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Arguments {
    pub garments: Vec<Garment>,
    pub avatars: Vec<Avatar>,
    pub out: PathBuf,
    pub keep: bool,
    pub source_avatar: bool,
    pub options: Options,
    pub help: bool,
}

impl Arguments {
    /// Reads them.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut read = Self {
            garments: Garment::ALL.to_vec(),
            avatars: Avatar::ALL.to_vec(),
            out: PathBuf::from("build/gallery"),
            keep: false,
            source_avatar: false,
            options: Options::default(),
            help: false,
        };
        let options = &mut read.options;
        while let Some(name) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{name} needs a value"));
            match name.as_str() {
                "--help" => read.help = true,
                "--keep" => read.keep = true,
                "--source-avatar" => read.source_avatar = true,
                "--garments" => read.garments = select(&value()?, &Garment::ALL, Garment::name, "garment")?,
                "--avatars" => read.avatars = select(&value()?, &Avatar::ALL, Avatar::name, "avatar")?,
                "--out" => read.out = value()?.into(),
                "--threads" => options.threads = number(&name, &value()?)?,
                "--fit-weight" => options.fit_weight = number(&name, &value()?)?,
                "--designed-clearance" => options.designed_clearance = number(&name, &value()?)?,
                "--surface-weight" => options.surface_weight = number(&name, &value()?)?,
                "--curve-weight" => {
                    options.curvature_weight = number(&name, &value()?)?;
                    options.torsion_weight = options.curvature_weight;
                }
                "--position-weight" => options.position_weight = number(&name, &value()?)?,
                "--barrier-weight" => options.barrier_weight = number(&name, &value()?)?,
                "--dhat" => options.dhat = number(&name, &value()?)?,
                "--voxel" => options.voxel_size = number(&name, &value()?)?,
                "--tolerance" => options.tolerance = number(&name, &value()?)?,
                _ => return Err(format!("{name} is no option")),
            }
        }
        options.check().map_err(|error| error.message)?;
        Ok(read)
    }
}

/// Those of `all` that `list` names, in the order of `all`.
fn select<T: Copy>(list: &str, all: &[T], name: fn(T) -> &'static str, what: &str) -> Result<Vec<T>, String> {
    let names: Vec<&str> = list.split(',').map(str::trim).collect();
    if let Some(other) = names.iter().find(|n| !all.iter().any(|&one| name(one) == **n)) {
        let known: Vec<&str> = all.iter().map(|&one| name(one)).collect();
        return Err(format!("there is no {what} {other:?}; there are {}", known.join(", ")));
    }
    Ok(all.iter().copied().filter(|&one| names.contains(&name(one))).collect())
}

fn number<T: FromStr>(name: &str, text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{name} {text}: that is no number"))
}
