//! The gallery as a sheet: garments down, bodies across, undressed above, the designs at the left.

use crate::closet::Closet;
use crate::generator::garments::Garment;
use crate::generator::skeleton::BONES;
use crate::generator::{Sample, mesh};
use crate::pair::Outcome;
use crate::sheet::{Cell, Heading, Layer, Role, Scale, Sheet, Values, View};
use crate::table::{Summary, figures};

const BODY: &str = "#c0b7ab";
const MANNEQUIN: &str = "#d9d3ca";
const BONE: &str = "#c2452d";
/// What differs by less than this from its design looks undistorted, and by more than that all the same.
const DISTORTION: [f64; 2] = [1e-4, 1e-1];

/// One colour a garment.
fn colour(garment: Garment) -> &'static str {
    match garment {
        Garment::Jumpsuit => "#2f6d73",
        Garment::Coat => "#d59a33",
        Garment::Skirt => "#b04a3a",
        Garment::Sweater => "#73905f",
        Garment::Vest => "#3f5490",
        Garment::Trousers => "#775072",
    }
}

/// A body in the grid.
struct Column {
    mesh: usize,
    skeleton: Layer,
    colour: &'static str,
}

impl Column {
    fn new(sheet: &mut Sheet, body: &Sample, colour: &'static str) -> Self {
        let joints: Vec<f32> = body.skeleton.joints.iter().flat_map(|p| p.as_vec3().to_array()).collect();
        let skeleton = Layer::Lines {
            role: Role::Skeleton,
            shown: false,
            points: sheet.add_floats(&joints),
            segments: sheet.add_indices(BONES.as_flattened()),
            colour: BONE.into(),
            radius: 0.006,
            balls: true,
            over: true,
        };
        Self { mesh: sheet.add_mesh(&positions(&body.mesh), &body.mesh.triangles), skeleton, colour }
    }

    /// The body, then `garment` on it.
    fn layers(&self, garment: Option<Layer>) -> Vec<Layer> {
        let body = surface(Role::Body, self.mesh, self.colour, 50.0);
        [Some(body), garment, Some(self.skeleton.clone())].into_iter().flatten().collect()
    }
}

/// All pairs of `closet`, as `outcomes` has them: garment after garment, avatar after avatar.
pub fn sheet(closet: &Closet, outcomes: &[Outcome], summary: &Summary) -> Sheet {
    let view = View { azimuth: 24.0, elevation: 7.0, ..View::default() };
    let mut sheet = Sheet::new("The gallery", &format!("{}.", summary.sentence()), view);
    // A giant is larger than a child, but not so much that nothing of the child is seen.
    sheet.evenness = 0.4;
    sheet.scales.push(Scale {
        label: "distortion".into(),
        minimum: DISTORTION[0],
        maximum: DISTORTION[1],
        logarithmic: true,
        map: "heat".into(),
    });
    let mut columns = vec![Column::new(&mut sheet, &closet.mannequin, MANNEQUIN)];
    sheet.columns.push(Heading { label: "Mannequin".into(), note: "as designed".into(), reference: None });
    for (avatar, body) in &closet.avatars {
        columns.push(Column::new(&mut sheet, body, BODY));
        sheet.columns.push(Heading { label: heading(avatar.name()), ..Heading::default() });
    }
    sheet.rows.push(Heading { label: "Undressed".into(), ..Heading::default() });
    for (column, body) in columns.iter().enumerate() {
        sheet.cells.push(Cell { column, layers: body.layers(None), ..Cell::default() });
    }
    for (row, (garment, worn)) in (1..).zip(&closet.garments) {
        let note = format!("{} vertices", worn.mesh.positions.len());
        sheet.rows.push(Heading { label: heading(garment.name()), note, reference: Some(0) });
        let mesh = sheet.add_mesh(&positions(&worn.mesh), &worn.mesh.triangles);
        let design = surface(Role::Garment, mesh, colour(*garment), 110.0);
        sheet.cells.push(Cell { row, layers: columns[0].layers(Some(design)), ..Cell::default() });
        for (column, (avatar, _)) in (1..).zip(&closet.avatars) {
            let of_pair = |o: &&Outcome| o.garment == garment.name() && o.avatar == avatar.name();
            let Some(outcome) = outcomes.iter().find(of_pair) else { continue };
            let mut cell = Cell { column, row, figures: figures(outcome), ..Cell::default() };
            match &outcome.error {
                Some(error) => cell.message = Some(error.clone()),
                None => {
                    let mesh = sheet.add_mesh(&outcome.positions, &worn.mesh.triangles);
                    let mut garment = surface(Role::Garment, mesh, colour(*garment), 110.0);
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

fn surface(role: Role, mesh: usize, colour: &str, crease: f64) -> Layer {
    let colour = colour.to_string();
    Layer::Surface { role, shown: true, mesh, colour, opacity: 1.0, wireframe: false, crease, values: None }
}

fn positions(mesh: &mesh::Mesh) -> Vec<[f32; 3]> {
    mesh.positions.iter().map(|p| p.as_vec3().to_array()).collect()
}

/// A name as a heading.
fn heading(name: &str) -> String {
    let words = name.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
