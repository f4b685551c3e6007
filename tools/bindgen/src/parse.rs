//! The header, parsed.

use tree_sitter::Node;

use crate::description::{
    Constant, Description, Enum, Field, Function, Handle, Length, Member, Parameter, Struct, Type,
};
use crate::{MARK, Result, layout, options, preprocess};

/// Reads a header that cbindgen wrote.
///
/// # Errors
/// A sentence with the line, where something is in it that this tool does not know.
pub fn description(header: &str) -> Result<Description> {
    let source = preprocess::plain_c(header)?;
    let mut parser = tree_sitter::Parser::new();
    parser.set_language(&tree_sitter_c::LANGUAGE.into()).map_err(|reason| reason.to_string())?;
    let tree = parser.parse(&source, None).ok_or("the parser gave up")?;
    let mut reader = Reader { source: &source, description: empty() };
    reader.file(tree.root_node())?;
    let mut description = reader.description;
    resolve_numbers(&mut description);
    layout::lay_out(&mut description)?;
    description.options = options::table(&description)?;
    Ok(description)
}

fn empty() -> Description {
    Description {
        generated: MARK.to_string(),
        constants: Vec::new(),
        enums: Vec::new(),
        handles: Vec::new(),
        structs: Vec::new(),
        functions: Vec::new(),
        options: Vec::new(),
    }
}

struct Reader<'s> {
    source: &'s str,
    description: Description,
}

impl Reader<'_> {
    fn text(&self, node: Node) -> String {
        self.source[node.byte_range()].trim().to_string()
    }

    fn unknown<T>(&self, node: Node) -> Result<T> {
        let line = node.start_position().row + 1;
        let text = self.text(node);
        let start = text.lines().next().unwrap_or_default();
        Err(format!("include/bespoke.h, line {line}: `{start}` ({}) is not known to the tool", node.kind()))
    }

    fn child<'n>(&self, node: Node<'n>, field: &str) -> Result<Node<'n>> {
        node.child_by_field_name(field).map_or_else(|| self.unknown(node), Ok)
    }

    /// Children with the comments above them. A comment with three slashes describes what comes next.
    fn documented<'n>(&self, node: Node<'n>) -> Vec<(String, Node<'n>)> {
        let mut found = Vec::new();
        let mut lines: Vec<String> = Vec::new();
        let mut cursor = node.walk();
        for child in node.named_children(&mut cursor) {
            if child.kind() == "comment" {
                if let Some(line) = self.text(child).strip_prefix("///") {
                    lines.push(line.trim().to_string());
                }
                continue;
            }
            found.push((paragraphs(&std::mem::take(&mut lines)), child));
        }
        found
    }

    fn file(&mut self, file: Node) -> Result<()> {
        for (doc, node) in self.documented(file) {
            match node.kind() {
                "preproc_include" => {}
                "preproc_def" => self.constant(doc, node)?,
                "enum_specifier" => self.enumeration(doc, node)?,
                "type_definition" => self.type_definition(doc, node)?,
                "declaration" => self.function(doc, node)?,
                _ => return self.unknown(node),
            }
        }
        Ok(())
    }

    fn constant(&mut self, doc: String, node: Node) -> Result<()> {
        let Some(value) = node.child_by_field_name("value") else { return Ok(()) };
        let value = serde_json::from_str(&self.text(value)).or_else(|_| self.unknown(node))?;
        let name = self.text(self.child(node, "name")?);
        self.description.constants.push(Constant { name, value, doc });
        Ok(())
    }

    fn enumeration(&mut self, doc: String, node: Node) -> Result<()> {
        let mut members = Vec::new();
        for (doc, member) in self.documented(self.child(node, "body")?) {
            let value = self.text(self.child(member, "value")?).parse().or_else(|_| self.unknown(member))?;
            members.push(Member { name: self.text(self.child(member, "name")?), value, doc });
        }
        let name = self.text(self.child(node, "name")?);
        self.description.enums.push(Enum { name, doc, members });
        Ok(())
    }

    /// A struct, an opaque one, or the number as which an enum crosses.
    fn type_definition(&mut self, doc: String, node: Node) -> Result<()> {
        let kind = self.child(node, "type")?;
        let name = self.text(self.child(node, "declarator")?);
        if self.text(kind) == "uint32_t" && self.description.enums.iter().any(|one| one.name == name) {
            return Ok(());
        }
        if kind.kind() != "struct_specifier" {
            return self.unknown(node);
        }
        let Some(body) = kind.child_by_field_name("body") else {
            self.description.handles.push(Handle { name, doc });
            return Ok(());
        };
        let fields = self.documented(body).into_iter().map(|(doc, field)| self.field(doc, field));
        let fields = fields.collect::<Result<Vec<_>>>()?;
        self.description.structs.push(Struct { name, doc, size: 0, alignment: 0, fields });
        Ok(())
    }

    fn field(&self, doc: String, node: Node) -> Result<Field> {
        let mut declared = Declared::new(self.base(node)?);
        let name = self.declarator(self.child(node, "declarator")?, &mut declared)?;
        let mut kind = declared.kind;
        self.meaning(&mut kind, &doc);
        Ok(Field { name, kind, length: declared.length, offset: 0, size: 0, doc })
    }

    fn function(&mut self, doc: String, node: Node) -> Result<()> {
        let mut returns = Declared::new(self.base(node)?);
        let mut declarator = self.child(node, "declarator")?;
        while declarator.kind() == "pointer_declarator" {
            returns.kind.pointers += 1;
            declarator = self.child(declarator, "declarator")?;
        }
        if declarator.kind() != "function_declarator" {
            return self.unknown(node);
        }
        let name = self.text(self.child(declarator, "declarator")?);
        let list = self.child(declarator, "parameters")?;
        let mut cursor = list.walk();
        let mut parameters = Vec::new();
        for parameter in list.named_children(&mut cursor) {
            let Some(inner) = parameter.child_by_field_name("declarator") else { continue };
            let mut declared = Declared::new(self.base(parameter)?);
            let name = self.declarator(inner, &mut declared)?;
            parameters.push(Parameter { name, kind: declared.kind });
        }
        for k in 0..parameters.len() {
            let said = said_of(&doc, k, &parameters);
            self.meaning(&mut parameters[k].kind, &said);
        }
        self.description.functions.push(Function { name, doc, returns: returns.kind, parameters });
        Ok(())
    }

    /// The type of a declaration, without what belongs to the name.
    fn base(&self, node: Node) -> Result<Type> {
        let kind = self.child(node, "type")?;
        let base = match kind.kind() {
            "struct_specifier" => self.text(self.child(kind, "name")?),
            "primitive_type" | "type_identifier" => self.text(kind),
            _ => return self.unknown(node),
        };
        let mut cursor = node.walk();
        let is_const = node
            .named_children(&mut cursor)
            .any(|child| child.kind() == "type_qualifier" && self.text(child) == "const");
        Ok(Type { base, pointers: 0, is_const, enumeration: None, is_flag: false })
    }

    /// The name within a declarator; pointers and lengths go to `declared`.
    fn declarator(&self, node: Node, declared: &mut Declared) -> Result<String> {
        match node.kind() {
            "identifier" | "field_identifier" => Ok(self.text(node)),
            "pointer_declarator" => {
                declared.kind.pointers += 1;
                self.declarator(self.child(node, "declarator")?, declared)
            }
            "array_declarator" => {
                let constant = self.text(self.child(node, "size")?);
                let known = self.description.constant(&constant).and_then(|known| known.value.as_u64());
                let Some(value) = known else { return self.unknown(node) };
                declared.length = Some(Length { constant, value: value as usize });
                self.declarator(self.child(node, "declarator")?, declared)
            }
            _ => self.unknown(node),
        }
    }

    /// What the comment says that C's type does not: a flag.
    fn meaning(&self, kind: &mut Type, doc: &str) {
        if kind.base == "uint32_t" {
            kind.is_flag = kind.pointers == 0 && (doc.starts_with("1: ") || doc.starts_with("1 where "));
            kind.enumeration = named_enum(doc).map(str::to_string);
        }
    }
}

