//! Verdicts on maps beside the two finer octaves that they did not see.

use crate::{FINE, MAPS, REDUCED, follow, made, task};
use asperity_roughness::half_space::HalfSpace;
use asperity_roughness::scales::{By, Class, Numbers, Quantity, Verdict, press_scale};
use asperity_roughness::{HeightMap, Surface};
use asperity_verification::report::Report;

/// Fine pixels in a coarse one along a side.
const COARSENED: usize = 4;
/// Change by two finer octaves up to which a quantity counts as one that converges.
const CONVERGES: f64 = 0.05;
/// It does not converge where the second of them changes it by more than that, and by this share of what the
/// first does, or more.
const STEADY: f64 = 0.8;

/// A map as an instrument of pixels so many times wider sees it: their means, or single points of it.
pub fn coarsened(map: &HeightMap, times: usize, means: bool) -> Surface {
    let n = map.columns() / times;
    let side = if means { times } else { 1 };
    let height = |i: usize| {
        let [x, y] = [i % n, i / n].map(|k| k * times);
        let sum: f64 = (y..y + side).flat_map(|y| &map.row(y)[x..x + side]).sum();
        sum / (side * side) as f64
    };
    let pixel = map.pixel().map(|p| p * times as f64);
    let coarse = HeightMap::new(n, n, pixel, (0..n * n).map(height).collect()).expect("a coarser map");
    Surface::from_map(coarse.with_periodic(map.periodic())).expect("a map of many cells")
}

/// Counts of verdicts: said, and true.
#[derive(Clone, Copy, Default)]
struct Count {
    said: usize,
    right: usize,
}

impl Count {
    fn add(&mut self, right: bool) {
        self.said += 1;
        self.right += usize::from(right);
    }

    fn cell(&self) -> String {
        match self.said {
            0 => "–".into(),
            said => format!("{} of {said}, {:.0} %", self.right, 1e2 * self.right as f64 / said as f64),
        }
    }
}

/// The verdicts on one kind of map.
#[derive(Clone, Copy, Default)]
struct Tally {
    /// Converged, converging, not converging: the change is inside the error; of the last that it is above
    /// the limit and between the percentages of the sentence.
    statements: [Count; 3],
    /// Those that converge: converged said; those that do not: not converging said, or still converging.
    recall: [Count; 2],
    small: usize,
}

impl Tally {
    fn add(&mut self, quantity: Quantity, octaves: &[Numbers; 2], verdict: &Verdict) {
        let of = |found: &Numbers| quantity.value(found).filter(|value| *value > 0.0);
        let [Some(middle), Some(truth)] = octaves.each_ref().map(of) else { return };
        let steps = [(middle / verdict.value).ln().abs(), (truth / middle).ln().abs()];
        let change = (truth / verdict.value - 1.0).abs();
        let error = verdict.error.unwrap_or(0.0);
        match verdict.class {
            Class::Converged => self.statements[0].add(change <= error),
            Class::Converging => {
                let end = verdict.extrapolated.unwrap_or(f64::NAN);
                self.statements[1].add((truth / end - 1.0).abs() <= error);
            }
            Class::NotConverging => {
                let inside = verdict.range.is_some_and(|[low, high]| (low..=high).contains(&truth));
                self.statements[2].add(change > CONVERGES && inside);
            }
            Class::MapTooSmall => self.small += 1,
        }
        if verdict.class == Class::MapTooSmall {
            return;
        }
        if change <= CONVERGES {
            self.recall[0].add(verdict.class == Class::Converged);
        } else if steps[1] > CONVERGES && steps[1] >= STEADY * steps[0] {
            self.recall[1].add(verdict.class == Class::NotConverging);
        }
    }
}

pub fn judged(report: &mut Report) {
    report.section("Verdicts beside two finer octaves");
    report.line(&format!(
        "Periodic maps of {FINE}² pressed whole, and as an instrument of pixels {COARSENED} times wider sees them, whose verdicts are held against \
         that: {MAPS} band-limited ones (shortest wave 10 to 30 fine pixels, every fourth point), {MAPS} self-affine ones (to 2 fine pixels, \
         means of 4 x 4); H 0.3 to 0.9, elastic contact of 1 to 10 %, metal from nearly elastic to nearly plastic. Seven quantities by the elastic \
         and by the limited half-space. A quantity converges where two finer octaves change it by {:.0} % or less, and does not where the second of them changes it by more \
         than that, and by at least {} of what the first does.\n",
        1e2 * CONVERGES,
        STEADY
    ));
    report.table(
        "| maps | half-space | converged: true | converging: true | not converging: true | converged said of those that converge | not converging said of those that do not | map too small |",
    );
    for band_limited in [true, false] {
        let mut tallies = [Tally::default(); 2];
        for seed in 1..=MAPS {
            let share = seed as f64 / MAPS as f64;
            let hurst = 0.3 + 0.6 * (5.0 * share).fract();
            let shortest = if band_limited { 10.0 + 20.0 * (3.0 * share).fract() } else { 2.0 };
            let fine = made(FINE, hurst, [64.0 + 64.0 * (7.0 * share).fract(), shortest], seed);
            let [coarse, middle] =
                [COARSENED, COARSENED / 2].map(|times| coarsened(&fine.map, times, !band_limited));
            let slope = REDUCED * coarse.parameters.rms_gradient;
            let pressure = slope * 0.005 * 10f64.powf((11.0 * share).fract());
            let task = task(slope * 0.03 * 10f64.powf((13.0 * share).fract()));
            let found = follow(&task, &coarse, pressure);
            for (limited, tally) in [false, true].into_iter().zip(&mut tallies) {
                let by = if limited { By::Limited } else { By::Elastic };
                let Some((_, last)) = found.contacts(by).last() else { continue };
                let body = HalfSpace { limit: last.limit, ..task.body };
                let truth = [&middle, &fine].map(|surface| {
                    let found = press_scale(&body, surface, pressure, None, None);
                    found.expect("the load is carried").0
                });
                for judged in found.verdicts.iter().filter(|j| j.limited == limited) {
                    tally.add(judged.quantity, &truth, &judged.verdict);
                }
            }
        }
        for (name, tally) in ["elastic", "limited"].into_iter().zip(tallies) {
            let kind = if band_limited { "band-limited" } else { "self-affine" };
            let statements = tally.statements.map(|count| count.cell()).join(" | ");
            let recall = tally.recall.map(|count| count.cell()).join(" | ");
            report.line(&format!("| {kind} | {name} | {statements} | {recall} | {} |", tally.small));
        }
    }
}
