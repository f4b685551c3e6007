//! Messages about the common skeleton of two rigs, in words that their caller knows.
//!
//! Inside, a joint is a number. A caller of two rigs has given no number to the joints of their common skeleton, so its
//! messages name them: "the bone between joints 9 and 10" becomes "the bone between left hip and left knee".

/// `message` with the numbers of joints replaced by their `names`.
pub fn with_names(message: &str, names: &[String]) -> String {
    let mut out = String::with_capacity(message.len());
    let mut rest = message;
    while let Some(at) = rest.find("joint") {
        let (before, found) = rest.split_at(at);
        out.push_str(before);
        let is_word = !before.chars().next_back().is_some_and(char::is_alphanumeric);
        match named(found, names).filter(|_| is_word) {
            Some((text, length)) => {
                out.push_str(&text);
                rest = &found[length..];
            }
            None => {
                out.push_str("joint");
                rest = &found["joint".len()..];
            }
        }
    }
    out + rest
}

/// The joints with which `text` begins by their names, and how long that was: "joint 3", "joints 3 and 4", "joints 3-4".
fn named(text: &str, names: &[String]) -> Option<(String, usize)> {
    let (after, several) = match text.strip_prefix("joints ") {
        Some(after) => (after, true),
        None => (text.strip_prefix("joint ")?, false),
    };
    let (first, after) = number(after, names)?;
    if !several {
        return Some((first.clone(), text.len() - after.len()));
    }
    let between = [" and ", "-"].into_iter().find(|word| after.starts_with(word))?;
    let (second, after) = number(&after[between.len()..], names)?;
    let word = if between == "-" { " to " } else { between };
    Some((format!("{first}{word}{second}"), text.len() - after.len()))
}

/// The joint whose number `text` begins with, and what follows.
fn number<'t, 'n>(text: &'t str, names: &'n [String]) -> Option<(&'n String, &'t str)> {
    let digits = text.chars().take_while(char::is_ascii_digit).count();
    let joint: usize = text[..digits].parse().ok()?;
    Some((names.get(joint)?, &text[digits..]))
}
