//! Files of imprints: a profile (`r_um,z_um`), or a map, of which the radial mean about its centre is taken.
//!
//! Instruments write them as they like: a line that begins at its end and is tilted, a list of points for a
//! map, heights that count down. What a file does not say is [asked](Reading) of its user.

use crate::far_field::tail;
use crate::imprint::FARTHEST_RADII;
use crate::imprint_columns::{Table, unknown_columns};
use crate::imprint_level::{LEVEL_RADII, level};
use crate::imprint_profile::{Profile, line, profile};
use crate::rings::Ring;
use asperity_formats::surface::{self, Measured, Request, Spacing};
use asperity_formats::units::Length;
use asperity_numerics::least_squares;
use std::path::Path;

/// Statements of the user on a file beside its name.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading<'a> {
    /// Distance of the points of a map that does not say it, m.
    pub pixel: Option<[f64; 2]>,
    /// Unit of the heights of a map that does not say it.
    pub height_unit: Option<&'a str>,
    /// True where the heights count down.
    pub is_down: bool,
}

/// Share by which a size has to differ from that of the file to contradict it.
const LEAST_DIFFERENCE: f64 = 1e-4;

impl Reading<'_> {
    /// Metres of the unit of heights that is stated.
    fn unit(&self) -> Result<Option<f64>, String> {
        let of = |name| {
            let unit = Length::UNITS.iter().find(|(unit, _)| *unit == name);
            unit.map(|(_, metres)| *metres)
                .ok_or_else(|| format!("has no heights in \"{name}\": give height_unit, like \"nm\""))
        };
        self.height_unit.map(of).transpose()
    }

    /// Refuses what is stated on a map where the file is a table with a `unit` of its heights.
    fn refuse_of_a_table(&self, unit: f64) -> Result<(), String> {
        if self.pixel.is_some() {
            return Err("says the places of its heights: remove pixel_size, which is of a map".into());
        }
        refuse_other("height_unit", Some(unit), self.unit()?, LEAST_DIFFERENCE)
    }
}

/// Refuses a `given` size that differs from the one that the file tells by more than `share`.
fn refuse_other(key: &str, told: Option<f64>, given: Option<f64>, share: f64) -> Result<(), String> {
    match (told, given) {
        (Some(told), Some(given)) if (given / told - 1.0).abs() > share => Err(format!(
            "says {}, but {key} is {}: remove the key, or correct the file",
            Length(told),
            Length(given)
        )),
        _ => Ok(()),
    }
}

/// Contact radii to which ring means have to reach, that their end tells the height of the ground.
const GROUND_RADII: f64 = 3.0;
/// Rings of a radial mean over one contact radius: a wide one would blunt the rim.
const RINGS: f64 = 160.0;

/// An imprint as a file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct ImprintRead {
    /// Place and height, m.
    pub points: Vec<[f64; 2]>,
    /// The rings of a map of which the heights are means; empty of a profile.
    pub rings: Vec<Ring>,
    /// Interpretation of the file.
    pub understood: String,
}

/// The imprint in the file at `path`, for a contact of about `radius`; `text` is its content with its
/// encoding where it is text.
///
/// # Errors
/// The reason why it is none, with a way out.
pub fn read(
    path: &Path,
    text: Option<(&str, &str)>,
    radius: f64,
    reading: Reading<'_>,
) -> Result<ImprintRead, String> {
    let of_map = || map(path, radius, reading).map_err(|no_map| without_keys(&no_map));
    let Some((text, encoding)) = text else { return of_map() };
    let as_text = |Profile { points, understood }| {
        let understood = format!("{encoding} text: {understood}");
        ImprintRead { points, rings: Vec::new(), understood }
    };
    match Table::new(text) {
        Ok(Table::Profile(table)) => {
            reading.refuse_of_a_table(table.scales[1])?;
            profile(table, radius, reading.is_down).map(as_text)
        }
        Ok(Table::Points(table)) => of_map().or_else(|no_map| {
            reading.refuse_of_a_table(table.scales[2])?;
            let beside = format!("{no_map}; nor do the points lie on one line");
            let problem = if no_map.starts_with(UNSAID) { no_map } else { beside };
            line(table, radius, reading.is_down).unwrap_or(Err(problem)).map(as_text)
        }),
        Err(no_profile) => match unknown_columns(text, &no_profile) {
            Some(unknown) => Err(unknown),
            None => of_map().map_err(|no_map| {
                if no_map.starts_with(UNSAID) || no_map.starts_with("says ") {
                    no_map
                } else {
                    format!("is no profile ({no_profile}), and no map: {no_map}")
                }
            }),
        },
    }
}

