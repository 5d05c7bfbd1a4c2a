//! The values that the keys of a study take in each run: every combination, values in step, or points drawn
//! from ranges.

use super::vary::{Values, Vary, wrong};
use crate::error::InputError;
use asperity_numerics::sobol::{self, Sobol};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

/// The way the values of several keys are combined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sample {
    /// Every combination; the last key runs fastest.
    #[default]
    Grid,
    /// The first values of all keys, then the second ones.
    List,
    /// A Latin hypercube: in every key one point in each of equally many equal parts.
    Lhs {
        /// Their number.
        points: usize,
        /// Other seeds draw other points.
        seed: u64,
    },
    /// The first points of Sobol's sequence; more of them continue it.
    Sobol {
        /// Their number.
        points: usize,
    },
}

/// More runs than this are a slip of the pen.
const MAX_RUNS: usize = 10_000_000;

/// The points of a study.
#[derive(Clone, Debug)]
pub(super) struct Points {
    vary: Vec<Vary>,
    kind: Kind,
    len: usize,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Numbers of values of each key, combined.
    Grid(Vec<usize>),
    /// Values of each key, in step.
    List,
    /// Share of the way for each key and point.
    Lhs(Vec<Vec<f64>>),
    Sobol(Sobol),
}

impl Points {
    /// # Errors
    /// No keys, a key that stands twice, ranges with or without a number of values where they need it
    /// otherwise, lists of different lengths, no points or too many.
    pub fn new(vary: &[Vary], sample: Sample) -> Result<Points, InputError> {
        if vary.is_empty() {
            let help = "give --vary KEY=V1,V2,… or a [vary] table, for example --vary material.hardening_exponent=0,0.1,0.2";
            return Err(InputError::new("a study varies at least one key").help(help));
        }
        for (i, one) in vary.iter().enumerate() {
            if vary[..i].iter().any(|other| other.key == one.key) {
                return Err(wrong(&one.key, "is varied twice"));
            }
        }
        let counts = || vary.iter().map(count).collect::<Result<Vec<_>, _>>();
        let (kind, len) = match sample {
            Sample::Grid => {
                let counts = counts()?;
                let len = counts.iter().try_fold(1_usize, |len, &count| len.checked_mul(count));
                (Kind::Grid(counts), len.unwrap_or(usize::MAX))
            }
            Sample::List => {
                let counts = counts()?;
                let len = counts[0];
                if let Some((one, count)) = vary.iter().zip(&counts).find(|(_, count)| **count != len) {
                    let first = &vary[0].key;
                    let message = format!("has {count} values, {first} has {len}: in step they need as many");
                    return Err(wrong(&one.key, &message));
                }
                (Kind::List, len)
            }
            Sample::Lhs { points, seed } => {
                check_drawn(vary, points)?;
                (Kind::Lhs((0..vary.len()).map(|key| hypercube(points, seed, key)).collect()), points)
            }
            Sample::Sobol { points } => {
                check_drawn(vary, points)?;
                let sobol = Sobol::new(vary.len()).ok_or_else(|| {
                    InputError::new(format!(
                        "Sobol's sequence is there for {} keys, not for {}: take a Latin hypercube, --sample lhs N",
                        sobol::MAX_DIMENSIONS,
                        vary.len()
                    ))
                })?;
                (Kind::Sobol(sobol), points)
            }
        };
        if len > MAX_RUNS {
            return Err(too_many());
        }
        Ok(Points { vary: vary.to_vec(), kind, len })
    }

    /// Their number.
    pub fn len(&self) -> usize {
        self.len
    }

    /// The values of all keys in run `i`.
    pub fn get(&self, i: usize) -> Vec<String> {
        let drawn = |share: &dyn Fn(usize) -> f64| {
            self.vary.iter().enumerate().map(|(key, one)| one.value_at(share(key))).collect()
        };
        match &self.kind {
            Kind::Grid(counts) => {
                let mut rest = i;
                let keys = self.vary.iter().zip(counts).rev();
                let mut values: Vec<String> = keys
                    .map(|(one, count)| {
                        let value = one.level(rest % count);
                        rest /= count;
                        value
                    })
                    .collect();
                values.reverse();
                values
            }
            Kind::List => self.vary.iter().map(|one| one.level(i)).collect(),
            Kind::Lhs(shares) => drawn(&|key| shares[key][i]),
            Kind::Sobol(sobol) => drawn(&|key| sobol.coordinate(key, i)),
        }
    }
}

