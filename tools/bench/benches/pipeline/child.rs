//! Measures a case in a process of its own, so that its peak memory is its own, too.

use std::process::{Command, Stdio};

use crate::case::Case;
use crate::measurement::Measurement;

/// How a case is measured.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Runs, of which the median counts.
    pub runs: usize,
    /// Threads of the session.
    pub threads: u32,
    /// Another tolerance than the default.
    pub tolerance: Option<f64>,
}

/// What became of `case`; or why there is no measurement.
pub fn measure(case: &Case, setup: Setup) -> Result<Measurement, String> {
    eprintln!("{}, {} threads ...", case.name(), setup.threads);
    let this = std::env::current_exe().map_err(|e| format!("the benchmark's own program: {e}"))?;
    let mut command = Command::new(this);
    command.arg("--case").args([&case.garment, &case.avatar]);
    command.args(["--runs", &setup.runs.to_string(), "--threads", &setup.threads.to_string()]);
    if let Some(tolerance) = setup.tolerance {
        command.args(["--tolerance", &tolerance.to_string()]);
    }
    let output = command.stderr(Stdio::inherit()).output().map_err(|e| format!("{}: {e}", case.name()))?;
    if !output.status.success() {
        return Err(format!("{}: failed, {}", case.name(), output.status));
    }
    let measured: Measurement = serde_json::from_slice(&output.stdout).map_err(|e| format!("{}: {e}", case.name()))?;
    let Measurement { seconds, f, iterations: [inflate, fit], .. } = measured;
    eprintln!("    {seconds:.2} s, F {f:.0}, {inflate} + {fit} iterations");
    Ok(measured)
}
