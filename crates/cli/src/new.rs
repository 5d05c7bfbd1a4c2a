//! `asperity new`: a commented scene to start from.

use crate::terminal;
use asperity::error::{Error, InputError};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `asperity new`.
#[derive(Debug, Args)]
pub struct New {
    /// Kind of scene
    #[arg(value_enum)]
    pub kind: Start,
    /// File to write [default: KIND.toml]
    pub file: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}

/// Scenes to start from.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Start {
    /// the paper's asperity under a plane
    Single,
    /// three asperities under a plane
    Multi,
    /// a flat body under a cone
    Cone,
    /// a flat body under a ball
    Ball,
    /// three ridges of constant section under a plane
    PlaneStrain,
    /// a rough surface made from random numbers, under a plane
    Rough,
    /// a measured surface under a plane
    Surface,
    /// cones of some slopes and metals
    Sweep,
    /// a scene over some of its keys
    Study,
    /// a metal from measured curves
    Fit,
}

impl Start {
    /// Name, scene and command.
    fn scene(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Start::Single => ("single", asperity::scenes::SINGLE_ASPERITY, "crush"),
            Start::Multi => ("multi", asperity::scenes::THREE_IDENTICAL, "crush"),
            Start::Cone => ("cone", asperity::scenes::CONE_INDENTATION, "crush"),
            Start::Ball => ("ball", asperity::scenes::BALL, "crush"),
            Start::PlaneStrain => ("plane-strain", asperity::scenes::THREE_IDENTICAL_PLANE_STRAIN, "crush"),
            Start::Surface => ("surface", asperity::scenes::SURFACE, "rough"),
            Start::Sweep => ("sweep", asperity::scenes::SWEEP, "calibrate"),
            Start::Study => ("study", asperity::scenes::STUDY, "study"),
            Start::Rough => ("rough", asperity::scenes::ROUGH_MILLED, "rough"),
            Start::Fit => ("fit", asperity::scenes::FIT, "identify"),
        }
    }
}

/// Writes the scene and says how to run it.
///
/// # Errors
/// A file that exists, or that cannot be written.
pub fn new(args: &New) -> Result<(), Error> {
    let (name, text, command) = args.kind.scene();
    let path = args.file.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let mut options = std::fs::OpenOptions::new();
    options.write(true).create(true).truncate(true).create_new(!args.force);
    let error = |e: std::io::Error| {
        if e.kind() == std::io::ErrorKind::AlreadyExists {
            return InputError::new(format!("{} exists already", path.display())).help(format!(
                "FILE is the scene to write: give another name, asperity new {name} FILE, or --force to replace it"
            ));
        }
        InputError::new(format!("cannot write {}: {e}", path.display()))
            .help("give a file in a folder that exists and that you may write to")
    };
    options.open(&path).and_then(|mut file| file.write_all(text.as_bytes())).map_err(error)?;
    terminal::say(&format!(
        "written   {}; run it with: asperity {command} {}",
        path.display(),
        path.display()
    ))?;
    Ok(())
}
