//! Diagnostics about inputs and result, element by element.

use std::ffi::c_char;
use std::mem::size_of;

use crate::capi::session::{BespokeSession, call};
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::capi::text;
use crate::capi::view::invalid;
use crate::input::diagnostic::{Diagnostic, DiagnosticKind, Element, ElementKind, Severity, Subject};

/// Bytes of the message in BespokeDiagnostic, its zero byte included.
pub const BESPOKE_MESSAGE_SIZE: usize = 512;

/// Elements that a BespokeDiagnostic can name.
pub const BESPOKE_MAX_ELEMENTS: usize = 4;

/// What a diagnostic is about.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeDiagnosticKind {
    /// Garment vertices at equal positions, as along UV seams, that are welded. The first of them are named.
    SplitVertices = 1,
    /// A garment triangle with the corners of another, which counts once. Both are named.
    DuplicateTriangle = 2,
    /// A garment triangle without area.
    DegenerateTriangle = 3,
    /// A garment edge with more than two triangles. Its vertices are named.
    NonManifoldEdge = 4,
    /// A garment vertex that no triangle uses.
    UnusedVertex = 5,
    /// A small piece of the garment, such as a button, that is attached to the nearest other piece.
    LoosePiece = 6,
    /// Two garment triangles that pass through each other, or touch, before anything has moved. They are exempted from
    /// contact until they separate. Also pairs beside each other that are left in the result of a crumpled design: from 15 % of the
    /// area on it is not as designed.
    SelfIntersection = 7,
    /// Parts of the garment, or garment and shrunk avatar, that are very near at the start. The garment's vertices are
    /// named.
    NearContact = 8,
    /// The avatar, shrunk onto the source skeleton, passes through the garment.
    AvatarPenetrates = 9,
    /// The coordinates in which the result is read are coarse, so the minimum separation is larger than the option's.
    CoarseCoordinates = 10,
    /// Two triangles that intersect in the result and did not at the start.
    ResultIntersection = 11,
    /// A pinned garment vertex ended away from its target.
    PinNotReached = 12,
    /// A rigid group of garment vertices ended bent, because something is in its way.
    RigidGroupBent = 13,
    /// The inflation stalled, and this part of the avatar, or these two, push against the garment. A garment triangle
    /// is named and the avatar's triangles on its sides, and with one part its bone. The distance is that between the
    /// garment and one part now, or that between two parts at full size, which is 0 where they touch or overlap.
    InflationBlocked = 14,
    /// An input is in another unit than the one that it belongs to: garment or source avatar and the source skeleton, or
    /// target avatar and target skeleton. The message has the factor.
    UnitMismatch = 15,
    /// An input is turned against the one that it belongs to, or the target faces another way than the garment, in which
    /// case it is turned while it is solved for. The message has the turn.
    FacingMismatch = 16,
    /// Left and right of the target are exchanged, or it is mirrored.
    SidesSwapped = 17,
    /// A joint is missing or does not lie where the body wants it: the body goes on beyond the end of a bone where no bone
    /// does, such as a head above the joint from which the shoulders branch off, or the joint is outside of the body, as a
    /// root on the floor is. The bone is named; the distance is how far the body goes on, or how far the joint is off. It is
    /// taken to lie where the message says, unless the option strict is set.
    JointMisplaced = 18,
    /// The target stands in another pose than the garment was designed in, and the garment does not let it go from that pose
    /// to its own, because parts of it, which are named, meet: the result is in the pose of the design, whose transforms are
    /// read with bespoke_session_read_pose_transforms.
    PoseBlocked = 30,
    /// With the target in its own pose, which is another one than the garment was designed in, the inflation stalled: it was
    /// posed as in the design, by its own skin weights, dressed there, and brought back. The share of its size at which it
    /// stalled is named, and the angle between the poses.
    SolvedPosed = 34,
    /// The garment was refused (NOT_ENCLOSED, INFLATION_STALLED), and the source avatar passes through it, as a head through its
    /// hat: it was dressed with that body and the garment together as the source avatar, close to the target. The first
    /// triangles that meet in the design are named. With the option strict it is refused.
    SourceDressed = 40,
    /// A mesh that follows the garment (bespoke_session_add_follower) is in the avatar, a layer or the garment in the
    /// result, and was not in the design. Its first such triangle is named, and the one that it passes through.
    FollowerIntersects = 35,
    /// A morph of the target avatar (bespoke_session_add_target_morph) to which the garment has no answer, because it gives way
    /// only up to the weight in the message.
    MorphNotSolved = 36,
    /// The garment's answer to a morph of the target avatar is good at weight 0 and 1, but intersects halfway. The first two
    /// triangles that meet there are named.
    MorphIntersects = 37,
    /// Which joints of the rigs are places of the body, which are named, is a guess, because their names do not say it:
    /// bespoke_session_read_joint_map shows it and bespoke_session_set_joint_pairs mends it.
    JointsUnsure = 33,
    /// Skin weights bind vertices of the avatar to joints far away, while another bone is near; the nearest bone decides
    /// for them, unless the option strict is set. The first vertices are named.
    WeightsContradict = 19,
    /// The avatar has no skin weights, and vertices beside each other on its surface, which are named, belong to bones far from
    /// each other on the skeleton, as where a hand and a thigh are one mesh: the garment may be caught there.
    BonesUnclear = 38,
    /// A connected piece of the avatar's mesh, or of the source avatar's, seems to be no part of the body, such as a floor or a dome; it
    /// is left out, unless the option strict is set or bespoke_session_set_avatar_parts gives it a role. Its first and last triangles
    /// are named. The distance is the longest side of its bounding box.
    ForeignPart = 20,
    /// A piece of the garment that is around no bone, such as a cape or a badge, or closed around one without any opening, as a
    /// hat with a filling is, and is carried along with the body beside it. A triangle of it is named and the bone nearest to
    /// it; the distance is that from the source avatar, or from the bone where there is none.
    CarriedPiece = 22,
    /// The inflation stalled with the caller's settings of the contact, and was done with others, which are named.
    SettingsAdjusted = 26,
    /// Borders of the garment that lie on or beside another part of it, such as the fronts of a placket or a shirt over
    /// trousers, and keep their place there. A vertex is named and the triangle beside it; the distance is the largest.
    KeptTogether = 28,
    /// Open seams of the garment whose sides are within BespokeOptions.weld_distance, which are closed. The first
    /// vertices are named.
    WeldedNear = 29,
    /// Vertices of the garment lie on the edge of a triangle that does not have them, as where an edge was split on one side
    /// alone: both sides keep together, but may part by a hair. The first vertices are named.
    TJunctions = 39,
    /// A piece of the garment is a closed surface around a bone, as where both sides of the cloth are modelled, and no cuff,
    /// hem or collar of it was found: nothing keeps its openings in their places along the bones. A triangle of it is named,
    /// and a bone that it is around.
    RimsNotFound = 32,
    /// The garment passed through itself in the design, and begins pulled apart there, wholly or partly: the result has
    /// fewer such pairs of triangles than the design. The first pair is named.
    Untangled = 27,
    /// Triangles that close an opening of the garment where a bone leaves it: left out while it is fitted, carried along
    /// with their rim, and not verified, for the body passes through them. The bone is named, and the first three of them.
    OpeningCap = 21,
    /// The result is not as designed: a limb that went through an opening of the garment and does not now, that was
    /// outside of the garment and is shut up in it, or that was inside and is beside it. Its bone is named, and a
    /// garment vertex of the opening or an avatar triangle of the limb. So are parts of the body without a bone of their own that are
    /// shut up, such as horns and strands of hair, most of them as a warning.
    LimbMisplaced = 23,
    /// A piece of the result is far larger or smaller than what it hangs on. A triangle of it is named.
    PieceResized = 24,
    /// The fit ended by the limit of iterations, or where no step made it better, and not by its tolerance.
    NotConverged = 25,
}

