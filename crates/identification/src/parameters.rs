//! Unknowns: parameters with bounds, and the metal and tools that belong to their values.

use crate::fit_file::FitMaterial;
use crate::known_or_unknown::KnownOrUnknown;
use asperity_material::units::{Stress, rounded};
use asperity_material::{Elastic, Hardening, HardeningCurve, HardeningTable, range};
use asperity_numerics::sobol::Sobol;
use asperity_simulation::scene::Material;

/// Quantity that a parameter stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// E.
    YoungsModulus,
    /// ν.
    PoissonsRatio,
    /// σ_y.
    YieldStress,
    /// n.
    HardeningExponent,
    /// Yield stress of a point of the table.
    TablePoint(usize),
    /// Depth reading at which the tool touches, of a measurement.
    ContactDepth(usize),
    /// Compliance of the machine, of a measurement.
    Compliance(usize),
    /// Radius of the tip, of a measurement.
    TipRadius(usize),
    /// Coefficient of friction of the tool, of a measurement.
    Friction(usize),
}

/// A parameter. Its coordinate is the logarithm of its SI value where that is positive by nature, else the
/// value in the unit of the results.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in the results.
    pub name: String,
    /// Unit of its values in the results.
    pub unit: &'static str,
    /// SI value of that unit.
    pub scale: f64,
    /// Quantity that it stands for.
    pub slot: Slot,
    /// True where the coordinate is a logarithm.
    pub logarithmic: bool,
    /// Bounds of the coordinate.
    pub bounds: [f64; 2],
}

impl Parameter {
    fn new(
        name: String,
        slot: Slot,
        (unit, scale): (&'static str, f64),
        logarithmic: bool,
        ends: [f64; 2],
    ) -> Parameter {
        let bounds = ends.map(|x| if logarithmic { x.ln() } else { x / scale });
        Parameter { name, unit, scale, slot, logarithmic, bounds }
    }

    /// SI value at a coordinate.
    pub fn value(&self, coordinate: f64) -> f64 {
        if self.logarithmic { coordinate.exp() } else { coordinate * self.scale }
    }

    /// Value in the unit of the results.
    pub fn shown(&self, coordinate: f64) -> f64 {
        self.value(coordinate) / self.scale
    }

    /// Width of the bounds.
    pub fn width(&self) -> f64 {
        self.bounds[1] - self.bounds[0]
    }
}

/// A metal with every number given, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Metal {
    /// E and ν.
    pub elastic: Elastic,
    /// The curve of hardening, Pa.
    pub hardening: HardeningCurve,
}

impl Metal {
    /// Yield stress at a plastic strain, Pa.
    pub fn stress_at(&self, plastic_strain: f64) -> f64 {
        self.hardening.flow(plastic_strain).yield_stress
    }
}

/// The metal of a fit and the places of its parameters.
#[derive(Clone, Debug)]
pub struct Unknowns {
    material: FitMaterial,
    /// All that is sought, the metal first.
    pub parameters: Vec<Parameter>,
}

const GPA: (&str, f64) = ("GPa", 1e9);
const MPA: (&str, f64) = ("MPa", 1e6);

impl Unknowns {
    /// The unknowns of `material`; those of the measurements are added later.
    pub fn new(material: &FitMaterial) -> Unknowns {
        let mut parameters = Vec::new();
        let mut add = |name: &str, slot, unit, logarithmic, sought: KnownOrUnknown<f64>| {
            if let KnownOrUnknown::Range(ends) = sought {
                parameters.push(Parameter::new(name.to_string(), slot, unit, logarithmic, ends));
            }
        };
        add("youngs_modulus", Slot::YoungsModulus, GPA, true, material.youngs_modulus.map(|e| e.0));
        add("poissons_ratio", Slot::PoissonsRatio, ("", 1.0), false, material.poissons_ratio);
        if let Some(sought) = material.yield_stress {
            add("yield_stress", Slot::YieldStress, MPA, true, sought.map(|s| s.0));
        }
        if let Some(sought) = material.hardening_exponent {
            add("hardening_exponent", Slot::HardeningExponent, ("", 1.0), false, sought);
        }
        for (i, (_, sought)) in material.hardening_table.iter().flatten().enumerate() {
            let name = format!("hardening_table[{i}]");
            add(&name, Slot::TablePoint(i), MPA, true, sought.map(|s| s.0));
        }
        Unknowns { material: material.clone(), parameters }
    }

    /// Adds what is unknown of measurement `curve`, counted from 0 of `curves`.
    pub fn add(&mut self, key: &str, curve: usize, curves: usize, ends: [f64; 2]) {
        let name = if curves > 1 { format!("{key}[{curve}]") } else { key.to_string() };
        let (slot, unit, logarithmic) = match key {
            "contact_depth" => (Slot::ContactDepth(curve), ("um", 1e-6), false),
            "machine_compliance" => (Slot::Compliance(curve), ("nm/mN", 1e-6), false),
            "friction" => (Slot::Friction(curve), ("", 1.0), false),
            _ => (Slot::TipRadius(curve), ("um", 1e-6), true),
        };
        self.parameters.push(Parameter::new(name, slot, unit, logarithmic, ends));
    }

    /// The same with first touch and compliance held at 0, or as near to it as their bounds let them.
    pub fn without_nuisances(&self) -> Unknowns {
        let mut held = self.clone();
        for p in &mut held.parameters {
            if matches!(p.slot, Slot::ContactDepth(_) | Slot::Compliance(_)) {
                p.bounds = [0.0_f64.clamp(p.bounds[0], p.bounds[1]); 2];
            }
        }
        held
    }

