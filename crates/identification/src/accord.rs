//! Accord of an imprint with the other measurements: one metal has to explain both about as well as each is
//! explained by itself.
//!
//! A sum of squares over a hundred numbers hardly notices when two of them contradict: what they tell of the
//! metal is a few numbers, and its scatter is that of all. What the sum grows by when one metal has to serve
//! both sides is a sum of squares over those few alone, as two estimates of the same numbers differ: its
//! expectation is at most the number of unknowns, however many points there are and however large their
//! noise was stated.

use crate::experiment::{Data, Experiment};
use crate::noise::noise_from_scatter;
use crate::numbers::{Accord, limit, room_for_the_noise};
use crate::parameters::Unknowns;
use crate::search::again;

/// Rounds of taking the noise of a side from its scatter.
const NOISE_ROUNDS: usize = 3;

/// The accord of each imprint with all other measurements, near the best fit at `point`; empty where there is
/// none, or nothing beside it.
pub(crate) fn accords(experiments: &[Experiment], unknowns: &Unknowns, point: &[f64]) -> Vec<Accord> {
    let imprints = experiments.iter().enumerate().filter(|(_, e)| e.is_imprint());
    imprints.filter_map(|(i, _)| accord(experiments, i, unknowns, point)).collect()
}

/// That of the imprint `i`.
///
/// Noise that is taken from the scatter is that of the others by themselves: about a common fit that
/// contradicts them they scatter more, and the noise would hide it. Each side is fitted from the common fit
/// on, so that a minimum that is missed makes the growth smaller, never larger.
fn accord(experiments: &[Experiment], i: usize, unknowns: &Unknowns, point: &[f64]) -> Option<Accord> {
    let imprint = [experiments[i].clone()];
    let mut others = experiments.to_vec();
    others.remove(i);
    if others.is_empty() {
        return None;
    }
    let mut without = again(&others, unknowns, point).ok()?;
    for _ in 0..NOISE_ROUNDS {
        if !noise_from_scatter(&mut others, unknowns, &without.point) {
            break;
        }
        without = again(&others, unknowns, &without.point).ok()?;
    }
    let alone = again(&imprint, unknowns, point).ok()?;
    let [imprint] = imprint;
    let room = match &imprint.data {
        Data::Imprint(read) => {
            let told = read
                .noise_freedom
                .map_or(0.0, |freedom| room_for_the_noise(unknowns.parameters.len(), freedom));
            // where finite elements err more than heights scatter, it hardly matters how well noise is told
            let noise = (read.deviation() / imprint.depth).powi(2);
            let model = imprint.variance_of_the_model(unknowns, &alone.point)?;
            told * noise / (noise + model)
        }
        _ => 0.0,
    };
    let measurement = imprint.name.clone();
    others.insert(i, imprint);
    let starts = [point, &without.point, &alone.point];
    let common = starts.iter().filter_map(|start| again(&others, unknowns, start).ok());
    let common = common.map(|minimum| minimum.chi2).min_by(f64::total_cmp)?;
    let growth = (common - without.chi2 - alone.chi2).max(0.0);
    let growth_limit = limit(unknowns.parameters.len() as i64, room);
    Some(Accord { measurement, growth, growth_limit, holds: growth <= growth_limit })
}
