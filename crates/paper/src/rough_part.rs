//! A rough part: curves and maps of its own surface, and the surfaces of its row of Table 1.

use super::profile::profile;
use crate::table1;
use asperity::Progress;
use asperity::error::Error;
use asperity::output::{Sink, SinkExt, write_csv};
use asperity::rough::{self, RoughScene};
use asperity::roughness::scene::{Choice, Scene};
use asperity::roughness::{Closure, KindName};
use asperity::scales::scales;
use asperity::units::MICROMETRE;
use std::path::Path;

/// Dots along a side of a map in the report, its key included.
const MAP: usize = 900;

/// The closure whose maps the report shows.
const MAPPED: Closure = Closure::Published;

/// Time of both half-spaces with their curves, in that of a surface under all closures of islands.
const HALF_SPACES: f64 = 11.0;

/// The work of a part whose own surface is pressed by `closure`, in surfaces under all closures of islands:
/// that of its own, of those of its row, of those of other kinds.
pub fn surfaces(closure: Choice) -> [f64; 3] {
    let half_spaces = if closure == Choice::All { HALF_SPACES } else { 0.0 };
    [1.0 + half_spaces, table1::SEEDS as f64, (table1::TABLE.len() - 1) as f64]
}

/// Presses the surface of `scene` and those of the row `kind` of Table 1, and writes what the report shows of
/// them; `observer` hears of the share that is done (0 to 1) and ends the work by `false`.
///
/// # Errors
/// A surface that cannot be made or pressed, a disk that refuses, an observer that ended the work.
pub fn press(
    scene: &Scene,
    kind: KindName,
    sink: &mut dyn Sink,
    observer: &mut (dyn FnMut(f64, &str) -> bool + Send),
) -> Result<(), Error> {
    let surfaces = surfaces(scene.closure);
    let [own, of_table, of_others] = surfaces.map(|one| one / surfaces.iter().sum::<f64>());
    let scene = RoughScene::new(scene.clone(), Path::new(""));
    let told = &mut |reached: &Progress<'_, Closure>| {
        let closure = reached.news.map_or("compared", |closure| closure.name());
        observer(own * reached.share, &format!("the {} surface, {closure}", kind.name()))
    };
    let rough = rough::press(&scene, told)?;
    if rough.stopped {
        return Err(table1::ended());
    }
    rough.write_tables(sink)?;
    rough.write_topography(sink, MAP)?;
    if let Some(one) = rough.contact(MAPPED) {
        rough.write_pictures(sink, one, MAP)?;
        if let Some(islands) = one.islands() {
            let points = profile(&rough.surface.map, &islands.contact.islands);
            sink.write("profile.csv", |out| write_csv(out, &points))?;
        }
    }
    let Some((_, row)) = table1::TABLE.into_iter().find(|(row, _)| *row == kind) else { return Ok(()) };
    let told = &mut |share: f64, message: &str| observer(own + of_table * share, message);
    let table = table1::measure(kind, &row, Choice::Islands, told)?;
    sink.text("table1.json", &asperity::output::json(&table)?)?;
    let told = &mut |share: f64, message: &str| observer(own + of_table + of_others * share, message);
    let others = table1::other_kinds(kind, &row, told)?;
    sink.text("other_kinds.json", &asperity::output::json(&others)?)
}

/// Presses the surface of `scene` at all its scales and writes what `asperity scales` writes; `observer`
/// hears of the share that is done (0 to 1) and ends the work by `false`.
///
/// # Errors
/// A surface that cannot be made or pressed, a disk that refuses, an observer that ended the work.
pub fn press_scales(
    scene: &Scene,
    sink: &mut dyn Sink,
    observer: &mut (dyn FnMut(f64, &str) -> bool + Send),
) -> Result<(), Error> {
    let scene = RoughScene::new(scene.clone(), Path::new(""));
    let told = &mut |reached: &Progress<'_, f64>| {
        let cutoff = reached.news.map_or(0.0, |cutoff| cutoff / MICROMETRE);
        observer(reached.share, &format!("waves from {cutoff:.3} um"))
    };
    scales(&[scene], told)?.write(sink)
}
