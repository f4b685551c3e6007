//! The class in the editor's help.

use crate::words::{OPTIONS, OptionWord, WORDS, Word};

/// The text by hand, in the form of the engine's own; what the library's header says is put in where it names it.
const TEXT: &str = include_str!("../doc_classes/BespokeRetarget.xml");

/// Tells the editor.
pub fn register() {
    let text = text();
    // SAFETY: this is the stage in which the editor takes it, and the text has its length.
    unsafe {
        godot::sys::interface_fn!(editor_help_load_xml_from_utf8_chars_and_len)(
            text.as_ptr().cast(),
            text.len() as i64,
        );
    }
}

/// The whole document.
fn text() -> String {
    let constant = |word: &Word| {
        format!(
            "\t\t<constant name=\"{}\" value=\"{}\">\n\t\t\t{}\n\t\t</constant>\n",
            word.name,
            word.value,
            escaped(word.text)
        )
    };
    let mut text = TEXT.replace("{constants}", &WORDS.iter().map(constant).collect::<String>());
    for option in OPTIONS {
        text = text.replace(&format!("{{{}}}", option.name), &escaped(option.text));
    }
    let row = |option: &OptionWord| {
        let whom = if option.is_expert { "Expert. " } else { "" };
        format!("[code]{}[/code]: {whom}{}[br]", option.name, escaped(option.text))
    };
    text.replace("{options}", &OPTIONS.iter().map(row).collect::<String>())
}

/// As text of XML and of the engine's own marks.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '[' => escaped += "[lb]",
            ']' => escaped += "[rb]",
            _ => escaped.push(letter),
        }
    }
    escaped
}
