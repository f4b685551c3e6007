//! The body that a garment was made for, and the body that it is put on, out of the parts of a character.

use bespoke::geometry::mesh::{TriangleMesh, triangle_area};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::body_part::BodyPart;
use bespoke::session::PartRole;

use crate::figure::{Figure, Part};
use crate::fit::Skinned;
use crate::parts::Kind;

/// Skin of less than this share of the garment's area at a joint is no body beneath it: its maker has taken it away.
const BENEATH: f64 = 0.3;
/// A garment with more than this share of its area at such joints has no body of its own in the file.
const MISSING: f64 = 0.25;
/// Hair that hangs lower than this below the head's joint, in heights of the head, lies on shoulders and garments.
const HANGS: f64 = 0.25;

/// One mesh of several parts, and whose triangle each is.
pub fn joined<'a>(parts: impl IntoIterator<Item = &'a Part>, joints: usize) -> (Skinned, Vec<usize>) {
    let mut mesh = TriangleMesh::default();
    let (mut rows, mut owners) = (Vec::new(), Vec::new());
    for (owner, part) in parts.into_iter().enumerate() {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(&part.positions);
        mesh.triangles.extend(part.triangles.iter().map(|t| t.map(|v| v + first)));
        rows.extend(part.influences.iter().cloned());
        owners.resize(mesh.triangles.len(), owner);
    }
    (Skinned { mesh, skin: SkinWeights::from_rows(joints, rows) }, owners)
}

/// The body to dress.
#[derive(Clone, Debug)]
pub struct Avatar {
    /// What is dressed, with all that must not be passed through.
    pub body: Skinned,
    /// What each of its triangles is.
    pub roles: Vec<PartRole>,
    /// What there is to say, in words.
    pub notes: Vec<String>,
}

/// The body of `figure` that an outfit is fitted to: its skin, its clothes too where `clothed`, and close hair, which is not
/// fitted to but not passed through.
pub fn avatar(figure: &Figure, clothed: bool) -> Avatar {
    let mut notes = Vec::new();
    let clothes: Vec<&Part> = figure.of(Kind::Garment).collect();
    let mut worn = clothed;
    if !clothed && !clothes.is_empty() && !has_skin_beneath(figure, &clothes) {
        worn = true;
        notes.push(
            "the avatar has no skin beneath its own clothes; the outfit is fitted over them, and they are not in the result"
                .to_string(),
        );
    }
    let hair_hangs = hangs(figure);
    let takes_part = |part: &&Part| match part.sorted.kind {
        Kind::Body => true,
        Kind::Hair => !hair_hangs,
        Kind::Garment => worn,
        Kind::Prop => false,
    };
    if hair_hangs {
        notes.push("the avatar's hair hangs over its shoulders; it takes no part".to_string());
    }
    let parts: Vec<&Part> = figure.parts.iter().filter(takes_part).collect();
    let (body, owners) = joined(parts.iter().copied(), figure.rig.joints.len());
    let role = |&owner: &usize| match parts[owner].sorted.kind {
        Kind::Hair => PartRole::Collision,
        _ => PartRole::Automatic,
    };
    Avatar { roles: owners.iter().map(role).collect(), body, notes }
}

/// The body that the garments of `figure` were made for: its skin, or the whole character with its clothes where a maker has taken
/// away the skin beneath them. None in a file without either.
pub fn source(figure: &Figure) -> Option<Skinned> {
    let clothes: Vec<&Part> = figure.of(Kind::Garment).collect();
    let kinds: &[Kind] = match clothes.is_empty() || has_skin_beneath(figure, &clothes) {
        true => &[Kind::Body],
        false => &[Kind::Body, Kind::Hair, Kind::Garment],
    };
    let parts: Vec<&Part> = figure.parts.iter().filter(|part| kinds.contains(&part.sorted.kind)).collect();
    (!parts.is_empty()).then(|| joined(parts, figure.rig.joints.len()).0)
}

/// Whether there is body under most of the area of `clothes`, joint by joint.
fn has_skin_beneath(figure: &Figure, clothes: &[&Part]) -> bool {
    let joints = figure.rig.joints.len();
    let mut covered = vec![0.0; joints];
    clothes.iter().for_each(|part| add_areas(part, &mut covered));
    let mut skin = vec![0.0; joints];
    figure.of(Kind::Body).for_each(|part| add_areas(part, &mut skin));
    let bare: f64 = (0..joints).filter(|&j| skin[j] < BENEATH * covered[j]).map(|j| covered[j]).sum();
    bare <= MISSING * covered.iter().sum::<f64>()
}

/// Adds the area that each joint moves of a part.
fn add_areas(part: &Part, areas: &mut [f64]) {
    for triangle in &part.triangles {
        let area = triangle_area(triangle.map(|v| part.positions[v as usize])) / 3.0;
        for &(joint, weight) in triangle.iter().flat_map(|&v| &part.influences[v as usize]) {
            areas[joint as usize] += area * weight;
        }
    }
}

/// Whether hair hangs below the head. glTF's y is up.
fn hangs(figure: &Figure) -> bool {
    let reading = figure.reading();
    let Some(head) = reading.joint_of(BodyPart::Head).map(|joint| figure.rig.place(joint).y) else { return false };
    let top = figure.of(Kind::Body).flat_map(|part| &part.positions).map(|p| p.y).fold(head, f64::max);
    figure.of(Kind::Hair).flat_map(|part| &part.positions).any(|p| p.y < head - HANGS * (top - head))
}
