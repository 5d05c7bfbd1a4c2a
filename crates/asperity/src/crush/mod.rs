//! One scene crushed: the run, its result, and the files of the result.
//!
//! Rows and summary are in SI; files have the names and units of [`crate::results::columns`].

mod crush_report;
mod fields;
mod plot;

pub use crate::results::columns::{Unit, read_rows, write_rows};
pub use crate::results::crush_summary::{Summary, peak_memory};
pub use asperity_simulation::record::rows::{
    AsperityRow, CurveRow, CycleRow, Errors, GapRow, OliverPharr, Phase, Summary as Numbers,
};
pub use asperity_simulation::scene::Smoothing;
pub use asperity_solver::body::fields::SurfacePoint;
pub use asperity_solver::body::islands::Island;
pub use fields::{FieldSeries, Frame};
pub use plot::{plot, titled_plot};

use crate::draw::field_plot::{Panel, Reach, Section};
use crate::error::Error;
use crate::input::scene::Scene;
use crate::progress::Progress;
use crate::results::numbers::decimals;
use crate::results::output::{Sink, SinkExt};
use crate::results::units::{MICROMETRE, per_length};
use asperity_mesh::Mesh;
use asperity_simulation::run::{CrushError, Event, FieldFrame, Outcome, Run};
use asperity_simulation::scene::{Scene as Tables, SceneError, Symmetry};
use asperity_solver::body::analysis::Analyses;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

/// The result of a crush.
#[derive(Clone, Debug)]
pub struct Crush {
    /// The numbers of `summary.json`; `summary.stopped` says why and where the run ended before its target.
    pub summary: Summary,
    /// Loading and unloading, one row per converged increment, from first touch.
    pub curve: Vec<CurveRow>,
    /// The share of each asperity in each increment; empty for a single one.
    pub asperities: Vec<AsperityRow>,
    /// The gaps between contacts in each increment.
    pub gaps: Vec<GapRow>,
    /// The loading and the reloads, each with its unloading, as far as they are complete; empty without
    /// reloads.
    pub cycles: Vec<CycleRow>,
    /// Fields of some increments, where the scene asks for them and they were not written as they came.
    pub frames: Vec<Frame>,
    /// Fields of the last increment of the first loading, SI, for pictures.
    peak: Option<FieldFrame>,
}

/// News for the observer of a crush: of every increment, and again where its fields are due.
#[derive(Clone, Copy, Debug)]
pub struct Increment<'a> {
    /// The last increment as it was found: ripple still in, not extrapolated, without a stated error. The row
    /// of the result differs by as much as the error that is stated there.
    pub row: &'a CurveRow,
    /// The fields of the increment, where they are due.
    pub frame: Option<&'a Frame>,
}

/// A picture of the peak that a crush leaves where it has fields.
#[derive(Clone, Copy, Debug)]
pub struct Sketch {
    /// Start of the file's name.
    pub name: &'static str,
    /// The part of the section.
    pub reach: Reach,
    /// The panels, side by side.
    pub panels: &'static [Panel],
}

impl Sketch {
    /// The picture that `asperity crush` draws.
    pub const PEAK: Sketch = Sketch { name: "section", reach: Reach::Yielded, panels: &Panel::PEAK };
}

/// Crushes `scene` and keeps its fields in the result.
///
/// The observer hears of every increment; it ends the run by `false`, and the result is what was reached:
/// `summary.stopped` says where, nothing is extrapolated, and no error is stated (NaN or `None`).
///
/// # Errors
/// Only if the run cannot begin: [`Error::Input`], pointing at the line of the scene. What stops it later is
/// in `summary.stopped`.
pub fn crush(
    scene: &Scene,
    observer: &mut dyn FnMut(&Progress<'_, Increment<'_>>) -> bool,
) -> Result<Crush, Error> {
    crush_sharing(scene, &Analyses::default(), observer)
}

/// [`crush`] for one of many scenes, which share `analyses` of their meshes.
///
/// # Errors
/// As for [`crush`].
pub(crate) fn crush_sharing(
    scene: &Scene,
    analyses: &Analyses,
    observer: &mut dyn FnMut(&Progress<'_, Increment<'_>>) -> bool,
) -> Result<Crush, Error> {
    let mut frames = Vec::new();
    let keep = &mut |shown: Shown| {
        match shown {
            Shown::Frame(frame) => frames.push(frame),
            Shown::Anew => frames.clear(),
        }
        Ok(())
    };
    let (crush, _) = simulate(scene, analyses, observer, keep)?;
    Ok(Crush { frames, ..crush })
}

