//! One measurement: what was measured, what the finite elements expect, and how far the two may differ.

use super::emulator::{Emulator, by_the_atlas};
use super::imprint::{self, Imprint};
use super::interpolation::smooth;
use super::parameters::{Slot, Unknowns};
use super::pyramid::Pyramid;
use super::response::{DesignPoint, Geometry, NUMBERS_AFTER_LOADING};
use crate::measured_curve::Measured;
use crate::numbers::room_for_the_noise;
use asperity_calibration::indentation::FORCES;
use asperity_material::{Elastic, StressMeasure};
use asperity_simulation::scene::Friction;

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
    /// Relative 95 % errors of the finite elements: loading, slope, recovery.
    pub errors: [f64; 3],
    /// The answers to be expected.
    pub emulator: Emulator,
}

/// Shares of the deepest depth: room beside the depths of first touch to which the laws of a tool point, the
/// farthest of them, and that from which a sharp tool is doubted.
const TOUCH_ROOM: f64 = 0.08;
const FARTHEST_TOUCH: f64 = 0.24;
const DOUBTED_TOUCH: f64 = 0.03;

/// Predicted values of a measurement.
#[derive(Clone, Debug)]
pub(crate) struct Expected {
    /// E for the contact.
    modulus: f64,
    pub(crate) logarithms: Vec<f64>,
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

    /// Growth of the largest sum of squares of its `count` differences because the noise was taken from few
    /// points.
    pub fn room_for_the_noise(&self, count: usize) -> f64 {
        match &self.data {
            Data::Imprint(Imprint { noise_freedom: Some(freedom), .. }) => {
                room_for_the_noise(count, *freedom)
            }
            _ => 0.0,
        }
    }

    /// True where the atlas of sharp cones is the trend: curves and their numbers under one, smooth or of
    /// known friction.
    pub fn is_sharp(&self) -> bool {
        matches!(self.geometry, Geometry::Sharp { .. }) && !self.is_imprint() && !self.friction_sought
    }

    /// True where a sharp cone has friction, of which the atlas knows nothing: what finite elements answer
    /// shifts all that the atlas expects.
    pub fn shifts_the_atlas(&self) -> bool {
        self.is_sharp() && self.friction.and_then(Friction::law).is_some()
    }

    /// True where the loading is one number, K, by similarity.
    pub(crate) fn is_similar(&self) -> bool {
        matches!(self.geometry, Geometry::Sharp { .. })
    }

    /// Numbers of the loading in a response.
    pub fn of_the_loading(&self) -> usize {
        if self.is_imprint() { 1 } else { self.geometry.shares().len() }
    }

    pub(crate) fn expected(&self, unknowns: &Unknowns, point: &[f64], roughly: bool) -> Option<Expected> {
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
        Some(self.differences_from(&self.expected(unknowns, point, roughly)?))
    }

    /// Measured less what is `expected`.
    pub(crate) fn differences_from(&self, expected: &Expected) -> Vec<f64> {
        match &self.data {
            Data::Features { loading_curvature, unloading_slope, plastic_work_ratio } => {
                let [curvature, slope, plastic] = self.features(expected);
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
                    let model = self.force(expected, p[0] - expected.contact_depth, p[1]);
                    (p[1] / model).ln()
                });
                let back = measured
                    .unloading
                    .iter()
                    .map(|p| (p[0] - self.depth_back(expected, measured.turn(), p[1])) / self.depth);
                load.chain(back).collect()
            }
            Data::Imprint(imprint) => {
                let depth = self.true_depth(expected);
                let surface = imprint::surface(&expected.logarithms);
                let model = imprint.read(|r| depth * surface(r / depth));
                imprint.points.iter().zip(model).map(|(p, model)| (p[1] - model) / self.depth).collect()
            }
            Data::ImprintNumbers(numbers) => {
                let depth = self.true_depth(expected);
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
        }
    }

    /// The depth from contact of an imprint: what the machine and first touch take is no imprint.
    pub(crate) fn true_depth(&self, expected: &Expected) -> f64 {
        let peak = self.imprint_force.unwrap_or(0.0);
        (self.depth - expected.contact_depth - expected.compliance * peak).max(0.1 * self.depth)
    }

    /// Loading curvature (Pa), unloading slope (N/m) and plastic share that are expected.
    pub(crate) fn features(&self, expected: &Expected) -> [f64; 3] {
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

    /// Reading of the depth expected in unloading at `force`, from a turn of which the depths where the
    /// loading ended and where the unloading began were read under a force.
    ///
    /// A hold between them makes the contact wider under the same force. The slope where unloading begins
    /// goes with the width, so with the depth; the whole recovery with the force over it.
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

    /// Heights (m) expected at the places of a measured imprint; `None` without one.
    pub fn imprint_heights(&self, unknowns: &Unknowns, point: &[f64]) -> Option<Vec<f64>> {
        let Data::Imprint(imprint) = &self.data else { return None };
        let left = self.differences(unknowns, point, false)?;
        Some(imprint.points.iter().zip(left).map(|(p, d)| p[1] - d * self.depth).collect())
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
        let share = touches.abs() / self.depth;
        if !self.is_similar() || share <= DOUBTED_TOUCH || first_touch_sought && share <= FARTHEST_TOUCH {
            return None;
        }
        let way_out = if share > FARTHEST_TOUCH {
            format!(
                "farther than is sought by contact_depth ({:.0} % of the depth): subtract it from the depths and leave out the approach",
                100.0 * FARTHEST_TOUCH
            )
        } else {
            "a rounded tip or an offset; add unknown = [\"contact_depth\"] or a tip_radius".to_string()
        };
        Some(format!(
            "{}: √F points to first touch at {:.4} um, not at 0: {way_out}",
            self.name,
            1e6 * touches
        ))
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

/// Recovery over the deepest depth, at a share of the peak force.
pub(crate) fn recovery(logarithms: &[f64], share: f64) -> f64 {
    // straight in F^(2/3) nearly, from no way at the peak
    let bent = |share: f64| -share.max(0.0).powf(2.0 / 3.0);
    let ways = &logarithms[logarithms.len() - (NUMBERS_AFTER_LOADING - 2)..];
    let mut points = vec![[bent(1.0), 0.0]];
    points.extend(FORCES.iter().zip(ways).map(|(force, way)| [bent(*force), way.exp()]));
    smooth(&points, bent(share))
}
