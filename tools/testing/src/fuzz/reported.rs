//! What other people's bug reports are about, in small: one or more of it are done to a garment, a body and their skeletons.

use super::shape::Shape;
use super::source::Source;

/// Kinds that [`Reported::afflict`] knows.
const KINDS: usize = 17;
/// Ratios of units.
const UNITS: [f64; 6] = [100.0, 39.370_1, 2.54, 1000.0, 0.01, 0.3048];

/// The inputs of a scene.
pub struct Reported<'a> {
    pub garment: &'a mut Shape,
    pub body: &'a mut Shape,
    pub joints: &'a mut [Vec<f64>; 2],
    /// Rows of skin weights of the body, a row a joint; empty for none.
    pub skin: &'a mut Vec<f64>,
    /// Whether the garment got T-junctions, whose sides stay together and so touch.
    pub has_junctions: &'a mut bool,
}

impl Reported<'_> {
    /// Does one thing, or nothing where the source has ended.
    pub fn afflict(&mut self, source: &mut Source) {
        match source.below(KINDS + 1) {
            1 => self.garment.join(&piece(source)),
            2 => {
                *self.has_junctions = true;
                split_edge(self.garment, source);
            }
            3 => touching_patch(self.garment, source),
            4 => {
                let factor = UNITS[source.below(UNITS.len())];
                self.points(source).iter_mut().for_each(|x| *x *= factor);
            }
            5 => flip(self.joints, self.body, source),
            6 => self.bind_to_one(source),
            7 => thin_out(self.garment, 2 + source.below(14)),
            8 => bow_ties(self.garment, 1 + source.below(4)),
            9 => self.body.join(&floor(source)),
            10 => self.body.join(&horn(source)),
            11 => {
                let points = self.points(source);
                turn(points, [0.0; 3], source);
            }
            12 => {
                // Of no unit, and small.
                let factor = 10f64.powf(0.7 * source.signed());
                self.points(source).iter_mut().for_each(|x| *x *= factor);
            }
            13 => bend(&mut self.joints[source.below(2)], source),
            14 => self.body.join(&wings(source)),
            15 => *self.garment = belt(source),
            16 => *self.garment = necklace(source),
            17 => *self.garment = cape(source),
            _ => {}
        }
    }

    /// The points of garment, body or one of the skeletons.
    fn points(&mut self, source: &mut Source) -> &mut Vec<f64> {
        match source.below(4) {
            0 => &mut self.garment.points,
            1 => &mut self.body.points,
            k => &mut self.joints[k - 2],
        }
    }

    /// All skin weights on one joint.
    fn bind_to_one(&mut self, source: &mut Source) {
        let (joints, vertices) = (self.joints[1].len() / 3, self.body.vertex_count());
        let root = source.below(joints.clamp(1, 256));
        *self.skin = (0..joints).flat_map(|joint| vec![f64::from(u8::from(joint == root)); vertices]).collect();
    }
}

/// A box somewhere beside the garment, such as a pouch.
fn piece(source: &mut Source) -> Shape {
    let size = source.within(0.01, 0.3);
    let mut shape = Shape::tube(2, 4, [-1.0, 1.0], true, |_| 1.4, |_| [0.0; 2]);
    shape.scale(size, [0; 3].map(|_| 0.8 * source.signed()));
    shape
}

/// A floor below the body.
fn floor(source: &mut Source) -> Shape {
    let half = source.within(0.5, 8.0);
    let z = -source.within(1.6, 3.0);
    Shape {
        points: vec![-half, -half, z, half, -half, z, half, half, z, -half, half, z],
        triangles: vec![0, 1, 2, 0, 2, 3],
    }
}

/// A part without a bone that sticks out of the body.
fn horn(source: &mut Source) -> Shape {
    let (length, radius, height) = (source.within(0.1, 1.5), source.within(0.01, 0.2), source.signed());
    let mut shape = Shape::tube(4, 5, [0.0, length], true, |_| radius, |_| [0.0; 2]);
    shape.points.as_chunks_mut::<3>().0.iter_mut().for_each(|p| *p = [p[2], p[1], height - p[0]]);
    shape
}

/// A pair of flat parts without a bone that stick out of the body to both sides.
fn wings(source: &mut Source) -> Shape {
    let (length, width, height) = (source.within(0.1, 2.0), source.within(0.05, 0.5), source.signed());
    let mut pair = Shape::default();
    for side in [1.0, -1.0] {
        let mut wing = Shape::tube(4, 6, [0.0, length], true, |_| width, |_| [0.0; 2]);
        wing.points
            .as_chunks_mut::<3>()
            .0
            .iter_mut()
            .for_each(|p| *p = [side * p[2], 0.1 * p[1], height - side * p[0]]);
        pair.join(&wing);
    }
    pair
}

/// A narrow band around the bones, tilted.
fn belt(source: &mut Source) -> Shape {
    let (half, radius) = (source.within(0.005, 0.1), source.within(0.1, 0.6));
    let mut band = Shape::tube(3, 10, [-half, half], false, |_| radius, |_| [0.0; 2]);
    turn(&mut band.points, [0.0; 3], source);
    band
}

/// A closed ring around the bones, tilted.
fn necklace(source: &mut Source) -> Shape {
    const AROUND: usize = 12;
    const SIDES: usize = 4;
    let (wire, radius) = (source.within(0.005, 0.05), source.within(0.1, 0.6));
    let mut ring = Shape::tube(AROUND + 1, SIDES, [0.0, std::f64::consts::TAU], false, |_| wire, |_| [0.0; 2]);
    // The last of its rows is the first.
    let vertices = AROUND * SIDES;
    ring.points.truncate(3 * vertices);
    ring.triangles.iter_mut().for_each(|v| *v %= vertices as u32);
    for p in ring.points.as_chunks_mut::<3>().0 {
        let (sin, cos) = p[2].sin_cos();
        *p = [(radius + p[0]) * cos, (radius + p[0]) * sin, p[1]];
    }
    turn(&mut ring.points, [0.0; 3], source);
    ring
}

