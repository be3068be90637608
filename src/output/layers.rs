//! A bed in layers: porosity, pressure, flow, grains and their stresses, from one end of an axis to the other.

use std::ops::Range;

use psmrt_reference::grains::touching::touching;
use psmrt_reference::lattice::Vec3;

use super::grain_means;
use crate::engine::{Block, Coupled};
use crate::scene::Scene;
use crate::scene::check::permeability::si_gravity;

/// The first cell of each of `count` layers of whole cells, as equal as can be, and the end of the last.
fn bounds(cells: usize, count: usize) -> Vec<usize> {
    (0..=count).map(|layer| layer * cells / count).collect()
}

/// The values of [`crate::scene::columns::LAYER_COLUMNS`], layer by layer.
pub fn rows(scene: &Scene, engine: &Coupled, axis: usize, count: usize) -> Vec<[f64; 13]> {
    let (domain, units) = (&scene.setup.domain, &scene.units);
    let cells = domain.cells();
    let bounds = bounds(cells[axis], count);
    let layers = bounds.windows(2).map(|ends| ends[0]..ends[1]);
    let planes = Planes::of(scene, engine, axis);
    let area = (domain.cell_count() / cells[axis]) as f64;
    let period = domain.is_periodic(axis).then_some(cells[axis] as f64);
    let grains = GrainLayers::of(engine, axis, &bounds, period);
    let pressures: Vec<f64> = layers.clone().map(|layer| planes.si_pressure(layer)).collect();
    let places: Vec<f64> = layers.clone().map(|layer| middle(&layer) * units.si_dx).collect();
    let weight = units.si_density * si_gravity(scene.free.as_ref(), units);
    let driving = engine.setup().body_force.map_or(0.0, |g| g[axis]);
    layers
        .enumerate()
        .map(|(number, layer)| {
            let volume = area * layer.len() as f64;
            let slope = slope(&places, &pressures, number, period.map(|n| n * units.si_dx));
            // i = (G - dp/dx)/(ρ g)
            let si_driving = driving * units.si_force() / units.si_dx.powi(3);
            let velocity = planes.velocity(layer.clone()) * units.si_velocity();
            let stress = grains.stresses[number] / volume * units.si_pressure();
            [
                layer.start as f64 * units.si_dx,
                layer.end as f64 * units.si_dx,
                planes.pores(layer) / volume,
                pressures[number],
                (si_driving - slope) / weight,
                velocity.x,
                velocity.y,
                velocity.z,
                grains.counts[number],
                grains.contacts[number] / grains.counts[number].max(1.0),
                stress.x,
                stress.y,
                stress.z,
            ]
        })
        .collect()
}

fn middle(layer: &Range<usize>) -> f64 {
    0.5 * (layer.start + layer.end) as f64
}

/// How fast `values` rise at one of the `places`: between its neighbours, at an end between the last two.
fn slope(places: &[f64], values: &[f64], number: usize, period: Option<f64>) -> f64 {
    let last = places.len() - 1;
    let (before, after) = (number.checked_sub(1), (number < last).then_some(number + 1));
    let (low, high, turns) = match (before, after, period) {
        (Some(low), Some(high), _) => (low, high, 0.0),
        (None, Some(high), Some(length)) => (last, high, length),
        (Some(low), None, Some(length)) => (low, 0, length),
        (None, None, _) => return 0.0,
        (low, high, None) => (low.unwrap_or(number), high.unwrap_or(number), 0.0),
    };
    if low == high {
        return 0.0;
    }
    (values[high] - values[low]) / (places[high] - places[low] + turns)
}

/// Sums over the planes of cells across an axis.
struct Planes {
    /// Volume of the pores, cells.
    pores: Vec<f64>,
    /// Pressure in the pores, Pa times cells.
    si_pressure: Vec<f64>,
    /// Velocity in the pores, times cells.
    velocity: Vec<Vec3>,
}

