//! The maps of a joint pressed one after the other, by the same loads.

use super::summary::Summary;
use super::table::{JointRow, Seal};
use crate::crush::Phase;
use crate::error::{Error, InputError};
use crate::progress::Progress;
use crate::results::units::MEGAPASCAL;
use crate::rough::tables::{Choice, Scene, SceneError};
use crate::rough::{Passage, RoughScene, half_space_of, scene_warnings};
use asperity_roughness::half_space::{HalfSpace, HalfSpaceError, PressureLimit};
use asperity_roughness::joint::{
    Conductors, Fits, Flow, JointError, JointPath, JointPoint, Law, bounds, follow, largest_pressure, loads,
};
use asperity_roughness::{HeightMap, Load, Surface};
use std::time::Instant;

/// Loads of which the leak is found, unless the scene asks for all or none.
const LEAK_LOADS: usize = 5;

/// The law of a joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Loading and unloading: `joint.csv`.
    pub rows: Vec<JointRow>,
    /// Fits, errors and what was pressed: `joint.json`.
    pub summary: Summary,
    /// Pressure over approach as a curve; none where too few loads touch.
    pub law: Option<Law>,
}

/// One map of a joint, pressed.
struct PressedMap {
    surface: Surface,
    path: JointPath,
    /// Of each load of the loading, first touch left out.
    flows: Vec<Flow>,
}

/// The metal of a joint.
struct Metal {
    body: HalfSpace,
    limit: Option<PressureLimit>,
    warnings: Vec<String>,
}

/// Presses the surfaces of `scenes`, which are maps of one surface, from first touch to the load of the first
/// scene, or where it has none to the end of the metal or of the gap, and back.
///
/// `observer` is asked before each load, whose pressure (Pa) is its news; `false` ends the run.
///
/// # Errors
/// A scene that makes no sense, a surface that cannot be read, maps of different sizes, a load that touches
/// nothing or is beyond the limit of pressure, a run that was ended.
pub fn joint(
    scenes: &[RoughScene],
    observer: &mut dyn FnMut(&Progress<'_, f64>) -> bool,
) -> Result<Joint, Error> {
    let start = Instant::now();
    let Some(scene) = scenes.first() else {
        return Err(InputError::new("no surface was given").help("give a scene or a map of heights").into());
    };
    scenes.iter().try_for_each(|scene| scene.tables().validate_joint().map_err(|e| scene.error(&e)))?;
    let whole = scenes.iter().map(RoughScene::prepare_surface).collect::<Result<Vec<_>, _>>()?;
    same_size(scenes, &whole)?;
    let tables = scene.tables();
    let range = left_out(scene, &whole[0]);
    let surfaces = places(scene, whole)?;
    let asked = tables.load.of_joint().map_err(|e| scene.error(&e))?;
    let metal = metal(scene, &surfaces[0], asked)?;
    let refused = |e: JointError| Error::from(scene.error(&SceneError::new(place(&e), e)));
    // one that is given holds for all; else the map that closes first ends the joint
    let largest = surfaces
        .iter()
        .map(|surface| largest_pressure(&metal.body, surface, asked))
        .try_fold(f64::INFINITY, |least, found| Ok::<_, JointError>(least.min(found?)))
        .map_err(refused)?;
    let pressures = loads(largest, tables.joint.loads());
    let all = pressures.len() * surfaces.len();
    let mut maps: Vec<PressedMap> = Vec::new();
    for surface in surfaces {
        let done = maps.len() * pressures.len();
        let mut tell = |i: usize| observer(&Progress::counted(done + i, all, pressures.get(i)));
        maps.push(press_map(&metal.body, tables, surface, &pressures, &mut tell).map_err(refused)?);
        if maps.last().is_some_and(|map| map.path.stopped) {
            let text = "stopped before the last load: nothing was written; the same command begins anew";
            return Err(Error::Unfinished(text.into()));
        }
    }
    let mut found = evaluate(scenes, &metal, &maps, range).ok_or_else(|| refused(JointError::NoTouch))?;
    found.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(found)
}

/// The maps that are pressed: those given, or their tiles.
fn places(scene: &RoughScene, whole: Vec<Surface>) -> Result<Vec<Surface>, InputError> {
    let Some(count) = scene.tables().joint.tiles.filter(|count| *count > 1) else { return Ok(whole) };
    let mut places = Vec::new();
    for surface in whole {
        let mut tiles = surface.tiles(count).map_err(|e| scene.error(&SceneError::new("joint.tiles", e)))?;
        let mut notes = surface.notes;
        notes.push(format!(
            "the map is cut into {} tiles of {} x {} points: heights, areas and pressures are of a tile",
            tiles.len(),
            tiles[0].map.columns(),
            tiles[0].map.rows()
        ));
        tiles[0].notes = notes;
        places.extend(tiles);
    }
    Ok(places)
}

/// The key that an error is about.
fn place(error: &JointError) -> &'static str {
    match error {
        JointError::Flat => "surface",
        JointError::HalfSpace(HalfSpaceError::Closed { .. }) => "load.separation",
        JointError::HalfSpace(HalfSpaceError::Limit { .. }) => "load.pressure",
        JointError::HalfSpace(_) => "half_space",
        JointError::NoTouch => "load",
    }
}

