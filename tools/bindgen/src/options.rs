//! The options as a table: what the comments of `BespokeOptions` say of default, range and switching off.
//!
//! A comment may begin with "Expert."; then it may hold a range in brackets, "Default" with a value up to the end of the
//! sentence or to a comma, and what BESPOKE_WEIGHT_OFF does behind a colon, or "possible".

use crate::Result;
use crate::description::{Audience, Description, OptionEntry};
use crate::prose::sentence;

const EXPERT: &str = "Expert. ";
const OFF: &str = "BESPOKE_WEIGHT_OFF";

/// The rows of the table, in the order of the struct.
pub fn table(description: &Description) -> Result<Vec<OptionEntry>> {
    let structure = description.structure("BespokeOptions").ok_or("the header has no BespokeOptions")?;
    let mut rows = Vec::new();
    for field in structure.fields.iter().filter(|field| field.is_content()) {
        let (audience, doc) = match field.doc.strip_prefix(EXPERT) {
            Some(rest) => (Audience::Expert, rest),
            None => (Audience::Artist, field.doc.as_str()),
        };
        let said = doc.split_once("Default").ok_or(format!("the comment of option {} has no default", field.name))?.1;
        let default = sentence(said.trim_start_matches([':', ' '])).0.split([',', ':']).next().unwrap_or_default();
        let range = doc.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map(|(range, _)| range.to_string());
        let off = doc.split_once(OFF).map(|(_, rest)| sentence(rest).0.trim_start_matches([':', ' ']));
        rows.push(OptionEntry {
            name: field.name.clone(),
            kind: field.kind.clone(),
            audience,
            default: default.to_string(),
            default_value: default.parse().ok(),
            range,
            off: off.map(|text| text.strip_prefix("possible").unwrap_or(text).to_string()),
            doc: doc.to_string(),
        });
    }
    Ok(rows)
}
