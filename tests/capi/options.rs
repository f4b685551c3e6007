//! What the comments say of the options holds: bindings/bespoke.json has their defaults, their ranges and whether they can be
//! switched off, and each of these is tried. An option that is added is tried without a word here.

use std::fs;

use bespoke::capi::options::*;
use bespoke::capi::status::BespokeStatus::{InvalidArgument, Ok as Accepted};
use serde_json::Value;
use testing::caller::{Caller, no_options};
use testing::process::root;

/// One row of the table, and where its field lies.
struct Entry {
    said: Value,
    offset: usize,
}

impl Entry {
    fn text(&self, key: &str) -> Option<&str> {
        self.said[key].as_str()
    }

    fn name(&self) -> &str {
        self.text("name").expect("an option has a name")
    }

    /// The bytes of a value in the type of the field.
    fn bytes(&self, value: f64) -> Vec<u8> {
        match self.text("type") {
            Some("double") => value.to_ne_bytes().to_vec(),
            Some("uint32_t") => (value as u32).to_ne_bytes().to_vec(),
            Some("uint64_t") => (value as u64).to_ne_bytes().to_vec(),
            other => panic!("{} is {other:?}", self.name()),
        }
    }

    /// `options` with this value.
    fn with(&self, options: BespokeOptions, value: f64) -> BespokeOptions {
        let bytes = self.bytes(value);
        let mut changed = options;
        assert!(self.offset + bytes.len() <= size_of::<BespokeOptions>());
        // SAFETY: the field lies within the struct, and any bytes are numbers.
        unsafe {
            let field = (&raw mut changed).cast::<u8>().add(self.offset);
            std::ptr::copy_nonoverlapping(bytes.as_ptr(), field, bytes.len());
        }
        changed
    }

    /// The ends of the range in brackets.
    fn range(&self) -> Option<(f64, f64)> {
        let text = self.text("range")?;
        let number = |text: &str| text.parse::<f64>().unwrap_or_else(|_| panic!("{text} is no number"));
        Some(match (text.strip_prefix("up to "), text.split_once(", ")) {
            (Some(high), _) => (0.0, number(high)),
            (None, Some((low, high))) => (number(low), number(high)),
            _ => panic!("the range of {} is {text}", self.name()),
        })
    }
}

fn entries() -> Vec<Entry> {
    let text = fs::read_to_string(root().join("bindings/bespoke.json")).expect("bindings/bespoke.json is committed");
    let said: Value = serde_json::from_str(&text).expect("JSON");
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let structs = list(&said["structs"]);
    let options = structs.iter().find(|one| one["name"] == "BespokeOptions").expect("the struct");
    let fields = list(&options["fields"]);
    let entry = |said: &Value| {
        let field = fields.iter().find(|field| field["name"] == said["name"]).expect("its field");
        Entry { said: said.clone(), offset: field["offset"].as_u64().expect("its offset") as usize }
    };
    let entries: Vec<_> = list(&said["options"]).iter().map(entry).collect();
    assert!(entries.len() > 20, "only {} options were found", entries.len());
    entries
}

#[test]
fn defaults_are_those_of_the_comments() {
    let mut defaults = no_options();
    // SAFETY: the options are as large as they say.
    assert_eq!(unsafe { bespoke_options_read_defaults(&mut defaults) }, Accepted);
    for entry in entries() {
        // Where it is no number, as "no limit" or the first form of the surface term, it is 0.
        let said = entry.said["default_value"].as_f64().unwrap_or(0.0);
        assert_eq!(entry.with(defaults, said), defaults, "the default of {} is not {said}", entry.name());
    }
}

#[test]
fn ranges_are_those_of_the_comments() {
    let caller = Caller::new();
    // SAFETY: the options are as large as they say.
    let set = |options: BespokeOptions| unsafe { bespoke_session_set_options(caller.session, &options) };
    // What one option allows another, it allows all of them.
    let base = BespokeOptions { dhat: 0.1, inflation_dhat: 0.1, min_separation: 1e-8, ..no_options() };
    for entry in entries() {
        let accepted = |value| caller.accepted(set(entry.with(base, value)));
        let refused = |value| caller.refused(set(entry.with(base, value)), InvalidArgument, &[entry.name()]);
        let is_double = entry.text("type") == Some("double");
        if let Some((low, high)) = entry.range() {
            accepted(low);
            accepted(high);
            refused(high * 1.01 + f64::from(u8::from(!is_double)));
            if low > 0.0 && is_double {
                refused(low * 0.99);
            }
        }
        if is_double {
            refused(f64::NAN);
            refused(-2.0);
            match entry.text("off") {
                Some(_) => accepted(BESPOKE_WEIGHT_OFF),
                None => refused(BESPOKE_WEIGHT_OFF),
            }
        } else if entry.said["is_flag"] == true {
            accepted(1.0);
            refused(2.0);
        }
    }
}
