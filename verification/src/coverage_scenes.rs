//! A battery of numbered scenes that differ in everything a scene can say: what the stated errors are held
//! against. Which constants of the program had seen them, the page of stated errors says.
//!
//! The [`Kind`]s take turns, so that the first [`Kind::ALL`] scenes hold each of them; the levels take turns
//! too, and everything else is drawn from the number.

use crate::single_asperity::{loaded, prepared};
use asperity_material::units::{Length, Stress, rounded};
use asperity_material::{HardeningLaw, HardeningMode};
use asperity_mesh::Mesh;
use asperity_simulation::scene::{
    Accuracy, Asperity, ElementChoice, Lateral, Loading, Material, Scene, SceneError, Symmetry, Tool,
};
use asperity_simulation::setup::discretisation::Discretisation;

/// The peculiarity of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A plane on a sharp cone.
    SharpCone,
    /// A plane on a cone with a rounded tip.
    RoundedCone,
    /// A plane on the cap of a ball.
    Cap,
    /// A cone into a flat body.
    IndentingCone,
    /// A ball into a flat body.
    IndentingBall,
    /// A cone or a ball on an asperity.
    ToolOnAsperity,
    /// A plane on one ridge.
    Ridge,
    /// A wedge or a cylinder into a flat body.
    IndentingWedge,
    /// A plane on a cone and rings around it.
    Rings,
    /// The same between symmetric sides.
    RepeatedRings,
    /// A plane on several ridges.
    Ridges,
    /// The same between symmetric sides.
    RepeatedRidges,
    /// A body of one of the kinds above with one contact, on a mesh that is given.
    ImportedMesh,
    /// The same with linear elements.
    LinearElement,
    /// The same of a metal that hardens by a table with kinks.
    Table,
    /// The same of a metal that hardens by the motion of its yield surface, at least in part.
    Kinematic,
    /// The same of a body that never yields.
    Elastic,
    /// The same of a metal that does not harden.
    PerfectlyPlastic,
}

impl Kind {
    /// In the order of the numbers; first those with one contact, then those with several, then the
    /// particular ones.
    pub const ALL: [Kind; 18] = [
        Kind::SharpCone,
        Kind::RoundedCone,
        Kind::Cap,
        Kind::IndentingCone,
        Kind::IndentingBall,
        Kind::ToolOnAsperity,
        Kind::Ridge,
        Kind::IndentingWedge,
        Kind::Rings,
        Kind::RepeatedRings,
        Kind::Ridges,
        Kind::RepeatedRidges,
        Kind::ImportedMesh,
        Kind::LinearElement,
        Kind::Table,
        Kind::Kinematic,
        Kind::Elastic,
        Kind::PerfectlyPlastic,
    ];

    /// Kinds with one contact, the first ones.
    const SINGLE_CONTACT_KINDS: usize = 8;

    /// Its name in a table.
    pub fn name(self) -> &'static str {
        match self {
            Kind::SharpCone => "sharp cone",
            Kind::RoundedCone => "rounded cone",
            Kind::Cap => "cap",
            Kind::IndentingCone => "indenting cone",
            Kind::IndentingBall => "indenting ball",
            Kind::ToolOnAsperity => "tool on asperity",
            Kind::Ridge => "ridge",
            Kind::IndentingWedge => "wedge or cylinder",
            Kind::Rings => "rings",
            Kind::RepeatedRings => "rings, symmetric sides",
            Kind::Ridges => "ridges",
            Kind::RepeatedRidges => "ridges, symmetric sides",
            Kind::ImportedMesh => "imported mesh",
            Kind::LinearElement => "linear element",
            Kind::Table => "table with kinks",
            Kind::Kinematic => "kinematic hardening",
            Kind::Elastic => "elastic",
            Kind::PerfectlyPlastic => "perfectly plastic",
        }
    }
}

