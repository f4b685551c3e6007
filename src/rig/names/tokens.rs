//! A joint's name, split into words, with its side apart.

use super::super::body_part::Side;

/// A name in words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words {
    /// The side that a word of the name says.
    pub side: Option<Side>,
    /// The other words in order, in lower case; a number is a word.
    pub words: Vec<String>,
}

/// What a word says of the side.
fn side_of(word: &str) -> Option<Side> {
    match word {
        "left" | "l" | "lft" | "lt" | "links" | "左" | "gauche" | "izquierda" | "izquierdo" | "izq" | "sinistra"
        | "sinistro" | "esquerda" | "esquerdo" | "левая" | "левый" | "левое" | "лев" => {
            Some(Side::Left)
        }
        "right" | "r" | "rgt" | "rt" | "rechts" | "右" | "droite" | "droit" | "derecha" | "derecho" | "destra"
        | "destro" | "direita" | "direito" | "правая" | "правый" | "правое" | "прав" => {
            Some(Side::Right)
        }
        _ => None,
    }
}

impl Words {
    /// Splits a name at its separators, at changes of case, and between letters and digits. What stands before the last
    /// `:` or `|` is a namespace and left out.
    pub fn new(name: &str) -> Self {
        let own = name.rsplit([':', '|']).find(|part| part.chars().any(char::is_alphanumeric)).unwrap_or(name);
        let words = split(own);
        let sides: Vec<Option<Side>> = words.iter().map(|word| side_of(word)).collect();
        // A whole word says more than a letter, which may be somebody's initial.
        let spelt = |k: &usize| words[*k].chars().count() > 1 || !words[*k].is_ascii();
        let said: Vec<usize> = (0..words.len()).filter(|&k| sides[k].is_some()).collect();
        let clear: Vec<usize> = said.iter().copied().filter(spelt).collect();
        let said = if clear.is_empty() { said } else { clear };
        let side = said.first().and_then(|&k| sides[k]);
        if said.iter().any(|&k| sides[k] != side) {
            return Self { side: None, words };
        }
        let words = words.into_iter().enumerate().filter(|(k, _)| !said.contains(k)).map(|(_, word)| word).collect();
        Self { side, words }
    }
}

/// Words without separators, which only keep two numbers apart.
pub fn key(words: &[String]) -> String {
    let mut key = String::new();
    let mut was_number = false;
    for word in words {
        let number = is_number(word);
        if number && was_number {
            key.push('.');
        }
        key.push_str(word);
        was_number = number;
    }
    key
}

/// Whether a word is a number.
pub fn is_number(word: &str) -> bool {
    word.bytes().all(|b| b.is_ascii_digit())
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Separator,
    Digit,
    Upper,
    Lower,
    /// A letter of a script without cases.
    Other,
}

fn kind(c: char) -> Kind {
    match c {
        c if c.is_ascii_digit() => Kind::Digit,
        c if c.is_uppercase() => Kind::Upper,
        c if c.is_lowercase() => Kind::Lower,
        c if c.is_alphanumeric() || c == 'ー' => Kind::Other,
        _ => Kind::Separator,
    }
}

/// Letters and digits as wide as Chinese characters are the common ones.
fn narrow(c: char) -> char {
    match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        c => c,
    }
}

fn split(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().map(narrow).collect();
    let mut words: Vec<String> = Vec::new();
    let mut word = String::new();
    for (k, &c) in letters.iter().enumerate() {
        let own = kind(c);
        let last = if k == 0 { Kind::Separator } else { kind(letters[k - 1]) };
        let next = letters.get(k + 1).map_or(Kind::Separator, |&c| kind(c));
        let begins = match (last, own) {
            (Kind::Upper, Kind::Lower) => false,
            // The last capital of several begins the word after them, as in IKFoot.
            (Kind::Upper, Kind::Upper) => next == Kind::Lower,
            (last, own) => last != own,
        };
        let is_side = own == Kind::Other && matches!(c, '左' | '右');
        let after_side = last == Kind::Other && matches!(letters[k - 1], '左' | '右');
        if (begins || is_side || after_side) && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        if own != Kind::Separator {
            word.extend(c.to_lowercase());
        }
    }
    if !word.is_empty() {
        words.push(word);
    }
    words.into_iter().flat_map(side_apart).collect()
}

/// `leftarm` in two words.
fn side_apart(word: String) -> Vec<String> {
    for side in ["left", "right"] {
        if let Some(rest) = word.strip_prefix(side)
            && rest.len() > 1
        {
            return vec![side.to_owned(), rest.to_owned()];
        }
    }
    vec![word]
}