/// How much a diagnostic matters.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeSeverity {
    /// For information.
    Note = 1,
    /// The result may be worse for it.
    Warning = 2,
    /// There is no result because of it, or, with IMPLAUSIBLE_RESULT, none that should be used unseen.
    Error = 3,
}

/// Which of the inputs an element belongs to. Any number from BESPOKE_SUBJECT_LAYER on is a layer, and from
/// BESPOKE_SUBJECT_FOLLOWER on a follower.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeSubject {
    /// The garment.
    Garment = 1,
    /// The body to dress.
    TargetAvatar = 2,
    /// The body that the garment was designed on.
    SourceAvatar = 3,
    /// The skeleton that the garment was designed on.
    SourceSkeleton = 4,
    /// The skeleton of the body to dress.
    TargetSkeleton = 5,
    /// The first layer that was added with bespoke_session_add_layer; layer k, counted from 0, is this plus k.
    Layer = 256,
    /// The first mesh that was added with bespoke_session_add_follower; follower k, counted from 0, is this plus k.
    Follower = 0x4000_0000,
}

/// What the index of an element counts.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeElementKind {
    /// Vertices of a mesh.
    Vertex = 1,
    /// Triangles of a mesh.
    Triangle = 2,
    /// Bones of a skeleton.
    Bone = 3,
}

