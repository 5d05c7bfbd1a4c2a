//! The parts of an edge that touch.

/// Parts of an edge, as intervals of its coordinate ξ in [-1, 1]: its middle, or both its ends.
pub type Parts = [Option<[f64; 2]>; 2];

/// No part at all.
pub const NOTHING: Parts = [None, None];

/// The whole edge.
pub const WHOLE: Parts = [Some([-1.0, 1.0]), None];

/// The edges that touch wholly, those that touch in any part, and the mean share of the parts of edges at the
/// ends of contact: 0 where all touch wholly.
pub fn whole_edges_around(parts: &[Parts]) -> ([Vec<Parts>; 2], f64) {
    let share = |touching: &Parts| touching.iter().flatten().map(|[from, to]| 0.5 * (to - from)).sum::<f64>();
    let wholly = |touching: &Parts| if share(touching) < 1.0 { NOTHING } else { WHOLE };
    let partly = |touching: &Parts| if share(touching) > 0.0 { WHOLE } else { NOTHING };
    let ends: Vec<f64> = parts.iter().map(share).filter(|share| *share > 0.0 && *share < 1.0).collect();
    let mean = ends.iter().sum::<f64>() / ends.len().max(1) as f64;
    ([parts.iter().map(wholly).collect(), parts.iter().map(partly).collect()], mean)
}

/// The first and the last place of an edge that touch; `None` where nothing does.
pub fn ends_of_touch(parts: &Parts) -> Option<[f64; 2]> {
    let places = || parts.iter().flatten().flatten().copied();
    Some([places().reduce(f64::min)?, places().reduce(f64::max)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_contacts_go_to_the_ends_of_their_edges() {
        let some = |a: f64, b: f64| [Some([a, b]), None];
        let ([inner, outer], mean) =
            whole_edges_around(&[WHOLE, some(-1.0, 0.0), NOTHING, some(0.5, 1.0), WHOLE]);
        assert_eq!(inner, [WHOLE, NOTHING, NOTHING, NOTHING, WHOLE]);
        assert_eq!(outer, [WHOLE, WHOLE, NOTHING, WHOLE, WHOLE]);
        assert_eq!(mean, 0.375);
        assert_eq!(
            whole_edges_around(&[WHOLE, NOTHING]),
            ([vec![WHOLE, NOTHING], vec![WHOLE, NOTHING]], 0.0)
        );
    }

    #[test]
    fn two_parts_touch_from_the_first_to_the_last() {
        assert_eq!(ends_of_touch(&[Some([0.4, 0.9]), Some([-0.8, -0.2])]), Some([-0.8, 0.9]));
        assert_eq!(ends_of_touch(&NOTHING), None);
    }
}
