//! Noise of a profile from its far field, beyond the pile-up.
//!
//! Heights there are an offset, a tilt, the smooth end of the pile-up, and noise whose covariance falls
//! exponentially with the distance. The smooth terms take most of a noise that is alike over much of the far
//! field, so its variance comes from the restricted likelihood, which knows of them (Patterson and Thompson,
//! Biometrika 58, 1971, 545). A few correlation lengths hardly tell that length: the noise is a mixture over
//! lengths, each with the weight that the heights give it.

use nalgebra::{DMatrix, DVector};

/// Contact radii from which a profile is flat but for noise and the end of the pile-up.
pub const FAR_RADII: f64 = 1.9;
/// Fewest points of the far field that tell its noise.
pub const MIN_FAR_POINTS: usize = 8;
/// Lengths that are tried: none, and from a fraction of the distance of two points to one contact radius.
const LENGTHS: usize = 16;
const SHORTEST_OVER_SPACING: f64 = 0.2;
/// Weight below which a length is left out.
const LEAST_WEIGHT: f64 = 1e-4;
/// Share of a variance that keeps points at one place from being one equation twice.
const NUGGET: f64 = 1e-9;
/// Offset, tilt, end of the pile-up.
const TERMS: usize = 3;

/// Noise that is alike over one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoisePart {
    /// Variance of a height, m².
    pub variance: f64,
    /// Distance over which heights are off alike, m; 0: each by itself.
    pub length: f64,
}

impl NoisePart {
    /// Covariance of two heights at this distance; 0 is that of a height with itself.
    pub fn covariance(&self, distance: f64) -> f64 {
        self.variance * alike_within(distance, self.length)
    }
}

fn alike_within(distance: f64, length: f64) -> f64 {
    if length > 0.0 { (-distance / length).exp() } else { f64::from(u8::from(distance == 0.0)) }
}

/// Distance of the readings `i` and `j` at these places: two at one place are still two.
pub fn apart(i: usize, j: usize, [a, b]: [f64; 2]) -> f64 {
    if i == j { 0.0 } else { (a - b).abs().max(f64::MIN_POSITIVE) }
}

/// Heights beyond the pile-up.
#[derive(Clone, Debug, PartialEq)]
pub struct FarField {
    /// The noise, a mixture over lengths.
    pub parts: Vec<NoisePart>,
    /// Degrees of freedom of its variance.
    pub freedom: f64,
    /// Mean distance from the axis, m.
    pub place: f64,
    /// Variance of one height of a map of whose rings the noise is, m².
    pub of_one_height: Option<f64>,
}

/// Residual height far outside of a contact of the radius `radius` over its size at the rim: what yields is
/// small from there, and lifts the free surface of an elastic half-space as the inverse cube of the distance
/// (Mogi 1958).
pub fn tail(place: f64, radius: f64) -> f64 {
    (radius / place.abs()).powi(3)
}

/// That of the profile `points` (place and height, m), whose noise is alike over `length` where that is
/// known; `None` of too few points.
pub fn far_field(points: &[[f64; 2]], radius: f64, length: Option<f64>) -> Option<FarField> {
    let side = |side: f64| -> Vec<[f64; 2]> {
        points.iter().copied().filter(|p| side * p[0] > FAR_RADII * radius).collect()
    };
    let sides = [-1.0, 1.0].map(side);
    let sides: Vec<Vec<[f64; 2]>> = sides.into_iter().filter(|far| far.len() >= MIN_FAR_POINTS / 2).collect();
    let count: usize = sides.iter().map(Vec::len).sum();
    if count < MIN_FAR_POINTS {
        return None;
    }
    let reach: f64 = sides.iter().map(|far| far[far.len() - 1][0] - far[0][0]).sum();
    let spacing = reach / (count - sides.len()) as f64;
    let freedom = (count - TERMS * sides.len()) as f64;
    let tried = |k: usize| {
        let share = k as f64 / (LENGTHS - 1) as f64;
        if k == 0 { 0.0 } else { (SHORTEST_OVER_SPACING * spacing).powf(1.0 - share) * radius.powf(share) }
    };
    let lengths = length.map_or_else(|| (0..LENGTHS).map(tried).collect(), |known| vec![known]);
    let found: Vec<(f64, NoisePart)> = lengths
        .into_iter()
        .filter_map(|length| {
            let of_sides: Option<Vec<[f64; 2]>> =
                sides.iter().map(|far| restricted(far, radius, length)).collect();
            let of_sides = of_sides?;
            let [square, determinant] = [0, 1].map(|k| of_sides.iter().map(|side| side[k]).sum::<f64>());
            let variance = (square / freedom).max(f64::MIN_POSITIVE);
            Some((-0.5 * (freedom * variance.ln() + determinant), NoisePart { variance, length }))
        })
        .collect();
    let most = found.iter().map(|(likelihood, _)| *likelihood).fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = found.iter().map(|(likelihood, _)| (likelihood - most).exp()).collect();
    let all: f64 = weights.iter().sum();
    let parts: Vec<NoisePart> = found
        .iter()
        .zip(&weights)
        .filter(|(_, weight)| **weight > LEAST_WEIGHT * all)
        .map(|((_, part), weight)| NoisePart { variance: part.variance * weight / all, ..*part })
        .collect();
    let place = sides.iter().flatten().map(|p| p[0].abs()).sum::<f64>() / count as f64;
    (!parts.is_empty()).then_some(FarField { parts, freedom, place, of_one_height: None })
}

