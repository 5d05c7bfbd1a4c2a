use super::*;
use asperity_material::HardeningMode;
use asperity_material::units::Stress;
use std::sync::Arc;

/// The asperity of the paper.
fn scene() -> Scene {
    Scene {
        symmetry: Symmetry::Axisymmetric,
        accuracy: Accuracy::Standard,
        lateral: Lateral::Free,
        material: Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3),
        asperity: vec![cone()],
        profile: Vec::new(),
        substrate: None,
        tool: plane(),
        loading: Loading { depth: Some(Length(5e-6)), force: None, unload: true, reloads: 0 },
        initial: None,
        output: Output::default(),
        numerics: Numerics::default(),
        mesh: None,
    }
}

fn cone() -> Asperity {
    Asperity {
        height: Some(Length(20e-6)),
        slope_deg: Some(10.0),
        tip_radius: Some(Length(10e-6)),
        ..Asperity::default()
    }
}

fn ball(radius: f64) -> Asperity {
    let (height, slope_deg, tip_radius) = (None, None, None);
    Asperity { radius: Some(Length(radius)), height, slope_deg, tip_radius, ..cone() }
}

fn plane() -> Tool {
    Tool::plane()
}

fn um(value: f64) -> Option<Length> {
    Some(Length(value * 1e-6))
}

#[test]
fn the_papers_asperity_has_its_base_radius() {
    assert_eq!(scene().validate(), Ok(()));
    let form = cone().form().unwrap();
    assert!((form.base_radius() - 114.30e-6).abs() < 0.005e-6 && form.height() == 20e-6);
}

/// A change to the paper's scene that the ranges allow.
#[test]
fn the_ends_of_the_ranges_are_allowed() {
    type Change = fn(&mut Scene);
    let table: &[(&str, Change)] = &[
        ("elastic", |s| s.material.yield_stress = None),
        ("nearly incompressible", |s| s.material.poissons_ratio = 0.4999999),
        ("auxetic", |s| s.material.poissons_ratio = -0.9),
        ("E/sy = 5", |s| s.material.yield_stress = Some(Stress(42e9))),
        ("E/sy = 1e6", |s| s.material.yield_stress = Some(Stress(210e3))),
        ("n = 0.99", |s| s.material.hardening_exponent = Some(0.99)),
        ("voce", |s| saturating(s, 6e8, 0.1)),
        ("n = 0", |s| s.material.hardening_exponent = Some(0.0)),
        ("table", |s| table_of(s, &[(0.0, 300e6), (0.1, 450e6), (0.2, 450e6)])),
        ("kinematic", |s| s.material.hardening_mode = HardeningMode::Kinematic),
        ("table of one point", |s| table_of(s, &[(0.0, 300e6)])),
        ("flat", |s| s.asperity[0].slope_deg = Some(0.1)),
        ("sharp", |s| s.asperity[0].tip_radius = um(0.0)),
        ("blunt", |s| s.asperity[0].tip_radius = um(1300.0)),
        ("steep", |s| s.asperity[0] = Asperity { slope_deg: Some(60.0), tip_radius: None, ..cone() }),
        ("whole height", |s| s.loading.depth = um(20.0)),
        ("force", |s| {
            s.loading =
                Loading { depth: None, force: Some("4 N".parse().unwrap()), unload: false, reloads: 0 }
        }),
        ("ball", |s| s.asperity[0] = ball(50e-6)),
        ("high cap", |s| {
            s.asperity[0] = Asperity { height: um(25.0), ..ball(50e-6) };
        }),
        ("cone on a flat", |s| {
            s.asperity.clear();
            s.tool = Tool::cone(19.7);
        }),
        ("mesh of the asperity", |s| {
            s.mesh = Some(MeshFile { file: "body.msh".into(), unit: um(1.0) });
        }),
        ("ridges", |s| {
            s.symmetry = Symmetry::PlaneStrain;
            s.substrate = Some(Substrate { radius: um(2000.0), depth: um(2000.0) });
        }),
        ("cell of ridges", |s| {
            s.symmetry = Symmetry::PlaneStrain;
            s.lateral = Lateral::Symmetric;
            s.asperity = vec![cone(); 3];
            s.substrate = Some(Substrate { radius: None, depth: um(2000.0) });
        }),
        ("numerics", |s| {
            s.numerics = Numerics {
                element: Some(ElementChoice::Q4),
                elements_in_contact: Some(2),
                steps: Some(10_000),
                penetration: Some(0.1),
                newton_tolerance: Some(1e-13),
                refine: None,
                domain: Some(3.0),
            };
        }),
    ];
    for (name, change) in table {
        let mut scene = scene();
        change(&mut scene);
        assert_eq!(scene.validate(), Ok(()), "{name}");
    }
}

