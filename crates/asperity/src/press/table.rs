//! Rows of `table.csv` and `load_curve.csv`.

use super::closures::ClosureContact;
use crate::crush::Phase;
use crate::output::row;
use crate::units::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::{Closure, CurvePoint, Surface};

row! {
    /// A row of `table.csv`: one closure at the load. Shares are of the contact area.
    TableRow(name: &str, surface: &Surface, one: &ClosureContact) {
        /// Name of the surface.
        surface: String = name.into(),
        /// The closure.
        closure: Closure = one.law.closure,
        /// Sa of the map, µm.
        ra_um: f64 = surface.parameters.sa / MICROMETRE,
        /// atan of the mean |∇h|, degrees.
        beta_deg: f64 = surface.parameters.beta_deg(),
        /// Load over contact area, MPa; none without contact.
        #[serde(rename = "mean_pressure_MPa")]
        mean_pressure_mpa: Option<f64> = one.contact.mean_pressure().map(|p| p / MEGAPASCAL),
        /// Contact area over nominal area.
        contact_area_ratio: f64 = one.contact.area_ratio,
        /// Elastic pressure of the closure at the mean slope over hardness (eq. (13)).
        plasticity_index: Option<f64> = one.plasticity_index,
        /// Elastic share.
        elastic_share: Option<f64> = share(one, 0),
        /// Elastoplastic share.
        elastoplastic_share: Option<f64> = share(one, 1),
        /// Plastic share.
        plastic_share: Option<f64> = share(one, 2),
        /// Largest pressure on a pixel over nominal pressure.
        max_pressure_over_nominal: Option<f64> = one.peak_ratio().filter(|_| one.contact.area_ratio > 0.0),
        /// The plane above the mean height, µm.
        separation_um: f64 = one.contact.separation / MICROMETRE,
        /// |ΣF_j/(P A_nom) - 1|; none where no pressure was asked for.
        load_error: Option<f64> = one.contact.load_error,
        /// Islands in contact.
        asperities: usize = one.contact.islands.islands.len(),
        /// Displacement that stays after unloading, µm.
        residual_displacement_um: Option<f64> =
            one.unloading.as_ref().map(|u| u.residual_displacement / MICROMETRE),
        /// Work returned over work done.
        elastic_energy_share: Option<f64> = one.unloading.as_ref().and_then(|u| u.elastic_share),
    }
}

/// Share of the contact area in a regime; none where no hardness tells the regimes apart.
fn share(one: &ClosureContact, regime: usize) -> Option<f64> {
    one.law.hardness.and(one.contact.shares).map(|shares| shares[regime])
}

row! {
    /// A row of `load_curve.csv`: 64 points a closure from first touch to the load, and as many back.
    #[derive(Copy)]
    LoadPoint(closure: Closure, phase: Phase, point: &CurvePoint) {
        /// The closure.
        closure: Closure = closure,
        /// Whether the plane goes down or up.
        phase: Phase = phase,
        /// The plane above the mean height, µm.
        separation_um: f64 = point.separation / MICROMETRE,
        /// Nominal pressure, MPa.
        #[serde(rename = "pressure_MPa")]
        pressure_mpa: f64 = point.pressure / MEGAPASCAL,
        /// Contact area over nominal area.
        contact_area_ratio: f64 = point.area_ratio,
    }
}

impl LoadPoint {
    /// Both phases of a contact.
    pub(super) fn curve(one: &ClosureContact) -> impl Iterator<Item = LoadPoint> {
        let point = |phase: Phase| move |p: &CurvePoint| LoadPoint::new(one.law.closure, phase, p);
        let unload = one.unloading.iter().flat_map(|u| &u.curve);
        one.contact.curve.iter().map(point(Phase::Load)).chain(unload.map(point(Phase::Unload)))
    }
}
