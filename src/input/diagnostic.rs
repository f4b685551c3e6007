//! What is worth knowing about the inputs and the result, item by item: a sentence for people, elements for tools.

use std::fmt;

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

/// What a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FindingKind {
    /// Garment vertices in one place, as along UV seams, that move as one.
    SplitVertices,
    /// A garment triangle with the corners of another, which counts once.
    DuplicateTriangle,
    /// A garment triangle without area.
    DegenerateTriangle,
    /// A garment edge with more than two triangles.
    NonManifoldEdge,
    /// A garment vertex that no triangle uses.
    UnusedVertex,
    /// A small piece of the garment, such as a button, that is held to the piece beside it.
    LoosePiece,
    /// Two garment triangles that pass through each other, or touch, before anything has moved.
    SelfIntersection,
    /// Parts of the garment, or garment and skeleton, that are so near at the start that the minimum separation is lowered.
    NearContact,
    /// The shrunk avatar passes through the garment at the start.
    AvatarPenetrates,
    /// The coordinates in which the result is read are so coarse that the garment keeps a wider gap.
    CoarseCoordinates,
    /// The result intersects where the input did not.
    ResultIntersection,
    /// A pinned garment vertex ended away from its place.
    PinNotReached,
    /// A rigid group of garment vertices ended bent, because something stands in its way.
    RigidGroupBent,
}

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Good to know.
    Note,
    /// The result may be worse for it.
    Warning,
    /// There is no result because of it.
    Error,
}

/// One finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is about.
    pub kind: FindingKind,
    /// How much it matters.
    pub severity: Severity,
    /// The elements, in the caller's indices: at most four.
    pub elements: Vec<Element>,
    /// A distance in the normalised space (the skeleton is 2 long), NaN where the finding has none.
    pub distance: f64,
    /// One sentence for a person.
    pub sentence: String,
}

impl Finding {
    /// A finding without a distance.
    pub fn new(kind: FindingKind, severity: Severity, elements: &[Element], sentence: impl Into<String>) -> Self {
        Self { kind, severity, elements: elements.to_vec(), distance: f64::NAN, sentence: sentence.into() }
    }
}

/// Largest number of findings for one reason.
const MOST: usize = 1000;

/// Adds a finding for each of the first [`MOST`] items, and one more that counts the others: "100 more `others`".
pub fn describe<T>(findings: &mut Vec<Finding>, items: &[T], finding: impl Fn(&T) -> Finding, others: &str) {
    let first = findings.len();
    findings.extend(items.iter().take(MOST).map(finding));
    if items.len() > MOST {
        let Finding { kind, severity, .. } = findings[first];
        findings.push(Finding::new(kind, severity, &[], format!("{} more {others}", items.len() - MOST)));
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence)
    }
}
