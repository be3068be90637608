//! The paper's own cloud, 12,000 grains, until it lies on the floor: what is claimed of the committed run, and its figures.

use psmrt_report::{Axis, Figure, Series};

use crate::cases::{CaseError, Claim, Golden};
use psmrt::table::Table;

/// The tables of the run, and of single grains alone at its settings.
pub(super) const TABLES: [&str; 4] =
    ["fall.csv", "fall_walls.csv", "fall_layers.csv", "fall_alone.csv"];

/// From which diameter on the core is taken.
const CORE: f64 = 8.0;

/// Height of the box, m.
const HEIGHT: f64 = 1e-2;

/// When what swings after the start has died out, s.
const QUIET: f64 = 0.6;

/// From which on grains are the innermost.
const INNERMOST: f64 = 14.0;

/// Weight less buoyancy of all grains over the area of the floor, Pa: 12,000 π/6 d³ 1500 kg/m³ g over 6.4 mm squared.
const PRESSURE: f64 = 9.246;

struct Fall {
    moments: Table,
    walls: Table,
    layers: Table,
    alone: Table,
}

impl Fall {
    fn of(golden: &Golden) -> Result<Self, CaseError> {
        let [moments, walls, layers, alone] = TABLES.map(|file| golden.table(file));
        Ok(Fall { moments: moments?, walls: walls?, layers: layers?, alone: alone? })
    }

    /// Mean velocity of the grains from one distance to the nearest wall to another, early on.
    fn between(&self, from: f64, to: f64) -> Result<f64, CaseError> {
        let distances = self.walls.numbers("layer_from_diameters")?;
        let (grains, velocities) =
            (self.walls.numbers("grains")?, self.walls.numbers("velocity_m_s")?);
        let (mut sum, mut count) = (0.0, 0.0);
        for ((distance, n), velocity) in distances.into_iter().zip(grains).zip(velocities) {
            if (from..to).contains(&distance) {
                (sum, count) = (sum + n * velocity, count + n);
            }
        }
        Ok(sum / count)
    }

    /// The mean velocity of all grains in the middle of the height, and of single grains in the same places.
    fn in_the_same_places(&self) -> Result<[f64; 2], CaseError> {
        let alone = self.alone.points("wall_distance_diameters", "velocity_m_s")?;
        let (mut all, mut same, mut count) = (0.0, 0.0, 0.0);
        let layers = self.walls.points("layer_from_diameters", "velocity_m_s")?;
        for ((from, velocity), n) in layers.into_iter().zip(self.walls.numbers("grains")?) {
            all += n * velocity;
            same += n * between(&alone, from + 0.5);
            count += n;
        }
        Ok([all / count, same / count])
    }

    /// The value of a column at the last moment.
    fn last(&self, column: &str) -> Result<f64, CaseError> {
        Ok(self.moments.numbers(column)?.last().copied().unwrap_or(f64::NAN))
    }

    /// How far off the forces on the walls are from the weight, at most, once the sound of the start has gone.
    fn imbalance(&self) -> Result<f64, CaseError> {
        let (water, contacts) =
            (self.moments.points("time_s", "by_water")?, self.moments.numbers("by_contacts")?);
        let off = water.into_iter().zip(contacts).filter(|((time, _), _)| *time >= QUIET);
        let off: Vec<f64> =
            off.map(|((_, water), contacts)| (water + contacts - 1.0).abs()).collect();
        // What is not a number is not passed over, and nothing at all is no balance.
        let is_known = !off.is_empty() && off.iter().all(|off| off.is_finite());
        Ok(if is_known { off.into_iter().fold(0.0, f64::max) } else { f64::NAN })
    }

    /// Means of the porosity and of the coordination number over the layers inside the bed: from a diameter above the floor
    /// to as much below the top of the highest layer that is at least half as dense as the second.
    fn inside_bed(&self) -> Result<[f64; 2], CaseError> {
        let (porosity, coordination) =
            (self.layers.numbers("porosity")?, self.layers.numbers("coordination_number")?);
        let solid: Vec<f64> = porosity.iter().map(|n| 1.0 - n).collect();
        let second = solid.get(1).copied().unwrap_or(f64::NAN);
        let top = solid.iter().rposition(|solid| *solid > 0.5 * second);
        // Layers are a diameter and a quarter thick.
        let inside = 1..top.unwrap_or(0).saturating_sub(1);
        let mean = |values: &[f64]| {
            let own = values.get(inside.clone()).unwrap_or(&[]);
            own.iter().sum::<f64>() / own.len() as f64
        };
        Ok([mean(&porosity), mean(&coordination)])
    }
}

