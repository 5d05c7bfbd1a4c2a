//! Curves of the surface and of its gap: material ratio, power spectrum, distribution of gaps.

use crate::results::output::row;
use crate::results::units::MICROMETRE;
use crate::rough::closure_contact::{Body, ClosureContact};
use asperity_roughness::{Closure, SpectrumPoint, Surface};

/// Heights of `bearing.csv`.
const HEIGHTS: usize = 201;
/// Gaps of a closure in `gaps.csv`.
const GAPS: usize = 201;

row! {
    /// A row of `bearing.csv`: the areal material ratio of ISO 25178-2, from the highest point down.
    #[derive(Copy)]
    BearingRow(point: [f64; 2]) {
        /// Height above the mean plane.
        height_um: f64 = point[0] / MICROMETRE,
        /// Share of the surface above it.
        material_ratio: f64 = point[1],
    }
}

row! {
    /// A row of `spectrum.csv`: power spectral densities around one frequency.
    #[derive(Copy)]
    SpectrumRow(point: &SpectrumPoint) {
        /// 1 over the wave length.
        frequency_per_um: f64 = point.frequency * MICROMETRE,
        /// Mean over all directions; its integral over the plane of frequencies is Sq².
        psd_um4: Option<f64> = point.areal.map(|c| c / MICROMETRE.powi(4)),
        /// Of profiles along x; twice its integral is Sq².
        psd_x_um3: Option<f64> = point.along_x.map(|c| c / MICROMETRE.powi(3)),
        /// Of profiles along y.
        psd_y_um3: Option<f64> = point.along_y.map(|c| c / MICROMETRE.powi(3)),
    }
}

row! {
    /// A row of `gaps.csv`: how much of the surface is closer to the plane than a gap, on a half-space.
    #[derive(Copy)]
    GapShare(closure: Closure, gap: f64, share: f64) {
        /// The closure.
        closure: Closure = closure,
        /// Distance of plane and surface.
        gap_um: f64 = gap / MICROMETRE,
        /// Share of the pixels with no larger gap; of a gap of 0 the contact.
        share: f64 = share,
    }
}

/// The rows of `bearing.csv`; none of a flat map.
pub(super) fn bearing(surface: &Surface) -> Vec<BearingRow> {
    surface.material_ratio(HEIGHTS).into_iter().map(BearingRow::new).collect()
}

/// The rows of `spectrum.csv`.
pub(super) fn spectrum(surface: &Surface) -> Vec<SpectrumRow> {
    let points = asperity_roughness::spectrum(&surface.map).unwrap_or_default();
    points.iter().map(SpectrumRow::new).collect()
}

/// The rows of `gaps.csv` of one contact: at equal steps from 0 to the largest gap; none of closures with
/// islands.
pub(super) fn gaps(one: &ClosureContact) -> Vec<GapShare> {
    let Body::HalfSpace(space) = &one.body else { return Vec::new() };
    let gaps = &space.contact.gaps;
    let most = f64::from(gaps.iter().copied().filter(|g| !g.is_nan()).fold(0.0, f32::max));
    let step = most / (GAPS - 1) as f64;
    let mut counts = [0usize; GAPS];
    for gap in gaps.iter().map(|g| f64::from(*g)).filter(|g| !g.is_nan()) {
        let k = if gap > 0.0 { (gap / step).ceil() as usize } else { 0 };
        counts[k.min(GAPS - 1)] += 1;
    }
    let pixels = counts.iter().sum::<usize>() as f64;
    let mut below = 0;
    let points = counts.iter().enumerate().map(|(k, count)| {
        below += count;
        GapShare::new(one.closure, k as f64 * step, below as f64 / pixels)
    });
    points.collect()
}
