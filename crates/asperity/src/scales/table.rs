//! Rows of `scales.csv` and `slopes.csv`.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use crate::results::output::row;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::scales::{By, Numbers, Step};

row! {
    /// A row of `scales.csv`: one closure at one cut-off.
    ScaleRow(step: &Step, by: By, found: &Numbers) {
        /// Cut-off of the Gaussian filter (ISO 16610-61), µm: a wave so long keeps half its height, shorter ones less. The finest is the whole map, not filtered: two pixels, the shortest wave that it holds.
        cutoff_um: f64 = step.cutoff / MICROMETRE,
        /// Root mean square of |∇h| of what the filter leaves.
        rms_slope: f64 = step.slopes.rms,
        /// Slope β = atan(mean |∇h|), degrees.
        mean_slope_deg: f64 = step.slopes.mean.atan().to_degrees(),
        /// `half-space` (elastic), `half-space-plastic` (with the limit of pressure that `asperity rough` takes), `half-space-plastic-by-slope` (the plateau of the atlas of cones at the mean slope of this scale, where that is another limit), closures of islands, `persson`, `persson-plastic`, `bearing` (the limit of pressure all over the contact).
        closure: String = by.name().into(),
        /// Contact area over nominal area, of a half-space by pixels.
        contact_area_ratio: Option<f64> = found.area_ratio,
        /// Nominal pressure over that, MPa.
        mean_pressure_MPa: Option<f64> = found.mean_pressure.map(|p| p / MEGAPASCAL),
        /// Pressure that 99 % of the contact are below, MPa.
        pressure_p99_MPa: Option<f64> = found.pressures[1].map(|p| p / MEGAPASCAL),
        /// Mean distance of plane and surface, µm.
        mean_gap_um: Option<f64> = found.mean_gap.map(|gap| gap / MICROMETRE),
        /// Volume flux times viscosity over pressure difference along x, m³; 0 where nothing passes.
        leak_x_m3: Option<f64> = found.leaks[0],
        /// The same along y.
        leak_y_m3: Option<f64> = found.leaks[1],
        /// -dp/d(mean gap) per area, MPa/µm; pixels at the limit of pressure carry no more.
        stiffness_MPa_per_um: Option<f64> = found.stiffness.map(|s| s / MEGAPASCAL * MICROMETRE),
        /// Share of the load on patches whose mean slope leaves a cone of the metal elastic: 0.9 of the force of an elastic cone or more.
        elastic_share: Option<f64> = found.by_load[0],
        /// Share of the load on patches between both.
        elastoplastic_share: Option<f64> = found.by_load[1],
        /// Share of the load on patches so steep that a cone has 0.9 of its largest pressure or more: the share of the singular pressures.
        plastic_share: Option<f64> = found.by_load[2],
        /// The same shares of the area; of closures of islands by their own regimes.
        elastic_area_share: Option<f64> = found.by_area[0],
        /// The same.
        elastoplastic_area_share: Option<f64> = found.by_area[1],
        /// The same.
        plastic_area_share: Option<f64> = found.by_area[2],
        /// Contact area ratio less what the rims of pixels add.
        contact_area_ratio_corrected: Option<f64> = found.area.map(|area| area.corrected),
        /// 95 % bound of the error of that by the pixels.
        area_error: Option<f64> = found.area.map(|area| area.error),
        /// Median pressure over the contact, MPa.
        pressure_median_MPa: Option<f64> = found.pressures[0].map(|p| p / MEGAPASCAL),
        /// Largest pressure of a pixel, MPa.
        pressure_max_MPa: Option<f64> = found.pressures[2].map(|p| p / MEGAPASCAL),
        /// Gap of the critical constriction along x, µm; none where no path crosses.
        critical_gap_x_um: Option<f64> = found.critical_gaps[0].map(|gap| gap / MICROMETRE),
        /// The same along y.
        critical_gap_y_um: Option<f64> = found.critical_gaps[1].map(|gap| gap / MICROMETRE),
        /// Error of the leak along x by the pixels: the true one lies between leak/(1 + error) and leak (1 + error).
        leak_x_error: Option<f64> = found.leak_errors[0],
        /// The same along y.
        leak_y_error: Option<f64> = found.leak_errors[1],
        /// Largest pressure that the metal carries, MPa.
        limit_MPa: Option<f64> = found.limit.map(|p| p / MEGAPASCAL),
        /// Share of the contact area at that limit.
        limited_share: Option<f64> = found.limited_share,
    }
}

impl ScaleRow {
    /// Nominal pressure over the corrected area, MPa.
    pub(super) fn corrected_mean_pressure(&self) -> Option<f64> {
        Some(self.mean_pressure_MPa? * self.contact_area_ratio? / self.contact_area_ratio_corrected?)
    }
}

row! {
    /// A row of `slopes.csv`: slopes and curvatures at one cut-off.
    SlopeRow(step: &Step) {
        /// As in `scales.csv`.
        cutoff_um: f64 = step.cutoff / MICROMETRE,
        /// Distance of the points of the grid that the contact was found on, along x.
        grid_um: f64 = step.grid / MICROMETRE,
        /// Root mean square height.
        sq_um: f64 = step.sq / MICROMETRE,
        /// Root mean square of |∇h|.
        rms_slope: f64 = step.slopes.rms,
        /// Slope that 1 % of the surface are below, degrees.
        slope_p01_deg: f64 = step.slopes.quantiles[0].atan().to_degrees(),
        /// Slope that 10 % are below.
        slope_p10_deg: f64 = step.slopes.quantiles[1].atan().to_degrees(),
        /// Slope that half of it are below.
        slope_median_deg: f64 = step.slopes.quantiles[2].atan().to_degrees(),
        /// Slope that 90 % are below.
        slope_p90_deg: f64 = step.slopes.quantiles[3].atan().to_degrees(),
        /// Slope that 99 % are below.
        slope_p99_deg: f64 = step.slopes.quantiles[4].atan().to_degrees(),
        /// Root mean square of half the Laplacian, the mean curvature of a gentle surface.
        rms_curvature_per_um: f64 = step.slopes.rms_curvature * MICROMETRE,
        /// Smallest over largest rms slope of all directions: 1 of an isotropic surface, 0 of grooves.
        anisotropy: f64 = step.slopes.anisotropy,
        /// Direction of the largest, degrees from x to y.
        steepest_deg: f64 = step.slopes.steepest_deg,
        /// Distance of points for the next four, half the cut-off in whole pixels; on the map without a filter.
        distance_um: f64 = step.slopes.distance / MICROMETRE,
        /// Root mean square difference of heights of points so far apart over their distance, along x.
        slope_over_distance_x: Option<f64> = step.slopes.over_distance[0],
        /// The same along y.
        slope_over_distance_y: Option<f64> = step.slopes.over_distance[1],
        /// Root mean square second difference of three such points over the square of the distance, along x.
        curvature_over_distance_x_per_um: Option<f64> = step.slopes.curvature_over_distance[0].map(|c| c * MICROMETRE),
        /// The same along y.
        curvature_over_distance_y_per_um: Option<f64> = step.slopes.curvature_over_distance[1].map(|c| c * MICROMETRE),
    }
}
