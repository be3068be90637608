//! How the fluid starts: the section, checked.

use std::path::absolute;
use std::sync::Arc;

use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

use super::in_time::Files;
use super::numbers::{absent, beyond, finite, needed, shorter_step};
use super::{Attachment, MAX_SPEED, Trouble, velocity};
use crate::input::{self, MIB};
use crate::scene::format_initial::{FlowName, InitialSection};
use crate::scene::format_run::AxisName;
use crate::scene::initial::{CellsAtStart, Initial};
use crate::units::Units;
use crate::{npy, quote};

const FIELD: &str = "initial.velocity_field";

/// Room for the header of a NumPy file, and for values of 16 bytes where 8 would do.
const BYTES_OF_VALUE: u64 = 16;

/// How the fluid starts.
pub(super) fn initial(
    section: Option<&InitialSection>,
    domain: &Domain,
    units: &Units,
    files: &mut Files,
) -> Result<Initial, Trouble> {
    let Some(section) = section else { return Ok(Initial::Uniform(Vec3::zeros())) };
    let InitialSection { velocity: given, flow, across, speed, velocity_field, from } = section;
    let kinds = [
        ("initial.flow", flow.is_some()),
        (FIELD, velocity_field.is_some()),
        ("initial.from", from.is_some()),
    ];
    let mut kinds = kinds.into_iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key);
    let first = kinds.next();
    if let Some(second) = kinds.next() {
        let problem = format!("the start is given twice, by `{}` too", first.unwrap_or_default());
        return Err(Trouble::new(second, problem, "keep one of them"));
    }
    if *flow != Some(FlowName::TaylorGreen) {
        absent("initial.speed", speed.as_ref(), "`flow = \"taylor_green\"`")?;
    }
    if flow.is_none() {
        absent("initial.across", across.as_ref(), "`flow`")?;
    }
    if let Some(flow) = flow {
        return named(*flow, section, domain, units);
    }
    if let Some(key) = first {
        absent("initial.velocity", given.as_ref(), &format!("a start without `{key}`"))?;
    }
    if let Some(name) = velocity_field {
        return field(name, domain, units, files);
    }
    if let Some(name) = from {
        let folder = files.folder.join(name);
        // A run keeps it as it is seen from everywhere.
        return Ok(Initial::Run(absolute(&folder).unwrap_or(folder)));
    }
    let because = "the section has nothing else";
    let given =
        needed("initial.velocity", *given, because, "add `velocity = [1e-3, 0.0, 0.0]` (m/s)")?;
    velocity("initial.velocity", given, units).map(Initial::Uniform)
}

/// A flow by its formula.
fn named(
    flow: FlowName,
    section: &InitialSection,
    domain: &Domain,
    units: &Units,
) -> Result<Initial, Trouble> {
    let because = "a flow needs it";
    let across = needed("initial.across", section.across, because, "add `across = \"z\"`")?;
    let across = match across {
        AxisName::X => 0,
        AxisName::Y => 1,
        AxisName::Z => 2,
    };
    let lengths = domain.cells().map(|n| n as f64);
    if flow != FlowName::ShearWave {
        absent("initial.velocity", section.velocity.as_ref(), "`flow = \"shear_wave\"`")?;
    }
    match flow {
        FlowName::Shear => {
            let [low, high] = domain.faces().axis(across).map(|face| match face {
                Face::Wall { velocity } => Some(velocity),
                _ => None,
            });
            let Some(walls) = low.zip(high).map(|(low, high)| [low, high]) else {
                let problem = format!(
                    "a shear lies between two walls, and the faces along {} are not both",
                    ["x", "y", "z"][across]
                );
                let remedy = "make both `kind = \"wall\"`, or use `flow = \"shear_wave\"`";
                return Err(Trouble::new("initial.flow", problem, remedy));
            };
            Ok(Initial::Shear { across, length: lengths[across], walls })
        }
        FlowName::ShearWave => {
            let key = "initial.velocity";
            let remedy = "add it, in m/s: the velocity where it is largest";
            let crest = needed(key, section.velocity, "a shear wave needs it", remedy)?;
            let crest = velocity(key, crest, units)?;
            if crest[across] != 0.0 {
                let problem =
                    "a shear wave moves across the axis along which it changes, not along it";
                let remedy = format!("set its component along {} to 0", ["x", "y", "z"][across]);
                return Err(Trouble::new(key, problem, remedy));
            }
            Ok(Initial::ShearWave { across, length: lengths[across], crest })
        }
        FlowName::TaylorGreen => {
            let key = "initial.speed";
            let remedy = "add `speed = 1e-3` (m/s)";
            let si_speed = needed(key, section.speed, "vortices need it", remedy)?;
            finite(key, &[si_speed], "m/s")?;
            let axes = [[1, 2], [0, 2], [0, 1]][across];
            let speed = si_speed / units.si_velocity();
            let vortices =
                Initial::TaylorGreen { axes, lengths: axes.map(|axis| lengths[axis]), speed };
            slow_enough(key, vortices.top_speed(), "its largest", units)?;
            Ok(vortices)
        }
    }
}

