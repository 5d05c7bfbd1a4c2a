//! Claims about the pictures.

use super::deformed_mesh::Field;
use super::*;
use crate::MEGAPASCAL;
use asperity_simulation::record::rows::Phase;
use asperity_simulation::run::{Event, FieldFrame, Run};
use asperity_simulation::scene::Scene;
use std::ops::ControlFlow;

/// The asperity of the paper, coarse.
const SCENE: &str = r#"
symmetry = "axisymmetric"
accuracy = "draft"
material = { youngs_modulus = "210 GPa", poissons_ratio = 0.3, yield_stress = "300 MPa", hardening_exponent = 0.3 }
asperity = [{ height = "20 um", slope_deg = 10, tip_radius = "10 um" }]
tool = { shape = "plane" }
loading = { depth = "5 um", unload = true }
output = { every = 100000 }
numerics = { steps = 8 }
"#;

fn peak() -> (Scene, FieldFrame) {
    let scene: Scene = toml::from_str(SCENE).unwrap();
    let mut peak = None;
    Run::new(&scene)
        .run(&mut |event| {
            if let Event::Fields(frame) = event
                && frame.phase == Phase::Load
            {
                peak = Some((*frame).clone());
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    (scene, peak.unwrap())
}

/// The dots on both sides of the axis are the same, the body ends at the tool, and the colours reach the
/// largest stress of the nodes but not beyond.
#[test]
fn the_picture_is_that_of_the_fields() {
    let (scene, frame) = peak();
    let section = Section::new(&frame, &scene, Reach::Yielded).unwrap();
    let size = [300, 200];
    let raster = Raster::draw(&section.mesh, &section.window, true, size, &[Field::VonMises]);
    let largest = frame.fields.von_mises.iter().copied().fold(0.0, f64::max) / MEGAPASCAL;
    let [_, high] = raster.range(Field::VonMises);
    assert!(high <= largest * (1.0 + 1e-6) && high > 0.9 * largest, "{high} {largest}");
    let stress = raster.plane(Field::VonMises);
    for row in stress.chunks(size[0]) {
        for (a, b) in row.iter().zip(row.iter().rev()) {
            assert!(a == b || a.is_nan() && b.is_nan());
        }
    }
    let height = |dots: usize| section.window.high[1] - dots as f64 * section.window.size()[0] / 300.0;
    let first = stress.iter().position(|stress| !stress.is_nan()).unwrap() / size[0];
    assert!((height(first) - section.tip.unwrap()).abs() < 2.0 * section.window.size()[0] / 300.0);
}

#[test]
fn every_panel_is_drawn_with_its_unit() {
    let (scene, frame) = peak();
    let section = Section::new(&frame, &scene, Reach::Asperities(3.0)).unwrap();
    let panels = [&Panel::PEAK[..], &Panel::FIG5, &[Panel::Mesh]].concat();
    let svg = section.svg(&panels, "a title").unwrap();
    for text in [
        "a title",
        "von Mises stress (MPa)",
        "contact pressure (MPa)",
        "r (µm)",
        "never yielded",
        "rigid tool",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    assert_eq!(svg.matches("data:image/png").count(), 6);
    // letters of an encoded image say nothing
    let drawn: String = svg.split("base64,").map(|part| part.trim_start_matches(|c| c != '"')).collect();
    assert!(drawn.len() < svg.len() && !drawn.contains("NaN"));
    let document = roxmltree_free_check(&svg);
    assert!(document, "tags that do not close");
}

/// Every element that opens closes: the document is XML, not only HTML.
fn roxmltree_free_check(svg: &str) -> bool {
    let opened = svg.matches('<').count() - svg.matches("</").count();
    opened == svg.matches("</").count()
}

/// An elastic body has no zones and no plastic strain, and is drawn all the same.
#[test]
fn an_elastic_body_is_drawn() {
    let (mut scene, mut frame) = peak();
    scene.material.yield_stress = None;
    frame.fields.first_yield.iter_mut().for_each(|z| *z = -1.0);
    frame.fields.plastic_strain.iter_mut().for_each(|s| *s = 0.0);
    let svg = Section::new(&frame, &scene, Reach::Yielded).unwrap().svg(&Panel::PEAK, "").unwrap();
    assert!(!svg.contains("NaN"));
}

/// A zone ends on a line through cells, not along their sides: where first yield is a line of the height,
/// every dot is on the side of that height on which it lies.
#[test]
fn elastic_zones_end_between_nodes() {
    let (scene, mut frame) = peak();
    let moved = frame.mesh.nodes.iter().zip(&frame.fields.displacement).map(|(x, u)| x[1] + u[1]);
    let heights: Vec<f64> = moved.map(|z| z / crate::MICROMETRE).collect();
    let (limit, depth) = (-23.0, 40.0);
    frame.fields.first_yield = heights.iter().map(|z| ((z - limit) / depth).clamp(-1.0, 1.0)).collect();
    let section = Section::new(&frame, &scene, Reach::Asperities(3.0)).unwrap();
    let size = [300, 200];
    let fields = Panel::ElasticZones.fields();
    let raster = Raster::draw(&section.mesh, &section.window, true, size, fields);
    let [first_yield, now] = [Field::FirstYield, Field::YieldFunction].map(|field| raster.plane(field));
    let dot_height = section.window.size()[0] / size[0] as f64;
    let mut zones = [0; 2];
    for (place, (&first_yield, &now)) in first_yield.iter().zip(now).enumerate() {
        let z = section.window.high[1] - ((place / size[0]) as f64 + 0.5) * dot_height;
        // sides of deformed cells are curved, fields bilinear in them
        if !first_yield.is_nan() && (z - limit).abs() > 1.0 {
            assert_eq!(panel::zone(first_yield, now) == 1, z < limit, "{z}");
            zones[usize::from(z < limit)] += 1;
        }
    }
    assert!(zones.iter().all(|count| *count > 1000), "{zones:?}");
}
