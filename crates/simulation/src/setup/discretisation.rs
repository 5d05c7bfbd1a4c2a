//! The numbers of the discretisation that an accuracy chooses for a scene and for a self-similar cone:
//! elements, steps, penetration, tolerance, size of the substrate.

use crate::scene::{Accuracy, ElementChoice, Level, Numerics, Scene, Symmetry, ToolForm};
use crate::setup::schedule::{Spacing, loading};
use asperity_material::units::rounded;
use asperity_mesh::build::Sizes;
use asperity_mesh::grading::LINEAR_PER_QUADRATIC;
use asperity_mesh::outline::Outline;

/// Depths from which errors count, as a share of the peak.
pub const LEAST_COUNTED_DEPTH: f64 = 0.2;

/// Every number of the discretisation, none left open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discretisation {
    /// Kind of quadrilateral.
    pub element: ElementChoice,
    /// Elements across the contact radius at the peak.
    pub elements_in_contact: usize,
    /// Load steps to the peak.
    pub steps: usize,
    /// Spacing of the steps.
    pub spacing: Spacing,
    /// Steps back to zero force.
    pub unload_steps: usize,
    /// Mean penetration over depth.
    pub penetration: f64,
    /// Relative residual at which Newton stops.
    pub newton_tolerance: f64,
    /// Size of an automatic substrate, in contact radii.
    pub domain: f64,
}

/// Numbers that an accuracy chooses for a quadratic element.
struct Choice {
    elements: usize,
    steps: usize,
    unload_steps: usize,
    tolerance: f64,
    domain: f64,
    penetration: f64,
}

/// The levels from coarse to fine: the promised error, and in the order of [`Choice`] the numbers that keep
/// it.
const LEVELS: [(Accuracy, [f64; 6]); 3] = [
    (Accuracy::Draft, [10.0, 29.0, 6.0, 1e-3, 40.0, 0.008]),
    (Accuracy::Standard, [20.0, 58.0, 10.0, 1e-3, 60.0, 0.0042]),
    (Accuracy::Reference, [46.0, 170.0, 12.0, 1e-3, 200.0, 0.002]),
];

impl Choice {
    /// Between two levels every number is a power of the promise, as every part of the error is a power of
    /// its number: each part then falls with the promise.
    fn for_promise(promise: f64) -> Choice {
        let [coarse, middle, fine] = LEVELS;
        let ends = if promise > middle.0.promise() { [coarse, middle] } else { [middle, fine] };
        let [from, to] = ends.map(|(level, _)| level.promise());
        let share = ((promise / from).ln() / (to / from).ln()).clamp(0.0, 1.0);
        let [elements, steps, unload_steps, tolerance, domain, penetration] =
            std::array::from_fn(|i| ends[0].1[i].powf(1.0 - share) * ends[1].1[i].powf(share));
        let whole = |x: f64| x.round() as usize;
        let digits = |x: f64| rounded(x, 3);
        Choice {
            elements: whole(elements),
            steps: whole(steps),
            unload_steps: whole(unload_steps),
            tolerance: digits(tolerance),
            domain: digits(domain),
            penetration: digits(penetration),
        }
    }
}

/// Fewest elements, load steps and unloading steps of a companion: fewer make no curve.
const FEWEST_OF_COMPANION: [usize; 3] = [3, 8, 3];

