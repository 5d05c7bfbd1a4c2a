use super::closures::ClosureContact;
use super::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::{Closure, CurvePoint, Surface};
use serde::{Deserialize, Serialize};

/// A row of `table.csv`: one closure at the load. Shares are of the contact area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableRow {
    /// Name of the surface.
    pub surface: String,
    /// The closure.
    pub closure: Closure,
    /// Sa of the map, µm.
    pub ra_um: f64,
    /// atan of the mean |∇h|, degrees.
    pub beta_deg: f64,
    /// Load over contact area, MPa; none without contact.
    #[serde(rename = "mean_pressure_MPa")]
    pub mean_pressure_mpa: Option<f64>,
    /// Contact area over nominal area.
    pub contact_area_ratio: f64,
    /// Elastic pressure of the closure at the mean slope over hardness (eq. (13)).
    pub plasticity_index: Option<f64>,
    /// Elastic share.
    pub elastic_share: Option<f64>,
    /// Elastoplastic share.
    pub elastoplastic_share: Option<f64>,
    /// Plastic share.
    pub plastic_share: Option<f64>,
    /// Largest pressure on a pixel over nominal pressure.
    pub max_pressure_over_nominal: Option<f64>,
    /// The plane above the mean height, µm.
    pub separation_um: f64,
    /// |ΣF_j/(P A_nom) - 1|; none where no pressure was asked for.
    pub load_error: Option<f64>,
    /// Islands in contact.
    pub asperities: usize,
    /// Displacement that stays after unloading, µm.
    pub residual_displacement_um: Option<f64>,
    /// Work returned over work done.
    pub elastic_energy_share: Option<f64>,
}

impl TableRow {
    pub(super) fn of(name: &str, surface: &Surface, one: &ClosureContact) -> TableRow {
        let (contact, unloading) = (&one.contact, one.unloading.as_ref());
        let share = |k: usize| contact.shares.filter(|_| one.law.hardness().is_some()).map(|s| s[k]);
        TableRow {
            surface: name.into(),
            closure: one.law.closure,
            ra_um: surface.parameters.sa / MICROMETRE,
            beta_deg: surface.parameters.beta_deg(),
            mean_pressure_mpa: contact.mean_pressure().map(|p| p / MEGAPASCAL),
            contact_area_ratio: contact.area_ratio,
            plasticity_index: one.plasticity_index,
            elastic_share: share(0),
            elastoplastic_share: share(1),
            plastic_share: share(2),
            max_pressure_over_nominal: one.peak_ratio().filter(|_| contact.area_ratio > 0.0),
            separation_um: contact.separation / MICROMETRE,
            load_error: contact.load_error,
            asperities: contact.islands.islands.len(),
            residual_displacement_um: unloading.map(|u| u.residual_displacement / MICROMETRE),
            elastic_energy_share: unloading.and_then(|u| u.elastic_share),
        }
    }
}

/// Whether the plane goes down or up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// Down.
    Load,
    /// Up.
    Unload,
}

/// A row of `load_curve.csv`: 64 points a closure from first touch to the load, and as many back.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadPoint {
    /// The closure.
    pub closure: Closure,
    /// Down or up.
    pub phase: Phase,
    /// The plane above the mean height, µm.
    pub separation_um: f64,
    /// Nominal pressure, MPa.
    #[serde(rename = "pressure_MPa")]
    pub pressure_mpa: f64,
    /// Contact area over nominal area.
    pub contact_area_ratio: f64,
}

impl LoadPoint {
    /// Both phases of a contact.
    pub(super) fn curve(one: &ClosureContact) -> impl Iterator<Item = LoadPoint> {
        let closure = one.law.closure;
        let point = move |phase: Phase, p: &CurvePoint| LoadPoint {
            closure,
            phase,
            separation_um: p.separation / MICROMETRE,
            pressure_mpa: p.pressure / MEGAPASCAL,
            contact_area_ratio: p.area_ratio,
        };
        let unload = one.unloading.iter().flat_map(|u| &u.curve);
        let load = one.contact.curve.iter().map(move |p| point(Phase::Load, p));
        load.chain(unload.map(move |p| point(Phase::Unload, p)))
    }
}
