//! The kinds of problems, typed: what a candidate is given. What it answers is in `spec.rs`.

use psmrt_reference::collision::Collision;
use psmrt_reference::directions::{C, Q};
use psmrt_reference::domain::Domain;
use psmrt_reference::grains::contact::{ContactMemory, Geometry, Motion};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Load;

use super::array::{Answers, Array};

/// What is asked. Lattice units; populations in the kit's order of directions.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    /// Weights, opposites, `M`, `S-hat`, relaxation times.
    Constants(Constants),
    /// Moments and equilibria of given states.
    Moments(States),
    /// Collisions of single cells.
    Collisions(Collisions),
    /// Solid fractions of spheres in single cells.
    SolidFractions(Spheres),
    /// Weights `B` of single cells with one solid.
    Weights(SolidCells),
    /// Weights of cells with two solids.
    SharedWeights(SharedCells),
    /// One streaming step of a domain with its faces.
    Streaming(Streaming),
    /// A domain, run for some steps.
    Scene(Box<Scene>),
    /// Forces of single contacts.
    Contacts(Contacts),
    /// Formulas and sizes that the paper states.
    Formulas(Formulas),
}

/// Stage 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Constants {
    /// The rates whose `S-hat` is asked.
    pub rates: Rates,
    /// Kinematic viscosities whose relaxation times are asked, cells²/step.
    pub viscosities: Vec<f64>,
}

/// Stage 1: cells.
#[derive(Clone, Debug, PartialEq)]
pub struct States {
    /// Populations whose density, momentum and moments are asked.
    pub f: Vec<Populations>,
    /// Density and velocity at which the equilibria are asked.
    pub at: Vec<(f64, Vec3)>,
}

/// Stage 2: cells that collide once, each by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Collisions {
    /// The solid part's collision, where there is one.
    pub operator: SolidOperator,
    /// The weight.
    pub weighting: Weighting,
    /// The cells.
    pub cells: Vec<CollidingCell>,
}

/// A cell that collides. All cells of a problem have the same parts.
#[derive(Clone, Debug, PartialEq)]
pub struct CollidingCell {
    /// Populations before the collision.
    pub f: Populations,
    /// SRT or MRT, with its rates.
    pub collision: Collision,
    /// Force per volume on the fluid.
    pub body_force: Option<Vec3>,
    /// Solid fraction `epsilon` and velocity `u_p` of a solid in the cell.
    pub solid: Option<(f64, Vec3)>,
}

/// Stage 3: spheres.
#[derive(Clone, Debug, PartialEq)]
pub struct Spheres {
    /// From the centre of the cell to that of the sphere, and the radius, in cells.
    pub spheres: Vec<(Vec3, f64)>,
}

/// Stage 3: cells with one solid.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidCells {
    /// Solid fraction and relaxation time.
    pub cells: Vec<(f64, f64)>,
}

/// Stage 3: cells with two solids.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedCells {
    /// Solid fractions of the two and relaxation time.
    pub cells: Vec<([f64; 2], f64)>,
}

/// Stage 4.
#[derive(Clone, Debug, PartialEq)]
pub struct Streaming {
    /// The domain and its faces.
    pub domain: Domain,
    /// Populations after the collision, cell by cell, x fastest.
    pub post: Vec<Populations>,
}

/// Stages 5, 7 and 8.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Box, collision, body force and solids.
    pub setup: Setup,
    /// Populations at the start, cell by cell, x fastest.
    pub populations: Vec<Populations>,
    /// Steps to make.
    pub steps: u64,
    /// What is asked afterwards.
    pub wanted: Vec<Wanted>,
    /// The viscosity is given instead of the relaxation time.
    pub viscosity_given: bool,
}

/// What is asked of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// `populations`, those before the next collision.
    Populations,
    /// `force` and `torque` on each solid in the last step.
    Loads,
    /// `velocity_profile`: `(j + G/2)/rho` along x in the cells of the column x = 0, z = 0.
    Profile,
    /// `viscosity`, from the decay of a wave `u_x = A sin(2 pi (y + 1/2)/n_y)`.
    ShearViscosity {
        /// Its amplitude at the start.
        amplitude: f64,
    },
    /// `drag`, the sum of the forces on all solids along x, and `mean_velocity`, the mean of
    /// `(j + G/2)/rho` along x over all cells.
    Drag,
}

/// What a candidate found at the end of a scene: what it leaves out counts as not attempted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneOutcome {
    /// Populations before the next collision, cell by cell, x fastest.
    pub populations: Option<Vec<Populations>>,
    /// `(j + G/2)/rho` of each cell.
    pub velocity: Option<Vec<Vec3>>,
    /// Force and torque of the fluid on each solid during the last step.
    pub loads: Option<Vec<Load>>,
}

