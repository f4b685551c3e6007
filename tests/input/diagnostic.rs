//! Every sort of diagnostic, with its message to the letter.

use bespoke::input::coordinate_system::{Axis, AxisTurn, CoordinateSystem};
use bespoke::input::diagnostic::{
    AvatarPart, Bone, Diagnostic, DiagnosticKind, Element, Foreignness, JointFault, LimbPlace, Severity, Subject,
};

const BONE: Bone = Bone { index: 4, joints: [5, 7] };

fn avatar(index: u32) -> Element {
    Element::triangle(Subject::TargetAvatar, index)
}

fn layer(index: u32) -> Element {
    Element::triangle(Subject::Layer(2), index)
}

#[test]
fn every_sentence_is_made_of_its_data() {
    let moved = |aside, between, beyond, shares| Diagnostic::BoneMoved {
        bone: BONE,
        triangles: vec![1, 2],
        aside,
        between,
        beyond,
        shares,
    };
    let start = "source skeleton: at the bone between joints 5 and 7, the shrunk avatar would penetrate the garment;";
    let end = "(the skeleton is 2 long); check the result there, or move skeleton and garment onto each other";
    let cases = [
        (
            Diagnostic::SplitVertices { sharing: 4, vertices: 7, shared_places: 2, places: 5, first: vec![0, 1, 3, 4] },
            "garment: 4 of the 7 vertices share their place with another, in 2 places, as along UV and normal seams; copies \
             move as one, so there are 5 vertices to place. The result is in the caller's order"
                .to_string(),
        ),
        (
            Diagnostic::DuplicateTriangle { triangle: 9, of: 3 },
            "garment: triangle 9 has the corners of triangle 3; the two count as one".into(),
        ),
        (
            Diagnostic::CollapsedTriangle { triangle: 1, corners: [3, 3, 8], kept: true },
            "garment: triangle 1 (vertices 3, 3, 8) has corners in one place; it counts as a wire, which collides and nothing \
             more"
                .into(),
        ),
        (
            Diagnostic::CollapsedTriangle { triangle: 1, corners: [3, 3, 8], kept: false },
            "garment: triangle 1 (vertices 3, 3, 8) has corners in one place; it is left out".into(),
        ),
        (
            Diagnostic::FlatTriangle { triangle: 2, corners: [1, 2, 8] },
            "garment: triangle 2 (vertices 1, 2, 8) has its corners on a line; it has no area".into(),
        ),
        (
            Diagnostic::NonManifoldEdge { vertices: [1, 6], triangles: 4 },
            "garment: the edge between vertices 1 and 6 has 4 triangles; each of them bends with every other, and boundary \
             curves that end there do not hold their shape"
                .into(),
        ),
        (
            Diagnostic::UnusedVertex { vertex: 8 },
            "garment: vertex 8 belongs to no triangle with a side; nothing holds it in its place".into(),
        ),
        (
            Diagnostic::LoosePiece { vertices: 7, triangle: 40, host: 11, distance: 0.02 },
            "garment: the loose piece of 7 vertices with triangle 40 is held to the piece beside it, near triangle 11".into(),
        ),
        (
            Diagnostic::PoseBlocked { share: 0.96, joints: vec![5, 9] },
            "target avatar: it stands in another pose than the garment was designed in, and the garment lets it go only 96 % of \
             the way from that pose to its own: what belongs to joint 5 and to joint 9 is in the way of each other; the result \
             is in the pose of the design; give the avatar in a pose nearer to it"
                .into(),
        ),
        (
            Diagnostic::SolvedPosed { stalled_at: 0.91114, degrees: 48.6 },
            "target avatar: in its own pose, which differs from that of the design by 49 degrees, it cannot grow beyond 0.9111 \
             of its size inside the garment; it was posed as in the design, dressed there, and brought back to its own pose"
                .into(),
        ),
        (
            Diagnostic::SourceDressed { pairs: 31, triangles: [4, 9], has_begun: false },
            "source avatar: it passes through the garment in 31 pairs of triangles, such as garment triangle 4 and avatar \
             triangle 9, and with it the garment was refused; that body with the garment on took its place, so that the \
             garment keeps no distance from the target; take away what passes through it to keep its looseness"
                .into(),
        ),
        (
            Diagnostic::FollowerIntersects {
                follower: 2,
                body: 1,
                garment: 7,
                first: vec![Element::triangle(Subject::Follower(2), 4), Element::triangle(Subject::TargetAvatar, 9)],
            },
            "follower 2: it passes with 1 triangle into the avatar and with 7 triangles through the garment where the result \
             takes it, and did not in the design; make it part of the garment, or move it away from the body"
                .into(),
        ),
        (
            Diagnostic::MorphNotSolved { morph: 1, name: "heavy".into(), weight: 0.634 },
            "target morph 1 (\"heavy\"): the garment lets the body change only up to weight 0.63; there is no answer to it; make \
             the morph smaller, or the garment looser"
                .into(),
        ),
        (
            Diagnostic::MorphNotSolved { morph: 1, name: String::new(), weight: 1.0 },
            "target morph 1: the garment intersects at weight 1 in the precision in which it is read; there is no answer to it; \
             set the garment in 64 bits"
                .into(),
        ),
        (
            Diagnostic::MorphIntersects { morph: 0, name: "thin".into(), pairs: 3, first: Vec::new() },
            "target morph 0 (\"thin\"): the garment's answer is good at weight 1, but halfway 3 pairs of triangles intersect; \
             divide the morph into smaller ones"
                .into(),
        ),
        (
            Diagnostic::BonesUnclear { edges: 9, vertices: [4, 70], joints: [[4, 5], [10, 10]] },
            "target avatar: parts of the body that are far apart on the skeleton are one surface, at 9 edges such as that of \
             vertices 4 and 70, which begin at the bone between joints 4 and 5 and at joint 10; without skin weights the nearest \
             bone inside the body decides, and the garment may be caught there; set skin weights of the avatar, or part its mesh \
             there"
                .into(),
        ),
        (
            Diagnostic::JointsUnsure { places: vec!["shoulders", "hips", "knees"] },
            "which joints of the two rigs are shoulders, hips and knees is a guess: the names do not say it; look at the joint \
             map, and say which joints correspond, as pairs"
                .into(),
        ),
        (
            Diagnostic::KeptTogether { vertices: 12, vertex: 5, triangle: 40, distance: 0.01 },
            "garment: 12 vertices on its borders lie on or beside another part of it and keep their place there, such as vertex \
             5 at triangle 40"
                .into(),
        ),
        (
            Diagnostic::RimsNotFound { triangles: 240, triangle: 12, bone: Bone { index: 3, joints: [4, 5] } },
            "garment: the piece of 240 triangles with triangle 12 is closed, around the bone between joints 4 and 5, and no cuff, \
             hem or collar of it was found; nothing keeps its openings in their places along the bones; name them with \
             add_curve, or model it without its inner side"
                .into(),
        ),
        (
            Diagnostic::WeldedNear { places: 3, first: vec![4, 9], gap: 2e-5 },
            "garment: open seams with gaps of up to 2.0e-5 are closed in 3 places (the first: vertices 4, 9); weld_distance \
             says how near is one place"
                .into(),
        ),
        (
            Diagnostic::TJunctions { count: 120, first: vec![1987, 1990], triangle: 48 },
            "garment: 120 vertices lie on the edge of a triangle that does not have them (T-junctions), such as vertex 1987 on \
             triangle 48; the two sides keep together, but may part by a hair; split these edges where the vertices are"
                .into(),
        ),
        (
            Diagnostic::CarriedPiece {
                vertices: 7,
                triangle: 40,
                bone: BONE,
                distance: 0.02,
                from_body: true,
                stiff: true,
                closed: false,
            },
            "garment: the piece of 7 vertices with triangle 40 is around no bone; it is carried by the body at the bone \
             between joints 5 and 7, 2.0e-2 from the source avatar (the skeleton is 2 long), and keeps its shape"
                .into(),
        ),
        (
            Diagnostic::SelfIntersection { triangles: [1, 2], touches: false, strict: true },
            "garment: triangles 1 and 2 intersect before anything has moved, which the option strict refuses".into(),
        ),
        (
            Diagnostic::SelfIntersection { triangles: [1, 2], touches: true, strict: false },
            "garment: triangles 1 and 2 touch within rounding before anything has moved, so they are exempted from \
             contact until they separate, and may still do so in the result"
                .into(),
        ),
        (
            Diagnostic::NearContact { vertices: vec![3], to_itself: f64::INFINITY, to_avatar: 2e-6, min_separation: 5e-7 },
            "garment: at the start it is within 2.0e-6 of the shrunk avatar, so that the minimum separation \
             begins at 5.0e-7 and rises as they part"
                .into(),
        ),
        (moved(0.0, 0.0, 0.0, [0.0; 2]), format!("{start} a bone beside it was moved {end}")),
        (
            moved(0.1, 0.2, 0.3, [0.1, 0.5]),
            format!(
                "{start} it was led aside by up to 0.100, and 0.200 of its length (10 %) was pulled back to where it is still \
                 inside, and of what goes beyond its end 0.300 (50 %) was pulled back {end}"
            ),
        ),
        (
            moved(0.0, 0.4, 0.0, [0.8, 0.0]),
            format!(
                "{start} 0.400 of its length (80 %) was pulled back to where it is still inside {end}; where the garment has no \
                 opening for that part, as for a tail or horn, leave it and its bone out, or cut one"
            ),
        ),
        (
            moved(0.0, 0.0, 0.3, [0.0, 1.0]),
            format!(
                "{start} of what goes beyond its end 0.300 (100 %) was pulled back {end}; what should leave the garment there, \
                 as a hand does, may be shut up in it: lay the bone through the opening"
            ),
        ),
        (
            Diagnostic::CycleCut { triangles: vec![5] },
            "source skeleton: between bones that form a cycle, the shrunk avatar would penetrate the garment; the cycle was \
             cut open; check the result there"
                .into(),
        ),
        (
            Diagnostic::AvatarPenetrates { garment: 3, bone: Some(BONE), avatar: avatar(6) },
            "garment: avatar triangle 6, shrunk onto the source skeleton, penetrates triangle 3 at the bone between joints 5 \
             and 7, and no way around it was found"
                .into(),
        ),
        (
            Diagnostic::AvatarPenetrates { garment: 3, bone: None, avatar: layer(6) },
            "garment: triangle 6 of layer 2, shrunk onto the source skeleton, penetrates triangle 3 between bones that form \
             a cycle, and no way around it was found"
                .into(),
        ),
        (
            Diagnostic::CoarseCoordinates { min_separation: 3e-4 },
            "target avatar: so far from the origin, the coordinates in which the garment is read are coarse, and it keeps a \
             distance of 3.0e-4 at least, in units in which the skeleton is 2 long; a place nearer to the origin or 64 bits \
             allow a closer fit"
                .into(),
        ),
        (
            Diagnostic::ResultSelfIntersection { triangles: [7, 8] },
            "result: garment triangles 7 and 8 intersect, which they did not at the start".into(),
        ),
        (
            Diagnostic::ResultIntersection { garment: 7, avatar: layer(1) },
            "result: garment triangle 7 and triangle 1 of layer 2 intersect".into(),
        ),
        (
            Diagnostic::OpeningCap { bone: BONE, triangles: (0..12).collect() },
            "garment: the bone between joints 5 and 7 leaves it through a cap, triangles 0-11 (12 in all), taken for an \
             opening: left out while it is fitted, carried along with the rim, and not verified, for the body passes through; \
             delete them in the result, or set keep_caps to refuse them"
                .into(),
        ),
        (
            Diagnostic::PinNotReached { vertex: 12, distance: 0.25 },
            "garment: pinned vertex 12 ends 2.5e-1 from its place, in units in which the skeleton is 2 long: the body is in its \
             way, or the garment holds it back; a higher pin_weight helps against the garment"
                .into(),
        ),
        (
            Diagnostic::RigidGroupBent { group: 1, vertex: 12, distance: 0.25 },
            "garment: rigid group 1 ends bent, by 2.5e-1 at vertex 12 in units in which the skeleton is 2 long, for the body or \
             another part of the garment is in its way"
                .into(),
        ),
        (
            Diagnostic::JointMisplaced {
                skeleton: Subject::TargetSkeleton,
                bone: BONE,
                fault: JointFault::Outside,
                distance: 0.5,
                length: 42.0,
                share: 0.25,
                place: Some([100.0, -1.25, 0.0]),
                mended: true,
            },
            "target skeleton: joint 7 lies outside of the body, by 42 (0.25 of the bone from joint 5); joint 7 belongs at \
             (100, -1.2, 0), where it is taken to lie; move it there"
                .into(),
        ),
        (
            Diagnostic::JointMisplaced {
                skeleton: Subject::SourceSkeleton,
                bone: BONE,
                fault: JointFault::Stray,
                distance: 0.5,
                length: 0.25,
                share: 1.0,
                place: Some([0.0, 0.0, 0.0]),
                mended: false,
            },
            "source skeleton: the bone between joints 5 and 7 runs outside of the body, between its parts, over 0.25 (1.00 of \
             the bone from joint 5); joint 7 belongs at (0, 0, 0), but is taken as it is; move it there, or leave it out of both \
             skeletons"
                .into(),
        ),
        (
            Diagnostic::JointMisplaced {
                skeleton: Subject::TargetSkeleton,
                bone: BONE,
                fault: JointFault::Low,
                distance: 0.5,
                length: 0.125,
                share: 0.5,
                place: Some([0.0, 1.125, 0.01]),
                mended: true,
            },
            "target skeleton: joint 7 lies too low, by 0.125 (0.50 of the bone from joint 5): limbs branch off there and leave \
             the body above it, so that the head beyond it begins below the collar; joint 7 belongs at (0, 1.125, 0.01), where \
             it is taken to lie; move it there"
                .into(),
        ),
        (
            Diagnostic::JointMisplaced {
                skeleton: Subject::TargetSkeleton,
                bone: BONE,
                fault: JointFault::AtTip,
                distance: 0.5,
                length: 0.07,
                share: 0.14,
                place: Some([0.17, 0.08, 0.01]),
                mended: true,
            },
            "target skeleton: joint 7 lies at the tip of its limb, beyond where the other skeleton has it, by 0.07 (0.14 of the \
             bone from joint 5), so that a cuff or a hem would end there; joint 7 belongs at (0.17, 0.08, 0.01), where it is \
             taken to lie; move it there"
                .into(),
        ),
        (
            Diagnostic::JointMisplaced {
                skeleton: Subject::TargetSkeleton,
                bone: BONE,
                fault: JointFault::BoneOutside,
                distance: 0.5,
                length: 0.25,
                share: 0.5,
                place: None,
                mended: false,
            },
            "target skeleton: the bone between joints 5 and 7 leaves the body, by 0.25 (0.50 of the bone from joint 5), although \
             both are inside; move its joints into the middle of the limb, or add one between them"
                .into(),
        ),
        (
            Diagnostic::EndWithoutBone { bone: BONE, reach: 0.5, mended: true },
            "target skeleton: the body goes on 0.50 beyond joint 7, straight on from joint 5, where no bone goes on (the \
             skeleton is 2 long); it starts there as if one did; give both skeletons a joint at the end of that part, such as \
             the top of the head, and look whether joint 7 lies where that part begins"
                .into(),
        ),
        (
            Diagnostic::WeightsContradict {
                count: 20,
                weighted: 90,
                first: vec![7, 9],
                example: Some((0, [5, 6])),
                mended: true,
            },
            "target skin weights: they contradict the positions of 20 of 90 vertices, such as vertex 7: they bind it to joint 0, \
             and the bone between joints 5 and 6 is nearest; the nearest bone decides for these; check that the rows are in the \
             order of the skeleton's joints, and the export of the weights"
                .into(),
        ),
        (
            Diagnostic::ForeignPart {
                whose: Subject::TargetAvatar,
                count: 2,
                triangles: [40, 41],
                reason: Foreignness::Ground,
                size: 8.0,
                left_out: true,
            },
            "target avatar: the piece of 2 triangles, from 40 to 41, seems to be no part of the body: it is flat, and the body \
             stands on it (its longest side is 8.00, the skeleton's is 2); it is left out: the result may pass through it; give \
             it a role with set_avatar_parts, or take it out of the avatar"
                .into(),
        ),
        (
            Diagnostic::PieceResized { triangle: 5, triangles: 48, scale: 0.0604, is_gross: true },
            "result: the piece of 48 triangles with garment triangle 5 is 0.06 times as large as it should be beside the \
             garment around it or the bodies; join it to what it hangs on, or make it a rigid group"
                .into(),
        ),
        (
            Diagnostic::ClothDistorted { scales: [0.083, 7.94], triangles: [5, 48] },
            "result: some of the cloth, such as garment triangle 5, is 0.08 times as large as in the design and some, such as \
             triangle 48, 7.9 times; compare unit and place of the garment with its skeleton, and of the avatar with its own"
                .into(),
        ),
        (
            Diagnostic::NotConverged { iterations: 9, stuck: true },
            "result: the fit ended after 9 iterations where no step brings the garment nearer to the body or its own shape, \
             short of its tolerance, for contact holds it; another dhat or barrier_weight may free it"
                .into(),
        ),
        (
            Diagnostic::NotConverged { iterations: 9, stuck: false },
            "result: the fit ended after 9 iterations by the limit, not by its tolerance, so that the garment is not as near to \
             the body or its own shape as it could be; raise max_iterations"
                .into(),
        ),
    ];
    for (diagnostic, sentence) in cases {
        assert_eq!(diagnostic.to_string(), sentence);
        // Of a cap all triangles are elements; the C API has room for the first.
        assert!(diagnostic.elements().len() <= 4 || diagnostic.kind() == DiagnosticKind::OpeningCap);
        // Of many, the last says how many more there are, and nothing else.
        let more = Diagnostic::More { like: Box::new(diagnostic.clone()), count: 3 };
        assert_eq!((more.kind(), more.severity()), (diagnostic.kind(), diagnostic.severity()));
        assert!(more.elements().is_empty() && more.distance().is_nan());
        assert!(more.to_string().starts_with("3 more "));
    }
}

