//! A sweater of which both sides are modelled keeps its cuffs, hem and collar where the same sweater of one side has them.

use bespoke::geometry::mesh::Topology;
use bespoke::options::Options;
use glam::DVec3;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use closet::Sample;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::{ARMS, NECK, ROOT, Skeleton, WAIST};
use closet::thickness::{Rim, thickened};
use gallery::look;
use gallery::sheet::{Cell, Heading, Sheet, View};

const WORN: Garment = Garment::Sweater;
const BODIES: [Avatar; 3] = [Avatar::LongArms, Avatar::Heavy, Avatar::Child];
/// The ways in which both sides are joined; none: there is one side.
const RIMS: [(&str, Option<Rim>); 3] =
    [("one side", None), ("folded", Some(Rim::Fold)), ("a half-round", Some(Rim::Round(4)))];
/// Metres.
const THICKNESS: f64 = 0.006;
/// Cuffs may be off by this share of the forearm.
const ALLOWED: f64 = 0.05;

/// An opening, as vertices of the side that is seen, with the joints of the bone that it is around.
struct Opening {
    vertices: Vec<u32>,
    bone: [usize; 2],
}

impl Opening {
    /// The mean place of its vertices along its bone, 0 at its first joint and 1 at the other.
    fn place(&self, x: &[DVec3], skeleton: &Skeleton) -> f64 {
        let [a, b] = self.bone.map(|joint| skeleton.joints[joint]);
        let place = |&v: &u32| (x[v as usize] - a).dot(b - a) / (b - a).length_squared();
        self.vertices.iter().map(place).sum::<f64>() / self.vertices.len() as f64
    }
}

/// Both cuffs, the collar and the hem.
fn openings(worn: &Sample) -> Outcome<[Opening; 4]> {
    let joints = worn.skeleton.joints;
    let loops = Topology::new(worn.mesh.positions.len(), &worn.mesh.triangles).loops;
    let nearest = |joint: usize, bone: [usize; 2]| {
        let mean =
            |curve: &[u32]| curve.iter().map(|&v| worn.mesh.positions[v as usize]).sum::<DVec3>() / curve.len() as f64;
        let distance = |curve: &[u32]| mean(curve).distance(joints[joint]);
        let curves = loops.iter().map(|curve| &curve.vertices);
        let vertices = curves.min_by(|a, b| distance(a).total_cmp(&distance(b)))?.clone();
        Some(Opening { vertices, bone })
    };
    let [[_, elbow, wrist], [_, other_elbow, other_wrist]] = ARMS;
    let found = [
        nearest(wrist, [elbow, wrist]),
        nearest(other_wrist, [other_elbow, other_wrist]),
        nearest(NECK, [WAIST, NECK]),
        nearest(ROOT, [WAIST, ROOT]),
    ];
    match found {
        [Some(left), Some(right), Some(collar), Some(hem)] => Ok([left, right, collar, hem]),
        _ => Err("the sweater has no openings".into()),
    }
}

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let subtitle = "A sweater of one side, and with both sides of its cloth modelled, 6 mm apart, on other bodies.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let columns =
        ["body", "openings", "cuffs along the forearm", "collar along the chest", "hem along the belly", "iterations"];
    let mut figure = Figure::new(Sheet::new("Both sides modelled", subtitle, view), &columns);
    let sweater = garment(WORN);
    let openings = openings(&sweater)?;
    let places = |x: &[DVec3], skeleton: &Skeleton| openings.each_ref().map(|opening| opening.place(x, skeleton));
    let row = |body: &str, rim: &str, [left, right, collar, hem]: [f64; 4], iterations: String| {
        vec![
            body.to_string(),
            rim.to_string(),
            format!("{left:.3}, {right:.3}"),
            format!("{collar:.3}"),
            format!("{hem:.3}"),
            iterations,
        ]
    };
    let designed = places(&sweater.mesh.positions, &sweater.skeleton);
    figure.rows.push(row("mannequin", "as designed", designed, String::new()));
    figure.sheet.rows.extend(RIMS.map(|(name, _)| Heading { label: name.into(), ..Heading::default() }));
    let mut off = 0.0_f64;
    for (column, kind) in BODIES.into_iter().enumerate() {
        let body = avatar(kind);
        let skin = look::body(&mut figure.sheet, &body, look::BODY);
        figure.sheet.columns.push(Heading { label: kind.name().into(), ..Heading::default() });
        for (line, (name, rim)) in RIMS.into_iter().enumerate() {
            let mut worn = sweater.clone();
            if let Some(rim) = rim {
                worn.mesh = thickened(&sweater.mesh, THICKNESS, rim);
            }
            let dressed = dress(&worn, &body, &[], None, &Options::default())
                .map_err(|message| format!("{name}, {}: {message}", kind.name()))?;
            let ended = places(&dressed.mesh.positions, &body.skeleton);
            for k in 0..2 {
                off = off.max((ended[k] - designed[k]).abs());
            }
            let iterations = format!("{} + {}", dressed.report.inflate.iterations, dressed.report.fit.iterations);
            figure.rows.push(row(kind.name(), name, ended, iterations));
            let sheet = &mut figure.sheet;
            let garment = look::garment(sheet, &dressed.mesh.positions, &dressed.mesh.triangles, WORN);
            let caption = format!("cuffs at {:.2}", 0.5 * (ended[0] + ended[1]));
            sheet.cells.push(Cell {
                row: line,
                column,
                caption,
                layers: vec![skin.clone(), garment],
                ..Cell::default()
            });
        }
    }
    figure.claim(
        off < ALLOWED,
        format!("cuffs are off their place along the forearm by {off:.3} of it at most (allowed: {ALLOWED})"),
    );
    Ok(figure)
}
