//! Claims about scenes.

use super::*;
use asperity_formats::surface;
use std::path::Path;

const GOOD: &str = r#"
    closure = "published"
    [surface]
    file = "z.npy"
    pixel_size = ["1 um", "2 um"]
    height_unit = "nm"
    level = "none"
    [material]
    youngs_modulus = "210 GPa"
    poissons_ratio = 0.3
    hardness = "1280 MPa"
    [load]
    pressure = "200 MPa"
"#;

fn read(text: &str) -> Result<Scene, String> {
    let scene: Scene = toml::from_str(text).map_err(|e| e.to_string())?;
    scene.validate().map_err(|e| e.to_string())?;
    Ok(scene)
}

#[test]
fn a_scene_reads_and_is_written_back() {
    let scene = read(GOOD).unwrap();
    assert_eq!(toml::from_str::<Scene>(&toml::to_string(&scene).unwrap()).unwrap(), scene);
}

/// Beside "all", "islands" leaves out what is solved at once and no law of single islands.
#[test]
fn islands_are_all_closures_but_the_half_spaces() {
    let scene = read(&GOOD.replacen("\"published\"", "\"islands\"", 1)).unwrap();
    let [islands, all] = [scene.closure, Choice::All].map(Choice::closures);
    assert!(islands.iter().all(|closure| !closure.is_half_space()));
    assert!(all.iter().all(|closure| islands.contains(closure) != closure.is_half_space()));
    assert!(scene.closure.is_several() && !Choice::Published.is_several());
    assert_eq!(Choice::HalfSpacePlastic.closures(), [Closure::HalfSpacePlastic]);
}

#[test]
fn a_wrong_scene_is_refused_where_it_is_wrong() {
    for (old, new, place) in [
        ("\"210 GPa\"", "\"-210 GPa\"", "material.youngs_modulus"),
        ("0.3", "0.5", "material.poissons_ratio"),
        ("0.3", "nan", "material.poissons_ratio"),
        ("\"1280 MPa\"", "\"1280 GPa\"", "material.hardness"),
        ("\"200 MPa\"", "\"-1 MPa\"", "load.pressure"),
        ("pressure = \"200 MPa\"", "", "load:"),
        ("pressure = ", "separation = \"1 um\"\npressure = ", "load.separation"),
        ("\"1 um\", \"2 um\"", "\"0 um\", \"2 um\"", "surface.pixel_size"),
        ("file = \"z.npy\"", "", "surface:"),
        ("level = ", "s_filter = \"0 um\"\nlevel = ", "surface.s_filter"),
        ("level = ", "s_filter = \"9 um\"\nl_filter = \"8 um\"\nlevel = ", "surface.s_filter"),
        ("\"nm\"", "\"parsec\"", "parsec"),
        ("\"none\"", "\"nothing\"", "nothing"),
        ("\"published\"", "\"hertz\"", "hertz"),
        ("closure", "colour = 1\nclosure", "colour"),
    ] {
        let message = read(&GOOD.replacen(old, new, 1)).unwrap_err();
        assert!(message.contains(place), "{new}: {message}");
    }
}

fn generated(table: &str) -> Result<Scene, String> {
    let surface =
        format!("[surface.generate]\nsize = [\"100 um\", \"100 um\"]\npixels = [64, 64]\n{table}\n");
    let (head, rest) = GOOD.split_once("[surface]").unwrap();
    let (_, tail) = rest.split_once("[material]").unwrap();
    read(&format!("{head}{surface}[material]{tail}"))
}

#[test]
fn a_generated_surface_needs_what_its_kind_has() {
    assert!(generated("kind = \"sanded\"\nra = \"1 um\"\nmean_slope_deg = 8").is_ok());
    assert!(
        generated(
            "kind = \"self-affine\"\nra = \"1 um\"\nhurst = 0.8\nrolloff = \"50 um\"\ncutoff = \"10 um\""
        )
        .is_ok()
    );
    for bad in [
        "kind = \"sanded\"",
        "kind = \"sanded\"\nra = \"0 um\"",
        "kind = \"sanded\"\nmean_slope_deg = 90",
        "kind = \"sanded\"\nra = \"1 um\"\nhurst = 0.8",
        "kind = \"self-affine\"\nra = \"1 um\"\nhurst = 0.8",
        "kind = \"self-affine\"\nra = \"1 um\"\nhurst = 1.8\nrolloff = \"50 um\"\ncutoff = \"10 um\"",
        "kind = \"self-affine\"\nra = \"1 um\"\nmean_slope_deg = 3\nhurst = 0.8\nrolloff = \"50 um\"\ncutoff = \"10 um\"",
    ] {
        assert!(generated(bad).is_err(), "{bad}");
    }
}

