//! Scenes of what was taken from a map, as commented TOML.

use super::bodies::{Body, Line};
use crate::results::numbers::digits;
use crate::results::units::{GIGAPASCAL, MEGAPASCAL, MICROMETRE};
use asperity_roughness::Material;
use asperity_roughness::asperities::Direction;
use asperity_simulation::scene::Accuracy;
use std::fmt::Write;

/// Width of the half of a line's block over its length: free metal beside the measured line.
const WIDTH_BESIDE: f64 = 1.0;
/// Depth of that block over its width.
const DEPTH: f64 = 1.0;

fn um(metres: f64) -> String {
    format!("\"{} um\"", digits(metres / MICROMETRE))
}

/// The table of the metal that is crushed: that of the rough scene; of a hardness alone a third of it,
/// without hardening.
fn material(material: &Material) -> String {
    let mut text = format!(
        "[material]\nyoungs_modulus = \"{} GPa\"\npoissons_ratio = {}\n",
        digits(material.youngs_modulus.0 / GIGAPASCAL),
        material.poissons_ratio
    );
    let Some(limit) = material.limit() else { return text };
    let (stress, remark) = match material.yield_stress {
        Some(stress) => (stress.0, ""),
        None => (limit / 3.0, "            # a third of the hardness (eq. [20])"),
    };
    let _ = writeln!(text, "yield_stress = \"{} MPa\"{remark}", digits(stress / MEGAPASCAL));
    let _ = writeln!(text, "hardening_exponent = {}", material.hardening_exponent.unwrap_or(0.0));
    if let Some(law) = material.hardening_law {
        let _ = writeln!(text, "hardening_law = \"{}\"", law.name());
    }
    text
}

/// The name of the files of asperity `number`, without their ending.
pub(super) fn stem(number: usize) -> String {
    format!("{number:03}")
}

/// The scene of a body of revolution, whose profile lies in ../profiles.
pub(super) fn of_body(body: &Body, surface: &str, accuracy: Accuracy, metal: &Material) -> String {
    let [x, y] = body.asperity.position.map(|x| digits(x / MICROMETRE));
    format!(
        "# Asperity {} of {surface}: summit {x} um along x, {y} um along y, {} um above the mean plane;\n\
         # the mean height around it as a body of revolution.\n\
         symmetry = \"axisymmetric\"\n\
         accuracy = \"{accuracy}\"\n\
         {}\
         [[asperity]]\n\
         profile = \"../profiles/{}.csv\"\n\
         [tool]\n\
         shape = \"plane\"\n\
         [loading]\n\
         depth = {}\n\
         unload = true\n",
        body.number,
        digits(body.asperity.height / MICROMETRE),
        material(metal),
        stem(body.number),
        um(body.depth),
    )
}

/// The scene of a line, whose profile lies in ../profiles.
pub(super) fn of_line(line: &Line, surface: &str, accuracy: Accuracy, metal: &Material) -> String {
    let across = if line.direction == Direction::X { "y" } else { "x" };
    format!(
        "# A line of {surface} at {across} = {} um as the free surface of a body of constant section.\n\
         symmetry = \"plane-strain\"\n\
         accuracy = \"{accuracy}\"\n\
         {}\
         [[profile]]\n\
         file = \"../profiles/{}.csv\"\n\
         [substrate]\n\
         radius = {}\n\
         depth = {}\n\
         [tool]\n\
         shape = \"plane\"\n\
         [loading]\n\
         depth = {}                     # of the highest point\n",
        digits(line.at / MICROMETRE),
        material(metal),
        line.name,
        um(WIDTH_BESIDE * line.length()),
        um(DEPTH * line.length()),
        um(line.depth),
    )
}
