//! Errors of a run, measured by the run itself: its companion is the same scene with every number of the
//! discretisation half as good, and costs a fifth.
//!
//! With Q the force or the contact area at a depth, D = ln(Q_companion/Q) holds what mesh, load step, penalty
//! and substrate do, each of first order nearly or better, and the ripple of both. The smooth part of D over
//! ln h is a parabola for the force; for the area, whose companion ripples more than it differs, the mean, or
//! a line where D is one.
//! * Were all errors of the order p, ln Q would be off by D/(2ᵖ - 1), which is subtracted (Richardson's
//!   extrapolation): with p = 3/2 of the force, whose observed orders lie between 1 and 2, and with p = 1 of
//!   the area.
//! * A penetration d over the depth widens radius or half width by about 3 d, of an order near 0.85: after
//!   Richardson's extrapolation of the first order 3 d (2 - 2^0.85) = 0.6 d is left, and subtracted too.
//! * The bound of the remainder is, added in squares, what another order than the assumed one leaves of the
//!   largest smooth part from a fifth of the depth on, twice the largest rest, and what errors of mesh and
//!   penetration, which have opposite signs, may hide from each other by chance (of the force also what
//!   coarse steps lose): less of a body that dissipates little of its work. The rest of the area is that of
//!   D, or that of the run from a smooth curve of its own where it is less: the companion ripples more. The
//!   rest of the force, which ripples little, is a geometric mean of the two: D alone shows a kink of the
//!   metal.
//! * What extrapolation leaves of the area does not hang on D, scene by scene: the end of the contact is
//!   known to nine tenths of the penetration, and its bound says so even where run and companion agree.
//! * Of a difference that has no order, all counts; of the area with Roache's factor of safety.
//! * Where another asperity begins to carry, run and companion differ by what it carries: that stretch of
//!   depths has no smooth part, parts those before and after it, and counts whole in the bound.
//! * A companion that differs too much is in no asymptotic range: no share of D is subtracted.
//! * The contact of a punch ends in one edge of the mesh all the way, which two meshes place differently: D
//!   of the area is no mean over many edges, has no order, and nothing is subtracted from area and stiffness.
//!   The bound of the area holds that edge.
//! * The mesh that is given cannot be made coarser. Its companion has the other element, of which no order is
//!   known: nothing is subtracted from the force, half of D from the area.
//!
//! Numbers that were chosen on measured scenes stand in `fitted.rs`.
//!
//! The stiffness of the first unloading is that of a punch, 2 E* a: its correction is half of that of the
//! area of an axisymmetric contact.
//!
//! The error stated of the peak is the bound near it, that stated along the curve the largest one, and a row
//! has that of its neighbourhood. A companion that ends before the run says nothing of the peak itself: the
//! largest bound stands for it.
//!
//! The mean pressure is force over area: its bound is theirs in squares. Other values read at the peak or
//! after it are not extrapolated. Their bound is the difference itself (of the residual depth what the
//! lowest order leaves of it), and in squares what the stated errors of force and stiffness near the peak
//! would do to it, since two runs may agree by chance; to that of the stiffness, half the bound of the area
//! there is added in squares. Where the energies of the body leave more of the work over the depths
//! unaccounted, that stands in the place of the second for the elastic fraction. What transfers to better
//! meshes took and gave is added to both whole: the companion has transfers of its own, at other depths.

mod bound;
mod rescale;

pub(super) use bound::Setting;
pub(super) use rescale::rescale_to_force;

use crate::fitted::FITTED;
use crate::record::curve::Curve;
use crate::record::outcome::Outcome;
use crate::record::recorder::stiffer;
use crate::record::rows::{
    AsperityRow, CurveRow, Errors, ErrorsAlong, Phase, Summary, largest_work, work_along,
};
use crate::setup::discretisation::LEAST_COUNTED_DEPTH;
use crate::setup::schedule::UNLOADING_EXPONENT;
use asperity_solver::point::kinematics::Symmetry;
use bound::{Difference, Quantity, longer};
use rescale::{last_loaded, loading_curve, note_peak};

/// Depths at which curves are compared, equally spaced in the logarithm.
const COMPARED_DEPTHS: usize = 81;

/// Half the span of ln h over which the rest of the difference counts for a row.
const HALF_SPAN_OF_ROW: f64 = 0.15;

/// Error of a residual depth over the depth, and of an elastic fraction, below which none is stated.
const LEAST_STATED_ERROR: f64 = 1e-5;

/// Error of a value that is not extrapolated over its difference to the companion, 1/(2ᵖ - 1), at the lowest
/// order p = 0.8 that was seen.
const LEFT_BY_LOWEST_ORDER: f64 = 1.35;

/// Share of the depth that the companion must reach.
const LEAST_COMPANION_DEPTH: f64 = 0.9;

