//! Force and contact area of each closure for one asperity pressed by a plane to a depth.

use super::bodies::Body;
use super::rows::Carried;
use crate::error::InputError;
use crate::rough::{RoughScene, half_space_of};
use asperity_material::HardeningLaw;
use asperity_roughness::half_space::{HalfSpace, PressureLimit};
use asperity_roughness::scene::Scene;
use asperity_roughness::{Closure, ClosureLaw, Islands, Load, Surface};
use std::f64::consts::PI;

/// Points along each side of the map that a body of revolution is pressed on as a half-space.
const NODES: usize = 256;
/// Half the side of that map over the radius at which the plane cuts the body: the true contact is smaller.
const MARGIN: f64 = 1.25;

/// The closures that a metal allows.
#[derive(Debug)]
pub(super) struct Closures {
    laws: Vec<ClosureLaw>,
    spaces: Vec<Closure>,
    scene: Scene,
    law: HardeningLaw,
    /// The reason why the others are not there.
    pub skipped: Vec<String>,
}

/// Force and contact area of one closure.
pub(super) struct Given {
    pub closure: Closure,
    /// For the body of revolution, or why nothing.
    pub body: Result<Carried, String>,
    /// For the asperity as it stands on the map; none of a half-space.
    pub island: Option<Carried>,
}

impl Closures {
    /// All that the metal of `scene` allows, whichever closure the scene names.
    ///
    /// # Errors
    /// A calibration that cannot be read.
    pub fn for_scene(scene: &RoughScene) -> Result<Closures, InputError> {
        let tables = scene.tables();
        let coefficient = scene.calibration()?;
        let (mut laws, mut spaces, mut skipped) = (Vec::new(), Vec::new(), Vec::new());
        for closure in Closure::ALL {
            if closure.is_half_space() {
                let known = closure == Closure::HalfSpace || tables.material.limit().is_some();
                spaces.extend(known.then_some(closure));
                continue;
            }
            match ClosureLaw::new(closure, &tables.material, Some(&coefficient)) {
                Ok(law) => laws.push(law),
                Err(e) => skipped.push(format!("skipped: {e}")),
            }
        }
        Ok(Closures { laws, spaces, scene: tables.clone(), law: scene.hardening_law()?, skipped })
    }

    /// Force and contact area of each for `body` on `surface` at `depth` (m).
    pub fn answers_at(&self, body: &Body, surface: &Surface, depth: f64) -> Vec<Given> {
        let (area, slope) = body.profile.area_and_slope(depth);
        let top = surface.map.row(body.asperity.summit[1])[body.asperity.summit[0]];
        let islands = Islands::above_plane(&surface.map, top - depth);
        let island = islands.holding(body.asperity.summit);
        let cones = self.laws.iter().map(|law| Given {
            closure: law.closure,
            body: Ok(carried(law, area, slope)),
            island: island.map(|island| carried(law, island.area, island.slope)),
        });
        let half_width = MARGIN * (area / PI).sqrt();
        let limit = PressureLimit::at_slope(&self.scene.material, self.law, slope).map(|l| l.pressure);
        let spaces = self.spaces.iter().map(|&closure| Given {
            closure,
            body: on_half_space(
                &half_space_of(&self.scene, limit.filter(|_| closure != Closure::HalfSpace)),
                body,
                half_width,
                depth,
            ),
            island: None,
        });
        cones.chain(spaces).collect()
    }
}

/// Force and contact area of an island of this area and mean gradient.
fn carried(law: &ClosureLaw, area: f64, slope: f64) -> Carried {
    let response = law.respond(slope);
    Carried { force: response.island_pressure * area, area: response.area_ratio * area }
}

/// The body alone on a half-space.
fn on_half_space(space: &HalfSpace, body: &Body, half_width: f64, depth: f64) -> Result<Carried, String> {
    let alone = body.profile.surface(half_width, NODES).map_err(|e| e.to_string())?;
    let separation = body.profile.height() - depth - alone.parameters.mean;
    let found = space.press(&alone, Load::Separation(separation)).map_err(|e| e.to_string())?;
    Ok(Carried {
        force: found.pressure * found.nominal_area,
        area: found.area.corrected * found.nominal_area,
    })
}
