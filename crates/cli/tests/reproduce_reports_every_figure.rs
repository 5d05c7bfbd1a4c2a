//! `asperity reproduce` writes one self-contained report, does nothing twice, and goes on where it was
//! stopped.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use scraper::{Html, Selector};
use std::collections::HashSet;
use std::hash::{BuildHasher, RandomState};
use std::process::{Command, Stdio};
use std::time::{Duration, SystemTime};

/// A place where the paper's asperity was reproduced at draft.
fn reproduced() -> Place {
    let place = Place::with_scene("");
    let end = place.run(&["reproduce", "--accuracy", "draft", "--only", "fig1,fig2", "--out", "out"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(end.out.contains("out/report/index.html"), "{}", end.out);
    place
}

fn changed(place: &Place, name: &str) -> SystemTime {
    std::fs::metadata(place.path(name)).unwrap().modified().unwrap()
}

#[test]
fn a_second_run_computes_nothing_and_writes_the_same_report() {
    let place = reproduced();
    let (curve, report) = ("out/parts/single-asperity/curve.csv", "out/report/index.html");
    let (before, text) = (changed(&place, curve), place.text(report));
    let end = place.run(&["reproduce", "--accuracy", "draft", "--only", "fig1,fig2", "--out", "out"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(end.err.contains("only the report is written"), "{}", end.err);
    assert_eq!((changed(&place, curve), place.text(report)), (before, text));
}

/// A run that was killed has no stamp on the part it was busy with; another accuracy has another key.
#[test]
fn what_is_not_done_is_done_again() {
    let place = reproduced();
    let part = "out/parts/single-asperity";
    let summary = place.text(&format!("{part}/summary.json"));
    std::fs::remove_file(place.path(&format!("{part}.done"))).unwrap();
    std::fs::write(place.path(&format!("{part}/curve.csv")), "half a li").unwrap();
    let end = place.run(&["reproduce", "--accuracy", "draft", "--only", "fig2", "--out", "out", "--quiet"]);
    assert_eq!((end.status, end.out.as_str()), (0, ""), "{}", end.err);
    assert!(place.text(&format!("{part}/curve.csv")).lines().count() > 20);
    let force = |text: &str| -> f64 {
        serde_json::from_str::<serde_json::Value>(text).unwrap()["peak_force_N"].as_f64().unwrap()
    };
    assert_eq!(force(&summary), force(&place.text(&format!("{part}/summary.json"))));
}

/// Killed four times at moments drawn anew in every run of this test: no part that was done is begun again,
/// the cases in the sweep's journal are taken as they are, seconds included.
#[test]
fn a_run_killed_anywhere_goes_on() {
    let place = Place::with_scene("");
    let args = ["reproduce", "--accuracy", "draft", "--only", "fig2,fig8", "--out", "out", "--quiet"];
    let journal = || std::fs::read_to_string(place.path("out/parts/calibrate.journal")).unwrap_or_default();
    let mut kept = String::new();
    for _ in 0..4 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .current_dir(place.path(""))
            .args(args)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let moment = RandomState::new().hash_one(0) % 3000;
        eprintln!("killed after {moment} ms");
        std::thread::sleep(Duration::from_millis(moment));
        let _ = child.kill();
        child.wait().unwrap();
        // only its last line may be torn
        let (now, whole) = (journal(), kept.rfind('\n').map_or(0, |end| end + 1));
        assert!(now.starts_with(&kept[..whole]) || place.path("out/parts/calibrate.done").exists());
        kept = now;
    }
    let done = place.path("out/parts/single-asperity.done").exists();
    let before = done.then(|| changed(&place, "out/parts/single-asperity/curve.csv"));
    let end = place.run(&args);
    assert_eq!(end.status, 0, "{}", end.err);
    let cases = place.text("out/parts/calibrate/cases.csv");
    assert_eq!(cases.lines().count(), 481);
    let rows: HashSet<&str> = cases.lines().collect();
    let whole_lines = kept.rsplit_once('\n').map_or("", |(lines, _)| lines);
    let lost = whole_lines
        .lines()
        .skip(1)
        .filter(|line| !rows.iter().any(|row| line.contains(&format!("\"{row}\""))))
        .count();
    assert_eq!(lost, 0, "{kept}");
    if let Some(before) = before {
        assert_eq!(changed(&place, "out/parts/single-asperity/curve.csv"), before);
    }
    let written: serde_json::Value = serde_json::from_str(&place.text("out/report/claims.json")).unwrap();
    assert!(
        written["numbers"]["coefficient"].is_number() && written["numbers"]["force_at_5_um_N"].is_number()
    );
}

#[test]
fn the_report_stands_alone_and_its_links_resolve() {
    let place = reproduced();
    let text = place.text("out/report/index.html");
    let page = Html::parse_document(&text);
    let select = |selector: &str| Selector::parse(selector).unwrap();
    let ids: HashSet<&str> = page.select(&select("[id]")).filter_map(|e| e.value().attr("id")).collect();
    let links: Vec<&str> = page.select(&select("a")).filter_map(|e| e.value().attr("href")).collect();
    assert!(links.len() > 5);
    for link in links {
        assert!(link.strip_prefix('#').is_some_and(|id| ids.contains(id)), "{link}");
    }
    for element in page.select(&select("img, image, link, script, iframe")) {
        let source = ["src", "href"].iter().find_map(|name| element.value().attr(name)).unwrap_or("data:");
        assert!(source.starts_with("data:"), "{source:.60}");
    }
    assert!(page.select(&select("figure svg")).count() >= 3);
    // every claim of the overview is one of claims.json
    let claims: serde_json::Value = serde_json::from_str(&place.text("out/report/claims.json")).unwrap();
    let rows = page.select(&select("#overview tbody tr")).count();
    assert_eq!(rows, claims["claims"].as_array().unwrap().len());
    assert_eq!(place.text("out/report/claims.md").lines().count(), rows + 2);
}

/// In a browser: it loads, and no picture is broken. Skipped where there is none.
#[test]
fn a_browser_opens_the_report() {
    let Some(browser) = common::browser() else { return };
    let place = reproduced();
    // a copy that tells, as its title, how many pictures did not decode
    let probe = "<script>{let sum=0,broken=0;const tell=b=>{broken+=b;document.title='pictures '+(++sum)+' broken '+broken};\
                 for(const i of [...document.images,...document.querySelectorAll('image')]){const p=new Image();\
                 p.onload=()=>tell(0);p.onerror=()=>tell(1);p.src=i.src||i.getAttribute('href')}}</script></body>";
    let text = place.text("out/report/index.html").replace("</body>", probe);
    std::fs::write(place.path("probe.html"), text).unwrap();
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom"])
        .arg(format!("file://{}", place.path("probe.html").display()))
        .output()
        .unwrap();
    let dom = String::from_utf8_lossy(&output.stdout);
    let title = dom.split("<title>").nth(1).and_then(|t| t.split("</title>").next()).unwrap_or_default();
    assert!(title.ends_with("broken 0") && !title.contains("pictures 0"), "{title}");
}

#[test]
fn what_it_cannot_reproduce_is_said() {
    let place = Place::with_scene("");
    let end = place.run(&["reproduce", "--only", "fig10", "--out", "out"]);
    assert_eq!(end.status, 2);
    assert!(end.err.contains("fig10") && end.err.contains("fig11"), "{}", end.err);
    assert!(place.names("out").is_empty());
    let list = place.run(&["reproduce", "--list"]);
    assert!(list.out.lines().count() == 16 && list.out.contains("table2"), "{}", list.out);
    // a folder of somebody else
    std::fs::create_dir(place.path("thesis")).unwrap();
    std::fs::write(place.path("thesis/chapter.tex"), "years").unwrap();
    let end = place.run(&["reproduce", "--only", "fig2", "--accuracy", "draft", "--out", "thesis"]);
    assert_eq!((end.status, place.names("thesis")), (2, vec!["chapter.tex".to_string()]));
    assert!(end.err.contains("chapter.tex"), "{}", end.err);
}
