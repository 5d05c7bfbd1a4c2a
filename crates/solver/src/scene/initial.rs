//! Loads that the body of a scene bore before.

use super::{Loading, Scene, SceneError, Tool};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Earlier loads of a body: it starts deformed and hardened, with its residual stress.
///
/// Asperities, material and substrate are those before the first load. Every earlier load is taken off before the next.
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

/// One load that was taken off again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EarlierLoad {
    /// Its tool; absent: a rigid plane.
    #[serde(default = "Tool::plane")]
    pub tool: Tool,
    /// How far it went, from first touch of the body as it was then. It was unloaded, whatever `unload` says.
    pub loading: Loading,
}

impl Scene {
    /// The loads before that of the scene, in their order.
    pub fn earlier_loads(&self) -> &[EarlierLoad] {
        self.initial.as_ref().map_or(&[], |initial| &initial.load)
    }

    /// The scene of the earlier load `index`, which has those before it before it.
    pub(crate) fn at_load(&self, index: usize) -> Scene {
        let EarlierLoad { tool, loading } = self.earlier_loads()[index].clone();
        let initial = self.initial.as_ref().filter(|_| index > 0);
        Scene {
            tool,
            loading: loading.unloaded(),
            initial: initial.map(|initial| Initial { from: None, load: initial.load[..index].to_vec() }),
            ..self.clone()
        }
    }

    /// The scene whose body is loaded again, by this tool, after the load of this scene is taken off.
    #[must_use]
    pub fn loaded_again(mut self, tool: Tool, loading: Loading) -> Scene {
        let load = EarlierLoad {
            tool: std::mem::replace(&mut self.tool, tool),
            loading: std::mem::replace(&mut self.loading, loading),
        };
        self.initial.get_or_insert_default().load.push(load);
        self
    }

    /// Every earlier load must make sense of itself.
    pub(super) fn check_earlier_loads(&self) -> Result<(), SceneError> {
        if self.initial.is_some() && self.earlier_loads().is_empty() {
            return Err(SceneError {
                path: "initial".into(),
                message: "names no earlier load: give from = \"out/first\", the folder of an earlier result, or [[initial.load]]"
                    .into(),
            });
        }
        for index in 0..self.earlier_loads().len() {
            let scene = Scene { initial: None, ..self.at_load(index) };
            scene
                .check_load()
                .map_err(|e| SceneError { path: format!("initial.load[{index}].{}", e.path), ..e })?;
        }
        Ok(())
    }
}
