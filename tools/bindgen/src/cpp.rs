//! What include/bespoke.hpp repeats of the header: its enums and its options. The rest of that file is written by hand; a
//! mark above and one below say what is not.

use std::fmt::Write;

use crate::Result;
use crate::description::{Audience, Description, Enum, Member, OptionEntry, Type};
use crate::prose::{self, Names};

/// `text` with new parts between its marks.
pub fn rewritten(text: &str, description: &Description) -> Result<String> {
    let text = replaced(text, "enums", &enums(description))?;
    replaced(&text, "options", &options(description)?)
}

fn replaced(text: &str, what: &str, new: &str) -> Result<String> {
    let begin =
        format!("// Begin of the {what}: written by `make bindings` from bespoke.h; changes by hand are lost.\n");
    let end = format!("// End of the {what}.\n");
    let (before, rest) = text.split_once(&begin).ok_or(format!("include/bespoke.hpp has lost its line `{begin}`"))?;
    let (_, after) = rest.split_once(&end).ok_or(format!("include/bespoke.hpp has lost its line `{end}`"))?;
    Ok(format!("{before}{begin}\n{new}\n{end}{after}"))
}

fn short(name: &str) -> &str {
    name.strip_prefix("Bespoke").unwrap_or(name)
}

fn enums(description: &Description) -> String {
    let one = |one: &Enum| {
        let text = prose::translate(&one.doc, description, &Words);
        let (first, rest) = prose::sentence(&text);
        let mut text = comment(&format!("{first}: {}. {rest}", one.name), 0);
        let _ = writeln!(text, "enum class {} : std::uint32_t {{", short(&one.name));
        for member in &one.members {
            let _ = writeln!(text, "    {} = {},", one.short(member).to_ascii_lowercase(), member.name);
        }
        text + "};\n"
    };
    description.enums.iter().map(one).collect::<Vec<_>>().join("\n")
}

fn comment(text: &str, indent: usize) -> String {
    let margin = format!("{}/// ", " ".repeat(indent));
    prose::wrap(text.trim(), 120 - margin.len()).iter().map(|line| format!("{margin}{line}\n")).collect()
}

/// Type, value at first, and how it goes to C and comes back.
fn crossing(option: &OptionEntry, description: &Description) -> Result<[String; 4]> {
    let (field, kind) = (&option.name, &option.kind);
    if kind.is_flag {
        return Ok(["bool".into(), "false".into(), format!("{field} ? 1 : 0"), format!("read.{field} != 0")]);
    }
    if let Some((name, zero)) = zero(kind, description) {
        let cast = |to: &str, from: &str| format!("static_cast<{to}>({from})");
        let value = format!("{name}::{zero}");
        return Ok([name.clone(), value, cast("std::uint32_t", field), cast(&name, &format!("read.{field}"))]);
    }
    let (name, value) = match kind.base.as_str() {
        "double" => ("double", "0.0"),
        "uint32_t" => ("std::uint32_t", "0"),
        "uint64_t" => ("std::uint64_t", "0"),
        other => return Err(format!("C++ has no type yet for the option {field}: {other}")),
    };
    Ok([name.to_string(), value.to_string(), field.clone(), format!("read.{field}")])
}

/// The enum of a number, and its member 0.
fn zero(kind: &Type, description: &Description) -> Option<(String, String)> {
    let one = description.enums.iter().find(|one| Some(&one.name) == kind.enumeration.as_ref())?;
    let zero = one.members.iter().find(|member| member.value == 0)?;
    Some((short(&one.name).to_string(), one.short(zero).to_ascii_lowercase()))
}

fn options(description: &Description) -> Result<String> {
    let (mut fields, mut to, mut from) = (String::new(), String::new(), String::new());
    for option in &description.options {
        let [kind, value, write, read] = crossing(option, description)?;
        let whom = if option.audience == Audience::Expert { "Expert. " } else { "" };
        let doc = format!("{whom}{}", prose::of_flag(&option.doc, &option.kind));
        fields += &comment(&prose::translate(&doc, description, &Words), 4);
        let name = &option.name;
        let _ = writeln!(fields, "    {kind} {name} = {value};");
        let _ = writeln!(to, "        options.{name} = {write};");
        let _ = writeln!(from, "        options.{name} = {read};");
    }
    Ok(format!(
        "/// What may be tuned: BespokeOptions. Zero means the default, which is what a new Options has everywhere; `weight_off`
/// switches a term off where that is possible. Lengths are in the normalised space, in which the longest side of the
/// skeleton's bounding box is 2.
struct Options {{
{fields}
    /// As the C API takes them.
    BespokeOptions get() const noexcept {{
        BespokeOptions options{{}};
        options.struct_size = sizeof options;
{to}        return options;
    }}

    /// The defaults written out: bespoke_options_read_defaults. Errors: INVALID_ARGUMENT, where the library does not
    /// know this header. Threads: any.
    static Result<Options> read_defaults() {{
        BespokeOptions read{{}};
        read.struct_size = sizeof read;
        const auto status = static_cast<Status>(bespoke_options_read_defaults(&read));
        if (status != Status::ok) {{
            return Error(status, \"the library refuses to write into a BespokeOptions of this header's size\");
        }}
        Options options;
{from}        return options;
    }}
}};
"
    ))
}

struct Words;

impl Names for Words {
    fn member(&self, one: &Enum, member: &Member) -> String {
        format!("{}::{}", short(&one.name), one.short(member).to_ascii_lowercase())
    }

    fn enumeration(&self, name: &str) -> String {
        short(name).to_string()
    }

    fn structure(&self, name: &str) -> String {
        short(name).to_string()
    }

    fn function(&self, name: &str) -> String {
        match name.strip_prefix("bespoke_session_") {
            Some(method) => format!("Session::{method}"),
            None => name.to_string(),
        }
    }

    fn constant(&self, name: &str) -> String {
        match name {
            "BESPOKE_WEIGHT_OFF" => "weight_off".to_string(),
            _ => name.to_string(),
        }
    }

    fn quoted(&self, text: &str) -> String {
        format!("`{text}`")
    }
}
