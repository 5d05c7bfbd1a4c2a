//! The scene of each earlier load of a body.

use super::{EarlierLoad, Initial, Loading, Scene, SceneError, Tool};

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

    /// The scene whose body is loaded again, by this tool, after the load of this scene is removed.
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
