//! What a session has measured about itself.

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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageReport {
    /// Wall seconds.
    pub seconds: f64,
    /// Newton iterations.
    pub iterations: u32,
    /// Numeric factorisations.
    pub factorisations: u32,
    /// Symbolic factorisations.
    pub analyses: u32,
    /// Seconds in assembly, in linear algebra, in broad phase and continuous collision detection, in line search.
    pub kernels: [f64; 4],
}

/// Intersecting pairs of triangles, counted by the exact verifier.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Verification {
    /// Pairs of garment triangles.
    pub garment_garment: u64,
    /// Pairs of a garment and an avatar triangle.
    pub garment_avatar: u64,
}

impl Verification {
    /// True where nothing intersects.
    pub fn is_clean(&self) -> bool {
        self.garment_garment == 0 && self.garment_avatar == 0
    }
}

/// Everything measured so far. Lengths are in the normalised space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Projection and set-up.
    pub prepare: StageReport,
    /// Step 2.
    pub inflate: StageReport,
    /// Step 3.
    pub fit: StageReport,
    /// Seconds in the exact verifier.
    pub verify_seconds: f64,
    /// Seconds until the distance field was built, beside the inflation.
    pub field_seconds: f64,
    /// The terms of the objective at the present configuration.
    pub terms: Vec<TermReport>,
    /// Smallest distance between garment primitives that d-hat still sees; infinite where there is none.
    pub min_distance_self: f64,
    /// Smallest distance between garment and avatar that d-hat still sees; infinite where there is none.
    pub min_distance_avatar: f64,
    /// Intersections counted at the end, when the end was reached.
    pub verification: Option<Verification>,
    /// The separation floor in force, lower than the option's where the input is nearer than that.
    pub separation_floor: f64,
    /// Whether Step 3 ended by its tolerance, and not by the limit of iterations.
    pub converged: bool,
    /// Garment vertices and triangles.
    pub garment_size: [usize; 2],
    /// Avatar vertices and triangles.
    pub avatar_size: [usize; 2],
    /// Vertices and triangles of the avatar subdivided onto the skeleton.
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
