//! The asperities of a map, the bodies of revolution of the highest of them, and lines.

use super::bodies::{Body, Line};
use super::rows::AsperityRow;
use super::scenes;
use super::settings::{Extraction, LineAt, Parts};
use crate::error::{Error, InputError};
use crate::results::numbers::digits;
use crate::results::output::row;
use crate::results::units::MICROMETRE;
use crate::rough::RoughScene;
use asperity_roughness::asperities::{
    Asperity, Direction, FindError, RadialProfile, Segmentation, find, line,
};
use asperity_roughness::scene::{Scene, SceneError};
use asperity_roughness::{Closure, ClosureLaw, Load, Surface, press, read_as};

/// Asperities and lines of a map.
#[derive(Clone, Debug)]
pub struct Extracted {
    /// Name of the map.
    pub name: String,
    /// The map as the scene levels and filters it.
    pub surface: Surface,
    /// The plane of the islands above the mean plane, m; none of hills.
    pub separation: Option<f64>,
    /// The closure that carries the pressure of the scene at that plane; none where the plane was given.
    pub closure: Option<Closure>,
    /// All asperities, from the highest down.
    pub asperities: Vec<Asperity>,
    /// Those with a profile and a scene.
    pub bodies: Vec<Body>,
    /// Lines with a profile and a scene.
    pub lines: Vec<Line>,
    /// One row an asperity: `asperities.csv`.
    pub table: Vec<AsperityRow>,
    /// Surface, metal and load as read.
    pub scene: Scene,
    /// Remarks on the trust in the numbers.
    pub warnings: Vec<String>,
}

row! {
    /// The content of `summary.json`.
    Summary(done: &Extracted) {
        /// Name of the map.
        surface: String = done.name.clone(),
        /// Interpretation of the file: dialect, columns, units, lines; and remarks on it.
        understood: Vec<String> = done.surface.notes.clone(),
        /// Points along x and y.
        pixels: [usize; 2] = [done.surface.map.columns(), done.surface.map.rows()],
        /// Distance of the points.
        pixel_size_um: [f64; 2] = done.surface.map.pixel().map(|p| p / MICROMETRE),
        /// Plane of islands above the mean plane; none of hills.
        separation_um: Option<f64> = done.separation.map(|s| s / MICROMETRE),
        /// The closure that carries the pressure of the scene at that plane; none where the plane was given.
        separation_closure: Option<Closure> = done.closure,
        /// Asperities found.
        asperities: usize = done.asperities.len(),
        /// Those that reach the edge of the map or a point that was not measured.
        cut: usize = done.asperities.iter().filter(|one| one.cut).count(),
        /// Asperities per area of the map (of hills: Spd of ISO 25178-2), 1/mm².
        density_per_mm2: f64 = done.asperities.len() as f64 / done.surface.nominal_area() * 1e-6,
        /// Mean over the asperities of the mean curvature of the summit (of hills: Spc of ISO 25178-2), 1/µm.
        mean_tip_curvature_per_um: Option<f64> = done.mean_tip_curvature().map(|c| c * MICROMETRE),
        /// Asperities with a profile and a scene.
        profiles: usize = done.bodies.len(),
        /// Lines with a profile and a scene.
        lines: usize = done.lines.len(),
        /// Remarks on the trust in the numbers.
        warnings: Vec<String> = done.warnings.clone(),
        /// Surface, material and load as read.
        scene: Scene = done.scene.clone(),
        /// Version of this program.
        version: String = env!("CARGO_PKG_VERSION").into(),
    }
}

