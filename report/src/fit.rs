//! Power laws: straight lines on log-log axes.

use crate::error::PlotError;
use crate::series::{Series, Style};

/// `y = y0 (x / x0)^order`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// The exponent: the slope on log-log axes. An error that falls as `dx^2` has order 2 against
    /// `dx` and -2 against the number of cells.
    pub order: f64,
    /// Standard error of the order, from how far the points lie off the line; `None` with two points,
    /// which every line goes through.
    pub order_error: Option<f64>,
    /// A point `(x0, y0)` of the line.
    pub through: (f64, f64),
}

impl PowerLaw {
    /// The least-squares line through the logarithms of the points.
    ///
    /// # Errors
    /// Fewer than two different x, or a coordinate that is not finite and positive.
    pub fn fit(points: &[(f64, f64)]) -> Result<Self, PlotError> {
        for (i, &(x, y)) in points.iter().enumerate() {
            if !(x > 0.0 && x.is_finite() && y > 0.0 && y.is_finite()) {
                let point = i + 1;
                return Err(PlotError::NoFit(format!(
                    "point {point} is ({x:?}, {y:?}), and both coordinates must be finite and \
                     positive"
                )));
            }
        }
        let n = points.len() as f64;
        let mean_x = points.iter().map(|p| p.0.ln()).sum::<f64>() / n;
        let mean_y = points.iter().map(|p| p.1.ln()).sum::<f64>() / n;
        let (mut sxx, mut sxy) = (0.0, 0.0);
        for (x, y) in points {
            let dx = x.ln() - mean_x;
            sxx += dx * dx;
            sxy += dx * (y.ln() - mean_y);
        }
        let different = points.windows(2).any(|pair| pair[0].0 != pair[1].0);
        if !different || sxx <= 0.0 {
            return Err(PlotError::NoFit(format!(
                "{} points with fewer than two different x",
                points.len()
            )));
        }
        let order = sxy / sxx;
        let off = |(x, y): &(f64, f64)| y.ln() - mean_y - order * (x.ln() - mean_x);
        let squares: f64 = points.iter().map(|point| off(point).powi(2)).sum();
        // Var(order) = s²/Sxx with s² = Σ off²/(n - 2)
        let order_error = (n > 2.0).then(|| (squares / (n - 2.0) / sxx).sqrt());
        Ok(Self { order, order_error, through: (mean_x.exp(), mean_y.exp()) })
    }

    /// The value at `x`.
    pub fn at(&self, x: f64) -> f64 {
        let (x0, y0) = self.through;
        y0 * (x / x0).powf(self.order)
    }

    /// The size of the order as it is shown: `2.03 ± 0.04`.
    pub fn order_words(&self) -> String {
        let order = self.order.abs();
        match self.order_error {
            Some(error) => format!("{order:.2} ± {error:.2}"),
            None => format!("{order:.2}"),
        }
    }

    /// The law as a thin grey line between two x.
    pub fn series(&self, label: impl Into<String>, x_range: (f64, f64)) -> Series {
        // 33 points, so that it is right on axes where it is not straight too.
        let (from, ratio) = (x_range.0, x_range.1 / x_range.0);
        let points = (0..=32).map(|i| from * ratio.powf(f64::from(i) / 32.0));
        Series::new(label, Style::Reference, points.map(|x| (x, self.at(x))).collect())
    }
}

impl Series {
    /// A line of slope `order` on log-log axes through a point, between two x. With an x that is
    /// not positive it holds NaN, which rendering refuses by the series' label.
    pub fn reference_slope(
        label: impl Into<String>,
        order: f64,
        through: (f64, f64),
        x_range: (f64, f64),
    ) -> Self {
        PowerLaw { order, order_error: None, through }.series(label, x_range)
    }
}
