//! A hardening law, a tool and a closure that another crate hands in give what the built-in ones give, stand
//! by name and parameters in results, and are refused with a sentence where a file holds them. A punch is a
//! tool by the same door.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity::tables::{Accuracy, Asperity, Loading, Material, Scene as Tables, Symmetry, Tool};
use asperity::{
    Closure, Crush, FlowCurve, IslandClosure, Length, Penetration, Regime, Response, RoughScene, Scene,
    Stress, ToolOutline, crush, press,
};
use std::path::Path;
use std::sync::Arc;

const MODULUS: f64 = 210e9;
const YIELD: f64 = 300e6;
const EXPONENT: f64 = 0.3;

/// Swift's σ = σ_y (1 + E ε_p/σ_y)^n.
#[derive(Debug)]
struct Swift;

impl FlowCurve for Swift {
    fn name(&self) -> &str {
        "my-swift"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![("yield_stress_Pa", YIELD), ("exponent", EXPONENT)]
    }

    fn flow(&self, plastic_strain: f64) -> [f64; 2] {
        let grown = 1.0 + MODULUS / YIELD * plastic_strain;
        [YIELD * grown.powf(EXPONENT), EXPONENT * MODULUS * grown.powf(EXPONENT - 1.0)]
    }
}

/// A sharp cone by its distance.
#[derive(Debug)]
struct Cone {
    tan: f64,
}

impl ToolOutline for Cone {
    fn name(&self) -> &str {
        "my-cone"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![("tan_slope", self.tan)]
    }

    fn penetration(&self, [r, z]: [f64; 2]) -> Penetration {
        let secant = self.tan.hypot(1.0);
        let (sine, cosine) = (self.tan / secant, 1.0 / secant);
        Penetration { depth: z * cosine - r * sine, slope: [-sine, cosine], curvature: [0.0; 3] }
    }
}

/// The published p = 0.13 E* tan β, for a metal whose hardness is `HARDNESS`.
#[derive(Debug)]
struct Published;

const HARDNESS: f64 = 1280e6;

impl Published {
    fn modulus(&self) -> f64 {
        0.13 * MODULUS / (1.0 - 0.3 * 0.3)
    }
}

impl IslandClosure for Published {
    fn name(&self) -> &str {
        "my-published"
    }

    fn source(&self) -> &str {
        "p = 0.13 E* tan(beta)"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![("modulus_Pa", self.modulus())]
    }

    fn respond(&self, tan_beta: f64) -> Response {
        let island_pressure = self.modulus() * tan_beta;
        let regime = match island_pressure / HARDNESS {
            index if index < 0.6 => Regime::Elastic,
            index if index <= 1.0 => Regime::Elastoplastic,
            _ => Regime::Plastic,
        };
        Response { island_pressure, area_ratio: 1.0, regime, inside: true }
    }
}

fn run(tables: &Tables) -> Crush {
    let crush = crush(&Scene::new(tables).unwrap(), &mut |_| true).unwrap();
    assert_eq!(crush.summary.stopped, None);
    crush
}

fn asperity_of(material: Material) -> Tables {
    Tables::new(Symmetry::Axisymmetric, material, Tool::plane(), Loading::to_depth(Length(2e-6)).unloaded())
        .with(Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6)))
        .with_accuracy(Accuracy::Draft)
}

fn elastic() -> Material {
    Material::elastic_body(Stress(MODULUS), 0.3)
}

fn same(a: &Crush, b: &Crush, tolerance: f64) {
    let peak = a.summary.peak_force;
    assert_eq!(a.curve.len(), b.curve.len());
    for (a, b) in a.curve.iter().zip(&b.curve) {
        assert!((a.force - b.force).abs() < tolerance * peak, "{} {}", a.force, b.force);
    }
    let works = [a, b].map(|crush| crush.summary.plastic_work);
    assert!((works[0] - works[1]).abs() <= 1e-6 * works[0].abs(), "{works:?}");
}

#[test]
fn a_copy_of_swifts_law_gives_its_force() {
    let built_in = asperity_of(elastic().yielding(Stress(YIELD), EXPONENT));
    let text = Scene::new(&built_in).unwrap().with(&["material.hardening_law=swift".into()]).unwrap();
    let exact = crush(&text, &mut |_| true).unwrap();
    let own = run(&asperity_of(elastic().hardening_as(Arc::new(Swift))));
    same(&exact, &own, 1e-6);

    let summary = serde_json::to_value(&own.summary).unwrap();
    let material = &summary["scene"]["material"];
    assert_eq!(material["hardening_law"], "custom");
    assert_eq!(material["custom"]["name"], "my-swift");
    assert_eq!(material["custom"]["parameters"]["exponent"], EXPONENT);
}

