//! Rows of `table.csv` and `load_curve.csv`.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use crate::crush::Phase;
use crate::results::output::{nan_for_null, row};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::closure_contact::ClosureContact;
use asperity_roughness::{Closure, CurvePoint, Surface};

row! {
    /// A row of `table.csv`: one closure at the load. Shares are of the contact area.
    TableRow(name: &str, surface: &Surface, one: &ClosureContact) {
        /// Name of the surface.
        surface: String = name.into(),
        /// The closure.
        closure: Closure = one.closure,
        /// Sa of the map, µm.
        ra_um: f64 = surface.parameters.sa / MICROMETRE,
        /// atan of the mean |∇h|, degrees.
        beta_deg: f64 = surface.parameters.beta_deg(),
        /// Load over contact area, MPa; none without contact. On a half-space over that of whole pixels: load over the corrected area is the nominal pressure over `contact_area_ratio_corrected`.
        mean_pressure_MPa: Option<f64> = one.mean_pressure().map(|p| p / MEGAPASCAL),
        /// Contact area over nominal area; NaN where `status` says why.
        #[serde(deserialize_with = "nan_for_null")]
        contact_area_ratio: f64 = one.area_ratio().unwrap_or(f64::NAN),
        /// Elastic pressure of the closure at the mean slope over hardness (eq. (13)).
        plasticity_index: Option<f64> = one.plasticity_index,
        /// Share of the contact area with an elastic pressure: of islands by their slope, of a half-space pixels below its limit of pressure.
        elastic_share: Option<f64> = share(one, 0),
        /// Share of it on islands between both; 0 on a half-space.
        elastoplastic_share: Option<f64> = share(one, 1),
        /// Share of it with a fully plastic pressure; of a half-space pixels at the limit.
        plastic_share: Option<f64> = share(one, 2),
        /// Largest pressure on a pixel over nominal pressure.
        max_pressure_over_nominal: Option<f64> = one.peak_ratio().filter(|_| one.area_ratio() > Some(0.0)),
        /// The plane above the mean height, µm.
        #[serde(deserialize_with = "nan_for_null")]
        separation_um: f64 =
            one.either(|i| i.contact.separation, |s| s.contact.separation).unwrap_or(f64::NAN) / MICROMETRE,
        /// |ΣF_j/(P A_nom) - 1|; none where no pressure was asked for.
        load_error: Option<f64> = one.either(|i| i.contact.load_error, |s| s.load_error(one.nominal)).flatten(),
        /// Islands in contact; patches of pixels on a half-space.
        asperities: Option<usize> = one.either(|i| i.contact.islands.islands.len(), |s| s.patches),
        /// Residual displacement after unloading, µm.
        residual_displacement_um: Option<f64> = one
            .either(
                |i| i.unloading.as_ref().map(|u| u.residual_displacement),
                |s| s.unloading.as_ref().map(|u| u.residual_displacement),
            )
            .flatten()
            .map(|u| u / MICROMETRE),
        /// Work returned over work done.
        elastic_energy_share: Option<f64> = one
            .either(
                |i| i.unloading.as_ref().and_then(|u| u.elastic_share),
                |s| s.unloading.as_ref().and_then(|u| u.elastic_share),
            )
            .flatten(),
        /// Contact area ratio, corrected for the perimeter of the pixels (Yastrebov et al. 2017).
        contact_area_ratio_corrected: Option<f64> = one.space().map(|s| s.contact.area.corrected),
        /// 95 % bound of the error of the corrected ratio: what pixels leave, and what the limit of pressure leaves.
        area_error: Option<f64> = one.space().map(|s| s.area_error()),
        /// The same of the mean pressure that the corrected area has, MPa.
        mean_pressure_error_MPa: Option<f64> = one
            .space()
            .filter(|s| s.contact.area.corrected > 0.0)
            .map(|s| s.contact.pressure * s.area_error() / s.contact.area.corrected.powi(2) / MEGAPASCAL),
        /// Residual of the complementarity conditions of the half-space.
        residual: Option<f64> = one.space().map(|s| s.contact.residual),
        /// Mean distance of plane and surface, µm.
        mean_gap_um: Option<f64> = one.space().map(|s| s.contact.mean_gap / MICROMETRE),
        /// Normal contact stiffness per unit of area, -dp/d(mean gap), MPa/µm.
        stiffness_MPa_per_um: Option<f64> =
            one.space().and_then(|s| s.contact.stiffness).map(|k| k / MEGAPASCAL * MICROMETRE),
        /// True where an open path crosses the map along x; none where that hangs on points without a height.
        percolates_x: Option<bool> = one.space().and_then(|s| s.percolates(0)),
        /// The same along y.
        percolates_y: Option<bool> = one.space().and_then(|s| s.percolates(1)),
        /// Gap of the critical constriction along x, µm.
        critical_gap_x_um: Option<f64> =
            one.space().and_then(|s| s.passages[0].narrowest).map(|c| c.gap / MICROMETRE),
        /// The same along y.
        critical_gap_y_um: Option<f64> =
            one.space().and_then(|s| s.passages[1].narrowest).map(|c| c.gap / MICROMETRE),
        /// Volumetric flow rate times viscosity over pressure difference along x, m³; 0 where tight, none where not asked for or not known.
        leak_x_m3: Option<f64> = one.space().and_then(|s| s.leak(0)),
        /// The same along y.
        leak_y_m3: Option<f64> = one.space().and_then(|s| s.leak(1)),
        /// Error of the leak along x by the pixels and by points without a height: the true one lies between leak/(1 + error) and leak (1 + error). None without a leak, or where nothing bounds it.
        leak_x_error: Option<f64> = one.space().and_then(|s| s.leak_error(0)),
        /// The same along y.
        leak_y_error: Option<f64> = one.space().and_then(|s| s.leak_error(1)),
        /// Gap between parallel planes that leak as much along x, µm.
        hydraulic_gap_x_um: Option<f64> =
            one.space().and_then(|s| s.passages[0].leak).map(|l| l.hydraulic_gap / MICROMETRE),
        /// The same along y.
        hydraulic_gap_y_um: Option<f64> =
            one.space().and_then(|s| s.passages[1].leak).map(|l| l.hydraulic_gap / MICROMETRE),
        /// Area over that of the half-space with the same metal, those of half-spaces corrected for pixels.
        area_over_half_space: Option<f64> = one.judged.map(|j| j.area),
        /// Mean pressure over that of the half-space with the same metal, by the same areas.
        pressure_over_half_space: Option<f64> = one.judged.map(|j| j.pressure),
        /// The half-space of the two columns before: elastic, or with the limit of pressure of the metal.
        judged_by: Option<Closure> = one.judged.map(|j| j.by),
        /// Area over which the load is nominal, µm²: the load is the nominal pressure times it. Islands stand on cells with a height at each corner, half-spaces on pixels with a height.
        nominal_area_um2: Option<f64> = one.nominal_area().map(|a| a / MICROMETRE / MICROMETRE),
        /// `ok`, or why there are no numbers.
        status: String = one.status().into(),
    }
}

