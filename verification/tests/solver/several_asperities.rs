//! Claims on asperities side by side:
//! * three ridges between symmetric sides carry three times what one carries in a cell of its own width:
//!   1e-8; and the forces of the three sum to the whole: 1e-10;
//! * with free sides they do so to 1 % when the pitch is four depths of the substrate;
//! * the contact widths that the mesh of a row is made for are those that a run finds: 20 %;
//! * a neighbour that is never touched changes the force by at most 0.5 %;
//! * a touched ring of line load P sinks the centre by 2P/E* at any radius: 2 %;
//! * over a substrate of fixed depth D on a rigid base a ring beyond 4 D leaves the central curve alone: 1 %;
//! * a ring that is touched half way does not widen what is said of the peak: force and area there differ
//!   from those of `standard` by less than both state, which is less than 10 %;
//! * in plane strain twice the depth of the substrate adds (2P/πE*) ln 2 to the depth: 1 % elastic, 5 % in
//!   plastic metal.
//!
//! Sources: symmetry; the ring: Johnson 1985 §3.2, point loads P ds at equal distance b give u = ∫P ds/(πE*
//! b) = 2P/E*; the depth: Johnson 1985 §2.3, u = (2P/πE*) ln(depth) + constant. 1e-8: what is asked; Newton's
//! tolerance is set to 1e-11. 1 % and 0.5 %: what is asked. 2 %: a contact is not small against its distance
//! (0.6 % measured). 5 %: the shift is a difference of two curves that ripple differently.

use asperity_material::units::Length;
use asperity_simulation::scene::{Accuracy, Lateral, Scene, Symmetry};
use asperity_verification::several::{
    FOOT, LOW_MEMBER, Member, PAPER, depth_at, interpolated, of_asperity, row, three_over_one, whole,
    worst_difference,
};
use asperity_verification::single_asperity::{crush, prepared};

#[test]
fn three_ridges_between_symmetric_sides_carry_three_times_one() {
    let member = Member { spacing: 30e-6, ..PAPER };
    let curve = |count: usize| {
        let mut scene =
            row(Symmetry::PlaneStrain, Lateral::Symmetric, &vec![member; count], Some([1e-3, 1e-3])).unwrap();
        scene.numerics.newton_tolerance = Some(1e-11);
        scene.numerics.steps = Some(12);
        let outcome = crush(&scene).unwrap();
        assert!(outcome.stopped.is_none());
        for row in &outcome.rows {
            let shares = outcome.asperities.iter().filter(|share| share.increment == row.increment);
            let sum: f64 = shares.map(|share| share.force).sum();
            assert!(count == 1 || (sum - row.force).abs() <= 1e-10 * row.force, "{sum:e} of {:e}", row.force);
        }
        whole(&outcome)
    };
    let (one, three) = (curve(1), curve(3));
    assert_eq!(one.len(), three.len());
    for (a, b) in one.iter().zip(&three).skip(1) {
        assert!((b[0] / a[0] - 1.0).abs() < 1e-8, "depth {:e} and {:e}", a[0], b[0]);
        assert!((b[1] / (3.0 * a[1]) - 1.0).abs() < 1e-8, "force {:e} and {:e}", a[1], b[1]);
    }
}

#[test]
fn three_free_ridges_at_four_depths_carry_three_times_one() {
    let difference = three_over_one(800e-6, 200e-6, Accuracy::Draft).unwrap();
    assert!(difference < 0.01, "{difference:e}");
}

