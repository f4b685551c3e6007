//! Whether the inputs belong together, looked at before the work begins: unit and axes of each mesh against its skeleton,
//! which way the two bodies face, and their left and right sides.
//!
//! Nothing is known of a skeleton but joints and bones, so everything is a comparison: a mesh lies around its bones, and
//! one body in the other's pose looks like it.

pub mod alignment;
pub mod bones;
pub mod evidence;
pub mod front;
pub mod limb;
pub mod mirror;
pub mod scene;
pub mod size;
pub mod tilt;
mod wrong;

use alignment::Alignment;
use evidence::Threaded;
use front::Front;
use limb::TurnedLimb;
use mirror::MirrorPairs;
use scene::Scene;
use size::{Mend, Surroundings};
use tilt::Tilt;
use wrong::Wrong;

use super::coordinate_system::{AxisTurn, CoordinateSystem};
use super::diagnostic::{Bone, Diagnostic, Severity, Subject};
use super::skeleton::Skeleton;
use crate::error::{Error, ErrorKind, Result};

/// Turns of up to this many degrees need no word: between y up and z up nobody has made a mistake.
const USUAL: f64 = 90.0;

/// From so many degrees on a garment that is turned against its skeleton is refused, and a body: where nothing but its bones says
/// which part is which, and where skin weights do, or the garment is not made for it.
const GARMENT_TURNED: f64 = 25.0;
const BODY_TURNED: f64 = 30.0;
const BODY_TURNED_WITH_SKIN: f64 = 60.0;
/// The same for a limb of the source skeleton against its sleeve or leg; by less the garment may find its way to where it belongs,
/// which the result is asked about, and from so many degrees on there is a warning.
const LIMB_TURNED: f64 = 38.0;
const LIMB_TOLD: f64 = 25.0;

/// Compares the inputs, and adds what is found to `diagnostics`. Returns the turn of the target after which both bodies face the
/// same way, or are nearest to that. With `strict` the target is refused instead, where it is turned by more than a right angle. A
/// side whose coordinate system is trusted is not looked at.
///
/// # Errors
/// `NotEnclosed` where the garment is in another unit or in other axes than its skeleton, `InvalidSkeleton` where an avatar
/// is, where left and right are swapped, or, with `strict`, where the target faces another way.
pub fn check(scene: &Scene<'_>, strict: bool, diagnostics: &mut Vec<Diagnostic>) -> Result<AxisTurn> {
    let mut found = units(scene);
    if found.is_empty() && !scene.source_coordinate_system.trusted {
        found.extend(limbs(scene));
    }
    let turn =
        if scene.target_coordinate_system.trusted { AxisTurn::IDENTITY } else { sides(scene, strict, &mut found) };
    let first = found.iter().find(|d| d.severity() == Severity::Error).map(|d| {
        let kind = match d {
            Diagnostic::UnitMismatch { subject: Subject::Garment, .. }
            | Diagnostic::FacingMismatch { subject: Subject::Garment, .. }
            | Diagnostic::Turned { subject: Subject::Garment, .. }
            | Diagnostic::LimbTurned { .. } => ErrorKind::NotEnclosed,
            _ => ErrorKind::InvalidSkeleton,
        };
        Error::new(kind, d.to_string())
    });
    diagnostics.extend(found);
    first.map_or(Ok(turn), Err)
}

/// Each mesh against its own skeleton.
fn units(scene: &Scene<'_>) -> Vec<Diagnostic> {
    let (source, target) = (scene.source_skeleton, scene.target_skeleton);
    let source_body = scene.source_avatar.map(|mesh| Surroundings::of_body(mesh, source, None));
    let body = Surroundings::of_body(scene.avatar, target, scene.skin);
    let (of_source, of_body) = (source_body.as_ref().map(Surroundings::mend), body.mend());
    // How thick a body is around its bones: the garment's own where it is known.
    let thickness = match (&source_body, &of_source) {
        (Some(body), Some(mend)) => body.thickness(mend),
        _ => body.thickness(&of_body),
    };
    let around_garment = Surroundings::of_garment(scene.garment, source, thickness);
    let of_garment = around_garment.mend();
    let mut found = Vec::new();
    let mut add = |wrong: Wrong, subject, against, system: &CoordinateSystem, most_turned: f64| match wrong {
        Wrong::Read(mend) => found.extend(misread(mend, subject, against, system)),
        Wrong::Turned(tilt) => found.push(turned(tilt, subject, against, system, most_turned)),
    };
    let (from, to) = (&scene.source_coordinate_system, &scene.target_coordinate_system);
    // What is not gross by the distances may be so by the way of the bones.
    let or_proven = |mend: Mend, proven: &dyn Fn() -> Option<Wrong>| {
        let is_sure = mend.is_gross() == Some(true);
        if is_sure { Wrong::Read(mend) } else { proven().unwrap_or(Wrong::Read(mend)) }
    };
    match of_source {
        _ if from.trusted => {}
        // Both against the skeleton: it is the skeleton that is in another unit. A hat alone suits many.
        Some(mend) if mend.is_gross().is_some() && (mend.is_like(&of_garment) || around_garment.suits(&mend)) => {
            add(Wrong::Read(mend.inverse()), Subject::SourceSkeleton, Subject::Garment, from, GARMENT_TURNED);
        }
        _ => {
            let garment = or_proven(of_garment, &|| wrong::of_garment(scene.garment, &around_garment, source));
            let bodies = of_source.zip(source_body.as_ref()).zip(scene.source_avatar);
            let body = bodies.map(|((mend, around), mesh)| or_proven(mend, &|| wrong::of_body(mesh, around, source)));
            match (garment, body) {
                (Wrong::Turned(garment), Some(Wrong::Turned(body))) if garment.is_like(&body) => {
                    let skeleton = Wrong::Turned(garment.inverse());
                    add(skeleton, Subject::SourceSkeleton, Subject::Garment, from, GARMENT_TURNED);
                }
                (garment, body) => {
                    add(garment, Subject::Garment, Subject::SourceSkeleton, from, GARMENT_TURNED);
                    if let Some(body) = body {
                        add(body, Subject::SourceAvatar, Subject::SourceSkeleton, from, BODY_TURNED_WITH_SKIN);
                    }
                }
            }
        }
    }
    if !to.trusted {
        let proven = || {
            let bare = scene.skin.map(|_| Surroundings::of_body(scene.avatar, target, None));
            wrong::of_body(scene.avatar, bare.as_ref().unwrap_or(&body), target)
        };
        let most = if scene.skin.is_some() { BODY_TURNED_WITH_SKIN } else { BODY_TURNED };
        add(or_proven(of_body, &proven), Subject::TargetAvatar, Subject::TargetSkeleton, to, most);
    }
    found
}

