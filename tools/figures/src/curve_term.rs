//! Figure 10: with the curve term the V of a neckline stays a V on a body with broad shoulders, at every resolution.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::measure::{Neckline, NecklineShape};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, vest};
use closet::{Kind, sample};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

const WORN: Garment = Garment::Vest;

/// Multiples of the edge lengths, the finest last.
const COARSENESS: [f64; 4] = [2.0, 1.4, 1.0, 0.5];

/// By how much the V may open, in degrees.
const KEPT: f64 = 8.0;

/// Weights of curvature and torsion; none for the default one, and whether the terms are as printed.
const TERMS: [(Option<f64>, bool); 5] =
    [(Some(0.0), false), (None, true), (None, false), (Some(10.0), false), (Some(1000.0), false)];

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let (mannequin, body) = (sample(Kind::Mannequin), avatar(Avatar::Giant));
    let subtitle = "A vest on a body with broad shoulders, modelled with coarse and with fine triangles, with weights of the \
                    term that keeps the shape of boundary curves.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let columns = [
        "vertices",
        "weight of curvature and torsion",
        "angle of the V, degrees",
        "at its point",
        "bend of its sides",
        "mean distortion",
        "iterations",
    ];
    let mut figure = Figure::new(Sheet::new("Curve term", subtitle, view), &columns);
    let default = Options::default().curvature_weight;
    figure.sheet.columns.push(Heading { label: "as designed".into(), ..Heading::default() });
    let names = TERMS.map(|(weight, as_printed)| match (weight, as_printed) {
        (Some(0.0), _) => "without the term".into(),
        (Some(weight), _) => format!("{weight}"),
        (None, true) => "as printed".into(),
        (None, false) => format!("{default}, the default"),
    });
    figure.sheet.columns.extend(names.iter().map(|label| Heading { label: label.clone(), ..Heading::default() }));
    let nude = look::body(&mut figure.sheet, &mannequin, look::MANNEQUIN);
    let skin = look::body(&mut figure.sheet, &body, look::BODY);
    let caption = |shape: &NecklineShape| format!("{:.0} degrees, {:.0} at the point", shape.angle, shape.at_point);
    let mut opens = [const { Vec::new() }; TERMS.len()];
    for (row, coarseness) in COARSENESS.into_iter().enumerate() {
        let worn = vest(coarseness);
        let vertices = worn.mesh.positions.len();
        let neckline = Neckline::of(&worn.mesh)?;
        let designed = neckline.shape(&worn.mesh.positions);
        let cells = |name: &str, shape: &NecklineShape, distortion: f64, iterations: String| {
            vec![
                vertices.to_string(),
                name.to_string(),
                format!("{:.1}", shape.angle),
                format!("{:.1}", shape.at_point),
                format!("{:.1} %", 1e2 * shape.bend),
                format!("{distortion:.2e}"),
                iterations,
            ]
        };
        figure.sheet.rows.push(Heading { label: format!("{vertices} vertices"), ..Heading::default() });
        let made = look::garment(&mut figure.sheet, &worn.mesh.positions, &worn.mesh.triangles, WORN);
        let layers = vec![nude.clone(), made];
        figure.sheet.cells.push(Cell { row, caption: caption(&designed), layers, ..Cell::default() });
        figure.rows.push(cells("as designed", &designed, 0.0, String::new()));
        for (column, (weight, as_printed)) in TERMS.into_iter().enumerate() {
            let mut options = Options::default();
            if let Some(weight) = weight {
                (options.curvature_weight, options.torsion_weight) = (weight, weight);
            }
            if as_printed {
                options.curve_chord = 0.0;
            }
            let dressed = dress(&worn, &body, &[], None, &options)
                .map_err(|message| format!("{vertices} vertices, {}: {message}", names[column]))?;
            let shape = neckline.shape(&dressed.mesh.positions);
            let garment = look::garment(&mut figure.sheet, &dressed.mesh.positions, &dressed.mesh.triangles, WORN);
            let layers = vec![skin.clone(), garment];
            let caption = caption(&shape);
            figure.sheet.cells.push(Cell { row, column: column + 1, caption, layers, ..Cell::default() });
            let iterations = format!("{} + {}", dressed.report.inflate.iterations, dressed.report.fit.iterations);
            figure.rows.push(cells(&names[column], &shape, dressed.distortions()[0], iterations));
            opens[column].push((shape.angle - designed.angle).abs());
        }
    }
    let most = |column: usize| opens[column].iter().copied().fold(0.0, f64::max);
    let [without, printed, by_default] = [0, 1, 2].map(most);
    figure.claim(
        by_default < KEPT,
        format!(
            "by default the V opens by {by_default:.1} degrees at most, as printed by {printed:.1}, without the term by \
             {without:.1}"
        ),
    );
    Ok(figure)
}
