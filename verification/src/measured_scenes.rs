//! Scenes drawn at random whose asperity or tool is a measured outline: a cone with a tip, a ball, or a power
//! of the radius as points, few or many, with or without scatter.

use crate::random_metal::{Drawn, Kind, log_between, material};
use proptest::prelude::*;
use std::fmt::Write;

/// Height of an outline at the share `x` of its half width, as a share of its height.
#[derive(Clone, Copy, Debug)]
enum Form {
    /// A cone whose tip is round up to this share of its half width.
    Cone(f64),
    /// A cap whose foot has this slope in degrees.
    Cap(f64),
    /// A power of the distance.
    Power(f64),
}

impl Form {
    fn height(self, x: f64) -> f64 {
        let drop = |x: f64| match self {
            Form::Cone(round) if x < round => 0.5 * x * x / round,
            Form::Cone(round) => x - 0.5 * round,
            Form::Cap(foot) => {
                let sine = f64::to_radians(foot).sin();
                1.0 - (1.0 - (sine * x).powi(2)).sqrt()
            }
            Form::Power(power) => x.powf(power),
        };
        1.0 - drop(x) / drop(1.0)
    }
}

fn form() -> impl Strategy<Value = Form> {
    prop_oneof![
        1 => Just(Form::Cone(0.0)),
        3 => (0.0..0.9).prop_map(Form::Cone),
        2 => (5.0..60.0).prop_map(Form::Cap),
        2 => (1.0..3.0).prop_map(Form::Power),
    ]
}

/// Points of a section, `[place, height]` lists of TOML, in um.
fn points(section: &[[f64; 2]]) -> String {
    let point = |p: &[f64; 2]| format!("[\"{} um\", \"{} um\"]", p[0], p[1]);
    format!("points = [{}]\n", section.iter().map(point).collect::<Vec<_>>().join(", "))
}

/// Errors between -1 and 1.
fn errors(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Use of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Asperity,
    Ridge,
    Tool,
}

/// A scene with a measured outline. One with scatter may be refused.
pub(crate) fn measured() -> impl Strategy<Value = Drawn> {
    let part = prop::sample::select(vec![Part::Asperity, Part::Ridge, Part::Tool]);
    let size = (log_between(0.1, 1000.0), prop_oneof![6 => log_between(1.0, 40.0), 1 => 0.1..1.0]);
    let detail =
        (prop_oneof![2usize..8, 20usize..300], prop_oneof![2 => Just(0.0), 1 => log_between(1e-5, 3e-3)]);
    let loading = (log_between(0.01, 0.9), any::<bool>());
    (part, form(), size, detail, loading, any::<u64>(), material()).prop_map(
        |(part, form, (height, slope), (count, scatter), (share, unload), seed, material)| {
            let width = height / f64::to_radians(slope).tan();
            let mut error = errors(seed);
            let mut at = |x: f64| [width * x, height * (form.height(x.abs()) + scatter * error())];
            let half: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
            let mut text = String::new();
            let symmetry = if part == Part::Ridge { "plane-strain" } else { "axisymmetric" };
            let _ = write!(text, "symmetry = \"{symmetry}\"\n{material}");
            let plane = "[tool]\nshape = \"plane\"\n";
            match part {
                Part::Asperity => {
                    let section: Vec<_> = half.iter().map(|x| at(*x)).collect();
                    let _ = write!(text, "[[asperity]]\n{}{plane}", points(&section));
                }
                Part::Ridge => {
                    let left = half[1..].iter().rev().map(|x| -x);
                    let section: Vec<_> = left.chain(half.iter().copied()).map(&mut at).collect();
                    let size = 40.0 * (width + height);
                    let substrate = format!("[substrate]\nradius = \"{size} um\"\ndepth = \"{size} um\"\n");
                    let _ = write!(text, "[[asperity]]\n{}{substrate}{plane}", points(&section));
                }
                Part::Tool => {
                    let rise = |[x, z]: [f64; 2]| [x, height - z];
                    let section: Vec<_> = half.iter().map(|x| rise(at(*x))).collect();
                    let _ = write!(text, "[tool]\nshape = \"profile\"\n{}", points(&section));
                }
            }
            // what scatter takes off the summit is no depth that can be reached
            let depth = share * height * (1.0 - 10.0 * scatter);
            let _ =
                write!(text, "[loading]\ndepth = \"{depth} um\"\nunload = {unload}\n[output]\nevery = 0\n");
            // with scatter a few points may not tell a summit between two feet, or a tool that is convex
            let kind = if scatter > 0.0 { Kind::CutOff } else { Kind::Sound };
            Drawn { text, kind }
        },
    )
}
