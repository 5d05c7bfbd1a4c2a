//! A scene crushed by the library gives the numbers, the files and the ends that the command gives.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use asperity::columns::{Described, read_rows, write_rows};
use asperity::crush::{AsperityRow, CurveRow, GapRow, Summary};
use asperity::output::Directory;
use asperity::tables::Symmetry;
use asperity::{Scene, crush};
use common::{Place, SCENE};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// A summary without what differs from run to run.
fn lasting(text: &str) -> Value {
    let mut summary: Value = serde_json::from_str(text).unwrap();
    for key in ["wall_s", "peak_memory_MB"] {
        summary.as_object_mut().unwrap().remove(key).unwrap();
    }
    summary
}

fn reads_back<T: Described + Serialize + DeserializeOwned>(place: &Place, file: &str, symmetry: Symmetry) {
    let path = place.path("library").join(file);
    let mut again = Vec::new();
    write_rows(&mut again, &read_rows::<T>(&path).unwrap(), symmetry).unwrap();
    assert!(again == std::fs::read(&path).unwrap(), "{file}");
}

#[test]
fn files_of_the_library_and_the_command_are_the_same() {
    let second = "[[asperity]]\nheight = \"19 um\"\nslope_deg = 12\n[tool]";
    let substrate = "[substrate]\nradius = \"1 mm\"\ndepth = \"1 mm\"\n";
    let fields = SCENE.replace("every = 0", "every = 4");
    let ridges = fields.replace("\"axisymmetric\"", "\"plane-strain\"").replace("[tool]", second) + substrate;
    for scene in [fields, ridges] {
        let place = Place::with_scene(&scene);
        let end = place.run(&["crush", "scene.toml", "--out", "command", "--quiet"]);
        assert_eq!(end.status, 0, "{}", end.err);
        let result = crush(&Scene::from_toml(&scene, "".as_ref()).unwrap(), &mut |_| true).unwrap();
        result.write(&mut Directory::create(&place.path("library")).unwrap()).unwrap();

        let names: Vec<String> =
            place.names("command").into_iter().filter(|name| !name.starts_with('.')).collect();
        assert_eq!(names, place.names("library"));
        for name in names.iter().filter(|name| *name != "summary.json") {
            let [command, library] =
                ["command", "library"].map(|dir| std::fs::read(place.path(dir).join(name)).unwrap());
            assert!(command == library, "{name}");
        }
        assert_eq!(
            lasting(&place.text("command/summary.json")),
            lasting(&serde_json::to_string(&result.summary).unwrap())
        );
        // what is written reads back to values that are written alike
        let symmetry = result.summary.scene.symmetry;
        reads_back::<CurveRow>(&place, "curve.csv", symmetry);
        let read = Summary::read(&place.path("library/summary.json")).unwrap();
        assert_eq!(read.to_json().unwrap(), place.text("library/summary.json"));
        if names.contains(&"asperities.csv".into()) {
            reads_back::<AsperityRow>(&place, "asperities.csv", symmetry);
            reads_back::<GapRow>(&place, "gaps.csv", symmetry);
        }
        assert!(result.frames.iter().all(|frame| frame.array("von_mises_MPa").is_some()));
    }
}

#[test]
fn an_observer_that_ends_the_run_keeps_what_was_reached() {
    let scene = Scene::from_toml(&SCENE.replace("every = 0", "every = 1"), "".as_ref()).unwrap();
    let (mut told, mut seen) = (0, 0);
    let result = crush(&scene, &mut |progress| {
        told += 1;
        seen += usize::from(progress.news.is_some_and(|news| news.frame.is_some()));
        progress.done < 3
    })
    .unwrap();
    assert_eq!(result.curve.last().map(|row| row.increment), Some(3));
    assert!(result.summary.stopped.is_some_and(|reason| reason.contains("interrupted")));
    assert!(told > seen && seen >= 2, "{told} {seen}");
    // nothing is told after the end, but the fields of the end are kept
    assert_eq!(result.frames.last().map(|frame| frame.increment), Some(3));
}

#[test]
fn a_scene_that_makes_no_sense_is_refused_at_its_line() {
    let wrong = SCENE.replace("\"5 um\"", "\"500 um\"");
    let Err(asperity::Error::Input(error)) = Scene::from_toml(&wrong, "".as_ref()) else {
        panic!("accepted")
    };
    let place = error.place.as_ref().unwrap();
    assert!(place.text[place.span.clone()].contains("500 um") && error.to_string().contains("loading.depth"));
}