/// Velocities from a file.
fn field(
    name: &str,
    domain: &Domain,
    units: &Units,
    files: &mut Files,
) -> Result<Initial, Trouble> {
    let path = files.folder.join(name);
    let shown = quote::path(&path);
    let cells @ [nx, ny, nz] = domain.cells();
    let wrong = |problem: String, remedy: String| {
        Trouble::new(FIELD, format!("{shown}: {problem}"), remedy)
    };
    let expected =
        format!("numpy.save an array of shape ({nz}, {ny}, {nx}, 3): velocity[k, j, i] in m/s");
    let most = 3 * BYTES_OF_VALUE * domain.cell_count() as u64 + MIB;
    let bytes =
        input::read(&path, most).map_err(|error| wrong(error.to_string(), expected.clone()))?;
    let (shape, values) =
        npy::read(&bytes).map_err(|error| wrong(error.to_string(), expected.clone()))?;
    if shape != [nz, ny, nx, 3] {
        let found: Vec<String> = shape.iter().map(usize::to_string).collect();
        let problem =
            format!("its shape is ({}), the domain needs ({nz}, {ny}, {nx}, 3)", found.join(", "));
        return Err(wrong(
            problem,
            "its axes are z, y, x and component: numpy.transpose changes their order".to_owned(),
        ));
    }
    let mut velocities = Vec::with_capacity(domain.cell_count());
    for (cell, value) in values.chunks_exact(3).enumerate() {
        let velocity = Vec3::new(value[0], value[1], value[2]) / units.si_velocity();
        let at = || format!("[{}, {}, {}]", cell / (nx * ny), cell / nx % ny, cell % nx);
        if !velocity.norm().is_finite() {
            let problem = format!("velocity{} is {value:?}, not three finite numbers", at());
            return Err(wrong(
                problem,
                "give every cell a velocity, those inside grains too (0, say)".to_owned(),
            ));
        }
        slow_enough(FIELD, velocity.norm(), &format!("{shown}: velocity{}", at()), units)?;
        velocities.push(velocity);
    }
    files.attachments.push(Attachment::of_field(FIELD, "initial_velocity.npy", bytes));
    let velocities: Arc<[Vec3]> = velocities.into();
    Ok(Initial::Cells(CellsAtStart { cells, densities: None, velocities, run: None }))
}

/// Errors if a speed, which messages call `what`, is too large.
pub fn slow_enough(key: &str, speed: f64, what: &str, units: &Units) -> Result<(), Trouble> {
    if speed <= MAX_SPEED {
        return Ok(());
    }
    let problem = format!(
        "{what} is {} cells per time step; at most {MAX_SPEED} is allowed",
        beyond(speed, MAX_SPEED)
    );
    Err(Trouble::new(key, problem, shorter_step(units, 0.5 * MAX_SPEED / speed)))
}
