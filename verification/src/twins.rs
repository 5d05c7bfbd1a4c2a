//! Twins of `identify`: curves of sharp cones on metals that are known, by finite elements at `reference`,
//! whose errors a fit at a coarser level does not share; and what has to hold of the fits of one twin.
//!
//! By similarity a cone's curve is F = K h² with an unloading that scales with its depth, so ten numbers make
//! curves of any depth and any number of points. They stand in `results/reference-cones.md`.

use asperity_calibration::fit::SplitMix;
use asperity_calibration::indentation::{FORCES, solve};
use asperity_identification::interpolation::smooth;
use asperity_material::{Elastic, Hardening, HardeningLaw, StressMeasure};
use asperity_numerics::sobol::Sobol;
use asperity_simulation::scene::Accuracy;
use asperity_simulation::setup::cone::Cone as Indenter;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::point::material::Metal;
use serde_json::Value;
use std::fmt::Write;

/// A draw of normal numbers.
pub struct Normal(pub SplitMix);

impl Normal {
    /// The next one.
    pub fn draw(&mut self) -> f64 {
        let mut uniform = || ((self.0.bits() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
        // Box and Muller
        (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
    }
}

/// A rigid, frictionless cone of 90° less `slope_deg` half apex angle that indents metal of E 1, ν 0.3 and
/// law `swift`.
pub fn indenter(slope_deg: f64, e_over_sy: f64, exponent: f64) -> Indenter {
    let law =
        Hardening { law: HardeningLaw::Swift, yield_stress: 1.0 / e_over_sy, exponent, youngs_modulus: 1.0 };
    let metal = Metal {
        elastic: Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 },
        hardening: Some(law.into()),
        kinematic_share: 0.0,
        stress_measure: StressMeasure::default(),
    };
    Indenter { slope_deg, indents: true, metal, friction: None }
}

/// Recovery over the depth at a share of the peak force, between those at [`FORCES`]: nearly straight in
/// F^(2/3), and without a kink.
pub fn recovery_between(recovery: &[f64; FORCES.len()], share: f64) -> f64 {
    let bent = |share: f64| -share.powf(2.0 / 3.0);
    let points: Vec<[f64; 2]> = std::iter::once([bent(1.0), 0.0])
        .chain(FORCES.iter().zip(recovery).map(|(share, way)| [bent(*share), *way]))
        .collect();
    smooth(&points, bent(share))
}

/// A computed cone.
#[derive(Clone, Debug, PartialEq)]
pub struct Cone {
    /// Half apex angle, degrees.
    pub half_apex_deg: f64,
    /// E over σ_y.
    pub e_over_sy: f64,
    /// n.
    pub exponent: f64,
    /// K/E of F = K h².
    pub k_over_e: f64,
    /// Recovery over the depth at each of [`FORCES`].
    pub recovery: [f64; FORCES.len()],
}

impl Cone {
    /// That of number `i` by finite elements at `reference`; `None` where they came to no end.
    pub fn solved(i: usize) -> Option<Cone> {
        let sobol = Sobol::new(2)?;
        let half_apex_deg = [70.3, 60.0][i % 2];
        let e_over_sy = (50.0 * 12_f64.powf(sobol.coordinate(0, i + 1))).round();
        let exponent = (350.0 * sobol.coordinate(1, i + 1)).round() / 1e3;
        let cone = indenter(90.0 - half_apex_deg, e_over_sy, exponent);
        let (found, _) = solve(&cone, Accuracy::Reference, &Analyses::default()).ok()?;
        Some(Cone { half_apex_deg, e_over_sy, exponent, k_over_e: found.k_over_e, recovery: found.recovery })
    }

    /// Those that were computed.
    pub fn computed() -> Vec<Cone> {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/results/reference-cones.md");
        let text = std::fs::read_to_string(file).unwrap_or_default();
        text.lines().filter_map(Cone::of_row).collect()
    }

    /// The head of their table.
    pub fn head() -> String {
        let back: String = FORCES.iter().map(|force| format!(" recovery at {force} |")).collect();
        format!("| half apex angle, ° | E/σ_y | n | K/E |{back}")
    }

    /// The row of this one.
    pub fn row(&self) -> String {
        let back: String = self.recovery.iter().map(|way| format!(" {way:.7} |")).collect();
        let Cone { half_apex_deg, e_over_sy, exponent, k_over_e, .. } = self;
        format!("| {half_apex_deg} | {e_over_sy} | {exponent} | {k_over_e:.7} |{back}")
    }

    fn of_row(line: &str) -> Option<Cone> {
        let cells: Option<Vec<f64>> =
            line.trim_matches(['|', ' ']).split('|').map(|cell| cell.trim().parse().ok()).collect();
        let cells = cells?;
        let [half_apex_deg, e_over_sy, exponent, k_over_e] = *cells.first_chunk()?;
        Some(Cone {
            half_apex_deg,
            e_over_sy,
            exponent,
            k_over_e,
            recovery: cells.get(4..)?.try_into().ok()?,
        })
    }

    /// A curve to `depth` (µm) in metal of the modulus `modulus` (GPa), with so many points of loading and
    /// half as many of unloading, noise of that relative standard deviation on every force.
    pub fn curve(&self, modulus: f64, depth: f64, points: usize, noise: f64, draw: &mut Normal) -> String {
        let mut text = "depth_um,force_mN\n".to_string();
        // E in GPa over lengths in µm: mN
        let force = |depth: f64| modulus * self.k_over_e * depth * depth;
        let mut row = |depth: f64, force: f64| {
            let _ = writeln!(text, "{depth:.8},{:.10}", force * (1.0 + noise * draw.draw()));
        };
        for k in 1..=points {
            let at = depth * k as f64 / points as f64;
            row(at, force(at));
        }
        let count = (points / 2).max(10);
        for k in 1..count {
            let share = 1.0 - k as f64 / count as f64;
            row(depth * (1.0 - recovery_between(&self.recovery, share)), share * force(depth));
        }
        text
    }
}

/// The numbers that may be unknown beside the metal of a twin; in truth both are 0.
pub const NUISANCES: [&str; 2] = ["contact_depth", "machine_compliance"];

/// A twin: a metal, its curve, and what is told of it.
#[derive(Clone, Debug)]
pub struct Twin {
    /// The cone that indented it.
    pub cone: Cone,
    /// E, GPa.
    pub modulus: f64,
    /// Points of its loading.
    pub points: usize,
    /// Relative standard deviation of a force.
    pub noise: f64,
    /// True where that is told.
    pub stated: bool,
    /// Number of [`NUISANCES`] that are unknown.
    pub nuisances: usize,
    /// Seed of the noise.
    pub seed: u64,
}

impl Twin {
    /// Number `i` over the metals of `cones`: 20 to 20,000 points, noise of 0.1 to 2 %, stated or not, with
    /// no, one or two unknowns beside the metal.
    pub fn new(cones: &[Cone], i: usize) -> Option<Twin> {
        let sobol = Sobol::new(3)?;
        let at = |k: usize| sobol.coordinate(k, i + 1);
        Some(Twin {
            cone: cones.get(i % cones.len().max(1))?.clone(),
            modulus: (10.0 * 60.0 * 3.5_f64.powf(at(0))).round() / 10.0,
            points: (20.0 * 1000_f64.powf(at(1))).round() as usize,
            noise: 1e-3 * 20_f64.powf(at(2)),
            stated: i.is_multiple_of(2),
            nuisances: i % 3,
            seed: 31 * i as u64 + 7,
        })
    }

    /// σ_y, MPa.
    pub fn yield_stress(&self) -> f64 {
        1e3 * self.modulus / self.cone.e_over_sy
    }

    /// The table of its readings: 2 µm deep.
    pub fn curve(&self) -> String {
        let mut draw = Normal(SplitMix(self.seed));
        self.cone.curve(self.modulus, 2.0, self.points, self.noise, &mut draw)
    }

    /// The fit of its curve in `file`, E sought within ±20 %, with the first `nuisances` unknown and the
    /// noise as it is stated.
    pub fn fit(&self, file: &str, nuisances: usize, noise: Option<f64>) -> String {
        let [low, high] = [0.8, 1.2].map(|share| share * self.modulus);
        let mut text = format!(
            "accuracy = \"standard\"\nsamples = 0\n[material]\nyoungs_modulus = [\"{low:.2} GPa\", \"{high:.2} GPa\"]\npoissons_ratio = 0.3\nyield_stress = [\"30 MPa\", \"10 GPa\"]\nhardening_exponent = [0.0, 0.5]\nhardening_law = \"swift\"\n[[curve]]\nfile = \"{file}\"\ntool = {{ shape = \"cone\", half_apex_deg = {} }}\nunknown = {:?}\n",
            self.cone.half_apex_deg,
            &NUISANCES[..nuisances]
        );
        if let Some(noise) = noise {
            let _ = writeln!(text, "noise = \"{:.4} %\"", 100.0 * noise);
        }
        text
    }

    /// True values of E (GPa), σ_y (MPa) and n.
    pub fn truth(&self) -> [(&'static str, f64); 3] {
        [
            ("youngs_modulus", self.modulus),
            ("yield_stress", self.yield_stress()),
            ("hardening_exponent", self.cone.exponent),
        ]
    }
}

/// The outcome of the fits of a twin.
#[derive(Clone, Copy, Debug)]
pub struct Properties {
    /// True where the right model fits.
    pub fits: bool,
    /// True where the intervals of E, σ_y and n hold the truth, each by itself.
    pub covers: [bool; 3],
    /// Relative error of σ_y, and the half width of its interval over the truth.
    pub of_the_yield_stress: [f64; 2],
    /// Largest share of its width by which an added unknown narrows an interval of E, σ_y or n.
    pub narrowed: f64,
    /// Largest growth of the minimised sum of squares by an added unknown.
    pub raised: f64,
}

fn number(fit: &Value, name: &str, key: &str) -> f64 {
    fit["parameters"][name][key].as_f64().unwrap_or(f64::NAN)
}

/// The properties of `twin`, whose curve stands in `file`, by `answer`: the `fit.json` of a fit. The noise is
/// held between the fits that are compared.
pub fn properties(twin: &Twin, file: &str, answer: &dyn Fn(&str) -> Option<Value>) -> Option<Properties> {
    let fit = answer(&twin.fit(file, twin.nuisances, twin.stated.then_some(twin.noise)))?;
    let held = fit["residual"]["curves"][0]["noise"].as_f64()?;
    let compared: Option<Vec<Value>> =
        (0..=NUISANCES.len()).map(|nuisances| answer(&twin.fit(file, nuisances, Some(held)))).collect();
    let width = |fit: &Value, name: &str| number(fit, name, "high") - number(fit, name, "low");
    let (mut narrowed, mut raised) = (0.0_f64, f64::NEG_INFINITY);
    for pair in compared?.windows(2) {
        let chi2 = |fit: &Value| fit["residual"]["chi2"].as_f64().unwrap_or(f64::NAN);
        raised = raised.max(chi2(&pair[1]) - chi2(&pair[0]));
        for (name, _) in twin.truth() {
            narrowed = narrowed.max(1.0 - width(&pair[1], name) / width(&pair[0], name));
        }
    }
    let holds = |(name, truth): (&str, f64)| {
        (number(&fit, name, "low")..=number(&fit, name, "high")).contains(&truth)
    };
    let (name, truth) = ("yield_stress", twin.yield_stress());
    Some(Properties {
        fits: fit["residual"]["fits"] == true,
        covers: twin.truth().map(holds),
        of_the_yield_stress: [number(&fit, name, "value") / truth - 1.0, 0.5 * width(&fit, name) / truth],
        narrowed,
        raised,
    })
}
