//! The header as a C99 compiler sees it: of each `#if` the part that holds for C99. cbindgen gives enums their type in
//! C23 and C++ only, in the midst of the declaration, where no parser of plain C would expect it.

use crate::Result;

fn holds(condition: &str) -> Result<bool> {
    match condition {
        "ifndef BESPOKE_H" | "ifndef __cplusplus" => Ok(true),
        "ifdef __cplusplus"
        | "if __STDC_VERSION__ >= 202311L"
        | "if defined(__cplusplus) || __STDC_VERSION__ >= 202311L" => Ok(false),
        other => Err(format!("include/bespoke.h: the condition `#{other}` is not known")),
    }
}

/// `header` with empty lines instead of directives and of what does not hold, so that lines keep their numbers.
pub fn plain_c(header: &str) -> Result<String> {
    let mut text = String::new();
    let mut open = Vec::new();
    for line in header.lines() {
        let directive = line.trim().strip_prefix('#').map(|rest| rest.split("//").next().unwrap_or(rest).trim());
        match directive {
            Some(condition) if condition.starts_with("if") => open.push(holds(condition)?),
            Some("else") => {
                let last = open.last_mut().ok_or("include/bespoke.h: an #else without its #if")?;
                *last = !*last;
            }
            Some(end) if end.split_whitespace().next() == Some("endif") => {
                open.pop().ok_or("include/bespoke.h: an #endif without its #if")?;
            }
            _ if open.iter().all(|&holds| holds) => text.push_str(line),
            _ => {}
        }
        text.push('\n');
    }
    Ok(text)
}
