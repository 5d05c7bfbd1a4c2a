//! Claims of the solver, one a file. One binary, so that the solver is linked once.

// in a test a panic is the message
#![allow(clippy::unwrap_used)]

mod balls_reach_their_radius;
mod confined_bar;
mod contact_patch;
mod curved_tool_on_an_asperity;
mod elastic_flattening;
mod elastic_indentation;
mod elastic_zones;
mod energy_balance;
mod extrapolated_flow_stops_where_the_point_stops;
mod failed_increment_leaves_no_trace;
mod fill_ordering_grows_like_dissection;
mod flattened_sphere;
mod friction;
mod full_quad;
mod hysteresis_of_reloads;
mod kinematic_hardening;
mod leaps_are_refused;
mod loaded_again;
mod lone_column;
mod lost_pivot;
mod meshing_anew;
mod newton_order;
mod newton_tolerance;
mod patch;
mod penalty_keeps_the_force;
mod plastic_unloading_stiffness;
mod plastic_work_of_a_turning_path;
mod pressure_along_the_contact;
mod punch;
mod reaches_half_height;
mod refinement;
mod ridges_that_press_each_other;
mod rotation;
mod same_bits;
mod scaled_units;
mod self_contact;
mod several_asperities;
mod simple_shear;
mod sound_cells;
mod steep_cone_unloads;
mod step_order;
mod system_tangent;
mod tabulated_hardening;
mod ten_reloads;
mod the_tool_advances_while_it_loads;
mod thick_walls;
mod tip_within_the_first_edge;
mod uniaxial_bar;
