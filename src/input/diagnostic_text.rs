//! Messages of diagnostics, all in this file, so that they can be translated; names and numbers in them are made in
//! [`super::diagnostic_words`].

use std::fmt::{Display, Formatter, Result};

use super::diagnostic::{Bone, Diagnostic, Foreignness, JointFault, LimbPlace};
use super::diagnostic_words::{
    NO_OPENING, at_bone, avatar_triangle, axes, bone_name, input, listed, part, part_name, point, quoted, ranges,
    short, turned, units,
};
use super::element::Subject;

/// Axes that are exchanged are turned by 90 degrees, or by 120; what stands the other way round by 180.
const HALF_WAY: f64 = 150.0;

impl Display for Diagnostic {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::SplitVertices { sharing, vertices, shared_places, places, .. } => write!(
                f,
                "garment: {sharing} of the {vertices} vertices share their place with another, in {shared_places} places, as \
                 along UV and normal seams; copies move as one, so there are {places} vertices to place. The result is in the \
                 caller's order"
            ),
            Self::DuplicateTriangle { triangle, of } => {
                write!(f, "garment: triangle {triangle} has the corners of triangle {of}; the two count as one")
            }
            Self::CollapsedTriangle { triangle, corners: [a, b, c], kept } => {
                let treated =
                    if *kept { "it counts as a wire, which collides and nothing more" } else { "it is left out" };
                write!(
                    f,
                    "garment: triangle {triangle} (vertices {a}, {b}, {c}) has corners in one place; {treated}"
                )
            }
            Self::FlatTriangle { triangle, corners: [a, b, c] } => write!(
                f,
                "garment: triangle {triangle} (vertices {a}, {b}, {c}) has its corners on a line; it has no area"
            ),
            Self::NonManifoldEdge { vertices: [a, b], triangles } => write!(
                f,
                "garment: the edge between vertices {a} and {b} has {triangles} triangles; each of them bends with every other, \
                 and boundary curves that end there do not hold their shape"
            ),
            Self::UnusedVertex { vertex } => write!(
                f,
                "garment: vertex {vertex} belongs to no triangle with a side; nothing holds it in its place"
            ),
            Self::LoosePiece { vertices, triangle, host, .. } => write!(
                f,
                "garment: the loose piece of {vertices} vertices with triangle {triangle} is held to the piece beside it, near \
                 triangle {host}"
            ),
            Self::KeptTogether { vertices, vertex, triangle, .. } => write!(
                f,
                "garment: {vertices} vertices on its borders lie on or beside another part of it and keep their place there, such \
                 as vertex {vertex} at triangle {triangle}"
            ),
            Self::RimsNotFound { triangles, triangle, bone } => {
                let [a, b] = bone.joints;
                write!(
                    f,
                    "garment: the piece of {triangles} triangles with triangle {triangle} is closed, around the bone between joints \
                     {a} and {b}, and no cuff, hem or collar of it was found; nothing keeps its openings in their places along \
                     the bones; name them with add_curve, or model it \
                     without its inner side"
                )
            }
            Self::WeldedNear { places, first, gap } => {
                let first: Vec<String> = first.iter().map(u32::to_string).collect();
                write!(
                    f,
                    "garment: open seams with gaps of up to {gap:.1e} are closed in {places} places (the first: vertices {}); \
                     weld_distance says how near is one place",
                    first.join(", ")
                )
            }
            Self::TJunctions { count, first, triangle } => {
                let first = first.first().map_or(String::new(), |v| format!(", such as vertex {v} on triangle {triangle}"));
                write!(
                    f,
                    "garment: {count} vertices lie on the edge of a triangle that does not have them (T-junctions){first}; the \
                     two sides keep together, but may part by a hair; split these edges where the vertices are"
                )
            }
            Self::CarriedPiece { vertices, triangle, bone, distance, from_body, stiff, closed } => {
                let [a, b] = bone.joints;
                let from = if *from_body { "the source avatar" } else { "that bone" };
                let around = if *closed { "is closed around a bone, without cuff, hem or collar" } else { "is around no bone" };
                let keeps = match (stiff, closed) {
                    (true, _) => "keeps its shape",
                    (false, true) => "what is inside of it gives way",
                    (false, false) => "gives way",
                };
                write!(
                    f,
                    "garment: the piece of {vertices} vertices with triangle {triangle} {around}; it is carried by \
                     the body at the bone between joints {a} and {b}, {distance:.1e} from {from} (the skeleton is 2 long), \
                     and {keeps}"
                )
            }
            Self::SelfIntersection { triangles: [s, t], touches, strict } => {
                let how = if *touches { "touch within rounding" } else { "intersect" };
                let fate = match strict {
                    true => "which the option strict refuses",
                    false => "so they are exempted from contact until they separate, and may still do so in the result",
                };
                write!(f, "garment: triangles {s} and {t} {how} before anything has moved, {fate}")
            }
            Self::NearContact { to_itself, to_avatar, min_separation, .. } => {
                let near = [(to_itself, "itself"), (to_avatar, "the shrunk avatar")];
                let near = near.iter().filter(|(distance, _)| distance.is_finite());
                let near: Vec<String> = near.map(|(distance, what)| format!("{distance:.1e} of {what}")).collect();
                write!(
                    f,
                    "garment: at the start it is within {}, so that the minimum separation begins at {min_separation:.1e} and \
                     rises as they part",
                    near.join(" and ")
                )
            }
            Self::BoneMoved { bone, aside, between, beyond, shares, .. } => {
                let [a, b] = bone.joints;
                write!(
                    f,
                    "source skeleton: at the bone between joints {a} and {b}, the shrunk avatar would penetrate the garment; \
                     {} (the skeleton is 2 long); check the result there, or move skeleton and garment onto each other",
                    moves(*aside, [*between, *beyond], *shares)
                )?;
                match shares {
                    [between, _] if *between > MUCH => write!(f, "; {NO_OPENING}"),
                    [_, beyond] if *beyond > MUCH => f.write_str(
                        "; what should leave the garment there, as a hand does, may be shut up in it: lay the bone through the \
                         opening",
                    ),
                    _ => Ok(()),
                }
            }
            Self::CycleCut { .. } => f.write_str(
                "source skeleton: between bones that form a cycle, the shrunk avatar would penetrate the garment; the cycle \
                 was cut open; check the result there",
            ),
            Self::AvatarPenetrates { garment, bone, avatar } => write!(
                f,
                "garment: {}, shrunk onto the source skeleton, penetrates triangle {garment} {}, and no way around it was \
                 found",
                avatar_triangle(*avatar),
                at_bone(bone.map(|bone| bone.joints))
            ),
            Self::CoarseCoordinates { min_separation } => write!(
                f,
                "target avatar: so far from the origin, the coordinates in which the garment is read are coarse, and it keeps a \
                 distance of {min_separation:.1e} at least, in units in which the skeleton is 2 long; a place nearer to the \
                 origin or 64 bits allow a closer fit"
            ),
            Self::ResultSelfIntersection { triangles: [s, t] } => {
                write!(f, "result: garment triangles {s} and {t} intersect, which they did not at the start")
            }
            Self::ResultIntersection { garment, avatar } => {
                write!(f, "result: garment triangle {garment} and {} intersect", avatar_triangle(*avatar))
            }
            Self::PinNotReached { vertex, distance } => write!(
                f,
                "garment: pinned vertex {vertex} ends {distance:.1e} from its place, in units in which the skeleton is 2 long: \
                 the body is in its way, or the garment holds it back; a higher pin_weight helps against the garment"
            ),
            Self::RigidGroupBent { group, vertex, distance } => write!(
                f,
                "garment: rigid group {group} ends bent, by {distance:.1e} at vertex {vertex} in units in which the skeleton is \
                 2 long, for the body or another part of the garment is in its way"
            ),
            Self::InflationHeld { garment, part, held, .. } => write!(
                f,
                "target avatar: the garment holds back {}, which pushes it from one side (garment triangle \
                 {garment}, {}; {held} garment triangles in all): it is caught on that part, or too tight or too stiff there; \
                 leave that part out of the body, or cut or widen the garment there",
                part_name(*part),
                avatar_triangle(part.triangle),
            ),
            Self::InflationSqueezed { garment, parts, same, gap, inflation_dhat } => {
                let [a, b] = parts.map(|part| avatar_triangle(part.triangle));
                let [one, other] = *parts;
                let who = match same {
                    true => format!("two sides of {}", part_name(one)),
                    false if parts.iter().all(|part| part.loose.is_none()) => {
                        format!("the parts around {} and {}", bone_name(one.bone), bone_name(other.bone))
                    }
                    false => format!("{} and {}", part_name(one), part_name(other)),
                };
                match gap {
                    None => write!(
                        f,
                        "target avatar: {who} touch each other at full size (near {a} and {b}), and the garment is between \
                         them (garment triangle {garment}): no garment can pass there; move the limbs apart, or leave one part \
                         out of the body"
                    ),
                    Some(gap) => {
                        let narrow = if *gap < 2.0 * inflation_dhat { ", less than two inflation_dhat" } else { "" };
                        write!(
                            f,
                            "target avatar: {who} hold the garment between them (garment triangle {garment}, {a} and {b}); at \
                             full size these are {gap:.1e} apart{narrow}, in units in which the skeleton is 2 long; move the \
                             limbs apart, leave one part out of the body, or cut the garment between them"
                        )
                    }
                }
            }
            Self::EndWithoutBone { bone, reach, mended } => {
                let [from, joint] = bone.joints;
                let fate = match mended {
                    true => "it starts there as if one did",
                    false => "it starts at that joint all the same, inside the garment",
                };
                write!(
                    f,
                    "target skeleton: the body goes on {reach:.2} beyond joint {joint}, straight on from joint {from}, where no \
                     bone goes on (the skeleton is 2 long); {fate}; give both skeletons a joint at the end of that part, such as \
                     the top of the head, and look whether joint {joint} lies where that part begins"
                )
            }
            Self::JointMisplaced { skeleton, bone, fault, length, share, place, mended, .. } => {
                let [from, joint] = bone.joints;
                let size = format!("{} ({share:.2} of the bone from joint {from})", short(*length));
                let name = input(*skeleton);
                match fault {
                    JointFault::Outside => write!(f, "{name}: joint {joint} lies outside of the body, by {size}")?,
                    JointFault::Stray => write!(
                        f,
                        "{name}: the bone between joints {from} and {joint} runs outside of the body, between its parts, over \
                         {size}"
                    )?,
                    JointFault::Low => write!(
                        f,
                        "{name}: joint {joint} lies too low, by {size}: limbs branch off there and leave the body above it, so \
                         that the head beyond it begins below the collar"
                    )?,
                    JointFault::AtTip => write!(
                        f,
                        "{name}: joint {joint} lies at the tip of its limb, beyond where the other skeleton has it, by {size}, so \
                         that a cuff or a hem would end there"
                    )?,
                    JointFault::BoneOutside => write!(
                        f,
                        "{name}: the bone between joints {from} and {joint} leaves the body, by {size}, although both are inside"
                    )?,
                }
                match place {
                    Some(place) => {
                        let fate = if *mended { "where it is taken to lie" } else { "but is taken as it is" };
                        write!(f, "; joint {joint} belongs at {}, {fate}; move it there", point(*place))?;
                    }
                    None => write!(f, "; move its joints into the middle of the limb, or add one between them")?,
                }
                match fault {
                    JointFault::Stray => f.write_str(", or leave it out of both skeletons"),
                    _ => Ok(()),
                }
            }
            Self::FollowerIntersects { follower, body, garment, .. } => {
                let said = |count: usize, of: &str| {
                    let noun = if count == 1 { "triangle" } else { "triangles" };
                    (count > 0).then(|| format!("{count} {noun} {of}"))
                };
                let said: Vec<String> =
                    [said(*body, "into the avatar"), said(*garment, "through the garment")].into_iter().flatten().collect();
                write!(
                    f,
                    "follower {follower}: it passes with {} where the result takes it, and did not in the design; make it part of \
                     the garment, or move it away from the body",
                    said.join(" and with ")
                )
            }
            Self::MorphNotSolved { morph, name, weight } if *weight < 1.0 => {
                write!(
                    f,
                    "target morph {morph}{}: the garment lets the body change only up to weight {weight:.2}; there is no answer to \
                     it; make the morph smaller, or the garment looser",
                    quoted(name)
                )
            }
            Self::MorphNotSolved { morph, name, .. } => {
                write!(
                    f,
                    "target morph {morph}{}: the garment intersects at weight 1 in the precision in which it is read; there is no \
                     answer to it; set the garment in 64 bits",
                    quoted(name)
                )
            }
            Self::MorphIntersects { morph, name, pairs, .. } => {
                write!(
                    f,
                    "target morph {morph}{}: the garment's answer is good at weight 1, but halfway {pairs} pairs of triangles \
                     intersect; divide the morph into smaller ones",
                    quoted(name)
                )
            }
            Self::PoseBlocked { share, joints } => {
                write!(
                    f,
                    "target avatar: it stands in another pose than the garment was designed in, and the garment lets it go only \
                     {:.0} % of the way from that pose to its own",
                    100.0 * share
                )?;
                match joints[..] {
                    [a, b] => write!(f, ": what belongs to joint {a} and to joint {b} is in the way of each other")?,
                    [a] => write!(f, ": what belongs to joint {a} is in the way")?,
                    _ => {}
                }
                write!(f, "; the result is in the pose of the design; give the avatar in a pose nearer to it")
            }
            Self::SolvedPosed { stalled_at, degrees } => write!(
                f,
                "target avatar: in its own pose, which differs from that of the design by {degrees:.0} degrees, it cannot grow \
                 beyond {stalled_at:.4} of its size inside the garment; it was posed as in the design, dressed there, and \
                 brought back to its own pose"
            ),
            Self::SourceDressed { pairs, triangles: [t, body], has_begun } => write!(
                f,
                "source avatar: it passes through the garment in {pairs} pairs of triangles, such as garment triangle {t} and \
                 avatar triangle {body}, and with it {}; that body with the garment on took its place, so that the garment keeps \
                 no distance from the target; take away what passes through it to keep its looseness",
                if *has_begun { "the inflation stalled" } else { "the garment was refused" }
            ),
            Self::JointsUnsure { places } => write!(
                f,
                "which joints of the two rigs are {} is a guess: the names do not say it; look at the joint map, and say \
                 which joints correspond, as pairs",
                listed(places)
            ),
            Self::BonesUnclear { edges, vertices: [v, w], joints } => {
                let [here, there] = (*joints).map(part);
                write!(
                    f,
                    "target avatar: parts of the body that are far apart on the skeleton are one surface, at {edges} edges such \
                     as that of vertices {v} and {w}, which begin at {here} and at {there}; without skin weights the nearest bone \
                     inside the body decides, and the garment may be caught there; set skin weights of the avatar, or part its \
                     mesh there"
                )
            }
            Self::WeightsContradict { count, weighted, first, example, mended } => {
                let fate = match mended {
                    true => "the nearest bone decides for these",
                    false => "the option strict takes the weights as they are",
                };
                let such = match (first.first(), example) {
                    (Some(v), Some((joint, [a, b]))) => format!(
                        ", such as vertex {v}: they bind it to joint {joint}, and the bone between joints {a} and {b} is nearest"
                    ),
                    _ => String::new(),
                };
                write!(
                    f,
                    "target skin weights: they contradict the positions of {count} of {weighted} vertices{such}; {fate}; check \
                     that the rows are in the order of the skeleton's joints, and the export of the weights"
                )
            }
            Self::ForeignPart { whose, count, triangles: [first, last], reason, size, left_out } => {
                let why = match reason {
                    Foreignness::Surrounds => "it surrounds the body and its skeleton",
                    Foreignness::Ground => "it is flat, and the body stands on it",
                    Foreignness::Huge => "it is far larger than the skeleton and around none of its bones",
                    Foreignness::Detached => "it is away from all bones and from the body",
                };
                let (consequence, remedy) = match whose {
                    Subject::SourceAvatar => (": no clearance is measured to it", "take it out of the avatar"),
                    _ => (
                        ": the result may pass through it",
                        "give it a role with set_avatar_parts, or take it out of the avatar",
                    ),
                };
                let fate = match left_out {
                    true => format!("it is left out{consequence}"),
                    false => "the option strict keeps it".into(),
                };
                write!(
                    f,
                    "{}: the piece of {count} triangles, from {first} to {last}, seems to be no part of the body: {why} (its \
                     longest side is {size:.2}, the skeleton's is 2); {fate}; {remedy}",
                    input(*whose)
                )
            }
            Self::SettingsAdjusted { stalled_at, attempts, inflation_dhat, inflation_barrier_weight } => write!(
                f,
                "garment: with the settings given, the avatar did not grow beyond {stalled_at:.4} of its size; attempt \
                 {attempts} succeeded, with inflation_dhat {inflation_dhat} and inflation_barrier_weight \
                 {inflation_barrier_weight}; set these to save the time of the others"
            ),
            Self::Untangled { pairs, remaining, first: [s, t] } => {
                write!(
                    f,
                    "garment: {pairs} pairs of triangles that pass through each other as designed, such as {s} and {t}, are pulled \
                     apart before the fit; "
                )?;
                match remaining {
                    0 => f.write_str("none is left"),
                    _ => write!(f, "{remaining} pairs are left as they were"),
                }
            }
            Self::OpeningCap { bone, triangles } => {
                let [a, b] = bone.joints;
                write!(
                    f,
                    "garment: the bone between joints {a} and {b} leaves it through a cap, triangles {} ({} in all), taken \
                     for an opening: left out while it is fitted, carried along with the rim, and not verified, for the body \
                     passes through; delete them in the result, or set keep_caps to refuse them",
                    ranges(triangles),
                    triangles.len()
                )
            }
            Self::LimbMisplaced { bone, place } => misplaced(f, *bone, *place),
            Self::PieceResized { triangle, triangles, scale, .. } => write!(
                f,
                "result: the piece of {triangles} triangles with garment triangle {triangle} is {scale:.2} times as large as it \
                 should be beside the garment around it or the bodies; join it to what it hangs on, or make it a rigid group"
            ),
            Self::ClothDistorted { scales: [smaller, larger], triangles: [shrunk, drawn_out] } => write!(
                f,
                "result: some of the cloth, such as garment triangle {shrunk}, is {smaller:.2} times as large as in the design and \
                 some, such as triangle {drawn_out}, {larger:.1} times; compare unit and place of the garment with its skeleton, and \
                 of the avatar with its own"
            ),
            Self::ResultCrumpled { pairs, first: [s, t], share, .. } => write!(
                f,
                "result: {pairs} pairs of garment triangles beside each other, such as {s} and {t}, pass through each other as in the \
                 design ({:.0} % of its area); smooth the garment there, so that it does not pass through itself",
                100.0 * share
            ),
            Self::ClothLifted { triangle, times } => write!(
                f,
                "result: some of the cloth, such as garment triangle {triangle}, lies {times:.1} times as far from the bones as in \
                 the design beside the rest of it, for something that sticks out of the body is under it; a wing or a tail needs a \
                 bone and an opening, or leave it out with set_avatar_parts"
            ),
            Self::NotConverged { iterations, stuck: true } => write!(
                f,
                "result: the fit ended after {iterations} iterations where no step brings the garment nearer to the body or its \
                 own shape, short of its tolerance, for contact holds it; another dhat or barrier_weight may free it"
            ),
            Self::NotConverged { iterations, stuck: false } => write!(
                f,
                "result: the fit ended after {iterations} iterations by the limit, not by its tolerance, so that the garment is \
                 not as near to the body or its own shape as it could be; raise max_iterations"
            ),
            Self::UnitMismatch { subject, against, factor, or, turn, .. } => {
                let (subject, against) = (input(*subject), input(*against));
                let is_large = *factor > 1.0;
                let size = if is_large { "large" } else { "small" };
                let times = |factor: f64| {
                    let times = if is_large { factor } else { 1.0 / factor };
                    format!("{} times{}", short(times), units(times))
                };
                let other: String = or.iter().map(|&or| format!(", or {}", times(or))).collect();
                write!(f, "{subject}: it is too {size} for the {against}: {}{other}", times(*factor))?;
                let other: String = or.iter().map(|or| format!(" or {}", short(1.0 / or))).collect();
                let also = turn.map_or(String::new(), |turn| format!(", and turn it by {}", turned(turn)));
                write!(f, "; multiply its coordinates by {}{other}{also}", short(1.0 / factor))
            }
            Self::FacingMismatch { subject, against, turn, told: None, .. } => {
                let (subject, against) = (input(*subject), input(*against));
                let (degrees, turn) = (turn.degrees(), turned(*turn));
                if degrees > HALF_WAY {
                    write!(
                        f,
                        "{subject}: it stands the other way round than the {against}, as where one faces backwards or is \
                         mirrored; turn it by {turn}"
                    )
                } else {
                    write!(
                        f,
                        "{subject}: it lies across the {against}, as where one is y-up and the other z-up, or faces sideways; turn it \
                         by {turn}"
                    )
                }
            }
            Self::Turned { subject, against, axis, degrees, .. } => {
                let (subject, against, axis) = (input(*subject), input(*against), axis.name().trim_start_matches('+'));
                write!(
                    f,
                    "{subject}: it is turned against the {against}, so that bones pass beside it or through it; turn it by about \
                     {degrees:.0} degrees about {axis}"
                )
            }
            Self::LimbTurned { bone, joint, opening, degrees, .. } => {
                let next = if bone.joints[0] == *joint { bone.joints[1] } else { bone.joints[0] };
                write!(
                    f,
                    "source skeleton: the limb from joint {joint} over joint {next} is elsewhere than its part of the garment: no bone \
                     goes through the opening at {}, to which it would have to be turned by {degrees:.0} degrees; bring skeleton and \
                     garment into one pose",
                    point(*opening)
                )
            }
            Self::FacingMismatch { turn, told: Some(system), gross: true, .. } => write!(
                f,
                "target avatar and skeleton: they are turned against the source by {}, which the option strict refuses; tell \
                 the target coordinate system, which would be {}",
                turned(*turn),
                axes(system)
            ),
            Self::FacingMismatch { turn, told: Some(system), sure, .. } => {
                let unsure = "; whether front is front then could not be seen, so look at the result";
                write!(
                    f,
                    "target avatar and skeleton: they are turned against the source; they are fitted as if turned by {}, and the result is as they are. The target coordinate system {} says the same{}",
                    turned(*turn),
                    axes(system),
                    if *sure { "" } else { unsure }
                )
            }
            Self::SidesSwapped { mirrored: Some(system), .. } => write!(
                f,
                "target avatar and skeleton: they are mirrored, so that left is right, and the triangles are turned inside out; tell the target coordinate system, which would be {}",
                axes(system)
            ),
            Self::SidesSwapped { joints: [a, b], mirrored: None, all, .. } => {
                let which = if *all { "left and right are swapped" } else { "some limbs are on the wrong side" };
                write!(
                    f,
                    "target skeleton: {which}: joints {a} and {b} belong into each other's places, and what hangs on them; exchange them, with their rows of skin weights{}",
                    if *all { ", or mirror the target back if it is mirrored" } else { "" }
                )
            }
            Self::More { like, count } => write!(f, "{count} more {}", several(like)),
        }
    }
}

