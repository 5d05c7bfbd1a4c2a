//! The extension module under the Python package `asperity`: each function takes what Python gives, calls the function of the
//! library of the same name, and hands back its rows, numbers and fields. Nothing is computed here.

mod error;

mod table;

mod scene;

mod work;

mod calibrate;
mod crush;
mod extract;
mod identify;
mod joint;
mod press;
mod scales;
mod study;
mod trade;

use pyo3::prelude::*;

/// The extension module.
#[pymodule]
fn _asperity(module: &Bound<'_, PyModule>) -> PyResult<()> {
    error::add(module)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<scene::RoughScene>()?;
    module.add_class::<crush::Crush>()?;
    module.add_class::<press::Rough>()?;
    module.add_class::<joint::Joint>()?;
    module.add_class::<scales::Scales>()?;
    module.add_function(wrap_pyfunction!(crush::crush, module)?)?;
    module.add_function(wrap_pyfunction!(press::press, module)?)?;
    module.add_function(wrap_pyfunction!(joint::joint, module)?)?;
    module.add_function(wrap_pyfunction!(scales::scales, module)?)?;
    module.add_function(wrap_pyfunction!(calibrate::calibrate, module)?)?;
    module.add_function(wrap_pyfunction!(trade::trade, module)?)?;
    module.add_function(wrap_pyfunction!(identify::identify, module)?)?;
    module.add_function(wrap_pyfunction!(study::study, module)?)?;
    module.add_function(wrap_pyfunction!(extract::extract, module)?)?;
    Ok(())
}
