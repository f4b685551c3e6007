//! The functions.

use super::{head, native, number, public};
use crate::Result;
use crate::description::{Description, Function, Parameter, pascal};

const LIBRARY: &str = r#"    internal static unsafe class Native
    {
        // Where the library is linked into the program itself, as on iOS and consoles, there is no file to look for.
#if BESPOKE_STATIC || (UNITY_IOS && !UNITY_EDITOR)
        private const string Library = "__Internal";
#else
        private const string Library = "bespoke";
#endif
        private const CallingConvention C = CallingConvention.Cdecl;
"#;

pub fn text(description: &Description) -> Result<String> {
    let about =
        "The functions of bespoke.h. All that crosses is blittable: numbers, pointers, and handles as their pointers.";
    let mut text = head(about, &["System", "System.Runtime.InteropServices"]);
    text += LIBRARY;
    for function in &description.functions {
        text += &declaration(function, description)?;
    }
    Ok(text + "    }\n}\n")
}

fn declaration(function: &Function, description: &Description) -> Result<String> {
    let returns = match (function.returns.base.as_str(), function.returns.pointers) {
        ("void", 0) => "void".to_string(),
        ("char", 1) => "byte*".to_string(),
        (name, 0) if description.enums.iter().any(|one| one.name == name) => public(name).to_string(),
        (_, 0) => number(&function.returns).ok_or(format!("C# has no type yet for what {} returns", function.name))?,
        _ => return Err(format!("C# has no type yet for what {} returns", function.name)),
    };
    let ends = function.name.ends_with("_destroy");
    let parameters: Vec<_> =
        function.parameters.iter().map(|one| parameter(one, ends, description)).collect::<Result<_>>()?;
    let begin = format!("        internal static extern {returns} {}(", function.name);
    let inside = parameters.join(", ");
    let gap = if begin.len() + inside.len() + 2 > 120 { "\n            " } else { "" };
    Ok(format!("\n        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]\n{begin}{gap}{inside});\n"))
}

/// A handle crosses as its SafeHandle, but where it is made or where SafeHandle itself frees it.
fn parameter(parameter: &Parameter, ends: bool, description: &Description) -> Result<String> {
    let kind = &parameter.kind;
    let is_handle = description.handles.iter().any(|handle| handle.name == kind.base);
    let name = match kind.pointers {
        2 if is_handle => "IntPtr*".to_string(),
        1 if is_handle && ends => "IntPtr".to_string(),
        1 if is_handle => format!("{}Handle", public(&kind.base)),
        1 if description.structure(&kind.base).is_some() => format!("{}*", native(&kind.base)),
        pointers @ (0 | 1) => {
            let number = number(kind).ok_or(format!("C# has no type yet for {parameter:?}"))?;
            number + &"*".repeat(pointers)
        }
        _ => return Err(format!("C# has no type yet for {parameter:?}")),
    };
    Ok(format!("{name} {}", camel(&parameter.name)))
}

/// `maxIterations` of `max_iterations`.
fn camel(name: &str) -> String {
    let name = pascal(name);
    let (first, rest) = name.split_at(1);
    first.to_ascii_lowercase() + rest
}
