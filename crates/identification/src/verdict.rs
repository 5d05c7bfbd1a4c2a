//! Verdict on what the measurements tell and what they do not, in words.

use crate::identifiability::NullDirection;
use crate::next_experiment::NextExperiment;
use crate::numbers::{Found, Residual, StressAt};
use asperity_material::units::rounded;
use indexmap::IndexMap;
use std::fmt::Write;

/// Share of the width of an interval below which an experiment that leaves it is named beside the best one.
const WORTH_SAYING: f64 = 0.9;

/// The verdict, in one sentence that can be quoted.
pub fn verdict(
    parameters: &IndexMap<String, Found>,
    representative: Option<&StressAt>,
    null: Option<&NullDirection>,
    next: Option<&NextExperiment>,
    residual: &Residual,
    doubts: &[String],
) -> String {
    let list = |told: bool| -> Vec<&str> {
        parameters.iter().filter(|(_, f)| f.identifiable == told).map(|(name, _)| name.as_str()).collect()
    };
    if let Some(accord) = residual.accords.iter().find(|accord| !accord.holds) {
        return format!(
            "not identifiable: no metal explains both the measurement \"{}\" and the others, so the model is rejected (where one metal has to serve both χ² grows by {:.1}, of which chance allows {:.1}); look whether they belong to one indent, for a wrong unit, tool, law or level",
            accord.measurement, accord.growth, accord.growth_limit
        );
    }
    if !residual.fits {
        let misses = residual.curves.iter().filter(|curve| curve.chi2 > curve.chi2_limit);
        let miss = misses.max_by(|a, b| (a.chi2 / a.chi2_limit).total_cmp(&(b.chi2 / b.chi2_limit)));
        let of = miss.filter(|_| residual.curves.len() > 1).map_or_else(String::new, |curve| {
            format!(
                ", \"{}\" by itself {:.1} of {:.1} that chance allows",
                curve.name, curve.chi2, curve.chi2_limit
            )
        });
        return format!(
            "not identifiable: no metal within the bounds fits the measurements within their errors, so the model is rejected (χ² {:.1}, {} degrees of freedom{of}); look for a wrong unit, tool, law, bound or noise",
            residual.chi2, residual.degrees_of_freedom
        );
    }
    if let Some(doubt) = doubts.first() {
        return format!(
            "not identifiable: the numbers hold for this tool and this first touch alone, which the curve itself doubts ({doubt})"
        );
    }
    let (told, unidentified) = (list(true), list(false));
    let mut text = match (&told[..], &unidentified[..]) {
        (_, []) => "identifiable: the measurements determine all that is sought".to_string(),
        ([], _) => format!("not identifiable: the measurements do not determine {}", unidentified.join(", ")),
        _ => format!(
            "partly identifiable: the measurements determine {}, but not {}",
            told.join(", "),
            unidentified.join(", ")
        ),
    };
    if let Some(metals) = several_metals(parameters) {
        let _ = write!(text, "; {metals}");
    }
    if let (false, Some(null)) = (unidentified.is_empty(), null) {
        let _ = write!(text, "; they are least sensitive to {}", null.text);
    }
    if let (false, Some(s)) = (unidentified.is_empty(), representative) {
        let _ = write!(
            text,
            "; what they determine best is the stress at a plastic strain of {}: {:.0} ({:.0} to {:.0}) MPa",
            s.plastic_strain, s.value_MPa, s.low_MPa, s.high_MPa
        );
    }
    if let Some(next) = next {
        let percent = |ratio: f64| format!("to {:.0} % of its width", 100.0 * ratio);
        let (name, by) = (&next.parameter, percent(next.interval_ratio));
        let _ = write!(text, "; {} beside these would narrow the interval of {name} {by}", next.text);
        for other in next.others.iter().filter(|other| other.interval_ratio < WORTH_SAYING) {
            let _ = write!(text, ", {} {}", other.text, percent(other.interval_ratio));
        }
    }
    text
}

/// The sentence on several metals that fit; `None` of one.
fn several_metals(parameters: &IndexMap<String, Found>) -> Option<String> {
    let count = parameters.values().map(|f| f.branches.len()).max().filter(|count| *count > 1)?;
    let metal = |k: usize| {
        let number = |(name, f): (&String, &Found)| {
            let value = f.branches.get(k)?.value;
            Some(format!("{name} {} {}", rounded(value, 3), f.unit).trim_end().to_string())
        };
        parameters.iter().filter_map(number).collect::<Vec<_>>().join(", ")
    };
    let metals: Vec<String> = (0..count).map(metal).collect();
    let number = if count == 2 { "two".to_string() } else { count.to_string() };
    Some(format!("{number} metals fit: {}", metals.join("; or ")))
}
