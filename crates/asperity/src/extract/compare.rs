//! Extracted asperities crushed by finite elements, each beside what every closure gives for it.

use super::bodies::Body;
use super::closures::Closures;
use super::rows::{Carried, ComparedRow, FINITE_ELEMENTS, written_area, written_depth};
use super::scenes::stem;
use crate::batch::journal::fingerprint;
use crate::batch::{self, Batch, Options};
use crate::crush::{Crush, CurveRow, Phase, crush, write_rows};
use crate::error::{Error, InputError};
use crate::extract::take::Extracted;
use crate::input::scene::Scene;
use crate::progress::Observer;
use crate::results::output::{Sink, SinkExt};
use crate::results::units::MICROMETRE;
use crate::rough::RoughScene;
use asperity_roughness::Closure;
use asperity_simulation::scene::Symmetry;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Instant;

/// Shares of the depth at which closures and finite elements are compared.
const SHARES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// The journal in the folder of the results.
const JOURNAL: &str = "crush.journal";

/// One asperity crushed and compared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// Number of the asperity.
    pub asperity: usize,
    /// Rows of `compared.csv`: at each depth the finite elements, then every closure.
    pub rows: Vec<ComparedRow>,
    /// Text of its curve, the file of `asperity crush`.
    pub curve: String,
    /// `ok`, or why it did not reach its depth.
    pub status: String,
}

/// Asperities crushed and compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// One for each asperity that was crushed, in the order of their numbers.
    pub asperities: Vec<Compared>,
    /// Closures that the metal does not allow, with the reason.
    pub warnings: Vec<String>,
    /// True where the observer ended it before all were crushed.
    pub stopped: bool,
    /// Seconds it took.
    pub wall_s: f64,
}

impl Extracted {
    /// Crushes the `count` highest bodies and holds every closure against them, a thread an asperity; `scene`
    /// is that of the extraction, whose files lie in the folder of `options` ([`Extracted::write`]).
    ///
    /// `observer` is asked at the beginning, as runs go on and when they end; `false` ends the comparison,
    /// which keeps the asperities that were crushed: the same call goes on from there.
    ///
    /// # Errors
    /// More asperities than have a profile, no folder, or one that cannot be written. A run that fails is a
    /// row with its reason.
    pub fn crush(
        &self,
        scene: &RoughScene,
        count: usize,
        options: &Options,
        observer: &mut Observer<'_, Compared>,
    ) -> Result<Comparison, Error> {
        let start = Instant::now();
        let Some(folder) = options.folder.as_deref() else {
            return Err(
                InputError::new("the scenes of the asperities lie in files: give their folder").into()
            );
        };
        self.check_count(count)?;
        let closures = Closures::for_scene(scene)?;
        let journal = folder.join(JOURNAL);
        let definition = self.definition(scene)?;
        let scenes = folder.join("scenes");
        let batch = Batch {
            definition: &definition,
            cases: &self.bodies[..count],
            key: &|body: &Body| format!("{}\n{:?}", body.scene, body.profile.points),
            solve: &|body: &Body, go_on: &dyn Fn() -> bool| self.one(body, &closures, &scenes, go_on),
            threads: options.threads,
            journal: Some(&journal),
        };
        let finished = batch::run(&batch, observer)?;
        Ok(Comparison {
            asperities: finished.rows.into_iter().map(|(_, row)| row).collect(),
            warnings: closures.skipped,
            stopped: finished.stopped,
            wall_s: start.elapsed().as_secs_f64(),
        })
    }

    /// Checks that `count` asperities can be crushed.
    ///
    /// # Errors
    /// More than have a profile, with the reasons.
    pub fn check_count(&self, count: usize) -> Result<(), InputError> {
        if count <= self.bodies.len() {
            return Ok(());
        }
        let message = format!(
            "{count} asperities are to be crushed, but only {} of {} have a profile",
            self.bodies.len(),
            self.asperities.len()
        );
        let help = self.warnings.last().cloned().unwrap_or_else(|| "ask for more profiles".into());
        Err(InputError::new(message)
            .help(format!("crush fewer, lower the plane, or take --hills or --line; {help}")))
    }

