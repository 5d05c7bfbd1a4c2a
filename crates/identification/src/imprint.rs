//! The imprint that a tool leaves: the residual surface of finite elements, the profile that was measured,
//! and how far the two may differ.
//!
//! Loading and unloading of one sharp cone leave one direction in (σ_y, n) open; the pile-up closes it (Jiao
//! and Vlassak 2024). Heights stand over the deepest depth h, places over the contact radius a under load: so
//! a profile varies smoothly with the metal, and that of a sharp cone does not depend on the depth.

use crate::far_field::{FAR_RADII, FarField, MIN_FAR_POINTS, NoisePart, apart, far_field};
use crate::interpolation::{alike, linear_between, smooth};
use crate::rings::{Ring, noise_of_means};
use asperity_simulation::scene::Accuracy;
use nalgebra::DMatrix;

/// Places over the contact radius at which a computed profile is read: close beside the rim, where it bends.
pub const PLACES: [f64; 36] = [
    0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.78, 0.84, 0.88, 0.91, 0.94, 0.965, 0.985, 1.0, 1.015, 1.03,
    1.045, 1.06, 1.08, 1.1, 1.13, 1.16, 1.2, 1.25, 1.3, 1.37, 1.45, 1.55, 1.7, 1.9, 2.2, 2.6, 3.2, 4.0,
];

/// Numbers of a computed imprint: ln(a/h), then the heights over h at [`PLACES`].
pub const NUMBERS: usize = 1 + PLACES.len();

/// Standard deviation over the depth that is taken where the far field tells none.
const ASSUMED_NOISE_SHARE: f64 = 0.02;
/// Least standard deviation over the depth: no instrument and no metal is smoother.
const MIN_NOISE_SHARE: f64 = 1e-3;
/// Standard deviations of what levelling leaves: an offset, and a tilt over one contact radius, over the
/// depth.
const LEVELLING_SHARE: f64 = 0.005;
/// Contact radii within which an imprint is a hole, and the share of the depth that it has at least there.
const INNER_RADII: f64 = 0.3;
const LEAST_DEPTH_SHARE: f64 = 0.05;
/// Least radius of a ring over that of the far field: about a patch of roughness, which a smaller ring does
/// not average.
const LEAST_RING_SHARE: f64 = 0.01;
/// Points that are kept of a profile.
const KEPT_POINTS: usize = 90;
/// Farthest place that is compared, contact radii: that to which the computed profiles reach.
pub const FARTHEST_RADII: f64 = PLACES[PLACES.len() - 1];
/// Contact radii over which an error of the finite elements is alike, along flank and pile-up.
const ALIKE_RADII: f64 = 0.25;
/// Standard deviation over the depth of a height by finite elements at `standard` under a sharp cone; twice
/// that under other tools, whose meshes are no similar ones, and twice that again at `draft`.
///
/// Measured against `reference` on ten metals (E/σ_y 100 to 600, n to 0.3) under a cone of 70.3° and on
/// twelve under balls to a/R 0.37: rms of 0.0003 to 0.0006 (cones) and 0.0005 to 0.0012 (balls) at
/// `standard`, 0.0003 to 0.0009 and 0.0009 to 0.0018 at `draft`, but for the rim.
const HEIGHT_ERROR: f64 = 5e-4;
/// Error of the rim over that elsewhere, the contact radii over which it falls, and those over which it is
/// alike: an element there is longer than the bend.
///
/// Measured on the same: rms within 0.05 contact radii of 0.002 and 0.0054 at `standard`, 0.004 and 0.016 at
/// `draft`, with a correlation of one half over 0.01 (cones) and 0.03 contact radii (balls).
const RIM_FACTOR: f64 = 6.0;
const RIM_RADII: f64 = 0.04;
const RIM_ALIKE_RADII: f64 = 0.02;
/// Contact radii beside the rim within which a surface is taken as straight between its points.
const BENT_RADII: f64 = 0.12;
/// Errors of the numbers of an imprint over that of a height: of the highest point, of the lowest one, of
/// the logarithm of the rim's radius.
///
/// Measured on the same: 2 to 6, 0.4 to 0.8, 16 to 23.
pub const ERRORS_OF_NUMBERS: [f64; 3] = [5.0, 1.0, 20.0];

