//! One measurement: what was measured, what the finite elements expect, and how far the two may differ.

use super::emulator::{Emulator, by_the_atlas};
use super::imprint::{self, Imprint};
use super::interpolation::smooth;
use super::parameters::{Slot, Unknowns};
use super::pyramid::Pyramid;
use super::response::{DesignPoint, Geometry, NUMBERS_AFTER_LOADING};
use crate::measured_curve::Measured;
use asperity_calibration::indentation::FORCES;
use asperity_material::{Elastic, StressMeasure};
use asperity_simulation::scene::Friction;
use nalgebra::{Cholesky, DMatrix, Dyn};

/// Measured values, SI.
#[derive(Clone, Debug)]
pub enum Data {
    /// Numbers of a curve.
    Features {
        /// F/h² of the loading, Pa.
        loading_curvature: Option<f64>,
        /// dF/dh where unloading begins, N/m.
        unloading_slope: Option<f64>,
        /// Share of the work that is not returned.
        plastic_work_ratio: Option<f64>,
    },
    /// A curve.
    Curve(Measured),
    /// The imprint after unloading.
    Imprint(Imprint),
    /// Numbers of an imprint.
    ImprintNumbers(ImprintNumbers),
}

/// Numbers of an imprint, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImprintNumbers {
    /// Highest point of the surface above the far field.
    pub pile_up_height: Option<f64>,
    /// Depth of the lowest point below the far field.
    pub residual_depth: Option<f64>,
    /// Radius of the rim, the highest point.
    pub rim_radius: Option<f64>,
}

/// One measurement.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// Its name in messages.
    pub name: String,
    /// Its name in pictures.
    pub label: String,
    /// Number of the measurement, for its own unknowns.
    pub curve: usize,
    /// Body and tool.
    pub geometry: Geometry,
    /// The pyramid whose cone of the same section is its geometry.
    pub pyramid: Option<Pyramid>,
    /// Elasticity of the tool; `None`: rigid.
    pub tool: Option<Elastic>,
    /// Radius of the tip where it is known, m.
    pub tip_radius: f64,
    /// Compliance of the machine where it is known, m/N.
    pub compliance: f64,
    /// Friction of the tool where it is known; `None`: smooth.
    pub friction: Option<Friction>,
    /// True where the friction is sought.
    pub friction_sought: bool,
    /// Deepest depth, m; 1 where nothing hangs on it.
    pub depth: f64,
    /// Of an imprint: the peak force, where a curve tells it, N.
    pub imprint_force: Option<f64>,
    /// The stress that yields.
    pub stress_measure: StressMeasure,
    /// The data.
    pub data: Data,
    /// Relative standard deviation of the force.
    pub noise: f64,
    /// True where that was given, and not taken from the scatter.
    pub noise_given: bool,
    /// Correlation of the noise of neighbouring points of a curve.
    pub noise_correlation: f64,
    /// Relative standard deviation of what the model leaves out, beside that of a pyramid's correction.
    pub model_error: f64,
    /// Relative 95 % errors of the finite elements: loading, slope, way back.
    pub errors: [f64; 3],
    /// The answers to be expected.
    pub emulator: Emulator,
}

/// Logarithms of the depth over which the force that a body is expected to need is too large or too small
/// alike. That of a sharp cone is one number, K, off alike at every depth.
const ALIKE_LOG_DEPTH: f64 = 1.0;
/// Share of the deepest depth from which finite elements state the error of the force along a curve; below
/// it, where fewer elements touch, the error of a body grows as the inverse of the depth.
const STATED_DEPTH_SHARE: f64 = 0.2;
/// Shares of the peak force over which the error of the shape of the way back is alike, and its standard
/// deviation over that of the whole way: a way back is read at few forces, at a few steps.
const ALIKE_FORCE_SHARE: f64 = 0.25;
const WAY_SHAPE_SHARE: f64 = 0.5;

