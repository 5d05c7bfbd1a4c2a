//! A rigid outline given by functions: of this program (`punch.rs`), or of another crate that hands it in.

use std::fmt;
use std::sync::Arc;

/// Depth of a point inside a tool, and the derivatives with respect to the point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// Depth inside the tool; negative outside.
    pub depth: f64,
    /// ∂depth/∂(r, z): the direction in which the tool is left is its opposite.
    pub slope: [f64; 2],
    /// ∂²depth/∂r², ∂²depth/∂z², ∂²depth/∂r∂z.
    pub curvature: [f64; 3],
}

/// Steps of the search for a height or a width.
const MOST_STEPS: usize = 200;

/// Least ∂depth/∂z that a step along z divides by: a flank is then as good as upright.
const LEAST_SLOPE: f64 = 1e-3;

/// The outline of a rigid tool of revolution (prismatic in plane strain) that comes down along z. It is
/// convex, symmetric about the axis, and its lowest point lies at (0, 0).
///
/// Lengths are metres, whatever unit the solver computes in. The functions are pure: the same argument gives
/// the same bits, whichever thread asks. Only [`ToolOutline::penetration`] must be written; mesh, area
/// function, picture and deck follow from it.
///
/// ```
/// use asperity_mesh::{Penetration, ToolOutline};
///
/// /// A flat paraboloid, z = r²/2R: far inside R the height over it is a distance to first order.
/// #[derive(Debug)]
/// struct Paraboloid {
///     radius: f64,
/// }
///
/// impl ToolOutline for Paraboloid {
///     fn name(&self) -> &str {
///         "paraboloid"
///     }
///     fn parameters(&self) -> Vec<(&str, f64)> {
///         vec![("radius_m", self.radius)]
///     }
///     fn penetration(&self, [r, z]: [f64; 2]) -> Penetration {
///         Penetration {
///             depth: z - r * r / (2.0 * self.radius),
///             slope: [-r / self.radius, 1.0],
///             curvature: [-1.0 / self.radius, 0.0, 0.0],
///         }
///     }
/// }
///
/// let tool = Paraboloid { radius: 2.0 };
/// assert!((tool.rise(1.0) - 0.25).abs() < 1e-15 && (tool.half_width(0.25) - 1.0).abs() < 1e-15);
/// ```
pub trait ToolOutline: fmt::Debug + Send + Sync {
    /// Name of the tool in results, not one of a built-in tool.
    fn name(&self) -> &str;

    /// Its numbers in SI by name, for results. Two outlines of one name and the same numbers are taken to be
    /// the same.
    fn parameters(&self) -> Vec<(&str, f64)>;

    /// Penetration of the point (r, z), r ≥ 0, m, with its derivatives. Of a signed distance the pressure of
    /// the contact is that of the same penalty everywhere; another measure must have a slope of length near 1
    /// at the outline: z less the height of the outline becomes a distance to first order where it is divided
    /// by the length of its gradient.
    fn penetration(&self, x: [f64; 2]) -> Penetration;

    /// Height of the outline at the distance `r` ≥ 0 from the axis. Unless given: where the penetration is 0.
    fn rise(&self, r: f64) -> f64 {
        let mut z = 0.0;
        for _ in 0..MOST_STEPS {
            let inside = self.penetration([r, z]);
            let step = inside.depth / inside.slope[1].max(LEAST_SLOPE);
            z -= step;
            if step.abs() <= f64::EPSILON * z.abs() {
                break;
            }
        }
        z
    }

