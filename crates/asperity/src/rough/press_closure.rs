//! Presses one surface by one closure, and says what the scene makes of a closure that has no contact.

use super::closure_contact::{Body, ClosureContact, IslandContact};
use super::half_space::{self, SpaceContact};
use super::half_space_contacts::HalfSpaceContacts;
use super::warnings::{self, Warnings};
use crate::error::InputError;
use crate::results::units::MEGAPASCAL;
use crate::rough::rough_scene::RoughScene;
use asperity_roughness::half_space::HalfSpaceError;
use asperity_roughness::scene::SceneError;
use asperity_roughness::{
    Closure, ClosureLaw, Coefficient, Contact, ContactError, Load, PressureField, SINGLE_ASPERITY_EXPONENT,
    Surface, press, unload,
};

/// The surface that every closure of a scene presses, and its load.
struct Task<'a> {
    scene: &'a RoughScene,
    surface: &'a Surface,
    coefficient: Option<&'a Coefficient>,
    load: Load,
}

/// A contact that a closure found.
struct Pressed {
    body: Body,
    /// Elastic pressure of the closure at the mean slope, in Pa.
    elastic: f64,
    /// Nominal pressure that it carries, in Pa.
    carried: f64,
    warnings: Warnings,
}

/// The reason why a closure has no contact.
enum PressError {
    /// The scene makes no sense, whatever its other closures do.
    Input(InputError),
    /// The scene lacks the material that the closure needs.
    Material(String),
    /// The closure does not carry the load.
    Load {
        /// The key of the scene that asks for it.
        key: &'static str,
        message: String,
        /// Elastic pressure of the closure at the mean slope, in Pa.
        elastic: f64,
        /// The largest nominal pressure that it carries, in Pa, where that is known.
        largest: Option<f64>,
    },
}

/// The contact by `closure` with its warnings; of a scene with several closures, one that lacks its material
/// is a warning alone and one that cannot carry the load says so in its row.
pub(super) fn press_by(
    closure: Closure,
    scene: &RoughScene,
    surface: &Surface,
    coefficient: Option<&Coefficient>,
    spaces: &mut HalfSpaceContacts,
) -> Result<(Option<ClosureContact>, Warnings), InputError> {
    let load = scene.tables().load.load().map_err(|e| scene.error(&e))?;
    let task = Task { scene, surface, coefficient, load };
    let pressed = if closure.is_half_space() {
        task.press_half_space(closure, spaces)
    } else {
        task.press_islands(closure)
    };
    task.contact_or_warning(closure, pressed)
}

