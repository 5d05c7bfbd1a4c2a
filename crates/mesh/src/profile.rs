//! The profile of a rough surface: asperities side by side on a base plane. Height 0 is the highest summit.

use crate::outline::Outline;
use crate::tool_outline::OwnTool;
use std::sync::Arc;

/// Slopes that jump by less than this are no kink for a mesh.
const KINK: f64 = 0.01;

/// Shape of one asperity, in any unit of length.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A cone (ridge in plane strain) whose flank rises by `tan_slope`, with a rounded tip.
    Cone {
        /// tan β of the flank.
        tan_slope: f64,
        /// Radius of the rounded tip; 0: sharp.
        tip_radius: f64,
    },
    /// A spherical cap (cylindrical in plane strain).
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A measured outline, seen from its summit; it ends at its feet.
    Measured(Arc<Outline>),
    /// The mirror image of a tool that is given by functions.
    Own(OwnTool),
}

/// One asperity on the base plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Asperity {
    /// Its shape.
    pub shape: Shape,
    /// From the base plane to the (rounded) summit.
    pub height: f64,
    /// Position of its summit: distance from the axis, or x in plane strain.
    pub centre: f64,
    /// Radius of the fillet in the valley at its outer (right) foot; 0: sharp.
    pub valley_radius: f64,
}

impl Asperity {
    /// Depth of the surface below the summit at the distance `x` from it, on the asperity continued for ever.
    pub fn drop(&self, x: f64) -> f64 {
        match &self.shape {
            Shape::Sphere { radius } => cap_drop(*radius, x.abs()),
            Shape::Cone { tan_slope, tip_radius } => {
                let x = x.abs();
                let secant = tan_slope.hypot(1.0);
                let cap = tip_radius * tan_slope / secant; // R sin β
                if x < cap { cap_drop(*tip_radius, x) } else { x * tan_slope - tip_radius * (secant - 1.0) }
            }
            Shape::Measured(outline) => outline.depth_at(x),
            Shape::Own(tool) => tool.rise(x),
        }
    }

    /// Half width where the asperity continued for ever is cut at `depth` below its summit, on the side where
    /// it is wider.
    pub fn half_width(&self, depth: f64) -> f64 {
        let cap_width = |radius: f64| {
            let depth = depth.min(radius);
            (depth * (2.0 * radius - depth)).max(0.0).sqrt()
        };
        match &self.shape {
            Shape::Sphere { radius } => cap_width(*radius),
            Shape::Cone { tan_slope, tip_radius } => {
                let secant = tan_slope.hypot(1.0);
                if depth < tip_radius * (1.0 - 1.0 / secant) {
                    cap_width(*tip_radius)
                } else {
                    (depth + tip_radius * (secant - 1.0)) / tan_slope
                }
            }
            Shape::Own(tool) => tool.half_width(depth),
            // the summit itself may be found a rounding beside 0
            Shape::Measured(_) if depth <= 0.0 => 0.0,
            Shape::Measured(outline) => {
                let [left, right] = outline.widths(depth);
                // a neighbour begins at the foot; a tool goes on
                let [a, b] = if self.height.is_finite() { self.feet() } else { [f64::INFINITY; 2] };
                left.min(a).max(right.min(b))
            }
        }
    }

    /// Widths of its left and right side, from the summit to the foot.
    pub fn feet(&self) -> [f64; 2] {
        match &self.shape {
            Shape::Measured(outline) => {
                let [left, right] = outline.ends();
                [-left, right]
            }
            _ => [self.half_width(self.height); 2],
        }
    }

    /// Radius of the tangent circle between tip and flank, 0 for a sharp tip and where there is no such
    /// circle.
    pub fn cap_radius(&self) -> f64 {
        match self.shape {
            Shape::Sphere { .. } | Shape::Measured(_) | Shape::Own(_) => 0.0,
            Shape::Cone { tan_slope, tip_radius } => tip_radius * tan_slope / tan_slope.hypot(1.0),
        }
    }

    /// Slope (tangent) at the edge of a contact of the half width `width`, as the estimates before a run take
    /// it; of a measured outline at least that of the chord to its summit.
    pub fn slope_at(&self, width: f64) -> f64 {
        match &self.shape {
            Shape::Cone { tan_slope, tip_radius } if *tip_radius > 0.0 => tan_slope.min(width / tip_radius),
            Shape::Cone { tan_slope, .. } => *tan_slope,
            Shape::Sphere { radius } => width / radius,
            Shape::Own(tool) => tool.slope_at(width),
            Shape::Measured(outline) => {
                let at = |x: f64| {
                    let [drop, slope] = outline.drop_and_slope(x);
                    slope.abs().max(drop / width)
                };
                at(width).min(at(-width)).max(outline.depth_at(width).min(outline.depth_at(-width)) / width)
            }
        }
    }