/// Takes the asperities of the surface of `scene`, the bodies that stand for the highest of them, and lines.
///
/// # Errors
/// A scene that makes no sense, a surface that cannot be read, one without an asperity, a line beside it.
///
/// # Examples
/// ```
/// use asperity::RoughScene;
/// use asperity::extract::{Extraction, extract};
///
/// let text = include_str!("../../scenes/rough-sanded.toml");
/// let scene = RoughScene::from_toml(&text, std::path::Path::new(""))?;
/// let found = extract(&scene, &Extraction::default())?;
/// assert!(found.asperities.len() > found.bodies.len() && found.bodies[0].scene.contains("profile"));
/// # Ok::<(), asperity::Error>(())
/// ```
pub fn extract(scene: &RoughScene, wanted: &Extraction) -> Result<Extracted, Error> {
    wanted.check()?;
    scene.validate()?;
    let tables = scene.tables();
    let surface = scene.prepare_surface()?;
    let name = scene.surface_name();
    let (how, closure) = segmentation(scene, &surface, wanted.parts)?;
    let asperities = find(&surface, how).map_err(|e| not_found(&e))?;
    if asperities.is_empty() {
        return Err(InputError::new("no asperity was found above the plane: lower it").into());
    }
    let separation = match how {
        Segmentation::Islands { separation } => Some(separation),
        Segmentation::Hills { .. } => None,
    };
    let metal = &tables.material;
    let (mut table, mut bodies, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    for (i, one) in asperities.iter().enumerate() {
        let number = i + 1;
        let tried = (bodies.len() < wanted.bodies).then(|| body(&surface, number, one, wanted));
        let status = match &tried {
            Some(Ok(_)) => "ok".into(),
            Some(Err(reason)) => reason.clone(),
            None => String::new(),
        };
        let body = tried.and_then(Result::ok).map(|body| {
            let scene = scenes::of_body(&body, &name, wanted.accuracy, metal);
            Body { scene, ..body }
        });
        table.push(AsperityRow::new(number, one, body.as_ref(), status));
        bodies.extend(body);
    }
    if bodies.len() < wanted.bodies {
        let way_out = if bodies.is_empty() { way_out(&surface, wanted) } else { None };
        warnings.push(few(bodies.len(), wanted.bodies, &table) + &way_out.unwrap_or_default());
    }
    warnings.extend(long(&bodies));
    let lines = wanted.lines.iter().map(|at| {
        let line = take_line(&surface, at, separation, wanted)?;
        let scene = scenes::of_line(&line, &name, wanted.accuracy, metal);
        Ok(Line { scene, ..line })
    });
    let lines = lines.collect::<Result<Vec<_>, InputError>>()?;
    let scene = tables.clone();
    Ok(Extracted { name, surface, separation, closure, asperities, bodies, lines, table, scene, warnings })
}

/// The number of bodies, and the reason why there are not more.
fn few(found: usize, wanted: usize, table: &[AsperityRow]) -> String {
    let mut reasons: Vec<(String, usize)> = Vec::new();
    for row in table.iter().filter(|row| row.status != "ok" && !row.status.is_empty()) {
        let kind = without_numbers(&row.status);
        match reasons.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, count)) => *count += 1,
            None => reasons.push((kind, 1)),
        }
    }
    let why: Vec<String> = reasons.iter().map(|(kind, count)| format!("; {count}: {kind}")).collect();
    let have = if table.len() == 1 { "asperity has" } else { "asperities have" };
    format!("{found} of {} {have} a profile, {wanted} were asked for{}", table.len(), why.concat())
}

/// Rules that are tried where one leaves no profile: the higher the plane, the fewer islands reach the edge.
const RULES: [Parts; 7] = [
    Parts::Share(0.1),
    Parts::Share(0.05),
    Parts::Share(0.02),
    Parts::Share(0.01),
    Parts::Share(0.005),
    Parts::Hills(0.05),
    Parts::Hills(0.2),
];

/// The rule that gives the most profiles, to be asked for instead; none where no rule gives one.
fn way_out(surface: &Surface, wanted: &Extraction) -> Option<String> {
    let mut best = (0, None);
    for parts in RULES {
        let count = profiles_by(surface, &Extraction { parts, ..wanted.clone() });
        if count > best.0 {
            best = (count, Some(parts));
        }
    }
    let flag = match best.1? {
        Parts::Share(share) => format!("--share {share}"),
        Parts::Hills(prune) => format!("--hills {prune}"),
        Parts::Load(_) | Parts::Separation(_) => return None,
    };
    let profiles = if best.0 == 1 { "profile" } else { "profiles" };
    Some(format!("; {flag} would give {} {profiles}", best.0))
}

/// The number of profiles that there would be of those that are asked for.
fn profiles_by(surface: &Surface, wanted: &Extraction) -> usize {
    let how = match wanted.parts {
        Parts::Share(share) => {
            Segmentation::Islands { separation: plane_above(surface, share) - surface.parameters.mean }
        }
        Parts::Hills(prune) => Segmentation::Hills { prune },
        Parts::Load(_) | Parts::Separation(_) => return 0,
    };
    let found = find(surface, how).unwrap_or_default();
    found.iter().filter(|one| body(surface, 1, one, wanted).is_ok()).take(wanted.bodies).count()
}

