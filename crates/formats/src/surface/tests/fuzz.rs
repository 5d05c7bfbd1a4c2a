//! Damaged files: every reader answers with a map or an error, never with a panic, an endless loop or a map
//! larger than its file.
//!
//! Each reader is given 20 000 files that the same seeds damage in every run (ASPERITY_FUZZ_FILES for
//! another number). ASPERITY_FUZZ_SECONDS goes on with further seeds for at least so much CPU time of each
//! reader, and ASPERITY_SURFACES names a folder of instruments' files that are damaged too.

use super::*;
use std::io::{Cursor, Write};
use std::time::Duration;

/// Numbers of a seed (splitmix64, Steele, Lea, Flood 2014).
struct Seeded(u64);

impl Seeded {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`, which is not 0.
    fn number_below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }
}

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
        "bcr" => ["bcrstm", "bcrf", "bcrf_unicode"].map(|kind| scanning::bcr(kind, false, "")).into(),
        "nid" => vec![scanning::nid(16, "m"), scanning::nid(32, "m")],
        "gsf" => vec![include_bytes!("data/gsffile.gsf").into()],
        "txt" => [
            "0 0 1\n1 0 2\n0 1 3\n1 1 4\n",
            "1,2,3\n4,,6\n",
            "x;y;z\n0;0;1,5\n1;0;2\n0;1;3\n1;1;4\n",
            "nx 3\nNODATA_value -9999\ny\\x (um),0,1,2\n0,1,2,3\n1,4,-9999,6\n2,7,1,9\n",
            "DSAA\n3 2\n0 4\n1 2\n1 6\n1 2 3\n4 1.70141e+038 6\n",
            &titled::zygo("1e-6", ""),
            &titled::wyko(0, "Aspect\t7\t4\t0.8\n"),
        ]
        .map(|t| t.into())
        .into(),
        _ => Vec::new(),
    };
    let mut all: Vec<_> =
        made.into_iter().enumerate().map(|(i, content)| (format!("made-{i}.{extension}"), content)).collect();
    let is_kind = |name: &str| name.rsplit('.').next() == Some(extension);
    let files = instruments::FILES.iter().filter(|file| is_kind(file.0.0));
    all.extend(files.map(|((name, content), ..)| ((*name).to_string(), content.to_vec())));
    let folder = std::env::var_os("ASPERITY_SURFACES").and_then(|folder| std::fs::read_dir(folder).ok());
    for entry in folder.into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if is_kind(&name) {
            all.push((name, std::fs::read(entry.path()).unwrap()));
        }
    }
    all
}

/// Bytes that are large, negative or no number.
const WORDS: [&[u8]; 9] = [
    b"\xff\xff\xff\xff",
    b"\0\0\0\x80",
    b"\xff\xff\xff\x7f",
    b"9999",
    b"-1e9",
    b"\0\0\0\0",
    b"nan ",
    b"\0\0\0\0\0\0\xf8\x7f",
    b",;\t\"",
];

/// Does one damage: another bit or byte or word, near the beginning where headers are or anywhere; an early
/// end; a part again somewhere else.
fn harm(content: &mut Vec<u8>, seed: &mut Seeded) {
    let length = content.len();
    if length == 0 {
        return;
    }
    let near = if seed.number_below(2) == 0 { length.min(600) } else { length };
    let at = seed.number_below(near);
    match seed.number_below(10) {
        0..3 => content[at] ^= 1 << seed.number_below(8),
        3..6 => content[at] = seed.next() as u8,
        6..8 => {
            let word = WORDS[seed.number_below(WORDS.len())];
            content.iter_mut().skip(at).zip(word).for_each(|(byte, other)| *byte = *other);
        }
        8 => content.truncate(at),
        _ => {
            let from = seed.number_below(length);
            let part = content[from..(from + 1 + seed.number_below(64)).min(length)].to_vec();
            content.splice(at..at, part);
        }
    }
}

/// The file with up to seven damages; of an archive every other time the members, in a sound archive.
fn harmed(content: &[u8], seed: &mut Seeded) -> Vec<u8> {
    let count = seed.number_below(8);
    if seed.number_below(2) == 0
        && let Some(packed) = harmed_members(content, count, seed)
    {
        return packed;
    }
    let mut content = content.to_vec();
    (0..count).for_each(|_| harm(&mut content, seed));
    content
}

fn harmed_members(content: &[u8], count: usize, seed: &mut Seeded) -> Option<Vec<u8>> {
    let mut archive = zip::ZipArchive::new(Cursor::new(content)).ok()?;
    let mut out = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    let victim = seed.number_below(archive.len().max(1));
    for i in 0..archive.len() {
        let mut member = archive.by_index(i).ok()?;
        let mut data = Vec::new();
        member.read_to_end(&mut data).ok()?;
        if i == victim {
            (0..count).for_each(|_| harm(&mut data, seed));
        }
        out.start_file(member.name().ok()?, options).ok()?;
        out.write_all(&data).ok()?;
    }
    Some(out.finish().ok()?.into_inner())
}

/// Deflate packs at most 1032 to 1; an entry of one byte is at most eight bytes of heights.
const LARGEST: usize = 1032 * 8;

fn number(name: &str, unless: u64) -> u64 {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(unless)
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
    let (least, files) =
        (Duration::from_secs(number("ASPERITY_FUZZ_SECONDS", 0)), number("ASPERITY_FUZZ_FILES", 20_000));
    // what is free must not decide which files are refused
    let request = Request { memory_limit: Some(1 << 30), ..Request::default() };
    let (mut count, mut maps) = (0, 0);
    while count < files || spent() < least {
        let mut seed = Seeded(count);
        let (name, content) = &samples[seed.number_below(samples.len())];
        let content = harmed(content, &mut seed);
        if let Ok(found) = read(&folder.file(name, &content), &request) {
            assert_eq!(found.heights.len(), found.columns * found.rows, "{name}, seed {count}");
            assert!(found.heights.len() <= LARGEST * content.len().max(8), "{name}, seed {count}");
            maps += 1;
        }
        count += 1;
    }
    println!("{extension}: {count} files in {:.1} s of CPU, {maps} still maps", spent().as_secs_f64());
}

macro_rules! damaged {
    ($($name:ident: $extension:literal,)*) => {
        /// Every kind of file, by its extension.
        const KINDS: &[&str] = &[$($extension),*];

        $(#[test]
        fn $name() {
            survives($extension);
        })*
    };
}

damaged! {
    damaged_npy_is_answered: "npy",
    damaged_sur_is_answered: "sur",
    damaged_al3d_is_answered: "al3d",
    damaged_bcr_is_answered: "bcr",
    damaged_nid_is_answered: "nid",
    damaged_sdf_is_answered: "sdf",
    damaged_x3p_is_answered: "x3p",
    damaged_gwy_is_answered: "gwy",
    damaged_gsf_is_answered: "gsf",
    damaged_text_is_answered: "txt",
    damaged_opd_is_answered: "opd",
    damaged_opdx_is_answered: "opdx",
    damaged_metropro_is_answered: "dat",
    damaged_vk4_is_answered: "vk4",
    damaged_vk6_is_answered: "vk6",
    damaged_zon_is_answered: "zon",
    damaged_plu_is_answered: "plu",
    damaged_plux_is_answered: "plux",
    damaged_nanoscope_is_answered: "spm",
    damaged_datx_is_answered: "datx",
    damaged_tif_is_answered: "tif",
    damaged_xlsx_is_answered: "xlsx",
    damaged_xls_is_answered: "xls",
    damaged_ods_is_answered: "ods",
}

/// The beginnings of coverage-guided fuzzing (`verification/measure/fuzz`), to the folder that
/// ASPERITY_FUZZ_SEEDS names, a folder a kind.
#[test]
#[ignore = "writes files"]
fn seeds_of_fuzzing_are_written() {
    let top = std::path::PathBuf::from(std::env::var_os("ASPERITY_FUZZ_SEEDS").unwrap());
    let curves =
        CURVES.iter().enumerate().map(|(i, curve)| (format!("made-{i}.csv"), curve.as_bytes().to_vec()));
    let kinds = KINDS.iter().map(|kind| (*kind, samples(kind)));
    for (kind, files) in kinds.chain([("curve", curves.collect())]) {
        std::fs::create_dir_all(top.join(kind)).unwrap();
        for (name, content) in files {
            std::fs::write(top.join(kind).join(name), content).unwrap();
        }
    }
}

const CURVES: [&str; 2] =
    ["depth_nm;force_mN\n0,1;2,5\n0,2;3,5\n", "# h P\nDepth (nm)\tLoad (µN)\n1\t2\n2\t4\n"];

/// Curves go through the reader of series.
#[test]
fn damaged_curves_are_answered() {
    for count in 0..number("ASPERITY_FUZZ_FILES", 20_000) {
        let mut seed = Seeded(count);
        let content = harmed(CURVES[seed.number_below(2)].as_bytes(), &mut seed);
        if let Ok((text, _)) = crate::text::decode(&content)
            && let Ok(table) = crate::indentation::read(&text, [None, None], None)
        {
            assert!(table.series.iter().flat_map(|s| &s.rows).flatten().all(|x| x.is_finite()), "{count}");
        }
    }
}

/// Noise follows the magic of a format.
#[test]
fn noise_after_a_known_beginning_is_answered() {
    let folder = Folder::new();
    let all: Vec<_> = KINDS.iter().map(|kind| samples(kind).swap_remove(0)).collect();
    for count in 0..number("ASPERITY_FUZZ_FILES", 20_000) {
        let mut seed = Seeded(count);
        let (name, content) = &all[seed.number_below(all.len())];
        let mut content = content[..content.len().min(12)].to_vec();
        let length = seed.number_below(700);
        content.extend((0..length).map(|_| seed.next() as u8));
        let _ = read_plain(&folder.file(name, &content));
    }
}
