//! How a run of a map ended.

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It lived, and is right.
    Right,
    /// It lived, and is wrong.
    Wrong,
    /// It lived; there is nothing to hold it to.
    Unjudged,
    /// The guard stopped it.
    Stopped,
    /// The set-up was refused.
    Refused,
}

impl Outcome {
    /// As tables spell it.
    pub fn word(self) -> &'static str {
        match self {
            Outcome::Right => "right",
            Outcome::Wrong => "wrong",
            Outcome::Unjudged => "unjudged",
            Outcome::Stopped => "stopped",
            Outcome::Refused => "refused",
        }
    }

    /// The outcome of a word of a table, if it is one.
    pub fn of(word: &str) -> Option<Self> {
        let all = [Self::Right, Self::Wrong, Self::Unjudged, Self::Stopped, Self::Refused];
        all.into_iter().find(|outcome| outcome.word() == word)
    }

    /// Whether the run lived.
    pub fn lived(self) -> bool {
        !matches!(self, Outcome::Stopped | Outcome::Refused)
    }
}
