//! Times, counts and distances that a session has measured.

use crate::solver::profile::Profile;

/// A term of the objective at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct TermReport {
    /// Name of the term.
    pub name: &'static str,
    /// Its value without its weight.
    pub value: f64,
    /// Its weight.
    pub weight: f64,
}

/// Work of one stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageReport {
    /// Wall seconds.
    pub seconds: f64,
    /// Newton iterations.
    pub iterations: u32,
    /// Numeric factorisations.
    pub factorisations: u32,
    /// Symbolic factorisations.
    pub analyses: u32,
    /// Where the time went.
    pub profile: Profile,
}

/// Intersecting pairs of triangles, counted by the exact verifier. The garment is welded: triangles that share a corner's
/// place share the corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Verification {
    /// Pairs of garment triangles.
    pub garment_garment: u64,
    /// Those of them that intersected or touched at the start, too.
    pub initial: u64,
    /// Pairs of a garment triangle and one of the avatar or a layer that it wears.
    pub garment_avatar: u64,
}

impl Verification {
    /// Pairs of garment triangles that were apart at the start.
    pub fn new_garment_garment(&self) -> u64 {
        self.garment_garment - self.initial
    }

    /// True where nothing intersects that did not from the start.
    pub fn is_clean(&self) -> bool {
        self.new_garment_garment() == 0 && self.garment_avatar == 0
    }
}

/// Everything measured so far. Lengths are in the normalised space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Stage PREPARE: set-up, and projection of the avatar onto the source skeleton.
    pub prepare: StageReport,
    /// Stage INFLATE.
    pub inflate: StageReport,
    /// Stage REPOSE, where the target stands in another pose than the source; with the time in which a second problem is set up
    /// for it.
    pub repose: StageReport,
    /// Stage FIT.
    pub fit: StageReport,
    /// Seconds in which rigs are read and matched and the target is posed, a part of PREPARE.
    pub rig_seconds: f64,
    /// Seconds in the exact verifier.
    pub verify_seconds: f64,
    /// Seconds until the distance field was built, in parallel with the inflation.
    pub field_seconds: f64,
    /// Seconds that the fit waited for the distance field.
    pub field_wait_seconds: f64,
    /// Wall seconds from the beginning of PREPARE to t = 1, the first garment on the whole avatar; 0 before that.
    pub feasible_seconds: f64,
    /// The terms of the objective at the present configuration.
    pub terms: Vec<TermReport>,
    /// Smallest distance between garment primitives within d-hat; infinite where there is none.
    pub min_distance_self: f64,
    /// Smallest distance between garment and avatar or layers within d-hat; infinite where there is none.
    pub min_distance_avatar: f64,
    /// Intersections counted at the end, when the end was reached.
    pub verification: Option<Verification>,
    /// The minimum separation in force: lower than the option's where the garment is nearer to something than that, higher
    /// where the coordinates of the result are coarse.
    pub min_separation: f64,
    /// Whether the fit ended by its tolerance, and not by the limit of iterations, nor because nothing moved any more.
    pub converged: bool,
    /// Whether the fit ended because no step decreased the objective, above its tolerance.
    pub stuck: bool,
    /// Pairs of garment triangles that intersect or touch as designed. They are pulled apart before the start, or exempted
    /// from contact until they separate.
    pub initial_self_intersections: usize,
    /// Garment vertices and triangles.
    pub garment_size: [usize; 2],
    /// Avatar vertices and triangles, without its layers.
    pub avatar_size: [usize; 2],
    /// Vertices and triangles of the avatar without its layers, subdivided onto the skeleton.
    pub projected_size: [usize; 2],
    /// Contact pairs closer than d-hat.
    pub active_contacts: usize,
    /// Norm of the gradient at the last linear system.
    pub gradient_norm: f64,
    /// Inflation parameter.
    pub t: f64,
    /// Threads of the session.
    pub threads: usize,
    /// Bytes that the session's arrays take.
    pub memory: u64,
}
