//! CPU seconds of the search of a half-space alone, without reading, gaps of other loads, stiffness and
//! files.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release -p asperity-verification --example half_space -- HEIGHTS.npy
//! PRESSURE TOLERANCE PRESSURES.npy`: heights in pixels, of one period; the nominal pressure over E*; the
//! relative error of the pressures in the norm of the energy at which the search ends. Prints the seconds,
//! the error that it proves and its convolutions; writes the pressures over E*. It is set beside other
//! programs by `verification/measure/rough-peer`.

// its caller reads what it prints
#![allow(clippy::print_stdout)]

use asperity_formats::surface::{Request, read, write_npy};
use asperity_roughness::half_space::HalfSpace;
use asperity_roughness::{HeightMap, Load, Surface};
use cpu_time::ProcessTime;
use std::error::Error;
use std::path::Path;

/// E*, Pa: pressures are shares of it.
const MODULUS: f64 = 1e9;
/// Distance of the nodes, in metres.
const PIXEL: f64 = 1e-6;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [file, pressure, tolerance, out] = words.as_slice() else {
        return Err("give the file of heights, the pressure, the tolerance and the file of pressures".into());
    };
    let read = read(Path::new(file), &Request::default())?;
    let heights = read.heights.iter().map(|z| z * PIXEL).collect();
    let map = HeightMap::new(read.columns, read.rows, [PIXEL; 2], heights)?.with_periodic(true);
    let surface = Surface::from_map(map)?;
    let body = HalfSpace { reduced_modulus: MODULUS, limit: None, tolerance: tolerance.parse()? };
    let load = Load::Pressure(pressure.parse::<f64>()? * MODULUS);
    let start = ProcessTime::now();
    let contact = body.press_without_stiffness(&surface, load, None)?;
    let seconds = start.elapsed().as_secs_f64();
    println!("{seconds} {} {}", contact.pressure_error, contact.convolutions);
    let pressures: Vec<f64> = contact.pressures.iter().map(|p| f64::from(*p) / MODULUS).collect();
    write_npy(Path::new(out), read.columns, read.rows, &pressures)?;
    Ok(())
}
