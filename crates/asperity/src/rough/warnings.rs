//! Warnings: remarks on the trust in the numbers of a rough contact.

use super::charts;
use super::closure_contact::IslandContact;
use super::half_space::{CONTRADICTION, SpaceContact};
use crate::results::numbers::with_digits;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::scene::Scene;
use asperity_roughness::{Closure, Coefficient, Levelling, SINGLE_ASPERITY_EXPONENT, Surface, level};

/// Remarks on the trust in the numbers.
pub type Warnings = Vec<String>;

/// The beginning of a warning of a closure that was left out.
const SKIPPED_PREFIX: &str = "skipped: ";

/// Of a closure that lacks its material: `reason`.
pub(super) fn skipped(reason: &str) -> String {
    format!("{SKIPPED_PREFIX}{reason}")
}

/// True of a warning of a closure that was left out.
pub(super) fn is_skipped(warning: &str) -> bool {
    warning.starts_with(SKIPPED_PREFIX)
}

/// Of a run that ended before `closure`.
pub(super) fn stopped_before(closure: Closure) -> String {
    format!("stopped before closure \"{}\"", closure.name())
}

/// Of the scene as a whole: an unused fluid, its material, its surface and its load.
pub(crate) fn scene_warnings(surface: &Surface, scene: &Scene) -> Warnings {
    let first = unused_fluid(scene).into_iter().chain(two_materials(scene)).chain(impossible_hardness(scene));
    first.chain(missing_points(surface, scene)).chain(surface_warnings(surface, scene)).collect()
}

/// Share of points without a height below which no number of a contact moves by more than pixels move it.
const SEEN_MISSING_SHARE: f64 = 1e-3;

/// Points without a height: what they do to load, area and flow.
fn missing_points(surface: &Surface, scene: &Scene) -> Option<String> {
    let map = &surface.map;
    let nodes = map.heights().len() as f64;
    let share = (surface.missing + surface.outliers) as f64 / nodes;
    if share <= SEEN_MISSING_SHARE {
        return None;
    }
    let taken = match surface.outliers {
        0 => String::new(),
        n => format!(" ({n} of them surface.outliers took away)"),
    };
    let percent = 100.0 * share;
    if map.missing() == 0 {
        return Some(format!(
            "{percent:.1} % of the points have no height{taken} and were filled from their rims: contact, gap and flow there are a guess"
        ));
    }
    let cells = surface.extent.cells as f64 / (map.cell_columns() * map.cell_rows()) as f64;
    let pixels = 1.0 - map.missing() as f64 / nodes;
    let closures = scene.closure.closures();
    let (fields, islands): (Vec<Closure>, Vec<Closure>) =
        closures.iter().partition(|closure| closure.is_half_space());
    let rest = [
        (!islands.is_empty()).then(|| format!("{:.1} % of the cells for closures of islands", 100.0 * cells)),
        (!fields.is_empty()).then(|| format!("{:.1} % of the pixels for the half-space", 100.0 * pixels)),
    ];
    let rest = rest.into_iter().flatten().collect::<Vec<_>>().join(" and ");
    let flow = match fields[..] {
        [] => "",
        _ => "; percolation and leak take them for closed, which they may not be",
    };
    Some(format!(
        "{percent:.1} % of the points have no height{taken} and carry nothing: areas and the load are those of the rest, which is {rest} \
         (force = nominal pressure x nominal_area_um2){flow}; surface.missing = \"fill\" fills them"
    ))
}

/// A fluid that no closure lets flow, or a seal of it that is not of this map.
fn unused_fluid(scene: &Scene) -> Option<String> {
    let flows = scene.closure.closures().iter().any(|closure| closure.is_half_space());
    let text = match scene.half_space.leak {
        _ if !flows => {
            "closures of islands leave no gap that can leak; add closure \"half-space\" or \"half-space-plastic\""
        }
        Some(false) => "half_space.leak = false; leave it out and the fluid flows",
        _ => {
            let shape = scene.fluid.as_ref()?.width_over_length?;
            return Some(format!(
                "fluid.width_over_length = {shape} is not used: flows are those through this map; `asperity joint` takes it"
            ));
        }
    };
    scene.fluid.as_ref().map(|_| format!("[fluid] is not used: {text}"))
}