/// Crushes `scene` and writes its fields to `sink` as they come, then its records and `sketches`; the result
/// keeps no fields.
///
/// # Errors
/// [`Error::Input`] only if the run cannot begin, when nothing was written. [`Error::Unfinished`] if
/// something could not be written: the run ended there, and what could be written of it was.
pub fn crush_into(
    scene: &Scene,
    sink: &mut dyn Sink,
    sketches: &[Sketch],
    observer: &mut dyn FnMut(&Progress<'_, Increment<'_>>) -> bool,
) -> Result<Crush, Error> {
    let mut series = FieldSeries::default();
    let (crush, failure) = simulate(scene, &Analyses::default(), observer, &mut |shown| match shown {
        Shown::Frame(frame) => series.add(sink, &frame),
        Shown::Anew => std::mem::take(&mut series).remove(sink),
    })?;
    let written = series.write_surfaces(sink).and_then(|()| crush.write_records(sink, sketches));
    // of two failures to write, the first says more
    failure.map_or(written, Err).map(|()| crush)
}

/// The fields that a run gives out.
enum Shown {
    /// One more frame.
    Frame(Frame),
    /// A later round counts: the frames so far are to be forgotten.
    Anew,
}

/// The fields of one round.
#[derive(Default)]
struct RoundFields {
    mesh: Option<Arc<Mesh>>,
    /// Those of the peak, as far as the run has come.
    peak: Option<FieldFrame>,
    /// Those of a round that may come to nothing, until it is known whether it counts.
    frames: Vec<Frame>,
}

impl RoundFields {
    /// A frame of the run in the units of the files.
    fn note(&mut self, frame: &FieldFrame, scene: &Tables, row: Option<&CurveRow>) -> Frame {
        let mesh = self.mesh.get_or_insert_with(|| Arc::new(frame.mesh.clone()));
        if frame.phase == Phase::Load {
            self.peak = Some(frame.clone());
        }
        Frame::new(frame, mesh.clone(), scene, row)
    }
}

/// Runs `scene`, hands its fields to `keep`, and gives the result with the failure of `keep`, if it failed.
fn simulate(
    scene: &Scene,
    analyses: &Analyses,
    observer: &mut dyn FnMut(&Progress<'_, Increment<'_>>) -> bool,
    keep: &mut dyn FnMut(Shown) -> Result<(), Error>,
) -> Result<(Crush, Option<Error>), Error> {
    let start = Instant::now();
    let tables = scene.tables();
    let (mut last, mut failure, mut ended) = (None, None, false);
    let mut rounds = vec![RoundFields::default()];
    let mut hear = |event: &Event<'_>| -> bool {
        let mut frame = None;
        match event {
            Event::Increment { row, planned } => last = Some((**row, *planned)),
            Event::Round(_) => {
                rounds.push(RoundFields::default());
                last = None;
            }
            Event::Fields(fields) => {
                let row = last.as_ref().map(|(row, _)| row);
                frame = rounds.last_mut().map(|round| round.note(fields, tables, row));
            }
        }
        let told = |(row, planned): &(CurveRow, usize)| {
            let news = Increment { row, frame: frame.as_ref() };
            observer(&Progress::counted(row.increment, *planned, Some(&news)))
        };
        // a run that was ended may still hand out the fields of where it ended
        ended = ended || !last.as_ref().is_none_or(told);
        match (frame, &mut rounds[..]) {
            (Some(frame), [_]) if failure.is_none() => failure = keep(Shown::Frame(frame)).err(),
            (Some(frame), [_, .., now]) => now.frames.push(frame),
            _ => {}
        }
        !ended && failure.is_none()
    };
    let run = Run { mesh: scene.mesh().cloned(), analyses: analyses.clone(), ..Run::new(tables) };
    let outcome = run.run_refined(&mut |event| match hear(event) {
        true => ControlFlow::Continue(()),
        false => ControlFlow::Break(()),
    });
    let outcome = outcome.map_err(|e| begin_error(scene, e))?;
    let RoundFields { peak, frames, .. } = rounds.swap_remove(outcome.round - 1);
    if outcome.round > 1 {
        let shown = std::iter::once(Shown::Anew).chain(frames.into_iter().map(Shown::Frame));
        failure = failure.or(shown.map(keep).find_map(Result::err));
    }
    let stopped = match &failure {
        Some(_) => Some("its fields could not be written".to_string()),
        None => reason(&outcome, tables),
    };
    let crush = Crush {
        summary: Summary::new(&outcome, tables, stopped, start.elapsed().as_secs_f64()),
        curve: outcome.rows,
        asperities: outcome.asperities,
        gaps: outcome.gaps,
        // a single loading stands in the summary
        cycles: match tables.loading.reloads {
            0 => Vec::new(),
            _ => outcome.cycles,
        },
        frames: Vec::new(),
        peak,
    };
    Ok((crush, failure))
}

