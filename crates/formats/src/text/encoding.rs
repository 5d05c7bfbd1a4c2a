//! Text of files, whichever way their characters were written.

use super::TextError;
use crate::workbook;
use encoding_rs::{SHIFT_JIS, WINDOWS_1252};
use std::borrow::Cow;

/// Bytes that are looked at to tell UTF-16 without a mark, and text from other data.
const LOOKED_AT: usize = 1 << 16;

/// The text of `bytes` and the name of its encoding: by the byte order mark, UTF-16 without one by its zeros,
/// UTF-8 where it is that, else Shift-JIS where it can only be that, or Windows-1252; of a workbook the
/// sheet with a table. Lines end in `\n` or `\r\n`.
///
/// # Errors
/// Bytes that are no text.
pub fn decode(bytes: &[u8]) -> Result<(Cow<'_, str>, Cow<'static, str>), TextError> {
    if bytes.starts_with(workbook::ARCHIVE) || bytes.starts_with(workbook::COMPOUND) {
        let (text, name) = workbook::text(bytes)?;
        return Ok((text.into(), name.into()));
    }
    let (text, name) = decode_characters(bytes)?;
    let name = Cow::Borrowed(name);
    // old programs for the Mac end lines by a carriage return, those for DOS a file by Ctrl-Z
    if text.contains('\r') && !text.contains('\n') {
        return Ok((text.replace('\r', "\n").into(), name));
    }
    let end = text.trim_end_matches('\u{1a}').len();
    Ok(match text {
        Cow::Borrowed(text) => (text[..end].into(), name),
        Cow::Owned(mut text) => {
            text.truncate(end);
            (text.into(), name)
        }
    })
}

fn decode_characters(bytes: &[u8]) -> Result<(Cow<'_, str>, &'static str), TextError> {
    if bytes.starts_with(&[0xff, 0xfe, 0, 0]) || bytes.starts_with(&[0, 0, 0xfe, 0xff]) {
        return Err(TextError::whole("is text in UTF-32, which is not known: save it as UTF-8"));
    }
    if let Some(rest) = bytes.strip_prefix(&[0xff, 0xfe]) {
        return Ok((utf16(rest, u16::from_le_bytes).into(), "UTF-16"));
    }
    if let Some(rest) = bytes.strip_prefix(&[0xfe, 0xff]) {
        return Ok((utf16(rest, u16::from_be_bytes).into(), "UTF-16"));
    }
    let bytes = bytes.strip_prefix(&[0xef, 0xbb, 0xbf]).unwrap_or(bytes);
    let sample = &bytes[..bytes.len().min(LOOKED_AT)];
    let zeros = |side: usize| sample.iter().skip(side).step_by(2).filter(|b| **b == 0).count();
    let (even, odd) = (zeros(0), zeros(1));
    // numbers and Latin letters are below 256 in UTF-16
    let mostly = sample.len() / 4;
    match (even, odd) {
        (0, 0) => {}
        (0, n) if n > mostly => return Ok((utf16(bytes, u16::from_le_bytes).into(), "UTF-16")),
        (n, 0) if n > mostly => return Ok((utf16(bytes, u16::from_be_bytes).into(), "UTF-16")),
        _ => return Err(no_text(sample, |b| b == 0)),
    }
    let is_control = |b: u8| b < 0x20 && !matches!(b, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c | 0x1a);
    if sample.iter().filter(|b| is_control(**b)).count() > sample.len() / 100 {
        return Err(no_text(sample, is_control));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok((text.into(), "UTF-8")),
        Err(_) => Ok(japanese(bytes).map_or_else(
            || (WINDOWS_1252.decode_without_bom_handling(bytes).0, "Windows-1252"),
            |text| (text, "Shift-JIS"),
        )),
    }
}

/// The text of `bytes` in Shift-JIS, where two kana or kanji stand in a row and most of these begin with a
/// byte that is no letter of Windows-1252: letters with accents hardly ever make such pairs.
fn japanese(bytes: &[u8]) -> Option<Cow<'_, str>> {
    let text = SHIFT_JIS.decode_without_bom_handling_and_without_replacement(bytes)?;
    let is_kana_or_kanji = |c: &char| matches!(*c, '\u{3041}'..='\u{30fe}' | '\u{4e00}'..='\u{9fff}');
    let letters: Vec<bool> = text.chars().filter(|c| !c.is_ascii()).map(|c| is_kana_or_kanji(&c)).collect();
    let in_a_row = letters.windows(2).filter(|two| two[0] && two[1]).count();
    let leads = bytes.iter().filter(|byte| (0x81..=0x9f).contains(*byte)).count();
    (in_a_row > 0 && 2 * leads >= letters.len()).then_some(text)
}

fn no_text(sample: &[u8], is_strange: impl Fn(u8) -> bool) -> TextError {
    let place = sample.iter().position(|b| is_strange(*b)).unwrap_or(0);
    TextError::whole(format!("is no text: byte {place} is a control character"))
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}
