//! The answers of finite elements to one measurement between the metals that were computed: a trend, and a
//! Gaussian process for what is left of it.
//!
//! The trend of a sharp cone is the atlas of cones, that of other tools a polynomial through a design of
//! runs. Every further run draws the process to itself; where none is near, the process says how much may be
//! left, and that is part of the covariance of the fit (Kennedy and O'Hagan, Biometrika 87 (2000) 1, with one
//! run a level). Of a curve's runs most of it is the mesh, which differs from metal to metal: the process
//! knows only the share that varies smoothly.

use super::imprint::error_sizes;
use super::response::{DesignPoint, Geometry, Response, SHARES};
use asperity_material::cone_atlas::{Atlas, Contact, SharpCone};
use asperity_material::{Elastic, HardeningCurve};
use asperity_simulation::scene::Friction;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A computed metal.
#[derive(Clone, Debug)]
struct Node {
    place: Vec<f64>,
    logarithms: Vec<f64>,
    /// Relative error of the answer.
    error: f64,
}

/// A metal of which a finer level answered.
#[derive(Clone, Debug)]
struct Met {
    place: Vec<f64>,
    /// Variance of its mesh over that of the runs, by the errors that both state.
    share: f64,
}

/// Mean function of the answers, where none is near.
#[derive(Clone, Debug)]
enum Trend {
    Atlas,
    Polynomial(Polynomial),
}

/// The answers to one measurement as a function of the metal.
#[derive(Clone, Debug)]
pub struct Emulator {
    trend: Trend,
    /// Lengths of the coordinates over which what is left of the trend varies.
    lengths: Vec<f64>,
    /// The scatter that is left of the trend, one for each logarithm.
    amplitudes: Vec<f64>,
    /// Covariance of what is left of the trend of a curve, by a polynomial through its runs.
    rest: Option<DMatrix<f64>>,
    /// Share of that remainder that varies smoothly with the metal; the rest is the mesh's.
    smooth_share: f64,
    /// That over which the error of an answer counts: of the loading, or of heights far from a rim.
    scatter: f64,
    nodes: Vec<Node>,
    factor: Option<Cholesky<f64, Dyn>>,
    weights: DMatrix<f64>,
    /// Correction by a finer level, added to all of them.
    lift: Vec<f64>,
    /// The metal of which that level answered last.
    met: Option<Met>,
}

/// The coefficient of friction whose tool holds a surface like one that sticks: most of it does from there
/// on.
const STICKS_LIKE: f64 = 0.5;

/// The coordinates of a question: logarithms of E/σ_y, n (of what is no power law: of E over
/// stresses), ν, the law's E over that of the contact, tip over depth; and the coefficient of friction.
pub fn features(question: &DesignPoint) -> Vec<f64> {
    let curve = &question.metal.hardening;
    let mut place = match curve {
        HardeningCurve::Power(law) => vec![(question.modulus / law.yield_stress).ln(), law.exponent],
        _ => [0.0, 0.01, 0.03, 0.1, 0.3]
            .iter()
            .map(|strain| (question.modulus / curve.flow(*strain).yield_stress).ln())
            .collect(),
    };
    place.push(question.metal.elastic.poissons_ratio);
    place.push((question.metal.elastic.youngs_modulus / question.modulus).ln());
    place.push((question.tip_radius / question.depth).max(1e-4).ln());
    place.push(match question.friction {
        Some(Friction::Coefficient(coefficient)) => coefficient,
        Some(Friction::Sticking) => STICKS_LIKE,
        None => 0.0,
    });
    place
}

/// The slope of the cone that a tool is like, degrees.
fn likened_slope(question: &DesignPoint) -> f64 {
    match &question.geometry {
        Geometry::Sharp { slope_deg } | Geometry::Rounded { slope_deg } => *slope_deg,
        Geometry::Ball { radius } => (question.depth / (2.0 * radius)).sqrt().atan().to_degrees(),
        Geometry::Crush { asperity } => asperity.slope_deg.unwrap_or_else(|| {
            let radius = asperity.radius.map_or(1.0, |r| r.0);
            (question.depth / (2.0 * radius)).sqrt().atan().to_degrees()
        }),
    }
}