/// Levels in turn: the finest is the rarest, as it costs the most.
const LEVELS: [Accuracy; 7] = [
    Accuracy::Draft,
    Accuracy::Standard,
    Accuracy::Draft,
    Accuracy::Standard,
    Accuracy::Reference,
    Accuracy::Draft,
    Accuracy::Standard,
];

/// Every so many scenes the truth is found with the other element.
const OTHER_ELEMENT: usize = 13;

/// The first number that is in no table of the battery, and the distance of the numbers of one seed from
/// those of the next where scenes beside it are drawn.
pub const BEYOND_BATTERY: usize = 1000;

/// A scene of the battery.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Counted from 0.
    pub number: usize,
    /// Its peculiarity.
    pub kind: Kind,
    /// Driven by depth, with unloading, without fields.
    pub scene: Scene,
}

impl Case {
    /// The scene of this number.
    ///
    /// # Errors
    /// A scene that the program refuses.
    pub fn new(number: usize) -> Result<Case, SceneError> {
        let kind = Kind::ALL[number % Kind::ALL.len()];
        let mut draw = Draw { number, count: 0 };
        let body = match kind {
            kind if (kind as usize) < Kind::ImportedMesh as usize => kind,
            _ => Kind::ALL[draw.index_below(Kind::SINGLE_CONTACT_KINDS)],
        };
        let given = kind == Kind::ImportedMesh;
        let mut scene = draw.body(body, kind == Kind::Elastic, given)?;
        scene.material = draw.metal(kind);
        scene.accuracy = LEVELS[number % LEVELS.len()];
        if kind == Kind::LinearElement || given && draw.chance(0.5) {
            scene.numerics.element = Some(ElementChoice::Q4);
        }
        scene.validate()?;
        Ok(Case { number, kind, scene })
    }

    /// The mesh to run it on, m: none but for imported ones, where it is the one that the program builds.
    ///
    /// # Errors
    /// A scene that cannot be meshed.
    pub fn mesh(&self) -> Result<Option<Mesh>, SceneError> {
        if self.kind != Kind::ImportedMesh {
            return Ok(None);
        }
        let problem = prepared(&self.scene)?;
        Ok(Some(problem.mesh.scaled(problem.units.length)))
    }

    /// The element that the truth is to be found with: that of the levels or, of some scenes and of those
    /// that ask for the linear one, the other. Quadratic elements in plane strain are not judged by linear
    /// ones: the mesh far from the contact, which no level refines, is part of the depth there, and linear
    /// elements on it are too stiff by 0.8 % of the force of a ridge.
    pub fn element_of_truth(&self) -> ElementChoice {
        let own = Discretisation::new(&self.scene).element;
        let other = self.kind == Kind::LinearElement || self.number % OTHER_ELEMENT == OTHER_ELEMENT / 2;
        match own {
            _ if !other => own,
            ElementChoice::Q4 => ElementChoice::Q8r,
            ElementChoice::Q8r if self.scene.symmetry == Symmetry::PlaneStrain => own,
            ElementChoice::Q8r => ElementChoice::Q4,
        }
    }
}

/// Height of the asperities, m.
const HEIGHT: f64 = 20e-6;

/// Radius of caps and of balls and cylinders that indent, m.
const RADIUS: f64 = 100e-6;

/// Of the metal, Pa.
const MODULUS: f64 = 210e9;

/// Random numbers that depend on the number of the scene and on how many were drawn before.
struct Draw {
    number: usize,
    count: u64,
}

