//! Claims about text in the encodings that Windows had before UTF-8: its letters tell which it is.
//! Source: words of instruments and laboratories, encoded by tables of the standard of the web (encoding_rs).

// a test fails by panicking
#![allow(clippy::unwrap_used)]

mod common;

use asperity_formats::text::decode;
use common::is_the_curve;
use encoding_rs::{BIG5, EUC_KR, Encoding, GBK, SHIFT_JIS, WINDOWS_1250, WINDOWS_1251, WINDOWS_1252};

#[track_caller]
fn is_decoded(text: &str, encoding: &'static Encoding, name: &str) {
    let (bytes, _, unknown) = encoding.encode(text);
    assert!(!unknown, "{text} is not in {name}");
    let (found, told) = decode(&bytes).unwrap();
    assert_eq!((found.as_ref(), told.as_ref()), (text, name));
}

#[test]
fn letters_tell_the_encoding() {
    for text in [
        "Prüfkörper größer, Länge: 3 µm, Höhe ±2°",
        "Zähigkeit für “spröde” – 20 °C",
        "ÄÖÜ äöü",
        "Température: 20 °C\nDéplacement (µm);Force (N)\n",
        "Profundidad de indentación (µm)\nPresión (MPa)\n",
        "Höjd (µm)",
    ] {
        is_decoded(text, WINDOWS_1252, "Windows-1252");
    }
    for text in ["変位(μm);荷重(mN)\n", "測定日時 2024/1/1\n"] {
        is_decoded(text, SHIFT_JIS, "Shift-JIS");
    }
    for text in ["Głębokość (µm);Siła (mN)\n", "Výška (µm)\n", "Mélység (µm);Erő (mN)\n"] {
        is_decoded(text, WINDOWS_1250, "Windows-1250");
    }
    for text in ["Глубина (мкм);Нагрузка (мН)\n", "Ширина: 20 мкм\n"] {
        is_decoded(text, WINDOWS_1251, "Windows-1251");
    }
    is_decoded("位移(μm),载荷(mN)\n", GBK, "GBK");
    is_decoded("位移(μm),荷重(mN)\n", BIG5, "Big5");
    is_decoded("변위(μm),하중(mN)\n", EUC_KR, "EUC-KR");
}

/// A detector of languages reads "µm" of Windows as a Chinese word.
#[test]
fn signs_of_units_alone_are_those_of_western_windows() {
    for text in [
        "Depth (µm);Load (mN)\n0,1;2,0\n",
        "x [µm]\ty [µm]\tz [µm]\n",
        "Breite: 20 µm ± 0.1 µm\n",
        "Area (µm²);Load (µN);20°C\n",
        "Displacement (Å)\n",
        "Ra = 0,5\u{a0}µm\u{a0}±\u{a0}5\u{a0}%, «map»\n",
    ] {
        is_decoded(text, WINDOWS_1252, "Windows-1252");
    }
}

#[test]
fn a_curve_in_the_encoding_of_its_country_is_read() {
    // as Python's codec shift_jis writes 変位(μm);荷重(mN)
    let japanese = b"\x95\xcf\x88\xca(\x83\xcam);\x89\xd7\x8f\x64(mN)\r\n0.1;2\r\n0.2;8\r\n";
    let (found, encoding) = decode(japanese).unwrap();
    assert_eq!(encoding, "Shift-JIS");
    is_the_curve(&found);
    for (names, encoding) in [
        ("位移(μm);载荷(mN)", GBK),
        ("변위(μm);하중(mN)", EUC_KR),
        ("Глубина (мкм);Нагрузка (мН)", WINDOWS_1251),
        ("Głębokość [µm];Siła [mN]", WINDOWS_1250),
        ("Indringdiepte (µm);Kracht (mN)", WINDOWS_1252),
        ("Intryckningsdjup (µm);Kraft (mN)", WINDOWS_1252),
    ] {
        let text = format!("{names}\r\n0,1;2,0\r\n0,2;8,0\r\n");
        let (bytes, ..) = encoding.encode(&text);
        let (found, _) = decode(&bytes).unwrap();
        is_the_curve(&found);
    }
}