/// A reason as it is for all that have it: they differ in numbers.
fn without_numbers(reason: &str) -> String {
    let number = |c: char| c.is_ascii_digit() || c == '.';
    let words = reason.split(' ').map(|word| if word.starts_with(number) { "…" } else { word });
    words.collect::<Vec<_>>().join(" ")
}

/// Length over width of half the area from which a body of revolution says little.
const LONG_ASPECT_RATIO: f64 = 3.0;

/// A doubt about bodies of revolution of long asperities; by area, for many small round ones carry little.
fn long(bodies: &[Body]) -> Option<String> {
    let shape =
        |body: &Body| body.asperity.ellipse.map(|e| (e.semi_axes[0] / e.semi_axes[1], body.asperity.area));
    let ratio = median_by_area(bodies.iter().filter_map(shape).collect())
        .filter(|ratio| *ratio > LONG_ASPECT_RATIO)?;
    Some(format!(
        "the asperities are ridges (half of their area is on ones at least {ratio:.1} times as long as wide), for which a body of \
         revolution says little: take a line across them, --line \"y=PLACE\" or --line \"x=PLACE\""
    ))
}

/// The value with half of the area at it or above; none of nothing.
fn median_by_area(mut shapes: Vec<(f64, f64)>) -> Option<f64> {
    shapes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let half = 0.5 * shapes.iter().map(|s| s.1).sum::<f64>();
    let mut above = 0.0;
    let reached = shapes.iter().find(|(_, area)| {
        above += area;
        above >= half
    });
    reached.map(|(ratio, _)| *ratio)
}

fn not_found(error: &FindError) -> InputError {
    let help = match error {
        FindError::Flat => "check units and levelling: surface.height_unit, surface.level",
        FindError::Above { .. } | FindError::Below { .. } => {
            "give --separation, --share 0.1 for the plane that a tenth of the points is above, or --hills"
        }
        FindError::Prune(_) => "for example --hills 0.05",
    };
    InputError::new(error.to_string()).help(help)
}

/// The rule that divides this surface into asperities, with the closure that says where its plane is.
fn segmentation(
    scene: &RoughScene,
    surface: &Surface,
    parts: Parts,
) -> Result<(Segmentation, Option<Closure>), InputError> {
    let mean = surface.parameters.mean;
    let mut carries = None;
    let separation = match parts {
        Parts::Hills(prune) => return Ok((Segmentation::Hills { prune }, None)),
        Parts::Separation(separation) => separation.0,
        Parts::Share(share) => plane_above(surface, share) - mean,
        Parts::Load(closure) => match (scene.tables().load.load().map_err(|e| scene.error(&e))?, closure) {
            (Load::Separation(separation), None) => separation,
            (Load::Separation(_), Some(closure)) => {
                let message = format!(
                    "the scene gives the plane, so that closure \"{}\" has no say in it",
                    closure.name()
                );
                let help = "leave --closure out, or give [load] pressure in place of separation";
                return Err(scene.error(&SceneError::new("load.separation", message)).help(help));
            }
            (load @ Load::Pressure(_), closure) => {
                let closure = closure.unwrap_or_else(|| first_of_islands(scene));
                carries = Some(closure);
                loaded(scene, surface, load, closure)?
            }
        },
    };
    Ok((Segmentation::Islands { separation }, carries))
}

/// The plane that a share of the measured points is above.
fn plane_above(surface: &Surface, share: f64) -> f64 {
    let mut heights: Vec<f64> = surface.map.heights().iter().copied().filter(|z| !z.is_nan()).collect();
    let k = ((1.0 - share) * heights.len() as f64) as usize;
    let k = k.min(heights.len().saturating_sub(1));
    *heights.select_nth_unstable_by(k, f64::total_cmp).1
}

/// The first closure of the scene that presses islands; the elastic cone where it names a half-space.
fn first_of_islands(scene: &RoughScene) -> Closure {
    let islands = scene.tables().closure.closures().into_iter().find(|c| !c.is_half_space());
    islands.unwrap_or(Closure::Sneddon)
}

