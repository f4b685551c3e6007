//! Figure 9: on one body, moving the joints at neck and waist moves the collar and the hem.

use bespoke::options::Options;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::measure::{loop_height, middle_loops};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::{LEGS, NECK, ROOT, WAIST};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

/// The joints of the neck, and those of the waist down to the hips, that a change moves, in metres upwards.
const EDITS: [(&str, f64, f64); 3] =
    [("as it is", 0.0, 0.0), ("neck lower", -0.05, 0.0), ("waist and hips higher", 0.0, 0.06)];
const WORN: Garment = Garment::Coat;

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let (mut body, worn) = (avatar(Avatar::Slim), garment(WORN));
    let designed = body.skeleton.clone();
    let [collar, hem] = middle_loops(&worn.mesh)?;
    let subtitle =
        "One coat on one body, with three skeletons in it: where the joints are decides where collar and hem come.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let mut figure = Figure::new(
        Sheet::new("Skeleton edits", subtitle, view),
        &["skeleton", "neck moved, mm", "waist and hips moved, mm", "collar at, mm", "hem at, mm"],
    );
    figure.sheet.rows = vec![Heading::default(), Heading::default()];
    let mut heights = Vec::new();
    for (column, (label, neck, waist)) in EDITS.into_iter().enumerate() {
        body.skeleton = designed.clone();
        body.skeleton.joints[NECK].z += neck;
        for joint in [ROOT, WAIST, LEGS[0][0], LEGS[1][0]] {
            body.skeleton.joints[joint].z += waist;
        }
        let dressed =
            dress(&worn, &body, &[], None, &Options::default()).map_err(|message| format!("{label}: {message}"))?;
        let [top, bottom] = [&collar, &hem].map(|curve| loop_height(&dressed.mesh.positions, curve));
        let sheet = &mut figure.sheet;
        sheet.columns.push(Heading { label: label.into(), ..Heading::default() });
        let skin = look::body(sheet, &body, look::BODY);
        let garment = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, WORN);
        let caption = format!("collar {:.0} mm, hem {:.0} mm", 1e3 * top, 1e3 * bottom);
        sheet.cells.push(Cell { column, caption, layers: vec![skin.clone(), garment], ..Cell::default() });
        let bones = look::skeleton(sheet, &body, true);
        sheet.cells.push(Cell { column, row: 1, layers: vec![skin, bones], ..Cell::default() });
        let millimetres = [neck, waist, top, bottom].map(|z| format!("{:.0}", 1e3 * z));
        figure.rows.push([label.to_string()].into_iter().chain(millimetres).collect());
        heights.push([top, bottom]);
    }
    let [[collar, hem], [lower, _], [_, higher]] = heights[..] else { return Err("three edits were expected".into()) };
    let [fall, rise] = [1e3 * (collar - lower), 1e3 * (higher - hem)];
    figure.claim(fall > 10.0, format!("a lower neck joint brings the collar down, by {fall:.0} mm"));
    figure.claim(rise > 10.0, format!("higher joints at waist and hips bring the hem up, by {rise:.0} mm"));
    Ok(figure)
}