/// Edges that the front of the contact of a companion passes: with fewer, where in its edge it ends decides
/// how the areas differ.
const LEAST_EDGES_PASSED: f64 = 1.0;

/// A quantity of a run and of its companion over the first loading, and how the two differ.
struct Compared {
    difference: Difference,
    curves: [Curve; 2],
    /// Power of F with which the quantity falls as the tool retreats.
    power: f64,
}

/// The errors of a run that a companion reveals.
struct Comparison {
    force: Compared,
    area: Compared,
    /// Depth of the last row of the first loading.
    depth: f64,
    /// True where the companion ended before the run, of whose peak it then says nothing of its own.
    ended_early: bool,
    symmetry: Symmetry,
}

/// Power of the depth over the residual one with which the area falls as the tool retreats: F ∝ (h - h_r)^m
/// and dF/dh = 2 E* a.
const UNLOADING_AREA_EXPONENT: f64 = 2.0 * (UNLOADING_EXPONENT - 1.0);

impl Comparison {
    /// Of `run` and `companion`; `None` where the two cannot be compared: a companion that stopped early says
    /// nothing of what comes after.
    fn new(run: &Outcome, companion: &Outcome, setting: Setting) -> Option<Comparison> {
        let top = last_loaded(&run.rows).filter(|row| row.force > 0.0 && row.contact_area > 0.0)?;
        let curves =
            |of: fn(&CurveRow) -> f64| [&run.rows, &companion.rows].map(|rows| loading_curve(rows, top, of));
        let [force, area] = [curves(|row| row.force), curves(|row| row.contact_area)];
        let (end, other) = (force[0].end(), force[1].end());
        if other < LEAST_COMPANION_DEPTH * end {
            return None;
        }
        let common = end.min(other);
        let onsets = onsets([run, companion], top);
        let compared = |curves: [Curve; 2], of: Quantity, power: f64| {
            Some(Compared { difference: difference(&curves, common, &onsets, of)?, curves, power })
        };
        let elements = companion.numbers.elements_in_contact;
        let of_area = if passes_edges(&area[1], common, elements, setting.symmetry) {
            setting.area()
        } else {
            setting.area().within_an_edge(run.numbers.elements_in_contact, setting.symmetry)
        };
        Some(Comparison {
            force: compared(force, setting.force(dissipated(top)), UNLOADING_EXPONENT)?,
            area: compared(area, of_area, UNLOADING_AREA_EXPONENT)?,
            depth: top.depth,
            ended_early: other < end,
            symmetry: setting.symmetry,
        })
    }

    /// Bound of what is left of a quantity at the peak.
    fn at_peak(&self, of: &Compared) -> f64 {
        if self.ended_early { of.difference.whole() } else { of.difference.near_peak() }
    }

    /// ln(h/h_peak) of a row of the first loading; that of the peak after it.
    fn logarithmic_depth(&self, row: &CurveRow) -> f64 {
        match row.phase {
            Phase::Load if row.depth > 0.0 => (row.depth / self.depth).ln(),
            _ => 0.0,
        }
    }

    /// The errors of what is stated of `run`, before anything is subtracted from it.
    fn errors(&self, run: &Outcome, companion: &Summary) -> Errors {
        let summary = &run.summary;
        let relative = |own: Option<f64>, other: Option<f64>| Some((other? / own? - 1.0).abs());
        let unloading_stiffness = relative(summary.unloading_stiffness, companion.unloading_stiffness);
        let [force, area] = [&self.force, &self.area].map(|of| self.at_peak(of));
        let unloading_stiffness = unloading_stiffness.map(|s| s.hypot(0.5 * area));
        let indirect = force.hypot(unloading_stiffness.unwrap_or(0.0));
        let difference = |own: Option<f64>, other: Option<f64>| Some((other? - own?).abs());
        let share = |x: f64| x * (1.0 - x) * indirect;
        let residual = summary.residual_depth.map(|depth| (depth / summary.peak_depth).clamp(0.0, 1.0));
        let elastic = summary.elastic_fraction.map(|fraction| fraction.clamp(0.0, 1.0));
        let transferred = transferred(&run.rows);
        // F u/(m + 1) comes back over the recovered depth u: with energy that is gone u is shorter by its
        // share
        let recovered = (UNLOADING_EXPONENT + 1.0) * transferred * largest_work(&run.rows)
            / (summary.peak_force * summary.peak_depth);
        Errors {
            force,
            contact_area: area,
            mean_pressure: force.hypot(area),
            depth: None,
            residual_depth: difference(summary.residual_depth, companion.residual_depth).zip(residual).map(
                |(d, r)| {
                    let left = (LEFT_BY_LOWEST_ORDER * d / summary.peak_depth).hypot(share(r));
                    (left + recovered).max(LEAST_STATED_ERROR)
                },
            ),
            elastic_fraction: difference(summary.elastic_fraction, companion.elastic_fraction)
                .zip(elastic)
                .map(|(d, e)| {
                    let left = d.hypot(share(e).max(unaccounted(&run.rows)));
                    (left + transferred).max(LEAST_STATED_ERROR)
                }),
            unloading_stiffness,
        }
    }

