//! The profile of a rough surface: asperities side by side on a base plane. Height 0 is the highest summit.

/// Shape of one asperity, in any unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// One asperity on the base plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asperity {
    /// Its shape.
    pub shape: Shape,
    /// From the base plane to the (rounded) summit.
    pub height: f64,
    /// Position of its summit: distance from the axis, or x in plane strain.
    pub centre: f64,
}

impl Asperity {
    /// How far the surface lies below the summit at the distance `x` from it, on the asperity continued for ever.
    pub fn drop(&self, x: f64) -> f64 {
        let x = x.abs();
        match self.shape {
            Shape::Sphere { radius } => cap_drop(radius, x),
            Shape::Cone { tan_slope, tip_radius } => {
                let secant = tan_slope.hypot(1.0);
                let cap = tip_radius * tan_slope / secant; // R sin β
                if x < cap { cap_drop(tip_radius, x) } else { x * tan_slope - tip_radius * (secant - 1.0) }
            }
        }
    }

    /// Half width where the asperity continued for ever is cut at `depth` below its summit.
    pub fn half_width(&self, depth: f64) -> f64 {
        let cap_width = |radius: f64| (depth * (2.0 * radius - depth)).max(0.0).sqrt();
        match self.shape {
            Shape::Sphere { radius } => cap_width(radius),
            Shape::Cone { tan_slope, tip_radius } => {
                let secant = tan_slope.hypot(1.0);
                if depth < tip_radius * (1.0 - 1.0 / secant) {
                    cap_width(tip_radius)
                } else {
                    (depth + tip_radius * (secant - 1.0)) / tan_slope
                }
            }
        }
    }

    /// Radius of the tangent circle between tip and flank, 0 for a sharp tip.
    pub fn cap_radius(&self) -> f64 {
        match self.shape {
            Shape::Sphere { .. } => 0.0,
            Shape::Cone { tan_slope, tip_radius } => tip_radius * tan_slope / tan_slope.hypot(1.0),
        }
    }
}

/// R - √(R² - x²), without cancellation.
fn cap_drop(radius: f64, x: f64) -> f64 {
    let x = x.min(radius);
    x * x / (radius + ((radius - x) * (radius + x)).sqrt())
}

/// Asperities on a common base plane, none overlapping.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// In order from the axis (left) outward; may be empty: a flat surface.
    pub asperities: Vec<Asperity>,
}

impl Profile {
    /// Height of the highest asperity: the base plane is this far below 0.
    pub fn height(&self) -> f64 {
        self.asperities.iter().fold(0.0, |h, a| a.height.max(h))
    }

    /// Height of the surface at `r`, 0 at the highest summit, negative elsewhere.
    pub fn z(&self, r: f64) -> f64 {
        let base = -self.height();
        self.asperities.iter().fold(base, |z, a| z.max(base + a.height - a.drop(r - a.centre)))
    }

    /// Where the slope jumps or the curvature does: summits, edges of caps, feet of flanks, valleys; in order.
    pub fn kinks(&self) -> Vec<f64> {
        let mut kinks: Vec<f64> = self
            .asperities
            .iter()
            .flat_map(|a| {
                let (foot, cap) = (a.half_width(a.height), a.cap_radius());
                [-foot, -cap, 0.0, cap, foot].map(|x| a.centre + x)
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

    /// Height 20 µm, slope 10°, tip 10 µm: the base radius is 114.30 µm.
    #[test]
    fn the_papers_asperity_has_base_radius_114_30() {
        let tan_slope = 10f64.to_radians().tan();
        let a = Asperity { shape: Shape::Cone { tan_slope, tip_radius: 10.0 }, height: 20.0, centre: 0.0 };
        assert!((a.half_width(20.0) - 114.30).abs() < 5e-3);
        assert!((a.cap_radius() - 1.7365).abs() < 1e-4);
        let profile = Profile { asperities: vec![a] };
        assert_eq!(profile.z(0.0), 0.0);
        assert!((profile.z(200.0) + 20.0).abs() < 1e-12);
        for x in [0.5, 1.7, 1.8, 50.0] {
            assert!((a.half_width(a.drop(x)) / x - 1.0).abs() < 1e-12);
        }
    }
}
