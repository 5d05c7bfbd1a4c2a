//! Damaged files: every reader answers with a map or an error, never with a panic, an endless loop or a map
//! larger than its file.
//!
//! PROPTEST_CASES sets how many files are damaged (64 unless told), ASPERITY_FUZZ_SECONDS goes on with others
//! for at least so much CPU time of each reader, and ASPERITY_SURFACES names a folder of instruments' files
//! that are damaged too.

use super::*;
use std::time::Duration;

/// Valid files of one kind: those made here, and those of the folder named by the environment.
fn samples(extension: &str) -> Vec<(String, Vec<u8>)> {
    let holes = [0.0, 1.0, NAN, 3.0, 4.0, 5.0];
    let made: Vec<Vec<u8>> = match extension {
        "npy" => ["<f4", ">f8", "|u1", "<f2"].map(|d| npy(d, "True", "(2, 3)", &[0; 48])).into(),
        "sur" => vec![sur(16, &[10, 11, 12, 13, 8, 15]), sur(32, &[10, 11, 12, 13, 8, 15]), packed_sur()],
        "al3d" => vec![al3d()],
        "sdf" => vec![sdf_binary(), SDF.into(), SDF.replace("BAD", "1e999").into()],
        "x3p" => vec![x3p_of(&holes)],
        "gwy" => vec![
            include_bytes!("data/gwyfile.gwy").into(),
            include_bytes!("data/gwyfile-two-channels.gwy").into(),
        ],
        "gsf" => vec![include_bytes!("data/gsffile.gsf").into()],
        _ => ["0 0 1\n1 0 2\n0 1 3\n1 1 4\n", "1,2,3\n4,,6\n", "x;y;z\n0;0;1,5\n1;0;2\n0;1;3\n1;1;4\n"]
            .map(|t| t.into())
            .into(),
    };
    let names = |i: usize| {
        format!("made-{i}.{}", if extension == "text" { ["xyz", "csv", "txt"][i % 3] } else { extension })
    };
    let mut all: Vec<_> = made.into_iter().enumerate().map(|(i, content)| (names(i), content)).collect();
    let folder = std::env::var_os("ASPERITY_SURFACES").and_then(|folder| std::fs::read_dir(folder).ok());
    for entry in folder.into_iter().flatten().flatten() {
        let path = entry.path();
        if path.extension().is_some_and(|e| e == extension) {
            all.push((
                path.file_name().unwrap().to_string_lossy().into_owned(),
                std::fs::read(&path).unwrap(),
            ));
        }
    }
    all
}

/// One damage to a file.
#[derive(Clone, Debug)]
enum Damage {
    /// Another byte, near the beginning where the headers are or anywhere.
    Byte { near: bool, at: prop::sample::Index, byte: u8 },
    /// Bytes that are large, negative or no number.
    Word { near: bool, at: prop::sample::Index, word: [u8; 4] },
    /// The file ends early.
    Cut(prop::sample::Index),
    /// A part of the file again, somewhere else.
    Copy { from: prop::sample::Index, to: prop::sample::Index, length: usize },
}

fn damage() -> impl Strategy<Value = Damage> {
    use prop::sample::Index;
    let words = prop::sample::select(vec![
        *b"\xff\xff\xff\xff",
        *b"\0\0\0\x80",
        *b"\xff\xff\xff\x7f",
        *b"9999",
        *b"-1e9",
        *b"\0\0\0\0",
        *b"nan ",
    ]);
    prop_oneof![
        4 => (any::<bool>(), any::<Index>(), any::<u8>()).prop_map(|(near, at, byte)| Damage::Byte { near, at, byte }),
        3 => (any::<bool>(), any::<Index>(), words).prop_map(|(near, at, word)| Damage::Word { near, at, word }),
        1 => any::<Index>().prop_map(Damage::Cut),
        1 => (any::<Index>(), any::<Index>(), 1usize..64).prop_map(|(from, to, length)| Damage::Copy { from, to, length }),
    ]
}

