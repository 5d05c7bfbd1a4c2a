//! Settings of an extraction.

use crate::error::InputError;
use asperity_material::units::Length;
use asperity_roughness::Closure;
use asperity_roughness::asperities::Direction;
use asperity_simulation::scene::Accuracy;
use std::str::FromStr;

/// Rule by which the map is divided into asperities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parts {
    /// Islands above the separation of the scene's load: its own, or the one at which this closure carries
    /// its pressure; none named: the first of the scene that presses islands (of "all" `published`).
    Load(Option<Closure>),
    /// Islands above this separation from the mean plane.
    Separation(Length),
    /// Islands above the plane that this share of the measured points is above.
    Share(f64),
    /// Hills of ISO 25178-2 that rise by at least this share of the surface's height.
    Hills(f64),
}

/// A line of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineAt {
    /// The direction in which it runs.
    pub direction: Direction,
    /// Its position across that, from the first node.
    pub at: Length,
}

impl FromStr for LineAt {
    type Err = String;

    fn from_str(text: &str) -> Result<LineAt, String> {
        let form =
            || "write it as x=PLACE (a column) or y=PLACE (a row), for example \"y=0.2 mm\"".to_string();
        let (axis, place) = text.split_once('=').ok_or_else(form)?;
        let direction = match axis.trim() {
            // the points of equal y lie along x
            "y" => Direction::X,
            "x" => Direction::Y,
            _ => return Err(form()),
        };
        let at = place.parse().map_err(|e: asperity_material::units::UnitError| e.to_string())?;
        Ok(LineAt { direction, at })
    }
}

/// Settings of an extraction.
#[derive(Clone, Debug, PartialEq)]
pub struct Extraction {
    /// Rule by which the map is divided into asperities.
    pub parts: Parts,
    /// Depth to which the asperities are to be crushed; absent: down to the plane of islands, half the rise
    /// of hills.
    pub depth: Option<Length>,
    /// Asperities, from the highest down, that get a profile and a scene.
    pub bodies: usize,
    /// Lines of the map that get a profile and a scene in plane strain.
    pub lines: Vec<LineAt>,
    /// Accuracy of the scenes.
    pub accuracy: Accuracy,
}

/// Asperities with a profile unless told.
const BODIES: usize = 20;
/// Share of the points above the plane unless told.
const SHARE: f64 = 0.1;

impl Default for Extraction {
    /// Twenty bodies of islands above the plane that a tenth of the points is above, scenes at `standard`.
    fn default() -> Extraction {
        Extraction {
            parts: Parts::Share(SHARE),
            depth: None,
            bodies: BODIES,
            lines: Vec::new(),
            accuracy: Accuracy::Standard,
        }
    }
}

/// Summits that are crushed to judge closures.
const JUDGING_SUMMITS: usize = 3;

impl Extraction {
    /// The highest summits above the plane at which `calibrated` carries the load of the scene, at `draft`:
    /// enough to tell closures apart that differ by tens of percent, in seconds.
    pub fn to_judge() -> Extraction {
        Extraction {
            parts: Parts::Load(Some(Closure::Calibrated)),
            bodies: JUDGING_SUMMITS,
            accuracy: Accuracy::Draft,
            ..Extraction::default()
        }
    }

    /// Checks the values that need no map.
    ///
    /// # Errors
    /// The first that makes no sense.
    pub(super) fn check(&self) -> Result<(), InputError> {
        let error = |message: String| Err(InputError::new(message));
        match self.parts {
            Parts::Share(share) if !(share > 0.0 && share < 1.0) => error(format!(
                "share = {share} is not possible: it must be above 0 and below 1, for example 0.1"
            )),
            Parts::Hills(prune) if !(0.0..1.0).contains(&prune) => error(format!(
                "hills = {prune} is not possible: it must be at least 0 and below 1, for example 0.05"
            )),
            _ => match self.depth {
                Some(depth) if depth.0.is_nan() || depth.0 <= 0.0 => error(format!(
                    "depth = {depth} is not possible: it must be above 0, for example \"0.5 um\""
                )),
                _ => Ok(()),
            },
        }
    }
}