fn surface(text: &str) -> SurfaceScene {
    toml::from_str(text).unwrap()
}

#[test]
fn units_and_pixels_are_demanded_and_contradictions_refused() {
    let folder = tempfile::tempdir().unwrap();
    let resolve = |p: &Path| folder.path().join(p);
    let heights: Vec<f64> = (0..25).map(|i| f64::from(i * i % 7)).collect();
    surface::write_npy(&resolve(Path::new("z.npy")), 5, 5, &heights).unwrap();
    surface::write_x3p(&resolve(Path::new("z.x3p")), 5, 5, [1e-6, 1e-6], &heights).unwrap();
    let unit = "height_unit = \"um\"\n";
    let pixel = "pixel_size = [\"2 um\", \"2 um\"]\n";
    for (text, place) in [
        ("file = \"z.npy\"\n".to_string(), "height_unit"),
        (format!("file = \"z.npy\"\n{unit}"), "pixel_size"),
        (format!("file = \"z.x3p\"\n{unit}"), "surface.height_unit"),
        (format!("file = \"z.x3p\"\n{pixel}"), "surface.pixel_size"),
        ("file = \"none.npy\"\n".into(), "none.npy"),
    ] {
        let message = surface(&text).prepare(resolve).err().unwrap().to_string();
        assert!(message.contains(place), "{message}");
    }
    // a size without a unit is no reason to guess one
    let text = "cellsize 0.5\n1 2 5\n4 4 2\n7 1 1\n";
    std::fs::write(resolve(Path::new("z.asc")), text).unwrap();
    let bare = surface(&format!("file = \"z.asc\"\n{unit}")).prepare(resolve).err().unwrap().to_string();
    assert!(bare.contains("0.5 x 0.5 apart") && bare.contains("pixel_size = \"0.5 um\""), "{bare}");
    // sides in a unit that is not named tell their ratio
    std::fs::write(resolve(Path::new("xy.asc")), text.replace("cellsize 0.5", "dx 1.5\ndy 2")).unwrap();
    let sides = |pixel: &str| {
        surface(&format!("file = \"xy.asc\"\n{unit}pixel_size = {pixel}\n"))
            .prepare(resolve)
            .map(|map| map.map.pixel())
    };
    let other = sides("\"1.5 um\"").err().unwrap().to_string();
    assert!(other.contains("1.5 x 2") && other.contains("[\"1.5 um\", \"2 um\"]"), "{other}");
    assert_eq!(sides("[\"3 um\", \"4 um\"]").unwrap(), [3e-6, 4e-6]);
    let square = surface(&format!("file = \"z.npy\"\n{unit}pixel_size = \"2 um\"\n"));
    assert_eq!(square.pixel_size, surface(&format!("file = \"z.npy\"\n{unit}{pixel}")).pixel_size);
    let forced = surface(&format!("file = \"z.x3p\"\n{unit}{pixel}override = true\nlevel = \"none\""))
        .prepare(resolve)
        .unwrap();
    assert_eq!((forced.map.pixel(), forced.map.heights()[2]), ([2e-6, 2e-6], 4e-6));
    assert!(surface(&format!("file = \"z.npy\"\n{unit}{pixel}")).prepare(resolve).is_ok());
}

#[test]
fn a_map_without_a_height_is_refused_and_one_with_few_is_filled() {
    let folder = tempfile::tempdir().unwrap();
    let resolve = |p: &Path| folder.path().join(p);
    let rest = "pixel_size = [\"2 um\", \"2 um\"]\nheight_unit = \"um\"\nfile = \"z.npy\"\n";
    for (measured, missing, good) in
        [(0, "fill", false), (0, "exclude", false), (1, "exclude", false), (1, "fill", true)]
    {
        let mut heights = vec![f64::NAN; 16];
        heights[..measured].fill(1.0);
        surface::write_npy(&resolve(Path::new("z.npy")), 4, 4, &heights).unwrap();
        let answer = surface(&format!("{rest}missing = \"{missing}\"")).prepare(resolve);
        assert_eq!(answer.is_ok(), good, "{measured} {missing}");
    }
}
