//! Factorisation of the sparse stiffness, front by front: the symbolic analysis once per mesh, numbers in
//! place, nothing allocated per factorisation or solve.

use crate::sparse::factor_numbers::FactorNumbers;
use crate::sparse::failure::FactorError;
use crate::sparse::front::Pivots;
use crate::sparse::front_tree::FrontTree;
use pulp::Arch;
use sprs::CsMat;
use std::sync::Arc;

/// Floating-point operations of one solution of a sparse symmetric system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operations {
    /// Of the factorisation.
    pub factor: f64,
    /// Of a solve with the factors.
    pub solve: f64,
}

/// Digits of the factors. Single precision halves memory and time of a factorisation, and iterations whose
/// residuals are double take as many as with double factors, unless the matrix is nearly singular to its
/// digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Of 32 bits.
    Single,
    /// Of 64 bits.
    Double,
}

/// The factors.
enum Numbers {
    Single(FactorNumbers<f32>),
    Double(FactorNumbers<f64>),
}

impl Numbers {
    fn new(tree: &FrontTree, precision: Precision) -> Numbers {
        match precision {
            Precision::Single => Numbers::Single(FactorNumbers::new(tree)),
            Precision::Double => Numbers::Double(FactorNumbers::new(tree)),
        }
    }
}

/// Symbolic analysis, factor values and work space of one pattern.
pub struct Factor {
    arch: Arch,
    tree: Arc<FrontTree>,
    numbers: Numbers,
}

impl Factor {
    /// From now on without the vector registers of the processor, as a test on any processor.
    #[doc(hidden)]
    pub fn without_vector_registers(&mut self) {
        self.arch = Arch::Scalar;
    }

    /// Analyses the lower triangle `matrix`, whose unknowns stand in an order of little fill.
    pub fn new(matrix: &CsMat<f64>, precision: Precision) -> Factor {
        Factor::with_tree(Arc::new(FrontTree::new(matrix)), precision)
    }

    /// Of the pattern that was analysed.
    pub fn with_tree(tree: Arc<FrontTree>, precision: Precision) -> Factor {
        Factor { arch: Arch::new(), numbers: Numbers::new(&tree, precision), tree }
    }

    /// The digits of its numbers.
    pub fn precision(&self) -> Precision {
        match self.numbers {
            Numbers::Single(_) => Precision::Single,
            Numbers::Double(_) => Precision::Double,
        }
    }

    /// Of this precision from now on; it has no factors then.
    pub fn set_precision(&mut self, precision: Precision) {
        self.numbers = Numbers::new(&self.tree, precision);
    }

    /// L D Lᵀ of a matrix with the analysed pattern, all pivots positive.
    ///
    /// # Errors
    /// A pivot that is not positive.
    pub fn cholesky(&mut self, matrix: &CsMat<f64>) -> Result<(), FactorError> {
        self.factorise(matrix.data(), Pivots::Positive).map(|_| ()).ok_or(FactorError::NotPositive)
    }

    /// L D Lᵀ without pivoting; returns the number of negative pivots.
    ///
    /// # Errors
    /// A pivot of zero, or one that is not finite.
    pub fn ldlt(&mut self, matrix: &CsMat<f64>) -> Result<usize, FactorError> {
        self.factorise(matrix.data(), Pivots::Any).ok_or(FactorError::Singular)
    }

    /// Operations of a factorisation and a solve: a column with n entries below its diagonal takes n(n + 1)
    /// products and sums of its outer product and n divisions; a solve passes twice over every entry. Zeros
    /// that merged fronts hold are counted.
    pub fn operations(&self) -> Operations {
        let mut sum = Operations { factor: 0.0, solve: 0.0 };
        for front in &self.tree.fronts {
            for j in 0..front.size.pivots {
                let n = (front.size.pivots - 1 - j + front.size.below) as f64;
                sum.factor += n * (n + 2.0);
                sum.solve += 4.0 * (n + 1.0);
            }
        }
        sum
    }