/// A measured profile made ready.
#[derive(Clone, Debug, PartialEq)]
pub struct Imprint {
    /// Place (m, negative on the other side of the axis) and height above the far field (m).
    pub points: Vec<[f64; 2]>,
    /// Places (m) of the readings of which each point is the mean: about the rim, where the surface bends,
    /// the mean of heights is not the height at the mean place.
    pub places: Vec<Vec<f64>>,
    /// Noise of a height, a sum of parts that are alike over a length each.
    pub noise: Vec<NoisePart>,
    /// Degrees of freedom of the noise where the far field tells it; `None` where it is stated or assumed.
    pub noise_freedom: Option<f64>,
    /// Distance from the axis (m) at which heights that are means over rings have that noise, of a map whose
    /// far field tells it or how it is alike; `None` where all heights have it.
    pub ring: Option<f64>,
    /// Remarks.
    pub notes: Vec<String>,
}

/// Noise of a profile as a person states it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StatedNoise {
    /// Standard deviation of a height, of a map of one of its heights, m.
    pub noise: Option<f64>,
    /// Distance over which heights are off alike, m.
    pub correlation_length: Option<f64>,
}

impl Imprint {
    /// Makes `points` (place and height, m) ready for an imprint of about the contact radius `radius`; they
    /// are those of one line, or the means of as many `rings` of a map.
    ///
    /// # Errors
    /// The fault of the profile, with a way out.
    pub fn new(
        (points, rings): (&[[f64; 2]], &[Ring]),
        radius: f64,
        depth: f64,
        stated: StatedNoise,
    ) -> Result<Imprint, String> {
        let are_means = !rings.is_empty();
        let with_rings = points.iter().enumerate().map(|(i, p)| (*p, rings.get(i).copied()));
        let is_within =
            |p: &[f64; 2]| p.iter().all(|x| x.is_finite()) && p[0].abs() <= FARTHEST_RADII * radius;
        let mut with_rings: Vec<_> = with_rings.filter(|(p, _)| is_within(p)).collect();
        with_rings.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
        let points: Vec<[f64; 2]> = with_rings.iter().map(|(p, _)| *p).collect();
        if points.len() < MIN_FAR_POINTS {
            return Err(format!(
                "has {} points within {:.3} um of the axis, too few for an imprint: give r (0 on the axis) and z of the surface after unloading",
                points.len(),
                1e6 * FARTHEST_RADII * radius
            ));
        }
        let reach = points.iter().map(|p| p[0].abs()).fold(0.0, f64::max);
        if reach < 1.2 * radius {
            return Err(format!(
                "ends {:.3} um from the axis, within the contact of about {:.3} um: pile-up stands outside it; give the profile out to three radii",
                1e6 * reach,
                1e6 * radius
            ));
        }
        // the bottom of a hole may be where nothing was measured
        let within = |radii: f64| -> Vec<f64> {
            points.iter().filter(|p| p[0].abs() < radii * radius).map(|p| p[1]).collect()
        };
        let Some(inner) = [INNER_RADII, 1.0].map(within).into_iter().find(|inner| !inner.is_empty()) else {
            return Err(format!(
                "has no height within the contact of about {:.3} um: the imprint itself is missing, or its places do not count from its middle",
                1e6 * radius
            ));
        };
        let middle = inner.iter().sum::<f64>() / inner.len() as f64;
        if middle >= -LEAST_DEPTH_SHARE * depth {
            return Err(format!(
                "lies about the axis at {:.4} um on average, and not below 0: heights z count up from the far field, the imprint lies below it, places r from its middle; where they count down say imprint = {{ file = …, z_down = true }}",
                1e6 * middle
            ));
        }
        let stretch = points.len().div_ceil(KEPT_POINTS);
        let of_a_stretch = |part: &[([f64; 2], Option<Ring>)]| {
            part.iter().filter_map(|(_, ring)| *ring).fold(Ring::default(), |all, ring| all.with(&ring))
        };
        let rings: Vec<Ring> = with_rings.chunks(stretch).map(of_a_stretch).collect();
        let stretches = points.chunks(stretch);
        let places = stretches.clone().map(|part| part.iter().map(|p| p[0]).collect()).collect();
        let points: Vec<[f64; 2]> = stretches.map(mean).collect();
        let mut notes = Vec::new();
        let of_rings = noise_of_means(&rings, radius, stated.correlation_length);
        let far = of_rings.or_else(|| far_field(&points, radius, stated.correlation_length));
        if far.is_none() && stated.noise.is_none() {
            notes.push(format!(
                "the imprint has fewer than {MIN_FAR_POINTS} points beyond {FAR_RADII} contact radii that would tell its noise: {} % of the depth is taken; state it",
                100.0 * ASSUMED_NOISE_SHARE
            ));
        }
        Ok(Imprint {
            noise: noise(far.as_ref(), stated, depth),
            noise_freedom: far.as_ref().filter(|_| stated.noise.is_none()).map(|far| far.freedom),
            ring: far
                .filter(|far| far.of_one_height.is_some() || are_means && stated.noise.is_none())
                .map(|far| far.place),
            points,
            places,
            notes,
        })
    }

