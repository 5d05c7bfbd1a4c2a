//! The surface that earlier loads left, as far as estimates before a run need it: how wide a tool meets it,
//! and how hard it is. None of it stands in a result, as for [`crate::setup::contact_estimate`].

use crate::setup::contact_estimate;
use crate::setup::discretisation::LEAST_COUNTED_DEPTH;
use asperity_mesh::profile::{Asperity, Profile};
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::material::Metal;

/// Places where a surface is looked at around the axis of a tool: each so many times as far away as the one
/// before.
const PLACE_RATIO: f64 = 0.9;
const PLACE_COUNT: usize = 120;

/// A surface that earlier loads left. Lengths in the unit of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Formed {
    /// Its highest points, from left to right.
    points: Vec<[f64; 2]>,
    /// Largest yield stress that the metal reached, in units of E.
    yield_stress: f64,
}

impl Formed {
    /// A surface through `points` of metal that reached this yield stress.
    pub fn new(mut points: Vec<[f64; 2]>, yield_stress: f64) -> Formed {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
        points.dedup_by_key(|point| point[0]);
        Formed { points, yield_stress }
    }

    /// Height at `x`, linear between points; `None` beside them.
    fn height(&self, x: f64) -> Option<f64> {
        let after = self.points.partition_point(|point| point[0] < x);
        let to = self.points.get(after)?;
        let from = self.points[after.saturating_sub(1)];
        let share = if to[0] > from[0] { (x - from[0]) / (to[0] - from[0]) } else { 1.0 };
        (x >= self.points[0][0]).then_some(from[1] + share * (to[1] - from[1]))
    }

    /// Places with the height of the surface above the tool that stands at height 0, from left to right.
    fn clearances(&self, tool: &Tool) -> Vec<[f64; 2]> {
        let drop = tool.mirrored();
        let reach = self.points.iter().map(|point| point[0].abs()).fold(0.0, f64::max);
        let around = (0..PLACE_COUNT).map(|i| reach * PLACE_RATIO.powi(i as i32)).flat_map(|x| [-x, x]);
        let mut places: Vec<f64> =
            self.points.iter().map(|point| point[0]).chain(around).chain([0.0]).collect();
        places.sort_by(f64::total_cmp);
        let above = |x: f64| Some(self.height(x)? - drop.as_ref().map_or(0.0, |tool| tool.drop(x)));
        places.into_iter().filter_map(|x| Some([x, above(x)?])).filter(|[_, z]| z.is_finite()).collect()
    }

    /// Contact half widths of the asperities of `profile` (one entry for a flat body) where the tool is at
    /// `depth`.
    pub fn half_widths(&self, profile: &Profile, tool: &Tool, depth: f64) -> Vec<f64> {
        let places = self.clearances(tool);
        let top = places.iter().map(|place| place[1]).fold(f64::NEG_INFINITY, f64::max);
        let widest = |centre: f64, [left, right]: [f64; 2]| {
            let farthest = |places: &mut dyn Iterator<Item = f64>| {
                let within = places.filter(|x| (left..=right).contains(x));
                within.map(|x| (x - centre).abs()).fold(0.0, f64::max)
            };
            let width = farthest(&mut places.iter().filter(|[_, z]| *z >= top - depth).map(|[x, _]| *x));
            // a summit that is one place alone has the width of the polyline
            if width > 0.0 { width } else { farthest(&mut edges_above(&places, top - depth)) }
        };
        if profile.asperities.is_empty() {
            return vec![widest(0.0, [f64::NEG_INFINITY, f64::INFINITY])];
        }
        let of = |a: &Asperity| widest(a.centre, [a.centre - a.feet()[0], a.centre + a.feet()[1]]);
        profile.asperities.iter().map(of).collect()
    }

    /// Half width of the widest contact.
    fn widest(&self, profile: &Profile, tool: &Tool, depth: f64) -> f64 {
        self.half_widths(profile, tool, depth).into_iter().fold(0.0, f64::max)
    }

