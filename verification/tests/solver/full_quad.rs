//! A system of fully integrated four-node elements, axisymmetric: what the solver does not offer, because it
//! locks. Source: the standard displacement formulation (T. J. R. Hughes, The Finite Element Method, §3.9).
//! No claim of its own: only `punch` uses it, to show that its claim can fail.

use asperity_mesh::Mesh;
use asperity_numerics::newton::{Assessment, System};
use asperity_numerics::sparse::cholesky::{Factor, Precision};
use asperity_solver::body::dofs::{Dofs, FIXED};
use asperity_solver::body::failure::Failure;
use asperity_solver::body::stiffness::Stiffness;
use asperity_solver::element::kernel::{entries, force, next_columns, stiffness_of_nodes, stress_of_node};
use asperity_solver::element::quad4;
use asperity_solver::point::j2::{Tangent, update};
use asperity_solver::point::kinematics::{ShapePoint, Symmetry, motion};
use asperity_solver::point::material::{Metal, PointState};

pub struct FullQuad<'m> {
    mesh: &'m Mesh,
    metal: Metal,
    dofs: Dofs,
    stiffness: Stiffness,
    factor: Factor,
    points: [ShapePoint<4>; 4],
    volume: Vec<f64>,
    position: Vec<[f64; 2]>,
    increment: Vec<[f64; 2]>,
    base: Vec<[f64; 2]>,
    old: Vec<PointState>,
    new: Vec<PointState>,
    /// Nodal forces at the iterate.
    pub internal: Vec<[f64; 2]>,
    residual: Vec<f64>,
    direction: Vec<f64>,
}

impl<'m> FullQuad<'m> {
    pub fn new(mesh: &'m Mesh, metal: Metal, held: &[[bool; 2]]) -> Self {
        let order: Vec<usize> = (0..mesh.nodes.len()).collect();
        let dofs = Dofs::new(mesh.nodes.len(), &order, |node| held[node]);
        let stiffness = Stiffness::new(&mesh.cells, 4, &dofs);
        let factor = Factor::new(&stiffness.matrix, Precision::Double);
        let points = quad4::points();
        let still = [[0.0; 2]; 4];
        let volume: Vec<f64> = (0..mesh.cell_count())
            .flat_map(|cell| {
                let x: [[f64; 2]; 4] = std::array::from_fn(|a| mesh.nodes[mesh.cell(cell)[a] as usize]);
                points.map(|p| motion(&p, &x, &still, Symmetry::Axisymmetric).unwrap().volume)
            })
            .collect();
        let (nodes, count) = (mesh.nodes.len(), dofs.count);
        FullQuad {
            mesh,
            dofs,
            stiffness,
            factor,
            points,
            position: mesh.nodes.clone(),
            increment: vec![[0.0; 2]; nodes],
            base: vec![[0.0; 2]; nodes],
            old: vec![metal.virgin(); volume.len()],
            new: vec![metal.virgin(); volume.len()],
            metal,
            volume,
            internal: vec![[0.0; 2]; nodes],
            residual: vec![0.0; count],
            direction: vec![0.0; count],
        }
    }

    pub fn begin(&mut self, guess: impl Fn(usize) -> [f64; 2]) {
        self.increment = (0..self.position.len()).map(guess).collect();
    }

    pub fn accept(&mut self) {
        for (x, du) in self.position.iter_mut().zip(&self.increment) {
            *x = [x[0] + du[0], x[1] + du[1]];
        }
        self.old.clone_from(&self.new);
    }

    fn add_cell(&mut self, cell: usize) -> Result<(), Failure> {
        let nodes = self.mesh.cell(cell);
        let du: [[f64; 2]; 4] = std::array::from_fn(|a| self.increment[nodes[a] as usize]);
        let x: [[f64; 2]; 4] = std::array::from_fn(|a| {
            let x = self.position[nodes[a] as usize];
            [x[0] + du[a][0], x[1] + du[a][1]]
        });
        let inverted = |cause| Failure::Element { cell, cause };
        for (q, point) in self.points.iter().enumerate() {
            let motion = motion(point, &x, &du, Symmetry::Axisymmetric).map_err(inverted)?;
            let index = 4 * cell + q;
            let end =
                update(&self.metal, &self.old[index], &motion.increment, Tangent::Exact).map_err(inverted)?;
            let (rows, volume) = (&motion.rows, self.volume[index]);
            let forces = force(rows, &end.stress, volume);
            for (a, &node) in nodes.iter().enumerate() {
                for i in 0..2 {
                    self.internal[node as usize][i] += forces[i][a];
                }
            }
            let mut triangle = [0.0; entries(4)];
            let mut rest = &mut triangle[..];
            for b in 0..4 {
                let stress = stress_of_node(&end.tangent, &rows[b], volume);
                let mut columns = next_columns(&mut rest, 4 - b);
                for a in b..4 {
                    columns.put(a - b, &stiffness_of_nodes(&rows[a], &stress));
                }
            }
            self.stiffness.add(cell, &triangle);
            self.new[index] = end.state;
        }
        Ok(())
    }
}

impl System for FullQuad<'_> {
    type Error = Failure;

    fn assess(&mut self, _: bool) -> Result<Assessment, Failure> {
        self.stiffness.clear();
        self.internal.fill([0.0; 2]);
        for cell in 0..self.mesh.cell_count() {
            self.add_cell(cell)?;
        }
        let mut scale = 0.0;
        for (f, numbers) in self.internal.iter().zip(&self.dofs.number) {
            for i in 0..2 {
                match self.residual.get_mut(numbers[i] as usize) {
                    Some(slot) => *slot = f[i],
                    None => scale += f[i] * f[i],
                }
            }
        }
        let residual = self.residual.iter().map(|r| r * r).sum::<f64>().sqrt();
        Ok(Assessment { residual, scale: scale.sqrt(), changed: false })
    }

    fn renew(&mut self) -> Result<(), Failure> {
        self.factor.cholesky(&self.stiffness.matrix).map_err(|_| Failure::Singular)
    }

    fn has_factors(&self) -> bool {
        false
    }

    fn factors_are_stale(&self) -> bool {
        false
    }

    fn forget(&mut self) {}

    fn find_direction(&mut self) {
        self.direction.copy_from_slice(&self.residual);
        self.factor.solve(&mut self.direction);
        self.base.clone_from(&self.increment);
    }

    fn slope(&self) -> f64 {
        -self.residual.iter().zip(&self.direction).map(|(r, d)| r * d).sum::<f64>()
    }

    fn advance(&mut self, fraction: f64) {
        for ((du, base), numbers) in self.increment.iter_mut().zip(&self.base).zip(&self.dofs.number) {
            for i in 0..2 {
                if numbers[i] != FIXED {
                    du[i] = base[i] - fraction * self.direction[numbers[i] as usize];
                }
            }
        }
    }
}
