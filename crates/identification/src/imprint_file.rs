//! Files of imprints: a profile (`r_um,z_um`), or a map, of which the radial mean about its centre is taken.

use asperity_formats::dimension::Dimension;
use asperity_formats::surface::{self, Measured, Request, Spacing};
use asperity_formats::text::{Asked, Quantity, read_series};
use asperity_numerics::least_squares;
use std::path::Path;

/// Distance from the axis, negative on its other side.
const PLACE: Quantity = Quantity {
    name: "place r",
    dimension: Dimension::Length,
    called: &["r", "x", "radius", "distance", "position", "abstand", "rayon", "lateral"],
    example: "r_um",
};

/// Height over the far field.
const HEIGHT: Quantity = Quantity {
    name: "height z",
    dimension: Dimension::Length,
    called: &["z", "height", "profile", "hohe", "hoehe", "profil", "hauteur", "altezza", "altura"],
    example: "z_um",
};

/// Share of the depth of the deepest point below which a point of a map belongs to the hole, whose middle is
/// the axis.
const HOLE_SHARE: f64 = 0.4;
/// Contact radii from which a map is levelled.
const LEVEL_RADII: f64 = 2.0;
/// Rings of a radial mean over one contact radius.
const RINGS: f64 = 40.0;

/// Points (m) of the imprint in the text `text` of a profile, and what was understood.
///
/// # Errors
/// The reason why it is none.
pub fn profile(text: &str) -> Result<(Vec<[f64; 2]>, String), String> {
    let table = read_series(text, &[PLACE, HEIGHT], &Asked::default()).map_err(|e| e.to_string())?;
    let points = table.series.into_iter().next().map(|series| series.rows).unwrap_or_default();
    Ok((points, table.understood))
}

/// Radial mean (m) of the imprint in the map at `path`, for a contact of about `radius`, and what was
/// understood.
///
/// # Errors
/// The reason why it is none, with a way out.
pub fn map(path: &Path, radius: f64) -> Result<(Vec<[f64; 2]>, String), String> {
    let measured = surface::read(path, &Request::default()).map_err(|e| e.to_string())?;
    let (pixel, unit) = match (measured.spacing, measured.height_unit) {
        (Spacing::Metres(pixel), Some(unit)) => (pixel, unit),
        (Spacing::HeightUnits(pixel), Some(unit)) => (pixel.map(|p| p * unit), unit),
        _ => {
            return Err("is a map that does not say its pixel size and the unit of its heights: export it in a format that does (.x3p, .sur, .sdf, .gwy), or as a profile r_um,z_um".into());
        }
    };
    let said = format!(
        "map of {} × {} points {:.4} um apart, its radial mean about the middle of the hole",
        measured.columns,
        measured.rows,
        1e6 * pixel[0]
    );
    Ok((radial_mean(&measured, pixel, unit, radius)?, said))
}

/// Mean heights over rings about the middle of the hole, levelled by a plane through what lies far from it.
fn radial_mean(
    measured: &Measured,
    pixel: [f64; 2],
    unit: f64,
    radius: f64,
) -> Result<Vec<[f64; 2]>, String> {
    let mut points: Vec<[f64; 3]> = (0..measured.heights.len())
        .map(|k| {
            let [x, y] = [k % measured.columns, k / measured.columns].map(|i| i as f64);
            [x * pixel[0], y * pixel[1], measured.heights[k] * unit]
        })
        .filter(|p| p[2].is_finite())
        .collect();
    // a slope of the whole map comes first, so that its lower side is no hole; then the hole has no say
    for round in 0..3 {
        let centre = if round == 0 { None } else { Some(centre(&points)?) };
        let far = |p: &&[f64; 3]| {
            centre.is_none_or(|c: [f64; 2]| (p[0] - c[0]).hypot(p[1] - c[1]) > LEVEL_RADII * radius)
        };
        let rows: Vec<_> =
            points.iter().filter(far).map(|p| ([1.0, p[0] / radius, p[1] / radius], p[2], 1.0)).collect();
        let plane = least_squares::solve(&rows).filter(|_| rows.len() > 20).ok_or_else(|| {
            format!(
                "shows too little beside the imprint to level it: it has to reach beyond {LEVEL_RADII} contact radii, {:.3} um",
                1e6 * LEVEL_RADII * radius
            )
        })?;
        for p in &mut points {
            p[2] -= plane[0] + (plane[1] * p[0] + plane[2] * p[1]) / radius;
        }
    }
    let middle = centre(&points)?;
    let width = radius / RINGS;
    let mut rings: Vec<(f64, [f64; 2])> = Vec::new();
    for p in &points {
        let r = (p[0] - middle[0]).hypot(p[1] - middle[1]);
        let k = (r / width) as usize;
        if k >= rings.len() {
            rings.resize(k + 1, (0.0, [0.0; 2]));
        }
        let ring = &mut rings[k];
        *ring = (ring.0 + 1.0, [ring.1[0] + r, ring.1[1] + p[2]]);
    }
    Ok(rings.iter().filter(|r| r.0 > 0.0).map(|(n, sum)| sum.map(|s| s / n)).collect())
}

/// Middle of the hole, weighted by its depth.
fn centre(points: &[[f64; 3]]) -> Result<[f64; 2], String> {
    let lowest = points.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
    let mut sums = [0.0; 3];
    for p in points {
        let weight = (HOLE_SHARE * lowest - p[2]).max(0.0);
        sums = [sums[0] + weight, sums[1] + weight * p[0], sums[2] + weight * p[1]];
    }
    if sums[0].is_nan() || sums[0] <= 0.0 {
        return Err("shows no hole: heights count up, the imprint lies below the surface around it".into());
    }
    Ok([sums[1] / sums[0], sums[2] / sums[0]])
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
            height_unit: Some(1.0),
            notes: Vec::new(),
        };
        let mean = radial_mean(&measured, [pixel; 2], 1.0, 5e-6).unwrap();
        for [r, z] in mean.iter().filter(|p| p[0] < 12e-6) {
            let cone = (0.2 * r - 1e-6).min(0.0);
            assert!((z - cone).abs() < 0.02e-6, "{r:e} {z:e} {cone:e}");
        }
    }
}
