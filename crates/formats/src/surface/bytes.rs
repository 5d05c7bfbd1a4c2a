//! Numbers and texts of binary files, by their kind and place.

use super::measured::{Format, ReadError};

/// Numbers at places of a byte string; reading beyond its end is an error.
pub(super) struct Bytes<'a> {
    pub format: Format,
    pub data: &'a [u8],
}

impl<'a> Bytes<'a> {
    /// `length` bytes from `offset`.
    pub fn slice(&self, what: &'static str, offset: usize, length: usize) -> Result<&'a [u8], ReadError> {
        let promised = (offset as u64).saturating_add(length as u64);
        offset.checked_add(length).and_then(|end| self.data.get(offset..end)).ok_or(self.format.truncated(
            what,
            promised,
            self.data.len() as u64,
        ))
    }

    /// The little-endian number at `offset`.
    pub fn number(&self, kind: Number, offset: usize) -> Result<f64, ReadError> {
        let mut out = [0.0];
        kind.decode(self.slice("header", offset, kind.size())?, false, &mut out);
        Ok(out[0])
    }

    /// The big-endian number at `offset`.
    pub fn big_number(&self, kind: Number, offset: usize) -> Result<f64, ReadError> {
        let mut out = [0.0];
        kind.decode(self.slice("header", offset, kind.size())?, true, &mut out);
        Ok(out[0])
    }

    /// Text of a fixed field, without padding.
    pub fn text(&self, offset: usize, length: usize) -> Result<String, ReadError> {
        let raw = self.slice("header", offset, length)?;
        let end = raw.iter().position(|b| *b == 0).unwrap_or(raw.len());
        Ok(String::from_utf8_lossy(&raw[..end]).trim().to_string())
    }
}

/// The value of an IEEE 754 binary16 number: sign, 5 bits of exponent, 10 of fraction.
fn half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    let size = match exponent {
        0 => fraction * 2f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1024.0 + fraction) * 2f64.powi(exponent - 25),
    };
    if bits >> 15 == 0 { size } else { -size }
}

/// Reads as many numbers of `N` bytes as `out` takes.
fn each<const N: usize>(raw: &[u8], big_endian: bool, out: &mut [f64], read: impl Fn([u8; N]) -> f64) {
    for (z, bytes) in out.iter_mut().zip(raw.chunks_exact(N)) {
        let mut b = [0; N];
        b.copy_from_slice(bytes);
        if big_endian {
            b.reverse();
        }
        *z = read(b);
    }
}

/// The kinds of numbers, each with the type that has its bytes and the value of one of those.
macro_rules! numbers {
    ($stored:ident; $($kind:ident: $type:ty = $value:expr,)*) => {
        /// The way a number is stored.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Number { $($kind,)* }

        impl Number {
            pub fn size(self) -> usize {
                match self { $(Number::$kind => size_of::<$type>(),)* }
            }

            /// Decodes as many numbers as `out` takes from `raw`.
            pub fn decode(self, raw: &[u8], big_endian: bool, out: &mut [f64]) {
                match self {
                    $(Number::$kind => each(raw, big_endian, out, |bytes| {
                        let $stored = <$type>::from_le_bytes(bytes);
                        $value
                    }),)*
                }
            }
        }
    };
}

numbers! { stored;
    U8: u8 = stored as f64,
    U16: u16 = stored as f64,
    U32: u32 = stored as f64,
    U64: u64 = stored as f64,
    I8: i8 = stored as f64,
    I16: i16 = stored as f64,
    I32: i32 = stored as f64,
    I64: i64 = stored as f64,
    F16: u16 = half(stored),
    F32: f32 = stored as f64,
    F64: f64 = stored,
}

impl Number {
    /// Decodes all `count` little-endian numbers of `raw`.
    pub fn decode_all(self, raw: &[u8], count: usize) -> Vec<f64> {
        self.decode_all_ordered(raw, count, false)
    }

    /// The same, big-endian where told.
    pub fn decode_all_ordered(self, raw: &[u8], count: usize, big_endian: bool) -> Vec<f64> {
        let mut out = vec![0.0; count];
        self.decode(raw, big_endian, &mut out);
        out
    }
}
