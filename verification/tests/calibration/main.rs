//! Claims of the calibration, one file each.

mod elastic_cone;
mod law_recovered;
mod other_lengths;
mod peers;
mod steep_indentation;
