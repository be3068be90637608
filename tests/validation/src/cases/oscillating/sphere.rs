//! A sphere that oscillates in fluid at rest.

use std::f64::consts::TAU;

use super::harmonic::amplitude;
use super::womersley::Oscillation;
use crate::cases::sphere_drag::study::without_grid;
use crate::cases::{Bench, CaseError, Claim};
use psmrt::table::Table;
use psmrt_reference::grains::grain::sphere_volume;

/// A sphere that moves to and fro in the middle of a closed cubic box.
#[derive(Clone, Copy, Debug)]
pub struct OscillatingSphere {
    /// Cells per radius.
    pub radius: u32,
    /// Edge of the box in radii.
    pub side: u32,
    /// Thickness of the layer in which its surface is felt, `√(2ν/ω)`, in radii.
    pub layer: f64,
    /// Relaxation time.
    pub tau: f64,
    /// `solid.operator`.
    pub operator: &'static str,
}

/// That of sphere.toml.
pub const QUICK: OscillatingSphere =
    OscillatingSphere { radius: 5, side: 8, layer: 0.5, tau: 0.6, operator: "bounce_back" };

/// Radius, m, viscosity, m2/s, and density, kg/m3, of the scene; what of its radius the sphere moves.
const SI_RADIUS: f64 = 5e-4;
const SI_VISCOSITY: f64 = 1e-6;
const SI_DENSITY: f64 = 1000.0;
const STROKE: f64 = 0.02;

/// Mirror planes through the sphere leave a quarter of the force.
const QUARTERS: f64 = 4.0;

/// The parts of the force over the exact ones.
struct Parts {
    velocity: f64,
    acceleration: f64,
    /// Of the second, with what moves the fluid inside.
    with_inside: f64,
}

impl OscillatingSphere {
    fn si_omega(self) -> f64 {
        2.0 * SI_VISCOSITY / (self.layer * SI_RADIUS).powi(2)
    }

    /// Womersley's number of the sphere, radius times the root of omega/nu.
    fn womersley(self) -> f64 {
        2.0_f64.sqrt() / self.layer
    }

    fn changes(self) -> Vec<String> {
        let (cells, half) = (self.radius * self.side, self.radius * self.side / 2);
        let dx = SI_RADIUS / f64::from(self.radius);
        let period = TAU / self.si_omega();
        vec![
            format!("domain.dx={dx:e}"),
            format!("domain.cells=[{cells}, {half}, {half}]"),
            format!("time.tau={}", self.tau),
            format!("solid.operator=\"{}\"", self.operator),
            format!("grains[0].centre=[{:e}, 0.0, 0.0]", 0.5 * f64::from(cells) * dx),
            format!(
                "grains[0].velocity={{ amplitude = [{:e}, 0.0, 0.0], period = {period:e} }}",
                self.si_omega() * STROKE * SI_RADIUS
            ),
            format!("stop.time={:e}", 1.5 * period),
        ]
    }

    fn parts(self, bench: &mut Bench) -> Result<Parts, CaseError> {
        let omega = self.si_omega();
        let (run, _) = bench.run("oscillating/sphere.toml", &self.changes())?;
        let forces = run.record("sphere")?.points("time (s)", "force_x (N)")?;
        let last = forces.into_iter().filter(|sample| sample.0 > 0.5 * TAU / omega);
        let force = amplitude(last, omega, None)? * QUARTERS;
        // u = U sin ωt = Re[-iU e^(iωt)], F = -C_u u - C_a du/dt: F̂ = (i C_u - ω C_a) U
        let speed = omega * STROKE * SI_RADIUS;
        let found = [force.im / speed, -force.re / (omega * speed)];
        let exact = Oscillation { nu: SI_VISCOSITY, omega }.on_sphere(SI_RADIUS);
        let [velocity, acceleration] = exact.map(|part| SI_DENSITY * part);
        let inside = SI_DENSITY * sphere_volume(SI_RADIUS);
        Ok(Parts {
            velocity: found[0] / velocity,
            acceleration: (found[1] - inside) / acceleration,
            with_inside: found[1] / acceleration,
        })
    }

    /// What a row of the study begins with.
    pub fn start(self) -> String {
        let OscillatingSphere { radius, side, layer, tau, operator } = self;
        format!("{operator},{layer},{tau},{side},{radius}")
    }

    /// A row of the study. Errors if it cannot be run.
    pub fn row(self, bench: &mut Bench) -> Result<String, CaseError> {
        let parts = self.parts(bench)?;
        Ok(format!(
            "{},{},{:.5},{:.5},{:.5}",
            self.start(),
            bench.engine_name().word(),
            parts.velocity,
            parts.acceleration,
            parts.with_inside
        ))
    }
}

pub(super) fn measure(bench: &mut Bench, table: &mut Table) -> Result<(), CaseError> {
    let parts = QUICK.parts(bench)?;
    table.add(vec![
        bench.engine_name().word().to_owned(),
        "sphere".to_owned(),
        format!("{:.4}", QUICK.womersley()),
        QUICK.radius.to_string(),
        "0".to_owned(),
        format!("{:.6e}", parts.velocity),
        format!("{:.6e}", parts.acceleration),
    ]);
    Ok(())
}

