//! The options that were set, by the names that the library gives them.

use std::collections::BTreeMap;

use godot::builtin::{Array, VarDictionary, Variant};

use crate::native::{BESPOKE_WEIGHT_OFF, BespokeOptions};
use crate::session::{Failure, Result, default_options, unset_options};
use crate::words::{OPTIONS, OptionWord, Slot};

/// What was set; all else is as by default.
#[derive(Default)]
pub struct Options(BTreeMap<&'static str, f64>);

fn entry(name: &str) -> Result<&'static OptionWord> {
    OPTIONS.iter().find(|option| option.name == name).ok_or_else(|| {
        let names: Vec<&str> = OPTIONS.iter().map(|option| option.name).collect();
        Failure::argument(format!("there is no option '{name}'; there are {}", names.join(", ")))
    })
}

/// 0 is the default in C; here it is 0, where that is a value.
fn is_zero_allowed(option: &OptionWord) -> bool {
    option.off.is_some()
        || option.is_flag
        || matches!((option.slot)(&mut unset_options()), Slot::Count(_) | Slot::Bytes(_))
        || option.default == "0"
}

impl Options {
    /// Sets an option; nil takes it back to its default.
    ///
    /// # Errors
    /// There is no such option, or it is no number that could be right. Ranges are checked by the library as it begins.
    pub fn set(&mut self, name: &str, value: &Variant) -> Result<()> {
        let option = entry(name)?;
        if value.is_nil() {
            self.0.remove(option.name);
            return Ok(());
        }
        let number =
            value.try_to_relaxed::<f64>().or_else(|_| value.try_to::<bool>().map(|flag| f64::from(u8::from(flag))));
        let number = number
            .ok()
            .filter(|number| number.is_finite() && *number >= 0.0)
            .ok_or_else(|| Failure::argument(format!("option {name}: {value} is no finite number from 0 on")))?;
        if number == 0.0 && !is_zero_allowed(option) {
            return Err(Failure::argument(format!("option {name}: it must be above 0")));
        }
        self.0.insert(option.name, number);
        Ok(())
    }

    /// What is set, or the default.
    ///
    /// # Errors
    /// There is no such option.
    pub fn get(&self, name: &str) -> Result<Variant> {
        let option = entry(name)?;
        let number = self.0.get(option.name).copied().unwrap_or_else(|| default(option));
        Ok(value(option, number))
    }

    /// As the library takes them.
    pub fn to_native(&self) -> BespokeOptions {
        let mut options = unset_options();
        for (name, &number) in &self.0 {
            let Ok(option) = entry(name) else { continue };
            match (option.slot)(&mut options) {
                Slot::Real(slot) => {
                    *slot = if number == 0.0 && option.off.is_some() { BESPOKE_WEIGHT_OFF } else { number }
                }
                Slot::Count(slot) => *slot = number as u32,
                Slot::Bytes(slot) => *slot = number as u64,
            }
        }
        options
    }
}

fn default(option: &OptionWord) -> f64 {
    match (option.slot)(&mut default_options()) {
        Slot::Real(&mut number) => number.max(0.0),
        Slot::Count(&mut number) => f64::from(number),
        Slot::Bytes(&mut number) => number as f64,
    }
}

fn value(option: &OptionWord, number: f64) -> Variant {
    match (option.slot)(&mut unset_options()) {
        _ if option.is_flag => Variant::from(number != 0.0),
        Slot::Real(_) => Variant::from(number),
        Slot::Count(_) | Slot::Bytes(_) => Variant::from(number as i64),
    }
}

/// All options as a table for tools.
pub fn table() -> Array<VarDictionary> {
    let row = |option: &OptionWord| {
        let mut row = VarDictionary::new();
        row.set("name", option.name);
        row.set("text", option.text);
        row.set("default", &value(option, default(option)));
        row.set("default_text", option.default);
        row.set("range", option.range.unwrap_or_default());
        row.set("is_expert", option.is_expert);
        row
    };
    OPTIONS.iter().map(row).collect()
}
