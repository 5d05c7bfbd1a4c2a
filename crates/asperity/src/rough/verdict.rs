//! The findings at the end of a run, one a line: area, the closure to believe, gap, how much it leaks.

use super::half_space::{CONTRADICTION, SpaceContact, area_error};
use crate::results::numbers::{rounded, significant, with_digits, with_error};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::closure_contact::ClosureContact;
use crate::rough::contact::Rough;
use asperity_roughness::Closure;
use asperity_roughness::scene::Fluid;
use std::fmt::Write;

/// A closure whose area is nearer than this to the half-space's may be believed.
const BELIEVED_AREA_ERROR: f64 = 0.1;
/// Relative error of the half-space's area above which it is no measure of closures: half of what they may be
/// off.
const KNOWN_AREA_ERROR: f64 = 0.05;
/// Share of a closure's load outside its range above which an area that fits is chance.
const MAX_LOAD_OUTSIDE: f64 = 0.2;

impl Rough {
    /// The findings of the half-space, and the load that a closure could carry where none carries that asked.
    pub fn verdict(&self) -> Option<String> {
        let said: Vec<_> = [self.of_half_space(), overload(&self.contacts)].into_iter().flatten().collect();
        (!said.is_empty()).then(|| said.join("\n"))
    }

    fn of_half_space(&self) -> Option<String> {
        let best = self
            .contact(Closure::HalfSpacePlastic)
            .filter(|one| one.space().is_some())
            .or_else(|| self.contact(Closure::HalfSpace))?;
        let space = best.space()?;
        let area = &space.contact.area;
        let share = with_error(100.0 * area.corrected, 100.0 * space.area_error());
        let mut found = vec![format!("{}: true contact on {share} % of the area", best.name())];
        if space.saturated() {
            found.push("saturated: that is load over limit of pressure, whatever the roughness".into());
        }
        found.extend(limit_in_words(space));
        found.extend(belief(&self.contacts, best));
        found.push(format!("mean gap {} µm", with_digits(space.contact.mean_gap / MICROMETRE, 3)));
        for (k, name) in ["x", "y"].into_iter().enumerate() {
            found.push(passage(space, k, name, self.summary.scene.fluid.as_ref()));
        }
        if !space.flows && space.passages.iter().any(|p| p.narrowest.is_some()) {
            let why = match self.summary.scene.half_space.leak {
                Some(_) => ": the scene has half_space.leak = false",
                None => " beside other closures: --set half_space.leak=true, or a [fluid] table",
            };
            found.push(format!("how much leaks is not computed{why}"));
        }
        Some(found.join("\n  - "))
    }
}

/// The limit of pressure of `space`, where its source says more than the scene does.
fn limit_in_words(space: &SpaceContact) -> Option<String> {
    let limit = space.limit?;
    let [pressure, error] = [limit.pressure, limit.error * limit.pressure].map(|p| p / MEGAPASCAL);
    match (space.limit_slope_deg(), limit.rival) {
        (Some(slope), _) => Some(format!(
            "no point carries more than {} MPa, the plateau of the atlas of cones at the {slope:.1}° of the patches",
            with_error(pressure, error)
        )),
        (None, Some(rival)) if limit.contradiction() > CONTRADICTION => Some(format!(
            "no point carries more than the hardness, {pressure:.0} MPa, where yield stress and hardening say {:.0} MPa: two metals",
            rival / MEGAPASCAL
        )),
        _ => None,
    }
}

/// The load that could be carried, where no closure of islands carries that asked for.
fn overload(contacts: &[ClosureContact]) -> Option<String> {
    let islands = || contacts.iter().filter(|one| !one.closure.is_half_space());
    if islands().any(|one| one.islands().is_some()) {
        return None;
    }
    let loads = islands().filter_map(|one| Some((one.name(), one.largest_load?)));
    let (name, largest) = loads.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(format!(
        "No closure of islands carries the load; the most that one carries is {} MPa ({name}): try --set load.pressure=\"{} MPa\".",
        significant(largest / MEGAPASCAL),
        rounded(0.5 * largest / MEGAPASCAL)
    ))
}

/// The closure that has the area of the half-space `best`, or the reason why that cannot be told: of those
/// that make their contact of the same metal.
fn belief(contacts: &[ClosureContact], best: &ClosureContact) -> Option<String> {
    let space = best.space()?;
    let area = &space.contact.area;
    let two_metals = space.limit.map_or(0.0, |limit| limit.contradiction());
    let error = area_error(&space.contact, two_metals) / area.corrected;
    let same_metal = contacts.iter().filter(|one| one.half_space_of_its_metal() == best.closure);
    let islands = same_metal.filter_map(|one| Some((one.name(), one.islands()?)));
    let judged = islands.map(|(name, one)| ComparedClosure {
        name,
        ratio: one.contact.area_ratio / area.corrected,
        outside: one.contact.outside_share.unwrap_or(0.0),
    });
    let judged: Vec<_> = judged.filter(|one| one.ratio.is_finite() && one.ratio > 0.0).collect();
    judgement(&judged, best.name(), error, two_metals > KNOWN_AREA_ERROR)
}

