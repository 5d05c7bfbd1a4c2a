//! From the rows of a sweep to ε_r of every slope, c of ε_r = c tan β, and its two intervals:
//! * that of the arithmetic: the same choices, other cases drawn and K shifted by its error;
//! * that of the model: the same cases, of which parts are left out. ε_r = c tan β is not exact, so c depends
//!   on the metals and slopes that it is fitted to, by more than its arithmetic tells.

use crate::collapse::{
    Collapse, Measure, SEARCHED, Sample, distinct, largest_correlation, least_scatter, scatter_left,
};
use crate::row::Row;
use asperity_material::Elastic;
use rayon::prelude::*;

/// Resamples of the bootstrap and its seed, fixed so that the same rows give the same bytes.
const RESAMPLES: usize = 800;
const SEED: u64 = 480;

/// E* tan β/σ_r from which a crush counts as developed plasticity: below it K says little about σ_r.
pub const DEVELOPED_PLASTICITY: f64 = 10.0;

/// Share of the resamples that must have a minimum for a slope to count as determined.
const DETERMINED_SHARE: f64 = 0.9;

/// The representative strain of one slope.
#[derive(Clone, Debug, PartialEq)]
pub struct Angle {
    /// Slope, degrees.
    pub beta_deg: f64,
    /// ε_r of least scatter; `None`: not determined.
    pub strain: Option<f64>,
    /// ε_r of largest correlation.
    pub correlation_strain: Option<f64>,
    /// 95 % interval of ε_r (open ends where resamples have no minimum lie at the end of the range searched).
    pub interval: [f64; 2],
    /// Scatter of ln(K/σ_r) left at the minimum.
    pub scatter: f64,
    /// The curve of scatter against ε_r/tan β.
    pub curve: Vec<Measure>,
    /// Materials that took part.
    pub cases: usize,
    /// ln(ε_r/tan β) of every resample.
    resampled: Vec<Option<f64>>,
}

/// c of ε_r = c tan β over all slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainCoefficient {
    /// c by least squares of ε_r = c tan β, a line through the origin: Σ ε_r tan β/Σ tan²β. The steepest
    /// cones count most.
    pub c: f64,
    /// Mean of ε_r/tan β, in which all slopes count alike.
    pub mean_ratio: f64,
    /// 95 % interval of c from the arithmetic: resampled materials, K shifted by its error.
    pub ci95: [f64; 2],
    /// Slopes that took part.
    pub angles: usize,
}

/// c of a part of the cases.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelChoice {
    /// The part, in words.
    pub part: String,
    /// Its c by least squares; `None` where it determines none.
    pub c: Option<f64>,
}

/// Samples of every slope, ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    /// Slope in degrees and its samples.
    pub slopes: Vec<(f64, Vec<Sample>)>,
    /// Hardening exponent of every material.
    pub materials: Vec<f64>,
    /// E*/E.
    pub reduced_modulus: f64,
}

impl Data {
    /// The rows that succeeded, every material once.
    pub fn new(rows: &[Row]) -> Data {
        let mut materials: Vec<(f64, f64)> = Vec::new();
        let mut slopes: Vec<(f64, Vec<Sample>)> = Vec::new();
        let mut reduced_modulus = 1.0;
        for row in rows {
            let (Ok(kick), Some(y), Some(hardening)) =
                (&row.outcome, row.case.yielding, row.case.hardening())
            else {
                continue;
            };
            reduced_modulus = Elastic::reduced_modulus(&row.case.elastic());
            let key = (y.exponent, y.e_over_sy);
            let material = materials.iter().position(|m| *m == key).unwrap_or_else(|| {
                materials.push(key);
                materials.len() - 1
            });
            let beta = row.case.beta_deg;
            let at = slopes.iter().position(|s| s.0 == beta).unwrap_or_else(|| {
                slopes.push((beta, Vec::new()));
                slopes.len() - 1
            });
            let samples = &mut slopes[at].1;
            if samples.iter().all(|s| s.material != material) {
                samples.push(Sample {
                    material,
                    hardening,
                    k_over_e: kick.k_over_e,
                    error: kick.error,
                    contact_ratio: kick.contact_ratio,
                });
            }
        }
        slopes.sort_by(|a, b| a.0.total_cmp(&b.0));
        Data { slopes, materials: materials.iter().map(|m| m.0).collect(), reduced_modulus }
    }

