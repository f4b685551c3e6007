//! What a batch is to do: outfits, avatars, and where the results go.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::failure::{Failure, Result};
use crate::obj;

/// An outfit. All but the file is as in `bespoke dress`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outfit {
    /// GLB, glTF, VRM or OBJ.
    pub file: PathBuf,
    /// What it is called in the names of results; the file's without its ending where it is not said.
    #[serde(default)]
    pub name: String,
    /// `--source-skeleton`.
    pub skeleton: Option<PathBuf>,
    /// `--garment-skin`.
    pub skin: Option<PathBuf>,
    /// `--source-skin`.
    pub source_skin: Option<PathBuf>,
    /// `--source-space`.
    pub space: Option<String>,
    /// `--nodes`.
    pub nodes: Option<String>,
    /// `--source`.
    pub source: Option<PathBuf>,
    /// `--source-nodes`.
    pub source_nodes: Option<String>,
    /// `--map`.
    pub map: Option<PathBuf>,
}

/// An avatar.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Avatar {
    /// GLB, glTF, VRM or OBJ.
    pub file: PathBuf,
    /// As that of an outfit.
    #[serde(default)]
    pub name: String,
    /// `--target-skeleton`.
    pub skeleton: Option<PathBuf>,
    /// `--target-skin`.
    pub skin: Option<PathBuf>,
    /// `--target-space`.
    pub space: Option<String>,
    /// `--avatar-nodes`.
    pub nodes: Option<String>,
}

/// Options for all pairs, by their names in `bespoke dress`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dials {
    /// `--fit`.
    pub fit: Option<f64>,
    /// `--offset`.
    pub offset: Option<f64>,
    /// `--looseness`.
    pub looseness: Option<f64>,
    /// `--influences`.
    pub influences: Option<u32>,
    /// `--keep`.
    pub keep: Option<String>,
}

/// A manifest, with its paths from its own folder.
#[derive(Clone, Debug)]
pub struct Manifest {
    /// What is worn.
    pub outfits: Vec<Outfit>,
    /// Who wears it.
    pub avatars: Vec<Avatar>,
    output: String,
    dials: Dials,
    folder: PathBuf,
}

/// An outfit on an avatar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// "suit on hero".
    pub name: String,
    /// Name of the outfit.
    pub outfit: String,
    /// The avatar's file and nodes: pairs in which they are the same share it.
    pub avatar: String,
    /// Files whose change makes the result an old one.
    pub inputs: Vec<PathBuf>,
    /// Where the result goes.
    pub output: PathBuf,
    /// What follows on `bespoke dress`, but for the report and what is said.
    pub arguments: Vec<String>,
}

impl Manifest {
    /// Reads a manifest.
    ///
    /// # Errors
    /// Where it cannot be read, or says something that is not known.
    pub fn read(file: &Path) -> Result<Self> {
        let fail = |why: String| Failure::usage(format!("{}: {why}", file.display()));
        let text = std::fs::read_to_string(file).map_err(|e| fail(format!("it cannot be read: {e}")))?;
        let value: Value = serde_json::from_str(&text).map_err(|e| fail(format!("it is not JSON: {e}")))?;
        let Value::Object(mut all) = value else {
            return Err(fail("it has to be an object with outfits, avatars and output".into()));
        };
        let outfits = entries(&mut all, "outfits").map_err(fail)?;
        let avatars = entries(&mut all, "avatars").map_err(fail)?;
        let output = match all.remove("output") {
            Some(Value::String(output)) if output.contains("{outfit}") && output.contains("{avatar}") => output,
            _ => {
                return Err(fail(
                    "output has to be a path with {outfit} and {avatar} in it, such as \"dressed/{outfit}-on-{avatar}.glb\""
                        .into(),
                ));
            }
        };
        let dials = match all.remove("options") {
            Some(options) => serde_json::from_value(options).map_err(|e| fail(format!("options: {e}")))?,
            None => Dials::default(),
        };
        if let Some(other) = all.keys().next() {
            return Err(fail(format!("{other} is not known; there are outfits, avatars, output and options")));
        }
        let folder = file.parent().map(Path::to_path_buf).unwrap_or_default();
        let mut manifest = Self { outfits, avatars, output, dials, folder };
        manifest.outfits.iter_mut().for_each(|outfit| name(&mut outfit.name, &outfit.file));
        manifest.avatars.iter_mut().for_each(|avatar| name(&mut avatar.name, &avatar.file));
        Ok(manifest)
    }