    /// The largest bounds along the curve.
    fn errors_along(&self) -> ErrorsAlong {
        let [force, contact_area] = [&self.force, &self.area].map(|of| of.difference.whole());
        ErrorsAlong { force, contact_area, mean_pressure: force.hypot(contact_area) }
    }

    /// The row without the errors that are known.
    fn corrected(&self, row: &CurveRow) -> CurveRow {
        let x = self.logarithmic_depth(row);
        let [stronger, wider] = [&self.force, &self.area].map(|of| of.difference.correction(x));
        CurveRow {
            force: row.force * stronger.exp(),
            contact_area: row.contact_area * wider.exp(),
            contact_radius: row.contact_radius * longer(self.symmetry, wider.exp()),
            mean_pressure: row.mean_pressure * (stronger - wider).exp(),
            ..*row
        }
    }

    /// The share of an asperity in `row` without the errors that are known.
    fn corrected_share(&self, share: &AsperityRow, row: &CurveRow) -> AsperityRow {
        let x = self.logarithmic_depth(row);
        AsperityRow {
            force: share.force * self.force.difference.correction(x).exp(),
            contact_area: share.contact_area * self.area.difference.correction(x).exp(),
            ..*share
        }
    }

    /// Bound of the error of a quantity in a `row` of the run that `summary` is of, the `errors` of which are
    /// known; `None` where there is no force.
    fn row_error(&self, of: &Compared, row: &CurveRow, summary: &Summary, errors: &Errors) -> Option<f64> {
        if row.depth <= 0.0 || row.force <= 0.0 {
            return None;
        }
        let x = self.logarithmic_depth(row);
        match row.phase {
            Phase::Load if x < LEAST_COUNTED_DEPTH.ln() => {
                let depth = row.depth / self.depth;
                let [run, companion] = of.curves.each_ref().map(|curve| curve.logarithm_at(depth));
                let own = (companion - run).abs();
                let first =
                    of.difference.bound(f64::NEG_INFINITY, LEAST_COUNTED_DEPTH.ln() + HALF_SPAN_OF_ROW);
                Some(if own.is_finite() { first.max(own) } else { first.max(1.0) })
            }
            Phase::Load if self.ended_early && x > -HALF_SPAN_OF_ROW => Some(self.at_peak(of)),
            Phase::Load => Some(of.difference.bound(x - HALF_SPAN_OF_ROW, x + HALF_SPAN_OF_ROW)),
            // a curve that is moved by the error of the residual depth: dF/F = m dh/(h - h_residual)
            _ => {
                let residual_depth = summary.residual_depth.unwrap_or(0.0);
                let moved = errors.residual_depth.unwrap_or(0.0) * summary.peak_depth;
                let left = (row.depth - residual_depth)
                    / (summary.peak_depth - residual_depth).max(f64::MIN_POSITIVE);
                let lever = of.power * (1.0 - left).max(0.0) * moved;
                let moved = lever / (row.depth - residual_depth).max(f64::MIN_POSITIVE);
                Some((self.at_peak(of) + moved).min(1.0))
            }
        }
    }
}

/// Whether the front of a contact with so many `elements` across it, the `area` of which is known up to the
/// depth `common`, passes an edge over the depths that count.
fn passes_edges(area: &Curve, common: f64, elements: usize, symmetry: Symmetry) -> bool {
    let grown = area.logarithm_at(common) - area.logarithm_at(LEAST_COUNTED_DEPTH * common);
    let passed = elements as f64 * (1.0 - longer(symmetry, (-grown).exp()));
    passed.is_nan() || passed >= LEAST_EDGES_PASSED
}