    /// Solves in place with the last factorisation of `matrix`, its lower triangle, to the digits of double
    /// precision: corrections for double residuals, until they no longer fall by half.
    pub fn solve_refined(&mut self, matrix: &CsMat<f64>, rhs: &mut [f64]) {
        let wanted = rhs.to_vec();
        let mut size = f64::INFINITY;
        rhs.fill(0.0);
        loop {
            let mut correction = residual(matrix, rhs, &wanted);
            let now = correction.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
            // false of NaN, too
            let falls = now > 0.0 && now < 0.5 * size;
            if !falls {
                return;
            }
            size = now;
            self.solve(&mut correction);
            rhs.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
        }
    }

    /// Solves in place with the last factorisation, to the digits of its [`Precision`].
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let Factor { arch, tree, numbers } = self;
        match numbers {
            Numbers::Single(numbers) => numbers.solve(*arch, tree, rhs),
            Numbers::Double(numbers) => numbers.solve(*arch, tree, rhs),
        }
    }

    /// Factorises; returns the number of negative pivots, nothing where a pivot is not accepted.
    fn factorise(&mut self, matrix: &[f64], pivots: Pivots) -> Option<usize> {
        let Factor { arch, tree, numbers } = self;
        match numbers {
            Numbers::Single(numbers) => numbers.factorise(*arch, tree, matrix, pivots),
            Numbers::Double(numbers) => numbers.factorise(*arch, tree, matrix, pivots),
        }
    }
}

