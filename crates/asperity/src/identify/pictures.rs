//! Pictures of an identification: measured points with fit and residual, the stress-strain band, the map of
//! the objective.

use crate::draw::axis::Axis;
use crate::draw::chart::{Chart, Dash, FINE_PIXELS, INK, Sample, Series, axes, draw, framed, rgb, titled};
use crate::draw::palette::{self, Colour, LINES, VIRIDIS, interpolated};
use asperity_identification::experiment::{Data, Experiment};
use asperity_identification::levenberg_marquardt::{Minimum, chi2};
use asperity_identification::numbers::StressAt;
use asperity_identification::objective::Objective;
use asperity_identification::parameters::Unknowns;
use asperity_identification::profile_likelihood::{GROWTH, Interval};
use plotters::prelude::*;
use rayon::prelude::*;

/// Width of the axes, heights of the curves and of their residuals, in pixels.
const SIZE: (u32, [u32; 2]) = (540, [380, 240]);
/// Cells of the map along each unknown.
const CELLS: usize = 61;

/// One measurement as it is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
struct One {
    name: String,
    /// Depth (µm) and force (N) that were measured; empty of features.
    measured: Vec<[f64; 2]>,
    /// The fit.
    fitted: Vec<[f64; 2]>,
    /// Residuals of loading and unloading, of features, or of an imprint.
    left: Vec<Left>,
    /// Heights of the imprint over the distance from the axis (µm), measured and fitted.
    imprint: [Vec<[f64; 2]>; 2],
}

/// Residuals that are drawn together.
#[derive(Clone, Debug, Default, PartialEq)]
struct Left {
    /// Depth (of features: their number; of an imprint: distance from the axis, µm) and residual, % (of
    /// unloading and imprint: of the deepest depth).
    points: Vec<[f64; 2]>,
    /// Outline of twice their expected standard deviation.
    band: Vec<[f64; 2]>,
}

impl Left {
    /// Residuals at the places `at` with their expected standard `deviations`, both as shares.
    fn new(at: impl Iterator<Item = f64>, differences: &[f64], deviations: &[f64]) -> Left {
        let mut rows: Vec<[f64; 3]> =
            at.zip(differences).zip(deviations).map(|((x, d), s)| [x, 100.0 * d, 200.0 * s]).collect();
        rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let upper = rows.iter().map(|[x, _, s]| [*x, *s]);
        let lower = rows.iter().rev().map(|[x, _, s]| [*x, -s]);
        Left { points: rows.iter().map(|[x, d, _]| [*x, *d]).collect(), band: upper.chain(lower).collect() }
    }
}

/// The map of the objective.
#[derive(Clone, Debug, PartialEq)]
struct Map {
    names: [String; 2],
    /// Places of the cells along both unknowns.
    places: [Vec<f64>; 2],
    /// Growth of the sum of squares, row by row of the second unknown.
    growth: Vec<f64>,
    best: [f64; 2],
}

/// Contents of the pictures.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drawn {
    ones: Vec<One>,
    map: Option<Map>,
}

impl Drawn {
    /// The measurements and the map at `best`.
    pub fn new(
        objective: &Objective<'_>,
        experiments: &[Experiment],
        unknowns: &Unknowns,
        best: &Minimum,
        intervals: &[Interval],
    ) -> Drawn {
        let mut number = 0;
        let ones = experiments.iter().filter_map(|e| one(e, unknowns, &best.point, &mut number)).collect();
        let map = (unknowns.parameters.len() > 1).then(|| map(objective, unknowns, best, intervals));
        Drawn { ones, map }
    }

    /// Measured points, fit and residuals, as SVG.
    ///
    /// # Errors
    /// A text for a person where the drawing library fails.
    pub fn curves(&self) -> Result<String, String> {
        let legend = self.names(|one| one.imprint[0].is_empty());
        stacked("Measurements, their fit and its residuals", legend, self.forces(), &self.left())
    }

