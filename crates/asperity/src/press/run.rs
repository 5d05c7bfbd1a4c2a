//! The contact by every closure that a scene asks for.

use asperity_roughness::scene::{Choice, Prepared, Scene};
use asperity_roughness::{
    Closure, Coefficient, Contact, ContactError, KindName, Load, Model, PressureField, Regime, Unloading,
    press, unload,
};

/// What one closure says of the surface at the load.
pub struct Pressed {
    /// The closure with its metal.
    pub model: Model,
    /// The contact.
    pub contact: Contact,
    /// Pressure on the pixels.
    pub field: PressureField,
    /// What taking the load off gives back, where that was asked for.
    pub unloading: Option<Unloading>,
    /// p(β)/H of the closure's elastic pressure at the mean slope.
    pub plasticity_index: Option<f64>,
    /// Nominal pressure: that asked for, or that carried at the separation asked for, in Pa.
    pub nominal: f64,
}

impl Pressed {
    /// Regime of island `j` as a number: 1 elastic, 2 elastoplastic, 3 plastic.
    pub fn regime(&self, j: usize) -> u8 {
        match self.contact.responses[j].regime {
            Regime::Elastic => 1,
            Regime::Elastoplastic => 2,
            Regime::Plastic => 3,
        }
    }

    /// Largest pixel pressure over nominal pressure.
    pub fn peak_ratio(&self) -> Option<f64> {
        (self.nominal > 0.0).then(|| self.field.largest / self.nominal)
    }
}

/// An error of the scene: the key it belongs to, and the message.
pub type Wrong = (&'static str, String);

/// Presses the plane by every closure of the scene; what `all` had to skip is among the warnings.
pub fn press_all(
    scene: &Scene,
    prepared: &Prepared,
    coefficient: Option<&Coefficient>,
) -> Result<(Vec<Pressed>, Vec<String>), Wrong> {
    let metal = scene.material.metal();
    let load = scene.load.load().map_err(|e| ("load", e.message))?;
    let (mut pressed, mut warnings) = (Vec::new(), Vec::new());
    for closure in scene.closure.closures() {
        let model = match Model::new(closure, &metal, coefficient) {
            Ok(model) => model,
            Err(e) if scene.closure == Choice::All => {
                warnings.push(format!("skipped: {e}"));
                continue;
            }
            Err(e) => return Err(("closure", e.to_string())),
        };
        match press_one(scene, prepared, model, load, coefficient) {
            Ok(one) => {
                warnings.extend(remarks(&one, coefficient));
                pressed.push(one);
            }
            Err(e @ ContactError::Unreachable { .. })
                if scene.closure == Choice::All && closure != Closure::Published =>
            {
                warnings.push(format!("skipped: {e}"));
            }
            Err(e) => return Err(("load.pressure", e.to_string())),
        }
    }
    if pressed.is_empty() {
        return Err((
            "closure",
            "no closure can be used with this material: add hardness or yield_stress".into(),
        ));
    }
    if let (Some(hardness), Some(yield_stress)) = (scene.material.hardness, scene.material.yield_stress) {
        let ratio = hardness.0 / (3.0 * yield_stress.0);
        if !(0.8..=1.25).contains(&ratio) {
            warnings.push(format!(
                "hardness is {ratio:.2} times 3 yield_stress (eq. 20 says 1): two different metals?"
            ));
        }
    }
    Ok((pressed, warnings))
}

fn press_one(
    scene: &Scene,
    prepared: &Prepared,
    model: Model,
    load: Load,
    coefficient: Option<&Coefficient>,
) -> Result<Pressed, ContactError> {
    let contact = press(&prepared.surface(), &model, load)?;
    let field = PressureField::of(&prepared.map, &contact, scene.pressure_profile);
    let exponent = model.unloading_exponent(coefficient);
    let unloading = scene.load.unload.then(|| unload(&contact, &model, exponent));
    let elastic = model.elastic_pressure(prepared.roughness.mean_gradient);
    let nominal = match load {
        Load::Pressure(p) => p,
        Load::Separation(_) => contact.pressure,
    };
    Ok(Pressed {
        plasticity_index: model.hardness().map(|h| elastic / h),
        model,
        contact,
        field,
        unloading,
        nominal,
    })
}

/// What a reader of the numbers should know.
fn remarks(one: &Pressed, coefficient: Option<&Coefficient>) -> Vec<String> {
    let name = one.model.closure.name();
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
    if one.unloading.is_some() && !one.model.returns_everything() && coefficient.is_none() {
        remarks.push(format!(
            "{name}: unloading exponent {} is that of the paper's single asperity, not of a calibration",
            asperity_roughness::SINGLE_ASPERITY_EXPONENT
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

/// The name of a generated kind.
pub fn kind_name(kind: KindName) -> &'static str {
    match kind {
        KindName::Ground => "ground",
        KindName::Milled => "milled",
        KindName::Sanded => "sanded",
        KindName::SelfAffine => "self-affine",
    }
}
