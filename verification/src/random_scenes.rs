//! Scenes drawn at random, sound and unsound, and what a run of the program made of each.
//!
//! A sound scene must be done (exit status 0) or say where and why it stopped (1); an unsound one must be
//! refused with nothing written (2); a scene cut off in the middle may be either. Nothing may panic, hang, or
//! write a number that is none.

pub use crate::random_metal::{Drawn, Kind};

use crate::coverage_scenes::Case;
use crate::measured_scenes::measured;
use crate::random_metal::{log_between, material};
use asperity_simulation::scene::Accuracy;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::error::Error;
use std::fmt::Write;
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};
use std::str::FromStr;
use std::time::{Duration, Instant};

/// A run that reached its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Done {
    /// Energy balance of the summary.
    pub energy_balance: f64,
    /// True where the run states no more than its accuracy promises; `None` where it cannot make itself
    /// finer, because the scene gives its numbers.
    pub promise_kept: Option<bool>,
}

/// The end of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// Exit status 0.
    Done(Done),
    /// Exit status 1, with the reason.
    Stopped(String),
    /// Exit status 2.
    Refused,
    /// An end that must not be, with a description.
    Fault(String),
}

/// The parts of a scene that make its body.
#[derive(Clone, Debug)]
struct Body {
    symmetry: &'static str,
    asperities: String,
    substrate: String,
    /// Of the asperities, in the unit that they are written in.
    height: f64,
}

/// One to three asperities of one kind, lengths in `unit`.
fn body(unit: &'static str) -> impl Strategy<Value = Body> {
    let slope = prop_oneof![6 => log_between(1.0, 45.0), 1 => 0.1..1.0, 1 => 45.0..75.0];
    let count = prop_oneof![5 => Just(1usize), 2 => 2usize..4];
    (log_between(0.1, 1000.0), slope, 0.0..0.9, count, any::<bool>(), 0.0..2.0, 0..5, 0..5).prop_map(
        move |(height, slope, roundness, count, ridges, spacing, kind, sharp)| {
            let cap = 1.0 - f64::to_radians(slope).cos();
            let mut one = "[[asperity]]\n".to_string();
            if kind == 0 {
                let _ = writeln!(one, "radius = \"{} {unit}\"", 4.0 * height);
            } else {
                let _ = writeln!(one, "height = \"{height} {unit}\"\nslope_deg = {slope}");
                if sharp > 0 {
                    let _ = writeln!(one, "tip_radius = \"{} {unit}\"", roundness * height / cap);
                }
            }
            if spacing > 1.0 && count > 1 {
                let _ = writeln!(one, "spacing = \"{} {unit}\"", (spacing - 1.0) * height);
            }
            // a round tip widens the foot by its share of the height; the foot of a cap is 2.6 heights wide
            let foot = f64::max(3.0 * height, height * (1.0 + roundness) / f64::to_radians(slope).tan());
            let size = 40.0 * count as f64 * (foot + height);
            let substrate = format!("[substrate]\nradius = \"{size} {unit}\"\ndepth = \"{size} {unit}\"\n");
            Body {
                symmetry: if ridges { "plane-strain" } else { "axisymmetric" },
                asperities: one.repeat(count),
                substrate: if ridges { substrate } else { String::new() },
                height,
            }
        },
    )
}

fn sound() -> impl Strategy<Value = String> {
    let unit = prop::sample::select(vec!["um", "nm", "mm"]);
    unit.prop_flat_map(|unit| {
        (material(), body(unit), log_between(0.01, 0.9), any::<bool>(), 0..6).prop_map(
            move |(material, body, share, unload, numerics)| {
                let Body { symmetry, asperities, substrate, height } = body;
                let numerics = match numerics {
                    0 => "[numerics]\nelement = \"q4\"\n",
                    1 => "[numerics]\nsteps = 7\n",
                    2 => "[numerics]\npenetration = 0.02\n",
                    _ => "",
                };
                format!(
                    "symmetry = \"{symmetry}\"\n{material}{asperities}{substrate}[tool]\nshape = \"plane\"\n[loading]\ndepth = \"{} {unit}\"\nunload = {unload}\n[output]\nevery = 0\n{numerics}",
                    share * height
                )
            },
        )
    })
}

/// Lines of a sound scene and what makes them unsound.
const SPOILED: [(&str, &str); 16] = [
    ("youngs_modulus", "\"-210 GPa\""),
    ("youngs_modulus", "\"nan GPa\""),
    ("youngs_modulus", "\"1e400 GPa\""),
    ("youngs_modulus", "\"210\""),
    ("youngs_modulus", "210"),
    ("poissons_ratio", "0.5"),
    ("poissons_ratio", "nan"),
    ("poissons_ratio", "-1.0"),
    ("depth", "\"0 um\""),
    ("depth", "\"-3 um\""),
    ("depth", "\"1e6 m\""),
    ("depth", "\"inf um\""),
    ("shape", "\"wedge\""),
    ("shape", "\"cone\""),
    ("unload", "\"maybe\""),
    ("every", "-1"),
];