impl Damage {
    fn harm(&self, content: &mut Vec<u8>) {
        let place = |near: bool, at: &prop::sample::Index, length: usize| {
            at.index(if near { length.min(600) } else { length })
        };
        let length = content.len();
        if length == 0 {
            return;
        }
        match self {
            Damage::Byte { near, at, byte } => content[place(*near, at, length)] = *byte,
            Damage::Word { near, at, word } => {
                let at = place(*near, at, length);
                content.iter_mut().skip(at).zip(word).for_each(|(byte, other)| *byte = *other);
            }
            Damage::Cut(at) => content.truncate(at.index(length)),
            Damage::Copy { from, to, length: part } => {
                let from = from.index(length);
                let part = content[from..(from + part).min(length)].to_vec();
                let to = to.index(length);
                content.splice(to..to, part);
            }
        }
    }
}

/// Deflate packs at most 1032 to 1; an entry of one byte is at most eight bytes of heights.
const LARGEST: usize = 1032 * 8;

fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(64)
}

/// The least time for which each reader is tried.
fn duration() -> Duration {
    let told = std::env::var("ASPERITY_FUZZ_SECONDS").ok().and_then(|n| n.parse().ok());
    Duration::from_secs(told.unwrap_or(0))
}

/// CPU time of this thread, from the kernel's account of it (clock ticks of 10 ms); none where there is no
/// such account.
fn thread_time() -> Option<Duration> {
    let account = std::fs::read_to_string("/proc/thread-self/stat").ok()?;
    // the name, in brackets, may hold blanks; user and system time are the 12th and 13th fields after it
    let fields: Vec<&str> = account.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |i: usize| fields.get(i)?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks(11)? + ticks(12)?)))
}

fn survives(extension: &str) {
    let samples = samples(extension);
    let folder = Folder::new();
    let clock = std::time::Instant::now();
    let start = thread_time();
    let spent = || thread_time().zip(start).map_or_else(|| clock.elapsed(), |(now, start)| now - start);
    let (mut files, mut maps) = (0, 0);
    loop {
        let (answered, read) = survives_once(&samples, &folder);
        (files, maps) = (files + answered, maps + read);
        if spent() >= duration() {
            break;
        }
    }
    println!("{extension}: {files} files in {:.0} s of CPU, {maps} still maps", spent().as_secs_f64());
    assert!(files > 0);
}

/// A round of damaged files, with seeds of its own; how many there were, and of how many a map was read.
fn survives_once(samples: &[(String, Vec<u8>)], folder: &Folder) -> (usize, usize) {
    let config = ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) };
    let input = (any::<prop::sample::Index>(), prop::collection::vec(damage(), 0..8));
    let counts = std::cell::Cell::new((0, 0));
    let result = prop::test_runner::TestRunner::new(config).run(&input, |(which, damages)| {
        let (name, content) = &samples[which.index(samples.len())];
        let mut content = content.clone();
        damages.iter().for_each(|d| d.harm(&mut content));
        let answer = read_plain(&folder.file(name, &content));
        let (files, maps) = counts.get();
        counts.set((files + 1, maps + usize::from(answer.is_ok())));
        if let Ok(found) = answer {
            prop_assert_eq!(found.heights.len(), found.columns * found.rows);
            prop_assert!(found.heights.len() <= LARGEST * content.len().max(8));
        }
        Ok(())
    });
    result.unwrap();
    counts.get()
}

#[test]
fn damaged_npy_is_answered() {
    survives("npy");
}

#[test]
fn damaged_sur_is_answered() {
    survives("sur");
}

#[test]
fn damaged_al3d_is_answered() {
    survives("al3d");
}

#[test]
fn damaged_sdf_is_answered() {
    survives("sdf");
}

#[test]
fn damaged_x3p_is_answered() {
    survives("x3p");
}

#[test]
fn damaged_gwy_is_answered() {
    survives("gwy");
}

#[test]
fn damaged_gsf_is_answered() {
    survives("gsf");
}

#[test]
fn damaged_text_is_answered() {
    survives("text");
}

/// Noise follows the magic of a format.
#[test]
fn noise_after_a_known_beginning_is_answered() {
    let folder = Folder::new();
    let config = ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(cases()) };
    let kinds = ["npy", "sur", "al3d", "sdf", "x3p", "gwy", "gsf", "text"];
    let input = (0..kinds.len(), prop::collection::vec(any::<u8>(), 0..700));
    prop::test_runner::TestRunner::new(config)
        .run(&input, |(kind, noise)| {
            let (name, mut content) = samples(kinds[kind]).swap_remove(0);
            content.truncate(8.min(content.len()));
            content.extend(noise);
            let _ = read_plain(&folder.file(&name, &content));
            Ok(())
        })
        .unwrap();
}
