//! Any scene over any of its keys: grids, lists and drawn points, a row a run, killed and resumed, in parts
//! and joined.

mod vary;

mod points;

mod row;

mod subject;

mod plan;

mod picture;

mod run_study;

pub use crate::batch::{Options, Shard};
pub use crate::study::run_study::{Study, merge, study};
pub use plan::{Plan, SampleKind, SampleTable, StudyFile};
pub use points::Sample;
pub use row::{Columns, Run};
pub use subject::Subject;
pub use vary::{Range, Values, Vary};
