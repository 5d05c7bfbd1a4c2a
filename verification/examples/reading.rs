//! Time and memory of reading a map of heights, beside the least that a program has to do: one pass over the
//! bytes of the file into numbers, on one thread.
//!
//! `cargo run --release -p asperity-verification --example reading -- [SIDE] [--out FILE]`: maps of SIDE²
//! points as text and of (2 SIDE)² as binary files (4096 unless told; 1.5 GB of files in the folder for
//! temporary files). Each time is the least of three. The peak of memory is that of a process of its own,
//! less what one has that reads a map of four points; Linux tells it, elsewhere the column is empty. The
//! table is `verification/results/reading.md`.

// files of its own making, on a disk that has room
#![allow(clippy::expect_used, clippy::print_stdout)]

use asperity_formats::surface::{Request, read, write_npy};
use asperity_verification::report::{Report, timed};
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Times that a file is read.
const TRIES: usize = 3;

/// A height of the map, µm: a wave and some digits.
fn height(column: usize, row: usize) -> f64 {
    let (x, y) = (column as f64, row as f64);
    (0.37 * x).sin() * (0.011 * y).cos() + 1e-4 * ((column * 7919 + row * 104_729) % 1000) as f64
}

/// A way to write a map.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Text,
    Npy64,
    Npy32,
    Gsf,
    Sur,
}

impl Kind {
    const ALL: [Kind; 5] = [Kind::Text, Kind::Npy64, Kind::Npy32, Kind::Gsf, Kind::Sur];

    fn name(self) -> &'static str {
        match self {
            Kind::Text => "text, tabs between six digits",
            Kind::Npy64 => "npy of 64-bit floats",
            Kind::Npy32 => "npy of 32-bit floats",
            Kind::Gsf => "gsf, 32-bit floats",
            Kind::Sur => "sur, 32-bit whole numbers",
        }
    }

    /// Bytes of a number in the file; 0 of text.
    fn size(self) -> usize {
        match self {
            Kind::Text => 0,
            Kind::Npy64 => 8,
            Kind::Npy32 | Kind::Gsf | Kind::Sur => 4,
        }
    }

    fn write(self, file: &Path, side: usize) -> std::io::Result<()> {
        let points = || (0..side).flat_map(move |row| (0..side).map(move |column| height(column, row)));
        if self == Kind::Npy64 {
            return write_npy(file, side, side, &points().collect::<Vec<f64>>());
        }
        let mut out = BufWriter::new(File::create(file)?);
        match self {
            Kind::Text => {
                for row in 0..side {
                    let words: Vec<String> =
                        (0..side).map(|column| format!("{:.5}", height(column, row))).collect();
                    writeln!(out, "{}", words.join("\t"))?;
                }
            }
            Kind::Npy64 => {}
            Kind::Npy32 => {
                let dictionary =
                    format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({side}, {side}), }}");
                // magic, version and length of what follows make ten bytes; all together a multiple of 64
                let head = format!("{dictionary:117}\n");
                out.write_all(b"\x93NUMPY\x01\x00")?;
                out.write_all(&(head.len() as u16).to_le_bytes())?;
                out.write_all(head.as_bytes())?;
                points().try_for_each(|z| out.write_all(&(z as f32).to_le_bytes()))?;
            }
            Kind::Gsf => {
                let head = format!(
                    "Gwyddion Simple Field 1.0\nXRes = {side}\nYRes = {side}\nXReal = 1e-3\nYReal = 1e-3\nXYUnits = m\nZUnits = m\n"
                );
                out.write_all(head.as_bytes())?;
                out.write_all(&[0; 4][..4 - head.len() % 4])?;
                points().try_for_each(|z| out.write_all(&(1e-6 * z as f32).to_le_bytes()))?;
            }
            Kind::Sur => {
                let mut head = [0_u8; 512];
                let mut put =
                    |place: usize, bytes: &[u8]| head[place..place + bytes.len()].copy_from_slice(bytes);
                put(0, b"DIGITAL SURF");
                put(18, &2_i16.to_le_bytes());
                put(86, &1_i16.to_le_bytes());
                put(98, &32_u16.to_le_bytes());
                put(108, &(side as i32).to_le_bytes());
                put(112, &(side as i32).to_le_bytes());
                put(120, &1e-3_f32.to_le_bytes());
                put(124, &1e-3_f32.to_le_bytes());
                put(128, &1e-3_f32.to_le_bytes());
                put(180, b"mm");
                put(196, b"um");
                put(212, b"nm");
                out.write_all(&head)?;
                points().try_for_each(|z| out.write_all(&((1e4 * z) as i32).to_le_bytes()))?;
            }
        }
        out.flush()
    }

    /// The least work: the file as numbers.
    fn benchmark(self, file: &Path) -> std::io::Result<Vec<f64>> {
        let data = std::fs::read(file)?;
        let body = &data[data.len() % 8..];
        Ok(match self {
            Kind::Text => String::from_utf8_lossy(&data)
                .lines()
                .flat_map(|line| line.split('\t'))
                .filter_map(|word| word.parse().ok())
                .collect(),
            Kind::Npy64 => body.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect(),
            Kind::Npy32 | Kind::Gsf => {
                body.as_chunks().0.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes))).collect()
            }
            Kind::Sur => {
                body.as_chunks().0.iter().map(|bytes| f64::from(i32::from_le_bytes(*bytes))).collect()
            }
        })
    }
}

