//! Seconds to read a text map, beside a plain loop on one thread: read the file, split it, parse each number.
//!
//! `cargo run --release -p asperity-formats --example text_map_speed [SIDE]`

use asperity_formats::surface::{Request, read};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

fn plain(path: &Path) -> std::io::Result<f64> {
    let text = std::fs::read_to_string(path)?;
    let numbers: Vec<f64> =
        text.lines().flat_map(|line| line.split(',')).filter_map(|word| word.parse().ok()).collect();
    Ok(numbers.iter().sum())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let side: usize = std::env::args().nth(1).map_or(Ok(4096), |side| side.parse())?;
    let path = std::env::temp_dir().join(format!("text-map-speed-{}.csv", std::process::id()));
    let mut text = String::new();
    for j in 0..side {
        for i in 0..side {
            let height = ((i * 7 + j * 13) % 10_007) as f64 / 1e4 - 0.5;
            write!(text, "{}{height:.5}", if i > 0 { "," } else { "" })?;
        }
        text.push('\n');
    }
    std::fs::write(&path, &text)?;
    drop(text);
    for _ in 0..5 {
        let start = Instant::now();
        let sum = plain(&path)?;
        let plainly = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let map = read(&path, &Request::default())?;
        let read = start.elapsed().as_secs_f64();
        assert!((map.heights.iter().sum::<f64>() - sum).abs() <= 1e-6 * sum.abs());
        writeln!(
            std::io::stdout(),
            "{side}²: plain loop {plainly:.2} s, reader {read:.2} s, ratio {:.2}",
            read / plainly
        )?;
    }
    std::fs::remove_file(&path)?;
    Ok(())
}
