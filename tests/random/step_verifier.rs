//! The exact verifier, applied to a session after every step.

use std::collections::BTreeSet;

use bespoke::contact::PairType;
use bespoke::control::{Cancel, Stage};
use bespoke::error::Result;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::Session;
use bespoke::stage::setup::problem::Problem;
use bespoke::verify::intersections;

use testing::scene::Scene;

type Pairs = BTreeSet<[u32; 2]>;

/// Knows which pairs of triangles intersect at the start, or touch but for rounding; no other pair ever may.
pub struct StepVerifier<'a> {
    pub scene: &'a Scene,
    pub problem: Problem,
    pub garment: Pairs,
    pub avatar: Pairs,
}

fn pairs(a: &TriangleMesh, b: Option<&TriangleMesh>) -> Pairs {
    intersections(a, b, usize::MAX).expect("finite meshes").pairs.into_iter().collect()
}

/// Smallest distance of a corner of one triangle from the other, or of two sides.
fn distance(mesh: &TriangleMesh, pair: [u32; 2]) -> f64 {
    let [s, t] = pair.map(|t| mesh.triangles[t as usize].map(|v| mesh.positions[v as usize]));
    let mut nearest = f64::INFINITY;
    for i in 0..3 {
        let sides = (0..3).map(|j| (PairType::EdgeEdge, [s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]]));
        let corners = [[s[i], t[0], t[1], t[2]], [t[i], s[0], s[1], s[2]]].map(|x| (PairType::PointTriangle, x));
        for (kind, x) in sides.chain(corners) {
            nearest = nearest.min(kind.separation(&x).squared.sqrt());
        }
    }
    nearest
}

impl<'a> StepVerifier<'a> {
    /// # Errors
    /// Where the session refuses the scene in `prepare`.
    pub fn new(scene: &'a Scene) -> Result<Self> {
        let problem = scene.problem()?;
        let mut verifier = Self { scene, problem, garment: pairs(&scene.garment, None), avatar: Pairs::new() };
        let start = verifier.source_positions();
        let objective = verifier.problem.inflation_objective(&scene.options, &Cancel::new(), &mut Vec::new())?;
        for &pair in objective.contact.exempt_pairs().triangle_pairs() {
            let pair = pair.map(|t| verifier.problem.weld.triangle_of[t as usize]);
            let touches = distance(&start, pair) < 2e-12;
            assert!(verifier.garment.contains(&pair) || touches, "triangles {pair:?} are exempt, but are apart");
            verifier.garment.insert(pair);
        }
        verifier.avatar = verifier.against_avatar(start, 0.0);
        Ok(verifier)
    }

    /// The garment as designed, normalised.
    fn source_positions(&self) -> TriangleMesh {
        let normalised = |&p| {
            self.problem.source_normalization.normalise(self.scene.source_coordinate_system.position_to_internal(p))
        };
        TriangleMesh {
            positions: self.scene.garment.positions.iter().map(normalised).collect(),
            triangles: self.scene.garment.triangles.clone(),
        }
    }

    /// Pairs of a normalised garment and the projected avatar at `t`, subdivided as the solver has it.
    fn against_avatar(&self, garment: TriangleMesh, t: f64) -> Pairs {
        let projected = &self.problem.projected;
        let ends = projected.start.iter().zip(&projected.end);
        let body = TriangleMesh {
            positions: ends.map(|(a, b)| a.lerp(*b, t)).collect(),
            triangles: projected.triangles.clone(),
        };
        pairs(&garment, Some(&body))
    }

    /// The garment as it is now against itself and the avatar at its present t: a message where a new pair intersects.
    pub fn verify_step(&self, session: &Session) -> std::result::Result<(), String> {
        let positions = session.garment_positions().map_err(|e| format!("not readable: {e}"))?;
        let now = TriangleMesh { positions, triangles: self.scene.garment.triangles.clone() };
        let t = session.report().t;
        let at = format!("{:?} at t = {t}", session.stage());
        let new: Vec<_> = pairs(&now, None).difference(&self.garment).copied().collect();
        if !new.is_empty() {
            return Err(format!("{at}: garment triangles {new:?} intersect, which did not at the start"));
        }
        let new: Vec<_> = if t < 1.0 {
            let normalised = |&p| {
                self.problem.target_normalization.normalise(self.scene.target_coordinate_system.position_to_internal(p))
            };
            let garment = TriangleMesh { positions: now.positions.iter().map(normalised).collect(), ..now };
            self.against_avatar(garment, t).difference(&self.avatar).copied().collect()
        } else {
            pairs(&now, Some(&self.scene.avatar)).into_iter().collect()
        };
        if new.is_empty() { Ok(()) } else { Err(format!("{at}: garment and avatar triangles {new:?} intersect")) }
    }

    /// The result as a caller reads it.
    pub fn verify_result(&self, session: &Session) -> std::result::Result<(), String> {
        assert_eq!(session.stage(), Stage::Done);
        let round = |p| self.scene.precision.round(p);
        let positions = session.garment_positions().map_err(|e| e.message)?.into_iter().map(round).collect();
        let result = TriangleMesh { positions, triangles: self.scene.garment.triangles.clone() };
        let new: Vec<_> = pairs(&result, None).difference(&self.garment).copied().collect();
        let penetrating = pairs(&result, Some(&self.scene.avatar));
        if new.is_empty() && penetrating.is_empty() {
            return Ok(());
        }
        Err(format!("the result intersects: garment {new:?}, garment and avatar {penetrating:?}"))
    }
}
