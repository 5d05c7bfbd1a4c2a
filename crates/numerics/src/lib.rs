//! Numerical methods that name no mechanical word: lanes of numbers side by side, least squares, roots,
//! Sobol's sequence, Newton's method with its secants, and a sparse LDLᵀ factorisation.
//!
//! ```
//! use asperity_numerics::bisection::bisect;
//!
//! // √2 is where x² - 2 turns from negative to positive
//! let [low, high] = bisect([0.0, 2.0], 60, |x| x * x < 2.0);
//! assert!(low <= std::f64::consts::SQRT_2 && std::f64::consts::SQRT_2 <= high);
//! ```

pub mod lanes;

pub mod bisection;
pub mod least_squares;
pub mod sobol;

pub mod transpose;
pub mod vectors;

pub mod secants;

pub mod newton;

pub mod sparse;
