//! The work of a session, in a thread of its own, and what comes out of it.

use std::sync::Arc;
use std::thread::JoinHandle;

use crate::mesh::BlendShape;
use crate::native::*;
use crate::session::{Failure, Influences, Result, Session};

/// What the thread needs to read a result.
pub struct Wanted {
    /// Vertices of the garment.
    pub vertices: usize,
    /// Its normals, if it has any.
    pub normals: Vec<[f32; 3]>,
    /// Its tangents, if it has any.
    pub tangents: Vec<[f32; 4]>,
    /// Its blend shapes.
    pub shapes: Vec<BlendShape>,
    /// Joints for each vertex of the result; 0 where the body has no skin.
    pub influences: usize,
    /// Joints of the body to dress.
    pub joints: usize,
}

/// A verified result.
pub struct Fitted {
    /// The garment's vertices.
    pub positions: Vec<[f32; 3]>,
    /// Normals, where it had some.
    pub normals: Vec<[f32; 3]>,
    /// Tangents, where it had some.
    pub tangents: Vec<[f32; 4]>,
    /// Blend shapes: offsets, and normals and tangents at weight 1.
    pub shapes: Vec<BlendShape>,
    /// Skin weights, where the body has some.
    pub skin: Option<Influences>,
    /// Joints of the garment's own.
    pub added: Vec<BespokeAddedJoint>,
}

/// What came out.
pub struct Outcome {
    /// OK, or what the last call returned.
    pub status: u32,
    /// Why it is not OK.
    pub message: String,
    /// The result, where there is one.
    pub fitted: Option<Fitted>,
    /// What was measured.
    pub report: Option<BespokeReport>,
    /// What the library has to say.
    pub findings: Vec<BespokeDiagnostic>,
}

/// Runs the session in a thread.
///
/// # Errors
/// The system gives no thread.
pub fn start(session: Arc<Session>, wanted: Wanted) -> Result<JoinHandle<Outcome>> {
    let begin = std::thread::Builder::new().name("bespoke".into());
    begin.spawn(move || outcome(&session, &wanted)).map_err(|reason| Failure {
        status: BESPOKE_STATUS_NO_THREAD,
        message: format!("no thread could be started: {reason}"),
    })
}

fn outcome(session: &Session, wanted: &Wanted) -> Outcome {
    let ran = session.run();
    // Verified, but not worn as designed. In another pose than the body's it is of no use here.
    let flaw = match &ran {
        Err(failure) if failure.status == BESPOKE_STATUS_IMPLAUSIBLE_RESULT => session.is_in_own_pose(wanted.joints),
        _ => false,
    };
    let (failure, fitted) = match (ran, flaw) {
        (Err(failure), false) => (failure, None),
        (ran, _) => match read(session, wanted) {
            Ok(fitted) => (ran.err().unwrap_or_default(), Some(fitted)),
            Err(failure) => (failure, None),
        },
    };
    Outcome {
        status: failure.status,
        message: failure.message,
        fitted,
        report: session.report().ok(),
        findings: session.diagnostics(),
    }
}

fn read(session: &Session, wanted: &Wanted) -> Result<Fitted> {
    let normals = |normals: &[[f32; 3]], tangents: &[[f32; 4]]| match normals.is_empty() {
        true => Ok((Vec::new(), Vec::new())),
        false => session.read_normals(normals, tangents),
    };
    let (turned, turned_tangents) = normals(&wanted.normals, &wanted.tangents)?;
    let shape = |(k, shape): (usize, &BlendShape)| {
        // Turned as the surface has turned, like the normals of the design.
        let (normals, tangents) = normals(&shape.normals, &shape.tangents)?;
        Ok(BlendShape { name: shape.name.clone(), offsets: session.read_morph(k, wanted.vertices)?, normals, tangents })
    };
    let has_skin = wanted.influences > 0;
    Ok(Fitted {
        positions: session.read_vertices(wanted.vertices)?,
        normals: turned,
        tangents: turned_tangents,
        shapes: wanted.shapes.iter().enumerate().map(shape).collect::<Result<_>>()?,
        skin: has_skin.then(|| session.read_influences(wanted.influences, wanted.vertices)).transpose()?,
        added: if has_skin { session.read_added_joints()? } else { Vec::new() },
    })
}