/// The same metal by a table, in Pa.
fn table_of(scene: &mut Scene, points: &[(f64, f64)]) {
    scene.material = Material {
        yield_stress: None,
        hardening_exponent: None,
        hardening_law: HardeningChoice::Table,
        hardening_table: Some(points.iter().map(|&(strain, stress)| (strain, Stress(stress))).collect()),
        ..scene.material.clone()
    };
}

/// The same metal by Voce's law.
fn saturating(scene: &mut Scene, saturation_stress: f64, saturation_strain: f64) {
    let metal = Material { hardening_exponent: None, ..scene.material.clone() };
    scene.material = metal.saturating(Stress(300e6), Stress(saturation_stress), saturation_strain);
}

/// A change, the place that must be named, and words of the message: the value and the allowed range.
#[expect(clippy::too_many_lines, reason = "a table of refusals, a line each")]
#[test]
fn what_makes_no_sense_is_refused_with_place_value_and_range() {
    type Row = (fn(&mut Scene), &'static str, &'static [&'static str]);
    let table: &[Row] = &[
        (|s| s.material.poissons_ratio = 0.5, "material.poissons_ratio", &["0.5", "above -1"]),
        (|s| s.material.poissons_ratio = f64::NAN, "material.poissons_ratio", &["NaN"]),
        (|s| s.material.youngs_modulus = Stress(-1e9), "material.youngs_modulus", &["above 0", "-1 GPa"]),
        (
            |s| s.material.yield_stress = Some(Stress(300e9)),
            "material.yield_stress",
            &["0.21 to 42000 MPa", "300000 MPa"],
        ),
        (|s| s.material.yield_stress = Some(Stress(0.0)), "material.yield_stress", &["not 0 MPa"]),
        (|s| s.material.hardening_exponent = Some(1.0), "material.hardening_exponent", &["below 1", "not 1"]),
        (|s| s.material.hardening_exponent = Some(f64::NAN), "material.hardening_exponent", &["NaN"]),
        (|s| s.material.hardening_exponent = None, "material", &["`hardening_exponent` is missing"]),
        (
            |s| table_of(s, &[(0.0, 300e9)]),
            "material.hardening_table[0]",
            &["0.21 to 42000 MPa", "300000 MPa"],
        ),
        (
            |s| table_of(s, &[(0.0, 3e8), (0.1, 3e11)]),
            "material.hardening_table[1]",
            &["at most", "210000 MPa"],
        ),
        (
            |s| table_of(s, &[(0.0, 3e8), (0.0, 4e8)]),
            "material.hardening_table[1]",
            &["must grow", "0 follows 0"],
        ),
        (|s| table_of(s, &[]), "material.hardening_table", &["from 1 to 100000 points"]),
        (
            |s| s.material.hardening_law = HardeningChoice::Table,
            "material.yield_stress",
            &["first point is the yield stress", "remove it"],
        ),
        (
            |s| {
                table_of(s, &[]);
                s.material.hardening_table = None;
            },
            "material.hardening_law",
            &["hardening_file = \"curve.csv\""],
        ),
        (
            |s| {
                table_of(s, &[(0.0, 3e8)]);
                s.material.hardening_file = Some("curve.csv".into());
            },
            "material.hardening_file",
            &["does not go with `hardening_table`"],
        ),
        (
            |s| {
                s.material.hardening_mode = HardeningMode::Kinematic;
                (s.material.yield_stress, s.material.hardening_exponent) = (None, None);
            },
            "material.hardening_mode",
            &["needs a metal that yields"],
        ),
        (|s| s.material.kinematic_share = Some(0.5), "material.kinematic_share", &["needs hardening_mode"]),
        (
            |s| {
                s.material.hardening_mode = HardeningMode::Kinematic;
                s.material.kinematic_share = Some(1.5);
            },
            "material.kinematic_share",
            &["at most 1, not 1.5"],
        ),
        (
            |s| s.material.hardening_file = Some("curve.csv".into()),
            "material.hardening_file",
            &["hardening_law = \"table\""],
        ),
        (
            |s| s.material.saturation_stress = Some(Stress(6e8)),
            "material.saturation_stress",
            &["hardening_law = \"voce\""],
        ),
        (
            |s| s.material.saturation_strain = Some(0.1),
            "material.saturation_strain",
            &["hardening_law = \"voce\""],
        ),
        (
            |s| saturating(s, 2e8, 0.1),
            "material.saturation_stress",
            &["above yield_stress, 300 MPa", "not 200"],
        ),
        (|s| saturating(s, 3e11, 0.1), "material.saturation_stress", &["at most", "210000 MPa"]),
        (|s| saturating(s, f64::NAN, 0.1), "material.saturation_stress", &["NaN"]),
        (|s| saturating(s, 6e8, 0.0), "material.saturation_strain", &["above 0, not 0"]),
        (|s| saturating(s, 6e8, f64::INFINITY), "material.saturation_strain", &["finite"]),
        (
            |s| {
                saturating(s, 6e8, 0.1);
                s.material.hardening_exponent = Some(0.1);
            },
            "material.hardening_exponent",
            &["which saturates", "remove it"],
        ),
        (
            |s| {
                saturating(s, 6e8, 0.1);
                s.material.saturation_strain = None;
            },
            "material",
            &["`saturation_strain` is missing", "saturation_strain = 0.1"],
        ),
        (
            |s| s.material.hardening_law = HardeningChoice::Voce,
            "material.hardening_exponent",
            &["which saturates"],
        ),
        (|s| s.asperity[0].height = um(-20.0), "asperity[0].height", &["above 0", "-20 um"]),
        (|s| s.asperity[0].height = None, "asperity[0]", &["`height` is missing"]),
        (|s| s.asperity[0].slope_deg = Some(90.0), "asperity[0].slope_deg", &["below 90", "not 90"]),
        (|s| s.asperity[0].slope_deg = Some(0.0), "asperity[0].slope_deg", &["above 0", "not 0"]),
        (
            |s| s.asperity[0].tip_radius = um(1400.0),
            "asperity[0].tip_radius",
            &["below 1.3164", "not 1.4 mm"],
        ),
        (|s| s.asperity[0].tip_radius = um(-1.0), "asperity[0].tip_radius", &["at least 0", "-1 um"]),
        (
            |s| s.asperity[0].valley_radius = um(700.0),
            "asperity[0].valley_radius",
            &["at most 648.2", "700 um"],
        ),
        (|s| s.asperity[0].spacing = um(-5.0), "asperity[0].spacing", &["at least 0"]),
        (|s| s.asperity[0].radius = um(5.0), "asperity[0].slope_deg", &["does not go with `radius`"]),
        (|s| s.asperity.push(ball(0.0)), "asperity[1].radius", &["above 0"]),
        (
            |s| s.asperity[0] = Asperity { height: um(26.0), ..ball(50e-6) },
            "asperity[0].height",
            &["at most 25 um", "not 26 um"],
        ),
        (|s| s.asperity.clear(), "asperity", &["at least one [[asperity]]"]),
        (|s| s.loading.depth = um(500.0), "loading.depth", &["at most 20 um", "not 500 um"]),
        (|s| s.loading.depth = um(0.0), "loading.depth", &["above 0"]),
        (|s| s.loading.depth = None, "loading", &["depth = \"5 um\" or force"]),
        (|s| s.loading.force = Some("4 N".parse().unwrap()), "loading.force", &["does not go with `depth`"]),
        (
            |s| {
                s.loading =
                    Loading { depth: None, force: Some("4 N/mm".parse().unwrap()), unload: true, reloads: 0 }
            },
            "loading.force",
            &["plane strain", "4 N"],
        ),
        (|s| s.loading.reloads = 1001, "loading.reloads", &["from 0 to 1000", "not 1001"]),
        (|s| (s.loading.unload, s.loading.reloads) = (false, 2), "loading.reloads", &["unload = true"]),
        (|s| s.tool.radius = um(1.0), "tool.radius", &["does not belong to a plane"]),
        (|s| s.tool.shape = ToolShape::Cone, "tool", &["`slope_deg` of the cone is missing"]),
        (
            |s| s.tool = Tool { shape: ToolShape::Cone, slope_deg: Some(90.0), ..s.tool.clone() },
            "tool.slope_deg",
            &["below 90"],
        ),
        (
            |s| s.tool = Tool { shape: ToolShape::Sphere, radius: um(4.0), ..s.tool.clone() },
            "loading.depth",
            &["at most", "4 um"],
        ),
        (|s| s.symmetry = Symmetry::PlaneStrain, "substrate", &["is missing"]),
        (
            |s| s.substrate = Some(Substrate { radius: um(50.0), depth: um(100.0) }),
            "substrate.radius",
            &["at least 114.30", "not 50 um"],
        ),
        (|s| s.substrate = Some(Substrate { radius: None, depth: um(0.0) }), "substrate.depth", &["above 0"]),
        (|s| s.mesh = Some(MeshFile { file: "".into(), unit: None }), "mesh.file", &["empty"]),
        (
            |s| {
                s.asperity.clear();
                s.mesh = Some(MeshFile { file: "body.msh".into(), unit: None });
            },
            "mesh",
            &["[[asperity]]"],
        ),
        (|s| s.numerics.steps = Some(0), "numerics.steps", &["from 1 to 10000", "not 0"]),
        (|s| s.numerics.elements_in_contact = Some(1), "numerics.elements_in_contact", &["from 2 to 1000"]),
        (|s| s.numerics.penetration = Some(0.5), "numerics.penetration", &["0.000001 to 0.1"]),
        (|s| s.numerics.newton_tolerance = Some(0.0), "numerics.newton_tolerance", &["to 0.001"]),
        (|s| s.numerics.domain = Some(1.0), "numerics.domain", &["from 3 to 10000"]),
    ];
    for (change, path, words) in table {
        let mut scene = scene();
        change(&mut scene);
        let error = scene.validate().expect_err(path);
        assert_eq!(error.path, *path, "{error}");
        for word in *words {
            assert!(error.message.contains(word), "{word}: {error}");
        }
    }
}

#[test]
fn fields_are_written_when_they_are_asked_for() {
    let output = |fields: Option<&[Field]>, every| Output { fields: fields.map(<[Field]>::to_vec), every };
    assert_eq!(Output::default().interval(), 0);
    assert_eq!(output(None, Some(7)).interval(), 7);
    assert_eq!(output(None, Some(7)).fields().len(), 6);
    assert_eq!(output(Some(&[Field::VonMises]), None).interval(), 5);
    assert_eq!(output(Some(&[]), Some(7)).interval(), 0);
}

#[test]
fn a_tool_goes_no_deeper_than_itself_and_the_body() {
    assert_eq!(scene().deepest(), 20e-6);
    let sphere = Tool { shape: ToolShape::Sphere, radius: um(500.0), ..plane() };
    let shallow = Some(Substrate { radius: None, depth: um(100.0) });
    let mut ball_on_flat = Scene { asperity: vec![], tool: sphere, ..scene() };
    assert_eq!(ball_on_flat.deepest(), 500e-6);
    ball_on_flat.substrate = shallow;
    assert!((ball_on_flat.deepest() / 100e-6 - 1.0).abs() < 2e-3);
    ball_on_flat.loading.depth = um(200.0);
    assert_eq!(ball_on_flat.validate().unwrap_err().path, "loading.depth");
    let cone_on_flat = Tool { shape: ToolShape::Cone, slope_deg: Some(20.0), ..plane() };
    assert_eq!(Scene { asperity: vec![], tool: cone_on_flat, ..scene() }.deepest(), f64::INFINITY);
}

/// A paraboloid that is known up to 3 µm, as another crate hands it in.
#[derive(Debug)]
struct Known;

impl asperity_mesh::ToolOutline for Known {
    fn name(&self) -> &str {
        "known"
    }
    fn parameters(&self) -> Vec<(&str, f64)> {
        Vec::new()
    }
    fn penetration(&self, [r, z]: [f64; 2]) -> asperity_mesh::Penetration {
        let curvature = [-1e4, 0.0, 0.0];
        asperity_mesh::Penetration { depth: z - 5e3 * r * r, slope: [-1e4 * r, 1.0], curvature }
    }
    fn deepest(&self) -> f64 {
        3e-6
    }
}

#[test]
fn an_outline_of_functions_says_where_it_ends() {
    let mut scene = Scene { asperity: vec![], tool: Tool::custom(Arc::new(Known)), ..scene() };
    let error = scene.validate().unwrap_err();
    assert_eq!(error.path, "loading.depth");
    assert!(error.message.contains("at most 3 um") && !error.message.contains("measure"), "{error}");
    scene.loading.depth = um(3.0);
    assert_eq!(scene.validate(), Ok(()));
}

/// A law that is vertical at first yield, and says so.
#[derive(Debug)]
struct Vertical;

impl asperity_material::FlowCurve for Vertical {
    fn name(&self) -> &str {
        "vertical"
    }
    fn parameters(&self) -> Vec<(&str, f64)> {
        Vec::new()
    }
    fn flow(&self, plastic_strain: f64) -> [f64; 2] {
        [300e6 + 500e6 * plastic_strain.sqrt(), 250e6 / plastic_strain.sqrt()]
    }
}

#[test]
fn a_law_without_a_slope_at_first_yield_is_refused() {
    let material = Material::elastic_body(Stress(210e9), 0.3).hardening_as(Arc::new(Vertical));
    let error = Scene { material, ..scene() }.validate().unwrap_err();
    assert_eq!(error.path, "material.custom");
    for words in ["at the plastic strain 0 must be finite", "not inf Pa", "a little further on"] {
        assert!(error.message.contains(words), "{error}");
    }
}

#[test]
fn the_names_of_laws_are_those_of_a_file() {
    for law in HardeningChoice::OF_FILES {
        assert_eq!(serde_json::to_value(law).unwrap(), law.name());
    }
    // every law but that of a program
    let schema = serde_json::to_string(&schemars::schema_for!(HardeningChoice)).unwrap();
    assert_eq!(schema.matches("\"const\"").count(), HardeningChoice::OF_FILES.len(), "{schema}");
    let mut unnamed = scene();
    unnamed.material = Material::elastic_body(Stress(210e9), 0.3);
    unnamed.material.hardening_law = HardeningChoice::Custom;
    let error = unnamed.validate().unwrap_err();
    assert!(HardeningChoice::OF_FILES.iter().all(|law| error.message.contains(law.name())), "{error}");
}

/// 0.34e² + 15e cells of 18 kB under a contact: 0.01 GB with the 24 of `standard`, 6.4 GB with 1000.
#[test]
fn a_run_of_gigabytes_is_told_with_its_key() {
    assert_eq!(scene().costly(), None);
    let mut fine = scene();
    fine.numerics.elements_in_contact = Some(1000);
    fine.numerics.element = Some(ElementChoice::Q8r);
    let told = fine.costly().unwrap();
    assert_eq!(told.path, "numerics.elements_in_contact");
    assert!(told.message.contains("about 6 GB") && told.message.contains("fewer"), "{}", told.message);
    let many = Scene { asperity: vec![scene().asperity[0].clone(); 300], ..scene() };
    assert_eq!(many.costly().unwrap().path, "asperity");
    fine.mesh = Some(MeshFile { file: "body.msh".into(), unit: None });
    assert_eq!(fine.costly(), None);
}

#[test]
fn what_has_no_effect_is_named() {
    let unused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene();
        change(&mut scene);
        assert_eq!(scene.validate(), Ok(()));
        scene.unused().into_iter().map(|e| e.path).collect::<Vec<_>>()
    };
    let sides = |spacing: f64, radius: Option<Length>| {
        move |s: &mut Scene| {
            s.lateral = Lateral::Symmetric;
            s.asperity[0].spacing = um(spacing);
            s.substrate = Some(Substrate { radius, depth: um(500.0) });
        }
    };
    assert_eq!(unused(&|_| ()), [""; 0]);
    // the asperity of the scene and half a gap
    let cell = scene().asperity[0].form().unwrap().base_radius() + 15e-6;
    assert_eq!(unused(&sides(30.0, Some(Length(cell)))), [""; 0]);
    assert_eq!(unused(&sides(30.0, None)), [""; 0]);
    assert_eq!(unused(&sides(30.0, um(2000.0))), ["substrate.radius"]);
    assert_eq!(
        unused(&|s| {
            s.mesh = Some(MeshFile { file: "body.msh".into(), unit: None });
            s.substrate = Some(Substrate { radius: None, depth: um(500.0) });
            s.numerics.elements_in_contact = Some(12);
        }),
        ["substrate.depth", "numerics.elements_in_contact"]
    );
    assert_eq!(
        unused(&|s| {
            s.substrate = Some(Substrate { radius: um(2000.0), depth: um(2000.0) });
            s.numerics.domain = Some(100.0);
        }),
        ["numerics.domain"]
    );
}
