//! What is measured of one case, in a process of its own.

use std::time::{Duration, Instant};

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::weld::Weld;
use bespoke::session::{Options, Precision, Report, Session};
use bespoke::solver::profile::Profile;
use bespoke::verify::intersections;
use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::case::{Case, Inputs};
use crate::median;
use crate::unit::Unit;

type Failure = Box<dyn std::error::Error>;

/// A garment of more vertices runs once: its time is long, and its own mean.
const LARGE: usize = 10_000;
/// Factorisations between two runs.
const UNITS: usize = 7;

/// Seconds by stage, of the library's own clocks.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Stages {
    pub prepare: f64,
    pub inflate: f64,
    pub fit: f64,
    pub verify: f64,
}

/// Milliseconds by kernel: wall time, but for `field_samples`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Kernels {
    pub assembly: f64,
    pub factorisation: f64,
    pub solve: f64,
    pub analysis: f64,
    pub broad_phase: f64,
    pub ccd: f64,
    pub line_search: f64,
    /// Building the distance field, beside the inflation.
    pub field_build: f64,
    /// Waiting for it after the inflation.
    pub field_wait: f64,
    /// The fit term's part of assembly and line search, summed over the threads.
    pub field_samples: f64,
}

/// A term of the objective at the end, and the milliseconds in it, summed over the threads.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Term {
    pub name: String,
    pub weight: f64,
    /// Without its weight.
    pub value: f64,
    /// In assembly.
    pub derivatives: f64,
    /// In line searches.
    pub values: f64,
}

/// One case, that run of several whose time is the median.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Measurement {
    pub case: String,
    pub threads: usize,
    pub garment_vertices: usize,
    pub avatar_vertices: usize,
    /// Wall seconds of the whole retarget, from the inputs in memory to the verified result.
    pub seconds: f64,
    /// Those of all runs.
    pub runs: Vec<f64>,
    /// Seconds of all threads in user mode: hardly more on a busy machine. None where the system does not tell.
    pub cpu_seconds: Option<f64>,
    /// Seconds of one factorisation, the median of many between the runs.
    pub unit: f64,
    /// `seconds / unit`.
    pub f: f64,
    pub stages: Stages,
    /// Of inflation and fit.
    pub iterations: [u32; 2],
    pub factorisations: u32,
    pub symbolic_factorisations: u32,
    /// Time of an iteration in units.
    pub units_per_iteration: f64,
    /// From the beginning to t = 1.
    pub feasible_seconds: f64,
    /// That as a part of the whole.
    pub feasible_share: f64,
    pub kernels: Kernels,
    pub terms: Vec<Term>,
    /// Weighted sum of the terms.
    pub objective: f64,
    pub converged: bool,
    /// In the normalised space, in which a skeleton is 2 long.
    pub min_distance: f64,
    /// Intersecting pairs of triangles in the result as a caller reads it in 32 bits, found by the exact verifier: within
    /// the garment, and with the avatar.
    pub intersections: [u64; 2],
    /// Largest resident size of a process that reads the files and runs once; none where the system does not tell.
    pub peak_memory: Option<u64>,
    /// FNV-1a of the result: the same for all runs and any number of threads.
    pub hash: String,
}

/// Runs `case` so often (at least once, a large one exactly once), and measures.
pub fn measure(case: &Case, options: &Options, runs: usize) -> Result<Measurement, Failure> {
    let inputs = Inputs::read(case)?;
    let weld = Weld::new(&inputs.garment).0;
    let (mut done, mut units, mut peak_memory, mut unit): (Vec<Run>, _, _, _) = (Vec::new(), Vec::new(), None, None);
    let runs = if weld.mesh.positions.len() > LARGE { 1 } else { runs.max(1) };
    for _ in 0..runs {
        let (clock, user) = (Instant::now(), user_seconds());
        let mut session = inputs.session(options.clone())?;
        let stage = session.run()?;
        let seconds = clock.elapsed().as_secs_f64();
        let cpu_seconds = user_seconds().zip(user).map(|(after, before)| after - before);
        if stage != Stage::Done {
            return Err(format!("it ended as {stage:?}").into());
        }
        peak_memory = peak_memory.or_else(peak_resident_size);
        done.push(Run::new(&session, seconds, cpu_seconds)?);
        drop(session);
        let unit = match &mut unit {
            Some(unit) => unit,
            none => none.insert(Unit::new(&weld.mesh)?),
        };
        for _ in 0..UNITS {
            units.push(unit.measure()?);
        }
    }
    if let Some(other) = done.iter().find(|run| run.hash != done[0].hash) {
        return Err(format!("two runs differ: {:016x} and {:016x}", done[0].hash, other.hash).into());
    }
    let seconds: Vec<f64> = done.iter().map(|run| run.seconds).collect();
    done.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let run = &done[done.len() / 2];
    let unit = median(&mut units);
    let mut measurement = run.measurement(case.name(), unit);
    measurement.runs = seconds;
    measurement.peak_memory = peak_memory;
    measurement.intersections = judge(&weld, &inputs.avatar, &run.result)?;
    Ok(measurement)
}