/// Shares of the deepest depth: room beside the depths of first touch to which the laws of a tool point, the
/// farthest of them, and that from which a sharp tool is doubted.
const TOUCH_ROOM: f64 = 0.08;
const FARTHEST_TOUCH: f64 = 0.24;
const DOUBTED_TOUCH: f64 = 0.03;

/// Effect on the difference at a point of a curve of errors of the expected force and of the way back.
struct ErrorOfAPoint {
    /// Logarithm of the depth over the deepest; the way back begins there.
    place: f64,
    /// Of a relative error of the force.
    by_the_force: f64,
    /// Of a relative error of the slope where unloading begins, and of the whole way back.
    by_the_way: [f64; 2],
    /// Share of the peak force.
    share: f64,
}

/// Covariance of the differences of a measurement: what belongs to the data, and what each relative error of
/// the finite elements adds for a variance of 1.
#[derive(Clone, Debug)]
pub struct Covariance {
    noise: DMatrix<f64>,
    /// Of an error of the force, of the slope where unloading begins, of the way back.
    model: [DMatrix<f64>; 3],
}

impl Covariance {
    /// That of data of which one error of the finite elements is known alone.
    fn of_the_first(noise: DMatrix<f64>, model: DMatrix<f64>) -> Covariance {
        let none = DMatrix::zeros(noise.nrows(), noise.ncols());
        Covariance { model: [model, none.clone(), none], noise }
    }

    /// The factor of the covariance with the model's standard deviations; `None` where it has none.
    pub fn factor(&self, deviations: [f64; 3]) -> Option<Cholesky<f64, Dyn>> {
        self.sum(deviations).cholesky()
    }

    fn sum(&self, deviations: [f64; 3]) -> DMatrix<f64> {
        let mut sum = self.noise.clone();
        for (part, deviation) in self.model.iter().zip(deviations) {
            sum.zip_apply(part, |entry, more| *entry += deviation * deviation * more);
        }
        sum
    }
}

/// Correlation of two places a distance `apart` of each other.
fn alike(apart: f64, length: f64) -> f64 {
    (-0.5 * (apart / length).powi(2)).exp()
}

/// Predicted values of a measurement.
struct Expected {
    /// E for the contact.
    modulus: f64,
    logarithms: Vec<f64>,
    contact_depth: f64,
    compliance: f64,
}

impl Experiment {
    /// The question to the finite elements at `point`; `None` where there is no metal.
    pub fn design_point(&self, unknowns: &Unknowns, point: &[f64]) -> Option<DesignPoint> {
        let metal = unknowns.metal(point)?;
        let own = metal.elastic.reduced_modulus();
        let together = self.tool.map_or(own, |tool| 1.0 / (1.0 / own + 1.0 / tool.reduced_modulus()));
        Some(DesignPoint {
            geometry: self.geometry.clone(),
            depth: self.depth,
            modulus: metal.elastic.youngs_modulus * together / own,
            metal,
            tip_radius: unknowns.unknown_value(point, Slot::TipRadius(self.curve)).unwrap_or(self.tip_radius),
            stress_measure: self.stress_measure,
            friction: unknowns
                .unknown_value(point, Slot::Friction(self.curve))
                .map_or(self.friction, |coefficient| Some(Friction::Coefficient(coefficient))),
            imprint: self.is_imprint(),
        })
    }

    /// True where the imprint was measured.
    pub fn is_imprint(&self) -> bool {
        matches!(self.data, Data::Imprint(_) | Data::ImprintNumbers(_))
    }

    /// True where the atlas of sharp cones is the trend: curves and their numbers under one, smooth or of known
    /// friction.
    pub fn is_sharp(&self) -> bool {
        matches!(self.geometry, Geometry::Sharp { .. }) && !self.is_imprint() && !self.friction_sought
    }

    /// True where a sharp cone has friction, of which the atlas knows nothing: what finite elements answer
    /// shifts all that the atlas expects.
    pub fn shifts_the_atlas(&self) -> bool {
        self.is_sharp() && self.friction.and_then(Friction::law).is_some()
    }