impl Discretisation {
    /// The numbers of `scene`: those of its numerics, and of its accuracy where they are silent.
    pub fn new(scene: &Scene) -> Discretisation {
        let numerics = &scene.numerics;
        let Choice { elements, steps, unload_steps, tolerance, domain, penetration } =
            Choice::for_promise(scene.accuracy.promise());
        let element = numerics.element.unwrap_or_else(|| {
            element_under(match scene.tool.form() {
                Ok(ToolForm::Cone { slope, .. }) => Some(slope),
                Ok(ToolForm::Measured(outline)) => conical_slope(&outline),
                Ok(ToolForm::Own(tool)) => tool.outline().flank().map(f64::atan),
                _ => None,
            })
        });
        // the work of ridges grows with h², that of a cone with h³: their early increments weigh more
        let ridges = scene.symmetry == Symmetry::PlaneStrain || scene.asperity.len() > 1;
        let (steps, from) = if ridges { (steps + steps / 3, 0.0075) } else { (steps, 0.05) };
        // unloaded, contacts part one after the other, each with a kink in the curve
        let unload_steps = if ridges { 2 * unload_steps } else { unload_steps };
        // errors of step and mesh were made equal to the promise on metal of n 0.3 and grow as it hardens
        // less
        let softness = softness(scene);
        let elements = (elements as f64 * softness.powf(0.8)).round() as usize;
        let steps = (steps as f64 * softness).round() as usize;
        let elements = match element {
            ElementChoice::Q8r => elements,
            ElementChoice::Q4 => (elements as f64 * LINEAR_PER_QUADRATIC) as usize,
        };
        Discretisation {
            element,
            elements_in_contact: numerics.elements_in_contact.unwrap_or(elements),
            steps: numerics.steps.unwrap_or(steps),
            spacing: Spacing::Geometric { from },
            unload_steps,
            penetration: numerics.penetration.unwrap_or(penetration),
            newton_tolerance: numerics.newton_tolerance.unwrap_or(tolerance),
            domain: numerics.domain.unwrap_or(domain),
        }
    }

    /// Numbers half as good: half the elements and steps, twice the penetration, half the substrate; the
    /// tolerance stays.
    #[must_use]
    pub fn coarser(&self) -> Discretisation {
        Discretisation {
            elements_in_contact: self.elements_in_contact.div_ceil(2).max(FEWEST_OF_COMPANION[0]),
            steps: self.steps.div_ceil(2).max(FEWEST_OF_COMPANION[1]),
            unload_steps: self.unload_steps.div_ceil(2).max(FEWEST_OF_COMPANION[2]),
            penetration: 2.0 * self.penetration,
            domain: 0.5 * self.domain,
            ..*self
        }
    }

    /// Numbers `factor` times as good: elements, penalty, substrate, and `steps` where they are to be. Steps
    /// back and the tolerance stay, and what is `given`.
    #[must_use]
    pub fn finer(&self, factor: f64, steps: bool, given: &Numerics) -> Discretisation {
        let more = |count: usize| (factor * count as f64).round() as usize;
        Discretisation {
            elements_in_contact: more(self.elements_in_contact),
            steps: if steps && given.steps.is_none() { more(self.steps) } else { self.steps },
            penetration: given.penetration.unwrap_or(self.penetration / factor),
            domain: given.domain.unwrap_or(factor * self.domain),
            ..*self
        }
    }

    /// Depths at the ends of the load steps as shares of the peak.
    pub fn schedule(&self) -> Vec<f64> {
        loading(self.steps, self.spacing)
    }

    /// Length of the last load step in ln h.
    pub fn last_log_step(&self) -> f64 {
        match self.schedule()[..] {
            [.., before, last] => f64::ln(last / before),
            _ => 1.0,
        }
    }

    /// The part of it that a scene can give.
    pub fn numerics(&self) -> Numerics {
        Numerics {
            element: Some(self.element),
            elements_in_contact: Some(self.elements_in_contact),
            steps: Some(self.steps),
            penetration: Some(self.penetration),
            newton_tolerance: Some(self.newton_tolerance),
            domain: Some(self.domain),
            refine: None,
        }
    }
}

/// Slope of an indenting cone, degrees, beyond which linear elements are used.
const STEEP_SLOPE_DEG: f64 = 11.0;

/// The quadratic element gives the smaller error for its cost. Under a steep indenter, though, the material
/// at the axis is drawn out along the flank until four points no longer hold the shape of its cells:
/// perfectly plastic material of E/σ_y 500 went to 0.6 of the depth under a cone of 20° and could not be
/// unloaded from one of 14°. With linear elements it does both, up to 40°.
fn element_under(indenter: Option<f64>) -> ElementChoice {
    if indenter.is_some_and(|slope| slope > STEEP_SLOPE_DEG.to_radians()) {
        ElementChoice::Q4
    } else {
        ElementChoice::Q8r
    }
}

/// Slope at half way out over that at the end from which a measured tool is a cone: that of a ball is a half
/// at most.
const CONICAL_SLOPE_RATIO: f64 = 0.75;

