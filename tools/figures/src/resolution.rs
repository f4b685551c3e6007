//! One vest at four resolutions: with hinges weighed by their length across, and by their area alone as printed.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::measure::mean_clearance;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, vest};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

/// Multiples of the edge lengths.
const COARSENESS: [f64; 4] = [2.0, 1.4, 1.0, 0.5];
/// The largest clearance beside the smallest, at most.
const ALLOWED: f64 = 1.2;

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let body = avatar(Avatar::Giant);
    let subtitle = "A vest on a body with broad shoulders, modelled with coarse and with fine triangles.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let columns = ["vertices", "mean clearance, mm", "iterations", "the same as printed, mm", "iterations"];
    let mut figure = Figure::new(Sheet::new("Resolution", subtitle, view), &columns);
    figure
        .sheet
        .rows
        .extend(["as by default", "as printed"].map(|label| Heading { label: label.into(), ..Heading::default() }));
    let skin = look::body(&mut figure.sheet, &body, look::BODY);
    let mut by_default = Vec::new();
    for (column, coarseness) in COARSENESS.into_iter().enumerate() {
        let worn = vest(coarseness);
        let vertices = worn.mesh.positions.len();
        let label = format!("{vertices} vertices");
        figure.sheet.columns.push(Heading { label, ..Heading::default() });
        let mut cells = vec![vertices.to_string()];
        let as_printed = Options { surface_length: 0.0, ..Options::default() };
        for (row, options) in [Options::default(), as_printed].iter().enumerate() {
            let dressed =
                dress(&worn, &body, &[], None, options).map_err(|message| format!("{vertices} vertices: {message}"))?;
            let clearance = mean_clearance(&dressed.mesh, &body);
            // The coarsest is as stiff as printed.
            if row == 0 && column > 0 {
                by_default.push(clearance);
            }
            let sheet = &mut figure.sheet;
            let garment = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, Garment::Vest);
            let caption = format!("{:.1} mm off", 1e3 * clearance);
            sheet.cells.push(Cell { row, column, caption, layers: vec![skin.clone(), garment], ..Cell::default() });
            let report = &dressed.report;
            cells.push(format!("{:.1}", 1e3 * clearance));
            cells.push(format!("{} + {}", report.inflate.iterations, report.fit.iterations));
        }
        figure.rows.push(cells);
    }
    let [least, most] =
        [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| by_default.iter().copied().reduce(of).unwrap_or(f64::NAN));
    figure.claim(
        most < ALLOWED * least,
        format!("but for the coarsest it is {:.1} to {:.1} mm off the body, within 20 %", 1e3 * least, 1e3 * most),
    );
    Ok(figure)
}
