//! `summary.json` of a pressed surface.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use super::table::TableRow;
use crate::results::output::row;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::closure_contact::ClosureContact;
use crate::rough::warnings::Warnings;
use asperity_roughness::Surface;
use asperity_roughness::scene::Scene;
use std::collections::BTreeMap;

/// Meaning of numbers whose names could be misread.
const DEFINITIONS: [(&str, &str); 6] = [
    (
        "standards",
        "sa, sq, ssk, sku, sp, sv, sz, sdq, sdr: ISO 25178-2 over the whole map, without further filters than those of the scene; \
         sdq and sdr by its derivative of seven points; ra and rq are sa and sq of the map",
    ),
    (
        "beta",
        "atan of mean_gradient, the mean of |grad h|; mean_slope_x is the mean of |dz/dx|; both depend on the pixel size",
    ),
    (
        "asperity_slope",
        "tan(beta_j) is the mean of |grad h| over the island, not the slope from summit to rim",
    ),
    (
        "elastic_energy_share",
        "work returned over work done, at most 1; by_law is the unloading law's own figure, above 1 where asperities are \
         shallower than the cones that stand for them",
    ),
    ("separation", "from the mean height of the nodes"),
    (
        "pressure",
        "force on a pixel over the area of the pixel; an island mostly outside the ellipse of its moments is uniform \
         (load_share_uniform)",
    ),
];

row! {
    /// The content of `summary.json`: the surface as pressed, and every closure.
    Summary(name: &str, surface: &Surface, scene: &Scene) {
        /// Name of the surface.
        surface: String = name.into(),
        /// Points along x and y.
        pixels: [usize; 2] = [surface.map.columns(), surface.map.rows()],
        /// Distance of points along x and y.
        pixel_size_um: [f64; 2] = surface.map.pixel().map(|p| p / MICROMETRE),
        /// Points that were not measured.
        missing: usize = surface.missing,
        /// Interpretation of the file: dialect, columns, units, lines; and remarks on it.
        understood: Vec<String> = surface.notes.clone(),
        /// Points that `surface.outliers` took away.
        outliers: usize = surface.outliers,
        /// Area of the cells used, over which closures of islands carry the pressure; `nominal_area_um2` of a closure is its own.
        nominal_area_um2: f64 = surface.nominal_area() / MICROMETRE / MICROMETRE,
        /// Arithmetic mean height Sa of ISO 25178-2, over the whole map.
        sa_um: f64 = surface.parameters.sa / MICROMETRE,
        /// Root mean square height Sq.
        sq_um: f64 = surface.parameters.sq / MICROMETRE,
        /// Skewness Ssk; none of a flat map, like `sku`.
        ssk: Option<f64> = finite(surface.parameters.ssk),
        /// Kurtosis Sku.
        sku: Option<f64> = finite(surface.parameters.sku),
        /// Largest height less smallest height.
        sz_um: f64 = surface.parameters.sz / MICROMETRE,
        /// Maximum peak height Sp: highest point above the mean, µm.
        sp_um: f64 = surface.parameters.sp / MICROMETRE,
        /// Maximum pit height Sv: mean above the lowest point, µm.
        sv_um: f64 = surface.parameters.sv / MICROMETRE,
        /// Root mean square gradient Sdq, by the derivative of seven points of ISO 25178-2.
        sdq: f64 = surface.parameters.sdq,
        /// Developed area over projected area, less 1, Sdr.
        sdr: f64 = surface.parameters.sdr,
        /// Root mean square of |∇h| of the surface that is pressed, which is linear between the points.
        rms_gradient: f64 = surface.parameters.rms_gradient,
        /// Sa again, under the name of the scene and of the table.
        ra_um: f64 = surface.parameters.sa / MICROMETRE,
        /// Sq again.
        rq_um: f64 = surface.parameters.sq / MICROMETRE,
        /// Mean of |∇h|; depends on the pixel size.
        mean_gradient: f64 = surface.parameters.mean_gradient,
        /// Mean of |dz/dx|.
        mean_slope_x: f64 = surface.parameters.mean_slope_x,
        /// atan of `mean_gradient`, degrees.
        beta_deg: f64 = surface.parameters.beta_deg(),
        /// Definitions of keys that are easily misread.
        definitions: BTreeMap<String, String> = DEFINITIONS.map(|(name, text)| (name.into(), text.into())).into(),
        /// Every closure.
        closures: Vec<ClosureSummary> = Vec::new(),
        /// Area, closure to believe, gap and leak of a half-space in words; where no closure of islands carries the load, what they carry.
        verdict: Option<String> = None,
        /// Remarks on the trust in the numbers.
        warnings: Warnings = Vec::new(),
        /// Seconds the run took.
        wall_s: f64 = 0.0,
        /// The scene as pressed.
        scene: Scene = scene.clone(),
        /// Version of this program.
        version: String = env!("CARGO_PKG_VERSION").into(),
    }
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|v| v.is_finite())
}