/// The value on the line through points, or at its nearest end.
fn between(points: &[(f64, f64)], x: f64) -> f64 {
    let after = points.iter().position(|point| point.0 >= x).unwrap_or(points.len() - 1);
    let (a, b) = (points[after.saturating_sub(1)], points[after]);
    if b.0 <= a.0 || x >= b.0 {
        return b.1;
    }
    let share = ((x - a.0) / (b.0 - a.0)).clamp(0.0, 1.0);
    a.1 + share * (b.1 - a.1)
}

pub(super) fn claims(golden: &Golden, laws: &Table) -> Result<Vec<Claim>, CaseError> {
    let fall = Fall::of(golden)?;
    let law = |name: &str| laws.with(&[("law", name)])?.number("velocity_over_alone");
    let [core, rim] = [fall.between(CORE, 20.0)?, fall.between(0.0, 1.0)?];
    let [all, alone] = fall.in_the_same_places()?;
    let inner = fall.between(INNERMOST, 20.0)?;
    let single = |distance| -> Result<f64, CaseError> {
        let row = fall.alone.with(&[("wall_distance_diameters", distance)])?;
        Ok(row.number("velocity_m_s")?)
    };
    let (in_the_middle, beside_wall) = (single("10")?, single("0.75")?);
    let [porosity, coordination] = fall.inside_bed()?;
    let stress = fall.layers.numbers("stress_z_Pa")?.first().copied().unwrap_or(f64::NAN);
    Ok(vec![
        Claim {
            what: format!(
                "12,000 grains: velocity {CORE} diameters and more from the side walls over that beside them, over the same ratio of \
                 single grains"
            ),
            measured: core / rim / (in_the_middle / beside_wall),
            allowed: 1.1..=f64::INFINITY,
            why: "a grain alone is slower beside a wall too, so the cloud shows something of its own only above 1; a tenth more, since \
                  grains that move together are few. There is no upper bound: the water that they take along, and that comes up beside \
                  the walls, is not known beforehand",
        },
        Claim {
            what: format!(
                "12,000 grains: velocity {INNERMOST} diameters and more from the side walls over that of one grain alone in the middle"
            ),
            measured: inner / in_the_middle,
            allowed: 1.0..=f64::INFINITY,
            why: "seen first, then claimed: the innermost are carried down by the water round them",
        },
        Claim {
            what: "12,000 grains: mean velocity in the middle of the height over that of single grains in the same places".to_owned(),
            measured: all / alone,
            allowed: law("Batchelor 1972")?..=1.5 * law("Richardson & Zaki 1954")?,
            why: "no water passes through the whole box, so the mean is that of hindered settling, between the two laws. At tau = 2 a grain \
                  alone falls 7 % too fast (fall_alone.csv), one in a crowd 8 to 60 % (psmrt check): the ratio is too large by a factor of \
                  1 to 1.5",
        },
        Claim {
            what: "12,000 grains: water and contacts on the walls over the weight, from 0.6 s on, the one that is off most".to_owned(),
            measured: fall.imbalance()?,
            allowed: 0.0..=1e-3,
            why: "what the walls do not carry changes the momentum of water and grains: by 6e-8 N, 2e-4 of the weight, where all grains \
                  change their velocity by 1 mm/s in a second, and by some more as sound dies away",
        },
        Claim {
            what: "12,000 grains: how far the upper front has fallen at the end, over the height of the box".to_owned(),
            measured: 1.0 - fall.last("front")? / HEIGHT,
            allowed: 0.5..=1.0,
            why: "the fall is to be followed over half of the height at least; a step takes 0.1 s on two cores, so that all of it does not fit \
                  into one session of computing",
        },
        Claim {
            what: "12,000 grains: porosity inside the bed that is left".to_owned(),
            measured: porosity,
            allowed: 0.36..=0.47,
            why: "between random close packing, 0.36, and random loose packing, 0.445 (Onoda & Liniger, Phys. Rev. Lett. 64, 2727 \
                  (1990)), and 0.025 more for a bed onto which grains still fall",
        },
        Claim {
            what: "12,000 grains: contacts a grain inside the bed".to_owned(),
            measured: coordination,
            allowed: 4.0..=6.0,
            why: "4 is what rigid grains with friction need, 6 what those without need (isostatic packings)",
        },
        Claim {
            what: "12,000 grains: stress of the grains in the lowest layer over the weight above it".to_owned(),
            measured: stress / (PRESSURE * fall.last("share_at_rest")?),
            allowed: 0.75..=1.05,
            why: "the weight of what rests, less what the side walls carry by friction, about 2 mu K h/W, a tenth in a bed a fifth as high as it \
                  is wide (Janssen, with K of a half), and less half of the lowest layer, a tenth of the bed",
        },
    ])
}

