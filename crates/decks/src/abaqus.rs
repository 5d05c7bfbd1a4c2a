//! The parts of a deck that Abaqus has in a way of its own: a rigid tool with a reference node, and a step
//! for each direction, in which an amplitude moves it.

use super::deck::Deck;
use super::write::number;
use asperity_mesh::Section;
use std::io::{self, Write};

/// Pairs of time and value in a line of an amplitude.
const PAIRS: usize = 4;

impl Deck {
    /// The tool: rigid links along its outline, the surface `TOOL` on their lower side, and the node `REF`
    /// that carries them.
    pub(super) fn rigid_tool(&self, out: &mut impl Write) -> io::Result<()> {
        let (nodes, cells) = (self.mesh.nodes.len(), self.mesh.cell_count());
        let count = self.outline.len();
        writeln!(out, "*NODE")?;
        for (i, [x, z]) in self.outline.iter().enumerate() {
            writeln!(out, "{}, {}, {}", nodes + i + 1, number(*x), number(*z))?;
        }
        let high = self.outline.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[1])) + self.depth;
        writeln!(out, "*NODE, NSET=REF\n{}, 0., {}", nodes + count + 1, number(high))?;
        let element = match self.section {
            Section::Axisymmetric => "RAX2",
            Section::PlaneStrain => "R2D2",
        };
        writeln!(out, "*ELEMENT, TYPE={element}, ELSET=TOOL")?;
        // the positive side of a link lies to the left of its way: from right to left it faces down
        for i in 0..count - 1 {
            writeln!(out, "{}, {}, {}", cells + i + 1, nodes + i + 2, nodes + i + 1)?;
        }
        writeln!(out, "*RIGID BODY, REF NODE=REF, ELSET=TOOL")?;
        writeln!(out, "*SURFACE, NAME=TOOL, TYPE=ELEMENT\nTOOL, SPOS")
    }

    /// A step for each phase; `REF` moves along the travels, one to each unit of time.
    pub(super) fn abaqus_steps(&self, out: &mut impl Write) -> io::Result<()> {
        let mut from = 0.0;
        // the way of the whole scene is that of its first phase
        let whole = self.phases[0].travels.iter().fold(0.0f64, |most, travel| most.max(travel.abs()));
        for phase in &self.phases {
            let (name, count) = (&phase.name, phase.travels.len());
            writeln!(out, "*AMPLITUDE, NAME={name}")?;
            let pairs: Vec<String> = std::iter::once(from)
                .chain(phase.travels.iter().copied())
                .enumerate()
                .map(|(time, travel)| format!("{time}., {}", number(travel / whole)))
                .collect();
            for line in pairs.chunks(PAIRS) {
                writeln!(out, "{}", line.join(", "))?;
            }
            writeln!(out, "*TIME POINTS, NAME={name}, GENERATE\n0., {count}., 1.")?;
            from = phase.travels[count - 1];
        }
        for phase in &self.phases {
            self.abaqus_step(out, &phase.name, phase.travels.len(), whole)?;
        }
        Ok(())
    }

    fn abaqus_step(&self, out: &mut impl Write, name: &str, count: usize, whole: f64) -> io::Result<()> {
        writeln!(out, "*STEP, NAME={name}, NLGEOM=YES, INC=10000")?;
        writeln!(out, "*STATIC\n1., {count}., 1.E-6, 1.")?;
        writeln!(out, "*BOUNDARY, AMPLITUDE={name}\nREF, 2, 2, {}", number(-whole))?;
        writeln!(out, "*OUTPUT, FIELD, FREQUENCY=10000\n*NODE OUTPUT\nU, RF")?;
        writeln!(out, "*ELEMENT OUTPUT, ELSET=BODY\nS, PEEQ\n*CONTACT OUTPUT\nCSTRESS, CDISP")?;
        writeln!(out, "*OUTPUT, HISTORY, TIME POINTS={name}\n*NODE OUTPUT, NSET=REF\nU2, RF2")?;
        writeln!(out, "*CONTACT OUTPUT, MASTER=TOOL, SLAVE=CONTACT\nCFN, CAREA")?;
        writeln!(out, "*ENERGY OUTPUT\nALLSE, ALLPD, ALLWK")?;
        writeln!(out, "*END STEP")
    }
}
