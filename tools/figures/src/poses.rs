//! The same garment given in three poses, on bodies that stand in three: the fit is the same whichever it was given in.
//!
//! A garment in another pose is the one of the mannequin, put on the mannequin in that pose by the library: moved by skin
//! weights, a wide sweater would pass through itself under hanging arms, which no garment does that someone has designed. What
//! differs between the poses of a target is the body; what differs between those of the source should not show. The measure
//! is the mean distance from garment to body, over the garment's area; by how much each of the three is off their mean is what
//! is claimed. Beside it stands the time of the way: rigs read and matched, weights of the result, and the stage REPOSE.

use std::time::Instant;

use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::session::Precision;
use closet::avatars::Avatar;
use closet::garments::{Garment, garment};
use closet::mesh::Mesh;
use closet::rigs::{Body, Character, Naming, Pose, character};
use gallery::sheet::{Cell, Heading, Role, Sheet, View};
use gallery::{look, pair};
use testing::character::{mesh, session, skin};

use crate::figure::{Figure, Outcome};
use crate::measure::mean_distance;

/// The poses in which garments are given and bodies stand.
pub const POSES: [(&str, Pose); 3] = [("A", Pose::A), ("T", Pose::T), ("arms down", Pose::ARMS_DOWN)];
const GARMENTS: [Garment; 3] = [Garment::Jumpsuit, Garment::Sweater, Garment::Trousers];
const BODIES: [Avatar; 2] = [Avatar::Slim, Avatar::Tall];
const MORE_BODIES: [Avatar; 2] = [Avatar::Child, Avatar::Heavy];
/// A mean distance may be off that of all three poses by this share.
const ALLOWED: f64 = 0.05;
/// Rigs and weights may take this share of the fit, and the way to the own pose this one of all.
const RIGS: f64 = 0.10;
const WAY: f64 = 0.50;
/// Influences that most engines take.
const INFLUENCES: usize = 4;

/// A result.
pub struct Worn {
    /// The garment.
    pub mesh: TriangleMesh,
    /// Mean distance from the body, in metres.
    pub distance: f64,
    /// Seconds of the fit, of rigs and weights, of the stage REPOSE, and of all.
    pub seconds: [f64; 4],
    /// Iterations of the inflation, of the way and of the fit.
    pub iterations: [u32; 3],
}

/// Dresses `target` in a garment that `source` wears; the fit aims at the looseness there.
pub fn dress(worn: &Character, source: &Character, target: &Character, options: Options) -> Outcome<Worn> {
    let run = || {
        let clock = Instant::now();
        let mut session = session(worn, source, target, options)?;
        session.set_source_avatar(mesh(source))?;
        session.set_source_skin(skin(source))?;
        session.run()?;
        let weights = Instant::now();
        session.garment_skin(INFLUENCES)?;
        let weights = weights.elapsed().as_secs_f64();
        let report = session.report();
        let positions = session.garment_as_read(Precision::F32)?;
        let mesh = TriangleMesh { positions, triangles: worn.mesh.triangles.clone() };
        let body = pair::mesh(&target.mesh);
        Ok(Worn {
            distance: mean_distance(&mesh, &ClosestPoint::new(&body)),
            mesh,
            seconds: [
                report.fit.seconds,
                report.rig_seconds + weights,
                report.repose.seconds,
                clock.elapsed().as_secs_f64(),
            ],
            iterations: [report.inflate.iterations, report.repose.iterations, report.fit.iterations],
        })
    };
    run().map_err(|error: bespoke::error::Error| error.message)
}

impl Worn {
    /// The garment as the closet has it.
    fn cloth(&self) -> Mesh {
        Mesh { positions: self.mesh.positions.clone(), triangles: self.mesh.triangles.clone() }
    }
}

/// By how much each of the values is off their mean, as a share of that.
pub fn deviations(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|value| value / mean - 1.0).collect()
}

/// Makes the figure.
///
/// # Errors
/// Where a garment cannot be given in a pose.
pub fn figure() -> Outcome<Figure> {
    of(&BODIES)
}

/// The same on other bodies, on which not all of it holds: a child's, and a heavy one whose hanging arms lie in its flesh.
///
/// # Errors
/// As [`figure`].
pub fn figure_of_more() -> Outcome<Figure> {
    of(&MORE_BODIES)
}