    /// The heights (m) that a surface of this `height` at a place (m) has where the points are.
    pub fn read(&self, height: impl Fn(f64) -> f64) -> Vec<f64> {
        let mean = |places: &Vec<f64>| places.iter().map(|r| height(*r)).sum::<f64>() / places.len() as f64;
        self.places.iter().map(mean).collect()
    }

    /// Standard deviation of a height by noise, m.
    pub fn deviation(&self) -> f64 {
        self.noise.iter().map(|part| part.variance).sum::<f64>().sqrt()
    }

    /// Noise at `place` over that of the far field: a ring holds as many patches of roughness as it is long,
    /// so that the variance of its mean is as the inverse of its radius.
    fn of_a_ring(&self, place: f64) -> f64 {
        self.ring.map_or(1.0, |ring| (ring / place.abs().max(LEAST_RING_SHARE * ring)).sqrt())
    }

    /// Covariance of the heights over `depth` by noise and levelling, and what an error of the finite
    /// elements with a variance of 1 adds, for a contact of the radius `radius`.
    pub fn covariances(&self, radius: f64, depth: f64) -> [DMatrix<f64>; 2] {
        let count = self.points.len();
        let pair = |of: &dyn Fn(f64, f64, f64) -> f64| {
            DMatrix::from_fn(count, count, |i, j| {
                let [a, b] = [i, j].map(|k| self.points[k][0]);
                of(a, b, apart(i, j, [a, b]))
            })
        };
        let noise = pair(&|a, b, apart| {
            let together =
                self.noise.iter().map(|part| part.covariance(apart)).sum::<f64>() / (depth * depth);
            let levelling = LEVELLING_SHARE.powi(2) * (1.0 + a * b / (radius * radius));
            self.of_a_ring(a) * self.of_a_ring(b) * together + levelling
        });
        // on both sides of the axis the finite elements are off alike
        let model = pair(&|a, b, _| {
            let apart = (a.abs() - b.abs()) / radius;
            let [at_a, at_b] = [a, b].map(|place| of_the_rim(place.abs() / radius));
            alike(apart, ALIKE_RADII) + at_a * at_b * alike(apart, RIM_ALIKE_RADII)
        });
        [noise, model]
    }
}

/// Error of a height near the rim beside that of all heights, over the latter, at `place` over
/// the contact radius.
fn of_the_rim(place: f64) -> f64 {
    RIM_FACTOR * alike(place - 1.0, RIM_RADII)
}

/// The error of each number of a computed imprint over that of a height far from the rim.
pub fn error_sizes() -> [f64; NUMBERS] {
    let mut sizes = [1.0; NUMBERS];
    for (size, place) in sizes[1..].iter_mut().zip(PLACES) {
        *size = of_the_rim(place).hypot(1.0);
    }
    sizes
}

/// The noise of heights over an imprint of `depth`: as it is stated, else as the far field tells it, else
/// assumed.
fn noise(far: Option<&FarField>, stated: StatedNoise, depth: f64) -> Vec<NoisePart> {
    let told = far.map_or_else(Vec::new, |far| far.parts.clone());
    let sum = told.iter().map(|part| part.variance).sum::<f64>();
    let assumed = if far.is_none() { ASSUMED_NOISE_SHARE * depth } else { sum.sqrt() };
    // the stated noise of one height shrinks in the mean of a ring as the noise that is seen does
    let shown = far.and_then(|far| far.of_one_height).filter(|shown| *shown > 0.0);
    let shrinks = shown.map_or(1.0, |shown| (sum / shown).sqrt());
    let given = stated.noise.map(|noise| shrinks * noise);
    let deviation = given.unwrap_or(assumed).max(MIN_NOISE_SHARE * depth);
    let variance = deviation * deviation;
    if sum <= f64::MIN_POSITIVE * 1e3 {
        return vec![NoisePart { variance, length: stated.correlation_length.unwrap_or(0.0) }];
    }
    told.into_iter().map(|part| NoisePart { variance: part.variance * variance / sum, ..part }).collect()
}

