//! Twins of one cone with its imprint, at a finer level than that of the fit.

use crate::cases::{Case, material};
use asperity::tables::Accuracy;
use asperity_calibration::fit::SplitMix;
use asperity_calibration::indentation::{residual_surface, solve};
use asperity_identification::interpolation::linear_between;
use asperity_numerics::sobol::Sobol;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::twins::{Cone, Normal, indenter};
use rayon::prelude::*;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The depth of every imprint, µm.
const DEPTH: f64 = 2.0;
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

/// `count` metals of E/σ_y from 100 to 600 and n from 0 to 0.3, each with the curve of a cone of 70.3° (200
/// points of loading, 100 of unloading) and its imprint (150 points to three contact radii), both with noise.
/// Heights are alike over `length` contact radii, one of [`LENGTHS`].
pub fn imprints(count: usize, length: f64) -> Vec<Case> {
    let folder = std::env::temp_dir().join(concat!("asperity-imprints-", env!("CARGO_PKG_VERSION")));
    std::fs::create_dir_all(&folder).expect("can be made");
    let sobol = Sobol::new(3).expect("three dimensions");
    let metal = |i: usize| {
        let at = |k: usize| sobol.coordinate(k, i + 1);
        let e = (10.0 * 60.0 * 3.5_f64.powf(at(0))).round() / 10.0;
        [e, (1e3 * e / (100.0 * 6.0_f64.powf(at(1)))).round(), (300.0 * at(2)).round() / 1e3]
    };
    let one = |i: usize| {
        let [e, s, n] = metal(i);
        let curve = folder.join(format!("curve-{i}.csv"));
        let imprints = LENGTHS.map(|length| folder.join(format!("imprint-{i}-{length}.csv")));
        if !curve.exists() || imprints.iter().any(|imprint| !imprint.exists()) {
            write([e, s, n], i as u64, &curve, &imprints)?;
        }
        let modulus = format!("[\"{:.1} GPa\", \"{:.1} GPa\"]", 0.8 * e, 1.2 * e);
        let mut fit = material(&modulus, 0.3, ["50 MPa", "10 GPa"]);
        let _ = write!(
            fit,
            "[[curve]]\nfile = \"curve-{i}.csv\"\ntool = {{ shape = \"cone\", half_apex_deg = 70.3 }}\nnoise = \"1 %\"\nimprint = \"imprint-{i}-{length}.csv\"\n"
        );
        Some(Case {
            name: format!("imprint {i}"),
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

/// Writes the curve of a metal (GPa, MPa, n) by finite elements at `reference`, and its imprint with each of
/// the roughnesses.
fn write([e, s, n]: [f64; 3], seed: u64, curve: &Path, imprints: &[PathBuf]) -> Option<()> {
    let cone = indenter(SLOPE_DEG, 1e3 * e / s, n);
    let analyses = Analyses::default();
    let (found, _) = solve(&cone, Accuracy::Reference, &analyses).ok()?;
    let left = residual_surface(&cone, Accuracy::Reference, &analyses).ok()?;
    let mut noise = Normal(SplitMix(seed + 77));
    let computed = Cone {
        half_apex_deg: 90.0 - SLOPE_DEG,
        e_over_sy: 1e3 * e / s,
        exponent: n,
        k_over_e: found.k_over_e,
        recovery: found.recovery,
    };
    std::fs::write(curve, computed.curve(e, DEPTH, POINTS[0], NOISE[0], &mut noise)).ok()?;
    let mut surface = left.points.clone();
    surface.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let far = surface.last()?[1];
    let radius = left.contact_radius;
    for (length, imprint) in LENGTHS.iter().zip(imprints) {
        let mut noise = Normal(SplitMix(noise.0.0));
        let alike = (-place(1) / length).exp();
        let [offset, tilt] = [NOISE[2] * noise.draw(), NOISE[2] * noise.draw()];
        let mut rough = noise.draw();
        let mut text = "r_um,z_um\n".to_string();
        for k in 0..POINTS[2] {
            let place = place(k);
            let height =
                linear_between(&surface, place * radius) - far + NOISE[1] * rough + offset + tilt * place;
            let _ = writeln!(text, "{:.6},{:.6}", DEPTH * place * radius, DEPTH * height);
            rough = alike * rough + (1.0 - alike * alike).sqrt() * noise.draw();
        }
        std::fs::write(imprint, text).ok()?;
    }
    Some(())
}