/// Hardness over Young's modulus beyond which no metal has it: hardened steels have 0.05.
const MOST_HARDNESS: f64 = 0.1;

/// A hardness that no metal has.
fn impossible_hardness(scene: &Scene) -> Option<String> {
    let hardness = scene.material.hardness?;
    let share = hardness.0 / scene.material.youngs_modulus.0;
    (share > MOST_HARDNESS).then(|| {
        format!(
            "hardness = {hardness} is {} times Young's modulus, that of metals at most 0.05 times: look at its unit",
            with_digits(share, 2)
        )
    })
}

/// A metal that yields, pressed elastically by the only closure of the scene.
fn yields(closure: Closure, one: &SpaceContact, scene: &Scene) -> Option<String> {
    let material = &scene.material;
    let limit = material.hardness.map(|h| h.0).or_else(|| Some(3.0 * material.yield_stress?.0))?;
    let mean = one.contact.pressure / one.contact.area.corrected;
    let is_alone = closure == Closure::HalfSpace && scene.closure.closures().len() == 1;
    // three yield stresses are what the metal supports before it hardens
    let hardens = material.hardness.is_none() && material.hardening_exponent.is_some_and(|n| n > 0.0);
    let most = if hardens { 2.0 * limit } else { limit };
    let named = if material.hardness.is_some() { "the hardness of this metal" } else { "3 yield_stress" };
    (is_alone && mean > most).then(|| {
        format!(
            "half-space: its mean pressure, {} MPa, is {} times {named} ({} MPa): there it yields, and touches on a larger area; \
             closure \"half-space-plastic\" limits the pressure",
            with_digits(mean / MEGAPASCAL, 3),
            with_digits(mean / limit, 2),
            with_digits(limit / MEGAPASCAL, 3)
        )
    })
}

/// A hardness that is not that of the yield stress. Where hardening is known the half-space tells, by the
/// atlas of cones at the slope of the patches.
fn two_materials(scene: &Scene) -> Option<String> {
    let plastic = scene.closure.closures().contains(&Closure::HalfSpacePlastic);
    if plastic && scene.material.hardening_exponent.is_some() {
        return None;
    }
    let ratio = scene.material.hardness?.0 / (3.0 * scene.material.yield_stress?.0);
    let text = format!("hardness is {ratio:.2} times 3 yield_stress (eq. 20 says 1): two different metals?");
    (!(0.8..=1.25).contains(&ratio)).then_some(text)
}

/// The largest step across the seam of a periodic map, over that between neighbours, that is taken without a
/// word.
const MAX_SEAM_STEP: f64 = 4.0;
/// Standard deviations from the mean beyond which the highest or lowest point looks like an error.
const SPIKE_DEVIATIONS: f64 = 8.0;

/// Mean slopes (degrees) beyond which a map looks like one in the wrong unit: lapped and polished surfaces
/// lie above the lower, ground and blasted ones below the upper.
const USUAL_SLOPES_DEG: [f64; 2] = [0.02, 45.0];