    /// Distance from the axis at which the outline lies at `height`: its area function is π times the square.
    /// Unless given: where the penetration is 0.
    fn half_width(&self, height: f64) -> f64 {
        let inside = |r: f64| self.penetration([r, height]).depth > 0.0;
        if height <= 0.0 {
            return 0.0;
        }
        let [mut low, mut high] = [0.0, height];
        for _ in 0..MOST_STEPS {
            if !inside(high) {
                break;
            }
            [low, high] = [high, 2.0 * high];
        }
        for _ in 0..MOST_STEPS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if inside(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Slope (tangent) of the outline at the distance `r` ≥ 0 from the axis. Unless given: that of the
    /// penetration there.
    fn slope(&self, r: f64) -> f64 {
        let [across, along] = self.penetration([r, self.rise(r)]).slope;
        -across / along.max(LEAST_SLOPE)
    }

    /// Distances from the axis where slope or curvature jump, for facets of a deck and the mesh under an
    /// edge. Unless given: none.
    fn kinks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Slope (tangent) of the flank of a tool that is a cone: steep ones take linear elements. Unless given:
    /// none.
    fn flank(&self) -> Option<f64> {
        None
    }

    /// Depth to which it may be pressed in at most. Unless given: any.
    fn deepest(&self) -> f64 {
        f64::INFINITY
    }
}

/// A tool from outside in the unit of length of a computation.
#[derive(Clone, Debug)]
pub struct OwnTool {
    outline: Arc<dyn ToolOutline>,
    /// Metres in one unit of length.
    unit: f64,
}

impl OwnTool {
    /// The tool in metres.
    pub fn new(outline: Arc<dyn ToolOutline>) -> OwnTool {
        OwnTool { outline, unit: 1.0 }
    }

    /// The outline as it was handed in, in metres.
    pub fn outline(&self) -> &dyn ToolOutline {
        self.outline.as_ref()
    }

    /// The same tool with lengths in another unit, of which one is `unit` > 0 here.
    #[must_use]
    pub fn in_units_of(&self, unit: f64) -> OwnTool {
        OwnTool { outline: self.outline.clone(), unit: self.unit * unit }
    }

    /// Penetration of the point `x` when the lowest point of the tool is at height `tip`.
    pub fn penetration(&self, x: [f64; 2], tip: f64) -> Penetration {
        let z = x[1] - tip;
        if z == f64::NEG_INFINITY {
            return Penetration { depth: z, slope: [0.0, 1.0], curvature: [0.0; 3] }; // the tool is gone
        }
        let side = if x[0] < 0.0 { -1.0 } else { 1.0 };
        let inside = self.outline.penetration([x[0].abs() * self.unit, z * self.unit]);
        let ([r, z], [rr, zz, rz]) = (inside.slope, inside.curvature);
        Penetration {
            depth: inside.depth / self.unit,
            slope: [side * r, z],
            curvature: [rr, zz, side * rz].map(|curvature| curvature * self.unit),
        }
    }

    /// Height of the outline at the distance `x` from the axis, on either side.
    pub fn rise(&self, x: f64) -> f64 {
        self.outline.rise(x.abs() * self.unit) / self.unit
    }

    /// Distance from the axis at which the outline lies at `height`.
    pub fn half_width(&self, height: f64) -> f64 {
        self.outline.half_width(height * self.unit) / self.unit
    }

    /// Distances from the axis where slope or curvature jump.
    pub fn kinks(&self) -> Vec<f64> {
        self.outline.kinks().into_iter().map(|r| r / self.unit).collect()
    }

    /// Slope (tangent) of the outline at the distance `x` ≥ 0 from the axis.
    pub fn slope(&self, x: f64) -> f64 {
        self.outline.slope(x * self.unit)
    }

    /// n of the power r^n that the outline rises with at `height`, between a cone's 1 and a paraboloid's 2.
    pub fn power(&self, height: f64) -> f64 {
        let r = self.half_width(height);
        (r * self.outline.slope(r * self.unit) / height).clamp(1.0, 2.0)
    }

    /// Slope (tangent) at the distance `x`, as the estimates before a run take it: of a flat bottom that of a
    /// paraboloid as high there.
    pub fn slope_at(&self, x: f64) -> f64 {
        let slope = self.outline.slope(x * self.unit);
        if x > 0.0 { slope.min(2.0 * self.rise(x) / x) } else { slope }
    }

    /// The same where it is pressed in to `height`.
    pub fn slope_of_contact(&self, height: f64) -> f64 {
        self.power(height) * height / self.half_width(height)
    }
}

impl PartialEq for OwnTool {
    fn eq(&self, other: &OwnTool) -> bool {
        let (a, b) = (&self.outline, &other.outline);
        a.name() == b.name() && a.parameters() == b.parameters() && self.unit == other.unit
    }
}