struct Declared {
    kind: Type,
    length: Option<Length>,
}

impl Declared {
    fn new(kind: Type) -> Self {
        Self { kind, length: None }
    }
}

/// What is meant by "one of BespokeStage", or the first number of an enum where none is named.
fn named_enum(doc: &str) -> Option<&str> {
    let lead = doc.find("ne of Bespoke").map(|at| at + "ne of ".len());
    let start = lead
        .or_else(|| doc.starts_with("BESPOKE_").then_some(0))
        .or_else(|| doc.find(", BESPOKE_").map(|at| at + 2))?;
    doc[start..].split(|letter: char| !letter.is_ascii_alphanumeric() && letter != '_').next()
}

/// Names of numbers become those of their enums; what is no enum is dropped.
fn resolve_numbers(description: &mut Description) {
    let resolve = |name: &Option<String>| {
        let name = name.as_deref()?;
        let whole = description.enums.iter().find(|one| one.name == name);
        whole.or_else(|| Some(description.member(name)?.0)).map(|one| one.name.clone())
    };
    let of_fields: Vec<Vec<_>> = description
        .structs
        .iter()
        .map(|one| one.fields.iter().map(|field| resolve(&field.kind.enumeration)).collect())
        .collect();
    let of_parameters: Vec<Vec<_>> = description
        .functions
        .iter()
        .map(|one| one.parameters.iter().map(|parameter| resolve(&parameter.kind.enumeration)).collect())
        .collect();
    for (structure, names) in description.structs.iter_mut().zip(of_fields) {
        for (field, name) in structure.fields.iter_mut().zip(names) {
            field.kind.enumeration = name;
        }
    }
    for (function, names) in description.functions.iter_mut().zip(of_parameters) {
        for (parameter, name) in function.parameters.iter_mut().zip(names) {
            parameter.kind.enumeration = name;
        }
    }
}

/// The part of a function's comment that describes a parameter: behind its name in backquotes, up to the next one's.
fn said_of(doc: &str, index: usize, parameters: &[Parameter]) -> String {
    let find = |name: &str| [format!("`{name}`"), format!("`*{name}`")].iter().find_map(|mark| doc.find(mark.as_str()));
    let Some(start) = find(&parameters[index].name) else { return String::new() };
    let topics = ["State:", "Errors:", "Ownership:", "Threads:"].iter().filter_map(|topic| doc.find(topic));
    let others = parameters.iter().filter_map(|parameter| find(&parameter.name));
    let end = topics.chain(others).filter(|&at| at > start).min().unwrap_or(doc.len());
    doc[start..end].to_string()
}

fn paragraphs(lines: &[String]) -> String {
    lines.split(|line| line.is_empty()).map(|lines| lines.join(" ")).collect::<Vec<_>>().join("\n\n")
}
