//! Which changes of the layout are refused while the version of the binary interface stays.

use bespoke_bindgen::{check_compatible, description};

/// A header with one struct, whose size is known to it or not, and the pins that it gives.
fn pins(version: u32, fields: &str) -> String {
    let header = format!(
        "#ifndef BESPOKE_H\n#define BESPOKE_H\n#define BESPOKE_ABI_VERSION {version}\n\
         typedef struct BespokeOptions {{\n{fields}\n}} BespokeOptions;\n#endif\n"
    );
    let described = description(&header).expect("a header");
    let options = described.structure("BespokeOptions").expect("the struct");
    let mut text = format!("VALUE(BESPOKE_ABI_VERSION, {version})\nSTRUCT(BespokeOptions, {})\n", options.size);
    for field in &options.fields {
        text += &format!("FIELD(BespokeOptions, {}, {}, {})\n", field.name, field.offset, field.size);
    }
    text
}

const FIELD: &str = "/// Default 1.\n";

#[test]
fn fields_lie_as_in_c() {
    let text = pins(1, &format!("uint32_t struct_size;\n{FIELD}double a;\n{FIELD}uint32_t b;"));
    assert!(text.contains("STRUCT(BespokeOptions, 24)"), "{text}");
    assert!(text.contains("FIELD(BespokeOptions, a, 8, 8)"), "{text}");
    assert!(text.contains("FIELD(BespokeOptions, b, 16, 4)"), "{text}");
}

#[test]
fn a_struct_with_its_size_may_grow() {
    let old = pins(1, &format!("uint32_t struct_size;\nuint32_t reserved;\n{FIELD}double a;"));
    let grown = pins(1, &format!("uint32_t struct_size;\n{FIELD}uint32_t b;\n{FIELD}double a;\n{FIELD}double c;"));
    check_compatible(&old, &old).expect("the same");
    check_compatible("", &old).expect("the first");
    check_compatible(&old, &grown).expect("what was reserved has a name, and one more field");
}

#[test]
fn nothing_else_moves_within_a_version() {
    let old = pins(1, &format!("uint32_t struct_size;\nuint32_t reserved;\n{FIELD}double a;\n{FIELD}double b;"));
    let swapped = |version| {
        pins(version, &format!("uint32_t struct_size;\nuint32_t reserved;\n{FIELD}double b;\n{FIELD}double a;"))
    };
    let refused = check_compatible(&old, &swapped(1)).expect_err("two fields have changed places");
    assert!(refused.contains("FIELD(BespokeOptions, a, 8, 8)"), "{refused}");
    check_compatible(&old, &swapped(2)).expect("another version");
    let (small, large) =
        (pins(1, &format!("{FIELD}double a;")), pins(1, &format!("{FIELD}double a;\n{FIELD}double b;")));
    check_compatible(&small, &large).expect_err("a struct that does not know its size has grown");
}