/// Stretches of ln(h/h_peak) in which an asperity begins to carry in one of the `runs`, up to where it no
/// longer decides how they differ. `top` is the peak of the first.
fn onsets(runs: [&Outcome; 2], top: &CurveRow) -> Vec<[f64; 2]> {
    let count = runs[0].asperities.iter().map(|row| row.asperity + 1).max().unwrap_or(0);
    let mut onsets: Vec<[f64; 2]> = Vec::new();
    let mut asperities: Vec<[f64; 2]> = (0..count)
        .filter_map(|index| {
            let loading = |run: &'_ Outcome| -> Vec<AsperityRow> {
                let own = run.asperities.iter().filter(|row| row.asperity == index);
                own.take_while(|row| row.phase == Phase::Load).copied().collect()
            };
            let [own, other] = runs.map(loading);
            let counts = own.last()?.force >= FITTED.errors.least_share * top.force;
            let touch = |rows: &[AsperityRow]| {
                let first = rows.iter().position(|row| row.force > 0.0)?;
                Some([rows.get(first.saturating_sub(1))?.depth, rows.get(first)?.depth])
            };
            let ([a, b], [c, d]) = (touch(&own)?, touch(&other)?);
            let ends = [a.min(c), FITTED.errors.onset * b.max(d)];
            counts.then(|| ends.map(|depth| (depth / top.depth).ln()))
        })
        .filter(|[_, end]| *end > LEAST_COUNTED_DEPTH.ln())
        .collect();
    asperities.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for next in asperities {
        match onsets.last_mut() {
            Some(last) if next[0] <= last[1] => last[1] = last[1].max(next[1]),
            _ => onsets.push(next),
        }
    }
    onsets
}

/// Difference of a quantity between the curves of run and companion, up to the depth `common` that both
/// reached, over the logarithm of the depth over that of the peak of the run.
fn difference(
    [own, other]: &[Curve; 2],
    common: f64,
    onsets: &[[f64; 2]],
    of: Quantity,
) -> Option<Difference> {
    let smooth = own.smooth(common);
    let last = (COMPARED_DEPTHS - 1) as f64;
    let places = (0..COMPARED_DEPTHS).map(|i| LEAST_COUNTED_DEPTH.ln() * i as f64 / last).rev();
    let compared = |x: f64| {
        let depth = common * x.exp();
        let value = own.logarithm_at(depth);
        ([x + common.ln(), other.logarithm_at(depth) - value], value - smooth.value(depth).ln())
    };
    let (points, ripple) = places.map(compared).unzip();
    Difference::new(points, ripple, onsets, of)
}

/// The `run` without the errors that its `companion` reveals of force, area and stiffness, and with the
/// bounds of the residuals; as it was where the two cannot be compared.
pub(super) fn extrapolate_and_bound(run: Outcome, companion: &Outcome, setting: Setting) -> Outcome {
    let Some(found) = Comparison::new(&run, companion, setting) else { return run };
    let errors = found.errors(&run, &companion.summary);
    let stiffer = stiffer(setting.symmetry, found.area.difference.correction(0.0).exp());
    let mut asperities = run.asperities;
    for share in &mut asperities {
        if let Some(row) = run.rows.get(share.increment) {
            *share = found.corrected_share(share, row);
        }
    }
    let mut cycles = run.cycles;
    cycles.iter_mut().for_each(|cycle| cycle.peak_force *= found.force.difference.correction(0.0).exp());
    let mut rows: Vec<CurveRow> = run.rows.iter().map(|row| found.corrected(row)).collect();
    let last = rows.len() - 1;
    for (index, row) in rows.iter_mut().enumerate() {
        // at the end of an unloading there is no force
        let is_end = index == last && row.phase != Phase::Load;
        if !is_end {
            row.force_error = found.row_error(&found.force, row, &run.summary, &errors);
            row.area_error = found.row_error(&found.area, row, &run.summary, &errors);
        }
    }
    let summary = Summary {
        unloading_stiffness: run.summary.unloading_stiffness.map(|s| s * stiffer),
        estimated_error: errors.force,
        errors,
        errors_along: found.errors_along(),
        ..run.summary
    };
    let summary = note_peak(summary, &rows);
    Outcome { rows, asperities, cycles, summary, ..run }
}

/// Energy that transfers to better meshes took and gave up to the end of an unloaded run, each counted for
/// itself, over the external work at the peak.
fn transferred(rows: &[CurveRow]) -> f64 {
    let each = rows.windows(2).map(|pair| (pair[1].transfer_energy - pair[0].transfer_energy).abs());
    each.sum::<f64>() / largest_work(rows)
}

/// Share of the work up to this row that yielding and friction have taken.
fn dissipated(row: &CurveRow) -> f64 {
    let taken = row.plastic_work + row.friction_work.unwrap_or(0.0);
    if row.external_work > 0.0 { (taken / row.external_work).clamp(0.0, 1.0) } else { 1.0 }
}

/// Work over the depths of an unloaded run that the energies of its body do not account for, over the
/// external work at the peak.
fn unaccounted(rows: &[CurveRow]) -> f64 {
    let kept = |row: &CurveRow| {
        let rubbed = row.friction_work.unwrap_or(0.0);
        row.elastic_energy + row.plastic_work - row.transfer_energy + rubbed
    };
    rows.last().map_or(0.0, |last| (work_along(rows) - kept(last)).abs() / largest_work(rows))
}

#[cfg(test)]
mod tests;
