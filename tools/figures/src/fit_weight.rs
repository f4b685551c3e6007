//! Figure 8: the weight of the fit term decides how tightly the waist of a straight garment follows a slim one.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::measure::waist_clearance;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

const WEIGHTS: [f64; 3] = [0.2, 2.0, 20.0];
const WORN: Garment = Garment::Sweater;

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let (body, worn) = (avatar(Avatar::Giant), garment(WORN));
    let subtitle = "A sweater on a body with broad shoulders and a slim waist, with three weights of the fit term.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let mut figure = Figure::new(
        Sheet::new("Fit weight", subtitle, view),
        &["fit weight", "clearance at the waist, mm", "mean distortion", "iterations"],
    );
    figure.sheet.rows.push(Heading::default());
    figure.sheet.columns.push(Heading { label: "undressed".into(), ..Heading::default() });
    let skin = look::body(&mut figure.sheet, &body, look::BODY);
    figure.sheet.cells.push(Cell { layers: vec![skin.clone()], ..Cell::default() });
    let mut clearances = Vec::new();
    for (column, fit_weight) in (1..).zip(WEIGHTS) {
        let dressed = dress(&worn, &body, &[], None, &Options { fit_weight, ..Options::default() })
            .map_err(|message| format!("fit weight {fit_weight}: {message}"))?;
        let clearance = waist_clearance(&dressed.mesh, &body);
        let sheet = &mut figure.sheet;
        let garment = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, WORN);
        let layers = vec![skin.clone(), garment];
        let caption = format!("waist {:.0} mm away", 1e3 * clearance);
        sheet.columns.push(Heading { label: format!("weight {fit_weight}"), ..Heading::default() });
        sheet.cells.push(Cell { column, caption, layers, ..Cell::default() });
        let report = &dressed.report;
        figure.rows.push(vec![
            fit_weight.to_string(),
            format!("{:.1}", 1e3 * clearance),
            format!("{:.2e}", dressed.distortions()[0]),
            format!("{} + {}", report.inflate.iterations, report.fit.iterations),
        ]);
        clearances.push(clearance);
    }
    let falls = clearances.windows(2).all(|pair| pair[1] < pair[0]);
    figure.claim(falls, "the clearance at the waist shrinks as the weight grows");
    Ok(figure)
}
