"""Tables that the functions take as keywords; written by scripts/python-keys from the schemas of the program."""

# fmt: off
from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypedDict

from numpy.typing import ArrayLike


class AsperityTable(TypedDict, total=False):
    """One asperity as written: a cone (`height`, `slope_deg`, …), a sphere (`radius`) or a measured outline
    (`profile`).
    """

    height: str
    """Base plane to the real (rounded) summit."""

    points: Sequence[Sequence[str]]
    """Instead of `profile`: r and z, point by point."""

    profile: str
    """A measured outline instead of the keys above but `spacing`: a csv file, relative to the scene file, with columns
    such as r_um,z_um (or nm, mm, m), z up. Half of it from its axis outward, in plane strain also the whole ridge from
    foot to foot. A resolved scene has `points` in its place.
    """

    radius: str
    """Radius of a spherical (cylindrical) asperity; excludes the keys above but `height` and `spacing`. Its height is a
    quarter of the radius if absent, and half the radius at most: the foot of half a ball is vertical.
    """

    slope_deg: float
    """Angle β between flank and base plane, degrees."""

    spacing: str
    """Flat distance between its outer foot and the next asperity; absent: 0."""

    tip_radius: str
    """Radius of the sphere (cylinder) tangent to the flanks that rounds the tip; absent or 0: sharp."""

    tolerance: str
    """Of a measured outline: standard deviation of its heights that is smoothed away; absent: as far as neighbouring
    points scatter.
    """

    valley_radius: str
    """Radius of the fillet at its outer foot; absent or 0: sharp."""


class LoadingTable(TypedDict, total=False):
    """Its goal, from first touch of the body as it was then. It was unloaded, whatever `unload` says."""

    depth: str
    """Tool travel from first touch of the highest summit, corrected for penetration."""

    force: str
    """Force at the peak, instead of `depth`; per length of ridge in plane strain."""

    reloads: int
    """Number of times that the tool then returns to the same depth (or force) and retreats again; needs `unload`."""

    unload: bool
    """True where the tool then retreats to zero force."""


class AreaFunctionTable(TypedDict, total=False):
    """Area function of the tip by which the reading of Oliver and Pharr goes; absent: the outline of the tool."""

    coefficients: Sequence[float]
    """C0, C1, C2, …: one to nine."""

    unit: str
    """Unit of the depths that the coefficients are for, as a word: areas come in its square."""


class ToolTable(TypedDict, total=False):
    """Its tool; absent: a rigid plane."""

    area_function: AreaFunctionTable
    """Area function of the tip by which the reading of Oliver and Pharr goes; absent: the outline of the tool."""

    edge_radius: str
    """Punch: radius of the arc between its flat end and its flank, above 0 and at most `radius`."""

    file: str
    """Profile: a csv file, relative to the scene file, with columns such as r_um,z_um (or nm, mm, m): from the apex on
    the axis outward, z up. It must be convex. A resolved scene has `points` in its place.
    """

    friction: float | Literal["sticking"]
    """Coulomb's coefficient of friction between tool and surface, from 0 to 2, or "sticking": what touches sticks.
    Absent: 0.
    """

    half_apex_deg: float
    """Cone: angle between its flank and its axis, degrees, instead of `slope_deg`."""

    machine_compliance: str
    """Compliance of the load frame, displacement per force; reported depths include its deflection."""

    points: Sequence[Sequence[str]]
    """Instead of `file`: r and z, point by point."""

    poissons_ratio: float
    """Poisson's ratio of the tool, beside its modulus; in (-1, 0.5)."""

    radius: str
    """Sphere, punch: its radius."""

    shape: Literal["plane", "cone", "sphere", "profile", "berkovich", "vickers", "conospherical", "punch"]
    """Its outline."""

    slope_deg: float
    """Cone: angle between its flank and the horizontal, degrees."""

    tip_radius: str
    """Cone, pyramid: tip radius; absent or 0: sharp."""

    tolerance: str
    """Profile: standard deviation of its heights that is smoothed away; absent: as far as neighbouring points scatter.
    """

    youngs_modulus: str
    """Young's modulus of the tool; absent: rigid. Its deflection as a half-space is part of depth, stiffness and the
    reduced modulus of Oliver and Pharr.
    """


