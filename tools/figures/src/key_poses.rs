//! Corrections of key poses: the same garment posed by weights of several kinds, and by the library's with the offsets that
//! it finds for each pose. And what it costs to have rigs: their reading, the map and the weights of the result beside the fit,
//! and the way back to the own pose where the body stands in another one than the garment was made in.
//!
//! Beside two pairs of the closet stand real ones where there are any, in folders of their own. Skeletons become rigs of their
//! joints, so that both sorts go the same way.

use std::cmp::Reverse;
use std::collections::HashSet;
use std::path::PathBuf;
use std::time::Instant;

use bespoke::error::{Error, ErrorKind};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::Diagnostic;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::rig::weights::blend::linear_blend;
use bespoke::session::{KeyPose, Precision, Session};
use glam::{DMat3, DMat4, DVec3};

use crate::figure::{Figure, Outcome};
use crate::poses::claim_times;
use crate::skin_weights::{BEND, INFLUENCES, by_tools, skin_of};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::BONES;
use closet::{Kind, sample};
use gallery::folder::Pair;
use gallery::sheet::{Cell, Heading, Layer, Role, Sheet, View};
use gallery::{look, pair};
use testing::posing::{Bend, Bound, Counts, POSES, Puppet};

/// Those of the closet.
const PAIRS: [(Garment, Avatar); 2] = [(Garment::Coat, Avatar::Heavy), (Garment::Trousers, Avatar::Giant)];

/// The colour of garments, and the height of what is in a picture, in metres.
const GARMENT: &str = "#2f6d73";
const HEIGHT: f64 = 1.8;

/// So many pairs of those in which corrections take the most away are in the picture.
const SHOWN: usize = 4;

const METHODS: [&str; 4] = ["nearest vertex", "closest point", "Bespoke", "corrected"];

/// The pose of a runner, to see what the way from the pose of the design to that of the body takes, in degrees.
const RUNNER: &[Bend] = &[Bend::Elbow, Bend::Knee];
const RUNNING: f64 = 75.0;

/// What there may be of the intersections of the nearest vertex.
const ALLOWED: f64 = 1.0 / 3.0;

/// The joints of the samples' skeletons, with those of Mixamo's names that are in their places, and the top of the head.
const NAMES: [&str; 16] = [
    "Hips",
    "Spine",
    "Neck",
    "LeftArm",
    "LeftForeArm",
    "LeftHand",
    "RightArm",
    "RightHand",
    "RightForeArm",
    "LeftUpLeg",
    "LeftLeg",
    "LeftFoot",
    "RightUpLeg",
    "RightLeg",
    "RightFoot",
    "HeadTop_End",
];

/// A garment and a body to dress, on skeletons with the joints of the samples.
struct Given {
    pair: Pair,
    skin: SkinWeights,
    front: DVec3,
    up: DVec3,
}

/// What became of it.
struct Found {
    name: String,
    /// By each method, in all poses.
    counts: [Counts; METHODS.len()],
    /// Seconds of the run, of its fit, of rigs and weights, and of the corrections.
    seconds: [f64; 4],
    /// Seconds of the way to the own pose, and of all, where the body stands in a pose that the garment was not made in. None
    /// where there is no result.
    way: Option<[f64; 2]>,
    body: TriangleMesh,
    garment: TriangleMesh,
    /// The body in the pose in which all joints bend, and the garment there by each method.
    bent: (Vec<DVec3>, Vec<Vec<DVec3>>),
    /// How it stands upright in a sheet.
    upright: DMat3,
}

impl Given {
    /// One of the closet.
    fn closet((kind, who): (Garment, Avatar)) -> Outcome<Self> {
        let (worn, body, mannequin) = (garment(kind), avatar(who), sample(Kind::Mannequin));
        let skeleton = |joints: &[DVec3]| Skeleton { joints: joints.to_vec(), bones: BONES.to_vec() };
        let skin = skin_of(&body)?;
        let pair = Pair {
            name: format!("{} on {}", kind.name(), who.name()),
            garment: pair::mesh(&worn.mesh),
            source_skeleton: skeleton(&mannequin.skeleton.joints),
            source_avatar: Some(pair::mesh(&mannequin.mesh)),
            avatar: pair::mesh(&body.mesh),
            skeleton: skeleton(&body.skeleton.joints),
            skin: Some(skin.clone()),
        };
        Ok(Self { pair, skin, front: DVec3::NEG_Y, up: DVec3::Z })
    }

    /// One from a folder.
    fn real(pair: Pair) -> Outcome<Self> {
        let skin =
            pair.skin.clone().ok_or_else(|| format!("{}: the body has no skin weights (skin.txt)", pair.name))?;
        Ok(Self { pair, skin, front: DVec3::Z, up: DVec3::Y })
    }

    /// How it stands in a sheet: z up, facing -y.
    fn upright(&self) -> DMat3 {
        DMat3::from_cols(self.up.cross(self.front), -self.front, self.up).transpose()
    }