    /// Measured and fitted imprints and their residuals, as SVG; `None` without one.
    ///
    /// # Errors
    /// A text for a person where the drawing library fails.
    pub fn imprints_svg(&self) -> Result<Option<String>, String> {
        let (Some(heights), Some(left)) = (self.imprints(), self.imprints_left()) else { return Ok(None) };
        let mut legend = self.names(|one| !one.imprint[0].is_empty());
        legend.push(("fit".into(), Sample::Line(INK, [1, 0])));
        stacked("Imprints, their fit and its residuals", legend, Some(heights), &left).map(Some)
    }

    /// Names and colours of the measurements that `are_drawn`.
    fn names(&self, are_drawn: impl Fn(&One) -> bool) -> Vec<(String, Sample)> {
        let drawn = self.ones.iter().enumerate().filter(|(_, one)| are_drawn(one));
        drawn.map(|(i, one)| (one.name.clone(), Sample::Line(rgb(colour(i)), [1, 0]))).collect()
    }

    /// Measured points and fit; `None` of features alone.
    pub fn forces(&self) -> Option<Chart> {
        let points = || self.ones.iter().flat_map(|one| one.measured.iter().chain(&one.fitted));
        self.ones.iter().find(|one| !one.measured.is_empty())?;
        let most = points().map(|p| p[1]).fold(0.0, f64::max);
        let (scale, unit) = if most < 0.1 { (1e3, "mN") } else { (1.0, "N") };
        let scaled = |points: &[[f64; 2]]| points.iter().map(|p| [p[0], scale * p[1]]).collect();
        let curves = self.ones.iter().enumerate().filter(|(_, one)| !one.measured.is_empty());
        let lines = curves.flat_map(|(i, one)| {
            let fitted = Series::line(format!("{}, fit", one.name), scaled(&one.fitted));
            let measured = Series::line(format!("{}, measured", one.name), scaled(&one.measured));
            [
                Series { colour: Some(colour(i)), ..fitted },
                Series { colour: Some(colour(i)), dash: Some(Dash::Hidden), ..measured }.marked(),
            ]
        });
        Some(Chart::new("Depth h (µm)", format!("Force F ({unit})"), lines))
    }

    /// Measured and fitted imprints; `None` without one.
    pub fn imprints(&self) -> Option<Chart> {
        let with_one = || self.ones.iter().enumerate().filter(|(_, one)| !one.imprint[0].is_empty());
        with_one().next()?;
        let lines = with_one().flat_map(|(i, one)| {
            let [measured, fitted] = one.imprint.clone();
            let fitted = Series::line(format!("{}, fit", one.name), fitted);
            let measured = Series::line(format!("{}, measured", one.name), measured);
            [
                Series { colour: Some(colour(i)), dash: Some(Dash::Hidden), ..measured }.marked(),
                // over the dots, in a colour of no measurement
                Series { colour: Some(palette::INK), ..fitted },
            ]
        });
        Some(Chart::new("Distance from the axis r (µm)", "Height z (µm)", lines).titled("The imprint"))
    }

    /// Residuals of the curves and features.
    pub fn left(&self) -> Chart {
        let drawn = self.ones.iter().any(|one| !one.measured.is_empty());
        let over = if drawn { "Depth h (µm)" } else { "Feature" };
        self.residuals(over, |one| one.imprint[0].is_empty())
    }

    /// Residuals of the imprints; `None` without one.
    pub fn imprints_left(&self) -> Option<Chart> {
        self.ones.iter().find(|one| !one.imprint[0].is_empty())?;
        Some(self.residuals("Distance from the axis r (µm)", |one| !one.imprint[0].is_empty()))
    }