impl Planes {
    fn of(scene: &Scene, engine: &Coupled, axis: usize) -> Self {
        let domain = &scene.setup.domain;
        let count = domain.cells()[axis];
        let [pores, si_pressure] = std::array::from_fn(|_| vec![0.0; count]);
        let mut planes = Planes { pores, si_pressure, velocity: vec![Vec3::zeros(); count] };
        // By planes along z, whatever the axis: engines answer so.
        for z in 0..domain.cells()[2] {
            let block = Block::plane(domain, z);
            for (number, state) in block.numbers(domain).into_iter().zip(engine.cells(block)) {
                let plane = domain.coordinates(number)[axis];
                let pore = 1.0 - state.solid_fraction;
                planes.pores[plane] += pore;
                planes.si_pressure[plane] += pore * scene.units.si_gauge_pressure(state.density);
                planes.velocity[plane] += pore * state.velocity;
            }
        }
        planes
    }

    fn pores(&self, layer: Range<usize>) -> f64 {
        self.pores[layer].iter().sum()
    }

    /// Mean pressure in the pores of a layer, Pa; 0 in one without.
    fn si_pressure(&self, layer: Range<usize>) -> f64 {
        let pores = self.pores(layer.clone());
        let sum: f64 = self.si_pressure[layer].iter().sum();
        if pores > 0.0 { sum / pores } else { 0.0 }
    }

    /// Mean velocity in the pores of a layer; 0 in one without.
    fn velocity(&self, layer: Range<usize>) -> Vec3 {
        let pores = self.pores(layer.clone());
        let sum: Vec3 = self.velocity[layer].iter().sum();
        if pores > 0.0 { sum / pores } else { Vec3::zeros() }
    }
}

/// What lies in each layer of the grains.
struct GrainLayers {
    /// Grains with their centres in it.
    counts: Vec<f64>,
    /// Contacts of these, faces too.
    contacts: Vec<f64>,
    /// `-Σ F_k l_k` over the shares of the branches in it, for the three axes k.
    stresses: Vec<Vec3>,
}

impl GrainLayers {
    fn of(engine: &Coupled, axis: usize, bounds: &[usize], period: Option<f64>) -> Self {
        let count = bounds.len() - 1;
        let mut layers = GrainLayers {
            counts: vec![0.0; count],
            contacts: vec![0.0; count],
            stresses: vec![Vec3::zeros(); count],
        };
        let place = |centre: f64| period.map_or(centre, |length| centre.rem_euclid(length));
        let layer_of = |centre: f64| {
            let above = bounds[1..].iter().filter(|&&end| place(centre) >= end as f64).count();
            above.min(count - 1)
        };
        for solid in engine.solids() {
            layers.counts[layer_of(solid.centre[axis])] += 1.0;
        }
        let Some(system) = engine.free_grains() else { return layers };
        let contacts = grain_means::contacts_of_each(&system.state());
        for (grain, contacts) in system.grains().iter().zip(contacts) {
            layers.contacts[layer_of(grain.position[axis])] += f64::from(contacts);
        }
        for contact in touching(system) {
            let start = place(system.grains()[contact.grain].position[axis]);
            let length = contact.branch[axis];
            let moment = -contact.force.component_mul(&contact.branch);
            // What lies along the layers, and so has no length across them, counts where it is.
            if length.abs() < 1e-9 {
                layers.stresses[layer_of(start)] += moment;
                continue;
            }
            for (layer, stress) in layers.stresses.iter_mut().enumerate() {
                let ends = [bounds[layer] as f64, bounds[layer + 1] as f64];
                *stress += moment * share([start, start + length], ends, period);
            }
        }
        layers
    }
}

/// The share of the way from one place to another that lies between two `ends`, and between their images if there is a
/// period.
pub fn share([from, to]: [f64; 2], ends: [f64; 2], period: Option<f64>) -> f64 {
    let (low, high) = (from.min(to), from.max(to));
    let within = |shift: f64| (high.min(ends[1] + shift) - low.max(ends[0] + shift)).max(0.0);
    let length: f64 = match period {
        Some(period) => [-period, 0.0, period].into_iter().map(within).sum(),
        None => within(0.0),
    };
    length / (high - low)
}