    /// True where the loading is one number, K, by similarity.
    fn is_similar(&self) -> bool {
        matches!(self.geometry, Geometry::Sharp { .. })
    }

    /// Numbers of the loading in a response.
    pub fn of_the_loading(&self) -> usize {
        if self.is_imprint() { 1 } else { self.geometry.shares().len() }
    }

    fn expected(&self, unknowns: &Unknowns, point: &[f64], roughly: bool) -> Option<Expected> {
        let question = self.design_point(unknowns, point)?;
        let mut logarithms = if roughly && !question.imprint {
            by_the_atlas(&question)
        } else {
            self.emulator.predict(&question)
        };
        if let Some(pyramid) = self.pyramid {
            pyramid.correct(&question, &mut logarithms, self.of_the_loading());
        }
        let own = |slot, known| unknowns.unknown_value(point, slot).unwrap_or(known);
        Some(Expected {
            modulus: question.modulus,
            logarithms,
            contact_depth: own(Slot::ContactDepth(self.curve), 0.0),
            compliance: own(Slot::Compliance(self.curve), self.compliance),
        })
    }

    /// Measured less expected, each over what it is measured in: logarithms of forces and slopes, shares of
    /// the work, depths of unloading over the deepest. `roughly`: by the atlas of cones alone.
    pub fn differences(&self, unknowns: &Unknowns, point: &[f64], roughly: bool) -> Option<Vec<f64>> {
        if roughly && self.is_imprint() {
            return Some(Vec::new());
        }
        let expected = self.expected(unknowns, point, roughly)?;
        Some(match &self.data {
            Data::Features { loading_curvature, unloading_slope, plastic_work_ratio } => {
                let [curvature, slope, plastic] = self.features(&expected);
                let logarithm = |data: &Option<f64>, model: f64| data.map(|d| (d / model).ln());
                let all = [
                    logarithm(loading_curvature, curvature),
                    logarithm(unloading_slope, slope),
                    plastic_work_ratio.map(|data| (data - plastic) / data),
                ];
                all.into_iter().flatten().collect()
            }
            Data::Curve(measured) => {
                let load = measured.loading.iter().map(|p| {
                    let model = self.force(&expected, p[0] - expected.contact_depth, p[1]);
                    (p[1] / model).ln()
                });
                let back = measured
                    .unloading
                    .iter()
                    .map(|p| (p[0] - self.depth_back(&expected, measured.turn(), p[1])) / self.depth);
                load.chain(back).collect()
            }
            Data::Imprint(imprint) => {
                let depth = self.true_depth(&expected);
                let model = |r: f64| depth * imprint::height(&expected.logarithms, r / depth);
                imprint.points.iter().map(|[r, z]| (z - model(*r)) / self.depth).collect()
            }
            Data::ImprintNumbers(numbers) => {
                let depth = self.true_depth(&expected);
                let [pile_up, residual, rim] = imprint::outstanding(&expected.logarithms).map(|x| depth * x);
                let over = |data: Option<f64>, model: f64| data.map(|d| (d - model) / self.depth);
                let logarithm = |data: Option<f64>, model: f64| data.map(|d| (d / model).ln());
                let all = [
                    over(numbers.pile_up_height, pile_up),
                    over(numbers.residual_depth, residual),
                    logarithm(numbers.rim_radius, rim),
                ];
                all.into_iter().flatten().collect()
            }
        })
    }

    /// The depth from contact of an imprint: what the machine and first touch take is no imprint.
    fn true_depth(&self, expected: &Expected) -> f64 {
        let peak = self.imprint_force.unwrap_or(0.0);
        (self.depth - expected.contact_depth - expected.compliance * peak).max(0.1 * self.depth)
    }

    /// Loading curvature (Pa), unloading slope (N/m) and plastic share that are expected.
    fn features(&self, expected: &Expected) -> [f64; 3] {
        let loading = self.of_the_loading();
        let [curvature, slope, share] =
            [loading - 1, loading, loading + 1].map(|i| expected.logarithms[i].exp());
        let (curvature, slope) = (expected.modulus * curvature, expected.modulus * self.depth * slope);
        // the machine takes its part of the depth
        let longer = 1.0 + expected.compliance * curvature * self.depth;
        [curvature / (longer * longer), slope / (1.0 + expected.compliance * slope), 1.0 - share]
    }

