use super::measured::ReadError;

/// Numbers at places of a byte string; reading beyond its end is an error.
pub(super) struct Bytes<'a> {
    pub format: &'static str,
    pub data: &'a [u8],
}

impl<'a> Bytes<'a> {
    /// `length` bytes from `offset`.
    pub fn slice(&self, what: &'static str, offset: usize, length: usize) -> Result<&'a [u8], ReadError> {
        offset.checked_add(length).and_then(|end| self.data.get(offset..end)).ok_or(ReadError::truncated(
            self.format,
            what,
            (offset as u64).saturating_add(length as u64),
            self.data.len() as u64,
        ))
    }

    fn array<const N: usize>(&self, offset: usize) -> Result<[u8; N], ReadError> {
        let mut out = [0; N];
        out.copy_from_slice(self.slice("header", offset, N)?);
        Ok(out)
    }

    pub fn u16(&self, offset: usize) -> Result<u16, ReadError> {
        self.array(offset).map(u16::from_le_bytes)
    }

    pub fn i16(&self, offset: usize) -> Result<i16, ReadError> {
        self.array(offset).map(i16::from_le_bytes)
    }

    pub fn i32(&self, offset: usize) -> Result<i32, ReadError> {
        self.array(offset).map(i32::from_le_bytes)
    }

    pub fn u32(&self, offset: usize) -> Result<u32, ReadError> {
        self.array(offset).map(u32::from_le_bytes)
    }

    pub fn f32(&self, offset: usize) -> Result<f64, ReadError> {
        self.array(offset).map(f32::from_le_bytes).map(f64::from)
    }

    pub fn f64(&self, offset: usize) -> Result<f64, ReadError> {
        self.array(offset).map(f64::from_le_bytes)
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

/// How a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    U8,
    U16,
    U32,
    I8,
    I16,
    I32,
    I64,
    U64,
    F16,
    F32,
    F64,
}

impl Number {
    pub fn size(self) -> usize {
        match self {
            Number::U8 | Number::I8 => 1,
            Number::U16 | Number::I16 | Number::F16 => 2,
            Number::U32 | Number::I32 | Number::F32 => 4,
            Number::I64 | Number::U64 | Number::F64 => 8,
        }
    }

    /// Decodes as many numbers as `out` takes from `raw`.
    pub fn decode(self, raw: &[u8], big_endian: bool, out: &mut [f64]) {
        fn each<const N: usize>(raw: &[u8], big: bool, out: &mut [f64], read: impl Fn([u8; N]) -> f64) {
            for (z, bytes) in out.iter_mut().zip(raw.chunks_exact(N)) {
                let mut b = [0; N];
                b.copy_from_slice(bytes);
                if big {
                    b.reverse();
                }
                *z = read(b);
            }
        }
        match self {
            Number::U8 => each(raw, big_endian, out, |b: [u8; 1]| f64::from(b[0])),
            Number::I8 => each(raw, big_endian, out, |b| f64::from(i8::from_le_bytes(b))),
            Number::U16 => each(raw, big_endian, out, |b| f64::from(u16::from_le_bytes(b))),
            Number::I16 => each(raw, big_endian, out, |b| f64::from(i16::from_le_bytes(b))),
            Number::U32 => each(raw, big_endian, out, |b| f64::from(u32::from_le_bytes(b))),
            Number::I32 => each(raw, big_endian, out, |b| f64::from(i32::from_le_bytes(b))),
            Number::I64 => each(raw, big_endian, out, |b| i64::from_le_bytes(b) as f64),
            Number::U64 => each(raw, big_endian, out, |b| u64::from_le_bytes(b) as f64),
            Number::F16 => each(raw, big_endian, out, |b| half(u16::from_le_bytes(b))),
            Number::F32 => each(raw, big_endian, out, |b| f64::from(f32::from_le_bytes(b))),
            Number::F64 => each(raw, big_endian, out, f64::from_le_bytes),
        }
    }

    /// Decodes all `count` little-endian numbers of `raw`.
    pub fn decode_all(self, raw: &[u8], count: usize) -> Vec<f64> {
        let mut out = vec![0.0; count];
        self.decode(raw, false, &mut out);
        out
    }
}
