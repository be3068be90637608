//! Contacts that are hard or brief, grains that overlap at the start, several grains in one cell.

use psmrt_reference::collision::Preset;
use psmrt_reference::coupling::{CouplingSettings, Gravity};
use psmrt_reference::domain::{Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::motion::Substeps;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::Solid;

use super::lab::{Lab, go_on};
use super::movers::with_grains;
use super::{Flow, Found, LabError, Line, Search};
use psmrt::engine::EngineName;
use psmrt::scene::FreePart;

const RADIUS: f64 = 3.0;
const DENSITY: f64 = 2.65;

pub(super) const CONTACT: Flow = Flow {
    name: "contact",
    about: &[
        "A grain of 6 cells and density ratio 2.65 sinks 0.2 cells onto a floor (10 x 10 x 12 cells, periodic sides),",
        "restitution 0.5 in vacuum, friction 0.5; 1000 steps. variant: sub-steps in the shortest contact time (scenes take",
        "25 and refuse fewer than 10). Right: in the end the floor is pressed in by W/k within 5 %, W the weight less",
        "buoyancy, k the stiffness of that duration. error: of that overlap.",
    ],
    parameter: "duration of a contact on the floor, time steps",
    values: &[100.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03],
    search: Search::All,
    also: |_| None,
    lines: |engine| {
        let all = ["25", "15", "10", "5"];
        all.iter().flat_map(|variant| [0.6, 1.0].map(|tau| grains(engine, variant, tau))).collect()
    },
    run: contact,
};

pub(super) const OVERLAP: Flow = Flow {
    name: "overlap",
    about: &[
        "Two free grains of 6 cells and density ratio 2.65 overlap at the start, in a fluid at rest (24 x 12 x 12 cells,",
        "periodic); 200 steps. variant: duration of their contact in time steps, restitution 0.5. Right within 5 %: no",
        "grain is ever faster than the energy of the spring allows, delta sqrt(k/m)/2 with the reduced mass m, and in the",
        "end the overlap is gone. error: the excess of speed, or the overlap that is left over that at the start.",
    ],
    parameter: "overlap at the start over the diameter",
    values: &[0.001, 0.003, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5],
    search: Search::All,
    also: |_| None,
    lines: |engine| {
        let all = ["30", "10", "3"];
        all.iter().flat_map(|variant| [0.6, 1.0].map(|tau| grains(engine, variant, tau))).collect()
    },
    run: overlap,
};

pub(super) const CROWD: Flow = Flow {
    name: "crowd",
    about: &[
        "Several held grains in the same cells, a body force of 1e-6 through a periodic box of 12^3 cells; 400 steps.",
        "variant coincident: grains of 6 cells at the same place; right: the flux is that past one of them and each takes",
        "its equal part of the load, within 0.1 % (single precision). variant cluster: grains of 2 cells with their",
        "centres within 0.6 cells; right: what the force puts in is what the grains take and the fluid gains in a step,",
        "within 2 %. error: the distance from that.",
    ],
    parameter: "grains that share the cells",
    values: &[1.0, 2.0, 4.0, 8.0],
    search: Search::All,
    also: |_| None,
    lines: |engine| {
        let mut all = Vec::new();
        for variant in ["coincident", "cluster"] {
            for weighting in [Weighting::NobleTorczynski, Weighting::SolidFraction] {
                all.extend([0.501, 0.6, 1.0, 2.0].map(|tau| Line {
                    weighting: Some(weighting),
                    ..grains(engine, variant, tau)
                }));
            }
        }
        all
    },
    run: crowd,
};

fn grains(engine: EngineName, variant: &'static str, tau: f64) -> Line {
    let weighting = Some(Weighting::NobleTorczynski);
    Line { engine, model: Preset::DHumieres, weighting, variant, tau }
}

/// The number that a variant stands for.
fn number(line: &Line) -> f64 {
    line.variant.parse().unwrap_or(f64::NAN)
}

fn contact(lab: &Lab, line: &Line, duration: f64) -> Result<Found, LabError> {
    const STEPS: u64 = 1000;
    let faces = Faces { z: [Face::wall(); 2], ..Faces::PERIODIC };
    let grain = Grain::sphere(Vec3::new(5.3, 5.2, RADIUS + 0.2), RADIUS, DENSITY);
    let setup = with_grains(Lab::setup(line, [10, 10, 12], faces)?, line, &[grain]);
    let law =
        ContactLaw::from_duration_and_restitution(duration, 0.5, grain.mass)?.with_friction(0.5)?;
    let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
    let sides = PeriodicBox { lengths: [Some(10.0), Some(10.0), None] };
    let grain_setup = GrainSetup { sides, ..GrainSetup::new(law) };
    // Alone in the shortest contact, which is that of two grains: half the mass.
    let shortest = grain_setup.shortest_time(&[grain, grain], &[floor]);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1000")]
    let substeps = (number(line) / shortest).ceil().clamp(1.0, 1e4) as u32;
    let g = 3e-4;
    let free = FreePart {
        setup: GrainSetup { substeps: Substeps::Fixed(substeps), ..grain_setup },
        grains: vec![grain],
        solids: vec![0],
        planes: vec![floor],
        settings: CouplingSettings {
            gravity: Some(Gravity::Reduced { acceleration: Vec3::new(0.0, 0.0, -g) }),
            ..CouplingSettings::default()
        },
    };
    let mut engine = lab.engine(line, &setup, Some(&free), |_| (1.0, Vec3::zeros()))?;
    go_on(&mut engine, STEPS)?;
    let solids = engine.solids();
    let (height, fall) = (solids[0].centre.z, solids[0].velocity.z.abs());
    // δ = W/k,  W = (1 - 1/s) m g
    let expected = (1.0 - 1.0 / DENSITY) * grain.mass * g / law.stiffness;
    // Soft contacts come to rest slowly: one that will still sink by 1 % is not judged.
    let is_at_rest = fall * STEPS as f64 <= 0.01 * expected;
    let error = ((RADIUS - height) / expected - 1.0).abs();
    Ok(Found::judged(STEPS, error, 0.05).if_judged(is_at_rest || error <= 0.05))
}

fn overlap(lab: &Lab, line: &Line, overlap: f64) -> Result<Found, LabError> {
    const STEPS: u64 = 200;
    let depth = 2.0 * RADIUS * overlap;
    let at = |x: f64| Grain::sphere(Vec3::new(x, 6.23, 6.11), RADIUS, DENSITY);
    let apart = 0.5 * (2.0 * RADIUS - depth);
    let both = vec![at(12.31 - apart), at(12.31 + apart)];
    let setup = with_grains(Lab::setup(line, [24, 12, 12], Faces::PERIODIC)?, line, &both);
    let reduced = 0.5 * both[0].mass;
    let law = ContactLaw::from_duration_and_restitution(number(line), 0.5, reduced)?;
    // m v²/2 = k δ²/2 with the relative speed v, half of it each
    let fastest = 0.5 * depth * (law.stiffness / reduced).sqrt();
    let free = FreePart {
        setup: GrainSetup { sides: PeriodicBox::all([24.0, 12.0, 12.0]), ..GrainSetup::new(law) },
        grains: both,
        solids: vec![0, 1],
        planes: Vec::new(),
        settings: CouplingSettings::default(),
    };
    let mut engine = lab.engine(line, &setup, Some(&free), |_| (1.0, Vec3::zeros()))?;
    let mut error = 0.0_f64;
    while engine.steps() < STEPS {
        let next = engine.steps() + 1;
        go_on(&mut engine, next)?;
        for solid in engine.solids() {
            error = error.max(solid.velocity.norm() / fastest - 1.0);
        }
    }
    let solids = engine.solids();
    let gap = (solids[1].centre - solids[0].centre).norm() - 2.0 * RADIUS;
    Ok(Found::judged(STEPS, error.max(-gap / depth), 0.05))
}

fn crowd(lab: &Lab, line: &Line, count: f64) -> Result<Found, LabError> {
    const STEPS: u64 = 400;
    const SIDE: usize = 12;
    const FORCE: f64 = 1e-6;
    let middle = Vec3::new(6.31, 6.23, 6.11);
    let is_cluster = line.variant == "cluster";
    // Corners of a cube of 0.6 cells, or all at one place.
    let place = |number: u8| {
        let corner = |bit: u8| if number & bit == 0 { -0.3 } else { 0.3 };
        let off = Vec3::new(corner(1), corner(2), corner(4));
        if is_cluster { (middle + off, 1.0) } else { (middle, RADIUS) }
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 8")]
    let number = count as u8;
    let run = |number: u8| -> Result<_, LabError> {
        let solids = (0..number).map(place).map(|(c, radius)| Solid::fixed_sphere(c, radius));
        let weighting = line.weighting.unwrap_or_default();
        let setup = Lab::setup(line, [SIDE; 3], Faces::PERIODIC)?
            .with_body_force(Vec3::new(FORCE, 0.0, 0.0))
            .with_solids(SolidPhase {
                solids: solids.collect(),
                weighting,
                ..SolidPhase::default()
            });
        let mut engine = lab.engine(line, &setup, None, |_| (1.0, Vec3::zeros()))?;
        go_on(&mut engine, STEPS)?;
        Ok(engine)
    };
    let mut engine = run(number)?;
    let flux = engine.box_means().mass_flux.x;
    let loads: Vec<f64> = engine.loads().iter().map(|load| load.force.x).collect();
    if !is_cluster {
        let alone = run(1)?;
        let (one_flux, one_load) = (alone.box_means().mass_flux.x, alone.loads()[0].force.x);
        let worst = loads.iter().map(|load| (load * count / one_load - 1.0).abs());
        let error = worst.fold((flux / one_flux - 1.0).abs(), f64::max);
        return Ok(Found::judged(STEPS, error, 1e-3));
    }
    // Σ_cells (1 - B) G = Σ F + d(Σ j)/dt, over one step
    let all = psmrt::engine::Block { low: [0; 3], size: [SIDE; 3] };
    let weighting = line.weighting.unwrap_or_default();
    let total = |cells: &[psmrt::engine::CellState]| -> f64 {
        cells.iter().map(|cell| cell.density * cell.velocity.x).sum()
    };
    let before = engine.cells(all);
    let input: f64 = before
        .iter()
        .map(|cell| (1.0 - weighting.weight(cell.solid_fraction, line.tau)) * FORCE)
        .sum();
    const MORE: u64 = 20;
    let mut taken = 0.0;
    for step in 1..=MORE {
        go_on(&mut engine, STEPS + step)?;
        taken += engine.loads().iter().map(|load| load.force.x).sum::<f64>();
    }
    let gained = total(&engine.cells(all)) - total(&before);
    let error = ((taken + gained) / (input * MORE as f64) - 1.0).abs();
    Ok(Found::judged(STEPS + MORE, error, 0.02))
}
