//! Tests that stand twice in a table, in two units.

use super::Series;

/// Largest difference of the readings of one test in two units, as a share of the largest: that of printed
/// digits. Two tests of one metal part by more.
const ROUNDING: f64 = 1e-4;

/// Fewest readings of a repeat: fewer may agree by chance.
const FEWEST_READINGS: usize = 8;

/// Leaves out what repeats an earlier one of the `tests`, and returns how many those are.
pub(super) fn leave_out_repeats<const N: usize>(tests: &mut Vec<Series<N>>) -> usize {
    let before = tests.len();
    let mut kept: Vec<Series<N>> = Vec::with_capacity(before);
    for test in tests.drain(..) {
        if !kept.iter().any(|earlier| is_repeat(earlier, &test)) {
            kept.push(test);
        }
    }
    *tests = kept;
    before - tests.len()
}

fn is_repeat<const N: usize>(one: &Series<N>, other: &Series<N>) -> bool {
    let largest = |i: usize| one.rows.iter().fold(0.0, |most: f64, row| most.max(row[i].abs()));
    let rows = || one.rows.iter().zip(&other.rows);
    // one beside the other
    one.rows.len() >= FEWEST_READINGS
        && one.lines == other.lines
        && (0..N).all(|i| rows().all(|(a, b)| (a[i] - b[i]).abs() <= ROUNDING * largest(i)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_in_two_units_counts_once() {
        let test = |factor: f64| Series {
            label: "1".into(),
            rows: (1..9).map(|i| [f64::from(i), factor * f64::from(i * i)]).collect(),
            lines: (1..9).collect(),
        };
        let mut tests = vec![test(1.0), test(1.003), test(1.00001)];
        assert_eq!((leave_out_repeats(&mut tests), tests), (1, vec![test(1.0), test(1.003)]));
    }
}
