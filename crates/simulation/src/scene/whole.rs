//! Properties of a scene as a whole: its extent, its asperities, the curves that were fitted to measured
//! outlines.

use super::measured::span_of;
use super::{Asperity, Lateral, LineProfile, Scene, Smoothing, Symmetry};
use asperity_mesh::outline::Span;

impl Scene {
    /// From the axis to the outermost foot of the asperities, in plane strain half their whole width; m.
    pub(super) fn extent(&self) -> f64 {
        if let Some(Ok(line)) = self.profile.first().map(LineProfile::line) {
            let [left, right] = line.outline.ends();
            return 0.5 * (right - left);
        }
        let last = self.asperity.len().saturating_sub(1);
        let widths = self.asperity.iter().enumerate().filter_map(|(i, a)| {
            let form = a.form().ok()?;
            // half of the first asperity lies beyond the axis
            let own = if i == 0 && self.symmetry == Symmetry::Axisymmetric {
                form.feet()[1]
            } else {
                2.0 * form.base_radius()
            };
            Some(own + if i < last { a.spacing.map_or(0.0, |s| s.0) } else { 0.0 })
        });
        let total: f64 = widths.sum();
        if self.symmetry == Symmetry::Axisymmetric { total } else { 0.5 * total }
    }

    /// True where symmetric sides repeat the asperities.
    pub(crate) fn has_repeated_asperities(&self) -> bool {
        self.lateral == Lateral::Symmetric && !(self.asperity.is_empty() && self.profile.is_empty())
    }

    /// Width of the body of repeated asperities beyond the last of them: half of the last gap, m.
    pub(crate) fn end_gap(&self) -> f64 {
        let last = self.asperity.last().filter(|_| self.has_repeated_asperities());
        last.and_then(|a| a.spacing).map_or(0.0, |s| 0.5 * s.0)
    }

    /// Number of asperities, those of a measured line included.
    pub fn asperity_count(&self) -> usize {
        let line = self.profile.first().and_then(|p| p.line().ok()).map_or(0, |line| line.asperities.len());
        self.asperity.len() + line
    }

    /// Height of the highest asperity, m.
    pub fn highest(&self) -> f64 {
        let line = self.profile.first().and_then(|p| p.line().ok()).map(|line| line.height);
        let forms = self.asperity.iter().filter_map(|a| a.form().ok());
        forms.map(|f| f.height()).chain(line).fold(0.0, f64::max)
    }

    /// The fitted curve of each measured outline of the scene, in numbers.
    pub fn smoothings(&self) -> Vec<Smoothing> {
        let asperity = |(i, a): (usize, &Asperity)| {
            let points = a.points.as_ref()?;
            let fit = points.fit(span_of(points.metres()), a.tolerance, false).ok()?;
            Some(Smoothing::new(format!("asperity[{i}]"), points, &fit))
        };
        let tool = || {
            let points = self.tool.points.as_ref()?;
            let fit = points.fit(Span::Half, self.tool.tolerance, true).ok()?;
            Some(Smoothing::new("tool", points, &fit))
        };
        let lines = self.profile.iter().enumerate();
        let lines = lines.filter_map(|(i, line)| line.smoothing(format!("profile[{i}]")));
        self.asperity.iter().enumerate().filter_map(asperity).chain(lines).chain(tool()).collect()
    }
}
