//! The atlas of cones: force, contact radius and recovery of a sharp cone of any slope and any power-law
//! metal, as a formula through tens of thousands of computed cones.
//!
//! A sharp cone has no length but its depth h, so F = K h² and everything else goes with h alike. With σ_r =
//! σ(ε_r), ε_r = [`STRAIN`] tan β, taken on the curve of the metal itself, and m = d ln σ/d ln ε_p there, the
//! answer depends on
//!   X = E* tan β/σ_r,   β,   m,   ν,   which body is the cone,
//! and the law of hardening matters little beside. The logarithm of K over that of an elastic cone, (2/π)
//! E*/tan β, less a curve that joins the two limits (0 for small X, a plateau of K tan²β/σ_r for large X), is
//! a sum of products of Chebyshev's polynomials; likewise the other answers. The coefficients are least
//! squares through the cones of `verification/results/atlas.csv.gz` (ν 0 to 0.49, both laws, Cauchy's
//! stress); the book says how well cones that are not among them are met.
//!
//! ```
//! use asperity_material::cone_atlas::{Atlas, Contact, SharpCone};
//! use asperity_material::{Elastic, Hardening, HardeningLaw};
//!
//! let elastic = Elastic { youngs_modulus: 210e9, poissons_ratio: 0.3 };
//! let steel = Hardening { law: HardeningLaw::Hollomon, yield_stress: 300e6, exponent: 0.2, youngs_modulus: 210e9 };
//! let atlas = Atlas::committed().expect("comes with the program");
//! let cone = SharpCone::new(10.0, &elastic, steel, Contact::Crushed);
//! let answer = atlas.answer(&cone).expect("inside the atlas");
//! // F = K h²; an elastic cone has (2/π) E*/tan β
//! let over_elastic = answer.k_over_e.value / (2.0 / std::f64::consts::PI / 0.91 / 10f64.to_radians().tan());
//! assert!(over_elastic > 0.05 && over_elastic < 0.5);
//! assert!(answer.k_over_e.error < 0.02);
//! // no cone of the atlas is as steep
//! assert!(atlas.answer(&SharpCone::new(50.0, &elastic, steel, Contact::Crushed)).is_none());
//! ```

use crate::{Elastic, Hardening, HardeningCurve, HardeningLaw};
use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::OnceLock;

/// ε_r over tan β of the stress σ_r that the atlas is written in: between the values that `calibrate` fits,
/// so that cones of one X are nearly alike. Any value near would do, as m is a coordinate of its own.
pub const STRAIN: f64 = 0.1;

/// Slopes of the atlas, degrees.
pub const SLOPES: [f64; 2] = [0.5, 40.0];
/// Its Young's moduli over yield stress.
pub const RATIOS: [f64; 2] = [5.0, 10_000.0];
/// Its hardening exponents.
pub const EXPONENTS: [f64; 2] = [0.0, 0.6];
/// Its Poisson's ratios.
pub const POISSONS_RATIOS: [f64; 2] = [0.0, 0.49];

/// Forces over that of the peak at which the recovery is read.
pub const FORCES: [f64; 9] = [0.95, 0.85, 0.7, 0.55, 0.4, 0.25, 0.12, 0.04, 0.0];

/// The one of the two bodies that is the cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contact {
    /// A cone of metal is crushed by a rigid plane.
    Crushed,
    /// A rigid cone indents a flat body of metal.
    Indenting,
}

/// A sharp cone and its metal.
#[derive(Clone, Debug, PartialEq)]
pub struct SharpCone {
    tan: f64,
    elastic: Elastic,
    curve: HardeningCurve,
    contact: Contact,
}

/// A number with its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its relative error (95 %), that of the computed cones included.
    pub error: f64,
}

/// Values of the atlas for a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// K/E of F = K h².
    pub k_over_e: Estimate,
    /// a tan β/h with π a² the contact area.
    pub contact_ratio: Estimate,
    /// S/(E h), the slope of the curve where unloading begins.
    pub stiffness: Estimate,
    /// Share of the work of loading that unloading returns.
    pub elastic_share: Estimate,
    /// Elastic recovery h_peak - h at each of [`FORCES`], over the depth of the peak; its error is that of
    /// the elastic share.
    pub recovery: [f64; FORCES.len()],
    /// σ_r/E at ε_r = [`STRAIN`] tan β.
    pub stress_over_e: f64,
    /// True where the cone lies inside the atlas; else the answer is extrapolated from its edge.
    pub inside: bool,
}

