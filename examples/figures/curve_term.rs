//! Figure 10: with the curve term the V of a neckline stays a V on a body with broad shoulders.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::generator::avatars::{Avatar, avatar};
use crate::generator::garments::{Garment, garment};
use crate::generator::{Kind, sample};
use crate::look;
use crate::measure::Neckline;
use crate::sheet::{Cell, Heading, Role, Sheet, View};

const WORN: Garment = Garment::Vest;

pub fn figure() -> Outcome<Figure> {
    let (mannequin, body, worn) = (sample(Kind::Mannequin), avatar(Avatar::Giant), garment(WORN));
    let neckline = Neckline::of(&worn.mesh)?;
    let subtitle =
        "A vest on a body with broad shoulders, without and with the term that keeps the shape of boundary curves.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let mut figure = Figure::new(
        Sheet::new("Curve term", subtitle, view),
        &["", "angle of the V, degrees", "bend of its sides", "mean distortion"],
    );
    let designed = neckline.shape(&worn.mesh.positions);
    let sheet = &mut figure.sheet;
    sheet.rows.push(Heading::default());
    sheet.columns.push(Heading { label: "as designed".into(), ..Heading::default() });
    let skin = look::body(sheet, &mannequin, look::MANNEQUIN);
    let mesh = sheet.add_mesh(&look::positions(&worn.mesh), &worn.mesh.triangles);
    let caption = format!("{:.0} degrees", designed.angle);
    let layers = vec![skin, look::surface(Role::Garment, mesh, look::colour(WORN))];
    sheet.cells.push(Cell { caption, layers, ..Cell::default() });
    let row = |label: &str, angle: f64, bend: f64, distortion: f64| {
        vec![label.to_string(), format!("{angle:.1}"), format!("{:.1} %", 1e2 * bend), format!("{distortion:.2e}")]
    };
    figure.rows.push(row("as designed", designed.angle, designed.bend, 0.0));
    let skin = look::body(&mut figure.sheet, &body, look::BODY);
    let mut shapes = Vec::new();
    for (column, label, weight) in [(1, "without", 0.0), (2, "with", Options::default().curvature_weight)] {
        let options = Options { curvature_weight: weight, torsion_weight: weight, ..Options::default() };
        let dressed =
            dress(&worn, &body, &[], None, &options).map_err(|message| format!("{label} the term: {message}"))?;
        let shape = neckline.shape(&dressed.mesh.positions);
        let sheet = &mut figure.sheet;
        let mesh = sheet.add_mesh(&dressed.positions(), &dressed.mesh.triangles);
        let layers = vec![skin.clone(), look::surface(Role::Garment, mesh, look::colour(WORN))];
        sheet.columns.push(Heading { label: format!("{label} the curve term"), ..Heading::default() });
        sheet.cells.push(Cell { column, caption: format!("{:.0} degrees", shape.angle), layers, ..Cell::default() });
        figure.rows.push(row(&format!("{label} the curve term"), shape.angle, shape.bend, dressed.distortions()[0]));
        shapes.push(shape);
    }
    let [without, with] = [&shapes[0], &shapes[1]].map(|shape| (shape.angle - designed.angle).abs());
    figure.claim(
        with < without,
        format!("with the term the V's angle changes by {with:.1} degrees, without it by {without:.1}"),
    );
    let [without, with] = [&shapes[0], &shapes[1]].map(|shape| 1e2 * shape.bend);
    figure.claim(
        with < without,
        format!("with the term the V's sides bend by {with:.1} % of their length, without it by {without:.1} %"),
    );
    Ok(figure)
}
