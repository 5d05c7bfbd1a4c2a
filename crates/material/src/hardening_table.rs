//! Hardening by a table: yield stress over plastic strain, linear between its points, constant beyond the
//! last one, as *PLASTIC of Abaqus and CalculiX reads it.
//!
//! The return map is exact: q - 3G (ε_p - ε_p,old) = σ(ε_p) is linear on each segment, and because both sides
//! are monotone the segment is found by bisection over the points. The slope at a kink is that of the segment
//! the return ended on; the incremental energy stays convex there, so that Newton's method with a line search
//! passes it.

use crate::hardening::HardeningPoint;

/// Most points that a table may have.
pub const LARGEST_TABLE: usize = 100_000;

/// A curve of hardening through points of growing plastic strain.
#[derive(Clone, Debug, PartialEq)]
pub struct HardeningTable {
    /// Accumulated plastic strain ε_p, from 0, growing.
    strain: Vec<f64>,
    /// Yield stress there, positive, never falling.
    stress: Vec<f64>,
    /// ∫σ dε_p from 0 to there.
    work: Vec<f64>,
}

/// The reason why a point of a table is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{message}", point.map_or_else(String::new, |point| format!("point {}: ", point + 1)))]
pub struct TableError {
    /// Number of the point, from 0; `None`: the table as a whole.
    pub point: Option<usize>,
    /// Names the value, what is allowed and a way out.
    pub message: String,
}

impl HardeningTable {
    /// A table through `points` (plastic strain, yield stress in any unit).
    ///
    /// # Errors
    /// No points or too many; a plastic strain that does not start at 0 or does not grow; a yield stress that
    /// is not positive or falls. Softening is refused because its localisation follows the mesh, not the
    /// material.
    pub fn new(points: &[[f64; 2]]) -> Result<HardeningTable, TableError> {
        if points.is_empty() || points.len() > LARGEST_TABLE {
            let message = format!(
                "must have from 1 to {LARGEST_TABLE} points, not {}: give plastic strain and yield stress from first yield on",
                points.len()
            );
            return Err(TableError { point: None, message });
        }
        let mut before: Option<[f64; 2]> = None;
        for (point, &now) in points.iter().enumerate() {
            check_point(before, now).map_err(|message| TableError { point: Some(point), message })?;
            before = Some(now);
        }
        let mut work = vec![0.0];
        for pair in points.windows(2) {
            let done = work.last().copied().unwrap_or(0.0);
            work.push(done + 0.5 * (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]));
        }
        Ok(HardeningTable {
            strain: points.iter().map(|p| p[0]).collect(),
            stress: points.iter().map(|p| p[1]).collect(),
            work,
        })
    }

    /// The same curve with stresses in another unit, of which one is `unit` > 0 here.
    #[must_use]
    pub fn in_units_of(&self, unit: f64) -> HardeningTable {
        let over = |values: &[f64]| values.iter().map(|v| v / unit).collect();
        HardeningTable { strain: self.strain.clone(), stress: over(&self.stress), work: over(&self.work) }
    }

    /// Plastic strain and yield stress of each point.
    pub fn points(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        self.strain.iter().zip(&self.stress).map(|(strain, stress)| [*strain, *stress])
    }

    /// Stress at first yield.
    pub fn yield_stress(&self) -> f64 {
        self.stress[0]
    }

    /// dσ/dε_p from the point `index` on: 0 beyond the last one.
    fn slope(&self, index: usize) -> f64 {
        if index + 1 < self.strain.len() {
            (self.stress[index + 1] - self.stress[index]) / (self.strain[index + 1] - self.strain[index])
        } else {
            0.0
        }
    }

    /// The point of the curve at `plastic_strain` on the segment that begins at point `index`.
    fn on_segment(&self, index: usize, plastic_strain: f64) -> HardeningPoint {
        let slope = self.slope(index);
        let yield_stress = self.stress[index] + slope * (plastic_strain - self.strain[index]);
        HardeningPoint { plastic_strain, yield_stress, slope }
    }

    /// The segment that holds `plastic_strain` ≥ 0: the index of the point it begins at.
    fn segment(&self, plastic_strain: f64) -> usize {
        self.strain.partition_point(|p| *p <= plastic_strain).saturating_sub(1)
    }

    /// Yield stress and slope at accumulated plastic strain `plastic_strain` ≥ 0; at a kink the slope ahead.
    pub fn flow(&self, plastic_strain: f64) -> HardeningPoint {
        self.on_segment(self.segment(plastic_strain), plastic_strain)
    }

    /// Radial return: the flow state at which `q_trial - 3G (ε_p - ε_p,old) = σ(ε_p)`.
    ///
    /// `q_trial` is at or above the yield stress at `old_plastic_strain`; `three_g` is 3G.
    pub fn return_to_yield(&self, q_trial: f64, three_g: f64, old_plastic_strain: f64) -> HardeningPoint {
        // σ + 3G (ε_p - ε_p,old) grows with ε_p: the segment begins at the last point where it is below q
        let (mut low, mut high) = (self.segment(old_plastic_strain), self.strain.len());
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            if self.stress[middle] + three_g * (self.strain[middle] - old_plastic_strain) <= q_trial {
                low = middle;
            } else {
                high = middle;
            }
        }
        // from the old state where it is on that segment, so that a tiny flow keeps its digits
        let from = self.strain[low].max(old_plastic_strain);
        let at = self.on_segment(low, from);
        let excess = q_trial - three_g * (from - old_plastic_strain) - at.yield_stress;
        self.on_segment(low, from + excess.max(0.0) / (three_g + at.slope))
    }

    /// Plastic work per volume, ∫₀^{ε_p} σ dε_p, in the unit of the stresses.
    pub fn plastic_work(&self, plastic_strain: f64) -> f64 {
        let index = self.segment(plastic_strain);
        let end = self.on_segment(index, plastic_strain);
        self.work[index]
            + 0.5 * (plastic_strain - self.strain[index]) * (self.stress[index] + end.yield_stress)
    }
}