/// Numbers of an answer as the formula has them: K, contact ratio, S, elastic share, recovery.
pub const OUTPUTS: usize = 4 + FORCES.len();

/// Coordinates of a cone in the formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// X^q/(X^q + X₀^q), from 0 (elastic) to 1 (rigid and plastic).
    plasticity: f64,
    /// √tan β over that of the steepest cone.
    steepness: f64,
    /// m over the largest exponent.
    hardening: f64,
    /// ν over the largest.
    poissons_ratio: f64,
    /// 1 of an indenting cone, -1 of a crushed one.
    contact: f64,
    /// 1 of `hollomon`, -1 of `swift`, 0 of what is no power law.
    law: f64,
    /// Logarithm of K over that of an elastic cone that joins the limits.
    trend: f64,
}

/// X₀ and q of [`Place`]: of a few tried, those with which cones left out of the fit were met best.
const MIDDLE: [f64; 2] = [6.0, 0.7];

/// Plateau of K tan²β/σ_r in the trend; the polynomials make it that of the cone.
const PLATEAU: f64 = 12.0;

/// Largest degrees in plasticity, steepness, hardening and ν, and the largest sum of degrees over them: of
/// what both contacts and laws share, of what differs between contacts, between laws.
const BLOCKS: [([usize; 4], f64); 3] = [([9, 5, 4, 3], 1.3), ([6, 4, 3, 2], 1.3), ([5, 3, 2, 2], 1.3)];

/// The largest degree among them.
const MOST_DEGREE: usize = 9;

/// Degree of the formula of the errors in all coordinates together.
const DEGREE_OF_ERRORS: usize = 2;

/// Formulas of errors: K, contact ratio, S, elastic share.
pub const ERRORS: usize = 4;

impl SharpCone {
    /// A cone of the slope `slope_deg` (degrees, above 0 and below 90) against the plane.
    pub fn new(
        slope_deg: f64,
        elastic: &Elastic,
        curve: impl Into<HardeningCurve>,
        contact: Contact,
    ) -> SharpCone {
        SharpCone { tan: slope_deg.to_radians().tan(), elastic: *elastic, curve: curve.into(), contact }
    }

    /// True where slope, metal and ν lie in the ranges of the atlas. All cones of the atlas hardened by a
    /// power law.
    pub fn is_inside(&self) -> bool {
        let holds = |[low, high]: [f64; 2], x: f64| x >= low * (1.0 - 1e-9) && x <= high * (1.0 + 1e-9);
        let HardeningCurve::Power(law) = &self.curve else { return false };
        holds(SLOPES, self.tan.atan().to_degrees())
            && holds(RATIOS, self.elastic.youngs_modulus / law.yield_stress)
            && holds(EXPONENTS, law.exponent)
            && holds(POISSONS_RATIOS, self.elastic.poissons_ratio)
    }

    /// X and m.
    fn groups(&self) -> [f64; 2] {
        let strain = STRAIN * self.tan;
        let flow = self.curve.flow(strain);
        [
            self.elastic.reduced_modulus() * self.tan / flow.yield_stress,
            strain * flow.slope / flow.yield_stress,
        ]
    }

    /// The same with a yield stress at the edge of the atlas where it lies beyond; what is no power law as it
    /// is.
    fn at_the_edge(&self) -> SharpCone {
        let mut edge = self.clone();
        if let HardeningCurve::Power(law) = &mut edge.curve {
            let modulus = self.elastic.youngs_modulus;
            law.yield_stress = law.yield_stress.clamp(modulus / RATIOS[1], modulus / RATIOS[0]);
        }
        edge
    }