class LoadTable(TypedDict, total=False):
    """One load that was removed again."""

    loading: LoadingTable
    """Its goal, from first touch of the body as it was then. It was unloaded, whatever `unload` says."""

    tool: ToolTable
    """Its tool; absent: a rigid plane."""


_InitialTable = TypedDict("_InitialTable", {"from": "str"}, total=False)


class InitialTable(_InitialTable, total=False):
    """Earlier loads of the body; absent: it starts undeformed and free of stress."""

    load: Sequence[LoadTable]
    """The loads that went before, in their order; absent: those of `from`."""


class MaterialTable(TypedDict, total=False):
    """The material of asperities and substrate. A scene that starts from an earlier result has that of the result."""

    hardening_exponent: float
    """Hardening exponent n in [0, 1), 0: perfect plasticity; required beside a yield stress of `hollomon` and `swift`.
    """

    hardening_file: str
    """For hardening_law = "table": a csv file, relative to the scene file, whose first line is
    plastic_strain,yield_stress_MPa, or total_strain in place of plastic_strain, of which stress over Young's modulus is
    subtracted; or an input file of Abaqus or CalculiX with *PLASTIC, whose unit of stress its *ELASTIC tells. Linear
    between its points, constant beyond the last. A resolved scene has `hardening_table` in its place.
    """

    hardening_law: Literal["hollomon", "swift", "voce", "table"]
    """Hardening law: `hollomon` (power law in total strain), `swift` (power law in plastic strain), `voce` (saturates)
    or `table`.
    """

    hardening_mode: Literal["isotropic", "kinematic"]
    """Change of the yield surface with plastic flow: it grows or moves; the two differ in unloading and reloading."""

    hardening_table: Sequence[Sequence[float | str]]
    """Instead of `hardening_file`: accumulated plastic strain, from 0, and yield stress, point by point."""

    kinematic_share: float
    """Share of the hardening that moves the yield surface in the kinematic mode, in (0, 1]; absent: all of it."""

    poissons_ratio: float
    """Poisson's ratio ν, in (-1, 0.5)."""

    saturation_strain: float
    """For hardening_law = "voce": plastic strain, above 0, over which what the yield stress lacks of saturation_stress
    falls to 1/e.
    """

    saturation_stress: str
    """For hardening_law = "voce": the stress that the yield stress goes to, above yield_stress."""

    stress_measure: Literal["cauchy", "kirchhoff"]
    """The stress that the yield stress and the hardening curve mean: true stress, or Kirchhoff's, which is J times
    that.
    """

    yield_stress: str
    """Initial yield stress σ_y; absent with `hollomon` or `swift`: the body stays elastic; `voce` needs it."""

    youngs_modulus: str
    """Young's modulus E."""


class MeshTable(TypedDict, total=False):
    """A mesh to read instead of building one."""

    file: str
    """A Gmsh MSH 4.1 file, relative to the scene file."""

    unit: str
    """The length of 1 in the file; absent: 1 m."""


class NumericsTable(TypedDict, total=False):
    """Discretisation; what is absent follows from `accuracy`."""

    domain: float
    """Size of an automatic substrate, in contact radii."""

    element: Literal["q8r", "q4"]
    """Kind of element."""

    elements_in_contact: int
    """Elements across the contact radius at the peak."""

    newton_tolerance: float
    """Relative residual at which Newton stops; a tenth of it counts while nothing yields."""

    penetration: float
    """Mean penetration over depth that sets the penalty."""

    refine: bool
    """True where a run that misses what `accuracy` promises is made again with finer numbers; absent: it is. With
    `elements_in_contact` or a mesh by hand there is one run.
    """

    steps: int
    """Load steps to the peak."""


class OutputTable(TypedDict, total=False):
    """Fields that are written, and their interval."""

    every: int
    """Increments between field files; 0: no files. Absent: 5 where `fields` are named, else 0."""

    fields: Sequence[Literal["displacement", "stress", "von_mises", "plastic_strain", "pressure", "plastic_zone"]]
    """The fields of a field file; absent: all."""


class ProfileTable(TypedDict, total=False):
    """A measured line as written: the whole free surface in plane strain, from its first valley to its last."""

    file: str
    """A csv file, relative to the scene file, with columns such as x_um,z_um (or nm, mm, m), z up. A resolved scene has
    `points` in its place.
    """

    points: Sequence[Sequence[str]]
    """Instead of `file`: x and z, point by point."""

    tolerance: str
    """Standard deviation of its heights that is smoothed away; absent: as far as neighbouring points scatter."""