/// The logarithms that the atlas of cones has for a tool like the one in question, extrapolated beyond its
/// edge.
pub fn by_the_atlas(question: &DesignPoint) -> Vec<f64> {
    let Some(atlas) = Atlas::committed() else { return vec![f64::NAN; 3] };
    let contact = match question.geometry {
        Geometry::Crush { .. } => Contact::Crushed,
        _ => Contact::Indenting,
    };
    let elastic = Elastic { youngs_modulus: question.modulus, ..question.metal.elastic };
    let hardening = question.metal.hardening.clone();
    let found = atlas.nearest(&SharpCone::new(likened_slope(question), &elastic, hardening, contact));
    let loading = found.k_over_e.value.ln();
    let numbers = [found.stiffness.value, found.elastic_share.value];
    let after = numbers.into_iter().chain(found.recovery).map(|x| x.max(1e-12).ln());
    match question.geometry {
        Geometry::Sharp { .. } => std::iter::once(loading).chain(after).collect(),
        // a ball presses with the square root of the depth less
        _ => SHARES.iter().map(|share| loading - 0.9 * share.ln()).chain(after).collect(),
    }
}

/// Variance of an answer with a relative `error` (95 %) over that of what is left of the trend, not less
/// than what rounding takes.
fn share_of_an_error(error: f64, amplitude: f64) -> f64 {
    (0.5 * error / amplitude).powi(2).max(1e-6)
}

/// Parts of the covariance that are the model's: errors of the force, of the slope where unloading begins, of
/// the recovery; and the remainder of all numbers beside their trend.
pub const MODEL_PARTS: usize = 4;

/// ln det of a factored matrix.
pub fn log_determinant(factor: &Cholesky<f64, Dyn>) -> f64 {
    2.0 * factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>()
}

/// Shares of the remainder that are tried as the one that varies smoothly with the metal.
const SHARES_TRIED: usize = 20;

/// Correlations of which a `share` is smooth.
fn partly(alike: &DMatrix<f64>, share: f64) -> DMatrix<f64> {
    let own = (1.0 - share) * DMatrix::identity(alike.nrows(), alike.ncols());
    share * alike + own
}

/// Least scatter of a curve about a polynomial: what the mesh, which differs from metal to metal, leaves.
/// That of heights is their error.
const MIN_AMPLITUDE: f64 = 0.003;

impl Emulator {
    /// That of a sharp cone before any run of its own.
    pub fn of_a_cone(outputs: usize, like_the_atlas: bool) -> Emulator {
        let wide = if like_the_atlas { 1.0 } else { 2.0 };
        let amplitudes = (0..outputs).map(|i| if i == 0 { 0.006 * wide } else { 0.015 * wide }).collect();
        let lengths = vec![1.2, 0.25, 0.15, 0.5, 1.0, 0.2];
        Emulator::new(Trend::Atlas, lengths, amplitudes)
    }

    /// A polynomial through `runs`, which are of an `imprint` or of a curve.
    pub fn fit(runs: &[(Vec<f64>, Response)], imprint: bool) -> Option<Emulator> {
        let places: Vec<&[f64]> = runs.iter().map(|(place, _)| place.as_slice()).collect();
        let values: Vec<&[f64]> = runs.iter().map(|(_, r)| r.logarithms.as_slice()).collect();
        let (polynomial, left) = Polynomial::fit(&places, &values)?;
        let lengths = polynomial.widths.iter().map(|w| if *w > 0.0 { 0.8 * w } else { 1.0 }).collect();
        let trend = Trend::Polynomial(polynomial);
        let mut emulator = if imprint {
            let least = runs.iter().map(|(_, r)| 0.5 * r.errors[0]).fold(0.0, f64::max);
            let left = left.diagonal().iter().map(|square| square.sqrt()).collect();
            Emulator::of_an_imprint(trend, lengths, left, least)
        } else {
            let mut rest = left;
            for i in 0..rest.nrows() {
                rest[(i, i)] = rest[(i, i)].max(MIN_AMPLITUDE.powi(2));
            }
            let amplitudes = rest.diagonal().iter().map(|square| square.sqrt()).collect();
            Emulator { rest: Some(rest), ..Emulator::new(trend, lengths, amplitudes) }
        };
        for (place, response) in runs {
            emulator.push(place.clone(), response);
        }
        emulator.renew();
        Some(emulator)
    }

    fn new(trend: Trend, lengths: Vec<f64>, amplitudes: Vec<f64>) -> Emulator {
        let (weights, lift) = (DMatrix::zeros(0, amplitudes.len()), vec![0.0; amplitudes.len()]);
        let scatter = amplitudes.first().copied().unwrap_or(0.01);
        let (nodes, factor, rest, smooth_share, met) = (Vec::new(), None, None, 1.0, None);
        Emulator {
            trend,
            lengths,
            amplitudes,
            rest,
            smooth_share,
            scatter,
            nodes,
            factor,
            weights,
            lift,
            met,
        }
    }

