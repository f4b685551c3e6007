//! What the Godot add-on repeats of the header: the raw layer, the constants of its class, and texts for the editor.

mod constants;
mod native;
mod words;

use crate::description::{Description, Enum, Member};
use crate::prose::{self, Names};
use crate::{MARK, Result};

/// Enums whose numbers are constants of the class, with what their names begin with there.
const PUBLIC: &[(&str, &str)] = &[
    ("BespokeStatus", "STATUS"),
    ("BespokeStage", "STAGE"),
    ("BespokeSeverity", "SEVERITY"),
    ("BespokeDiagnosticKind", "KIND"),
    ("BespokeSubject", "SUBJECT"),
    ("BespokeElementKind", "ELEMENT"),
    ("BespokePartRole", "ROLE"),
    ("BespokeJointReason", "REASON"),
];

/// Names and texts of all files.
pub fn files(description: &Description) -> Result<Vec<(&'static str, String)>> {
    Ok(vec![
        ("native.rs", native::text(description)?),
        ("constants.rs", constants::text(description)?),
        ("words.rs", words::text(description)?),
    ])
}

/// The beginning of a file.
fn head(about: &str) -> String {
    format!("// {MARK}\n{}\n", prose::wrap(about, 116).iter().map(|line| format!("//! {line}\n")).collect::<String>())
}

/// The enums that are public, with their prefixes.
fn public(description: &Description) -> Result<Vec<(&Enum, &'static str)>> {
    let find = |name: &str| description.enums.iter().find(|one| one.name == name);
    PUBLIC.iter().map(|&(name, prefix)| Ok((find(name).ok_or(format!("the header has no {name}"))?, prefix))).collect()
}

/// A comment of the header in the words of the class.
fn words(text: &str, description: &Description) -> String {
    prose::translate(text, description, &Words)
}

struct Words;

impl Names for Words {
    fn member(&self, one: &Enum, member: &Member) -> String {
        match PUBLIC.iter().find(|(name, _)| *name == one.name) {
            Some((_, prefix)) => format!("{prefix}_{}", one.short(member)),
            None => one.short(member).to_string(),
        }
    }

    fn enumeration(&self, name: &str) -> String {
        match PUBLIC.iter().find(|(other, _)| *other == name) {
            Some((_, prefix)) => format!("{prefix}_*"),
            None => name.to_string(),
        }
    }

    fn structure(&self, name: &str) -> String {
        match name {
            "BespokeOptions" => "the options".to_string(),
            "BespokeReport" => "the report".to_string(),
            _ => name.to_string(),
        }
    }

    fn function(&self, name: &str) -> String {
        name.to_string()
    }

    /// Zero stands for the default in C only; here it switches off, and what is not set is the default.
    fn constant(&self, name: &str) -> String {
        if name == "BESPOKE_WEIGHT_OFF" { "0".to_string() } else { name.to_string() }
    }

    fn quoted(&self, text: &str) -> String {
        text.to_string()
    }
}