/// The way out for an imprint in place of setting keys of a surface.
const WAYS: [(&str, &str); 4] = [
    ("override = ", ""),
    ("missing_value = ", ": write nan in its place"),
    ("columns = {", ": head the columns of points x_um,y_um,z_um"),
    ("decimal = ", ": write a point before decimals"),
];

/// The message on a map in terms of an imprint, which has fewer keys than a surface.
fn without_keys(message: &str) -> String {
    let mut message = message.to_string();
    for (key, way) in WAYS {
        let Some(at) = message.find(key) else { continue };
        let start = [": ", ", or "].iter().filter_map(|mark| message[..at].rfind(mark)).max();
        message.truncate(start.unwrap_or(at));
        message += way;
    }
    message
}

/// The beginning of the message on a map of which too little is known.
const UNSAID: &str = "is a map that does not say ";

/// The message on a map whose file does not say its pixel size, the unit of its heights, or both.
fn unsaid(lacks_pixel: bool, lacks_unit: bool) -> String {
    let lacking = [
        (lacks_pixel, "its pixel size", "pixel_size = \"0.5 um\""),
        (lacks_unit, "the unit of its heights", "height_unit = \"nm\""),
    ];
    let lacking = lacking.into_iter().filter(|(is_lacking, ..)| *is_lacking);
    let (what, keys): (Vec<_>, Vec<_>) = lacking.map(|(_, what, key)| (what, key)).unzip();
    format!(
        "{UNSAID}{}: say {}, imprint = {{ file = …, {} }}, or export it in a format that does (.x3p, .sur, .sdf, .gwy), or as a \
         profile r_um,z_um",
        what.join(" and "),
        if what.len() > 1 { "them" } else { "it" },
        keys.join(", ")
    )
}

/// Those of the radial mean of a map.
fn map(path: &Path, radius: f64, reading: Reading<'_>) -> Result<ImprintRead, String> {
    let mut measured = surface::read(path, &Request::default()).map_err(|e| e.to_string())?;
    let asked = reading.unit()?;
    let unit = measured.height_unit.or(asked);
    let told = match (measured.spacing, unit) {
        (Spacing::Metres(pixel), _) => Some(pixel),
        (Spacing::HeightUnits(pixel), Some(unit)) => Some(pixel.map(|p| p * unit)),
        _ => None,
    };
    refuse_other("height_unit", measured.height_unit, asked, LEAST_DIFFERENCE)?;
    let share = measured.spacing_error.max(LEAST_DIFFERENCE);
    for k in [0, 1] {
        refuse_other("pixel_size", told.map(|p| p[k]), reading.pixel.map(|p| p[k]), share)?;
    }
    let pixel = told.or(reading.pixel);
    let (Some(pixel), Some(unit)) = (pixel, unit) else {
        let in_height_units = matches!(measured.spacing, Spacing::HeightUnits(_));
        return Err(unsaid(pixel.is_none() && !in_height_units, unit.is_none()));
    };
    if reading.is_down {
        for z in &mut measured.heights {
            *z = -*z;
        }
    }
    let missing = measured.heights.iter().filter(|z| !z.is_finite()).count();
    let understood = format!(
        "map of {} × {} points {:.4} um apart, heights in {}{}, its radial mean about the middle of the hole",
        measured.columns,
        measured.rows,
        1e6 * pixel[0],
        Length(unit).to_string().trim_start_matches("1 "),
        if missing > 0 { format!(", {missing} of them missing") } else { String::new() }
    );
    let (points, rings) = radial_mean(&measured, pixel, unit, radius)?;
    Ok(ImprintRead { points, rings, understood })
}

