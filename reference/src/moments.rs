//! The moment space of MRT: the matrix `M`, its inverse, and the diagonal matrix `S-hat`.
//!
//! Source: d'Humières, Ginzburg, Krafczyk, Lallemand & Luo, Phil. Trans. R. Soc. A 360, 437 (2002),
//! the paper's reference 4. Each row of `M` is a polynomial in the components of `c_a`; the rows are
//! the Gram–Schmidt orthogonalisation of those polynomials under the plain sum over directions.

use crate::directions::Q;
use crate::lattice::c;
use faer::diag::Diag;
use faer::linalg::solvers::DenseSolveCore;
use faer::{Col, Mat};

/// Values of the nineteen moments, in the order of [`NAMES`].
pub type Moments = [f64; Q];

/// Names of the moments, in d'Humières' symbols.
pub const NAMES: [&str; Q] = [
    "rho", "e", "eps", "jx", "qx", "jy", "qy", "jz", "qz", "3pxx", "3pixx", "pww", "piww", "pxy",
    "pyz", "pxz", "mx", "my", "mz",
];

/// Squared length of each row of `M`: the diagonal of `M Mᵀ`.
pub const ROW_NORMS: [f64; Q] = [
    19.0, 2394.0, 252.0, 10.0, 40.0, 10.0, 40.0, 10.0, 40.0, 36.0, 72.0, 12.0, 24.0, 4.0, 4.0, 4.0,
    8.0, 8.0, 8.0,
];

/// The moment polynomials of direction `(x, y, z)`: one column of `M`.
#[rustfmt::skip]
fn polynomials(x: f64, y: f64, z: f64) -> Moments {
    let c2 = x * x + y * y + z * z; // |c|²
    [
        1.0,                                        //  0 rho    density
        19.0 * c2 - 30.0,                           //  1 e      energy
        (21.0 * c2 * c2 - 53.0 * c2 + 24.0) / 2.0,  //  2 eps    energy squared
        x,                                          //  3 jx     momentum
        (5.0 * c2 - 9.0) * x,                       //  4 qx     energy flux
        y,                                          //  5 jy
        (5.0 * c2 - 9.0) * y,                       //  6 qy
        z,                                          //  7 jz
        (5.0 * c2 - 9.0) * z,                       //  8 qz
        3.0 * x * x - c2,                           //  9 3pxx   normal stress difference
        (3.0 * c2 - 5.0) * (3.0 * x * x - c2),      // 10 3pixx  its fourth-order companion
        y * y - z * z,                              // 11 pww    normal stress difference
        (3.0 * c2 - 5.0) * (y * y - z * z),         // 12 piww   its fourth-order companion
        x * y,                                      // 13 pxy    shear stress
        y * z,                                      // 14 pyz
        x * z,                                      // 15 pxz
        (y * y - z * z) * x,                        // 16 mx     third order, antisymmetric
        (z * z - x * x) * y,                        // 17 my
        (x * x - y * y) * z,                        // 18 mz
    ]
}

/// The matrix `M` (19 × 19, rows are moments, columns are directions): `m = M f`.
pub fn moment_matrix() -> Mat<f64> {
    Mat::from_fn(Q, Q, |moment, a| {
        let c = c(a);
        polynomials(c.x, c.y, c.z)[moment]
    })
}

/// The inverse of `M`, by LU decomposition with partial pivoting: `f = M⁻¹ m`.
pub fn inverse_moment_matrix() -> Mat<f64> {
    moment_matrix().partial_piv_lu().inverse()
}

/// The diagonal matrix `S-hat` of Eq. 3.
///
/// Of its type so that a product with it only scales columns: faer's product of two full matrices (0.24,
/// private-gemm-x86) ends without `vzeroupper`. That leaves the upper parts of the vector registers in use,
/// in this thread and in those it starts, and there are processors on which every SSE2 instruction of all
/// later steps then waits.
pub fn relaxation_matrix(rates: &Moments) -> Diag<f64> {
    Col::from_fn(Q, |moment| rates[moment]).into_diagonal()
}

/// A 19 × 19 matrix laid out for products with the values of one cell.
#[derive(Clone, Debug)]
pub struct CellMatrix {
    columns: [[f64; Q]; Q],
}

impl CellMatrix {
    /// Copies a 19 × 19 faer matrix.
    pub fn from_faer(matrix: &Mat<f64>) -> Self {
        let mut columns = [[0.0; Q]; Q];
        for (column, values) in columns.iter_mut().enumerate() {
            for (row, value) in values.iter_mut().enumerate() {
                *value = matrix[(row, column)];
            }
        }
        CellMatrix { columns }
    }

    /// The product of this matrix and a vector, summed column by column.
    pub fn times(&self, vector: &[f64; Q]) -> [f64; Q] {
        let mut product = [0.0; Q];
        for (column, &value) in self.columns.iter().zip(vector) {
            for (sum, &entry) in product.iter_mut().zip(column) {
                *sum += entry * value;
            }
        }
        product
    }
}
