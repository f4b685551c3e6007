//! The numbers of the enums as constants of the class.

use std::fmt::Write;

use super::{head, public};
use crate::Result;
use crate::description::Description;

pub fn text(description: &Description) -> Result<String> {
    let mut text = head("The constants of the class; their texts are in words.rs.");
    text += "use godot::prelude::*;\n\nuse crate::retarget::BespokeRetarget;\n\n#[godot_api(secondary)]\n\
             impl BespokeRetarget {\n";
    for (one, prefix) in public(description)? {
        for member in &one.members {
            let _ = writeln!(
                text,
                "    #[constant]\n    pub const {prefix}_{}: i64 = {};",
                one.short(member),
                member.value
            );
        }
    }
    Ok(text + "}\n")
}
