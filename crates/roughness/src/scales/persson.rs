//! Persson's theory of contact by scale: pressures spread as they diffuse with the slopes that are let in.
//!
//! With the variance V = (E* h'/2)² of the pressures of full contact as its time, the density of pressures
//! obeys ∂P/∂V = ½ ∂²P/∂σ² from all of it at the nominal pressure p; what reaches 0 has left contact. Elastic
//! metal is in contact where P is left, erf(p/√(2V)) (Persson 2001). With a limit H a second end takes what
//! reaches it: metal that flows. The sums over images and over sines are the same numbers; the first is short
//! while V is small, the second afterwards.

use std::f64::consts::{PI, SQRT_2};

/// Terms of the sums: each converges as a Gaussian of them.
const TERMS: i32 = 24;
/// √V over H at which the sums change hands.
const HANDOVER: f64 = 0.4;

/// Contact area over nominal area by Persson's theory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerssonArea {
    /// Metal in contact that is below the limit.
    pub elastic: f64,
    /// Metal at the limit.
    pub plastic: f64,
}

impl PerssonArea {
    /// Both.
    pub fn total(&self) -> f64 {
        self.elastic + self.plastic
    }
}

/// The contact of a surface of rms slope `slope` under the nominal `pressure` (Pa) on metal of E*
/// `reduced_modulus` (Pa) and the `limit` of pressure (Pa), without one elastic. None of a pressure that is
/// not between 0 and the limit.
pub fn persson(slope: f64, pressure: f64, reduced_modulus: f64, limit: Option<f64>) -> Option<PerssonArea> {
    if !(pressure >= 0.0 && slope >= 0.0 && limit.is_none_or(|limit| pressure < limit)) {
        return None;
    }
    let spread = 0.5 * reduced_modulus * slope;
    if spread == 0.0 {
        return Some(PerssonArea { elastic: if pressure > 0.0 { 1.0 } else { 0.0 }, plastic: 0.0 });
    }
    let Some(limit) = limit else {
        return Some(PerssonArea { elastic: libm::erf(pressure / (SQRT_2 * spread)), plastic: 0.0 });
    };
    let (share, spread) = (pressure / limit, spread / limit);
    Some(if spread < HANDOVER { by_images(share, spread) } else { by_sines(share, spread) })
}

/// With images of the start beyond both ends; pressures over the limit.
pub(super) fn by_images(start: f64, spread: f64) -> PerssonArea {
    let beyond = |x: f64| 0.5 * libm::erfc(x / (SQRT_2 * spread));
    let (mut elastic, mut plastic) = (0.0, 0.0);
    for k in -TERMS..=TERMS {
        let at = 2.0 * f64::from(k);
        // the density is that of the starts at 2k + p less that of those at 2k - p
        let inside = |start: f64| beyond(-start) - beyond(1.0 - start);
        elastic += inside(at + start) - inside(at - start);
        // what has reached the limit by now: Gaussians first passing at the distance 2k + 1 - p
        let distance = at + 1.0 - start;
        plastic += distance.signum() * 2.0 * beyond(distance.abs());
    }
    PerssonArea { elastic, plastic }
}

/// With the eigenfunctions between both ends.
pub(super) fn by_sines(start: f64, spread: f64) -> PerssonArea {
    let (mut elastic, mut plastic) = (0.0, start);
    for n in 1..=TERMS {
        let k = f64::from(n) * PI;
        let term = 2.0 / k * (k * start).sin() * (-0.5 * (k * spread).powi(2)).exp();
        let odd = n % 2 == 1;
        elastic += if odd { 2.0 * term } else { 0.0 };
        plastic += if odd { -term } else { term };
    }
    PerssonArea { elastic, plastic }
}
