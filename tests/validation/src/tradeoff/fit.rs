//! Least squares for models that are not linear in their parameters, with bands.

use nalgebra::{DMatrix, DVector};

/// Parameters that make a sum of squares least.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// What is left at each point.
    pub residuals: Vec<f64>,
    /// Standard deviation of the residuals, with the parameters taken off the points.
    pub scale: f64,
    /// Standard error of each parameter.
    pub errors: Vec<f64>,
}

/// Steps that the search may take; some ten are usual.
const MOST_STEPS: usize = 500;

/// Step of the numerical derivatives: the root of the rounding error.
const STEP: f64 = 1e-7;

/// Levenberg and Marquardt's method from `start`. `None` if there are no more points than parameters, a
/// residual is not finite at the start, or the parameters cannot be told apart.
pub fn least_squares(start: &[f64], residuals: impl Fn(&[f64]) -> Vec<f64>) -> Option<Fit> {
    let mut p = start.to_vec();
    let mut r = DVector::from_vec(residuals(&p));
    if r.len() <= p.len() || !r.iter().all(|value| value.is_finite()) {
        return None;
    }
    let mut damping = 1e-3;
    let mut jacobian = derivatives(&p, &r, &residuals);
    for _ in 0..MOST_STEPS {
        // (Jᵀ J + λ diag(Jᵀ J)) s = -Jᵀ r
        let normal = jacobian.transpose() * &jacobian;
        let damped = &normal + DMatrix::from_diagonal(&(normal.diagonal() * damping));
        let step = damped.lu().solve(&(-jacobian.transpose() * &r))?;
        let next: Vec<f64> = p.iter().zip(step.iter()).map(|(p, s)| p + s).collect();
        let left = DVector::from_vec(residuals(&next));
        let (before, after) = (r.norm_squared(), left.norm_squared());
        if after <= before {
            let done = before - after <= 1e-14 * before;
            (p, r) = (next, left);
            if done {
                break;
            }
            jacobian = derivatives(&p, &r, &residuals);
            damping = (damping / 5.0).max(1e-15);
        } else {
            damping *= 4.0;
            if damping > 1e12 {
                break;
            }
        }
    }
    let scale = (r.norm_squared() / (r.len() - p.len()) as f64).sqrt();
    let covariance = (jacobian.transpose() * &jacobian).try_inverse()?;
    let errors = covariance.diagonal().iter().map(|c| scale * c.max(0.0).sqrt()).collect();
    Some(Fit { parameters: p, residuals: r.iter().copied().collect(), scale, errors })
}

/// The derivative of each residual by each parameter.
fn derivatives(
    p: &[f64],
    r: &DVector<f64>,
    residuals: &impl Fn(&[f64]) -> Vec<f64>,
) -> DMatrix<f64> {
    let columns: Vec<_> = (0..p.len())
        .map(|i| {
            let mut moved = p.to_vec();
            let step = STEP * p[i].abs().max(1.0);
            moved[i] += step;
            (DVector::from_vec(residuals(&moved)) - r) / step
        })
        .collect();
    DMatrix::from_columns(&columns)
}

/// Root mean square.
pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}
