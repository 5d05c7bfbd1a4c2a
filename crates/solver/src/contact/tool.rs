//! A rigid tool is a signed gap function of position, nothing more.

use asperity_mesh::OwnTool;
pub use asperity_mesh::Penetration;
use asperity_mesh::outline::Outline;
use asperity_mesh::profile::{Asperity, Shape};
use std::sync::Arc;

/// Shape of a rigid axisymmetric (or prismatic) tool that moves along z. Lengths are the scene's own.
#[derive(Clone, Debug, PartialEq)]
pub enum Tool {
    /// A plane, normal to z.
    Plane,
    /// A cone pointing down, flanks rising by `tan_slope`, its tip rounded by `tip_radius` (0: sharp).
    Cone {
        /// tan β of the flank against the plane.
        tan_slope: f64,
        /// Radius of the rounded tip.
        tip_radius: f64,
    },
    /// A sphere (cylinder in plane strain).
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A measured outline, as the rise from its apex on the axis; it goes straight on beyond its end.
    Measured(Arc<Outline>),
    /// An outline that is given by functions, of this program or of another crate.
    Own(OwnTool),
}

/// A place of an outline at which its curvature jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kink {
    /// Distance from the axis.
    pub radius: f64,
    /// Height above the lowest point.
    pub rise: f64,
    /// Slope (tangent) of the outline there.
    pub slope: f64,
}

impl Tool {
    /// Hands over the kinks of the outline beside which points between the radii `ends` (signed) may lie.
    pub fn kinks_near(&self, [low, high]: [f64; 2], hear: &mut dyn FnMut(Kink)) {
        // a point lies beside its foot, by its depth at most: the ends with as much room as they are apart
        let width = high - low;
        let [inner, outer] = if low >= 0.0 { [low, high] } else { [0.0, high.max(-low)] };
        let near = |radius: f64| (inner - width..=outer + width).contains(&radius);
        match self {
            Tool::Plane | Tool::Sphere { .. } => {}
            &Tool::Cone { tan_slope, tip_radius } => {
                let secant = tan_slope.hypot(1.0);
                let sine = tan_slope / secant;
                // 1 - cos β without cancellation
                let rise = tip_radius * sine * tan_slope / (1.0 + secant);
                let slope = if tip_radius > 0.0 { tan_slope } else { 0.0 };
                let radius = tip_radius * sine;
                if near(radius) {
                    hear(Kink { radius, rise, slope });
                }
            }
            Tool::Measured(outline) => {
                for [radius, rise, slope] in outline.joints_between([inner - width, outer + width]) {
                    hear(Kink { radius, rise, slope });
                }
            }
            Tool::Own(tool) => {
                for radius in tool.kinks().into_iter().filter(|radius| near(*radius)) {
                    hear(Kink { radius, rise: tool.rise(radius), slope: tool.slope(radius) });
                }
            }
        }
    }

    /// The tool as an asperity of the same outline: the contact of the two is the same to first order in the
    /// slope. `None` for a plane.
    pub fn mirrored(&self) -> Option<Asperity> {
        let shape = match self {
            Tool::Plane => return None,
            Tool::Cone { tan_slope, tip_radius } => {
                Shape::Cone { tan_slope: *tan_slope, tip_radius: *tip_radius }
            }
            Tool::Sphere { radius } => Shape::Sphere { radius: *radius },
            Tool::Measured(outline) => Shape::Measured(outline.clone()),
            Tool::Own(tool) => Shape::Own(tool.clone()),
        };
        Some(Asperity { shape, height: f64::INFINITY, centre: 0.0, valley_radius: 0.0 })
    }

