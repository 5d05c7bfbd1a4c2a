//! The price of accuracy on a scene: error against core seconds, knob by knob.

pub mod settings;

pub mod case;

mod converged;
mod pareto_front;
mod row;

mod overview;
mod picture;

mod run_settings;

pub use crate::trade::run_settings::{Options, Runner, Trade, trade};
pub use row::TradeRow;

/// The scene of a trade that names none: the asperity of the paper.
pub const DEFAULT_SCENE: &str = crate::scenes::SINGLE_ASPERITY;