/// Relative 95 % errors of a computed imprint at `accuracy`, as those of a response stand, of a tool that is
/// `similar` to itself at every depth or is not.
pub fn errors(accuracy: Accuracy, similar: bool) -> [f64; 3] {
    let coarse = if accuracy == Accuracy::Draft { 2.0 } else { 1.0 };
    let alone = if similar { 1.0 } else { 2.0 };
    [2.0 * coarse * alone * HEIGHT_ERROR, 0.0, 0.0]
}

/// The mean of a stretch of points.
fn mean(part: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| part.iter().map(|p| p[k]).sum::<f64>() / part.len() as f64)
}

/// The numbers of an imprint from `points` (r, z) of the surface after unloading and the contact `radius`
/// under load, all over the depth; `None` where nothing touched.
pub fn numbers(mut points: Vec<[f64; 2]>, radius: f64) -> Option<Vec<f64>> {
    if radius.is_nan() || radius <= 0.0 {
        return None;
    }
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points.dedup_by(|a, b| a[0] == b[0]);
    let far = points.last()?[1];
    let heights = PLACES.iter().map(|place| height_between(&points, place * radius, *place) - far);
    Some(std::iter::once(radius.ln()).chain(heights).collect())
}

/// Contact radius over the depth of a computed imprint.
pub fn radius_over_depth(numbers: &[f64]) -> f64 {
    numbers[0].exp()
}

/// Height over the depth of a computed imprint at a place, a distance from the axis over the depth.
pub fn surface(numbers: &[f64]) -> impl Fn(f64) -> f64 + use<> {
    let radius = radius_over_depth(numbers);
    let points: Vec<[f64; 2]> = PLACES.iter().zip(&numbers[1..]).map(|(place, z)| [*place, *z]).collect();
    move |place| {
        let place = (place.abs() / radius).min(FARTHEST_RADII);
        height_between(&points, place, place)
    }
}

/// Height at `x` between `points` of a surface, which is `place` contact radii from the axis: a cubic, as
/// hole and far field bend smoothly, but about the rim, where a cubic would swing.
fn height_between(points: &[[f64; 2]], x: f64, place: f64) -> f64 {
    if (place - 1.0).abs() < BENT_RADII { linear_between(points, x) } else { smooth(points, x) }
}