/// Largest error of the two parts.
fn worst(velocity: f64, acceleration: f64) -> f64 {
    (velocity - 1.0).abs().max((acceleration - 1.0).abs())
}

pub(super) fn quick_claim(rows: &Table, engine: &str) -> Result<Claim, CaseError> {
    let own = rows.with(&[("engine", engine), ("flow", "sphere")])?;
    Ok(Claim {
        what: format!(
            "{engine}: sphere of 5 cells per radius: larger error of the two parts of the force"
        ),
        measured: worst(own.number("re")?, own.number("im")?),
        allowed: 0.0..=0.26,
        why: "10 % at 8 cells per radius, as the study is held to, and second order: (8/5)² times that. Without taking the fluid inside \
              off it would be 50 % and more",
    })
}

/// The two parts of the rows of a study with these values, by cells per radius.
pub fn parts_by(
    study: &Table,
    of: &OscillatingSphere,
    along: &str,
) -> Result<Vec<[f64; 3]>, CaseError> {
    let layer = of.layer.to_string();
    let tau = of.tau.to_string();
    let (side, radius) = (of.side.to_string(), of.radius.to_string());
    let all = [
        ("operator", of.operator),
        ("layer_radii", &layer),
        ("tau", &tau),
        ("box_radii", &side),
        ("cells_per_radius", &radius),
    ];
    let wanted: Vec<_> = all.into_iter().filter(|(name, _)| *name != along).collect();
    let own = study.with(&wanted)?;
    let [x, velocity, acceleration] =
        [along, "velocity_part", "acceleration_part"].map(|name| own.numbers(name));
    let (x, velocity, acceleration) = (x?, velocity?, acceleration?);
    let mut rows: Vec<_> = (0..x.len()).map(|i| [x[i], velocity[i], acceleration[i]]).collect();
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Ok(rows)
}

/// The operators of the study.
pub const OPERATORS: [&str; 2] = ["bounce_back", "full_bounce_back"];

/// The grids of the study: in a box in which the layer is far from the walls.
pub const GRIDS: OscillatingSphere = OscillatingSphere { side: 12, ..QUICK };

/// The boxes of the study: with a layer as thick as the radius, which the walls of a small one are in.
pub const BOXES: OscillatingSphere = OscillatingSphere { radius: 4, layer: 1.0, ..QUICK };

pub(super) fn claims(study: &Table, shells: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for operator in OPERATORS {
        let grids = parts_by(study, &OscillatingSphere { operator, ..GRIDS }, "cells_per_radius")?;
        for [cells, velocity, acceleration] in grids.iter().filter(|row| row[0] >= 8.0) {
            claims.push(Claim {
                what: format!(
                    "study: {operator}, {cells} cells per radius: larger error of the two parts of the force"
                ),
                measured: worst(*velocity, *acceleration),
                allowed: 0.0..=0.1,
                why: "fixed before these runs: 10 %, the bound of an earlier form, a sphere of 4 cells in a box of 8 radii, which failed it",
            });
        }
        let [.., coarse, fine] = grids[..] else {
            return Err(CaseError::table("the study needs two grids"));
        };
        for (number, part) in [(1, "velocity"), (2, "acceleration")] {
            claims.push(Claim {
                what: format!("study: {operator}: error of the part with {part}, extrapolated in the grid"),
                measured: without_grid(&[coarse, fine].map(|row| (row[0], row[number])))
                    .map_or(f64::NAN, |part| part - 1.0),
                allowed: -0.05..=0.05,
                why: "exact in unbounded fluid; the box adds 0 to 2 % (shells of literature.csv), two grids leave as much again, the \
                      stroke 2 % of the radius",
            });
        }
    }
    let boxes = parts_by(study, &BOXES, "box_radii")?;
    let ([small, .., large], layer) = (&boxes[..], BOXES.layer.to_string()) else {
        return Err(CaseError::table("the study needs two boxes"));
    };
    for (number, part) in [(1, "velocity"), (2, "acceleration")] {
        let shell = |side: f64, shell: &str| {
            let side = side.to_string();
            let own = shells.with(&[("box_radii", &side), ("shell", shell)])?;
            own.with(&[("layer_radii", &layer)])?.number(&format!("{part}_part"))
        };
        let ratio =
            |name: &str| Ok::<_, CaseError>(shell(small[0], name)? / shell(large[0], name)?);
        let (one, other) = (ratio("inscribed")?, ratio("circumscribed")?);
        claims.push(Claim {
            what: format!(
                "study: layer of a radius: part with {part} in a box of {} radii over that in one of {}",
                small[0], large[0]
            ),
            measured: small[number] / large[number],
            allowed: one.min(other)..=one.max(other),
            why: "a cube acts between the spherical shells inscribed and circumscribed, for which the same ratio is exact \
                  (literature.csv); the error of the grid cancels",
        });
    }
    Ok(claims)
}