    /// Force expected at a reading of the depth from contact, under the force that was measured there.
    fn force(&self, expected: &Expected, reading: f64, force: f64) -> f64 {
        let depth = (reading - expected.compliance * force).max(1e-4 * self.depth);
        let shares = self.geometry.shares();
        let points: Vec<[f64; 2]> =
            shares.iter().zip(&expected.logarithms).map(|(s, l)| [s.ln(), *l]).collect();
        expected.modulus * depth * depth * smooth(&points, (depth / self.depth).ln()).exp()
    }

    /// Reading of the depth expected on the way back at `force`, from a turn of which the depths where the
    /// loading ended and where the way back began were read under a force.
    ///
    /// A hold between them makes the contact wider under the same force. The slope where unloading begins
    /// goes with the width, so with the depth; the whole way with the force over it.
    fn depth_back(&self, expected: &Expected, [loaded, turned, held]: [f64; 3], force: f64) -> f64 {
        let less = expected.contact_depth + expected.compliance * held;
        let (loaded, top) = (loaded - less, turned - less);
        let loading = &expected.logarithms[..self.of_the_loading()];
        let curvature = loading.last().map_or(0.0, |l| l.exp());
        let most = expected.modulus * loaded * loaded * curvature;
        let way = recovery(&expected.logarithms, force / most) * (loaded / top).powi(2);
        top - way * self.depth + expected.contact_depth + expected.compliance * force
    }

    /// The curve expected at `point`: readings of depth and force, loading then unloading.
    pub fn curve(&self, unknowns: &Unknowns, point: &[f64], peak: [f64; 2]) -> Option<[Vec<[f64; 2]>; 2]> {
        let expected = self.expected(unknowns, point, false)?;
        let top = peak[0] - expected.contact_depth;
        let load = (1..=60).map(|i| {
            let depth = top * f64::from(i) / 60.0;
            let mut force = self.force(&expected, depth, 0.0);
            for _ in 0..20 {
                force = 0.5 * (force + self.force(&expected, depth, force));
            }
            [depth + expected.contact_depth, force]
        });
        let load: Vec<[f64; 2]> = load.collect();
        let most = load.last().map_or(0.0, |p| p[1]);
        let back = (0..=40).rev().map(|i| {
            let force = most * f64::from(i) / 40.0;
            [self.depth_back(&expected, [peak[0], peak[0], most], force), force]
        });
        let back = back.collect();
        Some([load, back])
    }

    /// Relative standard deviations of what finite elements expect at `point`: of the force, of the slope
    /// where unloading begins, of the way back.
    pub fn model_deviations(&self, unknowns: &Unknowns, point: &[f64]) -> Option<[f64; 3]> {
        let left = self.emulator.left(&self.design_point(unknowns, point)?, self.of_the_loading());
        // the stated errors are 95 % bounds
        Some(std::array::from_fn(|i| (0.5 * self.errors[i]).hypot(left[i]).hypot(self.model_error)))
    }

    /// Heights (m) expected at the places of a measured imprint; `None` without one.
    pub fn imprint_heights(&self, unknowns: &Unknowns, point: &[f64]) -> Option<Vec<f64>> {
        let Data::Imprint(imprint) = &self.data else { return None };
        let left = self.differences(unknowns, point, false)?;
        Some(imprint.points.iter().zip(left).map(|(p, d)| p[1] - d * self.depth).collect())
    }