/// Mean heights over rings about the middle of the hole, levelled by a plane through what lies far from it,
/// and the rings.
fn radial_mean(
    measured: &Measured,
    pixel: [f64; 2],
    unit: f64,
    radius: f64,
) -> Result<(Vec<[f64; 2]>, Vec<Ring>), String> {
    let mut points: Vec<[f64; 3]> = (0..measured.heights.len())
        .map(|k| {
            let [x, y] = [k % measured.columns, k / measured.columns].map(|i| i as f64);
            [x * pixel[0], y * pixel[1], measured.heights[k] * unit]
        })
        .filter(|p| p[2].is_finite())
        .collect();
    let middle = level(&mut points, radius, |_| 1.0, |p| [1.0, p[0] / radius, p[1] / radius])?;
    let width = radius / RINGS;
    let mut rings: Vec<Ring> = Vec::new();
    for p in &points {
        let [x, y] = [p[0] - middle[0], p[1] - middle[1]];
        let r = x.hypot(y);
        let k = (r / width) as usize;
        if k >= rings.len() {
            rings.resize(k + 1, Ring::default());
        }
        rings[k].take(r, y.atan2(x), p[2]);
    }
    rings.retain(|ring| ring.mean().is_some());
    let mut means: Vec<[f64; 2]> = rings.iter().filter_map(Ring::mean).collect();
    let ground = ground(&means, radius);
    for mean in &mut means {
        mean[1] -= ground;
    }
    Ok((means, rings))
}

/// Height to which ring means tend beyond the end of the pile-up, which the plane through what lies far from
/// the hole has taken for level; 0 where they do not reach so far that they tell it.
fn ground(means: &[[f64; 2]], radius: f64) -> f64 {
    let far = || means.iter().filter(|p| p[0] > LEVEL_RADII * radius && p[0] < FARTHEST_RADII * radius);
    let reach = far().map(|p| p[0]).fold(0.0, f64::max);
    let rows: Vec<_> = far().map(|p| ([1.0, tail(p[0], radius)], p[1], 1.0)).collect();
    match least_squares::solve(&rows) {
        Some([ground, _]) if reach > GROUND_RADII * radius => ground,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone of depth 1 um and radius 5 um on a tilted map, its middle between the points: the mean over
    /// rings is the cone, to what a ring of an eighth of a micrometre blurs.
    #[test]
    fn the_radial_mean_of_a_tilted_cone_is_the_cone() {
        let (columns, rows, pixel) = (161, 141, 0.2e-6);
        let middle = [15.33e-6, 13.71e-6];
        let heights = (0..columns * rows).map(|k| {
            let [x, y] = [(k % columns) as f64 * pixel, (k / columns) as f64 * pixel];
            let r = (x - middle[0]).hypot(y - middle[1]);
            (0.2e-6 * r / 1e-6 - 1e-6).min(0.0) + 0.02 * x - 0.01 * y + 3e-6
        });
        let measured = Measured {
            columns,
            rows,
            heights: heights.collect(),
            spacing: Spacing::Metres([pixel; 2]),
            spacing_error: 0.0,
            height_unit: Some(1.0),
            notes: Vec::new(),
        };
        let (mean, _) = radial_mean(&measured, [pixel; 2], 1.0, 5e-6).unwrap();
        for [r, z] in mean.iter().filter(|p| p[0] < 12e-6) {
            let cone = (0.2 * r - 1e-6).min(0.0);
            assert!((z - cone).abs() < 0.02e-6, "{r:e} {z:e} {cone:e}");
        }
    }

    #[test]
    fn a_message_on_a_map_names_no_key_that_an_imprint_lacks() {
        for (of_a_surface, of_an_imprint) in [
            (
                "holds -9999 at 9 points, where nothing was measured: set missing_value = -9999, or override = true if it is a height",
                "holds -9999 at 9 points, where nothing was measured: write nan in its place",
            ),
            (
                "line 2: names Q beside heights: delete what holds none, or set override = true if all are",
                "line 2: names Q beside heights: delete what holds none",
            ),
            (
                "the shape of a list: name the columns of points by columns = { x = \"1\" }, or set override = true if it is a map",
                "the shape of a list: head the columns of points x_um,y_um,z_um",
            ),
        ] {
            assert_eq!(without_keys(of_a_surface), of_an_imprint);
        }
    }
}
