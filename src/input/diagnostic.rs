//! Diagnostics about the inputs and the result: typed data, whose messages are made in [`super::diagnostic_text`]
//! alone, and whose kinds, severities and elements in [`super::diagnostic_facts`].

use super::coordinate_system::{Axis, AxisTurn, CoordinateSystem};

pub use super::element::{Element, ElementKind, Subject};

/// What a diagnostic is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DiagnosticKind {
    /// Garment vertices at equal positions, as along UV seams, that are welded.
    SplitVertices,
    /// A garment triangle with the corners of another, which counts once.
    DuplicateTriangle,
    /// A garment triangle without area.
    DegenerateTriangle,
    /// A garment edge with more than two triangles.
    NonManifoldEdge,
    /// A garment vertex that no triangle uses.
    UnusedVertex,
    /// A small piece of the garment, such as a button, that is attached to the nearest other piece.
    LoosePiece,
    /// A piece of the garment that is around no bone, or closed around one, and is carried by the body beside it.
    CarriedPiece,
    /// Two garment triangles that pass through each other, or touch, before anything has moved.
    SelfIntersection,
    /// Parts of the garment, or garment and skeleton, that are so near at the start that the minimum separation is lowered.
    NearContact,
    /// The shrunk avatar passes through the garment at the start.
    AvatarPenetrates,
    /// The coordinates in which the result is read are so coarse that the minimum separation is raised.
    CoarseCoordinates,
    /// The result intersects where the input did not.
    ResultIntersection,
    /// A pinned garment vertex ended away from its target.
    PinNotReached,
    /// A rigid group of garment vertices ended bent, because something stands in its way.
    RigidGroupBent,
    /// A part of the avatar that cannot grow because of the garment triangles in its way.
    InflationBlocked,
    /// A joint does not lie where the body wants it.
    JointMisplaced,
    /// Joints of a rig whose part of the body is a guess.
    JointsUnsure,
    /// The body could not be taken from the pose of the design to its own.
    PoseBlocked,
    /// The body was dressed in the pose of the design and brought back, after its own pose had failed.
    SolvedPosed,
    /// The body that the garment was made for took the garment on, through which it passes.
    SourceDressed,
    /// Skin weights bind vertices of the avatar to joints far away from them.
    WeightsContradict,
    /// A surface of the avatar without skin weights that far parts of the skeleton claim.
    BonesUnclear,
    /// A connected piece of the avatar's mesh that is no part of the body.
    ForeignPart,
    /// The inflation stalled with the caller's settings of the contact, and was done with others.
    SettingsAdjusted,
    /// Borders of the garment that lie on or beside another part of it, such as the fronts of a placket, and keep to it.
    KeptTogether,
    /// A closed piece of the garment around a bone of which no rim was found.
    RimsNotFound,
    /// Open seams whose sides are a hair apart, which are closed.
    WeldedNear,
    /// Vertices of the garment that lie on an edge of a triangle beside them which does not have them.
    TJunctions,
    /// The garment passed through itself in the design, and begins pulled apart there.
    Untangled,
    /// A cap that closes an opening of the garment where a bone leaves it, left out while the garment is fitted.
    OpeningCap,
    /// A limb that is on the other side of the garment than in the design.
    LimbMisplaced,
    /// A piece of the garment whose size is far from that of what it hangs on.
    PieceResized,
    /// A mesh that follows the garment meets the body or the garment.
    FollowerIntersects,
    /// A morph of the avatar to which the garment has no answer.
    MorphNotSolved,
    /// The garment's answer to a morph of the avatar meets itself or the body at a weight between 0 and 1.
    MorphIntersects,
    /// The fit ended by the limit of iterations or where no step made it better, not by its tolerance.
    NotConverged,
    /// An input is in another unit than the one that it belongs to.
    UnitMismatch,
    /// An input is in other axes than the one that it belongs to, or the target faces another way than the garment.
    FacingMismatch,
    /// Left and right of the target are exchanged, or it is mirrored.
    SidesSwapped,
}

