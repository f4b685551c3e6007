//! The C API as Rust has it: constants, structs field by field, functions.

use std::fmt::Write;

use super::head;
use crate::Result;
use crate::description::{Description, Struct, Type};

pub fn text(description: &Description) -> Result<String> {
    let mut text = head("The C API: constants, structs field by field, functions. The header says what they are.");
    text += "use std::ffi::{c_char, c_void};\n\n";
    for one in &description.constants {
        let kind = if one.value.is_f64() { "f64" } else { "u32" };
        let _ = writeln!(text, "pub const {}: {kind} = {};", one.name, one.value);
    }
    for one in &description.enums {
        text.push('\n');
        for member in &one.members {
            let _ = writeln!(text, "pub const {}: u32 = {};", member.name, member.value);
        }
    }
    for handle in &description.handles {
        let _ = write!(text, "\n#[repr(C)]\npub struct {} {{\n    _opaque: [u8; 0],\n}}\n", handle.name);
    }
    for structure in &description.structs {
        text += &declaration(structure, description)?;
    }
    text += "\nunsafe extern \"C\" {\n";
    for function in &description.functions {
        let mut parameters = Vec::new();
        for one in &function.parameters {
            parameters.push(format!("{}: {}", one.name, rust(&one.kind, description)?));
        }
        let returns = match (function.returns.base.as_str(), function.returns.pointers) {
            ("void", 0) => String::new(),
            _ => format!(" -> {}", rust(&function.returns, description)?),
        };
        let line = format!("    pub fn {}({}){returns};\n", function.name, parameters.join(", "));
        if line.len() <= 121 {
            text += &line;
            continue;
        }
        let parameters: String = parameters.iter().map(|one| format!("        {one},\n")).collect();
        let _ = write!(text, "    pub fn {}(\n{parameters}    ){returns};\n", function.name);
    }
    Ok(text + "}\n")
}

/// A struct with its layout, which the compiler proves.
fn declaration(structure: &Struct, description: &Description) -> Result<String> {
    let name = &structure.name;
    let mut text = format!("\n#[derive(Clone, Copy)]\n#[repr(C)]\npub struct {name} {{\n");
    let mut pins = String::new();
    for field in &structure.fields {
        let kind = rust(&field.kind, description)?;
        let kind = match &field.length {
            Some(length) => format!("[{kind}; {} as usize]", length.constant),
            None => kind,
        };
        let _ = writeln!(text, "    pub {}: {kind},", field.name);
        let _ = writeln!(pins, "    assert!(std::mem::offset_of!({name}, {}) == {});", field.name, field.offset);
    }
    let _ = write!(
        text,
        "}}\n\n#[cfg(target_pointer_width = \"64\")]\nconst _: () = {{\n    assert!(size_of::<{name}>() == {});\n{pins}}};\n",
        structure.size
    );
    Ok(text)
}

fn rust(kind: &Type, description: &Description) -> Result<String> {
    let one = match kind.base.as_str() {
        "char" => "c_char",
        "uint32_t" => "u32",
        "uint64_t" => "u64",
        "size_t" => "usize",
        "double" => "f64",
        "float" => "f32",
        "void" => "c_void",
        name if description.enums.iter().any(|one| one.name == name) => "u32",
        name if description.structure(name).is_some() => name,
        name if description.handles.iter().any(|one| one.name == name) => name,
        _ => return Err(format!("Rust has no type yet for {kind:?}")),
    };
    let mut text = one.to_string();
    for level in 0..kind.pointers {
        let way = if kind.is_const && level == 0 { "*const" } else { "*mut" };
        text = format!("{way} {text}");
    }
    Ok(text)
}