/// A limb of which more than this share was pulled back may not come out of the garment again.
const MUCH: f64 = 0.5;

/// Where a limb is and was.
fn misplaced(f: &mut Formatter<'_>, bone: Bone, place: LimbPlace) -> Result {
    let (name, cause) = (
        bone_name(Some(bone)),
        "compare the source skeleton with the garment there, and the skin weights with the avatar",
    );
    match place {
        LimbPlace::OutOfOpening { vertex } => write!(
            f,
            "result: {name} belongs into the opening at garment vertex {vertex} by the design, and nothing goes through it now; \
             {cause}"
        ),
        LimbPlace::Inside { triangle, share } => write!(
            f,
            "result: the end of the limb at {name} is outside of the garment in the design and is shut up in it now ({:.0} % of \
             it, such as avatar triangle {triangle}); {cause}",
            100.0 * share
        ),
        LimbPlace::Beside { triangle, share } => write!(
            f,
            "result: the part around {name} is inside of the garment in the design and is beside it now ({:.0} % of it, such as \
             avatar triangle {triangle}); {cause}",
            100.0 * share
        ),
        LimbPlace::Swallowed { triangle, times, .. } => write!(
            f,
            "result: a part that sticks out of the body near {name}, such as avatar triangle {triangle}, is shut up in the garment, \
             {times:.1} times as far from the bone as there is room in the design; as a horn, a tail or a wing it needs a bone and an \
             opening, or leave it out with set_avatar_parts"
        ),
        LimbPlace::Under { triangle, share } => write!(
            f,
            "result: a loose sheet of the avatar, as strands of hair are, begins outside of the garment and ends under it near \
             {name}, such as avatar triangle {triangle} ({:.0} % of it); leave it out with set_avatar_parts, and it can hang over \
             the garment",
            100.0 * share
        ),
    }
}

