//! Numbers that the paper prints, and the parts that answer to them.

/// Sets of Fig. 6 in order of slope.
pub const SETS: [&str; 3] = ["slopes-1-4", "slopes-5-8", "slopes-9-12"];
/// Ends of the names of parts and the symmetry in words.
pub const SYMMETRIES: [(&str, &str); 2] = [("", "axisymmetric"), ("-plane-strain", "plane strain")];
/// The rough parts, in the order of Table 1.
pub const ROUGH: [&str; 3] = ["rough-ground", "rough-milled", "rough-sanded"];
/// Largest over nominal pressure of each row of Table 1 by the text, least and most.
pub const PEAKS: [[f64; 2]; 3] = [[7.5, 8.5], [60.0, 80.0], [60.0, 80.0]];
/// Table 2 as printed: residual displacement (µm) and elastic energy (%), for ground, milled, sanded.
pub const TABLE2: [[f64; 2]; 3] = [[1.63, 7.0], [5.7, 15.0], [17.91, 31.0]];
/// The row of three identical asperities on three meshes, from the coarsest to the finest.
pub const IDENTICAL: [&str; 3] = ["three-identical", "three-identical-finer", "three-identical-finest"];
