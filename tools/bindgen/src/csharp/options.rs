//! The properties of the class `Options`, and what takes them from and to the struct.

use std::fmt::Write;

use super::{head, number, summary};
use crate::Result;
use crate::description::{Audience, Description, OptionEntry, pascal};
use crate::prose;

fn kind(option: &OptionEntry) -> Result<String> {
    if option.kind.is_flag {
        return Ok("bool".to_string());
    }
    number(&option.kind).ok_or(format!("C# has no type yet for the option {}", option.name))
}

pub fn text(description: &Description) -> Result<String> {
    let mut text = head("What may be tuned: the fields of BespokeOptions.", &[]);
    text += "    public sealed partial class Options\n    {\n";
    let (mut from, mut to) = (String::new(), String::new());
    for option in &description.options {
        let (field, property, kind) = (&option.name, pascal(&option.name), kind(option)?);
        let whom = if option.audience == Audience::Expert { "Expert. " } else { "" };
        let doc = format!("{whom}{}", prose::of_flag(&option.doc, &option.kind));
        text += &summary(&doc, "", 8, description);
        let _ = writeln!(text, "        public {kind} {property} {{ get; set; }}\n");
        let (read, write) = if option.kind.is_flag {
            (format!("native.{field} != 0"), format!("{property} ? 1u : 0u"))
        } else {
            (format!("native.{field}"), property.clone())
        };
        let _ = writeln!(from, "                {property} = {read},");
        let _ = writeln!(to, "                {field} = {write},");
    }
    let _ = write!(
        text,
        "        private static Options FromNative(NativeOptions native)\n        {{\n            \
         return new Options\n            {{\n{from}            }};\n        }}\n\n        \
         internal unsafe NativeOptions ToNative()\n        {{\n            return new NativeOptions\n            {{\n                \
         struct_size = (uint)sizeof(NativeOptions),\n{to}            }};\n        }}\n    }}\n}}\n"
    );
    Ok(text)
}
