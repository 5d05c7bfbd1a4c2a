//! The parabola that an unloading nearly is.

use asperity_numerics::least_squares::{Line, powers, solve};

/// Depth of an unloading as a parabola in F^(2/3), in which it nearly is a line (Oliver and Pharr, J. Mater.
/// Res. 7 (1992) 1564).
pub struct UnloadingParabola {
    numbers: [f64; 3],
    peak_force: f64,
}

/// Points up to which a line is drawn through them, not a parabola.
const ENOUGH: usize = 5;

impl UnloadingParabola {
    /// Through points (depth, force) below `peak_force`; a line where there are too few of them.
    pub fn new(points: &[[f64; 2]], peak_force: f64) -> UnloadingParabola {
        let place = |p: &[f64; 2]| (p[1] / peak_force).powf(2.0 / 3.0);
        let rows: Vec<([f64; 3], f64, f64)> = points.iter().map(|p| (powers(place(p)), p[0], 1.0)).collect();
        let numbers = solve(&rows).filter(|_| points.len() > ENOUGH).unwrap_or_else(|| {
            let places: Vec<[f64; 2]> = points.iter().map(|p| [place(p), p[0]]).collect();
            let mean = |k: usize| places.iter().map(|p| p[k]).sum::<f64>() / places.len().max(1) as f64;
            let slope = Line::fit(&places).slope;
            [mean(1) - slope * mean(0), slope, 0.0]
        });
        UnloadingParabola { numbers, peak_force }
    }

    /// Growth of the depth by a relative growth of `force`; none where it falls.
    pub fn growth(&self, force: f64) -> f64 {
        let place = (force / self.peak_force).powf(2.0 / 3.0);
        let [_, along, bent] = self.numbers;
        let growth = 2.0 / 3.0 * place * (along + 2.0 * bent * place);
        if growth.is_finite() { growth.max(0.0) } else { 0.0 }
    }

    /// Standard deviation of the depths of `points` about it; 0 where they are too few to tell.
    pub fn scatter(&self, points: &[[f64; 2]]) -> f64 {
        if points.len() <= ENOUGH {
            return 0.0;
        }
        let depth = |force: f64| {
            let basis: [f64; 3] = powers((force / self.peak_force).powf(2.0 / 3.0));
            self.numbers.iter().zip(basis).map(|(number, power)| number * power).sum::<f64>()
        };
        let squares = points.iter().map(|p| (p[0] - depth(p[1])).powi(2)).sum::<f64>();
        (squares / (points.len() - self.numbers.len()) as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// h = 0.9 + 0.1 (F/F₀)^(1/m) grows by 0.1 (F/F₀)^(1/m)/m for each relative change of the force; a
    /// parabola in F^(2/3) follows exponents of the field within some percent.
    #[test]
    fn growth_follows_the_measured_unloading() {
        for m in [1.25, 1.5, 1.6] {
            let point = |share: f64| [0.9 + 0.1 * share.powf(1.0 / m), 5e-3 * share];
            let unloading: Vec<[f64; 2]> = (1..=18).map(|i| point(1.0 - f64::from(i) / 20.0)).collect();
            let parabola = UnloadingParabola::new(&unloading, 5e-3);
            for p in &unloading {
                let expected = 0.1 * (p[1] / 5e-3).powf(1.0 / m) / m;
                let growth = parabola.growth(p[1]);
                assert!((growth / expected - 1.0).abs() < 0.06, "{m} {} {growth} {expected}", p[1]);
            }
        }
        let two = UnloadingParabola::new(&[[0.95, 3e-3], [0.93, 1e-3]], 5e-3);
        assert!([3e-3, 1e-3].iter().all(|force| (1e-9..0.1).contains(&two.growth(*force))));
    }

    #[test]
    fn what_scatters_about_an_unloading_is_told() {
        let depth = |share: f64| 1.0 + 0.1 * share.powf(2.0 / 3.0) + 0.02 * share.powf(4.0 / 3.0);
        let points: Vec<[f64; 2]> =
            (1..=40).map(|i| f64::from(i) / 40.0).map(|share| [depth(share), 7.0 * share]).collect();
        assert!(UnloadingParabola::new(&points, 7.0).scatter(&points) < 1e-12);
        let shift = |i: usize| if i.is_multiple_of(2) { 1e-3 } else { -1e-3 };
        let scattered: Vec<[f64; 2]> =
            points.iter().enumerate().map(|(i, p)| [p[0] + shift(i), p[1]]).collect();
        let scatter = UnloadingParabola::new(&scattered, 7.0).scatter(&scattered);
        // three numbers of the parabola follow some of forty readings
        assert!((scatter / 1e-3 - 1.0).abs() < 0.11, "{scatter}");
        assert_eq!(UnloadingParabola::new(&points[..5], 7.0).scatter(&points[..5]), 0.0);
    }
}
