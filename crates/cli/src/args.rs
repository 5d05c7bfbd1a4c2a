//! The command line: the commands and what help says of them.

use super::{
    calibrate, crush, extract, identify, joint, manual, mesh, new, reference, reproduce, rough, scales,
    schema, study, trade,
};
use clap::{Parser, Subcommand};

/// Crush rough metal, from one conical asperity to a measured surface.
#[derive(Debug, Parser)]
#[command(name = "asperity", version, arg_required_else_help = true, after_help = EXAMPLES)]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "Examples:
  asperity reproduce --accuracy draft              the whole paper, into out/reproduce/report/index.html
  asperity reproduce --only fig6,table1            a part of it; --list names the parts
  asperity new single                              a commented scene, single.toml, to start from
  asperity crush single.toml                       curve, summary, fields, pictures, in out/single
  asperity crush single.toml --accuracy draft --set material.hardening_exponent=0.1
  asperity crush single.toml --set \"loading.depth=2 um\" --out out/shallow --json
  asperity mesh single.toml -o asperity.msh        for Gmsh; .vtu for ParaView
  asperity mesh single.toml --format abaqus        the whole scene as a deck for Abaqus; inp: for CalculiX
  asperity calibrate                               the representative strain from 480 cones
  asperity study single.toml --vary material.hardening_exponent=0,0.1,0.2 --vary \"loading.depth=1 um..5 um/5\"
  asperity new fit; asperity identify fit.toml     from measured curves to the metal
  asperity trade single.toml                       what accuracy costs on a scene, knob by knob
  asperity rough --table1                          three rough surfaces beside the paper's Table 1
  asperity joint surface.sur                       pressure over gap, stiffness, conductance, for other programs
  asperity scales surface.sur                      which waves matter: slope, area, pressure, gap, leak by scale, with verdicts
  asperity extract surface.sur --crush 20          asperities of a map, and the closures beside finite elements
  asperity schema > scene.schema.json              for editors that complete and check TOML
  asperity completions bash; asperity man crush    for shells and manuals

Exit status: 0 done; 1 the run could not finish (what was reached is on disk); 2 the input is wrong.";

const CRUSH: &str = "Examples:
  asperity crush single.toml                                   into out/single
  asperity crush single.toml --accuracy draft --out out/quick  5 % instead of 1 %
  asperity crush single.toml --set material.hardening_exponent=0.1 --out out/soft
  asperity crush single.toml --set \"loading.depth=2 um\" --out out/shallow --json";

const MESH: &str = "Examples:
  asperity mesh single.toml -o single.vtu          for ParaView
  asperity mesh single.toml -o single.msh          for Gmsh; a scene reads it with [mesh]
  asperity mesh single.toml --format abaqus        the whole scene for Abaqus
  asperity mesh single.toml --format inp           the whole scene for CalculiX";

const ROUGH: &str = "Examples:
  asperity new rough && asperity rough rough.toml
  asperity rough rough.toml --set closure=half-space --set \"load.pressure=100 MPa\" --out out/half-space
  asperity rough --table1                          the surfaces of the paper beside its Table 1";

const JOINT: &str = "Examples:
  asperity joint surface.sur --set \"load.pressure=50 MPa\"     into out/surface: joint.csv, calculix.inp, abaqus.inp, moose.csv
  asperity joint one.sur two.sur three.sur --like steel.toml    their mean and spread, not two faces of a joint
  asperity joint scene.toml --set 'thermal.conductivity=[\"50 W/(m K)\", \"50 W/(m K)\"]' --report";

const SCALES: &str = "Examples:
  asperity scales surface.sur --like steel.toml        into out/surface: scales.csv, slopes.csv, spectrum.csv, summary.json
  asperity scales one.sur again.sur --report           the second measurement tells the noise of the first
  asperity scales surface.sur --set \"scales.tip_radius=2 um\" --set \"load.pressure=50 MPa\"";

const CALIBRATE: &str = "Examples:
  asperity calibrate                               480 cones, into out/calibrate
  asperity calibrate sweep.toml --accuracy reference
  asperity calibrate sweep.toml --shard 2/8 --out part-2
  asperity calibrate merge part-1 part-2 --out all";

