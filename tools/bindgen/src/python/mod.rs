//! What the Python package repeats of the header: enums, what a session tells as frozen dataclasses, options, and the raw
//! layer for ctypes. All but the raw layer is public, and reads as Python does.

mod enums;
mod native;
mod options;
mod values;

use crate::description::{Description, Enum, Member, Type};
use crate::prose::{self, Names};
use crate::{MARK, Result};

/// Names and texts of all files.
pub fn files(description: &Description) -> Result<Vec<(&'static str, String)>> {
    Ok(vec![
        ("_enums.py", enums::text(description)),
        ("_native.py", native::text(description)?),
        ("_options.py", options::text(description)?),
        ("_values.py", values::text(description)?),
    ])
}

/// The beginning of a file, with the names that it imports.
fn head(about: &str, imports: &str) -> String {
    format!("# {MARK}\n\"\"\"{about}\"\"\"\n\nfrom __future__ import annotations\n\n{imports}")
}

/// `Stage` of `BespokeStage`.
fn public(name: &str) -> &str {
    name.strip_prefix("Bespoke").unwrap_or(name)
}

/// The type of a number as Python has it.
fn number(kind: &Type) -> Option<&str> {
    if kind.is_flag {
        return Some("bool");
    }
    if let Some(one) = &kind.enumeration {
        return Some(public(one));
    }
    match kind.base.as_str() {
        "uint32_t" | "uint64_t" | "size_t" => Some("int"),
        "double" | "float" => Some("float"),
        _ => None,
    }
}

/// A comment of the header as the text of a docstring.
fn words(text: &str, description: &Description) -> String {
    prose::translate(text, description, &Words).replace('\\', "\\\\")
}

/// A docstring, wrapped, with its margin and an empty line between paragraphs.
fn docstring(text: &str, indent: usize) -> String {
    let margin = " ".repeat(indent);
    if !text.contains("\n\n") && margin.len() + text.chars().count() + 6 <= 120 {
        return format!("{margin}\"\"\"{text}\"\"\"\n");
    }
    let mut lines = Vec::new();
    for (k, paragraph) in text.split("\n\n").enumerate() {
        if k > 0 {
            lines.push(String::new());
        }
        // The first line holds the quotes.
        let mark = if k == 0 { "\"\"\"" } else { "" };
        lines.extend(
            prose::wrap(&format!("{mark}{paragraph}"), 120 - indent).into_iter().map(|line| margin.clone() + &line),
        );
    }
    format!("{}\n{margin}\"\"\"\n", lines.join("\n"))
}

struct Words;

impl Names for Words {
    fn member(&self, one: &Enum, member: &Member) -> String {
        format!("`{}.{}`", public(&one.name), one.short(member))
    }

    fn enumeration(&self, name: &str) -> String {
        format!("`{}`", public(name))
    }

    fn structure(&self, name: &str) -> String {
        public(name).to_string()
    }

    fn function(&self, name: &str) -> String {
        match name.strip_prefix("bespoke_session_") {
            Some(method) => format!("`Session.{method}`"),
            None => format!("`{}`", name.trim_start_matches("bespoke_")),
        }
    }

    /// Zero stands for the default in C only; here it switches off, and what is left out is the default.
    fn constant(&self, name: &str) -> String {
        match name {
            "BESPOKE_WEIGHT_OFF" => "0".to_string(),
            "BESPOKE_NO_JOINT" => "None".to_string(),
            _ => name.to_string(),
        }
    }

    fn quoted(&self, text: &str) -> String {
        format!("`{text}`")
    }
}
