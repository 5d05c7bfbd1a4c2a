//! The figures and tables of the paper, and the parts that must be computed for them.

use asperity::crush::Sketch;
use asperity::draw::field_plot::{Panel, Reach};
use asperity::error::InputError;
use asperity::roughness::KindName;
use asperity::scenes;

/// A figure or a table of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Item {
    /// Its name for `--only`.
    pub name: &'static str,
    /// Its name in the paper.
    pub title: &'static str,
}

/// Every figure and table that computation can give, in the order of the paper.
pub const ITEMS: [Item; 16] = [
    Item { name: "fig1", title: "Figure 1. Geometry of an asperity" },
    Item { name: "fig2", title: "Figure 2. Strength/depth curve for the crushing of the modelled asperity" },
    Item { name: "fig3", title: "Figure 3. Strength/depth curve for the crushing of a milled real surface" },
    Item { name: "fig4", title: "Figure 4. Modelling of multi asperities crushing" },
    Item { name: "fig5", title: "Figure 5. Plastic areas" },
    Item { name: "fig6", title: "Figure 6. Crushing of asperities presenting different rake angles" },
    Item { name: "fig7", title: "Figure 7. Mixed curves principle" },
    Item { name: "fig8", title: "Figure 8. Representative strain" },
    Item { name: "fig9", title: "Figure 9. Presentation of the roughness summits by cones" },
    Item { name: "fig11", title: "Figure 11. Topographies of rough surfaces" },
    Item { name: "fig12", title: "Figure 12. Pressure distributions" },
    Item { name: "fig13", title: "Figure 13. Distribution of real contact areas" },
    Item { name: "table1", title: "Table 1. Numerical results" },
    Item { name: "fig15", title: "Figure 15. Indentation curves" },
    Item { name: "table2", title: "Table 2. Experimental results" },
    Item { name: "outlook", title: "Outlook. Scales of roughness and singular pressures" },
];

/// The way a part is computed.
#[derive(Clone, Copy, Debug)]
pub enum Work {
    /// A crush of a scene with values changed, and pictures of its peak.
    Crush {
        /// The scene file.
        scene: &'static str,
        /// Changes, as `--set` takes them.
        changes: &'static [&'static str],
        /// Pictures.
        sketches: &'static [Sketch],
    },
    /// The sweep of 480 cones.
    Calibrate,
    /// A rough surface: five seeds for the tables, the first for the pictures.
    Rough {
        /// The scene file.
        scene: &'static str,
        /// Changes, as `--set` takes them.
        changes: &'static [&'static str],
        /// The row of Table 1.
        kind: KindName,
    },
    /// A rough surface at all its scales.
    Scales {
        /// The scene file.
        scene: &'static str,
        /// Changes, as `--set` takes them.
        changes: &'static [&'static str],
    },
}

/// A run of its own, with a folder of its own.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// The folder's name; for a scene that of its file.
    pub name: &'static str,
    /// The way it is computed.
    pub work: Work,
    /// The items that need it.
    pub serves: &'static [&'static str],
}

/// No field files on the way: only the peak and the end.
const PEAK_ONLY: &str = "output.every=1000000";
/// All of the asperities' height.
const TOTAL: &str = "loading.depth=20 um";
/// The zones are those of the peak.
const LOADING_ALONE: &str = "loading.unload=false";
const ELEMENTS: Sketch = Sketch { name: "elements", reach: Reach::Asperities(3.0), panels: &[Panel::Mesh] };
const ZONES: Sketch = Sketch { name: "zones", reach: Reach::Asperities(11.0), panels: &Panel::FIG5 };

/// The closures of islands, whose maps and curves the report shows: no half-space, no flow, no comparison of
/// closures, no spectrum.
const ISLANDS: &[&str] =
    &["closure=islands", "judge=false", "half_space.leak=false", "output.spectrum=false"];
/// The same with both half-spaces, whose load curves Figure 3 shows, their ends as close as the points
/// between them.
const EVERY_CLOSURE: &[&str] = &[
    "closure=all",
    "judge=false",
    "half_space.leak=false",
    "half_space.tolerance=1e-4",
    "output.spectrum=false",
];

macro_rules! crush {
    ($name:literal, $scene:ident, $changes:expr, $sketches:expr, $serves:expr) => {
        Part {
            name: $name,
            work: Work::Crush { scene: scenes::$scene, changes: $changes, sketches: $sketches },
            serves: $serves,
        }
    };
}

macro_rules! rough {
    ($name:literal, $scene:ident, $changes:expr, $kind:expr, $serves:expr) => {
        Part {
            name: $name,
            work: Work::Rough { scene: scenes::$scene, changes: $changes, kind: $kind },
            serves: $serves,
        }
    };
}

/// A quarter of the surface with the same pixel: its longest waves are far below a side.
const QUARTER: &[&str] = &[
    "closure=half-space-plastic",
    "surface.generate.size=[\"1 mm\", \"1 mm\"]",
    "surface.generate.pixels=[512, 512]",
];

macro_rules! scales {
    ($name:literal, $scene:ident) => {
        Part {
            name: $name,
            work: Work::Scales { scene: scenes::$scene, changes: QUARTER },
            serves: &["outlook"],
        }
    };
}

