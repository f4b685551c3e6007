//! The rigs of the closet's characters, each with the joints and habits of a tool.

use bespoke::rig::body_part::{BodyPart, Finger, Side};
use bespoke::rig::names::Named;
use closet::rigs::{Naming, Role};

use super::Report;
use super::lists::Joint;

fn side(side: closet::rigs::Side) -> Side {
    match side {
        closet::rigs::Side::Left => Side::Left,
        closet::rigs::Side::Right => Side::Right,
    }
}

fn named(naming: Naming, role: Role) -> Named {
    let fingers = [Finger::Thumb, Finger::Index, Finger::Middle, Finger::Ring, Finger::Little];
    Named::Part(match role {
        Role::Hips => BodyPart::Hips,
        Role::Spine(_) => BodyPart::Spine,
        Role::Neck => BodyPart::Neck,
        Role::Head => BodyPart::Head,
        Role::HeadEnd => BodyPart::HeadTop,
        Role::Clavicle(s) => BodyPart::Clavicle(side(s)),
        Role::UpperArm(s) => BodyPart::UpperArm(side(s)),
        Role::LowerArm(s) => BodyPart::LowerArm(side(s)),
        Role::Wrist(s) => BodyPart::Hand(side(s)),
        Role::Finger(s, finger, k) => BodyPart::Finger { side: side(s), finger: fingers[finger], segment: k as u8 + 1 },
        Role::Thigh(s) => BodyPart::UpperLeg(side(s)),
        Role::Calf(s) => BodyPart::LowerLeg(side(s)),
        Role::Foot(s) => BodyPart::Foot(side(s)),
        Role::Toe(s) => BodyPart::Toes(side(s)),
        // The end of a foot that hangs on the root.
        Role::ToeEnd(_) if naming == Naming::FeetOnRoot => return Named::Twist,
        Role::ToeEnd(s) => BodyPart::ToeTip(side(s)),
        Role::Hand(_) | Role::UpperArmTwist(_) | Role::LowerArmTwist(_) | Role::ThighTwist(_) => return Named::Twist,
        Role::Slot(_) => return Named::Prop,
        _ => return Named::Control,
    })
}

fn joints(naming: Naming) -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    let mut roles: Vec<Role> = Vec::new();
    for role in Role::all() {
        let Some(name) = naming.name(role) else { continue };
        let up = std::iter::successors(naming.hangs_on(role), |&above| naming.hangs_on(above));
        let parent = up.filter_map(|above| roles.iter().position(|&other| other == above)).next();
        joints.push(Joint { name, parent, named: named(naming, role) });
        roles.push(role);
    }
    joints
}

#[test]
fn characters_of_the_closet() {
    let mut report = Report::default();
    for naming in Naming::ALL {
        let joints = joints(naming);
        if naming == Naming::Unnamed {
            let found = super::reading(&joints);
            assert!(found.joints.iter().all(|named| *named == Named::Unknown), "{found:?}");
            continue;
        }
        let found = report.right(naming.word(), &joints);
        let others = joints.iter().zip(&found.joints).filter(|(joint, named)| joint.named != **named);
        report.lines.extend(others.map(|(joint, named)| format!("{}: {} is {named:?}", naming.word(), joint.name)));
    }
    report.end();
}
