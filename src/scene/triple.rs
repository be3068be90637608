//! Three components, as scenes spell a vector.

/// Three components x, y, z.
pub type Triple = [f64; 3];
