//! Repair of the start where the avatar, shrunk onto the source skeleton, penetrates the garment.
//!
//! The guarantee of the inflation needs a start without contact, and nothing else of it. So the skeleton is bent until it
//! stays clear of the garment: displaced where a bone leaves through a wall, retracted where it ends beyond a closed end.
//! Whether it is clear is the exact verifier's decision alone.

use glam::DVec3;

use super::caps::Caps;
use super::enclosure;
use super::inside::{Design, Lost};
use super::path_search::{PathSearch, SearchSettings, SkeletonPath, enclosing_planes};
use super::projection::ProjectedAvatar;
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::diagnostic::{Bone, Diagnostic};
use crate::input::diagnostic_words::{NO_OPENING, at_bone, avatar_triangle};
use crate::input::skeleton::{Location, Skeleton};
use crate::verify::intersections_with_cancel;

/// What is tried, one after the other, until nothing between joints has to be retracted: finely and near, then far, and
/// last with hardly any clearance.
const ROUNDS: [SearchSettings; 3] = [
    SearchSettings { radius: 0.12, spacing: 0.012, clearance: 2.5e-3 },
    SearchSettings { radius: 0.32, spacing: 0.015, clearance: 2e-3 },
    SearchSettings { radius: 0.08, spacing: 0.008, clearance: 2e-4 },
];
/// No more than this share of the bones' length is retracted: what hangs on the rest would not be dressed.
const MAX_RETRACTED: f64 = 0.2;
/// The garment must enclose the bent skeleton for this share of it.
const MIN_ENCLOSED_SHARE: f64 = 0.85;
/// Where the design leaves more outside, the bent skeleton may leave so much more; and it encloses at least this share.
const LOST_SHARE: f64 = 0.1;
const MOST: f64 = 0.5;
/// A bent skeleton with more joints than this is not tried: the table of paths between them grows with its square.
const MAX_JOINTS: usize = 8192;
/// A piece of this size, its bounding box's diagonal, has to stay around what it was around: a shoe, not a button.
const MIN_PIECE: f64 = 0.1;
/// Joints that may be the root, those nearest to the garment's middle.
const ROOTS: usize = 64;
/// Garment triangles that an error names.
const NAMED: usize = 8;
/// Diagnostics of one error, at most.
const MAX_DIAGNOSTICS: usize = 64;

/// A garment triangle that the shrunk avatar passes through, the bone, and the triangle of the avatar or a layer.
struct Penetration {
    garment: u32,
    bone: Option<u32>,
    avatar: u32,
}

