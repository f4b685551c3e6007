//! What programs read of a diagnostic: its kind, how much it matters, the elements it names, and a distance.

use super::diagnostic::{Bone, Diagnostic, DiagnosticKind, LimbPlace, Severity};
use super::element::{Element, Subject};

impl Diagnostic {
    /// What it is about.
    pub fn kind(&self) -> DiagnosticKind {
        match self {
            Self::SplitVertices { .. } => DiagnosticKind::SplitVertices,
            Self::DuplicateTriangle { .. } => DiagnosticKind::DuplicateTriangle,
            Self::CollapsedTriangle { .. } | Self::FlatTriangle { .. } => DiagnosticKind::DegenerateTriangle,
            Self::NonManifoldEdge { .. } => DiagnosticKind::NonManifoldEdge,
            Self::UnusedVertex { .. } => DiagnosticKind::UnusedVertex,
            Self::LoosePiece { .. } => DiagnosticKind::LoosePiece,
            Self::KeptTogether { .. } => DiagnosticKind::KeptTogether,
            Self::RimsNotFound { .. } => DiagnosticKind::RimsNotFound,
            Self::WeldedNear { .. } => DiagnosticKind::WeldedNear,
            Self::TJunctions { .. } => DiagnosticKind::TJunctions,
            Self::CarriedPiece { .. } => DiagnosticKind::CarriedPiece,
            Self::SelfIntersection { .. } | Self::ResultCrumpled { .. } => DiagnosticKind::SelfIntersection,
            Self::NearContact { .. } => DiagnosticKind::NearContact,
            Self::BoneMoved { .. } | Self::CycleCut { .. } | Self::AvatarPenetrates { .. } => {
                DiagnosticKind::AvatarPenetrates
            }
            Self::CoarseCoordinates { .. } => DiagnosticKind::CoarseCoordinates,
            Self::ResultSelfIntersection { .. } | Self::ResultIntersection { .. } => DiagnosticKind::ResultIntersection,
            Self::PinNotReached { .. } => DiagnosticKind::PinNotReached,
            Self::RigidGroupBent { .. } => DiagnosticKind::RigidGroupBent,
            Self::InflationHeld { .. } | Self::InflationSqueezed { .. } => DiagnosticKind::InflationBlocked,
            Self::EndWithoutBone { .. } | Self::JointMisplaced { .. } => DiagnosticKind::JointMisplaced,
            Self::JointsUnsure { .. } => DiagnosticKind::JointsUnsure,
            Self::PoseBlocked { .. } => DiagnosticKind::PoseBlocked,
            Self::SolvedPosed { .. } => DiagnosticKind::SolvedPosed,
            Self::SourceDressed { .. } => DiagnosticKind::SourceDressed,
            Self::FollowerIntersects { .. } => DiagnosticKind::FollowerIntersects,
            Self::MorphNotSolved { .. } => DiagnosticKind::MorphNotSolved,
            Self::MorphIntersects { .. } => DiagnosticKind::MorphIntersects,
            Self::WeightsContradict { .. } => DiagnosticKind::WeightsContradict,
            Self::BonesUnclear { .. } => DiagnosticKind::BonesUnclear,
            Self::ForeignPart { .. } => DiagnosticKind::ForeignPart,
            Self::SettingsAdjusted { .. } => DiagnosticKind::SettingsAdjusted,
            Self::Untangled { .. } => DiagnosticKind::Untangled,
            Self::OpeningCap { .. } => DiagnosticKind::OpeningCap,
            Self::LimbMisplaced { .. } | Self::ClothLifted { .. } => DiagnosticKind::LimbMisplaced,
            Self::PieceResized { .. } | Self::ClothDistorted { .. } => DiagnosticKind::PieceResized,
            Self::NotConverged { .. } => DiagnosticKind::NotConverged,
            Self::UnitMismatch { .. } => DiagnosticKind::UnitMismatch,
            Self::FacingMismatch { .. } | Self::Turned { .. } | Self::LimbTurned { .. } => {
                DiagnosticKind::FacingMismatch
            }
            Self::SidesSwapped { .. } => DiagnosticKind::SidesSwapped,
            Self::More { like, .. } => like.kind(),
        }
    }

