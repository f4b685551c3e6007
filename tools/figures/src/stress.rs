//! Figure 7: a jumpsuit on arms much longer than those it was made for, and where that distorts it.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::ARMS;
use closet::{Kind, Sample, sample};
use gallery::look;
use gallery::sheet::{Cell, Heading, Layer, Sheet, Values, View};

/// Shoulder to wrist over shoulder-to-ankle height: how long the arms are for the body.
fn reach(body: &Sample) -> f64 {
    let [shoulder, elbow, wrist] = ARMS[0].map(|joint| body.skeleton.joints[joint]);
    (shoulder.distance(elbow) + elbow.distance(wrist)) / shoulder.z
}

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let (mannequin, body) = (sample(Kind::Mannequin), avatar(Avatar::LongArms));
    let worn = garment(Garment::Jumpsuit);
    let dressed = dress(&worn, &body, &[], None, &Options::default())?;
    let subtitle = "A jumpsuit on a body with much longer arms. The distortion of each triangle is the mean over its edges of \
                    the surface term, in the form that is free for similarities.";
    let view = View { azimuth: 0.0, elevation: 7.0, ..View::default() };
    let mut figure = Figure::new(
        Sheet::new("Stress test", subtitle, view),
        &["garment", "arm for shoulder height, designed", "here", "distortion: median", "mean", "95 %", "largest"],
    );
    let sheet = &mut figure.sheet;
    sheet.rows.push(Heading::default());
    for label in ["as designed", "on long arms", "distortion"] {
        sheet.columns.push(Heading { label: label.into(), ..Heading::default() });
    }
    sheet.scales.push(look::distortion_scale());
    let design = look::body(sheet, &mannequin, look::MANNEQUIN);
    let made = look::garment(sheet, &worn.mesh.positions, &worn.mesh.triangles, Garment::Jumpsuit);
    sheet.cells.push(Cell { layers: vec![design, made], ..Cell::default() });
    let skin = look::body(sheet, &body, look::BODY);
    let fitted = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, Garment::Jumpsuit);
    let mut painted = fitted.clone();
    let numbers: Vec<f32> = dressed.distortion.iter().map(|d| *d as f32).collect();
    let array = sheet.add_floats(&numbers);
    if let Layer::Surface { values, .. } = &mut painted {
        *values = Some(Values { array, scale: 0, shown: true });
    }
    for (column, garment) in [(1, fitted), (2, painted)] {
        sheet.cells.push(Cell { column, layers: vec![skin.clone(), garment], ..Cell::default() });
    }

    let mut sorted = dressed.distortion.clone();
    sorted.sort_by(f64::total_cmp);
    let [mean, largest] = dressed.distortions();
    let [median, high] = [sorted.len() / 2, sorted.len() * 95 / 100].map(|k| sorted[k]);
    let [designed, here] = [&mannequin, &body].map(reach);
    let numbers = [designed, here, median, mean, high, largest];
    let cells = numbers.map(|n| if n < 0.1 { format!("{n:.2e}") } else { format!("{n:.2}") });
    figure.rows.push([Garment::Jumpsuit.name().to_string()].into_iter().chain(cells).collect());
    figure.claim(here > 1.4 * designed, format!("the arms are {:.2} times as long for the body", here / designed));
    figure.claim(
        high < 0.05,
        format!("95 % of the triangles are distorted by less than 0.05 (the 95th percentile is {high:.1e})"),
    );
    Ok(figure)
}