    /// Place of the cone in the formula; a cone beyond the atlas is taken to its edge.
    pub fn place(&self) -> Place {
        let [x, exponent] = self.groups();
        let x = x.max(least_x());
        let [middle, power] = MIDDLE;
        let [gentlest, steepest] = SLOPES.map(|slope| slope.to_radians().tan());
        let x_power = x.powf(power);
        let within = |[low, high]: [f64; 2], x: f64| x.clamp(low, high) / high;
        Place {
            plasticity: x_power / (x_power + middle.powf(power)),
            steepness: within([gentlest, steepest], self.tan).sqrt(),
            hardening: within(EXPONENTS, exponent),
            poissons_ratio: within(POISSONS_RATIOS, self.elastic.poissons_ratio),
            contact: if self.contact == Contact::Indenting { 1.0 } else { -1.0 },
            law: match &self.curve {
                HardeningCurve::Power(Hardening { law: HardeningLaw::Hollomon, .. }) => 1.0,
                HardeningCurve::Power(_) => -1.0,
                _ => 0.0,
            },
            trend: -(FRAC_2_PI * x / PLATEAU).ln_1p(),
        }
    }

    /// The formula's form of K/E, contact ratio, S/(E h), elastic share and recovery.
    pub fn logarithms(&self, answer: [f64; OUTPUTS]) -> [f64; OUTPUTS] {
        let modulus = self.elastic.reduced_modulus() / self.elastic.youngs_modulus;
        let [k, ratio, stiffness, ..] = answer;
        let mut logarithms = answer;
        logarithms[0] = (k * self.tan / (FRAC_2_PI * modulus)).ln() - self.place().trend;
        logarithms[1] = ratio.ln();
        logarithms[2] = (stiffness * self.tan / (2.0 * modulus)).ln();
        // metal goes back by about F/S
        logarithms[3..].iter_mut().for_each(|way| *way = (*way * stiffness / k).ln());
        logarithms
    }

    fn of_logarithms(&self, logarithms: [f64; OUTPUTS], trend: f64) -> [f64; OUTPUTS] {
        let modulus = self.elastic.reduced_modulus() / self.elastic.youngs_modulus;
        let mut answer = logarithms;
        answer[0] = (logarithms[0] + trend).exp() * FRAC_2_PI * modulus / self.tan;
        answer[1] = logarithms[1].exp();
        answer[2] = logarithms[2].exp() * 2.0 * modulus / self.tan;
        let back = answer[0] / answer[2];
        answer[3..].iter_mut().for_each(|way| *way = way.exp() * back);
        answer
    }
}

/// X of the gentlest cone of the hardest metal.
fn least_x() -> f64 {
    RATIOS[0] * SLOPES[0].to_radians().tan()
}

/// Chebyshev's polynomials of 2x - 1 up to `degree`, 1 at least and [`MOST_DEGREE`] at most.
fn chebyshev(x: f64, degree: usize) -> [f64; MOST_DEGREE + 1] {
    let x = 2.0 * x - 1.0;
    let mut series = [0.0; MOST_DEGREE + 1];
    series[..2].copy_from_slice(&[1.0, x]);
    for k in 2..=degree {
        series[k] = 2.0 * x * series[k - 1] - series[k - 2];
    }
    series
}

/// Degrees of the products of each of [`BLOCKS`], in the order of their coefficients.
fn products() -> &'static [Vec<[usize; 4]>; 3] {
    static PRODUCTS: OnceLock<[Vec<[usize; 4]>; 3]> = OnceLock::new();
    PRODUCTS.get_or_init(|| {
        BLOCKS.map(|(degrees, most)| {
            let share = |powers: &[usize; 4]| {
                powers.iter().zip(degrees).map(|(power, degree)| *power as f64 / degree as f64).sum::<f64>()
            };
            let [a, b, c, d] = degrees.map(|degree| degree + 1);
            let all = (0..a * b * c * d).map(|k| [k / (b * c * d), k / (c * d) % b, k / d % c, k % d]);
            all.filter(|powers| share(powers) <= most + 1e-9).collect()
        })
    })
}

