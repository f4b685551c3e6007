//! What is wrong with a file, and where in it.

use std::fmt;

/// Where in a file something is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A byte, counted from the start of the file.
    Byte(usize),
    /// A value of its JSON, as a JSON pointer such as `/meshes/3/primitives/0/attributes/POSITION`.
    Json(String),
}

/// What is wrong with a file, as a sentence that says where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// Name of the file, where it was opened by one.
    pub file: Option<String>,
    /// Where in it.
    pub place: Place,
    /// What is wrong there, and where something can be done about it, what.
    pub message: String,
}

/// A result that fails with an [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    pub(crate) fn file(message: impl Into<String>) -> Self {
        Self { file: None, place: Place::File, message: message.into() }
    }

    pub(crate) fn byte(at: usize, message: impl Into<String>) -> Self {
        Self { file: None, place: Place::Byte(at), message: message.into() }
    }

    pub(crate) fn json(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { file: None, place: Place::Json(path.into()), message: message.into() }
    }

    /// The same with the name of the file in front, where it has none yet.
    #[must_use]
    pub fn in_file(mut self, name: impl Into<String>) -> Self {
        self.file.get_or_insert_with(|| name.into());
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}: ")?;
        }
        match &self.place {
            Place::File => {}
            Place::Byte(at) => write!(f, "byte {at}: ")?,
            Place::Json(path) if path.is_empty() => write!(f, "JSON: ")?,
            Place::Json(path) => write!(f, "{path}: ")?,
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}
