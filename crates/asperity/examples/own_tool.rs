//! An own tool: a paraboloid pressed into an elastic half-space, beside Hertz's F = (4/3) E* √R h^(3/2).

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity::tables::{Accuracy, Loading, Material, Scene as Tables, Symmetry, Tool};
use asperity::{Error, Length, Penetration, Scene, Stress, ToolOutline, crush};
use std::sync::Arc;

/// z = r²/2R, m.
#[derive(Debug)]
struct Paraboloid {
    radius: f64,
}

impl ToolOutline for Paraboloid {
    fn name(&self) -> &str {
        "paraboloid"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![("radius_m", self.radius)]
    }

    // along z, which on a tool as flat as this is the distance
    fn penetration(&self, [r, z]: [f64; 2]) -> Penetration {
        Penetration {
            depth: z - r * r / (2.0 * self.radius),
            slope: [-r / self.radius, 1.0],
            curvature: [-1.0 / self.radius, 0.0, 0.0],
        }
    }
}

fn main() -> Result<(), Error> {
    let (radius, depth) = (100e-6, 0.1e-6);
    let material = Material::elastic_body(Stress(210e9), 0.3);
    let tool = Tool::custom(Arc::new(Paraboloid { radius }));
    let tables = Tables::new(Symmetry::Axisymmetric, material, tool, Loading::to_depth(Length(depth)))
        .with_accuracy(Accuracy::Draft);
    let summary = crush(&Scene::new(&tables)?, &mut |_| true)?.summary;
    let hertz = 4.0 / 3.0 * 210e9 / 0.91 * radius.sqrt() * depth.powf(1.5);
    println!("{:.4e} N, {:.4} of Hertz's", summary.peak_force, summary.peak_force / hertz);
    Ok(())
}