    /// Covariance of the differences at `point`, in its parts.
    pub fn covariance(&self, unknowns: &Unknowns, point: &[f64]) -> Option<Covariance> {
        let expected = self.expected(unknowns, point, false)?;
        let covariance = match &self.data {
            Data::Features { loading_curvature, unloading_slope, plastic_work_ratio } => {
                let share = 1.0 - self.features(&expected)[2];
                let given = [
                    loading_curvature.map(|_| [1.0, 0.0, 0.0]),
                    unloading_slope.map(|_| [0.0, 1.0, 0.0]),
                    // what is said of the returned work is said of its complement, less
                    plastic_work_ratio.map(|data| [0.0, 0.0, share / data]),
                ];
                let effects: Vec<[f64; 3]> = given.into_iter().flatten().collect();
                let count = effects.len();
                let part = |k: usize| {
                    DMatrix::from_fn(count, count, |i, j| if i == j { effects[i][k].powi(2) } else { 0.0 })
                };
                let noise = DMatrix::identity(count, count) * self.noise.powi(2);
                Covariance { noise, model: [part(0), part(1), part(2)] }
            }
            Data::Curve(measured) => self.covariance_of_a_curve(&expected, measured),
            Data::Imprint(imprint) => {
                let radius = imprint::radius_over_depth(&expected.logarithms) * self.true_depth(&expected);
                let [noise, model] = imprint.covariances(radius, self.depth);
                Covariance::of_the_first(noise, model)
            }
            Data::ImprintNumbers(numbers) => {
                let given = [numbers.pile_up_height, numbers.residual_depth, numbers.rim_radius];
                let scales = [0, 1, 2].map(|k| given[k].map(|d| if k < 2 { d / self.depth } else { 1.0 }));
                let sizes: Vec<f64> = scales.into_iter().flatten().collect();
                let noise = DMatrix::from_diagonal(
                    &sizes.iter().map(|s| (self.noise * s).powi(2)).collect::<Vec<_>>().into(),
                );
                Covariance::of_the_first(noise, DMatrix::identity(sizes.len(), sizes.len()))
            }
        };
        let Some(pyramid) = self.pyramid else { return Some(covariance) };
        // that of the metal at the point: where it grows with the metal, a fit would flee to where it is wide
        let corrected = pyramid.correction(&self.design_point(unknowns, point)?).deviations;
        Some(Covariance { noise: covariance.sum(corrected), ..covariance })
    }

    fn covariance_of_a_curve(&self, expected: &Expected, measured: &Measured) -> Covariance {
        let load = measured.loading.len();
        let length = if self.is_similar() { f64::INFINITY } else { ALIKE_LOG_DEPTH };
        let shallow =
            |share: f64| if self.is_similar() { 1.0 } else { (STATED_DEPTH_SHARE / share).max(1.0) };
        // a force that is expected too large takes from each difference of the loading, and adds to each of
        // the way back
        let of_the_loading = measured.loading.iter().map(|p| {
            let depth = (p[0] / self.depth).abs().max(1e-3);
            let by_the_force = -shallow(depth);
            ErrorOfAPoint { place: depth.ln(), by_the_force, by_the_way: [0.0; 2], share: 1.0 }
        });
        let shares: Vec<f64> = measured.unloading.iter().map(|p| p[1] / measured.peak[1]).collect();
        let slopes: Vec<f64> =
            shares.iter().map(|share| share * slope_back(&expected.logarithms, *share)).collect();
        let of_the_way_back = measured.unloading.iter().zip(&slopes).zip(&shares).map(|((p, slope), s)| {
            let way = (measured.peak[0] - p[0]).max(0.0) / self.depth;
            // near the peak the way is the slope's, at the end the whole
            let by_the_way = [way * s, way * (1.0 - s)];
            ErrorOfAPoint { place: 0.0, by_the_force: *slope, by_the_way, share: *s }
        });
        let errors: Vec<ErrorOfAPoint> = of_the_loading.chain(of_the_way_back).collect();
        let count = errors.len();
        let noise = |i: usize| {
            let of_a_depth = |slope: &f64| (self.noise * slope.max(0.02)).max(1e-5);
            i.checked_sub(load).map_or(self.noise, |back| of_a_depth(&slopes[back]))
        };
        let part = |of_a_pair: &dyn Fn(&ErrorOfAPoint, &ErrorOfAPoint) -> f64| {
            DMatrix::from_fn(count, count, |i, j| of_a_pair(&errors[i], &errors[j]))
        };
        let force = part(&|a, b| alike(a.place - b.place, length) * a.by_the_force * b.by_the_force);
        let slope = part(&|a, b| a.by_the_way[0] * b.by_the_way[0]);
        let whole = part(&|a, b| {
            let way = |e: &ErrorOfAPoint| e.by_the_way[0] + e.by_the_way[1];
            let shape = WAY_SHAPE_SHARE.powi(2) * alike(a.share - b.share, ALIKE_FORCE_SHARE);
            a.by_the_way[1] * b.by_the_way[1] + shape * way(a) * way(b)
        });
        let noise = DMatrix::from_fn(count, count, |i, j| {
            // readings of one stretch are off alike, those of loading and way back are not
            let of_one_stretch = (i < load) == (j < load);
            let steps = i.abs_diff(j) as i32;
            let together = if of_one_stretch { self.noise_correlation.powi(steps) } else { 0.0 };
            noise(i) * noise(j) * together
        });
        Covariance { noise, model: [force, slope, whole] }
    }

