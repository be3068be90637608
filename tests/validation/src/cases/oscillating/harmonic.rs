//! The amplitude of what oscillates in a record.

use nalgebra::{Complex, Matrix3, Vector3};

use crate::cases::CaseError;

/// The complex amplitude `A` of `Re[A e^(iωt)]` in samples of time and value, by least squares beside a constant. Errors with
/// too few samples.
pub fn amplitude(
    samples: impl Iterator<Item = (f64, f64)>,
    omega: f64,
) -> Result<Complex<f64>, CaseError> {
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (time, value) in samples {
        let (sin, cos) = (omega * time).sin_cos();
        let row = Vector3::new(cos, sin, 1.0);
        matrix += row * row.transpose();
        right += row * value;
    }
    let solved = matrix.cholesky().map(|factors| factors.solve(&right));
    let Some(solved) = solved else {
        return Err(CaseError::table("too few samples of what oscillates"));
    };
    // a cos ωt + b sin ωt = Re[(a - ib) e^(iωt)]
    Ok(Complex::new(solved[0], -solved[1]))
}
