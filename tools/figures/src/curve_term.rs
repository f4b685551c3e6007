//! Figure 10: with the curve term the V of a neckline stays a V on a body with broad shoulders.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::measure::{Neckline, NecklineShape};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::{Kind, sample};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

const WORN: Garment = Garment::Vest;

/// Without the term, as it is by default, and so strong that the neckline comes before all else.
const WEIGHTS: [f64; 3] = [0.0, 1.0, 1000.0];

fn row(label: &str, shape: &NecklineShape, distortion: f64) -> Vec<String> {
    vec![
        label.to_string(),
        format!("{:.1}", shape.angle),
        format!("{:.1}", shape.at_point),
        format!("{:.1} %", 1e2 * shape.bend),
        format!("{distortion:.2e}"),
    ]
}

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let (mannequin, body, worn) = (sample(Kind::Mannequin), avatar(Avatar::Giant), garment(WORN));
    let neckline = Neckline::of(&worn.mesh)?;
    let subtitle = "A vest on a body with broad shoulders, with three weights of the term that keeps the shape of boundary \
                    curves.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let columns = [
        "weight of curvature and torsion",
        "angle of the V, degrees",
        "at its point",
        "bend of its sides",
        "mean distortion",
    ];
    let mut figure = Figure::new(Sheet::new("Curve term", subtitle, view), &columns);
    let designed = neckline.shape(&worn.mesh.positions);
    let sheet = &mut figure.sheet;
    sheet.rows.push(Heading::default());
    sheet.columns.push(Heading { label: "as designed".into(), ..Heading::default() });
    let skin = look::body(sheet, &mannequin, look::MANNEQUIN);
    let made = look::garment(sheet, &worn.mesh.positions, &worn.mesh.triangles, WORN);
    let caption = |shape: &NecklineShape| format!("{:.0} degrees, {:.0} at the point", shape.angle, shape.at_point);
    let layers = vec![skin, made];
    sheet.cells.push(Cell { caption: caption(&designed), layers, ..Cell::default() });
    figure.rows.push(row("as designed", &designed, 0.0));
    let skin = look::body(&mut figure.sheet, &body, look::BODY);
    let mut shapes = Vec::new();
    for (column, weight) in (1..).zip(WEIGHTS) {
        let options = Options { curvature_weight: weight, torsion_weight: weight, ..Options::default() };
        let dressed =
            dress(&worn, &body, &[], None, &options).map_err(|message| format!("weight {weight}: {message}"))?;
        let shape = neckline.shape(&dressed.mesh.positions);
        let sheet = &mut figure.sheet;
        let garment = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, WORN);
        let layers = vec![skin.clone(), garment];
        let label = if weight == 0.0 { "without the term".to_string() } else { format!("weight {weight}") };
        sheet.columns.push(Heading { label, ..Heading::default() });
        sheet.cells.push(Cell { column, caption: caption(&shape), layers, ..Cell::default() });
        figure.rows.push(row(&weight.to_string(), &shape, dressed.distortions()[0]));
        shapes.push(shape);
    }
    let [without, by_default, strong] = &shapes[..] else { return Err("three weights were expected".into()) };
    let [off, on] = [without, by_default].map(|shape| (shape.at_point - designed.at_point).abs());
    figure.claim(
        on < off,
        format!("at its point the V opens by {on:.1} degrees more by default, without the term by {off:.1}"),
    );
    let [off, on] = [without, strong].map(|shape| (shape.angle - designed.angle).abs());
    figure.claim(
        on < off,
        format!("as a whole it opens by {on:.1} degrees more with the strong term, without it by {off:.1}"),
    );
    Ok(figure)
}
