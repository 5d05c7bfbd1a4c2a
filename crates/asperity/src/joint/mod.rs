//! The law of a joint: a surface pressed from first touch to its largest load and back, as tables that other
//! programs read, each number with its error.

mod press_joint;

mod summary;
mod table;

mod formats;

mod joint_report;

pub use press_joint::{Joint, joint};
pub use summary::{ExponentialFit, LawRow, PowerFit, Summary};
pub use table::JointRow;