impl Place {
    /// The terms whose weighted sum is a logarithm of [`SharpCone::logarithms`].
    pub fn terms(&self) -> Vec<f64> {
        // contacts are alike for gentle cones, laws for metal that does not harden
        let factors = [1.0, self.contact * self.steepness, self.law * self.hardening];
        let coordinates = [self.plasticity, self.steepness, self.hardening, self.poissons_ratio];
        let mut terms = Vec::new();
        for (((degrees, _), products), factor) in BLOCKS.iter().zip(products()).zip(factors) {
            let series: [[f64; MOST_DEGREE + 1]; 4] =
                std::array::from_fn(|i| chebyshev(coordinates[i], degrees[i]));
            let product = |[i, j, k, l]: &[usize; 4]| {
                factor * series[0][*i] * series[1][*j] * series[2][*k] * series[3][*l]
            };
            terms.extend(products.iter().map(product));
        }
        terms
    }

    /// The terms whose weighted sum is the logarithm of an error.
    pub fn terms_of_errors(&self) -> Vec<f64> {
        let x = [self.plasticity, self.steepness, self.hardening, self.poissons_ratio].map(|x| 2.0 * x - 1.0);
        let mut terms = vec![1.0, self.contact];
        for i in 0..4 {
            terms.extend([x[i], self.contact * x[i]]);
            terms.extend((i..4).take(4 * (DEGREE_OF_ERRORS - 1)).map(|j| x[i] * x[j]));
        }
        terms
    }
}

/// The formula with its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// Those of [`OUTPUTS`], one row for each of [`Place::terms`]: all outputs are summed side by side.
    values: Vec<[f64; OUTPUTS]>,
    /// One row for each of [`ERRORS`].
    errors: Vec<Vec<f64>>,
    /// Least errors of the computed cones, added in squares.
    least: [f64; ERRORS],
}

