//! `asperity crush`: one scene from its file to a folder of results.

use crate::cli::args::Crush;
use crate::cli::folder::Folder;
use crate::cli::progress::Progress;
use crate::cli::terminal;
use crate::crush::{self as records, FieldSeries, MICROMETRE};
use crate::draw::field_plot::{Panel, Reach, Section};
use crate::error::{Error, InputError};
use crate::input::{scene_file, toml_file::TomlFile};
use crate::output::{Sink, SinkExt};
use asperity_mesh::Mesh;
use asperity_solver::run::crush::{CrushError, Event, FieldFrame, Outcome, run};
use asperity_solver::run::discretisation::Discretisation;
use asperity_solver::run::record::{CurveRow, Phase};
use asperity_solver::scene::{Field, Scene, Symmetry};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or a run that could not finish (what it reached is written).
pub fn crush(args: &Crush) -> Result<(), Error> {
    let Some(scene) = &args.scene else {
        return Err(InputError::new("crush what? No scene file is given")
            .help(
                "asperity new single writes single.toml, a commented scene to start from; then: asperity crush single.toml",
            )
            .into());
    };
    let file = scene_file::read(scene, &args.scene_flags)?;
    let mesh = scene_file::read_mesh(&file)?;
    if !args.run.quiet {
        file.value.unused().iter().for_each(terminal::warn);
    }
    let out = args.run.out.clone().unwrap_or_else(|| PathBuf::from("out").join(file.stem()));
    let mut folder = Folder::create(&out, "crush", args.run.force)?;

    let progress = Progress::new(args.run.quiet);
    let Crushed { outcome, stopped, failure, summary } =
        match crush_into(&file.value, mesh, &mut folder, &[Sketch::PEAK], progress) {
            Ok(crushed) => crushed,
            Err(error) => {
                folder.abandon();
                return Err(begin_error(&file, &error).into());
            }
        };
    let summary = match (summary, failure.is_some()) {
        (Ok(summary), _) => summary,
        // of two failures to write, the first says more
        (Err(second), first) => return Err(if first { failure.unwrap_or(second) } else { second }),
    };
    folder.publish()?;

    if args.run.json {
        terminal::say(summary.trim_end());
    } else if !args.run.quiet {
        terminal::say(&records::overview(&outcome.summary, file.value.symmetry));
        terminal::say(&format!("results   {}", out.display()));
    }
    match (failure, stopped) {
        (Some(failure), _) => Err(failure),
        (None, Some(reason)) => {
            Err(Error::Unfinished(format!("{reason}; what was reached is in {}", out.display())))
        }
        (None, None) => Ok(()),
    }
}

/// A picture of the peak that a crush leaves where it has fields.
#[derive(Clone, Copy, Debug)]
pub struct Sketch {
    /// Start of the file's name.
    pub name: &'static str,
    /// Which part of the section.
    pub reach: Reach,
    /// What is drawn.
    pub panels: &'static [Panel],
}

impl Sketch {
    /// What `asperity crush` draws.
    pub const PEAK: Sketch = Sketch { name: "section", reach: Reach::Yielded, panels: &Panel::PEAK };
}

/// A run whose files are in their folder.
pub struct Crushed {
    /// What it gave.
    pub outcome: Outcome,
    /// Why it ended before its target.
    pub stopped: Option<String>,
    /// What could not be written while it ran; the run ended there.
    pub failure: Option<Error>,
    /// The text of summary.json.
    pub summary: Result<String, Error>,
}

/// Runs `scene` and writes its records, fields and `sketches` to `folder`.
///
/// # Errors
/// Only if the run cannot begin.
pub fn crush_into(
    scene: &Scene,
    mesh: Option<Mesh>,
    folder: &mut dyn Sink,
    sketches: &[Sketch],
    progress: Progress,
) -> Result<Crushed, CrushError> {
    let start = Instant::now();
    let series = FieldSeries::default();
    let mut observer = Observer { scene, folder, series, peak: None, last: None, failure: None, progress };
    let result = run(scene, mesh, &mut |event| observer.hear(event));
    let drawn = observer.draw(sketches);
    let Observer { failure, progress, .. } = observer;
    progress.finish();
    let outcome = result?;
    let failure = failure.or(drawn.err());
    let stopped = failure
        .as_ref()
        .map(|_| "its fields could not be written".to_string())
        .or_else(|| reason(&outcome, scene));
    let summary = write_records(folder, scene, &outcome, stopped.as_deref(), start);
    Ok(Crushed { outcome, stopped, failure, summary })
}

/// Hears of every increment: shows progress, writes fields, keeps the fields of the peak to draw them.
struct Observer<'a> {
    scene: &'a Scene,
    folder: &'a mut dyn Sink,
    series: FieldSeries,
    /// The last fields of loading.
    peak: Option<FieldFrame>,
    /// The last increment and its title.
    last: Option<(usize, String)>,
    failure: Option<Error>,
    progress: Progress,
}

