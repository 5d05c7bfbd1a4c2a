//! Rows of `joint.csv`.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use crate::crush::Phase;
use crate::results::output::row;
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::tables::Fluid;
use asperity_roughness::HeightMap;
use asperity_roughness::joint::{Bounds, Conductors, Flow, JointPoint};

/// The fluid in a joint and the seal that its map stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Seal {
    fluid: Option<Fluid>,
    /// Width over length of the map for flows along x and along y.
    shapes: [f64; 2],
}

impl Seal {
    pub(super) fn new(fluid: Option<&Fluid>, map: &HeightMap) -> Seal {
        let sides = [0, 1].map(|k| map.pixel()[k] * [map.columns(), map.rows()][k] as f64);
        Seal { fluid: fluid.cloned(), shapes: [sides[1] / sides[0], sides[0] / sides[1]] }
    }

    /// Flow of a leak (m³) along an axis in ml/min of a liquid, or mbar l/s of a gas; none of the other kind.
    fn flow(&self, leak: Option<f64>, axis: usize, gas: bool) -> Option<f64> {
        let fluid = self.fluid.as_ref().filter(|fluid| fluid.gas == gas)?;
        // 1 m³ is 1e6 ml, a minute 60 s; 1 Pa m³ is 10 mbar l
        let unit = if gas { 10.0 } else { 6e7 };
        leak.map(|leak| unit * fluid.flow(leak * fluid.seal_over_map(self.shapes[axis])))
    }

    /// True where a gap (m) is too narrow for the law of flow of the gas.
    pub(super) fn is_rare(&self, gap: f64) -> bool {
        self.fluid.as_ref().is_some_and(|fluid| fluid.is_rare(gap))
    }
}

/// A stiffness (Pa/m) as the files have it.
fn in_file(stiffness: f64) -> f64 {
    stiffness / MEGAPASCAL * MICROMETRE
}

row! {
    /// A row of `joint.csv`: the joint at one load, of several maps their mean.
    JointRow(phase: Phase, point: &JointPoint, conductors: &Conductors, seal: &Seal, flow: Flow, bounds: Option<Bounds>) {
        /// `load` from first touch to the largest load; `unload` from there, elastic, on the surface as flow left it. A second loading follows the same curve.
        phase: Phase = phase,
        /// Nominal pressure, MPa.
        pressure_MPa: f64 = point.pressure / MEGAPASCAL,
        /// Mean distance of plane and surface, µm.
        mean_gap_um: f64 = point.mean_gap / MICROMETRE,
        /// Fall of the mean gap since first touch, µm: the overclosure of programs whose bodies just touch.
        approach_um: f64 = point.approach / MICROMETRE,
        /// Contact area over nominal area, by pixels.
        contact_area_ratio: f64 = point.area.ratio,
        /// Stiffness of loading dp/d(approach) per area, MPa/µm: pixels at the limit of pressure carry no more. None without contact, or without a gap.
        stiffness_MPa_per_um: Option<f64> = point.stiffness.map(in_file),
        /// Elastic stiffness per area of the contact as it stands, MPa/µm: every pixel in contact moves with the plane. For vibrations, and for conductances.
        elastic_stiffness_MPa_per_um: Option<f64> = point.elastic.map(|s| in_file(s.gap)),
        /// Thermal conductance per area, W/(m² K), with `[thermal]`: k S/E* of the spots (Barber 2003), and where `gap_conductivity` is given that of the medium.
        conductance_W_per_m2K: Option<f64> = conductors.thermal(point),
        /// Volumetric flow rate times viscosity over pressure difference along x, m³; 0 where tight, none where not asked for or not known.
        leak_x_m3: Option<f64> = flow.leaks[0],
        /// The same along y.
        leak_y_m3: Option<f64> = flow.leaks[1],
        /// Relative error of the elastic stiffness and of the conductances through spots: what it jumps by as rims go from pixel to pixel, and of several maps two standard deviations between them.
        error: Option<f64> = point.whole_error(),
        /// The part of it that is the spread between maps; none of one map.
        repeatability: Option<f64> = point.repeatability,
        /// The plane above the mean height, µm; of a map that is not periodic the dent of the body is in it.
        separation_um: f64 = point.separation / MICROMETRE,
        /// Contact area ratio, corrected for the perimeter of the pixels.
        contact_area_ratio_corrected: f64 = point.area.corrected,
        /// Load over that area, MPa.
        mean_pressure_MPa: Option<f64> =
            (point.area.corrected > 0.0).then(|| point.pressure / point.area.corrected / MEGAPASCAL),
        /// Largest pressure of a pixel, MPa.
        largest_pressure_MPa: f64 = point.largest_pressure / MEGAPASCAL,
        /// Share of the contact area at the limit of pressure.
        limited_share: f64 = point.limited_share,
        /// Elastic stiffness by the way of the plane, MPa/µm: that of a single spot on a large body is 2 E* a over the area of the map. Of a periodic elastic map it is the same.
        plane_stiffness_MPa_per_um: Option<f64> = point.elastic.map(|s| in_file(s.plane)),
        /// Proven lower bound of the elastic stiffness, whatever roughness of the height range `left_out` the map does not hold, MPa/µm.
        elastic_stiffness_low_MPa_per_um: Option<f64> = bounds.map(|b| in_file(b.low)),
        /// Proven upper bound; none where nothing bounds it.
        elastic_stiffness_high_MPa_per_um: Option<f64> = bounds.and_then(|b| b.high).map(in_file),
        /// Electrical conductance per area, S/m², with `[electrical]`.
        electrical_conductance_S_per_m2: Option<f64> = conductors.electrical(point),
        /// Gap of the critical constriction along x, µm; none where no path crosses.
        critical_gap_x_um: Option<f64> = flow.critical_gaps[0].map(|gap| gap / MICROMETRE),
        /// The same along y.
        critical_gap_y_um: Option<f64> = flow.critical_gaps[1].map(|gap| gap / MICROMETRE),
        /// Error of the leak along x: the true one lies between leak/(1 + error) and leak (1 + error).
        leak_x_error: Option<f64> = flow.errors[0],
        /// The same along y.
        leak_y_error: Option<f64> = flow.errors[1],
        /// With a liquid as `[fluid]`: its flow along x, ml/min.
        flow_x_ml_per_min: Option<f64> = seal.flow(flow.leaks[0], 0, false),
        /// The same along y.
        flow_y_ml_per_min: Option<f64> = seal.flow(flow.leaks[1], 1, false),
        /// With a gas as `[fluid]`: its flow along x, mbar l/s.
        flow_x_mbar_l_per_s: Option<f64> = seal.flow(flow.leaks[0], 0, true),
        /// The same along y.
        flow_y_mbar_l_per_s: Option<f64> = seal.flow(flow.leaks[1], 1, true),
        /// Width of the critical constriction along x, from wall to wall, µm: the shortest open stretch through its pixel.
        critical_width_x_um: Option<f64> = flow.critical_widths[0].map(|width| width / MICROMETRE),
        /// The same along y.
        critical_width_y_um: Option<f64> = flow.critical_widths[1].map(|width| width / MICROMETRE),
    }
}
