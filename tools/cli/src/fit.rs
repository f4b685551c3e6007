//! One garment through one session of the library.

use std::time::Instant;

use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, Severity, Subject};
use bespoke::input::rig::Rig;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::report::Report;
use bespoke::rig::joint_map::CallersPair;
use bespoke::rig::weights::own_joints::AddedJoint;
use bespoke::session::{Morph, PartRole, Precision, RenderMesh, Session, SharedAvatar, SharedGarment};
use glam::{DVec3, DVec4};

use crate::failure::{Failure, Result};
use crate::progress::{is_stopped, watched};

/// A mesh that a rig moves.
#[derive(Clone, Debug)]
pub struct Skinned {
    /// Vertices in the bind pose, and triangles.
    pub mesh: TriangleMesh,
    /// Joints of each vertex.
    pub skin: SkinWeights,
}

impl Skinned {
    /// Whether any vertex has a weight.
    pub fn has_weights(&self) -> bool {
        (0..self.skin.vertex_count()).any(|v| !self.skin.weights(v).is_empty())
    }
}

/// What a garment is dressed with.
#[derive(Clone)]
pub struct Job<'a> {
    /// As the user knows it.
    pub name: &'a str,
    /// The garment on its own body.
    pub garment: &'a Skinned,
    /// Its normals and tangents, one for each vertex, where its file has some.
    pub drawn: &'a RenderMesh,
    /// Its morph targets.
    pub morphs: &'a [Morph],
    /// Whether its weights mean anything.
    pub has_skin: bool,
    /// The body that it was made for, if there is one.
    pub source: Option<&'a Skinned>,
    /// The joints of garment and source body.
    pub source_rig: &'a Rig,
    /// The body to dress.
    pub avatar: &'a Skinned,
    /// What each of its triangles is to the garment.
    pub roles: &'a [PartRole],
    /// Its joints.
    pub target_rig: &'a Rig,
    /// The garment with all that belongs to it, for all sessions: [`shared_garment`].
    pub shared_garment: &'a SharedGarment,
    /// Body and joints together, likewise: [`shared_avatar`].
    pub shared_avatar: &'a SharedAvatar,
    /// Which of them it is tried without as well, where they leave it no room; empty where that is none.
    pub dispensable: &'a [bool],
    /// Garments that it wears already, inside this one.
    pub layers: &'a [TriangleMesh],
    /// Joints that the user says correspond.
    pub pairs: &'a [CallersPair],
    /// Source and target skeleton, where the two correspond joint by joint; they take the place of the rigs.
    pub skeletons: Option<[&'a Skeleton; 2]>,
    /// The coordinate system of the avatar.
    pub space: CoordinateSystem,
    /// Joints for each vertex of the result.
    pub influences: usize,
    /// How it fits.
    pub options: &'a Options,
    /// No progress on the terminal.
    pub quiet: bool,
}

/// Something that the library has to say.
#[derive(Clone, Debug)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// What kind of thing it is; none of an error.
    pub kind: Option<DiagnosticKind>,
    /// In words.
    pub sentence: String,
}

/// A garment that is dressed and verified.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Its vertices on the avatar in the avatar's bind pose.
    pub positions: Vec<DVec3>,
    /// Its normals there.
    pub normals: Vec<DVec3>,
    /// Its tangents, with the handedness of the bitangent, where it had some.
    pub tangents: Vec<DVec4>,
    /// What each of its morph targets adds to its vertices there.
    pub morphs: Vec<Vec<DVec3>>,
    /// Its skin weights on the avatar's joints and, after them, the added ones.
    pub skin: SkinWeights,
    /// Joints of its own that come along.
    pub added: Vec<AddedJoint>,
    /// Triangles of caps that close openings, through which the body goes; ascending.
    pub caps: Vec<u32>,
    /// What is not as designed, if anything.
    pub flaw: Option<String>,
    /// It is not where it is worn.
    pub is_astray: bool,
    /// What the library has to say.
    pub findings: Vec<Finding>,
    /// What was measured.
    pub report: Report,
    /// Seconds from the first step of the library to the verified result.
    pub seconds: f64,
}

/// A garment that is not dressed.
#[derive(Clone, Debug)]
pub struct Refused {
    /// Why.
    pub failure: Failure,
    /// What else the library has to say.
    pub findings: Vec<Finding>,
    /// Where parts of the avatar that touch each other hold it most, and not what that wears already: a triangle of each.
    pub held_by: Option<[u32; 2]>,
}