/// A mesh in another unit or other axes; none where it is right.
fn misread(mend: Mend, subject: Subject, against: Subject, system: &CoordinateSystem) -> Option<Diagnostic> {
    let turn = system.turn_from_internal(mend.turn);
    let gross = mend.is_gross()?;
    Some(if mend.factor == 1.0 {
        Diagnostic::FacingMismatch { subject, against, turn, told: None, gross, sure: true }
    } else {
        let turn = (turn != AxisTurn::IDENTITY).then_some(turn);
        let or = mend.or.iter().map(|or| 1.0 / or).collect();
        Diagnostic::UnitMismatch { subject, against, factor: 1.0 / mend.factor, or, turn, gross }
    })
}

/// A mesh that is turned against its skeleton, refused from `most` degrees on.
fn turned(tilt: Tilt, subject: Subject, against: Subject, system: &CoordinateSystem, most: f64) -> Diagnostic {
    let (axis, degrees) = system.turn_about_from_internal(tilt.axis, tilt.degrees);
    Diagnostic::Turned { subject, against, axis, degrees, gross: degrees >= most }
}

/// The limbs of the source skeleton against the garment.
fn limbs(scene: &Scene<'_>) -> Vec<Diagnostic> {
    let (skeleton, system) = (scene.source_skeleton, &scene.source_coordinate_system);
    let said = |limb: TurnedLimb| Diagnostic::LimbTurned {
        bone: Bone { index: limb.bone, joints: skeleton.bones[limb.bone as usize] },
        joint: limb.joint,
        opening: system.position_from_internal(limb.opening).to_array(),
        degrees: limb.degrees,
        gross: limb.degrees >= LIMB_TURNED,
    };
    limb::turned(&Threaded::new(scene.garment), skeleton, LIMB_TOLD).into_iter().map(said).collect()
}

/// The target against the source: the turn between them, and whether left is left.
fn sides(scene: &Scene<'_>, strict: bool, found: &mut Vec<Diagnostic>) -> AxisTurn {
    let (source, target) = (scene.source_skeleton, scene.target_skeleton);
    let turn = Alignment::between(source, target).turn_if_clear();
    let Some(pairs) = MirrorPairs::of(source) else {
        return facing(scene, turn, 1.0, strict, found);
    };
    // Some of the limbs alone.
    let limbs = pairs.limbs_swapped(source, target, turn);
    if !limbs.is_empty() {
        let joints = pairs.example(&limbs);
        found.push(Diagnostic::SidesSwapped { joints, mirrored: None, all: false, sure: true });
        return AxisTurn::IDENTITY;
    }
    // All of them: the joints alone cannot tell that from a half turn, but front and back of the bodies can.
    let front = Front::compare(scene, &pairs, turn);
    let turns_front = turn != AxisTurn::IDENTITY;
    if front < if turns_front { -front::LIKELY } else { -front::SURE } {
        let joints = pairs.example(&pairs.all_limbs());
        let mirrored = front::is_turned_inside_out(scene).then(|| mirror_to_tell(scene)).flatten();
        let sure = turns_front && front < -front::SURE;
        found.push(Diagnostic::SidesSwapped { joints, mirrored, all: true, sure });
        return if turn.degrees() > USUAL { turn } else { AxisTurn::IDENTITY };
    }
    facing(scene, turn, front, strict, found)
}

/// Says that the target is turned, where that is unusual, and how it would be told. It is turned back in any case: a half turn would
/// take all of a growing body through one plane, and a hat would stay as it is while the head in it turns.
fn facing(scene: &Scene<'_>, turn: AxisTurn, front: f64, strict: bool, found: &mut Vec<Diagnostic>) -> AxisTurn {
    if turn.degrees() <= USUAL {
        return turn;
    }
    let system = scene.target_coordinate_system;
    found.push(Diagnostic::FacingMismatch {
        subject: Subject::TargetAvatar,
        against: Subject::Garment,
        turn: system.turn_from_internal(turn),
        told: Some(system.turned(turn)),
        gross: strict,
        sure: front > front::LIKELY,
    });
    turn
}

/// The coordinate system that undoes the mirror: of the three, that after which the bodies need the least turn.
fn mirror_to_tell(scene: &Scene<'_>) -> Option<CoordinateSystem> {
    let mirrored = AxisTurn::mirrors().map(|mirror| {
        let joints = scene.target_skeleton.joints.iter().map(|&p| mirror.apply(p)).collect();
        let target = Skeleton { joints, bones: scene.target_skeleton.bones.clone() };
        let turn = Alignment::between(scene.source_skeleton, &target).turn_if_clear();
        (turn.degrees(), turn.after(mirror))
    });
    let least = mirrored.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    least.map(|(_, turn)| scene.target_coordinate_system.turned(turn))
}