#[test]
fn a_blockage_names_bones_and_triangles_and_what_helps() {
    let part = |triangle, bone| AvatarPart { bone, triangle, loose: None };
    let other = Bone { index: 9, joints: [10, 11] };
    let squeezed = |second, same, gap| Diagnostic::InflationSqueezed {
        garment: 55,
        parts: [part(avatar(120), Some(BONE)), part(layer(981), second)],
        same,
        gap,
        inflation_dhat: 0.01,
    };
    let touching = squeezed(Some(other), false, None);
    assert_eq!(
        touching.to_string(),
        "target avatar: the parts around bone 4 (joints 5-7) and bone 9 (joints 10-11) touch each other at full size (near avatar \
         triangle 120 and triangle 981 of layer 2), and the garment is between them (garment triangle 55): no garment can pass \
         there; move the limbs apart, or leave one part out of the body"
    );
    assert_eq!((touching.kind(), touching.severity()), (DiagnosticKind::InflationBlocked, Severity::Error));
    assert_eq!(touching.elements(), [Element::triangle(Subject::Garment, 55), avatar(120), layer(981)]);
    assert_eq!(touching.distance(), 0.0);
    for (gap, narrow) in [(0.015, true), (0.3, false)] {
        let apart = squeezed(Some(other), false, Some(gap));
        assert_eq!(apart.to_string().contains("less than two inflation_dhat"), narrow, "{apart}");
        assert_eq!(apart.distance(), gap);
        assert!(!apart.to_string().contains("touch"));
    }
    assert!(squeezed(None, false, None).to_string().contains("bone 4 (joints 5-7) and bones that form a cycle touch"));
    assert!(
        squeezed(Some(BONE), true, None).to_string().contains("two sides of the part around bone 4 (joints 5-7) touch")
    );

    let adjusted = Diagnostic::SettingsAdjusted {
        stalled_at: 0.73125,
        attempts: 3,
        inflation_dhat: 0.01,
        inflation_barrier_weight: 1000.0,
    };
    assert_eq!(
        adjusted.to_string(),
        "garment: with the settings given, the avatar did not grow beyond 0.7312 of its size; attempt 3 succeeded, with \
         inflation_dhat 0.01 and inflation_barrier_weight 1000; set these to save the time of the others"
    );
    assert_eq!((adjusted.kind(), adjusted.severity()), (DiagnosticKind::SettingsAdjusted, Severity::Note));
    assert!(adjusted.elements().is_empty() && adjusted.distance().is_nan());

    let held = Diagnostic::InflationHeld { garment: 55, part: part(avatar(120), Some(BONE)), held: 3, distance: 0.002 };
    let elements = [Element::triangle(Subject::Garment, 55), avatar(120), Element::bone(Subject::SourceSkeleton, 4)];
    assert_eq!((held.elements(), held.distance()), (elements.into(), 0.002));
    for words in
        ["bone 4 (joints 5-7)", "from one side", "garment triangle 55, avatar triangle 120", "3 garment triangles"]
    {
        assert!(held.to_string().contains(words), "{held}");
    }
    let loose = AvatarPart { loose: Some(20), ..part(avatar(120), Some(BONE)) };
    let held = Diagnostic::InflationHeld { garment: 55, part: loose, held: 3, distance: 0.002 };
    assert!(
        held.to_string().contains("holds back the loose piece of 20 triangles around bone 4 (joints 5-7)"),
        "{held}"
    );
    assert!(!held.to_string().contains("between"));
}

