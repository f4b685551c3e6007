//! A process that dresses pairs one after the other, and what the batch knows of it.
//!
//! It is told a pair in a line of JSON, and answers with a line. So outfits for the same avatar find it prepared, and an outfit that
//! was put on another one before is known; and a pair that takes its process with it takes no result of another.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use clap::Parser as _;
use serde::{Deserialize, Serialize};

use crate::args::{self, CommandLine};
use crate::dress::{self, Known};
use crate::failure::{Failure, Result};
use crate::progress::is_stopped;
use crate::say::heard;

/// What follows on `bespoke dress`.
#[derive(Debug, Deserialize, Serialize)]
struct Question {
    arguments: Vec<String>,
}

/// What a pair has come to.
#[derive(Debug, Deserialize, Serialize)]
pub struct Answer {
    /// As `bespoke dress` exits.
    pub exit: u8,
    /// What it says on standard error.
    pub said: String,
}

/// The other side of a process that dresses pairs.
pub struct Worker {
    child: Child,
    questions: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Worker {
    /// Starts one.
    ///
    /// # Errors
    /// Where the program cannot be started.
    pub fn start(program: &Path) -> Result<Self> {
        let fail = || Failure::no_result(format!("{} cannot be started", program.display()));
        let mut child = Command::new(program)
            .arg("batch-worker")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // What a pair says comes with its answer; the rest is of one that is being killed.
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| Failure::no_result(format!("{}: {e}", fail().sentence)))?;
        let answers = BufReader::new(child.stdout.take().ok_or_else(fail)?);
        Ok(Self { questions: child.stdin.take(), child, answers })
    }

    /// Dresses a pair. None where the process has ended meanwhile.
    pub fn ask(&mut self, arguments: &[String]) -> Option<Answer> {
        let question = serde_json::to_string(&Question { arguments: arguments.to_vec() }).ok()?;
        let questions = self.questions.as_mut()?;
        writeln!(questions, "{question}").and_then(|()| questions.flush()).ok()?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer).ok()?;
        serde_json::from_str(&answer).ok()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // It ends where nothing more is asked.
        self.questions = None;
        drop(self.child.wait());
    }
}

/// Answers questions until there are no more.
///
/// # Errors
/// Where nobody listens any more.
pub fn serve(questions: &mut impl BufRead, answers: &mut impl Write) -> Result<u8> {
    let fail = |e: std::io::Error| Failure::no_result(format!("nobody asks any more: {e}"));
    let mut known = Known::default();
    for question in questions.lines() {
        let question: Question = serde_json::from_str(&question.map_err(fail)?)
            .map_err(|e| Failure::usage(format!("this is no question of `bespoke batch`: {e}")))?;
        let (exit, said) = heard(|| dress_one(&question.arguments, &mut known));
        let answer = match exit {
            Ok(exit) => Answer { exit, said },
            Err(failure) => Answer { exit: failure.exit, said: format!("{said}bespoke: {failure}") },
        };
        let answer = serde_json::to_string(&answer).map_err(|e| Failure::no_result(format!("an answer: {e}")))?;
        writeln!(answers, "{answer}").and_then(|()| answers.flush()).map_err(fail)?;
        if is_stopped() {
            return Err(Failure::interrupted());
        }
    }
    Ok(0)
}

fn dress_one(arguments: &[String], known: &mut Known) -> Result<u8> {
    let words = ["bespoke", "dress"].into_iter().map(String::from).chain(arguments.iter().cloned());
    match CommandLine::try_parse_from(words).map_err(|e| Failure::usage(e.to_string()))?.command {
        args::Command::Dress(args) => dress::run_with(&args, known),
        _ => Err(Failure::usage("a pair is dressed and nothing else")),
    }
}
