//! Decimal numbers without float noise: a whole number of powers of ten.

/// `digits * 10^exponent`, exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Decimal {
    pub(crate) digits: i64,
    pub(crate) exponent: i32,
}

impl Decimal {
    /// The decimal of twelve significant digits nearest to a finite value.
    pub(crate) fn near(value: f64) -> Self {
        let text = format!("{value:.11e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = mantissa.replace('.', "").parse().unwrap_or(0);
        let exponent: i32 = exponent.parse().unwrap_or(0);
        Self { digits, exponent: exponent - 11 }.reduced()
    }

    /// The nearest f64: what the literal would give.
    pub(crate) fn value(self) -> f64 {
        format!("{}e{}", self.digits, self.exponent).parse().unwrap_or(f64::NAN)
    }

    /// The power of ten of the leading digit.
    pub(crate) fn magnitude(self) -> i32 {
        let length = self.digits.unsigned_abs().to_string().len();
        self.exponent + i32::try_from(length).unwrap_or(0) - 1
    }

    /// The same number with no trailing zeros in its digits.
    fn reduced(mut self) -> Self {
        if self.digits == 0 {
            return Self { digits: 0, exponent: 0 };
        }
        while self.digits % 10 == 0 {
            self.digits /= 10;
            self.exponent += 1;
        }
        self
    }

    /// `0.30`: as many decimals as the exponent asks for.
    pub(crate) fn plain(self) -> String {
        let sign = if self.digits < 0 { "-" } else { "" };
        let digits = self.digits.unsigned_abs().to_string();
        let Ok(decimals) = usize::try_from(-self.exponent) else {
            let zeros = usize::try_from(self.exponent).unwrap_or(0);
            let zeros = if self.digits == 0 { 0 } else { zeros };
            return format!("{sign}{digits}{}", "0".repeat(zeros));
        };
        if decimals == 0 {
            return format!("{sign}{digits}");
        }
        let digits = format!("{digits:0>width$}", width = decimals + 1);
        let (whole, fraction) = digits.split_at(digits.len() - decimals);
        format!("{sign}{whole}.{fraction}")
    }

    /// `1.5e-4`, and `0` for zero.
    pub(crate) fn scientific(self) -> String {
        let Self { digits, .. } = self.reduced();
        if digits == 0 {
            return "0".into();
        }
        let sign = if digits < 0 { "-" } else { "" };
        let text = digits.unsigned_abs().to_string();
        let (first, rest) = text.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        match self.magnitude() {
            0 => format!("{sign}{first}{point}{rest}"),
            magnitude => format!("{sign}{first}{point}{rest}e{magnitude}"),
        }
    }
}

/// Labels for the ticks of one axis: all plain, or all scientific where plain would be long.
pub(crate) fn labels(ticks: &[Decimal]) -> Vec<String> {
    let sizes = || ticks.iter().filter(|t| t.digits != 0);
    let low = sizes().map(|t| t.magnitude()).min().unwrap_or(0);
    let high = sizes().map(|t| t.magnitude()).max().unwrap_or(0);
    // 101325.0, 101325.5: a narrow range far from zero is long either way, and plainer plain.
    let digits = sizes().map(|t| t.reduced().digits.unsigned_abs().to_string().len()).max();
    let long_either_way = digits > Some(4) && high <= 9;
    let plain = low >= -3 && (high <= 5 || long_either_way);
    ticks.iter().map(|t| if plain { t.plain() } else { t.scientific() }).collect()
}
