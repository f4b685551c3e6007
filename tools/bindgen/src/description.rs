//! What include/bespoke.h says, as data. `bindings/bespoke.json` is this, serialised.
//!
//! Comments are without their marks: a paragraph is one line, and paragraphs are apart by an empty one.

use serde::Serialize;

/// The whole C API, in the order of the header.
#[derive(Debug, Serialize)]
pub struct Description {
    /// Where it comes from.
    pub generated: String,
    /// Numbers with a name.
    pub constants: Vec<Constant>,
    /// Enums; they cross as `uint32_t`.
    pub enums: Vec<Enum>,
    /// Types of which callers hold pointers only.
    pub handles: Vec<Handle>,
    /// Structs with their layout.
    pub structs: Vec<Struct>,
    /// Functions.
    pub functions: Vec<Function>,
    /// The fields of `BespokeOptions` but for its size and what is reserved, as a table.
    pub options: Vec<OptionEntry>,
}

/// A number with a name.
#[derive(Debug, Serialize)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Its value: whole, or with a point.
    pub value: serde_json::Number,
    /// What it is.
    pub doc: String,
}

/// An enum.
#[derive(Debug, Serialize)]
pub struct Enum {
    /// Its name.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// Its numbers.
    pub members: Vec<Member>,
}

/// A number of an enum.
#[derive(Debug, Serialize)]
pub struct Member {
    /// Its whole name.
    pub name: String,
    /// Its value.
    pub value: u32,
    /// What it says.
    pub doc: String,
}

/// An opaque type.
#[derive(Debug, Serialize)]
pub struct Handle {
    /// Its name.
    pub name: String,
    /// What it is.
    pub doc: String,
}

/// A struct.
#[derive(Debug, Serialize)]
pub struct Struct {
    /// Its name.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// Bytes, where pointers have 64 bits; so everywhere here.
    pub size: usize,
    /// Alignment in bytes.
    pub alignment: usize,
    /// Its fields in order.
    pub fields: Vec<Field>,
}

/// A field of a struct.
#[derive(Debug, Serialize)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Its type; of one element where it is an array.
    #[serde(flatten)]
    pub kind: Type,
    /// Where it is an array: how many elements.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<Length>,
    /// Bytes from the beginning of the struct.
    pub offset: usize,
    /// Bytes of all of it.
    pub size: usize,
    /// What it is.
    pub doc: String,
}

/// The length of an array.
#[derive(Clone, Debug, Serialize)]
pub struct Length {
    /// The constant that says it.
    pub constant: String,
    /// Its value.
    pub value: usize,
}

/// The type of a field, a parameter or a result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Type {
    /// Its name, without pointers: `double`, `uint32_t`, `size_t`, `char`, `void` or one of the header's types.
    #[serde(rename = "type")]
    pub base: String,
    /// How many pointers away.
    #[serde(skip_serializing_if = "is_zero")]
    pub pointers: usize,
    /// Whether what is pointed to is not written.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_const: bool,
    /// The enum of a number, where its comment names one ("One of BespokeStage").
    #[serde(rename = "enum", skip_serializing_if = "Option::is_none")]
    pub enumeration: Option<String>,
    /// A number that says yes or no: its comment begins with "1:" or "1 where".
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_flag: bool,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// A function.
#[derive(Debug, Serialize)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// What it does.
    pub doc: String,
    /// What it returns.
    pub returns: Type,
    /// What it takes.
    pub parameters: Vec<Parameter>,
}

/// A parameter of a function.
#[derive(Debug, Serialize)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(flatten)]
    pub kind: Type,
}

/// Whom an option is for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Audience {
    /// What an artist or a pipeline asks for.
    Artist,
    /// The solver's: its comment begins with "Expert."
    Expert,
}

/// A field of `BespokeOptions` as somebody sees it who sets it.
#[derive(Debug, Serialize)]
pub struct OptionEntry {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(flatten)]
    pub kind: Type,
    /// Whom it is for.
    pub audience: Audience,
    /// The default, as the comment says it.
    pub default: String,
    /// The default, where it is a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub default_value: Option<f64>,
    /// The range, as the comment says it in brackets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<String>,
    /// What `BESPOKE_WEIGHT_OFF` does, where it may be used; empty where the comment says only that it may.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub off: Option<String>,
    /// The whole comment, without the word "Expert."
    pub doc: String,
}

impl Description {
    /// The constant of this name.
    pub fn constant(&self, name: &str) -> Option<&Constant> {
        self.constants.iter().find(|constant| constant.name == name)
    }

    /// The struct of this name.
    pub fn structure(&self, name: &str) -> Option<&Struct> {
        self.structs.iter().find(|structure| structure.name == name)
    }

    /// The enum and the member of this whole name.
    pub fn member(&self, name: &str) -> Option<(&Enum, &Member)> {
        self.enums.iter().find_map(|one| Some((one, one.members.iter().find(|member| member.name == name)?)))
    }
}

impl Enum {
    /// A member's name without that of the enum: `DONE` of `BESPOKE_STAGE_DONE`.
    pub fn short<'m>(&self, member: &'m Member) -> &'m str {
        let prefix = format!("{}_", screaming(&self.name));
        member.name.strip_prefix(&prefix).unwrap_or(&member.name)
    }
}

impl Field {
    /// Neither its struct's size nor reserved.
    pub fn is_content(&self) -> bool {
        self.name != "struct_size" && !self.name.starts_with("reserved")
    }
}

/// `BESPOKE_DIAGNOSTIC_KIND` of `BespokeDiagnosticKind`.
pub fn screaming(camel: &str) -> String {
    let mut name = String::new();
    for letter in camel.chars() {
        if letter.is_ascii_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.push(letter.to_ascii_uppercase());
    }
    name
}

/// `FitWeight` of `fit_weight` and of `FIT_WEIGHT`.
pub fn pascal(name: &str) -> String {
    name.split('_')
        .map(|word| {
            let (first, rest) = word.split_at(word.len().min(1));
            first.to_ascii_uppercase() + &rest.to_ascii_lowercase()
        })
        .collect()
}
