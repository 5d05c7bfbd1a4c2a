//! Claims about the charts.

use super::*;

/// Width that a phone of 390 pixels leaves for a picture of the book.
const PHONE: f64 = 334.0;
/// Smallest letters, in pixels, that a person reads on it.
const LEGIBLE: f64 = 9.0;

/// The numbers behind `name="` in a document.
fn numbers(svg: &str, name: &str) -> Vec<f64> {
    let start = format!(" {name}=\"");
    svg.split(&start).skip(1).filter_map(|part| part.split('"').next()?.parse().ok()).collect()
}

/// However many lines a chart has and however long its title is, a phone shows it whole with legible letters.
#[test]
fn letters_stay_legible_on_a_phone() {
    for (lines, letters) in [(1, 7), (3, 20), (10, 32)] {
        let series = (0..lines)
            .map(|i| Series::line(format!("{i:a>letters$}"), vec![[0.0, 0.0], [1.0, f64::from(i)]]).marked());
        let title =
            "Load curve: nominal pressure over the travel of the plane; not drawn: the unloading of one";
        let names = ["travel of the plane from first touch (µm)", "mean pressure on its contact (MPa)"];
        let svg = svg(&Chart::new(names[0], names[1], series).titled(title)).unwrap();
        let width = numbers(&svg, "width")[0];
        let smallest = numbers(&svg, "font-size").into_iter().fold(f64::INFINITY, f64::min);
        let shown = smallest / f64::from(FINE_PIXELS) * PHONE / width;
        assert!(shown >= LEGIBLE, "{lines} lines: {width} pixels wide, letters of {shown}");
        assert_eq!(svg.matches("<tspan").count(), 2, "the title has two lines");
    }
}

/// The entries of a legend follow each other in rows no wider than the chart.
#[test]
fn a_legend_fills_its_rows() {
    let entry = |letters: usize| ("a".repeat(letters), Sample::Line(INK, [1, 0]));
    let legend = [entry(10), entry(10), entry(30), entry(10), entry(90)];
    let places = legend_places(SIZE.0, &legend);
    assert_eq!(places.iter().map(|place| place[1]).collect::<Vec<_>>(), [0, 0, 1, 1, 2]);
    for (place, entry) in places.iter().zip(&legend).take(4) {
        assert!(place[0] + room(entry) <= SIZE.0, "{place:?}");
    }
}

/// Both ends of an interval are one entry.
#[test]
fn lines_of_one_name_share_their_entry() {
    let end = |y| Series::line("95 % interval", vec![[0.0, y], [1.0, y]]);
    let svg = svg(&Chart::new("x", "y", [end(1.0), end(2.0)])).unwrap();
    assert_eq!(svg.matches("95 % interval").count(), 1);
}

/// Each axis is logarithmic for itself: the mark lies where the window says.
#[test]
fn one_axis_may_be_logarithmic_alone() {
    let line = Series::line("F", vec![[0.5, 1.0], [30.0, 7.0]]).marked();
    for logarithmic in [[true, false], [false, true], [true, true]] {
        let chart = Chart { logarithmic, ..Chart::new("x", "y", [line.clone()]) };
        let (svg, window) = located(&chart).unwrap();
        let place = |value: f64, k: usize| if logarithmic[k] { value.log10() } else { value };
        let ([left, top, right, bottom], [x0, y1, x1, y0]) = (window.frame, window.range);
        let x = left + (place(30.0, 0) - x0) / (x1 - x0) * (right - left);
        let y = bottom + (place(7.0, 1) - y0) / (y1 - y0) * (top - bottom);
        let mark = svg.rsplit("<circle ").next().unwrap();
        let [cx, cy] = ["cx", "cy"].map(|name| numbers(&format!(" {mark}"), name)[0]);
        // the library draws at whole numbers of these units
        assert!((cx - x).abs() <= 0.51 && (cy - y).abs() <= 0.51, "{logarithmic:?}: {cx} {x} {cy} {y}");
    }
}
