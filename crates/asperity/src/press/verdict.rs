//! The sentence at the end of a run: area, the closure to believe, gap, and whether and how much it leaks.

use super::closures::ClosureContact;
use super::half_space::SpaceContact;
use super::rough::Rough;
use crate::units::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::Closure;
use asperity_roughness::flow::Axis;
use asperity_roughness::scene::Fluid;
use std::fmt::Write;

/// A closure whose area is nearer than this to the half-space's may be believed.
const BELIEVED: f64 = 0.1;

impl Rough {
    /// The verdict of the half-space, in words; `None` where no half-space was pressed.
    pub fn verdict(&self) -> Option<String> {
        let best = self
            .contact(Closure::HalfSpacePlastic)
            .filter(|one| one.space().is_some())
            .or_else(|| self.contact(Closure::HalfSpace))?;
        let space = best.space()?;
        let area = &space.contact.area;
        let mut text = format!(
            "{}: true contact on {:.3} ± {:.3} % of the area",
            best.name(),
            100.0 * area.corrected,
            100.0 * area.error
        );
        if let (Some(limit), Some(slope)) = (space.body.limit, space.limit_slope_deg()) {
            let _ = write!(
                text,
                "; no point bears more than {:.0} MPa, the plateau of the atlas of cones at the {slope:.1}° of the patches",
                limit / MEGAPASCAL
            );
        }
        if let Some(belief) = belief(&self.contacts, area.ratio) {
            let _ = write!(text, "; {belief}");
        }
        let _ = write!(text, "; mean gap {} µm", short(space.contact.mean_gap / MICROMETRE));
        for (k, axis) in [Axis::X, Axis::Y].into_iter().enumerate() {
            let _ = write!(text, "; {}", passage(space, k, axis, self.summary.scene.fluid.as_ref()));
        }
        text.push('.');
        Some(text)
    }
}

/// Which closure has the area of the half-space, a share `area` of the surface.
fn belief(contacts: &[ClosureContact], area: f64) -> Option<String> {
    let islands = contacts.iter().filter(|one| one.islands().is_some());
    let judged: Vec<(&str, f64)> = islands
        .filter_map(|one| Some((one.name(), one.area_ratio()? / area)))
        .filter(|(_, ratio)| ratio.is_finite() && *ratio > 0.0)
        .collect();
    let nearest = judged.iter().min_by(|a, b| a.1.ln().abs().total_cmp(&b.1.ln().abs()))?;
    let off = 100.0 * (nearest.1 - 1.0);
    if (nearest.1 - 1.0).abs() <= BELIEVED {
        return Some(format!("of the closures believe {} here (its area is {off:+.0} % off)", nearest.0));
    }
    Some(format!(
        "believe none of the closures here (the nearest, {}, has an area {off:+.0} % off)",
        nearest.0
    ))
}

fn passage(space: &SpaceContact, k: usize, axis: Axis, fluid: Option<&Fluid>) -> String {
    let name = if axis == Axis::X { "x" } else { "y" };
    let Some(narrowest) = space.passages[k].narrowest else {
        return format!("no open path crosses along {name}: tight there, as far as the pixels see");
    };
    let mut text = format!(
        "an open path crosses along {name}, {} µm at its narrowest",
        short(narrowest.gap / MICROMETRE)
    );
    if let Some(leak) = space.passages[k].leak {
        let _ = write!(
            text,
            ", and leaks {:.2e} m³ × pressure difference / viscosity, as parallel planes {} µm apart",
            leak.conductance,
            short(leak.hydraulic_gap / MICROMETRE)
        );
        if let Some(fluid) = fluid {
            let difference = fluid.pressures[0].0 - fluid.pressures[1].0;
            let flux = leak.conductance * difference / fluid.viscosity.pascal_seconds;
            let _ = write!(text, ": {flux:.2e} m³/s of this fluid");
        }
    }
    text
}

/// Three digits.
fn short(value: f64) -> String {
    let digits = if value > 0.0 { (2.0 - value.log10().floor()).clamp(0.0, 9.0) as usize } else { 0 };
    format!("{value:.digits$}")
}
