//! The law of an interface as input decks of finite-element programs: pressure over overclosure, conductances
//! over pressure.
//!
//! Sources: the manuals of CalculiX 2.20 and Abaqus (`*SURFACE BEHAVIOR`, `*GAP CONDUCTANCE`), and runs of
//! CalculiX.

use std::fmt::Write;

/// Lines of a comment are broken after so many letters.
const COMMENT_WIDTH: usize = 100;

/// Rows of a conductance that CalculiX keeps: of 2.20, row 21 is written over the first, row 22 over the
/// second.
pub const CALCULIX_CONDUCTANCE_ROWS: usize = 20;

/// An exponential p₀ exp(overclosure/length) through the law of an interface, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    /// p₀, the pressure at overclosure 0, in Pa.
    pub touching: f64,
    /// The length, in m.
    pub length: f64,
    /// Smallest and largest pressure through which it goes, in Pa.
    pub range: [f64; 2],
    /// Root mean square of its relative deviations there.
    pub residual: f64,
}

/// The law of an interface, in SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InterfaceLaw {
    /// The program that made it, for whom the decks are read.
    pub head: String,
    /// Overclosure (m) and pressure (Pa), both rising from 0.
    pub pressure: Vec<[f64; 2]>,
    /// An exponential through the law; none where it is none.
    pub exponential: Option<Exponential>,
    /// Pressure (Pa) and thermal conductance (W/(m² K)), rising; empty without one.
    pub heat: Vec<[f64; 2]>,
    /// Share by which straight lines between those rows are off the law.
    pub heat_error: f64,
    /// Pressure (Pa) and electrical conductance (S/m²), rising; empty without one.
    pub current: Vec<[f64; 2]>,
}

impl InterfaceLaw {
    /// For CalculiX, in N, mm, mW, K: `JOINT` for mechanics from node to surface; with conductances, in
    /// [`CALCULIX_CONDUCTANCE_ROWS`] rows at most, `JOINT_HEAT` from surface to surface, whose closure is a
    /// line, and `JOINT_HEAT_EXPONENTIAL`, whose closure is the exponential.
    ///
    /// Of 2.20, surface to surface with a table has no force, and node to surface with one has the heat of no
    /// pressure. Tried with two blocks of steel on four laws, loads from a thousandth to all of the largest,
    /// first increments from a thousandth to all of the load: the line always converges; the exponential
    /// where every increment carries more than its pressure at overclosure 0, and not where that is next to
    /// nothing; the table from first increments of a hundredth on.
    pub fn calculix(&self) -> String {
        let mut text = comment(&self.head);
        text += &comment(
            "Mechanics, for *CONTACT PAIR, INTERACTION=JOINT, TYPE=NODE TO SURFACE: pressure over overclosure. Begin with a hundredth \
             of the load or less, *STATIC and 0.01, 1.: a joint that just touches is soft, and a model that is pressed at once fails.",
        );
        text += &self.behaviour();
        let Some([overclosure, pressure]) = self.pressure.last().filter(|_| !self.heat.is_empty()) else {
            return text;
        };
        text += &comment(&format!(
            "Heat, for *CONTACT PAIR, INTERACTION=JOINT_HEAT, TYPE=SURFACE TO SURFACE: there CalculiX 2.20 takes no table of pressure, so \
             that the closure is a line to the last row. Under given forces the pressure is right whatever the closure, and so is \
             the heat. CalculiX 2.20 keeps {CALCULIX_CONDUCTANCE_ROWS} rows of a conductance and writes more over the first: \
             straight lines between these are off the law by at most {:.1} %.",
            1e2 * self.heat_error
        ));
        text += "*SURFACE INTERACTION, NAME=JOINT_HEAT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n";
        let _ = writeln!(text, "{}, {}", number(1e-9 * pressure / overclosure), number(0.0));
        text += "*GAP CONDUCTANCE\n";
        text += &rows(&self.heat, 1e-3);
        let Some(formula) = self.exponential else { return text };
        let [low, high] = formula.range.map(|p| short(1e-6 * p));
        text += &comment(&format!(
            "The same with an exponential as its closure, JOINT_HEAT_EXPONENTIAL, for models that move the bodies: from {low} to {high} MPa \
             it is off the law by {:.0} % of the pressure, in root mean square, and beyond it is not the joint's. Under given forces every \
             increment has to carry more than {} MPa, its pressure at overclosure 0: faces that are pressed by less part, and the \
             step fails.",
            1e2 * formula.residual,
            short(1e-6 * formula.touching)
        ));
        text += "*SURFACE INTERACTION, NAME=JOINT_HEAT_EXPONENTIAL\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n";
        // p = p₀ exp(ln(100) overclosure/c₀)
        let length = number(1e3 * formula.length * 100f64.ln());
        let _ = writeln!(text, "{length}, {}", number(1e-6 * formula.touching));
        text + "*GAP CONDUCTANCE\n" + &rows(&self.heat, 1e-3)
    }

    /// For Abaqus, in N, mm, mW, K, A, V: one interaction. Without the parameter `PRESSURE` the second column
    /// of a conductance is a clearance.
    pub fn abaqus(&self) -> String {
        let mut text = comment(&self.head) + &self.behaviour();
        if !self.heat.is_empty() {
            text += &format!("*GAP CONDUCTANCE, PRESSURE\n{}", rows(&self.heat, 1e-3));
        }
        if !self.current.is_empty() {
            text += &format!("*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{}", rows(&self.current, 1e-6));
        }
        text
    }