impl Scene {
    /// The answers that are wanted, as far as `outcome` has them.
    pub fn answers(&self, outcome: &SceneOutcome) -> Answers {
        let mut answers = Answers::new();
        let cells = self.setup.domain.cells();
        for wanted in &self.wanted {
            let SceneOutcome { populations, velocity, loads } = outcome;
            match wanted {
                Wanted::Populations => {
                    if let Some(f) = populations {
                        answers = answers.with("populations", Array::populations(cells, f));
                    }
                }
                Wanted::Loads => {
                    if let Some(loads) = loads {
                        let list = |of: fn(&Load) -> Vec3| {
                            Array::vectors(&loads.iter().map(of).collect::<Vec<_>>())
                        };
                        answers = answers
                            .with("force", list(|load| load.force))
                            .with("torque", list(|load| load.torque));
                    }
                }
                Wanted::Profile => {
                    if let Some(u) = velocity {
                        let column = (0..cells[1]).map(|y| u[cells[0] * y].x).collect();
                        answers = answers.with("velocity_profile", Array::list(column));
                    }
                }
                Wanted::ShearViscosity { amplitude } => {
                    if let Some(u) = velocity {
                        let viscosity = self.decay(u, *amplitude);
                        answers = answers.with("viscosity", Array::number(viscosity));
                    }
                }
                Wanted::Drag => {
                    if let Some(loads) = loads {
                        let drag = loads.iter().map(|load| load.force.x).sum();
                        answers = answers.with("drag", Array::number(drag));
                    }
                    if let Some(u) = velocity {
                        let mean = u.iter().map(|u| u.x).sum::<f64>() / u.len() as f64;
                        answers = answers.with("mean_velocity", Array::number(mean));
                    }
                }
            }
        }
        answers
    }

    /// Viscosity of a shear wave that has decayed from `amplitude` to what `u` shows.
    fn decay(&self, u: &[Vec3], amplitude: f64) -> f64 {
        let (k, sines) = self.shear_wave();
        let sum: f64 = u.iter().zip(&sines).map(|(u, sine)| u.x * sine).sum();
        let now = sum * 2.0 / u.len() as f64;
        // u ~ exp(-ν k² t)
        -(now / amplitude).ln() / (k * k * self.steps as f64)
    }

    /// Wave number of a wave along y, and `sin(k (y + 1/2))` in each cell.
    pub fn shear_wave(&self) -> (f64, Vec<f64>) {
        let domain = &self.setup.domain;
        let k = std::f64::consts::TAU / domain.cells()[1] as f64;
        let sine = |cell| (k * domain.centre(domain.coordinates(cell)).y).sin();
        (k, (0..domain.cell_count()).map(sine).collect())
    }

    /// Cell updates that the scene takes.
    pub fn cell_updates(&self) -> u64 {
        self.steps * self.setup.domain.cell_count() as u64
    }
}

/// Stage 6.
#[derive(Clone, Debug, PartialEq)]
pub struct Contacts {
    /// Against a plane instead of a second sphere.
    pub plane: bool,
    /// The contacts.
    pub pairs: Vec<TouchingPair>,
}

/// A contact at one instant: springs stay as they are given, unless they slip.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchingPair {
    /// The law.
    pub law: ContactLaw,
    /// Radii; the second is 0 for a plane.
    pub radii: [f64; 2],
    /// From the first centre to the second, or to the nearest point of the plane.
    pub offset: Vec3,
    /// The two motions.
    pub motions: [Motion; 2],
    /// The springs.
    pub springs: ContactMemory,
}

impl TouchingPair {
    /// Where the two touch.
    pub fn geometry(&self, plane: bool) -> Geometry {
        if plane {
            let height = self.offset.norm();
            return Geometry::on_plane(height, &(-self.offset / height), self.radii[0]);
        }
        Geometry::of_spheres(&self.offset, self.radii)
    }
}

/// Stage 8: formulas and sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct Formulas {
    /// Reynolds numbers at which the drag coefficient of a sphere is asked.
    pub reynolds: Vec<f64>,
    /// Diameter (m), velocity (m/s) and kinematic viscosity (m²/s) of a settling grain.
    pub settling: [f64; 3],
    /// Number of spheres, their diameter in cells, porosity, and the two known sides of the bed in cells.
    pub bed: [f64; 5],
}

/// Directions as an array, `[19, 3]`.
pub fn direction_array(directions: &[[i32; 3]; Q]) -> Array {
    Array::new([Q, 3], directions.iter().flatten().map(|&c| f64::from(c)).collect())
}

/// The kit's directions as an array, `[19, 3]`.
pub fn kit_directions() -> Array {
    direction_array(&C)
}
