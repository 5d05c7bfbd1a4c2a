//! `zones.json`: the elastic zones of a row of asperities at the peak, enclosed by metal that yields or has
//! yielded.
//!
//! Two quantities bound them, both continuous over the mesh: what the metal itself says, first yield, and
//! what the paper's Figure 5 draws, the von Mises stress against the first yield stress. Metal that has
//! yielded may carry less than that and be elastic again.

use asperity::simulation::run::FieldFrame;
use asperity::simulation::scene::{Scene, Symmetry};
use asperity::solver::body::islands::enclosed_regions;
use asperity::units::{MEGAPASCAL, MICROMETRE};
use serde::{Deserialize, Serialize};

/// Share of the section of one asperity up to which a zone is none: the line that bounds a zone is that
/// exact.
const LEAST_SHARE: f64 = 0.01;

/// A zone of the section before the crush.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Zone {
    /// Its centroid (r, z), µm.
    pub place: [f64; 2],
    /// Its area, µm².
    pub area: f64,
    /// Its mean hydrostatic pressure over the section, MPa.
    pub pressure: f64,
}

/// The zones of a row on one mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Zones {
    /// Zones in which the metal never yielded.
    pub never_yielded: Vec<Zone>,
    /// Zones in which the von Mises stress is below the first yield stress.
    pub below_yield: Vec<Zone>,
    /// Places of the outermost summits, µm.
    pub summits: [f64; 2],
    /// Depth of the valleys between the asperities, µm.
    pub height: f64,
    /// Area up to which a zone is none, µm².
    pub least: f64,
}

impl Zones {
    /// The zones in `frame`, a state of `scene`, whose asperities are alike; `None` for a body that never
    /// yields.
    pub fn new(frame: &FieldFrame, scene: &Scene) -> Option<Zones> {
        let limit = scene.material.yield_stress?.0;
        let fields = &frame.fields;
        let height = scene.highest();
        let surface = frame.mesh.sides.surface.iter().flat_map(|&edge| frame.mesh.edge_nodes(edge).0);
        let risen = surface.map(|node| frame.mesh.nodes[node as usize]).filter(|[_, z]| *z > -0.999 * height);
        let [left, right] =
            risen.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [r, _]| [low.min(r), high.max(r)]);
        // of a body of revolution half of the first asperity is in the section
        let revolved = scene.symmetry == Symmetry::Axisymmetric;
        let half_widths = 2.0 * scene.asperity_count() as f64 - if revolved { 1.0 } else { 0.0 };
        let half_width = (right - left) / half_widths;
        let first = if revolved { 0.0 } else { left + half_width };
        let zone = |values: &[f64]| -> Vec<Zone> {
            let found = enclosed_regions(&frame.mesh, &frame.mesh.nodes, values);
            let inside = found.into_iter().filter(|region| (left..right).contains(&region.centre[0]));
            inside
                .map(|region| Zone {
                    place: region.centre.map(|x| x / MICROMETRE),
                    area: region.area / (MICROMETRE * MICROMETRE),
                    pressure: region.mean(&fields.pressure, |_| 1.0) / MEGAPASCAL,
                })
                .collect()
        };
        let stress: Vec<f64> = fields.von_mises.iter().map(|s| s - limit).collect();
        Some(Zones {
            never_yielded: zone(&fields.first_yield),
            below_yield: zone(&stress),
            summits: [first, right - half_width].map(|x| x / MICROMETRE),
            height: height / MICROMETRE,
            least: LEAST_SHARE * half_width * height / (MICROMETRE * MICROMETRE),
        })
    }

    /// The zones between the asperities: they lie between summits and nearer to the valley than it is deep.
    pub fn valley_zones(&self) -> Vec<Zone> {
        let near = |zone: &&Zone| {
            let [r, z] = zone.place;
            r > self.summits[0] && r < self.summits[1] && z > -2.0 * self.height
        };
        self.below_yield.iter().filter(near).copied().collect()
    }
}

/// The area of all zones.
pub fn area(zones: &[Zone]) -> f64 {
    zones.iter().fold(0.0, |sum, zone| sum + zone.area)
}
