//! Meshes that follow the garment without being solved: levels of detail, trims, badges, collision proxies.

use std::sync::Arc;

use glam::DVec3;

use super::Session;
use super::inputs::{Inputs, mesh_to_internal};
use super::snapshot::Snapshot;
use crate::control::{Cancel, Cancelled, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::follow::binding::Place;
use crate::follow::surface::MovedSurface;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::triangle_motion::TriangleMotion;
use crate::input::diagnostic::{Diagnostic, Element, Subject};
use crate::input::precision::Precision;
use crate::input::skin::SkinWeights;
use crate::rig::weights::limited;
use crate::sdf::Field;
use crate::verify::intersections_with_cancel;

/// What is nearer to the garment than this in the design, in the normalised space, lies on it: that it touches the garment in
/// the result is no fault.
const LIES_ON: f64 = 1e-3;

/// What is this far inside of the body is swallowed by it, not only beside a facet of it.
const INSIDE: f64 = 2e-3;

/// A follower where the result has it.
#[derive(Clone, Debug)]
pub(super) struct Follower {
    /// Vertices in the target coordinate system, rounded to the precision in which the mesh was given.
    positions: Vec<DVec3>,
    /// Triangle of the welded garment and barycentric coordinates for each vertex.
    places: Vec<Option<([u32; 3], [f64; 3])>>,
}

impl Session {
    /// A mesh that follows the garment: it is bound to the garment as designed, in whose coordinate system it is, and carried to
    /// the result. One more; they are numbered from 0.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn add_follower(&mut self, mesh: TriangleMesh, precision: Precision) -> Result<()> {
        self.setting("a follower")?;
        mesh.check(&format!("follower {}", self.inputs.followers.len()))?;
        self.inputs.followers.push((Arc::new(mesh), precision));
        Ok(())
    }

    /// Removes all followers.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_followers(&mut self) -> Result<()> {
        self.setting("the followers")?;
        self.inputs.followers.clear();
        Ok(())
    }

    /// The vertices of a follower at the result, in the target coordinate system. Where it meets the body or the garment there,
    /// and did not in the design, a diagnostic says so.
    ///
    /// # Errors
    /// `InvalidState` before the end, `InvalidArgument` where there is no such follower.
    pub fn follower_positions(&self, index: usize) -> Result<Vec<DVec3>> {
        Ok(self.follower(index)?.positions.clone())
    }

    /// Skin weights of a follower's vertices: those of the garment where they are bound, each vertex with at most so many joints.
    ///
    /// # Errors
    /// As [`Self::follower_positions`] and [`Self::garment_skin`].
    pub fn follower_skin(&self, index: usize, influences: usize) -> Result<SkinWeights> {
        let follower = self.follower(index)?;
        // Refused with its words where that has none.
        self.garment_skin(influences)?;
        let whole = &self.whole_skin()?.weights;
        let weld = &self.readable()?.problem.weld;
        let rows = weld.vertex_of.iter().map(|&v| whole.weights(v as usize).to_vec());
        let welded = SkinWeights::from_rows(whole.joint_count(), rows);
        Ok(limited(&welded.at(&follower.places), influences))
    }

    fn follower(&self, index: usize) -> Result<&Follower> {
        let count = self.inputs.followers.len();
        if index >= count {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("follower {index}: there are {count}; they are added before prepare and count from 0"),
            ));
        }
        match self.followers.get(index) {
            Some(follower) if self.stage == Stage::Done => Ok(follower),
            _ => Err(Error::new(
                ErrorKind::InvalidState,
                format!("follower {index}: there is no result yet; run the session to its end first"),
            )),
        }
    }

    /// Carries the followers to the result, and says where they fail.
    pub(super) fn carry_followers(&mut self) -> Result<()> {
        if self.inputs.followers.is_empty() {
            return Ok(());
        }
        let (Some(snapshot), Some(pool)) = (&self.snapshot, &self.pool) else { return Ok(()) };
        let (snapshot, inputs, stop) = (snapshot.clone(), self.inputs.clone(), Cancel::new());
        let (cancel, control) = (stop.clone(), &self.control);
        if control.is_cancelled() {
            return Err(Cancelled.into());
        }
        let field = self.run.as_ref().and_then(|run| run.distance.as_ref()).map(|(field, _)| field.clone());
        let job = move || snapshot.followers(&inputs, field.as_deref(), &cancel);
        let (followers, found) = pool.run(|| control.is_cancelled(), &stop, job)??;
        self.followers = followers;
        Diagnostic::list(&mut self.diagnostics, &found, Clone::clone);
        Ok(())
    }
}

impl Snapshot {
    fn followers(
        &self,
        inputs: &Inputs,
        field: Option<&Field>,
        cancel: &Cancel,
    ) -> Result<(Vec<Follower>, Vec<Diagnostic>)> {
        let mut surface = self.moved_surface(inputs)?;
        // Caps take no part in the verification, and what is bound to them goes along all the same.
        surface.triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
        let surface = MovedSurface::new(surface.rest, surface.now, surface.triangles);
        let motions = surface.vertex_motions();
        let (mut followers, mut found) = (Vec::new(), Vec::new());
        for (index, (mesh, precision)) in inputs.followers.iter().enumerate() {
            cancel.check()?;
            let carried = Carried::new(self, inputs, &surface, &motions, mesh, *precision);
            found.extend(carried.fault(index, self, inputs, field, cancel)?);
            followers.push(carried.follower);
        }
        Ok((followers, found))
    }
}

