//! A measured curve made ready: its loading and its last unloading, thinned by averaging; holds and other
//! cycles cut.

use super::unloading_parabola::UnloadingParabola;
use asperity_formats::indentation::Readings;
use asperity_numerics::least_squares::Line;

/// A curve made ready.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Loading, rising in depth.
    pub loading: Vec<[f64; 2]>,
    /// Unloading from the peak, falling in force; empty where there is none.
    pub unloading: Vec<[f64; 2]>,
    /// Depth and force where the unloading begins.
    pub peak: [f64; 2],
    /// Depth where the loading ended: less than that of the peak where the load was held there.
    pub loaded: f64,
    /// Readings that a point of the loading and one of the unloading are the mean of.
    pub averaged: [f64; 2],
    /// Standard deviation of the depth of one reading of the unloading at its force; 0 of too few readings.
    pub scatter_of_the_unloading: f64,
    /// Remarks.
    pub notes: Vec<String>,
}

/// Points that are kept of loading and unloading.
const KEPT_POINTS: [usize; 2] = [30, 20];
/// Shares of the deepest depth from which loading counts, and of the peak force between which unloading
/// counts.
const LOADING_DEPTH_SHARE: f64 = 0.1;
const UNLOADING_FORCE_SHARES: [f64; 2] = [0.1, 0.97];
/// Fewest points of a loading.
const MIN_LOADING_POINTS: usize = 6;
/// Share of the peak force from which readings belong to the peak or its hold.
const PEAK_FORCE_SHARE: f64 = 0.995;
/// Most neighbours on each side that tell whether the peak is reached.
const MOST_NEIGHBOURS: usize = 4;
/// Readings of an unloading for each of these neighbours.
const READINGS_PER_NEIGHBOUR: usize = 40;
/// Share of the largest force from which a reading may be the deepest one: noise makes the largest force, not
/// the turn of the path.
const DEEPEST_FORCE_SHARE: f64 = 0.8;
/// Share of the largest depth from which readings belong to the turn.
const TURN_DEPTH_SHARE: f64 = 0.999;
/// Growth of the force over that of the depth, both relative, below which readings are a hold: that of a
/// loading is 1 at least, as in the force of a ball on metal that does not harden.
const HOLD_GROWTH: f64 = 0.5;
/// Twice the logarithm of how much likelier a hold has to be than a loading by the noise of the forces: 20
/// times. Where there are so many times more readings than over the same depth before, that of how much less
/// likely it may be.
const HOLD_EVIDENCE: f64 = 6.0;
const HOLD_DENSITY: usize = 3;
/// Share of the deepest depth above which a loading tells its noise.
const NOISE_DEPTH_SHARE: f64 = 0.5;
/// Share of the deepest depth above which a loading shows where the tool touches.
const TOUCH_DEPTH_SHARE: f64 = 0.4;