#[test]
fn a_law_stays_with_its_scene_and_no_file_holds_it() {
    let file = "symmetry = \"axisymmetric\"\n[material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n\
        [[asperity]]\nheight = \"20 um\"\nslope_deg = 10\n[loading]\ndepth = \"2 um\"\n";
    let scene = || Scene::from_toml(file, Path::new("")).unwrap();
    let own = scene().with_law(Arc::new(Swift)).unwrap();
    let deeper = own.with(&["loading.depth=3 um".into()]).unwrap();
    assert_eq!(deeper.tables().material.custom, own.tables().material.custom);
    assert!(deeper.tables().material.hardening().is_some());

    let text = own.to_toml().unwrap();
    assert!(text.contains("my-swift") && text.contains("yield_stress_Pa"), "{text}");
    let refused = Scene::from_toml(&text, Path::new("")).unwrap_err().to_string();
    assert!(refused.contains("\"my-swift\" is a custom hardening law"), "{refused}");

    let both =
        scene().with(&["material.yield_stress=300 MPa".into(), "material.hardening_exponent=0".into()]);
    let refused = both.unwrap().with_law(Arc::new(Swift)).unwrap_err().to_string();
    assert!(refused.contains("does not go with the law"), "{refused}");
    let named = scene().with(&["material.hardening_law=custom".into()]).unwrap_err().to_string();
    assert!(named.contains("a file takes"), "{named}");
}

#[test]
fn a_copy_of_the_cone_gives_its_force() {
    let metal = || elastic().yielding(Stress(YIELD), EXPONENT);
    let indent = |tool| {
        let loading = Loading::to_depth(Length(1e-6)).unloaded();
        run(&Tables::new(Symmetry::Axisymmetric, metal(), tool, loading).with_accuracy(Accuracy::Draft))
    };
    let exact = indent(Tool::cone(10.0));
    let own = indent(Tool::custom(Arc::new(Cone { tan: 10f64.to_radians().tan() })));
    same(&exact, &own, 1e-6);
    let read = [&exact, &own].map(|crush| crush.summary.oliver_pharr.as_ref().unwrap().contact_area);
    assert!((read[0] / read[1] - 1.0).abs() < 1e-6, "{read:?}");

    let summary = serde_json::to_value(&own.summary).unwrap();
    assert_eq!(summary["scene"]["tool"]["shape"], "custom");
    assert_eq!(summary["scene"]["tool"]["custom"]["name"], "my-cone");
    let file = "[material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n[tool]\nshape = \"plane\"\n\
        [loading]\ndepth = \"1 um\"\n[[asperity]]\nheight = \"20 um\"\nslope_deg = 10\n";
    let scene =
        Scene::from_toml(file, Path::new("")).unwrap().with_tool(Arc::new(Cone { tan: 0.1 })).unwrap();
    let text = scene.to_toml().unwrap();
    let refused = Scene::from_toml(&text, Path::new("")).unwrap_err().to_string();
    assert!(refused.contains("\"my-cone\" is a custom tool"), "{refused}");
}

#[test]
fn a_copy_of_a_closure_gives_its_area() {
    let scene = || {
        let text = asperity::scenes::ROUGH_MILLED;
        let overrides = ["closure=published", "load.pressure=100 MPa", "surface.generate.pixels=[128, 128]"];
        RoughScene::from_toml(text, Path::new("")).unwrap().with(&overrides.map(String::from)).unwrap()
    };
    let exact = press(&scene(), &mut |_| true).unwrap();
    let own = press(&scene().with_closure(Arc::new(Published)), &mut |_| true).unwrap();
    let [a, b] = [&exact, &own].map(|rough| &rough.table[0]);
    assert_eq!((a.closure, b.closure), (Closure::Published, Closure::Custom));
    assert!((a.contact_area_ratio / b.contact_area_ratio - 1.0).abs() < 1e-9);
    let [mean, own_mean] = [a, b].map(|row| row.mean_pressure_MPa.unwrap());
    assert!((mean / own_mean - 1.0).abs() < 1e-9);
    let summary = serde_json::to_value(&own.summary).unwrap();
    assert_eq!(summary["scene"]["custom"]["name"], "my-published");
    assert_eq!(summary["closures"][0]["source"], "p = 0.13 E* tan(beta)");

    let kept = scene().with_closure(Arc::new(Published)).with(&["load.pressure=50 MPa".into()]).unwrap();
    assert!(kept.tables().custom.is_some());
    let refused = RoughScene::from_toml("closure = \"custom\"\n[custom]\nname = \"mine\"\n", Path::new(""));
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("\"mine\" is a custom closure"), "{refused}");
}

/// F = 2 E* a h and S = 2 E* a of a flat punch, of which the arc of the edge takes 1 % of the radius.
#[test]
fn a_punch_presses_as_its_closed_form() {
    let text = "accuracy = \"draft\"\n[material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n\
        [tool]\nshape = \"punch\"\nradius = \"20 um\"\nedge_radius = \"0.2 um\"\n[loading]\ndepth = \"0.1 um\"\nunload = true\n";
    let punched = crush(&Scene::from_toml(text, Path::new("")).unwrap(), &mut |_| true).unwrap().summary;
    assert_eq!(punched.stopped, None);
    let stiffness = 2.0 * MODULUS / 0.91 * 20e-6;
    let force = punched.peak_force / (stiffness * 0.1e-6);
    let unloading = punched.unloading_stiffness.unwrap() / stiffness;
    println!("F/(2 E* a h) {force}, S/(2 E* a) {unloading}, {} elements", punched.elements);
    assert!((force - 1.0).abs() < 0.04, "{force}");
    assert!((unloading - 1.0).abs() < 0.04, "{unloading}");
    assert!(punched.elements < 20_000);
}
