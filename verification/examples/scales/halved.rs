//! Verdicts on surfaces that are anisotropic or not Gaussian beside those on half the map: of half the
//! side, and of pixels twice as wide.

use crate::verdicts::coarsened;
use crate::{FINE, REDUCED, first_half, follow, task};
use asperity_roughness::scales::{Class, Judged, Scales};
use asperity_roughness::{Grid, HeightMap, Kind, Surface, Target, generate};
use asperity_verification::report::Report;

/// Seeds of each kind.
const SEEDS: u64 = 2;
/// Load over E* h' of the whole map, and the yield stress over the same.
const LOAD: f64 = 0.01;
const YIELD: f64 = 0.05;
/// Octaves that the cut-off of a verdict may move.
const OCTAVE: f64 = 1.0 + 1e-9;

fn generated(kind: Kind, seed: u64) -> Vec<f64> {
    let grid = Grid { nodes: [FINE; 2], pixel: [1e-6; 2], seed };
    generate(kind, &grid, Target::Height(1e-6)).expect("the kind is in range").heights().to_vec()
}

/// A surface of the kind `name`, with the mean gradient 0.1.
fn surface(name: &str, seed: u64) -> Surface {
    let law = |rolloff: f64, cutoff: f64| {
        let kind = Kind::SelfAffine { hurst: 0.8, rolloff: rolloff * 1e-6, cutoff: cutoff * 1e-6 };
        generated(kind, seed + rolloff as u64)
    };
    let heights: Vec<f64> = match name {
        "anisotropic" => generated(Kind::Ground, seed),
        // what honing cut off coarse grooves, with finer roughness on the plateaus
        "plateau-honed" => law(64.0, 8.0)
            .into_iter()
            .zip(law(16.0, 2.0))
            .map(|(coarse, fine)| coarse.min(0.1 * fine))
            .collect(),
        "skewed" => law(48.0, 2.0).into_iter().map(|z| 1e-6 * (0.6e6 * z).exp()).collect(),
        "milled" => generated(Kind::Milled, seed),
        _ => law(48.0, 12.0),
    };
    let map = HeightMap::new(FINE, FINE, [1e-6; 2], heights).expect("a map of finite heights");
    // milled marks do not repeat, whose map is free
    let map = map.with_periodic(name != "milled");
    let gradient = Surface::from_map(map.clone()).expect("a map of many cells").parameters.mean_gradient;
    let scaled = map.mapped(|_, row| row.iter_mut().for_each(|z| *z *= 0.1 / gradient));
    Surface::from_map(scaled).expect("a map of many cells")
}

/// True where the verdict on a part is that on the whole: its class, and its cut-off within an octave; or
/// where the part is too small to say.
fn agrees(whole: &Judged, part: &Judged) -> bool {
    if part.verdict.class == Class::MapTooSmall {
        return true;
    }
    let near = match (whole.verdict.from, part.verdict.from) {
        (Some(a), Some(b)) if whole.verdict.class == Class::Converged => (a / b).log2().abs() <= OCTAVE,
        _ => true,
    };
    whole.verdict.class == part.verdict.class && near
}

/// Verdicts that agree, and all of them.
fn count(whole: &Scales, part: &Scales) -> [usize; 2] {
    let pairs = whole.verdicts.iter().filter_map(|one| {
        let same = |j: &&Judged| j.quantity == one.quantity && j.limited == one.limited;
        part.verdicts.iter().find(same).map(|other| agrees(one, other))
    });
    pairs.fold([0; 2], |[right, all], agrees| [right + usize::from(agrees), all + 1])
}

pub fn judged(report: &mut Report) {
    report.section("Verdicts on half the map");
    report.line(&format!(
        "Maps of {FINE}² at a load of {LOAD} E* h', and their first quarter, levelled, and the whole in pixels twice as wide (means): verdicts of the same class \
         whose cut-off is within an octave, or `map too small`, of all of both half-spaces; the map counts as right where nine of ten are.\n"
    ));
    report.table("| kind | seed | half the size | half the resolution |");
    let mut right = [0; 2];
    let kinds = ["anisotropic", "plateau-honed", "skewed", "milled", "band-limited"];
    for (kind, seed) in kinds.iter().flat_map(|kind| (1..=SEEDS).map(move |seed| (kind, seed))) {
        let surface = surface(kind, seed);
        let stress = REDUCED * surface.parameters.rms_gradient;
        let task = task(YIELD * stress);
        let smaller = Surface::from_map(first_half(&surface.map)).expect("a map of many cells");
        let parts = [smaller, coarsened(&surface.map, 2, true)];
        let whole = follow(&task, &surface, LOAD * stress);
        let counts = parts.map(|part| count(&whole, &follow(&task, &part, LOAD * stress)));
        for (right, [agree, all]) in right.iter_mut().zip(counts) {
            *right += usize::from(10 * agree >= 9 * all);
        }
        let cells = counts.map(|[agree, all]| format!("{agree} of {all}"));
        report.line(&format!("| {kind} | {seed} | {} |", cells.join(" | ")));
    }
    let maps = kinds.len() * SEEDS as usize;
    report.line(&format!(
        "\nRight at half the size: {} of {maps}; at half the resolution: {} of {maps}.",
        right[0], right[1]
    ));
}