    /// That of heights of which `left` is left of the trend, and whose standard deviation by the finite
    /// elements is `least` far from the rim.
    fn of_an_imprint(trend: Trend, lengths: Vec<f64>, left: Vec<f64>, least: f64) -> Emulator {
        let sizes = error_sizes();
        let amplitudes: Vec<f64> = left.iter().zip(sizes).map(|(l, size)| l.max(least * size)).collect();
        // of the heights, which stand behind the radius
        let each = amplitudes.iter().zip(sizes).skip(1).map(|(a, size)| (a / size).powi(2));
        let scatter = (each.sum::<f64>() / (amplitudes.len() - 1).max(1) as f64).sqrt();
        Emulator { scatter, ..Emulator::new(trend, lengths, amplitudes) }
    }

    /// Adds the answer to a question.
    pub fn add(&mut self, question: &DesignPoint, response: &Response) {
        let trend = self.trend(question, &features(question));
        let rest = response.logarithms.iter().zip(&trend).map(|(a, b)| a - b).collect();
        let node = Response { logarithms: rest, ..response.clone() };
        self.nodes.push(Node {
            place: features(question),
            logarithms: node.logarithms,
            error: node.errors[0],
        });
        self.renew();
    }

    /// Shifts all that is expected so that it meets the answer of a finer level: levels differ by nearly the
    /// same share at metals that are near each other.
    pub fn meet(&mut self, question: &DesignPoint, response: &Response) {
        let expected = self.predict(question);
        let coarse = self.nodes.iter().map(|node| node.error.powi(2)).sum::<f64>();
        let share = response.errors[0].powi(2) * self.nodes.len() as f64 / coarse.max(f64::MIN_POSITIVE);
        self.met = Some(Met { place: features(question), share: share.min(1.0) });
        for ((lift, fine), coarse) in self.lift.iter_mut().zip(&response.logarithms).zip(expected) {
            *lift += fine - coarse;
        }
    }

    fn push(&mut self, place: Vec<f64>, response: &Response) {
        let Trend::Polynomial(polynomial) = &self.trend else { return };
        let trend = polynomial.predict(&place);
        let logarithms = response.logarithms.iter().zip(&trend).map(|(a, b)| a - b).collect();
        self.nodes.push(Node { place, logarithms, error: response.errors[0] });
    }

    fn trend(&self, question: &DesignPoint, place: &[f64]) -> Vec<f64> {
        match &self.trend {
            Trend::Atlas => by_the_atlas(question),
            Trend::Polynomial(polynomial) => polynomial.predict(place),
        }
    }

    fn correlation(&self, a: &[f64], b: &[f64]) -> f64 {
        let square = |((a, b), l): ((&f64, &f64), &f64)| ((a - b) / l).powi(2);
        (-0.5 * a.iter().zip(b).zip(&self.lengths).map(square).sum::<f64>()).exp()
    }

    fn renew(&mut self) {
        let count = self.nodes.len();
        let alike = DMatrix::from_fn(count, count, |i, j| {
            self.correlation(&self.nodes[i].place, &self.nodes[j].place)
        });
        let rest = DMatrix::from_fn(count, self.amplitudes.len(), |i, j| self.nodes[i].logarithms[j]);
        let matrix = if self.rest.is_some() {
            self.smooth_share = self.likeliest_share(&alike, &rest);
            partly(&alike, self.smooth_share)
        } else {
            let errors = self.nodes.iter().map(|node| share_of_an_error(node.error, self.scatter));
            &alike + DMatrix::from_diagonal(&DVector::from_iterator(count, errors))
        };
        self.factor = matrix.cholesky();
        let solved = self.factor.as_ref().map(|f| self.smooth_share * f.solve(&rest));
        self.weights = solved.unwrap_or_else(|| DMatrix::zeros(count, self.amplitudes.len()));
    }

    /// The share of the remainder that varies smoothly with the metal, all numbers together: the likeliest
    /// one by how alike remainders are of metals that are near each other.
    fn likeliest_share(&self, alike: &DMatrix<f64>, rest: &DMatrix<f64>) -> f64 {
        let misfit = |share: f64| {
            let Some(factor) = partly(alike, share).cholesky() else { return f64::INFINITY };
            let solved = factor.solve(rest);
            let squares =
                (0..rest.ncols()).map(|j| rest.column(j).dot(&solved.column(j)) / self.amplitudes[j].powi(2));
            squares.sum::<f64>() + rest.ncols() as f64 * log_determinant(&factor)
        };
        let shares = (0..SHARES_TRIED).map(|k| k as f64 / SHARES_TRIED as f64);
        shares.min_by(|a, b| misfit(*a).total_cmp(&misfit(*b))).unwrap_or(0.0)
    }

