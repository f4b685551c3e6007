//! What the header says of enums and options, as tables that the editor shows.

use std::fmt::Write;

use super::{head, public, words};
use crate::Result;
use crate::description::{Audience, Description};
use crate::prose;

const TYPES: &str = r#"use crate::native::BespokeOptions;

/// A number of an enum.
pub struct Word {
    /// The constant of the class.
    pub name: &'static str,
    pub value: u32,
    pub text: &'static str,
}

/// An option.
pub struct OptionWord {
    pub name: &'static str,
    pub text: &'static str,
    /// As a number, or in words.
    pub default: &'static str,
    /// Its bounds in words, and what 0 does where it switches off.
    pub range: Option<&'static str>,
    pub off: Option<&'static str>,
    pub is_flag: bool,
    pub is_expert: bool,
    /// Where it is in the struct.
    pub slot: fn(&mut BespokeOptions) -> Slot<'_>,
}

/// A field of the options.
pub enum Slot<'a> {
    Real(&'a mut f64),
    Count(&'a mut u32),
    Bytes(&'a mut u64),
}

"#;

pub fn text(description: &Description) -> Result<String> {
    let mut text = head("What constants and options say, for the editor's help and for tooltips.");
    text += TYPES;
    text += "pub const WORDS: &[Word] = &[\n";
    for (one, prefix) in public(description)? {
        for member in &one.members {
            let said = words(&member.doc, description);
            let _ = writeln!(
                text,
                "    Word {{ name: \"{prefix}_{}\", value: {}, text: {said:?} }},",
                one.short(member),
                member.value
            );
        }
    }
    text += "];\n\npub const OPTIONS: &[OptionWord] = &[\n";
    for option in &description.options {
        let slot = match option.kind.base.as_str() {
            "double" => "Real",
            "uint32_t" => "Count",
            "uint64_t" => "Bytes",
            _ => return Err(format!("Godot has no type yet for the option {}", option.name)),
        };
        let said = words(&prose::of_flag(&option.doc, &option.kind), description);
        let off = option.off.as_ref().map(|off| words(off, description));
        let _ = writeln!(
            text,
            "    OptionWord {{\n        name: {:?},\n        text: {said:?},\n        default: {:?},\n        range: {:?},\n        \
             off: {off:?},\n        is_flag: {},\n        is_expert: {},\n        slot: |options| Slot::{slot}(&mut \
             options.{}),\n    }},",
            option.name,
            option.default,
            option.range,
            option.kind.is_flag,
            option.audience == Audience::Expert,
            option.name
        );
    }
    Ok(text + "];\n")
}