/// How much a diagnostic matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// For information.
    Note,
    /// The result may be worse for it.
    Warning,
    /// There is no result because of it, or none that should be used unseen.
    Error,
}

/// A bone, and the joints at its ends. Both skeletons share the joints' indices; the bone's is the source skeleton's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bone {
    /// The caller's index in the source skeleton.
    pub index: u32,
    /// The joints at its ends.
    pub joints: [u32; 2],
}

impl Bone {
    pub(super) fn element(self) -> Element {
        Element::bone(Subject::SourceSkeleton, self.index)
    }
}

/// What is wrong with the place of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointFault {
    /// It is outside of the body.
    Outside,
    /// Its bone is no limb's: it runs between parts of the body, as one to a root on the floor does.
    Stray,
    /// Limbs branch off there and leave the body above it, so that what goes on beyond, as a head does, begins among them.
    Low,
    /// It is the last of its limb and at the tip, where that of the other skeleton is before it.
    AtTip,
    /// It is inside, but its bone leaves the body on the way to it.
    BoneOutside,
}

/// Why a piece of the avatar's mesh is no part of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreignness {
    /// It surrounds body and skeleton, as a dome or a box does.
    Surrounds,
    /// It is flat, and the body stands on it.
    Ground,
    /// It is far larger than the skeleton and around none of its bones.
    Huge,
    /// It is away from all bones and from the body.
    Detached,
}

/// A part of the avatar: what moves with one bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvatarPart {
    /// The bone; none where the part lies between bones that form a cycle.
    pub bone: Option<Bone>,
    /// A triangle of it, of the avatar or of a layer.
    pub triangle: Element,
    /// Where it belongs to a loose piece of the avatar, much smaller than the largest: how many triangles that has.
    pub loose: Option<usize>,
}

/// Where a limb is that should be elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LimbPlace {
    /// Beside an opening of the garment: nothing goes through it any more.
    OutOfOpening {
        /// A garment vertex of the opening.
        vertex: u32,
    },
    /// Shut up inside of the garment with its end.
    Inside {
        /// A triangle of the avatar that is inside.
        triangle: u32,
        /// The share of the end that is.
        share: f64,
    },
    /// Beside the garment, not inside.
    Beside {
        /// A triangle of the avatar that is beside.
        triangle: u32,
        /// The share of the part around the bone that is.
        share: f64,
    },
    /// No limb of its own, but a part that sticks out of the body, shut up in the garment without room for it in the design.
    Swallowed {
        /// A triangle of the avatar that is inside.
        triangle: u32,
        /// How many times farther from the bone it reaches than the garment does in the design.
        times: f64,
        /// Nobody would wear it.
        is_gross: bool,
    },
    /// Under the garment, where a loose sheet such as a strand of hair ends that begins outside of it.
    Under {
        /// A triangle of the avatar that is there.
        triangle: u32,
        /// The share of the sheet that is.
        share: f64,
    },
}