impl Measured {
    /// Makes `readings` ready.
    ///
    /// # Errors
    /// The fault of the curve, with a way out.
    pub fn new(readings: &Readings) -> Result<Measured, String> {
        let given = readings.len();
        let readings: Readings =
            readings.iter().copied().filter(|p| p.iter().all(|x| x.is_finite())).collect();
        let most = readings.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
        if readings.len() < MIN_LOADING_POINTS {
            return Err(format!(
                "has {} points, too few for a curve: give at least {MIN_LOADING_POINTS} of the loading, or `features` instead of a file",
                readings.len()
            ));
        }
        if most.is_nan() || most <= 0.0 {
            return Err(
                "has no positive force: forces must be positive in compression; turn their sign".into()
            );
        }
        let Turn { first, last, peak } = turn(&readings, most);
        if peak[0] <= 0.0 {
            return Err(format!(
                "has its largest force at a depth of {:.4} um, which is not positive: depths must grow into the metal from 0 at first touch; turn their sign, or shift them",
                1e6 * peak[0]
            ));
        }
        let mut notes = Vec::new();
        if readings.len() < given {
            notes.push(format!(
                "{} readings that are no finite numbers were left out",
                given - readings.len()
            ));
        }
        let loading = envelope(&readings[..=first], &mut notes);
        if loading.len() < MIN_LOADING_POINTS {
            return Err(format!(
                "goes nowhere: only {} points before its largest force lie deeper than those before them; the loading must come first and needs {MIN_LOADING_POINTS} (an unloading that stands as a test of its own belongs below the loading, under the same header)",
                loading.len()
            ));
        }
        let start = loading[loading.len() - 1];
        let held = peak[0] > 1.003 * start[0] && is_held(&loading, &readings[first..=last], peak);
        if held {
            notes.push(format!(
                "a hold of the load from {:.4} to {:.4} um was cut; the loading before it counts",
                1e6 * start[0],
                1e6 * peak[0]
            ));
        }
        let loaded = if held { start[0] } else { peak[0] };
        let inside = falling(&readings[last..], peak);
        // of forces that scatter, and of depths that do so themselves
        let scatter_of_the_unloading = UnloadingParabola::new(&inside, peak[1]).scatter(&inside);
        let (unloading, of_the_unloading) = averaged_by_depth(&inside, peak);
        if unloading.is_empty() {
            notes.push("there is no unloading: the elastic modulus is hardly seen".into());
        }
        let (loading, of_the_loading) = thinned(&loading);
        let averaged = [of_the_loading, of_the_unloading];
        Ok(Measured { loading, unloading, peak, loaded, averaged, scatter_of_the_unloading, notes })
    }

    /// Depth reading at which the tool seems to touch, if its force grows with that `power` of the depth:
    /// where the line through the upper part of F^(1/power) meets zero.
    pub fn touches(&self, power: f64) -> f64 {
        let deepest = self.loading.last().map_or(1.0, |p| p[0]);
        let upper = self.loading.iter().filter(|p| p[0] > TOUCH_DEPTH_SHARE * deepest);
        let upper: Vec<[f64; 2]> = upper.map(|p| [p[1].powf(1.0 / power), p[0]]).collect();
        let mean = |k: usize| upper.iter().map(|p| p[k]).sum::<f64>() / upper.len().max(1) as f64;
        mean(1) - Line::fit(&upper).slope * mean(0)
    }

    /// Depths where the loading ended and where the unloading began, and the force there.
    pub fn turn(&self) -> [f64; 3] {
        [self.loaded, self.peak[0], self.peak[1]]
    }
}

/// The point at which a path turns.
struct Turn {
    /// The reading with which the loading ends: a hold may follow.
    first: usize,
    /// The deepest reading, the last one before the unloading.
    last: usize,
    /// Depth there, and the mean force of the readings at that depth.
    peak: [f64; 2],
}

/// The turn of a path whose largest force is `most`: it lies at the largest depth, for depths are read more
/// exactly than forces.
fn turn(readings: &[[f64; 2]], most: f64) -> Turn {
    let high = |p: &[f64; 2]| p[1] >= DEEPEST_FORCE_SHARE * most;
    let deepest = readings.iter().filter(|p| high(p)).map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
    let at_the_turn = |p: &[f64; 2]| high(p) && p[0] >= deepest - (1.0 - TURN_DEPTH_SHARE) * deepest.abs();
    let last = readings.iter().position(|p| high(p) && p[0] >= deepest).unwrap_or(0);
    // the way back, which is steep, is no part of it
    let turned: Vec<f64> = readings[..=last].iter().filter(|p| at_the_turn(p)).map(|p| p[1]).collect();
    let force = turned.iter().sum::<f64>() / turned.len().max(1) as f64;
    let first = first_at(&readings[..=last], force);
    Turn { first, last, peak: [readings[last][0], force] }
}

/// The first of the `readings` at whose place the force has come to that of the `peak`: where a hold follows
/// by the mean with its neighbours, for noise lifts one on the way up as far. Those just before it that are
/// there one by one belong to it: the mean comes late where forces do not scatter.
fn first_at(readings: &[[f64; 2]], peak: f64) -> usize {
    let least = PEAK_FORCE_SHARE * peak;
    let there = readings.iter().filter(|p| p[1] >= least).count();
    let side = (there / 4).min(MOST_NEIGHBOURS);
    let late =
        (0..readings.len()).find(|i| mean_force(readings, *i, side) >= least).unwrap_or(readings.len() - 1);
    let at_the_peak = |p: &&[f64; 2]| (p[1] - peak).abs() <= peak - least;
    let steady = readings[late..].iter().take_while(at_the_peak).count() >= 2 * side;
    let before = readings[..late].iter().rev().take(side).take_while(at_the_peak).count();
    if steady { late - before } else { late }
}