/// One point after the one before it; the error is a sentence for the user.
fn check_point(before: Option<[f64; 2]>, [strain, stress]: [f64; 2]) -> Result<(), String> {
    if !(stress > 0.0 && stress.is_finite()) {
        return Err(format!("the yield stress must be finite and above 0, not {stress}"));
    }
    match before {
        None if strain != 0.0 => Err(format!(
            "the plastic strain must start at 0, not at {strain}: the first point is first yield (plastic strain is total strain less stress over Young's modulus)"
        )),
        None => Ok(()),
        // of another temperature or rate
        Some([last, _]) if strain == 0.0 && last > 0.0 => Err(format!(
            "the plastic strain is 0 again after {last}: a second curve begins here; keep one in a file"
        )),
        Some([last, _]) if !(strain > last && strain.is_finite()) => Err(format!(
            "the plastic strain must grow from point to point, but {strain} follows {last}: sort the points and keep one of those with equal strain"
        )),
        Some([_, last]) if stress < last => Err(format!(
            "the yield stress must not fall, but {stress} follows {last}: metal that softens flows where the mesh lets it; end the table at its largest stress, which then stays constant"
        )),
        Some(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> HardeningTable {
        HardeningTable::new(&[[0.0, 1.0], [0.1, 2.0], [0.4, 2.6], [0.5, 2.6]]).unwrap()
    }

    #[test]
    fn linear_between_the_points_and_constant_beyond() {
        let t = table();
        for (p, stress, slope) in [(0.0, 1.0, 10.0), (0.05, 1.5, 10.0), (0.1, 2.0, 2.0), (0.25, 2.3, 2.0)] {
            let flow = t.flow(p);
            assert!((flow.yield_stress - stress).abs() < 1e-15 && (flow.slope - slope).abs() < 1e-13);
        }
        assert_eq!((t.flow(7.0).yield_stress, t.flow(7.0).slope), (2.6, 0.0));
    }

    #[test]
    fn the_return_lands_on_the_curve_from_every_state() {
        let t = table();
        for old in [0.0, 1e-9, 0.05, 0.1, 0.3, 0.5, 2.0] {
            for excess in [0.0, 1e-14, 1e-6, 0.3, 1.0, 2.0, 5.0, 1e3] {
                for three_g in [1e-3, 1.2, 100.0] {
                    let q = t.flow(old).yield_stress + excess;
                    let end = t.return_to_yield(q, three_g, old);
                    let gap = q - three_g * (end.plastic_strain - old) - end.yield_stress;
                    assert!(
                        gap.abs() <= 4e-16 * (q + three_g * end.plastic_strain),
                        "{old} {excess} {gap:e}"
                    );
                    assert!(end.plastic_strain >= old);
                    assert!((t.flow(end.plastic_strain).yield_stress - end.yield_stress).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn a_tiny_flow_keeps_its_digits() {
        let end = table().return_to_yield(1.5 + 1e-13, 1.0, 0.05);
        assert!(((end.plastic_strain - 0.05) / (1e-13 / 11.0) - 1.0).abs() < 1e-2);
    }

    #[test]
    fn work_is_the_integral_of_the_yield_stress() {
        let t = table();
        // trapezoids by hand
        for (p, work) in [(0.0, 0.0), (0.05, 0.0625), (0.1, 0.15), (0.4, 0.84), (0.5, 1.1), (1.5, 3.7)] {
            assert!((t.plastic_work(p) - work).abs() < 1e-15, "{p}");
            assert!((t.in_units_of(2.0).plastic_work(p) - 0.5 * work).abs() < 1e-15);
        }
    }

    #[test]
    fn what_is_no_curve_of_hardening_is_refused() {
        for (points, point, words) in [
            (&[][..], None, "from 1 to 100000 points, not 0"),
            (&[[0.01, 1.0]], Some(0), "must start at 0, not at 0.01"),
            (&[[0.0, 1.0], [0.1, 2.0], [0.1, 3.0]], Some(2), "0.1 follows 0.1"),
            (&[[0.0, 1.0], [0.1, 2.0], [0.0, 3.0]], Some(2), "a second curve begins here"),
            (&[[0.0, 1.0], [0.1, 2.0], [0.2, 1.9]], Some(2), "1.9 follows 2"),
            (&[[0.0, 0.0]], Some(0), "above 0, not 0"),
            (&[[0.0, 1.0], [0.1, f64::NAN]], Some(1), "not NaN"),
            (&[[f64::NAN, 1.0]], Some(0), "not at NaN"),
        ] {
            let error = HardeningTable::new(points).unwrap_err();
            assert_eq!(error.point, point);
            assert!(error.message.contains(words), "{error}");
        }
        assert!(HardeningTable::new(&[[0.0, 3.0]]).is_ok());
    }
}
