//! Numbers as files of arrays hold them: their type, and how to read one.

/// NumPy's codes without the order of bytes, and the names here.
const NUMPY_CODES: [(&str, &str); 12] = [
    ("b1", "bool"),
    ("u1", "u8"),
    ("i1", "i8"),
    ("u2", "u16"),
    ("i2", "i16"),
    ("u4", "u32"),
    ("i4", "i32"),
    ("u8", "u64"),
    ("i8", "i64"),
    ("f2", "f16"),
    ("f4", "f32"),
    ("f8", "f64"),
];

/// A type of number in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberType {
    kind: Kind,
    is_big_endian: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Bool,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F16,
    F32,
    F64,
}

impl NumberType {
    /// By the name that Rust and C programmers give it, `u8` to `f64`; little-endian.
    pub fn named(name: &str) -> Option<Self> {
        let kind = match name {
            "bool" => Kind::Bool,
            "u8" => Kind::U8,
            "i8" => Kind::I8,
            "u16" => Kind::U16,
            "i16" => Kind::I16,
            "u32" => Kind::U32,
            "i32" => Kind::I32,
            "u64" => Kind::U64,
            "i64" => Kind::I64,
            "f16" => Kind::F16,
            "f32" => Kind::F32,
            "f64" => Kind::F64,
            _ => return None,
        };
        Some(NumberType { kind, is_big_endian: false })
    }

    /// By NumPy's code, as `<f8`, `>u2` or `|b1`.
    pub fn of_numpy(code: &str) -> Option<Self> {
        let order = code.chars().next().filter(|order| "<>|".contains(*order))?;
        let (_, name) = NUMPY_CODES.iter().find(|(known, _)| *known == &code[1..])?;
        Some(NumberType { is_big_endian: order == '>', ..Self::named(name)? })
    }

    /// The same, most significant byte first.
    pub fn big_endian(self) -> Self {
        NumberType { is_big_endian: true, ..self }
    }

    /// Whether each of its numbers is finite and has an `f64` of its own.
    pub fn is_exact(self) -> bool {
        !matches!(self.kind, Kind::F16 | Kind::F32 | Kind::F64 | Kind::U64 | Kind::I64)
    }

    /// Whether a number that was read is finite and may be told from its neighbours.
    pub fn is_usable(self, number: f64) -> bool {
        match self.kind {
            // 2^53
            Kind::U64 | Kind::I64 => number.abs() < 9_007_199_254_740_992.0,
            _ => number.is_finite(),
        }
    }

    /// Bytes of one.
    pub fn size(self) -> usize {
        match self.kind {
            Kind::Bool | Kind::U8 | Kind::I8 => 1,
            Kind::U16 | Kind::I16 | Kind::F16 => 2,
            Kind::U32 | Kind::I32 | Kind::F32 => 4,
            Kind::U64 | Kind::I64 | Kind::F64 => 8,
        }
    }

    /// The number at the start of a slice that has at least [`NumberType::size`] bytes.
    pub fn read(self, bytes: &[u8]) -> f64 {
        match self.kind {
            Kind::Bool | Kind::U8 => bytes[0].into(),
            Kind::I8 => i8::from_le_bytes([bytes[0]]).into(),
            Kind::U16 => u16::from_le_bytes(self.first(bytes)).into(),
            Kind::I16 => i16::from_le_bytes(self.first(bytes)).into(),
            Kind::F16 => half(u16::from_le_bytes(self.first(bytes))),
            Kind::U32 => u32::from_le_bytes(self.first(bytes)).into(),
            Kind::I32 => i32::from_le_bytes(self.first(bytes)).into(),
            Kind::F32 => f32::from_le_bytes(self.first(bytes)).into(),
            Kind::U64 => u64::from_le_bytes(self.first(bytes)) as f64,
            Kind::I64 => i64::from_le_bytes(self.first(bytes)) as f64,
            Kind::F64 => f64::from_le_bytes(self.first(bytes)),
        }
    }

    /// The first bytes of a slice that has that many, least significant first.
    fn first<const N: usize>(self, bytes: &[u8]) -> [u8; N] {
        std::array::from_fn(|i| bytes[if self.is_big_endian { N - 1 - i } else { i }])
    }
}

/// A number in half precision: one bit of sign, five of exponent, ten of fraction.
fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f64::from(bits & 0x3ff) / 1024.0);
    match exponent {
        0 => sign * fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => sign * f64::INFINITY,
        31 => f64::NAN,
        _ => sign * (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    }
}
