//! `--report` leaves a page that needs nothing beside it, says in words what it shows, and has the numbers of
//! the summary.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use scraper::{ElementRef, Html, Selector};
use serde_json::Value;
use std::process::Command;

const ROUGH: &str = r#"closure = "all"
[surface.generate]
kind = "milled"
ra = "1 um"
mean_slope_deg = 4
size = ["0.3 mm", "0.3 mm"]
pixels = [64, 64]
seed = 1
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
hardness = "1280 MPa"
yield_stress = "400 MPa"
[load]
pressure = "100 MPa"
unload = true
"#;

const SWEEP: &str = r#"accuracy = "draft"
slopes_deg = [4, 9]
youngs_modulus = ["70 GPa", "210 GPa"]
yield_stress = ["200 MPa", "300 MPa", "700 MPa"]
hardening_exponent = [0.1, 0.5]
"#;

const FIT: &str = r#"accuracy = "draft"
samples = 0
[material]
youngs_modulus = "50 GPa"
poissons_ratio = 0.3
yield_stress = ["50 MPa", "2 GPa"]
hardening_exponent = [0.0, 0.5]
hardening_law = "swift"
[[curve]]
features = { loading_curvature = "13.602 GPa" }
tool = { shape = "cone", half_apex_deg = 60 }
noise = "1 %"
[[curve]]
features = { loading_curvature = "7.0 GPa" }
tool = { shape = "cone", half_apex_deg = 50 }
noise = "1 %"
"#;

fn each<'a>(page: &'a Html, selector: &str) -> Vec<ElementRef<'a>> {
    page.select(&Selector::parse(selector).unwrap()).collect()
}

/// Holds a page against its summary; how many numbers it shows.
fn checked(text: &str, summary: &str) -> usize {
    let page = Html::parse_document(text);
    // nothing was lost or moved by a parser that mends what it reads
    for name in ["table", "figure", "svg", "data", "script"] {
        assert_eq!(each(&page, name).len(), text.matches(&format!("<{name}")).count(), "{name}");
    }
    for element in each(&page, "[src], [href]") {
        for name in ["src", "href"] {
            let source = element.value().attr(name).unwrap_or("#");
            assert!(source.starts_with("data:") || source.starts_with('#'), "{source:.60}");
        }
    }
    for outside in ["url(", "@import", "fetch("] {
        assert!(!text.contains(outside), "{outside}");
    }
    for picture in each(&page, "svg, img") {
        let name = picture.value().attr("aria-label").or(picture.value().attr("alt")).unwrap_or_default();
        assert!(name.len() > 10, "{:.200}", picture.html());
    }
    assert!(each(&page, "th").iter().all(|th| th.value().attr("scope").is_some()));
    for (of, needed) in [("table", "caption"), ("figure", "figcaption")] {
        let needed = Selector::parse(needed).unwrap();
        assert!(each(&page, of).iter().all(|one| one.select(&needed).count() == 1), "{of}");
    }
    let order = [
        text.find("class=\"finding\"").unwrap(),
        text.find("<table").unwrap(),
        text.find("<figure").unwrap(),
    ];
    assert!(order.is_sorted(), "the verdict stands first: {order:?}");
    for chart in each(&page, "figure.chart script") {
        let data: Value = serde_json::from_str(&chart.inner_html()).unwrap();
        assert!(data["lines"].as_array().is_some_and(|lines| !lines.is_empty()), "{data}");
    }
    let summary: Value = serde_json::from_str(summary).unwrap();
    let numbers = each(&page, "data");
    for number in &numbers {
        let place = number.value().attr("data-place").unwrap();
        let shown: f64 = number.value().attr("value").unwrap().parse().unwrap();
        assert_eq!(summary.pointer(place).and_then(Value::as_f64), Some(shown), "{place}");
        // what is read is that number, in its unit or as a percentage, to its last digit
        let read = number.text().collect::<String>();
        let digits: String = read.chars().take_while(|c| c.is_ascii_digit() || "+-.e".contains(*c)).collect();
        let read: f64 = digits.parse().unwrap_or_else(|_| panic!("{read}"));
        let decimals =
            digits.split('.').nth(1).map_or(0, |d| d.chars().take_while(char::is_ascii_digit).count());
        let tens = digits.split('e').nth(1).map_or(0, |e| e.parse::<i32>().unwrap());
        let last = 10f64.powi(tens - decimals as i32);
        let close = |factor: f64| (read - factor * shown).abs() <= 0.501 * last;
        assert!(close(1.0) || close(100.0), "{place}: {read} of {shown}");
    }
    numbers.len()
}

