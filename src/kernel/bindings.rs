//! The number of every binding. What has one number has it in all shaders.
//!
//! Shaders name them too: in front of each stands a constant for each number, `BIND_` and the name, in
//! `@binding(BIND_Slots)`.

/// What a shader may be bound to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binding {
    /// The populations that are read; up to 19 numbers.
    Old = 0,
    /// The populations that are written; as many.
    New = 20,
    /// `B` of each cell, where no solid can move.
    CellWeights = 40,
    /// Of each cell the number of its record, 0 for none.
    Slots,
    /// `(B, Σ B_s u_s)` of each covered cell.
    Records,
    /// Of cells in which several solids meet: what `Σ B_s u_s u_s` is beyond one solid of the mean velocity.
    Excess,
    /// Momentum and density of each covered cell before its collision.
    Moments,
    /// The body force and the values of the faces.
    Drive,
    /// Which cells are worked on.
    Task,
    /// Their list.
    CellList,
    /// Velocities at faces that let sound out, those that are read.
    Outgoing,
    /// Those that are written.
    NewOutgoing,
    /// What is read back.
    Seen,
    /// The solids with their motion.
    Solids,
    /// Cell and solid fraction of each touch of solids whose cells are given.
    Given,
    /// Rows of cells about balls.
    Rows,
    /// Number of touches of each solid.
    Counts,
    /// Solid fraction and solid of each touch.
    Touches,
    /// Of each touch the one before it in its cell, then the record of the cell.
    Links,
    /// `B_s` of each touch.
    Weights,
    /// Of each touch its cell and the arm from the solid's centre.
    Shares,
    /// How many cells one solid touches, and how many several do.
    Found,
    /// The cells that one solid touches.
    Alone,
    /// The cells in which several meet.
    Meetings,
    /// How many workgroups these lists take.
    Groups,
    /// Force, torque and `Σ B_s` of each solid.
    Loads,
    /// Balls whose solid fractions are to be checked.
    Balls,
}

impl Binding {
    /// All of them from [`Binding::CellWeights`] on have a name in the shaders.
    const NAMED: [Binding; 25] = [
        Binding::CellWeights,
        Binding::Slots,
        Binding::Records,
        Binding::Excess,
        Binding::Moments,
        Binding::Drive,
        Binding::Task,
        Binding::CellList,
        Binding::Outgoing,
        Binding::NewOutgoing,
        Binding::Seen,
        Binding::Solids,
        Binding::Given,
        Binding::Rows,
        Binding::Counts,
        Binding::Touches,
        Binding::Links,
        Binding::Weights,
        Binding::Shares,
        Binding::Found,
        Binding::Alone,
        Binding::Meetings,
        Binding::Groups,
        Binding::Loads,
        Binding::Balls,
    ];

    /// Its number, the first of several.
    pub(super) const fn number(self) -> u32 {
        self as u32
    }

    /// The constants that stand for the numbers in a shader.
    pub(super) fn constants() -> String {
        let line = |binding: &Binding| format!("const BIND_{binding:?} = {}u;\n", binding.number());
        Self::NAMED.iter().map(line).collect()
    }
}
