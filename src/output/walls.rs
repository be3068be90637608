//! Forces on the faces of the domain: of the fluid on walls and mirror planes, of grains on all that stop them.

use psmrt_reference::directions::C;
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::grains::touching::{Touched, touching};
use psmrt_reference::lattice::Vec3;

use crate::engine::{Block, Coupled};
use crate::scene::Scene;
use crate::scene::names::FACE_KEYS;

/// The forces on one face, N: of the fluid, no number where the fluid flows through it; and of the grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceForces {
    /// Its name.
    pub face: &'static str,
    /// Of the fluid, the pressure being that above the reference; 0 where there is none.
    pub fluid: [f64; 3],
    /// Of the grains.
    pub grains: [f64; 3],
}

/// Those of all faces that are not periodic.
pub fn forces(scene: &Scene, engine: &Coupled) -> Vec<FaceForces> {
    let domain = &scene.setup.domain;
    let of_grains = of_grains(engine);
    let mut all = Vec::new();
    for axis in 0..3 {
        for side in 0..2 {
            let face = engine.setup().domain.faces().axis(axis)[side];
            if face == Face::Periodic {
                continue;
            }
            let fluid = match scene.is_dry {
                true => Vec3::zeros(),
                false => of_fluid(domain, engine, (axis, side), &face),
            };
            all.push(FaceForces {
                face: FACE_KEYS[axis][side],
                fluid: (fluid * scene.units.si_force()).into(),
                grains: (of_grains[axis][side] * scene.units.si_force()).into(),
            });
        }
    }
    all
}

/// What the fluid has given up at a face in the last step.
///
/// A population that has come from a wall or mirror plane is the one that went there, turned round, so the face has taken up
/// `-2 f_a c_a` of each, of a mirror plane the part along its normal only. At an edge each of the two faces takes the part along
/// its own normal: what is at rest then exerts nothing but pressure.
fn of_fluid(domain: &Domain, engine: &Coupled, (axis, side): (usize, usize), face: &Face) -> Vec3 {
    let velocity = match face {
        Face::Wall { velocity } => *velocity,
        Face::FreeSlip => Vec3::zeros(),
        _ => return Vec3::repeat(f64::NAN),
    };
    let cells = domain.cells();
    let inward = if side == 0 { 1 } else { -1 };
    let mut block = Block::whole(domain);
    block.size[axis] = 1;
    block.low[axis] = if side == 0 { 0 } else { cells[axis] - 1 };
    let incoming: Vec<usize> = (0..C.len()).filter(|&a| C[a][axis] == inward).collect();
    let places = block.numbers(domain).into_iter().map(|number| domain.coordinates(number));
    let mut force = Vec3::zeros();
    for (at, f) in places.zip(engine.populations(block)) {
        for &a in &incoming {
            force[axis] -= 2.0 * f[a] * f64::from(inward);
            if *face == Face::FreeSlip {
                continue;
            }
            for along in (0..3).filter(|&along| along != axis && C[a][along] != 0) {
                let edge = if C[a][along] > 0 { 0 } else { cells[along] - 1 };
                if at[along] != edge || domain.is_periodic(along) {
                    force[along] -= 2.0 * f[a] * f64::from(C[a][along]);
                }
            }
        }
        // Of a wall that moves in its plane the populations have brought ρ u/3 of its momentum with them: 2 w_a ρ (c_a·u)/c_s²
        // c_a summed over the two of them along u, w_a = 1/36. The density is that of now.
        let density: f64 = f.iter().sum();
        force += velocity * (density / 3.0);
    }
    // The pressure of the reference density is c_s² = 1/3.
    force[axis] += f64::from(inward) * block.cell_count() as f64 / 3.0;
    force
}

/// Of all grains that touch each face.
fn of_grains(engine: &Coupled) -> [[Vec3; 2]; 3] {
    let mut forces = [[Vec3::zeros(); 2]; 3];
    let Some(system) = engine.free_grains() else { return forces };
    for contact in touching(system) {
        let Touched::Plane(number) = contact.other else { continue };
        let normal = system.planes()[number].normal;
        let axis = normal.iamax();
        forces[axis][usize::from(normal[axis] < 0.0)] -= contact.force;
    }
    forces
}
