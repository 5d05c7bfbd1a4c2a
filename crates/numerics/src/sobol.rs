//! Sobol's sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2008, file
//! new-joe-kuo-6.21201), in the order of the Gray code (Antonov and Saleev 1979).

/// Bits of a coordinate.
const BITS: usize = 32;

/// Degree s, inner coefficients a, and first odd numbers m_1 to m_s of the primitive polynomial of each
/// dimension from the second.
const POLYNOMIALS: [(usize, u32, &[u32]); 20] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// Largest number of dimensions.
pub const MAX_DIMENSIONS: usize = POLYNOMIALS.len() + 1;

/// The sequence in so many dimensions.
#[derive(Clone, Debug)]
pub struct Sobol {
    /// Direction numbers of each dimension, the leading bit first.
    directions: Vec<[u32; BITS]>,
}

impl Sobol {
    /// `None` for more dimensions than there are numbers for.
    pub fn new(dimensions: usize) -> Option<Sobol> {
        (dimensions <= MAX_DIMENSIONS)
            .then(|| Sobol { directions: (0..dimensions).map(directions).collect() })
    }

    /// Coordinate of point `i` along `dimension`, from 0 to below 1.
    pub fn coordinate(&self, dimension: usize, i: usize) -> f64 {
        let gray = i ^ (i >> 1);
        let directions = &self.directions[dimension];
        let bits = (0..BITS).filter(|bit| gray >> bit & 1 == 1).fold(0, |x, bit| x ^ directions[bit]);
        f64::from(bits) / 2f64.powi(BITS as i32)
    }
}

fn directions(dimension: usize) -> [u32; BITS] {
    let mut v = std::array::from_fn(|k| 1_u32 << (BITS - 1 - k));
    // the first dimension is van der Corput's sequence
    let Some((s, a, m)) = dimension.checked_sub(1).map(|d| POLYNOMIALS[d]) else { return v };
    for k in 0..BITS {
        v[k] = if k < s {
            m[k] << (BITS - 1 - k)
        } else {
            let taps = (1..s).filter(|j| a >> (s - 1 - j) & 1 == 1);
            taps.fold(v[k - s] ^ (v[k - s] >> s), |x, j| x ^ v[k - j])
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points that scipy 1.17.1 gives, `qmc.Sobol(21, scramble=False)`: the first four, of some
    /// dimensions.
    #[test]
    fn the_first_points_are_those_of_the_published_numbers() {
        let sobol = Sobol::new(MAX_DIMENSIONS).unwrap();
        let point = |i: usize| [0, 1, 2, 3, 6, 20].map(|d| sobol.coordinate(d, i));
        assert_eq!(point(0), [0.0; 6]);
        assert_eq!(point(1), [0.5; 6]);
        assert_eq!(point(2), SCIPY[0]);
        assert_eq!(point(3), SCIPY[1]);
        assert_eq!([0, 5, 20].map(|d| sobol.coordinate(d, 1000)), SCIPY_1000);
    }

    const SCIPY: [[f64; 6]; 2] = [[0.75, 0.25, 0.25, 0.25, 0.25, 0.25], [0.25, 0.75, 0.75, 0.75, 0.75, 0.75]];
    const SCIPY_1000: [f64; 3] = [0.2197265625, 0.9072265625, 0.5224609375];

    /// Of 2^m points one lies in each of 2^m equal parts of every dimension.
    #[test]
    fn every_part_of_every_dimension_holds_one_point() {
        let sobol = Sobol::new(MAX_DIMENSIONS).unwrap();
        for dimension in 0..MAX_DIMENSIONS {
            let mut parts: Vec<usize> =
                (0..256).map(|i| (sobol.coordinate(dimension, i) * 256.0) as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..256).collect::<Vec<_>>(), "{dimension}");
        }
        assert!(Sobol::new(MAX_DIMENSIONS + 1).is_none());
    }
}
