//! A sphere that settles in a tank of liquid: the experiments of ten Cate et al. (2002).

use super::golden_rows;
use psmrt_reference::collision::Collision;
use psmrt_reference::coupling::{CoupledSolver, CouplingSettings, Gravity};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};

/// Standard gravity, m/s².
const SI_GRAVITY: f64 = 9.81;

/// One experiment: a row of `golden/ten_cate/literature.csv`, SI units.
#[derive(Clone, Debug)]
pub struct Experiment {
    pub name: String,
    pub si_diameter: f64,
    pub density_ratio: f64,
    pub si_viscosity: f64,
    pub si_width: f64,
    pub si_height: f64,
    pub si_gap: f64,
    /// Terminal velocity in an unbounded liquid by Abraham's law of drag, m/s.
    pub si_unbounded: f64,
    /// Largest velocity measured, m/s.
    pub si_largest: f64,
}

impl Experiment {
    /// The experiment of this name, `E1` to `E4`.
    pub fn named(name: &str) -> Self {
        let rows = golden_rows("ten_cate/literature.csv");
        let row = rows.iter().find(|row| &row[0] == name).unwrap();
        let value = |key: &str| -> f64 {
            let column = rows[0].iter().position(|header| header == key).unwrap();
            row[column].parse().unwrap()
        };
        Experiment {
            name: name.to_owned(),
            si_diameter: value("d_m"),
            density_ratio: value("rho_p") / value("rho_f"),
            si_viscosity: value("mu_Pa_s") / value("rho_f"),
            si_width: value("tank_x_m"),
            si_height: value("tank_z_m"),
            si_gap: value("initial_gap_m"),
            si_unbounded: value("u_inf_Abraham_m_s"),
            si_largest: value("umax_exp_m_s"),
        }
    }

    /// The points `(time s, value)` of a measured curve, `gap_over_d` or `velocity_m_s` (downwards).
    pub fn curve(&self, quantity: &str) -> Vec<(f64, f64)> {
        let rows = golden_rows("ten_cate/curves.csv");
        let own = rows.iter().filter(|row| row[0] == self.name && &row[2] == quantity);
        own.map(|row| (row[3].parse().unwrap(), row[4].parse::<f64>().unwrap().abs())).collect()
    }
}

/// A moment of a fall.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Time since the release, s.
    pub si_time: f64,
    /// Gap below the sphere over its diameter.
    pub gap: f64,
    /// Velocity downwards, m/s.
    pub si_velocity: f64,
}

/// A fall on a grid: a quarter of the tank, between mirror planes through the sphere.
pub struct Fall {
    pub solver: CoupledSolver,
    pub si_dx: f64,
    pub si_dt: f64,
    radius: f64,
}

impl Fall {
    /// `cells` per diameter and relaxation time `tau` (d'Humières' rates). The tank is rounded to
    /// whole cells, at most half a cell a side; the gap is exact.
    pub fn new(experiment: &Experiment, cells: f64, tau: f64) -> Self {
        let si_dx = experiment.si_diameter / cells;
        let si_dt = (tau - 0.5) / 3.0 * si_dx * si_dx / experiment.si_viscosity;
        let whole = |si_length: f64| whole_cells(si_length / si_dx);
        let half = whole(0.5 * experiment.si_width);
        let height = whole(experiment.si_height);
        let side = [Face::FreeSlip, Face::wall()];
        let faces = Faces { x: side, y: side, z: [Face::wall(); 2] };
        let collision = Collision::Mrt { rates: Rates::dhumieres(tau).unwrap() };
        let domain = Domain::new([half, half, height], faces).unwrap();
        let radius = 0.5 * cells;
        let start = radius + experiment.si_gap / si_dx;
        let grain = Grain::sphere(Vec3::new(0.0, 0.0, start), radius, experiment.density_ratio);
        let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, grain.mass).unwrap();
        let acceleration = Vec3::new(0.0, 0.0, -SI_GRAVITY * si_dt * si_dt / si_dx);
        let solver = CoupledSolver::new(
            Setup::fluid(domain, collision).with_solids(SolidPhase::default()),
            |_| (1.0, Vec3::zeros()),
            GrainSetup::new(law),
            vec![grain],
            vec![Plane::fixed(Vec3::zeros(), Vec3::z(), law)],
            CouplingSettings {
                gravity: Some(Gravity::Reduced { acceleration }),
                ..Default::default()
            },
        )
        .unwrap();
        Fall { solver, si_dx, si_dt, radius }
    }

    /// Where it is now.
    pub fn moment(&self) -> Moment {
        let grain = &self.solver.grains().grains()[0];
        Moment {
            si_time: self.solver.fluid().steps() as f64 * self.si_dt,
            gap: (grain.position.z - self.radius) / (2.0 * self.radius),
            si_velocity: -grain.velocity.z * self.si_dx / self.si_dt,
        }
    }
}