/// Several maps are of one surface only if they are alike.
fn same_size(scenes: &[RoughScene], surfaces: &[Surface]) -> Result<(), InputError> {
    let size = |map: &HeightMap| ([map.columns(), map.rows()], map.pixel());
    let words = |map: &HeightMap| {
        let ([nx, ny], [dx, dy]) = (size(map).0, map.pixel().map(|p| p * 1e6));
        format!("{nx} x {ny} points of {dx:.6} x {dy:.6} um")
    };
    let alike = |a: &HeightMap, b: &HeightMap| {
        let ([p, q], [r, s]) = (a.pixel(), b.pixel());
        size(a).0 == size(b).0 && (p / r - 1.0).abs() < 1e-6 && (q / s - 1.0).abs() < 1e-6
    };
    let first = &surfaces[0].map;
    match surfaces.iter().position(|surface| !alike(&surface.map, first)) {
        None => Ok(()),
        Some(i) => Err(InputError::new(format!(
            "the maps of a joint must be of one size: {} has {}, {} has {}",
            scenes[0].name(),
            words(first),
            scenes[i].name(),
            words(&surfaces[i].map)
        ))
        .help("cut or measure them alike, or make a joint of each")),
    }
}

/// The half-space that the scene asks for: elastic, or with the limit of pressure of its metal.
fn metal(scene: &RoughScene, surface: &Surface, load: Option<Load>) -> Result<Metal, InputError> {
    let tables = scene.tables();
    let mut warnings = Vec::new();
    if !matches!(tables.closure, Choice::HalfSpace | Choice::HalfSpacePlastic | Choice::All) {
        warnings.push(
            "closures of islands leave no gap: the joint is that of the half-space, with the limit of pressure of the metal where it is \
             known"
                .into(),
        );
    }
    let known = || -> Result<Option<PressureLimit>, InputError> {
        // without a load the patches are those of half of the metal at its limit
        let most = tables.material.limit().map(|limit| Load::Pressure(0.5 * limit));
        let Some(load) = load.or(most) else { return Ok(None) };
        Ok(PressureLimit::on_surface(&tables.material, scene.hardening_law()?, surface, load))
    };
    let limit = if tables.closure == Choice::HalfSpace { None } else { known()? };
    if limit.is_none() && tables.closure == Choice::HalfSpacePlastic {
        let message = "\"half-space-plastic\" needs hardness or yield_stress in [material]: add it, or choose \"half-space\"";
        return Err(scene.error(&SceneError::new("closure", message)));
    }
    let body = half_space_of(tables, limit.map(|limit| limit.pressure));
    Ok(Metal { body, limit, warnings })
}

/// One map through all loads; `tell` hears of each load before it.
fn press_map(
    body: &HalfSpace,
    tables: &Scene,
    surface: Surface,
    pressures: &[f64],
    tell: &mut dyn FnMut(usize) -> bool,
) -> Result<PressedMap, JointError> {
    let count = pressures.len();
    let leaks = |i: usize| match tables.half_space.leak {
        Some(asked) => asked,
        // evenly among the loads, the last of them included
        None => (1..=LEAK_LOADS).any(|k| (k * count).div_ceil(LEAK_LOADS) == i),
    };
    let mut flows = Vec::new();
    tell(0);
    let path = follow(body, &surface, pressures, &mut |i, found| {
        flows.push(flow(&Passage::both(body, &surface, found, leaks(i))?, leaks(i)));
        Ok(tell(i))
    })?;
    Ok(PressedMap { surface, path, flows })
}

