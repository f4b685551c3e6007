//! Skin weights of results: garment and body posed by their weights, and what passes through what.
//!
//! Beside the library's weights stand those of the nearest vertex and of the closest point of the body, which is what tools
//! hand out. What a pose needs beyond weights shows as well: a body of few triangles bends along these, which no weights of
//! the garment can follow.

use bespoke::control::Cancel;
use bespoke::error::Error;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::rig::weights::blend::linear_blend;
use bespoke::rig::weights::{TransferOptions, limited, sure_weights, transfer};
use glam::{DAffine3, DVec3};

use crate::dressed::dress;
use crate::figure::{Figure, Outcome};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::BONES;
use closet::{Kind, Sample, sample};
use gallery::sheet::{Cell, Heading, Role, Sheet, View};
use gallery::{look, pair};
use testing::posing::{Bound, Counts, POSES, Puppet, nearest_vertex};

const PAIRS: [(Garment, Avatar); 10] = [
    (Garment::Jumpsuit, Avatar::Slim),
    (Garment::Jumpsuit, Avatar::Heavy),
    (Garment::Coat, Avatar::LongArms),
    (Garment::Coat, Avatar::Heavy),
    (Garment::Sweater, Avatar::Child),
    (Garment::Sweater, Avatar::Tall),
    (Garment::Sweater, Avatar::Giant),
    (Garment::Trousers, Avatar::Heavy),
    (Garment::Trousers, Avatar::Child),
    (Garment::Vest, Avatar::Slim),
];

/// Pairs of which there are pictures.
const SHOWN: [usize; 4] = [1, 2, 4, 8];

const METHODS: [&str; 3] = ["nearest vertex", "closest point", "Bespoke"];

/// Influences that most engines take.
pub const INFLUENCES: usize = 4;

/// By how much each joint bends, in degrees.
pub const BEND: f64 = 45.0;

/// The share of what the nearest vertex gives that is allowed.
const ALLOWED: f64 = 1.0 / 3.0;

/// Weights of a garment as tools hand them out: those of the nearest vertex of the body, and of the closest point.
///
/// # Errors
/// Those of the library.
pub fn by_tools(worn: &TriangleMesh, body: &TriangleMesh, skin: &SkinWeights) -> Result<[SkinWeights; 2], Error> {
    let closest = sure_weights(worn, body, skin, &TransferOptions::default(), &Cancel::new())?.weights;
    Ok([nearest_vertex(worn, body, skin), closest].map(|weights| limited(&weights, INFLUENCES)))
}

/// Weights of the same garment by all methods.
fn weights(worn: &TriangleMesh, body: &TriangleMesh, skin: &SkinWeights) -> Result<[SkinWeights; 3], Error> {
    let own = transfer(worn, body, skin, &TransferOptions::default(), &Cancel::new())?;
    let [nearest, closest] = by_tools(worn, body, skin)?;
    Ok([nearest, closest, limited(&own, INFLUENCES)])
}

/// The skin of a body.
pub fn skin_of(body: &Sample) -> Outcome<SkinWeights> {
    let rows: Vec<f64> = body.skin.iter().flatten().copied().collect();
    SkinWeights::from_dense(&rows, body.skin.len(), body.mesh.positions.len(), "skin").map_err(|error| error.message)
}

/// Makes the figure.
pub fn figure() -> Outcome<Figure> {
    let mannequin = sample(Kind::Mannequin);
    let subtitle = "Shoulders, elbows, hips and knees bent by 45 degrees, body and garment by their skin weights. Pairs of \
                    triangles that pass through each other, in each of these poses and all at once: within the garment + of \
                    garment and body (where the body passes through itself).";
    let view = View { azimuth: 24.0, elevation: 7.0, ..View::default() };
    let mut figure = Figure::new(Sheet::new("Skin weights", subtitle, view), &["garment", "body", "weights", "pairs"]);
    figure.sheet.rows.extend(METHODS.map(|label| Heading { label: label.into(), ..Heading::default() }));
    let mut totals = [Counts::default(); METHODS.len()];
    for (number, (kind, who)) in PAIRS.into_iter().enumerate() {
        let (worn, body) = (garment(kind), avatar(who));
        let dressed = dress(&worn, &body, &[], Some(&mannequin), &Options::default())
            .map_err(|message| format!("{} on {}: {message}", kind.name(), who.name()))?;
        let (under, skin) = (pair::mesh(&body.mesh), skin_of(&body)?);
        let skeleton = Skeleton { joints: body.skeleton.joints.to_vec(), bones: BONES.to_vec() };
        let puppet = Puppet::new(&skeleton, DVec3::NEG_Y, DVec3::Z);
        let moves = POSES.map(|pose| puppet.moves(pose, BEND));
        let bound = Bound::new(&dressed.mesh, &under, &skin);
        let posed = moves.each_ref().map(|moves| bound.posed(moves));
        let column = SHOWN.iter().position(|&shown| shown == number);
        let all_bent: &[DAffine3] = &moves[POSES.len() - 1];
        let posed_body = column.map(|_| {
            let label = format!("{}, {}", kind.name(), who.name());
            figure.sheet.columns.push(Heading { label, ..Heading::default() });
            let mesh = figure
                .sheet
                .add_mesh(&look::positions(&linear_blend(&under.positions, &skin, all_bent)), &under.triangles);
            look::surface(Role::Body, mesh, look::BODY)
        });
        let weights = weights(&dressed.mesh, &under, &skin).map_err(|error| error.message)?;
        for (row, (name, weights)) in METHODS.into_iter().zip(weights).enumerate() {
            let mut sum = Counts::default();
            posed.iter().for_each(|pose| sum += pose.counts(&dressed.mesh.positions, &weights));
            totals[row] += sum;
            let caption = format!("{} + {} ({})", sum.own, sum.body, sum.folds);
            figure.rows.push(vec![kind.name().into(), who.name().into(), name.into(), caption.clone()]);
            if let (Some(column), Some(skin)) = (column, &posed_body) {
                let posed = linear_blend(&dressed.mesh.positions, &weights, all_bent);
                let cloth = look::garment(&mut figure.sheet, &posed, &dressed.mesh.triangles, kind);
                figure.sheet.cells.push(Cell {
                    column,
                    row,
                    caption,
                    layers: vec![skin.clone(), cloth],
                    ..Cell::default()
                });
            }
        }
    }
    let [nearest, closest, own] = totals.map(|sum| sum.own + sum.body);
    figure.claim(
        own as f64 <= ALLOWED * nearest as f64,
        format!("{own} pairs in all, {nearest} by nearest vertices (allowed: a third)"),
    );
    figure.claim(own < closest, format!("{own} pairs in all, {closest} by closest points"));
    Ok(figure)
}
