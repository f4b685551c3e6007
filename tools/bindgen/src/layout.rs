//! Where the fields of structs lie, by the rule of C on x86-64 and AArch64: each at the next multiple of its own alignment.
//! The rule is this tool's own; compilers prove what comes of it (tests/capi/layout.h), and so does the C# runtime.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::description::{Description, Field, Struct, Type};
use crate::{MARK, Result};

/// Size and alignment of one value.
fn measure(kind: &Type, known: &[Struct]) -> Result<(usize, usize)> {
    if kind.pointers > 0 {
        return Ok((8, 8));
    }
    let size = match kind.base.as_str() {
        "char" => 1,
        "uint32_t" => 4,
        "uint64_t" | "size_t" | "double" => 8,
        name => {
            let inner = known.iter().find(|one| one.name == name).ok_or(format!("the size of {name} is not known"))?;
            return Ok((inner.size, inner.alignment));
        }
    };
    Ok((size, size))
}

/// Fills in offsets and sizes; structs come after those that they hold.
pub fn lay_out(description: &mut Description) -> Result<()> {
    for k in 0..description.structs.len() {
        let (known, rest) = description.structs.split_at_mut(k);
        let structure = &mut rest[0];
        let (mut end, mut alignment) = (0usize, 1);
        for field in &mut structure.fields {
            let (size, aligned) = measure(&field.kind, known)?;
            field.offset = end.next_multiple_of(aligned);
            field.size = size * field.length.as_ref().map_or(1, |length| length.value);
            end = field.offset + field.size;
            alignment = alignment.max(aligned);
        }
        structure.size = end.next_multiple_of(alignment);
        structure.alignment = alignment;
    }
    Ok(())
}

/// tests/capi/layout.inc.
pub fn pins(description: &Description) -> String {
    let mut text = format!(
        "/* {MARK}\n\n   \
         What a binding relies on in bespoke.h: the layout of every struct where pointers have 64 bits, STRUCT(type, size) and\n   \
         FIELD(type, field, offset, size) in bytes, and every whole number with a name, VALUE(name, number). Whoever includes this\n   \
         says what the macros do. It changes only together with BESPOKE_ABI_VERSION, or where something is added: a field at the\n   \
         end of a struct with a struct_size, a new name. */\n"
    );
    for structure in &description.structs {
        let name = &structure.name;
        let _ = writeln!(text, "\nSTRUCT({name}, {})", structure.size);
        for Field { name: field, offset, size, .. } in &structure.fields {
            let _ = writeln!(text, "FIELD({name}, {field}, {offset}, {size})");
        }
    }
    for one in &description.enums {
        text.push('\n');
        for member in &one.members {
            let _ = writeln!(text, "VALUE({}, {})", member.name, member.value);
        }
    }
    text.push('\n');
    for constant in description.constants.iter().filter(|constant| constant.value.is_i64()) {
        let _ = writeln!(text, "VALUE({}, {})", constant.name, constant.value);
    }
    text
}

/// Pins as sets of their lines.
fn lines<'t>(pins: &'t str, kind: &str) -> BTreeSet<&'t str> {
    pins.lines().filter(|line| line.starts_with(kind)).collect()
}

/// Refuses pins that break programs which were built with the committed ones, unless BESPOKE_ABI_VERSION says so. Structs
/// with a `struct_size` may grow, and what is reserved may get a name.
pub fn check_compatible(committed: &str, new: &str) -> Result<()> {
    let version = "VALUE(BESPOKE_ABI_VERSION,";
    if committed.is_empty() || lines(committed, version) != lines(new, version) {
        return Ok(());
    }
    let is_reserved = |line: &str| line.contains(", reserved");
    let may_grow = |line: &str| {
        let name = line.trim_start_matches("STRUCT(").split(',').next().unwrap_or_default();
        committed.contains(&format!("FIELD({name}, struct_size, 0, 4)"))
    };
    let lost = |kind| -> Vec<&str> { lines(committed, kind).difference(&lines(new, kind)).copied().collect() };
    let broken = lost("STRUCT(")
        .into_iter()
        .filter(|line| !may_grow(line))
        .chain(lost("FIELD(").into_iter().filter(|line| !is_reserved(line)))
        .chain(lost("VALUE("))
        .collect::<Vec<_>>();
    if broken.is_empty() {
        return Ok(());
    }
    Err(format!(
        "the binary interface would change within one BESPOKE_ABI_VERSION: {} would be no more. Raise the version in \
         src/capi/version.rs; where this version was never released, delete tests/capi/layout.inc instead and run again",
        broken.join(" ")
    ))
}
