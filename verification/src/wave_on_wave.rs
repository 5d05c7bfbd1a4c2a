//! Waves on a wave in plane strain under a rigid plane, by finite elements. Lengths are over the longest
//! wave, stresses over Young's modulus.
//!
//! Half of the longest wave, from its summit to its valley, with smooth walls on both sides: the surface goes
//! on beyond them. The block is one and a half waves deep, where the stress is even (e^-9 of the longest wave
//! is left of it).

use crate::single_increment::{increment, model};
use crate::test_meshes::{mapped, nodes_of};
use asperity_mesh::{ElementKind, Mesh};
use asperity_numerics::newton::Settings;
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool;
use asperity_solver::equilibrium::{Equilibrium, SolveFailure};
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;
use std::f64::consts::TAU;

/// Depth of the block.
const DEPTH: f64 = 1.5;
/// Heights of neighbouring layers of elements; those of the surface are as high as wide.
const GROWTH: f64 = 1.2;
/// Pressure over penetration, in units of the shortest wave: the plane enters a summit by less than a
/// hundredth of what it presses it down.
const PENALTY: f64 = 1e3;
/// Share of the largest load that an increment adds, about.
const LOAD_STEP: f64 = 0.03;
/// Halvings of an increment that does not converge.
const HALVINGS: usize = 12;
/// Pressures that stand for those of an edge in contact.
const SAMPLES: usize = 8;
/// Share of the contact below the high pressure.
const HIGH: f64 = 0.99;
/// The force to 1e-6, far below what the mesh leaves.
const SETTLED: Settings = Settings { tolerance: 1e-6, max_iterations: 40, keep: 0.0 };

/// A sum of waves with their summits at 0.
#[derive(Clone, Debug)]
pub struct Waves {
    /// Of each its number in the longest, and the largest slope.
    pub waves: Vec<[f64; 2]>,
}

/// Contact at one load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveContact {
    /// Nominal pressure over E.
    pub pressure: f64,
    /// Contact over nominal area.
    pub area: f64,
    /// The pressure over E that 99 % of the contact are below.
    pub high_pressure: f64,
}

impl Waves {
    /// The height at `x`.
    pub fn height(&self, x: f64) -> f64 {
        self.waves.iter().map(|[number, slope]| slope / (TAU * number) * (TAU * number * x).cos()).sum()
    }

    /// The largest number of a wave.
    fn finest(&self) -> f64 {
        self.waves.iter().fold(1.0, |most, wave| wave[0].max(most))
    }

    /// Half of the longest wave, with so many elements to the shortest.
    fn mesh(&self, elements: usize) -> Mesh {
        let columns = (0.5 * self.finest() * elements as f64).round() as usize;
        let top = 0.5 / columns as f64;
        let layers = ((1.0 + DEPTH * (GROWTH - 1.0) / top).ln() / GROWTH.ln()).round();
        let whole = GROWTH.powf(layers) - 1.0;
        mapped(ElementKind::Quad8, [columns, layers as usize], |[s, t]| {
            let below = (GROWTH.powf(layers * (1.0 - t)) - 1.0) / whole;
            [0.5 * s, (1.0 - below) * self.height(0.5 * s) - DEPTH * below]
        })
    }

