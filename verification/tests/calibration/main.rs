//! Claims of the calibration, one file each.

mod atlas;
mod calculix_cones;
mod coefficient_recovered;
mod elastic_cone;
mod independent_of_other_lengths;
mod perfectly_plastic_cone;
mod steep_indentation;
