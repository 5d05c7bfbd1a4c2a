//! Pages that stand alone: one HTML document each, which needs no network, reads on a phone, on paper and in
//! the dark, and says in words what its pictures show. The curves tell the value under the pointer; without a
//! script they are pictures.

use crate::draw::chart::{Chart, located};
use crate::error::Error;
use crate::results::numbers::{rounded, significant};
use crate::results::output::json;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde::Serialize;
use serde_json::Value;

/// The document of `body` under `title`.
pub fn document(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                link rel="icon" href="data:,";
                style { (PreEscaped(include_str!("page.css"))) }
            }
            body { (body) script { (PreEscaped(include_str!("values.js"))) } }
        }
    };
    page.into_string()
}

/// The report of one run.
pub struct Report<'a> {
    /// Name of the computation.
    pub title: &'a str,
    /// Its object, and how exact it is.
    pub about: &'a str,
    /// The main result, in a sentence or two.
    pub verdict: &'a str,
    /// Doubts about the numbers.
    pub warnings: &'a [String],
    /// The numbers and the pictures.
    pub sections: Markup,
    /// Names and texts of what was asked for.
    pub inputs: &'a [(&'a str, String)],
}

impl Report<'_> {
    /// The document.
    pub fn html(&self) -> String {
        let body = html! {
            header {
                h1 { (self.title) }
                p { (self.about) "; asperity " (env!("CARGO_PKG_VERSION")) "." }
            }
            main {
                p class="finding" { (self.verdict) }
                @if !self.warnings.is_empty() {
                    div class="warnings" role="note" {
                        p { strong { "Warnings" } }
                        ul { @for warning in self.warnings { li { (warning) } } }
                    }
                }
                (self.sections)
                @for (name, text) in self.inputs { details { summary { (name) } pre { (text) } } }
            }
        };
        document(self.title, &body)
    }
}

/// The numbers of a summary; what a page shows of them carries the whole number and the place it has in the
/// file.
pub(crate) struct Numbers(Value);

impl Numbers {
    /// The numbers of `summary`.
    ///
    /// # Errors
    /// A summary that JSON cannot hold.
    pub fn from_summary(summary: &impl Serialize) -> Result<Numbers, Error> {
        serde_json::from_str(&json(summary)?)
            .map(Numbers)
            .map_err(|e| Error::Unfinished(format!("a summary is not JSON: {e}")))
    }

    /// The number at the JSON pointer `place` times `scale` to four digits with its unit; a dash where there
    /// is none.
    pub fn shown(&self, place: &str, scale: f64, unit: &str) -> Markup {
        self.text(place, |value| significant(scale * value) + unit)
    }

    /// The error at `place`, a share, as a percentage of what `of` says.
    pub fn error(&self, place: &str, of: &str) -> Markup {
        self.text(place, |value| format!("{} %{of}", rounded(100.0 * value)))
    }

    fn text(&self, place: &str, text: impl Fn(f64) -> String) -> Markup {
        let value = self.0.pointer(place).and_then(Value::as_f64);
        value.map_or_else(
            || html! { "–" },
            |value| html! { data value=(value) data-place=(place) { (text(value)) } },
        )
    }
}

/// A table with its caption; the first cell of a row names it, the others are numbers.
pub fn table(caption: &str, head: &[&str], rows: &[Vec<Markup>]) -> Markup {
    let class = |i: usize| (i > 0).then_some("number");
    html! {
        div class="wide" { table {
            caption { (caption) }
            thead { tr { @for (i, cell) in head.iter().enumerate() { th scope="col" class=[class(i)] { (cell) } } } }
            tbody { @for row in rows { tr {
                @for (i, cell) in row.iter().enumerate() {
                    @if i == 0 { th scope="row" { (cell) } } @else { td class="number" { (cell) } }
                }
            } } }
        } }
    }
}

