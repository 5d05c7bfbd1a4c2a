//! The direction of an iteration and how far it was gone.

use asperity_numerics::secants::Secants;
use asperity_numerics::vectors::dot;

/// A direction, where it was found, and the share of it that was gone since.
pub(super) struct LineSearch {
    direction: Vec<f64>,
    /// Displacement of each node where the direction was found.
    base: Vec<[f64; 2]>,
    residual_before: Vec<f64>,
    /// True where the contact of the converged state was kept there.
    kept_contact: bool,
    /// Share of the direction that was gone since.
    fraction: f64,
    /// True where a limit changed the residual at the last assessed iterate: no secant leads there.
    jumped: bool,
}

impl LineSearch {
    /// Of a body with so many `nodes` and `unknowns`.
    pub fn new(nodes: usize, unknowns: usize) -> LineSearch {
        LineSearch {
            direction: vec![0.0; unknowns],
            base: vec![[0.0; 2]; nodes],
            residual_before: vec![0.0; unknowns],
            kept_contact: false,
            fraction: 0.0,
            jumped: false,
        }
    }

    /// The next iterate is no step along the direction.
    pub fn restart(&mut self) {
        self.fraction = 0.0;
        self.jumped = false;
    }

    /// The next change of the residual tells nothing of the tangent: the factors are new.
    pub fn forget_step(&mut self) {
        self.fraction = 0.0;
    }

    /// The residual of the last iterate was changed by a limit.
    pub fn note_jump(&mut self) {
        self.jumped = true;
    }

    /// Finds the direction at `displacement`, where the residual is `residual` and whether the contact is
    /// kept there is known: `solve` does so with the factors, which `secants` correct by what the last step
    /// has shown.
    pub fn find_direction(
        &mut self,
        residual: &[f64],
        displacement: &[[f64; 2]],
        kept_contact: bool,
        secants: &mut Secants,
        solve: impl FnOnce(&mut [f64]),
    ) {
        if self.fraction > 0.0 && !self.jumped {
            secants.note(-self.fraction, &self.direction, &self.residual_before, residual);
        }
        self.restart();
        self.residual_before.copy_from_slice(residual);
        self.direction.copy_from_slice(residual);
        secants.solve(&mut self.direction, solve);
        self.base.clear();
        self.base.extend_from_slice(displacement);
        self.kept_contact = kept_contact;
    }

    /// Slope of the potential along the direction where the residual is `residual`.
    pub fn slope(&self, residual: &[f64]) -> f64 {
        -dot(residual, &self.direction)
    }

    /// Goes to this `fraction` of the direction. `None` where it leads away from its start; at the start,
    /// whether the contact was kept there.
    pub fn advance(&mut self, fraction: f64) -> Option<bool> {
        self.fraction = fraction;
        (fraction == 0.0).then_some(self.kept_contact)
    }

    /// Displacement of a component of `node` there, which is unknown `number`.
    pub fn displacement(&self, node: usize, component: usize, number: u32) -> f64 {
        self.base[node][component] - self.fraction * self.direction[number as usize]
    }
}