    /// Every outfit on every avatar, one outfit after the other.
    ///
    /// # Errors
    /// Where two results would go to one file.
    pub fn pairs(&self) -> Result<Vec<Pair>> {
        let on = |outfit| self.avatars.iter().map(move |avatar| self.pair(outfit, avatar));
        let pairs: Vec<Pair> = self.outfits.iter().flat_map(on).collect();
        let mut names = HashMap::new();
        for pair in &pairs {
            if let Some(other) = names.insert(&pair.output, &pair.name) {
                return Err(Failure::usage(format!(
                    "the results of {other} and of {} both go to {}; give one of them another name",
                    pair.name,
                    pair.output.display()
                )));
            }
        }
        Ok(pairs)
    }

    fn pair(&self, outfit: &Outfit, avatar: &Avatar) -> Pair {
        let path = |file: &Path| self.folder.join(file);
        let named = [
            ("--source", &outfit.source),
            ("--map", &outfit.map),
            ("--source-skeleton", &outfit.skeleton),
            ("--garment-skin", &outfit.skin),
            ("--source-skin", &outfit.source_skin),
            ("--target-skeleton", &avatar.skeleton),
            ("--target-skin", &avatar.skin),
        ];
        let named = || named.iter().filter_map(|(option, file)| Some((*option, path(file.as_deref()?))));
        let meshes: Vec<PathBuf> = [Some(&outfit.file), Some(&avatar.file), outfit.source.as_ref()]
            .into_iter()
            .flatten()
            .map(|file| path(file))
            .collect();
        let output = path(Path::new(&self.output.replace("{outfit}", &outfit.name).replace("{avatar}", &avatar.name)));
        let text = |path: PathBuf| path.to_string_lossy().into_owned();
        let mut arguments = vec![text(path(&outfit.file)), text(path(&avatar.file)), "-o".into(), text(output.clone())];
        let dials = &self.dials;
        let number = |value: Option<f64>| value.map(|value| value.to_string());
        for (option, value) in [
            ("--nodes", outfit.nodes.clone()),
            ("--source-nodes", outfit.source_nodes.clone()),
            ("--avatar-nodes", avatar.nodes.clone()),
            ("--source-space", outfit.space.clone()),
            ("--target-space", avatar.space.clone()),
            ("--fit", number(dials.fit)),
            ("--offset", number(dials.offset)),
            ("--looseness", number(dials.looseness)),
            ("--influences", dials.influences.map(|n| n.to_string())),
            ("--keep", dials.keep.clone()),
        ] {
            // In one word: a value may begin with a dash.
            arguments.extend(value.map(|value| format!("{option}={value}")));
        }
        arguments.extend(named().map(|(option, file)| format!("{option}={}", file.display())));
        Pair {
            name: format!("{} on {}", outfit.name, avatar.name),
            outfit: outfit.name.clone(),
            avatar: format!("{}\0{}", avatar.file.display(), avatar.nodes.as_deref().unwrap_or_default()),
            inputs: meshes
                .iter()
                .cloned()
                .chain(named().map(|(_, file)| file).filter(|file| !meshes.contains(file)))
                .chain(meshes.iter().flat_map(|file| obj::neighbours(file)))
                .collect(),
            output,
            arguments,
        }
    }
}

/// The list of that name; an entry that is a text is a file.
fn entries<T: DeserializeOwned>(all: &mut Map<String, Value>, list: &str) -> Result<Vec<T>, String> {
    let Some(Value::Array(entries)) = all.remove(list) else {
        return Err(format!("{list} has to be a list of files, or of objects with \"file\" in them"));
    };
    let read = |(k, entry): (usize, Value)| {
        let entry = match entry {
            Value::String(file) => serde_json::json!({ "file": file }),
            other => other,
        };
        serde_json::from_value(entry).map_err(|e| format!("{list}, entry {}: {e}", k + 1))
    };
    let read: Vec<T> = entries.into_iter().enumerate().map(read).collect::<Result<_, _>>()?;
    if read.is_empty() { Err(format!("{list} is empty")) } else { Ok(read) }
}

fn name(name: &mut String, file: &Path) {
    if name.is_empty() {
        *name = file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    }
}
