//! What is said on standard error.

use std::sync::{Mutex, PoisonError};

use bespoke::input::diagnostic::{DiagnosticKind, Severity};

use crate::fit::Finding;

/// So many findings of one kind are said of a garment; the report has all.
const OF_A_KIND: usize = 3;

/// What is said, where it is to be kept and not said at once.
static KEPT: Mutex<Option<String>> = Mutex::new(None);

/// Says one thing.
pub fn say(quiet: bool, what: &str) {
    if quiet {
        return;
    }
    match &mut *KEPT.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(kept) => *kept = format!("{kept}{what}\n"),
        None => eprintln!("{what}"),
    }
}

/// What `work` says, and what comes of it. Of one thread at a time.
pub fn heard<T>(work: impl FnOnce() -> T) -> (T, String) {
    let kept = || KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    *kept() = Some(String::new());
    let outcome = work();
    let said = kept().take();
    (outcome, said.unwrap_or_default())
}

/// Says what the library found in a garment: warnings and errors, and notes too where there is no result as designed.
pub fn say_findings(quiet: bool, garment: &str, findings: &[Finding], is_flawed: bool) {
    let matters = |finding: &&Finding| is_flawed || finding.severity != Severity::Note;
    for line in in_lines(findings.iter().filter(matters)) {
        say(quiet, &format!("{garment}: {line}"));
    }
}

/// Findings in lines, a few of each kind, in their order.
pub fn in_lines<'a>(findings: impl IntoIterator<Item = &'a Finding>) -> Vec<String> {
    let mut lines = Vec::new();
    let mut kinds: Vec<(Option<DiagnosticKind>, usize)> = Vec::new();
    for finding in findings {
        let place = kinds.iter().position(|&(kind, _)| kind == finding.kind).unwrap_or(kinds.len());
        if place == kinds.len() {
            kinds.push((finding.kind, 0));
        }
        kinds[place].1 += 1;
        if kinds[place].1 <= OF_A_KIND {
            lines.push(format!("{}: {}", word(finding.severity), finding.sentence));
        }
    }
    let more: usize = kinds.iter().map(|&(_, count)| count.saturating_sub(OF_A_KIND)).sum();
    if more > 0 {
        lines.push(format!("{more} more of these kinds; --json lists all"));
    }
    lines
}

/// A severity in a word.
pub fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}