/// A follower on its way from the design to the result.
struct Carried {
    follower: Follower,
    triangles: Vec<[u32; 3]>,
    /// In the normalised space, as designed.
    designed: Vec<DVec3>,
    /// In the normalised space, at the result.
    carried: Vec<DVec3>,
    /// How far each vertex was from the garment in the design.
    distances: Vec<f64>,
    precision: Precision,
}

impl Carried {
    fn new(
        snapshot: &Snapshot,
        inputs: &Inputs,
        surface: &MovedSurface,
        motions: &[TriangleMotion],
        mesh: &TriangleMesh,
        precision: Precision,
    ) -> Self {
        let internal = mesh_to_internal(&inputs.source_coordinate_system, mesh);
        let designed = snapshot.problem.source_normalization.normalise_all(&internal.positions);
        let places = Place::of_all(surface, &designed);
        let now = |(place, &p): (&Option<Place>, &DVec3)| place.map_or(p, |place| place.now(surface, motions));
        let carried: Vec<DVec3> = places.iter().zip(&designed).map(now).collect();
        let positions = carried.iter().map(|&p| precision.round(snapshot.restored(p))).collect();
        let distances = places.iter().map(|place| place.map_or(f64::INFINITY, |place| place.distance())).collect();
        let places = places.iter().map(|place| place.map(|place| (place.triangle, place.weights))).collect();
        Self {
            follower: Follower { positions, places },
            triangles: mesh.triangles.clone(),
            designed,
            carried,
            distances,
            precision,
        }
    }

    /// The triangles that are in the body or pass through the garment in the result, and are not in the design. `field` is the
    /// distance of the body.
    fn fault(
        &self,
        index: usize,
        snapshot: &Snapshot,
        inputs: &Inputs,
        field: Option<&Field>,
        cancel: &Cancel,
    ) -> Result<Option<Diagnostic>> {
        let problem = &snapshot.problem;
        let mesh = |positions: Vec<DVec3>| TriangleMesh { positions, triangles: self.triangles.clone() };
        let (before, now) = (mesh(self.designed.clone()), mesh(self.follower.positions.clone()));
        let hits = |a: &TriangleMesh, b: &TriangleMesh| -> Result<Vec<[u32; 2]>> {
            Ok(intersections_with_cancel(a, Some(b), usize::MAX, cancel)?.pairs)
        };
        let mut worn_through = vec![false; self.triangles.len()];
        if let Some(worn_by) = &inputs.source_avatar {
            let mut body = mesh_to_internal(&inputs.source_coordinate_system, worn_by);
            body.positions = problem.source_normalization.normalise_all(&body.positions);
            hits(&before, &body)?.iter().for_each(|pair| worn_through[pair[0] as usize] = true);
        }
        let all_inside = |t: usize, points: &[DVec3], distance: &dyn Fn(DVec3) -> f64| {
            self.triangles[t].iter().all(|&v| distance(points[v as usize]) < -INSIDE)
        };
        let mut swallowed = Vec::new();
        if let Some(field) = field {
            let source = problem.source_body.as_ref();
            let is_new = |t: &usize| {
                all_inside(*t, &self.carried, &|p| field.value(p))
                    && !source.is_some_and(|body| all_inside(*t, &self.designed, &|p| body.signed_distance(p)))
            };
            swallowed.extend((0..self.triangles.len()).filter(is_new).map(|t| t as u32));
        }
        let mut body = hits(&now, &snapshot.body.mesh)?;
        body.retain(|pair| !worn_through[pair[0] as usize]);
        let mut in_body: Vec<u32> = body.iter().map(|pair| pair[0]).chain(swallowed).collect();
        in_body.sort_unstable();
        in_body.dedup();

        let garment = |x: Vec<DVec3>| TriangleMesh { positions: x, triangles: problem.triangles.clone() };
        let lies_on = |t: usize| self.triangles[t].iter().any(|&v| self.distances[v as usize] < LIES_ON);
        let mut touched: Vec<bool> = (0..self.triangles.len()).map(lies_on).collect();
        hits(&before, &garment(problem.rest.clone()))?.iter().for_each(|pair| touched[pair[0] as usize] = true);
        let read = snapshot.x.iter().map(|&p| self.precision.round(snapshot.restored(p))).collect();
        let own = hits(&now, &garment(read))?;
        let own: Vec<[u32; 2]> = own.into_iter().filter(|pair| !touched[pair[0] as usize]).collect();

        let mut in_garment: Vec<u32> = own.iter().map(|pair| pair[0]).collect();
        in_garment.dedup();
        if in_body.is_empty() && in_garment.is_empty() {
            return Ok(None);
        }
        let element = |t: u32| Element::triangle(Subject::Follower(index as u32), t);
        let first_body = match body.first() {
            Some(&[own, other]) => vec![element(own), snapshot.body.triangle(other)],
            None => in_body.first().map(|&t| element(t)).into_iter().collect(),
        };
        let first_own = own.first().map(|&[own, other]| {
            [element(own), Element::triangle(Subject::Garment, problem.weld.triangle_of[other as usize])]
        });
        Ok(Some(Diagnostic::FollowerIntersects {
            follower: index,
            body: in_body.len(),
            garment: in_garment.len(),
            first: first_body.into_iter().chain(first_own.into_iter().flatten()).collect(),
        }))
    }
}