/// A closure beside the half-space.
#[derive(Clone, Copy, Debug)]
struct ComparedClosure {
    name: &'static str,
    /// Its area over the corrected one of the half-space.
    ratio: f64,
    /// Share of its load on islands outside the range that it was made for.
    outside: f64,
}

/// The sentence on the closure whose area is nearest, where that of the half-space `by` is known up to the
/// share `error`, because of its pixels or because hardness and yield stress are those of `two_metals`.
fn judgement(judged: &[ComparedClosure], by: &str, error: f64, two_metals: bool) -> Option<String> {
    let nearest = judged.iter().min_by(|a, b| a.ratio.ln().abs().total_cmp(&b.ratio.ln().abs()))?;
    let ComparedClosure { name, ratio, outside } = *nearest;
    let off = 100.0 * (ratio - 1.0);
    if error > KNOWN_AREA_ERROR {
        let (why, way_out) = if two_metals {
            ("pixels and two metals", "give the hardness or the yield stress of the metal, not both")
        } else {
            ("pixels alone", "measure finer, or smooth with s_filter")
        };
        return Some(format!(
            "which closure to believe cannot be judged here: {why} leave that area uncertain by {} %, more than {:.0} % ({way_out}; the nearest, {name}, has an area {off:+.0} % off that of {by})",
            rounded(100.0 * error),
            100.0 * KNOWN_AREA_ERROR
        ));
    }
    if (ratio - 1.0).abs() > BELIEVED_AREA_ERROR {
        return Some(format!(
            "believe none of the closures here (the nearest, {name}, has an area {off:+.0} % off that of {by})"
        ));
    }
    if outside > MAX_LOAD_OUTSIDE {
        return Some(format!(
            "which closure to believe cannot be judged here: the nearest, {name}, has an area {off:+.0} % off that of {by}, but {:.0} % of its load is on \
             asperities outside the range that it was made for",
            100.0 * outside
        ));
    }
    Some(format!("of the closures believe {name} here (its area is {off:+.0} % off that of {by})"))
}

fn passage(space: &SpaceContact, k: usize, name: &str, fluid: Option<&Fluid>) -> String {
    if let Some(unknown) = space.passages[k].unknown {
        let filled = match unknown.filled {
            Some(place) => format!(
                "an open path crosses, {} µm at its narrowest",
                with_digits(place.gap / MICROMETRE, 3)
            ),
            None => "no path crosses either".into(),
        };
        return format!(
            "whether a path crosses along {name} is not known: {} points without a height close the way; with missing = \"fill\" {filled}",
            unknown.missing
        );
    }
    let Some(narrowest) = space.passages[k].narrowest else {
        return format!("no open path crosses along {name}: tight there, as far as the pixels see");
    };
    let mut text = format!(
        "an open path crosses along {name}, {} µm at its narrowest",
        with_digits(narrowest.gap / MICROMETRE, 3)
    );
    if let Some(leak) = space.passages[k].leak {
        let _ = write!(
            text,
            ", and leaks {:.2e} m³ × pressure difference / viscosity {}, as parallel planes {} µm apart",
            leak.conductance,
            known_to(leak.error),
            with_digits(leak.hydraulic_gap / MICROMETRE, 3)
        );
        if let Some(fluid) = fluid {
            let unit = if fluid.gas { "Pa m³/s of this gas" } else { "m³/s of this fluid" };
            let _ = write!(text, ": {:.2e} {unit} through this map", fluid.flow(leak.conductance));
        }
    }
    text
}

/// Words on a leak whose true value lies within the factor 1 + `error`.
fn known_to(error: f64) -> String {
    const SMALL: f64 = 0.5;
    const ORDER: f64 = 10.0;
    let factor = with_digits(1.0 + error, 2);
    if error <= SMALL {
        format!("(± {} %)", with_digits(100.0 * error, 2))
    } else if 1.0 + error <= ORDER {
        format!("(within an order of magnitude: a factor of {factor} either way)")
    } else if error.is_finite() {
        format!("(its order of magnitude is not known: a factor of {factor} either way; nearly closed)")
    } else {
        "(nothing bounds its error)".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closure_is_believed_only_where_area_and_range_allow() {
        let one = |name, ratio, outside| ComparedClosure { name, ratio, outside };
        let said = |ratio, outside, error| {
            judgement(&[one("far", 2.0, 0.0), one("near", ratio, outside)], "half-space", error, false)
                .unwrap()
        };
        assert!(said(0.95, 0.0, 0.02).starts_with("of the closures believe near"));
        assert!(said(0.95, 0.0, 0.02).contains("off that of half-space"));
        assert!(said(0.8, 0.0, 0.02).starts_with("believe none"));
        assert!(said(0.95, 0.0, 0.22).contains("pixels alone leave that area uncertain by 22 %"));
        assert!(said(0.95, 0.6, 0.02).contains("60 % of its load"));
        assert_eq!(known_to(0.123), "(± 12 %)");
        assert!(
            known_to(3.0).contains("within an order of magnitude") && known_to(33.0).contains("factor of 34")
        );
        assert_eq!(judgement(&[], "half-space", 0.0, false), None);
    }
}
