//! Figure 6: garments over each other, each an obstacle for the next, and no triangle through any other.

use bespoke::options::Options;
use bespoke::verify::intersections;

use crate::dressed::{Dressed, dress};
use crate::figure::{Figure, Outcome};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use gallery::look;
use gallery::pair;
use gallery::sheet::{Cell, Heading, Sheet, View};

/// From the skin outwards.
const WORN: [Garment; 3] = [Garment::Jumpsuit, Garment::Coat, Garment::Skirt];

/// The body that wears them.
const BODY: Avatar = Avatar::Tall;

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let body = avatar(BODY);
    let mut layers: Vec<(Garment, Dressed)> = Vec::new();
    for kind in WORN {
        let below: Vec<_> = layers.iter().map(|(_, dressed)| dressed.mesh.clone()).collect();
        let dressed = dress(&garment(kind), &body, &below, None, &Options::default())
            .map_err(|message| format!("{} over {} layers: {message}", kind.name(), below.len()))?;
        layers.push((kind, dressed));
    }
    let subtitle = "A jumpsuit, a coat over it, a skirt on top: each garment fits what lies below it.";
    let view = View { azimuth: 24.0, elevation: 7.0, ..View::default() };
    let mut figure = Figure::new(Sheet::new("Layers", subtitle, view), &["layers", "intersecting pairs of triangles"]);
    let sheet = &mut figure.sheet;
    sheet.rows.push(Heading::default());
    let undressed = look::body(sheet, &body, look::BODY);
    let mut drawn = vec![undressed];
    for step in 0..=layers.len() {
        let label = match step {
            0 => "undressed".to_string(),
            _ => format!("{}{}", if step > 1 { "+ " } else { "" }, layers[step - 1].0.name()),
        };
        if let Some((kind, dressed)) = step.checked_sub(1).map(|k| &layers[k]) {
            drawn.push(look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, *kind));
        }
        sheet.columns.push(Heading { label, ..Heading::default() });
        sheet.cells.push(Cell { column: step, layers: drawn.clone(), ..Cell::default() });
    }
    let skin = pair::mesh(&body.mesh);
    let mut all = 0;
    let mut row = |figure: &mut Figure, what: String, count: u64| {
        all += count;
        figure.rows.push(vec![what, count.to_string()]);
    };
    for (k, (kind, dressed)) in layers.iter().enumerate() {
        let count = |other| intersections(&dressed.mesh, other, 0).map(|found| found.count).map_err(|e| e.message);
        row(&mut figure, kind.name().to_string(), count(None)?);
        row(&mut figure, format!("{} and body", kind.name()), count(Some(&skin))?);
        for (below, under) in &layers[..k] {
            row(&mut figure, format!("{} and {}", kind.name(), below.name()), count(Some(&under.mesh))?);
        }
    }
    figure.claim(all == 0, "no triangle passes through another, by the exact verifier, between any two layers");
    Ok(figure)
}