    /// The samples for which `keep(tan β, sample)` holds.
    pub fn filtered(&self, keep: impl Fn(f64, &Sample) -> bool) -> Data {
        let slopes = self.slopes.iter().map(|(beta, samples)| {
            let tan = beta.to_radians().tan();
            (*beta, samples.iter().filter(|s| keep(tan, s)).copied().collect())
        });
        Data { slopes: slopes.collect(), ..self.clone() }
    }

    /// X = E* tan β/σ_r of a sample at ε_r = `c` tan β.
    pub fn developed(&self, tan_beta: f64, sample: &Sample, c: f64) -> f64 {
        self.reduced_modulus * tan_beta / sample.hardening.representative_stress(c * tan_beta)
    }
}

/// The reason why nothing can be fitted at all, in words for a person; `None` if it can be tried.
pub fn obstacle(data: &Data) -> Option<String> {
    let samples = || data.slopes.iter().flat_map(|s| &s.1);
    if distinct(samples().map(|s| s.hardening.exponent)).len() < 2 {
        return Some("materials of one hardening exponent collapse for every representative strain".into());
    }
    if data.slopes.iter().all(|s| s.1.len() < 6) {
        return Some("fewer than six materials at every slope".into());
    }
    None
}

/// ε_r of every slope with its interval.
pub fn angles(data: &Data) -> Vec<Angle> {
    let draws = resample(&data.materials);
    data.slopes
        .par_iter()
        .filter_map(|(beta, samples)| {
            let tan = beta.to_radians().tan();
            let collapse = Collapse::new(samples, tan, data.reduced_modulus);
            let curve = collapse.measures(|_| [1.0, 0.0])?;
            let resampled: Vec<Option<f64>> = draws
                .iter()
                .map(|d| collapse.measures(|m| d[m]).and_then(|m| least_scatter(&m)).map(f64::ln))
                .collect();
            let share = resampled.iter().flatten().count() as f64 / resampled.len() as f64;
            let strain = least_scatter(&curve).filter(|_| share >= DETERMINED_SHARE).map(|s| s * tan);
            // a resample without a minimum says only that the strain may be anything
            let [first, last] = SEARCHED.map(f64::ln);
            let undecided = resampled.len() - resampled.iter().flatten().count();
            let mut all: Vec<f64> = resampled.iter().flatten().copied().collect();
            all.extend((0..undecided).map(|i| if i % 2 == 0 { first } else { last }));
            let interval = quantiles(&mut all).map(|q| q.exp() * tan);
            Some(Angle {
                beta_deg: *beta,
                strain,
                correlation_strain: largest_correlation(&curve).map(|s| s * tan),
                interval,
                scatter: scatter_left(&curve),
                cases: samples.len(),
                curve,
                resampled,
            })
        })
        .collect()
}

/// c over the determined slopes, and its interval from the same resamples of materials.
pub fn strain_coefficient(angles: &[Angle]) -> Option<StrainCoefficient> {
    let known: Vec<&Angle> = angles.iter().filter(|a| a.strain.is_some()).collect();
    let tan = |a: &Angle| a.beta_deg.to_radians().tan();
    let strains: Vec<[f64; 2]> = known.iter().filter_map(|a| Some([tan(a), a.strain?])).collect();
    let c = through_origin(&strains)?;
    let mean_ratio = strains.iter().map(|[tan, strain]| strain / tan).sum::<f64>() / strains.len() as f64;
    // a slope without a minimum may have any strain, in turn the least and the largest that is searched: left
    // out, it would take its doubt along, and the steepest slope has most of the weight
    let mut side = 0;
    let resample = |b: usize| {
        let undecided = known.iter().any(|a| a.resampled[b].is_none());
        side = if undecided { 1 - side } else { side };
        let ratio = |a: &Angle| a.resampled[b].map_or(SEARCHED[side], f64::exp);
        through_origin(&known.iter().map(|a| [tan(a), ratio(a) * tan(a)]).collect::<Vec<_>>())
    };
    let ci95 = quantiles(&mut (0..RESAMPLES).filter_map(resample).collect::<Vec<f64>>());
    Some(StrainCoefficient { c, mean_ratio, ci95, angles: known.len() })
}

