//! A value of the JSON with the path that leads to it, for messages.

use serde_json::Value;

use crate::error::{Error, Result};

/// Largest index that is followed: counts of a file are far below, and sums of them do not overflow.
const MOST: u64 = 1 << 53;

/// A value and where it is.
#[derive(Clone, Debug)]
pub(crate) struct At<'a> {
    pub value: &'a Value,
    pub path: String,
}

impl<'a> At<'a> {
    pub fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    pub fn error(&self, message: impl Into<String>) -> Error {
        Error::json(&self.path, message)
    }

    /// The value of `key`; none where this is no object or has no such key.
    pub fn get(&self, key: &str) -> Option<At<'a>> {
        let path = || format!("{}/{}", self.path, key.replace('~', "~0").replace('/', "~1"));
        self.value.get(key).map(|value| At { value, path: path() })
    }

    /// The value of `key`, which must be there.
    pub fn need(&self, key: &str) -> Result<At<'a>> {
        self.get(key).ok_or_else(|| self.error(format!("has no '{key}'")))
    }

    /// The entries of an array.
    pub fn list(&self) -> Result<impl ExactSizeIterator<Item = At<'a>> + use<'a>> {
        let entries = self.value.as_array().ok_or_else(|| self.error("is no array"))?;
        let path = self.path.clone();
        Ok(entries.iter().enumerate().map(move |(i, value)| At { value, path: format!("{path}/{i}") }))
    }

    /// The entries of the array `key`; empty where there is none.
    pub fn list_of(&self, key: &str) -> Result<Vec<At<'a>>> {
        self.get(key).map_or(Ok(Vec::new()), |list| Ok(list.list()?.collect()))
    }

    /// How many entries the array `key` has.
    pub fn count_of(&self, key: &str) -> Result<usize> {
        self.get(key).map_or(Ok(0), |list| Ok(list.list()?.len()))
    }

    /// The entry `index` of the array `key`.
    pub fn entry(&self, key: &str, index: usize) -> Option<At<'a>> {
        let value = self.value.get(key)?.get(index)?;
        Some(At { value, path: format!("{}/{key}/{index}", self.path) })
    }

    /// A whole number that is not negative. `5.0` is one: some exporters write that.
    pub fn count(&self) -> Result<usize> {
        let number = self.value.as_u64().or_else(|| {
            let number = self.value.as_f64()?;
            (number.fract() == 0.0 && (0.0..=MOST as f64).contains(&number)).then_some(number as u64)
        });
        let number = number.ok_or_else(|| self.error("is no whole number from 0 on"))?;
        let number =
            Some(number).filter(|n| *n <= MOST).ok_or_else(|| self.error(format!("is too large ({number})")))?;
        usize::try_from(number).map_err(|_| self.error(format!("is too large ({number})")))
    }

    /// The number of `key`, or `default` where there is none.
    pub fn count_of_key(&self, key: &str, default: usize) -> Result<usize> {
        self.get(key).map_or(Ok(default), |at| at.count())
    }

    /// The index of `key` into a list of `count`, if it is there.
    pub fn index(&self, key: &str, list: &str, count: usize) -> Result<Option<usize>> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.index_into(list, count).map(Some)
    }

    /// This as an index into a list of `count`.
    pub fn index_into(&self, list: &str, count: usize) -> Result<usize> {
        let index = self.count()?;
        if index < count { Ok(index) } else { Err(self.error(format!("is {index}, but there are {count} {list}"))) }
    }

    pub fn number(&self) -> Result<f64> {
        let number = self.value.as_f64().ok_or_else(|| self.error("is no number"))?;
        if number.is_finite() { Ok(number) } else { Err(self.error("is no number that 64 bits can hold")) }
    }

    /// Exactly `N` numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f64; N]> {
        let entries = self.list()?;
        if entries.len() != N {
            return Err(self.error(format!("has {} numbers instead of {N}", entries.len())));
        }
        let mut numbers = [0.0; N];
        for (number, entry) in numbers.iter_mut().zip(entries) {
            *number = entry.number()?;
        }
        Ok(numbers)
    }

    pub fn text(&self) -> Result<&'a str> {
        self.value.as_str().ok_or_else(|| self.error("is no text"))
    }

    /// The text of `key`; empty where there is none.
    pub fn text_of(&self, key: &str) -> &'a str {
        self.value.get(key).and_then(Value::as_str).unwrap_or_default()
    }

    /// The extension `name` of this object.
    pub fn extension(&self, name: &str) -> Option<At<'a>> {
        self.get("extensions")?.get(name)
    }
}