#[test]
fn a_misplaced_limb_names_its_bone_and_where_it_is() {
    let bone = Element::bone(Subject::SourceSkeleton, 4);
    let cases = [
        (LimbPlace::OutOfOpening { vertex: 17 }, "garment vertex 17", Element::vertex(Subject::Garment, 17)),
        (LimbPlace::Inside { triangle: 8, share: 0.914 }, "91 % of it, such as avatar triangle 8", avatar(8)),
        (LimbPlace::Beside { triangle: 8, share: 1.0 }, "100 % of it, such as avatar triangle 8", avatar(8)),
    ];
    for (place, words, element) in cases {
        let found = Diagnostic::LimbMisplaced { bone: BONE, place };
        let said = found.to_string();
        assert!(said.contains("bone 4 (joints 5-7)") && said.contains(words) && said.contains("compare"), "{said}");
        assert_eq!(found.elements(), [bone, element]);
        assert_eq!((found.kind(), found.severity()), (DiagnosticKind::LimbMisplaced, Severity::Error));
    }
    for is_gross in [true, false] {
        let place = LimbPlace::Swallowed { triangle: 8, times: 3.08, is_gross };
        let found = Diagnostic::LimbMisplaced { bone: BONE, place };
        let said = found.to_string();
        assert!(said.contains("near bone 4 (joints 5-7), such as avatar triangle 8, is shut up"), "{said}");
        assert!(said.contains("3.1 times as far from the bone") && said.contains("set_avatar_parts"), "{said}");
        assert_eq!(found.elements(), [bone, avatar(8)]);
        assert_eq!(found.severity(), if is_gross { Severity::Error } else { Severity::Warning });
    }
}