fn drawn() -> impl Strategy<Value = Drawn> {
    let unsound = (sound(), prop::sample::select(SPOILED.to_vec())).prop_map(|(text, (key, value))| {
        let mut lines: Vec<String> = text.lines().map(String::from).collect();
        if let Some(line) = lines.iter_mut().rev().find(|l| l.starts_with(key)) {
            *line = format!("{key} = {value}");
        }
        Drawn { text: lines.join("\n"), kind: Kind::Unsound }
    });
    let misspelt = sound().prop_map(|text| Drawn { text: text + "\n[loadings]\n", kind: Kind::Unsound });
    let cut_off = (sound(), 0.0..1.0).prop_map(|(text, share)| {
        let end = (share * text.len() as f64) as usize;
        Drawn { text: text[..end].into(), kind: Kind::CutOff }
    });
    prop_oneof![
        7 => sound().prop_map(|text| Drawn { text, kind: Kind::Sound }),
        2 => unsound,
        1 => misspelt,
        1 => cut_off,
        3 => measured(),
    ]
}

/// The first `count` scenes of `seed`.
///
/// # Errors
/// A strategy that yields no value, which names itself.
pub fn draw(count: usize, seed: u64) -> Result<Vec<Drawn>, String> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = drawn();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).map(|t| t.current()).map_err(|e| e.to_string()))
        .collect()
}

/// The scenes `numbers` of the battery of [`coverage_scenes`](crate::coverage_scenes), as text: another
/// generator, with tools, tables, ridges between walls and kinematic hardening.
///
/// # Errors
/// A scene that the program refuses, or that has no text.
pub fn of_battery(numbers: Range<usize>) -> Result<Vec<Drawn>, Box<dyn Error>> {
    let text = |number| -> Result<Drawn, Box<dyn Error>> {
        Ok(Drawn { text: toml::to_string(&Case::new(number)?.scene)?, kind: Kind::Sound })
    };
    numbers.map(text).collect()
}

/// Crushes `drawn` with the program `binary` at draft accuracy in the empty folder `place`, for at most
/// `limit`.
pub fn crush(binary: &Path, drawn: &Drawn, place: &Path, limit: Duration) -> End {
    crush_at(Accuracy::Draft, binary, drawn, place, limit)
}

/// [`crush`] at `accuracy`.
pub fn crush_at(accuracy: Accuracy, binary: &Path, drawn: &Drawn, place: &Path, limit: Duration) -> End {
    let scene = place.join("scene.toml");
    let out = place.join("out");
    if let Err(e) = std::fs::write(&scene, &drawn.text) {
        return End::Fault(format!("the scene was not written: {e}"));
    }
    let mut command = Command::new(binary);
    command
        .arg("crush")
        .arg(&scene)
        .args(["--accuracy", &accuracy.to_string(), "--quiet", "--threads", "1", "--out"])
        .arg(&out);
    let messages = place.join("stderr");
    let spawned = std::fs::File::create(&messages)
        .and_then(|file| command.stdout(Stdio::null()).stderr(Stdio::from(file)).spawn());
    let mut child = match spawned {
        Ok(child) => child,
        Err(e) => return End::Fault(format!("the program did not start: {e}")),
    };
    let clock = Instant::now();
    let status = loop {
        match child.try_wait() {
            Ok(Some(status)) => break status,
            Ok(None) if clock.elapsed() < limit => std::thread::sleep(Duration::from_millis(3)),
            _ => {
                let _ = child.kill();
                let _ = child.wait();
                return End::Fault(format!("not done after {} s", limit.as_secs()));
            }
        }
    };
    let message = std::fs::read_to_string(&messages).unwrap_or_default();
    judge(drawn.kind, status.code(), &message, &out)
}

fn judge(kind: Kind, code: Option<i32>, message: &str, out: &Path) -> End {
    if message.contains("panicked") {
        return End::Fault(format!("panic: {message}"));
    }
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap_or_default();
    let (summary, curve) = (read("summary.json"), read("curve.csv"));
    if [&summary, &curve].iter().any(|text| text.contains("NaN") || text.contains("inf")) {
        return End::Fault("a number that is none was written".into());
    }
    match (code, kind) {
        (Some(0), Kind::Sound | Kind::CutOff) => match value(&summary, "energy_balance_error") {
            Some(energy_balance) => {
                End::Done(Done { energy_balance, promise_kept: value(&summary, "promise_kept") })
            }
            None => End::Fault("the summary has no energy balance".into()),
        },
        (Some(1), Kind::Sound | Kind::CutOff) if !message.trim().is_empty() => {
            End::Stopped(reason(message.trim()))
        }
        (Some(2), Kind::Unsound | Kind::CutOff) if message.trim().is_empty() => {
            End::Fault("refused without a message".into())
        }
        (Some(2), Kind::Unsound | Kind::CutOff) if out.exists() => {
            End::Fault("refused with files left behind".into())
        }
        (Some(2), Kind::Unsound | Kind::CutOff) => End::Refused,
        (code, kind) => End::Fault(format!("{kind:?}, exit status {code:?}: {}", message.trim())),
    }
}

/// The value at `key` in a flat JSON object.
fn value<T: FromStr>(json: &str, key: &str) -> Option<T> {
    let after = json.split_once(&format!("\"{key}\":"))?.1;
    after.split([',', '}', '\n']).next()?.trim().parse().ok()
}

/// The reason why a run stopped, without the numbers of the scene.
fn reason(message: &str) -> String {
    let after = message.split_once(": stopped").map_or(message, |(_, rest)| rest);
    let after = after.split_once(": ").map_or(after, |(_, rest)| rest);
    after.split(';').next().unwrap_or(after).trim().to_string()
}
