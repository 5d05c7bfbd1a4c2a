//! Earlier loads of the body of a scene.

use super::{Loading, Tool};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Earlier loads of a body: it starts deformed and hardened, with its residual stress.
///
/// Asperities, material and substrate are those before the first load. Every earlier load is removed before the next.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Initial {
    /// The folder of an earlier result of `asperity crush`, relative to this scene file. Its body is that of this scene, which
    /// gives tool and loading alone; a resolved scene has `load` beside it.
    #[schemars(example = "out/first")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<PathBuf>,
    /// The loads that went before, in their order; absent: those of `from`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub load: Vec<EarlierLoad>,
}

/// One load that was removed again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EarlierLoad {
    /// Its tool; absent: a rigid plane.
    #[serde(default = "Tool::plane")]
    pub tool: Tool,
    /// Its goal, from first touch of the body as it was then. It was unloaded, whatever `unload` says.
    pub loading: Loading,
}
