//! The curvature of a distance: along which motions it becomes smaller than its gradient says.
//!
//! The distance d of two primitives is the least length of `r(x, y)` over the parameters y of the closest points (s and u of
//! two edges, two barycentric coordinates of a triangle; fewer where the closest points lie on a border). With the normal
//! `n = r / d`, the columns `J_k = dr/dy_k` and `G = J^T J`, the implicit function theorem gives its second derivative
//!
//! ```text
//! d2d = W^T (I - n n^T - J G^-1 J^T) W / d - M^T A - A^T M,
//! W = dr/dx,    M_k = n . dJ_k,    A = G^-1 (J^T W + d M / 2).
//! ```
//!
//! The first part is zero where both parameters are free, and never negative. The second is of both signs: it is there that
//! a step tangential to both primitives closes a small gap. Row by row
//!
//! ```text
//! M_k^T A_k + A_k^T M_k = (q^T q - p^T p) / 2,    q, p = l M_k +- A_k / l,    l^2 = |A_k| / |M_k|,
//! ```
//!
//! where, with a row alone, q and p are the eigenvectors: along q the distance closes, along p it opens.

use glam::DVec3;

use super::distance::{PairType, Separation};

/// A linear form in the motions of the four vertices of a pair.
pub type Form = [DVec3; 4];

/// The closest point of a primitive moves along an edge: the edge's vertices, from and to, and how r changes.
struct Slide {
    ends: [usize; 2],
    column: DVec3,
}

impl Slide {
    /// Adds the form `by . (dx_to - dx_from)`.
    fn add(&self, by: DVec3, form: &mut Form) {
        form[self.ends[0]] -= by;
        form[self.ends[1]] += by;
    }
}

/// A row of the second derivative: `-(closing^2 - opening^2) / 2` along a motion.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// q.
    pub closing: Form,
    /// p.
    pub opening: Form,
}

/// The second part of the second derivative of the distance. None where no parameter is free, and where they are not
/// determined (parallel edges).
pub fn bends(pair_type: PairType, x: &[DVec3; 4], separation: &Separation) -> [Option<Bend>; 2] {
    let slides = slides(pair_type, x, &separation.weights);
    let Some(inverse) = inverse_gram(&slides) else { return [None; 2] };
    let distance = separation.squared.sqrt();
    let normal = separation.vector / distance;
    std::array::from_fn(|k| {
        let own = slides[k].as_ref()?;
        // Row k of A.
        let (mut dual, mut a) = (DVec3::ZERO, [DVec3::ZERO; 4]);
        for (slide, inverse) in slides.iter().zip(inverse[k]) {
            let Some(slide) = slide else { continue };
            dual += inverse * slide.column;
            slide.add(0.5 * distance * inverse * normal, &mut a);
        }
        a.iter_mut().zip(separation.weights).for_each(|(a, w)| *a += w * dual);
        // |M_k|^2 is 2.
        let l = (0.5 * a.iter().map(|a| a.length_squared()).sum::<f64>()).sqrt().sqrt();
        let part = a.map(|a| a / l);
        if !part.iter().all(|a| a.is_finite()) {
            return None;
        }
        let (mut closing, mut opening) = (part, part.map(|a| -a));
        own.add(l * normal, &mut closing);
        own.add(l * normal, &mut opening);
        Some(Bend { closing, opening })
    })
}

/// The parameters that are free: those of closest points in the inside of an edge or a triangle.
fn slides(pair_type: PairType, x: &[DVec3; 4], weights: &[f64; 4]) -> [Option<Slide>; 2] {
    let slide = |ends: [usize; 2]| Slide { ends, column: x[ends[1]] - x[ends[0]] };
    let is_in = |i: usize| weights[i] != 0.0;
    match pair_type {
        // r grows by the first edge and shrinks by the second.
        PairType::EdgeEdge => [[0, 1], [3, 2]].map(|ends| (is_in(ends[0]) && is_in(ends[1])).then(|| slide(ends))),
        // The closest point is given by its shares of all corners but the first that takes part.
        PairType::PointTriangle => match [is_in(1), is_in(2), is_in(3)] {
            [true, true, true] => [Some(slide([2, 1])), Some(slide([3, 1]))],
            [true, true, false] => [Some(slide([2, 1])), None],
            [true, false, true] => [Some(slide([3, 1])), None],
            [false, true, true] => [Some(slide([3, 2])), None],
            _ => [None, None],
        },
    }
}

/// The inverse of `G`, zero in the rows of parameters that are not free. `None` where there is none.
fn inverse_gram(slides: &[Option<Slide>; 2]) -> Option<[[f64; 2]; 2]> {
    let [first, second] = slides.each_ref().map(|slide| slide.as_ref().map(|slide| slide.column));
    let inverse = match (first, second) {
        (Some(u), Some(v)) => {
            let [uu, uv, vv] = [u.length_squared(), u.dot(v), v.length_squared()];
            let det = u.cross(v).length_squared();
            [[vv / det, -uv / det], [-uv / det, uu / det]]
        }
        (Some(u), None) => [[u.length_squared().recip(), 0.0], [0.0; 2]],
        (None, Some(v)) => [[0.0; 2], [0.0, v.length_squared().recip()]],
        (None, None) => return None,
    };
    inverse.as_flattened().iter().all(|v| v.is_finite()).then_some(inverse)
}