    /// All that the rows depend on beside scene and profile.
    fn definition(&self, scene: &RoughScene) -> Result<String, Error> {
        let bits: Vec<u8> = self.surface.map.heights().iter().flat_map(|z| z.to_le_bytes()).collect();
        let metal = serde_json::json!([self.scene.material, self.scene.half_space, scene.calibration()?]);
        Ok(format!("extract {} {:016x} {metal}", env!("CARGO_PKG_VERSION"), fingerprint(bits)))
    }

    /// One asperity; `None` where it was told to end.
    fn one(
        &self,
        body: &Body,
        closures: &Closures,
        scenes: &Path,
        go_on: &dyn Fn() -> bool,
    ) -> Option<Compared> {
        let mut ended = false;
        let crushed = Scene::from_toml(&body.scene, scenes).and_then(|scene| {
            crush(&scene, &mut |_| {
                ended = ended || !go_on();
                !ended
            })
        });
        let failed = |status: String| Compared {
            asperity: body.number,
            rows: Vec::new(),
            curve: String::new(),
            status: status.replace(['\n', '\r'], " "),
        };
        let compared = crushed.and_then(|crush| {
            let mut curve = Vec::new();
            write_rows(&mut curve, &crush.curve, Symmetry::Axisymmetric)
                .map_err(|e| Error::Unfinished(e.to_string()))?;
            let status = crush.summary.stopped.clone().unwrap_or_else(|| "ok".into());
            Ok(Compared {
                rows: self.rows(body, closures, &crush),
                curve: String::from_utf8_lossy(&curve).into_owned(),
                ..failed(status)
            })
        });
        (!ended).then(|| compared.unwrap_or_else(|e| failed(e.to_string())))
    }

    fn rows(&self, body: &Body, closures: &Closures, crush: &Crush) -> Vec<ComparedRow> {
        let mut rows = Vec::new();
        for point in compared_points(&crush.curve, body.depth / MICROMETRE) {
            let own = Carried { force: point.force, area: written_area(point) * MICROMETRE * MICROMETRE };
            rows.push(ComparedRow::new(body, FINITE_ELEMENTS, point, own, None, Some(&crush.summary), "ok"));
            for given in closures.answers_at(body, &self.surface, written_depth(point)) {
                let (own, status) = match given.body {
                    Ok(own) => (own, "ok".into()),
                    Err(why) => (Carried { force: f64::NAN, area: f64::NAN }, why),
                };
                rows.push(ComparedRow::new(
                    body,
                    given.closure.name(),
                    point,
                    own,
                    given.island,
                    None,
                    &status,
                ));
            }
        }
        rows
    }
}

/// The increments of loading that are nearest to the shares of `depth` (µm), each once.
fn compared_points(curve: &[CurveRow], depth: f64) -> Vec<&CurveRow> {
    let loading: Vec<&CurveRow> =
        curve.iter().take_while(|row| row.phase == Phase::Load).filter(|row| row.force > 0.0).collect();
    let nearest = |share: f64| {
        loading.iter().copied().min_by(|a, b| {
            let off = |row: &CurveRow| (row.depth / MICROMETRE - share * depth).abs();
            off(a).total_cmp(&off(b))
        })
    };
    let mut points: Vec<&CurveRow> = SHARES.into_iter().filter_map(nearest).collect();
    points.dedup_by_key(|row| row.increment);
    points
}

impl Comparison {
    /// All rows of `compared.csv`; an asperity that could not be crushed has one with the reason.
    pub fn rows(&self) -> impl Iterator<Item = &ComparedRow> {
        self.asperities.iter().flat_map(|one| &one.rows)
    }