impl Draw {
    /// In [0, 1): splitmix64.
    fn share(&mut self) -> f64 {
        self.count += 1;
        let seed = ((self.number as u64) << 32) + self.count;
        let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn chance(&mut self, share: f64) -> bool {
        self.share() < share
    }

    fn index_below(&mut self, count: usize) -> usize {
        (self.share() * count as f64) as usize
    }

    fn number_between(&mut self, low: f64, high: f64) -> f64 {
        digits(low + self.share() * (high - low))
    }

    fn between_logs(&mut self, low: f64, high: f64) -> f64 {
        digits(low * (high / low).powf(self.share()))
    }

    /// A metal with the particularity of `kind`, if that is one of the metal.
    fn metal(&mut self, kind: Kind) -> Material {
        let body = Material::elastic_body(Stress(MODULUS), self.number_between(0.2, 0.4));
        if kind == Kind::Elastic {
            return body;
        }
        let yield_stress = MODULUS / self.between_logs(30.0, 3000.0);
        if kind == Kind::Table {
            return body.hardening_by(self.kinks(digits(yield_stress)));
        }
        let exponent = match kind {
            Kind::PerfectlyPlastic => 0.0,
            Kind::Kinematic => self.number_between(0.1, 0.6),
            _ => self.number_between(0.0, 0.6),
        };
        let law = if self.chance(0.5) { HardeningLaw::Hollomon } else { HardeningLaw::Swift };
        let mut metal = body.yielding(Stress(digits(yield_stress)), exponent);
        metal.hardening_law = law.into();
        if kind == Kind::Kinematic {
            metal.hardening_mode = HardeningMode::Kinematic;
            metal.kinematic_share = Some(self.number_between(0.3, 1.0));
        }
        metal
    }

    /// A table of three to five points; a third of its segments are level.
    fn kinks(&mut self, yield_stress: f64) -> Vec<(f64, Stress)> {
        let (mut strain, mut stress) = (0.0, yield_stress);
        let mut points = vec![(strain, Stress(stress))];
        for _ in 0..2 + self.index_below(3) {
            strain = digits(strain + self.between_logs(0.005, 0.2));
            if !self.chance(1.0 / 3.0) {
                stress = digits(stress * self.number_between(1.05, 1.6));
            }
            points.push((strain, Stress(stress)));
        }
        points
    }

    /// An asperity of some slope (degrees) and height (m), its tip rounded over up to 0.8 of its height.
    fn rounded(&mut self, height: f64, slope: f64) -> Asperity {
        let round = self.between_logs(0.01, 0.8) * height / (1.0 - slope.to_radians().cos());
        Asperity::cone(Length(height), slope).rounded(Length(digits(round)))
    }

    /// A cap between a quarter and half its radius high.
    fn cap(&mut self) -> Asperity {
        let height = Some(Length(digits(RADIUS * self.number_between(0.25, 0.5))));
        let cone = Asperity::cone(Length(HEIGHT), 1.0);
        Asperity { radius: Some(Length(RADIUS)), height, slope_deg: None, ..cone }
    }

    /// The scene of a body and a tool; `gentle` for what never yields, `sized` if the size of the body must
    /// be said.
    fn body(&mut self, kind: Kind, gentle: bool, sized: bool) -> Result<Scene, SceneError> {
        let deepest = if gentle { 0.2 } else { 0.6 };
        let curved = [Kind::IndentingCone, Kind::IndentingBall, Kind::IndentingWedge, Kind::ToolOnAsperity];
        let [flattest, steepest] = match kind {
            _ if gentle => [1.0, 15.0],
            kind if curved.contains(&kind) => [2.0, 35.0],
            _ => [1.0, 45.0],
        };
        let planar = [Kind::Ridge, Kind::IndentingWedge, Kind::Ridges, Kind::RepeatedRidges].contains(&kind);
        let repeated = [Kind::RepeatedRings, Kind::RepeatedRidges].contains(&kind);
        let share = self.between_logs(0.05, deepest);
        let slope = self.between_logs(flattest, steepest);
        let coin = self.chance(0.5);
        let asperities = match kind {
            Kind::SharpCone => vec![Asperity::cone(Length(HEIGHT), slope)],
            Kind::Ridge if coin => vec![Asperity::cone(Length(HEIGHT), slope)],
            Kind::RoundedCone | Kind::Ridge => vec![self.rounded(HEIGHT, slope)],
            Kind::Cap => vec![self.cap()],
            Kind::ToolOnAsperity if self.chance(0.5) => vec![self.cap()],
            Kind::ToolOnAsperity => vec![self.rounded(HEIGHT, slope)],
            Kind::Rings | Kind::RepeatedRings | Kind::Ridges | Kind::RepeatedRidges => self.row(share)?,
            _ => Vec::new(),
        };
        let highest = asperities.iter().try_fold(0.0, |m: f64, a| Ok(m.max(a.form()?.height())))?;
        let mut depth = share * if highest > 0.0 { highest } else { HEIGHT };
        let tool = match kind {
            Kind::IndentingBall => Tool::sphere(Length(RADIUS)),
            Kind::IndentingWedge | Kind::ToolOnAsperity if coin => Tool::sphere(Length(RADIUS)),
            Kind::IndentingCone | Kind::IndentingWedge | Kind::ToolOnAsperity => {
                let tip = Some(Length(digits(self.between_logs(0.1, 10.0) * depth)));
                Tool { tip_radius: tip.filter(|_| self.chance(0.3)), ..Tool::cone(slope) }
            }
            _ => Tool::plane(),
        };
        // half width of the contact on a flat body
        let mut contact = depth / slope.to_radians().tan();
        if tool.radius.is_some() && asperities.is_empty() {
            depth = RADIUS * self.between_logs(0.01, if gentle { 0.1 } else { 0.4 });
            contact = (2.0 * RADIUS * depth).sqrt();
        }
        let mut scene = Scene::new(
            if planar { Symmetry::PlaneStrain } else { Symmetry::Axisymmetric },
            Material::elastic_body(Stress(MODULUS), 0.3),
            tool,
            Loading::to_depth(Length(digits(depth))).unloaded(),
        );
        scene.output.fields = Some(Vec::new());
        scene.asperity = asperities;
        if repeated {
            scene.lateral = Lateral::Symmetric;
        }
        if planar || repeated || sized {
            let foot = scene.asperity.iter().try_fold(0.0, |sum, a| {
                Ok(sum + a.form()?.base_radius() + 0.5 * a.spacing.map_or(0.0, |s| s.0))
            })?;
            let foot = if planar { foot } else { 2.0 * foot };
            let reach = if foot > 0.0 { foot } else { 4.0 * contact };
            let [radius, below] = [0; 2].map(|_| self.between_logs(2.0, 20.0) * reach);
            // between walls the whole column gives way: where it is long, nothing else does
            let below = if repeated { 0.1 * below } else { below };
            scene = scene.on(Length(digits(radius)), Length(digits(below)));
            if let (true, Some(substrate)) = (repeated, &mut scene.substrate) {
                substrate.radius = None;
            }
        }
        Ok(scene)
    }

    /// Two to four asperities, of which one is the highest and some may not be touched at this share of the
    /// height.
    fn row(&mut self, share: f64) -> Result<Vec<Asperity>, SceneError> {
        let count = 2 + self.index_below(3);
        let highest = self.index_below(count);
        let mut row = Vec::new();
        for index in 0..count {
            let lower = if index == highest { 0.0 } else { self.number_between(0.0, 1.2) };
            let slope = self.between_logs(3.0, 30.0);
            let mut one = self.rounded(digits(HEIGHT * (1.0 - lower * share)), slope);
            if self.chance(0.5) {
                one.spacing = Some(Length(digits(one.form()?.base_radius() * self.number_between(0.1, 2.0))));
            }
            row.push(one);
        }
        Ok(row)
    }
}

/// `x` to three digits, as a person would write it.
fn digits(x: f64) -> f64 {
    rounded(x, 3)
}

/// A scene with what it is called in a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// A few words.
    pub name: String,
    /// The scene, driven by depth, without unloading and fields.
    pub scene: Scene,
}

