//! Every column of every table and every key of every summary, from the types that write them.

use super::markdown::{code, table, words};
use asperity::Identification;
use asperity::calibrate::{AngleFit, Fit};
use asperity::calibration::row::{CaseRow, Row};
use asperity::calibration::sweep::Sweep;
use asperity::columns::{Column, Described};
use asperity::crush::{
    AsperityRow, CurveRow, CycleRow, Errors, GapRow, Island, OliverPharr, Smoothing, Summary, SurfacePoint,
};
use asperity::extract;
use asperity::joint;
use asperity::rough;
use asperity::scales;
use asperity::tables::Symmetry;
use asperity::trade::TradeRow;
use schemars::schema_for;

const CRUSH: &str = "Lengths are in µm, forces in N, pressures in MPa, energies in µJ; in axisymmetry they are of the full body of \
    revolution. In plane strain they are per millimetre of ridge, under the last name. A key that a scene gives no rise to, or that a \
    run did not reach, is `null`.";

const FOLDER: &str = "`asperity crush` also writes `curve.svg`, the force over the depth. With `[output] fields`: `fields.pvd` opens \
    all increments in ParaView; `fields_NNNN.vtu` holds stress, displacement and the rest at the nodes, averaged from the integration \
    points, and `plastic_zone` of each cell (0 never yielded, 1 has yielded, 2 yields in this increment): z is the height and t or, in \
    plane strain, y the direction out of the plane, which the file draws in its plane x, y; `section_NNNN.svg` shows them at the peak. Ctrl-C ends a run with what it has reached.";

const STUDY: &str = "`results.csv` has a row per run, in the order of the plan: the varied keys as the scene has them, every number of \
    the run's summary under its key (those of a table behind its name and a point, `errors.force`; of a rough scene with several \
    closures behind the closure's name, `sneddon.contact_area_ratio`), `status` (`ok`, or the reason why there is no result or not the \
    whole one), and `curve`, the file of its curve, where curves are kept. A number that a run does not have is an empty cell. The \
    bytes are the same on any number of threads, in parts, and after a stop. `times.csv` has the seconds of each run and the largest \
    memory of its process until then. `study.svg` shows one result over one or two keys. `study.json` says what was varied, with the \
    scene, and `study.journal` holds the finished runs, from which a study goes on.";

const ROUGH: &str = "`contact.vti` holds the maps of all closures for ParaView, compressed, `pressure-CLOSURE.png` and `contact-CLOSURE.png` show them, \
    `load_curve.svg` and `pressure_histogram.svg` compare the closures. `--table1 --out DIR` leaves `table1.txt`, the printed text, and \
    `table1.json`: for each surface the row as printed (µm, degrees, MPa, %) and, for each closure, the values of the five seeds of \
    every column.";

const SCALES: &str = "`spectrum.csv` is that of `asperity rough`; `spectrum.svg`, `slope.svg`, `area.svg`, `pressure.svg`, `gap.svg`, `leak.svg` and \
     `regimes.svg` show the scales.";

const JOINT: &str = "`calculix.inp` and `abaqus.inp` hold `*SURFACE INTERACTION` with its tables, ready to be included by a deck in N, mm, K; \
    `moose.csv` holds the same in SI for piecewise functions. Their heads say what made them, where the overclosure is 0, and what goes \
    beyond the last row. `pressure.svg`, `stiffness.svg` and, with `[thermal]`, `conductance.svg` show the law with its errors.";

const IDENTIFY: &str = "A measurement is a curve, or the imprint of one. `material.toml` holds the best values as the `[material]` of a scene, which `asperity \
    crush --metal fit.json` takes as well; `posterior.csv` samples of the posterior, one column an unknown in the units of `parameters`; \
    `curve.svg`, `imprint.svg`, `stress_strain.svg` and `objective.svg` show data and fit.";

const REPORT: &str = "`crush`, `calibrate`, `rough`, `joint`, `scales` and `identify` with `--report` leave `report.html` as well: a page that needs no \
    network, with the numbers and their errors first, the warnings, and curves that tell the value under the pointer.";