    /// Residuals of the measurements that `are_drawn`, each over the band in which they are expected.
    fn residuals(&self, over: &str, are_drawn: impl Fn(&One) -> bool) -> Chart {
        let drawn = self.ones.iter().enumerate().filter(|(_, one)| are_drawn(one));
        let dots = drawn.flat_map(|(i, one)| {
            one.left.iter().map(move |left| {
                let line = Series::line(one.name.clone(), left.points.clone());
                let band = left.band.clone();
                Series { colour: Some(colour(i)), dash: Some(Dash::Hidden), band, ..line }.marked()
            })
        });
        Chart::new(over, "measured less fitted (%)", dots)
    }

    /// The map of the sum of squares over two unknowns, as SVG.
    ///
    /// # Errors
    /// A text for a person where the drawing library fails.
    pub fn map(&self) -> Result<Option<String>, String> {
        self.map.as_ref().map(draw_map).transpose()
    }
}

/// Measurements above their residuals, with one legend, as SVG.
fn stacked(
    title: &str,
    mut legend: Vec<(String, Sample)>,
    upper: Option<Chart>,
    lower: &Chart,
) -> Result<String, String> {
    let (width, [upper_height, lower_height]) = SIZE;
    legend.push(("pale: where 95 % of them are expected".into(), Sample::Heading));
    let height = lower_height + if upper.is_some() { upper_height } else { 0 };
    let drawn = framed((width, height), &legend, |paper| {
        let Some(upper) = upper else { return draw(lower, paper).map(|_| ()) };
        let (top, bottom) = paper.split_vertically(upper_height * FINE_PIXELS);
        draw(&upper, &top)?;
        draw(lower, &bottom).map(|_| ())
    })?;
    Ok(titled(title, drawn))
}

/// The colour of measurement `i`.
fn colour(i: usize) -> Colour {
    LINES[i % LINES.len()]
}

/// Standard deviations that are expected of the differences, noise and finite elements together.
fn deviations(experiment: &Experiment, unknowns: &Unknowns, point: &[f64]) -> Option<Vec<f64>> {
    let of_the_model = experiment.model_deviations(unknowns, point)?;
    let factor = experiment.covariance(unknowns, point)?.factor(of_the_model)?.l();
    Some(factor.row_iter().map(|row| row.norm()).collect())
}

fn one(experiment: &Experiment, unknowns: &Unknowns, point: &[f64], number: &mut usize) -> Option<One> {
    let differences = experiment.differences(unknowns, point, false)?;
    let deviations = deviations(experiment, unknowns, point)?;
    let shown = |p: &[f64; 2]| [1e6 * p[0], p[1]];
    let name = experiment.label.clone();
    match &experiment.data {
        Data::Imprint(imprint) => {
            let fitted = experiment.imprint_heights(unknowns, point)?;
            let shown = |p: &[f64; 2]| [1e6 * p[0], 1e6 * p[1]];
            let measured: Vec<[f64; 2]> = imprint.points.iter().map(shown).collect();
            let fitted = measured.iter().zip(fitted).map(|(p, z)| [p[0], 1e6 * z]).collect();
            let left = Left::new(measured.iter().map(|p| p[0]), &differences, &deviations);
            Some(One { name, left: vec![left], imprint: [measured, fitted], ..One::default() })
        }
        Data::Features { .. } | Data::ImprintNumbers(_) => {
            let left = differences.iter().zip(&deviations).map(|(d, s)| {
                *number += 1;
                Left { points: vec![[*number as f64, 100.0 * d]], band: bar(*number as f64, 200.0 * s) }
            });
            Some(One { name, left: left.collect(), ..One::default() })
        }
        Data::Curve(measured) => {
            let [load, back] = experiment.curve(unknowns, point, measured.peak)?;
            let turn = measured.loading.len();
            let depths = |points: &'_ [[f64; 2]]| points.iter().map(|p| 1e6 * p[0]).collect::<Vec<_>>();
            let loading = depths(&measured.loading).into_iter();
            let unloading = depths(&measured.unloading).into_iter();
            let left = vec![
                Left::new(loading, &differences[..turn], &deviations[..turn]),
                Left::new(unloading, &differences[turn..], &deviations[turn..]),
            ];
            Some(One {
                name,
                measured: measured.loading.iter().chain(&measured.unloading).map(shown).collect(),
                fitted: load.iter().chain(&back).map(shown).collect(),
                left,
                ..One::default()
            })
        }
    }
}