/// A sheet around a part of the bones, which is closed at its upper end only: by a collar, or not at all.
fn cape(source: &mut Source) -> Shape {
    const SIDES: usize = 10;
    const RINGS: usize = 6;
    let (low, radius, flare) = (-source.within(0.1, 0.9), source.within(0.1, 0.5), source.within(0.0, 0.6));
    let mut cape = Shape::tube(RINGS, SIDES, [low, 0.8], false, |z| radius + flare * (0.8 - z), |_| [0.0; 2]);
    let (width, collar) = (source.between(3, SIDES - 1), source.below(3));
    let is_cloth = |quad: usize| quad % SIDES < width || quad / SIDES + 1 + collar >= RINGS;
    let kept = cape.triangles.chunks(3).enumerate().filter(|(t, _)| is_cloth(t / 2));
    cape.triangles = kept.flat_map(|(_, corners)| corners.to_vec()).collect();
    cape
}

/// Turned about an axis of coordinates through `centre`, by any angle.
fn turn(points: &mut [f64], centre: [f64; 3], source: &mut Source) {
    let axis = source.below(3);
    let [a, b] = [1, 2].map(|k| (axis + k) % 3);
    let (sin, cos) = (std::f64::consts::PI * source.signed()).sin_cos();
    for p in points.as_chunks_mut::<3>().0 {
        let [x, y] = [p[a] - centre[a], p[b] - centre[b]];
        (p[a], p[b]) = (centre[a] + cos * x - sin * y, centre[b] + sin * x + cos * y);
    }
}

/// The joints beyond one of them turned about it, as a limb in another pose.
fn bend(joints: &mut [f64], source: &mut Source) {
    let at = source.below((joints.len() / 3).clamp(1, 256));
    let Some(centre) = joints.as_chunks::<3>().0.get(at).copied() else { return };
    turn(&mut joints[3 * at + 3..], centre, source);
}

/// The corners of a triangle that the source chooses; none where there is none.
fn triangle(shape: &Shape, source: &mut Source) -> Option<(usize, [u32; 3])> {
    let count = shape.triangles.len() / 3;
    let t = usize::from(source.byte()) % count.max(1);
    let corners: [u32; 3] = shape.triangles.get(3 * t..3 * t + 3)?.try_into().ok()?;
    corners.iter().all(|&v| (v as usize) < shape.vertex_count()).then_some((t, corners))
}

fn point(shape: &Shape, v: u32) -> [f64; 3] {
    [0, 1, 2].map(|k| shape.points[3 * v as usize + k])
}

/// A T-junction: a vertex in the middle of an edge, on one side only.
fn split_edge(shape: &mut Shape, source: &mut Source) {
    let Some((t, [a, b, c])) = triangle(shape, source) else { return };
    let (p, q, m) = (point(shape, a), point(shape, b), shape.vertex_count() as u32);
    shape.points.extend([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
    shape.triangles.splice(3 * t..3 * t + 3, [a, m, c]);
    shape.triangles.extend([m, b, c]);
}

/// A patch that stands with one corner in the middle of a triangle.
fn touching_patch(shape: &mut Shape, source: &mut Source) {
    let Some((_, corners)) = triangle(shape, source) else { return };
    let p = corners.map(|v| point(shape, v));
    let middle = [0, 1, 2].map(|k| (p[0][k] + p[1][k] + p[2][k]) / 3.0);
    let [u, v] = [1, 2].map(|i| [0, 1, 2].map(|k| 0.2 * (p[i][k] - p[0][k])));
    let up = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let height = 4.0 * source.signed();
    let first = shape.vertex_count() as u32;
    shape.points.extend(middle);
    shape.points.extend([0, 1, 2].map(|k| middle[k] + u[k] + height * up[k]));
    shape.points.extend([0, 1, 2].map(|k| middle[k] + v[k] + height * up[k]));
    shape.triangles.extend([first, first + 1, first + 2]);
}

/// Left and right, front and back, or up and down exchanged: of one skeleton, of a skeleton with its body, or of the order of joints.
fn flip(joints: &mut [Vec<f64>; 2], body: &mut Shape, source: &mut Source) {
    let signs = [[-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [1.0, -1.0, -1.0]][source.below(3)];
    let flipped = |points: &mut Vec<f64>| points.iter_mut().enumerate().for_each(|(k, x)| *x *= signs[k % 3]);
    match source.below(4) {
        0 => flipped(&mut joints[0]),
        1 => flipped(&mut joints[1]),
        2 => {
            flipped(&mut joints[1]);
            flipped(&mut body.points);
        }
        _ => {
            let mut rows: Vec<[f64; 3]> = joints[1].as_chunks::<3>().0.to_vec();
            rows.reverse();
            joints[1] = rows.concat();
        }
    }
}

/// Without one triangle in so many.
fn thin_out(shape: &mut Shape, every: usize) {
    let kept = shape.triangles.chunks(3).enumerate().filter(|(t, _)| t % every != 0);
    shape.triangles = kept.flat_map(|(_, corners)| corners.to_vec()).collect();
}

/// Squares that are missing like the black ones of a board, so that the others hang together at corners.
fn bow_ties(shape: &mut Shape, width: usize) {
    let kept = shape.triangles.chunks(3).enumerate().filter(|(t, _)| (t / 2 / width).is_multiple_of(2));
    shape.triangles = kept.flat_map(|(_, corners)| corners.to_vec()).collect();
}
