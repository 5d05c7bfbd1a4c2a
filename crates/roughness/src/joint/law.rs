//! Pressure over approach as one smooth, rising curve.

use super::path::JointPoint;

/// Points of the curve between two loads, where it is thinned or searched.
const FINE: usize = 64;
/// Slopes of a cubic so many times the chord's keep it rising (Fritsch and Carlson 1980).
const STEEPEST: f64 = 3.0;
/// Nodes and weights of Gauss's rule of four points on 0..1.
const GAUSS: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_71, 0.173_927_422_568_726_93],
    [0.330_009_478_207_571_87, 0.326_072_577_431_273_07],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
];

/// The approach as a function of the nominal pressure: between loads a cubic in the logarithm of the pressure
/// with the slopes that the stiffness gives, below the first load the power of the pressure that meets it
/// with its slope.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// ln p (Pa), δ (m), dδ/d ln p (m), rising.
    nodes: Vec<[f64; 3]>,
}

impl Law {
    /// Through the loads of `points` that carry something and come nearer with each; None of fewer than two.
    pub fn new(points: &[JointPoint]) -> Option<Law> {
        let mut nodes: Vec<[f64; 3]> = Vec::new();
        for point in points.iter().filter(|point| point.pressure > 0.0 && point.approach > 0.0) {
            let rises =
                nodes.last().is_none_or(|last| point.pressure.ln() > last[0] && point.approach > last[1]);
            if let Some(stiffness) = point.stiffness.filter(|_| rises) {
                nodes.push([point.pressure.ln(), point.approach, point.pressure / stiffness]);
            }
        }
        if nodes.len() < 2 {
            return None;
        }
        for i in 1..nodes.len() {
            let chord = (nodes[i][1] - nodes[i - 1][1]) / (nodes[i][0] - nodes[i - 1][0]);
            for k in [i - 1, i] {
                nodes[k][2] = nodes[k][2].min(STEEPEST * chord);
            }
        }
        Some(Law { nodes })
    }

    /// The smallest and the largest pressure that were computed, in Pa.
    pub fn range(&self) -> [f64; 2] {
        [0, self.nodes.len() - 1].map(|i| self.nodes[i][0].exp())
    }

    /// The approach at `pressure` (Pa), in m; beyond the largest load along its tangent.
    pub fn approach(&self, pressure: f64) -> f64 {
        let (first, last) = (self.nodes[0], self.nodes[self.nodes.len() - 1]);
        let [low, high] = self.range();
        if pressure <= low {
            return if pressure > 0.0 { first[1] * (pressure / low).powf(self.first_power()) } else { 0.0 };
        }
        if pressure >= high {
            return last[1] + last[2] * (pressure / high - 1.0);
        }
        let t = pressure.ln();
        let i = self.nodes.partition_point(|node| node[0] <= t).clamp(1, self.nodes.len() - 1);
        cubic(self.nodes[i - 1], self.nodes[i], t)[0]
    }

    /// d ln δ/d ln p below the first load.
    fn first_power(&self) -> f64 {
        self.nodes[0][2] / self.nodes[0][1]
    }

    /// ∫ p dδ to the largest load, in J/m²: the work done on the joint.
    pub fn work(&self) -> f64 {
        let [low, _] = self.range();
        let n = self.first_power();
        let before = low * self.nodes[0][1] * n / (n + 1.0);
        let piece = |pair: &[[f64; 3]]| {
            let width = pair[1][0] - pair[0][0];
            let at = |[x, weight]: [f64; 2]| {
                let t = pair[0][0] + x * width;
                weight * width * t.exp() * cubic(pair[0], pair[1], t)[1]
            };
            GAUSS.map(at).iter().sum::<f64>()
        };
        before + self.nodes.windows(2).map(piece).sum::<f64>()
    }

    /// Pressures close to each other from nothing to the largest load, in Pa.
    pub(super) fn fine_pressures(&self) -> Vec<f64> {
        let [low, _] = self.range();
        let first = (0..FINE).map(|k| low * k as f64 / FINE as f64);
        let between = |pair: &[[f64; 3]]| {
            let [from, to] = [pair[0][0], pair[1][0]];
            (0..FINE).map(move |k| (from + (to - from) * k as f64 / FINE as f64).exp())
        };
        let last = self.nodes[self.nodes.len() - 1][0].exp();
        first.chain(self.nodes.windows(2).flat_map(between)).chain([last]).collect()
    }

    /// Approach (m) and pressure (Pa) from first touch to the largest load, both rising: so few points that
    /// straight lines between them are off the curve by the share `tolerance` of the pressure at most, below
    /// the first load of that load.
    pub fn table(&self, tolerance: f64) -> Vec<[f64; 2]> {
        let curve: Vec<[f64; 2]> = self.fine_pressures().into_iter().map(|p| [self.approach(p), p]).collect();
        let [low, _] = self.range();
        let fits = |from: usize, to: usize| {
            let ([a, p], [b, q]) = (curve[from], curve[to]);
            let line = |x: f64| p + (q - p) * (x - a) / (b - a);
            curve[from + 1..to].iter().all(|[x, y]| (line(*x) - y).abs() <= tolerance * y.max(low))
        };
        let (mut table, mut from) = (vec![curve[0]], 0);
        while from + 1 < curve.len() {
            // the pieces of a curve that bends one way grow until they do not fit
            let mut to = from + 1;
            while to + 1 < curve.len() && fits(from, to + 1) {
                to += 1;
            }
            table.push(curve[to]);
            from = to;
        }
        table.dedup_by(|next, last| next[0] <= last[0] || next[1] <= last[1]);
        table
    }
}

/// Value and slope of the cubic between two nodes.
fn cubic(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 2] {
    let width = b[0] - a[0];
    let x = (t - a[0]) / width;
    let (m, n) = (a[2] * width, b[2] * width);
    let rise = b[1] - a[1];
    let (c, d) = (3.0 * rise - 2.0 * m - n, m + n - 2.0 * rise);
    [a[1] + x * (m + x * (c + x * d)), (m + x * (2.0 * c + 3.0 * x * d)) / width]
}
