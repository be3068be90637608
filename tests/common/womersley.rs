//! Oscillating flows with exact answers: between plates, in a square duct, and round a sphere.
//!
//! What moves the fluid is `Re[.. e^(iωt)]`, and so is what comes of it: the functions give its complex amplitude. Any
//! consistent units; the density is 1 where none is given. This file knows no engine: the tests and the cases share it.

use std::f64::consts::PI;

use nalgebra::Complex;

const I: Complex<f64> = Complex::new(0.0, 1.0);
const ONE: Complex<f64> = Complex::new(1.0, 0.0);

/// The real value at the time `t` of what has a complex amplitude.
pub fn at_time(amplitude: Complex<f64>, omega: f64, t: f64) -> f64 {
    (amplitude * Complex::from_polar(1.0, omega * t)).re
}

/// Fluid of viscosity `nu` that oscillates with the angular frequency `omega`.
#[derive(Clone, Copy, Debug)]
pub struct Oscillation {
    /// Kinematic viscosity, length²/time.
    pub nu: f64,
    /// Angular frequency, 1/time.
    pub omega: f64,
}

impl Oscillation {
    /// `λ = √(iω/ν)`, 1/length.
    fn lambda(self) -> Complex<f64> {
        (I * (self.omega / self.nu)).sqrt()
    }

    /// Velocity at height `y` between plates `n` apart under an acceleration `G e^(iωt)` along them.
    ///
    /// `u = G/(iω) (1 - cosh(λ(y - n/2))/cosh(λn/2))`, Womersley's flow (J. Physiol. 127, 553 (1955)) between plates.
    pub fn between_plates(self, force: f64, n: f64, y: f64) -> Complex<f64> {
        let lambda = self.lambda();
        let shape = (lambda * (y - 0.5 * n)).cosh() / (lambda * (0.5 * n)).cosh();
        (ONE - shape) * force / (I * self.omega)
    }

    /// Velocity at height `y` above a plate at rest, `n` below one that moves along itself with `U e^(iωt)`.
    ///
    /// `u = U sinh(λy)/sinh(λn)`, Stokes' second problem (Schlichting & Gersten, Boundary-Layer Theory, ch. 5).
    pub fn below_moving_plate(self, speed: f64, n: f64, y: f64) -> Complex<f64> {
        let lambda = self.lambda();
        (lambda * y).sinh() / (lambda * n).sinh() * speed
    }

    /// Velocities at the points (`of[i]`, `of[j]`), number `i + of.len() j`, of a square duct of width `n` under an acceleration
    /// `G e^(iωt)` along it.
    ///
    /// `u = Σ 16 G/(π² p q)/(iω + ν π² (p² + q²)/n²) sin(pπy/n) sin(qπz/n)`, odd `p` and `q`: the series that solves the
    /// equation of the flow term by term (Womersley's problem in a duct; Drake, Q. J. Mech. Appl. Math. 18, 1 (1965)). Its
    /// terms fall as `1/(p q (p² + q²))`: what is left out is below 1e-6 of the sum.
    pub fn in_square_duct(self, force: f64, n: f64, of: &[f64]) -> Vec<Complex<f64>> {
        let mut velocities = vec![Complex::new(0.0, 0.0); of.len() * of.len()];
        let odd = || (0..60).map(|i| f64::from(2 * i + 1));
        let sines: Vec<Vec<f64>> =
            odd().map(|p| of.iter().map(|y| (p * PI * y / n).sin()).collect()).collect();
        for (p, along_y) in odd().zip(&sines) {
            for (q, along_z) in odd().zip(&sines) {
                let decay = self.nu * PI * PI * (p * p + q * q) / (n * n);
                let factor = Complex::from(16.0 * force / (PI * PI * p * q))
                    / Complex::new(decay, self.omega);
                let sines = along_z.iter().flat_map(|z| along_y.iter().map(move |y| y * z));
                for (velocity, sine) in velocities.iter_mut().zip(sines) {
                    *velocity += factor * sine;
                }
            }
        }
        velocities
    }

    /// Thickness of the layer in which a wall is felt, `δ = √(2ν/ω)`.
    pub fn layer(self) -> f64 {
        (2.0 * self.nu / self.omega).sqrt()
    }

    /// Force on a sphere of radius `a` that moves slowly with `u` in fluid at rest, `F = -C_u u - C_a du/dt`: its two
    /// coefficients, for the density 1.
    ///
    /// `C_u = 6πνa (1 + a/δ)`, `C_a = 3πa²δ (1 + 2a/(9δ))` (Stokes 1851; Landau & Lifshitz, Fluid Mechanics, § 24, problem
    /// 5): Stokes' drag, the added mass `2πa³/3`, and Basset's force, half of it with `u` and half with `du/dt`.
    pub fn on_sphere(self, a: f64) -> [f64; 2] {
        let delta = self.layer();
        let with_velocity = 6.0 * PI * self.nu * a * (1.0 + a / delta);
        let with_acceleration = 3.0 * PI * a * a * delta * (1.0 + 2.0 * a / (9.0 * delta));
        [with_velocity, with_acceleration]
    }
}
