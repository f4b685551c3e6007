//! What a diagnostic points at: an element of one of the caller's inputs.

/// Which of the caller's inputs an element belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Subject {
    /// The garment.
    Garment,
    /// The body to dress.
    TargetAvatar,
    /// The body that the garment was designed on.
    SourceAvatar,
    /// The skeleton that the garment was designed on.
    SourceSkeleton,
    /// The skeleton of the body to dress.
    TargetSkeleton,
    /// A garment that the body wears already: which one, in the order in which they were added, from 0.
    Layer(u32),
    /// A mesh that follows the garment: which one, in the order in which they were added, from 0.
    Follower(u32),
}

/// What an index counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ElementKind {
    /// Vertices of a mesh.
    Vertex,
    /// Triangles of a mesh.
    Triangle,
    /// Bones of a skeleton.
    Bone,
}

/// One element of an input, by the caller's own index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Element {
    /// The input.
    pub subject: Subject,
    /// What `index` counts.
    pub kind: ElementKind,
    /// The caller's index.
    pub index: u32,
}

impl Element {
    /// A triangle of `subject`.
    pub fn triangle(subject: Subject, index: u32) -> Self {
        Self { subject, kind: ElementKind::Triangle, index }
    }

    /// A vertex of `subject`.
    pub fn vertex(subject: Subject, index: u32) -> Self {
        Self { subject, kind: ElementKind::Vertex, index }
    }

    /// A bone of `subject`.
    pub fn bone(subject: Subject, index: u32) -> Self {
        Self { subject, kind: ElementKind::Bone, index }
    }
}
