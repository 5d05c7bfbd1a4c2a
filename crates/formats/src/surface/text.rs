//! Text: rows of heights, or points x y z of a regular grid in any order. The shape of a table is doubted:
//! a profile is no map.

use super::axes::{self, Axes};
use super::beside::{Others, take_invalid};
use super::described::Described;
use super::even::Step;
use super::marks;
use super::measured::{Measured, ReadError, Request, Spacing};
use super::names::OF_HEIGHTS;
use super::points::onto_grid;
use super::titled;
use crate::dimension::Dimension;
use crate::heights;
use crate::text::{
    Asked, Columns, DeclaredColumn, DeclaredUnit, Grid, Header, MINUS, Quantity, Separator, Tables,
    TextError, decode, folded_name, header_cells, read_grid, shortened, uncommented,
};
use std::path::Path;

/// Most columns of a list of points: behind x, y, z may stand a quality or colours.
const MOST_COLUMNS_OF_POINTS: usize = 8;
/// Rows per column from which a table of up to three columns is no map.
const ROWS_OF_NO_MAP: usize = 16;
/// Ratio of the sides of a pixel beyond which something is said of it.
const MOST_UNEQUAL_PIXELS: f64 = 3.0;
/// Rows from which a column that rises or falls all the way is no chance.
const ROWS_OF_A_PROFILE: usize = 4;

/// A coordinate of a list of points.
const fn coordinate(name: &'static str, called: &'static [&'static str], example: &'static str) -> Quantity {
    Quantity { name, dimension: Dimension::Length, called, example }
}

const POINT: [Quantity; 3] = [
    coordinate(
        "x",
        &["x", "x axis", "x position", "x coordinate", "pos x", "x pos", "x koordinate", "rechtswert"],
        "x_um",
    ),
    coordinate(
        "y",
        &["y", "y axis", "y position", "y coordinate", "pos y", "y pos", "y koordinate", "hochwert"],
        "y_um",
    ),
    coordinate(
        "z",
        &[
            "z",
            "z axis",
            "height",
            "z position",
            "z coordinate",
            "pos z",
            "z pos",
            "hohe",
            "hoehe",
            "hauteur",
        ],
        "z_um",
    ),
];

/// Reads a table of heights or a list of points, whichever its names and its shape say.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let (text, encoding) =
        decode(&data).map_err(|e| ReadError::Unknown { found: format!("the file {}", e.message) })?;
    let mut map = match titled::read(&text, request) {
        Some(known) => known?,
        None => read_table(path, &text, &encoding, request)?,
    };
    marks::refuse(&map.heights, request)?;
    let unequal = |[x, y]: [f64; 2]| x > MOST_UNEQUAL_PIXELS * y || y > MOST_UNEQUAL_PIXELS * x;
    if let Spacing::Metres([x, y]) = map.spacing
        && unequal([x, y])
    {
        map.notes.push(format!(
            "pixels of {x:.3e} m along x and {y:.3e} m along y are very unequal: look whether both are right"
        ));
    }
    Ok(map)
}

/// A minus before the names of x and y would turn nothing that a contact knows of.
fn refuse_turned_places(request: &Request<'_>) -> Result<(), ReadError> {
    for (key, name) in ["x", "y"].into_iter().zip(request.columns) {
        if let Some(name) = name.filter(|name| name.starts_with(MINUS)) {
            let name = name.trim_start_matches(MINUS);
            let problem = format!(
                "columns.{key}: a minus turns heights, not places: leave it out, {key} = \"{name}\"; a mirrored map has the same contact"
            );
            return Err(TextError::whole(problem).into());
        }
    }
    Ok(())
}

