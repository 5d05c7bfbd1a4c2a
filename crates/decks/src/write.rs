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
fn number(x: f64) -> String {
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
        self.tool(&mut out)?;
        self.metal(&mut out)?;
        self.interaction(&mut out)?;
        self.supports(&mut out)?;
        for (index, travel) in self.travels.iter().enumerate() {
            self.step(&mut out, index, *travel)?;
        }
        Ok(())
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
                "** CalculiX takes CAX elements as wedges of 2 degrees: multiply its forces, areas and energies by 180\n\
                 ** (Abaqus: they are those of the full revolution). The axis is a hole of a thousandth of the first\n\
                 ** element with u_r = 0, because CalculiX finds no contact on faces that collapse onto the axis."
            )?,
            Section::PlaneStrain => writeln!(
                out,
                "** plane strain, 1 um thick: forces in uN are N/m of ridge, areas in um2 widths in um"
            )?,
        }
        writeln!(
            out,
            "** The tool is a row of elements whose nodes all move together: its force is the sum of RF2 over set TOOL.\n\
             ** Its travel includes the penetration: depth = travel - mean pressure / penalty ({:.3e} MPa/um, made for a\n\
             ** penetration of {:.2} % of the depth {:.4} um). Convergence in the load step is of first order in the ratio\n\
             ** of successive depths in CalculiX: more steps (numerics.steps) matter more than a finer mesh.",
            self.penalty,
            100.0 * self.penetration,
            self.depth
        )?;
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
                "** *PLASTIC holds {measure}, as the scene means it; its reader has a measure of its own."
            )?;
        }
        if self.reader == Reader::Abaqus {
            return Ok(());
        }
        writeln!(
            out,
            "** Abaqus: in the first step write *CONTACT PRINT ... with CFN, CAREA instead of CF and *ENERGY PRINT instead\n\
             ** of *EL PRINT ... ELSE; all else is common."
        )
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

    /// The metal, and a material for the tool, whose elements never strain.
    fn metal(&self, out: &mut impl Write) -> io::Result<()> {
        let elastic = format!("*ELASTIC\n{}, {}", number(self.elastic[0]), number(self.elastic[1]));
        writeln!(out, "*MATERIAL, NAME=METAL\n{elastic}")?;
        if let Some(table) = &self.table {
            writeln!(out, "** yield stress over plastic strain\n*PLASTIC")?;
            for [stress, strain] in &table.points {
                writeln!(out, "{}, {}", number(*stress), number(*strain))?;
            }
        }
        writeln!(out, "*MATERIAL, NAME=RIGID\n{elastic}")?;
        let thickness = match self.section {
            Section::Axisymmetric => "",
            Section::PlaneStrain => "1.\n",
        };
        write!(out, "*SOLID SECTION, ELSET=BODY, MATERIAL=METAL\n{thickness}")?;
        write!(out, "*SOLID SECTION, ELSET=TOOL, MATERIAL=RIGID\n{thickness}")
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
        writeln!(out, "TOOL, 1")
    }

    /// One step to `travel`; forces, contact and energy are printed at its end, fields kept at the peak and
    /// at the end.
    fn step(&self, out: &mut impl Write, index: usize, travel: f64) -> io::Result<()> {
        let kind = if index < self.loading { "loading" } else { "unloading" };
        writeln!(out, "** step {}, {kind} to a travel of {travel:.6} um", index + 1)?;
        writeln!(out, "*STEP, NLGEOM, INC=1000\n*STATIC\n1., 1., 1.E-6, 1.")?;
        writeln!(out, "*BOUNDARY\nTOOL, 2, 2, {}", number(-travel))?;
        if self.reader == Reader::Abaqus {
            return self.abaqus_output(out, index);
        }
        if index == 0 {
            writeln!(out, "*NODE PRINT, NSET=TOOL, TOTALS=YES, FREQUENCY=1000\nU, RF")?;
            writeln!(out, "*EL PRINT, ELSET=BODY, TOTALS=ONLY, FREQUENCY=1000\nELSE")?;
            writeln!(out, "*CONTACT PRINT, SLAVE=CONTACT, MASTER=TOOL, FREQUENCY=1000\nCF")?;
        }
        let fields = index + 1 == self.loading || index + 1 == self.travels.len();
        let frequency = if fields { 1000 } else { 0 };
        if fields || index == 0 || index == self.loading {
            writeln!(out, "*NODE FILE, FREQUENCY={frequency}\nU, RF")?;
            writeln!(out, "*EL FILE, FREQUENCY={frequency}\nS, PEEQ, ENER")?;
            writeln!(out, "*CONTACT FILE, FREQUENCY={frequency}\nCDIS, CSTR")?;
        }
        writeln!(out, "*END STEP")
    }

    /// The end of a step of Abaqus: requests of its first step hold for the later ones.
    fn abaqus_output(&self, out: &mut impl Write, index: usize) -> io::Result<()> {
        if index == 0 {
            writeln!(out, "*NODE PRINT, NSET=TOOL, TOTALS=YES, FREQUENCY=1000\nU, RF")?;
            writeln!(out, "*ENERGY PRINT, FREQUENCY=1000")?;
            writeln!(out, "*CONTACT PRINT, SLAVE=CONTACT, MASTER=TOOL, FREQUENCY=1000\nCFN, CAREA")?;
            writeln!(out, "*OUTPUT, FIELD, FREQUENCY=1000\n*NODE OUTPUT\nU, RF")?;
            writeln!(out, "*ELEMENT OUTPUT, ELSET=BODY\nS, PEEQ\n*CONTACT OUTPUT\nCSTRESS, CDISP")?;
            writeln!(out, "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=TOOL\nRF2, U2")?;
            writeln!(out, "*ENERGY OUTPUT\nALLSE, ALLPD, ALLWK")?;
        }
        writeln!(out, "*END STEP")
    }
}
