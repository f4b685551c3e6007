//! The enums, which are public but for one.

use std::fmt::Write;

use super::{docstring, head, public, words};
use crate::description::{Description, Enum};

/// What callers see by the types of their arrays.
pub const INTERNAL: &[&str] = &["BespokeComponent"];

const BASE: &str = r#"

class _Number(enum.IntEnum):
    """A number with a name. A later library may use others: they arrive as they are, named after their number."""

    @classmethod
    def _missing_(cls, value: object) -> _Number | None:
        if not isinstance(value, int):
            return None
        other = int.__new__(cls, value)
        other._name_ = f"NUMBER_{value}"
        other._value_ = value
        return other
"#;

pub fn text(description: &Description) -> String {
    let mut text = head("The enums of bespoke.h.", "import enum\n");
    text += BASE;
    for one in &description.enums {
        text += &declaration(one, description);
    }
    text
}

fn declaration(one: &Enum, description: &Description) -> String {
    let hidden = if INTERNAL.contains(&one.name.as_str()) { "_" } else { "" };
    let mut text = format!("\n\nclass {hidden}{}(_Number):\n", public(&one.name));
    text += &docstring(&words(&one.doc, description), 4);
    for member in &one.members {
        let _ = write!(text, "\n    {} = {}\n", one.short(member), member.value);
        text += &docstring(&words(&member.doc, description), 4);
    }
    text
}