fn count(vary: &Vary) -> Result<usize, InputError> {
    vary.count()
        .ok_or_else(|| wrong(&vary.key, "a range without --sample needs its number of values behind a slash"))
}

fn too_many() -> InputError {
    InputError::new(format!("the study has more than {MAX_RUNS} runs"))
        .help("take fewer values of a key, or draw from the ranges: --sample lhs 1000")
}

fn check_drawn(vary: &[Vary], points: usize) -> Result<(), InputError> {
    if points == 0 {
        return Err(InputError::new("a sample needs at least 1 point"));
    }
    if points > MAX_RUNS {
        return Err(too_many());
    }
    let counted = |one: &&Vary| matches!(&one.values, Values::Range(range) if range.count.is_some());
    match vary.iter().find(counted) {
        Some(one) => {
            Err(wrong(&one.key, "a range that is drawn from has no number of values: leave out the slash"))
        }
        None => Ok(()),
    }
}

/// Shares of the way of a key: one in each of `points` equal parts, in an order of its own.
fn hypercube(points: usize, seed: u64, key: usize) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(key as u64);
    let mut parts: Vec<usize> = (0..points).collect();
    for i in (1..points).rev() {
        // the bias of the remainder is below 1e-12 for as many points as there may be
        parts.swap(i, (random.next_u64() % (i as u64 + 1)) as usize);
    }
    let unit = |random: &mut ChaCha8Rng| (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    parts.into_iter().map(|part| (part as f64 + unit(&mut random)) / points as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(texts: &[&str], sample: Sample) -> Result<Points, InputError> {
        let vary: Vec<Vary> = texts.iter().map(|text| Vary::parse(text).unwrap()).collect();
        Points::new(&vary, sample)
    }

    #[test]
    fn the_last_key_of_a_grid_runs_fastest_and_lists_go_in_step() {
        let all = |p: &Points| (0..p.len()).map(|i| p.get(i).join(" ")).collect::<Vec<_>>();
        let grid = points(&["a=1,2", "b=x,y,z"], Sample::Grid).unwrap();
        assert_eq!(all(&grid), ["1 x", "1 y", "1 z", "2 x", "2 y", "2 z"]);
        let list = points(&["a=1,2", "b=x,y"], Sample::List).unwrap();
        assert_eq!(all(&list), ["1 x", "2 y"]);
        let error = points(&["a=1,2", "b=x"], Sample::List).unwrap_err().to_string();
        assert!(error.starts_with("b: "), "{error}");
    }

    #[test]
    fn a_hypercube_has_one_point_in_every_part_of_every_key() {
        let sample = Sample::Lhs { points: 50, seed: 3 };
        let drawn = points(&["a=0..50", "b=0..50", "c=u,v"], sample).unwrap();
        for key in 0..2 {
            let mut parts: Vec<usize> =
                (0..50).map(|i| drawn.get(i)[key].parse::<f64>().unwrap() as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..50).collect::<Vec<_>>());
        }
        assert_eq!((0..50).filter(|&i| drawn.get(i)[2] == "u").count(), 25);
        let other = points(&["a=0..50"], Sample::Lhs { points: 50, seed: 4 }).unwrap();
        assert_ne!(other.get(0)[0], drawn.get(0)[0]);
        assert_ne!(drawn.get(0)[0], drawn.get(0)[1]);
    }

    #[test]
    fn what_cannot_be_combined_is_named() {
        let said = |texts: &[&str], sample| points(texts, sample).unwrap_err().to_string();
        assert!(said(&["a=0..1"], Sample::Grid).starts_with("a: a range without --sample"));
        assert!(said(&["a=0..1/3"], Sample::Sobol { points: 4 }).starts_with("a: a range that is drawn"));
        assert!(said(&["a=1,2", "a=3"], Sample::Grid).starts_with("a: is varied twice"));
        assert!(said(&["a=0..1"], Sample::Lhs { points: 0, seed: 0 }).contains("at least 1"));
        assert!(said(&["a=0..1/10000", "b=0..1/10000"], Sample::Grid).contains("more than"));
        // refused before any list is made: it would hold 24 GB, and 1e18 values
        assert!(said(&["a=0..1/1000000000"], Sample::Grid).contains("more than"));
        assert!(said(&["a=0..1/1000000000000000000"], Sample::List).contains("more than"));
        assert!(said(&["a=0..1/10000000000", "b=0..1/10000000000"], Sample::Grid).contains("more than"));
        assert!(said(&[], Sample::Grid).contains("at least one key"));
    }
}
