//! Text of files, whichever way their characters were written.

use super::TextError;
use crate::workbook;
use chardetng::EncodingDetector;
use encoding_rs::{
    BIG5, EUC_JP, EUC_KR, Encoding, GBK, ISO_8859_2, KOI8_U, SHIFT_JIS, WINDOWS_1250, WINDOWS_1251,
    WINDOWS_1252,
};
use std::borrow::Cow;

/// Bytes that are looked at to tell UTF-16 without a mark, and text from other data.
const LOOKED_AT: usize = 1 << 16;

/// Lines beyond ASCII that tell an encoding.
const TELLING_LINES: usize = 1000;

/// °, ±, ², ³, µ, ·, «, », dashes and the space that does not break of Windows, Å.
const SIGNS: &[u8] = b"\xb0\xb1\xb2\xb3\xb5\xb7\xab\xbb\x96\x97\xa0\xc5";

/// Encodings that letters tell, and their usual names.
const TOLD: [(&Encoding, &str); 8] = [
    (BIG5, "Big5"),
    (EUC_JP, "EUC-JP"),
    (EUC_KR, "EUC-KR"),
    (GBK, "GBK"),
    (KOI8_U, "KOI8-U"),
    (SHIFT_JIS, "Shift-JIS"),
    (WINDOWS_1250, "Windows-1250"),
    (WINDOWS_1251, "Windows-1251"),
];

/// The text of `bytes` and the name of its encoding: by the byte order mark, UTF-16 without one by its zeros,
/// UTF-8 where it is that, else the encoding of Windows that its letters tell; of a workbook the sheet with a
/// table. Lines end in `\n` or `\r\n`.
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
        Err(_) => Ok(national(bytes)),
    }
}

/// The text of `bytes` that are not UTF-8, and the name of its encoding: told by its letters, with
/// Windows-1252 for the west of Europe and where signs of units alone are beyond ASCII.
fn national(bytes: &[u8]) -> (Cow<'_, str>, &'static str) {
    let mut detector = EncodingDetector::new();
    for line in bytes.split_inclusive(|b| *b == b'\n').filter(|line| !line.is_ascii()).take(TELLING_LINES) {
        detector.feed(&without_signs(line), false);
    }
    detector.feed(&[], true);
    let guess = match detector.guess(None, false) {
        // which has the letters of the other, and the sign of micro
        guess if guess == ISO_8859_2 => WINDOWS_1250,
        guess => guess,
    };
    let told = TOLD.into_iter().find(|(encoding, _)| *encoding == guess);
    let (encoding, name) = told.unwrap_or((WINDOWS_1252, "Windows-1252"));
    (encoding.decode_without_bom_handling(bytes).0, name)
}

/// The bytes of a `line` without the signs of units and numbers that stand among characters of ASCII, as µ, °
/// and ± of Windows do: they say nothing of a language, and look like parts of Chinese words.
fn without_signs(line: &[u8]) -> Vec<u8> {
    let pieces = line.chunk_by(|a, b| a.is_ascii() == b.is_ascii());
    pieces.filter(|piece| !piece.iter().all(|byte| SIGNS.contains(byte))).flatten().copied().collect()
}

fn no_text(sample: &[u8], is_strange: impl Fn(u8) -> bool) -> TextError {
    let place = sample.iter().position(|b| is_strange(*b)).unwrap_or(0);
    TextError::whole(format!("is no text: byte {place} is a control character"))
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}