class SubstrateTable(TypedDict, total=False):
    """The body under the asperities; absent in axisymmetry: sized from the contact."""

    depth: str
    """From the base plane of the asperities down to the fixed base. Absent in axisymmetry: sized from the contact."""

    radius: str
    """Outer radius; in plane strain half the width of the block, the ridges in its middle. Absent: sized from the
    contact. Under asperities between symmetric sides it is always that of the row, with half the last spacing at its
    ends.
    """


class SceneTable(TypedDict, total=False):
    """Everything that defines a run: what `asperity crush` and `asperity mesh` read."""

    accuracy: Literal["draft", "standard", "reference"] | str
    """Error of the force: draft 5 %, standard 1 %, reference 0.2 %, or a percentage from 0.2% to 5%."""

    asperity: Sequence[AsperityTable]
    """From the axis (left side in plane strain) outward. May be empty under a cone or sphere."""

    initial: InitialTable
    """Earlier loads of the body; absent: it starts undeformed and free of stress."""

    lateral: Literal["free", "symmetric"]
    """The side of the substrate: free, or a frictionless wall beyond which the body repeats."""

    loading: LoadingTable
    """Goal of the tool: exactly one of `depth` and `force`."""

    material: MaterialTable
    """The material of asperities and substrate. A scene that starts from an earlier result has that of the result."""

    mesh: MeshTable
    """A mesh to read instead of building one."""

    numerics: NumericsTable
    """Discretisation; what is absent follows from `accuracy`."""

    output: OutputTable
    """Fields that are written, and their interval."""

    profile: Sequence[ProfileTable]
    """A measured line instead of asperities, in plane strain: one."""

    substrate: SubstrateTable
    """The body under the asperities; absent in axisymmetry: sized from the contact."""

    symmetry: Literal["axisymmetric", "plane-strain"]
    """Body of revolution, or ridges of constant section."""

    tool: ToolTable
    """The tool, rigid unless it has a modulus and smooth unless it has friction; absent: a smooth rigid plane."""


class ElectricalTable(TypedDict, total=False):
    """For `asperity joint`: the conductivities of electric current."""

    conductivity: Sequence[str]
    """Electrical conductivity of the two bodies."""

    gap_conductivity: str
    """That of the medium in the gap: without it the gap lets nothing through."""


class FluidTable(TypedDict, total=False):
    """A fluid in the gap."""

    gas: bool
    """True where it is a gas, which expands on its way: its flow is counted in pressure times volume."""

    mean_free_path: str
    """Mean free path of a gas: below ten of them the flow is no longer that of a continuum, and a warning says so."""

    pressures: Sequence[str]
    """Its pressure on both sides that a flow joins: left and right, then first and last row."""

    viscosity: str
    """Its viscosity."""

    width_over_length: float
    """Of `asperity joint`: width of a seal across the flow over its length along it; by default that of the map."""


class HalfSpaceTable(TypedDict, total=False):
    """Settings of the half-space."""

    leak: bool
    """True where the flow through the gap is computed: by default where a fluid is given or one closure alone is
    chosen.
    """

    load_points: int
    """Points of the load curve beside first touch: by default 8, on maps of more than 512 x 512 points 6, of more than
    1024 x 1024 points 1, which gives no curve between first touch and the load.
    """

    stiffness: bool
    """False where `asperity rough` leaves out the contact stiffness, which no other number needs: true by default."""

    tolerance: float
    """Proven relative error of the pressures in the norm of the energy at which the search ends: 1e-6 by default; the
    loads of a joint and the contacts of scales are found to ten times it.
    """


class JointTable(TypedDict, total=False):
    """For `asperity joint`: its loads."""

    left_out: str
    """Height range, peak to valley, of roughness that the map does not hold: of it follow proven bounds of the elastic
    stiffness. By default the range that `surface.s_filter` removed.
    """

    loads: int
    """Loads from first touch to the largest: 25 by default."""

    tiles: int
    """Tiles along each side of the map, each levelled by a plane and pressed alone: the law is their mean, and how far
    they differ its repeatability. By default the whole map.
    """


