//! Twins of one cone, and of one ball, with its imprint, at a finer level than that of the fit.

use crate::cases::{Case, indented, material};
use asperity::tables::{Accuracy, Tool};
use asperity::{Length, units::MICROMETRE};
use asperity_calibration::fit::SplitMix;
use asperity_calibration::indentation::{residual_surface, solve};
use asperity_identification::interpolation::{linear_between, smooth};
use asperity_numerics::sobol::Sobol;
use asperity_simulation::record::rows::Phase;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::twins::{Cone, Normal, indenter};
use rayon::prelude::*;
use std::fmt::Write;

/// The depth of every imprint of a cone, µm.
const DEPTH: f64 = 2.0;
/// The radius of the ball, µm, and the depth over it: a contact of 0.4 radii where the surface neither sinks
/// in nor piles up.
const BALL: f64 = 10.0;
const BALL_DEPTH: f64 = 0.08;
/// Slope of the cone of 70.3° half apex angle, degrees.
pub const SLOPE_DEG: f64 = 19.7;
/// Standard deviations: of a force, of a height over the depth; and of offset and tilt over the depth.
pub const NOISE: [f64; 3] = [0.01, 0.02, 0.005];
/// Points of loading, of unloading (with that of the peak) and of the imprint.
pub const POINTS: [usize; 3] = [200, 100, 150];

/// Place of a height of the imprint, in contact radii: out to three.
pub fn place(k: usize) -> f64 {
    3.0 * k as f64 / (POINTS[2] - 1) as f64
}

/// Contact radii over which heights are alike.
pub const LENGTHS: [f64; 2] = [0.05, 0.3];

/// The tool that leaves an imprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Indenter {
    /// A cone of 70.3° half apex angle.
    Cone,
    /// A ball.
    Ball,
}

impl Indenter {
    fn name(self) -> &'static str {
        match self {
            Indenter::Cone => "cone",
            Indenter::Ball => "ball",
        }
    }

    /// The key of the fit file.
    fn key(self) -> String {
        match self {
            Indenter::Cone => "{ shape = \"cone\", half_apex_deg = 70.3 }".into(),
            Indenter::Ball => format!("{{ shape = \"sphere\", radius = \"{BALL} um\" }}"),
        }
    }
}

/// `count` metals of E/σ_y from 100 to 600 and n from 0 to 0.3, each with the curve of a tool (200 points of
/// loading, 100 of unloading) and its imprint (150 points to three contact radii), both with noise. Heights
/// are alike over `length` contact radii, one of [`LENGTHS`].
pub fn imprints(tool: Indenter, count: usize, length: f64) -> Vec<Case> {
    let folder = std::env::temp_dir().join(concat!("asperity-imprints-", env!("CARGO_PKG_VERSION")));
    std::fs::create_dir_all(&folder).expect("can be made");
    let sobol = Sobol::new(3).expect("three dimensions");
    let metal = |i: usize| {
        let at = |k: usize| sobol.coordinate(k, i + 1);
        let e = (10.0 * 60.0 * 3.5_f64.powf(at(0))).round() / 10.0;
        [e, (1e3 * e / (100.0 * 6.0_f64.powf(at(1)))).round(), (300.0 * at(2)).round() / 1e3]
    };
    // files of cones came first, and bear no name of a tool
    let of = if tool == Indenter::Cone { String::new() } else { format!("{}-", tool.name()) };
    let one = |i: usize| {
        let [e, s, n] = metal(i);
        let curve = folder.join(format!("{of}curve-{i}.csv"));
        let imprints = LENGTHS.map(|length| folder.join(format!("{of}imprint-{i}-{length}.csv")));
        if !curve.exists() || imprints.iter().any(|imprint| !imprint.exists()) {
            let mut noise = Normal(SplitMix(i as u64 + 77));
            let (text, left, depth) = match tool {
                Indenter::Cone => cone([e, s, n], &mut noise)?,
                Indenter::Ball => ball([e, s, n], &mut noise)?,
            };
            std::fs::write(&curve, text).ok()?;
            for (length, imprint) in LENGTHS.iter().zip(&imprints) {
                let noise = Normal(SplitMix(noise.0.0));
                std::fs::write(imprint, left.profile(depth, *length, noise)).ok()?;
            }
        }
        let modulus = format!("[\"{:.1} GPa\", \"{:.1} GPa\"]", 0.8 * e, 1.2 * e);
        let mut fit = material(&modulus, 0.3, ["50 MPa", "10 GPa"]);
        let _ = write!(
            fit,
            "[[curve]]\nfile = \"{of}curve-{i}.csv\"\ntool = {}\nnoise = \"1 %\"\nimprint = \"{of}imprint-{i}-{length}.csv\"\n",
            tool.key()
        );
        Some(Case {
            name: format!("{} with imprint {i}", tool.name()),
            youngs_modulus: e,
            yield_stress: s,
            exponent: n,
            stresses: Vec::new(),
            fit,
            folder: folder.clone(),
        })
    };
    (0..count).into_par_iter().with_max_len(1).filter_map(one).collect()
}