#[test]
fn a_sheet_under_the_garment_and_crumpled_cloth_are_told() {
    let found = Diagnostic::LimbMisplaced { bone: BONE, place: LimbPlace::Under { triangle: 8, share: 0.42 } };
    let said = found.to_string();
    assert!(said.contains("near bone 4 (joints 5-7), such as avatar triangle 8 (42 % of it)"), "{said}");
    assert!(said.contains("strands of hair") && said.contains("set_avatar_parts"), "{said}");
    assert_eq!(found.elements(), [Element::bone(Subject::SourceSkeleton, 4), avatar(8)]);
    assert_eq!((found.kind(), found.severity()), (DiagnosticKind::LimbMisplaced, Severity::Warning));
    for is_gross in [true, false] {
        let found = Diagnostic::ResultCrumpled { pairs: 812, first: [3, 9], share: 0.31, is_gross };
        let said = found.to_string();
        assert!(said.contains("812 pairs of garment triangles beside each other, such as 3 and 9"), "{said}");
        assert!(said.contains("31 % of its area") && said.contains("smooth the garment"), "{said}");
        assert_eq!(found.elements(), [3, 9].map(|t| Element::triangle(Subject::Garment, t)));
        assert_eq!(found.kind(), DiagnosticKind::SelfIntersection);
        assert_eq!(found.severity(), if is_gross { Severity::Error } else { Severity::Warning });
    }
}