/// Runs the command with `--report` and gives how many numbers its page shows.
fn reported(scene: &str, args: &[&str], summary: &str) -> (Place, usize) {
    let place = Place::with_scene(scene);
    let end = place.run(&[args, &["--report", "--out", "out", "--quiet"]].concat());
    assert_eq!(end.status, 0, "{}", end.err);
    let count = checked(&place.text("out/report.html"), &place.text(&format!("out/{summary}")));
    legible_on_a_phone(&place, "out/report.html");
    (place, count)
}

/// Shows a report 390 pixels wide and lists what is wider than the page, letters below 9 pixels, letters that
/// the edge of their drawing cuts, and letters that touch others.
const PHONE: &str = r#"<iframe style="width:390px;height:900px;border:0"></iframe><script>
const frame = document.querySelector("iframe");
frame.addEventListener("load", () => {
  const page = frame.contentDocument, found = [];
  const { scrollWidth } = page.documentElement;
  if (scrollWidth > 390) found.push(`the page is ${scrollWidth} pixels wide`);
  for (const svg of page.querySelectorAll("svg")) {
    if (svg.parentElement.closest("svg")) continue;
    const edge = svg.getBoundingClientRect(), before = [];
    for (const text of svg.querySelectorAll("text")) {
      if (!text.textContent.trim()) continue;
      const { a, b } = text.getScreenCTM(), box = text.getBoundingClientRect();
      const size = parseFloat(frame.contentWindow.getComputedStyle(text).fontSize) * Math.hypot(a, b);
      if (size < 9) found.push(`${size.toFixed(1)} pixels: ${text.textContent}`);
      const cut = box.left < edge.left - 1 || box.right > edge.right + 1 || box.top < edge.top - 1 || box.bottom > edge.bottom + 1;
      if (cut) found.push(`cut: ${text.textContent}`);
      for (const [other, name] of before) {
        const across = Math.min(box.right, other.right) - Math.max(box.left, other.left);
        const down = Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top);
        if (across > 2 && down > 3) found.push(`touch: ${name}, ${text.textContent}`);
      }
      before.push([box, text.textContent]);
    }
  }
  document.title = JSON.stringify(found);
});
frame.srcdoc = document.querySelector("template").innerHTML;
</script>"#;

/// In a browser: nothing of the page is too small, cut or hidden on a phone. Skipped where there is none.
fn legible_on_a_phone(place: &Place, name: &str) {
    let Some(browser) = common::browser() else { return };
    let probe = format!("<title>not run</title><template>{}</template>{PHONE}", place.text(name));
    std::fs::write(place.path("phone.html"), probe).unwrap();
    let page = Html::parse_document(&drawn(browser, place, "phone.html"));
    let title: String = each(&page, "head > title")[0].text().collect();
    assert_eq!(title, "[]", "{name}");
}