/// Reads rows of heights or of points.
fn read_table(path: &Path, text: &str, encoding: &str, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut grid = read_grid(text, request.missing_value, request.decimal)?;
    let mut notes = vec![format!("{encoding} {}", grid.describe())];
    let first = text.lines().nth(grid.lines[0] - 1).unwrap_or("");
    let said = Described::new(&grid, first, request)?;
    if let Some(columns) = said.columns_of_broken_rows(&grid) {
        notes.push(format!("each row of the map stands in {} lines", columns / grid.columns));
        (grid.columns, grid.parts) = (columns, None);
    }
    let is_xyz = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xyz"));
    refuse_turned_places(request)?;
    let turned = request.columns[2].is_some_and(|name| name.starts_with(MINUS));
    let columns = request.columns.map(|name| name.map(|name| name.trim_start_matches(MINUS)));
    let named = Asked { columns, may_lack_units: true, key: Some("columns"), ..Asked::default() };
    if !turned && !request.override_file {
        heights::refuse_depths(&grid.before)?;
    }
    if let Some(columns) = named_points(&grid, &named)? {
        notes.push(columns.said.clone());
        return points(grid, &columns, &said, request, notes).map(|map| turned_where(turned, map));
    }
    let (columns, rows) = (grid.columns, grid.rows());
    if is_xyz && columns < 3 {
        let problem = format!("{columns} numbers, a point has 3: x y z");
        return Err(TextError::new(grid.lines[0], problem).into());
    }
    let is_points =
        || (3..=MOST_COLUMNS_OF_POINTS).contains(&columns) && rows >= ROWS_OF_A_PROFILE && has_grid(&grid);
    if is_xyz || is_points() {
        if let Some(columns) = half_named_points(&grid, &named)? {
            notes.push(columns.said.clone());
            return points(grid, &columns, &said, request, notes);
        }
        refuse_numbered_points(&grid, request)?;
        notes.push("x, y, z from columns 1, 2, 3".into());
        let columns = numbered_points(&grid, &named)?;
        return points(grid, &columns, &said, request, notes);
    }
    refuse_profile(&grid, request.override_file)?;
    if let Some(Tables { count, size, are_beside }) = grid.parts.filter(|_| !request.override_file) {
        let (lines, what) =
            if are_beside { ("columns", "empty columns") } else { ("rows", "empty rows or notes") };
        let problem = format!(
            "holds {count} tables of {size} {lines}, which {what} part: keep one in a file, or set override = true if they are one"
        );
        return Err(TextError::new(grid.lines[0], problem).into());
    }
    let others = Others::new(&grid);
    let axes = axes::take(&mut grid)?.unwrap_or_default();
    others.refuse(grid.columns, request)?;
    if !axes.said.is_empty() {
        notes.push(axes.said.clone());
    }
    notes.extend(said.take_missing(grid.values.iter_mut()));
    said.refuse_factor(&grid.values, request)?;
    let (columns, rows) = (grid.columns, grid.rows());
    said.refuse_counts(columns, rows, request)?;
    let (spacing, doubt) = said.spacing([columns, rows], grid.empty_edges);
    notes.extend(said.notes(spacing.is_some()));
    notes.extend(doubt);
    let spacing_error = if spacing.is_some() { 0.0 } else { axes.error() };
    let spacing = spacing.or_else(|| spacing_of_places(&axes, &said)).unwrap_or(Spacing::Unknown);
    if spacing == Spacing::Unknown {
        let lengths = axes.lengths();
        let without_unit = || Some(places_without_unit("the places beside the map", lengths?));
        notes.extend(axes.doubt.or_else(without_unit));
    }
    let height_unit = said.height_unit.or(axes.height_unit);
    Ok(Measured { columns, rows, heights: grid.values, spacing, spacing_error, height_unit, notes })
}

/// The map with the sign of its heights turned where it is.
fn turned_where(is_turned: bool, mut map: Measured) -> Measured {
    if is_turned {
        map.heights.iter_mut().for_each(|z| *z = -*z);
        map.notes.push("the sign of z turned".into());
    }
    map
}

/// Distance of the points by the places beside them.
fn spacing_of_places(axes: &Axes, said: &Described) -> Option<Spacing> {
    let [x, y] = axes.lengths()?;
    match axes.lateral_unit.or(said.lateral_unit) {
        Some(unit) => Some(Spacing::Metres([x * unit, y * unit])),
        // a unit of everything is theirs, too; one of the heights is not
        None => (axes.doubt.is_none() && said.has_one_unit).then_some(Spacing::HeightUnits([x, y])),
    }
}

/// A remark on places, called `what`, whose unit nothing tells.
fn places_without_unit(what: &str, place: [f64; 2]) -> String {
    // the noise of sums of decimals is no digit
    let [x, y] = place.map(|x| format!("{x:.5e}").parse().unwrap_or(x));
    format!("{what} go on by {x} and {y} and name no unit: give it by pixel_size = \"{x} um\" or the like")
}

/// Units that words above the rows give to columns.
fn declared_units(grid: &Grid<'_>) -> Vec<DeclaredUnit> {
    grid.before.iter().flat_map(|(line, text)| DeclaredUnit::list(*line, text)).collect()
}