/// Moves the start of `projected`, of `avatar` and on `source`, clear of the garment where it is not, and adds what was done
/// to `diagnostics`. Returns the segments that the start lies on. `callers` has the caller's index of each garment triangle.
///
/// # Errors
/// `NotEnclosed` where that cannot be done, naming bone and triangles, which are also added to `diagnostics`; `Cancelled`.
pub fn resolve(
    garment: &TriangleMesh,
    avatar: &Body,
    projected: &mut ProjectedAvatar,
    source: &Skeleton,
    callers: &[u32],
    cancel: &Cancel,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<[DVec3; 2]>> {
    let mut penetrations = find_penetrations(garment, projected, cancel)?;
    penetrations.iter_mut().for_each(|penetration| penetration.garment = callers[penetration.garment as usize]);
    let extents = extents(projected, source);
    let segment = |(ends, bone): (&[f64; 2], u32)| ends.map(|s| source.point_at(bone, s));
    let straight: Vec<[DVec3; 2]> = extents.iter().zip(0..).map(segment).collect();
    if penetrations.is_empty() {
        return Ok(straight);
    }
    let design = Design::new(garment, straight);
    let found = search_path(garment, &avatar.mesh, projected, source, &design, &penetrations, cancel)?;
    let refusals = || penetrations.iter().take(MAX_DIAGNOSTICS).map(|p| refusal_of(p, source, avatar));
    let Some(Repair { path, start, lost, .. }) = found else {
        diagnostics.extend(refusals());
        return Err(refusal(&penetrations, source, avatar));
    };
    if let Some(lost) = design.emptied(&lost).into_iter().find(|lost| design.size(lost.piece) >= MIN_PIECE) {
        diagnostics.extend(refusals());
        let triangle = callers[design.triangle(lost.piece) as usize];
        return Err(outside(triangle, bone_of(lost.bone, source)));
    }
    diagnostics.extend(repairs(&penetrations, &path, source, &extents));
    *projected = start;
    Ok(path.bent.segments(&extents))
}

/// The caps of `garment` that the shrunk avatar, `projected` onto `source`, passes through.
///
/// # Errors
/// `Cancelled`.
pub fn find_caps(
    garment: &TriangleMesh,
    projected: &ProjectedAvatar,
    source: &Skeleton,
    cancel: &Cancel,
) -> Result<Caps> {
    let penetrations = find_penetrations(garment, projected, cancel)?;
    let mut through: Vec<(u32, u32)> =
        penetrations.iter().filter_map(|p| p.bone.map(|bone| (p.garment, bone))).collect();
    through.sort_unstable();
    through.dedup();
    Ok(Caps::find(garment, &through, source, &extents(projected, source)))
}

fn find_penetrations(garment: &TriangleMesh, projected: &ProjectedAvatar, cancel: &Cancel) -> Result<Vec<Penetration>> {
    let found = intersections_with_cancel(garment, Some(&projected.start_mesh()), usize::MAX, cancel)?;
    let penetration = |&[garment, piece]: &[u32; 2]| Penetration {
        garment,
        bone: projected.bones[piece as usize],
        avatar: projected.origins[piece as usize],
    };
    Ok(found.pairs.iter().map(penetration).collect())
}

/// What the rounds of a search have found.
#[derive(Default)]
struct Found {
    best: Option<Repair>,
    /// What leaves more of the garment outside, and no more than the design does.
    second: Option<Repair>,
}

/// A start that is clear of the garment.
struct Repair {
    /// The length that is retracted between joints.
    retracted: f64,
    path: SkeletonPath,
    start: ProjectedAvatar,
    lost: Vec<Lost>,
}

/// The first path that retracts no bone, or else the one that retracts least. Where that leads bones out of what is around
/// them, they are kept inside by force, if that can be done.
///
/// Of what is not around bones in the design either, as the brim of a hat, more may be left outside: where no path has the
/// garment around it as a rule, one will do that leads no bone out of its piece. And where the search begins with a leaf, such as
/// the end of a head beyond its hat or in the filling of its crown, and finds nothing, it begins with the joint before: the leaf
/// is pulled back rather than led around what it meets.
fn search_path(
    garment: &TriangleMesh,
    avatar: &TriangleMesh,
    projected: &ProjectedAvatar,
    source: &Skeleton,
    design: &Design,
    penetrations: &[Penetration],
    cancel: &Cancel,
) -> Result<Option<Repair>> {
    let root = choose_root(garment, source);
    let mut search = PathSearch {
        garment,
        tree: ClosestPoint::new(garment),
        source,
        extents: extents(projected, source),
        prefer_enclosed: near_penetrations(penetrations, source),
        keep_inside: source.bones.iter().map(|_| None).collect(),
        root_planes: 3,
    };
    let whole: f64 = source.bones.iter().map(|b| length(source, *b)).sum();
    let mut design_share = None;
    // That `leaf` is pulled back does not speak against a path.
    let mut rounds = |search: &PathSearch, root: u32, leaf: Option<u32>| -> Result<Found> {
        let cut = cycles(source, root);
        let mut found = Found::default();
        for settings in &ROUNDS {
            let Some(path) = search.find(root, &cut, settings, cancel)? else { continue };
            let in_all: f64 = path.retracted.iter().map(|p| p[0]).sum();
            let retracted = in_all - leaf.map_or(0.0, |bone| path.retracted[bone as usize][0]);
            let better = |than: &Option<Repair>| than.as_ref().is_none_or(|than| retracted < than.retracted);
            if !better(&found.best) || in_all > MAX_RETRACTED * whole || path.bent.skeleton.joints.len() > MAX_JOINTS {
                continue;
            }
            let start = path.bent.reproject(avatar, projected);
            if !find_penetrations(garment, &start, cancel)?.is_empty() {
                continue;
            }
            let segments = path.bent.segments(&search.extents);
            if enclosure::enclosed_share(garment, &segments) >= MIN_ENCLOSED_SHARE {
                found.best = Some(Repair { retracted, path, start, lost: Vec::new() });
                if retracted == 0.0 {
                    break;
                }
            } else if better(&found.second) {
                let designed = *design_share.get_or_insert_with(|| design.share());
                let least = MIN_ENCLOSED_SHARE.min(designed - LOST_SHARE).max(MOST);
                if enclosure::enclosed_share_of_area(garment, &segments) >= least
                    && design.lost(&path.bent, &search.extents).is_empty()
                {
                    found.second = Some(Repair { retracted, path, start, lost: Vec::new() });
                }
            }
        }
        if let Some(best) = &mut found.best {
            best.lost = design.lost(&best.path.bent, &search.extents);
        }
        Ok(found)
    };
    let free = rounds(&search, root, None)?;
    let lost = match &free.best {
        Some(best) => best.lost.clone(),
        None => design.around(&search.prefer_enclosed),
    };
    if lost.is_empty() && free.best.is_some() {
        return Ok(free.best);
    }
    let kept = if lost.is_empty() {
        Found::default()
    } else {
        search.keep_inside = design.keep(&lost);
        rounds(&search, root, None)?
    };
    let better = kept.best.filter(|kept| free.best.is_none() || kept.lost.len() < lost.len());
    if let Some(found) = better.or(free.best).or(free.second).or(kept.second) {
        return Ok(Some(found));
    }
    let Some((before, leaf)) = root_before(source, root) else { return Ok(None) };
    search.keep_inside.fill_with(|| None);
    search.root_planes = enclosing_planes(garment, source.joints[before as usize]);
    let found = rounds(&search, before, Some(leaf))?;
    Ok(found.best.filter(|best| best.lost.is_empty()).or(found.second))
}

fn length(source: &Skeleton, ends: [u32; 2]) -> f64 {
    let [a, b] = ends.map(|j| source.joints[j as usize]);
    a.distance(b)
}

/// The joint that the garment encloses in most planes, and among equals the one nearest to its middle.
fn choose_root(garment: &TriangleMesh, source: &Skeleton) -> u32 {
    let corners = || garment.triangles.iter().flatten().map(|&v| garment.positions[v as usize]);
    let middle = corners().sum::<DVec3>() / corners().count().max(1) as f64;
    let mut joints: Vec<u32> = (0..source.joints.len() as u32).collect();
    joints.sort_by(|&a, &b| {
        let distance = |j: u32| source.joints[j as usize].distance_squared(middle);
        distance(a).total_cmp(&distance(b))
    });
    joints.truncate(ROOTS);
    let score = |&j: &u32| enclosing_planes(garment, source.joints[j as usize]);
    // The last of equals in the reversed order is the nearest.
    joints.into_iter().rev().max_by_key(score).unwrap_or(0)
}

/// Where `root` is a leaf, the other end of its bone, and the bone: what lies beyond the garment, or within what fills it, as the end
/// of a head's bone in the crown of a hat, can be pulled back from there, and never from the leaf.
fn root_before(source: &Skeleton, root: u32) -> Option<(u32, u32)> {
    let mut bones = (0..).zip(&source.bones).filter(|(_, ends)| ends.contains(&root));
    let (bone, &[a, b]) = bones.next()?;
    bones.next().is_none().then_some((if a == root { b } else { a }, bone))
}

/// The bones without which the skeleton is a tree.
fn cycles(source: &Skeleton, root: u32) -> Vec<bool> {
    let mut cut = vec![true; source.bones.len()];
    let mut at = vec![Vec::new(); source.joints.len()];
    for (bone, &[a, b]) in source.bones.iter().enumerate() {
        at[a as usize].push((bone, b));
        at[b as usize].push((bone, a));
    }
    let mut reached = vec![false; at.len()];
    reached[root as usize] = true;
    let mut order = vec![root];
    let mut done = 0;
    while let Some(&joint) = order.get(done) {
        done += 1;
        for &(bone, other) in &at[joint as usize] {
            if !std::mem::replace(&mut reached[other as usize], true) {
                cut[bone] = false;
                order.push(other);
            }
        }
    }
    cut
}

/// The least and the largest parameter on each bone.
fn extents(projected: &ProjectedAvatar, source: &Skeleton) -> Vec<[f64; 2]> {
    let mut extents = vec![[0.0_f64, 1.0_f64]; source.bones.len()];
    for location in &projected.locations {
        if let Location::Bone { bone, parameter } = *location {
            let [low, high] = &mut extents[bone as usize];
            (*low, *high) = (low.min(parameter), high.max(parameter));
        }
    }
    extents
}

/// Bones that penetrate, and those that share a joint with them.
fn near_penetrations(penetrations: &[Penetration], source: &Skeleton) -> Vec<bool> {
    let mut joints = vec![false; source.joints.len()];
    for bone in penetrations.iter().filter_map(|p| p.bone) {
        source.bones[bone as usize].iter().for_each(|&j| joints[j as usize] = true);
    }
    source.bones.iter().map(|ends| ends.iter().any(|&j| joints[j as usize])).collect()
}

/// What was done, bone by bone; last what was done to cycles.
fn repairs(
    penetrations: &[Penetration],
    path: &SkeletonPath,
    source: &Skeleton,
    extents: &[[f64; 2]],
) -> Vec<Diagnostic> {
    let through = |bone: Option<u32>| {
        let mut triangles: Vec<u32> = penetrations.iter().filter(|p| p.bone == bone).map(|p| p.garment).collect();
        triangles.sort_unstable();
        triangles.dedup();
        triangles.truncate(3);
        triangles
    };
    let mut diagnostics = Vec::new();
    for bone in (0..source.bones.len() as u32).map(|index| bone_of(index, source)) {
        let triangles = through(Some(bone.index));
        let [between, beyond] = path.retracted[bone.index as usize];
        if triangles.is_empty() && between == 0.0 {
            continue;
        }
        let aside = path.displacements[bone.index as usize];
        let [low, high] = extents[bone.index as usize];
        let whole = length(source, bone.joints);
        let share = |part: f64, of: f64| if of > 0.0 { (part / of).min(1.0) } else { 0.0 };
        let shares = [share(between, whole), share(beyond, whole * (high - 1.0 - low))];
        diagnostics.push(Diagnostic::BoneMoved { bone, triangles, aside, between, beyond, shares });
    }
    let triangles = through(None);
    if !triangles.is_empty() {
        diagnostics.push(Diagnostic::CycleCut { triangles });
    }
    diagnostics
}

fn bone_of(index: u32, source: &Skeleton) -> Bone {
    Bone { index, joints: source.bones[index as usize] }
}

fn refusal_of(penetration: &Penetration, source: &Skeleton, avatar: &Body) -> Diagnostic {
    Diagnostic::AvatarPenetrates {
        garment: penetration.garment,
        bone: penetration.bone.map(|bone| bone_of(bone, source)),
        avatar: avatar.triangle(penetration.avatar),
    }
}

fn refusal(penetrations: &[Penetration], source: &Skeleton, avatar: &Body) -> Error {
    let mut triangles: Vec<u32> = penetrations.iter().map(|p| p.garment).collect();
    triangles.sort_unstable();
    triangles.dedup();
    let count = triangles.len();
    let named: Vec<String> = triangles.iter().take(NAMED).map(u32::to_string).collect();
    let part =
        penetrations.first().map_or(String::new(), |p| format!(" ({})", avatar_triangle(avatar.triangle(p.avatar))));
    Error::new(
        ErrorKind::NotEnclosed,
        format!(
            "garment: the avatar, shrunk onto the source skeleton, penetrates it {}{part}: at garment triangles \
             {}{} ({count} in all), and no way around them was found; move the garment or the skeleton so that the garment \
             is around its bones; {NO_OPENING}",
            at_bone(penetrations.first().and_then(|p| p.bone).map(|bone| source.bones[bone as usize])),
            named.join(", "),
            if count > named.len() { ", ..." } else { "" },
        ),
    )
}

/// The error of a piece of the garment, named by one of its triangles, that was around a bone and is around none now.
fn outside(triangle: u32, bone: Bone) -> Error {
    Error::new(
        ErrorKind::NotEnclosed,
        format!(
            "garment: the piece of triangle {triangle} is around the source skeleton's {}, which passes through its wall, and \
             the bone cannot be kept clear of it inside; move the bone's end to the middle of what that piece is to cover, \
             where it is inside",
            at_bone(Some(bone.joints)).trim_start_matches("at the "),
        ),
    )
}