/// Outline of the band of one number at place `x`.
fn bar(x: f64, half: f64) -> Vec<[f64; 2]> {
    let [left, right] = [x - 0.2, x + 0.2];
    vec![[left, half], [right, half], [right, -half], [left, -half]]
}

/// The map over the two widest unknowns of the metal around the best fit.
fn map(objective: &Objective<'_>, unknowns: &Unknowns, best: &Minimum, intervals: &[Interval]) -> Map {
    let mut order: Vec<usize> = (0..unknowns.of_the_metal().max(2).min(unknowns.parameters.len())).collect();
    let share = |i: usize| (intervals[i].ends[1] - intervals[i].ends[0]) / unknowns.parameters[i].width();
    order.sort_by(|a, b| share(*b).total_cmp(&share(*a)));
    let pair = [order[0].min(order[1]), order[0].max(order[1])];
    let places = pair.map(|i| {
        let (parameter, [low, high]) = (&unknowns.parameters[i], intervals[i].ends);
        let room = (0.3 * (high - low)).max(0.01 * parameter.width());
        let [low, high] = [(low - room).max(parameter.bounds[0]), (high + room).min(parameter.bounds[1])];
        (0..CELLS).map(|k| low + (high - low) * k as f64 / (CELLS - 1) as f64).collect::<Vec<f64>>()
    });
    let growth = (0..CELLS * CELLS).into_par_iter().map(|k| {
        let mut point = best.point.clone();
        (point[pair[0]], point[pair[1]]) = (places[0][k % CELLS], places[1][k / CELLS]);
        chi2(objective, &point) - best.chi2
    });
    let growth = growth.collect();
    let named = |i: usize| {
        let p = &unknowns.parameters[i];
        if p.unit.is_empty() { p.name.clone() } else { format!("{} ({})", p.name, p.unit) }
    };
    Map {
        names: pair.map(named),
        growth,
        best: pair.map(|i| unknowns.parameters[i].shown(best.point[i])),
        places: [0, 1].map(|k| places[k].iter().map(|x| unknowns.parameters[pair[k]].shown(*x)).collect()),
    }
}

/// Standard deviations at which the colours of the map end.
const DARKEST_DEVIATIONS: f64 = 6.0;

