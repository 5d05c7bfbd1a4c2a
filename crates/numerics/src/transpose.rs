//! A matrix written row by row, turned into its columns.

use rayon::prelude::*;

/// Rows of `columns` numbers become columns.
///
/// ```
/// use asperity_numerics::transpose::transposed;
///
/// assert_eq!(transposed(&[1, 2, 3, 4, 5, 6], 3), [1, 4, 2, 5, 3, 6]);
/// ```
pub fn transposed<T: Copy + Send + Sync + Default>(data: &[T], columns: usize) -> Vec<T> {
    let rows = data.len() / columns;
    let mut out = vec![T::default(); data.len()];
    // strips of columns keep both sides in the cache
    out.par_chunks_mut(rows * 16).enumerate().for_each(|(strip, part)| {
        let first = strip * 16;
        for row in 0..rows {
            for (k, line) in part.chunks_mut(rows).enumerate() {
                line[row] = data[row * columns + first + k];
            }
        }
    });
    out
}