/// The names of Tecplot's `VARIABLES = "X [um]", "Y [um]", "Z [nm]"`, a blank between each.
fn tecplot_names(text: &str) -> Option<String> {
    let (key, names) = text.split_once('=')?;
    let names = names.split('"').skip(1).step_by(2).map(|name| name.replace(' ', ""));
    key.trim().eq_ignore_ascii_case("variables").then(|| names.collect::<Vec<_>>().join(" "))
}

/// The columns of x, y and z where a header or the request names them.
fn named_points(grid: &Grid<'_>, named: &Asked<'_, 3>) -> Result<Option<Columns<3>>, ReadError> {
    let declared = declared_units(grid);
    let of_tecplot = grid.before.iter().find_map(|(line, text)| Some((*line, tecplot_names(text)?)));
    if let Some((line, names)) = of_tecplot
        && let Some(header) = Header::new(&grid.dialect, line, &names, &POINT, named)
    {
        return Ok(Some(header.columns(&grid.dialect, &grid.filled(), &POINT, named, &declared)?));
    }
    let mut units = None;
    // names, perhaps a line that describes them, units
    let lines = grid.before.iter().rev().filter(|(_, line)| !line.is_empty()).take(3);
    for &(line, text) in lines {
        let text = uncommented(text);
        if let Some(header) = Header::new(&grid.dialect, line, text, &POINT, named) {
            let header = Header { units, ..header };
            let columns = header.columns(&grid.dialect, &grid.filled(), &POINT, named, &declared)?;
            if named.columns[2].is_none() {
                let cells = header_cells(&grid.dialect, text, Some(grid.columns));
                heights::refuse_several(line, &cells, columns.picks[0][2].column, named.key)?;
            }
            return Ok(Some(columns));
        }
        units.get_or_insert(text);
    }
    if named.columns.iter().all(Option::is_none) {
        return Ok(None);
    }
    let header = Header { line: grid.lines[0], text: "", units: None };
    Ok(Some(header.columns(&grid.dialect, &grid.filled(), &POINT, named, &declared)?))
}

/// First words of a column that counts rows.
const ROW: [&str; 6] = ["row", "line", "zeile", "ligne", "riga", "fila"];

/// Parts of names of what grows away from a sensor above the surface, as depths do.
const DISTANCES: [&str; 3] = ["distance", "abstand", "range"];

/// The columns of a header that calls the first two x and y, and the third by a name that z may have.
///
/// # Errors
/// Names of which nothing tells what they are.
fn half_named_points(grid: &Grid<'_>, named: &Asked<'_, 3>) -> Result<Option<Columns<3>>, ReadError> {
    let Some(&(line, text)) = grid.before.iter().rev().find(|(_, line)| !line.is_empty()) else {
        return Ok(None);
    };
    let text = uncommented(text);
    let cells = header_cells(&grid.dialect, text, Some(grid.columns));
    let is_x = |cell: &String| POINT[0].called.contains(&folded_name(cell).0.as_str());
    // three words of a title are no names
    let is_parted = grid.dialect.separator != Separator::Blanks || cells.first().is_some_and(is_x);
    let is_named = cells.iter().all(|cell| cell.contains(char::is_alphabetic));
    if cells.len() != grid.columns || !is_parted || !is_named {
        return Ok(None);
    }
    let is_down = |cell: &str| {
        let name = folded_name(cell).0;
        heights::DEPTHS.iter().chain(&DISTANCES).any(|word| name.contains(word))
    };
    let (name, unit) = folded_name(&cells[2]);
    let is_length = unit.is_some_and(|unit| Dimension::Length.scale(&unit).is_some());
    let third = Asked { columns: [None, None, Some("3")], ..*named };
    let header = Header::new(&grid.dialect, line, text, &POINT, &third);
    match header.filter(|_| (is_length || OF_HEIGHTS.contains(&name.as_str())) && !is_down(&cells[2])) {
        Some(header) => {
            heights::refuse_several(line, &cells, 2, named.key)?;
            Ok(Some(header.columns(&grid.dialect, &grid.filled(), &POINT, &third, &declared_units(grid))?))
        }
        None => {
            let minus = |cell: &str| if is_down(cell) { "-" } else { "" };
            let names: Vec<String> =
                cells.iter().take(3).map(|cell| format!("\"{}{}\"", minus(cell), shortened(cell))).collect();
            let first = folded_name(&cells[0]).0;
            let [x, y, z] = match first.split(' ').next().unwrap_or("") {
                // y counts rows
                word if ROW.contains(&word) => [1, 0, 2],
                word if OF_HEIGHTS.contains(&word) => [1, 2, 0],
                _ => [0, 1, 2],
            };
            let problem = format!(
                "names the columns {}, and not which are x, y and z: say columns = {{ x = {}, y = {}, z = {} }}, with a minus before the name of a depth or of a distance from a sensor",
                names.join(", "),
                names[x],
                names[y],
                names[z]
            );
            Err(TextError::new(line, problem).into())
        }
    }
}