/// The page.
pub fn page() -> String {
    let mut text = String::from(
        "# Columns and keys of the results\n\nEvery folder of results holds text that any program reads: tables as CSV, summaries as JSON. \
         Units stand in the names. `errors` and `force_error` are bounds meant for 95 % of scenes ([how often they hold](../verified/errors.md)), against this program's own \
         limit of fine meshes and steps: see [errors](../theory/errors.md).\n\n",
    );
    text += &format!("{REPORT}\n\n## asperity crush\n\n{CRUSH}\n\n");
    text += &of_crush::<CurveRow>("curve.csv", "a row per converged increment");
    text += &of_crush::<Summary>("summary.json", "the numbers of the run");
    text += &of_crush::<Errors>("summary.json: `errors`", "bounds of the errors");
    text += &of_crush::<OliverPharr>(
        "summary.json: `oliver_pharr`",
        "an instrument's reading, under a tool that is no plane, with unloading",
    );
    text += &of_crush::<Smoothing>("summary.json: `outlines`", "what was made of a measured outline");
    text += &of_crush::<Island>("summary.json: `elastic_islands`", "regions that never yielded");
    text += &of_crush::<AsperityRow>("asperities.csv", "the share of each of several asperities");
    text += &of_crush::<GapRow>("gaps.csv", "untouched surface between two contacts");
    text +=
        &of_crush::<CycleRow>("cycles.csv", "a row per loading with its unloading, where the scene reloads");
    text += &of_crush::<SurfacePoint>(
        "surface_NNNN.csv",
        "the free surface, from the axis outward, with `[output] fields`; `surfaces.csv` holds those of all increments, with the number \
         of the increment first. After unloading the last one is the imprint (`every = 1000` writes little else)",
    );
    text += &format!("{FOLDER}\n\n## asperity calibrate\n\n");
    text += &of_cases();
    text += &file_columns::<Fit>("fit.json", "the representative strain and its coefficient");
    text += &file_columns::<AngleFit>("fit.json: `per_angle`", "one slope");
    text += "`coefficient.toml` is what `asperity rough` reads; `collapse.svg` and `representative_strain.svg` show both.\n\n";
    text += "## asperity rough\n\n";
    text += &file_columns::<rough::TableRow>("table.csv", "a row per closure");
    text += &file_columns::<rough::LoadPoint>("load_curve.csv", "the load curve of each closure");
    text += &file_columns::<rough::Summary>(
        "summary.json",
        "the surface after levelling and filtering, and every closure",
    );
    text += &file_columns::<rough::ClosureSummary>(
        "summary.json: `closures`",
        "beside the columns of `table.csv`",
    );
    text += &format!("{ROUGH}\n\n## asperity joint\n\n");
    text += &file_columns::<joint::JointRow>("joint.csv", "a row per load, of several maps their mean");
    text += &file_columns::<joint::Summary>("joint.json", "fits, errors and what was pressed");
    text += &file_columns::<joint::LawRow>("joint.json: `law`", "the table that programs take");
    text += &file_columns::<joint::ExponentialFit>("joint.json: `fit_pressure`", "pressure over mean gap");
    text += &file_columns::<joint::PowerFit>(
        "joint.json: `fit_stiffness`, `fit_conductance`",
        "over the pressure in MPa",
    );
    text += &format!("{JOINT}\n\n## asperity scales\n\n");
    text += &of_scales();
    text += &format!("{SCALES}\n\n## asperity extract\n\n");
    text += &file_columns::<extract::AsperityRow>(
        "asperities.csv",
        "a row per asperity, from the highest summit down",
    );
    text += &file_columns::<extract::ComparedRow>(
        "compared.csv",
        "a row per asperity, depth and closure, the finite elements among them",
    );
    text += &file_columns::<extract::Summary>("summary.json", "the map and what was found on it");
    text += &format!("## asperity identify\n\n{}{IDENTIFY}\n\n", of_identify());
    text += &format!("## asperity study\n\n{STUDY}\n\n## asperity trade\n\n");
    text += &file_columns::<TradeRow>("trade.csv", "a row per setting");
    text
}

