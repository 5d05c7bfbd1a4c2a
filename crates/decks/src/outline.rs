//! The lower outline of a tool as a row of straight facets.

use asperity_solver::contact::tool::Tool;

/// Facets over a round part.
const FACETS: usize = 48;
/// Largest share of the radius of a sphere that is drawn: beyond, facets would stand upright.
const ROUND: f64 = 0.95;

/// Points of the outline from left to right between the two `ends`, height 0 at the lowest point. Whatever is
/// round becomes [`FACETS`] facets between its points, outside it by at most (Δx)²/8R.
pub fn outline(tool: &Tool, ends: [f64; 2]) -> Vec<[f64; 2]> {
    let [low, high] = ends;
    let Some(mirrored) = tool.mirrored() else { return vec![[low, 0.0], [high, 0.0]] };
    let (round, last) = match tool {
        Tool::Sphere { radius } => (high.min(ROUND * radius), high.min(ROUND * radius)),
        Tool::Plane | Tool::Cone { .. } => (mirrored.cap_radius().min(high), high),
        Tool::Measured(_) | Tool::Own(_) => (high, high),
    };
    let mut right: Vec<f64> = Vec::new();
    // a kink is a corner of the facets
    let mut stops = match tool {
        Tool::Measured(outline) => outline.kinks(0.0),
        Tool::Own(tool) => tool.kinks(),
        Tool::Plane | Tool::Cone { .. } | Tool::Sphere { .. } => Vec::new(),
    };
    stops.retain(|x| *x > 0.0 && *x < high);
    right.extend(&stops);
    if let Tool::Own(_) = tool {
        // an arc between kinks may be short
        stops.push(high);
        let mut from = 0.0;
        for to in stops {
            right.extend((1..FACETS).map(|i| from + (to - from) * i as f64 / FACETS as f64));
            from = to;
        }
        right.push(high);
    } else if round > 0.0 {
        right.extend((1..=FACETS).map(|i| round * i as f64 / FACETS as f64));
    }
    if last > round {
        right.push(last);
    }
    right.sort_by(f64::total_cmp);
    let mut xs: Vec<f64> = if low < 0.0 { right.iter().rev().map(|x| -x).collect() } else { Vec::new() };
    xs.push(low.max(0.0));
    xs.extend(right.into_iter().filter(|x| *x > low));
    xs.into_iter().map(|x| [x, mirrored.drop(x)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_mesh::{OwnTool, Punch};
    use std::sync::Arc;

    #[test]
    fn facets_follow_the_tool() {
        let plane = outline(&Tool::Plane, [0.1, 2.0]);
        assert_eq!(plane, [[0.1, 0.0], [2.0, 0.0]]);
        let cone = outline(&Tool::Cone { tan_slope: 0.5, tip_radius: 0.0 }, [0.0, 2.0]);
        assert_eq!(cone, [[0.0, 0.0], [2.0, 1.0]]);
        let wedge = outline(&Tool::Cone { tan_slope: 0.5, tip_radius: 0.0 }, [-2.5, 2.0]);
        assert_eq!(wedge, [[-2.0, 1.0], [0.0, 0.0], [2.0, 1.0]]);
        let punch = OwnTool::new(Arc::new(Punch { radius: 2.5, edge_radius: 1.0 }));
        let cone = Tool::Cone { tan_slope: 0.5, tip_radius: 1.0 };
        for tool in [Tool::Sphere { radius: 3.0 }, cone, Tool::Own(punch)] {
            let points = outline(&tool, [1e-3, 2.0]);
            assert!(points.windows(2).all(|w| w[0][0] < w[1][0]) && points[points.len() - 1][0] == 2.0);
            for [x, z] in points {
                assert!(tool.penetration([x, z], 0.0).depth.abs() < 1e-12, "{tool:?} {x} {z}");
            }
        }
    }
}