/// Slope of the line through the origin by least squares of points (tan β, ε_r); `None` without any.
fn through_origin(points: &[[f64; 2]]) -> Option<f64> {
    let sum = |of: fn(&[f64; 2]) -> f64| points.iter().map(of).sum::<f64>();
    let square = sum(|p| p[0] * p[0]);
    (square > 0.0).then(|| sum(|p| p[0] * p[1]) / square)
}

/// c of parts of `data`: each half of the range of E/σ_y, each hardening exponent left out, each half of the
/// slopes and each slope left out. One law was swept; what another would give is in none of them.
pub fn model_choices(data: &Data) -> Vec<ModelChoice> {
    let ratio = |s: &Sample| 1.0 / s.hardening.yield_stress;
    let all = || data.slopes.iter().flat_map(|(_, samples)| samples);
    let ends = all().map(ratio).fold([f64::MAX, 0.0_f64], |[low, high], r| [low.min(r), high.max(r)]);
    let middle = (ends[0] * ends[1]).sqrt();
    let mut parts = vec![
        (format!("E/σ_y up to {middle:.0}"), data.filtered(|_, s| ratio(s) <= middle)),
        (format!("E/σ_y from {middle:.0}"), data.filtered(|_, s| ratio(s) >= middle)),
    ];
    for n in distinct(all().map(|s| s.hardening.exponent)) {
        parts.push((format!("without n = {n}"), data.filtered(|_, s| s.hardening.exponent != n)));
    }
    let of_metals = parts.into_iter().map(|(part, data)| {
        let enough = obstacle(&data).is_none();
        ModelChoice { part, c: enough.then(|| through_origin(&least_scatters(&data))).flatten() }
    });
    let strains = least_scatters(data);
    let half = strains.len().div_ceil(2);
    let degrees = |i: usize| {
        let beta = strains.get(i).map_or(f64::NAN, |p| p[0].atan().to_degrees());
        (1e6 * beta).round() * 1e-6
    };
    let mut slopes = Vec::new();
    if strains.len() > 1 {
        let last = strains.len() - 1;
        slopes.push((format!("slopes up to {}°", degrees(half - 1)), strains[..half].to_vec()));
        slopes.push((format!("slopes from {}°", degrees(half - 1)), strains[half - 1..].to_vec()));
        for out in 0..=last {
            let others = strains.iter().enumerate().filter(|(i, _)| *i != out).map(|(_, p)| *p);
            slopes.push((format!("without {}°", degrees(out)), others.collect()));
        }
    }
    let of_slopes = slopes.into_iter().map(|(part, points)| ModelChoice { part, c: through_origin(&points) });
    of_metals.chain(of_slopes).collect()
}

/// Least and largest c of the whole, `c`, and of the `choices`: all that is searched where one of them
/// determines none, as with two exponents, of which one is left out.
pub fn model_interval(c: f64, choices: &[ModelChoice]) -> [f64; 2] {
    let ends = |choice: &ModelChoice| choice.c.map_or(SEARCHED, |c| [c; 2]);
    choices.iter().map(ends).fold([c, c], |[low, high], [least, most]| [low.min(least), high.max(most)])
}

/// tan β and ε_r of least scatter of every slope that has one.
fn least_scatters(data: &Data) -> Vec<[f64; 2]> {
    let point = |(beta, samples): &(f64, Vec<Sample>)| {
        let tan = beta.to_radians().tan();
        let curve = Collapse::new(samples, tan, data.reduced_modulus).measures(|_| [1.0, 0.0])?;
        Some([tan, least_scatter(&curve)? * tan])
    };
    data.slopes.iter().filter_map(point).collect()
}

/// The 2.5 % and 97.5 % quantiles.
fn quantiles(values: &mut [f64]) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let at = |q: f64| values.get((q * (values.len().max(1) - 1) as f64).round() as usize).copied();
    [at(0.025), at(0.975)].map(|v| v.unwrap_or(f64::NAN))
}

