//! Intervals of an edge with a pressure above zero: its roots, isolated between samples and found to the last
//! digits.

use crate::contact::parts::{NOTHING, Parts};

/// Samples along a piece on which a pressure is smooth, its ends included: between two of them it has one
/// extreme at most.
const SAMPLES_PER_PIECE: usize = 9;

/// Halvings of an interval around a root or an extreme.
const MOST_HALVINGS: usize = 100;

/// Parts of [-1, 1] where `pressure`, which is smooth between the `places`, is above zero: one, or both ends
/// or any two; a gap that would leave three is closed, the narrowest first.
pub fn parts_above_zero(pressure: impl Fn(f64) -> f64, places: &[f64]) -> Parts {
    let mut at: Vec<[f64; 2]> = vec![[-1.0, pressure(-1.0)]];
    let mut from = -1.0;
    for &to in places.iter().chain(&[1.0]) {
        let sample = |i: usize| from + (to - from) * i as f64 / (SAMPLES_PER_PIECE - 1) as f64;
        at.extend((1..SAMPLES_PER_PIECE).map(sample).map(|x| [x, pressure(x)]));
        from = to;
    }
    // an extreme of the other sign between samples of one sign parts two roots
    let extremes: Vec<[f64; 2]> = at
        .windows(3)
        .filter(|w| w.iter().all(|p| (p[1] > 0.0) == (w[1][1] > 0.0)))
        .filter(|w| w[1][1].abs() <= w[0][1].abs() && w[1][1].abs() <= w[2][1].abs())
        .map(|w| extreme(&pressure, w[0][0], w[2][0], w[1][1] > 0.0))
        .collect();
    at.extend(extremes);
    at.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut ends: Vec<f64> = Vec::new();
    if at[0][1] > 0.0 {
        ends.push(-1.0);
    }
    for pair in at.windows(2) {
        if (pair[0][1] > 0.0) != (pair[1][1] > 0.0) {
            ends.push(root(&pressure, pair[0], pair[1]));
        }
    }
    if ends.len() % 2 == 1 {
        ends.push(1.0);
    }
    while ends.len() > 4 {
        let gap = |k: usize| ends[2 * k + 2] - ends[2 * k + 1];
        let narrowest = (0..ends.len() / 2 - 1).min_by(|&a, &b| gap(a).total_cmp(&gap(b))).unwrap_or(0);
        ends.drain(2 * narrowest + 1..2 * narrowest + 3);
    }
    match ends[..] {
        [a, b] => [Some([a, b]), None],
        [a, b, c, d] => [Some([a, b]), Some([c, d])],
        _ => NOTHING,
    }
}

/// The root between two places of different sign: secants, halved where they stay on one side (the Illinois
/// rule).
fn root(pressure: &impl Fn(f64) -> f64, from: [f64; 2], to: [f64; 2]) -> f64 {
    let ([mut a, mut fa], [mut b, mut fb]) = (from, to);
    for _ in 0..MOST_HALVINGS {
        let x = b - fb * (b - a) / (fb - fa);
        if (x - b).abs() <= 1e-15 {
            break;
        }
        let fx = pressure(x);
        if (fx > 0.0) == (fb > 0.0) {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (x, fx);
        if fx == 0.0 {
            break;
        }
    }
    b
}

/// The place in [a, b] where `pressure` is least (if it is `positive`) or greatest, by golden sections.
fn extreme(pressure: &impl Fn(f64) -> f64, mut a: f64, mut b: f64, positive: bool) -> [f64; 2] {
    const GOLDEN_SHARE: f64 = 0.618_033_988_749_894_9;
    let sign = if positive { 1.0 } else { -1.0 };
    let value = |x: f64| sign * pressure(x);
    let (mut c, mut d) = (b - GOLDEN_SHARE * (b - a), a + GOLDEN_SHARE * (b - a));
    let (mut fc, mut fd) = (value(c), value(d));
    for _ in 0..MOST_HALVINGS {
        if fc.min(fd) <= 0.0 || b - a < 1e-9 {
            break;
        }
        if fc < fd {
            (b, d, fd) = (d, c, fc);
            c = b - GOLDEN_SHARE * (b - a);
            fc = value(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + GOLDEN_SHARE * (b - a);
            fd = value(d);
        }
    }
    if fc < fd { [c, sign * fc] } else { [d, sign * fd] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_where_the_pressure_is_zero() {
        let close = |parts: Parts, expected: &[[f64; 2]]| {
            let found: Vec<[f64; 2]> = parts.into_iter().flatten().collect();
            assert_eq!(found.len(), expected.len(), "{found:?}");
            for (f, e) in found.iter().zip(expected) {
                assert!((f[0] - e[0]).abs() < 1e-12 && (f[1] - e[1]).abs() < 1e-12, "{found:?}");
            }
        };
        let above_zero = |pressure: fn(f64) -> f64| parts_above_zero(pressure, &[]);
        close(above_zero(|_| 1.0), &[[-1.0, 1.0]]);
        close(above_zero(|_| -1.0), &[]);
        close(above_zero(|x| x - 0.3), &[[0.3, 1.0]]);
        close(above_zero(|x| 0.01 - (x - 0.1).powi(2)), &[[0.0, 0.2]]);
        close(above_zero(|x| (x - 0.1).powi(2) - 0.0001), &[[-1.0, 0.09], [0.11, 1.0]]);
        // a bump between two samples
        close(above_zero(|x| 1e-6 - (x - 0.13).powi(2)), &[[0.129, 0.131]]);
        close(above_zero(|x| (x + 0.5) * (x - 0.2) * (x - 0.3) * (x - 0.9)), &[[-1.0, -0.5], [0.2, 1.0]]);
        // of three parts the two that are closest are one
        let three = |x: f64| -(x + 0.9) * (x + 0.6) * (x + 0.1) * (x - 0.2) * (x - 0.3) * (x - 0.8);
        close(above_zero(three), &[[-0.9, -0.6], [-0.1, 0.8]]);
        let mirrored = |x: f64| -(x - 0.9) * (x - 0.6) * (x - 0.1) * (x + 0.2) * (x + 0.3) * (x + 0.8);
        close(above_zero(mirrored), &[[-0.8, 0.1], [0.6, 0.9]]);
        // a bump that is narrow beside the samples of the edge, between two places
        let bump = |x: f64| if (0.3..0.302).contains(&x) { 0.0005 - (x - 0.301).abs() } else { -0.0005 };
        close(parts_above_zero(bump, &[0.3, 0.301, 0.302]), &[[0.3005, 0.3015]]);
    }
}