    /// Share of the contact half width at `reach` from which the contact must be resolved: see
    /// [`crate::setup::contact_estimate::resolved_from`].
    pub fn resolved_from(&self, profile: &Profile, tool: &Tool, depth: f64, reach: f64) -> f64 {
        let share =
            self.widest(profile, tool, LEAST_COUNTED_DEPTH * depth) / self.widest(profile, tool, reach);
        // metal that was pressed up between two feet may be touched before any summit
        if share > 0.0 { share } else { 1.0 }
    }

    /// Mean contact pressure to be expected at `depth`, in units of E: that of a contact of this depth and
    /// width in metal of its yield stress. Only the penalty is scaled with it.
    fn expected_pressure(&self, metal: &Metal, profile: &Profile, tool: &Tool, depth: f64) -> f64 {
        let slope = depth / self.widest(profile, tool, depth);
        contact_estimate::pressure_under(metal, slope, self.yield_stress)
    }
}

/// Places of the polyline through `places` that lie at `height` or above it, and where it crosses `height`: a
/// summit that is one place alone is as wide as the polyline says.
fn edges_above(places: &[[f64; 2]], height: f64) -> impl Iterator<Item = f64> {
    let ends = places.iter().filter(move |[_, z]| *z >= height).map(|[x, _]| *x);
    let crossings = places.windows(2).filter_map(move |pair| {
        let [[x, z], [to, z_to]] = [pair[0], pair[1]];
        ((z >= height) != (z_to >= height)).then(|| x + (to - x) * (height - z) / (z_to - z))
    });
    ends.chain(crossings)
}

/// Mean contact pressure to be expected at `depth`, in units of E, on the surface that earlier loads left, or
/// else on that of `profile`.
pub fn expected_pressure(
    formed: Option<&Formed>,
    metal: &Metal,
    profile: &Profile,
    tool: &Tool,
    depth: f64,
) -> f64 {
    match formed {
        None => contact_estimate::expected_pressure(metal, profile, tool, depth),
        Some(formed) => formed.expected_pressure(metal, profile, tool, depth),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_mesh::profile::Shape;

    /// A plateau of half width 2 with flanks of slope ½ on a base.
    fn plateau() -> Formed {
        Formed::new(vec![[4.0, -1.0], [0.0, 0.0], [2.0, 0.0], [10.0, -1.0]], 0.01)
    }

    /// A hat of the slope ½ whose sides have no place but summit and foot: at a depth of 0.1 the cut is 0.2
    /// to either side of its summit.
    #[test]
    fn a_summit_of_one_place_is_as_wide_as_its_sides_say() {
        let row = |x: f64| {
            let foot = |s: f64| [x + 2.0 * s, -1.0];
            vec![foot(-1.0), [x, 0.0], foot(1.0)]
        };
        let formed = Formed::new([row(0.0), row(1000.0)].concat(), 0.01);
        let hat = |centre: f64| Asperity {
            shape: Shape::Cone { tan_slope: 0.5, tip_radius: 0.0 },
            height: 1.0,
            centre,
            valley_radius: 0.0,
        };
        let profile = Profile { asperities: vec![hat(0.0), hat(1000.0)], line: None };
        let [at_axis, lone] = formed.half_widths(&profile, &Tool::Plane, 0.1)[..] else { panic!() };
        assert!((lone - 0.2).abs() < 1e-12, "{lone}");
        // places stand around the axis of the tool, each 5 % farther than the one before
        assert!((0.19..=0.2).contains(&at_axis), "{at_axis}");
    }

    #[test]
    fn a_plane_meets_a_plateau_over_its_width_and_a_ball_over_its_own() {
        let flat = Profile { asperities: Vec::new(), line: None };
        let width = |tool: &Tool, depth| plateau().half_widths(&flat, tool, depth)[0];
        assert!((width(&Tool::Plane, 1e-9) - 2.0).abs() < 0.2);
        assert!((width(&Tool::Plane, 0.5) - 3.0).abs() < 0.3);
        // 5 % from one place to the next, half of it in the mean
        let ball = Tool::Sphere { radius: 1.0 };
        assert!((width(&ball, 0.02) / (0.02_f64 * 1.98).sqrt() - 1.0).abs() < 0.11);
        let share = plateau().resolved_from(&flat, &ball, 0.02, 0.02);
        assert!((share / LEAST_COUNTED_DEPTH.sqrt() - 1.0).abs() < 0.15, "{share}");
    }
}