/// b − K x of a symmetric matrix whose lower triangle is `lower`.
fn residual(lower: &CsMat<f64>, x: &[f64], b: &[f64]) -> Vec<f64> {
    let mut residual = b.to_vec();
    for (column, entries) in lower.outer_iterator().enumerate() {
        for (row, &entry) in entries.iter() {
            residual[row] -= entry * x[column];
            if row != column {
                residual[column] -= entry * x[row];
            }
        }
    }
    residual
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::fill_ordering::elimination_order;
    use crate::sparse::large_front::is_large;
    use std::collections::BTreeSet;

    /// The lower triangle of the matrix that couples the two unknowns of all nodes of a cell, its nodes in
    /// `order`: all zero.
    fn coupled(cells: &[[u32; 4]], order: &[usize]) -> CsMat<f64> {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, &node)| place[node] = k);
        let mut rows = vec![BTreeSet::new(); 2 * order.len()];
        for cell in cells {
            let unknowns: Vec<usize> =
                cell.iter().flat_map(|&node| [0, 1].map(|c| 2 * place[node as usize] + c)).collect();
            for &column in &unknowns {
                rows[column].extend(unknowns.iter().filter(|&&row| row >= column));
            }
        }
        let mut starts = vec![0];
        rows.iter().for_each(|column| starts.push(starts[starts.len() - 1] + column.len()));
        let rows: Vec<usize> = rows.into_iter().flatten().collect();
        let zeros = vec![0.0; rows.len()];
        CsMat::new_csc((2 * order.len(), 2 * order.len()), starts, rows, zeros)
    }

    /// A grid of square elements with two unknowns a node, in an order of little fill: its lower triangle, in
    /// which every entry off the diagonal is some number between -1 and 1, and the diagonal is `excess`
    /// larger than the sum of their sizes in its row.
    fn grid(side: usize, excess: f64) -> CsMat<f64> {
        let node = |i: usize, j: usize| (j * (side + 1) + i) as u32;
        let cells: Vec<[u32; 4]> = (0..side * side)
            .map(|cell| (cell % side, cell / side))
            .map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)])
            .collect();
        let nodes = (side + 1) * (side + 1);
        let order = elimination_order(cells.as_flattened(), 4, &vec![true; nodes]).unwrap();
        let mut matrix = coupled(&cells, &order);
        let mut sums = vec![0.0_f64; matrix.cols()];
        let mut random = 1_u64;
        for (column, mut entries) in matrix.outer_iterator_mut().enumerate() {
            for (row, entry) in entries.iter_mut().filter(|(row, _)| *row != column) {
                random =
                    random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                *entry = (random >> 11) as f64 / 2f64.powi(52) - 1.0;
                sums[row] += entry.abs();
                sums[column] += entry.abs();
            }
        }
        for (column, mut entries) in matrix.outer_iterator_mut().enumerate() {
            entries
                .iter_mut()
                .filter(|(row, _)| *row == column)
                .for_each(|(_, e)| *e = sums[column] + excess);
        }
        matrix
    }

    /// Largest entry of K x − b over that of b.
    fn relative_residual(lower: &CsMat<f64>, x: &[f64], b: &[f64]) -> f64 {
        let largest = |v: &[f64]| v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        largest(&residual(lower, x, b)) / largest(b)
    }

    fn right_hand_side(size: usize) -> Vec<f64> {
        (0..size).map(|i| (i * 7919 % 1000) as f64 - 499.5).collect()
    }

    /// One front to several thousand, with branches and with fronts that are eliminated in large blocks.
    #[test]
    fn the_solution_satisfies_the_equations_at_every_size() {
        for side in [1, 2, 3, 7, 20, 45, 160] {
            let matrix = grid(side, 1.0);
            let b = right_hand_side(matrix.cols());
            // rounding of a diagonally dominant matrix of condition below 100
            for (precision, rounding) in [(Precision::Single, 1e-5), (Precision::Double, 1e-13)] {
                let mut factor = Factor::new(&matrix, precision);
                factor.cholesky(&matrix).unwrap();
                let mut x = b.clone();
                factor.solve(&mut x);
                assert!(relative_residual(&matrix, &x, &b) < rounding, "side {side}, {precision:?}");
                x.copy_from_slice(&b);
                factor.solve_refined(&matrix, &mut x);
                assert!(relative_residual(&matrix, &x, &b) < 1e-14, "side {side}, {precision:?}");
            }
        }
        let tree = FrontTree::new(&grid(160, 1.0));
        assert!(tree.parts.len() > 2, "no branches");
        assert!(tree.fronts.iter().any(|front| is_large(front.size)), "no large front");
    }

    #[test]
    fn every_number_of_threads_gives_the_same_bits() {
        let matrix = grid(160, 1.0);
        let solution = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut factor = Factor::new(&matrix, Precision::Single);
                factor.cholesky(&matrix).unwrap();
                let mut x = right_hand_side(matrix.cols());
                factor.solve(&mut x);
                x
            })
        };
        assert!(solution(1) == solution(3));
    }

    /// A diagonal shifted through eigenvalues: the number of negative pivots is that of negative eigenvalues
    /// (Sylvester).
    #[test]
    fn negative_pivots_are_counted_and_refused_by_cholesky() {
        let matrix = grid(6, -8.0);
        let mut factor = Factor::new(&matrix, Precision::Single);
        let dense = nalgebra::DMatrix::from_fn(matrix.rows(), matrix.cols(), |i, j| {
            matrix.get(i.max(j), i.min(j)).copied().unwrap_or(0.0)
        });
        let negative = dense.symmetric_eigenvalues().iter().filter(|&&value| value < 0.0).count();
        assert!(negative > 0, "the shift is too small");
        assert_eq!(factor.ldlt(&matrix), Ok(negative));
        assert_eq!(factor.cholesky(&matrix), Err(FactorError::NotPositive));
        let b = right_hand_side(matrix.cols());
        let mut x = b.clone();
        factor.ldlt(&matrix).unwrap();
        factor.solve_refined(&matrix, &mut x);
        assert!(relative_residual(&matrix, &x, &b) < 1e-12);
    }

    #[test]
    fn a_matrix_that_is_not_finite_is_refused() {
        let mut matrix = grid(5, 1.0);
        let mut factor = Factor::new(&matrix, Precision::Single);
        matrix.data_mut()[17] = f64::NAN;
        assert_eq!(factor.cholesky(&matrix), Err(FactorError::NotPositive));
        assert_eq!(factor.ldlt(&matrix), Err(FactorError::Singular));
    }
}