    /// The contact by finite elements at each of `pressures`, which rise, with so many elements to the
    /// shortest wave.
    ///
    /// # Errors
    /// An increment that does not converge, however small.
    pub fn crushed(
        &self,
        metal: &Metal,
        pressures: &[f64],
        elements: usize,
    ) -> Result<Vec<WaveContact>, SolveFailure> {
        let mesh = self.mesh(elements);
        let mut held = vec![[false; 2]; mesh.nodes.len()];
        for side in [&mesh.sides.axis, &mesh.sides.outer] {
            nodes_of(&mesh, side).iter().for_each(|&node| held[node][0] = true);
        }
        nodes_of(&mesh, &mesh.sides.base).iter().for_each(|&node| held[node][1] = true);
        let penalty = PENALTY * self.finest();
        let contact = ToolContact { tool: Tool::Plane, penalty, friction: None };
        let mut model = model(&mesh, Symmetry::PlaneStrain, metal.clone(), &held, Some(contact))?;
        let most = pressures.last().copied().unwrap_or(0.0);
        let top = self.height(0.0);
        // of the load of the first increment nothing is known yet
        let (mut travel, mut step, mut last) = (0.0, 1e-4 / self.finest(), 0.0);
        let mut path = Vec::new();
        while last < most {
            let mut halvings = 0;
            while let Err(failure) = increment(&mut model, top - travel - step, &SETTLED, |_| [0.0; 2]) {
                halvings += 1;
                step *= 0.5;
                if halvings > HALVINGS {
                    return Err(failure);
                }
            }
            travel += step;
            let found = read(&model);
            step *= (LOAD_STEP * most / (found.pressure - last).max(1e-12)).clamp(0.5, 2.0);
            last = found.pressure;
            path.push(found);
        }
        Ok(pressures.iter().map(|p| interpolated(&path, *p)).collect())
    }
}

/// The contact as it stands.
fn read(model: &Equilibrium<'_>) -> WaveContact {
    let mut samples: Vec<[f64; 2]> = Vec::new();
    for edge in model.contacts().iter().filter(|edge| edge.area > 0.0) {
        let place = |k: usize| (2 * k + 1) as f64 / SAMPLES as f64 - 1.0;
        let sample = |k: usize| [edge.line[0] + edge.line[1] * place(k), edge.area / SAMPLES as f64];
        samples.extend((0..SAMPLES).map(sample));
    }
    samples.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let whole: f64 = samples.iter().map(|s| s[1]).sum();
    let mut sum = 0.0;
    let below = samples.iter().find(|s| {
        sum += s[1];
        sum >= HIGH * whole
    });
    // half of the wave is half a unit wide
    let pressure = 2.0 * model.contacts().iter().map(|edge| edge.load).sum::<f64>();
    WaveContact { pressure, area: 2.0 * whole, high_pressure: below.map_or(0.0, |s| s[0]) }
}

/// The contact at `pressure`, a straight line between those of `path`.
fn interpolated(path: &[WaveContact], pressure: f64) -> WaveContact {
    let i = path.partition_point(|one| one.pressure < pressure).clamp(1, path.len() - 1);
    let (a, b) = (path[i - 1], path[i]);
    let share = (pressure - a.pressure) / (b.pressure - a.pressure);
    let between = |a: f64, b: f64| a + share * (b - a);
    WaveContact {
        pressure,
        area: between(a.area, b.area),
        high_pressure: between(a.high_pressure, b.high_pressure),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::single_increment::ELASTIC_METAL;
    use std::f64::consts::PI;

    /// Westergaard 1939 (Johnson 1985, section 13.2): contact on sin²(πa/λ) = p/p*, p* = πE*Δ/λ with the
    /// amplitude Δ, and the pressure 2p̄ cos(πx/λ) √(sin²(πa/λ) - sin²(πx/λ))/sin²(πa/λ) there. Tolerance: 20
    /// elements in the contact, clipped within them; the slope of 1 % is finite.
    #[test]
    fn one_wave_touches_as_westergaard_says() {
        let slope = 0.01;
        let full = 0.5 * slope / (1.0 - 0.3 * 0.3);
        let wave = Waves { waves: vec![[1.0, slope]] };
        let loads = [0.1, 0.3].map(|share| share * full);
        for found in wave.crushed(&ELASTIC_METAL, &loads, 96).unwrap() {
            let share = found.pressure / full;
            let half = share.sqrt().asin() / PI;
            assert!((found.area / (2.0 * half) - 1.0).abs() < 0.01, "{found:?} {half}");
            // at a hundredth of the contact, which is next to the middle
            let x = PI * 0.01 * half;
            let high = 2.0 * found.pressure * x.cos() * (share - x.sin().powi(2)).sqrt() / share;
            assert!((found.high_pressure / high - 1.0).abs() < 0.01, "{found:?} {high}");
        }
    }
}
