//! The structs as they lie in memory, and the constants.

use std::fmt::Write;

use super::{constant, head, native, number};
use crate::Result;
use crate::description::{Description, Field, Length, Struct, pascal};

pub fn text(description: &Description) -> Result<String> {
    let about = "The constants and structs of bespoke.h, field by field, named as in C. They hold numbers only, so that a\n\
                 // pointer to one is all that crosses; that each lies as in C is pinned by tests/csharp/Layout.cs.";
    let mut text = head(about, &["System", "System.Runtime.InteropServices"]);
    text += "    internal static class NativeConstants\n    {\n";
    for one in &description.constants {
        let kind = match one.value.as_i64() {
            Some(value) if i32::try_from(value).is_ok() => "int",
            Some(_) => "uint",
            None => "double",
        };
        let _ = writeln!(text, "        internal const {kind} {} = {};", constant(&one.name), one.value);
    }
    text += "    }\n";
    for structure in &description.structs {
        for field in &structure.fields {
            if let Some((length, inner)) = array_of_structs(field, description) {
                text += &elements(field, length, inner);
            }
        }
        text += &declaration(structure, description)?;
    }
    Ok(text + "}\n")
}

fn array_of_structs<'d>(field: &'d Field, description: &'d Description) -> Option<(&'d Length, &'d Struct)> {
    Some((field.length.as_ref()?, description.structure(&field.kind.base)?))
}

/// C# has no fixed buffer of structs.
fn elements(field: &Field, length: &Length, inner: &Struct) -> String {
    let items: String =
        (0..length.value).map(|k| format!("        internal {} item{k};\n", native(&inner.name))).collect();
    format!(
        "\n    // C's array of {}, for which C# has no fixed buffer.\n    \
         [StructLayout(LayoutKind.Sequential)]\n    internal struct Native{}\n    {{\n{items}    }}\n",
        length.constant,
        pascal(&field.name)
    )
}

fn declaration(structure: &Struct, description: &Description) -> Result<String> {
    let fields = structure.fields.iter().map(|field| member(field, description)).collect::<Result<Vec<_>>>()?;
    let is_unsafe = fields.iter().any(|field| field.contains('*') || field.contains(" fixed "));
    let word = if is_unsafe { "unsafe " } else { "" };
    Ok(format!(
        "\n    [StructLayout(LayoutKind.Sequential)]\n    internal {word}struct {}\n    {{\n{}    }}\n",
        native(&structure.name),
        fields.concat()
    ))
}

fn member(field: &Field, description: &Description) -> Result<String> {
    let name = &field.name;
    let kind = match number(&field.kind) {
        _ if field.kind.base == "void" && field.kind.pointers == 1 => "void*".to_string(),
        _ if field.kind.base == "char" && field.kind.pointers == 1 => "byte*".to_string(),
        Some(kind) if field.kind.pointers == 0 => kind,
        None if description.structure(&field.kind.base).is_some() => match array_of_structs(field, description) {
            Some(_) => format!("Native{}", pascal(name)),
            None => native(&field.kind.base),
        },
        _ => return Err(format!("C# has no type yet for the field {name}: {:?}", field.kind)),
    };
    Ok(match &field.length {
        Some(length) if number(&field.kind).is_some() => {
            format!("        internal fixed {kind} {name}[NativeConstants.{}];\n", constant(&length.constant))
        }
        _ => format!("        internal {kind} {name};\n"),
    })
}
