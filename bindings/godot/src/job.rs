//! The work of a session, in a thread of its own, and what comes out of it.

use std::sync::Arc;
use std::thread::JoinHandle;

use crate::figure::Figure;
use crate::mesh::BlendShape;
use crate::native::*;
use crate::session::{Failure, Influences, Result, Session};
use crate::turned::Turns;

/// A mesh as it was designed.
pub struct Design {
    /// Its vertices.
    pub positions: Vec<[f32; 3]>,
    /// Its triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Its normals, if it has any.
    pub normals: Vec<[f32; 3]>,
    /// Its tangents, if it has any.
    pub tangents: Vec<[f32; 4]>,
    /// Its blend shapes.
    pub shapes: Vec<BlendShape>,
}

impl Design {
    /// The one mesh of a figure.
    pub fn new(figure: &Figure) -> Self {
        Self {
            positions: figure.positions.clone(),
            triangles: figure.triangles.clone(),
            normals: figure.normals.clone(),
            tangents: figure.tangents.clone(),
            shapes: figure.shapes.clone(),
        }
    }
}

/// What the thread needs to read a result.
pub struct Wanted {
    /// The garment.
    pub garment: Design,
    /// What goes along with it.
    pub followers: Vec<Design>,
    /// Blend shapes of the body that the garment is to answer.
    pub answers: Vec<String>,
    /// Joints for each vertex of the result; 0 where the body has no skin.
    pub influences: usize,
    /// Joints of the body to dress.
    pub joints: usize,
}

/// A mesh on the body.
pub struct Fitted {
    /// Its vertices; those of the garment are verified.
    pub positions: Vec<[f32; 3]>,
    /// Normals, where it had some.
    pub normals: Vec<[f32; 3]>,
    /// Tangents, where it had some.
    pub tangents: Vec<[f32; 4]>,
    /// Blend shapes: offsets, and normals and tangents at weight 1.
    pub shapes: Vec<BlendShape>,
    /// Skin weights, where the body has some.
    pub skin: Option<Influences>,
}

/// A verified result.
pub struct Worn {
    /// The garment.
    pub garment: Fitted,
    /// What goes along with it.
    pub followers: Vec<Fitted>,
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
    pub worn: Option<Worn>,
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
    let is_worn = ran.is_ok();
    let (failure, worn) = match (ran, flaw) {
        (Err(failure), false) => (failure, None),
        (ran, _) => match read(session, wanted, is_worn) {
            Ok(worn) => (ran.err().unwrap_or_default(), Some(worn)),
            Err(failure) => (failure, None),
        },
    };
    Outcome {
        status: failure.status,
        message: failure.message,
        worn,
        report: session.report().ok(),
        findings: session.diagnostics(),
    }
}

/// `is_worn`: as designed, so that blend shapes of the body can be answered.
fn read(session: &Session, wanted: &Wanted, is_worn: bool) -> Result<Worn> {
    let design = &wanted.garment;
    let vertices = design.positions.len();
    let normals = |normals: &[[f32; 3]], tangents: &[[f32; 4]]| match normals.is_empty() {
        true => Ok((Vec::new(), Vec::new())),
        false => session.read_normals(normals, tangents),
    };
    let (turned, turned_tangents) = normals(&design.normals, &design.tangents)?;
    let shape = |(k, shape): (usize, &BlendShape)| {
        // Turned as the surface has turned, like the normals of the design.
        let (normals, tangents) = normals(&shape.normals, &shape.tangents)?;
        Ok(BlendShape { name: shape.name.clone(), offsets: session.read_morph(k, vertices)?, normals, tangents })
    };
    let has_skin = wanted.influences > 0;
    let mut garment = Fitted {
        positions: session.read_vertices(vertices)?,
        normals: turned,
        tangents: turned_tangents,
        shapes: design.shapes.iter().enumerate().map(shape).collect::<Result<_>>()?,
        skin: has_skin.then(|| session.read_influences(wanted.influences, vertices)).transpose()?,
    };
    let follower = |(k, design): (usize, &Design)| {
        let vertices = design.positions.len();
        let positions = session.read_follower(k, vertices)?;
        let turns = Turns::new(&design.triangles, &design.positions, &positions);
        Ok(Fitted {
            normals: turns.normals(&design.normals),
            tangents: turns.tangents(&design.tangents),
            shapes: design.shapes.iter().map(|shape| turns.shape(shape)).collect(),
            skin: has_skin.then(|| session.read_follower_influences(k, wanted.influences, vertices)).transpose()?,
            positions,
        })
    };
    let followers = wanted.followers.iter().enumerate().map(follower).collect::<Result<_>>()?;
    let added = if has_skin { session.read_added_joints()? } else { Vec::new() };
    if is_worn && !wanted.answers.is_empty() {
        answer(session, wanted, &mut garment)?;
    }
    Ok(Worn { garment, followers, added })
}

/// Adds what the garment answers to blend shapes of the body with, under their names.
fn answer(session: &Session, wanted: &Wanted, garment: &mut Fitted) -> Result<()> {
    session.begin_answers();
    session.solve_target_morphs()?;
    for (k, name) in wanted.answers.iter().enumerate() {
        // Without an answer, it is told by a finding.
        let Some(offsets) = session.read_target_morph(k, garment.positions.len()) else { continue };
        let moved = garment.positions.iter().zip(&offsets);
        let moved: Vec<[f32; 3]> = moved.map(|(p, d)| std::array::from_fn(|axis| p[axis] + d[axis])).collect();
        let turns = Turns::new(&wanted.garment.triangles, &garment.positions, &moved);
        garment.shapes.push(BlendShape {
            name: name.clone(),
            offsets,
            normals: turns.normals(&garment.normals),
            tangents: turns.tangents(&garment.tangents),
        });
    }
    Ok(())
}
