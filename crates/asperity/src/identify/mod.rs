//! From measured force-depth curves to the metal: what E, σ_y and n it has, how sure that is, and whether
//! these curves can tell at all.
//!
//! In the order of the data: the tables of a fit (`fit_file`, `known_or_unknown`), checked and with their
//! measurements read ([`Fit`]); the answer of finite elements to one metal (`response`) and between metals
//! (`emulator`); a measurement with its covariance (`experiment`), all of them (`objective`); the search
//! (`search`, `levenberg_marquardt`); intervals (`profile_likelihood`), samples (`posterior`), and the null
//! direction (`identifiability`): these are modules of `asperity_identification`. The result and its files
//! are here.

mod material_checks;
mod measurements;
mod tool_geometry;

mod fit;

mod result;

mod pictures;

mod fit_report;

pub use asperity_identification::fit_file::{
    Features, FitAccuracy, FitCurve, FitFile, FitMaterial, FitShape, FitTool, Nuisance,
};
pub use asperity_identification::identifiability::{Decided, NullDirection};
pub use asperity_identification::known_or_unknown::{KnownOrUnknown, Percent};
pub use asperity_identification::next_experiment::{NextExperiment, OtherExperiment};
pub use asperity_identification::numbers::StressAt;
pub use asperity_identification::numbers::{Accord, CurveResidual, Found, Residual};
pub use fit::Fit;
pub use result::{Identification, metal_override};
pub use tool_geometry::PYRAMIDS_CONE;

use crate::error::Error;

/// Finds the metal of `fit`.
///
/// `observer` hears the share that is done and what is being done; `false` ends the run.
///
/// # Errors
/// Finite elements that have no answer near the best fit, bounds without a metal, or an observer that ended
/// the run.
///
/// # Examples
/// ```
/// use asperity::{Fit, identify};
///
/// // σ_y and n of a metal of known E from its loading curvatures under two cones
/// let text = r#"
/// accuracy = "draft"
/// samples = 0
/// [material]
/// youngs_modulus = "50 GPa"
/// poissons_ratio = 0.3
/// yield_stress = ["50 MPa", "2 GPa"]
/// hardening_exponent = [0.0, 0.5]
/// hardening_law = "swift"
/// [[curve]]
/// features = { loading_curvature = "13.602 GPa" }
/// tool = { shape = "cone", half_apex_deg = 60 }
/// noise = "1 %"
/// [[curve]]
/// features = { loading_curvature = "7.0 GPa" }
/// tool = { shape = "cone", half_apex_deg = 50 }
/// noise = "1 %"
/// "#;
/// let fit = Fit::from_toml(text, std::path::Path::new(""))?;
/// let found = identify(fit, &mut |_, _| true)?;
/// let stress = &found.parameters["yield_stress"];
/// assert!(stress.low < stress.value && stress.value < stress.high);
/// # Ok::<(), asperity::Error>(())
/// ```
pub fn identify(fit: Fit, observer: &mut dyn FnMut(f64, &str) -> bool) -> Result<Identification, Error> {
    result::identify(fit, observer)
}