row! {
    /// One closure in the summary: its row of the table and how far to trust it.
    ClosureSummary(row: TableRow, one: &ClosureContact) {
        /// The row of `table.csv`.
        #[serde(flatten)]
        row: TableRow = row,
        /// Source of the closure.
        source: String = one.islands().map_or(one.closure.source(), |i| i.law.source()).into(),
        /// The pressure asked for, or carried at the separation asked for, MPa.
        nominal_pressure_MPa: f64 = one.nominal / MEGAPASCAL,
        /// True where the load jumps at the separation.
        load_jumps: bool = one.islands().is_some_and(|i| i.contact.jump),
        /// Share of the load on islands outside the range of the closure: of `calibrated` outside both the calibration and the atlas of cones.
        load_share_outside_range: Option<f64> = one.islands().and_then(|i| i.contact.outside_share),
        /// Share of the load on islands that no ellipse describes.
        load_share_uniform: Option<f64> = one.islands().and_then(|i| i.field.uniform_share),
        /// Work returned by the unloading law over work done, above 1 too.
        elastic_energy_share_by_law: Option<f64> =
            one.islands().and_then(|i| i.unloading.as_ref()).and_then(|u| u.elastic_share_by_law),
        /// Share of the load on islands that the law would raise by more than they were pressed.
        load_share_return_limited: Option<f64> =
            one.islands().and_then(|i| i.unloading.as_ref()).and_then(|u| u.limited_share),
        /// Largest pressure that a pixel of the half-space carries, MPa.
        limit_MPa: Option<f64> = one.space().and_then(|s| s.body.limit).map(|l| l / MEGAPASCAL),
        /// Source of that limit: the hardness, 3 yield_stress, or the atlas of cones.
        limit_from: Option<String> = one.space().and_then(|s| s.limit_from()),
        /// Slope of the patches of contact at which the atlas of cones was read, degrees.
        limit_slope_deg: Option<f64> = one.space().and_then(|s| s.limit_slope_deg()),
        /// Relative uncertainty of that limit (95 %); it goes into `area_error`.
        limit_error: Option<f64> = one.space().and_then(|s| s.limit).map(|l| l.error),
        /// The part of `area_error` that pixels leave.
        area_error_of_pixels: Option<f64> = one.space().map(|s| s.contact.area.error),
        /// Proven bound of the relative error of the pressures that the search of the half-space leaves, in the norm of the energy.
        pressure_error: Option<f64> = one.space().map(|s| s.contact.pressure_error),
        /// The same of the energy.
        energy_error: Option<f64> = one.space().map(|s| s.contact.pressure_error.powi(2)),
        /// Convolutions on the finest grid of the half-space.
        convolutions: Option<usize> = one.space().map(|s| s.contact.convolutions),
        /// Root mean square height of the surface after unloading, µm.
        residual_sq_um: Option<f64> =
            one.space().and_then(|s| s.unloading.as_ref()).map(|u| u.residual_sq / MICROMETRE),
        /// Pixels of the critical constriction along x and along y, counted from the first.
        critical_pixels: Option<[Option<[usize; 2]>; 2]> =
            one.space().map(|s| s.passages.map(|p| p.narrowest.map(|c| c.at))),
    }
}