    /// Steepest slope that a mesh under the asperity must follow: that at the foot of a cap.
    pub fn steepest(&self) -> f64 {
        match &self.shape {
            Shape::Cone { tan_slope, .. } => *tan_slope,
            Shape::Sphere { radius } => self.half_width(self.height) / (radius - self.height),
            Shape::Measured(outline) => outline.steepest(),
            Shape::Own(tool) => tool.slope_of_contact(self.height),
        }
    }

    /// The asperity with its tip cut off by an arc of at least the half width `width`: its flanks stay where
    /// they are, its summit is lower. Spheres and measured outlines stay as they are.
    #[must_use]
    pub fn blunted(&self, width: f64) -> Asperity {
        match self.shape {
            Shape::Cone { tan_slope, tip_radius: sharper } if self.cap_radius() < width => {
                let secant = tan_slope.hypot(1.0);
                let tip_radius = width * secant / tan_slope;
                Asperity {
                    shape: Shape::Cone { tan_slope, tip_radius },
                    height: self.height - (tip_radius - sharper) * (secant - 1.0),
                    ..*self
                }
            }
            _ => self.clone(),
        }
    }

    /// The asperity with every length over `length`.
    #[must_use]
    pub fn in_units_of(&self, length: f64) -> Asperity {
        let shape = match &self.shape {
            Shape::Cone { tan_slope, tip_radius } => {
                Shape::Cone { tan_slope: *tan_slope, tip_radius: tip_radius / length }
            }
            Shape::Sphere { radius } => Shape::Sphere { radius: radius / length },
            Shape::Measured(outline) => Shape::Measured(outline.scaled(length.recip()).shared()),
            Shape::Own(tool) => Shape::Own(tool.in_units_of(length)),
        };
        Asperity {
            shape,
            height: self.height / length,
            centre: self.centre / length,
            valley_radius: self.valley_radius / length,
        }
    }
}

/// R - √(R² - x²), without cancellation.
fn cap_drop(radius: f64, x: f64) -> f64 {
    let x = x.min(radius);
    x * x / (radius + ((radius - x) * (radius + x)).sqrt())
}

/// A fillet between a falling flank and what rises (or lies flat) beyond its foot.
struct Valley {
    foot: f64,
    base: f64,
    radius: f64,
    /// Angles of the falling and of the rising side.
    angles: [f64; 2],
}

impl Valley {
    /// From the foot to the points of tangency, along either side.
    fn tangent_length(&self) -> f64 {
        self.radius * (0.5 * (self.angles[0] + self.angles[1])).tan()
    }

    /// Height of the fillet at `r`, if it reaches there.
    fn z(&self, r: f64) -> Option<f64> {
        let (length, [fall, rise]) = (self.tangent_length(), self.angles);
        let x = r - self.foot;
        if x < -length * fall.cos() || x > length * rise.cos() {
            return None;
        }
        let centre =
            [-length * fall.cos() + self.radius * fall.sin(), length * fall.sin() + self.radius * fall.cos()];
        Some(self.base + centre[1] - (self.radius.powi(2) - (x - centre[0]).powi(2)).max(0.0).sqrt())
    }
}

/// Asperities on a common base plane, none overlapping.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// In order from the axis (left) outward; may be empty: a flat surface.
    pub asperities: Vec<Asperity>,
    /// The surface between the outer feet of the asperities where it was measured as one line, seen from the
    /// highest summit; beyond its ends it is level. `None`: the asperities stand on the base plane.
    pub line: Option<Arc<Outline>>,
}

impl Profile {
    /// Height of the highest asperity: the base plane is this far below 0.
    pub fn height(&self) -> f64 {
        self.asperities.iter().fold(0.0, |h, a| a.height.max(h))
    }

    /// Height of the surface at `r`, 0 at the highest summit, negative elsewhere.
    pub fn z(&self, r: f64) -> f64 {
        if let Some(line) = &self.line {
            let [left, right] = line.ends();
            return -line.depth_at(r.clamp(left, right));
        }
        let base = -self.height();
        let sharp = self.asperities.iter().fold(base, |z, a| z.max(base + a.height - a.drop(r - a.centre)));
        self.valleys().iter().filter_map(|valley| valley.z(r)).fold(sharp, f64::max)
    }

