//! The gallery as a sheet: garments down, bodies across, undressed above, the designs at the left.

use crate::look;
use crate::models::Closet;
use crate::pair::Outcome;
use crate::sheet::{Cell, Heading, Layer, Role, Sheet, Values, View};
use crate::table::{Summary, figures};
use closet::Sample;

/// A body in the grid.
struct Column {
    body: Layer,
    skeleton: Layer,
}

impl Column {
    fn new(sheet: &mut Sheet, body: &Sample, colour: &'static str) -> Self {
        Self { body: look::body(sheet, body, colour), skeleton: look::skeleton(sheet, body, false) }
    }

    /// The body, then `garment` on it.
    fn layers(&self, garment: Option<Layer>) -> Vec<Layer> {
        [Some(self.body.clone()), garment, Some(self.skeleton.clone())].into_iter().flatten().collect()
    }
}

/// All pairs of `closet`, as `outcomes` has them: garment after garment, avatar after avatar.
pub fn sheet(closet: &Closet, outcomes: &[Outcome], summary: &Summary) -> Sheet {
    let view = View { azimuth: 24.0, elevation: 7.0, ..View::default() };
    let mut sheet = Sheet::new("The gallery", &format!("{}.", summary.sentence()), view);
    // A giant is larger than a child, but not so much that nothing of the child is seen.
    sheet.evenness = 0.4;
    sheet.scales.push(look::distortion_scale());
    let mut columns = vec![Column::new(&mut sheet, &closet.mannequin, look::MANNEQUIN)];
    sheet.columns.push(Heading { label: "Mannequin".into(), note: "as designed".into(), reference: None });
    for (avatar, body) in &closet.avatars {
        columns.push(Column::new(&mut sheet, body, look::BODY));
        sheet.columns.push(Heading { label: heading(avatar.name()), ..Heading::default() });
    }
    sheet.rows.push(Heading { label: "Undressed".into(), ..Heading::default() });
    for (column, body) in columns.iter().enumerate() {
        sheet.cells.push(Cell { column, layers: body.layers(None), ..Cell::default() });
    }
    for (row, (garment, worn)) in (1..).zip(&closet.garments) {
        let note = format!("{} vertices", worn.mesh.positions.len());
        sheet.rows.push(Heading { label: heading(garment.name()), note, reference: Some(0) });
        let design = look::garment(&mut sheet, &worn.mesh.positions, &worn.mesh.triangles, *garment);
        sheet.cells.push(Cell { row, layers: columns[0].layers(Some(design)), ..Cell::default() });
        for (column, (avatar, _)) in (1..).zip(&closet.avatars) {
            let of_pair = |o: &&Outcome| o.garment == garment.name() && o.avatar == avatar.name();
            let Some(outcome) = outcomes.iter().find(of_pair) else { continue };
            let mut cell = Cell { column, row, figures: figures(outcome), ..Cell::default() };
            match &outcome.error {
                Some(error) => cell.message = Some(error.clone()),
                None => {
                    let mesh = sheet.add_mesh(&outcome.positions, &worn.mesh.triangles);
                    let mut garment = look::surface(Role::Garment, mesh, look::colour(*garment));
                    let array = sheet.add_floats(&outcome.distortions);
                    if let Layer::Surface { values, .. } = &mut garment {
                        *values = Some(Values { array, scale: 0, shown: false });
                    }
                    cell.layers = columns[column].layers(Some(garment));
                    let [inflate, fit] = outcome.iterations;
                    cell.caption = format!("{:.1} s\n{inflate} + {fit} iterations", outcome.seconds);
                }
            }
            sheet.cells.push(cell);
        }
    }
    sheet
}

/// A name as a heading.
fn heading(name: &str) -> String {
    let words = name.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
