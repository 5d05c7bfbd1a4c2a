//! The model as Newton sees it: out-of-balance forces, a direction, a step along it.

use super::Model;
use crate::algebra::dofs::FIXED;
use crate::algebra::newton::{Assessment, Failure, System};
use crate::point::j2::Tangent;

impl System for Model<'_> {
    fn assess(&mut self, tangent: bool) -> Result<Assessment, Failure> {
        let changed = self.assemble(if tangent { Tangent::Exact } else { Tangent::None })?;
        let residual = self.residual.iter().map(|r| r * r).sum::<f64>().sqrt();
        // forces of the held components and of the tool, and the largest load so far (the load itself goes to 0)
        let mut reaction = 0.0;
        for (f, numbers) in self.internal.iter().zip(&self.dofs.number) {
            for i in 0..2 {
                if numbers[i] == FIXED {
                    reaction += f[i] * f[i];
                }
            }
        }
        for edge in &self.edge_contact {
            reaction += edge.force.iter().flatten().map(|f| f * f).sum::<f64>();
        }
        let scale = reaction.sqrt().max(self.load_scale).max(f64::MIN_POSITIVE);
        Ok(Assessment { residual, scale, changed })
    }

    fn renew(&mut self) -> Result<(), Failure> {
        if !self.has_tangent {
            self.assemble_again(Tangent::Exact)?;
        }
        self.factorise()
    }

    fn has_factors(&self) -> bool {
        self.has_factors
    }

    fn forget(&mut self) {
        self.has_factors = false;
    }

    fn find_direction(&mut self) {
        let clock = std::time::Instant::now();
        if self.fraction > 0.0 {
            self.secants.note(-self.fraction, &self.direction, &self.residual_before, &self.residual);
        }
        self.fraction = 0.0;
        self.residual_before.copy_from_slice(&self.residual);
        self.direction.copy_from_slice(&self.residual);
        self.secants.solve(&mut self.direction, |rhs| self.factor.solve(rhs));
        self.base.clone_from(&self.increment);
        self.base_kept_contact = self.kept_contact;
        self.counters.solve_s += clock.elapsed().as_secs_f64();
    }

    fn slope(&self) -> f64 {
        -self.residual.iter().zip(&self.direction).map(|(r, d)| r * d).sum::<f64>()
    }

    fn advance(&mut self, fraction: f64) {
        self.fraction = fraction;
        if fraction == 0.0 {
            self.keep_contact = self.base_kept_contact;
        }
        for ((du, base), numbers) in self.increment.iter_mut().zip(&self.base).zip(&self.dofs.number) {
            for i in 0..2 {
                if numbers[i] != FIXED {
                    du[i] = base[i] - fraction * self.direction[numbers[i] as usize];
                }
            }
        }
    }
}
