//! The engines by name.

use crate::scene::EngineKind;

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineName {
    /// The oracle.
    Reference,
    /// The kernel.
    Wgpu,
}

impl EngineName {
    /// All of them, the oracle first. What each is made of stands in `open.rs`.
    pub const ALL: [EngineName; 2] = [EngineName::Reference, EngineName::Wgpu];

    /// As scenes, tables and `--engine` spell it.
    pub fn word(self) -> &'static str {
        self.kind().word()
    }

    /// The engine that is spelt so.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|name| name.word() == word)
    }

    /// The engine that a scene names; `None` for `auto`.
    pub fn of(kind: EngineKind) -> Option<Self> {
        Self::ALL.into_iter().find(|name| name.kind() == kind)
    }

    /// The kind that a scene names it by.
    pub fn kind(self) -> EngineKind {
        match self {
            EngineName::Reference => EngineKind::Reference,
            EngineName::Wgpu => EngineKind::Wgpu,
        }
    }

    /// What it is, in a few words.
    pub fn about(self) -> &'static str {
        match self {
            EngineName::Reference => "the oracle: double precision, CPU",
            EngineName::Wgpu => "the kernel: single precision, any adapter",
        }
    }

    /// Bytes of a number of its fields.
    pub fn bytes_of_number(self) -> u8 {
        match self {
            EngineName::Reference => 8,
            EngineName::Wgpu => 4,
        }
    }

    /// Whether it computes on a device, which an adapter stands for.
    pub fn needs_device(self) -> bool {
        self == EngineName::Wgpu
    }
}