impl Atlas {
    /// The atlas that comes with the program; `None` only if its file is damaged.
    pub fn committed() -> Option<&'static Atlas> {
        static ATLAS: OnceLock<Option<Atlas>> = OnceLock::new();
        ATLAS.get_or_init(|| Atlas::of_text(include_str!("../data/atlas.txt"))).as_ref()
    }

    /// Of coefficients that a fit has found: a row of [`Place::terms`] for each of [`OUTPUTS`], of
    /// [`Place::terms_of_errors`] for each of [`ERRORS`], and the least errors. `None` if rows are missing.
    pub fn new(values: Vec<Vec<f64>>, errors: Vec<Vec<f64>>, least: [f64; ERRORS]) -> Option<Atlas> {
        let elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
        let metal =
            Hardening { law: HardeningLaw::Swift, yield_stress: 0.01, exponent: 0.1, youngs_modulus: 1.0 };
        let place = SharpCone::new(10.0, &elastic, metal, Contact::Crushed).place();
        let [terms, terms_of_errors] = [place.terms().len(), place.terms_of_errors().len()];
        let whole = |rows: &[Vec<f64>], count: usize, terms: usize| {
            rows.len() == count
                && rows.iter().all(|row| row.len() == terms && row.iter().all(|x| x.is_finite()))
        };
        (whole(&values, OUTPUTS, terms) && whole(&errors, ERRORS, terms_of_errors)).then(|| Atlas {
            values: (0..terms).map(|term| std::array::from_fn(|output| values[output][term])).collect(),
            errors,
            least,
        })
    }

    /// The text of the file: a row a line, the least errors last.
    pub fn text(&self) -> String {
        let row = |row: &[f64], digits: usize| {
            let words: Vec<String> = row.iter().map(|x| short(*x, digits)).collect();
            words.join(" ") + "\n"
        };
        let of_output = |output: usize| self.values.iter().map(|values| values[output]).collect::<Vec<_>>();
        let values: String = (0..OUTPUTS).map(|output| row(&of_output(output), 5)).collect();
        let errors: String = self.errors.iter().map(|errors| row(errors, 3)).collect();
        values + &errors + &row(&self.least, 5)
    }

    fn of_text(text: &str) -> Option<Atlas> {
        let row = |line: &str| line.split(' ').map(|word| word.parse().ok()).collect::<Option<Vec<f64>>>();
        let mut rows = text.lines().map(row).collect::<Option<Vec<_>>>()?;
        let least = rows.pop()?.try_into().ok()?;
        let errors = rows.split_off(rows.len().checked_sub(ERRORS)?);
        Atlas::new(rows, errors, least)
    }

    /// The answer of a cone inside the atlas; `None` of any other.
    pub fn answer(&self, cone: &SharpCone) -> Option<Answer> {
        cone.is_inside().then(|| self.nearest(cone))
    }

    /// The answer of any cone, with a flag whether it lies inside the atlas. Beyond its edge
    /// * a softer metal has the K/σ_r, contact ratio and shares of E/σ_y = 10,000: the plastic plateau;
    /// * a harder one the K/E*, contact ratio and shares of E/σ_y = 5;
    /// * a gentler or steeper cone the K tan²β/σ_r of the nearest slope at equal X; n and ν likewise.
    pub fn nearest(&self, cone: &SharpCone) -> Answer {
        let edge = cone.at_the_edge();
        let place = edge.place();
        let sum = |rows: &[f64], terms: &[f64]| rows.iter().zip(terms).map(|(c, t)| c * t).sum::<f64>();
        let mut logarithms = [0.0; OUTPUTS];
        for (values, term) in self.values.iter().zip(place.terms()) {
            logarithms.iter_mut().zip(values).for_each(|(sum, value)| *sum += value * term);
        }
        // toward a plane every cone is elastic: below the least X what differs from Sneddon's solution falls
        // with X
        let developed = (edge.groups()[0] / least_x()).min(1.0);
        if developed < 1.0 {
            logarithms[0] = developed * (logarithms[0] + place.trend) - place.trend;
            // a = (2/π) h/tan β, S = 2E* a
            let elastic = FRAC_2_PI.ln();
            logarithms[1..3].iter_mut().for_each(|x| *x = elastic + developed * (*x - elastic));
        }
        let mut answer = edge.of_logarithms(logarithms, place.trend);
        let terms = place.terms_of_errors();
        let errors: [f64; ERRORS] =
            std::array::from_fn(|i| sum(&self.errors[i], &terms).exp().hypot(self.least[i]));
        // soft metal has the force of its stress; what comes back is in proportion to it
        let [softer, at_edge] = [cone, &edge].map(|cone| cone.groups()[0]);
        let share = if softer > at_edge { at_edge / softer } else { 1.0 };
        answer[0] *= share;
        answer[3..].iter_mut().for_each(|way| *way *= share);
        let estimate = |i: usize| Estimate { value: answer[i], error: errors[i] };
        let strain = STRAIN * cone.tan;
        Answer {
            k_over_e: estimate(0),
            contact_ratio: estimate(1),
            stiffness: estimate(2),
            elastic_share: estimate(3),
            recovery: std::array::from_fn(|i| answer[4 + i]),
            stress_over_e: cone.curve.flow(strain).yield_stress / cone.elastic.youngs_modulus,
            inside: cone.is_inside(),
        }
    }

    /// Mean pressure on the contact, in the unit of σ_y, that `cone` would have if its E were large: that of
    /// fully plastic metal with the same σ_r and m under a cone of the same slope. Slopes beyond the atlas
    /// are taken to its edge.
    pub fn plateau(&self, cone: &SharpCone) -> Estimate {
        let [gentlest, steepest] = SLOPES.map(|slope| slope.to_radians().tan());
        let tan = cone.tan.clamp(gentlest, steepest);
        let youngs_modulus = cone.elastic.youngs_modulus;
        let soft = Hardening {
            // of the curve the atlas sees σ_r and m; in metal as soft as this m is n
            law: HardeningLaw::Swift,
            yield_stress: youngs_modulus / RATIOS[1],
            exponent: cone.groups()[1].clamp(EXPONENTS[0], EXPONENTS[1]),
            youngs_modulus,
        };
        let stress = cone.curve.flow(STRAIN * cone.tan).yield_stress;
        let soft = SharpCone { tan, elastic: cone.elastic, curve: soft.into(), contact: cone.contact };
        let found = self.nearest(&soft);
        let island = found.k_over_e.value * tan * tan / PI / found.stress_over_e;
        Estimate {
            value: stress * island / found.contact_ratio.value.powi(2),
            error: found.k_over_e.error.hypot(2.0 * found.contact_ratio.error),
        }
    }
}

/// So many digits behind the point, without what says nothing.
fn short(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

#[cfg(test)]
mod tests;