fn of(bodies: &[Avatar]) -> Outcome<Figure> {
    let subtitle = "Garments given in an A-pose, in a T-pose and with arms down, on bodies that stand in each of these: mean \
                    distance from the body, and by how much it is off the mean of the three.";
    let view = View { azimuth: 0.0, elevation: 4.0, ..View::default() };
    let columns = [
        "garment",
        "body",
        "stands in",
        "given in",
        "as designed, mm",
        "distance, mm",
        "off the mean, %",
        "iterations",
        "fit, s",
        "rigs and weights, s",
        "way, s",
        "all, s",
    ];
    let mut figure = Figure::new(Sheet::new("Poses", subtitle, view), &columns);
    figure
        .sheet
        .rows
        .extend(POSES.map(|(name, _)| Heading { label: format!("given in {name}"), ..Heading::default() }));
    let mannequin = character(&Body::Mannequin.model(), Naming::Mixamo);
    let sources = POSES.map(|(_, pose)| mannequin.posed(&pose));
    let (mut off, mut sums, mut refused) = (0.0_f64, [0.0; 4], Vec::new());
    for kind in GARMENTS {
        let worn = mannequin.wears(&garment(kind).mesh);
        let mut given = Vec::new();
        for source in &sources {
            let mut worn_there = source.clone();
            worn_there.mesh = dress(&worn, &mannequin, source, Options::default())?.cloth();
            given.push(worn_there);
        }
        for &body in bodies {
            let undressed = character(&Body::Avatar(body).model(), Naming::Unreal);
            let name = body.name();
            for (stands_in, pose) in POSES {
                let target = undressed.posed(&pose);
                let column = figure.sheet.columns.len();
                let label = format!("{}, {name}, {stands_in}", kind.name());
                figure.sheet.columns.push(Heading { label, ..Heading::default() });
                let under = figure.sheet.add_mesh(&look::positions(&target.mesh.positions), &target.mesh.triangles);
                let mut results = Vec::new();
                for (row, (source, given)) in sources.iter().zip(&given).enumerate() {
                    let skin = look::surface(Role::Body, under, look::BODY);
                    let result = match dress(given, source, &target, Options::default()) {
                        Ok(result) => result,
                        Err(message) => {
                            let what = format!("{} given in {} on {name} in {stands_in}", kind.name(), POSES[row].0);
                            refused.push(format!("{what}: {message}"));
                            let (caption, layers) = ("no result".to_string(), vec![skin]);
                            figure.sheet.cells.push(Cell { row, column, caption, layers, ..Cell::default() });
                            continue;
                        }
                    };
                    let designed = mean_distance(&mesh(given), &ClosestPoint::new(&pair::mesh(&source.mesh)));
                    let cloth = look::garment(&mut figure.sheet, &result.mesh.positions, &result.mesh.triangles, kind);
                    let caption = format!("{:.1} mm off", 1e3 * result.distance);
                    let layers = vec![skin, cloth];
                    figure.sheet.cells.push(Cell { row, column, caption, layers, ..Cell::default() });
                    results.push((result, designed, POSES[row].0));
                }
                let distances: Vec<f64> = results.iter().map(|(result, ..)| result.distance).collect();
                for ((result, designed, given_in), deviation) in results.iter().zip(deviations(&distances)) {
                    off = off.max(deviation.abs());
                    sums.iter_mut().zip(result.seconds).for_each(|(sum, seconds)| *sum += seconds);
                    let iterations = result.iterations.map(|count| count.to_string()).join(" + ");
                    let mut row = [kind.name(), name, stands_in, *given_in].map(str::to_string).to_vec();
                    row.extend([1e3 * designed, 1e3 * result.distance].map(|mm| format!("{mm:.2}")));
                    row.extend([format!("{:+.1}", 1e2 * deviation), iterations]);
                    row.extend(result.seconds.map(|seconds| format!("{seconds:.2}")));
                    figure.rows.push(row);
                }
            }
        }
    }
    let [fit, rigs, way, all] = sums;
    figure.claim(
        refused.is_empty(),
        match refused.first() {
            None => "all are dressed".to_string(),
            Some(first) => format!("all are dressed: {} are not, such as {first}", refused.len()),
        },
    );
    figure.claim(
        off <= ALLOWED,
        format!(
            "the fit is the same whichever pose a garment was given in, within {:.1} % of its mean distance (at most {:.0} %)",
            1e2 * off,
            1e2 * ALLOWED
        ),
    );
    claim_times(&mut figure, [rigs, fit], [way, all]);
    Ok(figure)
}

/// Claims what rigs and weights take of the fit, and what the way to the own pose takes of all; in seconds.
pub fn claim_times(figure: &mut Figure, [rigs, fit]: [f64; 2], [way, all]: [f64; 2]) {
    figure.claim(
        rigs <= RIGS * fit,
        format!("rigs and weights take {:.1} % of the time of the fit (at most {:.0} %)", 1e2 * rigs / fit, 1e2 * RIGS),
    );
    figure.claim(
        way <= WAY * all,
        format!("the way to the own pose takes {:.0} % of all time (at most {:.0} %)", 1e2 * way / all, 1e2 * WAY),
    );
}
