//! The ground about an imprint, which levels it, and the middle of its hole.

use asperity_numerics::least_squares;

/// Share of the depth of the deepest point below which a point of a map belongs to the hole, whose middle is
/// the axis.
const HOLE_SHARE: f64 = 0.4;
/// Contact radii from which a map is levelled.
pub const LEVEL_RADII: f64 = 2.0;

/// Levels `points` (x, y, z), which stand for so much of the surface as `share` says, by what lies far from
/// the hole, a plane of the terms of `row`; the middle of the hole.
///
/// # Errors
/// Too little beside the hole, or none.
pub fn level<const N: usize>(
    points: &mut [[f64; 3]],
    radius: f64,
    share: impl Fn(usize) -> f64,
    row: impl Fn(&[f64; 3]) -> [f64; N],
) -> Result<[f64; 2], String> {
    // a slope of the whole comes first, so that its lower side is no hole; then the hole has no say
    for round in 0..3 {
        let centre = if round == 0 { None } else { Some(centre(points, &share)?) };
        let far = |(_, p): &(usize, &[f64; 3])| {
            centre.is_none_or(|c: [f64; 2]| (p[0] - c[0]).hypot(p[1] - c[1]) > LEVEL_RADII * radius)
        };
        let rows: Vec<_> =
            points.iter().enumerate().filter(far).map(|(i, p)| (row(p), p[2], share(i))).collect();
        let plane = least_squares::solve(&rows).filter(|_| rows.len() > 20).ok_or_else(|| {
            format!(
                "shows too little beside the imprint to level it: it has to reach beyond {LEVEL_RADII} contact radii, {:.3} um",
                1e6 * LEVEL_RADII * radius
            )
        })?;
        for p in points.iter_mut() {
            p[2] -= row(p).iter().zip(&plane).map(|(term, of)| term * of).sum::<f64>();
        }
    }
    centre(points, &share)
}

/// Middle of the hole, weighted by its depth.
fn centre(points: &[[f64; 3]], share: impl Fn(usize) -> f64) -> Result<[f64; 2], String> {
    let lowest = points.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
    let mut sums = [0.0; 3];
    for (i, p) in points.iter().enumerate() {
        let weight = share(i) * (HOLE_SHARE * lowest - p[2]).max(0.0);
        sums = [sums[0] + weight, sums[1] + weight * p[0], sums[2] + weight * p[1]];
    }
    if sums[0].is_nan() || sums[0] <= 0.0 {
        return Err("shows no hole: heights count up, the imprint lies below the surface around it".into());
    }
    Ok([sums[1] / sums[0], sums[2] / sums[0]])
}
