use super::*;

fn cone(slope_deg: f64, e_over_sy: f64, exponent: f64, contact: Contact) -> SharpCone {
    let elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
    let law = HardeningLaw::Hollomon;
    let metal = Hardening { law, yield_stress: 1.0 / e_over_sy, exponent, youngs_modulus: 1.0 };
    SharpCone::new(slope_deg, &elastic, metal, contact)
}

/// Sneddon's cone: K = (2/π) E*/tan β, a = (2/π) h/tan β, S = 2K h, all work returned. The formula knows
/// it from cones alone, within their errors: 0.5 % of K, 2 % of the radius and of the work, 1 % of S.
#[test]
fn a_gentle_hard_cone_is_elastic() {
    let atlas = Atlas::committed().unwrap();
    for (slope, contact) in [(0.5, Contact::Crushed), (0.5, Contact::Indenting), (0.01, Contact::Crushed)] {
        let found = atlas.nearest(&cone(slope, 5.0, 0.2, contact));
        let near = |a: f64, b: f64, share: f64| (a / b - 1.0).abs() < share;
        let sneddon = FRAC_2_PI / 0.91 / slope.to_radians().tan();
        assert!(near(found.k_over_e.value, sneddon, 0.005), "{found:?} {sneddon}");
        assert!(near(found.contact_ratio.value, FRAC_2_PI, 0.02), "{found:?}");
        assert!(near(found.stiffness.value, 2.0 * sneddon, 0.01), "{found:?}");
        assert!(near(found.elastic_share.value, 1.0, 0.02), "{found:?}");
    }
}

#[test]
fn beyond_its_edge_the_atlas_says_nothing_or_that_it_is_carried_on() {
    let atlas = Atlas::committed().unwrap();
    let crushed = Contact::Crushed;
    assert!(atlas.answer(&cone(10.0, 300.0, 0.2, crushed)).is_some_and(|a| a.inside));
    for outside in [
        cone(0.4, 300.0, 0.2, crushed),
        cone(41.0, 300.0, 0.2, crushed),
        cone(10.0, 4.0, 0.2, crushed),
        cone(10.0, 20_000.0, 0.2, crushed),
        cone(10.0, 300.0, 0.7, crushed),
    ] {
        assert!(atlas.answer(&outside).is_none());
        let carried = atlas.nearest(&outside);
        assert!(!carried.inside && carried.k_over_e.value.is_finite());
    }
    // the plateau of K/σ_r
    let plateau = |ratio: f64| atlas.nearest(&cone(20.0, ratio, 0.0, crushed)).k_over_e.value * ratio;
    assert!((plateau(1e6) / plateau(1e4) - 1.0).abs() < 1e-12);
}

/// Perfectly plastic metal is pressed to 3 σ_y under gentle cones and to less under steep ones (slip
/// lines: 2.97 of a flat punch, falling with the slope). On the contact the hardening counts at Tabor's 8
/// % under a Vickers pyramid of 19.7°, to the few per cent that his rule is worth.
#[test]
fn the_plateau_is_near_three_and_falls_with_the_slope() {
    const TABOR: f64 = 0.08 / 0.358;
    let atlas = Atlas::committed().unwrap();
    // over σ_r
    let of = |slope, exponent| {
        let cone = cone(slope, 1000.0, exponent, Contact::Crushed);
        let plateau = atlas.plateau(&cone);
        assert!(plateau.error < 0.05, "{slope}: {plateau:?}");
        plateau.value / atlas.nearest(&cone).stress_over_e
    };
    let mut last = 3.05;
    for slope in [0.2, 1.0, 3.0, 6.0, 10.0, 20.0] {
        let perfect = of(slope, 0.0);
        // the ripple of K and radius together
        assert!(perfect < last + 0.05 && perfect > 2.3, "{slope}: {perfect}");
        last = perfect;
        if slope <= 10.0 {
            let m = cone(slope, 1000.0, 0.3, Contact::Crushed).groups()[1];
            let hardening = of(slope, 0.3) / perfect;
            assert!((hardening / (TABOR / STRAIN).powf(m) - 1.0).abs() < 0.05, "{slope}: {hardening}");
        }
    }
}

#[test]
fn the_file_is_the_text_of_its_formula() {
    let atlas = Atlas::committed().unwrap();
    assert_eq!(Atlas::of_text(&atlas.text()).as_ref(), Some(atlas));
    assert_eq!(Atlas::of_text("1 2\n3 4"), None);
}