/// A surface or a load that looks like a slip.
fn surface_warnings(surface: &Surface, scene: &Scene) -> Vec<String> {
    let seam = surface.seam().filter(|ratio| *ratio > MAX_SEAM_STEP).map(|ratio| {
        format!(
            "surface.periodic: the steps across the seam are {ratio:.0} times those between neighbours: the map is no period of a \
             surface; leave periodic out, and it stands free"
        )
    });
    let parameters = &surface.parameters;
    let [above, below] = [surface.extent.high - parameters.mean, parameters.mean - surface.extent.low];
    let ends = [("highest", above), ("lowest", below)].map(|(end, off)| (end, off / parameters.sq));
    let spike = ends.iter().find(|(_, ratio)| *ratio > SPIKE_DEVIATIONS).map(|(end, ratio)| {
        let way_out = match scene.surface.outliers {
            None => "remove it (surface.outliers = 8, missing_value), or smooth with s_filter",
            Some(_) => {
                "surface.outliers left it, as its neighbours are nearly as far off: name it by missing_value, or smooth with s_filter"
            }
        };
        format!(
            "the {end} point is {ratio:.0} standard deviations from the mean: if it is dust, a missing point or an error of measurement, \
             first touch, gap and leak are its own; {way_out}"
        )
    });
    let [flat, steep] = USUAL_SLOPES_DEG;
    let unit = Some(parameters.beta_deg()).filter(|beta| *beta > 0.0 && !(flat..=steep).contains(beta)).map(|beta| {
        format!(
            "the mean slope is {} deg, that of machined surfaces {flat} to {steep} deg: look whether height_unit and pixel_size are right",
            with_digits(beta, 2)
        )
    });
    let apart = scene.load.separation.filter(|s| s.0 > above).map(|s| {
        format!(
            "load.separation = {s} is above the highest point ({:.4} um above the mean): nothing touches",
            above / MICROMETRE
        )
    });
    let of_pixels = short_waves(surface, scene);
    [seam, spike, unit, apart, of_pixels].into_iter().flatten().chain(tilt(surface, scene)).collect()
}

/// Pixels of a wave below which a map hardly shows it.
const FEWEST_PIXELS_OF_A_WAVE: f64 = 8.0;

/// A filter that leaves of a measured map only waves of few pixels.
fn short_waves(surface: &Surface, scene: &Scene) -> Option<String> {
    let longest = scene.surface.l_filter?;
    let [x, y] = surface.map.pixel();
    let pixels = longest.0 / x.max(y);
    (pixels < FEWEST_PIXELS_OF_A_WAVE).then(|| {
        format!(
            "surface.l_filter = {longest} is {} pixels: what it leaves changes from point to point, as noise does (Sq {} um); longer waves \
             need a longer l_filter, or none",
            with_digits(pixels, 2),
            with_digits(surface.parameters.sq / MICROMETRE, 3)
        )
    })
}

/// Share of Sq that the plane of a surface may be without a word.
const MAX_TILT_SHARE: f64 = 0.5;

/// A surface that is tilted far more than it is rough.
fn tilt(surface: &Surface, scene: &Scene) -> Option<String> {
    if scene.surface.level != Some(Levelling::None) || scene.surface.generate.is_some() {
        return None;
    }
    let level = Surface::from_map(level(surface.map.clone(), Levelling::Plane)).ok()?;
    let share = 1.0 - level.parameters.sq / surface.parameters.sq;
    (share > MAX_TILT_SHARE).then(|| {
        format!(
            "the mean plane of the map carries {:.1} % of Sq: it is tilted more than it is rough; surface.level = \"plane\" removes the tilt",
            100.0 * share
        )
    })
}

/// Relative error of a leak above which a warning says so.
const UNSURE_LEAK: f64 = 1.0;