/// Ten scenes that no level was chosen by: name, slope (degrees; 0: a ball), tip radius (µm), E/σ_y (0:
/// elastic), n, depth (µm) of a height of 20 µm.
const OTHERS: [(&str, f64, f64, f64, f64, f64); 10] = [
    ("sharp cone 3°, n 0.3", 3.0, 0.0, 700.0, 0.3, 4.0),
    ("sharp cone 10°, n 0.1", 10.0, 0.0, 300.0, 0.1, 5.0),
    ("sharp cone 20°, n 0.5", 20.0, 0.0, 1000.0, 0.5, 5.0),
    ("sharp cone 10°, n 0", 10.0, 0.0, 500.0, 0.0, 5.0),
    ("elastic cone 5°", 5.0, 0.0, 0.0, 0.0, 5.0),
    ("cone 10°, tip 100 µm, n 0.2", 10.0, 100.0, 400.0, 0.2, 3.0),
    ("cone 30°, tip 5 µm, n 0.3", 30.0, 5.0, 700.0, 0.3, 6.0),
    ("cone 1.5°, n 0.2, stiff", 1.5, 0.0, 100.0, 0.2, 2.0),
    ("ball, n 0.2", 0.0, 0.0, 600.0, 0.2, 1.0),
    ("elastic ball", 0.0, 0.0, 0.0, 0.0, 1.0),
];