/// True where the force stayed while the depth grew over `readings` up to the `peak`: by more than the
/// scatter of the `loading` before them makes of a force that grows, or for longer.
fn is_held(loading: &[[f64; 2]], readings: &[[f64; 2]], peak: [f64; 2]) -> bool {
    let held: Vec<[f64; 2]> = readings.iter().map(|p| [p[0] / peak[0], p[1] / peak[1]]).collect();
    let start = loading.last().map_or(0.0, |p| p[0]);
    let before = loading.iter().filter(|p| p[0] > 2.0 * start - peak[0]).count();
    let sign = if held.len() > HOLD_DENSITY * before { -1.0 } else { 1.0 };
    let evidence = 2.0 * (HOLD_GROWTH - Line::fit(&held).slope) * spread(&held);
    held.len() > 2 && evidence > sign * HOLD_EVIDENCE * scatter(loading)
}

/// Relative variance of the forces of a loading about a power of the depth, in its upper part.
fn scatter(loading: &[[f64; 2]]) -> f64 {
    let deepest = loading.last().map_or(1.0, |p| p[0]);
    let upper = loading.iter().filter(|p| p[0] > NOISE_DEPTH_SHARE * deepest);
    let upper: Vec<[f64; 2]> = upper.map(|p| [p[0].ln(), p[1].ln()]).collect();
    Line::fit(&upper).slope_error.powi(2) * spread(&upper)
}

/// Sum of squares of the places about their mean.
fn spread(points: &[[f64; 2]]) -> f64 {
    let middle = points.iter().map(|p| p[0]).sum::<f64>() / points.len() as f64;
    points.iter().map(|p| (p[0] - middle).powi(2)).sum()
}

/// The points deeper than all before them, under a force.
fn envelope(readings: &[[f64; 2]], notes: &mut Vec<String>) -> Vec<[f64; 2]> {
    let most = readings.iter().map(|p| p[1]).fold(0.0, f64::max);
    let (mut deepest, mut back) = (0.0_f64, 0.0_f64);
    let mut kept = Vec::new();
    for p in readings {
        // before first touch a tool may come from anywhere
        if deepest > 0.0 {
            back = back.max(deepest - p[0]);
        }
        if p[0] > deepest && p[1] > 0.0 {
            deepest = p[0];
            kept.push(*p);
        }
    }
    if back > 0.05 * deepest && kept.iter().any(|p| p[1] < 0.9 * most) {
        notes.push("there are several cycles: their outer loading and the last unloading count".into());
    }
    kept
}

/// The readings of the unloading between the shares of the peak force.
fn falling(readings: &[[f64; 2]], peak: [f64; 2]) -> Vec<[f64; 2]> {
    let [low, high] = UNLOADING_FORCE_SHARES.map(|share| share * peak[1]);
    let side = (readings.len() / READINGS_PER_NEIGHBOUR).min(MOST_NEIGHBOURS);
    let mean = |i: usize| mean_force(readings, i, side);
    let Some(first) = (0..readings.len()).find(|&i| mean(i) <= high) else { return Vec::new() };
    let last = (first..readings.len()).find(|&i| mean(i) < low).unwrap_or(readings.len());
    readings[first..last].iter().copied().filter(|p| p[0] < peak[0] * 1.001 && p[1] > 0.0).collect()
}

/// Averages of an unloading over equal parts of its way, and how many readings each is the mean of: a choice
/// by forces would choose their noise too, and so their mean.
fn averaged_by_depth(inside: &[[f64; 2]], peak: [f64; 2]) -> (Vec<[f64; 2]>, f64) {
    let depths = || inside.iter().map(|p| p[0]);
    let (top, bottom) = (depths().fold(f64::NEG_INFINITY, f64::max), depths().fold(f64::INFINITY, f64::min));
    let way = (top - bottom).max(f64::MIN_POSITIVE);
    let (mut points, of_a_point) = averaged(inside, KEPT_POINTS[1], |p| (top - p[0]) / way, |x| x);
    points.retain(|p| p[1] < peak[1]);
    (points, of_a_point)
}