impl Task<'_> {
    /// The pressure that is asked for, in Pa; 0 of a separation.
    fn asked(&self) -> f64 {
        match self.load {
            Load::Pressure(p) => p,
            Load::Separation(_) => 0.0,
        }
    }

    fn error(&self, key: &str, message: String) -> InputError {
        self.scene.error(&SceneError::new(key, message))
    }

    /// Outcome of a closure in its scene: its row, a row without numbers, a warning alone, or the end.
    fn contact_or_warning(
        &self,
        closure: Closure,
        pressed: Result<Pressed, PressError>,
    ) -> Result<(Option<ClosureContact>, Warnings), InputError> {
        let tables = self.scene.tables();
        let several = tables.closure.is_several();
        let hardness = tables.material.limit();
        let row = |body: Body, elastic: f64, nominal: f64, largest_load: Option<f64>| ClosureContact {
            closure,
            body,
            plasticity_index: hardness.map(|h| elastic / h),
            nominal,
            judged: None,
            largest_load,
        };
        match pressed {
            Ok(Pressed { body, elastic, carried, warnings }) => {
                let nominal = if self.asked() > 0.0 { self.asked() } else { carried };
                Ok((Some(row(body, elastic, nominal, None)), warnings))
            }
            Err(PressError::Input(e)) => Err(e),
            Err(PressError::Material(message)) if several => Ok((None, vec![warnings::skipped(&message)])),
            Err(PressError::Material(message)) => Err(self.error("closure", message)),
            Err(PressError::Load { message, elastic, largest, .. }) if several => {
                let warning = format!("{}: {message}", closure.name());
                let failed = row(Body::Failed(message), elastic, self.asked(), largest);
                Ok((Some(failed), vec![warning]))
            }
            Err(PressError::Load { key, message, .. }) => Err(self.error(key, message)),
        }
    }

    /// The whole surface on a half-space, elastic or with the limit of pressure of its metal.
    fn press_half_space(
        &self,
        closure: Closure,
        spaces: &mut HalfSpaceContacts,
    ) -> Result<Pressed, PressError> {
        let (tables, surface) = (self.scene.tables(), self.surface);
        let limit = match closure {
            Closure::HalfSpace => None,
            _ => spaces.limit(self.scene, surface, self.load).map_err(PressError::Input)?,
        };
        if limit.is_none() && closure != Closure::HalfSpace {
            return Err(PressError::Material(format!(
                "closure \"{}\" needs hardness or yield_stress in [material]: add it, or choose \"half-space\"",
                closure.name()
            )));
        }
        // on the contact an elastic cone of the mean slope has half of E* tan β
        let sneddon = 0.5 * tables.material.elastic().reduced_modulus() * surface.parameters.mean_gradient;
        let body = half_space::body(tables, limit.map(|l| l.pressure));
        let one = spaces
            .contact(&body, surface, self.load, tables.half_space.stiffness.unwrap_or(true))
            .and_then(|found| SpaceContact::evaluate(body, limit, surface, tables, found))
            .map_err(|e| PressError::of_half_space(&e, sneddon))?;
        let warnings = warnings::half_space_warnings(closure, &one, tables);
        let carried = one.contact.pressure;
        Ok(Pressed { body: Body::HalfSpace(Box::new(one)), elastic: sneddon, carried, warnings })
    }

    /// Islands, each by the closure.
    fn press_islands(&self, closure: Closure) -> Result<Pressed, PressError> {
        let tables = self.scene.tables();
        let own = tables.custom.as_ref().filter(|_| closure == Closure::Custom);
        let law = match own {
            Some(own) => ClosureLaw::own(own, &tables.material),
            None => ClosureLaw::new(closure, &tables.material, self.coefficient)
                .map_err(|e| PressError::Material(e.to_string()))?,
        };
        let elastic = law.elastic_pressure(self.surface.parameters.mean_gradient);
        let contact = press(self.surface, &law, self.load).map_err(|e| match e {
            ContactError::Unreachable { largest_mpa, .. } => PressError::Load {
                key: "load.pressure",
                message: e.to_string(),
                elastic,
                largest: Some(largest_mpa * MEGAPASCAL),
            },
            ContactError::Flat { .. } => PressError::Input(self.error("load.pressure", e.to_string())),
        })?;
        let one = self.island_contact(law, contact);
        let warnings = warnings::island_warnings(closure, &one, self.coefficient);
        let carried = one.contact.pressure;
        Ok(Pressed { body: Body::Islands(Box::new(one)), elastic, carried, warnings })
    }

    fn island_contact(&self, law: ClosureLaw, contact: Contact) -> IslandContact {
        let tables = self.scene.tables();
        let field = PressureField::distribute(&self.surface.map, &contact, tables.pressure_profile);
        let exponent = self.coefficient.map_or(SINGLE_ASPERITY_EXPONENT, |c| c.unloading_exponent);
        let unloading = tables.load.unload.then(|| unload(&contact, &law, exponent));
        IslandContact { law, contact, field, unloading }
    }
}

impl PressError {
    fn of_half_space(error: &HalfSpaceError, elastic: f64) -> PressError {
        let key = match error {
            HalfSpaceError::Closed { .. } => "load.separation",
            _ => "load.pressure",
        };
        let largest = match error {
            HalfSpaceError::Limit { limit_mpa, .. } => Some(limit_mpa * MEGAPASCAL),
            _ => None,
        };
        PressError::Load { key, message: error.to_string(), elastic, largest }
    }
}