impl Job<'_> {
    /// Dresses the garment.
    ///
    /// # Errors
    /// Where there is no verified result.
    pub fn run(&self) -> Result<Fitted, Box<Refused>> {
        let mut session = Session::new();
        let begin = Instant::now();
        let outcome = self.fill(&mut session).and_then(|()| {
            let control = session.control();
            watched(self.name, &control, self.quiet, || session.run().map(|_| ()))
        });
        let seconds = begin.elapsed().as_secs_f64();
        let findings = findings(&session);
        let flaw = match outcome {
            Ok(()) => None,
            Err(error) if error.kind == ErrorKind::ImplausibleResult && session.pose_transforms().is_none() => {
                Some(error.message)
            }
            Err(error) => return Err(self.refused(error, findings, held_by(&session))),
        };
        // Without weights of the avatar there are none to take over.
        let moves = self.avatar.has_weights();
        let read = || -> bespoke::error::Result<Fitted> {
            let (normals, tangents) = session.garment_normals(self.drawn)?;
            Ok(Fitted {
                positions: session.garment_positions()?,
                normals,
                tangents,
                morphs: (0..self.morphs.len())
                    .map(|k| session.garment_morph(k))
                    .collect::<bespoke::error::Result<_>>()?,
                skin: if moves { session.garment_skin(self.influences)? } else { unmoved(self.garment) },
                added: if moves { session.added_joints()? } else { Vec::new() },
                caps: caps(&session),
                is_astray: flaw.is_some(),
                flaw: flaw.clone(),
                findings: findings.clone(),
                report: session.report(),
                seconds,
            })
        };
        match read() {
            Ok(fitted) => Ok(fitted),
            Err(error) => Err(self.refused(error, findings, None)),
        }
    }

    /// What the library says of the garment before it is dressed, refusals included.
    pub fn look(&self) -> Vec<Finding> {
        let mut session = Session::new();
        let outcome = self.fill(&mut session).and_then(|()| session.prepare());
        let mut findings = findings(&session);
        if let Err(error) = outcome {
            findings.push(Finding { severity: Severity::Error, kind: None, sentence: error.message });
        }
        findings
    }

    /// The triangles of the garment's caps, as they are found before it is dressed.
    pub fn caps(&self) -> Vec<u32> {
        let mut session = Session::new();
        // A garment that is refused may have caps all the same.
        let _ = self.fill(&mut session).and_then(|()| session.prepare());
        caps(&session)
    }

    fn refused(&self, error: bespoke::error::Error, findings: Vec<Finding>, held_by: Option<[u32; 2]>) -> Box<Refused> {
        let failure = if error.kind == ErrorKind::Cancelled || is_stopped() {
            Failure::interrupted()
        } else {
            Failure::no_result(format!("{}: {error}", self.name))
        };
        Box::new(Refused { failure, findings, held_by })
    }

    fn fill(&self, session: &mut Session) -> bespoke::error::Result<()> {
        session.set_options(self.options.clone())?;
        session.use_garment(self.shared_garment)?;
        session.use_avatar(self.shared_avatar)?;
        session.set_target_coordinate_system(self.space)?;
        if let Some([source, target]) = self.skeletons {
            session.set_source_skeleton(source.clone())?;
            session.set_target_skeleton(target.clone())?;
        }
        session.set_avatar_parts(self.roles.to_vec())?;
        session.set_dispensable(self.dispensable.to_vec())?;
        for layer in self.layers {
            session.add_layer(layer.clone())?;
        }
        session.set_joint_pairs(self.pairs.to_vec())
    }
}

/// Where what holds the garment most are parts that touch each other at full size, and none of a layer: a triangle of each.
fn held_by(session: &Session) -> Option<[u32; 2]> {
    let first = session.diagnostics().iter().find(|found| found.kind() == DiagnosticKind::InflationBlocked)?;
    match first {
        Diagnostic::InflationSqueezed { gap: None, parts, .. }
            if parts.iter().all(|part| part.triangle.subject == Subject::TargetAvatar) =>
        {
            Some(parts.each_ref().map(|part| part.triangle.index))
        }
        _ => None,
    }
}

/// No weights for each vertex of `cloth`.
fn unmoved(cloth: &Skinned) -> SkinWeights {
    SkinWeights::from_rows(cloth.skin.joint_count(), cloth.mesh.positions.iter().map(|_| Vec::new()))
}

fn caps(session: &Session) -> Vec<u32> {
    let of = |diagnostic: &Diagnostic| match diagnostic {
        Diagnostic::OpeningCap { triangles, .. } => triangles.clone(),
        _ => Vec::new(),
    };
    let mut caps: Vec<u32> = session.diagnostics().iter().flat_map(of).collect();
    caps.sort_unstable();
    caps.dedup();
    caps
}

/// A garment that sessions share, with its morphs, the body that it was made for where there is one, and the joints and the coordinate
/// system of both. Its weights are left out where they mean nothing.
///
/// # Errors
/// Where the library refuses one of them.
pub fn shared_garment(
    garment: &Skinned,
    has_skin: bool,
    morphs: &[Morph],
    source: Option<&Skinned>,
    rig: &Rig,
    space: CoordinateSystem,
) -> bespoke::error::Result<SharedGarment> {
    let mut session = Session::new();
    session.set_garment(garment.mesh.clone(), Precision::F32)?;
    if has_skin {
        session.set_garment_skin(garment.skin.clone())?;
    }
    for morph in morphs {
        session.add_garment_morph(morph.clone())?;
    }
    session.set_source_coordinate_system(space)?;
    session.set_source_rig(rig.clone())?;
    if let Some(source) = source {
        session.set_source_avatar(source.mesh.clone())?;
        if source.has_weights() {
            session.set_source_skin(source.skin.clone())?;
        }
    }
    session.share_garment()
}

/// A body that sessions share, with the joints that move it and the roles of its triangles.
///
/// # Errors
/// Where the library refuses one of them.
pub fn shared_avatar(rig: &Rig, body: &Skinned, roles: &[PartRole]) -> bespoke::error::Result<SharedAvatar> {
    let mut session = Session::new();
    session.set_target_rig(rig.clone())?;
    session.set_target_avatar(body.mesh.clone())?;
    if body.has_weights() {
        session.set_target_skin(body.skin.clone())?;
    }
    session.set_avatar_parts(roles.to_vec())?;
    session.share_avatar()
}

fn findings(session: &Session) -> Vec<Finding> {
    let said = session.diagnostics().iter();
    said.map(|d| Finding { severity: d.severity(), kind: Some(d.kind()), sentence: session.sentence(d) }).collect()
}