/// The drawing `svg` with its caption; `seen` says it to those who cannot see it.
pub fn drawing(svg: &str, seen: &str, caption: &str) -> Markup {
    html! { figure { div class="drawing" { (named(svg, seen)) } figcaption { (caption) } } }
}

/// The picture `png` with its caption.
pub(crate) fn picture(png: &[u8], seen: &str, caption: &str) -> Markup {
    html! { figure { img src=(crate::draw::frame::data_uri(png)) alt=(seen); figcaption { (caption) } } }
}

/// The chart with its caption; its points tell their values.
///
/// # Errors
/// A drawing that fails.
pub fn chart(chart: &Chart, seen: &str, caption: &str) -> Result<Markup, Error> {
    let (svg, window) = located(chart).map_err(Error::Unfinished)?;
    let lines = chart.series.iter().map(|line| {
        let known = line.points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
        serde_json::json!({ "name": line.label, "points": known.collect::<Vec<_>>() })
    });
    let data = serde_json::json!({
        "x": chart.x_label, "y": chart.y_label, "frame": window.frame, "range": window.range,
        "logarithmic": chart.logarithmic,
        "lines": lines.collect::<Vec<_>>(),
    });
    // no text of it may end the element that holds it
    let data = data.to_string().replace('<', "\\u003c");
    Ok(html! {
        figure class="chart" {
            div class="drawing" { (named(&svg, seen)) }
            output { "" }
            script type="application/json" { (PreEscaped(data)) }
            figcaption { (caption) }
        }
    })
}

/// The document `svg` under the name `seen`.
fn named(svg: &str, seen: &str) -> PreEscaped<String> {
    let Some((tag, rest)) = svg.split_once('>') else { return PreEscaped(String::new()) };
    let kept = tag.split(" aria-label=\"").enumerate();
    let tag: String =
        kept.map(|(i, part)| if i == 0 { part } else { part.split_once('"').map_or("", |p| p.1) }).collect();
    let role = if tag.contains(" role=") { "" } else { " role=\"img\"" };
    let seen = html! { (seen) }.into_string();
    PreEscaped(format!("{tag}{role} aria-label=\"{seen}\">{rest}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::chart::Series;

    #[test]
    fn a_drawing_has_one_name() {
        let drawn =
            named("<svg width=\"1\" role=\"img\" aria-label=\"old\" height=\"2\"><g/></svg>", "a < \"b\"");
        assert_eq!(
            drawn.0,
            "<svg width=\"1\" role=\"img\" height=\"2\" aria-label=\"a &lt; &quot;b&quot;\"><g/></svg>"
        );
    }

    /// The place that the script computes of a point is that of its mark in the drawing.
    #[test]
    fn a_chart_knows_where_its_points_are() {
        let line = Series::line("F", vec![[0.0, 0.0], [1.7, 3.1]]).marked();
        for one in [Chart::new("x", "y", [line.clone()]), Chart::new("x", "y", [line]).titled("a title")] {
            let (svg, window) = located(&one).unwrap();
            let [left, top, right, bottom] = window.frame;
            let [x0, y1, x1, y0] = window.range;
            let x = left + 1.7 / (x1 - x0) * (right - left);
            let shift = if one.title.is_empty() { 0.0 } else { top - 14.0 * 8.0 };
            let y = bottom + (3.1 - y0) / (y1 - y0) * (top - bottom) - shift;
            let mark = svg.rsplit("<circle ").next().unwrap().split('"').skip(1).step_by(2);
            let mark: Vec<f64> = mark.take(2).map(|v| v.parse().unwrap()).collect();
            // the library draws at whole numbers of these units, eight to a pixel
            assert!((mark[0] - x).abs() <= 0.51 && (mark[1] - y).abs() <= 0.51, "{mark:?} {x} {y}");
        }
        let text = chart(&Chart::new("</script>", "y", []), "nothing", "").unwrap().into_string();
        assert_eq!(text.matches("</script>").count(), 1);
    }
}