/// Sum of squares that the smooth terms leave of one side, in units of noise of the variance 1, and the
/// logarithm of the determinants of the restricted likelihood.
fn restricted(far: &[[f64; 2]], radius: f64, length: f64) -> Option<[f64; 2]> {
    let count = far.len();
    let covariance = DMatrix::from_fn(count, count, |i, j| {
        let nugget = if i == j { NUGGET } else { 0.0 };
        alike_within(apart(i, j, [far[i][0], far[j][0]]), length) + nugget
    });
    let factor = covariance.cholesky()?;
    let terms = DMatrix::from_fn(count, TERMS, |i, j| match j {
        0 => 1.0,
        1 => far[i][0] / radius,
        _ => tail(far[i][0], radius),
    });
    let heights = DVector::from_iterator(count, far.iter().map(|p| p[1]));
    let lower = factor.l_dirty();
    let (terms, heights) = (lower.solve_lower_triangular(&terms)?, lower.solve_lower_triangular(&heights)?);
    let determinant: f64 = lower.diagonal().iter().map(|x| 2.0 * x.ln()).sum();
    let triangle = terms.qr();
    let smooth = triangle.q();
    let left = &heights - &smooth * smooth.tr_mul(&heights);
    let of_the_terms: f64 = triangle.r().diagonal().iter().map(|x| 2.0 * x.abs().ln()).sum();
    Some([left.norm_squared(), determinant + of_the_terms])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights of deviation 1 at the places, alike over `length`: an autoregression of the sum of twelve
    /// numbers of a fixed generator.
    fn noise(seed: &mut u64, spacing: f64, length: f64, count: usize) -> Vec<f64> {
        let mut draw = || {
            let mut uniform = || {
                *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (*seed >> 11) as f64 / (1_u64 << 53) as f64
            };
            (0..12).map(|_| uniform()).sum::<f64>() - 6.0
        };
        let alike = alike_within(spacing, length);
        let mut rough = draw();
        let mut heights = Vec::new();
        for _ in 0..count {
            heights.push(rough);
            rough = alike * rough + (1.0 - alike * alike).sqrt() * draw();
        }
        heights
    }

    /// Mean variance over 60 profiles of 40 points from 1.9 to 3.1 contact radii, and mean covariance of two
    /// heights at 0.1 radii, of noise of variance 1 on the end of a pile-up of 100.
    fn told(length: f64) -> [f64; 2] {
        let mut seed = 7;
        let mut means = [0.0; 2];
        for _ in 0..60 {
            let rough = noise(&mut seed, 0.03, length, 40);
            let points: Vec<[f64; 2]> = (0..40)
                .map(|i| 1.91 + 0.03 * f64::from(i))
                .zip(&rough)
                .map(|(r, rough)| [r, rough + 100.0 * tail(r, 1.0) + 2.0 - 3.0 * r])
                .collect();
            let far = far_field(&points, 1.0, None).unwrap();
            for (mean, distance) in means.iter_mut().zip([0.0, 0.1]) {
                *mean += far.parts.iter().map(|part| part.covariance(distance)).sum::<f64>() / 60.0;
            }
        }
        means
    }

    /// The smooth terms take three quarters of the variance of a noise that is alike over a quarter of the
    /// far field: a sum of squares over the degrees of freedom tells 0.25.
    #[test]
    fn noise_that_is_alike_is_not_taken_for_the_end_of_the_pile_up() {
        let [variance, beside] = told(0.3);
        assert!((0.6..1.7).contains(&variance), "{variance}");
        assert!((0.5..1.4).contains(&beside), "{beside}");
    }

    /// A profile through the axis: each side has its own offset, tilt and end of the pile-up, and both tell
    /// of one noise. Half of the mean square of differences at 0.1 radii, where it is alike over as much, is
    /// 1 - 1/e; lengths that are nearly an offset, which nothing excludes, do not count in it.
    #[test]
    fn both_sides_of_a_profile_tell_of_one_noise() {
        let mut seed = 3;
        let (mut half_square, profiles) = (0.0, 40);
        for _ in 0..profiles {
            let [left, right] = [(); 2].map(|()| noise(&mut seed, 0.03, 0.1, 40));
            let place = |i: usize| 1.91 + 0.03 * i as f64;
            let right: Vec<[f64; 2]> =
                (0..40).map(|i| [place(i), right[i] + 60.0 * tail(place(i), 1.0) + 5.0]).collect();
            let left = (0..40).rev().map(|i| [-place(i), left[i] + 90.0 * tail(place(i), 1.0) + place(i)]);
            let points: Vec<[f64; 2]> = left.chain(right).collect();
            let far = far_field(&points, 1.0, None).unwrap();
            assert_eq!(far.freedom, 74.0);
            let of = |part: &NoisePart| part.covariance(0.0) - part.covariance(0.1);
            half_square += far.parts.iter().map(of).sum::<f64>() / f64::from(profiles);
        }
        assert!((half_square / (1.0 - (-1.0_f64).exp()) - 1.0).abs() < 0.2, "{half_square}");
    }

    /// Both sides of an imprint under the same places, each reading with its own noise.
    #[test]
    fn two_readings_at_one_place_are_two() {
        let mut seed = 11;
        let rough = noise(&mut seed, 1.0, 0.0, 80);
        let points: Vec<[f64; 2]> =
            rough.iter().enumerate().map(|(i, z)| [1.91 + 0.03 * (i / 2) as f64, *z]).collect();
        let far = far_field(&points, 1.0, None).unwrap();
        let variance: f64 = far.parts.iter().map(|part| part.variance).sum();
        assert!((0.6..1.6).contains(&variance), "{far:?}");
    }

    /// A mixture over lengths holds long ones that short noise does not exclude: they are nearly an offset.
    #[test]
    fn noise_that_is_not_alike_is_told_as_such() {
        let [variance, beside] = told(0.0);
        assert!((0.9..1.6).contains(&variance), "{variance}");
        assert!(beside < 0.5, "{beside}");
    }
}
