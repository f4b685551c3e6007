//! The looseness of the design on other bodies: 10 mm off the mannequin's trunk, in proportion to the trunk that wears it.

use bespoke::options::Options;
use glam::DVec3;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::measure::{waist_clearance, waist_radius};
use closet::avatars::{Avatar, avatar};
use closet::garments::Garment;
use closet::skeleton::{ARMS, NECK, ROOT};
use closet::{Kind, Sample, sample};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

/// How far the garment is off the mannequin, in metres.
const DESIGNED: f64 = 0.010;
const BODIES: [Avatar; 4] = [Avatar::Dinosaur, Avatar::Child, Avatar::Giant, Avatar::Slim];
/// Of the fit: so strong that the garment is where it aims to be, whatever its shape.
const FIT_WEIGHT: f64 = 2000.0;
/// The clearance may be off by this share.
const ALLOWED: f64 = 0.1;

/// The skin of the mannequin's trunk, moved off it along its normals.
fn second_skin(mannequin: &Sample) -> Sample {
    let mut worn = mannequin.clone();
    let joints = mannequin.skeleton.joints;
    let (low, high) = (joints[ROOT].z + 0.02, joints[NECK].z - 0.02);
    let side = 0.9 * joints[ARMS[0][0]].x;
    let normals = worn.mesh.normals();
    let (positions, before) = (&mut worn.mesh.positions, &mannequin.mesh.positions);
    positions.iter_mut().zip(normals).for_each(|(p, normal)| *p += DESIGNED * normal);
    let is_trunk = |p: DVec3| (low..high).contains(&p.z) && p.x.abs() < side;
    worn.mesh.retain(|corners| corners.iter().all(|&v| is_trunk(before[v as usize])));
    worn.skin.clear();
    worn
}

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let mannequin = sample(Kind::Mannequin);
    let worn = second_skin(&mannequin);
    let radius = waist_radius(&mannequin);
    let subtitle = "A second skin, 10 mm off the mannequin it was designed on, on other bodies.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let columns =
        ["body", "radius of the waist, mm", "of the mannequin's", "clearance there, mm", "in proportion it were, mm"];
    let mut figure = Figure::new(Sheet::new("Designed clearance", subtitle, view), &columns);
    figure.sheet.rows.push(Heading::default());
    let options = Options { fit_weight: FIT_WEIGHT, ..Options::default() };
    let mut off = 0.0_f64;
    for (column, kind) in BODIES.into_iter().enumerate() {
        let body = avatar(kind);
        let dressed = dress(&worn, &body, &[], Some(&mannequin), &options)
            .map_err(|message| format!("{}: {message}", kind.name()))?;
        let clearance = waist_clearance(&dressed.mesh, &body);
        let ratio = waist_radius(&body) / radius;
        off = off.max((clearance / (ratio * DESIGNED) - 1.0).abs());
        let sheet = &mut figure.sheet;
        let skin = look::body(sheet, &body, look::BODY);
        let garment = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, Garment::Vest);
        sheet.columns.push(Heading { label: kind.name().into(), ..Heading::default() });
        let caption = format!("{:.1} mm off", 1e3 * clearance);
        sheet.cells.push(Cell { column, caption, layers: vec![skin, garment], ..Cell::default() });
        figure.rows.push(vec![
            kind.name().to_string(),
            format!("{:.0}", 1e3 * ratio * radius),
            format!("{ratio:.2}"),
            format!("{:.1}", 1e3 * clearance),
            format!("{:.1}", 1e3 * ratio * DESIGNED),
        ]);
    }
    figure.claim(
        off < ALLOWED,
        format!(
            "the clearance is in proportion to the trunk, within {:.0} % (at most {:.0} %)",
            1e2 * off,
            1e2 * ALLOWED
        ),
    );
    Ok(figure)
}