class RoughLoadTable(TypedDict, total=False):
    """Its load; a joint may go without one."""

    pressure: str
    """Nominal pressure."""

    separation: str
    """Separation from the mean plane."""

    unload: bool
    """True where the load is removed again."""


class RoughMaterialTable(TypedDict, total=False):
    """Its material."""

    hardening_exponent: float
    """Hardening exponent n."""

    hardening_law: Literal["hollomon", "swift"]
    """Hardening law, by default that of the calibration."""

    hardness: str
    """Hardness H: force over projected area (Meyer's). A Vickers number HV is H = 10.58 HV in MPa. Without it H is 3
    σ_y, and the limit of `half-space-plastic` that of the atlas of cones where n is known.
    """

    hardness_error: str
    """Uncertainty ± of the hardness (95 %): it goes into the errors that `half-space-plastic` states. Without it,
    beside a yield stress and a hardening exponent, the hardness is as uncertain as it is far from the plateau of
    pressure that they have.
    """

    poissons_ratio: float
    """Poisson's ratio ν."""

    yield_stress: str
    """Yield stress σ_y."""

    youngs_modulus: str
    """Young's modulus E."""


class RoughOutputTable(TypedDict, total=False):
    """Output files."""

    maps: bool
    """Pictures and .vti of pressure and contact."""

    spectrum: bool
    """The power spectrum of the surface, as spectrum.csv: by default of maps of up to 1024 x 1024 points."""

    surface: Literal["x3p", "npy"]
    """The surface as pressed (levelled, filtered), as surface.x3p or surface.npy (heights in metres: `height_unit =
    "m"`).
    """


class ScalesTable(TypedDict, total=False):
    """For `asperity scales`: the instrument."""

    tip_radius: str
    """Radius of the tip of the stylus or of the probe: where the surface is more curved than it, the measurement is of
    the tip.
    """


class ColumnsTable(TypedDict, total=False):
    """Columns of a list of points (text), by their names or numbers, with units where the file has none."""

    x: str
    """Name of the column of x, with or without a unit in brackets, or its number from 1."""

    y: str
    """That of y."""

    z: str
    """That of the heights."""


class GenerateTable(TypedDict, total=False):
    """Instead of a file."""

    cutoff: str
    """Shortest wave, of "self-affine"."""

    hurst: float
    """Hurst exponent, of "self-affine"."""

    kind: Literal["ground", "milled", "sanded", "self-affine"]
    """Ground, milled, sanded or self-affine."""

    mean_slope_deg: float
    """atan of the mean |∇h|, degrees."""

    pixels: Sequence[int]
    """Points along x and y, at least 2."""

    ra: str
    """Arithmetic mean height."""

    rolloff: str
    """Longest wave of the power law, of "self-affine"."""

    seed: int
    """Seed of the random numbers."""

    size: Sequence[str]
    """Length along x and y."""


class SurfaceTable(TypedDict, total=False):
    """The surface."""

    columns: ColumnsTable
    """Columns of a list of points (text), by their names or numbers, with units where the file has none."""

    decimal: Literal["point", "comma"]
    """Mark before decimals in text, `point` or `comma`, where the file does not tell."""

    file: str
    """A file, relative to the scene."""

    generate: GenerateTable
    """Instead of a file."""

    height_unit: Literal["um", "nm", "mm", "cm", "m", "µm", "μm", "pm", "km", "Å"]
    """Unit of the heights, where the file does not say."""

    l_filter: str
    """Cut-off of the Gaussian L-filter (removes what is longer)."""

    level: Literal["none", "mean", "plane", "quadratic"]
    """Levelling: by default the plane from a file, nothing from a generated surface."""

    memory_limit: str
    """Most memory that reading the file may take; half of what is free unless told."""

    missing: Literal["exclude", "fill"]
    """Missing points."""

    missing_value: float
    """Number that stands for a point that was not measured, in the unit of the file (text)."""

    outliers: float
    """Points further from the median of their eight neighbours than so many standard deviations count as missing; at
    least 3.
    """

    override: bool
    """True where `pixel_size` and `height_unit` win over what the file says, and a file is read whose sums do not hold.
    """

    periodic: bool
    """True where the map is one period of an endless surface."""

    pixel_size: Sequence[str] | str
    """Distance of the points along x and y, or one for both, where the file does not say."""

    s_filter: str
    """Cut-off of the Gaussian S-filter (removes what is shorter)."""