const STUDY: &str = "Examples:
  asperity study single.toml --vary material.hardening_exponent=0,0.1,0.2 --vary \"loading.depth=1 um..5 um/5\"
  asperity study single.toml --vary \"loading.depth=1 um..5 um\" --vary material.hardening_exponent=0..0.5 --sample lhs 100
  asperity study study.toml --shard 2/8 --out part-2
  asperity study merge part-1 part-2 --out all";

const TRADE: &str = "Examples:
  asperity trade single.toml                       every number of the discretisation around every level
  asperity trade single.toml --combinations 0      no settings that differ in everything";

const REPRODUCE: &str = "Examples:
  asperity reproduce --accuracy draft              the whole paper, into out/reproduce/report/index.html
  asperity reproduce --only fig6,table1            a part of it
  asperity reproduce --list                        the names of the parts";

const NEW: &str = "Examples:
  asperity new single                              single.toml
  asperity new surface                             for a map that you measured
  asperity new rough surface.toml                  under another name";

const SCHEMA: &str = "Example:
  asperity schema scene > scene.schema.json";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Crush the asperities of a scene with a rigid tool and write curve, summary and fields
    #[command(after_help = CRUSH)]
    Crush(crush::Crush),
    /// Mesh a scene, print sizes and quality, and write it as .vtu, .msh or .inp
    #[command(after_help = MESH)]
    Mesh(mesh::MeshCommand),
    /// Press a rigid plane on a rough surface and write table, load curve, maps
    #[command(after_help = ROUGH)]
    Rough(rough::Rough),
    /// Press a surface from first touch to its largest load and write its law (pressure, gap, stiffness, conductance, leak) for CalculiX, Abaqus, MOOSE
    #[command(after_help = JOINT)]
    Joint(joint::Joint),
    /// Press a surface with ever finer waves let in and say of each answer whether it has stopped changing
    #[command(after_help = SCALES)]
    Scales(scales::Scales),
    /// Find the asperities of a measured map, write profiles and scenes of them, crush some beside the closures
    Extract(extract::Extract),
    /// Crush cones of many slopes and metals and find the representative strain
    #[command(after_help = CALIBRATE)]
    Calibrate(calibrate::Calibrate),
    /// Run a scene over any of its keys: grids, lists, Latin hypercubes, in one go, in parts, and on after a stop
    #[command(after_help = STUDY)]
    Study(study::Study),
    /// Find the metal from measured force-depth curves: E, yield stress, hardening, with intervals and a verdict
    Identify(identify::Identify),
    /// Measure what accuracy costs on a scene: error against core seconds, knob by knob
    #[command(after_help = TRADE)]
    Trade(trade::Trade),
    /// Compute every figure and table of the paper and write a report that judges its claims
    #[command(after_help = REPRODUCE)]
    Reproduce(reproduce::Reproduce),
    /// Write a commented scene to start from
    #[command(after_help = NEW)]
    New(new::New),
    /// Print the JSON schema of an input file (scene, rough surface, sweep, study, fit), for editors
    #[command(after_help = SCHEMA)]
    Schema(schema::SchemaCommand),
    /// Print the completions of a shell
    Completions(manual::Completions),
    /// Print a page of the manual
    Man(manual::ManPage),
    /// Write the pages of the book that list commands, keys, columns and units
    #[command(hide = true)]
    Reference(reference::Reference),
}

impl Command {
    /// Threads that were asked for.
    pub fn threads(&self) -> Option<u16> {
        match self {
            Command::Crush(args) => args.run.threads,
            Command::Rough(args) => args.run.threads,
            Command::Joint(args) => args.run.threads,
            Command::Scales(args) => args.run.threads,
            Command::Extract(args) => args.run.threads,
            Command::Calibrate(args) => args.run.threads,
            Command::Study(args) => args.run.threads,
            Command::Identify(args) => args.run.threads,
            Command::Trade(args) => args.run.threads,
            Command::Reproduce(args) => args.run.threads,
            _ => None,
        }
    }
}
