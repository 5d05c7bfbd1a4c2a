//! `summary.json`: verdicts, fits of the spectrum, what was pressed, and the sentence.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use crate::results::output::row;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::tables::Scene;
use asperity_roughness::Surface;
use asperity_roughness::scales::{By, Interval, Judged, Scales, Verdict};
use std::collections::BTreeMap;

row! {
    /// A number with its 90 % interval.
    #[derive(Copy)]
    IntervalRow(found: Interval, unit: f64) {
        /// The number; none of a roll-off longer than the map.
        value: Option<f64> = Some(found.value / unit).filter(|v| v.is_finite()),
        /// Lower end.
        low: f64 = found.low / unit,
        /// Upper end; none where the map does not hold it.
        high: Option<f64> = Some(found.high / unit).filter(|v| v.is_finite()),
    }
}

row! {
    /// The verdict on one quantity.
    VerdictRow(found: &Verdict, unit: f64) {
        /// `converged`, `converging`, `not converging` or `map too small`.
        class: String = found.class.name().into(),
        /// The coarsest cut-off from which on every value lies within 5 % of the last, or within the error where that is more, µm; none where only the whole map does.
        from_um: Option<f64> = found.from.map(|from| from / MICROMETRE),
        /// Relative bound of what waves of two finer octaves change of the value, of one that is converging of the extrapolated one; none where it is not converging or the map too small.
        error: Option<f64> = found.error,
        /// The least value that two finer octaves leave, as far as the spectrum tells; none of a map too small.
        low: Option<f64> = found.range.map(|range| range[0] / unit),
        /// The largest.
        high: Option<f64> = found.range.map(|range| range[1] / unit),
        /// log2 of the factor by which the next finer octave changes it, as expected.
        exponent: Option<f64> = found.exponent,
        /// On the whole map, in the unit of its column.
        value: f64 = found.value / unit,
        /// Expected with two finer octaves.
        extrapolated: Option<f64> = found.extrapolated.map(|value| value / unit),
    }
}

row! {
    /// The content of `summary.json`.
    Summary(name: &str, map: &Surface, scene: &Scene, found: &Scales) {
        /// Name of the map.
        surface: String = name.into(),
        /// Points along x and y.
        pixels: [usize; 2] = [map.map.columns(), map.map.rows()],
        /// Distance of points along x and y.
        pixel_size_um: [f64; 2] = map.map.pixel().map(|p| p / MICROMETRE),
        /// Points without a height.
        missing: usize = map.missing,
        /// Interpretation of the file: dialect, columns, units, lines; and remarks on it.
        understood: Vec<String> = map.notes.clone(),
        /// Nominal pressure of every scale, MPa.
        pressure_MPa: f64 = found.pressure / MEGAPASCAL,
        /// E* = E/(1 - ν²), MPa.
        reduced_modulus_MPa: f64 = scene.material.elastic().reduced_modulus() / MEGAPASCAL,
        /// Hurst exponent of the power spectrum; none of a map with too few waves.
        hurst: Option<IntervalRow> = found.fit.map(|fit| IntervalRow::new(fit.hurst, 1.0)),
        /// Longest wave of its power law.
        rolloff_um: Option<IntervalRow> = found.fit.map(|fit| IntervalRow::new(fit.rolloff, MICROMETRE)),
        /// Shortest wave of its power law.
        shortest_um: Option<IntervalRow> = found.fit.map(|fit| IntervalRow::new(fit.shortest, MICROMETRE)),
        /// True where the spectrum goes on to the pixel, so that a finer map is expected to hold finer waves.
        spectrum_goes_on: bool = found.growth.goes_on(),
        /// The filter of the cut-offs, in words.
        filter: String = "Gaussian (ISO 16610-61), edges and missing points by its weights; the whole map is not filtered".into(),
        /// The window of the spectrum, in words.
        window: String = match map.map.periodic() {
            true => "none: the map is a period".into(),
            false => "Hann along both axes, its loss of power made up for".into(),
        },
        /// The verdict on each quantity: of the elastic half-space by the names of the columns of `scales.csv` (areas corrected for pixels), with `_plastic` behind of the half-space with the limit of pressure.
        verdicts: BTreeMap<String, VerdictRow> = found.verdicts.iter().map(verdict_row).collect(),
        /// The cut-off that the program would use itself: the coarsest from which on all that has converged holds, µm.
        cutoff_um: f64 = found.cutoff() / MICROMETRE,
        /// Cut-off below which the measurement is not to be trusted, by the tip and by repeated maps, µm; none where neither limits it.
        trusted_um: Option<f64> = None,
        /// The coarsest cut-off at which hardness ends the growth of the mean pressure, µm; none where it does not.
        hardness_ends_um: Option<f64> = found.hardness_ends().map(|cutoff| cutoff / MICROMETRE),
        /// Slope up to which a cone of the metal is elastic, degrees.
        elastic_below_deg: Option<f64> = found.regimes.map(|r| r.elastic.atan().to_degrees()),
        /// Slope from which on it is fully plastic, degrees.
        plastic_above_deg: Option<f64> = found.regimes.map(|r| r.plastic.atan().to_degrees()),
        /// Share of the elastic load on patches of the whole map so steep that the metal under them is fully plastic.
        singular_pressure_share: Option<f64> =
            found.contacts(By::Elastic).last().and_then(|(_, one)| one.by_load[2]),
        /// The result in words.
        verdict: String = format!("{name} at {}", found.sentence()),
        /// Remarks on the trust in the numbers.
        warnings: Vec<String> = Vec::new(),
        /// Seconds the run took.
        wall_s: f64 = 0.0,
        /// The scene as pressed.
        scene: Scene = scene.clone(),
        /// Version of this program.
        version: String = env!("CARGO_PKG_VERSION").into(),
    }
}

/// The name of a verdict, and the verdict.
fn verdict_row(judged: &Judged) -> (String, VerdictRow) {
    let ending = if judged.limited { "_plastic" } else { "" };
    let (name, unit) = judged.quantity.column();
    (format!("{name}{ending}"), VerdictRow::new(&judged.verdict, unit))
}