class ThermalTable(TypedDict, total=False):
    """For `asperity joint`: the conductivities of heat."""

    conductivity: Sequence[str]
    """Thermal conductivity of the two bodies."""

    gap_conductivity: str
    """That of the medium in the gap: without it the gap lets nothing through."""


class RoughTable(TypedDict, total=False):
    """A rough surface under a rigid plane."""

    closure: Literal["published", "fitted", "johnson", "sneddon", "calibrated", "half-space", "half-space-plastic", "all", "islands"]
    """The closure, or several."""

    coefficient: str
    """Result of a calibration, for "fitted" (c), "calibrated" (cones, unloading) and "johnson" (unloading)."""

    electrical: ElectricalTable
    """For `asperity joint`: the conductivities of electric current."""

    fluid: FluidTable
    """A fluid in the gap."""

    half_space: HalfSpaceTable
    """Settings of the half-space."""

    joint: JointTable
    """For `asperity joint`: its loads."""

    judge: bool
    """True where every closure is compared with the half-space: by default on maps of up to 1024 x 1024 points."""

    load: RoughLoadTable
    """Its load; a joint may go without one."""

    material: RoughMaterialTable
    """Its material."""

    output: RoughOutputTable
    """Output files."""

    pressure_profile: Literal["hertz", "cone", "uniform"]
    """Distribution of the pressure over an island."""

    scales: ScalesTable
    """For `asperity scales`: the instrument."""

    surface: SurfaceTable
    """The surface."""

    thermal: ThermalTable
    """For `asperity joint`: the conductivities of heat."""


class SweepTable(TypedDict, total=False):
    """A sweep as its file says it; what is absent is the paper's grid of 480 cases."""

    accuracy: Literal["draft", "standard", "reference"] | str
    """Error of K: draft 5 %, standard 1 %, reference 0.2 %, or a percentage from 0.2% to 5%."""

    friction: float | Literal["sticking"]
    """Coulomb's coefficient of friction between plane or cone and metal, from 0 to 2, or "sticking". Absent: 0."""

    hardening_exponent: Sequence[float]
    """Hardening exponents n."""

    hardening_law: Literal["hollomon", "swift"]
    """Hardening law: `hollomon` (power law in total strain) or `swift` (power law in plastic strain)."""

    poissons_ratio: float
    """Poisson's ratio."""

    slopes_deg: Sequence[float]
    """Slopes β of the cones against the plane, degrees; at most 30, under a cone 50."""

    stress_measure: Literal["cauchy", "kirchhoff"]
    """The stress that the hardening law speaks of."""

    tool: Literal["plane", "cone"]
    """Crush by a plane, or indentation by a cone."""

    yield_stress: Sequence[str]
    """Yield stresses."""

    youngs_modulus: Sequence[str]
    """Young's moduli."""


class CurveColumnsTable(TypedDict, total=False):
    """Columns of depth and force, where their names are unusual."""

    depth: str
    """Name of the column of depth, with or without a unit in brackets, or its number from 1; a minus before it turns
    the sign of its numbers.
    """

    force: str
    """That of force."""


class FeaturesTable(TypedDict, total=False):
    """Numbers of a curve in its place."""

    loading_curvature: str
    """F/h² of the loading."""

    max_depth: str
    """The largest depth."""

    pile_up_height: str
    """Height of the imprint's highest point above the far field, at `max_depth`; of cones and balls."""

    plastic_work_ratio: float
    """Share of the work of loading that unloading does not return."""

    residual_depth: str
    """Depth of the imprint's lowest point below the far field, likewise."""

    rim_radius: str
    """Radius of the imprint's rim, its highest point, likewise."""

    unloading_slope: str
    """dF/dh where unloading begins, at `max_depth`."""


class ImprintTable(TypedDict, total=False):
    """Its file, its noise, its units."""

    correlation_length: str
    """Distance over which heights are off alike, that of roughness or of the stylus; absent: from the far field."""

    file: str
    """Profile or map, relative to the fit file."""

    height_unit: str
    """Unit of the heights of a map, where the file does not say."""

    noise: str
    """Standard deviation of a height, of a map of one of its heights; absent: from the far field."""

    pixel_size: str | Sequence[str]
    """Distance of the points of a map along x and y, or one for both, where the file does not say."""

    z_down: bool
    """True where the heights of the file count down, so that the imprint has positive ones."""


