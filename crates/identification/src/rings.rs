//! Rings of a map about the middle of an imprint, and the noise of their means.
//!
//! A ring mean is the zeroth harmonic of the heights around a ring. Noise that knows no direction has about
//! as much power in the first few harmonics, which hold nothing of the imprint: far from it they tell the
//! noise of the means. The line of means itself tells it badly, for a pile-up of another height looks like
//! noise that is alike over as much.
//!
//! Variance and length are those of the harmonics over the distance from the middle: their mean square, and
//! the integral of their correlation up to where it ends. An exponential of both has the power of any noise
//! at long waves, where a pile-up lies, and more than that of a smooth one at short waves.

use crate::far_field::{FAR_RADII, FarField, MIN_FAR_POINTS, NoisePart};
use std::f64::consts::TAU;

/// Sectors of a ring, and the harmonics around it that are taken for its noise.
const SECTORS: usize = 16;
const HARMONICS: [usize; 4] = [1, 2, 3, 4];

/// Sums over the heights of a ring, or of several beside each other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ring {
    /// Number of heights in each sector.
    counts: [f64; SECTORS],
    /// Sum of the heights in each sector, m.
    heights: [f64; SECTORS],
    /// Sum of the distances from the middle, m, and of the squares of the heights, m².
    sums: [f64; 2],
}

impl Ring {
    /// Takes the height of a point at this distance from the middle and angle about it.
    pub fn take(&mut self, distance: f64, angle: f64, height: f64) {
        let sector = (angle.rem_euclid(TAU) / TAU * SECTORS as f64) as usize % SECTORS;
        self.counts[sector] += 1.0;
        self.heights[sector] += height;
        self.sums[0] += distance;
        self.sums[1] += height * height;
    }

    /// Mean distance and height, m; `None` without heights.
    pub fn mean(&self) -> Option<[f64; 2]> {
        let count = self.count();
        (count > 0.0).then(|| [self.sums[0], self.heights.iter().sum()].map(|sum| sum / count))
    }

    /// The ring with that of another one.
    pub fn with(mut self, other: &Ring) -> Ring {
        for sector in 0..SECTORS {
            self.counts[sector] += other.counts[sector];
            self.heights[sector] += other.heights[sector];
        }
        self.sums = [0, 1].map(|k| self.sums[k] + other.sums[k]);
        self
    }

    fn count(&self) -> f64 {
        self.counts.iter().sum()
    }

    /// Cosine and sine of each harmonic, of the variance that the mean of the ring has by a noise without a
    /// direction; `None` where a sector is empty.
    fn harmonics(&self) -> Option<[f64; 2 * HARMONICS.len()]> {
        if self.counts.contains(&0.0) {
            return None;
        }
        let sum = |k: usize| {
            let (wave, phase) = (HARMONICS[k / 2] as f64, 0.25 * TAU * (k % 2) as f64);
            let of = |i: usize| (wave * TAU * i as f64 / SECTORS as f64 - phase).cos();
            (0..SECTORS).map(|i| of(i) * self.heights[i] / self.counts[i]).sum::<f64>()
        };
        Some(std::array::from_fn(|k| f64::sqrt(2.0) / SECTORS as f64 * sum(k)))
    }
}