    /// How much it matters.
    pub fn severity(&self) -> Severity {
        match self {
            Self::SplitVertices { .. }
            | Self::DuplicateTriangle { .. }
            | Self::CollapsedTriangle { .. }
            | Self::FlatTriangle { .. }
            | Self::UnusedVertex { .. }
            | Self::LoosePiece { .. }
            | Self::KeptTogether { .. }
            | Self::WeldedNear { .. }
            | Self::TJunctions { .. }
            | Self::CarriedPiece { .. }
            | Self::NearContact { .. }
            | Self::SettingsAdjusted { .. }
            | Self::SolvedPosed { .. }
            | Self::Untangled { .. }
            | Self::FacingMismatch { told: Some(_), sure: true, gross: false, .. } => Severity::Note,
            Self::NonManifoldEdge { .. }
            | Self::SelfIntersection { strict: false, .. }
            | Self::BoneMoved { .. }
            | Self::CycleCut { .. }
            | Self::SourceDressed { .. }
            | Self::RimsNotFound { .. }
            | Self::CoarseCoordinates { .. }
            | Self::PinNotReached { .. }
            | Self::RigidGroupBent { .. }
            | Self::EndWithoutBone { .. }
            | Self::JointMisplaced { .. }
            | Self::JointsUnsure { .. }
            | Self::FollowerIntersects { .. }
            | Self::MorphNotSolved { .. }
            | Self::MorphIntersects { .. }
            | Self::WeightsContradict { .. }
            | Self::BonesUnclear { .. }
            | Self::ForeignPart { .. }
            | Self::OpeningCap { .. }
            | Self::ResultCrumpled { is_gross: false, .. }
            | Self::LimbMisplaced {
                place: LimbPlace::Swallowed { is_gross: false, .. } | LimbPlace::Under { .. },
                ..
            }
            | Self::PieceResized { is_gross: false, .. }
            | Self::NotConverged { .. }
            | Self::UnitMismatch { gross: false, .. }
            | Self::FacingMismatch { gross: false, .. }
            | Self::Turned { gross: false, .. }
            | Self::LimbTurned { gross: false, .. }
            | Self::SidesSwapped { sure: false, .. } => Severity::Warning,
            Self::SelfIntersection { strict: true, .. }
            | Self::AvatarPenetrates { .. }
            | Self::PoseBlocked { .. }
            | Self::ResultSelfIntersection { .. }
            | Self::ResultIntersection { .. }
            | Self::InflationHeld { .. }
            | Self::InflationSqueezed { .. }
            | Self::LimbMisplaced { .. }
            | Self::ResultCrumpled { is_gross: true, .. }
            | Self::PieceResized { is_gross: true, .. }
            | Self::ClothDistorted { .. }
            | Self::ClothLifted { .. }
            | Self::UnitMismatch { gross: true, .. }
            | Self::FacingMismatch { gross: true, .. }
            | Self::Turned { gross: true, .. }
            | Self::LimbTurned { gross: true, .. }
            | Self::SidesSwapped { sure: true, .. } => Severity::Error,
            Self::More { like, .. } => like.severity(),
        }
    }

