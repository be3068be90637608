//! Shaders put together for one scene: what the scene does not name is not in them.
//!
//! The files under `wgsl/` hold lines between `//#if NAME`, `//#else` and `//#end`, which stand or fall
//! with the scene's models. Sizes and rates are constants of the shader.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::Face;
use psmrt_reference::graded_viscosity::CUT_MAGIC;
use psmrt_reference::partial_saturation::SolidOperator;
use psmrt_reference::setup::Setup;

use super::bindings::Binding;
use super::coverage::graded_drag;
use super::driven::has_densities;
use super::layout::{Layout, Store};
use super::numbers::{count, literal};
use super::outgoing;
use super::streaming::{access, faces};
use super::table;

/// Invocations of `summary`, at most: enough to keep a large device busy, few enough to read back.
const MOST_STRANDS: u32 = 16_384;

/// Cells in one row of workgroups where cells are numbered through.
pub(super) const ROW: u32 = 65_535 * 64;

/// How the solids of a scene are kept on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SolidData {
    /// There are none.
    None,
    /// None of them ever moves: the weight of each cell.
    Fixed,
    /// Weight and velocity of each cell that one touches.
    Moving,
}

/// What the shaders of a scene are made from.
#[derive(Clone, Debug)]
pub(super) struct Recipe<'a> {
    pub(super) setup: &'a Setup,
    pub(super) layout: Layout,
    pub(super) solids: SolidData,
    /// Whether walls or inlets have velocities.
    pub(super) walls_move: bool,
}

/// The work that a shader does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Work {
    /// A step of all cells; with the solids in it or without.
    Step {
        /// Whether the solids are in it.
        with_solids: bool,
        /// Whether it keeps what the loads are worked out from.
        with_loads: bool,
    },
    /// A step of listed cells.
    StepListed {
        /// Whether it keeps what the loads are worked out from.
        with_loads: bool,
        /// Whether the populations are there before their collision, as at the start of a run.
        is_first: bool,
    },
    /// Populations and solid fractions read out.
    Observe,
    /// Sums over the box.
    Summary,
    /// Sums over the touches of each solid: the loads of the last step.
    Loads,
    /// The same of listed solids: how they hold the fluid before its next collision.
    Grips {
        /// Whether the populations are there before their collision.
        is_first: bool,
        /// Workgroups to each solid.
        parts: u32,
    },
}

impl Work {
    /// The name of the entry point.
    pub(super) fn entry(self) -> &'static str {
        match self {
            Work::Step { .. } => "step",
            Work::StepListed { .. } => "step_listed",
            Work::Observe => "observe",
            Work::Summary => "summary",
            Work::Loads | Work::Grips { .. } => "gather",
        }
    }

    /// Whether it streams with the rules of the faces, other than the steps of all cells.
    pub(super) fn has_faces(self) -> bool {
        match self {
            Work::Step { .. } | Work::Loads => false,
            Work::StepListed { is_first, .. } | Work::Grips { is_first, .. } => !is_first,
            Work::Observe | Work::Summary => true,
        }
    }
}

