//! Comments of the header in the words of another language: what they name becomes what it is called there.

use crate::description::{Description, Enum, Member, Type};

/// How a language writes what a comment names.
pub trait Names {
    /// A number of an enum.
    fn member(&self, one: &Enum, member: &Member) -> String;
    /// An enum.
    fn enumeration(&self, name: &str) -> String;
    /// A struct or a handle.
    fn structure(&self, name: &str) -> String;
    /// A function.
    fn function(&self, name: &str) -> String;
    /// A constant.
    fn constant(&self, name: &str) -> String;
    /// What stands in backquotes.
    fn quoted(&self, text: &str) -> String;
    /// All else.
    fn plain(&self, text: &str) -> String {
        text.to_string()
    }
}

fn is_word(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_'
}

fn name(word: &str, description: &Description, names: &impl Names) -> String {
    if let Some((one, member)) = description.member(word) {
        return names.member(one, member);
    }
    if description.enums.iter().any(|one| one.name == word) {
        return names.enumeration(word);
    }
    if description.structure(word).is_some() || description.handles.iter().any(|one| one.name == word) {
        return names.structure(word);
    }
    if description.functions.iter().any(|one| one.name == word) {
        return names.function(word);
    }
    if description.constant(word).is_some() {
        return names.constant(word);
    }
    names.plain(word)
}

/// `text` with the names of another language.
pub fn translate(text: &str, description: &Description, names: &impl Names) -> String {
    let mut translated = String::new();
    for (k, part) in text.split('`').enumerate() {
        if k % 2 == 1 {
            translated += &names.quoted(part);
            continue;
        }
        let mut rest = part;
        while let Some(letter) = rest.chars().next() {
            let is_name = is_word(letter);
            let end = rest.find(|other: char| is_word(other) != is_name).unwrap_or(rest.len());
            let (piece, behind) = rest.split_at(end);
            translated += &if is_name { name(piece, description, names) } else { names.plain(piece) };
            rest = behind;
        }
    }
    translated
}

/// The comment of a flag, in a language that has true and false.
pub fn of_flag(doc: &str, kind: &Type) -> String {
    if !kind.is_flag {
        return doc.to_string();
    }
    doc.replacen("1: ", "True: ", 1).replace("Default 0", "Default false").replace("Default 1", "Default true")
}

/// The first sentence without its full stop, and what comes behind it. A point within a number ends none, nor does "Eq.".
pub fn sentence(text: &str) -> (&str, &str) {
    let end = text.match_indices(". ").map(|(at, _)| at).find(|&at| !text[..at].ends_with("Eq"));
    match end {
        Some(end) => (&text[..end], &text[end + 2..]),
        None => (text.strip_suffix('.').unwrap_or(text), ""),
    }
}

/// Lines of at most so many letters. A space within a tag, `<see cref="..."/>`, ends no line.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut words = Vec::<String>::new();
    for piece in text.split(' ') {
        match words.last_mut() {
            Some(tag) if tag.rfind("<see").is_some_and(|begin| !tag[begin..].contains('>')) => {
                *tag += &format!(" {piece}");
            }
            _ => words.push(piece.to_string()),
        }
    }
    let mut lines = Vec::<String>::new();
    for word in words {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => *line += &format!(" {word}"),
            _ => lines.push(word),
        }
    }
    lines
}
