//! `bespoke check`: intersections of garments and body in the bind pose.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::weld::Weld;
use bespoke::verify::intersections;
use serde::Serialize;

use crate::args::Check;
use crate::bodies::joined;
use crate::failure::{Failure, Result};
use crate::figure::{Choice, Figure, Part};
use crate::outfit::{self, Garment};
use crate::parts::pattern::Patterns;
use crate::parts::{Kind, Role};
use crate::report;

/// What was counted in one pose.
#[derive(Clone, Debug, Serialize)]
pub struct Counted {
    /// In words.
    pub pose: String,
    /// Pairs of triangles of each garment that intersect.
    pub garments: Vec<CountedGarment>,
}

/// Intersecting pairs of triangles of one garment.
#[derive(Clone, Debug, Serialize)]
pub struct CountedGarment {
    /// The garment.
    pub name: String,
    /// With itself.
    pub own: u64,
    /// With the body.
    pub body: u64,
    /// With garments listed before it.
    pub others: u64,
}

/// Counts, and says what was counted; exit code 3 where anything intersects.
///
/// # Errors
/// Where the file cannot be read or has no garment.
pub fn run(args: &Check) -> Result<u8> {
    let garments = args.nodes.as_deref().map(Patterns::parse).transpose().map_err(Failure::usage)?;
    let figure = Figure::open(&args.file, Role::Outfit, &Choice { garments, body: None })?;
    let garments = outfit::need_garments(&figure)?;
    let counted = vec![count(&figure, &garments)?];
    if args.json {
        print!("{}", report::text(&counted)?);
    } else {
        for pose in &counted {
            for garment in &pose.garments {
                let CountedGarment { name, own, body, others } = garment;
                println!(
                    "{}: {name}: {own} with itself, {body} with the body, {others} with other garments",
                    pose.pose
                );
            }
        }
    }
    let clean = counted.iter().flat_map(|pose| &pose.garments).all(|g| g.own + g.body + g.others == 0);
    Ok(if clean { 0 } else { 3 })
}

fn count(figure: &Figure, garments: &[Garment]) -> Result<Counted> {
    let mesh = |parts: &mut dyn Iterator<Item = &Part>| {
        // Triangles on both sides of a seam share its vertices; files split them.
        Weld::new(&joined(parts, figure.rig.joints.len()).0.mesh).0.mesh
    };
    let body = mesh(&mut figure.of(Kind::Body));
    let counts = |a: &TriangleMesh, b: Option<&TriangleMesh>| {
        intersections(a, b, 0).map(|found| found.count).map_err(|e| Failure::no_result(e.message))
    };
    let mut meshes: Vec<TriangleMesh> = Vec::new();
    let mut counted = Vec::new();
    for garment in garments {
        let cloth = mesh(&mut garment.parts.iter().map(|&part| &figure.parts[part]));
        let mut others = 0;
        for other in &meshes {
            others += counts(&cloth, Some(other))?;
        }
        counted.push(CountedGarment {
            name: garment.name.clone(),
            own: counts(&cloth, None)?,
            body: counts(&cloth, Some(&body))?,
            others,
        });
        meshes.push(cloth);
    }
    Ok(Counted { pose: "bind pose".to_string(), garments: counted })
}