    /// Value of `slot` at `point`, where it is sought.
    pub fn unknown_value(&self, point: &[f64], slot: Slot) -> Option<f64> {
        let i = self.parameters.iter().position(|p| p.slot == slot)?;
        Some(self.parameters[i].value(point[i]))
    }

    fn number(&self, point: &[f64], slot: Slot, given: KnownOrUnknown<f64>) -> f64 {
        match given {
            KnownOrUnknown::Known(value) => value,
            KnownOrUnknown::Range(ends) => self.unknown_value(point, slot).unwrap_or(ends[0]),
        }
    }

    /// The metal at `point`; `None` where there is none: yield beyond what can be computed, a table that
    /// falls.
    pub fn metal(&self, point: &[f64]) -> Option<Metal> {
        let given = &self.material;
        let modulus = self.number(point, Slot::YoungsModulus, given.youngs_modulus.map(|e| e.0));
        let ratio = self.number(point, Slot::PoissonsRatio, given.poissons_ratio);
        let hardening: HardeningCurve = match given.hardening_law.power_law() {
            Some(law) => {
                let yield_stress = self.number(point, Slot::YieldStress, given.yield_stress?.map(|s| s.0));
                let exponent = self.number(point, Slot::HardeningExponent, given.hardening_exponent?);
                Hardening { law, yield_stress, exponent, youngs_modulus: modulus }.into()
            }
            None => {
                let table = given.hardening_table.as_ref()?.iter().enumerate();
                let stress = |(i, (strain, sought)): (
                    usize,
                    &(f64, KnownOrUnknown<asperity_material::units::Stress>),
                )| {
                    [*strain, self.number(point, Slot::TablePoint(i), sought.map(|s| s.0))]
                };
                HardeningTable::new(&table.map(stress).collect::<Vec<_>>()).ok()?.into()
            }
        };
        let over = modulus / hardening.yield_stress();
        let elastic = Elastic { youngs_modulus: modulus, poissons_ratio: ratio };
        let [least, most] = range::MODULUS_OVER_YIELD;
        (least..=most).contains(&over).then_some(Metal { elastic, hardening })
    }

    /// The metal at `point` as a scene gives it, to five digits; `None` where there is none.
    pub fn material(&self, point: &[f64]) -> Option<Material> {
        let Metal { elastic, hardening } = self.metal(point)?;
        let five = |x: f64| rounded(x, 5);
        let modulus = Stress(five(elastic.youngs_modulus));
        let body = Material {
            hardening_law: self.material.hardening_law.into(),
            stress_measure: self.material.stress_measure,
            ..Material::elastic_body(modulus, five(elastic.poissons_ratio))
        };
        Some(match hardening {
            HardeningCurve::Power(law) => Material {
                hardening_law: body.hardening_law,
                ..body.yielding(Stress(five(law.yield_stress)), five(law.exponent))
            },
            _ => {
                let strains = self.material.hardening_table.iter().flatten().map(|(strain, _)| *strain);
                let points =
                    strains.map(|strain| (strain, Stress(five(hardening.flow(strain).yield_stress))));
                Material { hardening_table: Some(points.collect()), ..body }
            }
        })
    }

    /// `point` within the bounds.
    pub fn clamped(&self, point: &[f64]) -> Vec<f64> {
        point.iter().zip(&self.parameters).map(|(x, p)| x.clamp(p.bounds[0], p.bounds[1])).collect()
    }

    /// Number of unknowns of the metal, which stand first.
    pub fn of_the_metal(&self) -> usize {
        let nuisance = |p: &&Parameter| {
            matches!(
                p.slot,
                Slot::ContactDepth(_) | Slot::Compliance(_) | Slot::TipRadius(_) | Slot::Friction(_)
            )
        };
        self.parameters.iter().filter(|p| !nuisance(p)).count()
    }
}

/// The first `count` points of Sobol's sequence within the bounds of `parameters`, its first point left out.
pub fn sobol_points(parameters: &[Parameter], count: usize) -> Vec<Vec<f64>> {
    let Some(sobol) = Sobol::new(parameters.len()) else { return Vec::new() };
    let coordinate = |i: usize, (k, p): (usize, &Parameter)| p.bounds[0] + p.width() * sobol.coordinate(k, i);
    (1..=count).map(|i| parameters.iter().enumerate().map(|k| coordinate(i, k)).collect()).collect()
}

/// Indices of `count` of `points`, each the one farthest from those taken before over their span, the first
/// one first.
pub(crate) fn far_apart(points: &[&[f64]], count: usize) -> Vec<usize> {
    let dimensions = points.first().map_or(0, |p| p.len());
    let span: Vec<f64> = (0..dimensions)
        .map(|i| {
            let of = points.iter().map(|p| p[i]);
            of.clone().fold(f64::NEG_INFINITY, f64::max) - of.fold(f64::INFINITY, f64::min)
        })
        .collect();
    let distance = |a: &[f64], b: &[f64]| {
        let square = |((a, b), s): ((&f64, &f64), &f64)| if *s > 0.0 { ((a - b) / s).powi(2) } else { 0.0 };
        a.iter().zip(b).zip(&span).map(square).sum::<f64>()
    };
    let mut nearest = vec![f64::INFINITY; points.len()];
    let mut taken = Vec::new();
    let mut next = 0;
    while taken.len() < count.min(points.len()) {
        taken.push(next);
        for (near, point) in nearest.iter_mut().zip(points) {
            *near = near.min(distance(point, points[next]));
        }
        next = (0..points.len()).max_by(|a, b| nearest[*a].total_cmp(&nearest[*b])).unwrap_or(0);
    }
    taken
}
