//! The amplitude of what oscillates in a record.

use nalgebra::{Complex, Matrix4, Vector4};

use crate::cases::CaseError;

/// The complex amplitude `A` of `Re[A e^(iωt)]` in samples of time and value, by least squares beside a constant and, where it
/// is given, what decays at the rate `decay`: what is left of the start. Errors with too few samples.
pub fn amplitude(
    samples: impl Iterator<Item = (f64, f64)>,
    omega: f64,
    decay: Option<f64>,
) -> Result<Complex<f64>, CaseError> {
    let (mut matrix, mut right) = (Matrix4::zeros(), Vector4::zeros());
    let mut first = None;
    for (time, value) in samples {
        let since = time - *first.get_or_insert(time);
        let (sin, cos) = (omega * time).sin_cos();
        let left_over = decay.map_or(0.0, |decay| (-decay * since).exp());
        let row = Vector4::new(cos, sin, 1.0, left_over);
        matrix += row * row.transpose();
        right += row * value;
    }
    if decay.is_none() {
        matrix[(3, 3)] = 1.0;
    }
    let solved = matrix.cholesky().map(|factors| factors.solve(&right));
    let Some(solved) = solved else {
        return Err(CaseError::table("too few samples of what oscillates"));
    };
    // a cos ωt + b sin ωt = Re[(a - ib) e^(iωt)]
    Ok(Complex::new(solved[0], -solved[1]))
}
