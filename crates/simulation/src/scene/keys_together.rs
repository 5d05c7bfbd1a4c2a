//! Keys that have to go together, and those of `[numerics]`; the range of one key stands in the file of its
//! table.

use super::geometry::HIGHEST_CAP;
use super::measured::span_of;
use super::messages::{Check, check_range, error, inside, length, not_negative, positive, slope};
use super::{
    Asperity, AsperityForm, Lateral, Numerics, Scene, SceneError, Substrate, Symmetry, ToolForce, ToolForm,
};
use asperity_mesh::outline::Span;

/// Limits that a tool cannot pass.
#[derive(Clone, Copy)]
enum End {
    /// The foot of the highest asperity, for a plane.
    Height,
    /// The widest circle of a sphere.
    Radius,
    /// The end of a measured tool.
    Outline,
    /// The depth that an outline of functions names.
    Own,
    /// The fixed base of the body.
    Bottom,
}

impl Scene {
    /// Checks that every value lies in its allowed range and the parts go together.
    ///
    /// # Errors
    /// The first value that does not, with its place in the scene, the allowed range and a way out.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.accuracy.check()?;
        self.material.check().map_err(|e| inside("material", e))?;
        for (i, asperity) in self.asperity.iter().enumerate() {
            asperity.check().map_err(|e| inside(&format!("asperity[{i}]"), e))?;
            if i == 0 && self.symmetry == Symmetry::Axisymmetric {
                asperity.check_on_axis().map_err(|e| inside("asperity[0]", e))?;
            }
        }
        if let Some(substrate) = &self.substrate {
            substrate.check().map_err(|e| inside("substrate", e))?;
        }
        if let Some(mesh) = &self.mesh {
            if mesh.file.as_os_str().is_empty() {
                return Err(error(
                    "mesh.file",
                    "is empty: give the path of a .msh file, relative to the scene file",
                ));
            }
            mesh.unit.map_or(Ok(()), |u| positive("mesh.unit", "the length of 1 in the mesh file", u))?;
        }
        self.check_line()?;
        self.check_earlier_loads()?;
        self.check_load()?;
        self.numerics.check().map_err(|e| inside("numerics", e))
    }

    /// Checks that tool and loading make sense on the body.
    pub(super) fn check_load(&self) -> Check {
        self.tool.check().map_err(|e| inside("tool", e))?;
        self.check_tool_compliance()?;
        self.check_body()?;
        self.loading.check().map_err(|e| inside("loading", e))?;
        self.check_loading()
    }

    /// Checks the compliance of tool and machine against the rest of the scene.
    fn check_tool_compliance(&self) -> Check {
        if self.symmetry == Symmetry::PlaneStrain && self.tool.area_function.is_some() {
            let message = "belongs to a body of revolution: a wedge has no contact area; leave it out";
            return Err(error("tool.area_function", message));
        }
        let given = [
            ("tool.youngs_modulus", self.tool.youngs_modulus.is_some()),
            ("tool.machine_compliance", self.tool.machine_compliance.is_some()),
        ];
        let Some((path, _)) = given.iter().find(|(_, given)| *given) else { return Ok(()) };
        if self.symmetry == Symmetry::PlaneStrain {
            return Err(error(
                *path,
                "belongs to a body of revolution: in plane strain a half space has no compliance and a machine no force; leave it out",
            ));
        }
        if self.tool.youngs_modulus.is_some() && (self.asperity.len() > 1 || !self.profile.is_empty()) {
            return Err(error(
                "tool.youngs_modulus",
                "needs a single contact: how a tool gives way under several at once is not modelled; leave it out for a rigid tool",
            ));
        }
        Ok(())
    }

    /// A measured line must be the only surface, in plane strain.
    fn check_line(&self) -> Check {
        for (i, line) in self.profile.iter().enumerate() {
            let table = format!("profile[{i}]");
            not_negative("tolerance", "the tolerance", line.tolerance).map_err(|e| inside(&table, e))?;
            line.line().map_err(|e| inside(&table, e))?;
        }
        let Some(_) = self.profile.first() else { return Ok(()) };
        let fault = if self.symmetry == Symmetry::Axisymmetric {
            "is a line of ridges, which belongs to plane strain: set symmetry = \"plane-strain\", or give an [[asperity]] with `profile`"
        } else if self.profile.len() > 1 {
            "must be one: join the lines, or crush each in a scene of its own"
        } else if !self.asperity.is_empty() {
            "is the whole surface: remove [[asperity]], or give each as an [[asperity]] with `profile`"
        } else {
            return Ok(());
        };
        Err(error("profile", fault))
    }

    /// True where anything stands on the substrate.
    fn is_flat(&self) -> bool {
        self.asperity.is_empty() && self.profile.is_empty()
    }

    /// Asperities, substrate and mesh must make one body that the tool can touch.
    fn check_body(&self) -> Check {
        let flattens = matches!(self.tool.form(), Ok(ToolForm::Plane));
        if self.is_flat() && flattens && self.mesh.is_some() {
            return Err(error(
                "mesh",
                "does not say how steep its summit is, from which the expected pressure follows: add the [[asperity]] that it holds",
            ));
        }
        if self.mesh.is_some() {
            return Ok(());
        }
        if self.is_flat() && flattens {
            return Err(error(
                "asperity",
                "a plane needs something to crush: give at least one [[asperity]], or a tool that is not a plane",
            ));
        }
        let substrate = self.substrate.unwrap_or_default();
        if self.symmetry == Symmetry::PlaneStrain {
            let why = "in plane strain the depth of the tool grows with the logarithm of the substrate's size without end";
            if self.substrate.is_none() {
                return Err(error(
                    "substrate",
                    format!("is missing: {why}, so give [substrate] radius and depth"),
                ));
            }
            if substrate.depth.is_none() {
                return Err(error(
                    "substrate",
                    format!("`depth` is missing: {why}, so give depth = \"2 mm\""),
                ));
            }
            if substrate.radius.is_none() && (self.lateral == Lateral::Free || self.is_flat()) {
                return Err(error(
                    "substrate",
                    format!("`radius` (half the width) is missing: {why}, so give radius = \"2 mm\""),
                ));
            }
        }
        if let Some(radius) = substrate.radius {
            let extent = self.extent();
            if radius.0 < extent * (1.0 - 1e-12) {
                return Err(error(
                    "substrate.radius",
                    format!(
                        "must be at least {}, the reach of the asperities, not {}: widen it, or leave it out",
                        length(extent),
                        length(radius.0)
                    ),
                ));
            }
        }
        Ok(())
    }

    /// The limit of the way of the tool, with the depth (m) there.
    fn ends(&self) -> impl Iterator<Item = (End, f64)> {
        let highest = self.highest();
        let own = match self.tool.form() {
            Ok(ToolForm::Plane) if highest > 0.0 => Some((End::Height, highest)),
            Ok(ToolForm::Sphere { radius }) => Some((End::Radius, radius)),
            Ok(ToolForm::Measured(outline)) => Some((End::Outline, outline.lowest())),
            Ok(ToolForm::Own(tool)) => Some((End::Own, tool.outline().deepest())),
            _ => None,
        };
        let bottom = self.substrate.and_then(|s| s.depth).map(|d| (End::Bottom, highest + d.0));
        own.into_iter().chain(bottom)
    }

    /// The depth (m) that the tool can go at most, infinite for a cone in a body without a bottom.
    pub fn deepest(&self) -> f64 {
        self.ends()
            .map(|(end, depth)| match end {
                End::Height | End::Radius | End::Outline | End::Own => depth,
                // a hair above the bottom, which itself is refused
                End::Bottom => 0.999 * depth,
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// The end of loading must suit the symmetry and the height of the asperities.
    fn check_loading(&self) -> Check {
        match (self.symmetry, self.loading.force) {
            (Symmetry::Axisymmetric, Some(ToolForce::PerLength(_))) => {
                return Err(error(
                    "loading.force",
                    "is per length, which belongs to plane strain: give the force on the full body of revolution, for example \"4 N\"",
                ));
            }
            (Symmetry::PlaneStrain, Some(ToolForce::Total(_))) => {
                return Err(error(
                    "loading.force",
                    "is a total, but in plane strain forces are per length of ridge: give for example \"4 N/mm\"",
                ));
            }
            _ => {}
        }
        let Some(depth) = self.loading.depth else { return Ok(()) };
        let message = self.ends().find_map(|(end, most)| match end {
            End::Height if depth.0 > most => Some(format!(
                "a plane can go at most {} deep, the height of the highest asperity, not {}: ask for less, or raise the asperity",
                length(most),
                length(depth.0)
            )),
            End::Radius if depth.0 > most => Some(format!(
                "a sphere can go at most its radius deep, {}, not {}: ask for less, or take a larger sphere",
                length(most),
                length(depth.0)
            )),
            End::Outline if depth.0 > most => Some(format!(
                "the tool is known up to {} above its apex, so it can go no deeper, not {}: ask for less, or measure more of it",
                length(most),
                length(depth.0)
            )),
            End::Own if depth.0 > most => Some(format!(
                "the tool can go at most {} deep, where its outline ends, not {}: ask for less, or take a tool whose outline goes further",
                length(most),
                length(depth.0)
            )),
            End::Bottom if depth.0 >= most => Some(format!(
                "the tool would go {} deep into a body {} high: ask for less",
                length(depth.0),
                length(most)
            )),
            _ => None,
        });
        message.map_or(Ok(()), |m| Err(error("loading.depth", m)))
    }
}

impl Asperity {
    /// Ranges of one asperity; paths relative to its table.
    fn check(&self) -> Check {
        not_negative("tolerance", "the tolerance", self.tolerance)?;
        let form = self.form()?;
        not_negative("spacing", "the spacing", self.spacing)?;
        if let Some(height) = self.height {
            positive("height", "the height", height)?;
        }
        if let Some(radius) = self.radius {
            positive("radius", "the radius", radius)?;
            let most = HIGHEST_CAP * radius.0;
            return match self.height {
                Some(height) if height.0 > most * (1.0 + 1e-12) => Err(error(
                    "height",
                    format!(
                        "must be at most {}, half the radius, as a mesh cannot follow a steeper foot, not {}: lower it, or leave it out for a quarter of the radius",
                        length(most),
                        length(height.0)
                    ),
                )),
                _ => Ok(()),
            };
        }
        slope("slope_deg", self.slope_deg)?;
        not_negative("tip_radius", "the tip radius", self.tip_radius)?;
        not_negative("valley_radius", "the valley radius", self.valley_radius)?;
        let AsperityForm::Cone { height, slope, tip_radius, valley_radius } = form else { return Ok(()) };
        let base = form.base_radius();
        if !(base.is_finite() && base > 0.0) {
            return Err(error("slope_deg", "makes a foot too wide to compute with: raise the slope"));
        }
        // the cap ends where the sphere meets the flank: R sin β out from the axis, R (1 - cos β) below the
        // summit
        let cap_height = 2.0 * (0.5 * slope).sin().powi(2);
        if tip_radius * cap_height >= height {
            return Err(error(
                "tip_radius",
                format!(
                    "must be below {}, else the rounded tip is higher than the asperity ({} high), not {}: make the tip sharper, the slope smaller or the asperity higher",
                    length(height / cap_height),
                    length(height),
                    length(tip_radius)
                ),
            ));
        }
        let flank = base - tip_radius * slope.sin();
        if valley_radius * slope.sin() > flank {
            return Err(error(
                "valley_radius",
                format!(
                    "must be at most {}, else the fillet reaches the tip, not {}: make the valley sharper",
                    length(flank / slope.sin()),
                    length(valley_radius)
                ),
            ));
        }
        Ok(())
    }
}

impl Asperity {
    /// A measured outline on the axis must be half a section.
    fn check_on_axis(&self) -> Check {
        match self.points.as_ref().map(|points| span_of(points.metres())) {
            Some(Span::Whole) => Err(error(
                "points[0]",
                "the asperity on the axis is half a section, from the axis outward, and begins at least half way up: count the places from its summit; a deeper hole in the middle is not meshed",
            )),
            _ => Ok(()),
        }
    }
}

impl Substrate {
    fn check(&self) -> Check {
        self.radius.map_or(Ok(()), |r| positive("radius", "the radius", r))?;
        self.depth.map_or(Ok(()), |d| positive("depth", "the depth", d))
    }
}

impl Numerics {
    /// Fewest and most elements across the contact that a scene may ask for.
    pub const ELEMENTS: [f64; 2] = [2.0, 1000.0];
    /// Fewest and most load steps.
    pub const STEPS: [f64; 2] = [1.0, 1e4];
    /// Least and greatest penetration over depth.
    pub const PENETRATION: [f64; 2] = [1e-6, 0.1];
    /// Tightest and loosest tolerance of Newton's method.
    pub const TOLERANCE: [f64; 2] = [1e-13, 1e-3];
    /// Smallest and largest substrate in contact radii.
    pub const DOMAIN: [f64; 2] = [3.0, 1e4];

    fn check(&self) -> Check {
        let whole = |value: Option<usize>| value.map(|v| v as f64);
        let numbers = [
            (
                "elements_in_contact",
                "the number of elements across the contact",
                whole(self.elements_in_contact),
                Numerics::ELEMENTS,
            ),
            ("steps", "the number of load steps", whole(self.steps), Numerics::STEPS),
            ("penetration", "the penetration over depth", self.penetration, Numerics::PENETRATION),
            (
                "newton_tolerance",
                "the tolerance of Newton's method",
                self.newton_tolerance,
                Numerics::TOLERANCE,
            ),
            ("domain", "the size of the substrate in contact radii", self.domain, Numerics::DOMAIN),
        ];
        numbers.into_iter().try_for_each(|(path, what, value, [low, high])| match value {
            Some(value) => check_range(path, what, value, low, high, "leave it out to let `accuracy` choose"),
            None => Ok(()),
        })
    }
}
