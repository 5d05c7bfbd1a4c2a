//! Plastic strain of a test whose table counts total strain: the total one less the elastic one, σ/E.

/// Strain beyond σ/E, as a share of it and in addition, up to which a row is of the elastic line: moduli of
/// tests differ by the share, gauges of strain resolve the rest. At yield both are below the 0.02 % of the
/// strictest proof stress.
const ELASTIC_SHARE: f64 = 0.1;
const RESOLUTION: f64 = 2e-5;

/// Elastic strain at a point of total strain and stress.
fn elastic_strain([_, stress]: [f64; 2], youngs_modulus: f64) -> f64 {
    stress / youngs_modulus
}

/// True of a point of total strain and stress that lies on the elastic line.
pub(crate) fn is_elastic(point: [f64; 2], youngs_modulus: f64) -> bool {
    let elastic = elastic_strain(point, youngs_modulus);
    (point[0] - elastic).abs() <= ELASTIC_SHARE * elastic.abs() + RESOLUTION
}

/// The reason why points hold no curve from first yield on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NoYield {
    /// This point with a stress before first yield does not lie on the elastic line.
    OffTheLine(usize),
    /// The last point still does.
    NeverLeaves(usize),
}

/// Number of `points` of total strain and stress before first yield, and those from there on with their
/// plastic strain: first yield is the last point of the elastic line.
pub(crate) fn plastic_points(
    points: &[[f64; 2]],
    youngs_modulus: f64,
) -> Result<(usize, Vec<[f64; 2]>), NoYield> {
    let is_on_line = |point: &[f64; 2]| point[1] > 0.0 && is_elastic(*point, youngs_modulus);
    let is_off_line = |point: &[f64; 2]| point[1] > 0.0 && !is_elastic(*point, youngs_modulus);
    let last = points.iter().rposition(is_on_line);
    let off = points.iter().position(is_off_line).filter(|off| last.is_none_or(|last| *off < last));
    let first = match (last, off) {
        (Some(last), None) => last,
        (_, off) => return Err(NoYield::OffTheLine(off.unwrap_or(points.len() - 1))),
    };
    if first + 1 == points.len() {
        return Err(NoYield::NeverLeaves(first));
    }
    let plastic = |point: &[f64; 2]| [point[0] - elastic_strain(*point, youngs_modulus), point[1]];
    let beyond = points[first + 1..].iter().map(plastic);
    Ok((first, std::iter::once([0.0, points[first][1]]).chain(beyond).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A metal of 200 GPa that yields at 300 MPa and hardens by 1 GPa, strained by a machine whose modulus
    /// misses by `slack`.
    fn tension(slack: f64) -> Vec<[f64; 2]> {
        let elastic = (0..=10).map(|i| 30e6 * f64::from(i)).map(|s| [s / 200e9 * (1.0 + slack), s]);
        let plastic = (1..=5).map(|i| 0.01 * f64::from(i));
        let flow = plastic.map(|p| [p, 300e6 + 1e9 * p]).map(|[p, s]| [p + s / 200e9 * (1.0 + slack), s]);
        elastic.chain(flow).collect()
    }

    #[test]
    fn the_elastic_line_is_subtracted_and_left_out() {
        for slack in [0.0, 0.05, -0.05] {
            let (before, points) = plastic_points(&tension(slack), 200e9).unwrap();
            assert_eq!((before, points.len(), points[0]), (10, 6, [0.0, 300e6]), "{slack}");
            for (k, [strain, stress]) in points.iter().enumerate() {
                let want = 0.01 * k as f64;
                assert!((strain - want).abs() < 1e-4, "{slack} {strain} {want}");
                assert!((stress - 300e6 - 1e9 * want).abs() < 1.0, "{stress}");
            }
        }
    }

    #[test]
    fn curves_that_tell_no_first_yield_are_none() {
        let plastic: Vec<[f64; 2]> = tension(0.0)[10..].iter().map(|[e, s]| [e - s / 200e9, *s]).collect();
        for (points, modulus, reason) in [
            (&tension(0.0)[..11], 200e9, NoYield::NeverLeaves(10)),
            (&tension(0.0)[11..], 200e9, NoYield::OffTheLine(0)),
            (&tension(1.0)[..], 200e9, NoYield::OffTheLine(1)),
            (&tension(0.0)[..], 100e9, NoYield::OffTheLine(1)),
            // passes through the line of the wrong modulus
            (
                &[[0.0, 0.0], [1e-3, 2e8], [1.5e-3, 3e8], [3e-3, 3e8], [0.01, 3.1e8]],
                100e9,
                NoYield::OffTheLine(1),
            ),
            (&plastic[..], 200e9, NoYield::OffTheLine(0)),
            (&[[0.0, 0.0]], 200e9, NoYield::OffTheLine(0)),
        ] {
            assert_eq!(plastic_points(points, modulus), Err(reason), "{points:?}");
        }
    }
}
