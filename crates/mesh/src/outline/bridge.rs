//! A curve through points that bulge outward everywhere and that bulges nowhere inward: for points so few
//! that the nearest smooth arcs swing between them (Schumaker, SIAM J. Numer. Anal. 20 (1983) 853).

use super::Parabola;

/// A slope may change so much more on one half of an arc than on the other; beyond that the arcs meet at an
/// angle.
const LOPSIDED_RATIO: f64 = 3.0;

/// Rounding of a slope, over the steepest.
const ROUNDING_SLOPE: f64 = 1e-9;

/// Slopes between neighbours.
fn chords(points: &[[f64; 2]]) -> Vec<f64> {
    points.windows(2).map(|p| (p[1][1] - p[0][1]) / (p[1][0] - p[0][0])).collect()
}

/// True where `points` fall ever more steeply; `level`: from a slope of 0 on.
pub fn bulges(points: &[[f64; 2]], level: bool) -> bool {
    let chords = chords(points);
    let rounding = ROUNDING_SLOPE * chords.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    chords.windows(2).all(|c| c[1] <= c[0] + rounding) && (!level || chords[0] <= rounding)
}

/// Arcs from 0 on through `points` that [`bulges`] holds for, two between neighbours; the slope jumps at
/// `kinks`, and where no smooth curve bulges. `level`: the slope is 0 at 0.
pub fn bridge(points: &[[f64; 2]], kinks: &[usize], level: bool) -> Vec<Parabola> {
    let (chords, last) = (chords(points), points.len() - 1);
    // the slope of the parabola through a point and its neighbours, at an end that through the last two
    let inside = |i: usize| {
        let [before, after] = [i - 1, i].map(|k| points[k + 1][0] - points[k][0]);
        (before * chords[i] + after * chords[i - 1]) / (before + after)
    };
    let free = |i: usize| i > 0 && i < last && !kinks.contains(&i);
    let end = |chord: usize, beyond: usize| {
        let other = if free(beyond) { inside(beyond) } else { chords[chord] };
        2.0 * chords[chord] - other
    };
    let mut arcs: Vec<Parabola> = Vec::new();
    for (i, chord) in chords.iter().copied().enumerate() {
        let ([x, z], length) = (points[i], points[i + 1][0] - points[i][0]);
        let from = match i {
            0 if level && x == 0.0 => 0.0,
            _ if free(i) => inside(i),
            0 => end(0, 1).min(if level { 0.0 } else { f64::INFINITY }),
            _ => end(i, i + 1).min(inside(i)),
        };
        let to = match i + 1 {
            k if free(k) => inside(k),
            k if k == last => end(i, i),
            k => end(i, i).max(inside(k)),
        };
        // how much the slope falls on either half; the middle slope is the chord's
        let [mut before, mut after] = [(from - chord).max(0.0), (chord - to).max(0.0)];
        [before, after] = [before.min(LOPSIDED_RATIO * after), after.min(LOPSIDED_RATIO * before)];
        if i == 0 && x > 0.0 {
            let slope = chord + before;
            let bend = if level { 0.5 * slope / x } else { 0.0 };
            arcs.push(Parabola {
                x: 0.0,
                drop: z - x * (slope - bend * x),
                slope: slope - 2.0 * bend * x,
                bend,
            });
        }
        if before + after <= 0.0 {
            arcs.push(Parabola { x, drop: z, slope: chord, bend: 0.0 });
            continue;
        }
        let first = length * after / (before + after);
        let drop = z + first * (chord + 0.5 * before);
        arcs.push(Parabola { x, drop: z, slope: chord + before, bend: -0.5 * before / first });
        arcs.push(Parabola { x: x + first, drop, slope: chord, bend: -0.5 * after / (length - first) });
    }
    arcs
}

#[cfg(test)]
mod tests {
    use super::super::{Outline, deepest_dent};
    use super::*;

    fn outline(arcs: &[Parabola], end: f64) -> Outline {
        let upside_down = |a: &Parabola| Parabola { drop: -a.drop, slope: -a.slope, bend: -a.bend, ..*a };
        Outline::new(arcs.iter().map(upside_down).collect(), end, true).unwrap()
    }

    #[test]
    fn a_bridge_passes_its_points_and_bulges() {
        type Shape = (&'static str, fn(f64) -> f64);
        let shapes: [Shape; 5] = [
            ("power", |x| -x.powf(1.2)),
            ("cap", |x| (1.0 - 0.5 * x * x).sqrt()),
            ("cone with a tip", |x| if x < 0.3 { -x * x / 0.6 } else { 0.15 - x }),
            ("truncated", |x| if x < 0.4 { 0.0 } else { -2.0 * (x - 0.4) }),
            ("polygon", |x| -x - (x - 0.5).max(0.0) - 2.0 * (x - 0.75).max(0.0)),
        ];
        for (name, shape) in shapes {
            for count in [2, 3, 4, 7, 8, 12] {
                for first in [0, 1] {
                    let points: Vec<[f64; 2]> = (0..=count)
                        .map(|i| (f64::from(i) + 0.5 * f64::from(first)) / f64::from(count))
                        .map(|x| [x, shape(x)])
                        .collect();
                    for level in [false, true] {
                        assert!(bulges(&points, level), "{name} {count}");
                        let curve = outline(&bridge(&points, &[], level), points[points.len() - 1][0]);
                        let dent = deepest_dent(&curve);
                        assert!(dent.depth < 1e-12, "{name} {count} {first} {level}: {dent:?}");
                        for [x, z] in points.iter().copied() {
                            assert!((curve.depth_at(x) + z).abs() < 1e-12, "{name} {count} {x}");
                        }
                        assert!(!level || first == 0 || curve.drop_and_slope(0.0)[1].abs() < 1e-12);
                    }
                }
            }
        }
    }

    #[test]
    fn a_parabola_comes_back_and_a_kink_stays() {
        let points: Vec<[f64; 2]> = (0..=6).map(f64::from).map(|x| [x, -0.5 * x * x]).collect();
        let curve = outline(&bridge(&points, &[], true), 6.0);
        for k in 0..60 {
            let x = 0.1 * f64::from(k);
            assert!((curve.depth_at(x) - 0.5 * x * x).abs() < 1e-12, "{x}");
        }
        // two straight flanks that meet at 2
        let bent = |x: f64| -0.2 * x - (x - 2.0).max(0.0);
        let points: Vec<[f64; 2]> = (0..=4).map(f64::from).map(|x| [x, bent(x)]).collect();
        let curve = outline(&bridge(&points, &[2], false), 4.0);
        assert!([0.3, 1.9, 2.1, 3.7].iter().all(|x| (curve.depth_at(*x) + bent(*x)).abs() < 1e-12));
        assert!(!bulges(&[[0.0, 0.0], [1.0, -1.0], [2.0, -1.5]], false));
    }
}