/// Resamples of the materials: how often each is drawn, and by how many times its 95 % bound its K is
/// shifted.
///
/// The shift is the same for all materials of one exponent and for all slopes, a standard deviation of half
/// the bound: the error of mesh and step is no noise, it depends on n, and so it is what would shift ε_r
/// unseen.
fn resample(exponents: &[f64]) -> Vec<Vec<[f64; 2]>> {
    let mut random = SplitMix(SEED);
    let kinds = distinct(exponents.iter().copied());
    (0..RESAMPLES)
        .map(|_| {
            let shifts: Vec<f64> = kinds.iter().map(|_| 0.5 * random.normal()).collect();
            let shift = |n: &f64| kinds.iter().position(|k| k == n).map_or(0.0, |i| shifts[i]);
            let mut drawn: Vec<[f64; 2]> = exponents.iter().map(|n| [0.0, shift(n)]).collect();
            for _ in exponents {
                drawn[(random.bits() % exponents.len() as u64) as usize][0] += 1.0;
            }
            drawn
        })
        .collect()
}

/// Steele, Lea and Flood's generator: a few lines, the same numbers on every machine.
pub struct SplitMix(pub u64);

impl SplitMix {
    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A normal deviate, by the sum of twelve uniform ones.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }

    /// A number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The developed cases alone: those with E* tan β/σ_r of at least `least` at ε_r = `c` tan β, at slopes where
