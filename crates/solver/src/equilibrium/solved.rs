//! A solve as it can be recalled, and what the solver remembers after it: with both, a run that was killed goes on with the same
//! bits.
//!
//! A recalled solve is one or two assemblies instead of a Newton iteration. It is checked by its residual, which must be the one it
//! ended with to the bit, so that a solve of another body, program or machine is not taken for one of this.

use super::{Equilibrium, SolveFailure};
use crate::body::failure::Failure;
use crate::point::failure::Failure as PointFailure;
use asperity_numerics::newton::{NewtonError as NewtonFailure, System};
use asperity_numerics::secants::{PAIRS, Secants};
use asperity_numerics::vectors::norm;
use std::io::{self, Read, Write};

/// Numbers that are written at once.
const CHUNK: usize = 1024;

/// Iterations of a solve, and why it failed, if it did.
pub type Outcome = Result<usize, (SolveFailure, usize)>;

/// How a solve ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    outcome: Outcome,
    /// Norm of the last residual.
    residual: f64,
    /// Whether the last assembly had a tangent.
    tangent: bool,
    /// Displacements of the nodes: where their extrapolation was limited, and at the end. Empty for a solve that failed, from which nothing
    /// goes on.
    limited_at: Option<Vec<[f64; 2]>>,
    displacement: Vec<[f64; 2]>,
}

fn write_words(to: &mut dyn Write, words: &[u64]) -> io::Result<()> {
    words.iter().try_for_each(|word| to.write_all(&word.to_le_bytes()))
}

fn write_numbers(to: &mut dyn Write, numbers: &[f64]) -> io::Result<()> {
    let mut bytes = [0; 8 * CHUNK];
    for chunk in numbers.chunks(CHUNK) {
        let filled = &mut bytes[..8 * chunk.len()];
        filled.chunks_exact_mut(8).zip(chunk).for_each(|(to, x)| to.copy_from_slice(&x.to_le_bytes()));
        to.write_all(filled)?;
    }
    Ok(())
}

fn read_words<const N: usize>(from: &mut dyn Read) -> io::Result<[u64; N]> {
    let mut words = [0; N];
    for word in &mut words {
        let mut bytes = [0; 8];
        from.read_exact(&mut bytes)?;
        *word = u64::from_le_bytes(bytes);
    }
    Ok(words)
}

fn read_numbers(from: &mut dyn Read, numbers: &mut [f64]) -> io::Result<()> {
    for number in numbers {
        *number = f64::from_bits(read_words::<1>(from)?[0]);
    }
    Ok(())
}

fn read_places(from: &mut dyn Read, nodes: usize) -> io::Result<Vec<[f64; 2]>> {
    let mut places = vec![[0.0; 2]; nodes];
    read_numbers(from, places.as_flattened_mut())?;
    Ok(places)
}

fn damaged() -> io::Error {
    io::Error::from(io::ErrorKind::InvalidData)
}

/// An outcome as three numbers.
fn coded(outcome: &Outcome) -> [u64; 3] {
    let (Ok(spent) | Err((_, spent))) = *outcome;
    let [kind, cell] = match outcome {
        Ok(_) => [0, 0],
        Err((NewtonFailure::NotConverged, _)) => [1, 0],
        Err((NewtonFailure::NotFinite, _)) => [2, 0],
        Err((NewtonFailure::System(Failure::Singular), _)) => [3, 0],
        Err((NewtonFailure::System(Failure::Element { cell, cause }), _)) => match cause {
            PointFailure::Inverted => [4, *cell as u64],
            PointFailure::NotPositive => [5, *cell as u64],
        },
    };
    [kind, cell, spent as u64]
}

fn decoded([kind, cell, spent]: [u64; 3]) -> io::Result<Outcome> {
    let element = |cause| NewtonFailure::System(Failure::Element { cell: cell as usize, cause });
    let failure = match kind {
        0 => return Ok(Ok(spent as usize)),
        1 => NewtonFailure::NotConverged,
        2 => NewtonFailure::NotFinite,
        3 => NewtonFailure::System(Failure::Singular),
        4 => element(PointFailure::Inverted),
        5 => element(PointFailure::NotPositive),
        _ => return Err(damaged()),
    };
    Ok(Err((failure, spent as usize)))
}

