//! Bisection: the place at which a condition ceases to hold.

/// Halves the interval between `ends` so many times, towards where `is_below` turns from true to false on the
/// way from the first end to the second, and returns the ends of the remainder. Neither end is asked: where
/// the condition holds all along, the second end stays, and where it holds nowhere the first.
///
/// ```
/// use asperity_numerics::bisection::bisect;
///
/// let [low, high] = bisect([0.0, 2.0], 60, |x| x * x < 2.0);
/// assert!(low <= 2_f64.sqrt() && 2_f64.sqrt() <= high && high - low < 1e-15);
/// ```
#[must_use]
pub fn bisect(
    [mut low, mut high]: [f64; 2],
    halvings: usize,
    mut is_below: impl FnMut(f64) -> bool,
) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, high]
}
