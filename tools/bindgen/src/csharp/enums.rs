//! The enums, which are public but for one.

use std::fmt::Write;

use super::{head, public, summary};
use crate::description::{Description, Enum, pascal};

/// What callers see by the types of their arrays.
const INTERNAL: &[&str] = &["BespokeComponent"];

/// What a member has to say in C# only.
const ADDITIONS: &[(&str, &str)] = &[
    (
        "BESPOKE_STATUS_CANCELLED",
        "It is thrown as <see cref=\"System.OperationCanceledException\"/>, never as <see cref=\"BespokeException\"/>.",
    ),
    ("BESPOKE_SUBJECT_LAYER", "See <see cref=\"Element.Layer\"/>."),
];

/// What zero means in an enum that has no such number, but whose fields may be left out.
const ZEROS: &[(&str, &str, &str)] =
    &[("BespokeAxis", "Default", "That of <see cref=\"CoordinateSystem\"/>'s field by default.")];

pub fn text(description: &Description) -> String {
    let mut text = head("The enums of bespoke.h.", &[]);
    let enums: Vec<_> = description.enums.iter().map(|one| declaration(one, description)).collect();
    text += &enums.join("\n");
    text + "}\n"
}

fn declaration(one: &Enum, description: &Description) -> String {
    let visibility = if INTERNAL.contains(&one.name.as_str()) { "internal" } else { "public" };
    let mut text = summary(&one.doc, "", 4, description);
    let _ = writeln!(text, "    {visibility} enum {} : uint\n    {{", public(&one.name));
    let mut members = Vec::new();
    if let Some((_, name, doc)) = ZEROS.iter().find(|(name, ..)| *name == one.name) {
        members.push(format!("        /// <summary>{doc}</summary>\n        {name} = 0,\n"));
    }
    for member in &one.members {
        let addition = ADDITIONS.iter().find(|(name, _)| *name == member.name).map_or("", |(_, text)| text);
        let doc = summary(&member.doc, addition, 8, description);
        members.push(format!("{doc}        {} = {},\n", pascal(one.short(member)), member.value));
    }
    text + &members.join("\n") + "    }\n"
}
