//! All error models together: which one speaks of a scene.

use std::sync::OnceLock;

use psmrt_reference::collision::Preset;

use super::model::{
    Evidence, GrainModel, LEAST_TAU, METHODS, Prediction, SolidMethod, WallModel, method,
};
use super::model_eps::EpsModel;
use super::model_low::LowModel;
use super::model_tight::{TIGHT, TightModel};
use crate::advice::coefficients::numbers;
use crate::table::TableError;

/// All models that the evidence supports.
#[derive(Clone, Debug, PartialEq)]
pub struct Models {
    /// With grains, one a collision, and one with the superposition operator.
    pub grains: Vec<GrainModel>,
    /// With grains and the weight `B = ε`.
    pub eps: Option<EpsModel>,
    /// With grains, d'Humières' rates and relaxation times below those of `grains`.
    pub low: Option<LowModel>,
    /// With grains and operators that let no fluid through.
    pub tight: Vec<TightModel>,
    /// Between plates; none for the magic rates, which are exact there.
    pub walls: Vec<WallModel>,
}

impl Models {
    /// Those of `coefficients.csv`, read once.
    pub fn committed() -> Result<&'static Self, TableError> {
        static MODELS: OnceLock<Models> = OnceLock::new();
        if let Some(models) = MODELS.get() {
            return Ok(models);
        }
        let mut models = Models {
            grains: Vec::new(),
            eps: None,
            low: None,
            tight: Vec::new(),
            walls: Vec::new(),
        };
        for (collision, solid) in METHODS {
            let of = method(collision, solid);
            let (parameters, evidence) = (numbers("grains", &of)?, Evidence::committed(&of)?);
            models.grains.push(GrainModel { collision, solid, parameters, evidence });
        }
        models.eps = Some(EpsModel::committed()?);
        models.low = Some(LowModel::committed()?);
        for (collision, solid) in TIGHT {
            models.tight.push(TightModel::committed(collision, solid)?);
        }
        for collision in [Preset::Srt, Preset::DHumieres] {
            let [s, c, scatter, count] = numbers("plates", collision.word())?;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small count"
            )]
            let count = count as usize;
            models.walls.push(WallModel { collision, parameters: [s, c], scatter, count });
        }
        Ok(MODELS.get_or_init(|| models))
    }

    /// The model with grains of a collision of the fluid and of solid cells.
    pub fn of_grains(&self, collision: Preset, solid: SolidMethod) -> Option<&GrainModel> {
        self.grains.iter().find(|model| model.collision == collision && model.solid == solid)
    }

    /// The model with grains of a collision of the fluid and an operator that lets no fluid through.
    pub fn of_tight(&self, collision: Preset, solid: SolidMethod) -> Option<&TightModel> {
        self.tight.iter().find(|model| model.collision == collision && model.solid == solid)
    }

    /// The error with grains; `None` where nothing was fitted.
    pub fn with_grains(
        &self,
        (collision, solid): (Preset, SolidMethod),
        d: f64,
        tau: f64,
        drag: f64,
    ) -> Option<Prediction> {
        if solid == SolidMethod::SolidFraction {
            let model = self.eps.as_ref().filter(|_| collision == Preset::DHumieres)?;
            return Some(model.prediction(d, tau, drag));
        }
        if matches!(solid, SolidMethod::Graded | SolidMethod::FullBounceBack) {
            return Some(self.of_tight(collision, solid)?.prediction(d, tau, drag));
        }
        let model = self.of_grains(collision, solid)?;
        let low = self
            .low
            .as_ref()
            .filter(|_| collision == Preset::DHumieres && solid == SolidMethod::Usual);
        if let Some(low) = low.filter(|_| tau < LEAST_TAU) {
            return Some(low.prediction(model, d, tau, drag));
        }
        let error = model.error(d, tau, drag);
        let band = [error / model.band(), error * model.band()];
        let ranges = model.evidence.ranges;
        let lowest = low.map_or(ranges[1][0], |low| low.evidence.ranges[1][0]);
        Some(Prediction { error, band, ranges: [ranges[0], [lowest, ranges[1][1]]] })
    }

    /// The model between plates of a collision.
    pub fn of_walls(&self, collision: Preset) -> Option<&WallModel> {
        self.walls.iter().find(|model| model.collision == collision)
    }
}
