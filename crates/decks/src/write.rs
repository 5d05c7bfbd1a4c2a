//! The text of a deck.

use super::deck::{Deck, Reader};
use asperity_material::StressMeasure;
use asperity_mesh::{ElementKind, Section, write_inp, write_inp_side};
use asperity_solver::contact::slip::Friction;
use std::io::{self, Write};

/// Coefficient that stands for a tool to which what touches sticks.
const STICKING: f64 = 1000.0;

/// Elastic slip of Abaqus over the length of an element.
const SLIP_TOLERANCE: f64 = 0.001;

/// A number in at most 18 characters: a field of CalculiX holds 20.
pub(super) fn number(x: f64) -> String {
    format!("{x:.11e}")
}

impl Deck {
    /// Writes the deck.
    ///
    /// # Errors
    /// A writer that fails.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        self.heading(&mut out)?;
        write_inp(&mut out, &self.mesh, self.section, "um")?;
        write_inp_side(&mut out, &self.mesh, "CONTACT", &self.contact)?;
        match self.reader {
            Reader::CalculiX => self.tool(&mut out)?,
            Reader::Abaqus => self.rigid_tool(&mut out)?,
        }
        self.metal(&mut out)?;
        self.interaction(&mut out)?;
        self.supports(&mut out)?;
        match self.reader {
            Reader::CalculiX => self.steps(&mut out),
            Reader::Abaqus => self.abaqus_steps(&mut out),
        }
    }

    /// The title, and how to read the results.
    fn heading(&self, out: &mut impl Write) -> io::Result<()> {
        let version = env!("CARGO_PKG_VERSION");
        writeln!(out, "*HEADING\n{}: crush by a rigid tool, written by asperity {version}", self.name)?;
        writeln!(out, "** units: um, MPa; so forces in uN, energies in pJ")?;
        match self.section {
            Section::Axisymmetric if self.reader == Reader::Abaqus => {
                writeln!(out, "** forces, areas and energies are those of the full revolution")?;
            }
            Section::Axisymmetric => writeln!(
                out,
                "** CalculiX takes CAX elements as wedges of 2 degrees: multiply its forces, areas and energies by 180.\n\
                 ** The axis is a hole of a thousandth of the first element with u_r = 0, because CalculiX finds no\n\
                 ** contact on faces that collapse onto the axis."
            )?,
            Section::PlaneStrain => writeln!(
                out,
                "** plane strain, 1 um thick: forces in uN are N/m of ridge, areas in um2, widths in um"
            )?,
        }
        let tool = match self.reader {
            Reader::CalculiX => {
                "The tool is a row of elements whose nodes all move together: its force is the sum of RF2 over set TOOL."
            }
            Reader::Abaqus => "The tool is a rigid body: its force is RF2 of node REF, its travel -U2 there.",
        };
        writeln!(
            out,
            "** {tool}\n\
             ** Its travel includes the penetration: depth = travel - mean pressure / penalty ({:.3e} MPa/um, made for a\n\
             ** penetration of {:.2} % of the depth {:.4} um).",
            self.penalty,
            100.0 * self.penetration,
            self.depth
        )?;
        self.remarks(out)?;
        match self.reader {
            Reader::CalculiX => writeln!(
                out,
                "** Convergence in the load step is of first order in the ratio of successive depths in CalculiX: more steps\n\
                 ** (numerics.steps) matter more than a finer mesh."
            ),
            Reader::Abaqus => writeln!(
                out,
                "** Each unit of time is an increment of the scene's own schedule; history is written at the end of each."
            ),
        }
    }

    /// The departures of the deck from the scene.
    fn remarks(&self, out: &mut impl Write) -> io::Result<()> {
        if let Some(table) = self.table.as_ref().filter(|table| table.error > 0.0) {
            writeln!(
                out,
                "** The table of hardening has {} points; between them, as a share of its stress, the law is met to {:.1e}",
                table.points.len(),
                table.error
            )?;
        }
        for warning in self.warnings() {
            writeln!(out, "** warning: {warning}")?;
        }
        if self.mesh.kind == ElementKind::Quad4 {
            writeln!(
                out,
                "** The linear element of asperity has one dilatation; that of the reader of this deck is its own."
            )?;
        }
        if self.table.is_some() {
            let measure = match self.stress_measure {
                StressMeasure::Cauchy => "true (Cauchy) stress, force over current area",
                StressMeasure::Kirchhoff => "Kirchhoff stress, the true one times the volume ratio",
            };
            writeln!(
                out,
                "** *PLASTIC holds {measure}, as the scene means it; the program that reads this deck may take another measure."
            )?;
        }
        if self.moving_share > 0.0 && self.phases.len() > 1 {
            writeln!(
                out,
                "** CalculiX 2.20 was seen to give up in unloading a body that hardens kinematically."
            )?;
        }
        Ok(())
    }

    /// The tool: a row of linear elements over its outline, whose lower sides are the surface `TOOL`.
    fn tool(&self, out: &mut impl Write) -> io::Result<()> {
        let (nodes, cells) = (self.mesh.nodes.len(), self.mesh.cell_count());
        let count = self.outline.len();
        let high = self.outline.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[1])) + self.depth;
        writeln!(out, "*NODE, NSET=TOOL")?;
        for (i, [x, z]) in self.outline.iter().enumerate() {
            writeln!(out, "{}, {}, {}, 0.", nodes + i + 1, number(*x), number(*z))?;
        }
        for (i, [x, _]) in self.outline.iter().enumerate() {
            writeln!(out, "{}, {}, {}, 0.", nodes + count + i + 1, number(*x), number(high))?;
        }
        let element = self.section.element(ElementKind::Quad4);
        writeln!(out, "*ELEMENT, TYPE={element}, ELSET=TOOL")?;
        for i in 0..count - 1 {
            let (a, b) = (nodes + i + 1, nodes + count + i + 1);
            writeln!(out, "{}, {a}, {}, {}, {b}", cells + i + 1, a + 1, b + 1)?;
        }
        writeln!(out, "*SURFACE, NAME=TOOL, TYPE=ELEMENT")?;
        for i in 0..count - 1 {
            writeln!(out, "{}, S1", cells + i + 1)?;
        }
        Ok(())
    }

    /// The metal; in CalculiX a material for the tool too, whose elements never strain.
    fn metal(&self, out: &mut impl Write) -> io::Result<()> {
        let elastic = format!("*ELASTIC\n{}, {}", number(self.elastic[0]), number(self.elastic[1]));
        writeln!(out, "*MATERIAL, NAME=METAL\n{elastic}")?;
        if let Some(table) = &self.table {
            self.plasticity(out, &table.points)?;
        }
        let thickness = match self.section {
            Section::Axisymmetric => "",
            Section::PlaneStrain => "1.\n",
        };
        write!(out, "*SOLID SECTION, ELSET=BODY, MATERIAL=METAL\n{thickness}")?;
        if self.reader == Reader::Abaqus {
            return Ok(());
        }
        writeln!(out, "*MATERIAL, NAME=RIGID\n{elastic}")?;
        write!(out, "*SOLID SECTION, ELSET=TOOL, MATERIAL=RIGID\n{thickness}")
    }

    /// The table of hardening; a share of it that moves the yield surface by itself.
    fn plasticity(&self, out: &mut impl Write, points: &[[f64; 2]]) -> io::Result<()> {
        let rows = |out: &mut dyn Write, share: f64| {
            points.iter().try_for_each(|[stress, strain]| {
                let first = points[0][0];
                writeln!(out, "{}, {}", number(first + share * (stress - first)), number(*strain))
            })
        };
        let moving = self.moving_share;
        if moving > 0.0 && moving < 1.0 {
            writeln!(
                out,
                "** movement of the yield surface over plastic strain, from first yield; then its size\n\
                 *PLASTIC, HARDENING=COMBINED"
            )?;
            rows(out, moving)?;
            writeln!(out, "*CYCLIC HARDENING")?;
            return rows(out, 1.0 - moving);
        }
        let kinematic = if moving > 0.0 { ", HARDENING=KINEMATIC" } else { "" };
        writeln!(out, "** yield stress over plastic strain\n*PLASTIC{kinematic}")?;
        rows(out, 1.0)
    }

    /// Contact with the penalty, smooth or with friction.
    fn interaction(&self, out: &mut impl Write) -> io::Result<()> {
        let name = if self.friction.is_some() { "RUBBING" } else { "FRICTIONLESS" };
        writeln!(
            out,
            "*SURFACE INTERACTION, NAME={name}\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}",
            number(self.penalty)
        )?;
        if let Some(friction) = self.friction {
            self.friction(out, friction)?;
        }
        writeln!(
            out,
            "** slave, master\n*CONTACT PAIR, INTERACTION={name}, TYPE=SURFACE TO SURFACE\nCONTACT, TOOL"
        )
    }

    /// Friction: in CalculiX the coefficient and the traction per elastic slip, in Abaqus the coefficient
    /// with the largest elastic slip over an element, or a rough tool.
    fn friction(&self, out: &mut impl Write, friction: Friction) -> io::Result<()> {
        match (self.reader, friction) {
            (Reader::CalculiX, Friction::Coulomb(coefficient)) => {
                writeln!(out, "*FRICTION\n{}, {}", number(coefficient), number(self.penalty))
            }
            (Reader::CalculiX, Friction::Sticking) => {
                writeln!(out, "** sticks\n*FRICTION\n{STICKING}, {}", number(self.penalty))
            }
            (Reader::Abaqus, Friction::Coulomb(coefficient)) => {
                writeln!(out, "*FRICTION, SLIP TOLERANCE={SLIP_TOLERANCE}\n{}", number(coefficient))
            }
            (Reader::Abaqus, Friction::Sticking) => writeln!(out, "*FRICTION, ROUGH"),
        }
    }

    /// The base is clamped, the axis and symmetric sides slide along themselves, the tool moves along z only.
    fn supports(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "*BOUNDARY\nBASE, 1, 2")?;
        let sides = &self.mesh.sides;
        let on_axis = self.section == Section::Axisymmetric || self.symmetric;
        if on_axis && !sides.axis.is_empty() {
            writeln!(out, "AXIS, 1")?;
        }
        if self.symmetric && !sides.outer.is_empty() {
            writeln!(out, "OUTER, 1")?;
        }
        match self.reader {
            Reader::CalculiX => writeln!(out, "TOOL, 1"),
            Reader::Abaqus => writeln!(out, "REF, 1\nREF, 6"),
        }
    }

    /// One step to each travel; forces, contact and energy are printed at its end, fields kept at the end of
    /// each phase.
    fn steps(&self, out: &mut impl Write) -> io::Result<()> {
        let mut index = 0;
        for phase in &self.phases {
            for (i, travel) in phase.travels.iter().enumerate() {
                let ends = [i == 0, i + 1 == phase.travels.len()];
                index += 1;
                let kind = phase.name.to_lowercase();
                writeln!(out, "** step {index}, {kind} to a travel of {travel:.6} um")?;
                writeln!(out, "*STEP, NLGEOM, INC=1000\n*STATIC\n1., 1., 1.E-6, 1.")?;
                writeln!(out, "*BOUNDARY\nTOOL, 2, 2, {}", number(-travel))?;
                output(out, index == 1, ends)?;
            }
        }
        Ok(())
    }
}

/// The output of a step of CalculiX: the very first one asks for what is printed, the first and the last of a
/// phase say whether fields are kept.
fn output(out: &mut impl Write, is_very_first: bool, [is_first, is_last]: [bool; 2]) -> io::Result<()> {
    if is_very_first {
        writeln!(out, "*NODE PRINT, NSET=TOOL, TOTALS=YES, FREQUENCY=1000\nU, RF")?;
        writeln!(out, "*EL PRINT, ELSET=BODY, TOTALS=ONLY, FREQUENCY=1000\nELSE")?;
        writeln!(out, "*CONTACT PRINT, SLAVE=CONTACT, MASTER=TOOL, FREQUENCY=1000\nCF")?;
    }
    if is_first || is_last {
        let frequency = if is_last { 1000 } else { 0 };
        writeln!(out, "*NODE FILE, FREQUENCY={frequency}\nU, RF")?;
        writeln!(out, "*EL FILE, FREQUENCY={frequency}\nS, PEEQ, ENER")?;
        writeln!(out, "*CONTACT FILE, FREQUENCY={frequency}\nCDIS, CSTR")?;
    }
    writeln!(out, "*END STEP")
}