/// Mean force of reading `i` and of so many neighbours on each side.
fn mean_force(readings: &[[f64; 2]], i: usize, side: usize) -> f64 {
    let around = &readings[i.saturating_sub(side)..(i + side + 1).min(readings.len())];
    around.iter().map(|p| p[1]).sum::<f64>() / around.len() as f64
}

fn thinned(loading: &[[f64; 2]]) -> (Vec<[f64; 2]>, f64) {
    let deepest = loading.last().map_or(1.0, |p| p[0]);
    let inside: Vec<[f64; 2]> =
        loading.iter().copied().filter(|p| p[0] >= LOADING_DEPTH_SHARE * deepest).collect();
    // in logarithms loading is nearly straight, so that its average lies on it
    let logs: Vec<[f64; 2]> = inside.iter().map(|p| p.map(f64::ln)).collect();
    averaged(&logs, KEPT_POINTS[0], |p| p[0].exp() / deepest, f64::exp)
}

/// Averages of `points` over at most `count` equal parts of `place`, which goes from 0 to 1; and the number
/// of points in each, as a harmonic mean: the mean variance of the averages goes with its inverse.
fn averaged(
    points: &[[f64; 2]],
    count: usize,
    place: impl Fn(&[f64; 2]) -> f64,
    of_mean: impl Fn(f64) -> f64,
) -> (Vec<[f64; 2]>, f64) {
    let mut parts = vec![(0.0, [0.0; 2]); count];
    for p in points {
        let part = &mut parts[((place(p) * count as f64) as usize).min(count - 1)];
        part.0 += 1.0;
        part.1 = [part.1[0] + p[0], part.1[1] + p[1]];
    }
    let filled = || parts.iter().filter(|p| p.0 > 0.0);
    let inverse = filled().map(|(n, _)| 1.0 / n).sum::<f64>() / filled().count().max(1) as f64;
    let means = filled().map(|(n, sum)| sum.map(|s| of_mean(s / n))).collect();
    (means, if inverse > 0.0 { 1.0 / inverse } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loaded(count: usize) -> Readings {
        (1..=count).map(|i| i as f64 / count as f64).map(|s| [1e-6 * s, 5e-3 * s * s]).collect()
    }

    /// A number of nearly the normal law: the sum of twelve of a fixed generator.
    fn normal(seed: &mut u64) -> f64 {
        let mut uniform = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }

    #[test]
    fn a_curve_is_thinned_to_points_that_lie_on_it() {
        let mut readings = loaded(3000);
        readings
            .extend((0..500).map(|i| 1.0 - f64::from(i) / 500.0).map(|s| [0.9e-6 + 0.1e-6 * s, 5e-3 * s]));
        let measured = Measured::new(&readings).unwrap();
        assert!(measured.loading.len() <= KEPT_POINTS[0] && measured.loading.len() >= 20);
        assert!(measured.unloading.len() >= 15 && measured.touches(2.0).abs() < 1e-9);
        for p in &measured.loading {
            assert!((p[1] / (5e9 * p[0] * p[0]) - 1.0).abs() < 1e-9, "{p:?}");
        }
        for p in &measured.unloading {
            assert!(((p[0] - 0.9e-6) / 0.1e-6 * 5e-3 / p[1] - 1.0).abs() < 1e-6, "{p:?}");
        }
    }

    #[test]
    fn what_is_no_curve_is_refused_with_a_way_out() {
        let single = vec![[1e-6, 1e-3]];
        let negative: Readings = loaded(50).iter().map(|p| [-p[0], p[1]]).collect();
        let pulled: Readings = loaded(50).iter().map(|p| [p[0], -p[1]]).collect();
        let flat: Readings = (0..50).map(|i| [1e-6, 1e-3 * f64::from(i)]).collect();
        for (readings, word) in [
            (single, "too few"),
            (negative, "turn their sign"),
            (pulled, "positive force"),
            (flat, "goes nowhere"),
        ] {
            let error = Measured::new(&readings).unwrap_err();
            assert!(error.contains(word), "{error}");
        }
        assert!(Measured::new(&loaded(50)).unwrap().notes[0].contains("no unloading"));
    }

    #[test]
    fn holds_and_inner_cycles_are_cut() {
        let mut readings = loaded(60);
        readings.truncate(40);
        // back to half of the force, and again
        readings.extend((0..20).map(|i| [0.6e-6 - 1e-9 * f64::from(i), 2.2e-3 - 1e-4 * f64::from(i)]));
        readings.extend(loaded(60)[35..].iter());
        readings.extend((1..30).map(|i| [1e-6 + 1e-9 * f64::from(i), 5e-3]));
        let measured = Measured::new(&readings).unwrap();
        let notes = measured.notes.join("; ");
        assert!(notes.contains("cycles") && notes.contains("hold"), "{notes}");
        assert!(measured.loading.windows(2).all(|w| w[0][0] < w[1][0]));
    }

    /// Forces with noise of 0.7 % before a hold without creep: a force on the way up that noise lifts to the
    /// peak is not the beginning of the hold.
    #[test]
    fn noisy_forces_on_the_way_up_begin_no_hold() {
        let mut seed = 3_u64;
        let mut noise = || 0.007 * normal(&mut seed);
        for case in 0..50 {
            // equal steps of force
            let shares = (1..=300).map(|i| f64::from(i) / 300.0);
            let mut readings: Readings = shares.map(|s| [1e-6 * s.sqrt(), 5e-3 * s]).collect();
            readings.extend((0..60).map(|i| [1e-6 + 1e-12 * f64::from(i % 7), 5e-3]));
            readings.extend(
                (1..150).map(|i| f64::from(i) / 150.0).map(|s| [1e-6 * (1.0 - 0.1 * s), 5e-3 * (1.0 - s)]),
            );
            for p in &mut readings {
                p[1] *= 1.0 + noise();
            }
            let measured = Measured::new(&readings).unwrap();
            // half a percent of the force is a quarter of one of the depth; a mean of nine is off as far
            let early = 1.0 - measured.loaded / measured.peak[0];
            assert!(early < 0.006, "{case}: {early}, {:?}", measured.notes);
        }
    }

    /// Forces of a ball, which grow nearly as the depth, with noise of 1 %: a lucky force before the peak
    /// begins no hold. One of sixty readings with a creep of 1 % of the depth is found under the same noise,
    /// nine of ten times: it begins where the mean of nine, which is off by 0.3 %, comes to the peak's
    /// force.
    #[test]
    fn noise_makes_no_hold_of_the_loading_of_a_ball() {
        let mut seed = 11_u64;
        let mut noise = || 1.0 + 0.01 * normal(&mut seed);
        let mut found = [0; 2];
        for _ in 0..50 {
            for (found, held) in found.iter_mut().zip([0, 60]) {
                let loading = (1..=200).map(|i| f64::from(i) / 200.0).map(|s| [1e-6 * s, 5e-3 * s.powf(1.1)]);
                let hold = (0..held).map(|i| [1e-6 + 1e-8 * f64::from(i) / 60.0, 5e-3]);
                let last = 1e-6 + if held > 0 { 1e-8 } else { 0.0 };
                let unloading = (1..100).map(|i| f64::from(i) / 100.0);
                let unloading = unloading.map(|s| [last * (1.0 - 0.1 * s), 5e-3 * (1.0 - s)]);
                let readings: Readings = loading.chain(hold).chain(unloading).collect();
                let readings = readings.iter().map(|p| [p[0], p[1] * noise()]).collect();
                let notes = Measured::new(&readings).unwrap().notes;
                *found += usize::from(notes.iter().any(|note| note.contains("hold")));
            }
        }
        assert!(found[0] == 0 && found[1] >= 45, "{found:?}");
    }

    /// Means over parts of the unloading lie on it whatever the noise of the forces, first and last ones as
    /// well: 1.5 % on each reading is less than 0.5 % on a mean of nine, and no part is off in one sense.
    #[test]
    fn noise_of_forces_does_not_shift_the_unloading() {
        let mut seed = 5_u64;
        let mut noise = || 0.015 * normal(&mut seed);
        // depth of the unloading over that of the turn by the share of the force
        let back = |share: f64| 1e-6 * (0.9 + 0.1 * share.powf(2.0 / 3.0));
        let (cases, mut sums) = (100, [0.0; 2]);
        for _ in 0..cases {
            let mut readings = loaded(300);
            readings.extend((1..=200).map(|i| 1.0 - f64::from(i) / 200.0).map(|s| [back(s), 5e-3 * s]));
            for p in &mut readings {
                p[1] *= 1.0 + noise();
            }
            let measured = Measured::new(&readings).unwrap();
            let off = |p: &[f64; 2]| p[1] / (5e-3 * ((p[0] / 1e-6 - 0.9) / 0.1).powf(1.5)) - 1.0;
            sums[0] += off(&measured.unloading[0]);
            sums[1] += off(measured.unloading.last().unwrap());
            assert!(measured.unloading.len() >= 17, "{}", measured.unloading.len());
        }
        // of a hundred cases: 0.05 % of noise, and the bend of the curve over a part
        assert!(sums.iter().all(|sum| (sum / f64::from(cases)).abs() < 0.004), "{sums:?}");
    }

    /// Noise that lifts a force before the turn does not move the turn there; a mean of the forces at the
    /// turn stands for its force.
    #[test]
    fn the_turn_lies_at_the_largest_depth_not_at_the_largest_force() {
        let mut readings = loaded(40);
        readings[38][1] *= 1.06;
        readings.extend((1..20).map(|i| [1e-6 - 4e-9 * f64::from(i), 5e-3 * (1.0 - f64::from(i) / 20.0)]));
        assert!(readings[38][1] > readings[39][1], "the case of this test");
        let measured = Measured::new(&readings).unwrap();
        assert_eq!((measured.peak, measured.loaded), ([1e-6, 5e-3], 1e-6));
        assert!(measured.notes.is_empty(), "{:?}", measured.notes);
    }

    /// A ball's force grows with a power between 1 and 1.5 of the depth: the laws at both ends enclose its
    /// touch.
    #[test]
    fn the_laws_of_a_ball_enclose_its_first_touch() {
        for offset in [0.0, 0.1e-6] {
            let readings: Readings = (1..=60)
                .map(|i| f64::from(i) / 60.0)
                .map(|s| [offset + 1e-6 * s, 5e-3 * s.powf(1.2)])
                .collect();
            let measured = Measured::new(&readings).unwrap();
            let [plastic, elastic] = [1.0, 1.5].map(|power| measured.touches(power));
            assert!(elastic < offset && offset < plastic, "{elastic:e} {offset:e} {plastic:e}");
            assert!((measured.touches(1.2) - offset).abs() < 1e-9);
        }
    }

    /// However dense the readings are, the steep way back beside the turn is no hold, nor part of its force.
    #[test]
    fn a_dense_curve_without_a_hold_has_none() {
        for count in [40, 200, 1000, 20_000] {
            let mut readings = loaded(count);
            let back = (1..count).map(|i| i as f64 / count as f64);
            readings.extend(back.map(|way| [1e-6 * (1.0 - 0.1 * way), 5e-3 * (1.0 - way).powf(1.3)]));
            let measured = Measured::new(&readings).unwrap();
            assert!(measured.notes.is_empty(), "{count}: {:?}", measured.notes);
            assert!(
                (measured.peak[1] / 5e-3 - 1.0).abs() < 2e-3 && measured.loaded == measured.peak[0],
                "{count}"
            );
        }
    }

    #[test]
    fn an_approach_is_no_cycle() {
        let mut readings: Readings = (0..30).map(|i| [-0.5e-6 + 1e-8 * f64::from(i), 0.0]).collect();
        readings.extend(loaded(60));
        let measured = Measured::new(&readings).unwrap();
        assert!(!measured.notes.iter().any(|note| note.contains("cycles")), "{:?}", measured.notes);
    }
}
