//! The contact of one surface by one closure, with its warnings.

use super::scene::RoughScene;
use crate::error::InputError;
use asperity_roughness::scene::{Choice, SceneError};
use asperity_roughness::{
    Closure, ClosureLaw, Coefficient, Contact, ContactError, Load, PressureField, SINGLE_ASPERITY_EXPONENT,
    Surface, Unloading, press, unload,
};

/// The contact of a surface by one closure at the load.
#[derive(Debug)]
pub struct ClosureContact {
    /// The closure with its material.
    pub law: ClosureLaw,
    /// The contact.
    pub contact: Contact,
    /// Pressure on the pixels.
    pub field: PressureField,
    /// Elastic return, where unloading was asked for.
    pub unloading: Option<Unloading>,
    /// p(β)/H of the closure's elastic pressure at the mean slope.
    pub plasticity_index: Option<f64>,
    /// Nominal pressure: that asked for, or that carried at the separation asked for, in Pa.
    pub nominal: f64,
}

impl ClosureContact {
    /// Name of the closure.
    pub fn name(&self) -> &'static str {
        self.law.closure.name()
    }

    /// Largest pixel pressure over nominal pressure.
    pub fn peak_ratio(&self) -> Option<f64> {
        (self.nominal > 0.0).then(|| self.field.largest / self.nominal)
    }
}

/// Remarks on the trust in the numbers.
pub type Warnings = Vec<String>;

/// The contact by `closure` with its warnings; of a scene with all closures, one that cannot be used is a warning alone.
pub(super) fn press_by(
    closure: Closure,
    scene: &RoughScene,
    surface: &Surface,
    coefficient: Option<&Coefficient>,
) -> Result<(Option<ClosureContact>, Warnings), InputError> {
    let all = scene.tables().closure == Choice::All;
    let wrong = |key: &str, message: String| scene.error(&SceneError::new(key, message));
    let load = scene.tables().load.load().map_err(|e| scene.error(&e))?;
    let law = match ClosureLaw::new(closure, &scene.tables().material, coefficient) {
        Ok(law) => law,
        Err(e) if all => return Ok((None, vec![format!("skipped: {e}")])),
        Err(e) => return Err(wrong("closure", e.to_string())),
    };
    match press_one(scene, surface, law, load, coefficient) {
        Ok(one) => {
            let warnings = remarks(&one, coefficient);
            Ok((Some(one), warnings))
        }
        Err(e @ ContactError::Unreachable { .. }) if all && closure != Closure::Published => {
            Ok((None, vec![format!("skipped: {e}")]))
        }
        Err(e) => Err(wrong("load.pressure", e.to_string())),
    }
}

fn press_one(
    scene: &RoughScene,
    surface: &Surface,
    law: ClosureLaw,
    load: Load,
    coefficient: Option<&Coefficient>,
) -> Result<ClosureContact, ContactError> {
    let contact = press(surface, &law, load)?;
    let scene = scene.tables();
    let field = PressureField::of(&surface.map, &contact, scene.pressure_profile);
    let exponent = coefficient.map_or(SINGLE_ASPERITY_EXPONENT, |c| c.unloading_exponent);
    let unloading = scene.load.unload.then(|| unload(&contact, &law, exponent));
    let elastic = law.elastic_pressure(surface.parameters.mean_gradient);
    let nominal = match load {
        Load::Pressure(p) => p,
        Load::Separation(_) => contact.pressure,
    };
    Ok(ClosureContact {
        plasticity_index: law.hardness.map(|h| elastic / h),
        law,
        contact,
        field,
        unloading,
        nominal,
    })
}

fn remarks(one: &ClosureContact, coefficient: Option<&Coefficient>) -> Warnings {
    let name = one.name();
    let mut remarks = Vec::new();
    if one.contact.jump {
        remarks.push(format!(
            "{name}: the load jumps where islands merge; no separation carries it, the nearer side is reported (load error {:.1e})",
            one.contact.load_error.unwrap_or(0.0)
        ));
    }
    if let Some(share) = one.contact.outside_share.filter(|s| *s > 0.0) {
        remarks.push(format!(
            "{name}: {:.1} % of the load is on asperities outside the calibrated range",
            100.0 * share
        ));
    }
    if one.unloading.is_some() && !one.law.returns_everything() && coefficient.is_none() {
        remarks.push(format!(
            "{name}: unloading exponent {} is that of the paper's single asperity, not of a calibration",
            SINGLE_ASPERITY_EXPONENT
        ));
    }
    if let Some(unloading) = &one.unloading
        && let Some(law) = unloading.elastic_share_by_law.filter(|share| *share > 1.0)
    {
        remarks.push(format!(
            "{name}: the unloading law, made for cones, returns {law:.2} times the work done on asperities that are long or flat ({:.0} % of \
             the load is on ones pressed by less than their cones would return): elastic_energy_share is limited to 1, plastic work is not resolved",
            100.0 * unloading.limited_share.unwrap_or(0.0)
        ));
    }
    remarks
}