/// Flat caps on rings, most of whose depth goes into the body at large: the cut of the plane is up to eight
/// times as wide. 20 %: the mesh is as fine as asked for within that.
#[test]
fn the_mesh_of_a_row_is_made_for_the_contacts_that_a_run_finds() {
    let mut scene = row(Symmetry::Axisymmetric, Lateral::Free, &[PAPER; 3], None).unwrap();
    for (asperity, (height, slope, tip)) in
        scene.asperity.iter_mut().zip([(18.1e-6, 8.0, 40e-6), (20e-6, 9.0, 1e-3), (18.9e-6, 4.0, 1e-3)])
    {
        asperity.height = Some(Length(height));
        asperity.slope_deg = Some(slope);
        asperity.tip_radius = Some(Length(tip));
    }
    scene.loading.depth = Some(Length(2.5e-6));
    let prepared = prepared(&scene).unwrap();
    let outcome = crush(&scene).unwrap();
    let last = outcome.asperities.last().unwrap().increment;
    let found = outcome.asperities.iter().filter(|row| row.increment == last);
    for (row, expected) in found.zip(&prepared.half_widths) {
        let expected = expected * prepared.units.length;
        let width = 0.5 * (row.contact_right - row.contact_left);
        let found = if width.is_nan() { 0.0 } else { width };
        assert!((found - expected).abs() <= 0.2 * expected, "{found:e} m, expected {expected:e} m");
    }
}

#[test]
fn untouched_neighbours_do_not_change_the_force() {
    // the same substrate: the ring only fills the valley beside the cone
    let size = Some([20e-3, 20e-3]);
    let curve = |members: &[Member]| {
        let mut scene = row(Symmetry::Axisymmetric, Lateral::Free, members, size).unwrap();
        scene.accuracy = Accuracy::Standard;
        let outcome = crush(&scene).unwrap();
        assert!(outcome.stopped.is_none());
        whole(&outcome)
    };
    let difference = worst_difference(&curve(&[PAPER, LOW_MEMBER]), &curve(&[PAPER]));
    assert!(difference <= 0.005, "{difference:e}");
}

fn without_yielding(mut scene: Scene) -> Scene {
    scene.material.yield_stress = None;
    scene.material.hardening_exponent = None;
    scene
}

/// A cone with a ring at `pitch` over a substrate of this radius and depth (m): the depth that the touched
/// ring adds at the peak, over 2P/E*, and the largest difference of the central force. Beside it the same
/// body with a ring too low to be touched, so that both meshes ripple alike.
fn ring(pitch: f64, size: [f64; 2], elastic: bool) -> [f64; 2] {
    let cone = Member { spacing: pitch - 2.0 * FOOT, ..PAPER };
    let scene = |ring: Member| {
        let mut scene = row(Symmetry::Axisymmetric, Lateral::Free, &[cone, ring], Some(size)).unwrap();
        // a difference of two curves: their own errors must be small against it
        scene.accuracy = Accuracy::Standard;
        if elastic { without_yielding(scene) } else { scene }
    };
    let alone = whole(&crush(&scene(LOW_MEMBER)).unwrap());
    let outcome = crush(&scene(PAPER)).unwrap();
    let (centre, ring) = (of_asperity(&outcome, 0), of_asperity(&outcome, 1));
    let modulus = scene(PAPER).material.elastic().reduced_modulus();
    let share = |depth: f64| {
        let line_load = interpolated(&ring, depth) / (std::f64::consts::TAU * pitch);
        (depth - depth_at(&alone, interpolated(&centre, depth))) * modulus / (2.0 * line_load)
    };
    let peak = centre.last().unwrap()[0];
    [mean(SHARES.map(|s| share(s * peak))), worst_difference(&centre, &alone)]
}

/// Shares of the peak over which small differences of two draft curves are averaged: at one of them alone the
/// ripple of the mesh is up to a tenth of the difference.
const SHARES: [f64; 13] = [0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0];

fn mean<const N: usize>(values: [f64; N]) -> f64 {
    values.iter().sum::<f64>() / N as f64
}

#[test]
fn a_ring_sinks_the_centre_wherever_it_is() {
    for (pitch, elastic) in [(300e-6, true), (1200e-6, true), (1200e-6, false)] {
        let size = 400.0 * pitch;
        let [ratio, difference] = ring(pitch, [size, size], elastic);
        assert!((ratio - 1.0).abs() < 0.02, "pitch {pitch:e}: {ratio} of 2P/E*");
        assert!(difference > 0.1, "the ring must be felt: {difference:e}");
    }
}

#[test]
fn a_rigid_base_decouples_rings() {
    let depth = 200e-6;
    let [_, difference] = ring(4.0 * depth + 2.0 * FOOT, [5e-3, depth], false);
    assert!(difference < 0.01, "{difference:e}");
}

