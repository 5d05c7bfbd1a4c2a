//! Numbers of a contact at one scale that a closure, a half-space or a theory may have.

use super::persson::PerssonArea;
use super::slopes::Slopes;
use crate::Contact;
use crate::half_space::Area;

/// The task at one scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// The elastic half-space.
    Elastic,
    /// The half-space with the limit of pressure of its patches.
    Limited,
    /// The same with the limit of pressure of the mean slope at this scale.
    LimitedBySlope,
    /// A closure of islands, by its name.
    Islands(&'static str),
    /// Persson's theory, elastic.
    Persson,
    /// The same with the limit of pressure.
    PerssonLimited,
    /// The limit of pressure all over the contact.
    Bearing,
}

impl By {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            By::Elastic => "half-space",
            By::Limited => "half-space-plastic",
            By::LimitedBySlope => "half-space-plastic-by-slope",
            By::Islands(name) => name,
            By::Persson => "persson",
            By::PerssonLimited => "persson-plastic",
            By::Bearing => "bearing",
        }
    }
}

/// Numbers of a contact, none where what pressed it has none; in SI.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Numbers {
    /// Contact area over nominal area, of a half-space by pixels.
    pub area_ratio: Option<f64>,
    /// Of a half-space: the area corrected for pixels, with the bound of its error.
    pub area: Option<Area>,
    /// Nominal pressure over contact area.
    pub mean_pressure: Option<f64>,
    /// Pressures that half and 99 % of the contact are below, and the largest.
    pub pressures: [Option<f64>; 3],
    /// Mean distance of plane and surface.
    pub mean_gap: Option<f64>,
    /// Gaps of the critical constrictions along x and y.
    pub critical_gaps: [Option<f64>; 2],
    /// Leaks along x and y, m³.
    pub leaks: [Option<f64>; 2],
    /// Their relative errors.
    pub leak_errors: [Option<f64>; 2],
    /// -dp/d(mean gap).
    pub stiffness: Option<f64>,
    /// Shares of the load in the three regimes.
    pub by_load: [Option<f64>; 3],
    /// The same of the area.
    pub by_area: [Option<f64>; 3],
    /// Limit of pressure.
    pub limit: Option<f64>,
    /// Share of the contact area at the limit.
    pub limited_share: Option<f64>,
}

/// A surface at one scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The cut-off, in metres.
    pub cutoff: f64,
    /// The shortest wave, in metres (see [`super::Scale`]).
    pub wave: f64,
    /// Distance of the points of its grid along x, in metres.
    pub grid: f64,
    /// Root mean square height, in metres.
    pub sq: f64,
    /// Slopes and curvatures.
    pub slopes: Slopes,
    /// Its contacts.
    pub contacts: Vec<(By, Numbers)>,
}

impl Numbers {
    /// Of islands, whose regimes are those of their closure.
    pub(super) fn of_islands(found: &Contact, limit: Option<f64>) -> Numbers {
        let by_area = found.shares.map_or([None; 3], |shares| shares.map(Some));
        let area_ratio = Some(found.area_ratio);
        Numbers { area_ratio, mean_pressure: found.mean_pressure(), by_area, limit, ..Numbers::default() }
    }

    /// Of a contact area ratio under the nominal `pressure`.
    pub(super) fn of_area(area: f64, pressure: f64, limit: Option<f64>) -> Numbers {
        let mean_pressure = (area > 0.0).then(|| pressure / area);
        Numbers { area_ratio: Some(area), mean_pressure, limit, ..Numbers::default() }
    }

    /// Of Persson's theory.
    pub(super) fn of_persson(found: &PerssonArea, pressure: f64, limit: Option<f64>) -> Numbers {
        let limited_share = limit.filter(|_| found.total() > 0.0).map(|_| found.plastic / found.total());
        Numbers { limited_share, ..Numbers::of_area(found.total(), pressure, limit) }
    }

    /// Nominal pressure over the corrected area.
    pub fn corrected_pressure(&self) -> Option<f64> {
        let area = self.area.filter(|area| area.corrected > 0.0)?;
        Some(self.mean_pressure? * area.ratio / area.corrected)
    }
}