    /// The filleted valleys.
    fn valleys(&self) -> Vec<Valley> {
        let base = -self.height();
        self.asperities
            .iter()
            .enumerate()
            .filter(|(_, a)| a.valley_radius > 0.0)
            .filter_map(|(i, a)| {
                let Shape::Cone { tan_slope, .. } = a.shape else { return None };
                let foot = a.centre + a.half_width(a.height);
                // the next asperity begins there, or the flat base plane
                let next = self
                    .asperities
                    .get(i + 1)
                    .filter(|b| (b.centre - b.feet()[0] - foot).abs() <= 1e-9 * foot.abs().max(a.height));
                let rise = match next.map(|b| b.shape.clone()) {
                    Some(Shape::Cone { tan_slope, .. }) => tan_slope.atan(),
                    _ => 0.0,
                };
                Some(Valley { foot, base, radius: a.valley_radius, angles: [tan_slope.atan(), rise] })
            })
            .collect()
    }

    /// Widths that the fillet of asperity `index` takes from its own flank and from what follows; `None` if
    /// sharp.
    pub fn valley_reach(&self, index: usize) -> Option<[f64; 2]> {
        let a = self.asperities.get(index)?;
        let foot = a.centre + a.half_width(a.height);
        let valleys = self.valleys();
        let valley = valleys.iter().find(|v| v.foot == foot)?;
        let length = valley.tangent_length();
        Some([length * valley.angles[0].cos(), length * valley.angles[1].cos()])
    }

    /// The places at which the slope jumps or the curvature does: summits, edges of caps, feet of flanks,
    /// valleys; in order.
    pub fn kinks(&self) -> Vec<f64> {
        let mut kinks: Vec<f64> = self
            .asperities
            .iter()
            .flat_map(|a| {
                let ([left, right], cap) = (a.feet(), a.cap_radius());
                let measured = match &a.shape {
                    Shape::Measured(outline) => outline.kinks(KINK),
                    _ => Vec::new(),
                };
                let places = [-left, -cap, 0.0, cap, right].into_iter().chain(measured);
                places.map(|x| a.centre + x).collect::<Vec<_>>()
            })
            .collect();
        kinks.sort_by(f64::total_cmp);
        kinks.dedup_by(|b, a| (*b - *a).abs() <= 1e-9 * (a.abs() + b.abs()));
        kinks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fillet leaves both sides tangentially, where `valley_reach` says.
    #[test]
    fn a_filleted_valley_is_smooth() {
        let cone = |centre, tan_slope: f64| Asperity {
            shape: Shape::Cone { tan_slope, tip_radius: 0.0 },
            height: 1.0,
            centre,
            valley_radius: 2.0,
        };
        let profile = Profile { asperities: vec![cone(0.0, 0.5), cone(2.0 + 4.0, 0.25)], line: None };
        let [left, right] = profile.valley_reach(0).unwrap();
        let slope = |r: f64| (profile.z(r + 1e-6) - profile.z(r - 1e-6)) / 2e-6;
        assert!(
            (slope(2.0 - left + 1e-4) + 0.5).abs() < 1e-3 && (slope(2.0 + right - 1e-4) - 0.25).abs() < 1e-3
        );
        assert!(profile.z(2.0) > -1.0 && profile.z(10.0) > -1.0);
        assert!((profile.z(2.0 - left - 1e-9) - profile.z(2.0 - left + 1e-9)).abs() < 1e-8);
    }

    #[test]
    fn blunting_lowers_the_summit_and_leaves_the_flanks() {
        let sharp = Asperity {
            shape: Shape::Cone { tan_slope: 2.0, tip_radius: 0.1 },
            height: 3.0,
            centre: 1.0,
            valley_radius: 0.0,
        };
        let blunt = sharp.blunted(0.4);
        assert!((blunt.cap_radius() - 0.4).abs() < 1e-15);
        let lost = sharp.height - blunt.height;
        assert!(lost > 0.0 && lost < sharp.drop(0.4));
        for x in [0.4, 0.7, 1.5] {
            assert!((sharp.drop(x) - blunt.drop(x) - lost).abs() < 1e-15);
        }
        assert_eq!(sharp.blunted(0.05), sharp);
    }

    /// Height 20 µm, slope 10°, tip 10 µm: the base radius is 114.30 µm.
    #[test]
    fn the_papers_asperity_has_base_radius_114_30() {
        let tan_slope = 10f64.to_radians().tan();
        let a = Asperity {
            shape: Shape::Cone { tan_slope, tip_radius: 10.0 },
            height: 20.0,
            centre: 0.0,
            valley_radius: 0.0,
        };
        assert!((a.half_width(20.0) - 114.30).abs() < 5e-3);
        assert!((a.cap_radius() - 1.7365).abs() < 1e-4);
        let profile = Profile { asperities: vec![a.clone()], line: None };
        assert_eq!(profile.z(0.0), 0.0);
        assert!((profile.z(200.0) + 20.0).abs() < 1e-12);
        for x in [0.5, 1.7, 1.8, 50.0] {
            assert!((a.half_width(a.drop(x)) / x - 1.0).abs() < 1e-12);
        }
    }
}
