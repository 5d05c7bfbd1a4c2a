//! `joint.json`: fits, errors, what was pressed and all rows.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use super::table::{JointRow, Seal};
use crate::crush::Phase;
use crate::results::numbers::{rounded, with_digits};
use crate::results::output::row;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::tables::Scene;
use asperity_roughness::Surface;
use asperity_roughness::joint::{Exponential, Fits, JointPath, Law, Power};

/// Relative error of straight lines between the rows of a table for another program.
pub(super) const TABLE_TOLERANCE: f64 = 5e-3;
/// Pieces of the line that is drawn of a fit.
const FIT_POINTS: usize = 64;
/// Bounds this many times apart say little.
const WIDE_BOUNDS: f64 = 3.0;
/// Largest error of pixels that is no warning.
const SEEN_ERROR: f64 = 0.1;

row! {
    /// p = pressure exp(-gap/length) through loads that touch in spots, over the widest range that it meets
    /// to 20 %.
    ExponentialFit(found: &Exponential, sq: f64) {
        /// Pressure where the gap is extrapolated to 0, MPa.
        pressure_MPa: f64 = found.pressure / MEGAPASCAL,
        /// Length over which the pressure falls to 1/e, µm.
        length_um: f64 = found.length / MICROMETRE,
        /// That length over Sq.
        length_over_sq: f64 = found.length / sq,
        /// Smallest and largest pressure of the fit, MPa.
        range_MPa: [f64; 2] = found.fit.range.map(|p| p / MEGAPASCAL),
        /// Root mean square of its relative deviations.
        residual: f64 = found.fit.residual,
    }
}

impl ExponentialFit {
    /// Approach (µm) since a first touch at mean gap `touch` (µm) and pressure (MPa), over the range of the
    /// fit.
    pub(super) fn points(&self, touch: f64) -> impl Iterator<Item = [f64; 2]> {
        let [low, high] = self.range_MPa;
        (0..=FIT_POINTS).map(move |i| {
            let pressure = low * (high / low).powf(i as f64 / FIT_POINTS as f64);
            [touch + self.length_um * (pressure / self.pressure_MPa).ln(), pressure]
        })
    }
}

row! {
    /// y = factor (p/MPa)^exponent through loads that touch in spots, over the widest range that it meets
    /// to 20 %.
    PowerFit(found: &Power, unit: f64) {
        /// y at 1 MPa.
        factor: f64 = found.factor * MEGAPASCAL.powf(found.exponent) / unit,
        /// The exponent.
        exponent: f64 = found.exponent,
        /// Smallest and largest pressure of the fit, MPa.
        range_MPa: [f64; 2] = found.fit.range.map(|p| p / MEGAPASCAL),
        /// Root mean square of its relative deviations.
        residual: f64 = found.fit.residual,
    }
}

row! {
    /// A row of the table that programs take: straight lines between rows are off the law by 0.5 % at most.
    #[derive(Copy)]
    LawRow(approach: f64, pressure: f64) {
        /// Fall of the mean gap since first touch, µm.
        approach_um: f64 = approach / MICROMETRE,
        /// Nominal pressure, MPa.
        pressure_MPa: f64 = pressure / MEGAPASCAL,
    }
}