impl Recipe<'_> {
    /// Workgroup of `step`: long in x.
    pub(super) fn workgroup(&self) -> [u32; 2] {
        let along = self.layout.cells[0].next_power_of_two().min(64);
        [along, 64 / along]
    }

    /// Invocations of `summary`.
    pub(super) fn strands(&self) -> u32 {
        self.layout.count.div_ceil(32).next_multiple_of(64).min(MOST_STRANDS)
    }

    /// What of the solids is in `work`, and whether it keeps what the loads are worked out from.
    pub(super) fn solids_in(&self, work: Work) -> (SolidData, bool) {
        let (is_in, with_loads) = match work {
            Work::Step { with_solids, with_loads } => (with_solids, with_loads),
            Work::StepListed { with_loads, .. } => (true, with_loads),
            Work::Summary | Work::Observe => (true, false),
            Work::Loads | Work::Grips { .. } => (false, false),
        };
        if is_in { (self.solids, with_loads) } else { (SolidData::None, false) }
    }

    /// Whether `work` depends on the body force or on what a face holds.
    pub(super) fn takes_drive(&self, work: Work) -> bool {
        let collides = matches!(work, Work::Step { .. } | Work::StepListed { .. } | Work::Summary);
        (collides && self.setup.body_force.is_some())
            || (work.has_faces() && (self.walls_move || has_densities(self.setup)))
    }

    /// The shader for `work`.
    pub(super) fn shader(&self, work: Work) -> String {
        if work == Work::Loads {
            return self.constants() + &self.gather(work);
        }
        let listed = !matches!(work, Work::Step { .. });
        let steps = matches!(work, Work::Step { .. } | Work::StepListed { .. });
        let (solids, with_loads) = self.solids_in(work);
        let flags = self.flags(work);
        let mut text = self.constants();
        let mut add = |file: &str| text += &selected(file, &flags);
        add(include_str!("wgsl/drive.wgsl"));
        if solids == SolidData::Moving {
            add(&table::reader(self.layout.store, Binding::Records, "records"));
        }
        if solids != SolidData::None {
            add(include_str!("wgsl/solid_part.wgsl"));
        }
        if steps {
            // A single relaxation time is a set of equal rates: a shader of its own was not faster.
            add(include_str!("wgsl/moments.wgsl"));
        }
        add(&access(&self.layout, steps));
        if listed || with_loads {
            add(include_str!("wgsl/sums.wgsl"));
        }
        if with_loads {
            add(&table::writer(self.layout.store, Binding::Moments, "moments"));
            add(include_str!("wgsl/moments_kept.wgsl"));
        }
        if listed {
            add(include_str!("wgsl/coordinates.wgsl"));
            add(include_str!("wgsl/task.wgsl"));
            let writes = matches!(work, Work::StepListed { is_first: false, .. });
            add(&faces(&self.setup.domain, &self.layout, self.walls_move, writes));
        }
        add(&match work {
            Work::Step { .. } => include_str!("wgsl/step.wgsl").to_owned(),
            Work::StepListed { .. } => include_str!("wgsl/step_listed.wgsl").to_owned(),
            Work::Observe => include_str!("wgsl/observe.wgsl").to_owned(),
            Work::Summary => include_str!("wgsl/summary.wgsl").to_owned(),
            Work::Loads | Work::Grips { .. } => self.gather(work),
        });
        text
    }

    /// What the solid operator takes of the momentum, over `B (j - ρ u_s)`.
    fn gain(&self) -> f64 {
        match self.setup.solid_phase.as_ref().map(|phase| phase.operator) {
            Some(SolidOperator::FullBounceBack | SolidOperator::GradedViscosity) => 2.0,
            Some(SolidOperator::NonEquilibriumBounceBack | SolidOperator::Superposition) | None => {
                1.0
            }
        }
    }

    /// Number of solids.
    pub(super) fn solid_count(&self) -> u32 {
        self.setup.solid_phase.as_ref().map_or(0, |phase| count(phase.solids.len()))
    }

    /// The names of the models that are on.
    fn flags(&self, work: Work) -> Vec<&'static str> {
        let (solids, with_loads) = self.solids_in(work);
        let mut flags = Vec::new();
        let [along, across] = self.workgroup();
        let [nx, ny, _] = self.layout.cells;
        if !nx.is_multiple_of(along) || !ny.is_multiple_of(across) {
            flags.push("RAGGED");
        }
        if self.layout.store == Store::Textures {
            flags.push("TEXTURES");
        }
        match work {
            Work::StepListed { is_first: true, .. } | Work::Grips { is_first: true, .. } => {
                flags.push("BEFORE");
            }
            Work::Grips { is_first: false, .. } => flags.push("AFTER"),
            Work::StepListed { is_first: false, .. } => {
                flags.push("AFTER");
                if outgoing::has_any(&self.setup.domain) {
                    flags.push("OUTGOING");
                }
            }
            _ => {}
        }
        let forced = self.setup.body_force.is_some();
        if forced {
            flags.push("FORCE");
        }
        if solids != SolidData::None {
            flags.push("SOLIDS");
            if solids == SolidData::Moving {
                flags.push("MOVING");
            }
            if solids == SolidData::Moving || with_loads {
                flags.push("SLOTS");
            }
            if solids == SolidData::Moving && matches!(work, Work::StepListed { .. }) {
                flags.push("MANY");
            }
            if with_loads {
                flags.push("LOADS");
            }
            let operator = self.setup.solid_phase.as_ref().map(|phase| phase.operator);
            match operator {
                Some(SolidOperator::Superposition) => flags.push("SUPERPOSITION"),
                Some(SolidOperator::FullBounceBack) => flags.push("FULL"),
                Some(SolidOperator::GradedViscosity) => flags.push("GRADED"),
                Some(SolidOperator::NonEquilibriumBounceBack) | None => {}
            }
        }
        if forced || flags.contains(&"GRADED") {
            flags.push("PUSHED");
        }
        if forced || solids != SolidData::None {
            flags.push("MOMENTUM");
        }
        flags
    }

    /// Sizes and rates.
    pub(super) fn constants(&self) -> String {
        let [nx, ny, nz] = self.layout.cells;
        let [along, across] = self.workgroup();
        let [step_y, step_z] = self.layout.steps();
        let [s_e, s_eps, s_q, s_nu, s_pi, s_m] = match self.setup.collision {
            Collision::Srt { tau } => [1.0 / tau; 6],
            Collision::Mrt { rates } => [rates.e, rates.eps, rates.q, rates.nu, rates.pi, rates.m],
        };
        let tau = self.setup.collision.tau();
        let whole = [
            ("NX", nx),
            ("NY", ny),
            ("NZ", nz),
            ("STEP_Y", step_y),
            ("STEP_Z", step_z),
            ("WORKGROUP_X", along),
            ("WORKGROUP_Y", across),
            ("STRANDS", self.strands()),
            ("ROW", ROW),
        ];
        let real = [
            ("S_E", s_e),
            ("S_EPS", s_eps),
            ("S_Q", s_q),
            ("S_NU", s_nu),
            ("S_PI", s_pi),
            ("S_M", s_m),
            ("TWO_THIRDS", 2.0 / 3.0),
            ("GAIN", self.gain()),
            ("EXCESS", tau - 0.5),
            ("GRADED_DRAG", graded_drag(tau)),
            ("ODD_IN_CUT_CELLS", CUT_MAGIC / (tau - 0.5)),
            ("MAX_SPEED2", self.setup.guard.max_speed.powi(2)),
        ];
        let mut text = String::new();
        for (name, value) in whole {
            text += &format!("const {name} = {value}u;\n");
        }
        for (name, value) in real {
            text += &format!("const {name} = {};\n", literal(value));
        }
        text
    }

    /// The cells that `step` gets wrong: those at faces that are not periodic. In order.
    pub(super) fn face_cells(&self) -> Vec<u32> {
        let domain = &self.setup.domain;
        let is_solid_face =
            |axis: usize, side: usize| domain.faces().axis(axis)[side] != Face::Periodic;
        let [nx, ny, nz] = self.layout.cells;
        let mut cells = Vec::new();
        for z in 0..nz {
            for y in 0..ny {
                let row_at_face = [(y, ny, 1), (z, nz, 2)].iter().any(|&(i, n, axis)| {
                    (i == 0 && is_solid_face(axis, 0)) || (i + 1 == n && is_solid_face(axis, 1))
                });
                let row = nx * (y + ny * z);
                if row_at_face {
                    cells.extend(row..row + nx);
                    continue;
                }
                if is_solid_face(0, 0) {
                    cells.push(row);
                }
                if is_solid_face(0, 1) && (nx > 1 || !is_solid_face(0, 0)) {
                    cells.push(row + nx - 1);
                }
            }
        }
        cells
    }
}

/// The lines of `file` that stand with these flags.
pub(super) fn selected(file: &str, flags: &[&str]) -> String {
    let mut text = String::new();
    // Whether the lines of each open condition stand.
    let mut open: Vec<bool> = Vec::new();
    for line in file.lines() {
        if let Some(name) = line.strip_prefix("//#if ") {
            open.push(flags.contains(&name));
        } else if line == "//#else" {
            if let Some(last) = open.last_mut() {
                *last = !*last;
            }
        } else if line == "//#end" {
            open.pop();
        } else if open.iter().all(|&stands| stands) {
            text += line;
            text.push('\n');
        }
    }
    text
}