    /// For piecewise functions of MOOSE, in SI: a row for each point of the pressure.
    pub fn moose(&self) -> String {
        let mut text = String::from("approach_m,pressure_Pa");
        let all = [("conductance_W_per_m2K", &self.heat), ("electrical_conductance_S_per_m2", &self.current)];
        let given = || all.iter().filter(|(_, rows)| !rows.is_empty());
        given().for_each(|(name, _)| text += &format!(",{name}"));
        text.push('\n');
        for [overclosure, pressure] in &self.pressure {
            text += &format!("{},{}", number(*overclosure), number(*pressure));
            given().for_each(|(_, rows)| text += &format!(",{}", number(interpolated(rows, *pressure))));
            text.push('\n');
        }
        text
    }

    fn behaviour(&self) -> String {
        let mut text = String::from(
            "*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n",
        );
        for [overclosure, pressure] in &self.pressure {
            let _ = writeln!(text, "{}, {}", number(1e-6 * pressure), number(1e3 * overclosure));
        }
        text
    }
}

/// Rows of a conductance, times `unit`, and its pressure.
fn rows(conductance: &[[f64; 2]], unit: f64) -> String {
    conductance.iter().fold(String::new(), |mut text, [pressure, value]| {
        let _ = writeln!(text, "{}, {}", number(unit * value), number(1e-6 * pressure));
        text
    })
}

/// A number in at most 20 characters, which is what CalculiX reads.
fn number(value: f64) -> String {
    format!("{value:.9e}")
}

/// A number for a person.
fn short(value: f64) -> String {
    if (1e-3..1e4).contains(&value) {
        format!("{}", (value * 1e4).round() / 1e4)
    } else {
        format!("{value:.1e}")
    }
}

/// A comment of a deck, in lines that a person reads.
fn comment(text: &str) -> String {
    let mut lines = vec![String::from("**")];
    for word in text.split_whitespace() {
        if lines.last().is_some_and(|line| line.chars().count() + word.chars().count() > COMMENT_WIDTH) {
            lines.push(String::from("**"));
        }
        if let Some(line) = lines.last_mut() {
            line.push(' ');
            line.push_str(word);
        }
    }
    lines.join("\n") + "\n"
}

/// The value at `x` between rows (x, y), rising in x: a power between two of them, beyond the last that of
/// the last two.
fn interpolated(rows: &[[f64; 2]], x: f64) -> f64 {
    let i = rows.partition_point(|row| row[0] < x).clamp(1, rows.len().max(2) - 1);
    let (Some([a, y]), Some([b, z])) = (rows.get(i - 1), rows.get(i)) else {
        return rows.first().map_or(f64::NAN, |row| row[1]);
    };
    if *a > 0.0 && *y > 0.0 {
        y * (z / y).powf((x / a).ln() / (b / a).ln())
    } else {
        y + (z - y) * (x - a) / (b - a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law() -> InterfaceLaw {
        InterfaceLaw {
            head: "a head that is long enough ".repeat(9),
            pressure: vec![[0.0, 0.0], [1e-7, 1e6], [2e-7, 4e6]],
            exponential: Some(Exponential { touching: 2e5, length: 5e-8, range: [3e5, 4e6], residual: 0.12 }),
            heat: vec![[0.0, 0.0], [1e6, 1e4], [4e6, 4e4]],
            heat_error: 0.012,
            current: Vec::new(),
        }
    }

    #[test]
    fn decks_have_the_rows_in_the_units_and_the_order_of_their_program() {
        let (calculix, abaqus) = (law().calculix(), law().abaqus());
        for deck in [&calculix, &abaqus] {
            assert!(
                deck.contains("TABULAR\n0.000000000e0, 0.000000000e0\n1.000000000e0, 1.000000000e-4\n"),
                "{deck}"
            );
            // mW/(mm² K), then MPa
            assert!(deck.contains("1.000000000e1, 1.000000000e0\n4.000000000e1, 4.000000000e0\n"), "{deck}");
            let width = |line: &str| line.split(',').map(|cell| cell.trim().len()).max().unwrap();
            assert!(deck.lines().filter(|line| !line.starts_with('*')).all(|line| width(line) <= 20));
            assert!(deck.lines().all(|line| line.len() < 120));
        }
        assert!(calculix.contains("LINEAR\n2.000000000e4, 0.000000000e0\n*GAP CONDUCTANCE\n"), "{calculix}");
        // 5e-5 mm ln 100, and 0.2 MPa
        assert!(calculix.contains("EXPONENTIAL\n2.302585093e-4, 2.000000000e-1\n*GAP CONDUCTANCE\n"));
        assert!(calculix.contains("from 0.3 to 4 MPa") && calculix.contains("12 %"), "{calculix}");
        assert!(calculix.contains("1.2 %"), "{calculix}");
        assert!(abaqus.contains("*GAP CONDUCTANCE, PRESSURE\n") && !abaqus.contains("JOINT_HEAT"));
        let plain = InterfaceLaw { exponential: None, ..law() }.calculix();
        assert!(plain.contains("LINEAR\n") && !plain.contains("EXPONENTIAL"), "{plain}");
    }

    #[test]
    fn moose_has_a_conductance_for_every_pressure() {
        let text = law().moose();
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
            .collect();
        assert!(text.starts_with("approach_m,pressure_Pa,conductance_W_per_m2K\n"));
        assert_eq!(rows, [[0.0, 0.0, 0.0], [1e-7, 1e6, 1e4], [2e-7, 4e6, 4e4]]);
        // a power between two rows: half way in the logarithms
        assert!((interpolated(&law().heat, 2e6) - 2e4).abs() < 1e-9);
    }
}