/// The reason why the run of `scene` ended before its target, with the place and the way out.
fn reason(outcome: &Outcome, scene: &Tables) -> Option<String> {
    let stopped = outcome.stopped.as_ref()?;
    let verb = match stopped.phase {
        Phase::Load => "loading",
        Phase::Unload => "unloading",
        Phase::Reload => "reloading",
    };
    let target = scene.loading.depth.filter(|_| stopped.phase != Phase::Unload);
    let target = target.map_or(String::new(), |depth| format!(" of {:.4} um", depth.0 / MICROMETRE));
    let way_out = stopped.way_out(scene).map_or(String::new(), |way_out| format!("; {way_out}"));
    let depth = stopped.depth / MICROMETRE;
    Some(format!("stopped {verb} at {depth:.4} um{target}: {}{way_out}", stopped.reason))
}

fn begin_error(scene: &Scene, error: CrushError) -> Error {
    let error = match error {
        CrushError::Scene(error) => error,
        CrushError::Mesh => {
            let path = if scene.mesh().is_some() { "mesh.file" } else { "" };
            SceneError { path: path.into(), message: error.to_string() }
        }
    };
    scene.error(&error).into()
}

impl Crush {
    /// Writes the files of `asperity crush`: curve, summary, plots, and the fields that the result holds.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let mut series = FieldSeries::default();
        for frame in &self.frames {
            series.add(sink, frame)?;
        }
        series.write_surfaces(sink)?;
        self.write_records(sink, &[Sketch::PEAK])
    }

    /// Writes everything but the fields.
    fn write_records(&self, sink: &mut dyn Sink, sketches: &[Sketch]) -> Result<(), Error> {
        let symmetry = self.summary.scene.symmetry;
        sink.write("curve.csv", |out| write_rows(out, &self.curve, symmetry))?;
        if !self.asperities.is_empty() {
            sink.write("asperities.csv", |out| write_rows(out, &self.asperities, symmetry))?;
        }
        if !self.cycles.is_empty() {
            sink.write("cycles.csv", |out| write_rows(out, &self.cycles, symmetry))?;
        }
        if !self.gaps.is_empty() {
            sink.write("gaps.csv", |out| write_rows(out, &self.gaps, symmetry))?;
        }
        let plot = titled_plot(&self.summary, &self.curve).map_err(Error::Unfinished)?;
        sink.text("curve.svg", &plot)?;
        sink.text("summary.json", &self.summary.to_json()?)?;
        for sketch in sketches {
            if let Some(drawn) = self.section(sketch)? {
                let name =
                    format!("{}_{:04}.svg", sketch.name, self.peak_row().map_or(0, |row| row.increment));
                sink.text(&name, &drawn)?;
            }
        }
        Ok(())
    }

    /// The fields of the last increment of the first loading, SI; `None` where the run hands out none.
    pub fn peak(&self) -> Option<&FieldFrame> {
        self.peak.as_ref()
    }

    /// The last increment of the first loading.
    fn peak_row(&self) -> Option<&CurveRow> {
        self.curve.iter().take_while(|row| row.phase == Phase::Load).last()
    }

    /// A picture of the section at the peak as SVG; `None` where the run has no fields of the peak.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn section(&self, sketch: &Sketch) -> Result<Option<String>, Error> {
        let (Some(frame), Some(row)) = (&self.peak, self.peak_row()) else { return Ok(None) };
        if frame.increment != row.increment {
            return Ok(None);
        }
        let scene = &self.summary.scene;
        Section::new(frame, scene, sketch.reach)
            .and_then(|section| section.svg(sketch.panels, &title(row, scene.symmetry)))
            .map(Some)
            .map_err(Error::Unfinished)
    }
}

/// Depth and force of a state, for people.
fn title(row: &CurveRow, symmetry: Symmetry) -> String {
    let (force, per) = (row.force / Unit::Force.value(symmetry), per_length(symmetry));
    let digits = decimals(force.abs().max(1e-9), 3);
    let depth = format!("{:.4}", row.depth / MICROMETRE);
    let depth = depth.trim_end_matches('0').trim_end_matches('.');
    format!("depth {depth} µm, force {force:.digits$} N{per}")
}