/// Noise of the means of `rings` far from a contact of the radius `radius`, alike over `length` where that is
/// known; `None` where too few of them are whole.
pub fn noise_of_means(rings: &[Ring], radius: f64, length: Option<f64>) -> Option<FarField> {
    let far = rings.iter().filter_map(|ring| Some((ring, ring.mean()?, ring.harmonics()?)));
    let far: Vec<_> = far.filter(|(_, mean, _)| mean[0] > FAR_RADII * radius).collect();
    if far.len() < MIN_FAR_POINTS {
        return None;
    }
    let count = far.len() as f64;
    let place = far.iter().map(|(_, mean, _)| mean[0]).sum::<f64>() / count;
    let spacing = (far[far.len() - 1].1[0] - far[0].1[0]) / (count - 1.0);
    // a ring holds as many patches of noise as it is long
    let series =
        |k: usize| far.iter().map(|(_, mean, of)| of[k] * (mean[0] / place).sqrt()).collect::<Vec<f64>>();
    let series: Vec<Vec<f64>> = (0..2 * HARMONICS.len()).map(series).collect();
    let products = |apart: usize| {
        let of = |z: &Vec<f64>| z.iter().zip(&z[apart..]).map(|(a, b)| a * b).sum::<f64>();
        series.iter().map(of).sum::<f64>() / (series.len() as f64 * count)
    };
    let variance = products(0).max(f64::MIN_POSITIVE);
    let alike = (1..far.len()).map(|apart| products(apart) / variance).take_while(|of| *of > 0.0);
    let alike: Vec<f64> = alike.collect();
    let seen = spacing * alike.iter().sum::<f64>();
    // squares are alike as the square of what heights are
    let squares = 1.0 + 2.0 * alike.iter().map(|of| of * of).sum::<f64>();
    let freedom = series.len() as f64 * (count / squares).max(1.0);
    let part = NoisePart { variance, length: length.unwrap_or(seen) };
    let about_the_means = far.iter().map(|(ring, mean, _)| ring.sums[1] - ring.count() * mean[1].powi(2));
    let of_one_height = about_the_means.sum::<f64>() / far.iter().map(|(ring, ..)| ring.count()).sum::<f64>();
    Some(FarField { parts: vec![part], freedom, place, of_one_height: Some(of_one_height) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rings from 1.9 to 4 contact radii of a map of bumps of a Gaussian form at random places: the sum of
    /// many is a noise whose patches are as wide as they.
    fn rings(seed: &mut u64, width: f64) -> Vec<Ring> {
        let mut draw = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let bumps: Vec<[f64; 3]> =
            (0..1500).map(|_| [10.0 * draw() - 5.0, 10.0 * draw() - 5.0, draw() - 0.5]).collect();
        let pixel = 8.0 / 80.0;
        let mut rings = vec![Ring::default(); 21];
        for k in 0..80 * 80 {
            let [x, y] = [k % 80, k / 80].map(|i| pixel * (f64::from(i) - 39.5));
            let r = x.hypot(y);
            if !(1.9..4.0).contains(&r) {
                continue;
            }
            let form = |[a, b, height]: &[f64; 3]| {
                let square = ((x - a).powi(2) + (y - b).powi(2)) / (width * width);
                if square < 9.0 { height * (-square).exp() } else { 0.0 }
            };
            rings[(10.0 * (r - 1.9)) as usize].take(r, y.atan2(x), bumps.iter().map(form).sum());
        }
        rings
    }

    /// Over 40 maps the means of rings have the variance that the harmonics of each tell, beside a level that
    /// no ring tells: as differences of two means half a contact radius apart show.
    #[test]
    fn harmonics_around_rings_tell_the_noise_of_their_means() {
        let mut seed = 5;
        for width in [0.1, 0.25] {
            let (mut told, mut seen) = (0.0, 0.0);
            for _ in 0..40 {
                let rings = rings(&mut seed, width);
                let means: Vec<[f64; 2]> = rings.iter().map(|ring| ring.mean().unwrap()).collect();
                let far = noise_of_means(&rings, 1.0, None).unwrap();
                let of = |i: usize, k: usize| {
                    let apart = means[i][0] - means[k][0];
                    let size = |i: usize| (far.place / means[i][0]).sqrt();
                    let sum: f64 = far.parts.iter().map(|part| part.covariance(apart)).sum();
                    size(i) * size(k) * sum
                };
                for i in 5..rings.len() {
                    told += of(i, i) + of(i - 5, i - 5) - 2.0 * of(i, i - 5);
                    seen += (means[i][1] - means[i - 5][1]).powi(2);
                }
            }
            assert!((0.7..1.5).contains(&(told / seen)), "{width}: told {told:e}, seen {seen:e}");
        }
    }

    #[test]
    fn rings_with_an_empty_sector_tell_no_noise() {
        let mut seed = 9;
        let mut rings = rings(&mut seed, 0.2);
        assert!(noise_of_means(&rings, 1.0, None).is_some());
        for ring in &mut rings[7..] {
            ring.counts[3] = 0.0;
        }
        assert!(noise_of_means(&rings, 1.0, None).is_none());
    }
}