    /// The rows of one closure at the full depth.
    pub fn at_depth<'a>(&'a self, closure: &'a str) -> impl Iterator<Item = &'a ComparedRow> {
        self.asperities.iter().filter_map(move |one| one.rows.iter().rfind(|row| row.closure == closure))
    }

    /// The names of the closures, in the order of the tables.
    pub fn closures(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for row in self.rows().filter(|row| row.closure != FINITE_ELEMENTS) {
            if !names.contains(&row.closure.as_str()) {
                names.push(&row.closure);
            }
        }
        names
    }

    /// Writes `compared.csv`, `curves/NNN.csv` and, where there is something to draw, `compared.svg`.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let rows: Vec<&ComparedRow> = self.rows().collect();
        sink.write("compared.csv", |out| crate::results::output::write_csv(out, &rows))?;
        for one in self.asperities.iter().filter(|one| !one.curve.is_empty()) {
            sink.text(&format!("curves/{}.csv", stem(one.asperity)), &one.curve)?;
        }
        let closures = Closure::ALL.map(|closure| (closure, self.at_depth(closure.name()).collect()));
        let picture = super::picture::compared(closures.into()).map_err(Error::Unfinished)?;
        picture.map_or(Ok(()), |picture| sink.text("compared.svg", &picture))
    }

    /// The closures that know the hardening of the metal beside the finite elements, in a sentence: which
    /// is to be believed, by the force at the full depth; None where nothing was crushed.
    pub fn verdict(&self) -> Option<String> {
        let middle = |name: &str, value: fn(&ComparedRow) -> Option<f64>| {
            let mut all: Vec<f64> = self.at_depth(name).filter_map(value).collect();
            all.sort_by(f64::total_cmp);
            all.get(all.len() / 2).copied()
        };
        let judged = [Closure::Calibrated, Closure::HalfSpacePlastic].into_iter().filter_map(|closure| {
            let force = middle(closure.name(), |row| row.force_over_finite_elements)?;
            let area = middle(closure.name(), |row| row.area_over_finite_elements)?;
            Some((closure.name(), force, area))
        });
        let judged: Vec<(&str, f64, f64)> = judged.collect();
        let said: Vec<String> = judged
            .iter()
            .map(|(name, force, area)| {
                let [force, area] = [force, area].map(|ratio| 100.0 * (ratio - 1.0));
                format!("{name} has a force {force:+.0} % and an area {area:+.0} % off")
            })
            .collect();
        let off = |one: &(&str, f64, f64)| one.1.ln().abs();
        let nearest = judged.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some(format!(
            "finite elements of {} summits (draft, to the same depth): {}; of the two believe {} here",
            self.at_depth(FINITE_ELEMENTS).count(),
            said.join(", "),
            nearest.0
        ))
    }

    /// Force and area of every closure over those of the finite elements, at the full depth, for a person.
    pub fn text(&self) -> String {
        use std::fmt::Write;
        let failed: Vec<&Compared> = self.asperities.iter().filter(|one| one.status != "ok").collect();
        let mut text = format!(
            "crushed   {} asperities in {:.1} s, {} short of their depth\n",
            self.asperities.len(),
            self.wall_s,
            failed.len()
        );
        text += "over finite elements    force: median (least, most)        contact area\n";
        for name in self.closures() {
            let spread = |value: fn(&ComparedRow) -> Option<f64>| {
                let mut all: Vec<f64> = self.at_depth(name).filter_map(value).collect();
                all.sort_by(f64::total_cmp);
                match (all.first(), all.get(all.len() / 2), all.last()) {
                    (Some(low), Some(middle), Some(high)) => format!("{middle:6.3} ({low:.3}, {high:.3})"),
                    _ => "-".into(),
                }
            };
            let (force, area) =
                (spread(|r| r.force_over_finite_elements), spread(|r| r.area_over_finite_elements));
            let _ = writeln!(text, "{name:<20}    {force:<35}{area}");
        }
        for one in failed.iter().take(5) {
            let _ = writeln!(text, "asperity {}: {}", one.asperity, one.status);
        }
        text
    }
}
