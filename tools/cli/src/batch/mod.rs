//! `bespoke batch`: every outfit of a manifest on every avatar.
//!
//! Processes run side by side, each with one thread, which wastes less than threads within a pair, until there are fewer pairs than
//! processes. Each dresses the outfits of one avatar after the other, which is read and prepared once, and keeps what it knows of the
//! last outfits; the results are those of `bespoke dress`. A pair that takes its process with it is dressed once more, in one of its
//! own, and the others of its avatar in another.

pub mod journal;
pub mod manifest;
pub mod queue;
pub mod worker;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::channel;
use std::time::Instant;

use crate::args::Batch;
use crate::failure::{Failure, Result};
use crate::progress::is_stopped;
use crate::say::say;
use journal::{Journal, Line, made_of};
use manifest::{Manifest, Pair};
use queue::{AtHand, Queue, Task};
use worker::Worker;

/// Of what a pair said, so many bytes are kept.
const MOST_SAID: usize = 4000;

/// Dresses all pairs that are not done. The exit code.
///
/// # Errors
/// For a manifest that cannot be used, and a report that cannot be written.
pub fn run(args: &Batch) -> Result<u8> {
    let manifest = Manifest::read(&args.manifest)?;
    let (part, parts) = args.slice;
    let pairs = manifest.pairs()?;
    let own = own(&pairs, part as usize, parts as usize);
    let report = args.report.clone().unwrap_or_else(|| beside(&args.manifest, args.slice));
    let mut journal =
        Journal::open(&report, || say(args.quiet, "another batch is at this report; waiting for it to end"))?;
    let mut count = Count::default();
    let (mut left, mut known) = (Vec::new(), Vec::new());
    for &pair in &own {
        match journal.done(pair) {
            Some(line) if !(args.retry && line.exit == 1) => {
                count.add(line.exit);
                known.push((pair, line.seconds));
            }
            _ => left.push(pair),
        }
    }
    let done = own.len() - left.len();
    if done > 0 {
        say(args.quiet, &format!("{done} of {} pairs are done already", own.len()));
    }
    let program = std::env::current_exe()
        .map_err(|e| Failure::no_result(format!("this program does not know where it lies: {e}")))?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let jobs = if args.jobs == 0 { cores } else { args.jobs as usize };
    let queue = Queue::new(&left, jobs);
    known.iter().for_each(|(pair, seconds)| queue.ended(pair, *seconds));
    let (ended, results) = channel();
    std::thread::scope(|scope| {
        for _ in 0..jobs.min(left.len()) {
            let (ended, queue, program) = (ended.clone(), &queue, &program);
            scope.spawn(move || {
                let (mut worker, mut at_hand) = (None, AtHand::default());
                while !is_stopped() {
                    let Some(task) = queue.next(&mut at_hand) else { return };
                    let line = dress(program, &mut worker, &task);
                    if let Ok(Some(line)) = &line {
                        queue.ended(task.pair, line.seconds);
                    }
                    if ended.send(line).is_err() {
                        return;
                    }
                }
            });
        }
        drop(ended);
        for (k, line) in results.iter().enumerate() {
            let Some(line) = line? else { continue };
            journal.add(&line)?;
            count.add(line.exit);
            let outcome = match line.exit {
                0 => "dressed".to_string(),
                3 => format!("dressed, not as designed: {}", headline(&line.said)),
                _ => headline(&line.said).to_string(),
            };
            say(args.quiet, &format!("[{}/{}] {}: {outcome}", done + k + 1, own.len(), line.pair));
        }
        Ok(())
    })?;
    if is_stopped() {
        return Err(Failure {
            exit: 130,
            sentence: "stopped; the same command goes on with the pairs that are not done".into(),
        });
    }
    say(
        args.quiet,
        &format!(
            "{} dressed, {} not as designed, {} without a result; {}",
            count.good,
            count.flawed,
            count.refused,
            report.display()
        ),
    );
    Ok(match (count.refused, count.flawed) {
        (0, 0) => 0,
        (0, _) => 3,
        _ => 1,
    })
}

