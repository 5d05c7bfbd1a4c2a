//! The discretisations that a trade runs: each number by itself around each level, and combinations that fill
//! the space.

use asperity_material::units::rounded;
use asperity_simulation::scene::{Accuracy, ElementChoice, Numerics, Scene};
use asperity_simulation::setup::discretisation::Discretisation;
use serde::{Deserialize, Serialize};

/// The number of the discretisation that was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Knob {
    /// Nothing: an accuracy as it is.
    Level,
    /// Linear elements instead of quadratic ones or the reverse, with about as many unknowns.
    Element,
    /// Elements across the contact.
    Mesh,
    /// Load steps.
    Step,
    /// The penetration that sets the penalty.
    Penetration,
    /// The residual at which Newton's method stops.
    Tolerance,
    /// Size of the substrate.
    Domain,
    /// All of them.
    Mixed,
    /// Finer than every level: one of the two runs that the converged value is made of.
    Converged,
}

/// One run of a trade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// The number that was changed.
    pub knob: Knob,
    /// The level around which it was changed; what a scene cannot say (steps of unloading) is that level's.
    pub around: Accuracy,
    /// Every number a scene can say.
    pub numerics: Numerics,
}

/// The levels from coarse to fine.
pub const LEVELS: [Accuracy; 3] = [Accuracy::Draft, Accuracy::Standard, Accuracy::Reference];

/// Accuracies between the levels, run as they are; to the last digit what "0.7%" is read as, by which a
/// journal finds them.
const ACCURACIES_BETWEEN: [Accuracy; 4] = [
    Accuracy::Within(3.0 / 100.0),
    Accuracy::Within(2.0 / 100.0),
    Accuracy::Within(0.7 / 100.0),
    Accuracy::Within(0.4 / 100.0),
];

/// An element of a linear mesh is smaller by this factor where it has as many unknowns as a quadratic one: a
/// quadratic element brings three nodes, a linear one brings one.
const LINEAR_FINENESS: f64 = 1.732;

impl Setting {
    /// `scene` with these numbers, without files of fields.
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = Scene { accuracy: self.around, numerics: self.numerics, ..scene.clone() };
        scene.output.every = Some(0);
        scene.output.fields = Some(Vec::new());
        scene
    }

    /// A number that grows with the cost, to begin with the longest runs.
    pub fn weight(&self) -> f64 {
        let n = &self.numerics;
        let or = |value: Option<f64>| value.unwrap_or(1.0);
        let elements = or(n.elements_in_contact.map(|e| e as f64));
        let fineness = if n.element == Some(ElementChoice::Q4) { 1.0 / LINEAR_FINENESS } else { 1.0 };
        (elements * fineness).powf(1.8) * or(n.steps.map(|s| s as f64)).powf(0.7)
    }
}

/// The runs of `scene` whose cost and error are compared. Numbers that the scene fixes are not varied.
pub fn settings(scene: &Scene, combinations: usize) -> Vec<Setting> {
    let levels = LEVELS.into_iter().flat_map(|level| settings_around(scene, level));
    let between = ACCURACIES_BETWEEN.into_iter().map(|accuracy| level(scene, accuracy));
    let mixed = (0..combinations).map(|i| mixed(scene, i));
    let mut settings: Vec<Setting> = Vec::new();
    for setting in levels.chain(between).chain(mixed).map(|s| fixed(scene, s)) {
        if !settings.iter().any(|s| s.numerics == setting.numerics && s.around == setting.around) {
            settings.push(setting);
        }
    }
    settings
}

/// The two finer runs that the converged value is made of: their meshes differ, so that their ripples do.
pub fn converged(scene: &Scene) -> [Setting; 2] {
    let base = level(scene, Accuracy::Reference);
    [(1.1, 1.0), (1.25, 1.1)].map(|(mesh, steps)| {
        let mut numerics = base.numerics;
        scale(&mut numerics.elements_in_contact, mesh, Numerics::ELEMENTS);
        scale(&mut numerics.steps, steps, Numerics::STEPS);
        fixed(scene, Setting { knob: Knob::Converged, numerics, ..base })
    })
}

/// An accuracy as it is.
fn level(scene: &Scene, accuracy: Accuracy) -> Setting {
    let numerics = Discretisation::new(&Scene { accuracy, ..scene.clone() }).numerics();
    Setting { knob: Knob::Level, around: accuracy, numerics }
}

/// The setting with the numbers that the scene fixes.
fn fixed(scene: &Scene, setting: Setting) -> Setting {
    let (said, own) = (&scene.numerics, setting.numerics);
    let numerics = Numerics {
        element: said.element.or(own.element),
        elements_in_contact: said.elements_in_contact.or(own.elements_in_contact),
        steps: said.steps.or(own.steps),
        penetration: said.penetration.or(own.penetration),
        newton_tolerance: said.newton_tolerance.or(own.newton_tolerance),
        domain: said.domain.or(own.domain),
        refine: None,
    };
    Setting { numerics, ..setting }
}

