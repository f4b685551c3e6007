//! A figure: a sheet of pictures, a table, and what it claims.

use std::fmt::Write as _;

use gallery::sheet::Sheet;

/// What a figure needs that may fail, with a sentence.
pub type Outcome<T> = Result<T, String>;

/// A figure.
pub struct Figure {
    /// Its pictures.
    pub sheet: Sheet,
    /// Headings of the table's columns.
    pub columns: Vec<&'static str>,
    /// One text a column.
    pub rows: Vec<Vec<String>>,
    /// What the figure shows, and whether it does.
    claims: Vec<(String, bool)>,
}

impl Figure {
    /// Without rows and claims.
    pub fn new(sheet: Sheet, columns: &[&'static str]) -> Self {
        Self { sheet, columns: columns.to_vec(), rows: Vec::new(), claims: Vec::new() }
    }

    /// Claims that `holds`, in words.
    pub fn claim(&mut self, holds: bool, words: impl Into<String>) {
        self.claims.push((words.into(), holds));
    }

    /// Claims that do not hold.
    pub fn failed(&self) -> usize {
        self.claims.iter().filter(|(_, holds)| !holds).count()
    }

    /// Table and claims.
    pub fn markdown(&self) -> String {
        let mut text = format!("# {}\n\n{}\n\n", self.sheet.title, self.sheet.subtitle);
        let _ = writeln!(text, "| {} |", self.columns.join(" | "));
        let _ = writeln!(text, "|{}", " --- |".repeat(self.columns.len()));
        for row in &self.rows {
            let _ = writeln!(text, "| {} |", row.join(" | "));
        }
        text.push('\n');
        for (words, holds) in &self.claims {
            let _ = writeln!(text, "- {}: {words}", if *holds { "holds" } else { "DOES NOT HOLD" });
        }
        text
    }
}
