//! What one parameter alone does: runs beside the run that differs in nothing else and has the default.

use crate::tradeoff::parameters::{Flow, Parameters, Storage};
use crate::tradeoff::row::Row;
use psmrt::table::Table;
use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;

/// A parameter, turned.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Which parameter, and to what.
    pub what: String,
    /// The flow.
    pub flow: Flow,
    /// Errors with it and with the default, in the order of the rows.
    pub pairs: Vec<[f64; 2]>,
}

impl Effect {
    /// The middle of the ratios of the errors' sizes.
    pub fn median_ratio(&self) -> f64 {
        let mut ratios: Vec<f64> = self.pairs.iter().map(|[a, b]| (a / b).abs()).collect();
        ratios.sort_by(f64::total_cmp);
        let half = ratios.len() / 2;
        let middle = [ratios.get(half), ratios.get(ratios.len().saturating_sub(half + 1))];
        middle.iter().map(|value| value.copied().unwrap_or(f64::NAN)).sum::<f64>() / 2.0
    }

    /// The largest difference of the errors.
    pub fn largest_difference(&self) -> f64 {
        self.pairs.iter().map(|[a, b]| (a - b).abs()).fold(0.0, f64::max)
    }
}

/// The effects of all parameters in a sweep, flow by flow.
pub fn effects(rows: &[Row]) -> Vec<Effect> {
    let mut effects: Vec<Effect> = Vec::new();
    for row in rows {
        let Some((what, default)) = turned(&row.parameters) else { continue };
        let partner = rows.iter().find(|other| other.parameters == default);
        let (Some(error), Some(usual)) = (row.error, partner.and_then(|other| other.error)) else {
            continue;
        };
        let flow = row.parameters.flow;
        match effects.iter_mut().find(|effect| effect.flow == flow && effect.what == what) {
            Some(effect) => effect.pairs.push([error, usual]),
            None => effects.push(Effect { what, flow, pairs: vec![[error, usual]] }),
        }
    }
    effects
}

/// The one parameter that is not at its default, and the parameters with it at its default; the storage of the
/// kernel is its own default. `None` if none is turned.
fn turned(parameters: &Parameters) -> Option<(String, Parameters)> {
    let mut default = parameters.clone();
    let what = if parameters.engine == "wgpu" {
        default.engine = "reference".to_owned();
        default.storage = Storage::F64;
        "engine wgpu (f32 shifted)".to_owned()
    } else if parameters.storage != Storage::F64 {
        default.storage = Storage::F64;
        let speed = if parameters.lattice_velocity < 5e-4 { "u < 5e-4" } else { "u >= 1e-3" };
        format!("storage {} ({speed})", parameters.storage.word())
    } else if parameters.weight != "NT" {
        default.weight = "NT".to_owned();
        "weight B = eps".to_owned()
    } else if parameters.operator != "bounce_back" {
        default.operator = "bounce_back".to_owned();
        "operator superposition".to_owned()
    } else if let CoverageRule::Sampled { n } = parameters.coverage {
        default.coverage = CoverageRule::Exact;
        format!("coverage sampled {n} x {n} x {n}")
    } else if parameters.coverage == CoverageRule::Linear {
        default.coverage = CoverageRule::Exact;
        "coverage linear".to_owned()
    } else if parameters.collision != Preset::DHumieres {
        default.collision = Preset::DHumieres;
        format!("collision {}", parameters.collision.title())
    } else {
        return None;
    };
    Some((what, default))
}

/// The effects as rows.
pub fn to_table(effects: &[Effect]) -> Table {
    let columns = ["case", "knob", "pairs", "median_ratio_of_errors", "largest_difference"];
    let mut table = Table::new(&columns);
    for effect in effects {
        table.add(vec![
            effect.flow.word().to_owned(),
            effect.what.clone(),
            effect.pairs.len().to_string(),
            format!("{:.3}", effect.median_ratio()),
            format!("{:.2e}", effect.largest_difference()),
        ]);
    }
    table
}