/// How a fall compares with the measured one.
#[derive(Clone, Copy, Debug)]
pub struct Comparison {
    /// Largest velocity over the largest measured one, less one.
    pub largest: f64,
    /// Root mean square of the difference of the velocities over the largest measured one, at the
    /// measured points above a gap of one diameter.
    pub velocity: f64,
    /// Mean difference of the gaps over the diameter, at the same points of the other curve.
    pub gap_offset: f64,
    /// Root mean square of what is left of that difference without its mean.
    pub gap: f64,
    /// How much later the sphere brakes at the bottom than computed, s: the shift in time that fits
    /// best below a gap of one diameter.
    pub si_delay: f64,
    /// Root mean square of the difference of the velocities there, with that shift, over the largest
    /// measured one.
    pub braking: f64,
}

/// Compares `fall`, from the release on, with the measured curves.
pub fn compare(experiment: &Experiment, fall: &[Moment]) -> Comparison {
    let largest = fall.iter().map(|moment| moment.si_velocity).fold(0.0, f64::max);
    let course = |value: fn(&Moment) -> f64| -> Vec<(f64, f64)> {
        fall.iter().map(|moment| (moment.si_time, value(moment))).collect()
    };
    let (gaps, velocities) = (course(|moment| moment.gap), course(|moment| moment.si_velocity));
    let near = fall.iter().find(|moment| moment.gap < 1.0).unwrap().si_time;
    let end = fall.last().unwrap().si_time;
    let differences = |own: &[(f64, f64)], measured: Vec<(f64, f64)>| -> Vec<f64> {
        measured.iter().map(|&(time, value)| interpolate(own, time) - value).collect()
    };
    let measured = |quantity, from: f64, to: f64, delay: f64| -> Vec<(f64, f64)> {
        let points = experiment.curve(quantity).into_iter();
        let shifted = points.map(|(time, value)| (time - delay, value));
        shifted.filter(|&(time, _)| time > from && time < to).collect()
    };
    let off = differences(&gaps, measured("gap_over_d", 0.0, near, 0.0));
    let gap_offset = off.iter().sum::<f64>() / off.len() as f64;
    let braking = |delay: f64| {
        let points = measured("velocity_m_s", near, end, delay);
        root_mean_square(&differences(&velocities, points)) / experiment.si_largest
    };
    // At most a diameter's worth of time, in steps far below what the curves resolve.
    let longest = experiment.si_diameter / largest;
    let delays = (0..=200).map(|step| f64::from(step) / 200.0 * longest);
    let si_delay = delays.min_by(|a, b| braking(*a).total_cmp(&braking(*b))).unwrap();
    Comparison {
        largest: largest / experiment.si_largest - 1.0,
        velocity: root_mean_square(&differences(
            &velocities,
            measured("velocity_m_s", 0.0, near, 0.0),
        )) / experiment.si_largest,
        gap_offset,
        gap: root_mean_square(&off.iter().map(|gap| gap - gap_offset).collect::<Vec<_>>()),
        si_delay,
        braking: braking(si_delay),
    }
}

fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt()
}

/// The value of `curve` at `x`, its points joined by straight lines.
pub fn interpolate(curve: &[(f64, f64)], x: f64) -> f64 {
    let after = curve.partition_point(|point| point.0 < x).clamp(1, curve.len() - 1);
    let [(x0, y0), (x1, y1)] = [curve[after - 1], curve[after]];
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

/// The nearest whole number of cells.
#[expect(clippy::cast_possible_truncation, reason = "lengths of boxes are small and positive")]
#[expect(clippy::cast_sign_loss, reason = "lengths of boxes are small and positive")]
fn whole_cells(length: f64) -> usize {
    length.round() as usize
}
