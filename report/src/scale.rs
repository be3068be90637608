//! Linear and logarithmic axes.

/// How values become positions along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equal lengths.
    Linear,
    /// Equal ratios are equal lengths; every value must be positive.
    Log,
}