    /// Depth readings between which the tool of a curve may first touch, 0 among them: those to which the
    /// laws of the tool point, with room on both sides.
    pub fn touch_range(&self) -> Option<[f64; 2]> {
        let Data::Curve(measured) = &self.data else { return None };
        let [room, farthest] = [TOUCH_ROOM, FARTHEST_TOUCH].map(|share| share * self.depth);
        let touches = self.geometry.loading_powers().map(|power| measured.touches(power));
        let low = touches[0].min(touches[1]).clamp(-farthest + room, farthest - room);
        let high = touches[0].max(touches[1]).clamp(-farthest + room, farthest - room);
        Some([(low - room).min(-0.25 * room), (high + room).max(0.25 * room)])
    }

    /// A doubt of the model: the curve of a sharp tool that does not begin where the file says, while
    /// `first_touch_sought` is false.
    pub fn doubt(&self, first_touch_sought: bool) -> Option<String> {
        let Data::Curve(measured) = &self.data else { return None };
        let touches = measured.touches(2.0);
        let elsewhere =
            self.is_similar() && !first_touch_sought && touches.abs() > DOUBTED_TOUCH * self.depth;
        elsewhere.then(|| {
            format!(
                "{}: √F points to first touch at {:.4} um, not at 0: a rounded tip or an offset; add unknown = [\"contact_depth\"] or a tip_radius",
                self.name,
                1e6 * touches
            )
        })
    }

    /// Peak of the curve that is drawn: that of the data, or of a feature at its depth.
    pub fn peak(&self) -> Option<[f64; 2]> {
        match &self.data {
            Data::Curve(measured) => Some(measured.peak),
            Data::Features { loading_curvature, .. } => {
                loading_curvature.map(|k| [self.depth, k * self.depth * self.depth])
            }
            Data::Imprint(_) | Data::ImprintNumbers(_) => None,
        }
    }
}

/// Way back over the deepest depth to a share of the peak force.
fn recovery(logarithms: &[f64], share: f64) -> f64 {
    // straight in F^(2/3) nearly, from no way at the peak
    let bent = |share: f64| -share.max(0.0).powf(2.0 / 3.0);
    let ways = &logarithms[logarithms.len() - (NUMBERS_AFTER_LOADING - 2)..];
    let mut points = vec![[bent(1.0), 0.0]];
    points.extend(FORCES.iter().zip(ways).map(|(force, way)| [bent(*force), way.exp()]));
    smooth(&points, bent(share))
}

/// The growth of the way back as the share of the force falls.
fn slope_back(logarithms: &[f64], share: f64) -> f64 {
    let (high, low) = ((share + 0.02).min(1.0), (share - 0.02).max(0.0));
    (recovery(logarithms, low) - recovery(logarithms, high)) / (high - low)
}