impl TableRow {
    /// Contact area over nominal area as well as it is known: corrected for pixels where it is made of them;
    /// NaN without a contact.
    pub fn best_area_ratio(&self) -> f64 {
        self.contact_area_ratio_corrected.unwrap_or(self.contact_area_ratio)
    }

    /// Load over that area, MPa; none without contact.
    pub fn best_mean_pressure_mpa(&self) -> Option<f64> {
        self.mean_pressure_MPa.map(|pressure| pressure * self.contact_area_ratio / self.best_area_ratio())
    }
}

/// Share of the contact area in a regime; none where no hardness tells the regimes apart.
fn share(one: &ClosureContact, regime: usize) -> Option<f64> {
    one.shares().map(|shares| shares[regime])
}

row! {
    /// A row of `load_curve.csv`: 64 points a closure from first touch to the load, and as many back; up to 9
    /// of a half-space.
    #[derive(Copy)]
    LoadPoint(closure: Closure, phase: Phase, point: &CurvePoint) {
        /// The closure.
        closure: Closure = closure,
        /// Direction of the plane, down or up.
        phase: Phase = phase,
        /// The plane above the mean height, µm.
        separation_um: f64 = point.separation / MICROMETRE,
        /// Nominal pressure, MPa.
        pressure_MPa: f64 = point.pressure / MEGAPASCAL,
        /// Contact area over nominal area.
        contact_area_ratio: f64 = point.area_ratio,
    }
}

impl LoadPoint {
    /// Both phases of a contact.
    pub(super) fn curve(one: &ClosureContact) -> impl Iterator<Item = LoadPoint> {
        let point = |phase: Phase| move |p: &CurvePoint| LoadPoint::new(one.closure, phase, p);
        one.curve()
            .iter()
            .map(point(Phase::Load))
            .chain(one.unloading_curve().iter().map(point(Phase::Unload)))
    }
}