/// Height of the highest point, depth of the lowest one, and place of the highest one of a computed imprint,
/// all over the depth.
pub fn outstanding(numbers: &[f64]) -> [f64; 3] {
    let heights = &numbers[1..];
    let top = (0..heights.len()).max_by(|a, b| heights[*a].total_cmp(&heights[*b])).unwrap_or(0);
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    [heights[top], -lowest, PLACES[top] * radius_over_depth(numbers)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone of depth 1 and radius 3 with a rim of 0.1, heights in micrometres.
    fn profile(r: f64) -> f64 {
        if r < 3.0 { r / 3.0 * 1.1 - 1.0 } else { 0.1 * (-(r - 3.0)).exp() }
    }

    #[test]
    fn a_computed_surface_is_read_back_between_its_places() {
        let points = (0..2000).map(|i| 0.01 * f64::from(i)).map(|r| [r, profile(r)]).collect();
        let numbers = numbers(points, 3.0).unwrap();
        assert_eq!(numbers.len(), NUMBERS);
        let read = surface(&numbers);
        for r in [0.0, 1.7, 2.9, 3.0, 3.2, 5.0, 9.0] {
            // straight lines between the places leave a thousandth of the depth of the bent pile-up
            assert!((read(r) - profile(r)).abs() < 2e-3, "{r}: {}", read(r));
        }
        let [pile_up, residual, rim] = outstanding(&numbers);
        assert!((pile_up - 0.1).abs() < 1e-3 && (residual - 1.0).abs() < 1e-6 && (rim - 3.0).abs() < 1e-9);
    }

    /// The hole of a ball is round: straight lines between nodes a twentieth and places a tenth of the
    /// contact apart would leave 0.003 of the depth, more than finite elements are off.
    #[test]
    fn the_round_hole_of_a_ball_is_read_back() {
        let round = |r: f64| (0.5 * r * r).min(1.0) - 1.0;
        let points = (0..200).map(|i| 0.07 * f64::from(i)).map(|r| [r, round(r)]).collect();
        let read = surface(&numbers(points, 2f64.sqrt()).unwrap());
        for r in [0.03, 0.21, 0.5, 0.77, 1.2] {
            assert!((read(r) - round(r)).abs() < 1e-4, "{r}: {}", read(r));
        }
    }

    /// A profile of four readings a kept point: the surface that it is of is what is read of it, at the rim
    /// too.
    #[test]
    fn means_over_a_bent_rim_are_compared_with_means() {
        let points: Vec<[f64; 2]> =
            (0..360).map(|i| 0.0247e-6 * f64::from(i)).map(|r| [r, 1e-6 * profile(1e6 * r)]).collect();
        let imprint = Imprint::new((&points, &[]), 3e-6, 1e-6, StatedNoise::default()).unwrap();
        assert!(imprint.points.len() < 100);
        let read = imprint.read(|r| 1e-6 * profile(1e6 * r));
        let worst = |model: &dyn Fn(usize) -> f64| {
            imprint.points.iter().enumerate().map(|(k, p)| (p[1] - model(k)).abs()).fold(0.0, f64::max)
        };
        let at_the_mean = worst(&|k| 1e-6 * profile(1e6 * imprint.points[k][0]));
        assert!(
            worst(&|k| read[k]) < 1e-18 && at_the_mean > 1e-9,
            "{at_the_mean:e} {:e}",
            worst(&|k| read[k])
        );
    }

    #[test]
    fn a_profile_that_is_no_imprint_is_refused_with_a_way_out() {
        let points = |factor: f64, reach: i32| -> Vec<[f64; 2]> {
            (0..reach).map(|i| 0.1 * f64::from(i)).map(|r| [1e-6 * r, factor * 1e-6 * profile(r)]).collect()
        };
        let refused = |points: &[[f64; 2]], word: &str| {
            let error = Imprint::new((points, &[]), 3e-6, 1e-6, StatedNoise::default()).unwrap_err();
            assert!(error.contains(word), "{error}");
        };
        refused(&points(-1.0, 90), "z_down = true");
        refused(&points(1.0, 25), "three radii");
        refused(&points(1.0, 4), "too few");
        let imprint = Imprint::new((&points(1.0, 45), &[]), 3e-6, 1e-6, StatedNoise::default()).unwrap();
        assert!(imprint.notes[0].contains("state it"), "{:?}", imprint.notes);
    }

    #[test]
    fn a_hole_without_a_bottom_is_compared_and_none_is_not() {
        let beyond = |least: f64| {
            let places = (0..90).map(|i| 0.1 * f64::from(i)).filter(|r| *r > least);
            let points: Vec<[f64; 2]> = places.map(|r| [1e-6 * r, 1e-6 * profile(r)]).collect();
            Imprint::new((&points, &[]), 3e-6, 1e-6, StatedNoise::default())
        };
        assert!(beyond(1.5).is_ok());
        assert!(beyond(3.1).unwrap_err().contains("the imprint itself is missing"));
    }

    /// A ring of a quarter of the far radius has a quarter of its patches, hence twice the noise;
    /// a line has the same everywhere, and so has noise that was stated.
    #[test]
    fn the_mean_over_a_small_ring_scatters_more() {
        let points: Vec<[f64; 2]> = (0..90)
            .map(|i| (0.1 * f64::from(i), if i % 2 == 0 { 1e-9 } else { -1e-9 }))
            .map(|(r, rough)| [1e-6 * r, 1e-6 * profile(r) + rough])
            .collect();
        // rings of which not one sector is filled leave the noise to the line of means
        let rings = vec![Ring::default(); points.len()];
        let noise = |are_means: bool, stated: StatedNoise| {
            let rings = if are_means { &rings[..] } else { &[] };
            let imprint = Imprint::new((&points, rings), 3e-6, 1e-6, stated).unwrap();
            let ring = imprint.ring.unwrap_or(7e-6);
            imprint.of_a_ring(0.25 * ring) / imprint.of_a_ring(ring)
        };
        assert!((noise(true, StatedNoise::default()) - 2.0).abs() < 1e-12);
        assert_eq!(noise(false, StatedNoise::default()), 1.0);
        assert_eq!(noise(true, StatedNoise { noise: Some(1e-9), correlation_length: None }), 1.0);
    }
}