    /// Covariance of all numbers by what is left of a trend through runs; `None` of other trends.
    pub fn scatter_of_the_numbers(&self) -> Option<&DMatrix<f64>> {
        self.rest.as_ref()
    }

    /// The logarithms to be expected.
    pub fn predict(&self, question: &DesignPoint) -> Vec<f64> {
        let place = features(question);
        let mut value = self.trend(question, &place);
        value.iter_mut().zip(&self.lift).for_each(|(v, lift)| *v += lift);
        if self.factor.is_some() {
            for (i, node) in self.nodes.iter().enumerate() {
                let k = self.correlation(&place, &node.place);
                for (j, v) in value.iter_mut().enumerate() {
                    *v += k * self.weights[(i, j)];
                }
            }
        }
        value
    }

    /// Correlation, from 0 to 1, of `question` with the computed metal that is nearest to it.
    pub fn nearness(&self, question: &DesignPoint) -> f64 {
        let place = features(question);
        self.nodes.iter().map(|node| self.correlation(&place, &node.place)).fold(0.0, f64::max)
    }

    /// Standard deviations of what is left of loading, slope and recovery, of which the response has
    /// `loading` numbers of the loading.
    pub fn left(&self, question: &DesignPoint, loading: usize) -> [f64; MODEL_PARTS] {
        let place = features(question);
        let k = DVector::from_fn(self.nodes.len(), |i, _| self.correlation(&place, &self.nodes[i].place));
        let known = self.factor.as_ref().map_or(0.0, |factor| k.dot(&factor.solve(&k)));
        if self.rest.is_some() {
            // near runs tell what varies smoothly, not what the mesh makes of each
            let smooth = self.smooth_share * (1.0 - self.smooth_share * known);
            return [0.0, 0.0, 0.0, (smooth + self.share_of_the_mesh(&place)).max(0.0).sqrt()];
        }
        self.left_of_the_trend(1.0 - known, question.imprint, loading)
    }

    /// Share of the mesh in the remainder at `place`: all of it until a finer level has answered, then what
    /// it makes of the difference to the metal of which that did, and what the finer mesh makes of both.
    fn share_of_the_mesh(&self, place: &[f64]) -> f64 {
        let share = match (&self.met, &self.trend) {
            (Some(met), Trend::Polynomial(polynomial)) => {
                2.0 * met.share + polynomial.variance_of_a_difference(place, &met.place)
            }
            _ => 1.0,
        };
        (1.0 - self.smooth_share) * share
    }

    /// The least that is left: at a metal that was computed with a relative `error`, of a trend that is the
    /// atlas, which keeps its part in what is expected; of a curve's trend through runs, what is the mesh's;
    /// of heights, whose runs tell of each other, nothing.
    pub fn least_left(&self, error: f64, imprint: bool, loading: usize) -> [f64; MODEL_PARTS] {
        let share = match self.trend {
            Trend::Atlas => share_of_an_error(error, self.scatter),
            Trend::Polynomial(_) if self.rest.is_some() => {
                let share = self.met.as_ref().map_or(1.0, |met| 2.0 * met.share) * (1.0 - self.smooth_share);
                return [0.0, 0.0, 0.0, share.sqrt()];
            }
            Trend::Polynomial(_) => 0.0,
        };
        self.left_of_the_trend(share / (1.0 + share), imprint, loading)
    }

    /// A `share` of the variance of what is left of the trend.
    fn left_of_the_trend(&self, share: f64, imprint: bool, loading: usize) -> [f64; MODEL_PARTS] {
        let share = share.clamp(0.0, 1.0).sqrt();
        let of = |i: usize| share * self.amplitudes.get(i).copied().unwrap_or(0.0);
        if imprint {
            return [share * self.scatter, 0.0, 0.0, 0.0];
        }
        [of(loading - 1), of(loading), of(loading + 1), 0.0]
    }
}