    /// Dresses, corrects the poses and counts.
    fn find(self) -> Outcome<Found> {
        let name = self.pair.name.clone();
        self.run().map_err(|error| format!("{name}: {}", error.message))
    }

    fn run(self) -> Result<Found, Error> {
        let upright = self.upright();
        let Self { pair, skin, front, up } = self;
        let puppet = Puppet::new(&pair.skeleton, front, up);
        let mut session = session(&pair, &puppet, pair.avatar.clone(), &pair.skeleton, &skin)?;
        let clock = Instant::now();
        session.run()?;
        let run = clock.elapsed().as_secs_f64();
        let own = session.garment_skin(INFLUENCES)?;
        let rigs = session.report().rig_seconds + clock.elapsed().as_secs_f64() - run;

        let moves = POSES.map(|pose| puppet.moves(pose, BEND));
        for (number, motions) in moves.iter().enumerate() {
            session.add_key_pose(KeyPose { name: format!("bend {number}"), motions: motions.clone() })?;
        }
        let clock = Instant::now();
        session.solve_pose_corrections(INFLUENCES)?;
        let seconds = [run, session.report().fit.seconds, rigs, clock.elapsed().as_secs_f64()];
        let way = way(&pair, &puppet, &skin)?;

        let worn = TriangleMesh {
            positions: session.garment_as_read(Precision::F32)?.into_iter().map(|p| Precision::F32.round(p)).collect(),
            triangles: without_caps(&session, &pair.garment.triangles),
        };
        let [nearest, closest] = by_tools(&worn, &pair.avatar, &skin)?;
        let methods = [&nearest, &closest, &own, &own];
        let bound = Bound::new(&worn, &pair.avatar, &skin);
        let mut counts = [Counts::default(); METHODS.len()];
        let mut bent = (Vec::new(), Vec::new());
        for (number, motions) in moves.iter().enumerate() {
            let pose = bound.posed(motions);
            let offsets = &session.pose_correction(number)?.offsets;
            let corrected: Vec<DVec3> = worn.positions.iter().zip(offsets).map(|(&p, &d)| p + d).collect();
            let positions = [&worn.positions, &worn.positions, &worn.positions, &corrected];
            let methods = || positions.into_iter().zip(methods);
            methods().zip(&mut counts).for_each(|((positions, skin), sum)| *sum += pose.counts(positions, skin));
            if number + 1 == moves.len() {
                let cloths = methods().map(|(positions, skin)| linear_blend(positions, skin, motions)).collect();
                bent = (pose.under.positions, cloths);
            }
        }
        Ok(Found { name: pair.name, counts, seconds, way, body: pair.avatar, garment: worn, bent, upright })
    }
}

/// All inputs, with the body as it stands.
fn session(
    pair: &Pair,
    puppet: &Puppet,
    avatar: TriangleMesh,
    skeleton: &Skeleton,
    skin: &SkinWeights,
) -> Result<Session, Error> {
    let mut session = Session::new();
    session.set_options(Options::default())?;
    session.set_garment(pair.garment.clone(), Precision::F32)?;
    session.set_source_rig(rig(&pair.source_skeleton, puppet))?;
    if let Some(source) = &pair.source_avatar {
        session.set_source_avatar(source.clone())?;
    }
    session.set_target_avatar(avatar)?;
    session.set_target_rig(rig(skeleton, puppet))?;
    session.set_target_skin(skin.clone())?;
    Ok(session)
}

/// What the way to the own pose takes, and the run, for a body that stands as a runner does. Where the body itself closes the way,
/// what it took so far; none where the garment is refused in that pose.
fn way(pair: &Pair, puppet: &Puppet, skin: &SkinWeights) -> Result<Option<[f64; 2]>, Error> {
    let moves = puppet.moves(RUNNER, RUNNING);
    let joints =
        pair.skeleton.joints.iter().zip(&moves).map(|(&joint, motion)| motion.transform_point3(joint)).collect();
    let avatar = TriangleMesh {
        positions: linear_blend(&pair.avatar.positions, skin, &moves),
        triangles: pair.avatar.triangles.clone(),
    };
    let skeleton = Skeleton { joints, bones: pair.skeleton.bones.clone() };
    let mut session = session(pair, puppet, avatar, &skeleton, skin)?;
    let clock = Instant::now();
    let has_ended = match session.run() {
        Err(error) => error.kind == ErrorKind::ImplausibleResult,
        Ok(_) => true,
    };
    Ok(has_ended.then(|| [session.report().repose.seconds, clock.elapsed().as_secs_f64()]))
}

/// A skeleton with the joints of the samples, as a rig.
fn rig(skeleton: &Skeleton, puppet: &Puppet) -> Rig {
    let joint = |((place, parent), name): ((&DVec3, &Option<u32>), &str)| RigJoint {
        name: name.into(),
        parent: *parent,
        bind: DMat4::from_translation(*place),
    };
    Rig { joints: skeleton.joints.iter().zip(puppet.parents()).zip(NAMES).map(joint).collect() }
}