struct Run {
    seconds: f64,
    cpu_seconds: Option<f64>,
    report: Report,
    result: Vec<DVec3>,
    hash: u64,
}

impl Run {
    fn new(session: &Session, seconds: f64, cpu_seconds: Option<f64>) -> bespoke::error::Result<Self> {
        let result = session.garment_as_read(Precision::F32)?;
        let bytes = result.iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes);
        let hash =
            bytes.fold(0xcbf2_9ce4_8422_2325, |h: u64, byte| (h ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
        Ok(Self { seconds, cpu_seconds, report: session.report(), result, hash })
    }

    fn measurement(&self, case: String, unit: f64) -> Measurement {
        let (seconds, report) = (self.seconds, &self.report);
        let stages = [&report.prepare, &report.inflate, &report.fit];
        let mut profile = Profile::default();
        stages.iter().for_each(|stage| profile += &stage.profile);
        let iterations = [report.inflate.iterations, report.fit.iterations];
        let iterating = report.inflate.seconds + report.fit.seconds;
        let terms = terms(report, &mut profile);
        let fit = profile.term("fit").clone();
        Measurement {
            case,
            threads: report.threads,
            garment_vertices: report.garment_size[0],
            avatar_vertices: report.avatar_size[0],
            seconds,
            runs: Vec::new(),
            cpu_seconds: self.cpu_seconds,
            unit,
            f: seconds / unit,
            stages: Stages {
                prepare: report.prepare.seconds,
                inflate: report.inflate.seconds,
                fit: report.fit.seconds,
                verify: report.verify_seconds,
            },
            iterations,
            factorisations: stages.iter().map(|stage| stage.factorisations).sum(),
            symbolic_factorisations: stages.iter().map(|stage| stage.analyses).sum(),
            units_per_iteration: iterating / f64::from(iterations.iter().sum::<u32>().max(1)) / unit,
            feasible_seconds: report.feasible_seconds,
            feasible_share: report.feasible_seconds / seconds,
            kernels: Kernels {
                assembly: milliseconds(profile.assembly),
                factorisation: milliseconds(profile.factorisation),
                solve: milliseconds(profile.solve),
                analysis: milliseconds(profile.analysis),
                broad_phase: milliseconds(profile.broad_phase),
                ccd: milliseconds(profile.ccd),
                line_search: milliseconds(profile.line_search),
                field_build: 1e3 * report.field_seconds,
                field_wait: 1e3 * report.field_wait_seconds,
                field_samples: milliseconds(fit.derivatives + fit.values),
            },
            objective: terms.iter().map(|term| term.weight * term.value).sum(),
            terms,
            converged: report.converged,
            min_distance: report.min_distance_self.min(report.min_distance_avatar),
            intersections: [0; 2],
            peak_memory: None,
            hash: format!("{:016x}", self.hash),
        }
    }
}

fn terms(report: &Report, profile: &mut Profile) -> Vec<Term> {
    let with_time = |term: &bespoke::session::TermReport| {
        let time = profile.term(term.name);
        Term {
            name: term.name.into(),
            weight: term.weight,
            value: term.value,
            derivatives: milliseconds(time.derivatives),
            values: milliseconds(time.values),
        }
    };
    report.terms.iter().map(with_time).collect()
}

fn milliseconds(time: Duration) -> f64 {
    1e3 * time.as_secs_f64()
}

/// The exact verifier on the 32-bit coordinates.
fn judge(weld: &Weld, avatar: &TriangleMesh, result: &[DVec3]) -> Result<[u64; 2], Failure> {
    let positions = weld.vertex_of.iter().map(|&v| result[v as usize].as_vec3().as_dvec3()).collect();
    let garment = TriangleMesh { positions, triangles: weld.mesh.triangles.clone() };
    Ok([intersections(&garment, None, 0)?.count, intersections(&garment, Some(avatar), 0)?.count])
}

/// Seconds that this process has computed, as Linux counts them: in hundredths.
fn user_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The second field is a name in parentheses, with whatever in it; the twelfth after that is the time.
    let hundredths = stat.rsplit_once(')')?.1.split_whitespace().nth(11)?;
    Some(hundredths.parse::<f64>().ok()? / 100.0)
}

/// Bytes, as Linux counts them.
fn peak_resident_size() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}
