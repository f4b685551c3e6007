//! `bespoke check`: intersections of garments and body, in the bind pose and in poses of animations.

use std::collections::HashSet;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::weld::Weld;
use bespoke::verify::intersections;
use glam::DVec3;
use serde::Serialize;

use crate::args::Check;
use crate::bodies::joined;
use crate::caps;
use crate::failure::{Failure, Result};
use crate::figure::{Choice, Figure, Part};
use crate::moments::{Meshes, moments};
use crate::outfit::{self, Garment};
use crate::parts::pattern::Patterns;
use crate::parts::{Kind, Role};
use crate::report;

/// What was counted in one pose.
#[derive(Clone, Debug, Serialize)]
pub struct Counted {
    /// In words.
    pub pose: String,
    /// The animation; none of the bind pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub animation: Option<String>,
    /// Seconds from its start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Pairs of triangles of each garment that intersect.
    pub garments: Vec<CountedGarment>,
}

/// Intersecting pairs of triangles of one garment, those at its caps apart.
#[derive(Clone, Debug, Serialize)]
pub struct CountedGarment {
    /// The garment.
    pub name: String,
    /// With itself.
    pub own: u64,
    /// With the body.
    pub body: u64,
    /// Of these, where the pose makes the body pass through itself: there is no room for a garment.
    pub folds: u64,
    /// With garments listed before it.
    pub others: u64,
    /// Pairs with a triangle that closes an opening, through which the body goes by design; in none of the other counts.
    pub caps: u64,
}

impl CountedGarment {
    fn is_clean(&self) -> bool {
        self.own + self.body + self.others == 0
    }

    fn in_words(&self) -> String {
        let Self { own, body, folds, others, caps, .. } = self;
        let folds = if *folds > 0 { format!(" ({folds} where the body folds)") } else { String::new() };
        let caps = if *caps > 0 { format!("; {caps} at caps of its openings are left out") } else { String::new() };
        format!("{own} with itself, {body} with the body{folds}, {others} with other garments{caps}")
    }
}

/// Counts, and says what was counted; exit code 3 where anything intersects.
///
/// # Errors
/// Where the file cannot be read or has no garment, or not the animation.
pub fn run(args: &Check) -> Result<u8> {
    let garments = args.nodes.as_deref().map(Patterns::parse).transpose().map_err(Failure::usage)?;
    let figure = Figure::open(&args.file, Role::Outfit, &Choice { garments, body: None })?;
    let garments = outfit::need_garments(&figure)?;
    let poses = match &args.animation {
        Some(name) => moments(&figure, name.as_deref(), args.moments as usize)?,
        None => Vec::new(),
    };
    let mut scene = Scene::new(&figure, &garments);
    let mut counted =
        vec![Counted { pose: "bind pose".into(), animation: None, time: None, garments: scene.count(None)? }];
    if !poses.is_empty() {
        let meshes = Meshes::of(&figure)?;
        for moment in poses {
            let places = meshes.in_pose(&figure, &moment.pose)?;
            counted.push(Counted {
                pose: format!("{} at {:.3} s", moment.animation, moment.time),
                animation: Some(moment.animation),
                time: Some(moment.time),
                garments: scene.count(Some(&places))?,
            });
        }
    }
    if args.json {
        print!("{}", report::text(&counted)?);
    } else {
        in_words(&counted).iter().for_each(|line| println!("{line}"));
    }
    let clean = counted.iter().flat_map(|pose| &pose.garments).all(CountedGarment::is_clean);
    Ok(if clean { 0 } else { 3 })
}

/// A line for each garment in each pose; where there are several animations, for each of them the pose with most.
fn in_words(counted: &[Counted]) -> Vec<String> {
    let line = |pose: &str, garment: &CountedGarment| format!("{pose}: {}: {}", garment.name, garment.in_words());
    let mut lines = Vec::new();
    let clips: Vec<&[Counted]> = counted.chunk_by(|a, b| a.animation == b.animation).collect();
    for clip in &clips {
        if clips.len() <= 2 {
            lines.extend(clip.iter().flat_map(|pose| pose.garments.iter().map(|garment| line(&pose.pose, garment))));
            continue;
        }
        for k in 0..clip[0].garments.len() {
            let sum = |pose: &&Counted| {
                let garment = &pose.garments[k];
                garment.own + garment.body + garment.others
            };
            // The first of those with most.
            if let Some(worst) = clip.iter().rev().max_by_key(sum) {
                let most =
                    if clip.len() > 1 { format!(", the worst of {} moments", clip.len()) } else { String::new() };
                lines.push(line(&format!("{}{most}", worst.pose), &worst.garments[k]));
            }
        }
    }
    lines
}

/// Some parts as one surface. Triangles on both sides of a seam share its vertices, which files split.
struct Surface<'a> {
    parts: Vec<&'a Part>,
    weld: Weld,
}