/// One diagnostic. Indices are the caller's; distances are in the normalised space, in which the skeleton is 2 long.
#[derive(Clone, Debug, PartialEq)]
pub enum Diagnostic {
    /// Garment vertices share their position with another.
    SplitVertices {
        /// Vertices that do.
        sharing: usize,
        /// All vertices.
        vertices: usize,
        /// Positions that they share.
        shared_places: usize,
        /// Positions in all: the vertices that are solved for.
        places: usize,
        /// The first of those that share, at most four.
        first: Vec<u32>,
    },
    /// A garment triangle has the corners of another.
    DuplicateTriangle {
        /// The copy.
        triangle: u32,
        /// The first with these corners.
        of: u32,
    },
    /// A garment triangle has corners at one position.
    CollapsedTriangle {
        /// The triangle.
        triangle: u32,
        /// Its vertices.
        corners: [u32; 3],
        /// It counts as an edge that collides; else it is left out.
        kept: bool,
    },
    /// A garment triangle has its corners on a line.
    FlatTriangle {
        /// The triangle.
        triangle: u32,
        /// Its vertices.
        corners: [u32; 3],
    },
    /// A garment edge has more than two triangles.
    NonManifoldEdge {
        /// The ends of the edge.
        vertices: [u32; 2],
        /// How many triangles it has.
        triangles: u32,
    },
    /// A garment vertex belongs to no triangle.
    UnusedVertex {
        /// The vertex.
        vertex: u32,
    },
    /// A loose piece of the garment is attached to the nearest other piece.
    LoosePiece {
        /// How many vertices the piece has.
        vertices: usize,
        /// A triangle of the piece.
        triangle: u32,
        /// The triangle nearest to it, of the piece that holds it.
        host: u32,
        /// The distance between the two.
        distance: f64,
    },
    /// Borders of the garment lie on or beside other parts of it, and are held there.
    KeptTogether {
        /// How many vertices.
        vertices: usize,
        /// The one that is nearest to what it is held to.
        vertex: u32,
        /// The triangle that holds it.
        triangle: u32,
        /// The largest distance over which one is held.
        distance: f64,
    },
    /// A piece of the garment is closed and around a bone, as where both sides of the cloth are modelled, and no rim of it was
    /// found.
    RimsNotFound {
        /// How many triangles it has.
        triangles: usize,
        /// The first of them.
        triangle: u32,
        /// A bone that it is around.
        bone: Bone,
    },
    /// Open seams of the garment whose sides are a hair apart are closed.
    WeldedNear {
        /// How many places they have in common, each of two vertices or more.
        places: usize,
        /// Vertices of the first of them, at most four.
        first: Vec<u32>,
        /// The widest gap, in the garment's unit.
        gap: f64,
    },
    /// Vertices of the garment lie on an edge of a triangle beside them which does not have them; they are held there.
    TJunctions {
        /// How many vertices.
        count: usize,
        /// The first of them, at most four.
        first: Vec<u32>,
        /// The triangle on whose edge the first lies.
        triangle: u32,
    },
    /// A piece of the garment is around no bone, or closed around one without an opening, and is carried along with the body
    /// beside it.
    CarriedPiece {
        /// How many vertices the piece has.
        vertices: usize,
        /// A triangle of the piece.
        triangle: u32,
        /// The bone nearest to it.
        bone: Bone,
        /// Its distance from the source body, or from the bone.
        distance: f64,
        /// The distance is that from the source body.
        from_body: bool,
        /// It keeps its shape.
        stiff: bool,
        /// It is closed around the bone.
        closed: bool,
    },
    /// Two garment triangles intersect before anything has moved.
    SelfIntersection {
        /// The triangles.
        triangles: [u32; 2],
        /// They only touch, within rounding.
        touches: bool,
        /// The option `strict` refuses it.
        strict: bool,
    },
    /// The garment is very near to itself or to the shrunk avatar at the start.
    NearContact {
        /// The garment vertices of the nearest pair.
        vertices: Vec<u32>,
        /// The smallest distance of the garment from itself; infinite where nothing is near.
        to_itself: f64,
        /// The smallest distance of the garment from the shrunk avatar; infinite where nothing is near.
        to_avatar: f64,
        /// The minimum separation with which the inflation begins.
        min_separation: f64,
    },
    /// The shrunk avatar would pass through the garment at a bone, and its start was moved out of the way.
    BoneMoved {
        /// The bone.
        bone: Bone,
        /// Garment triangles that the avatar would pass through there, at most three.
        triangles: Vec<u32>,
        /// How far it was displaced.
        aside: f64,
        /// The length between its joints that was retracted.
        between: f64,
        /// The length beyond its end that was retracted.
        beyond: f64,
        /// These two as shares of all that is there.
        shares: [f64; 2],
    },
    /// The shrunk avatar would pass through the garment between bones that form a cycle, which was cut open.
    CycleCut {
        /// Garment triangles that the avatar would pass through there, at most three.
        triangles: Vec<u32>,
    },
    /// The shrunk avatar passes through the garment, and no way around it was found.
    AvatarPenetrates {
        /// The garment triangle.
        garment: u32,
        /// The bone; none between bones that form a cycle.
        bone: Option<Bone>,
        /// The triangle of the avatar or of a layer.
        avatar: Element,
    },
    /// The coordinates in which the result is read are coarse.
    CoarseCoordinates {
        /// The minimum separation that it leads to.
        min_separation: f64,
    },
    /// Two garment triangles intersect in the result and did not at the start.
    ResultSelfIntersection {
        /// The triangles.
        triangles: [u32; 2],
    },
    /// A garment triangle intersects the avatar or a layer in the result.
    ResultIntersection {
        /// The garment triangle.
        garment: u32,
        /// The triangle of the avatar or of a layer.
        avatar: Element,
    },
    /// A pinned garment vertex ended away from its target.
    PinNotReached {
        /// The vertex.
        vertex: u32,
        /// How far away.
        distance: f64,
    },
    /// A rigid group of garment vertices ended bent.
    RigidGroupBent {
        /// Which group, in the order in which they were added, from 0.
        group: usize,
        /// The vertex that ended farthest from the rigid motion.
        vertex: u32,
        /// How far away.
        distance: f64,
    },
    /// The inflation stalled, and one part of the avatar pushes against the garment from one side.
    InflationHeld {
        /// The garment triangle that is pushed hardest.
        garment: u32,
        /// The part that pushes.
        part: AvatarPart,
        /// How many garment triangles it pushes against.
        held: usize,
        /// The distance between the two triangles now.
        distance: f64,
    },
    /// The inflation stalled, and the garment is between two parts of the avatar.
    InflationSqueezed {
        /// The garment triangle that is pushed hardest.
        garment: u32,
        /// The parts on its two sides.
        parts: [AvatarPart; 2],
        /// They are two sides of one part.
        same: bool,
        /// The distance of the two parts there at full size; none where they touch or overlap.
        gap: Option<f64>,
        /// What the option `inflation_dhat` was.
        inflation_dhat: f64,
    },
    /// The body goes on beyond the end of a bone, as a head without a bone of its own does.
    EndWithoutBone {
        /// The bone; its second joint is the one that the body goes on beyond.
        bone: Bone,
        /// How far it goes on.
        reach: f64,
        /// The body starts beyond the joint, as if a bone went on there.
        mended: bool,
    },
    /// A joint does not lie where the body wants it.
    JointMisplaced {
        /// The source or the target skeleton.
        skeleton: Subject,
        /// A bone that leads to it; its second joint is the one.
        bone: Bone,
        /// What is wrong with it.
        fault: JointFault,
        /// How far it is from the body, or from the better place.
        distance: f64,
        /// The same, in the caller's unit.
        length: f64,
        /// The same, as a share of the bone's length.
        share: f64,
        /// The better place, in the caller's coordinates; none where none is known.
        place: Option<[f64; 3]>,
        /// The joint is taken to lie there.
        mended: bool,
    },
    /// The body stands in another pose than the garment was designed in, and the garment does not let it go from that pose to
    /// its own: the result is in the pose of the design.
    PoseBlocked {
        /// How far it went, from 0 to 1.
        share: f64,
        /// The joints of the common skeleton whose parts the garment is between, at most two.
        joints: Vec<u32>,
    },
    /// The inflation stalled with the body in its own pose: it was posed as in the design, dressed there, and brought back.
    SolvedPosed {
        /// The share of its size beyond which it did not grow in its own pose.
        stalled_at: f64,
        /// The largest angle between the directions that a limb has in the two poses, in degrees.
        degrees: f64,
    },
    /// The garment was refused, and the source avatar passes through it: that body with the garment on took its place.
    SourceDressed {
        /// Pairs of a garment triangle and one of the source avatar that intersect.
        pairs: u64,
        /// The first of them.
        triangles: [u32; 2],
        /// The inflation had begun, and stalled.
        has_begun: bool,
    },
    /// A mesh that follows the garment passes through the body or the garment in the result, and did not in the design.
    FollowerIntersects {
        /// Which one, in the order in which they were added, from 0.
        follower: usize,
        /// How many of its triangles pass through the avatar or a layer, or are inside.
        body: usize,
        /// How many of its triangles pass through the garment.
        garment: usize,
        /// Of either, the first triangle and the one that it meets.
        first: Vec<Element>,
    },
    /// The garment does not let the body go to a morph, or cannot be verified there.
    MorphNotSolved {
        /// Which one, in the order in which they were added, from 0.
        morph: usize,
        /// What it is called.
        name: String,
        /// The weight up to which the garment gives way; 1 where its result intersects.
        weight: f64,
    },
    /// The garment's answer to a morph is good at weight 0 and 1, but not halfway.
    MorphIntersects {
        /// Which one, in the order in which they were added, from 0.
        morph: usize,
        /// What it is called.
        name: String,
        /// Pairs of triangles that intersect.
        pairs: usize,
        /// The first of them.
        first: Vec<Element>,
    },
    /// Which joints of the rigs are these places of the body is a guess.
    JointsUnsure {
        /// The places, such as "left shoulder".
        places: Vec<&'static str>,
    },
    /// Vertices of the avatar beside each other, without skin weights, belong to parts of the skeleton far from each other.
    BonesUnclear {
        /// How many edges lead from one part to the other.
        edges: usize,
        /// The ends of one of them.
        vertices: [u32; 2],
        /// The joints of the parts to which these belong.
        joints: [[u32; 2]; 2],
    },
    /// Skin weights bind vertices of the avatar to joints far away, while another bone is near.
    WeightsContradict {
        /// How many vertices.
        count: usize,
        /// Vertices with weights.
        weighted: usize,
        /// The first of them, at most four.
        first: Vec<u32>,
        /// The joint that the first one is bound to, and the joints of the bone nearest to it.
        example: Option<(u32, [u32; 2])>,
        /// The nearest bone decides for them; else the option `strict` takes the weights as they are.
        mended: bool,
    },
    /// A connected piece of an avatar's mesh is no part of the body.
    ForeignPart {
        /// The avatar to dress, or that which the garment was designed on.
        whose: Subject,
        /// How many triangles it has.
        count: usize,
        /// The first and the last of them.
        triangles: [u32; 2],
        /// Why it is no part of the body.
        reason: Foreignness,
        /// The longest side of its bounding box.
        size: f64,
        /// It is left out; else the option `strict` keeps it.
        left_out: bool,
    },
    /// The inflation stalled with the caller's settings, and was done with others.
    SettingsAdjusted {
        /// How far the avatar grew in the first attempt.
        stalled_at: f64,
        /// Attempts in all, the last one good.
        attempts: usize,
        /// What `inflation_dhat` was in it.
        inflation_dhat: f64,
        /// What `inflation_barrier_weight` was in it.
        inflation_barrier_weight: f64,
    },
    /// The garment passed through itself in the design, and begins pulled apart there, wholly or partly.
    Untangled {
        /// Pairs of triangles that intersected in the design and do not at the start.
        pairs: usize,
        /// Pairs that intersect still.
        remaining: usize,
        /// The first two of those pulled apart.
        first: [u32; 2],
    },
    /// A patch of triangles closes an opening of the garment where a bone leaves it. It is left out while the garment is
    /// fitted, and goes with its rim.
    OpeningCap {
        /// The bone.
        bone: Bone,
        /// The triangles, ascending.
        triangles: Vec<u32>,
    },
    /// A limb is on the other side of the garment than in the design.
    LimbMisplaced {
        /// The bone.
        bone: Bone,
        /// Where it is.
        place: LimbPlace,
    },
    /// A piece of the garment became larger or smaller than it should.
    PieceResized {
        /// A triangle of the piece.
        triangle: u32,
        /// How many triangles it has.
        triangles: usize,
        /// Its size beside that which it should have.
        scale: f64,
        /// Nobody would wear it.
        is_gross: bool,
    },
    /// Cloth that stands off the body over something that sticks out of it.
    ClothLifted {
        /// A garment triangle of it.
        triangle: u32,
        /// How many times farther from the bones than in the design, beside the cloth that lies nearest.
        times: f64,
    },
    /// The result passes through itself beside where it is, as the design does.
    ResultCrumpled {
        /// Pairs of triangles, beside each other, that do.
        pairs: usize,
        /// The first of them.
        first: [u32; 2],
        /// The share of the garment's area that takes part.
        share: f64,
        /// Nobody would wear it.
        is_gross: bool,
    },
    /// The cloth is drawn out in one place and has shrunk in another, so that nobody would wear it.
    ClothDistorted {
        /// How many times as large all but a twentieth of it is at least, and at most.
        scales: [f64; 2],
        /// A triangle of each size.
        triangles: [u32; 2],
    },
    /// The fit ended short of its tolerance.
    NotConverged {
        /// The iterations of the fit.
        iterations: u32,
        /// No step made it better; else it was the limit.
        stuck: bool,
    },
    /// An input is in another unit than the one that it belongs to.
    UnitMismatch {
        /// The input.
        subject: Subject,
        /// The one that it belongs to.
        against: Subject,
        /// How many times too large it is; below 1 where it is too small.
        factor: f64,
        /// Other ratios of units that suit as well, such as of a garment around few bones.
        or: Vec<f64>,
        /// The turn that it needs as well, in the caller's coordinates.
        turn: Option<AxisTurn>,
        /// It is refused.
        gross: bool,
    },
    /// An input is turned against the one that it belongs to.
    FacingMismatch {
        /// The input; the target avatar stands for its skeleton as well.
        subject: Subject,
        /// The one that it belongs to.
        against: Subject,
        /// The turn that mends it, in the caller's coordinates.
        turn: AxisTurn,
        /// The target's coordinate system that says so, where the target is solved for as if it had been told.
        told: Option<CoordinateSystem>,
        /// It is refused.
        gross: bool,
        /// Front and back of the bodies agree with it.
        sure: bool,
    },
    /// A mesh is turned against its skeleton by some angle.
    Turned {
        /// The mesh, or the skeleton where its meshes agree with each other.
        subject: Subject,
        /// The one that it belongs to.
        against: Subject,
        /// The axis of the turn that mends it, in the caller's coordinates.
        axis: Axis,
        /// Its angle.
        degrees: f64,
        /// It is refused.
        gross: bool,
    },
    /// A limb of the source skeleton is in another pose than the garment.
    LimbTurned {
        /// The bone at which it begins.
        bone: Bone,
        /// The joint about which it is turned.
        joint: u32,
        /// The middle of the opening that it should go through, in the caller's coordinates.
        opening: [f64; 3],
        /// By how many degrees.
        degrees: f64,
        /// It is refused.
        gross: bool,
    },
    /// Left and right of the target are exchanged, or it is mirrored.
    SidesSwapped {
        /// A pair of joints of the target that belong into each other's places.
        joints: [u32; 2],
        /// The target's coordinate system where it is not the names but the coordinates that are mirrored.
        mirrored: Option<CoordinateSystem>,
        /// All limbs are exchanged.
        all: bool,
        /// It is refused.
        sure: bool,
    },
    /// There are more of one sort than are listed.
    More {
        /// The first of them.
        like: Box<Diagnostic>,
        /// How many are not listed.
        count: usize,
    },
}

/// Largest number of diagnostics of one sort.
const MOST: usize = 1000;

impl Diagnostic {
    /// Adds a diagnostic for each of the first thousand items, all of one variant, and one more that counts the others.
    pub fn list<T>(diagnostics: &mut Vec<Self>, items: &[T], diagnostic: impl Fn(&T) -> Self) {
        let first = diagnostics.len();
        diagnostics.extend(items.iter().take(MOST).map(diagnostic));
        if items.len() > MOST {
            let like = Box::new(diagnostics[first].clone());
            diagnostics.push(Self::More { like, count: items.len() - MOST });
        }
    }
}
