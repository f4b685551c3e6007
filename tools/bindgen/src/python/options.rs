//! The options: a dataclass, the same as keyword arguments, and what takes them to the struct and back.

use std::fmt::Write;

use super::{docstring, head, number, public, words};
use crate::Result;
use crate::description::{Audience, Description, OptionEntry};
use crate::prose;

const ABOUT: &str = r#"

@dataclasses.dataclass(frozen=True)
class Options:
    """What may be tuned. None, which is what a new one has everywhere, means the default.

    Where a comment says so, 0 switches a term off. Lengths are in the normalised space, in which the longest side of the
    skeleton's bounding box is 2, unless it says something else. Weights are finite and not negative; other ranges are in
    brackets. Options that begin with "Expert." tune the solver.
    """
"#;

/// How an option goes to C: the function of _convert.py.
fn convert(option: &OptionEntry) -> &'static str {
    if option.kind.is_flag {
        "flag"
    } else if option.kind.enumeration.is_some() {
        "member"
    } else if option.kind.base == "double" {
        match (&option.off, option.default_value) {
            (Some(_), _) => "weight",
            (None, Some(0.0)) => "length",
            (None, _) => "positive",
        }
    } else if option.kind.base == "uint64_t" {
        "count64"
    } else {
        "count"
    }
}

pub fn text(description: &Description) -> Result<String> {
    let mut enums: Vec<_> = description.options.iter().filter_map(|one| one.kind.enumeration.as_deref()).collect();
    enums.dedup();
    let enums: Vec<_> = enums.into_iter().map(public).collect();
    let mut text = head(
        "What may be tuned.",
        &format!(
            "import ctypes\nimport dataclasses\nfrom typing import TypedDict\n\nfrom . import _convert as convert\n\
             from ._enums import {}\nfrom ._native import BespokeOptions\n",
            enums.join(", ")
        ),
    );
    text += ABOUT;
    let (mut fields, mut arguments, mut to, mut from) = (String::new(), String::new(), String::new(), String::new());
    for option in &description.options {
        let name = &option.name;
        let kind = number(&option.kind).ok_or(format!("Python has no type yet for the option {name}"))?;
        let whom = if option.audience == Audience::Expert { "Expert. " } else { "" };
        let doc =
            format!("{whom}{}", prose::of_flag(&option.doc, &option.kind)).replace("Default false", "Default False");
        let _ = write!(fields, "\n    {name}: {kind} | None = None\n");
        fields += &docstring(&words(&doc, description), 4);
        let _ = writeln!(arguments, "    {name}: {kind} | None");
        let _ = writeln!(to, "        native.{name} = convert.{}(\"{name}\", self.{name})", convert(option));
        let read = if option.kind.is_flag || option.kind.enumeration.is_some() {
            format!("{kind}(native.{name})")
        } else {
            format!("native.{name}")
        };
        let _ = writeln!(from, "            {name}={read},");
    }
    let _ = write!(
        text,
        "{fields}\n    def _to_native(self) -> BespokeOptions:\n        native = BespokeOptions()\n        \
         native.struct_size = ctypes.sizeof(native)\n{to}        return native\n\n    @classmethod\n    \
         def _from_native(cls, native: BespokeOptions) -> Options:\n        return cls(\n{from}        )\n\n\n\
         class OptionArguments(TypedDict, total=False):\n    \
         \"\"\"The same as keyword arguments: `Options` says what they are.\"\"\"\n\n{arguments}"
    );
    Ok(text)
}
