//! From a scene and its depth to what the solver computes with: unit of length, profile, tool, mesh, penalty.

use crate::scene::{AsperityForm, ElementChoice, Friction, Line, LineAsperity, Scene, SceneError, Target};
use crate::setup::contact_estimate;
use crate::setup::deformed_surface::{Formed, expected_pressure};
use crate::setup::discretisation::Discretisation;
use crate::setup::discretisation::LEAST_COUNTED_DEPTH;
use crate::setup::neighbours::{Support, own_depths};
use crate::setup::problem::{Goal, Problem, Rules, Specimen, held_nodes};
use crate::setup::units::Units;
use asperity_material::Elastic;
use asperity_mesh::build::{Contact, Plan, build};
use asperity_mesh::grading::{Grading, LINEAR_PER_QUADRATIC};
use asperity_mesh::profile::{Asperity, Profile, Shape};
use asperity_mesh::{ElementKind, Mesh};
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;

/// Largest depth of a run that is driven by a force over that at which it is expected, and over one that no
/// coarse run has reached.
const PROBED_DEPTH_RATIO: f64 = 1.3;
const PROBED_GUESS_RATIO: f64 = 3.0;

/// The material of `scene`, E = 1.
pub fn metal(scene: &Scene) -> Metal {
    let elastic = scene.material.elastic();
    Metal {
        elastic: Elastic { youngs_modulus: 1.0, ..elastic },
        hardening: scene.material.hardening().map(|curve| curve.in_units_of(elastic.youngs_modulus)),
        kinematic_share: scene.material.moving_share(),
        stress_measure: scene.material.stress_measure,
    }
}

/// The asperities and the tool of `scene`, lengths over `length` (m); the first summit stands at 0 where the
/// loads are [`Expected::centred`].
pub fn bodies(scene: &Scene, centred: bool, length: f64) -> Result<(Profile, Tool), SceneError> {
    let tool = scene.tool.form().map_err(|e| in_table("tool", e))?.in_units_of(length);
    if let Some(line) = scene.profile.first() {
        let profile = measured_line(&line.line().map_err(|e| in_table("profile[0]", e))?, length);
        return Ok((profile, tool));
    }
    let asperities = outlines(scene, centred)?.iter().map(|a| a.in_units_of(length)).collect();
    Ok((Profile { asperities, line: None }, tool))
}

/// A measured line and its asperities, lengths over `length`.
fn measured_line(line: &Line, length: f64) -> Profile {
    let asperity = |a: &LineAsperity| Asperity {
        shape: Shape::Measured(a.outline.clone()),
        height: a.height,
        centre: a.centre,
        valley_radius: 0.0,
    };
    Profile {
        asperities: line.asperities.iter().map(|a| asperity(a).in_units_of(length)).collect(),
        line: Some(line.outline.scaled(length.recip()).shared()),
    }
}

/// Estimates of a load before it is computed, and of the loads before it, lengths in the unit of the scene:
/// see [`crate::depth_for_force`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expected {
    /// Depth of the peak: the one that is asked for, or the one at which the force is expected.
    pub depth: f64,
    /// True where no coarse run has carried the force there: the depth may be further off.
    pub is_guessed: bool,
    /// True where a tool of the scene, or of a load before or after it, is curved: it comes down at 0, and
    /// all loads of a body share the places of its asperities.
    pub centred: bool,
    /// The surface that earlier loads left; `None`: that of the scene.
    pub formed: Option<Formed>,
    /// The same of the earlier loads, in their order.
    pub earlier: Vec<Expected>,
}

