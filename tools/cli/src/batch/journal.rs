//! The report of a batch: a line for each pair that has ended, from which the batch goes on after it was stopped.

use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use super::manifest::Pair;
use crate::failure::{Failure, Result};
use crate::progress::is_stopped;

/// What became of a pair.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Line {
    /// "suit on hero".
    pub pair: String,
    /// Where the result is, if there is one.
    pub output: Option<PathBuf>,
    /// As `bespoke dress` exits: 0, 1 or 3.
    pub exit: i32,
    /// Wall time.
    pub seconds: f64,
    /// What was said of it.
    pub said: String,
    /// Of what it was made: another one, and it is made again.
    pub made_of: String,
}

/// The lines of a file, and where new ones go.
pub struct Journal {
    file: File,
    path: PathBuf,
    lines: HashMap<String, Line>,
}

impl Journal {
    /// Reads what is there, and opens the file for more. A line that was not written to its end counts for nothing. While another batch
    /// has the file open, says so by `waiting` and waits: so no pair is dressed twice, also where a farm starts a task again whose
    /// process has outlived it.
    ///
    /// # Errors
    /// Where the file cannot be read or written, and where the wait was stopped.
    pub fn open(path: &Path, waiting: impl FnOnce()) -> Result<Self> {
        let fail =
            |e: std::io::Error| Failure::no_result(format!("{}: the report cannot be used: {e}", path.display()));
        let mut file = OpenOptions::new().create(true).read(true).append(true).open(path).map_err(fail)?;
        lock(&file, waiting).map_err(|e| e.map_or_else(Failure::interrupted, fail))?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(fail)?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let lines = text.lines().filter_map(|line| serde_json::from_str(line).ok());
        let lines = lines.map(|line: Line| (line.pair.clone(), line)).collect();
        if !text.is_empty() && !text.ends_with('\n') {
            file.write_all(b"\n").map_err(fail)?;
        }
        Ok(Self { file, path: path.to_path_buf(), lines })
    }

    /// The line of a pair that need not be made again: of the same files and options, and with its result still there.
    pub fn done(&self, pair: &Pair) -> Option<&Line> {
        let line = self.lines.get(&pair.name)?;
        let is_there = line.output.as_ref().is_none_or(|output| output.is_file());
        (is_there && made_of(pair).is_some_and(|made_of| made_of == line.made_of)).then_some(line)
    }

    /// Adds a line, which is on the disk when this returns.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn add(&mut self, line: &Line) -> Result<()> {
        let fail = |e: std::io::Error| {
            Failure::no_result(format!("{}: the report cannot be written: {e}", self.path.display()))
        };
        let text = serde_json::to_string(line).map_err(|e| Failure::no_result(format!("the report: {e}")))?;
        self.file.write_all(format!("{text}\n").as_bytes()).and_then(|()| self.file.sync_data()).map_err(fail)
    }
}

/// Waits until nobody else has the lock. It is gone with the process, however that ends. None where the wait was stopped.
fn lock(file: &File, waiting: impl FnOnce()) -> std::result::Result<(), Option<std::io::Error>> {
    let mut waiting = Some(waiting);
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(()),
            // A file system without locks: there is no more than to trust the caller.
            Err(TryLockError::Error(e)) if e.kind() == ErrorKind::Unsupported => return Ok(()),
            Err(TryLockError::Error(e)) => return Err(Some(e)),
            Err(TryLockError::WouldBlock) if is_stopped() => return Err(None),
            Err(TryLockError::WouldBlock) => {
                if let Some(waiting) = waiting.take() {
                    waiting();
                }
                std::thread::sleep(Duration::from_millis(200));
            }
        }
    }
}

/// Of what the result of a pair is made: the program, the options, and size and age of each file. None where one is missing.
pub fn made_of(pair: &Pair) -> Option<String> {
    let mut words = vec![env!("CARGO_PKG_VERSION").to_string()];
    words.extend(pair.arguments.iter().cloned());
    for file in &pair.inputs {
        let known = std::fs::metadata(file).ok()?;
        let age = known.modified().ok()?.duration_since(UNIX_EPOCH).unwrap_or_default();
        words.push(format!("{} {}", known.len(), age.as_nanos()));
    }
    // FNV-1a: the same in every version of the program.
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
    Some(format!("{:016x}", words.join("\0").bytes().fold(0xcbf2_9ce4_8422_2325, step)))
}
