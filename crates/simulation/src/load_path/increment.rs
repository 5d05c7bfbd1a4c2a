//! The increments of a path, and why it stops.

use crate::record::rows::Phase;
use asperity_solver::body::energy::ContactSums;
use asperity_solver::equilibrium::Equilibrium;

/// One converged increment, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Loading, unloading or reloading.
    pub phase: Phase,
    /// Travel of the tool from first touch, penetration included.
    pub travel: f64,
    /// Travel less penetration, and what the rules add for the far field, tool and machine. A depth that was
    /// asked for is met to 1e-9 and stands here as asked.
    pub depth: f64,
    /// Sums over the contact.
    pub contact: ContactSums,
    /// Deflection of tool and machine, a part of the depth.
    pub compliance_depth: f64,
    /// Energies since the first touch.
    pub energies: Energies,
    /// Newton iterations since the last increment.
    pub newton_iterations: usize,
}

/// Energies since the first touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energies {
    /// ∫F d(travel).
    pub external_work: f64,
    /// Elastic energy stored since then.
    pub elastic: f64,
    /// Plastic work.
    pub plastic: f64,
}

/// The reason why a run ended before its target. The last converged increment is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// Elements were distorted until one turned inside out.
    #[error("an element turned inside out: the metal is too distorted for its mesh")]
    Distorted,
    /// No equilibrium was found however small the increment.
    #[error("no equilibrium was found with the smallest increment")]
    NoEquilibrium,
    /// No equilibrium, in a body whose elastic strain is beyond what its law of elasticity can carry.
    #[error(
        "an elastic strain beyond 1/3, where Hencky's elasticity ends: give a yield stress, or press less deep"
    )]
    ElasticStrain,
    /// However small the increment, the metal flows by more than the tool and what is stored have energy for.
    #[error(
        "the metal leaps to another state, with more plastic work than there is energy for, however small the increment: take a blunter tool, a metal that hardens more, or a smaller depth"
    )]
    Leaps,
    /// A force that the tool does not find as deep as it can go.
    #[error("target force not reached at maximum depth: ask for less force, or for a depth")]
    ForceNotReached,
    /// Loading went back: the contact jumps between two states, as that of a light load does on a surface
    /// that was dented far deeper.
    #[error(
        "the depth fell while loading, so that force and depth go back and forth: press deeper, or give the body no earlier load that is so much heavier"
    )]
    DepthFell,
    /// A flank went through another part of the surface before the contact of the two was seen.
    #[error("a flank met another flank and went through it")]
    FlanksMeet,
    /// The observer asked for the end.
    #[error("the run was interrupted")]
    Interrupted,
}

/// Called after every converged increment; `false` ends the run.
pub type Observer<'o> = dyn FnMut(&Equilibrium<'_>, &Increment) -> bool + 'o;