/// A level and each of its numbers changed by itself.
///
/// Around the finest level, whose runs are the longest, only to the cheaper side: finer than that is the
/// converged value alone, and what the other element costs shows at the other levels.
fn settings_around(scene: &Scene, accuracy: Accuracy) -> Vec<Setting> {
    let base = level(scene, accuracy);
    let finest = accuracy == Accuracy::Reference;
    let mut settings = vec![base];
    let mut add = |knob, change: &dyn Fn(&mut Numerics)| {
        let mut numerics = base.numerics;
        change(&mut numerics);
        settings.push(Setting { knob, numerics, ..base });
    };
    if !finest {
        add(Knob::Element, &|n| {
            let (other, factor) = match n.element {
                Some(ElementChoice::Q4) => (ElementChoice::Q8r, 1.0 / LINEAR_FINENESS),
                _ => (ElementChoice::Q4, LINEAR_FINENESS),
            };
            n.element = Some(other);
            scale(&mut n.elements_in_contact, factor, Numerics::ELEMENTS);
        });
    }
    for factor in if finest { [0.6, 0.8] } else { [0.67, 1.5] } {
        add(Knob::Mesh, &|n| scale(&mut n.elements_in_contact, factor, Numerics::ELEMENTS));
    }
    let sides = |cheap: f64, dear: f64| [cheap, dear].into_iter().take(if finest { 1 } else { 2 });
    for factor in sides(0.5, 2.0) {
        add(Knob::Step, &|n| scale(&mut n.steps, factor, Numerics::STEPS));
    }
    for factor in sides(4.0, 0.25) {
        add(Knob::Penetration, &|n| scale_real(&mut n.penetration, factor, Numerics::PENETRATION));
    }
    for factor in sides(1e2, 1e-2) {
        add(Knob::Tolerance, &|n| scale_real(&mut n.newton_tolerance, factor, Numerics::TOLERANCE));
    }
    for factor in sides(0.25, 4.0) {
        add(Knob::Domain, &|n| scale_real(&mut n.domain, factor, Numerics::DOMAIN));
    }
    settings
}

fn scale(value: &mut Option<usize>, factor: f64, [low, high]: [f64; 2]) {
    *value = value.map(|v| (v as f64 * factor).round().clamp(low, high) as usize);
}

fn scale_real(value: &mut Option<f64>, factor: f64, [low, high]: [f64; 2]) {
    // three digits are enough to name a number that was multiplied
    *value = value.map(|v| rounded(v * factor, 3).clamp(low, high));
}

/// Combination `i`: a point of the additive recurrence of the generalised golden ratio in seven dimensions
/// (the real root g of x⁸ = x + 1, steps g⁻ᵏ), which fills the cube evenly however many points are taken; six
/// of them are numbers.
fn mixed(scene: &Scene, i: usize) -> Setting {
    let golden = (0..60).fold(1.5_f64, |x, _| (1.0 + x).powf(1.0 / 8.0));
    let at = |k: i32| (0.5 + (i + 1) as f64 * golden.powi(-k)).fract();
    let logs = |k, low: f64, high: f64| (low.ln() + at(k) * (high / low).ln()).exp();
    let linear = at(6) < 0.25;
    let elements = logs(1, 9.0, 50.0) * if linear { LINEAR_FINENESS } else { 1.0 };
    let steps = logs(2, 16.0, 200.0).round() as usize;
    let accuracy = match steps {
        ..60 => Accuracy::Draft,
        60..150 => Accuracy::Standard,
        _ => Accuracy::Reference,
    };
    let numerics = Numerics {
        element: Some(if linear { ElementChoice::Q4 } else { ElementChoice::Q8r }),
        elements_in_contact: Some(elements.round() as usize),
        steps: Some(steps),
        penetration: Some(rounded(logs(3, 0.0005, 0.016), 3)),
        newton_tolerance: Some(rounded(logs(4, 1e-8, 1e-4), 3)),
        domain: Some(rounded(logs(5, 30.0, 800.0), 3)),
        refine: None,
    };
    Setting { knob: Knob::Mixed, numerics, ..level(scene, accuracy) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_simulation::scene::ToolShape;

    /// The default scene with something added.
    fn scene(numerics: &str) -> Scene {
        let text = crate::scenes::SINGLE_ASPERITY.to_string() + numerics;
        crate::input::toml_file::TomlFile::parse("scene.toml".as_ref(), text, &[]).unwrap().value
    }

    #[test]
    fn every_setting_is_a_valid_scene_and_none_comes_twice() {
        let scene = scene("");
        let settings = settings(&scene, 30);
        assert_eq!(settings.iter().filter(|s| s.knob == Knob::Mixed).count(), 30);
        assert_eq!(settings.iter().filter(|s| s.knob == Knob::Level).count(), 7);
        assert!(settings.len() >= 60);
        for setting in settings.iter().chain(&converged(&scene)) {
            setting.scene(&scene).validate().unwrap();
        }
    }

    #[test]
    fn the_other_element_is_tried() {
        let mut scene = scene("");
        let tried = |scene: &Scene| {
            let settings = settings(scene, 0);
            settings.iter().find(|s| s.knob == Knob::Element).and_then(|s| s.numerics.element)
        };
        assert_eq!(tried(&scene), Some(ElementChoice::Q4));
        (scene.tool.shape, scene.tool.slope_deg) = (ToolShape::Cone, Some(30.0));
        assert_eq!(tried(&scene), Some(ElementChoice::Q8r));
    }

    #[test]
    fn numbers_that_the_scene_fixes_are_not_varied() {
        let scene = scene("[numerics]\nelements_in_contact = 6\nelement = \"q8r\"\n");
        for setting in settings(&scene, 5).iter().chain(&converged(&scene)) {
            assert_eq!(setting.numerics.elements_in_contact, Some(6));
            assert!(setting.knob != Knob::Mesh && setting.knob != Knob::Element);
        }
    }
}
