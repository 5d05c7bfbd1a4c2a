//! An own closure: islands that carry the hardness wherever they touch, and a generated surface pressed by
//! it.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::{Error, IslandClosure, Regime, Response, RoughScene, press};
use std::path::Path;
use std::sync::Arc;

/// Rigid and perfectly plastic: p = H on the whole island, whatever its slope.
#[derive(Debug)]
struct Plastic {
    hardness: f64,
}

impl IslandClosure for Plastic {
    fn name(&self) -> &str {
        "plastic"
    }

    fn source(&self) -> &str {
        "p = H on the island (Bowden and Tabor 1939)"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![("hardness_Pa", self.hardness)]
    }

    fn respond(&self, _tan_beta: f64) -> Response {
        Response { island_pressure: self.hardness, area_ratio: 1.0, regime: Regime::Plastic, inside: true }
    }

    fn elastic_pressure(&self, tan_beta: f64) -> f64 {
        0.5 * 210e9 / 0.91 * tan_beta
    }
}

fn main() -> Result<(), Error> {
    let scene = RoughScene::from_toml(asperity::scenes::ROUGH_MILLED, Path::new(""))?
        .with_closure(Arc::new(Plastic { hardness: 1280e6 }))
        .with(&["load.pressure=100 MPa".into()])?;
    let rough = press(&scene, &mut |_| true)?;
    println!("contact area {:.4} of the nominal one", rough.table[0].contact_area_ratio);
    Ok(())
}
