//! Warnings: remarks on the trust in the numbers of a rough contact.

use super::closure_contact::IslandContact;
use super::half_space::SpaceContact;
use crate::results::units::MICROMETRE;
use asperity_roughness::scene::{Missing, Scene};
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
pub(super) fn scene_warnings(surface: &Surface, scene: &Scene) -> Warnings {
    let first = unused_fluid(scene).into_iter().chain(two_materials(scene));
    first.chain(surface_warnings(surface, scene)).collect()
}

/// A fluid that no closure lets flow.
fn unused_fluid(scene: &Scene) -> Option<String> {
    let flows = scene.closure.closures().iter().any(|closure| closure.is_half_space());
    let text = "[fluid] is not used: closures of islands leave no gap that can leak; add closure \"half-space\" or \"half-space-plastic\"";
    (scene.fluid.is_some() && !flows).then(|| text.into())
}

/// A hardness that is not that of the yield stress.
fn two_materials(scene: &Scene) -> Option<String> {
    let ratio = scene.material.hardness?.0 / (3.0 * scene.material.yield_stress?.0);
    let text = format!("hardness is {ratio:.2} times 3 yield_stress (eq. 20 says 1): two different metals?");
    (!(0.8..=1.25).contains(&ratio)).then_some(text)
}

/// The largest step across the seam of a periodic map, over that between neighbours, that is taken without a
/// word.
const MAX_SEAM_STEP: f64 = 4.0;
/// Standard deviations above the mean beyond which the highest point looks like an error of measurement.
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
    let above = surface.extent.high - parameters.mean;
    let spike = Some(above / parameters.sq).filter(|ratio| *ratio > SPIKE_DEVIATIONS).map(|ratio| {
        format!(
            "the highest point is {ratio:.0} standard deviations above the mean: if it is dust or an error of measurement, the first \
             touch and all at light loads are its own; remove it (surface.outliers = 8), or smooth with s_filter"
        )
    });
    let [flat, steep] = USUAL_SLOPES_DEG;
    let unit = Some(parameters.beta_deg()).filter(|beta| *beta > 0.0 && !(flat..=steep).contains(beta)).map(|beta| {
        format!(
            "the mean slope is {beta:.3} deg; machined surfaces have {flat} to {steep}: look whether height_unit and pixel_size are right"
        )
    });
    let apart = scene.load.separation.filter(|s| s.0 > above).map(|s| {
        format!(
            "load.separation = {s} is above the highest point ({:.4} um above the mean): nothing touches",
            above / MICROMETRE
        )
    });
    let first = [seam, spike, unit, apart].into_iter().flatten();
    first.chain(missing_points(surface, scene)).chain(tilt(surface, scene)).collect()
}

/// Share of the points that may be missing without a word.
const MAX_MISSING_SHARE: f64 = 0.02;
/// Share of Sq that the plane of a surface may be without a word.
const MAX_TILT_SHARE: f64 = 0.9;

/// Points without a height that are left out.
fn missing_points(surface: &Surface, scene: &Scene) -> Option<String> {
    let (missing, all) = (surface.missing, surface.map.heights().len());
    let share = missing as f64 / all as f64;
    (share > MAX_MISSING_SHARE && scene.surface.missing == Missing::Exclude).then(|| {
        format!(
            "{missing} of {all} points ({:.1} %) have no height: they bear nothing and let no fluid through; measure them, or close \
             the holes smoothly by surface.missing = \"fill\"",
            100.0 * share
        )
    })
}

/// A surface that is tilted far more than it is rough.
fn tilt(surface: &Surface, scene: &Scene) -> Option<String> {
    if scene.surface.level != Some(Levelling::None) || scene.surface.generate.is_some() {
        return None;
    }
    let level = Surface::from_map(level(surface.map.clone(), Levelling::Plane)).ok()?;
    let share = 1.0 - level.parameters.sq / surface.parameters.sq;
    (share > MAX_TILT_SHARE).then(|| {
        format!(
            "the mean plane of the map carries {:.1} % of Sq: it is tilted, not rough; surface.level = \"plane\" takes the tilt out",
            100.0 * share
        )
    })
}

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
    let area = &one.contact.area;
    let coarse = (area.error > 0.1 * area.ratio).then(|| {
        format!(
            "{}: the contact is made of few pixels: its area is uncertain by {:.0} %; measure finer, or smooth with s_filter",
            closure.name(),
            100.0 * area.error / area.ratio
        )
    });
    let ends = (one.has_ends_only() && scene.half_space.load_points.is_none()).then(|| {
        format!(
            "{}: on so large a map the load curve has first touch and the load alone: for points between them give half_space.load_points \
             (--set half_space.load_points=6), each of which takes about as long as the load",
            closure.name()
        )
    });
    unbalanced.chain(coarse).chain(ends).collect()
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
