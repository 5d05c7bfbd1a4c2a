//! Sparse factorisation by faer: the symbolic analysis once per mesh, numbers in place, nothing allocated per solve.
//! This is the only file that names faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky, simplicial,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use sprs::CsMat;

/// Why a matrix could not be factorised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FactorError {
    /// A pivot of the Cholesky factorisation is not positive: the matrix is indefinite.
    #[error("the stiffness matrix is not positive definite")]
    NotPositive,
    /// The matrix is singular or not finite, or memory ran out.
    #[error("the stiffness matrix is singular or not finite")]
    Singular,
}

/// Floating-point operations of one solution of a sparse symmetric system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operations {
    /// Of the factorisation.
    pub factor: f64,
    /// Of a solve with the factors.
    pub solve: f64,
}

/// Symbolic analysis, factor values and work space of one pattern.
pub struct Factor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
    definite: bool,
}

/// sprs's arrays as faer sees them. `columns` is `matrix.proper_indptr()`, which borrows: the matrix is whole.
fn pattern_of<'a>(matrix: &'a CsMat<f64>, columns: &'a [usize]) -> SymbolicSparseColMatRef<'a, usize> {
    SymbolicSparseColMatRef::new_checked(matrix.rows(), matrix.cols(), columns, None, matrix.indices())
}

/// For each vertex of a graph (compressed columns without the diagonal) its place in an order of approximate minimum degree.
///
/// # Errors
/// More edges than can be counted.
pub fn minimum_degree(starts: &[usize], neighbours: &[usize]) -> Result<Vec<usize>, FactorError> {
    let size = starts.len() - 1;
    let (mut order, mut place) = (vec![0; size], vec![0; size]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(size, neighbours.len()));
    let pattern = SymbolicSparseColMatRef::new_checked(size, size, starts, None, neighbours);
    amd::order(&mut order, &mut place, pattern, amd::Control::default(), MemStack::new(&mut memory))
        .map_err(|_| FactorError::Singular)?;
    Ok(place)
}

/// Entries of each column of the Cholesky factor of a graph (compressed columns without the diagonal).
pub fn column_counts(starts: &[usize], neighbours: &[usize]) -> Vec<usize> {
    let size = starts.len() - 1;
    let (mut tree, mut counts) = (vec![0_isize; size], vec![0_usize; size]);
    let request = simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(size, neighbours.len());
    let mut memory = MemBuffer::new(request);
    let pattern = SymbolicSparseColMatRef::new_checked(size, size, starts, None, neighbours);
    simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, MemStack::new(&mut memory));
    counts
}

impl Factor {
    /// Analyses the lower triangle `matrix`, whose rows stand in the order in which they are to be eliminated.
    pub fn new(matrix: &CsMat<f64>) -> Result<Factor, FactorError> {
        // with the order it is given faer's analysis wants the upper triangle, the factorisation the lower
        let upper = matrix.transpose_view().to_csc();
        let columns = upper.proper_indptr();
        let pattern = pattern_of(&upper, &columns);
        let params = CholeskySymbolicParams {
            // measured: the automatic choice takes the simplicial path at 5,000 unknowns and is three times slower
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Upper, SymmetricOrdering::Identity, params)
            .map_err(|_| FactorError::Singular)?;
        let work = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default()))
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let values = vec![0.0; symbolic.len_val()];
        Ok(Factor { symbolic, values, memory: MemBuffer::new(work), definite: true })
    }

    /// Cholesky factorisation of a matrix with the analysed pattern.
    pub fn cholesky(&mut self, matrix: &CsMat<f64>) -> Result<(), FactorError> {
        let columns = matrix.proper_indptr();
        let pattern = pattern_of(matrix, &columns);
        let view = SparseColMatRef::new(pattern, matrix.data());
        self.definite = true;
        self.symbolic
            .factorize_numeric_llt(
                &mut self.values,
                view,
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .map(|_| ())
            .map_err(|_| FactorError::NotPositive)
    }

    /// LDLᵀ factorisation without pivoting; returns the number of negative pivots.
    pub fn ldlt(&mut self, matrix: &CsMat<f64>) -> Result<usize, FactorError> {
        let columns = matrix.proper_indptr();
        let pattern = pattern_of(matrix, &columns);
        let view = SparseColMatRef::new(pattern, matrix.data());
        self.definite = false;
        self.symbolic
            .factorize_numeric_ldlt(
                &mut self.values,
                view,
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .map_err(|_| FactorError::Singular)?;
        Ok(self.negative_pivots())
    }

    /// Negative entries of D.
    fn negative_pivots(&self) -> usize {
        let mut count = 0;
        self.each_column(|pivot, _| count += usize::from(pivot < 0.0));
        count
    }

    /// Operations of a factorisation and a solve: a column with n entries below its diagonal takes n(n + 1) products and sums
    /// of its outer product and n divisions; a solve passes twice over every entry.
    pub fn operations(&self) -> Operations {
        let mut sum = Operations { factor: 0.0, solve: 0.0 };
        self.each_column(|_, below| {
            let n = below as f64;
            sum.factor += n * (n + 2.0);
            sum.solve += 4.0 * (n + 1.0);
        });
        sum
    }

    /// Tells `visit` the diagonal entry of each column of the factor and the entries below it.
    fn each_column(&self, mut visit: impl FnMut(f64, usize)) {
        use faer::sparse::linalg::cholesky::{SymbolicCholeskyRaw, supernodal::SupernodalLdltRef};
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                let factor = SupernodalLdltRef::<'_, usize, f64>::new(symbolic, &self.values);
                for s in 0..symbolic.n_supernodes() {
                    let block = factor.supernode(s).val();
                    (0..block.ncols()).for_each(|j| visit(block[(j, j)], block.nrows() - 1 - j));
                }
            }
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                // the diagonal is the first entry of each column
                symbolic
                    .col_ptr()
                    .windows(2)
                    .for_each(|ends| visit(self.values[ends[0]], ends[1] - ends[0] - 1));
            }
        }
    }

    /// Solves in place with the last factorisation.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let rows = rhs.len();
        let rhs = MatMut::from_column_major_slice_mut(rhs, rows, 1);
        let stack = MemStack::new(&mut self.memory);
        if self.definite {
            LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
                Conj::No,
                rhs,
                Par::Seq,
                stack,
            );
        } else {
            LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
                Conj::No,
                rhs,
                Par::Seq,
                stack,
            );
        }
    }
}
