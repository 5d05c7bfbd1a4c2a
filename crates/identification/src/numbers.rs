//! Numbers of a result: what was sought with its interval, a point of the stress-strain curve, residuals.

use schemars::JsonSchema;
use serde::Serialize;

/// Yield stress at a plastic strain with its 95 % interval, MPa.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(non_snake_case, reason = "names of the file")]
pub struct StressAt {
    /// Plastic strain.
    pub plastic_strain: f64,
    /// The best value.
    pub value_MPa: f64,
    /// Lower end.
    pub low_MPa: f64,
    /// Upper end.
    pub high_MPa: f64,
}

/// A number that was sought, with its 95 % interval.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Found {
    /// The best value.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// Unit of the three.
    pub unit: &'static str,
    /// True where the measurements tell it: the model fits and no remark doubts it, the interval lies within
    /// ±15 % of the value (±0.05 of n), and no bound cuts it, neither its own nor that of an unknown it is
    /// tied to.
    pub identifiable: bool,
    /// True where the lower and the upper end are the bounds of the search.
    pub at_bound: [bool; 2],
    /// Several metals that fit, each with its own interval, the best one first; else empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub branches: Vec<Branch>,
}

/// A number of one of several metals that fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Branch {
    /// The best value.
    pub value: f64,
    /// Lower end of the interval of this metal.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Sum of squares at the best value.
    pub chi2: f64,
}

/// Residual of the fit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Residual {
    /// Sum of squares in standard deviations.
    pub chi2: f64,
    /// The largest that chance allows.
    pub chi2_limit: f64,
    /// True where neither that nor the sum of any measurement is larger, and every imprint is in accord with
    /// the rest.
    pub fits: bool,
    /// Measured numbers less unknowns.
    pub degrees_of_freedom: i64,
    /// Of each measurement: name, root mean square of the relative differences of its forces (features),
    /// noise used.
    pub curves: Vec<CurveResidual>,
    /// Of each imprint beside other measurements: whether one metal explains it and them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub accords: Vec<Accord>,
}

/// Accord of an imprint with the other measurements.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Accord {
    /// The imprint.
    pub measurement: String,
    /// Growth of the sum of squares because one metal has to serve the imprint and the others, over the sum
    /// of both by themselves, with the noise that the others have by themselves.
    pub growth: f64,
    /// The largest that chance allows.
    pub growth_limit: f64,
    /// True where it is not larger.
    pub holds: bool,
}

/// Residual of one measurement.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CurveResidual {
    /// Its name.
    pub name: String,
    /// Root mean square of the relative differences of forces, of features.
    pub rms: f64,
    /// Standard deviation that was given or taken from the scatter.
    pub noise: f64,
    /// Sum of squares of its differences in standard deviations.
    pub chi2: f64,
    /// The largest that chance allows.
    pub chi2_limit: f64,
}

/// The largest sum of squares that chance allows: three standard deviations above what is expected of so many
/// degrees of freedom, with [room for the noise](room_for_the_noise); that of none has to be small.
pub fn limit(freedom: i64, room: f64) -> f64 {
    let free = freedom.max(0) as f64;
    free + 3.0 * (2.0 * free).sqrt() + 4.0 + room
}

/// Growth of the largest sum of squares of `count` differences that chance allows, where the variance of
/// their noise was itself taken from readings with so many degrees of `freedom`: the logarithm of the ratio
/// of two variances scatters by √(2/N + 2/ν).
pub fn room_for_the_noise(count: usize, freedom: f64) -> f64 {
    let count = count as f64;
    let most = |scatter: f64| count * (3.0 * scatter.sqrt()).exp();
    most(2.0 / count + 2.0 / freedom) - most(2.0 / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ratio of two variances with 75 and 25 degrees of freedom is above 2.4 in 0.8 % and above 3.0 in
    /// 0.15 % (the integral of F); above 1.6 in 0.1 % where the second is known.
    #[test]
    fn a_sum_of_squares_may_be_off_as_much_as_its_noise() {
        let room = room_for_the_noise(75, 25.0);
        assert!(2.4 * 75.0 <= limit(75, room) && 2.4 * 75.0 > limit(75, 0.0));
        assert!(3.0 * 75.0 > limit(75, room));
        assert!(room_for_the_noise(75, 1e6) < 0.1);
    }
}