/// A vertex, triangle or bone of an input.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BespokeElement {
    /// One of BespokeSubject, BESPOKE_SUBJECT_LAYER plus the number of a layer, BESPOKE_SUBJECT_FOLLOWER plus that of a follower;
    /// 0 where there is no element.
    pub subject: u32,
    /// One of BespokeElementKind.
    pub kind: u32,
    /// The caller's index, from 0.
    pub index: u32,
}

/// A diagnostic about the inputs or the result.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeDiagnostic {
    /// sizeof(BespokeDiagnostic).
    pub struct_size: u32,
    /// One of BespokeDiagnosticKind.
    pub kind: u32,
    /// One of BespokeSeverity.
    pub severity: u32,
    /// Elements in use.
    pub element_count: u32,
    /// The elements that it is about, for a tool to select.
    pub elements: [BespokeElement; BESPOKE_MAX_ELEMENTS],
    /// A distance in the normalised space, in which the longest side of the skeleton's bounding box is 2; NaN where it
    /// has none.
    pub distance: f64,
    /// One sentence, UTF-8; ends with a zero byte.
    pub message: [c_char; BESPOKE_MESSAGE_SIZE],
}

// SAFETY: repr(C) of u32, an even number of them, a 64-bit number and bytes, without padding.
unsafe impl Sized32 for BespokeDiagnostic {}

impl From<&Element> for BespokeElement {
    fn from(element: &Element) -> Self {
        let subject = match element.subject {
            Subject::Garment => BespokeSubject::Garment as u32,
            Subject::TargetAvatar => BespokeSubject::TargetAvatar as u32,
            Subject::SourceAvatar => BespokeSubject::SourceAvatar as u32,
            Subject::SourceSkeleton => BespokeSubject::SourceSkeleton as u32,
            Subject::TargetSkeleton => BespokeSubject::TargetSkeleton as u32,
            Subject::Layer(layer) => (BespokeSubject::Layer as u32).saturating_add(layer),
            Subject::Follower(follower) => (BespokeSubject::Follower as u32).saturating_add(follower),
        };
        let kind = match element.kind {
            ElementKind::Vertex => BespokeElementKind::Vertex,
            ElementKind::Triangle => BespokeElementKind::Triangle,
            ElementKind::Bone => BespokeElementKind::Bone,
        };
        Self { subject, kind: kind as u32, index: element.index }
    }
}

