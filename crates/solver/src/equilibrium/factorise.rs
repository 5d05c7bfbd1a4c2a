//! The factorisation of the tangent, and of what takes its place where it is not definite.

use super::Equilibrium;
use crate::body::dofs::FIXED;
use crate::body::failure::Failure;
use crate::contact::parts::NOTHING;
use crate::point::j2::Tangent;
use std::time::Instant;

/// Negative pivots with which an LDLᵀ step is still taken: a limit point or a bifurcation has one or two;
/// more mean that the iterate is far from any equilibrium.
const TOLERATED_NEGATIVE_PIVOTS: usize = 2;

/// Shares of the diagonal that are added to it, one after the other, until the tangent is definite.
const ADDED_DIAGONAL: [f64; 2] = [1e-2, 1e-1];

impl Equilibrium<'_> {
    /// Factorises the stiffness, or what [`Self::factorise_indefinite`] puts in its place if a pivot is lost.
    pub(super) fn factorise(&mut self) -> Result<(), Failure> {
        let clock = Instant::now();
        self.counters.factorisations += 1;
        self.factors.secants.clear();
        self.search.forget_step();
        let outcome = match self.factors.factor.cholesky(&self.stiffness.matrix) {
            Ok(()) => Ok(()),
            Err(_) => self.factorise_indefinite(),
        };
        self.factors.valid = outcome.is_ok();
        self.note_friction();
        self.factors.note_yielding(self.response.yielding_points(&self.trial));
        self.counters.factor_s += clock.elapsed().as_secs_f64();
        outcome
    }

    /// Takes down what the tangent of friction has beside the stiffness.
    fn note_friction(&mut self) {
        let correction = &mut self.factors.correction;
        correction.clear();
        if self.body.contact.as_ref().is_none_or(|contact| contact.friction.is_none()) {
            return;
        }
        let numbers = &self.body.analysis.dofs.number;
        for (edge, share) in
            self.state.edges.iter().zip(&self.response.contact).filter(|(_, s)| s.parts != NOTHING)
        {
            let nodes = &edge.nodes[..edge.node_count()];
            for (a, row) in nodes.iter().enumerate() {
                for (b, column) in nodes.iter().enumerate() {
                    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        let [row, column] = [numbers[*row as usize][i], numbers[*column as usize][j]];
                        if row != FIXED && column != FIXED {
                            correction.add_entry(row, column, share.unsymmetric[a][i][b][j]);
                        }
                    }
                }
            }
        }
    }

    /// A tangent without the compressive geometric term; else LDLᵀ of the exact one if it is nearly definite;
    /// else a stiffer one.
    fn factorise_indefinite(&mut self) -> Result<(), Failure> {
        self.counters.lost_pivots += 1;
        self.assemble_again(Tangent::WithoutCompression)?;
        if self.factors.factor.cholesky(&self.stiffness.matrix).is_ok() {
            return Ok(());
        }
        self.assemble_again(Tangent::Exact)?;
        match self.factors.factor.ldlt(&self.stiffness.matrix) {
            Ok(negative) if negative <= TOLERATED_NEGATIVE_PIVOTS => Ok(()),
            _ if self.stiffens => self.factorise_stiffened(),
            _ => Err(Failure::Singular),
        }
    }

    /// The exact tangent with a stiffer diagonal, as little as makes it definite: directions that go down,
    /// where a perfectly plastic body gives way and Newton's go anywhere.
    fn factorise_stiffened(&mut self) -> Result<(), Failure> {
        for share in ADDED_DIAGONAL {
            self.stiffness.stiffen(share);
            if self.factors.factor.cholesky(&self.stiffness.matrix).is_ok() {
                return Ok(());
            }
        }
        Err(Failure::Singular)
    }
}