/// Covariance of the columns of `rest`, which have so many degrees of freedom: fewer runs than numbers tell
/// correlations badly, and what they miss would count as known. So correlations are shrunk by the share of
/// their squares that chance alone explains (Schäfer and Strimmer, Stat. Appl. Genet. Mol. Biol. 4 (2005)
/// 32).
fn shrunk(rest: &DMatrix<f64>, free: f64) -> DMatrix<f64> {
    let runs = rest.nrows() as f64;
    let sizes: Vec<f64> = rest.column_iter().map(|c| (c.norm_squared() / runs).sqrt().max(1e-12)).collect();
    let [mut by_chance, mut squares] = [0.0; 2];
    for i in 0..rest.ncols() {
        for j in 0..i {
            let products = rest.column(i).component_mul(&rest.column(j)) / (sizes[i] * sizes[j]);
            let mean = products.mean();
            by_chance += products.variance() / (runs - 1.0);
            squares += mean * mean;
        }
    }
    let kept = if squares > by_chance { 1.0 - by_chance / squares } else { 0.0 };
    let all = rest.tr_mul(rest) / free;
    DMatrix::from_fn(all.nrows(), all.ncols(), |i, j| if i == j { all[(i, i)] } else { kept * all[(i, j)] })
}

/// A polynomial of the second degree, of the third where there are points for it, in the coordinates that
/// vary.
#[derive(Clone, Debug)]
struct Polynomial {
    middle: Vec<f64>,
    /// Half widths; 0 of a coordinate that does not vary.
    widths: Vec<f64>,
    cubic: bool,
    coefficients: DMatrix<f64>,
    /// Factor of the normal equations.
    normal: Option<Cholesky<f64, Dyn>>,
}

impl Polynomial {
    /// That through `values` at `places`, and the covariance of what it leaves of them.
    fn fit(places: &[&[f64]], values: &[&[f64]]) -> Option<(Polynomial, DMatrix<f64>)> {
        let dimensions = places.first()?.len();
        let end =
            |i: usize, pick: fn(f64, f64) -> f64, from: f64| places.iter().map(|p| p[i]).fold(from, pick);
        let (low, high): (Vec<f64>, Vec<f64>) = (0..dimensions)
            .map(|i| (end(i, f64::min, f64::INFINITY), end(i, f64::max, f64::NEG_INFINITY)))
            .unzip();
        let middle = low.iter().zip(&high).map(|(l, h)| 0.5 * (l + h)).collect();
        let widths: Vec<f64> =
            low.iter().zip(&high).map(|(l, h)| if h - l > 1e-9 { 0.5 * (h - l) } else { 0.0 }).collect();
        let mut polynomial =
            Polynomial { middle, widths, cubic: true, coefficients: DMatrix::zeros(0, 0), normal: None };
        if 3 * places.len() < 5 * polynomial.terms(places[0]).len() {
            polynomial.cubic = false;
        }
        let rows: Vec<Vec<f64>> = places.iter().map(|p| polynomial.terms(p)).collect();
        let count = rows[0].len();
        if places.len() <= count {
            return None;
        }
        let matrix = DMatrix::from_fn(places.len(), count, |i, j| rows[i][j]);
        let goal = DMatrix::from_fn(places.len(), values[0].len(), |i, j| values[i][j]);
        let mut normal = matrix.tr_mul(&matrix);
        for i in 0..count {
            normal[(i, i)] += 1e-9;
        }
        let normal = normal.cholesky()?;
        polynomial.coefficients = normal.solve(&matrix.tr_mul(&goal));
        polynomial.normal = Some(normal);
        let rest = &goal - &matrix * &polynomial.coefficients;
        let free = (places.len() - count) as f64;
        Some((polynomial, shrunk(&rest, free)))
    }

    fn terms(&self, place: &[f64]) -> Vec<f64> {
        let x: Vec<f64> = (0..place.len())
            .filter(|&i| self.widths[i] > 0.0)
            .map(|i| ((place[i] - self.middle[i]) / self.widths[i]).clamp(-1.5, 1.5))
            .collect();
        let mut terms = vec![1.0];
        for i in 0..x.len() {
            terms.push(x[i]);
            for j in i..x.len() {
                terms.push(x[i] * x[j]);
                if self.cubic {
                    terms.extend(x[j..].iter().map(|z| x[i] * x[j] * z));
                }
            }
        }
        terms
    }

    /// Variance of the difference between the values at two places by the scatter of the runs, over that
    /// scatter.
    fn variance_of_a_difference(&self, a: &[f64], b: &[f64]) -> f64 {
        let difference = DVector::from_vec(self.terms(a)) - DVector::from_vec(self.terms(b));
        self.normal.as_ref().map_or(1.0, |normal| difference.dot(&normal.solve(&difference)))
    }

    fn predict(&self, place: &[f64]) -> Vec<f64> {
        let terms = DVector::from_vec(self.terms(place));
        self.coefficients.tr_mul(&terms).iter().copied().collect()
    }
}
