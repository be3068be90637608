//! The shaders that find what movable solids cover (`movable.rs`), put together for one scene.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::partial_saturation::Weighting;

use super::bindings::Binding;
use super::compose::{Recipe, selected};
use super::numbers::count;
use super::table;

/// The stages of finding what solids cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    /// Which cells each touches, and how much of them.
    Touch,
    /// What each cell is made of.
    Resolve,
    /// How many cells are listed.
    Groups,
}

/// What a shader that finds what solids cover is made from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Covering {
    pub(super) stage: Stage,
    /// Whether the step of all cells has the solids in it.
    pub(super) in_every_cell: bool,
    /// Workgroups to each solid.
    pub(super) parts: u32,
}

impl Recipe<'_> {
    /// The shaders that find what the solids cover; see `movable.rs`.
    pub(super) fn covering(&self, work: Covering) -> String {
        let phase = self.setup.solid_phase.as_ref();
        let mut flags = Vec::new();
        let samples = match phase.map(|phase| phase.coverage) {
            Some(CoverageRule::Sampled { n }) => {
                flags.push("SAMPLED");
                n
            }
            Some(CoverageRule::Linear) => {
                flags.push("LINEAR");
                1
            }
            Some(CoverageRule::Exact) | None => {
                flags.push("EXACT");
                1
            }
        };
        match phase.map(|phase| phase.weighting) {
            Some(Weighting::NobleTorczynski) => flags.push("NOBLE"),
            Some(Weighting::Graded) => flags.push("GRADED"),
            Some(Weighting::SolidFraction) | None => flags.push("FRACTION"),
        }
        if !work.in_every_cell {
            flags.push("LISTED");
        }
        let mut text = self.constants();
        let whole =
            [("SOLIDS", self.solid_count()), ("PARTS", work.parts), ("SAMPLES", count(samples))];
        for (name, value) in whole {
            text += &format!("const {name} = {value}u;\n");
        }
        for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
            text += &format!("const PERIODIC_{name} = {};\n", self.setup.domain.is_periodic(axis));
        }
        let store = self.layout.store;
        text += include_str!("wgsl/solid.wgsl");
        match work.stage {
            Stage::Touch => {
                text += &table::writer(store, Binding::Shares, "shares");
                text += include_str!("wgsl/coordinates.wgsl");
                text += include_str!("wgsl/fraction.wgsl");
                text += &selected(include_str!("wgsl/cover.wgsl"), &flags);
            }
            Stage::Resolve => {
                text += &table::reader(store, Binding::Shares, "shares");
                text += &table::writer(store, Binding::Records, "records");
                text += &selected(include_str!("wgsl/resolve.wgsl"), &flags);
            }
            Stage::Groups => text += include_str!("wgsl/groups.wgsl"),
        }
        text
    }
}