/// The pairs of one of so many parts, counted from 1: as many as in the others, or one less, and avatar by avatar, so that few avatars
/// are prepared twice.
fn own(pairs: &[Pair], part: usize, parts: usize) -> Vec<&Pair> {
    let mut by_avatar: Vec<&Pair> = pairs.iter().collect();
    let mut first = HashMap::new();
    for (k, pair) in pairs.iter().enumerate() {
        first.entry(&pair.avatar).or_insert(k);
    }
    by_avatar.sort_by_key(|pair| first[&pair.avatar]);
    let end = |part: usize| part * pairs.len() / parts;
    by_avatar[end(part - 1)..end(part)].to_vec()
}

#[derive(Default)]
struct Count {
    good: usize,
    flawed: usize,
    refused: usize,
}

impl Count {
    fn add(&mut self, exit: i32) {
        *match exit {
            0 => &mut self.good,
            3 => &mut self.flawed,
            _ => &mut self.refused,
        } += 1;
    }
}

/// The report that is meant where none is named: one for each slice, since two machines cannot write into one.
fn beside(manifest: &Path, (part, parts): (u32, u32)) -> PathBuf {
    let end = if parts == 1 { "report.jsonl".into() } else { format!("report.{part}of{parts}.jsonl") };
    manifest.with_extension(end)
}

/// Dresses a pair. None where it was stopped, so that it is done another time.
fn dress(program: &Path, worker: &mut Option<Worker>, task: &Task) -> Result<Option<Line>> {
    let (pair, clock) = (task.pair, Instant::now());
    if let Some(folder) = pair.output.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::no_result(format!("the folder {} cannot be made: {e}", folder.display())))?;
    }
    // Before it begins: a file that changes meanwhile makes the result an old one.
    let made_of = made_of(pair).unwrap_or_default();
    let mut arguments = pair.arguments.clone();
    arguments.extend([format!("--threads={}", task.threads), "--quiet".to_string()]);
    let running = match worker {
        Some(running) => running,
        None => worker.insert(Worker::start(program)?),
    };
    let answer = running.ask(&arguments);
    let (exit, said) = match answer {
        Some(answer) => (i32::from(answer.exit), answer.said),
        None if is_stopped() => return Ok(None),
        None => {
            // It may have been another pair that has used up the memory, or another program.
            *worker = None;
            match alone(program, &arguments)? {
                Ok(ended) => ended,
                Err(_) if is_stopped() => return Ok(None),
                Err(said) => return Ok(Some(line(pair, 1, clock, said, String::new()))),
            }
        }
    };
    if exit == 130 {
        return Ok(None);
    }
    let mut from = said.len().saturating_sub(MOST_SAID);
    while !said.is_char_boundary(from) {
        from += 1;
    }
    Ok(Some(line(pair, exit, clock, said[from..].trim().to_string(), made_of)))
}

/// Dresses a pair in a process of its own: exit code and what was said, or what became of a process that was killed.
fn alone(program: &Path, arguments: &[String]) -> Result<std::result::Result<(i32, String), String>> {
    let ended = Command::new(program)
        .arg("dress")
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .map_err(|e| Failure::no_result(format!("{} cannot be started: {e}", program.display())))?;
    Ok(match ended.status.code() {
        Some(exit) => Ok((exit, String::from_utf8_lossy(&ended.stderr).into_owned())),
        // Killed, by a user or for its memory.
        None => Err(format!("it was ended by the system: {}", ended.status)),
    })
}

fn line(pair: &Pair, exit: i32, clock: Instant, said: String, made_of: String) -> Line {
    Line {
        pair: pair.name.clone(),
        output: matches!(exit, 0 | 3).then(|| pair.output.clone()),
        exit,
        seconds: clock.elapsed().as_secs_f64(),
        said,
        made_of,
    }
}

/// What was said of a failure in one line.
fn headline(said: &str) -> &str {
    said.lines().find(|line| line.starts_with("bespoke: ")).or_else(|| said.lines().next()).unwrap_or("no result")
}