    /// Penetration of the point `x` when the lowest point of the tool is at height `tip`.
    pub fn penetration(&self, x: [f64; 2], tip: f64) -> Penetration {
        match self {
            Tool::Plane => Penetration { depth: x[1] - tip, slope: [0.0, 1.0], curvature: [0.0; 3] },
            &Tool::Sphere { radius } => inside_sphere(x, tip + radius, radius),
            Tool::Measured(outline) => inside_outline(x, tip, outline),
            Tool::Own(tool) => tool.penetration(x, tip),
            &Tool::Cone { tan_slope, tip_radius } => {
                let (r, side) = (x[0].abs(), if x[0] < 0.0 { -1.0 } else { 1.0 });
                let secant = tan_slope.hypot(1.0);
                let (sine, cosine) = (tan_slope / secant, 1.0 / secant);
                // centre of the tip sphere above its lowest point; the flank touches the sphere at the angle
                // β
                let centre = tip + tip_radius;
                if tip_radius > 0.0 && r <= tan_slope * (centre - x[1]) {
                    return inside_sphere(x, centre, tip_radius);
                }
                // signed distance to the flank through (R sin β, centre - R cos β)
                let depth = (x[1] - centre) * cosine - r * sine + tip_radius;
                Penetration { depth, slope: [-side * sine, cosine], curvature: [0.0; 3] }
            }
        }
    }
}

/// Least of what a curvature leaves of the distance to its centre: deeper points are past it, which no
/// contact is.
const LEAST_RADIUS: f64 = 1e-3;

/// Signed distance to an outline: with κ its curvature at the foot of the point and d the depth, the level
/// lines of the depth have the curvature κ/(1 - κd) there.
fn inside_outline(x: [f64; 2], tip: f64, outline: &Outline) -> Penetration {
    let (r, side) = (x[0].abs(), if x[0] < 0.0 { -1.0 } else { 1.0 });
    let z = x[1] - tip;
    if z == f64::NEG_INFINITY {
        return Penetration { depth: z, slope: [0.0, 1.0], curvature: [0.0; 3] }; // the tool is gone
    }
    let foot = outline.foot(r, z);
    if foot.corner {
        let near = inside_sphere([r - foot.x, z], foot.drop, 0.0);
        let ([nr, nz], [rr, zz, rz]) = (near.slope, near.curvature);
        return Penetration { slope: [side * nr, nz], curvature: [rr, zz, side * rz], ..near };
    }
    let secant = foot.slope.hypot(1.0);
    let (sine, cosine) = (foot.slope / secant, 1.0 / secant);
    let depth = (z - foot.drop) * cosine - (r - foot.x) * sine;
    let curvature = foot.bend * cosine.powi(3);
    let level = curvature / (1.0 - curvature * depth).max(LEAST_RADIUS);
    Penetration {
        depth,
        slope: [-side * sine, cosine],
        curvature: [-level * cosine * cosine, -level * sine * sine, -side * level * cosine * sine],
    }
}