/// at least eight of them and three exponents are left.
pub fn developed(data: &Data, c: f64, least: f64) -> Data {
    let mut kept = data.filtered(|tan, s| data.developed(tan, s, c) >= least);
    kept.slopes.retain(|(_, samples)| {
        samples.len() >= 8 && distinct(samples.iter().map(|s| s.hardening.exponent)).len() >= 3
    });
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::loading_curvature::LoadingCurvature;
    use crate::sweep::Sweep;

    /// K of a made-up law that collapses exactly at ε_r = `c` tan β, times 1 + noise·(normal deviate).
    fn synthetic(c: f64, noise: f64) -> Vec<Row> {
        let mut random = SplitMix(1);
        let cases = Sweep::default().cases();
        cases
            .into_iter()
            .map(|case| {
                let tan = case.tan_beta();
                let e_star = case.elastic().reduced_modulus();
                let s = case.hardening().unwrap().representative_stress(c * tan);
                let l = (e_star * tan / s).ln();
                // ln Y of ln X as cone indentation has it; any smooth curve would do
                let y = -1.147_675e-4 * l.powi(4) + 1.171_629e-2 * l.powi(3) - 0.212_961 * l * l
                    + 1.409_473 * l
                    - 0.701_906;
                let k_over_e = y.exp() * s / (tan * tan) * (1.0 + noise * random.normal());
                row(case, k_over_e)
            })
            .collect()
    }

    fn row(case: Case, k_over_e: f64) -> Row {
        let kick =
            LoadingCurvature { k_over_e, error: 0.01, contact_ratio: 0.9, increments: 1, iterations: 1 };
        Row { case, outcome: Ok(kick), wall_s: 0.0 }
    }

    #[test]
    fn a_known_strain_is_recovered_from_one_percent_noise() {
        for c in [0.06, 0.1, 0.25] {
            let angles = angles(&Data::new(&synthetic(c, 0.01)));
            let fit = strain_coefficient(&angles).unwrap();
            assert!(fit.ci95[0] <= c && c <= fit.ci95[1], "{c}: {fit:?}");
            assert!(
                (fit.c / c - 1.0).abs() < 0.05 && (fit.mean_ratio / c - 1.0).abs() < 0.05,
                "{c}: {fit:?}"
            );
            // slopes that are determined agree by both measures, within the interval
            for a in angles.iter().filter(|a| a.beta_deg >= 6.0) {
                let (s, r) = (a.strain.unwrap(), a.correlation_strain.unwrap());
                assert!((s / r - 1.0).abs() < 0.15 && a.interval[0] < s && s < a.interval[1], "{a:?}");
            }
        }
    }

    #[test]
    fn exact_data_have_the_same_coefficient_in_every_part() {
        let choices = model_choices(&Data::new(&synthetic(0.1, 0.0)));
        // two halves of the metals, four exponents, two halves of the slopes, ten slopes
        assert_eq!(choices.len(), 18);
        let near = |choice: &ModelChoice| (choice.c.unwrap() / 0.1 - 1.0).abs() < 0.01;
        assert!(choices.iter().all(near), "{choices:?}");
        let parts: Vec<&str> = choices.iter().map(|choice| choice.part.as_str()).collect();
        assert!(parts.contains(&"E/σ_y up to 324") && parts.contains(&"without n = 0.5"), "{parts:?}");
        assert!(parts.contains(&"slopes up to 5°") && parts.contains(&"slopes from 5°"), "{parts:?}");
        let [low, high] = model_interval(0.1, &choices);
        assert!(low <= 0.1 && 0.1 <= high);
    }

    /// Of two exponents one is left out, and c may be anything.
    #[test]
    fn a_part_that_determines_nothing_opens_the_interval_of_the_model() {
        let two = |s: &Sample| s.hardening.exponent < 0.25;
        let choices = model_choices(&Data::new(&synthetic(0.1, 0.0)).filtered(|_, s| two(s)));
        let open: Vec<&str> = choices.iter().filter(|c| c.c.is_none()).map(|c| c.part.as_str()).collect();
        assert_eq!(open, ["without n = 0.1", "without n = 0.2"]);
        assert_eq!(model_interval(0.1, &choices), SEARCHED);
    }

    /// The steeper of two slopes has four fifths of the weight, and no minimum in 6 % of the resamples: in 3
    /// % c may be as large as a strain of 1.2 tan β there makes it, which a 95 % interval holds.
    #[test]
    fn a_steep_slope_that_is_not_always_determined_widens_the_interval() {
        let angle = |beta_deg: f64, undecided: usize| Angle {
            beta_deg,
            strain: Some(0.1 * beta_deg.to_radians().tan()),
            correlation_strain: None,
            interval: [0.0; 2],
            scatter: 0.0,
            curve: Vec::new(),
            cases: 48,
            resampled: (0..RESAMPLES).map(|b| (b >= undecided).then(|| 0.1_f64.ln())).collect(),
        };
        let interval = |undecided| strain_coefficient(&[angle(5.0, 0), angle(10.0, undecided)]).unwrap().ci95;
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        let [low, high] = interval(0);
        assert!(near(low, 0.1) && near(high, 0.1));
        let square = |beta: f64| beta.to_radians().tan().powi(2);
        let steep = square(10.0) / (square(5.0) + square(10.0));
        let [low, high] = interval(RESAMPLES * 6 / 100);
        let [least, most] = SEARCHED.map(|share| 0.1 + steep * (share - 0.1));
        assert!(near(low, least) && near(high, most), "{low} {least} {high} {most}");
    }

    #[test]
    fn elastic_cones_determine_nothing() {
        for noise in [0.0, 0.01] {
            let mut random = SplitMix(2);
            let rows: Vec<Row> = Sweep::default()
                .cases()
                .into_iter()
                .map(|case| {
                    let k = 0.7 / case.tan_beta() * (1.0 + noise * (2.0 * random.uniform() - 1.0));
                    row(case, k)
                })
                .collect();
            let angles = angles(&Data::new(&rows));
            assert!(angles.len() == 10 && angles.iter().all(|a| a.strain.is_none()), "{noise}");
            assert_eq!(strain_coefficient(&angles), None);
        }
    }

    #[test]
    fn a_grid_that_cannot_be_fitted_says_why() {
        let sweep = Sweep { hardening_exponent: vec![0.3], ..Sweep::default() };
        let rows: Vec<Row> = sweep.cases().into_iter().map(|case| row(case, 1.0)).collect();
        assert!(obstacle(&Data::new(&rows)).unwrap().contains("exponent"));
        assert!(obstacle(&Data::new(&synthetic(0.1, 0.0))).is_none());
    }
}
