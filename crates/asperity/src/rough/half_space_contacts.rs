//! The half-spaces of a scene: each contact found once, and what closures give beside them.

use super::closure_contact::{ClosureContact, Judged};
use super::half_space;
use crate::error::InputError;
use crate::rough::rough_scene::RoughScene;
use asperity_roughness::half_space::{HalfSpace, HalfSpaceContact, HalfSpaceError, PressureLimit};
use asperity_roughness::{Closure, Load, Surface};

/// Contacts on half-spaces that were found, for those that are asked for again, and the limit of pressure of
/// the metal on this surface.
#[derive(Default)]
pub(super) struct HalfSpaceContacts {
    limit: Option<Option<PressureLimit>>,
    found: Vec<(HalfSpace, Result<HalfSpaceContact, HalfSpaceError>)>,
}

impl HalfSpaceContacts {
    /// The largest pressure that the metal carries under the patches of `surface` at `load`; None where
    /// nothing of its strength is known.
    ///
    /// # Errors
    /// A calibration that cannot be read, of metal whose law of hardening is that of the calibration.
    pub fn limit(
        &mut self,
        scene: &RoughScene,
        surface: &Surface,
        load: Load,
    ) -> Result<Option<PressureLimit>, InputError> {
        if let Some(known) = self.limit {
            return Ok(known);
        }
        let limit =
            PressureLimit::on_surface(&scene.tables().material, scene.hardening_law()?, surface, load);
        self.limit = Some(limit);
        Ok(limit)
    }

    /// The contact of `surface` at `load`, found once, with its stiffness where `stiffness`. Ask with the
    /// stiffness first: what was found without it stays without.
    ///
    /// # Errors
    /// The reason why the half-space has none.
    pub fn contact(
        &mut self,
        body: &HalfSpace,
        surface: &Surface,
        load: Load,
        stiffness: bool,
    ) -> Result<HalfSpaceContact, HalfSpaceError> {
        if let Some((_, found)) = self.found.iter().find(|(known, _)| known == body) {
            return found.clone();
        }
        let found = match stiffness {
            true => body.press(surface, load),
            false => body.press_without_stiffness(surface, load, None),
        };
        self.found.push((*body, found.clone()));
        found
    }
}

/// Area and mean pressure of each closure beside those of the half-space with the same metal: elastic for
/// "sneddon", with its limit of pressure for the others.
pub(super) fn compare_with_half_space(
    contacts: &mut [ClosureContact],
    scene: &RoughScene,
    surface: &Surface,
    spaces: &mut HalfSpaceContacts,
) {
    let tables = scene.tables();
    let Ok(load) = tables.load.load() else { return };
    for one in contacts.iter_mut() {
        let by = one.half_space_of_its_metal();
        let elastic = by == Closure::HalfSpace;
        let limit = if elastic { None } else { spaces.limit(scene, surface, load).ok().flatten() };
        let known = elastic || limit.is_some();
        let body = half_space::body(tables, limit.map(|l| l.pressure));
        let found = known.then(|| spaces.contact(&body, surface, load, false));
        if let (Some(Ok(found)), Some(area)) = (&found, one.corrected_ratio())
            && let known = found.area
            && known.corrected > 0.0
            && area > 0.0
        {
            let loads = if one.nominal > 0.0 { one.nominal / found.pressure } else { 1.0 };
            let ratio = area / known.corrected;
            // the limit is the closure's too, but where hardness and yield stress are two metals
            let two_metals = limit.map_or(0.0, |l| l.contradiction());
            let area_error = half_space::area_error(found, two_metals) / known.corrected;
            one.judged = Some(Judged { by, area: ratio, pressure: loads / ratio, area_error });
        }
    }
}