/// Slope (radians) of the flank of a measured tool that is conical.
fn conical_slope(outline: &Outline) -> Option<f64> {
    let [_, end] = outline.ends();
    let [middle, last] = [0.5 * end, end].map(|x| outline.drop_and_slope(x)[1]);
    (middle > CONICAL_SLOPE_RATIO * last).then(|| last.atan())
}

/// The [softness](softness_of) of the metal of `scene`.
fn softness(scene: &Scene) -> f64 {
    let modulus = scene.material.youngs_modulus.0;
    scene.material.hardening().map_or(1.0, |h| softness_of(h.exponent(modulus)))
}

/// (1 - n)/0.7 of metal that hardens less than n = 0.3, else 1: the error of the load step grows with its
/// square and is of second order in the step, the ripple of the mesh grows with it nearly and is of first
/// order.
fn softness_of(exponent: f64) -> f64 {
    ((1.0 - exponent) / 0.7).max(1.0)
}

/// The discretisation of a self-similar cone, crushed or indenting, on which the slope of √F over the depth
/// is measured: a mesh of one width and equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConeDiscretisation {
    /// Elements across the final contact radius, all of one size, so that the ripple of the force has one
    /// period; steps, penalty, tolerance and size of the substrate.
    pub numbers: Discretisation,
    /// The mesh around the contact.
    pub sizes: Sizes,
}

/// Share of the final depth to which longer steps lead, and from which they are equal.
pub const EQUAL_STEPS_FROM: f64 = 0.3;

/// Numbers of a cone of metal that hardens with n = 0.3 or more: elements across the contact, of which so
/// many are one column at the axis, steps to [`EQUAL_STEPS_FROM`] and from there; depth of the core, growth
/// of its rows, first shell in elements, growth of the shells, substrate and foot of the cone in contact
/// radii; penetration over depth, tolerance; powers of the [softness](softness_of) in the numbers of elements
/// and of steps, with which the difference between run and companion is about the same for all n: without
/// hardening, flow gathers where the mesh lets it.
type ConeLevel = ([usize; 4], [f64; 6], [f64; 2], [f64; 2]);

/// At draft, standard and reference.
type ConeLevels = [ConeLevel; 3];

/// Quadratic elements. A companion of four elements across the contact tells little of the error of eight: of
/// 124 cones of the default sweep 59 % lay within the bound that these gave at standard, 99 % with 12 and 6.
const QUADRATIC_LEVELS: ConeLevels = [
    ([10, 1, 3, 14], [0.4, 0.5, 1.0, 0.5, 64.0, 8.0], [0.008, 1e-3], [0.3, 2.0]),
    ([12, 1, 5, 20], [0.4, 0.4, 1.0, 0.4, 32.0, 8.0], [0.008, 1e-3], [0.3, 1.4]),
    ([18, 1, 12, 60], [0.8, 0.2, 1.0, 0.25, 200.0, 12.0], [0.004, 1e-6], [1.6, 2.0]),
];

/// Numbers of [`QUADRATIC_LEVELS`] at standard for a crushed cone of a gentle slope, to whose K the same
/// promise takes a third less work: of 160 cones of the default sweep all state at most 0.9 %, and 158 lie
/// within what they state. Under a slope of 30° such a mesh states 1.3 %.
const GENTLE_STANDARD: ConeLevel =
    ([10, 1, 3, 20], [0.4, 0.3, 1.0, 0.4, 20.0, 8.0], [0.008, 1e-3], [0.7, 1.4]);

/// Slope of a crushed cone, degrees, up to which it is gentle.
const GENTLE_SLOPE_DEG: f64 = 11.0;

/// Linear elements under a steep cone: they want finer meshes, and a wide column at the axis leaves room to
/// what is stretched along the flank.
const STEEP_LINEAR_LEVELS: ConeLevels = [
    ([16, 2, 6, 36], [0.6, 0.15, 1.0, 0.15, 100.0, 8.0], [0.002, 1e-3], [0.0; 2]),
    ([24, 4, 8, 60], [0.6, 0.15, 1.0, 0.1, 100.0, 8.0], [0.001, 1e-4], [0.0; 2]),
    ([36, 6, 12, 96], [0.8, 0.08, 1.0, 0.05, 200.0, 8.0], [0.0005, 1e-6], [0.0; 2]),
];

/// Penetration of a cone that indents a flat body with quadratic elements over that of a crushed one: it
/// costs more of the depth.
const INDENTED_PENETRATION_RATIO: f64 = 0.5;

