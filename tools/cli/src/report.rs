//! The reports of `--json`.

use std::fmt;
use std::path::Path;

use bespoke::input::rig::Rig;
use bespoke::rig::body_part::BodyPart;
use bespoke::rig::joint_map::{JointMap, Reason};
use bespoke::rig::part_name;
use serde::Serialize;

use crate::failure::{Failure, Result};
use crate::fit::{Finding, Fitted};
use crate::say::word;

/// A finding.
#[derive(Serialize)]
pub struct FindingLine {
    severity: &'static str,
    sentence: String,
}

impl From<&Finding> for FindingLine {
    fn from(finding: &Finding) -> Self {
        Self { severity: word(finding.severity), sentence: finding.sentence.clone() }
    }
}

/// Findings for a report.
pub fn findings(findings: &[Finding]) -> Vec<FindingLine> {
    findings.iter().map(FindingLine::from).collect()
}

/// A joint of the outfit's rig and what it is on the avatar.
#[derive(Serialize)]
pub struct JointLine {
    source: String,
    target: Option<String>,
    part: Option<String>,
    confidence: f64,
    reason: &'static str,
}

impl fmt::Display for JointLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let target = self.target.as_deref().unwrap_or("-");
        write!(f, "{} -> {target} ({}, {:.2})", self.source, self.reason, self.confidence)
    }
}

/// A joint map for a report.
pub fn joint_map(map: &JointMap, source: &Rig, target: &Rig) -> Vec<JointLine> {
    let line = |(joint, mapped): (usize, &bespoke::rig::joint_map::MappedJoint)| JointLine {
        source: label(source, joint as u32),
        target: mapped.target.map(|joint| label(target, joint)),
        part: part_words(mapped.part),
        confidence: mapped.confidence,
        reason: reason(mapped.reason),
    };
    map.joints.iter().enumerate().map(line).collect()
}

/// A joint's name, or its number where it has none.
pub fn label(rig: &Rig, joint: u32) -> String {
    match rig.joints[joint as usize].name.as_str() {
        "" => joint.to_string(),
        name => name.to_string(),
    }
}

/// A part of the body in words.
pub fn part_words(part: Option<BodyPart>) -> Option<String> {
    part.map(part_name::name)
}

fn reason(reason: Reason) -> &'static str {
    match reason {
        Reason::Nothing => "nothing corresponds",
        Reason::Caller => "as given",
        Reason::Name => "by name",
        Reason::Structure => "by structure",
        Reason::Order => "by order",
        Reason::SameName => "the same name",
        Reason::Ancestor => "goes with the joint above",
    }
}

/// What became of a garment.
#[derive(Serialize)]
pub struct GarmentLine {
    name: String,
    /// dressed, flawed or refused.
    status: &'static str,
    message: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    result: Option<ResultLine>,
    findings: Vec<FindingLine>,
}

#[derive(Serialize)]
struct ResultLine {
    vertices: usize,
    added_joints: usize,
    inflate_iterations: u32,
    fit_iterations: u32,
    /// Of the library, from its inputs to the verified result.
    seconds: f64,
    converged: bool,
    new_self_intersections: u64,
    own_self_intersections: u64,
    body_intersections: u64,
}

impl GarmentLine {
    /// Of a garment with a result.
    pub fn dressed(name: &str, fitted: &Fitted) -> Self {
        let report = &fitted.report;
        let verification = report.verification.unwrap_or_default();
        Self {
            name: name.to_string(),
            status: if fitted.flaw.is_some() { "flawed" } else { "dressed" },
            message: fitted.flaw.clone(),
            result: Some(ResultLine {
                vertices: fitted.positions.len(),
                added_joints: fitted.added.len(),
                inflate_iterations: report.inflate.iterations,
                fit_iterations: report.fit.iterations,
                seconds: fitted.seconds,
                converged: report.converged,
                new_self_intersections: verification.new_garment_garment(),
                own_self_intersections: verification.initial,
                body_intersections: verification.garment_avatar,
            }),
            findings: findings(&fitted.findings),
        }
    }

    /// Of a garment without one.
    pub fn refused(name: &str, failure: &Failure, said: &[Finding]) -> Self {
        Self {
            name: name.to_string(),
            status: "refused",
            message: Some(failure.sentence.clone()),
            result: None,
            findings: findings(said),
        }
    }
}

/// `bespoke dress --json`.
#[derive(Serialize)]
pub struct DressReport {
    /// The files.
    pub outfit: String,
    /// The files.
    pub avatar: String,
    /// Where the result is; none where there is none.
    pub output: Option<String>,
    /// In the order in which they were put on.
    pub garments: Vec<GarmentLine>,
    /// What else was said.
    pub notes: Vec<String>,
    /// The outfit's joints on the avatar.
    pub joint_map: Vec<JointLine>,
}

/// Makes the folder in which a file is to be.
///
/// # Errors
/// Where it cannot be made.
pub fn in_folder(file: &Path) -> std::io::Result<()> {
    file.parent().map_or(Ok(()), std::fs::create_dir_all)
}

/// Writes a report to a file, or to standard output for `-`.
///
/// # Errors
/// Where it cannot be written.
pub fn write(file: &Path, report: &impl Serialize) -> Result<()> {
    let text = text(report)?;
    if file.as_os_str() == "-" {
        print!("{text}");
        return Ok(());
    }
    in_folder(file)
        .and_then(|()| bespoke_gltf::replace(file, text.as_bytes()))
        .map_err(|e| Failure::no_result(format!("{}: it cannot be written: {e}", file.display())))
}

/// A report as text.
///
/// # Errors
/// Where a number is none.
pub fn text(report: &impl Serialize) -> Result<String> {
    serde_json::to_string_pretty(report)
        .map(|text| text + "\n")
        .map_err(|e| Failure::no_result(format!("the report cannot be made: {e}")))
}