/// What many diagnostics of one sort are about.
fn several(like: &Diagnostic) -> &'static str {
    match like {
        Diagnostic::DuplicateTriangle { .. } => "garment triangles have the corners of another",
        Diagnostic::CollapsedTriangle { .. } => "garment triangles have corners in one place",
        Diagnostic::FlatTriangle { .. } => "garment triangles have their corners on a line",
        Diagnostic::NonManifoldEdge { .. } => "garment edges have more than two triangles",
        Diagnostic::UnusedVertex { .. } => "garment vertices belong to no triangle",
        Diagnostic::LoosePiece { .. } => "loose pieces of the garment are held",
        Diagnostic::SelfIntersection { .. } => "pairs of garment triangles intersect before anything has moved",
        Diagnostic::ResultSelfIntersection { .. } => "pairs of garment triangles intersect in the result",
        Diagnostic::ResultIntersection { .. } => {
            "pairs of garment triangles and those of the avatar or its layers intersect in the result"
        }
        Diagnostic::PinNotReached { .. } => "pinned vertices end away from their places",
        Diagnostic::RigidGroupBent { .. } => "rigid groups end bent",
        Diagnostic::ForeignPart { .. } => "pieces of the avatar seem to be no part of the body",
        Diagnostic::LimbMisplaced { .. } => "limbs are elsewhere than in the design",
        Diagnostic::PieceResized { .. } | Diagnostic::ClothDistorted { .. } => {
            "pieces of the garment became larger or smaller than they should"
        }
        _ => "of this kind",
    }
}

/// What was done at a bone, where the shrunk avatar was in the garment's way: how far it was led aside, and what was pulled back
/// between its joints and beyond its end, as lengths and shares.
fn moves(aside: f64, [between, beyond]: [f64; 2], shares: [f64; 2]) -> String {
    let [of_bone, of_end] = shares.map(|share| 100.0 * share);
    let mut done = Vec::new();
    if aside > 0.0 {
        done.push(format!("it was led aside by up to {aside:.3}"));
    }
    if between > 0.0 {
        done.push(format!("{between:.3} of its length ({of_bone:.0} %) was pulled back to where it is still inside"));
    }
    if beyond > 0.0 {
        done.push(format!("of what goes beyond its end {beyond:.3} ({of_end:.0} %) was pulled back"));
    }
    if done.is_empty() {
        done.push("a bone beside it was moved".to_string());
    }
    done.join(", and ")
}