/// Factor by which cells grow faster with the distance from the contact in a companion. With quadratic
/// elements the error of that growth is of the fourth order nearly, so that twice as much of it would tell of
/// nothing else; with linear ones it is of the second (growth times 2, 1.5, 1/2, 1/4 under a cone of 30°:
/// +0.85, +0.37, -0.25, -0.33 % of K), as that of the elements themselves.
fn faster(element: ElementChoice) -> f64 {
    if element == ElementChoice::Q4 { 2.0 } else { 1.5 }
}

impl ConeDiscretisation {
    /// The numbers at the coarsest level that promises `accuracy`, for a cone of the slope `slope_deg`
    /// (degrees) that is crushed or `indents`, of a material of the hardening exponent `exponent` (`None`:
    /// elastic).
    pub fn new(
        slope_deg: f64,
        indents: bool,
        exponent: Option<f64>,
        accuracy: Accuracy,
    ) -> ConeDiscretisation {
        let element = element_under(indents.then_some(slope_deg.to_radians()));
        let quadratic = element == ElementChoice::Q8r;
        let levels = if quadratic { QUADRATIC_LEVELS } else { STEEP_LINEAR_LEVELS };
        let level = accuracy.level();
        let gentle = quadratic && !indents && slope_deg <= GENTLE_SLOPE_DEG && level == Level::Standard;
        let (counts, lengths, [penetration, tolerance], powers) =
            if gentle { GENTLE_STANDARD } else { levels[level as usize] };
        let [elements, at_axis, lead, steps] = counts;
        let [core_depth, row_growth, first_shell, growth, domain, foot] = lengths;
        let softness = exponent.map_or(1.0, softness_of);
        let finer = |count: usize, power: f64| count as f64 * softness.powf(power);
        // an even number: the companion has half of them
        let elements = 2 * (0.5 * finer(elements, powers[0])).round() as usize;
        let steps = finer(steps, powers[1]).round() as usize;
        ConeDiscretisation {
            numbers: Discretisation {
                element,
                elements_in_contact: elements,
                steps: lead + steps,
                spacing: Spacing::Equal { lead, from: EQUAL_STEPS_FROM },
                unload_steps: 0,
                penetration: if quadratic && indents {
                    INDENTED_PENETRATION_RATIO * penetration
                } else {
                    penetration
                },
                newton_tolerance: tolerance,
                domain,
            },
            sizes: Sizes {
                at_axis,
                core: 1.1,
                core_depth,
                row_growth,
                first_shell,
                growth,
                foot,
                rounding: 0.0,
            },
        }
    }

    /// Numbers half as good, those of the lead included; cells grow faster by half, the tolerance stays.
    #[must_use]
    pub fn coarser(&self) -> ConeDiscretisation {
        let mut numbers = self.numbers.coarser();
        if let Spacing::Equal { lead, from } = self.numbers.spacing {
            let equal = self.numbers.steps.saturating_sub(lead);
            let lead = lead.div_ceil(2);
            numbers.steps = lead + equal.div_ceil(2).max(FEWEST_OF_COMPANION[0]);
            numbers.spacing = Spacing::Equal { lead, from };
        }
        let faster = faster(numbers.element);
        let sizes = Sizes {
            at_axis: self.sizes.at_axis.div_ceil(2),
            row_growth: faster * self.sizes.row_growth,
            growth: faster * self.sizes.growth,
            ..self.sizes
        };
        ConeDiscretisation { numbers, sizes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smaller_error_is_promised_by_finer_numbers() {
        let mut before = Choice::for_promise(0.05);
        assert_eq!((before.elements, before.steps, before.tolerance), (10, 29, 1e-3));
        for promise in [0.03, 0.02, 0.01, 0.007, 0.005, 0.003, 0.002] {
            let next = Choice::for_promise(promise);
            assert!(next.elements > before.elements && next.steps > before.steps, "{promise}");
            // the tolerance of `standard` already is that of `draft`
            assert!(next.tolerance <= before.tolerance && next.domain > before.domain, "{promise}");
            assert!(next.unload_steps >= before.unload_steps && next.penetration <= before.penetration);
            before = next;
        }
        assert_eq!((before.elements, before.steps, before.domain), (46, 170, 200.0));
    }
}
