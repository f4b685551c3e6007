//! Constants, structs and functions as ctypes has them, named as in C.

use std::fmt::Write;

use super::head;
use crate::Result;
use crate::description::{Description, Field, Struct, Type};

const DECLARE: &str = r#"

def declare(library: ctypes.CDLL) -> None:
    """Tells ctypes what each function of the library takes and returns."""
    for name, (returns, takes) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = returns
        function.argtypes = takes
"#;

pub fn text(description: &Description) -> Result<String> {
    let mut text = head(
        "The C API as ctypes has it: constants, structs field by field, functions. That each struct lies as in C is tried by\n\
         the tests. Handles are plain addresses.\n",
        "import ctypes\nfrom typing import Any\n\n",
    );
    for one in &description.constants {
        let _ = writeln!(text, "{} = {}", one.name, one.value);
    }
    for structure in &description.structs {
        text += &declaration(structure, description)?;
    }
    text += "\n\nFUNCTIONS: dict[str, tuple[Any, list[Any]]] = {\n";
    for function in &description.functions {
        let returns = match (function.returns.base.as_str(), function.returns.pointers) {
            ("void", 0) => "None".to_string(),
            ("char", 1) => "ctypes.c_char_p".to_string(),
            _ => argument(&function.returns, description)?,
        };
        let takes =
            function.parameters.iter().map(|one| argument(&one.kind, description)).collect::<Result<Vec<_>>>()?;
        let line = format!("    \"{}\": ({returns}, [{}]),\n", function.name, takes.join(", "));
        if line.len() <= 121 {
            text += &line;
            continue;
        }
        let takes: String = takes.iter().map(|one| format!("            {one},\n")).collect();
        let _ =
            write!(text, "    \"{}\": (\n        {returns},\n        [\n{takes}        ],\n    ),\n", function.name);
    }
    text += "}\n";
    Ok(text + DECLARE)
}

/// A number of C.
fn plain(kind: &Type, description: &Description) -> Option<String> {
    let name = match kind.base.as_str() {
        "char" => "c_char",
        "uint32_t" => "c_uint32",
        "uint64_t" => "c_uint64",
        "size_t" => "c_size_t",
        "double" => "c_double",
        "float" => "c_float",
        name if description.enums.iter().any(|one| one.name == name) => "c_uint32",
        _ => return None,
    };
    Some(format!("ctypes.{name}"))
}

fn argument(kind: &Type, description: &Description) -> Result<String> {
    let is_handle = description.handles.iter().any(|handle| handle.name == kind.base);
    let one = match plain(kind, description) {
        Some(number) => number,
        // A handle is an address already.
        None if is_handle && kind.pointers > 0 => "ctypes.c_void_p".to_string(),
        None if description.structure(&kind.base).is_some() => kind.base.clone(),
        None => return Err(format!("Python has no type yet for {kind:?}")),
    };
    let pointers = kind.pointers - usize::from(is_handle);
    Ok((0..pointers).fold(one, |inner, _| format!("ctypes.POINTER({inner})")))
}

/// The type for ctypes, and the one of the attribute that comes of it.
fn field(field: &Field, description: &Description) -> Result<(String, String)> {
    let kind = &field.kind;
    let (inner, attribute) = match (kind.base.as_str(), kind.pointers) {
        ("void", 1) => ("ctypes.c_void_p".to_string(), "int | None".to_string()),
        ("char", 1) => ("ctypes.c_char_p".to_string(), "bytes | None".to_string()),
        (name, 0) if description.structure(name).is_some() => (name.to_string(), name.to_string()),
        (name, 0) => {
            let number =
                plain(kind, description).ok_or(format!("Python has no type yet for the field {}", field.name))?;
            (number, if name == "double" { "float" } else { "int" }.to_string())
        }
        _ => return Err(format!("Python has no type yet for the field {}: {kind:?}", field.name)),
    };
    let Some(length) = &field.length else { return Ok((inner, attribute)) };
    let attribute = if kind.base == "char" { "bytes".to_string() } else { format!("ctypes.Array[{inner}]") };
    Ok((format!("{inner} * {}", length.constant), attribute))
}

fn declaration(structure: &Struct, description: &Description) -> Result<String> {
    let (mut fields, mut attributes) = (String::new(), String::new());
    for one in &structure.fields {
        let (kind, attribute) = field(one, description)?;
        let _ = writeln!(fields, "        (\"{}\", {kind}),", one.name);
        let _ = writeln!(attributes, "    {}: {attribute}", one.name);
    }
    Ok(format!("\n\nclass {}(ctypes.Structure):\n    _fields_ = [\n{fields}    ]\n{attributes}", structure.name))
}
