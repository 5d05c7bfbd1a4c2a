//! `asperity crush`: one scene from its file to a folder of results.

use crate::args::Crush;
use crate::failure::{Failure, InputError};
use crate::folder::Folder;
use crate::progress::Progress;
use crate::records::{self, FieldSeries, MICROMETRE};
use crate::terminal;
use crate::{scene_file, toml_file::TomlFile};
use asperity_solver::crush::{CrushError, Event, FieldFrame, Outcome, run};
use asperity_solver::discretise::Discretisation;
use asperity_solver::record::{CurveRow, Phase};
use asperity_solver::scene::{Field, Scene, Symmetry};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or a run that could not finish (what it reached is written).
pub fn crush(args: &Crush) -> Result<(), Failure> {
    let start = Instant::now();
    let file = scene_file::read(&args.scene, &args.scene_flags)?;
    let mesh = scene_file::read_mesh(&file)?;
    let out = args.run.out.clone().unwrap_or_else(|| PathBuf::from("out").join(file.stem()));
    let mut folder = Folder::create(&out, "crush", args.run.force)?;

    let scene = &file.value;
    let progress = Progress::new(args.run.quiet);
    let mut observer =
        Observer { scene, folder: &mut folder, series: FieldSeries::default(), failure: None, progress };
    let result = run(scene, mesh, &mut |event| observer.hear(event));
    let mut failure = observer.finish();
    let outcome = match result {
        Ok(outcome) => outcome,
        Err(error) => {
            folder.abandon();
            return Err(begin_error(&file, &error).into());
        }
    };
    let stopped = failure
        .as_ref()
        .map(|_| "its fields could not be written".to_string())
        .or_else(|| reason(&outcome, scene));
    // of two failures to write, the first says more
    let summary = write_records(&mut folder, scene, &outcome, stopped.as_deref(), start)
        .map_err(|error| failure.take().unwrap_or(error))?;
    folder.publish()?;

    if args.run.json {
        terminal::say(summary.trim_end());
    } else if !args.run.quiet {
        terminal::say(&records::overview(&outcome.summary, scene.symmetry));
        terminal::say(&format!("results   {}", out.display()));
    }
    match (failure, stopped) {
        (Some(failure), _) => Err(failure),
        (None, Some(reason)) => {
            Err(Failure::Unfinished(format!("{reason}; what was reached is in {}", out.display())))
        }
        (None, None) => Ok(()),
    }
}

/// Hears of every increment: shows progress, writes fields.
struct Observer<'a> {
    scene: &'a Scene,
    folder: &'a mut Folder,
    series: FieldSeries,
    failure: Option<Failure>,
    progress: Progress,
}

impl Observer<'_> {
    fn hear(&mut self, event: &Event<'_>) -> ControlFlow<()> {
        let result = match event {
            Event::Increment { row, planned } => {
                let share = row.increment as f64 / (*planned).max(1) as f64;
                self.progress.show(share, || progress_line(row, self.scene.symmetry));
                Ok(())
            }
            Event::Fields(frame) => self.write_fields(frame),
        };
        match result {
            Ok(()) => ControlFlow::Continue(()),
            Err(failure) => {
                self.failure = Some(failure);
                ControlFlow::Break(())
            }
        }
    }

    fn write_fields(&mut self, frame: &FieldFrame) -> Result<(), Failure> {
        let wanted: &[Field] = self.scene.output.fields();
        let (nodes, cells) = records::field_arrays(&frame.fields, wanted, self.scene.symmetry);
        self.series.add(self.folder, frame.increment, &frame.mesh, &nodes, &cells)?;
        let name = format!("surface_{:04}.csv", frame.increment);
        self.folder.write(&name, |out| records::write_surface(out, &frame.fields.surface))
    }

    /// Takes the progress line away; what went wrong with the files, if anything did.
    fn finish(self) -> Option<Failure> {
        self.progress.finish();
        self.failure
    }
}

fn progress_line(row: &CurveRow, symmetry: Symmetry) -> String {
    let force = records::force_unit(symmetry);
    let verb = match row.phase {
        Phase::Load => "loading",
        Phase::Unload => "unloading",
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
    };
    let target = match (scene.loading.depth, stopped.phase) {
        (Some(depth), Phase::Load) => format!(" of {:.4} um", depth.0 / MICROMETRE),
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
    folder: &mut Folder,
    scene: &Scene,
    outcome: &Outcome,
    stopped: Option<&str>,
    start: Instant,
) -> Result<String, Failure> {
    let symmetry = scene.symmetry;
    folder.write("curve.csv", |out| records::write_curve(out, symmetry, &outcome.rows))?;
    if !outcome.asperities.is_empty() {
        folder
            .write("asperities.csv", |out| records::write_asperities(out, symmetry, &outcome.asperities))?;
    }
    if !outcome.gaps.is_empty() {
        folder.write("gaps.csv", |out| records::write_gaps(out, &outcome.gaps))?;
    }
    let plot = records::plot(symmetry, &outcome.rows).map_err(Failure::Unfinished)?;
    folder.write("curve.svg", |out| out.write_all(plot.as_bytes()))?;
    let wall_s = start.elapsed().as_secs_f64();
    let summary =
        records::summary_json(&outcome.summary, &outcome.elastic_islands, &resolved(scene), stopped, wall_s)
            .map_err(|e| Failure::Unfinished(format!("the summary could not be written: {e}")))?;
    folder.write("summary.json", |out| out.write_all(summary.as_bytes()))?;
    Ok(summary)
}

/// The scene with the numbers that its accuracy level stands for.
fn resolved(scene: &Scene) -> Scene {
    let numerics = Discretisation::new(scene).numerics();
    Scene { numerics, ..scene.clone() }
}