#[test]
fn doubling_the_substrate_depth_adds_a_logarithm() {
    // the load stretches a shallow body sideways, which helps its metal flow: 0.90 of the logarithm at 2 mm,
    // 0.99 at 20
    for (elastic, depth, tolerance) in [(true, 2e-3, 0.01), (false, 20e-3, 0.05)] {
        let scene = |depth: f64| {
            let substrate = Some([10.0 * depth, depth]);
            let mut scene = row(Symmetry::PlaneStrain, Lateral::Free, &[PAPER], substrate).unwrap();
            scene.accuracy = Accuracy::Standard;
            if elastic { without_yielding(scene) } else { scene }
        };
        let curve = |depth: f64| whole(&crush(&scene(depth)).unwrap());
        let (shallow, deep) = (curve(depth), curve(2.0 * depth));
        let peak = deep.last().unwrap()[1];
        let modulus = scene(depth).material.elastic().reduced_modulus();
        let ratio = mean(SHARES.map(|s| {
            let force = s * peak;
            let shift = depth_at(&deep, force) - depth_at(&shallow, force);
            shift / (2.0 * force / (std::f64::consts::PI * modulus) * 2.0_f64.ln())
        }));
        assert!((ratio - 1.0).abs() < tolerance, "elastic {elastic}: {ratio} of (2P/πE*) ln 2");
    }
}

/// The shear under a steep flank ends before the shells around the row spread sideways: no cell is inside
/// out.
#[test]
fn a_steep_ridge_alone_has_sound_cells() {
    for slope in [40.0, 50.0, 60.0] {
        let mut scene = asperity_verification::single_asperity::scene(Accuracy::Draft).unwrap();
        scene.symmetry = Symmetry::PlaneStrain;
        scene.asperity[0].slope_deg = Some(slope);
        let size = Some(asperity_material::units::Length(4e-3));
        scene.substrate = Some(asperity_simulation::scene::Substrate { radius: size, depth: size });
        let problem = asperity_verification::single_asperity::prepared(&scene).unwrap();
        let quality = problem.mesh.quality().unwrap();
        assert!(quality.min_scaled_jacobian > 0.05, "{slope}°: {quality:?}");
    }
}

/// The outer ring is 2 µm lower and is touched at two fifths of the depth, where run and companion differ by
/// what it carries. Measured at `draft`: 2.3 % of the force at the peak and 64 % along the curve, 4.0 % of
/// the area; `standard` is 0.2 and 1.7 % away.
#[test]
fn a_ring_that_is_touched_half_way_does_not_widen_the_error_of_the_peak() {
    let members = [PAPER, Member { height: 18e-6, ..PAPER }];
    let [draft, standard] = [Accuracy::Draft, Accuracy::Standard].map(|accuracy| {
        let mut scene = row(Symmetry::Axisymmetric, Lateral::Free, &members, None).unwrap();
        scene.accuracy = accuracy;
        let outcome = crush(&scene).unwrap();
        assert!(outcome.stopped.is_none());
        let (errors, along) = (outcome.summary.errors, outcome.summary.errors_along);
        assert!(errors.force < 0.1 && errors.contact_area < 0.1, "{accuracy:?}: {errors:?}");
        assert!(along.force >= errors.force && along.contact_area >= errors.contact_area);
        // the onset itself is said to be uncertain
        let touched =
            of_asperity(&outcome, 1).iter().find(|[_, force]| *force > 0.0).map(|[depth, _]| *depth);
        let onset = outcome.rows.iter().find(|row| Some(row.depth) == touched).unwrap();
        assert!(onset.force_error.unwrap() > 2.0 * errors.force, "{accuracy:?}: {onset:?}");
        assert!(along.force > 2.0 * errors.force, "{accuracy:?}: {along:?}");
        outcome.summary
    });
    for (of, a, b, stated) in [
        ("force", draft.peak_force, standard.peak_force, draft.errors.force + standard.errors.force),
        (
            "area",
            draft.contact_area,
            standard.contact_area,
            draft.errors.contact_area + standard.errors.contact_area,
        ),
    ] {
        assert!((a / b - 1.0).abs() < stated, "{of}: {a:e} and {b:e}, stated {stated}");
    }
}
