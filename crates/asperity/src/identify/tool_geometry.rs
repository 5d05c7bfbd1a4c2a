//! Body and tool of a measurement, from its tables.

use super::material_checks::{KeyError, key_error};
use asperity_identification::fit_file::{FitCurve, FitShape, FitTool, Nuisance};
use asperity_identification::known_or_unknown::KnownOrUnknown;
use asperity_identification::response::Geometry;
use asperity_simulation::scene::Friction;

/// Half apex angle of the cone whose section is that of Berkovich's and of Vickers' pyramid at every depth,
/// degrees.
pub const PYRAMIDS_CONE: f64 = 70.3;

fn slope_deg(tool: &FitTool) -> Result<f64, KeyError> {
    let missing = match tool.shape {
        FitShape::Conospherical => {
            "`half_apex_deg` of the cone behind the tip is missing: give half_apex_deg = 45 or slope_deg = 45, as the maker of the \
             tool states it; where the indent is so shallow that the tip alone touches, say shape = \"sphere\" and radius instead"
        }
        _ => "`half_apex_deg` of the cone is missing: give half_apex_deg = 70.3, or slope_deg = 19.7",
    };
    match (tool.slope_deg, tool.half_apex_deg) {
        (Some(_), Some(_)) => {
            Err(key_error("tool.half_apex_deg", "does not go with slope_deg: remove one of the two"))
        }
        (None, None) => Err(key_error("tool", missing)),
        (Some(slope), None) | (None, Some(slope)) if !(slope > 0.0 && slope < 90.0) => {
            Err(key_error("tool", format!("the angle must be above 0 and below 90 degrees, not {slope}")))
        }
        (Some(slope), None) => Ok(slope),
        (None, Some(half)) => Ok(90.0 - half),
    }
}

/// Slopes of cones that finite elements go through with, degrees.
const CONE_SLOPES_DEG: [f64; 2] = [1.0, 50.0];

/// Body and tool of a measurement.
pub(super) fn geometry(curve: &FitCurve) -> Result<Geometry, KeyError> {
    let tool = &curve.tool;
    let pyramid = matches!(tool.shape, FitShape::Berkovich | FitShape::Vickers);
    let cone = matches!(tool.shape, FitShape::Cone | FitShape::Conospherical);
    for (key, given, allowed) in [
        ("slope_deg", tool.slope_deg.is_some(), cone),
        ("half_apex_deg", tool.half_apex_deg.is_some(), cone),
        ("tip_radius", tool.tip_radius.is_some(), cone || pyramid),
        ("radius", tool.radius.is_some(), tool.shape == FitShape::Sphere),
    ] {
        if given && !allowed {
            let way_out = match (key, tool.shape) {
                ("radius", FitShape::Cone | FitShape::Conospherical) => {
                    "does not belong to a cone: that of its rounded tip is tip_radius"
                }
                ("tip_radius", FitShape::Sphere) => "does not belong to a ball: its radius is radius",
                _ => "does not belong to a tool of this shape: remove it",
            };
            return Err(key_error(&format!("tool.{key}"), way_out));
        }
    }
    if tool.shape != FitShape::Plane && curve.asperity.is_some() {
        return Err(key_error(
            "asperity",
            "is crushed by a plane: give tool = { shape = \"plane\" }, or remove it",
        ));
    }
    let blunt = match tool.tip_radius {
        Some(KnownOrUnknown::Known(tip)) => tip.0 > 0.0,
        Some(KnownOrUnknown::Range(_)) => true,
        None => curve.unknown.contains(&Nuisance::TipRadius),
    };
    let cone_of = |slope_deg: f64| {
        if !(CONE_SLOPES_DEG[0]..=CONE_SLOPES_DEG[1]).contains(&slope_deg) {
            return Err(key_error(
                "tool",
                format!(
                    "a cone must have a half apex angle from {} to {} degrees, not {}",
                    90.0 - CONE_SLOPES_DEG[1],
                    90.0 - CONE_SLOPES_DEG[0],
                    90.0 - slope_deg
                ),
            ));
        }
        Ok(if blunt { Geometry::Rounded { slope_deg } } else { Geometry::Sharp { slope_deg } })
    };
    match tool.shape {
        FitShape::Plane => {
            let asperity = curve
                .asperity
                .clone()
                .ok_or_else(|| key_error("", "`asperity` is missing: a plane crushes one"))?;
            asperity.form().map_err(|e| key_error(&format!("asperity.{}", e.path), e.message))?;
            Ok(Geometry::Crush { asperity })
        }
        FitShape::Sphere => {
            let radius = tool.radius.ok_or_else(|| {
                key_error("tool", "`radius` of the sphere is missing: give radius = \"1 mm\"")
            })?;
            if !(radius.0 > 0.0 && radius.0.is_finite()) {
                return Err(key_error("tool.radius", "must be finite and above 0"));
            }
            Ok(Geometry::Ball { radius: radius.0 })
        }
        FitShape::Berkovich | FitShape::Vickers => cone_of(90.0 - PYRAMIDS_CONE),
        FitShape::Cone | FitShape::Conospherical => cone_of(slope_deg(tool)?),
    }
}

/// Range of the coefficient of friction where it is sought without one.
const SOUGHT_FRICTION: [f64; 2] = [0.0, 0.5];

/// The friction of the tool that is known, and the range of the one that is sought.
pub(super) fn friction(curve: &FitCurve) -> Result<(Option<Friction>, Option<[f64; 2]>), KeyError> {
    let asked = curve.unknown.contains(&Nuisance::Friction);
    let checked = |friction: Friction| {
        friction.check().map(|()| friction).map_err(|e| key_error(&format!("tool.{}", e.path), e.message))
    };
    Ok(match curve.tool.friction {
        Some(KnownOrUnknown::Range(ends)) => {
            let ends = [checked(ends[0])?, checked(ends[1])?];
            let [Friction::Coefficient(low), Friction::Coefficient(high)] = ends else {
                return Err(key_error("tool.friction", "is sought between two coefficients: give [0, 0.5]"));
            };
            if low >= high {
                return Err(key_error("tool.friction", "the lower coefficient comes first: give [0, 0.5]"));
            }
            (None, Some([low, high]))
        }
        Some(KnownOrUnknown::Known(_)) if asked => {
            let message = "is known by tool.friction and sought by unknown: remove one of the two";
            return Err(key_error("unknown", message));
        }
        Some(KnownOrUnknown::Known(friction)) => (Some(checked(friction)?), None),
        None => (None, asked.then_some(SOUGHT_FRICTION)),
    })
}
