use super::*;

/// Errors between -1 and 1 with the standard deviation 0.5774.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Height of the paper's asperity: cone of 10°, tip of 10, 20 high.
fn cone(r: f64) -> f64 {
    let b = 10f64.to_radians();
    let t = 10.0 * b.sin();
    if r <= t {
        20.0 - (10.0 - (100.0 - r * r).sqrt())
    } else {
        20.0 - 10.0 * (1.0 - b.cos()) - (r - t) * b.tan()
    }
}

/// Two hundred points, and forty over the tip.
fn measured(mut error: impl FnMut() -> f64) -> Vec<[f64; 2]> {
    let mut places: Vec<f64> = (0..=200).map(|i| 114.0 * f64::from(i) / 200.0).collect();
    places.extend((1..40).map(|i| 1.7365 * f64::from(i) / 40.0));
    places.sort_by(f64::total_cmp);
    places.into_iter().map(|r| [r, cone(r) + error()]).collect()
}

#[test]
fn exact_points_of_a_cone_with_a_tip_give_it_back() {
    let fit = fit(&measured(|| 0.0), Span::Half, None).unwrap();
    assert!((fit.summit - 20.0).abs() < 1e-4 && fit.corners.is_empty(), "{:?}", fit.corners);
    for i in 0..1000 {
        let r = 0.114 * f64::from(i);
        assert!((fit.outline.depth_at(r) - (20.0 - cone(r))).abs() < 2e-4, "{r}");
    }
    assert!(fit.outline.arc_count() < 60, "{}", fit.outline.arc_count());
}

/// Scatter of 0.1 % of the height: the summit, from which the depth counts, and the flank lie within 0.75 of
/// it.
#[test]
fn scatter_is_smoothed_and_the_summit_stays() {
    for seed in 1..20 {
        let mut next = noise(seed);
        let fit = fit(&measured(|| 0.02 * 3f64.sqrt() * next()), Span::Half, None).unwrap();
        assert!((fit.tolerance / 0.02 - 1.0).abs() < 0.3, "{seed}: {}", fit.tolerance);
        assert!((fit.summit - 20.0).abs() < 0.015, "{seed}: {}", fit.summit);
        for r in [3.0, 5.0, 10.0, 20.0, 40.0, 80.0] {
            let off = fit.outline.depth_at(r) - (fit.summit - cone(r));
            assert!(off.abs() < 0.012, "{seed} {r}: {off}");
        }
        assert!(fit.outline.arc_count() < 6, "{seed}: {}", fit.outline.arc_count());
    }
}

#[test]
fn corners_stay_where_the_points_have_them() {
    let roof = |x: f64| 5.0 - 0.2 * (x - 12.0).abs() - 0.3 * (x - 20.0).max(0.0);
    let mut next = noise(3);
    for scatter in [0.0, 0.005] {
        let points: Vec<[f64; 2]> =
            (0..=300).map(|i| 0.1 * f64::from(i)).map(|x| [x, roof(x) + scatter * next()]).collect();
        let fit = fit(&points, Span::Whole, None).unwrap();
        assert_eq!(fit.corners.len(), 2, "{:?}", fit.corners);
        assert!((fit.corners[0] - 12.0).abs() < 0.15 && (fit.corners[1] - 20.0).abs() < 0.15);
        assert!((fit.summit - 5.0).abs() < 1e-6 + scatter, "{}", fit.summit);
    }
    let tip: Vec<[f64; 2]> = (0..=50).map(f64::from).map(|r| [r, 10.0 - 0.2 * r]).collect();
    let fit = fit(&tip, Span::Half, None).unwrap();
    assert_eq!((fit.corners.as_slice(), fit.outline.arc_count()), (&[0.0][..], 1));
    assert!((fit.outline.drop_and_slope(1e-9)[1] - 0.2).abs() < 1e-9);
}

#[test]
fn what_is_no_outline_is_refused_with_its_point() {
    type Case<'c> = (&'c [[f64; 2]], Option<usize>, &'c str);
    let row: [Case; 7] = [
        (&[[0.0, 1.0]], None, "from 2 to 20000 points, not 1"),
        (&[[0.0, 1.0], [1.0, f64::NAN], [2.0, 0.0]], Some(1), "finite"),
        (&[[0.0, 1.0], [2.0, 0.5], [1.0, 0.0]], Some(2), "overhangs"),
        (&[[0.0, 1.0], [1.0, 0.5], [1.0, 0.0]], Some(2), "upright"),
        (&[[-1.0, 1.0], [1.0, 0.5]], Some(0), "other side of the axis"),
        (&[[5.0, 1.0], [6.0, 0.5]], Some(0), "on the axis"),
        (&[[0.0, 1.0], [1.0, 1.0]], None, "same height"),
    ];
    for (points, point, words) in row {
        let error = fit(points, Span::Half, None).unwrap_err();
        assert_eq!(error.point, point, "{error}");
        assert!(error.message.contains(words), "{error}");
    }
    let two = fit(&[[0.0, 1.0], [2.0, 0.5]], Span::Half, None).unwrap();
    assert!((two.outline.depth_at(2.0) - 0.5).abs() < 1e-9);
}

/// A handful of points of a shape that bulges: the curve does too, passes them, and is near the shape between
/// them.
#[test]
fn few_points_that_bulge_give_a_curve_that_does() {
    type Shape = (&'static str, fn(f64) -> f64, f64);
    let shapes: [Shape; 6] = [
        ("cone", |x| 1.0 - x, 1e-6),
        ("blunt cone", |x| if x < 0.4 { 1.0 - x * x / 0.8 } else { 1.2 - x }, 0.06),
        ("cap", |x| (1.0 - 0.7 * x * x).sqrt(), 0.02),
        ("steep cap", |x| (1.0 - 0.9 * x * x).sqrt(), 0.1),
        ("power of 1.3", |x| 1.0 - x.powf(1.3), 0.06),
        ("power of 3", |x| 1.0 - x.powi(3), 0.08),
    ];
    for (name, shape, off) in shapes {
        for count in [2, 3, 4, 5, 6, 8, 12, 18] {
            let points: Vec<[f64; 2]> = (0..=count)
                .map(|i| 30.0 * f64::from(i) / f64::from(count))
                .map(|x| [x, 10.0 * shape(x / 30.0)])
                .collect();
            let fit = fit(&points, Span::Half, None).unwrap();
            let height = points[0][1] - points[points.len() - 1][1];
            let dent = deepest_dent(&fit.outline);
            assert!(dent.depth <= 1e-5 * height, "{name} of {count}: {dent:?}");
            assert!(fit.farthest <= 1e-2 * height, "{name} of {count}: {}", fit.farthest);
            let drop = |x: f64| fit.outline.depth_at(x) - fit.summit;
            let missed =
                (0..=300).map(|i| 0.1 * f64::from(i)).map(|x| (drop(x) + 10.0 * shape(x / 30.0)).abs());
            let missed = missed.fold(0.0, f64::max);
            // as the spacing of the points squared
            let most = 10.0 * off * (2.0 / f64::from(count)).powi(2) + 1e-2 * height;
            assert!(missed < most, "{name} of {count}: {missed} {most}");
        }
    }
}