/// The files of `asperity scales`.
fn of_scales() -> String {
    let mut text = String::new();
    text += &file_columns::<scales::ScaleRow>("scales.csv", "a row per cut-off and closure");
    text += &file_columns::<scales::SlopeRow>("slopes.csv", "a row per cut-off");
    text += &file_columns::<scales::Summary>("summary.json", "verdicts, fits and what was pressed");
    text += &file_columns::<scales::VerdictRow>("summary.json: `verdicts`", "the verdict on one quantity");
    text += &file_columns::<scales::IntervalRow>(
        "summary.json: `hurst`, `rolloff_um`, `shortest_um`",
        "an interval",
    );
    text
}

/// The keys of the `fit.json` of `asperity identify`, from the types that write it.
fn of_identify() -> String {
    let schema = schema_for!(Identification).to_value();
    let keys = |file: &str, about: &str, of: &serde_json::Value| {
        let described = of["properties"].as_object().into_iter().flatten();
        let rows = described.map(|(name, value)| {
            vec![code(name), words(value["description"].as_str().unwrap_or_default().trim())]
        });
        heading(file, about) + &table(&["name", "meaning"], rows)
    };
    let parts = [
        ("fit.json: `parameters`", "each unknown", "Found"),
        ("fit.json: `branches` of an unknown", "each of several metals that fit", "Branch"),
        ("fit.json: `stress_strain`, `representative`", "a point of the stress-strain curve", "StressAt"),
        ("fit.json: `residual`", "how well the best metal explains what was measured", "Residual"),
        ("fit.json: `curves` of `residual`", "each measurement", "CurveResidual"),
        ("fit.json: `accords` of `residual`", "each imprint beside the other measurements", "Accord"),
        ("fit.json: `decided`", "what each of several measurements tells", "Decided"),
        ("fit.json: `next_experiment`", "the experiment to make next", "NextExperiment"),
        ("fit.json: `next_experiment.others`", "experiments of other kinds", "OtherExperiment"),
    ];
    let mut text = keys("fit.json", "what was found", &schema);
    text.extend(parts.iter().map(|(file, about, name)| keys(file, about, &schema["$defs"][name])));
    text
}

fn heading(file: &str, about: &str) -> String {
    let file = if file.contains('`') { file.to_string() } else { code(file) };
    format!("### {file}\n\n{}{}.\n\n", about[..1].to_uppercase(), &about[1..])
}

/// Columns whose names do not depend on the symmetry. Tables inside have their own.
fn file_columns<T: Described>(file: &str, about: &str) -> String {
    let columns = T::COLUMNS.iter().filter(|column| column.quantity != "row");
    let rows = columns.map(|column| vec![code(column.quantity), words(column.about.trim())]);
    heading(file, about) + &table(&["name", "meaning"], rows)
}

/// Columns with their names in plane strain, where they differ.
fn of_crush<T: Described>(file: &str, about: &str) -> String {
    let row = |column: &Column| {
        let [name, plane] = [Symmetry::Axisymmetric, Symmetry::PlaneStrain].map(|s| column.name(s));
        let plane = if plane == name { String::new() } else { code(&plane) };
        vec![code(&name), words(column.about.trim()), plane]
    };
    heading(file, about) + &table(&["name", "meaning", "in plane strain"], T::COLUMNS.iter().map(row))
}

/// `cases.csv`, whose order is that of the file.
fn of_cases() -> String {
    let schema = schema_for!(CaseRow).to_value();
    let about =
        |name: &str| schema["properties"][name]["description"].as_str().unwrap_or_default().to_string();
    let head = Sweep::default().cases().first().map(|case| {
        let row = CaseRow::from(&Row { case: *case, outcome: Err(String::new()), wall_s: 0.0 });
        let mut table = csv::Writer::from_writer(Vec::new());
        let bytes = table.serialize(row).ok().and_then(|()| table.into_inner().ok()).unwrap_or_default();
        String::from_utf8_lossy(&bytes).lines().next().unwrap_or_default().to_string()
    });
    let head = head.unwrap_or_default();
    let rows = head.split(',').map(|name| vec![code(name), words(&about(name))]);
    heading("cases.csv", "a row per cone") + &table(&["name", "meaning"], rows)
}
