//! The settings that no other one beats in error and cost.

/// The Pareto front of points (cost, error), cheapest first: each point of it has a smaller error than every
/// point that costs as much or less. Points that are absent or not finite are not on it.
pub fn pareto_front(points: &[Option<[f64; 2]>]) -> Vec<usize> {
    let finite = |p: &[f64; 2]| p.iter().all(|x| x.is_finite());
    let mut order: Vec<(usize, [f64; 2])> =
        points.iter().enumerate().filter_map(|(i, p)| Some((i, p.filter(finite)?))).collect();
    order.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut best = f64::INFINITY;
    order.retain(|(_, p)| {
        let better = p[1] < best;
        best = best.min(p[1]);
        better
    });
    order.into_iter().map(|(i, _)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_beats_one_of_the_front() {
        let points = [[1.0, 0.05], [2.0, 0.06], [2.0, 0.01], [3.0, 0.01], [9.0, 0.002], [0.5, f64::NAN]];
        let mut points: Vec<Option<[f64; 2]>> = points.into_iter().map(Some).collect();
        points.push(None);
        assert_eq!(pareto_front(&points), [0, 2, 4]);
        assert!(pareto_front(&[]).is_empty());
        // every point is on the front or beaten by one that is
        let on = pareto_front(&points);
        for p in points.iter().flatten().filter(|p| p[1].is_finite()) {
            assert!(on.iter().filter_map(|&i| points[i]).any(|q| q[0] <= p[0] && q[1] <= p[1]));
        }
    }
}
