//! What a solver is set up with, and the checks that it makes sense.

use crate::collision::Collision;
use crate::coverage::{CoverageRule, SMALLEST_LINEAR_RADIUS};
use crate::domain::{Domain, DomainError};
use crate::guard::GuardSettings;
use crate::lattice::Vec3;
use crate::partial_saturation::{SolidOperator, Weighting};
use crate::rates::RateError;
use crate::solids::{Shape, Solid, SolidError};
use thiserror::Error;

/// The solids of a set-up and how they act on the fluid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SolidPhase {
    /// The solids.
    pub solids: Vec<Solid>,
    /// The weight `B` of a cell.
    pub weighting: Weighting,
    /// The collision in the solid part of a cell.
    pub operator: SolidOperator,
    /// How the solid fraction of a sphere is found.
    pub coverage: CoverageRule,
}

/// Everything a solver needs, in lattice units. What is `None` costs nothing. The body force and the values of the
/// faces are those of now: [`Self::set_drive`] changes them.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The domain and its faces.
    pub domain: Domain,
    /// The fluid's collision.
    pub collision: Collision,
    /// Force per volume on the fluid; it acts with weight `1 - B` where there is solid.
    pub body_force: Option<Vec3>,
    /// The solids, if there are any.
    pub solid_phase: Option<SolidPhase>,
    /// When to look for trouble and what counts as trouble.
    pub guard: GuardSettings,
}

/// A set-up that cannot be run.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SetupError {
    /// The domain or its faces.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The collision's rates.
    #[error(transparent)]
    Rates(#[from] RateError),
    /// A solid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A body force that is not finite.
    #[error("body force = {value:?}: each component must be finite")]
    BodyForce {
        /// The force as given.
        value: [f64; 3],
    },
    /// Sub-sampling with no points.
    #[error("coverage sampling with n = 0 points: take n from 1 up, or the exact rule")]
    NoSamples,
    /// An operator and a weight that do not go together.
    #[error(
        "the solid operator of graded viscosity has a weight of its own, which no other operator has: take both or neither"
    )]
    GradedWeight,
    /// A sphere too small for the linear rule.
    #[error(
        "the linear rule of coverage is meant for spheres of a radius of at least {SMALLEST_LINEAR_RADIUS} cell; solid \
         {solid} has {radius}: refine the grid, or take the exact rule"
    )]
    TooSmallForLinear {
        /// The number of the solid.
        solid: usize,
        /// Its radius in cells.
        radius: f64,
    },
}

impl Setup {
    /// A fluid alone: no body force, no solids.
    pub fn fluid(domain: Domain, collision: Collision) -> Self {
        Setup {
            domain,
            collision,
            body_force: None,
            solid_phase: None,
            guard: GuardSettings::default(),
        }
    }

    /// The same with a body force.
    #[must_use]
    pub fn with_body_force(self, body_force: Vec3) -> Self {
        Setup { body_force: Some(body_force), ..self }
    }

    /// The same with solids.
    #[must_use]
    pub fn with_solids(self, solid_phase: SolidPhase) -> Self {
        Setup { solid_phase: Some(solid_phase), ..self }
    }

    /// Errors if any part cannot be run.
    pub fn check(&self) -> Result<(), SetupError> {
        self.collision.checked()?;
        if let Some(g) = &self.body_force {
            check_body_force(g)?;
        }
        if let Some(phase) = &self.solid_phase {
            for (number, solid) in phase.solids.iter().enumerate() {
                solid.check(number, self.domain.cell_count())?;
            }
            let has_graded_weight = phase.weighting == Weighting::Graded;
            if has_graded_weight != (phase.operator == SolidOperator::GradedViscosity) {
                return Err(SetupError::GradedWeight);
            }
            check_coverage(phase)?;
        }
        Ok(())
    }
}

/// Errors unless the rule of coverage is meant for these solids.
fn check_coverage(phase: &SolidPhase) -> Result<(), SetupError> {
    match phase.coverage {
        CoverageRule::Exact | CoverageRule::Sampled { n: 1.. } => Ok(()),
        CoverageRule::Sampled { n: 0 } => Err(SetupError::NoSamples),
        CoverageRule::Linear => {
            for (solid, Solid { shape, .. }) in phase.solids.iter().enumerate() {
                match shape {
                    &Shape::Sphere { radius } if radius < SMALLEST_LINEAR_RADIUS => {
                        return Err(SetupError::TooSmallForLinear { solid, radius });
                    }
                    Shape::Sphere { .. } | Shape::Cells { .. } => {}
                }
            }
            Ok(())
        }
    }
}

/// Errors unless every component is finite.
pub(crate) fn check_body_force(g: &Vec3) -> Result<(), SetupError> {
    if g.iter().all(|value| value.is_finite()) {
        return Ok(());
    }
    Err(SetupError::BodyForce { value: (*g).into() })
}