const ROUGH: &[&str] = &["fig11", "fig12", "fig13", "table1", "fig15", "table2"];
const MILLED: &[&str] = &["fig3", "fig9", "fig11", "fig12", "fig13", "table1", "fig15", "table2"];

/// Every part, those that take longest first, so that all cores end at about the same time.
pub const PARTS: [Part; 20] = [
    Part { name: "calibrate", work: Work::Calibrate, serves: &["fig7", "fig8"] },
    crush!(
        "three-identical-finest-plane-strain",
        THREE_IDENTICAL_PLANE_STRAIN,
        &[TOTAL, PEAK_ONLY, LOADING_ALONE, "numerics.elements_in_contact=64"],
        &[ZONES],
        &["fig5"]
    ),
    crush!(
        "three-identical-finest",
        THREE_IDENTICAL,
        &[TOTAL, PEAK_ONLY, LOADING_ALONE, "numerics.elements_in_contact=64"],
        &[ZONES],
        &["fig5"]
    ),
    rough!("rough-milled", ROUGH_MILLED, EVERY_CLOSURE, KindName::Milled, MILLED),
    rough!("rough-ground", ROUGH_GROUND, ISLANDS, KindName::Ground, ROUGH),
    crush!(
        "three-identical-finer",
        THREE_IDENTICAL,
        &[TOTAL, PEAK_ONLY, LOADING_ALONE, "numerics.elements_in_contact=45"],
        &[],
        &["fig5"]
    ),
    crush!(
        "three-identical-finer-plane-strain",
        THREE_IDENTICAL_PLANE_STRAIN,
        &[TOTAL, PEAK_ONLY, LOADING_ALONE, "numerics.elements_in_contact=45"],
        &[],
        &["fig5"]
    ),
    rough!("rough-sanded", ROUGH_SANDED, ISLANDS, KindName::Sanded, ROUGH),
    scales!("scales-ground", ROUGH_GROUND),
    scales!("scales-milled", ROUGH_MILLED),
    scales!("scales-sanded", ROUGH_SANDED),
    crush!("slopes-1-4", SLOPES_1_4, &[], &[], &["fig6"]),
    crush!(
        "three-identical-plane-strain",
        THREE_IDENTICAL_PLANE_STRAIN,
        &[TOTAL, PEAK_ONLY, LOADING_ALONE, "numerics.elements_in_contact=32"],
        &[],
        &["fig5"]
    ),
    crush!(
        "three-identical",
        THREE_IDENTICAL,
        &[TOTAL, PEAK_ONLY, LOADING_ALONE, "numerics.elements_in_contact=32"],
        &[Sketch::PEAK, ELEMENTS],
        &["fig4", "fig5"]
    ),
    crush!("slopes-9-12-plane-strain", SLOPES_9_12_PLANE_STRAIN, &[], &[], &["fig6"]),
    crush!("slopes-1-4-plane-strain", SLOPES_1_4_PLANE_STRAIN, &[], &[], &["fig6"]),
    crush!("slopes-5-8-plane-strain", SLOPES_5_8_PLANE_STRAIN, &[], &[], &["fig6"]),
    crush!("slopes-9-12", SLOPES_9_12, &[], &[], &["fig6"]),
    crush!("slopes-5-8", SLOPES_5_8, &[], &[], &["fig6"]),
    crush!("single-asperity", SINGLE_ASPERITY, &[PEAK_ONLY], &[Sketch::PEAK, ELEMENTS], &["fig1", "fig2"]),
];

/// The items called for, in the order of the paper; all of them if none is.
///
/// # Errors
/// A name that is none of theirs, with the nearest one.
pub fn items(only: &[String]) -> Result<Vec<Item>, InputError> {
    let only: Vec<String> = only.iter().map(|name| name.trim().to_lowercase()).collect();
    let names = ITEMS.map(|item| item.name);
    if let Some(unknown) = only.iter().find(|name| !names.contains(&name.as_str())) {
        let near = asperity::input::suggest::nearest(unknown, &names);
        let did_you = near.map_or_else(String::new, |near| format!("did you mean {near}? "));
        return Err(InputError::new(format!("--only: the paper has no `{unknown}` that can be computed"))
            .help(format!("{did_you}Known here: {}", names.join(", "))));
    }
    let wanted = |item: &&Item| only.is_empty() || only.iter().any(|name| name == item.name);
    Ok(ITEMS.iter().filter(wanted).copied().collect())
}

/// The parts that `items` need.
pub fn parts(items: &[Item]) -> Vec<Part> {
    let needed = |part: &&Part| items.iter().any(|item| part.serves.contains(&item.name));
    PARTS.iter().filter(needed).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_has_a_part_and_every_part_an_item() {
        for item in ITEMS {
            assert!(!parts(&[item]).is_empty(), "{}", item.name);
        }
        assert_eq!(parts(&ITEMS).len(), PARTS.len());
        for part in PARTS {
            assert!(part.serves.iter().all(|name| ITEMS.iter().any(|i| i.name == *name)), "{}", part.name);
        }
        assert_eq!(items(&["table1".into(), "fig6".into()]).unwrap().len(), 2);
        assert!(items(&["fig10".into()]).unwrap_err().message.contains("fig10"));
    }
}