fn draw_map(map: &Map) -> Result<String, String> {
    let (width, [height, _]) = SIZE;
    let swatch = |sigma: f64| rgb(interpolated(&VIRIDIS, 1.0 - (sigma / DARKEST_DEVIATIONS).min(1.0)));
    let square = vec![(-9, -9), (9, -9), (9, 9), (-9, 9)];
    let square: Vec<(i32, i32)> =
        square.into_iter().map(|(x, y)| (x * FINE_PIXELS as i32, y * FINE_PIXELS as i32)).collect();
    let mut legend: Vec<(String, Sample)> = [0.0, 1.0, 2.0, 4.0, 6.0]
        .iter()
        .map(|s| (format!("{s} standard deviations"), Sample::Mark(swatch(*s), square.clone())))
        .collect();
    legend.push(("95 %, the others held".into(), Sample::Line(INK, [1, 0])));
    let drawn = framed((width, height), &legend, |paper| {
        let ends = [0, 1].map(|k| [map.places[k][0], map.places[k][CELLS - 1]]);
        let [x, y] = ends.map(Axis::spanning);
        let mut area = axes(paper, [x, y], [&map.names[0], &map.names[1]])?;
        let edge = |k: usize, i: usize| {
            let places = &map.places[k];
            let [before, after] = [places[i.saturating_sub(1)], places[(i + 1).min(CELLS - 1)]];
            (0.5 * (before + places[i]), 0.5 * (places[i] + after))
        };
        let cells = (0..CELLS * CELLS).filter(|k| map.growth[*k].is_finite()).map(|k| {
            let ((left, right), (low, high)) = (edge(0, k % CELLS), edge(1, k / CELLS));
            let sigma = map.growth[k].max(0.0).sqrt();
            Rectangle::new([(left, low), (right, high)], swatch(sigma).filled())
        });
        let corners = [(ends[0][0], ends[1][0]), (ends[0][1], ends[1][1])];
        area.draw_series(std::iter::once(Rectangle::new(corners, swatch(DARKEST_DEVIATIONS).filled())))?;
        area.draw_series(cells)?;
        for line in contour(map, GROWTH) {
            area.draw_series(LineSeries::new(line, INK.stroke_width(FINE_PIXELS)))?;
        }
        area.draw_series(std::iter::once(Cross::new(
            (map.best[0], map.best[1]),
            6 * FINE_PIXELS,
            INK.stroke_width(2 * FINE_PIXELS),
        )))?;
        Ok(())
    })?;
    Ok(titled("How well the measurements tell two unknowns apart", drawn))
}

/// Pieces of the line along which the growth is `level`: across each cell, between the sides that it cuts.
fn contour(map: &Map, level: f64) -> Vec<Vec<(f64, f64)>> {
    let at = |i: usize, j: usize| map.growth[j * CELLS + i] - level;
    let place = |i: usize, j: usize| (map.places[0][i], map.places[1][j]);
    let mut pieces = Vec::new();
    for j in 0..CELLS - 1 {
        for i in 0..CELLS - 1 {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let cuts = (0..4).filter_map(|k| {
                let (a, b) = (corners[k], corners[(k + 1) % 4]);
                let (f, g) = (at(a.0, a.1), at(b.0, b.1));
                let share = f / (f - g);
                (f.is_finite() && g.is_finite() && (f > 0.0) != (g > 0.0)).then(|| {
                    let (p, q) = (place(a.0, a.1), place(b.0, b.1));
                    (p.0 + share * (q.0 - p.0), p.1 + share * (q.1 - p.1))
                })
            });
            let cuts: Vec<_> = cuts.collect();
            pieces.extend(cuts.chunks_exact(2).map(<[_]>::to_vec));
        }
    }
    pieces
}

/// The stress-strain curve with its band; of a metal that does not fit without one.
pub fn stress_strain(rows: &[StressAt], fits: bool) -> Chart {
    let axes = ["Plastic strain (%)", "True stress (MPa)"];
    let line = rows.iter().map(|r| [100.0 * r.plastic_strain, r.value_MPa]).collect();
    let upper = rows.iter().map(|r| [100.0 * r.plastic_strain, r.high_MPa]);
    let lower = rows.iter().rev().map(|r| [100.0 * r.plastic_strain, r.low_MPa]);
    let ends =
        |pick: fn(&StressAt) -> f64| rows.iter().map(|r| [100.0 * r.plastic_strain, pick(r)]).collect();
    if !fits {
        let nearest = Series::line("nearest metal", line);
        return Chart::new(axes[0], axes[1], [nearest])
            .titled("The nearest stress-strain curve; no metal fits");
    }
    let series = [
        Series { band: upper.chain(lower).collect(), ..Series::line("best fit", line) },
        Series { colour: Some(LINES[5]), ..Series::line("95 % interval", ends(|r| r.high_MPa)) },
        Series { colour: Some(LINES[5]), ..Series::line("95 % interval", ends(|r| r.low_MPa)) },
    ];
    Chart::new(axes[0], axes[1], series).titled("The stress-strain curve that fits, with its 95 % band")
}
