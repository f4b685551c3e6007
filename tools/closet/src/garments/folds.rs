//! Folds of cloth on an unrolled surface: ridges with a shallow valley on both sides.

/// A ridge between two points of the unrolled surface. Lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct Fold {
    /// Where it begins: around, along.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// How far its middle lies to the left of the straight line.
    pub bow: f64,
    /// Half the distance between its two valleys, about.
    pub width: f64,
    /// How far it stands out; negative for a crease.
    pub height: f64,
}

impl Fold {
    /// The height at a point, where going once around measures `period`.
    fn height(&self, [u, v]: [f64; 2], period: f64) -> f64 {
        let middle = f64::midpoint(self.from[0], self.to[0]);
        let u = u - period * ((u - middle) / period).round();
        let direction = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let length = direction[0].hypot(direction[1]);
        let d = [u - self.from[0], v - self.from[1]];
        // From -1 at one end to 1 at the other.
        let x = 2.0 * (d[0] * direction[0] + d[1] * direction[1]) / (length * length) - 1.0;
        if x.abs() >= 1.0 {
            return 0.0;
        }
        let side = (d[1] * direction[0] - d[0] * direction[1]) / length - self.bow * (1.0 - x * x);
        let y = (side / self.width).powi(2);
        self.height * (1.0 - x.powi(4)).powi(2) * (1.0 - 0.8 * y) * (-y).exp()
    }
}

/// Folds on one unrolled surface.
#[derive(Clone, Debug)]
pub struct Folds {
    /// What going once around measures, in metres.
    pub period: f64,
    /// The folds; where they cross, their heights add up.
    pub folds: Vec<Fold>,
}

impl Folds {
    /// How far the cloth stands out at a point of the unrolled surface, in metres.
    pub fn height(&self, point: [f64; 2]) -> f64 {
        self.folds.iter().map(|fold| fold.height(point, self.period)).sum()
    }

    /// How much of `edge` is left as edge length at a point: the share `fine` on a fold, all of it away from the folds.
    pub fn fineness(&self, point: [f64; 2], fine: f64) -> f64 {
        let most = self.folds.iter().map(|fold| {
            let wide = Fold { width: 1.6 * fold.width, height: 1.0, ..*fold };
            wide.height(point, self.period).clamp(0.0, 1.0)
        });
        1.0 - (1.0 - fine) * most.fold(0.0, f64::max)
    }
}

/// A step from 0 to 1, half of it at 0, over `width` on both sides.
pub fn step(x: f64, width: f64) -> f64 {
    let x = (x / width).clamp(-1.0, 1.0);
    0.5 + 0.25 * x * (3.0 - x * x)
}

/// A rounded ridge of height 1 at 0 that ends at `width` on both sides.
pub fn ridge(x: f64, width: f64) -> f64 {
    let x = (x / width).clamp(-1.0, 1.0);
    (1.0 - x * x).powi(2)
}