fn flow(passages: &[Passage; 2], flows: bool) -> Flow {
    let known = |passage: Passage| passage.leak.map(|leak| leak.error).filter(|error| error.is_finite());
    Flow {
        critical_gaps: passages.map(|passage| passage.narrowest.map(|place| place.gap)),
        critical_widths: passages.map(|passage| passage.narrowest.map(|place| place.width)),
        leaks: passages.map(|passage| passage.conductance(flows)),
        errors: passages.map(known),
    }
}

/// Height range of the roughness that a map does not hold, in m: as the scene says, else what its filter took
/// off.
fn left_out(scene: &RoughScene, surface: &Surface) -> Option<f64> {
    let tables = scene.tables();
    if let Some(range) = tables.joint.left_out {
        return Some(range.0);
    }
    tables.surface.s_filter?;
    let raw = crate::rough::tables::SurfaceScene { s_filter: None, ..tables.surface.clone() };
    let raw = raw.prepare(|path| scene.resolve(path)).ok()?;
    if raw.map.heights().len() != surface.map.heights().len() {
        return None;
    }
    let differences = raw.map.heights().iter().zip(surface.map.heights()).map(|(a, b)| a - b);
    let known = differences.filter(|d| d.is_finite());
    let (low, high) = known.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| (l.min(d), h.max(d)));
    (high >= low).then_some(high - low)
}

/// Rows and summary of the maps that were pressed, which leave out a `range` (m) of heights; None of no map.
fn evaluate(scenes: &[RoughScene], metal: &Metal, maps: &[PressedMap], range: Option<f64>) -> Option<Joint> {
    let (scene, surface) = (scenes.first()?, &maps.first()?.surface);
    let tables = scene.tables();
    let paths: Vec<JointPath> = maps.iter().map(|map| map.path.clone()).collect();
    let path = JointPath::mean(&paths)?;
    let law = Law::new(&path.loading);
    let elastic = metal.body.limit.is_none();
    let bounded = |point: &JointPoint| {
        // what flows does not get stiffer with every load
        let (law, range) = law.as_ref().zip(range).filter(|_| elastic)?;
        (point.pressure > 0.0).then(|| bounds(law, range, point.pressure))
    };
    let conductors = Conductors {
        thermal: tables.thermal.map(|bodies| bodies.conductors()),
        electrical: tables.electrical.map(|bodies| bodies.conductors()),
        reduced_modulus: metal.body.reduced_modulus,
    };
    let seal = Seal::new(tables.fluid.as_ref(), &surface.map);
    let loading = path.loading.iter().enumerate().map(|(i, point)| {
        let flow = i.checked_sub(1).map(|i| Flow::mean(maps.iter().map(|map| &map.flows[i])));
        JointRow::new(Phase::Load, point, &conductors, &seal, flow.unwrap_or_default(), bounded(point))
    });
    let back =
        |point: &JointPoint| JointRow::new(Phase::Unload, point, &conductors, &seal, Flow::default(), None);
    let rows: Vec<JointRow> = loading.chain(path.unloading.iter().map(back)).collect();
    let names = scenes.iter().map(RoughScene::surface_name).collect();
    let mut summary = Summary::new(names, surface, tables, &path, Fits::new(&path.loading));
    summary.limit_MPa = metal.limit.map(|limit| limit.pressure / MEGAPASCAL);
    summary.limit_error = metal.limit.map(|limit| limit.error);
    // maps of one instrument are read alike
    summary.understood = maps.iter().flat_map(|map| map.surface.notes.clone()).collect();
    summary.understood.dedup();
    summary.left_out_um = range.map(|range| range * 1e6);
    // the surface and its metal are looked at as those of a half-space
    let closure = if elastic { Choice::HalfSpace } else { Choice::HalfSpacePlastic };
    let own = scene_warnings(surface, &Scene { closure, ..tables.clone() });
    summary.warnings = metal.warnings.iter().cloned().chain(own).collect();
    // of another joint, a part of the work is flow or a dent of the body
    let stores_all = elastic && surface.map.periodic() && surface.map.missing() == 0 && maps.len() == 1;
    let stored = path.loading.last().map(|last| last.elastic_work / path.nominal_area);
    summary.energy_error =
        law.as_ref().zip(stored).filter(|_| stores_all).map(|(law, stored)| law.work() / stored - 1.0);
    summary.tell(&rows, law.as_ref(), &seal, elastic);
    Some(Joint { rows, summary, law })
}
