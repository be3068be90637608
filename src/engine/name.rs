//! The engines by name.

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineName {
    /// The oracle.
    Reference,
    /// The kernel.
    Wgpu,
}

impl EngineName {
    /// As tables and `--engine` spell it.
    pub fn word(self) -> &'static str {
        match self {
            EngineName::Reference => "reference",
            EngineName::Wgpu => "wgpu",
        }
    }
}
