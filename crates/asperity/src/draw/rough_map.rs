//! Maps as PNG: pressure with a colour bar, contact coloured by regime.

use super::glyphs;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// No side of a picture is longer, unless less is asked for.
pub const LONGEST: usize = 2048;
/// Small maps are enlarged to about this.
const WANTED: usize = 640;
/// Room below the map for the legend.
const LEGEND: usize = 48;

const PAPER: [u8; 3] = [255, 255, 255];
const INK: [u8; 3] = [30, 30, 30];
/// Regimes: none, elastic, elastoplastic, plastic (Okabe and Ito's palette).
const REGIMES: [[u8; 3]; 4] = [[236, 236, 236], [0, 114, 178], [240, 180, 30], [213, 60, 20]];
/// From low to high pressure: even in lightness, legible in grey (after the map "inferno").
const HEAT: [[u8; 3]; 7] = [
    [10, 8, 35],
    [66, 10, 104],
    [132, 32, 107],
    [188, 55, 84],
    [229, 92, 48],
    [251, 155, 6],
    [252, 255, 164],
];

/// One number per cell.
#[derive(Clone, Copy)]
pub struct Map<'a> {
    /// Columns and rows.
    pub cells: [usize; 2],
    /// Size of a cell along x and y, in any unit.
    pub pixel: [f64; 2],
    /// Row by row.
    pub values: &'a [f32],
    /// No side of the picture has more dots.
    pub longest: usize,
}

/// How cells become dots: several cells a dot, or several dots a cell, so that lengths keep their ratio.
struct Grid {
    dots: [usize; 2],
    cells: [usize; 2],
}

impl Grid {
    fn of(map: &Map) -> Grid {
        let size = [0, 1].map(|k| map.cells[k] as f64 * map.pixel[k]);
        let longer = size[0].max(size[1]);
        let cells = map.cells[0].max(map.cells[1]);
        let room = map.longest.saturating_sub(LEGEND).max(1);
        let most = if cells >= WANTED { cells.min(room) } else { (cells * WANTED.div_ceil(cells)).min(room) };
        let dots = size.map(|s| ((s / longer * most as f64).round() as usize).clamp(1, room));
        Grid { dots, cells: map.cells }
    }

    /// Cells `start..end` that dot `dot` shows along axis `k`.
    fn span(&self, k: usize, dot: usize) -> std::ops::Range<usize> {
        let start = dot * self.cells[k] / self.dots[k];
        let end = ((dot + 1) * self.cells[k] / self.dots[k]).max(start + 1);
        start..end
    }
}

/// An image with room for a legend.
struct Picture {
    width: usize,
    height: usize,
    dots: Vec<u8>,
}

impl Picture {
    fn new(width: usize, height: usize) -> Picture {
        Picture { width, height, dots: PAPER.repeat(width * height) }
    }

    fn set(&mut self, x: usize, y: usize, colour: [u8; 3]) {
        if x < self.width && y < self.height {
            let at = 3 * (y * self.width + x);
            self.dots[at..at + 3].copy_from_slice(&colour);
        }
    }

    fn bar(
        &mut self,
        x: std::ops::Range<usize>,
        y: std::ops::Range<usize>,
        colour: impl Fn(usize) -> [u8; 3],
    ) {
        for row in y {
            x.clone().for_each(|column| self.set(column, row, colour(column)));
        }
    }

    /// Writes `text` with its left end at `x`; returns where it ends.
    fn text(&mut self, x: usize, y: usize, text: &str) -> usize {
        let mut at = x;
        for c in text.chars() {
            for (row, bits) in glyphs::glyph(c).iter().enumerate() {
                for column in (0..5).filter(|column| bits >> (4 - column) & 1 == 1) {
                    let (px, py) = (at + 2 * column, y + 2 * row);
                    self.bar(px..px + 2, py..py + 2, |_| INK);
                }
            }
            at += 12;
        }
        at
    }

    fn write(&self, path: &Path) -> std::io::Result<()> {
        let mut encoder =
            png::Encoder::new(BufWriter::new(File::create(path)?), self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.dots)?;
        writer.finish()?;
        Ok(())
    }
}

fn mixed(a: [u8; 3], b: [u8; 3], t: f64) -> [u8; 3] {
    [0, 1, 2].map(|k| (f64::from(a[k]) + t * (f64::from(b[k]) - f64::from(a[k]))).round() as u8)
}

/// Colour of a share 0..1 of the scale.
fn heat(share: f64) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (HEAT.len() - 1) as f64;
    let k = (place as usize).min(HEAT.len() - 2);
    mixed(HEAT[k], HEAT[k + 1], place - k as f64)
}

/// The three leading digits of a pressure.
fn digits(value: f64) -> String {
    if value >= 100.0 {
        format!("{value:.0}")
    } else if value >= 10.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.2}")
    }
}

/// The value that a share of the loaded pixels does not exceed.
fn quantile(values: &[f32], share: f64) -> f64 {
    let mut loaded: Vec<f32> = values.iter().copied().filter(|v| *v > 0.0).collect();
    if loaded.is_empty() {
        return 1.0;
    }
    let k = ((loaded.len() - 1) as f64 * share) as usize;
    let (_, value, _) = loaded.select_nth_unstable_by(k, f32::total_cmp);
    f64::from(*value)
}