    /// The elements, in the caller's indices: at most four.
    pub fn elements(&self) -> Vec<Element> {
        let triangle = |t: u32| Element::triangle(Subject::Garment, t);
        let vertex = |v: u32| Element::vertex(Subject::Garment, v);
        match *self {
            Self::SplitVertices { first: ref vertices, .. }
            | Self::WeldedNear { first: ref vertices, .. }
            | Self::TJunctions { first: ref vertices, .. }
            | Self::NearContact { ref vertices, .. } => vertices.iter().map(|&v| vertex(v)).collect(),
            Self::DuplicateTriangle { triangle: t, of } => [t, of].map(triangle).into(),
            Self::CollapsedTriangle { triangle: t, .. } | Self::FlatTriangle { triangle: t, .. } => vec![triangle(t)],
            Self::NonManifoldEdge { vertices, .. } => vertices.map(vertex).into(),
            Self::UnusedVertex { vertex: v }
            | Self::PinNotReached { vertex: v, .. }
            | Self::RigidGroupBent { vertex: v, .. } => vec![vertex(v)],
            Self::KeptTogether { vertex: v, triangle: t, .. } => vec![vertex(v), triangle(t)],
            Self::CarriedPiece { triangle: t, bone, .. } | Self::RimsNotFound { triangle: t, bone, .. } => {
                vec![triangle(t), bone.element()]
            }
            Self::LoosePiece { triangle: t, host, .. } => [t, host].map(triangle).into(),
            Self::SelfIntersection { triangles, .. }
            | Self::ResultSelfIntersection { triangles }
            | Self::ClothDistorted { triangles, .. }
            | Self::ResultCrumpled { first: triangles, .. }
            | Self::Untangled { first: triangles, .. } => triangles.map(triangle).into(),
            Self::BoneMoved { bone, ref triangles, .. } | Self::OpeningCap { bone, ref triangles } => {
                std::iter::once(bone.element()).chain(triangles.iter().map(|&t| triangle(t))).collect()
            }
            Self::CycleCut { ref triangles } => triangles.iter().map(|&t| triangle(t)).collect(),
            Self::AvatarPenetrates { garment, bone, avatar } => {
                std::iter::once(triangle(garment)).chain(bone.map(Bone::element)).chain([avatar]).collect()
            }
            Self::ResultIntersection { garment, avatar } => vec![triangle(garment), avatar],
            Self::InflationHeld { garment, part, .. } => {
                [triangle(garment), part.triangle].into_iter().chain(part.bone.map(Bone::element)).collect()
            }
            Self::InflationSqueezed { garment, parts: [a, b], .. } => vec![triangle(garment), a.triangle, b.triangle],
            Self::EndWithoutBone { bone, .. } | Self::LimbTurned { bone, .. } => vec![bone.element()],
            Self::JointMisplaced { skeleton, bone, .. } => vec![Element::bone(skeleton, bone.index)],
            Self::WeightsContradict { ref first, .. } => {
                first.iter().map(|&v| Element::vertex(Subject::TargetAvatar, v)).collect()
            }
            Self::BonesUnclear { vertices, .. } => vertices.map(|v| Element::vertex(Subject::TargetAvatar, v)).into(),
            Self::ForeignPart { whose, triangles: [first, last], .. } => {
                let triangles = if first == last { vec![first] } else { vec![first, last] };
                triangles.into_iter().map(|t| Element::triangle(whose, t)).collect()
            }
            Self::LimbMisplaced { bone, place } => {
                let element = match place {
                    LimbPlace::OutOfOpening { vertex: v } => vertex(v),
                    LimbPlace::Inside { triangle, .. }
                    | LimbPlace::Beside { triangle, .. }
                    | LimbPlace::Swallowed { triangle, .. }
                    | LimbPlace::Under { triangle, .. } => Element::triangle(Subject::TargetAvatar, triangle),
                };
                vec![bone.element(), element]
            }
            Self::PieceResized { triangle: t, .. } | Self::ClothLifted { triangle: t, .. } => vec![triangle(t)],
            Self::SourceDressed { triangles: [t, body], .. } => {
                vec![triangle(t), Element::triangle(Subject::SourceAvatar, body)]
            }
            Self::FollowerIntersects { ref first, .. } | Self::MorphIntersects { ref first, .. } => first.clone(),
            Self::CoarseCoordinates { .. }
            | Self::MorphNotSolved { .. }
            | Self::JointsUnsure { .. }
            | Self::PoseBlocked { .. }
            | Self::SolvedPosed { .. }
            | Self::SettingsAdjusted { .. }
            | Self::NotConverged { .. }
            | Self::UnitMismatch { .. }
            | Self::FacingMismatch { .. }
            | Self::Turned { .. }
            | Self::SidesSwapped { .. }
            | Self::More { .. } => Vec::new(),
        }
    }

    /// A distance; NaN where it has none.
    pub fn distance(&self) -> f64 {
        match *self {
            Self::LoosePiece { distance, .. }
            | Self::KeptTogether { distance, .. }
            | Self::CarriedPiece { distance, .. }
            | Self::PinNotReached { distance, .. }
            | Self::RigidGroupBent { distance, .. }
            | Self::JointMisplaced { distance, .. }
            | Self::InflationHeld { distance, .. } => distance,
            Self::EndWithoutBone { reach, .. } => reach,
            Self::ForeignPart { size, .. } => size,
            Self::NearContact { to_itself, to_avatar, .. } => to_itself.min(to_avatar),
            Self::CoarseCoordinates { min_separation } => min_separation,
            Self::InflationSqueezed { gap, .. } => gap.unwrap_or(0.0),
            _ => f64::NAN,
        }
    }
}