impl BespokeDiagnostic {
    /// `text` is what it says.
    fn new(diagnostic: &Diagnostic, text: &str) -> Self {
        let kind = match diagnostic.kind() {
            DiagnosticKind::SplitVertices => BespokeDiagnosticKind::SplitVertices,
            DiagnosticKind::DuplicateTriangle => BespokeDiagnosticKind::DuplicateTriangle,
            DiagnosticKind::DegenerateTriangle => BespokeDiagnosticKind::DegenerateTriangle,
            DiagnosticKind::NonManifoldEdge => BespokeDiagnosticKind::NonManifoldEdge,
            DiagnosticKind::UnusedVertex => BespokeDiagnosticKind::UnusedVertex,
            DiagnosticKind::LoosePiece => BespokeDiagnosticKind::LoosePiece,
            DiagnosticKind::SelfIntersection => BespokeDiagnosticKind::SelfIntersection,
            DiagnosticKind::NearContact => BespokeDiagnosticKind::NearContact,
            DiagnosticKind::AvatarPenetrates => BespokeDiagnosticKind::AvatarPenetrates,
            DiagnosticKind::CoarseCoordinates => BespokeDiagnosticKind::CoarseCoordinates,
            DiagnosticKind::ResultIntersection => BespokeDiagnosticKind::ResultIntersection,
            DiagnosticKind::PinNotReached => BespokeDiagnosticKind::PinNotReached,
            DiagnosticKind::RigidGroupBent => BespokeDiagnosticKind::RigidGroupBent,
            DiagnosticKind::InflationBlocked => BespokeDiagnosticKind::InflationBlocked,
            DiagnosticKind::UnitMismatch => BespokeDiagnosticKind::UnitMismatch,
            DiagnosticKind::FacingMismatch => BespokeDiagnosticKind::FacingMismatch,
            DiagnosticKind::SidesSwapped => BespokeDiagnosticKind::SidesSwapped,
            DiagnosticKind::JointMisplaced => BespokeDiagnosticKind::JointMisplaced,
            DiagnosticKind::PoseBlocked => BespokeDiagnosticKind::PoseBlocked,
            DiagnosticKind::FollowerIntersects => BespokeDiagnosticKind::FollowerIntersects,
            DiagnosticKind::MorphNotSolved => BespokeDiagnosticKind::MorphNotSolved,
            DiagnosticKind::MorphIntersects => BespokeDiagnosticKind::MorphIntersects,
            DiagnosticKind::JointsUnsure => BespokeDiagnosticKind::JointsUnsure,
            DiagnosticKind::SolvedPosed => BespokeDiagnosticKind::SolvedPosed,
            DiagnosticKind::SourceDressed => BespokeDiagnosticKind::SourceDressed,
            DiagnosticKind::WeightsContradict => BespokeDiagnosticKind::WeightsContradict,
            DiagnosticKind::BonesUnclear => BespokeDiagnosticKind::BonesUnclear,
            DiagnosticKind::ForeignPart => BespokeDiagnosticKind::ForeignPart,
            DiagnosticKind::SettingsAdjusted => BespokeDiagnosticKind::SettingsAdjusted,
            DiagnosticKind::KeptTogether => BespokeDiagnosticKind::KeptTogether,
            DiagnosticKind::RimsNotFound => BespokeDiagnosticKind::RimsNotFound,
            DiagnosticKind::WeldedNear => BespokeDiagnosticKind::WeldedNear,
            DiagnosticKind::TJunctions => BespokeDiagnosticKind::TJunctions,
            DiagnosticKind::CarriedPiece => BespokeDiagnosticKind::CarriedPiece,
            DiagnosticKind::Untangled => BespokeDiagnosticKind::Untangled,
            DiagnosticKind::OpeningCap => BespokeDiagnosticKind::OpeningCap,
            DiagnosticKind::LimbMisplaced => BespokeDiagnosticKind::LimbMisplaced,
            DiagnosticKind::PieceResized => BespokeDiagnosticKind::PieceResized,
            DiagnosticKind::NotConverged => BespokeDiagnosticKind::NotConverged,
        };
        let severity = match diagnostic.severity() {
            Severity::Note => BespokeSeverity::Note,
            Severity::Warning => BespokeSeverity::Warning,
            Severity::Error => BespokeSeverity::Error,
        };
        let named = diagnostic.elements();
        let named = &named[..named.len().min(BESPOKE_MAX_ELEMENTS)];
        let mut elements = [BespokeElement::default(); BESPOKE_MAX_ELEMENTS];
        elements.iter_mut().zip(named).for_each(|(to, from)| *to = from.into());
        let mut message = [0; BESPOKE_MESSAGE_SIZE];
        let text = text::cut(text, BESPOKE_MESSAGE_SIZE - 1);
        message.iter_mut().zip(text.as_bytes()).for_each(|(to, &from)| *to = from as c_char);
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: kind as u32,
            severity: severity as u32,
            element_count: named.len() as u32,
            elements,
            distance: diagnostic.distance(),
            message,
        }
    }
}

/// Writes the diagnostics about the inputs and the result: what prepare found, also where it failed, what holds the
/// garment where the inflation stalled, and what the verifier found in the end. Of one kind, the first thousand or so
/// are listed, and the last one says how many more there are.
///
/// `diagnostics`: room for `capacity` of them; the first that fit are written. The caller sets the `struct_size` of the first,
/// which is the size of each: so far apart they are written. May be null where `capacity` is 0. `*count`, unless null: how
/// many there are. State: any; there are none before prepare. Errors: INVALID_ARGUMENT (null with a capacity, or
/// struct_size), BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_diagnostics(
    session: *const BespokeSession,
    diagnostics: *mut BespokeDiagnostic,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` diagnostics and for one number.
    unsafe {
        call(session, |session| {
            if diagnostics.is_null() && capacity > 0 {
                return invalid(format!("diagnostics: the pointer is null, with room for {capacity}"));
            }
            let found = session.diagnostics();
            if !count.is_null() {
                count.write(found.len());
            }
            let filled = found.iter().map(|one| BespokeDiagnostic::new(one, &session.sentence(one)));
            sized::write_all(filled, diagnostics, capacity, "diagnostics")
        })
    }
}