/// Pressure in MPa: colours end at the pressure that 99 % of the loaded pixels do not exceed; no load is pale.
pub fn pressure(path: &Path, map: &Map, nominal_mpa: f64) -> std::io::Result<()> {
    let grid = Grid::of(map);
    let most = quantile(map.values, 0.99);
    let width = grid.dots[0].max(560);
    let mut picture = Picture::new(width, grid.dots[1] + LEGEND);
    for y in 0..grid.dots[1] {
        for x in 0..grid.dots[0] {
            // the largest pressure of the cells of a dot: small asperities stay visible
            let mut value = 0f32;
            for row in grid.span(1, y) {
                let line = &map.values[row * grid.cells[0]..][grid.span(0, x)];
                value = line.iter().fold(value, |v, p| v.max(*p));
            }
            let colour = if value > 0.0 { heat(f64::from(value) / most) } else { REGIMES[0] };
            picture.set(x, y, colour);
        }
    }
    let top = grid.dots[1] + 14;
    let bar = picture.text(10, top + 3, "0") + 8;
    picture.bar(bar..bar + 180, top..top + 20, |x| heat((x - bar) as f64 / 180.0));
    let label = format!("{} MPa (99 %), P/A0 {}", digits(most), digits(nominal_mpa));
    picture.text(bar + 190, top + 3, &label);
    picture.write(path)
}

/// Heights in µm about their mean, from low to high.
pub fn heights(path: &Path, map: &Map) -> std::io::Result<()> {
    let grid = Grid::of(map);
    let (low, high) = map.values.iter().fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
    let span = f64::from(high - low).max(f64::MIN_POSITIVE);
    let width = grid.dots[0].max(420);
    let mut picture = Picture::new(width, grid.dots[1] + LEGEND);
    for y in 0..grid.dots[1] {
        for x in 0..grid.dots[0] {
            let (mut sum, mut count) = (0.0, 0.0);
            for row in grid.span(1, y) {
                for value in &map.values[row * grid.cells[0]..][grid.span(0, x)] {
                    (sum, count) = (sum + f64::from(*value), count + 1.0);
                }
            }
            picture.set(x, y, heat((sum / count - f64::from(low)) / span));
        }
    }
    let top = grid.dots[1] + 14;
    let bar = picture.text(10, top + 3, &format!("{low:.1}")) + 8;
    picture.bar(bar..bar + 180, top..top + 20, |x| heat((x - bar) as f64 / 180.0));
    picture.text(bar + 190, top + 3, &format!("{high:.1} um"));
    picture.write(path)
}

/// Contact by regime; a partly covered pixel is paler.
pub fn contact(path: &Path, map: &Map, regime: &[f32], shares: Option<[f64; 3]>) -> std::io::Result<()> {
    let grid = Grid::of(map);
    let width = grid.dots[0].max(680);
    let mut picture = Picture::new(width, grid.dots[1] + LEGEND);
    for y in 0..grid.dots[1] {
        for x in 0..grid.dots[0] {
            let (mut cover, mut worst, mut count) = (0f32, 0f32, 0);
            for row in grid.span(1, y) {
                for column in grid.span(0, x) {
                    let i = row * grid.cells[0] + column;
                    cover += map.values[i];
                    worst = worst.max(regime[i]);
                    count += 1;
                }
            }
            let share = f64::from(cover) / f64::from(count.max(1));
            picture.set(x, y, mixed(REGIMES[0], REGIMES[worst as usize % 4], share.min(1.0)));
        }
    }
    let top = grid.dots[1] + 14;
    let mut x = 10;
    for (k, name) in ["elastic", "elastoplastic", "plastic"].iter().enumerate() {
        picture.bar(x..x + 20, top..top + 20, |_| REGIMES[k + 1]);
        let share = shares.map_or_else(String::new, |s| format!(" {:.0} %", 100.0 * s[k]));
        x = picture.text(x + 26, top + 3, &format!("{name}{share}")) + 14;
    }
    picture.write(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_keep_their_proportions_and_their_limit() {
        for (cells, pixel, want) in [
            ([1024, 1024], [1.0, 1.0], [1024, 1024]),
            ([8192, 4096], [1.0, 1.0], [2000, 1000]),
            ([100, 100], [1.0, 2.0], [350, 700]),
            ([5000, 10], [1.0, 1.0], [2000, 4]),
        ] {
            let map = Map { cells, pixel, values: &[], longest: LONGEST };
            assert_eq!(Grid::of(&map).dots, want);
        }
    }

    #[test]
    fn a_picture_is_written_and_reads_back() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("p.png");
        let values: Vec<f32> = (0..64).map(|i| i as f32 / 8.0).collect();
        let map = Map { cells: [8, 8], pixel: [1.0, 1.0], values: &values, longest: LONGEST };
        pressure(&path, &map, 100.0).unwrap();
        let reader =
            png::Decoder::new(std::io::BufReader::new(File::open(&path).unwrap())).read_info().unwrap();
        assert_eq!((reader.info().width, reader.info().height), (640, 688));
        contact(&path, &map, &[3.0; 64], None).unwrap();
    }
}
