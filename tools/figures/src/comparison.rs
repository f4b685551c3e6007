//! Section 4.2: the same garments on the same bodies, by the transfer that tools offer today and by the library.

use std::collections::HashSet;

use bespoke::energy::distortion::distortion;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::verify::intersections;

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use crate::transfer::transfer;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::{Kind, sample};
use gallery::look;
use gallery::pair;
use gallery::sheet::{Cell, Heading, Layer, Role, Sheet, View};

const PAIRS: [(Garment, Avatar); 4] = [
    (Garment::Jumpsuit, Avatar::LongArms),
    (Garment::Coat, Avatar::Heavy),
    (Garment::Skirt, Avatar::Giant),
    (Garment::Sweater, Avatar::Child),
];

/// The colour of triangles that intersect others.
const INTERSECTING: &str = "#e0241b";

/// A result, and what an exact judge says of it.
struct Judged {
    mesh: TriangleMesh,
    /// Pairs within the garment, and of garment and body.
    pairs: [u64; 2],
    /// Garment triangles that are in such a pair.
    faulty: HashSet<u32>,
    /// Mean and largest.
    distortion: [f64; 2],
}

impl Judged {
    fn new(mesh: TriangleMesh, body: &TriangleMesh, distortion: &[f64]) -> Outcome<Self> {
        let judge = |other| intersections(&mesh, other, usize::MAX).map_err(|error| error.message);
        let [own, others] = [judge(None)?, judge(Some(body))?];
        let faulty = own.pairs.iter().flatten().copied().chain(others.pairs.iter().map(|pair| pair[0])).collect();
        Ok(Self { mesh, pairs: [own.count, others.count], faulty, distortion: pair::mean_and_largest(distortion) })
    }

    /// The garment in `colour`, and in another one what intersects.
    fn layers(&self, sheet: &mut Sheet, colour: &str) -> Vec<Layer> {
        let positions = look::positions(&self.mesh.positions);
        let part = |is_faulty: bool| -> Vec<[u32; 3]> {
            let numbered = (0u32..).zip(&self.mesh.triangles);
            numbered.filter(|(k, _)| self.faulty.contains(k) == is_faulty).map(|(_, &t)| t).collect()
        };
        let parts = [(part(false), colour, Role::Garment), (part(true), INTERSECTING, Role::Mark)];
        let drawn = parts.into_iter().filter(|(triangles, ..)| !triangles.is_empty());
        drawn
            .map(|(triangles, colour, role)| look::surface(role, sheet.add_mesh(&positions, &triangles), colour))
            .collect()
    }

    fn caption(&self) -> String {
        format!("{} + {} intersections", self.pairs[0], self.pairs[1])
    }
}

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let mannequin = sample(Kind::Mannequin);
    let subtitle = "Above, skinning and a shrink-wrap to the designed offset, as tools do it today; below, this library. Red: \
                    triangles that pass through others of the garment or through the body.";
    let view = View { azimuth: 24.0, elevation: 7.0, ..View::default() };
    let columns =
        ["garment", "body", "", "intersections within the garment", "with the body", "mean distortion", "largest"];
    let mut figure = Figure::new(Sheet::new("Comparison", subtitle, view), &columns);
    figure.sheet.rows =
        ["skinning and offset", "Bespoke"].map(|label| Heading { label: label.into(), ..Heading::default() }).to_vec();
    let mut totals = [(0, 0.0); 2];
    for (column, (kind, who)) in PAIRS.into_iter().enumerate() {
        let (worn, body) = (garment(kind), avatar(who));
        let skin = pair::mesh(&body.mesh);
        let rest = pair::mesh(&worn.mesh).positions;
        let moved = transfer(&worn, &mannequin, &body);
        let bent = distortion(&rest, &moved.positions, &moved.triangles);
        let dressed = dress(&worn, &body, &[], Some(&mannequin), &Options::default())
            .map_err(|message| format!("{} on {}: {message}", kind.name(), who.name()))?;
        let both = [Judged::new(moved, &skin, &bent)?, Judged::new(dressed.mesh, &skin, &dressed.distortion)?];
        let sheet = &mut figure.sheet;
        sheet.columns.push(Heading { label: format!("{}, {}", kind.name(), who.name()), ..Heading::default() });
        let under = look::body(sheet, &body, look::BODY);
        for (row, judged) in both.iter().enumerate() {
            let mut layers = vec![under.clone()];
            layers.extend(judged.layers(sheet, look::colour(kind)));
            sheet.cells.push(Cell { column, row, caption: judged.caption(), layers, ..Cell::default() });
        }
        for (row, (judged, how)) in both.iter().zip(["skinning and offset", "Bespoke"]).enumerate() {
            let [own, others] = judged.pairs.map(|n| n.to_string());
            let [mean, largest] = judged.distortion.map(|d| format!("{d:.2e}"));
            figure.rows.push(vec![kind.name().into(), who.name().into(), how.into(), own, others, mean, largest]);
            totals[row].0 += judged.pairs[0] + judged.pairs[1];
            totals[row].1 += judged.distortion[0] / PAIRS.len() as f64;
        }
    }
    let [(theirs, their_mean), (ours, our_mean)] = totals;
    figure.claim(ours == 0, format!("no intersection here, {theirs} by skinning and offset"));
    figure.claim(
        our_mean < their_mean,
        format!("mean distortion {our_mean:.1e} here, {their_mean:.1e} by skinning and offset"),
    );
    Ok(figure)
}