/// Of a contact on a half-space.
pub(super) fn half_space_warnings(closure: Closure, one: &SpaceContact, scene: &Scene) -> Warnings {
    let leaks = one.passages.iter().filter_map(|p| p.leak);
    let unbalanced = leaks.filter(|l| l.imbalance > 1e-2).map(|l| {
        format!(
            "{}: the leak was not found to the end (in- and outflow differ by {:.1e})",
            closure.name(),
            l.imbalance
        )
    });
    let doubtful = (0..2)
        .filter_map(|k| Some((k, one.passages[k].leak?.error)))
        .filter(|(_, error)| *error > UNSURE_LEAK);
    let doubtful = doubtful.map(|(k, error)| {
        format!(
            "{}: the leak along {} is known only to within a factor of {}: the paths are few pixels wide, or missing points lie in them; measure \
             finer, or fill",
            closure.name(),
            ["x", "y"][k],
            with_digits(1.0 + error, 2)
        )
    });
    let doubtful: Vec<String> = doubtful.collect();
    let rival = one.limit.filter(|limit| limit.contradiction() > CONTRADICTION).and_then(|limit| {
        let [hardness, plateau] = [limit.pressure, limit.rival?].map(|p| p / MEGAPASCAL);
        Some(format!(
            "hardness {hardness:.0} MPa contradicts yield_stress and hardening_exponent: metal with those carries {plateau:.0} MPa under these \
             patches (atlas of cones). \"{}\" and closures of a hardness take the first, \"calibrated\" the second; leave out what \
             was not measured on this metal, or give hardness_error",
            closure.name()
        ))
    });
    let area = &one.contact.area;
    let coarse = (area.error > 0.1 * area.corrected).then(|| {
        format!(
            "{}: the contact is made of few pixels: its area is uncertain by {:.0} %; measure finer, or smooth with s_filter",
            closure.name(),
            100.0 * area.error / area.corrected
        )
    });
    let ends = (one.has_ends_only() && scene.half_space.load_points.is_none()).then(|| {
        format!(
            "{}: on so large a map the load curve has first touch and the load alone: for points between them give half_space.load_points \
             (--set half_space.load_points=6), each of which takes about as long as the load",
            closure.name()
        )
    });
    let yields = yields(closure, one, scene);
    unbalanced.chain(doubtful).chain(rival).chain(coarse).chain(ends).chain(yields).collect()
}

/// Share of the load below which nothing is said of it: no number moves by more.
const SEEN_LOAD_SHARE: f64 = 5e-3;

/// Of a contact of islands.
pub(super) fn island_warnings(
    closure: Closure,
    one: &IslandContact,
    coefficient: Option<&Coefficient>,
) -> Warnings {
    let name = closure.name();
    let mut warnings = Vec::new();
    if one.contact.jump {
        warnings.push(format!(
            "{name}: the load jumps where islands merge; no separation carries it, the nearer side is reported (load error {:.1e})",
            one.contact.load_error.unwrap_or(0.0)
        ));
    }
    if let Some(share) = one.contact.outside_share.filter(|s| *s > SEEN_LOAD_SHARE) {
        warnings.push(format!(
            "{name}: {:.1} % of the load is on asperities outside the ranges of the calibration and of the atlas of cones",
            100.0 * share
        ));
    }
    if one.unloading.is_some() && !one.law.returns_everything() && coefficient.is_none() {
        warnings.push(format!(
            "{name}: unloading exponent {} is that of the paper's single asperity, not of a calibration",
            SINGLE_ASPERITY_EXPONENT
        ));
    }
    if let Some(unloading) = &one.unloading
        && !one.law.returns_everything()
        && charts::unloading_lies_above(&one.contact.curve, &unloading.curve)
    {
        warnings.push(format!(
            "{name}: unloading carries more than loading at the same separation, which gains energy: load_curve.svg leaves it out"
        ));
    }
    if let Some(unloading) = &one.unloading
        && let Some(law) = unloading.elastic_share_by_law.filter(|share| *share > 1.0)
    {
        let limited =
            unloading.limited_share.filter(|s| *s > SEEN_LOAD_SHARE).map_or_else(String::new, |share| {
                format!(
                    " ({:.0} % of the load is on ones pressed by less than their cones would return)",
                    100.0 * share
                )
            });
        warnings.push(format!(
            "{name}: the unloading law, made for cones, returns {law:.2} times the work done on asperities that are long or \
             flat{limited}: elastic_energy_share is limited to 1, plastic work is not resolved"
        ));
    }
    warnings
}
