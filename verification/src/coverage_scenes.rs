//! A battery of scenes that differ in everything a scene can say: what the stated errors are held against.

use crate::single_asperity::loaded;
use asperity_law::HardeningLaw;
use asperity_law::units::{Length, Stress};
use asperity_solver::scene::{Accuracy, Asperity, Scene, Substrate, Symmetry};

/// A scene with what it is called in a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// A few words.
    pub name: String,
    /// The scene, driven by depth, without unloading and fields.
    pub scene: Scene,
    /// Whether it is to be driven by the force that belongs to its depth instead.
    pub by_force: bool,
}

/// Coordinate `axis` of point `i` of the additive recurrence whose steps are the square roots of primes: fills the unit
/// cube evenly, always the same way.
fn coordinate(i: usize, axis: usize) -> f64 {
    const PRIMES: [f64; 10] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0];
    ((i + 1) as f64 * PRIMES[axis % PRIMES.len()].sqrt()).fract()
}

fn between(share: f64, low: f64, high: f64) -> f64 {
    low + share * (high - low)
}

fn between_logs(share: f64, low: f64, high: f64) -> f64 {
    between(share, low.ln(), high.ln()).exp()
}

/// The scenes of these numbers: slopes of 1 to 45°, sharp to rounded over most of their height, n of 0 to 0.6, E/σ_y of 50
/// to 3000, both laws, elastic bodies, balls, ridges, depths of a twentieth to half of the height.
///
/// # Errors
/// The committed scene file does not read.
pub fn battery(numbers: std::ops::Range<usize>) -> Result<Vec<Entry>, toml::de::Error> {
    numbers.map(entry).collect()
}

fn entry(i: usize) -> Result<Entry, toml::de::Error> {
    let at = |axis: usize| coordinate(i, axis);
    let slope = between_logs(at(0), 1.0, 45.0);
    let height = 20e-6;
    let elastic = at(1) < 0.12;
    let exponent = if at(2) < 0.2 { 0.0 } else { between((at(2) - 0.2) / 0.8, 0.02, 0.6) };
    let ratio = between_logs(at(3), 50.0, 3000.0);
    // the cap of a tip of radius R is R (1 - cos β) high
    let cap = 1.0 - slope.to_radians().cos();
    let tip = if at(4) < 0.3 { 0.0 } else { between_logs(at(4), 0.003, 0.8) * height / cap };
    let ball = at(5) < 0.15;
    let ridge = !ball && at(6) < 0.07;
    let share = between_logs(at(7), 0.05, 0.5);
    let law = if at(8) < 0.5 { HardeningLaw::Hollomon } else { HardeningLaw::Swift };
    let by_force = at(9) < 0.2 && !ridge;

    let mut scene = loaded(Accuracy::Standard)?;
    let modulus = scene.material.youngs_modulus.0;
    scene.material.yield_stress = (!elastic).then_some(Stress(modulus / ratio));
    scene.material.hardening_exponent = (!elastic).then_some(exponent);
    scene.material.hardening_law = law.into();
    let cone = Asperity { slope_deg: Some(slope), tip_radius: Some(Length(tip)), ..scene.asperity[0] };
    let sphere = Asperity {
        radius: Some(Length(4.0 * height)),
        height: None,
        slope_deg: None,
        tip_radius: None,
        ..scene.asperity[0]
    };
    scene.asperity = vec![if ball { sphere } else { cone }];
    if ridge {
        scene.symmetry = Symmetry::PlaneStrain;
        let size = Some(Length(100.0 * height / slope.to_radians().tan()));
        scene.substrate = Some(Substrate { radius: size, depth: size });
    }
    scene.loading.depth = Some(Length(share * height));
    let body = match (ball, ridge) {
        (true, _) => "ball".to_string(),
        (_, true) => format!("ridge {slope:.1}°"),
        _ if tip == 0.0 => format!("sharp {slope:.1}°"),
        _ => format!("{slope:.1}° tip {:.2} h", tip / height),
    };
    let metal = if elastic { "elastic".into() } else { format!("n {exponent:.2} E/σ_y {ratio:.0}") };
    let drive = if by_force { ", by force" } else { "" };
    Ok(Entry { name: format!("{body}, {metal}, to {share:.2} of the height{drive}"), scene, by_force })
}

/// Ten scenes that no level was chosen by: name, slope (degrees; 0: a ball), tip radius (µm), E/σ_y (0: elastic), n,
/// depth (µm) of a height of 20 µm.
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
        Ok(Entry { name: name.into(), scene, by_force: false })
    };
    OTHERS.iter().map(make).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_valid_and_the_battery_holds_all_kinds() {
        let (battery, others) = (battery(0..100).unwrap(), others().unwrap());
        for entry in battery.iter().chain(&others).chain(&super::battery(100..200).unwrap()) {
            entry.scene.validate().unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        }
        let count = |kind: fn(&Entry) -> bool| battery.iter().filter(|e| kind(e)).count();
        assert!((5..25).contains(&count(|e| e.scene.material.yield_stress.is_none())));
        assert!((5..25).contains(&count(|e| e.scene.asperity[0].radius.is_some())));
        assert!((10..30).contains(&count(|e| e.by_force)));
        assert!((2..12).contains(&count(|e| e.scene.symmetry == Symmetry::PlaneStrain)));
        assert!((8..35).contains(&count(|e| e.scene.material.hardening_exponent == Some(0.0))));
    }
}
