//! What the library has to say of inputs and result, for scripts and for a viewport.

use godot::builtin::{PackedVector3Array, VarArray, VarDictionary, Variant, Vector3};
use godot::meta::ToGodot;

use crate::engine::Node;
use crate::figure::Figure;
use crate::native::*;
use crate::scene::Skeleton;
use crate::session::text;

/// The inputs that elements of findings belong to.
pub struct Scene {
    /// Bones that the garment was made around.
    pub source: Skeleton,
    /// Bones of the body to dress.
    pub target: Skeleton,
    /// The garment.
    pub garment: Figure,
    /// The body that it was made for.
    pub source_body: Option<Figure>,
    /// The body to dress.
    pub avatar: Figure,
    /// What it wears already.
    pub layers: Vec<Figure>,
    /// What goes along with the garment.
    pub followers: Vec<Figure>,
}

impl Scene {
    fn subject(&self, subject: u32) -> Option<(&Skeleton, Option<&Figure>)> {
        match subject {
            BESPOKE_SUBJECT_GARMENT => Some((&self.source, Some(&self.garment))),
            BESPOKE_SUBJECT_SOURCE_AVATAR => Some((&self.source, self.source_body.as_ref())),
            BESPOKE_SUBJECT_SOURCE_SKELETON => Some((&self.source, None)),
            BESPOKE_SUBJECT_TARGET_AVATAR => Some((&self.target, Some(&self.avatar))),
            BESPOKE_SUBJECT_TARGET_SKELETON => Some((&self.target, None)),
            BESPOKE_SUBJECT_LAYER..BESPOKE_SUBJECT_FOLLOWER => {
                let layer = self.layers.get((subject - BESPOKE_SUBJECT_LAYER) as usize);
                Some((&self.target, layer))
            }
            BESPOKE_SUBJECT_FOLLOWER.. => {
                Some((&self.source, self.followers.get((subject - BESPOKE_SUBJECT_FOLLOWER) as usize)))
            }
            _ => None,
        }
    }

    /// A finding as scripts read it.
    pub fn finding(&self, found: &BespokeDiagnostic) -> VarDictionary {
        let mut elements = VarArray::new();
        for element in found.elements.iter().take(found.element_count as usize) {
            elements.push(&self.element(element).to_variant());
        }
        let mut finding = VarDictionary::new();
        finding.set("kind", i64::from(found.kind));
        finding.set("severity", i64::from(found.severity));
        finding.set("message", text(&found.message.map(|letter| letter as u8)).as_str());
        finding.set("distance", found.distance);
        finding.set("elements", &elements);
        finding
    }

    fn element(&self, element: &BespokeElement) -> VarDictionary {
        let mut row = VarDictionary::new();
        row.set("subject", i64::from(element.subject));
        row.set("kind", i64::from(element.kind));
        row.set("index", i64::from(element.index));
        let Some((skeleton, figure)) = self.subject(element.subject) else { return row };
        row.set("skeleton", &skeleton.node.to_variant());
        let index = element.index as usize;
        let corners: Vec<u32> = match element.kind {
            BESPOKE_ELEMENT_KIND_TRIANGLE => figure.and_then(|f| f.triangles.get(index)).map(|t| t.to_vec()),
            BESPOKE_ELEMENT_KIND_VERTEX => Some(vec![element.index]),
            _ => None,
        }
        .unwrap_or_default();
        let Some(figure) = figure else { return row };
        let point = |&v: &u32| figure.positions.get(v as usize).map(|&[x, y, z]| Vector3::new(x, y, z));
        row.set("points", &corners.iter().filter_map(point).collect::<PackedVector3Array>());
        let part = corners.first().and_then(|&v| figure.parts.iter().rev().find(|p| p.first_vertex <= v as usize));
        row.set("node", &part.and_then(|part| part.shown.node).map_or(Variant::nil(), Node::to_variant));
        row
    }
}

/// The session's measurements as scripts read them.
pub fn report(report: &BespokeReport) -> VarDictionary {
    let stage = |stage: &BespokeStageReport| {
        let mut row = VarDictionary::new();
        row.set("seconds", stage.seconds);
        row.set("iterations", i64::from(stage.iterations));
        row
    };
    let mut row = VarDictionary::new();
    row.set("threads", i64::from(report.threads));
    row.set("prepare", &stage(&report.prepare));
    row.set("inflate", &stage(&report.inflate));
    row.set("repose", &stage(&report.repose));
    row.set("fit", &stage(&report.fit));
    row.set("verify_seconds", report.verify_seconds);
    row.set("garment_distance", report.garment_distance);
    row.set("avatar_distance", report.avatar_distance);
    row.set("garment_intersections", report.garment_intersections as i64);
    row.set("avatar_intersections", report.avatar_intersections as i64);
    row.set("initial_self_intersections", report.initial_self_intersections as i64);
    row.set("garment_vertices", report.garment_vertices as i64);
    row.set("garment_triangles", report.garment_triangles as i64);
    row.set("avatar_vertices", report.avatar_vertices as i64);
    row.set("avatar_triangles", report.avatar_triangles as i64);
    row.set("min_separation", report.min_separation);
    row.set("is_verified", report.is_verified != 0);
    row.set("is_converged", report.is_converged != 0);
    row.set("memory_bytes", report.memory_bytes as i64);
    row
}