/// Prepares `scene`, which is valid, with these `numbers` for its `expected` peak. `mesh` replaces the mesh
/// that would be built. Lengths are in `units`. The body is virgin: [`crate::run::Run`] takes it through its
/// earlier loads.
///
/// # Errors
/// A scene that cannot be meshed: path and reason.
pub fn prepare(
    scene: &Scene,
    numbers: Discretisation,
    mesh: Option<Mesh>,
    expected: &Expected,
    units: Units,
) -> Result<Problem, SceneError> {
    let depth = expected.depth;
    let length = units.length;
    let symmetry = scene.symmetry;
    let metal = metal(scene);
    let (profile, tool) = bodies(scene, expected.centred, length)?;
    let (goal, reach) = goal_and_reach(scene, &units, expected)?;
    let formed = expected.formed.clone();
    let substrate = scene.substrate.as_ref().and_then(|s| s.depth);
    let support = Support {
        symmetry,
        cell: scene.has_repeated_asperities().then(|| extent(scene, &profile, &[], length)),
        depth: substrate.map(|l| profile.height() + l.0 / length),
    };
    let own_depths_under = |tool: &Tool, depth: f64| own_depths(&metal, &profile, tool, &support, depth);
    let own_depths_at = |depth: f64| own_depths_under(&tool, depth);
    // on a surface that was formed the whole depth
    let indents = match formed {
        None => own_depths_at(depth).into_iter().fold(0.0, f64::max),
        Some(_) => depth,
    };
    let own = Contacts::new(&profile, &tool, formed.as_ref(), &own_depths_at, [depth, reach]);
    let half_widths = own.half_widths.clone();
    let contacts = with_earlier_contacts(own, scene, expected, &profile, (length, &own_depths_under))?;
    let row = extent(scene, &profile, &contacts.half_widths, length);
    let size = automatic_size(&numbers, &profile, &contacts.half_widths).max(3.0 * (row[1] - row[0]));
    let pressure = expected_pressure(formed.as_ref(), &metal, &profile, &tool, indents);
    let (mesh, cut_off) = match mesh {
        Some(mesh) => (mesh, 0.0),
        None => {
            let grading = contacts.grading(&numbers);
            // a body that is loaded again keeps the mesh of its first load
            let once = expected.earlier.is_empty() && expected.formed.is_none();
            let meshed =
                if once { blunted(&profile, &contacts.half_widths, &grading) } else { profile.clone() };
            check_valleys(&profile, length)?;
            let sizes = (grading, numbers.element.kind());
            let mesh = build_mesh(scene, sizes, &meshed, &contacts.half_widths, row, size, length)?;
            (mesh, profile.height() - meshed.height())
        }
    };
    Ok(Problem {
        rules: Rules::new(scene, &metal, &units, size),
        units,
        symmetry,
        metal,
        profile,
        tool,
        friction: scene.tool.friction.and_then(Friction::law),
        half_widths,
        depth,
        penalty: pressure / (numbers.penetration * indents),
        specimen: Specimen { held: held_nodes(&mesh, symmetry, scene.lateral), cut_off, earlier: None },
        mesh,
        numbers,
        goal,
        unload: scene.loading.unload,
        reloads: scene.loading.reloads,
        formed,
    })
}

/// The end of loading, and the depth that the mesh is to reach: a force may be found somewhat deeper than the
/// `depth` at which it is expected.
fn goal_and_reach(scene: &Scene, units: &Units, expected: &Expected) -> Result<(Goal, f64), SceneError> {
    let depth = expected.depth;
    Ok(match scene.loading.target().map_err(|e| in_table("loading", e))? {
        Target::Depth(asked) => (Goal::Depth(asked / units.length), depth),
        Target::Force(force) => {
            let probed = depth * if expected.is_guessed { PROBED_GUESS_RATIO } else { PROBED_DEPTH_RATIO };
            let limit = probed.min(scene.deepest() / units.length);
            (Goal::Force { force: force / units.force, expected_depth: depth, limit }, probed)
        }
    })
}

/// Depth by which each contact indents its surroundings under a tool at a depth.
type OwnDepths<'a> = &'a dyn Fn(&Tool, f64) -> Vec<f64>;

