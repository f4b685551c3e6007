//! Why the program ends without what was asked for: a sentence and an exit code, the same as those of `retarget`.

use std::fmt;

/// An end without a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// For the shell.
    pub exit: u8,
    /// For a person.
    pub sentence: String,
}

impl Failure {
    /// There is no result: a file that cannot be read, a garment that cannot be dressed.
    pub fn no_result(sentence: impl Into<String>) -> Self {
        Self { exit: 1, sentence: sentence.into() }
    }

    /// The command line asks for what cannot be.
    pub fn usage(sentence: impl Into<String>) -> Self {
        Self { exit: 2, sentence: sentence.into() }
    }

    /// Stopped by Ctrl-C.
    pub fn interrupted() -> Self {
        Self { exit: 130, sentence: "stopped; nothing was written".into() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence)
    }
}

impl std::error::Error for Failure {}

/// What a command gives, or why not.
pub type Result<T, E = Failure> = std::result::Result<T, E>;
