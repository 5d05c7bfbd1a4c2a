//! Rows of `asperities.csv` and `compared.csv` of an extraction.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use super::bodies::Body;
use crate::crush::{CurveRow, Summary as CrushSummary};
use crate::results::columns::Unit;
use crate::results::output::row;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use asperity_roughness::asperities::Asperity;
use asperity_simulation::scene::Symmetry;

/// The name of the reference in the column `closure` of `compared.csv`.
pub const FINITE_ELEMENTS: &str = "finite-elements";

row! {
    /// A row of `asperities.csv`: one asperity of the map, from the highest down.
    AsperityRow(number: usize, one: &Asperity, body: Option<&Body>, status: String) {
        /// Its number, from 1.
        asperity: usize = number,
        /// Place of its highest node along x, from the first node of the map.
        x_um: f64 = one.position[0] / MICROMETRE,
        /// The same along y.
        y_um: f64 = one.position[1] / MICROMETRE,
        /// Its highest node above the mean plane.
        height_um: f64 = one.height / MICROMETRE,
        /// Its highest node above the separation; of a hill above its highest saddle to another.
        rise_um: f64 = one.rise / MICROMETRE,
        /// Projected area.
        area_um2: f64 = one.area / MICROMETRE / MICROMETRE,
        /// atan of the mean |∇h| over it, degrees.
        slope_deg: f64 = one.slope.atan().to_degrees(),
        /// Major semi-axis of the ellipse of equal area and second moments; none where they span no ellipse.
        semi_major_um: Option<f64> = one.ellipse.map(|e| e.semi_axes[0] / MICROMETRE),
        /// Minor semi-axis.
        semi_minor_um: Option<f64> = one.ellipse.map(|e| e.semi_axes[1] / MICROMETRE),
        /// Direction of the major axis against x, -90 to 90 degrees.
        direction_deg: Option<f64> = one.ellipse.map(|e| e.direction[1].atan2(e.direction[0]).to_degrees()),
        /// Smaller principal curvature of the summit, positive where the surface falls away.
        tip_curvature_low_per_um: Option<f64> = one.tip.map(|t| t.curvatures[0] * MICROMETRE),
        /// Larger principal curvature.
        tip_curvature_high_per_um: Option<f64> = one.tip.map(|t| t.curvatures[1] * MICROMETRE),
        /// 1 over their mean.
        tip_radius_um: Option<f64> = one.tip.and_then(|t| t.radius()).map(|r| r / MICROMETRE),
        /// Nodes of the map that it holds.
        nodes: usize = one.nodes,
        /// True where it reaches the edge of the map or a point that was not measured.
        cut: bool = one.cut,
        /// Depth to which its scene crushes it; none without a profile, like what follows.
        depth_um: Option<f64> = body.map(|b| b.depth / MICROMETRE),
        /// Area of the body of revolution at the depth.
        profile_area_um2: Option<f64> = body.map(|b| b.profile.area_and_slope(b.depth).0 / MICROMETRE / MICROMETRE),
        /// Slope of the body of revolution down to the depth, degrees.
        profile_slope_deg: Option<f64> = body.map(|b| b.profile.area_and_slope(b.depth).1.atan().to_degrees()),
        /// `ok` with a profile, else why there is none; empty where none was asked for.
        status: String = status,
    }
}

/// Force and contact area that a closure gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carried {
    /// N.
    pub force: f64,
    /// m².
    pub area: f64,
}

row! {
    /// A row of `compared.csv`: what one closure, or the finite elements, give for one asperity at one depth.
    ComparedRow(
        body: &Body, closure: &str, point: &CurveRow, own: Carried, island: Option<Carried>, errors: Option<&CrushSummary>,
        status: &str
    ) {
        /// Number of the asperity.
        asperity: usize = body.number,
        /// Name of the closure, or `finite-elements`.
        closure: String = closure.into(),
        /// Depth from first touch.
        depth_um: f64 = point.depth / MICROMETRE,
        /// atan of the mean |dz/dr| of the body of revolution down to the depth, degrees.
        slope_deg: f64 = body.profile.area_and_slope(written_depth(point)).1.atan().to_degrees(),
        /// Force on the body of revolution.
        force_N: f64 = own.force,
        /// Its contact area.
        contact_area_um2: f64 = own.area / MICROMETRE / MICROMETRE,
        /// Force over contact area; none without contact.
        mean_pressure_MPa: Option<f64> = (own.area > 0.0).then(|| own.force / own.area / MEGAPASCAL),
        /// Force over that of the finite elements.
        force_over_finite_elements: Option<f64> = ratio(own.force, point.force),
        /// Contact area over that of the finite elements.
        area_over_finite_elements: Option<f64> = ratio(own.area / MICROMETRE / MICROMETRE, written_area(point)),
        /// Force of the closure on the asperity as it stands on the map, cut at the same depth; none of a half-space.
        island_force_N: Option<f64> = island.map(|i| i.force),
        /// Its contact area.
        island_contact_area_um2: Option<f64> = island.map(|i| i.area / MICROMETRE / MICROMETRE),
        /// 95 % bound of the relative error of the force of the finite elements.
        force_error: Option<f64> = errors.map(|s| s.errors.force).filter(|e| e.is_finite()),
        /// The same of their contact area.
        area_error: Option<f64> = errors.map(|s| s.errors.contact_area).filter(|e| e.is_finite()),
        /// `ok`, or why there are no numbers.
        status: String = status.into(),
    }
}

/// The depth of a point to the digits that its file has, m.
pub(super) fn written_depth(point: &CurveRow) -> f64 {
    point.depth / MICROMETRE * MICROMETRE
}

/// The contact area of a point as its file has it, µm².
pub(super) fn written_area(point: &CurveRow) -> f64 {
    point.contact_area / Unit::Contact.value(Symmetry::Axisymmetric)
}

fn ratio(a: f64, b: f64) -> Option<f64> {
    Some(a / b).filter(|r| r.is_finite())
}
