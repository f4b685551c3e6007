//! How far the gallery is: a bar with the remaining time on a terminal, else a line a pair.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use gallery::pair::Outcome;
use gallery::table;

pub struct Progress {
    bar: ProgressBar,
    clock: Instant,
}

impl Progress {
    /// For so many pairs.
    pub fn new(pairs: usize) -> Self {
        let bar = ProgressBar::new(pairs as u64);
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len}  {elapsed} gone, {eta} left  {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(250));
        Self { bar, clock: Instant::now() }
    }

    /// A pair begins.
    pub fn begin(&self, garment: &str, avatar: &str) {
        self.bar.set_message(format!("{garment} on {avatar}"));
    }

    /// It has ended.
    pub fn end(&self, outcome: &Outcome) {
        self.bar.inc(1);
        let line = table::line(outcome);
        if self.bar.is_hidden() {
            let (done, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
            let left = self.clock.elapsed().as_secs_f64() / done as f64 * (all - done) as f64;
            eprintln!("{done}/{all}  {line}; about {left:.0} s left");
        } else if !outcome.is_verified() {
            self.bar.println(line);
        }
    }

    /// All have ended.
    pub fn close(&self) {
        self.bar.finish_and_clear();
    }
}