/// The separation at which `closure` carries the load.
fn loaded(scene: &RoughScene, surface: &Surface, load: Load, closure: Closure) -> Result<f64, InputError> {
    let coefficient = scene.coefficient_of(&[closure])?;
    let wrong = |key: &str, message: String| scene.error(&SceneError::new(key, message));
    let law = ClosureLaw::new(closure, &scene.tables().material, coefficient.as_ref())
        .map_err(|e| wrong("closure", e.to_string()))?;
    let contact = press(surface, &law, load).map_err(|e| wrong("load.pressure", e.to_string()))?;
    Ok(contact.separation)
}

/// The body of revolution of an asperity, without its scene, or why there is none.
fn body(surface: &Surface, number: usize, one: &Asperity, wanted: &Extraction) -> Result<Body, String> {
    if one.cut {
        return Err("reaches the edge of the map or a point that was not measured".into());
    }
    let depth = wanted.depth.map_or_else(
        || match wanted.parts {
            // where two hills merge the lower one no longer stands alone
            Parts::Hills(_) => 0.5 * one.rise,
            _ => one.rise,
        },
        |depth| depth.0,
    );
    let profile = RadialProfile::around_summit(&surface.map, one.summit, depth).map_err(|e| e.to_string())?;
    Ok(Body { number, asperity: *one, profile, depth, scene: String::new() })
}

/// A line, without its scene.
fn take_line(
    surface: &Surface,
    wanted: &LineAt,
    separation: Option<f64>,
    settings: &Extraction,
) -> Result<Line, InputError> {
    let taken = line(&surface.map, wanted.direction, wanted.at.0)
        .map_err(|e| InputError::new(e.to_string()).help("for example --line \"y=0.1 mm\""))?;
    let heights = || taken.points.iter().map(|p| p[1]);
    let (low, high) = heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
    let across = if wanted.direction == Direction::X { "y" } else { "x" };
    let place = digits((taken.at / MICROMETRE * 1e3).round() * 1e-3);
    let name = format!("line-{across}-{place}um");
    // the plane of the islands, or a fifth of the height of the line where it lies above the line
    let to_plane = separation.map(|s| high - surface.parameters.mean - s).filter(|d| *d > 0.0);
    let depth = settings.depth.map(|d| d.0).or(to_plane).unwrap_or(0.2 * (high - low)).min(high - low);
    if depth.is_nan() || depth <= 0.0 {
        return Err(InputError::new(format!("the line {name} is flat: take another one")));
    }
    let points = taken.points.iter().map(|[x, z]| [x - taken.points[0][0], z - low]).collect();
    Ok(Line { name, direction: wanted.direction, at: taken.at, points, depth, scene: String::new() })
}

impl Extracted {
    /// Mean over the asperities of the mean curvature of the summit, 1/m; none where no summit has one.
    pub fn mean_tip_curvature(&self) -> Option<f64> {
        let all: Vec<f64> =
            self.asperities.iter().filter_map(|one| one.tip).map(|t| t.mean_curvature()).collect();
        (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
    }

    /// The numbers of all together: `summary.json`.
    pub fn summary(&self) -> Summary {
        Summary::new(self)
    }

    /// The result in a few lines.
    pub fn text(&self) -> String {
        let s = self.summary();
        let plane = s.separation_um.map_or("hills of ISO 25178-2".into(), |d| {
            let plane =
                format!("islands above a plane {} µm over the mean", digits((d * 1e4).round() * 1e-4));
            let pressure = self.scene.load.pressure.map_or(f64::NAN, |p| p.in_unit("MPa"));
            self.closure.map_or_else(
                || plane.clone(),
                |c| format!("{plane}, where closure \"{}\" carries {pressure} MPa", c.name()),
            )
        });
        let [nx, ny] = s.pixels;
        let mut text = read_as(&s.understood);
        text += &format!(
            "{}: {nx} x {ny} points; {} {} ({plane}), {} of them cut by an edge or a hole; {:.4} per mm²\n",
            s.surface,
            s.asperities,
            if s.asperities == 1 { "asperity" } else { "asperities" },
            s.cut,
            s.density_per_mm2
        );
        text += &format!("{} profiles and scenes of asperities, {} of lines", s.profiles, s.lines);
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_round_asperities_do_not_hide_a_ridge() {
        let crumbs = std::iter::repeat_n((1.2, 1.0), 20);
        assert_eq!(median_by_area(crumbs.clone().chain([(8.0, 100.0)]).collect()), Some(8.0));
        assert_eq!(median_by_area(crumbs.chain([(8.0, 10.0)]).collect()), Some(1.2));
        assert_eq!(median_by_area(Vec::new()), None);
    }
}