/// The triangles that close no opening: through such a cap the body goes as it did in the design.
fn without_caps(session: &Session, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let caps: HashSet<u32> = session
        .diagnostics()
        .iter()
        .flat_map(|found| match found {
            Diagnostic::OpeningCap { triangles, .. } => triangles.clone(),
            _ => Vec::new(),
        })
        .collect();
    (0u32..).zip(triangles).filter(|(number, _)| !caps.contains(number)).map(|(_, &t)| t).collect()
}

impl Found {
    /// The body and, by one of the methods, the garment in the pose in which all joints bend.
    fn layers(&self, sheet: &mut Sheet, method: usize) -> Vec<Layer> {
        let (body, cloths) = &self.bent;
        let all = || body.iter().map(|&p| self.upright * p);
        let (low, high) = (all().fold(DVec3::INFINITY, DVec3::min), all().fold(DVec3::NEG_INFINITY, DVec3::max));
        let foot = (0.5 * (low + high)).with_z(low.z);
        let scale = HEIGHT / (high.z - low.z);
        let mut layer = |role, mesh: &TriangleMesh, positions: &[DVec3], colour| {
            let placed: Vec<DVec3> = positions.iter().map(|&p| scale * (self.upright * p - foot)).collect();
            let mesh = sheet.add_mesh(&look::positions(&placed), &mesh.triangles);
            look::surface(role, mesh, colour)
        };
        vec![
            layer(Role::Body, &self.body, body, look::BODY),
            layer(Role::Garment, &self.garment, &cloths[method], GARMENT),
        ]
    }

    /// What corrections take away.
    fn corrected(&self) -> u64 {
        let [.., before, after] = self.counts.map(|counts| counts.own + counts.body);
        before.saturating_sub(after)
    }
}

/// Makes the figure, with the real pairs in these folders.
pub fn figure(folders: &[PathBuf]) -> Outcome<Figure> {
    let subtitle = "Shoulders, elbows, hips and knees bent by 45 degrees, body and garment by their skin weights, and by \
                    Bespoke's with the offsets that it finds for each pose. Pairs of triangles that pass through each other, \
                    in each of these poses and all at once: within the garment + of garment and body (where the body passes \
                    through itself).";
    let columns = [
        "pair",
        METHODS[0],
        METHODS[1],
        METHODS[2],
        METHODS[3],
        "run, s",
        "fit, s",
        "rigs and weights, s",
        "corrections, s",
        "way, s",
        "run with it, s",
    ];
    let view = View { azimuth: 24.0, elevation: 7.0, ..View::default() };
    let mut figure = Figure::new(Sheet::new("Key poses", subtitle, view), &columns);
    figure.sheet.rows.extend(METHODS.map(|label| Heading { label: label.into(), ..Heading::default() }));
    let real = folders.iter().filter_map(|folder| Pair::read(folder)).map(Given::real);
    let given: Vec<Given> = PAIRS.into_iter().map(Given::closet).chain(real).collect::<Outcome<_>>()?;
    let mut found = given.into_iter().map(Given::find).collect::<Outcome<Vec<Found>>>()?;
    let (mut totals, mut seconds) = ([Counts::default(); METHODS.len()], [0.0; 6]);
    for pair in &found {
        totals.iter_mut().zip(pair.counts).for_each(|(sum, counts)| *sum += counts);
        let of_pair = || pair.seconds.into_iter().chain(pair.way.into_iter().flatten());
        seconds.iter_mut().zip(of_pair()).for_each(|(sum, seconds)| *sum += seconds);
        let mut row = vec![pair.name.clone()];
        row.extend(pair.counts.map(caption));
        row.extend(of_pair().map(|seconds| format!("{seconds:.2}")));
        row.resize(columns.len(), "refused".into());
        figure.rows.push(row);
    }
    found.sort_by_key(|pair| Reverse(pair.corrected()));
    for (column, pair) in found.iter().take(SHOWN).enumerate() {
        figure.sheet.columns.push(Heading { label: pair.name.clone(), ..Heading::default() });
        for (row, &counts) in pair.counts.iter().enumerate() {
            let layers = pair.layers(&mut figure.sheet, row);
            figure.sheet.cells.push(Cell { column, row, caption: caption(counts), layers, ..Cell::default() });
        }
    }
    let [nearest, closest, weights, corrected] = totals.map(|sum| sum.own + sum.body);
    let [_, fit, rigs, _, way, all] = seconds;
    figure.claim(
        corrected as f64 <= ALLOWED * nearest as f64,
        format!("{corrected} pairs in all with corrections, {nearest} by nearest vertices (allowed: a third)"),
    );
    figure.claim(
        corrected <= weights && weights < closest,
        format!("{corrected} with corrections, {weights} without, {closest} by closest points"),
    );
    claim_times(&mut figure, [rigs, fit], [way, all]);
    Ok(figure)
}

fn caption(counts: Counts) -> String {
    format!("{} + {} ({})", counts.own, counts.body, counts.folds)
}