/// Heights that are the same at every point, beside a column that varies: a plane and what stands off it.
fn refuse_level(grid: &Grid<'_>, places: [usize; 3]) -> Result<(), ReadError> {
    let varies = |column: usize| {
        let mut values = grid.values.iter().skip(column).step_by(grid.columns);
        let first = values.next();
        values.any(|value| Some(value) != first)
    };
    let other = || (0..grid.columns).find(|column| !places.contains(column) && varies(*column));
    let [x, y, z] = places.map(|column| column + 1);
    match other() {
        Some(other) if !varies(places[2]) => {
            let problem = format!(
                "the height, column {z}, is {} at every point: say which column holds it, like columns = {{ x = \"{x}\", y = \"{y}\", z = \"{}\" }}",
                grid.values[places[2]],
                other + 1
            );
            Err(TextError::new(grid.lines[0], problem).into())
        }
        _ => Ok(()),
    }
}

/// The first three columns as x, y and z.
fn numbered_points(grid: &Grid<'_>, named: &Asked<'_, 3>) -> Result<Columns<3>, ReadError> {
    let header = Header { line: 1, text: "", units: None };
    let named = Asked { columns: [Some("1"), Some("2"), Some("3")], ..*named };
    let mut declared = declared_units(grid);
    for unit in &mut declared {
        if let Some(k) = POINT.iter().position(|quantity| unit.column.is_called(quantity)) {
            unit.column = DeclaredColumn::Placed(k, grid.columns);
        }
    }
    Ok(header.columns(&grid.dialect, &grid.filled(), &POINT, &named, &declared)?)
}

/// Numbers of the row and the column of each point before its places: nothing tells which are x and y.
fn refuse_numbered_points(grid: &Grid<'_>, request: &Request<'_>) -> Result<(), ReadError> {
    if grid.columns < 5 || request.columns.iter().any(Option::is_some) {
        return Ok(());
    }
    let others: Vec<[f64; 3]> =
        grid.values.chunks_exact(grid.columns).map(|row| [row[2], row[3], row[4]]).collect();
    let is_level = others.iter().all(|point| point[2] == others[0][2]);
    let is_full =
        |heights: &[f64]| heights.len() == others.len() && heights.iter().all(|height| !height.is_nan());
    if is_level || !onto_grid(&others).is_ok_and(|placed| is_full(&placed.heights)) {
        return Ok(());
    }
    let problem = "columns 1 and 2 are places of a grid, and so are columns 3 and 4: say which are x, y and z, like columns = { x = \"3\", y = \"4\", z = \"5\" }";
    Err(TextError::new(grid.lines[0], problem).into())
}

