//! The time that a reproduction still takes: what was expected of each part, at the pace of what is done.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Seconds of work that count as done at the pace that was expected, so that the first tenths of a second do
/// not speak for minutes.
const TRUSTED: f64 = 1.0;

/// A part of the work, and how far it has come.
#[derive(Clone, Copy, Debug)]
struct Reached {
    /// Seconds that it is expected to take on one core; 0 of a part that was done before.
    expected: f64,
    /// Share that is done, 0 to 1.
    share: f64,
    /// Its begin, while it runs.
    begun: Option<Instant>,
    /// Seconds that it took so far.
    took: f64,
}

/// Progress of all parts.
#[derive(Debug)]
pub struct Pace {
    parts: Mutex<Vec<Reached>>,
    cores: f64,
}

/// Work of all parts that is done, and work that remains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// Share of the work that is done, 0 to 1.
    pub share: f64,
    /// Seconds until all parts are done.
    pub left: f64,
}

impl Pace {
    /// Parts that are expected to take these seconds on one core, 0 of those that are done, on `cores`.
    pub fn new(expected: impl Iterator<Item = f64>, cores: usize) -> Pace {
        let part = |expected| Reached { expected, share: 0.0, begun: None, took: 0.0 };
        Pace { parts: Mutex::new(expected.map(part).collect()), cores: cores.max(1) as f64 }
    }

    fn parts(&self) -> MutexGuard<'_, Vec<Reached>> {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes that part `i` has begun.
    pub fn begin(&self, i: usize) {
        if let Some(part) = self.parts().get_mut(i) {
            part.begun = Some(Instant::now());
        }
    }

    /// Notes that `share` (0 to 1) of part `i` is done; gives what is left of all.
    pub fn reach(&self, i: usize, share: f64) -> Outlook {
        let mut parts = self.parts();
        if let Some(part) = parts.get_mut(i) {
            part.share = share.clamp(part.share, 1.0);
            part.took = part.begun.map_or(0.0, |begun| begun.elapsed().as_secs_f64());
        }
        outlook(&parts, self.cores)
    }
}

/// The remaining work of `parts`, as they were expected, at the pace of the work done.
fn outlook(parts: &[Reached], cores: f64) -> Outlook {
    let sum = |of: fn(&Reached) -> f64| parts.iter().map(of).sum::<f64>();
    let (all, done, took) = (sum(|p| p.expected), sum(|p| p.expected * p.share), sum(|p| p.took));
    let pace = (TRUSTED + took) / (TRUSTED + done);
    // a part is on one core, however many stand idle beside it
    let longest = parts.iter().map(|p| p.expected * (1.0 - p.share)).fold(0.0, f64::max);
    let left = pace * ((all - done) / cores).max(longest);
    Outlook { share: if all > 0.0 { done / all } else { 1.0 }, left }
}

#[cfg(test)]
mod tests {
    //! Claim: what is left follows the pace of what is done, not what was expected.
    use super::*;

    fn part(expected: f64, share: f64, took: f64) -> Reached {
        Reached { expected, share, begun: None, took }
    }

    #[test]
    fn parts_that_take_three_times_as_long_as_expected_triple_what_is_left() {
        let left = |took: f64| {
            let parts = [part(40.0, 1.0, took), part(100.0, 0.0, 0.0), part(100.0, 0.0, 0.0)];
            outlook(&parts, 2.0).left
        };
        assert!((left(40.0) - 100.0).abs() < 1e-9);
        // the trusted second is 1 of 41
        assert!((left(120.0) / 300.0 - 1.0).abs() < 0.03, "{}", left(120.0));
    }

    #[test]
    fn no_part_is_shared_by_cores() {
        let parts = [part(60.0, 0.5, 30.0), part(1.0, 1.0, 1.0)];
        assert!((outlook(&parts, 8.0).left - 30.0).abs() < 1e-9);
    }

    #[test]
    fn all_is_done_in_the_end_and_parts_of_before_take_nothing() {
        let pace = Pace::new([0.0, 5.0].into_iter(), 2);
        pace.begin(1);
        assert_eq!(pace.reach(1, 1.0), Outlook { share: 1.0, left: 0.0 });
        assert_eq!(Pace::new([0.0].into_iter(), 2).reach(0, 1.0).share, 1.0);
    }
}