row! {
    /// The content of `joint.json`.
    Summary(surfaces: Vec<String>, surface: &Surface, scene: &Scene, path: &JointPath, fits: Fits) {
        /// Names of the maps.
        surfaces: Vec<String> = surfaces,
        /// Interpretation of the files: dialect, columns, units, lines; and remarks on them.
        understood: Vec<String> = Vec::new(),
        /// Points along x and y of one map, of one tile where the map is cut.
        pixels: [usize; 2] = [surface.map.columns(), surface.map.rows()],
        /// Distance of points along x and y.
        pixel_size_um: [f64; 2] = surface.map.pixel().map(|p| p / MICROMETRE),
        /// Points of the first map or tile without a height.
        missing: usize = surface.missing,
        /// Points of it that `surface.outliers` took away.
        outliers: usize = surface.outliers,
        /// Root mean square height Sq of the first map or tile.
        sq_um: f64 = surface.parameters.sq / MICROMETRE,
        /// Area over which the pressure is nominal, of one map or tile, µm².
        nominal_area_um2: f64 = path.nominal_area / MICROMETRE / MICROMETRE,
        /// E* = E/(1 - ν²), MPa.
        reduced_modulus_MPa: f64 = scene.material.elastic().reduced_modulus() / MEGAPASCAL,
        /// Largest pressure that a pixel carries, MPa; none of elastic metal.
        limit_MPa: Option<f64> = None,
        /// Relative uncertainty of that limit (95 %).
        limit_error: Option<f64> = None,
        /// 2 k₁ k₂/(k₁ + k₂) of `[thermal]`, W/(m K).
        conductivity_W_per_mK: Option<f64> = scene.thermal.map(|bodies| bodies.conductors().0.conductivity()),
        /// The largest nominal pressure, MPa.
        largest_pressure_MPa: f64 = path.loading.last().map_or(f64::NAN, |last| last.pressure / MEGAPASCAL),
        /// Mean gap at first touch, µm: the zero of the approach.
        first_touch_gap_um: f64 = path.loading.first().map_or(f64::NAN, |first| first.mean_gap / MICROMETRE),
        /// Pressure over mean gap.
        fit_pressure: Option<ExponentialFit> =
            fits.pressure.map(|fit| ExponentialFit::new(&fit, surface.parameters.sq)),
        /// Elastic stiffness (MPa/µm) over pressure.
        fit_stiffness: Option<PowerFit> = fits.stiffness.map(|fit| PowerFit::new(&fit, MEGAPASCAL / MICROMETRE)),
        /// Thermal conductance (W/(m² K)) over pressure, medium included.
        fit_conductance: Option<PowerFit> = None,
        /// Height range, peak to valley, of roughness that the map does not hold, µm.
        left_out_um: Option<f64> = None,
        /// The proven bounds, in words.
        bounds: String = String::new(),
        /// ∫p dδ over the elastic energy, less 1: of elastic, periodic maps, whose work is all stored.
        energy_error: Option<f64> = None,
        /// The law for interpolation.
        law: Vec<LawRow> = Vec::new(),
        /// Rows of `joint.csv`.
        rows: Vec<JointRow> = Vec::new(),
        /// The result in words.
        verdict: String = String::new(),
        /// Remarks on the trust in the numbers.
        warnings: Vec<String> = Vec::new(),
        /// Seconds the run took.
        wall_s: f64 = 0.0,
        /// The scene as pressed, of the first map.
        scene: Scene = scene.clone(),
        /// Version of this program.
        version: String = env!("CARGO_PKG_VERSION").into(),
    }
}

impl Summary {
    /// Takes the rows and what they say.
    pub(super) fn tell(&mut self, rows: &[JointRow], law: Option<&Law>, seal: &Seal, elastic: bool) {
        self.rows = rows.to_vec();
        self.law = law.map_or_else(Vec::new, |law| {
            law.table(TABLE_TOLERANCE).into_iter().map(|[approach, p]| LawRow::new(approach, p)).collect()
        });
        let loading = || rows.iter().filter(|row| row.phase == Phase::Load && row.pressure_MPa > 0.0);
        let spots = self.fit_stiffness.as_ref().map_or(f64::INFINITY, |fit| fit.range_MPa[1]);
        let conducted = loading()
            .filter(|row| row.pressure_MPa <= spots * (1.0 + 1e-9))
            .filter_map(|row| Some([row.pressure_MPa * MEGAPASCAL, row.conductance_W_per_m2K?]));
        self.fit_conductance = Power::new(conducted).map(|fit| PowerFit::new(&fit, 1.0));
        self.bounds = self.bounds_in_words(elastic);
        let worst = loading().filter_map(|row| row.error).fold(0.0, f64::max);
        if worst > SEEN_ERROR {
            let worst = match worst <= 1.0 {
                true => format!("up to {} %", rounded(100.0 * worst)),
                false => "more than 100 %".into(),
            };
            self.warnings.push(format!(
                "the stiffness of single loads is uncertain by {worst}: the contact is made of few pixels there; column error tells where"
            ));
        }
        let gaps = |row: &JointRow| [row.critical_gap_x_um, row.critical_gap_y_um];
        let narrowest = loading().flat_map(gaps).flatten().fold(f64::INFINITY, f64::min);
        if seal.is_rare(narrowest * MICROMETRE) {
            self.warnings.push(format!(
                "the critical passage is down to {} um high, below ten mean free paths of the gas: its molecules slip along the walls, and more \
                 leaks than the flow of a continuum says",
                with_digits(narrowest, 2)
            ));
        }
        self.verdict = self.verdict_in_words();
    }

