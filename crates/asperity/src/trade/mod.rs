//! The price of accuracy on a scene: error against core seconds, knob by knob.

pub mod settings;

pub mod case;

mod converged;
mod pareto_front;
mod row;

mod overview;
mod picture;

mod run;

pub use row::TradeRow;
pub use run::{Options, Progress, Runner, Trade, trade};

/// The scene of a trade that names none: the asperity of the paper.
pub const DEFAULT_SCENE: &str = include_str!("../../scenes/single-asperity.toml");