pub(super) fn figures(golden: &Golden) -> Result<Vec<Figure>, CaseError> {
    let fall = Fall::of(golden)?;
    Ok(vec![profile(&fall)?, course(&fall)?, bed(&fall)?])
}

fn profile(fall: &Fall) -> Result<Figure, CaseError> {
    let points = fall.walls.points("layer_from_diameters", "velocity_m_s")?;
    let points = points.into_iter().map(|(from, velocity)| (from + 0.5, velocity)).collect();
    let spread = fall.walls.numbers("spread_m_s")?;
    let alone = fall.alone.points("wall_distance_diameters", "velocity_m_s")?;
    Ok(Figure::new(
        "12,000 grains: velocity against distance to the side walls",
        Axis::linear("distance to the nearest side wall (diameters)").range(0.0, 20.0),
        Axis::linear("velocity downwards (m/s)").range(0.0, 3.5e-3),
    )
    .with(Series::line_points("in the cloud", points).with_errors(spread))
    .with(Series::dashed("one grain alone", alone))
    .note("the paper's box, 40 diameters wide; means between 0.6 and 1.2 s, in the middle half of the height; bars: the spread of the grains, not an error: one cloud, whose grains move together"))
}

fn course(fall: &Fall) -> Result<Figure, CaseError> {
    let millimetres = |column: &str| -> Result<Vec<(f64, f64)>, CaseError> {
        let points = fall.moments.points("time_s", column)?;
        Ok(points.into_iter().map(|(time, height)| (time, 1e3 * height)).collect())
    };
    let mut figure = Figure::new(
        "12,000 grains: the fall",
        Axis::linear("time (s)"),
        Axis::linear("mean height (mm)").range(0.0, 10.0),
    )
    .with(Series::line("front: below it are 99 of 100", millimetres("front")?))
    .with(Series::line("rim", millimetres("height_rim")?))
    .with(Series::line("all", millimetres("height")?))
    .with(Series::line("core", millimetres("height_core")?))
    .with_panel(Axis::linear("velocity downwards (m/s)"));
    for (label, column) in [("rim", "velocity_rim"), ("all", "velocity"), ("core", "velocity_core")]
    {
        figure = figure.with(Series::line(label, fall.moments.points("time_s", column)?));
    }
    figure = figure.with_panel(Axis::linear("share of the weight").range(0.0, 1.1));
    for (label, column) in
        [("carried by the water", "by_water"), ("by contacts with the walls", "by_contacts")]
    {
        figure = figure.with(Series::dashed(label, fall.moments.points("time_s", column)?));
    }
    Ok(figure
        .note("core: grains that start at least 8 diameters from the side walls; rim: within one"))
}

fn bed(fall: &Fall) -> Result<Figure, CaseError> {
    let column = |name: &str| -> Result<Vec<(f64, f64)>, CaseError> {
        let (low, high) = (fall.layers.numbers("low_m")?, fall.layers.numbers("high_m")?);
        let values = fall.layers.numbers(name)?;
        let middle = low.iter().zip(&high).map(|(low, high)| 0.5e3 * (low + high));
        Ok(middle.zip(values).collect())
    };
    Ok(Figure::new(
        "12,000 grains: the bed that is left",
        Axis::linear("height (mm)").range(0.0, 2.5),
        Axis::linear("porosity").range(0.3, 1.0),
    )
    .with(Series::line_points("layers of five cells", column("porosity")?))
    .with_panel(Axis::linear("contacts a grain"))
    .with(Series::line_points("layers of five cells", column("coordination_number")?))
    .with_panel(Axis::linear("stress (Pa)"))
    .with(Series::line_points("layers of five cells", column("stress_z_Pa")?)))
}
