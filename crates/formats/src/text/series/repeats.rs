//! Tests that stand twice in a table, in two units.

/// Largest difference of the readings of one test in two units, as a share of the largest: that of printed
/// digits. Two tests of one metal part by more.
const ROUNDING: f64 = 1e-4;

/// Fewest readings of a repeat: fewer may agree by chance.
const FEWEST_READINGS: usize = 8;

/// Leaves out what repeats an earlier one of the `tests`, whose lines and numbers are its `readings`,
/// and returns how many those are.
pub(super) fn leave_out_repeats<T, const N: usize>(
    tests: &mut Vec<T>,
    readings: impl Fn(&T) -> (&[usize], &[[f64; N]]),
) -> usize {
    let before = tests.len();
    let mut kept: Vec<T> = Vec::with_capacity(before);
    for test in tests.drain(..) {
        if !kept.iter().any(|earlier| is_repeat(readings(earlier), readings(&test))) {
            kept.push(test);
        }
    }
    *tests = kept;
    before - tests.len()
}

fn is_repeat<const N: usize>(one: (&[usize], &[[f64; N]]), other: (&[usize], &[[f64; N]])) -> bool {
    let largest = |i: usize| one.1.iter().fold(0.0, |most: f64, row| most.max(row[i].abs()));
    let rows = || one.1.iter().zip(other.1);
    // one beside the other
    one.1.len() >= FEWEST_READINGS
        && one.0 == other.0
        && (0..N).all(|i| rows().all(|(a, b)| (a[i] - b[i]).abs() <= ROUNDING * largest(i)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_in_two_units_counts_once() {
        let test = |factor: f64| -> (Vec<usize>, Vec<[f64; 2]>) {
            (1..9).map(|i| (i, [i as f64, factor * (i * i) as f64])).unzip()
        };
        let mut tests = vec![test(1.0), test(1.003), test(1.00001)];
        let left = leave_out_repeats(&mut tests, |(lines, rows)| (lines, rows));
        assert_eq!((left, tests), (1, vec![test(1.0), test(1.003)]));
    }
}