impl Solved {
    /// Writes it to a file, or to memory.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        write_words(to, &coded(&self.outcome))?;
        let flags = [self.tangent, self.limited_at.is_some()].map(u64::from);
        write_words(to, &[flags[0], flags[1], self.residual.to_bits()])?;
        for places in self.limited_at.iter().chain([&self.displacement]) {
            write_numbers(to, places.as_flattened())?;
        }
        Ok(())
    }

    /// Reads what [`Solved::write`] wrote of a body with so many `nodes`.
    ///
    /// # Errors
    /// A file that ends early, or that holds something else.
    pub fn read(from: &mut dyn Read, nodes: usize) -> io::Result<Solved> {
        let outcome = decoded(read_words(from)?)?;
        let [tangent, limited, residual] = read_words(from)?;
        let limited_at = if limited == 1 { Some(read_places(from, nodes)?) } else { None };
        let displacement = if outcome.is_ok() { read_places(from, nodes)? } else { Vec::new() };
        Ok(Solved {
            outcome,
            residual: f64::from_bits(residual),
            tangent: tangent == 1,
            limited_at,
            displacement,
        })
    }
}

impl Equilibrium<'_> {
    /// The solve that has just ended with `outcome`.
    pub fn solved(&mut self, outcome: Outcome) -> Solved {
        let goes_on = outcome.is_ok();
        let solved = Solved {
            outcome,
            residual: self.residual_norm(),
            tangent: self.has_tangent,
            limited_at: (goes_on && !self.limited_at.is_empty()).then(|| self.limited_at.clone()),
            displacement: if goes_on { self.trial.displacement.clone() } else { Vec::new() },
        };
        self.limited_at.clear();
        solved
    }

    /// Goes to the end of a `solved` increment, of which the beginning was made. `None` if this body is not in equilibrium there as that
    /// one was: then all is as it was.
    pub fn recall(&mut self, solved: &Solved) -> Option<Outcome> {
        if solved.outcome.is_err() {
            self.forget();
            return Some(solved.outcome);
        }
        let before = (self.trial.clone(), self.touching.clone());
        let flags = (self.keep_contact, self.unlimited, self.jumped);
        let met = solved
            .limited_at
            .iter()
            .map(|places| (places, false))
            .chain([(&solved.displacement, solved.tangent)]);
        let mut residual = None;
        for (places, tangent) in met {
            self.trial.displacement.clone_from(places);
            self.keep_contact = false;
            residual = self.assess(tangent).ok().map(|assessed| assessed.residual);
        }
        // the next solve may limit nothing
        self.limited_at.clear();
        if residual.is_some_and(|residual| residual.to_bits() == solved.residual.to_bits()) {
            return Some(solved.outcome);
        }
        (self.trial, self.touching) = before;
        (self.keep_contact, self.unlimited, self.jumped) = flags;
        (self.has_factors, self.has_tangent) = (false, false);
        None
    }

    fn residual_norm(&self) -> f64 {
        norm(&self.response.residual)
    }

    /// Writes what the next solve takes from those before it, beside the state of the body.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write_memory(&self, to: &mut dyn Write) -> io::Result<()> {
        let flags = [self.jumped, self.has_factors].map(u64::from);
        write_words(to, &flags)?;
        write_words(to, &[self.secants.noted().len() as u64, self.fraction.to_bits()])?;
        write_numbers(to, &self.direction)?;
        write_numbers(to, &self.residual_before)?;
        for (step, change, inverse) in self.secants.noted() {
            write_numbers(to, step)?;
            write_numbers(to, change)?;
            write_numbers(to, &[inverse])?;
        }
        if self.has_factors {
            self.factor.values().try_for_each(|values| write_numbers(to, values))?;
            let yielded: Vec<f64> =
                self.yielded.iter().map(|&yielded| f64::from(u8::from(yielded))).collect();
            write_numbers(to, &yielded)?;
        }
        Ok(())
    }

    /// Reads what [`Equilibrium::write_memory`] wrote of this body at the same solve.
    ///
    /// # Errors
    /// A file that ends early: the next solve then begins with a tangent of its own.
    pub fn read_memory(&mut self, from: &mut dyn Read) -> io::Result<()> {
        self.has_factors = false;
        let [jumped, has_factors, pairs, fraction] = read_words(from)?;
        if pairs > PAIRS as u64 {
            return Err(damaged());
        }
        (self.jumped, self.fraction) = (jumped == 1, f64::from_bits(fraction));
        read_numbers(from, &mut self.direction)?;
        read_numbers(from, &mut self.residual_before)?;
        let mut noted = Vec::new();
        for _ in 0..pairs {
            let (mut step, mut change) = (self.direction.clone(), self.direction.clone());
            let mut inverse = [0.0];
            read_numbers(from, &mut step)?;
            read_numbers(from, &mut change)?;
            read_numbers(from, &mut inverse)?;
            noted.push((step, change, inverse[0]));
        }
        self.secants = Secants::of_noted(noted);
        if has_factors == 1 {
            self.factor.values_mut().try_for_each(|values| read_numbers(from, values))?;
            let mut yielded = vec![0.0; self.response.points.states.len()];
            read_numbers(from, &mut yielded)?;
            self.yielded = yielded.iter().map(|&yielded| yielded > 0.5).collect();
            self.has_factors = true;
        }
        Ok(())
    }
}
