//! What a session tells: structs of C as frozen dataclasses, without what only C needs.

use std::fmt::Write;

use super::{docstring, head, number, public, words};
use crate::Result;
use crate::description::{Description, Field, Struct};
use crate::prose;

/// Those that are read and that Python has as they are in C. Joints are written by hand: their matrices are rows and columns.
const READ: &[&str] = &[
    "BespokeIntersections",
    "BespokeProgress",
    "BespokeStageReport",
    "BespokeReport",
    "BespokeEnergy",
    "BespokeElement",
    "BespokeDiagnostic",
    "BespokeWornPair",
    "BespokePoseIntersections",
];

/// What a class has in Python only.
const ADDITIONS: &[(&str, &str)] = &[(
    "BespokeElement",
    r#"
    @property
    def layer(self) -> int | None:
        """The layer that it belongs to, from 0; None where it belongs to something else."""
        is_layer = Subject.LAYER <= self.subject < Subject.FOLLOWER
        return self.subject - Subject.LAYER if is_layer else None

    @property
    def follower(self) -> int | None:
        """The follower that it belongs to, from 0; None where it belongs to something else."""
        return self.subject - Subject.FOLLOWER if self.subject >= Subject.FOLLOWER else None
"#,
)];

pub fn text(description: &Description) -> Result<String> {
    let structs = || READ.iter().filter_map(|name| description.structure(name));
    let mut enums: Vec<_> = structs()
        .flat_map(|one| &one.fields)
        .filter_map(|field| field.kind.enumeration.as_deref())
        .map(public)
        .collect();
    enums.sort_unstable();
    enums.dedup();
    let natives: String = structs().map(|one| format!("    {},\n", one.name)).collect();
    let mut text = head(
        "What a session tells.",
        &format!(
            "import dataclasses\n\nfrom ._enums import {}\nfrom ._native import (\n{natives})\n",
            enums.join(", ")
        ),
    );
    for one in structs() {
        text += &declaration(one, description)?;
    }
    Ok(text)
}

/// The field that says how many elements of an array are in use: `element_count` of `elements`.
fn count<'s>(array: &Field, structure: &'s Struct) -> Option<&'s Field> {
    array.length.as_ref()?;
    let singular =
        array.name.strip_suffix("ies").map_or(array.name.trim_end_matches('s').to_string(), |stem| format!("{stem}y"));
    structure.fields.iter().find(|field| field.name == format!("{singular}_count"))
}

fn declaration(structure: &Struct, description: &Description) -> Result<String> {
    let name = public(&structure.name);
    let mut text = format!("\n\n@dataclasses.dataclass(frozen=True)\nclass {name}:\n");
    text += &docstring(&words(&structure.doc, description), 4);
    let counts: Vec<_> =
        structure.fields.iter().filter_map(|field| count(field, structure)).map(|one| &one.name).collect();
    let mut from = String::new();
    for field in structure.fields.iter().filter(|field| field.is_content() && !counts.contains(&&field.name)) {
        let (kind, read) = crossing(field, structure, description)?;
        let doc = prose::of_flag(&field.doc, &field.kind).replacen("1 where", "Whether", 1).replace(", else 0", "");
        let doc = doc.replace("; ends with a zero byte", "").replace(", 0 where by", ", and not by");
        let doc = words(&doc, description);
        let _ = write!(text, "\n    {}: {kind}\n{}", field.name, docstring(&doc, 4));
        let _ = writeln!(from, "            {}={read},", field.name);
    }
    text += ADDITIONS.iter().find(|(of, _)| *of == structure.name).map_or("", |(_, more)| more);
    let _ = write!(
        text,
        "\n    @classmethod\n    def _from_native(cls, native: {}) -> {name}:\n        return cls(\n{from}        )\n",
        structure.name
    );
    Ok(text)
}

/// The type in Python, and how it is read.
fn crossing(field: &Field, structure: &Struct, description: &Description) -> Result<(String, String)> {
    let native = format!("native.{}", field.name);
    let kind = &field.kind;
    if kind.base == "char" && field.length.is_some() {
        return Ok(("str".into(), format!("{native}.decode(\"utf-8\", \"replace\")")));
    }
    let is_struct = description.structure(&kind.base).is_some();
    let one = match number(kind) {
        Some(number) => number.to_string(),
        None if is_struct => public(&kind.base).to_string(),
        None => return Err(format!("Python has no type yet for the field {}: {kind:?}", field.name)),
    };
    if let Some(count) = count(field, structure) {
        let item = if is_struct { format!("{one}._from_native(item)") } else { format!("{one}(item)") };
        let read = format!("tuple({item} for item in {native}[: native.{}])", count.name);
        return Ok((format!("tuple[{one}, ...]"), read));
    }
    if field.length.is_some() {
        return Err(format!("nothing says how many of {} are in use", field.name));
    }
    let read = if is_struct {
        format!("{one}._from_native({native})")
    } else if kind.is_flag || kind.enumeration.is_some() {
        format!("{one}({native})")
    } else {
        native
    };
    Ok((one, read))
}
