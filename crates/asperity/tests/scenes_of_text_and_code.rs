//! A scene is the same from text and from code, and what is wrong with it is an error.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use asperity::Scene;
use std::path::Path;

/// A scene with some words replaced by others of it, or by extremes, is an error or a scene, never a
/// panic.
#[test]
fn a_scrambled_scene_does_not_panic() {
    let text = asperity::scenes::SINGLE_ASPERITY;
    let lines: Vec<&str> = text.lines().map(|l| l.split('#').next().unwrap_or_default()).collect();
    let text = lines.join("\n");
    let odd = [
        "-1",
        "0",
        "1e308",
        "1e-308",
        "nan",
        "\"inf um\"",
        "[",
        "]",
        "=",
        "\"",
        "\n",
        "true",
        "{}",
        "[[x]]",
        "\"1e300 km\"",
    ];
    let words: Vec<&str> = text.split_inclusive(char::is_whitespace).collect();
    let mut state = 7_u64;
    let mut next = move |n: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % n
    };
    let mut scenes = 0;
    for _ in 0..2_000 {
        let mut scrambled: Vec<String> = words.iter().map(|w| w.to_string()).collect();
        for _ in 0..1 + next(3) {
            let at = next(words.len());
            let space: String = words[at].chars().filter(|c| c.is_whitespace()).collect();
            let new = if next(2) == 0 { odd[next(odd.len())] } else { words[next(words.len())].trim() };
            scrambled[at] = format!("{new}{space}");
        }
        match Scene::from_toml(&scrambled.concat(), Path::new("")) {
            Ok(_) => scenes += 1,
            Err(error) => assert!(error.to_string().len() > 10),
        }
    }
    assert!((20..1_900).contains(&scenes), "{scenes}");
}

/// Of a device that never ends, and of a file that is none.
#[cfg(target_os = "linux")]
#[test]
fn a_mesh_file_without_end_is_refused_at_its_key() {
    let text = format!("{}\n[mesh]\nfile = \"/dev/zero\"\n", asperity::scenes::SINGLE_ASPERITY);
    let error = Scene::from_toml(&text, Path::new("")).unwrap_err().to_string();
    assert!(
        error.contains("mesh.file") && error.contains("no end below the limit of a mesh, 0.27 GB"),
        "{error}"
    );
}

#[test]
fn a_scene_built_in_code_is_that_of_its_file() {
    let text = asperity::scenes::SINGLE_ASPERITY;
    let read = Scene::from_toml(text, Path::new("")).unwrap();
    let built = Scene::new(read.tables()).unwrap();
    assert_eq!(built.tables(), read.tables());
    assert_eq!(Scene::from_toml(&read.to_toml().unwrap(), Path::new("")).unwrap().tables(), read.tables());
}

#[test]
fn a_value_that_is_set_is_checked() {
    let text = asperity::scenes::SINGLE_ASPERITY;
    let mut scene = Scene::from_toml(text, Path::new("")).unwrap();
    scene.set("loading.depth", "2 um").unwrap();
    assert_eq!(scene.tables().loading.depth, Some("2 um".parse().unwrap()));
    let error = scene.set("loading.depth", "2 km").unwrap_err();
    assert!(error.to_string().contains("loading.depth"), "{error}");
    assert_eq!(scene.tables().loading.depth, Some("2 um".parse().unwrap()));
}