/// The document of a page after its scripts have run.
fn drawn(browser: &str, place: &Place, name: &str) -> String {
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom"])
        .arg(format!("file://{}", place.path(name).display()))
        .output()
        .unwrap();
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn of_a_crush() {
    // with the steps of its level a run knows its errors
    let scene = SCENE.split("[numerics]").next().unwrap();
    let (place, numbers) = reported(scene, &["crush", "scene.toml"], "summary.json");
    assert_eq!(numbers, 15);
    let text = place.text("out/report.html");
    assert_eq!(text.matches("class=\"chart\"").count(), 3);
    // the points of the curve are those of the file
    let page = Html::parse_document(&text);
    let data: Value = serde_json::from_str(&each(&page, "figure.chart script")[0].inner_html()).unwrap();
    let points = data["lines"][0]["points"].as_array().unwrap();
    let curve = place.text("out/curve.csv");
    let loading: Vec<&str> = curve.lines().filter(|line| line.contains(",load,")).collect();
    assert_eq!(points.len(), loading.len());
    let last: Vec<f64> =
        loading.last().unwrap().split(',').skip(2).take(2).map(|v| v.parse().unwrap()).collect();
    assert_eq!(points.last().unwrap()[0].as_f64(), Some(last[0]));
    assert_eq!(points.last().unwrap()[1].as_f64(), Some(last[1]));
}

#[test]
fn of_a_crush_in_plane_strain_with_reloads() {
    let scene = SCENE
        .replace("axisymmetric", "plane-strain")
        .replace("unload = true", "unload = true\nreloads = 1")
        .replace("[tool]", "[substrate]\nradius = \"2 mm\"\ndepth = \"2 mm\"\n[tool]");
    let (place, numbers) = reported(&scene, &["crush", "scene.toml"], "summary.json");
    assert!(numbers >= 10, "{numbers}");
    let text = place.text("out/report.html");
    assert!(
        text.contains("class=\"warnings\"") && text.contains("is not known"),
        "a run that is too coarse says so"
    );
    assert!(
        text.contains("/peak_force_N_per_mm")
            && text.contains("/contact_width_um")
            && text.contains("reloading")
    );
    assert!(text.contains("The first loading, then the reloads"));
    // without the flag there is no page, but where one is: it is written anew
    let end = place.run(&["crush", "scene.toml", "--out", "other", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(!place.names("other").contains(&"report.html".to_string()));
    let end = place.run(&[
        "crush",
        "scene.toml",
        "--out",
        "out",
        "--quiet",
        "--set",
        "material.poissons_ratio=0.25",
    ]);
    assert_eq!(end.status, 0, "{}", end.err);
    let anew = place.text("out/report.html");
    assert!(anew != text, "the page of the run before");
    checked(&anew, &place.text("out/summary.json"));
}

#[test]
fn of_rough_surfaces() {
    let (place, numbers) = reported(ROUGH, &["rough", "scene.toml"], "summary.json");
    assert!(numbers >= 20, "{numbers}");
    let text = place.text("out/report.html");
    assert!(text.contains("true contact on") && text.matches("<img").count() >= 4);
    // each of several has its own
    std::fs::copy(place.path("scene.toml"), place.path("other.toml")).unwrap();
    let end = place.run(&["rough", "scene.toml", "other.toml", "--report", "--out", "both", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    for name in ["scene", "other"] {
        checked(
            &place.text(&format!("both/{name}/report.html")),
            &place.text(&format!("both/{name}/summary.json")),
        );
    }
}

#[test]
fn of_a_sweep_and_of_its_parts_joined() {
    let (place, numbers) = reported(SWEEP, &["calibrate", "scene.toml"], "fit.json");
    assert!(numbers >= 10, "{numbers}");
    let text = place.text("out/report.html");
    assert!(text.contains("The representative strain is") && text.matches("class=\"chart\"").count() == 3);
    let whole = place.text("out/fit.json");
    for part in ["1/2", "2/2"] {
        let name = format!("part-{}", &part[..1]);
        let end =
            place.run(&["calibrate", "scene.toml", "--shard", part, "--out", &name, "--report", "--quiet"]);
        assert_eq!(end.status, 0, "{}", end.err);
        assert!(place.text(&format!("{name}/report.html")).contains("A part of a sweep"));
    }
    let end = place.run(&["calibrate", "merge", "part-1", "part-2", "--out", "all", "--report", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert_eq!(place.text("all/fit.json"), whole);
    assert_eq!(checked(&place.text("all/report.html"), &whole), numbers);
}

#[test]
fn of_an_identification() {
    let (place, numbers) = reported(FIT, &["identify", "scene.toml"], "fit.json");
    assert!(numbers >= 10, "{numbers}");
    assert!(place.text("out/report.html").contains("yield_stress"));
}

/// In a browser: the script finds the values of a chart. Skipped where there is none.
#[test]
fn a_browser_tells_the_values_of_a_curve() {
    let Some(browser) = common::browser() else { return };
    let (place, _) = reported(SCENE, &["crush", "scene.toml"], "summary.json");
    // a copy in which an arrow key was pressed
    let press = "<script>document.querySelector('figure.chart svg').dispatchEvent(new KeyboardEvent('keydown',{key:'ArrowLeft'}));\
                 document.title=document.querySelector('figure.chart output').textContent</script></body>";
    std::fs::write(place.path("probe.html"), place.text("out/report.html").replace("</body>", press))
        .unwrap();
    let page = Html::parse_document(&drawn(browser, &place, "probe.html"));
    let title: String = each(&page, "title")[0].text().collect();
    assert!(title.starts_with("unloading: Depth h (µm) ") && title.contains(", Force F (N) "), "{title}");
    assert_eq!(each(&page, "svg circle.here").len(), 1);
}