fn inside_sphere(x: [f64; 2], centre: f64, radius: f64) -> Penetration {
    let (r, z) = (x[0], x[1] - centre);
    let distance = r.hypot(z);
    if distance == 0.0 {
        return Penetration { depth: radius, slope: [0.0, 1.0], curvature: [0.0; 3] };
    }
    let (n, m) = (r / distance, z / distance);
    Penetration {
        depth: radius - distance,
        slope: [-n, -m],
        curvature: [-(m * m) / distance, -(n * n) / distance, n * m / distance],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_mesh::Punch;
    use asperity_mesh::outline::Parabola;

    /// Slope and curvature are the derivatives of the depth (central differences, step 1e-5: error ≈ 1e-10),
    /// which is the same for tool and point raised together and on either side of the axis.
    #[test]
    fn derivatives_are_the_derivatives() {
        let tools = [
            Tool::Plane,
            Tool::Sphere { radius: 3.0 },
            Tool::Cone { tan_slope: 0.4, tip_radius: 0.0 },
            Tool::Cone { tan_slope: 0.4, tip_radius: 2.0 },
            Tool::Measured(bowl(true)),
            Tool::Measured(bowl(false)),
            Tool::Own(OwnTool::new(Arc::new(Punch { radius: 1.8, edge_radius: 0.7 })).in_units_of(0.9)),
        ];
        let d = 1e-5;
        for tool in tools {
            // the last one below the kinks
            for x in [[0.1, 0.2], [0.6, 0.1], [1.5, 0.4], [2.0, -0.3], [-1.1, 0.3], [-1.285, -0.25]] {
                let at = |r: f64, z: f64| tool.penetration([r, z], -0.1);
                let here = at(x[0], x[1]);
                let (raised, other) = (tool.penetration([x[0], x[1] + 2.7], 2.6), at(-x[0], x[1]));
                assert!((raised.depth - here.depth).abs() < 1e-12, "{tool:?} {x:?}");
                assert!((other.depth - here.depth).abs() < 1e-12, "{tool:?} {x:?}");
                assert!((other.slope[0] + here.slope[0]).abs() < 1e-12, "{tool:?} {x:?}");
                let (left, right) = (at(x[0] - d, x[1]), at(x[0] + d, x[1]));
                let (below, above) = (at(x[0], x[1] - d), at(x[0], x[1] + d));
                assert!(((right.depth - left.depth) / (2.0 * d) - here.slope[0]).abs() < 1e-8);
                assert!(((above.depth - below.depth) / (2.0 * d) - here.slope[1]).abs() < 1e-8);
                assert!(((right.slope[0] - left.slope[0]) / (2.0 * d) - here.curvature[0]).abs() < 1e-8);
                assert!(((above.slope[1] - below.slope[1]) / (2.0 * d) - here.curvature[1]).abs() < 1e-8);
                assert!(((above.slope[0] - below.slope[0]) / (2.0 * d) - here.curvature[2]).abs() < 1e-8);
            }
        }
    }

    /// A parabola, or a cone, that turns into a steeper flank at a kink.
    fn bowl(round: bool) -> Arc<Outline> {
        let (slope, bend) = if round { (0.0, 0.1) } else { (0.2, 0.0) };
        let at = slope * 1.2 + bend * 1.44;
        let arcs = vec![
            Parabola { x: 0.0, drop: 0.0, slope, bend },
            Parabola { x: 1.2, drop: at, slope: slope + 2.4 * bend + 0.1, bend: 0.05 },
        ];
        Outline::new(arcs, 1.8, true).unwrap().shared()
    }

    #[test]
    fn a_measured_cone_and_a_measured_parabola_are_as_far_as_they_are() {
        let straight = Outline::new(vec![Parabola { x: 0.0, drop: 0.0, slope: 0.4, bend: 0.0 }], 5.0, true);
        let [measured, cone] =
            [Tool::Measured(straight.unwrap().shared()), Tool::Cone { tan_slope: 0.4, tip_radius: 0.0 }];
        for x in [[0.0, 0.3], [0.0, -0.2], [1.0, 0.45], [-2.0, 0.5], [7.0, 3.0]] {
            let (a, b) = (measured.penetration(x, 0.1), cone.penetration(x, 0.1));
            assert!((a.depth - b.depth).abs() < 1e-14 && (a.slope[1] - b.slope[1]).abs() < 1e-14, "{x:?}");
            assert!((a.slope[0] - b.slope[0]).abs() < 1e-14, "{x:?}");
        }
        // before a kink the distance is that of the point
        let near = Tool::Measured(bowl(true)).penetration([1.212, 0.104], 0.0);
        assert!((near.depth + 0.012_f64.hypot(0.04)).abs() < 1e-12, "{near:?}");
    }

    #[test]
    fn a_rounded_cone_joins_its_flank_smoothly() {
        let tool = Tool::Cone { tan_slope: 0.5, tip_radius: 2.0 };
        let (sine, cosine) = (0.5 / 1.25_f64.sqrt(), 1.0 / 1.25_f64.sqrt());
        for s in [-1e-9, 1e-9] {
            let x = [2.0 * sine + s, 2.0 - 2.0 * cosine];
            assert!(tool.penetration(x, 0.0).depth.abs() < 2e-9);
        }
        assert_eq!(tool.penetration([0.0, 0.0], 0.0).depth, 0.0);
    }
}