impl Observer<'_> {
    fn hear(&mut self, event: &Event<'_>) -> ControlFlow<()> {
        let result = match event {
            Event::Increment { row, planned } => {
                let share = row.increment as f64 / (*planned).max(1) as f64;
                self.progress.show(share, || progress_line(row, self.scene.symmetry));
                if row.phase == Phase::Load {
                    self.last = Some((row.increment, title(row, self.scene.symmetry)));
                }
                Ok(())
            }
            Event::Fields(frame) => {
                if frame.phase == Phase::Load {
                    self.peak = Some((*frame).clone());
                }
                self.write_fields(frame)
            }
        };
        match result {
            Ok(()) => ControlFlow::Continue(()),
            Err(failure) => {
                self.failure = Some(failure);
                ControlFlow::Break(())
            }
        }
    }

    fn write_fields(&mut self, frame: &FieldFrame) -> Result<(), Error> {
        let wanted: &[Field] = self.scene.output.fields();
        let (nodes, cells) = records::field_arrays(&frame.fields, wanted, self.scene.symmetry);
        self.series.add(self.folder, frame.increment, &frame.mesh, &nodes, &cells)?;
        let name = format!("surface_{:04}.csv", frame.increment);
        self.folder.write(&name, |out| records::write_surface(out, &frame.fields.surface))
    }

    /// Draws the peak, where the run has left its fields.
    fn draw(&mut self, sketches: &[Sketch]) -> Result<(), Error> {
        let (Some(frame), Some((increment, title))) = (&self.peak, &self.last) else { return Ok(()) };
        // without fields at the last increment of loading there is none of the peak
        if frame.increment != *increment {
            return Ok(());
        }
        for sketch in sketches {
            let drawn = Section::new(frame, self.scene, sketch.reach)
                .and_then(|section| section.svg(sketch.panels, title))
                .map_err(Error::Unfinished)?;
            let name = format!("{}_{increment:04}.svg", sketch.name);
            self.folder.write(&name, |out| out.write_all(drawn.as_bytes()))?;
        }
        Ok(())
    }
}

/// Depth and force of a state, for people.
fn title(row: &CurveRow, symmetry: Symmetry) -> String {
    let per = if symmetry == Symmetry::PlaneStrain { "/mm" } else { "" };
    let force = row.force / records::force_unit(symmetry).scale;
    let digits = (3 - force.abs().max(1e-9).log10().floor() as i32 - 1).clamp(0, 9) as usize;
    let depth = format!("{:.4}", row.depth / MICROMETRE);
    let depth = depth.trim_end_matches('0').trim_end_matches('.');
    format!("depth {depth} µm, force {force:.digits$} N{per}")
}

fn progress_line(row: &CurveRow, symmetry: Symmetry) -> String {
    let force = records::force_unit(symmetry);
    let verb = match row.phase {
        Phase::Load => "loading",
        Phase::Unload => "unloading",
        Phase::Reload => "reloading",
    };
    let per = if symmetry == Symmetry::PlaneStrain { "/mm" } else { "" };
    let (depth, newtons) = (row.depth / MICROMETRE, row.force / force.scale);
    format!("{verb}  {depth:.3} um  {newtons:.3} N{per}  increment {}", row.increment)
}

/// Why the run ended before its target, with the place where it did.
fn reason(outcome: &Outcome, scene: &Scene) -> Option<String> {
    let stopped = outcome.stopped.as_ref()?;
    let verb = match stopped.phase {
        Phase::Load => "loading",
        Phase::Unload => "unloading",
        Phase::Reload => "reloading",
    };
    let target = match (scene.loading.depth, stopped.phase) {
        (Some(depth), Phase::Load | Phase::Reload) => format!(" of {:.4} um", depth.0 / MICROMETRE),
        _ => String::new(),
    };
    Some(format!("stopped {verb} at {:.4} um{target}: {}", stopped.depth / MICROMETRE, stopped.reason))
}

fn begin_error(file: &TomlFile<Scene>, error: &CrushError) -> InputError {
    match error {
        CrushError::Scene(error) => scene_file::point_at(file, error),
        CrushError::Mesh if file.value.mesh.is_some() => file.error_at("mesh.file", &error.to_string()),
        CrushError::Mesh => file.error_at("", &error.to_string()),
    }
}

/// Writes everything but the fields; returns the text of the summary.
fn write_records(
    folder: &mut dyn Sink,
    scene: &Scene,
    outcome: &Outcome,
    stopped: Option<&str>,
    start: Instant,
) -> Result<String, Error> {
    let symmetry = scene.symmetry;
    folder.write("curve.csv", |out| records::write_curve(out, symmetry, &outcome.rows))?;
    if !outcome.asperities.is_empty() {
        folder
            .write("asperities.csv", |out| records::write_asperities(out, symmetry, &outcome.asperities))?;
    }
    // a single loading stands in the summary
    if scene.loading.reloads > 0 {
        folder.write("cycles.csv", |out| records::write_cycles(out, symmetry, &outcome.cycles))?;
    }
    if !outcome.gaps.is_empty() {
        folder.write("gaps.csv", |out| records::write_gaps(out, &outcome.gaps))?;
    }
    let plot = records::plot(symmetry, &outcome.rows).map_err(Error::Unfinished)?;
    folder.write("curve.svg", |out| out.write_all(plot.as_bytes()))?;
    let wall_s = start.elapsed().as_secs_f64();
    let summary =
        records::summary_json(&outcome.summary, &outcome.elastic_islands, &resolved(scene), stopped, wall_s)
            .map_err(|e| Error::Unfinished(format!("the summary could not be written: {e}")))?;
    folder.write("summary.json", |out| out.write_all(summary.as_bytes()))?;
    Ok(summary)
}

/// The scene with the numbers that its accuracy level stands for.
pub fn resolved(scene: &Scene) -> Scene {
    let numerics = Discretisation::new(scene).numerics();
    Scene { numerics, ..scene.clone() }
}