/// The ten scenes that the promises of the levels are checked on.
///
/// # Errors
/// The committed scene file does not read.
pub fn others() -> Result<Vec<Entry>, toml::de::Error> {
    let make = |&(name, slope, tip, ratio, exponent, depth): &(&str, f64, f64, f64, f64, f64)| {
        let mut scene = loaded(Accuracy::Standard)?;
        let modulus = scene.material.youngs_modulus.0;
        let metal = ratio > 0.0;
        scene.material.yield_stress = metal.then(|| Stress(modulus / ratio));
        scene.material.hardening_exponent = metal.then_some(exponent);
        let um = |x: f64| Some(Length(x * 1e-6));
        let first = &mut scene.asperity[0];
        if slope > 0.0 {
            (first.slope_deg, first.tip_radius) = (Some(slope), um(tip));
        } else {
            (first.radius, first.height, first.slope_deg, first.tip_radius) = (um(20.0), None, None, None);
        }
        scene.loading.depth = um(depth);
        Ok(Entry { name: name.into(), scene })
    };
    OTHERS.iter().map(make).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_valid_and_the_first_ones_hold_all_kinds_levels_and_elements() {
        let battery: Vec<Case> = (0..630)
            .map(|number| Case::new(number).unwrap_or_else(|e| panic!("scene {number}: {e}")))
            .collect();
        for entry in others().unwrap() {
            entry.scene.validate().unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        }
        let kinds: Vec<Kind> = battery[..18].iter().map(|case| case.kind).collect();
        assert_eq!(kinds, Kind::ALL);
        let count = |of: &dyn Fn(&Case) -> bool| battery.iter().filter(|case| of(case)).count();
        assert_eq!(count(&|case| case.scene.accuracy == Accuracy::Reference), 90);
        let other = count(&|case| Discretisation::new(&case.scene).element != case.element_of_truth());
        assert!((50..80).contains(&other), "{other}");
        assert_eq!(count(&|case| case.mesh().unwrap().is_some()), 35);
        assert!(count(&|case| case.scene.unused().iter().any(|e| e.path != "numerics.domain")) == 0);
    }

    #[test]
    fn a_scene_depends_on_nothing_but_its_number() {
        assert_eq!(Case::new(77), Case::new(77));
        let mut draw = Draw { number: 5, count: 0 };
        let drawn: Vec<f64> = (0..1000).map(|_| draw.share()).collect();
        let mean = drawn.iter().sum::<f64>() / 1000.0;
        assert!((mean - 0.5).abs() < 0.03 && drawn.iter().all(|x| (0.0..1.0).contains(x)), "{mean}");
    }
}
