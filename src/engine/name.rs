//! The engines by name.

use crate::scene::{EngineKind, Precision, Scene};

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineName {
    /// The oracle.
    Reference,
    /// The CPU engine in double precision.
    Cpu,
    /// The CPU engine in single precision.
    CpuSingle,
    /// The kernel.
    Wgpu,
}

impl EngineName {
    /// All of them, the oracle first. What each is made of stands in `open.rs`.
    pub const ALL: [EngineName; 4] =
        [EngineName::Reference, EngineName::Cpu, EngineName::CpuSingle, EngineName::Wgpu];

    /// As tables and `--engine` spell it, and scenes too but for `cpu_single`: that is their engine `cpu` with
    /// `precision = "single"`.
    pub fn word(self) -> &'static str {
        match self {
            EngineName::CpuSingle => "cpu_single",
            name => name.kind().word(),
        }
    }

    /// The engine that is spelt so.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|name| name.word() == word)
    }

    /// The engine that a scene names; `None` for `auto`.
    pub fn of(scene: &Scene) -> Option<Self> {
        match scene.engine {
            EngineKind::Reference => Some(EngineName::Reference),
            EngineKind::Cpu => Some(Self::cpu(scene.precision)),
            EngineKind::Wgpu => Some(EngineName::Wgpu),
            EngineKind::Auto => None,
        }
    }

    /// The CPU engine in a precision: double where none is asked for.
    pub fn cpu(precision: Option<Precision>) -> Self {
        match precision {
            Some(Precision::Single) => EngineName::CpuSingle,
            Some(Precision::Double) | None => EngineName::Cpu,
        }
    }

    /// The kind that a scene names it by.
    pub fn kind(self) -> EngineKind {
        match self {
            EngineName::Reference => EngineKind::Reference,
            EngineName::Cpu | EngineName::CpuSingle => EngineKind::Cpu,
            EngineName::Wgpu => EngineKind::Wgpu,
        }
    }

    /// What it is, in a few words.
    pub fn about(self) -> &'static str {
        match self {
            EngineName::Reference => "the oracle: double precision, CPU, written to be read",
            EngineName::Cpu => "the CPU engine: double precision, all cores",
            EngineName::CpuSingle => "the same with precision = \"single\"",
            EngineName::Wgpu => "the kernel: single precision, any adapter",
        }
    }

    /// Whether it computes in double precision.
    pub fn is_double(self) -> bool {
        self.bytes_of_number() == 8
    }

    /// Bytes of a number of its fields.
    pub fn bytes_of_number(self) -> u8 {
        match self {
            EngineName::Reference | EngineName::Cpu => 8,
            EngineName::CpuSingle | EngineName::Wgpu => 4,
        }
    }

    /// How many copies of the populations it keeps.
    pub fn copies(self) -> u8 {
        match self {
            EngineName::Reference | EngineName::Wgpu => 2,
            EngineName::Cpu | EngineName::CpuSingle => 1,
        }
    }

    /// Whether it computes on a device, which an adapter stands for.
    pub fn needs_device(self) -> bool {
        self == EngineName::Wgpu
    }
}