    fn peak(&self) -> Option<&JointRow> {
        self.rows.iter().rfind(|row| row.phase == Phase::Load)
    }

    fn bounds_in_words(&self, elastic: bool) -> String {
        let Some(range) = self.left_out_um else {
            return "proven bounds of the elastic stiffness need joint.left_out, the height range of the roughness that the map does not hold"
                .into();
        };
        let range = with_digits(range, 3);
        if !elastic {
            return format!(
                "no bounds from the {range} um that were left out: they are proven of elastic metal alone, and this one flows"
            );
        }
        // the largest load has none from above: no chord goes beyond it
        let loads = || self.rows.iter().filter(|row| row.phase == Phase::Load);
        let width = |row: &JointRow| {
            Some(row.elastic_stiffness_high_MPa_per_um? / row.elastic_stiffness_low_MPa_per_um?)
        };
        match loads().filter_map(width).reduce(f64::min) {
            Some(width) if width < WIDE_BOUNDS => format!(
                "whatever roughness of {range} um was left out, the elastic stiffness is proven to a factor of {} where that is least",
                with_digits(width, 3)
            ),
            Some(width) => format!(
                "roughness of {range} um that was left out bounds the elastic stiffness to a factor of {} at best, which says little",
                with_digits(width, 2)
            ),
            None => format!(
                "roughness of {range} um that was left out is as high as the joint closes: the elastic stiffness has no proven upper bound"
            ),
        }
    }

    fn verdict_in_words(&self) -> String {
        let Some(peak) = self.peak() else { return String::new() };
        let elastic = self.limit_MPa.is_some() && self.rows.iter().all(|row| row.limited_share == 0.0);
        let number = |value: f64| with_digits(value, 4);
        let mut text = format!(
            "{}: from first touch to {} MPa the joint closes by {} um, to a mean gap of {} um",
            self.surfaces.join(", "),
            number(peak.pressure_MPa),
            number(peak.approach_um),
            number(peak.mean_gap_um),
        );
        let error = peak.error.map_or_else(String::new, |e| format!(" (± {} %)", rounded(100.0 * e)));
        match peak.elastic_stiffness_MPa_per_um {
            Some(stiffness) => {
                text += &format!("; its elastic stiffness there is {} MPa/um{error}", number(stiffness));
            }
            None => text += "; closed there, so that its stiffness is beyond numbers",
        }
        if let Some(h) = peak.conductance_W_per_m2K {
            text += &format!(", its conductance {} W/(m² K)", number(h));
        }
        if elastic {
            text += "; no pixel reaches the limit of pressure, so that unloading follows the loading";
        }
        if let Some(fit) = &self.fit_stiffness {
            text += &format!(
                "; from {} to {} MPa the stiffness grows as p^{:.3} (± {} %)",
                number(fit.range_MPa[0]),
                number(fit.range_MPa[1]),
                fit.exponent,
                rounded(100.0 * fit.residual)
            );
        }
        text + ". " + &self.bounds[..1].to_uppercase() + &self.bounds[1..] + "."
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p = p₀ exp(-g/l) at every point of the line that is drawn, from one end of its range to the other.
    #[test]
    fn a_fit_is_drawn_over_its_range_alone() {
        let fit = ExponentialFit {
            pressure_MPa: 2e3,
            length_um: 0.3,
            length_over_sq: 0.2,
            range_MPa: [0.5, 80.0],
            residual: 0.1,
        };
        let points: Vec<_> = fit.points(4.0).collect();
        for [approach, pressure] in &points {
            let exact = 2e3 * ((approach - 4.0) / 0.3).exp();
            assert!((pressure / exact - 1.0).abs() < 1e-12, "{pressure} {exact}");
        }
        let ends = [points[0][1], points[points.len() - 1][1]];
        assert!((ends[0] - 0.5).abs() < 1e-12 && (ends[1] - 80.0).abs() < 1e-12, "{ends:?}");
        assert!(points.windows(2).all(|two| two[1][0] > two[0][0]));
    }
}
