//! The committed files are what include/bespoke.h gives, and the description is whole.

use bespoke_bindgen::description::Audience;
use bespoke_bindgen::{Description, description, generate, root};

fn described() -> Description {
    let header = std::fs::read_to_string(root().join("include/bespoke.h")).expect("include/bespoke.h is committed");
    description(&header).expect("the header can be read")
}

#[test]
fn committed_files_match_the_header() {
    for file in generate(&root()).expect("the header can be read") {
        let path = file.path.display();
        assert!(
            file.committed() == file.text,
            "{path} is not what include/bespoke.h gives; run `make bindings` and commit it"
        );
    }
}

/// Counted in the text: nothing of the header was overlooked.
#[test]
fn description_is_whole() {
    let header = std::fs::read_to_string(root().join("include/bespoke.h")).expect("include/bespoke.h is committed");
    let lines = |found: fn(&str) -> bool| header.lines().filter(|line| found(line)).count();
    let said = described();
    assert_eq!(said.structs.len(), lines(|line| line.starts_with("typedef struct") && line.ends_with('{')));
    assert_eq!(said.handles.len(), lines(|line| line.starts_with("typedef struct") && line.ends_with(';')));
    assert_eq!(said.enums.len(), lines(|line| line.starts_with("enum ")));
    assert_eq!(
        said.constants.len(),
        lines(|line| line.starts_with("#define BESPOKE_") && line.split(' ').count() == 3)
    );
    assert_eq!(
        said.enums.iter().map(|one| one.members.len()).sum::<usize>(),
        lines(|line| line.starts_with("  BESPOKE_") && line.ends_with(','))
    );
    let functions =
        lines(|line| !line.trim_start().starts_with("//") && line.contains("bespoke_") && line.contains('('));
    assert_eq!(said.functions.len(), functions);
    assert!(functions > 30 && said.structs.len() > 10);
    let documented = said.structs.iter().flat_map(|one| one.fields.iter().map(|field| &field.doc));
    for doc in documented.chain(said.functions.iter().map(|one| &one.doc)).chain(said.enums.iter().map(|one| &one.doc))
    {
        assert!(!doc.is_empty());
    }
}

/// Numbers that stand for something are known as such.
#[test]
fn numbers_have_their_meaning() {
    let said = described();
    let field = |of: &str, name: &str| {
        let fields = &said.structure(of).expect("a struct").fields;
        fields.iter().find(|field| field.name == name).expect("a field").kind.clone()
    };
    assert_eq!(field("BespokeProgress", "stage").enumeration.as_deref(), Some("BespokeStage"));
    assert_eq!(field("BespokeBuffer", "component").enumeration.as_deref(), Some("BespokeComponent"));
    assert_eq!(field("BespokeProgress", "iteration").enumeration, None);
    assert!(field("BespokeReport", "is_verified").is_flag && !field("BespokeReport", "threads").is_flag);
    let step = said.functions.iter().find(|one| one.name == "bespoke_session_step").expect("the function");
    let meanings: Vec<_> = step.parameters.iter().map(|one| one.kind.enumeration.as_deref()).collect();
    assert_eq!(meanings, [None, None, None, Some("BespokeStage")]);
}

#[test]
fn every_option_says_what_it_is() {
    let said = described();
    let option = |name: &str| said.options.iter().find(|option| option.name == name).expect("an option");
    let weight = option("fit_weight");
    assert_eq!(
        (weight.audience, weight.default_value, weight.off.as_deref()),
        (Audience::Artist, Some(2.0), Some("no fit"))
    );
    let dhat = option("dhat");
    assert_eq!(
        (dhat.audience, dhat.default_value, dhat.range.as_deref()),
        (Audience::Expert, Some(0.002), Some("1e-5, 0.1"))
    );
    assert_eq!(option("curvature_weight").off.as_deref(), Some(""));
    assert_eq!(option("memory_limit").default, "no limit");
    assert_eq!(option("surface_form").default, "BESPOKE_SURFACE_FORM_SIMILARITY");
    assert!(option("strict").kind.is_flag);
}