#[test]
fn what_does_not_belong_together_is_said_with_what_mends_it() {
    let unit = |factor, or, gross| Diagnostic::UnitMismatch {
        subject: Subject::Garment,
        against: Subject::SourceSkeleton,
        factor,
        or,
        turn: None,
        gross,
    };
    let centimetres = unit(100.0, Vec::new(), true);
    assert_eq!(
        centimetres.to_string(),
        "garment: it is too large for the source skeleton: 100 times (as where a metre is in centimetres); multiply its \
         coordinates by 0.01"
    );
    assert_eq!((centimetres.kind(), centimetres.severity()), (DiagnosticKind::UnitMismatch, Severity::Error));
    let unsure = unit(0.1, vec![1.0 / 12.0], false);
    assert_eq!(
        unsure.to_string(),
        "garment: it is too small for the source skeleton: 10 times (as where a decimetre is in centimetres), or 12 times (as \
         where a foot is in inches); multiply its coordinates by 10 or 12"
    );
    assert_eq!(unsure.severity(), Severity::Warning);

    let system = CoordinateSystem { right: Axis::NegativeX, forward: Axis::PositiveZ, ..CoordinateSystem::default() };
    let about =
        AxisTurn::rotations().into_iter().find(|turn| turn.degrees() == 180.0 && turn.axis() == [0, 1, 0]).unwrap();
    let facing = |told, gross, sure| Diagnostic::FacingMismatch {
        subject: Subject::TargetAvatar,
        against: Subject::Garment,
        turn: about,
        told,
        gross,
        sure,
    };
    let turned = facing(Some(system), false, true);
    assert_eq!(
        turned.to_string(),
        "target avatar and skeleton: they are turned against the source; they are fitted as if turned by 180 degrees about y, \
         and the result is as they are. The target coordinate system right -x, up +y, forward +z says the same"
    );
    assert_eq!((turned.kind(), turned.severity()), (DiagnosticKind::FacingMismatch, Severity::Note));
    assert_eq!(facing(Some(system), false, false).severity(), Severity::Warning);
    assert_eq!(facing(Some(system), true, true).severity(), Severity::Error);
    assert_eq!(facing(None, true, true).severity(), Severity::Error);

    let aside = |gross| Diagnostic::Turned {
        subject: Subject::Garment,
        against: Subject::SourceSkeleton,
        axis: Axis::PositiveY,
        degrees: 34.6,
        gross,
    };
    assert_eq!(
        aside(true).to_string(),
        "garment: it is turned against the source skeleton, so that bones pass beside it or through it; turn it by about 35 \
         degrees about y"
    );
    assert_eq!(aside(true).kind(), DiagnosticKind::FacingMismatch);
    assert_eq!([true, false].map(|gross| aside(gross).severity()), [Severity::Error, Severity::Warning]);

    let limb = |gross| Diagnostic::LimbTurned {
        bone: Bone { index: 4, joints: [4, 3] },
        joint: 3,
        opening: [0.5, 1.0, 0.0],
        degrees: 81.2,
        gross,
    };
    assert_eq!(
        limb(true).to_string(),
        "source skeleton: the limb from joint 3 over joint 4 is elsewhere than its part of the garment: no bone goes through the \
         opening at (0.5, 1, 0), to which it would have to be turned by 81 degrees; bring skeleton and garment into one pose"
    );
    assert_eq!(limb(true).elements(), [Element::bone(Subject::SourceSkeleton, 4)]);
    assert_eq!([true, false].map(|gross| limb(gross).severity()), [Severity::Error, Severity::Warning]);

    let lifted = Diagnostic::ClothLifted { triangle: 7, times: 3.42 };
    assert!(
        lifted.to_string().starts_with("result: some of the cloth, such as garment triangle 7, lies 3.4 times as far")
    );
    assert_eq!((lifted.kind(), lifted.severity()), (DiagnosticKind::LimbMisplaced, Severity::Error));
    assert_eq!(lifted.elements(), [Element::triangle(Subject::Garment, 7)]);

    let swapped = |all, mirrored, sure| Diagnostic::SidesSwapped { joints: [3, 6], mirrored, all, sure };
    assert_eq!(
        swapped(false, None, true).to_string(),
        "target skeleton: some limbs are on the wrong side: joints 3 and 6 belong into each other's places, and what hangs on \
         them; exchange them, with their rows of skin weights"
    );
    assert!(swapped(true, None, true).to_string().contains("left and right are swapped: joints 3 and 6"));
    assert!(swapped(true, Some(system), true).to_string().contains("would be right -x, up +y, forward +z"));
    assert_eq!(swapped(true, None, true).kind(), DiagnosticKind::SidesSwapped);
    assert_eq!([true, false].map(|sure| swapped(true, None, sure).severity()), [Severity::Error, Severity::Warning]);
}
