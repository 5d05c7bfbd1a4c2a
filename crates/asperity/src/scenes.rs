//! The scenes that the program holds: those of the paper's figures and those to begin with, as texts.

macro_rules! held {
    ($($(#[$about:meta])* $name:ident = $file:literal;)*) => {
        $($(#[$about])* pub const $name: &str = include_str!(concat!("../scenes/", $file, ".toml"));)*

        /// Every scene with the name of its file, without its ending.
        pub const ALL: &[(&str, &str)] = &[$(($file, $name)),*];
    };
}

held! {
    /// The asperity of the paper, 10 degrees.
    SINGLE_ASPERITY = "single-asperity";
    /// Three asperities of 10 degrees: a cone and two rings.
    THREE_IDENTICAL = "three-identical";
    /// Three ridges of 10 degrees.
    THREE_IDENTICAL_PLANE_STRAIN = "three-identical-plane-strain";
    /// A cone and two rings of slopes around 1 to 4 degrees.
    SLOPES_1_4 = "slopes-1-4";
    /// Three ridges of slopes around 1 to 4 degrees.
    SLOPES_1_4_PLANE_STRAIN = "slopes-1-4-plane-strain";
    /// A cone and two rings of slopes around 5 to 8 degrees.
    SLOPES_5_8 = "slopes-5-8";
    /// Three ridges of slopes around 5 to 8 degrees.
    SLOPES_5_8_PLANE_STRAIN = "slopes-5-8-plane-strain";
    /// A cone and two rings of slopes around 9 to 12 degrees.
    SLOPES_9_12 = "slopes-9-12";
    /// Three ridges of slopes around 9 to 12 degrees.
    SLOPES_9_12_PLANE_STRAIN = "slopes-9-12-plane-strain";
    /// A rigid cone into a flat body.
    CONE_INDENTATION = "cone-indentation";
    /// The ground surface of the paper.
    ROUGH_GROUND = "rough-ground";
    /// The milled surface of the paper.
    ROUGH_MILLED = "rough-milled";
    /// The sanded surface of the paper.
    ROUGH_SANDED = "rough-sanded";
    /// A self-affine surface.
    ROUGH_SELF_AFFINE = "rough-self-affine";
    /// A ball into a flat body.
    BALL = "ball";
    /// A measured surface under a plane, to begin with.
    SURFACE = "surface";
    /// A sweep of cones, to begin with.
    SWEEP = "sweep";
    /// A study over a scene, to begin with.
    STUDY = "study";
    /// A fit of measured curves, to begin with.
    FIT = "fit";
}