class CurveToolTable(TypedDict, total=False):
    """The tool."""

    friction: float | Literal["sticking"] | Sequence[float | Literal["sticking"]]
    """Friction of the tool: a coefficient from 0 to 2, "sticking", or a list of two coefficients where it is sought;
    absent: smooth.
    """

    half_apex_deg: float
    """Cone: angle between flank and axis, degrees, instead of `slope_deg`."""

    machine_compliance: str | Sequence[str]
    """Depth per force that the machine adds; absent: none."""

    poissons_ratio: float
    """Poisson's ratio of the tool."""

    radius: str
    """Radius of the ball."""

    shape: Literal["plane", "cone", "conospherical", "sphere", "berkovich", "vickers"]
    """Its outline."""

    slope_deg: float
    """Cone: angle between flank and horizontal, degrees."""

    tip_radius: str | Sequence[str]
    """Radius of the tip; absent or 0: sharp."""

    youngs_modulus: str
    """Young's modulus of the tool; absent: rigid."""


class CurveTable(TypedDict, total=False):
    """A measurement: a force-depth curve in a file, or features of one."""

    asperity: AsperityTable
    """The asperity that a plane crushes; absent: a flat body."""

    columns: CurveColumnsTable
    """Columns of depth and force, where their names are unusual."""

    decimal: Literal["point", "comma"]
    """Mark before decimals, `point` or `comma`, where the file does not tell."""

    features: FeaturesTable
    """Numbers of a curve in its place."""

    file: str
    """Text table of depth and force, relative to the fit file."""

    imprint: str | ImprintTable
    """The imprint that was left, of a cone or a ball: a profile with columns such as r_um,z_um (r from the axis, z up,
    0 on the far field), or a map; or a table with its noise and what the file does not say.
    """

    missing_value: float
    """Number that stands for a reading that is missing, in the unit of the file."""

    model_error: str
    """Standard deviation of what the model leaves out, common to the whole curve; absent: 0. That of the correction of
    a pyramid counts in addition.
    """

    noise: str
    """Standard deviation of the force (of each feature); absent: from the scatter about the fit, 1 % of features."""

    test: int
    """Number of the test in a file of several, from 1; absent: every test is a curve of its own."""

    tool: CurveToolTable
    """The tool."""

    unknown: Sequence[Literal["contact_depth", "machine_compliance", "tip_radius", "friction"]]
    """Further unknowns of this measurement."""

    depth_um: ArrayLike
    """Depths, um, in the place of `file`; beside `force_N`."""

    force_N: ArrayLike
    """Forces, N, in the place of `file`; beside `depth_um`."""


class FitMaterialTable(TypedDict, total=False):
    """The metal: a number is known, a range of two is sought."""

    hardening_exponent: float | Sequence[float]
    """Hardening exponent n in [0, 1)."""

    hardening_law: Literal["hollomon", "swift", "table"]
    """Hardening law: `hollomon` (power law in total strain), `swift` (power law in plastic strain) or `table`, whose
    points follow any other law.
    """

    hardening_table: Sequence[Sequence[float | str | Sequence[str]]]
    """For hardening_law = "table": plastic strain, from 0, and yield stress (known or sought), point by point."""

    poissons_ratio: float | Sequence[float]
    """Poisson's ratio ν, in (-1, 0.5)."""

    stress_measure: Literal["cauchy", "kirchhoff"]
    """The stress that the yield stress means: true stress, or Kirchhoff's."""

    yield_stress: str | Sequence[str]
    """Initial yield stress σ_y."""

    youngs_modulus: str | Sequence[str]
    """Young's modulus E."""


class FitTable(TypedDict, total=False):
    """Everything that defines an identification: what `asperity identify` reads."""

    accuracy: Literal["draft", "standard"]
    """Level of the finite elements that give the answer: draft or standard."""

    curve: Sequence[CurveTable]
    """The measurements."""

    material: FitMaterialTable
    """The metal: a number is known, a range of two is sought."""

    samples: int
    """Samples of the posterior in posterior.csv; 0: no file."""

    seed: int
    """Seed of these samples."""