/// The map through the points whose coordinates stand in `columns`.
fn points(
    mut grid: Grid<'_>,
    columns: &Columns<3>,
    said: &Described,
    request: &Request<'_>,
    mut notes: Vec<String>,
) -> Result<Measured, ReadError> {
    let picks = columns.picks[0];
    let place = |k: usize| picks[k].column;
    if (0..3).any(|k| place(k) >= grid.columns) {
        let problem = format!("{} numbers, but the header names more columns", grid.columns);
        return Err(TextError::new(grid.lines[0], problem).into());
    }
    notes.extend(take_invalid(&mut grid, [place(0), place(1), place(2)]));
    let mut points: Vec<[f64; 3]> = grid
        .values
        .chunks_exact(grid.columns)
        .map(|row| [row[place(0)], row[place(1)], row[place(2)]])
        .collect();
    if request.columns[2].is_none() {
        refuse_level(&grid, [place(0), place(1), place(2)])?;
    }
    let scales = [0, 1].map(|k| picks[k].scale);
    drop(grid.values);
    notes.extend(said.take_missing(points.iter_mut().map(|p| &mut p[2])));
    let placed = onto_grid(&points).map_err(|problem| TextError::new(grid.lines[0], problem))?;
    notes.extend(placed.note);
    let counts = placed.step == [1.0; 2] && points.iter().all(|p| p[0].fract() == 0.0 && p[1].fract() == 0.0);
    let (pixel, doubt) = said.spacing([placed.columns, placed.rows], [false; 2]);
    notes.extend(doubt);
    let spacing = match scales {
        // places that count pixels of a known size
        [None, None] if counts && pixel.is_some() => pixel.unwrap_or(Spacing::Unknown),
        [Some(x), Some(y)] => Spacing::Metres([placed.step[0] * x, placed.step[1] * y]),
        [None, None] => match said.lateral_unit {
            Some(unit) => Spacing::Metres(placed.step.map(|step| step * unit)),
            // numbers of pixels say nothing of their size
            None if counts => {
                notes.push("x and y without a unit count pixels".into());
                Spacing::Unknown
            }
            // a unit of the heights alone is none of x and y
            None if picks[2].scale.is_some() || said.height_unit.is_some() && !said.has_one_unit => {
                notes.push(places_without_unit("x and y", placed.step));
                Spacing::Unknown
            }
            None => {
                if !said.has_one_unit {
                    notes.push(
                        "x and y in the unit of the heights (else columns = { x = \"1 [mm]\", … })".into(),
                    );
                }
                Spacing::HeightUnits(placed.step)
            }
        },
        // "x, y (mm)" names the unit of both
        [Some(unit), None] | [None, Some(unit)] if !is_count(scales, placed.step) => {
            notes.push("one unit for x and y".into());
            Spacing::Metres(placed.step.map(|step| step * unit))
        }
        _ => return Err(TextError::whole("names the unit of one of x and y: name both, or none").into()),
    };
    if picks[2].scale.is_none() {
        said.refuse_factor(&placed.heights, request)?;
    }
    let height_unit = picks[2].scale.or(said.height_unit);
    notes.extend(said.notes(false));
    Ok(Measured {
        columns: placed.columns,
        rows: placed.rows,
        heights: placed.heights,
        spacing,
        spacing_error: placed.error,
        height_unit,
        notes,
    })
}

/// True where the one of x and y without a unit counts lines, and the other does not.
fn is_count(scales: [Option<f64>; 2], step: [f64; 2]) -> bool {
    let [bare, other] = if scales[0].is_none() { [0, 1] } else { [1, 0] };
    step[bare] == 1.0 && step[other] != 1.0
}

/// True where the first two columns are the places of a full grid.
fn has_grid(grid: &Grid<'_>) -> bool {
    let points: Vec<[f64; 3]> =
        grid.values.chunks_exact(grid.columns).map(|row| [row[0], row[1], row[2]]).collect();
    onto_grid(&points).is_ok_and(|placed| placed.heights.len() == points.len())
}

/// A column or a row of places beside one of heights is a profile; many rows of few columns are a list,
/// unless it `is_told` that they are a map.
fn refuse_profile(grid: &Grid<'_>, is_told: bool) -> Result<(), ReadError> {
    let (columns, rows) = (grid.columns, grid.rows());
    let is_monotone = |places: &[f64]| {
        places.len() >= ROWS_OF_A_PROFILE
            && (places.windows(2).all(|p| p[1] > p[0]) || places.windows(2).all(|p| p[1] < p[0]))
    };
    let first: Vec<f64> = grid.values.iter().step_by(columns).copied().collect();
    let along = columns == 2 && is_monotone(&first) || rows == 2 && is_monotone(&grid.values[..columns]);
    let problem = if columns.min(rows) == 1 && columns.max(rows) > 2 {
        "holds one row or column of numbers: this is a profile, a map has at least 2 x 2 points; if it is a map, say above it how many columns and rows it has, like Columns: 60 and Rows: 40".to_string()
    } else if along {
        "holds places and heights along a line: this is a profile x, z, not a map; `asperity crush` takes one with its summits as [[profile]] file, a single asperity as asperity.profile".into()
    } else if columns <= MOST_COLUMNS_OF_POINTS
        && rows >= ROWS_OF_NO_MAP * columns
        && (columns <= 3 || !is_told)
    {
        // a column that numbers the points is no place
        let is_numbered = columns > 3 && first.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
        let [x, y, z] = if is_numbered { [2, 3, 4] } else { [1, 2, 3] };
        let along = !is_numbered && is_monotone(&first) && Step::new(&first).is_some();
        format!(
            "has {columns} columns and {rows} rows, {}: name the columns of points by columns = {{ x = \"{x}\", y = \"{y}\", z = \"{z}\" }}{}",
            if along {
                "the first of which rises in even steps as places of profiles do: `asperity crush` takes one profile x, z as asperity.profile; if they are points instead"
            } else {
                "the shape of a list, not of a map"
            },
            if columns > 3 { ", or set override = true if it is a map" } else { "" }
        )
    } else {
        return Ok(());
    };
    Err(TextError::new(grid.lines[0], problem).into())
}
