//! Pressure over approach as one smooth, rising curve.

use super::path::JointPoint;
use asperity_numerics::monotone_cubic::MonotoneCubic;

/// Points of the curve between two loads, where it is thinned or searched.
const FINE: usize = 64;
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
    /// ln p (Pa), δ (m).
    curve: MonotoneCubic,
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
        Some(Law { curve: MonotoneCubic::with_slopes(nodes)? })
    }

    /// The first and the last of its nodes: ln p, δ, dδ/d ln p.
    fn ends(&self) -> [[f64; 3]; 2] {
        let nodes = self.curve.nodes();
        [nodes[0], nodes[nodes.len() - 1]]
    }

    /// The smallest and the largest pressure that were computed, in Pa.
    pub fn range(&self) -> [f64; 2] {
        self.ends().map(|node| node[0].exp())
    }

    /// The approach at `pressure` (Pa), in m; beyond the largest load along its tangent.
    pub fn approach(&self, pressure: f64) -> f64 {
        let [first, last] = self.ends();
        let [low, high] = self.range();
        if pressure <= low {
            return if pressure > 0.0 { first[1] * (pressure / low).powf(self.first_power()) } else { 0.0 };
        }
        if pressure >= high {
            return last[1] + last[2] * (pressure / high - 1.0);
        }
        self.curve.value_and_slope(pressure.ln())[0]
    }

    /// d ln δ/d ln p below the first load.
    fn first_power(&self) -> f64 {
        let [[_, approach, slope], _] = self.ends();
        slope / approach
    }

    /// ∫ p dδ to the largest load, in J/m²: the work done on the joint.
    pub fn work(&self) -> f64 {
        let [low, _] = self.range();
        let n = self.first_power();
        let before = low * self.ends()[0][1] * n / (n + 1.0);
        let piece = |pair: &[[f64; 3]]| {
            let width = pair[1][0] - pair[0][0];
            let at = |[x, weight]: [f64; 2]| {
                let t = pair[0][0] + x * width;
                weight * width * t.exp() * self.curve.value_and_slope(t)[1]
            };
            GAUSS.map(at).iter().sum::<f64>()
        };
        before + self.curve.nodes().windows(2).map(piece).sum::<f64>()
    }

    /// Pressures close to each other from nothing to the largest load, in Pa.
    pub(super) fn fine_pressures(&self) -> Vec<f64> {
        fine_pressures(&self.curve)
    }

    /// Approach (m) and pressure (Pa) from first touch to the largest load, both rising: so few points that
    /// straight lines between them are off the curve by the share `tolerance` of the pressure at most, below
    /// the first load of that load.
    pub fn table(&self, tolerance: f64) -> Vec<[f64; 2]> {
        let curve: Vec<[f64; 2]> = self.fine_pressures().into_iter().map(|p| [self.approach(p), p]).collect();
        let [low, _] = self.range();
        let mut table = thinned(&curve, tolerance, low);
        table.dedup_by(|next, last| next[0] <= last[0] || next[1] <= last[1]);
        table
    }
}

/// Pressures close to each other from nothing to the last node of a `curve` over ln p, in Pa.
pub(super) fn fine_pressures(curve: &MonotoneCubic) -> Vec<f64> {
    let nodes = curve.nodes();
    let first = (0..FINE).map(|k| nodes[0][0].exp() * k as f64 / FINE as f64);
    let between = |pair: &[[f64; 3]]| {
        let [from, to] = [pair[0][0], pair[1][0]];
        (0..FINE).map(move |k| (from + (to - from) * k as f64 / FINE as f64).exp())
    };
    first.chain(nodes.windows(2).flat_map(between)).chain([nodes[nodes.len() - 1][0].exp()]).collect()
}

/// So few of the points (x, y) of `curve`, rising in x, that straight lines between them are off the others
/// by the share `tolerance` of y at most, of `least` where y is less.
pub(super) fn thinned(curve: &[[f64; 2]], tolerance: f64, least: f64) -> Vec<[f64; 2]> {
    let fits = |from: usize, to: usize| {
        let ([a, p], [b, q]) = (curve[from], curve[to]);
        let line = |x: f64| p + (q - p) * (x - a) / (b - a);
        curve[from + 1..to].iter().all(|[x, y]| (line(*x) - y).abs() <= tolerance * y.max(least))
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
    table
}