/// The imprint of a tool: the surface after unloading, places and heights over the depth, 0 far away; and the
/// contact radius under load.
pub struct Left {
    pub surface: Vec<[f64; 2]>,
    pub contact_radius: f64,
}

impl Left {
    /// From `points` in any order, above any level.
    pub fn new(mut points: Vec<[f64; 2]>, contact_radius: f64) -> Option<Left> {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let far = points.last()?[1];
        points.iter_mut().for_each(|point| point[1] -= far);
        Some(Left { surface: points, contact_radius })
    }

    /// A measured profile of an imprint of `depth` µm, as a table: heights with roughness that is alike over
    /// `length` contact radii, an offset and a tilt.
    fn profile(&self, depth: f64, length: f64, mut noise: Normal) -> String {
        let alike = (-place(1) / length).exp();
        let [offset, tilt] = [NOISE[2] * noise.draw(), NOISE[2] * noise.draw()];
        let mut rough = noise.draw();
        let mut text = "r_um,z_um\n".to_string();
        for k in 0..POINTS[2] {
            let (place, r) = (place(k), place(k) * self.contact_radius);
            let height = linear_between(&self.surface, r) + NOISE[1] * rough + offset + tilt * place;
            let _ = writeln!(text, "{:.6},{:.6}", depth * r, depth * height);
            rough = alike * rough + (1.0 - alike * alike).sqrt() * noise.draw();
        }
        text
    }
}

/// The curve of a metal (GPa, MPa, n) under a cone by finite elements at `reference`, its imprint and depth.
fn cone([e, s, n]: [f64; 3], noise: &mut Normal) -> Option<(String, Left, f64)> {
    let cone = indenter(SLOPE_DEG, 1e3 * e / s, n);
    let analyses = Analyses::default();
    let (found, _) = solve(&cone, Accuracy::Reference, &analyses).ok()?;
    let left = residual_surface(&cone, Accuracy::Reference, &analyses).ok()?;
    let computed = Cone {
        half_apex_deg: 90.0 - SLOPE_DEG,
        e_over_sy: 1e3 * e / s,
        exponent: n,
        k_over_e: found.k_over_e,
        recovery: found.recovery,
    };
    let curve = computed.curve(e, DEPTH, POINTS[0], NOISE[0], noise);
    Some((curve, Left::new(left.points, left.contact_radius)?, DEPTH))
}

/// The same under a ball.
fn ball(metal: [f64; 3], noise: &mut Normal) -> Option<(String, Left, f64)> {
    let depth = BALL_DEPTH * BALL;
    let tool = Tool::sphere(Length(BALL * MICROMETRE));
    let done = indented(metal, tool, Length(depth * MICROMETRE), Accuracy::Reference)?;
    let surface = &done.frames.last()?.surface;
    let over = |x: f64| x / (depth * MICROMETRE);
    let turn = done.curve.iter().rposition(|row| row.phase == Phase::Load)?;
    let (loading, unloading) = (&done.curve[..=turn], &done.curve[turn..]);
    let most = loading.last()?;
    let left =
        Left::new(surface.iter().map(|p| [over(p.r), over(p.z)]).collect(), over(most.contact_radius))?;
    let mut text = "depth_um,force_mN\n".to_string();
    let mut row = |share_of_depth: f64, force: f64| {
        let _ = writeln!(
            text,
            "{:.8},{:.10}",
            depth * share_of_depth,
            1e3 * force * (1.0 + NOISE[0] * noise.draw())
        );
    };
    let points: Vec<[f64; 2]> =
        loading.iter().filter(|r| r.force > 0.0).map(|r| [over(r.depth).ln(), r.force.ln()]).collect();
    for k in 1..=POINTS[0] {
        let share = k as f64 / POINTS[0] as f64;
        row(share, smooth(&points, share.ln()).exp());
    }
    // in F^(2/3) the unloading is nearly straight
    let bent = |force: f64| -(force / most.force).max(0.0).powf(2.0 / 3.0);
    let points: Vec<[f64; 2]> = unloading.iter().map(|r| [bent(r.force), over(r.depth)]).collect();
    for k in 1..POINTS[1] {
        let force = most.force * (1.0 - k as f64 / POINTS[1] as f64);
        row(smooth(&points, bent(force)), force);
    }
    Some((text, left, depth))
}
