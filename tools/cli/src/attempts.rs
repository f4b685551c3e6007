//! What is tried where a garment cannot be dressed as it should be.
//!
//! Each thing that is tried gives up a little more, and what it has given up is told, with the number of triangles that pass
//! through each other for it.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::rig::Rig;
use bespoke::input::skin::SkinWeights;
use bespoke::rig::body_part::BodyPart;
use bespoke::rig::landmark::Landmark;
use bespoke::rig::places::owners;
use bespoke::rig::reading::Reading;
use bespoke::session::PartRole;
use bespoke::verify::intersections;

use crate::fit::{Fitted, Job, Refused};
use crate::progress::is_stopped;

/// A garment with more than this share of its vertices at the head is worn on it.
const ON_HEAD: f64 = 0.1;

/// Dresses a garment over those that are worn already. Where it cannot give way to them, as where the shells of a shirt and of
/// trousers meet edge to edge, it is dressed over the body alone. Where the head lies on the shoulders, as a hood or the large head of
/// a toy does, it is dressed beneath the head; not where other parts of the body hold it.
pub fn put_on(job: &Job) -> Result<Fitted, Box<Refused>> {
    let head = head(job);
    let job = &Job { dispensable: head.as_ref().map_or(&[], |head| &head.is_head), ..job.clone() };
    let refused = match job.run() {
        Err(why) if !is_stopped() => why,
        outcome => return outcome,
    };
    let done = |job: Job| if is_stopped() { None } else { job.run().ok() };
    // Where the body alone leaves it no room, it does so without the layers.
    if !job.layers.is_empty()
        && refused.held_by.is_none()
        && let Some(fitted) = done(Job { layers: &[], ..job.clone() })
    {
        let through = job.layers.iter().map(|layer| pairs(&fitted, job, layer)).sum();
        let said = "it could not be dressed over the garments beneath it";
        return Ok(told(fitted, said, "them", through, &refused));
    }
    if let Some(head) = head.as_ref().filter(|head| refused.held_by.is_none_or(|parts| head.has_any(parts)))
        && let Some(fitted) = done(Job { roles: &head.roles_without(job.roles), dispensable: &[], ..job.clone() })
    {
        let body = &job.avatar.mesh;
        let through = pairs(&fitted, job, &head.of(body));
        let said = "the head lies on the parts of the body beside it; it is dressed beneath the head";
        return Ok(told(fitted, said, "it", through, &refused));
    }
    Err(refused)
}

/// Pairs of triangles in which the garment passes through `other`.
fn pairs(fitted: &Fitted, job: &Job, other: &TriangleMesh) -> u64 {
    let cloth = TriangleMesh { positions: fitted.positions.clone(), triangles: job.garment.mesh.triangles.clone() };
    intersections(&cloth, Some(other), 0).map_or(0, |found| found.count)
}

/// With what was given up for it as its flaw, if that shows.
fn told(mut fitted: Fitted, said: &str, through: &str, pairs: u64, refused: &Refused) -> Fitted {
    if pairs > 0 {
        let why = &refused.failure.sentence;
        let said = format!("{said} and passes through {through} in {pairs} pairs of triangles ({why})");
        fitted.flaw = Some(fitted.flaw.map_or(said.clone(), |flaw| format!("{flaw}; {said}")));
    }
    fitted
}

/// Which triangles of a body are its head.
struct Head {
    is_head: Vec<bool>,
}

impl Head {
    fn has_any(&self, triangles: [u32; 2]) -> bool {
        triangles.iter().any(|&t| self.is_head[t as usize])
    }

    /// The roles with the head taking no part.
    fn roles_without(&self, roles: &[PartRole]) -> Vec<PartRole> {
        let taken = |(role, head): (&PartRole, &bool)| if *head { PartRole::Ignored } else { *role };
        roles.iter().zip(&self.is_head).map(taken).collect()
    }

    /// The head alone.
    fn of(&self, body: &TriangleMesh) -> TriangleMesh {
        let head = body.triangles.iter().zip(&self.is_head).filter(|(_, head)| **head);
        body.with_triangles(head.map(|(t, _)| *t))
    }
}

/// The head; none where the garment is worn on it, or there is none.
fn head(job: &Job) -> Option<Head> {
    let is_of_head = |rig: &Rig, skin: Option<&SkinWeights>| {
        let reading = Reading::new(rig, skin);
        let owners = owners(rig, &reading, &rig.parents_first("rig").ok()?);
        let of_head = |joint: usize| {
            owners[joint] == Some(Landmark::HeadTop) && reading.part(joint as u32) != Some(BodyPart::Neck)
        };
        Some((0..rig.joints.len()).map(of_head).collect::<Vec<_>>())
    };
    let moves = |skin: &SkinWeights, joints: &[bool], vertex: usize| {
        skin.dominant_joint(vertex).is_some_and(|joint| joints[joint as usize])
    };
    let of_source = is_of_head(job.source_rig, job.source.map(|body| &body.skin))?;
    let of_target = is_of_head(job.target_rig, Some(&job.avatar.skin))?;
    let cloth = &job.garment.mesh.positions;
    let worn = (0..cloth.len()).filter(|&v| moves(&job.garment.skin, &of_source, v)).count();
    if !job.has_skin || worn as f64 > ON_HEAD * cloth.len() as f64 {
        return None;
    }
    let body = &job.avatar.mesh;
    let in_head = |triangle: &[u32; 3]| triangle.iter().all(|&v| moves(&job.avatar.skin, &of_target, v as usize));
    let is_head: Vec<bool> = body.triangles.iter().map(in_head).collect();
    is_head.contains(&true).then_some(Head { is_head })
}