impl<'a> Surface<'a> {
    fn new(parts: Vec<&'a Part>, joints: usize) -> Self {
        let weld = Weld::new(&joined(parts.iter().copied(), joints).0.mesh).0;
        Self { parts, weld }
    }

    /// In the bind pose, or with the vertices of all meshes in their `places`. What is one vertex in the bind pose stays one.
    fn in_pose(&self, places: Option<&[Vec<DVec3>]>) -> TriangleMesh {
        let mut mesh = self.weld.mesh.clone();
        if let Some(places) = places {
            let place = |part: &&'a Part| part.vertices.iter().map(|&v| places[part.instance][v as usize]);
            let all: Vec<DVec3> = self.parts.iter().flat_map(place).collect();
            mesh.positions = self.weld.vertex_of.iter().map(|&v| all[v as usize]).collect();
        }
        mesh
    }
}

/// What is counted in all poses.
struct Scene<'a> {
    figure: &'a Figure,
    body: Surface<'a>,
    /// Pairs of the body's triangles that intersect in the bind pose; asked for once.
    body_bound: Option<HashSet<[u32; 2]>>,
    garments: Vec<(&'a Garment, Surface<'a>)>,
    /// For each triangle of each garment whether it is of a cap; found out where it matters.
    caps: Vec<Option<Vec<bool>>>,
}

impl<'a> Scene<'a> {
    fn new(figure: &'a Figure, garments: &'a [Garment]) -> Self {
        let joints = figure.rig.joints.len();
        let surface = |garment: &'a Garment| {
            let parts = garment.parts.iter().map(|&part| &figure.parts[part]).collect();
            (garment, Surface::new(parts, joints))
        };
        Self {
            figure,
            body: Surface::new(figure.of(Kind::Body).collect(), joints),
            body_bound: None,
            garments: garments.iter().map(surface).collect(),
            caps: vec![None; garments.len()],
        }
    }

    fn count(&mut self, places: Option<&[Vec<DVec3>]>) -> Result<Vec<CountedGarment>> {
        let body = self.body.in_pose(places);
        let meshes: Vec<TriangleMesh> = self.garments.iter().map(|(_, surface)| surface.in_pose(places)).collect();
        let mut folded: Option<Vec<bool>> = None;
        let mut counted = Vec::new();
        for (k, cloth) in meshes.iter().enumerate() {
            let mut line =
                CountedGarment { name: self.garments[k].0.name.clone(), own: 0, body: 0, folds: 0, others: 0, caps: 0 };
            for [s, t] in pairs(cloth, None)? {
                let at_cap = self.is_cap(k, s) || self.is_cap(k, t);
                *(if at_cap { &mut line.caps } else { &mut line.own }) += 1;
            }
            for [s, t] in pairs(cloth, Some(&body))? {
                if self.is_cap(k, s) {
                    line.caps += 1;
                    continue;
                }
                line.body += 1;
                if places.is_some() {
                    let folded = match &folded {
                        Some(known) => known,
                        None => folded.insert(self.folded(&body)?),
                    };
                    line.folds += u64::from(folded[t as usize]);
                }
            }
            for (other, mesh) in meshes[..k].iter().enumerate() {
                for [s, t] in pairs(cloth, Some(mesh))? {
                    let at_cap = self.is_cap(k, s) || self.is_cap(other, t);
                    *(if at_cap { &mut line.caps } else { &mut line.others }) += 1;
                }
            }
            counted.push(line);
        }
        Ok(counted)
    }

    /// Which triangles of the body pass through others of it, and did not in the bind pose.
    fn folded(&mut self, body: &TriangleMesh) -> Result<Vec<bool>> {
        let bound = match &self.body_bound {
            Some(known) => known,
            None => self.body_bound.insert(pairs(&self.body.weld.mesh, None)?.into_iter().collect()),
        };
        let mut folded = vec![false; body.triangles.len()];
        let fresh = pairs(body, None)?.into_iter().filter(|pair| !bound.contains(pair));
        fresh.flatten().for_each(|t| folded[t as usize] = true);
        Ok(folded)
    }

    /// Whether a triangle of a garment's surface is of a cap.
    fn is_cap(&mut self, garment: usize, triangle: u32) -> bool {
        let (known, surface) = &self.garments[garment];
        let caps = self.caps[garment].get_or_insert_with(|| caps::of_garment(self.figure, known));
        caps[surface.weld.triangle_of[triangle as usize] as usize]
    }
}

fn pairs(a: &TriangleMesh, b: Option<&TriangleMesh>) -> Result<Vec<[u32; 2]>> {
    intersections(a, b, usize::MAX).map(|found| found.pairs).map_err(|e| Failure::no_result(e.message))
}
