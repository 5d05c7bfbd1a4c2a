//! PNG: grids of palette colours, and any drawing of this program.

use super::palette::Colour;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// DejaVu Sans, cut down to the letters of the pictures; its licence lies beside it.
const FONT: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");
/// The family that every drawing names first, and what stands for it where it is not installed.
pub const FAMILY: &str = "DejaVu Sans, sans-serif";

/// A grid of `size` columns and rows, row by row from the top: each dot a colour of `palette` counted from 1,
/// 0 transparent.
///
/// # Errors
/// A text for a person where the picture cannot be encoded.
pub fn indexed_png(size: [usize; 2], palette: &[Colour], indices: &[u8]) -> Result<Vec<u8>, String> {
    let palette = [&[[255; 3]], palette].concat().concat();
    encode(size, indices, |encoder| {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette);
        encoder.set_trns(vec![0]);
    })
}

/// The drawing `svg` on white, `scale` dots to each of its units.
///
/// # Errors
/// A text for a person where the drawing cannot be read or encoded.
pub fn drawing_png(svg: &str, scale: f64) -> Result<Vec<u8>, String> {
    let mut options = Options { font_family: "DejaVu Sans".into(), ..Options::default() };
    options.fontdb_mut().load_font_data(FONT.to_vec());
    options.fontdb_mut().set_sans_serif_family("DejaVu Sans");
    let tree = Tree::from_str(svg, &options).map_err(|e| format!("a drawing could not be read: {e}"))?;
    // the size of a drawing has two digits: what they cut off is no dot of its own
    let dots = |units: f32| (f64::from(units) * scale - 0.05).ceil().max(1.0) as u32;
    let (width, height) = (dots(tree.size().width()), dots(tree.size().height()));
    let mut canvas = Pixmap::new(width, height).ok_or("a picture is too large")?;
    canvas.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale as f32, scale as f32), &mut canvas.as_mut());
    let opaque: Vec<u8> = canvas.data().chunks_exact(4).flat_map(|dot| &dot[..3]).copied().collect();
    encode([width as usize, height as usize], &opaque, |encoder| encoder.set_color(png::ColorType::Rgb))
}

fn encode(
    size: [usize; 2],
    data: &[u8],
    describe: impl FnOnce(&mut png::Encoder<'_, &mut Vec<u8>>),
) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0] as u32, size[1] as u32);
    describe(&mut encoder);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(data)?;
        writer.finish()
    });
    written.map_err(|e| format!("a picture could not be encoded: {e}"))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: &[u8]) -> ([u32; 2], Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut dots = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut dots).unwrap();
        ([reader.info().width, reader.info().height], dots)
    }

    #[test]
    fn letters_and_embedded_pictures_become_dots() {
        let image = indexed_png([2, 1], &[[9, 8, 7]], &[1, 0]).unwrap();
        let svg = format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><image width="2" height="1" href="{}"/>
               <text x="10" y="15" font-size="14" font-family="{FAMILY}" fill="#ff0000">µσᵣ</text></svg>"##,
            super::super::frame::data_uri(&image)
        );
        let (size, dots) = decoded(&drawing_png(&svg, 1.0).unwrap());
        assert_eq!(size, [40, 20]);
        assert_eq!(&dots[..6], [9, 8, 7, 255, 255, 255]);
        let red = dots.chunks(3).filter(|dot| dot[0] == 255 && dot[1] < 50).count();
        assert!(red > 10, "{red} dots of letters");
        assert_eq!(decoded(&drawing_png(&svg, 2.5).unwrap()).0, [100, 50]);
    }
}
