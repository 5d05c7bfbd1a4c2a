//! The command line.

use asperity_solver::scene::{Accuracy, AccuracyError};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Crush rough metal, from one conical asperity to a measured surface.
#[derive(Debug, Parser)]
#[command(name = "asperity", version, arg_required_else_help = true, after_help = EXAMPLES)]
pub struct Cli {
    /// What to do.
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
  asperity mesh single.toml --format inp           the whole scene as a deck for CalculiX and Abaqus
  asperity calibrate                               the representative strain from 480 cones
  asperity trade single.toml                       what accuracy costs on a scene, knob by knob
  asperity rough --table1                          three rough surfaces beside the paper's Table 1
  asperity schema > scene.schema.json              for editors that complete and check TOML
  asperity completions bash; asperity man crush    for shells and manuals

Exit status: 0 done; 1 the run could not finish (what was reached is on disk); 2 the input is wrong.";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Crush the asperities of a scene with a rigid tool and write curve, summary and fields
    Crush(Crush),
    /// Mesh a scene, print sizes and quality, and write it as .vtu, .msh or .inp
    Mesh(MeshCommand),
    /// Press a rigid plane on a rough surface and write table, load curve, maps
    Rough(crate::cli::rough::Rough),
    /// Crush cones of many slopes and metals and find the representative strain
    Calibrate(crate::cli::calibrate::Calibrate),
    /// Measure what accuracy costs on a scene: error against core seconds, knob by knob
    Trade(crate::cli::trade::Trade),
    /// Compute every figure and table of the paper and write a report that judges its claims
    Reproduce(crate::cli::reproduce::Reproduce),
    /// Write a commented scene to start from
    New(crate::cli::new::New),
    /// Print the JSON schema of a scene, a rough surface or a sweep, for editors
    Schema(crate::cli::schema::SchemaCommand),
    /// Print the completions of a shell
    Completions(crate::cli::manual::Completions),
    /// Print a page of the manual
    Man(crate::cli::manual::ManPage),
}

impl Command {
    /// Threads that were asked for.
    pub fn threads(&self) -> Option<u16> {
        match self {
            Command::Crush(args) => args.run.threads,
            Command::Mesh(_)
            | Command::New(_)
            | Command::Schema(_)
            | Command::Completions(_)
            | Command::Man(_) => None,
            Command::Rough(args) => args.run.threads,
            Command::Calibrate(args) => args.run.threads,
            Command::Trade(args) => args.run.threads,
            Command::Reproduce(args) => args.run.threads,
        }
    }
}

/// Arguments of `asperity crush`.
#[derive(Debug, Args)]
pub struct Crush {
    /// Scene file (TOML); `asperity new single` writes one
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Arguments of `asperity mesh`.
#[derive(Debug, Args)]
pub struct MeshCommand {
    /// Scene file (TOML)
    pub scene: PathBuf,
    /// File to write: .vtu (ParaView), .msh (Gmsh 4.1) or .inp (CalculiX, Abaqus) [default with --format: named after the scene]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format, where the extension of the file does not say
    #[arg(long, value_enum)]
    pub format: Option<MeshFormat>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// Formats of `asperity mesh`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MeshFormat {
    /// The mesh for ParaView
    Vtu,
    /// The mesh for Gmsh 4.1; a scene can read it
    Msh,
    /// The whole scene for CalculiX and Abaqus: mesh, metal, tool, contact, steps, output
    Inp,
}

impl MeshFormat {
    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            MeshFormat::Vtu => "vtu",
            MeshFormat::Msh => "msh",
            MeshFormat::Inp => "inp",
        }
    }
}

/// Flags that change what a file says.
#[derive(Debug, Args)]
pub struct SceneFlags {
    /// Error of the force: draft (5 %), standard (1 %), reference (0.2 %) or a percentage like 0.5%, from 0.2% to 5% [default: what the scene says, else standard]
    #[arg(long, value_name = "LEVEL", value_parser = parse_accuracy)]
    pub accuracy: Option<Accuracy>,
    /// Change a value of the file, for example --set "loading.depth=2 um"; repeatable
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
}

/// Flags of every command that fills a folder.
#[derive(Debug, Args)]
pub struct RunFlags {
    /// Folder for the results [default: in out/, named after the scene or the command]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads to use [default: all cores]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Write into a folder that holds other files: they stay, but for those named like a result
    #[arg(long)]
    pub force: bool,
    /// Print the summary as JSON on stdout
    #[arg(long)]
    pub json: bool,
}

/// An accuracy within the range that can be asked for.
///
/// # Errors
/// What is wrong with it.
pub fn parse_accuracy(text: &str) -> Result<Accuracy, String> {
    let accuracy: Accuracy = text.parse().map_err(|e: AccuracyError| e.to_string())?;
    accuracy.check().map_err(|e| e.message)?;
    Ok(accuracy)
}
