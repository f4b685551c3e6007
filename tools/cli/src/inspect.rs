//! `bespoke inspect`: what is in a file, and what will need attention.

use bespoke::input::diagnostic::Severity;
use bespoke::rig::joint_map::JointMap;
use serde::Serialize;

use crate::args::Inspect;
use crate::failure::{Failure, Result};
use crate::figure::{Choice, Figure, Part};
use crate::fit::Finding;
use crate::outfit::{self, Garment};
use crate::own_body::on_own_body;
use crate::parts::Role;
use crate::report::{self, FindingLine, JointLine};
use crate::say::in_lines;

/// What is in a file.
#[derive(Serialize)]
struct Inspected {
    file: String,
    format: String,
    rig: RigLine,
    parts: Vec<PartLine>,
    garments: Vec<GarmentLine>,
    /// The joint map to another character.
    #[serde(skip_serializing_if = "Option::is_none")]
    joint_map: Option<Vec<JointLine>>,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct RigLine {
    /// Whose names the joints have.
    profile: Option<String>,
    joints: Vec<RigJointLine>,
}

#[derive(Serialize)]
struct RigJointLine {
    name: String,
    parent: Option<u32>,
    part: Option<String>,
    confidence: f64,
}

#[derive(Serialize)]
struct PartLine {
    node: String,
    material: String,
    kind: String,
    reason: String,
    vertices: usize,
    triangles: usize,
    morphs: Vec<String>,
    /// The joint that it hangs on without skin weights.
    hangs_on: Option<String>,
}

#[derive(Serialize)]
struct GarmentLine {
    name: String,
    findings: Vec<FindingLine>,
    #[serde(skip)]
    lines: Vec<String>,
}

impl GarmentLine {
    fn new(name: &str, findings: &[Finding]) -> Self {
        Self { name: name.to_string(), findings: report::findings(findings), lines: in_lines(findings) }
    }
}

/// Says what is in the file. The exit code.
///
/// # Errors
/// Where it cannot be read.
pub fn run(args: &Inspect) -> Result<u8> {
    let figure = Figure::open(&args.file, Role::Outfit, &Choice::default())?;
    let against = args.against.as_ref().map(|file| Figure::open(file, Role::Avatar, &Choice::default())).transpose()?;
    let joint_map = match &against {
        Some(other) => {
            let readings = [figure.reading(), other.reading()];
            let map =
                JointMap::new(&figure.rig, &other.rig, readings, &[]).map_err(|e| Failure::no_result(e.message))?;
            Some(report::joint_map(&map, &figure.rig, &other.rig))
        }
        None => None,
    };
    let garments = outfit::garments(&figure);
    let inspected = Inspected {
        file: args.file.display().to_string(),
        format: figure.format(),
        rig: rig_line(&figure),
        parts: figure.parts.iter().map(|part| part_line(&figure, part)).collect(),
        garments: garments.iter().map(|garment| GarmentLine::new(&garment.name, &findings(&figure, garment))).collect(),
        joint_map,
        notes: figure.notes.clone(),
    };
    if args.json {
        print!("{}", report::text(&inspected)?);
    } else {
        print!("{}", in_words(&inspected));
    }
    Ok(0)
}

fn rig_line(figure: &Figure) -> RigLine {
    if figure.rig.joints.is_empty() {
        return RigLine { profile: None, joints: Vec::new() };
    }
    let reading = figure.reading();
    let joint = |(index, joint): (usize, &bespoke::input::rig::RigJoint)| RigJointLine {
        name: joint.name.clone(),
        parent: joint.parent,
        part: report::part_words(reading.part(index as u32)),
        confidence: reading.confidence[index],
    };
    RigLine {
        profile: reading.profile.map(str::to_string),
        joints: figure.rig.joints.iter().enumerate().map(joint).collect(),
    }
}

fn part_line(figure: &Figure, part: &Part) -> PartLine {
    PartLine {
        node: part.node_name.clone(),
        material: part.material.clone(),
        kind: part.sorted.kind.to_string(),
        reason: part.sorted.reason.clone(),
        vertices: part.positions.len(),
        triangles: part.triangles.len(),
        morphs: part.morphs.clone(),
        hangs_on: part.hangs_on.map(|joint| report::label(&figure.rig, joint)),
    }
}

/// What the library says of a garment on its own body, before it is dressed.
fn findings(figure: &Figure, garment: &Garment) -> Vec<Finding> {
    match on_own_body(figure, garment, |job| job.look()) {
        Ok(found) => found.unwrap_or_default(),
        Err(error) => vec![Finding { severity: Severity::Error, kind: None, sentence: error.message }],
    }
}

fn in_words(inspected: &Inspected) -> String {
    let mut text = format!("{}: {}\n", inspected.file, inspected.format);
    let rig = &inspected.rig;
    if rig.joints.is_empty() {
        text += "no rig\n";
    } else {
        let named = rig.profile.as_deref().map_or("names of no known profile".into(), |p| format!("names of {p}"));
        text += &format!("rig: {} joints, {named}\n", rig.joints.len());
        for joint in &rig.joints {
            let Some(part) = &joint.part else { continue };
            let sure = if joint.confidence < 0.6 { ", unsure" } else { "" };
            text += &format!("  {}: {part}{sure}\n", joint.name);
        }
    }
    text += "parts:\n";
    for part in &inspected.parts {
        let hangs = part.hangs_on.as_ref().map_or(String::new(), |joint| format!(", hangs on '{joint}'"));
        let morphs = if part.morphs.is_empty() { String::new() } else { format!(", {} morphs", part.morphs.len()) };
        text += &format!(
            "  {}:{}: {} ({}), {} triangles{morphs}{hangs}\n",
            part.node, part.material, part.kind, part.reason, part.triangles
        );
    }
    for garment in &inspected.garments {
        text += &format!("garment {}\n", garment.name);
        garment.lines.iter().for_each(|line| text += &format!("  {line}\n"));
    }
    if let Some(map) = &inspected.joint_map {
        text += "joint map:\n";
        map.iter().for_each(|joint| text += &format!("  {joint}\n"));
    }
    inspected.notes.iter().for_each(|note| text += &format!("note: {note}\n"));
    text
}