/// Bytes of memory that this process has had at most, where the system tells it.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(1024 * line.split_whitespace().nth(1)?.parse::<u64>().ok()?)
}

/// Peak of memory of a process that reads `file` and nothing else.
fn peak_of_reading(file: &Path) -> Option<u64> {
    let own = std::env::current_exe().ok()?;
    let done = std::process::Command::new(own).args([Path::new("--read"), file]).output().ok()?;
    String::from_utf8(done.stdout).ok()?.trim().parse().ok()
}

fn least(mut work: impl FnMut()) -> f64 {
    (0..TRIES).map(|_| timed(&mut work).1).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    if words.next().as_deref() == Some("--read") {
        let file = words.next().ok_or("no file")?;
        let map = read(Path::new(&file), &Request::default())?;
        println!("{}", peak().map_or(String::new(), |bytes| bytes.to_string()));
        drop(map);
        return Ok(());
    }
    let (mut report, words) = Report::of_example("reading", "one thread");
    let side: usize = words.first().map_or(Ok(4096), |word| word.parse())?;
    report.table("| file | points | read, s | benchmark, s | ratio | peak of memory over the heights in the file's own numbers |");
    let folder = std::env::temp_dir().join(format!("asperity-reading-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let outcome = Kind::ALL.into_iter().try_for_each(|kind| -> Result<(), Box<dyn Error>> {
        let file = folder.join(if kind == Kind::Text { "map.txt" } else { "map.bin" });
        kind.write(&file, 2)?;
        let alone = peak_of_reading(&file);
        let side = if kind == Kind::Text { side } else { 2 * side };
        kind.write(&file, side)?;
        let ours = least(|| {
            drop(pool.install(|| read(&file, &Request::default())).expect("a map of its own making"))
        });
        let benchmark = least(|| drop(kind.benchmark(&file).expect("a file that is there")));
        let number = if kind == Kind::Text { 8 } else { kind.size() };
        let peak = peak_of_reading(&file).zip(alone).map_or(String::new(), |(peak, alone)| {
            format!("{:.2}", peak.saturating_sub(alone) as f64 / (number * side * side) as f64)
        });
        report.line(&format!(
            "| {} | {side}² | {ours:.2} | {benchmark:.2} | {:.2} | {peak} |",
            kind.name(),
            ours / benchmark
        ));
        Ok(())
    });
    std::fs::remove_dir_all(&folder)?;
    outcome?;
    report.finish()?;
    Ok(())
}