/// `contacts` and those of the earlier loads of `scene` on one mesh, lengths over `length`.
fn with_earlier_contacts(
    mut contacts: Contacts,
    scene: &Scene,
    expected: &Expected,
    profile: &Profile,
    (length, own_depths_under): (f64, OwnDepths<'_>),
) -> Result<Contacts, SceneError> {
    for (load, earlier) in scene.earlier_loads().iter().zip(&expected.earlier) {
        let tool = load.tool.form().map_err(|e| in_table("tool", e))?.in_units_of(length);
        let (formed, deep) = (earlier.formed.as_ref(), earlier.depth);
        let own_depths_at = |depth: f64| own_depths_under(&tool, depth);
        contacts = contacts.and(&Contacts::new(profile, &tool, formed, &own_depths_at, [deep; 2]));
    }
    Ok(contacts)
}

/// The contacts that a mesh is made for.
struct Contacts {
    /// Their half widths, one for each asperity.
    half_widths: Vec<f64>,
    /// Half width of the widest from which it is to be resolved.
    resolved_from: f64,
    /// Elements in the half width times the width of a shell of them over its distance from the centre: 1 for
    /// the core, and the logarithm of the half width over that of the core for the shells around it.
    graded: f64,
}

impl Contacts {
    /// Those of a tool at `reach`, resolved where it is `depth` deep; `own_depths_at` tells how deep each
    /// then indents its surroundings.
    fn new(
        profile: &Profile,
        tool: &Tool,
        formed: Option<&Formed>,
        own_depths_at: &dyn Fn(f64) -> Vec<f64>,
        [depth, reach]: [f64; 2],
    ) -> Contacts {
        let (half_widths, share) = match formed {
            None => {
                let [first, last] = [LEAST_COUNTED_DEPTH * depth, reach].map(own_depths_at);
                let share = contact_estimate::resolved_from(profile, tool, &first, &last);
                (contact_estimate::half_widths(profile, tool, &last), share)
            }
            Some(formed) => {
                (formed.half_widths(profile, tool, reach), formed.resolved_from(profile, tool, depth, reach))
            }
        };
        Contacts {
            resolved_from: share * widest(&half_widths),
            graded: 1.0 - (CORE_WIDTH_RATIO * share).ln(),
            half_widths,
        }
    }

    /// Sizes over the distance from a centre, so that the contact radius holds the wanted number of elements.
    fn grading(&self, numbers: &Discretisation) -> Grading {
        Grading {
            fineness: self.graded / numbers.elements_in_contact as f64,
            start: CORE_WIDTH_RATIO * self.resolved_from / widest(&self.half_widths),
            fine: 1.6,
            far: match numbers.element {
                ElementChoice::Q8r => FAR_GROWTH_SHARE,
                ElementChoice::Q4 => FAR_GROWTH_SHARE / LINEAR_PER_QUADRATIC,
            },
        }
    }

    /// Both on one mesh: it reaches as far as the wider and is as fine as either asks.
    fn and(self, other: &Contacts) -> Contacts {
        let wider = |(a, b): (&f64, &f64)| a.max(*b);
        Contacts {
            half_widths: self.half_widths.iter().zip(&other.half_widths).map(wider).collect(),
            resolved_from: self.resolved_from.min(other.resolved_from),
            graded: self.graded.min(other.graded),
        }
    }
}

fn in_table(table: &str, error: SceneError) -> SceneError {
    let path = if error.path.is_empty() { table.to_string() } else { format!("{table}.{}", error.path) };
    SceneError { path, message: error.message }
}

/// The asperities side by side, in metres.
fn outlines(scene: &Scene, centred: bool) -> Result<Vec<Asperity>, SceneError> {
    let mut outlines = Vec::new();
    let plane = scene.symmetry == Symmetry::PlaneStrain;
    let mut edge = 0.0; // where the next asperity may begin
    for (index, asperity) in scene.asperity.iter().enumerate() {
        let form = asperity.form().map_err(|e| in_table(&format!("asperity[{index}]"), e))?;
        let (shape, valley_radius) = match form {
            AsperityForm::Cone { slope, tip_radius, valley_radius, .. } => {
                (Shape::Cone { tan_slope: slope.tan(), tip_radius }, valley_radius)
            }
            AsperityForm::Sphere { radius, .. } => (Shape::Sphere { radius }, 0.0),
            AsperityForm::Measured { ref outline, .. } => (Shape::Measured(outline.clone()), 0.0),
        };
        let [left, right] = form.feet();
        // a curved tool comes down at 0: over the first summit
        let at_zero = index == 0 && (!plane || centred);
        let centre = if at_zero { 0.0 } else { edge + left };
        outlines.push(Asperity { shape, height: form.height(), centre, valley_radius });
        edge = centre + right + asperity.spacing.map_or(0.0, |s| s.0);
    }
    Ok(outlines)
}

fn widest(half_widths: &[f64]) -> f64 {
    half_widths.iter().fold(0.0, |m: f64, w| m.max(*w))
}

/// Half width of the core over that from which a contact is to be resolved: an elastic contact is 0.7 times
/// as wide as expected (see `a_priori`), and the columns of the core are wide.
const CORE_WIDTH_RATIO: f64 = 0.7;

/// Growth of the shells far from the contact, as a share of the distance, of quadratic elements. With linear
/// ones of this growth a ridge and a cylinder in plane strain were too stiff by 0.5 % and 0.8 %, with
/// [`LINEAR_PER_QUADRATIC`] times as many shells by 0.1 %; quadratic ones of half of it change the force by
/// 0.01 %.
const FAR_GROWTH_SHARE: f64 = 0.4;

/// Size of an automatic substrate: so many radii of the loaded region, which is the contact of a single
/// asperity and the whole row of several, whose forces add up far away.
fn automatic_size(numbers: &Discretisation, profile: &Profile, half_widths: &[f64]) -> f64 {
    let touched = profile.asperities.iter().zip(half_widths).filter(|(_, w)| **w > 0.0);
    let loaded = touched.map(|(a, w)| a.centre + w).fold(widest(half_widths), f64::max);
    numbers.domain * loaded
}

/// Left and right end of the row of asperities with the gaps beside it, lengths over `length`; of a flat body
/// some contact widths.
fn extent(scene: &Scene, profile: &Profile, half_widths: &[f64], length: f64) -> [f64; 2] {
    let end_gap = scene.end_gap() / length;
    let right = profile.asperities.last().map_or(0.0, |a| a.centre + a.feet()[1]) + end_gap;
    match scene.symmetry {
        Symmetry::Axisymmetric => [0.0, right],
        Symmetry::PlaneStrain if profile.asperities.is_empty() => {
            [-10.0, 10.0].map(|w| w * widest(half_widths))
        }
        Symmetry::PlaneStrain => {
            [profile.asperities.first().map_or(0.0, |a| a.centre - a.feet()[0]) - end_gap, right]
        }
    }
}

/// Slope (tangent) of a flank beyond which a sharp tip is cut off in the mesh: the cell below it would be
/// higher than wide.
const STEEP_FLANK_SLOPE: f64 = 1.0;

/// Half width of the arc that a steep flank ends in at least, over the width of the first column of cells.
const BLUNT_WIDTH_RATIO: f64 = 0.2;

/// The profile as it is meshed. A plane that comes down on the tip of a steep flank touches one node of a
/// high and narrow cell: a pressure of ten yield stresses there crushes the cell before the contact is as
/// wide as it. The part of such a tip that an arc half a column wide cuts off is crushed before the contact
/// is resolved in any case.
fn blunted(profile: &Profile, half_widths: &[f64], grading: &Grading) -> Profile {
    let blunt = |(asperity, half_width): (&Asperity, &f64)| match asperity.shape {
        Shape::Cone { tan_slope, .. } if tan_slope > STEEP_FLANK_SLOPE => {
            asperity.blunted(BLUNT_WIDTH_RATIO * grading.middle_column(*half_width))
        }
        _ => asperity.clone(),
    };
    Profile {
        asperities: profile.asperities.iter().zip(half_widths).map(blunt).collect(),
        line: profile.line.clone(),
    }
}

/// The mesh of the scene over the `row` of its asperities for contacts of these `half_widths`, lengths over
/// `length`; the substrate has the `size` if the scene gives none.
fn build_mesh(
    scene: &Scene,
    (grading, kind): (Grading, ElementKind),
    profile: &Profile,
    half_widths: &[f64],
    row: [f64; 2],
    size: f64,
    length: f64,
) -> Result<Mesh, SceneError> {
    let symmetry = scene.symmetry;
    let substrate = scene.substrate.as_ref();
    let size_of = |given: Option<asperity_material::units::Length>| given.map_or(size, |l| l.0 / length);
    let depth = profile.height() + size_of(substrate.and_then(|s| s.depth));
    let radius = size_of(substrate.and_then(|s| s.radius));
    let width = match symmetry {
        _ if scene.has_repeated_asperities() => row,
        Symmetry::Axisymmetric => [0.0, radius],
        Symmetry::PlaneStrain => {
            let middle = 0.5 * (row[0] + row[1]);
            [middle - radius, middle + radius]
        }
    };
    if width[0] > row[0] || width[1] < row[1] {
        return Err(SceneError {
            path: "substrate.radius".into(),
            message: format!(
                "{:.6e} m does not reach beyond the asperities, which need {:.6e} m: enlarge it",
                radius * length,
                match symmetry {
                    Symmetry::Axisymmetric => row[1],
                    Symmetry::PlaneStrain => 0.5 * (row[1] - row[0]),
                } * length
            ),
        });
    }
    let contacts: Vec<Contact> = if profile.asperities.is_empty() {
        let widest = widest(half_widths);
        vec![Contact { centre: 0.0, half_width: widest, foot: 10.0 * widest, sides: [1.0; 2], slope: 0.0 }]
    } else {
        let contact = |(a, w): (&Asperity, &f64)| {
            let sides = a.feet();
            let foot = sides[0].max(sides[1]);
            Contact {
                centre: a.centre,
                half_width: *w,
                foot,
                sides: sides.map(|side| side / foot),
                slope: a.steepest(),
            }
        };
        profile.asperities.iter().zip(half_widths).map(contact).collect()
    };
    if contacts.iter().all(|c| c.half_width <= 0.0) {
        return Err(SceneError {
            path: "loading.depth".into(),
            message: "no asperity is touched at the full depth: raise the depth".into(),
        });
    }
    Ok(build(&Plan { profile: profile.clone(), contacts, row, width, depth, grading, kind }))
}

/// Fillets must leave a part of both their sides straight.
fn check_valleys(profile: &Profile, length: f64) -> Result<(), SceneError> {
    for (index, asperity) in profile.asperities.iter().enumerate() {
        let Some([own, beyond]) = profile.valley_reach(index) else { continue };
        let foot = asperity.feet()[1];
        let next = profile.asperities.get(index + 1);
        let room = next.map_or(f64::INFINITY, |b| {
            let gap = b.centre - b.feet()[0] - asperity.centre - foot;
            if gap > 1e-9 * foot { gap } else { b.feet()[0] - b.cap_radius() }
        });
        if own > foot - asperity.cap_radius() || beyond > room {
            let largest = asperity.valley_radius * ((foot - asperity.cap_radius()) / own).min(room / beyond);
            return Err(SceneError {
                path: format!("asperity[{index}].valley_radius"),
                message: format!(
                    "{:.6e} m leaves no straight flank: it may be at most {:.6e} m here",
                    asperity.valley_radius * length,
                    largest * length
                ),
            });
        }
    }
    Ok(())
}
