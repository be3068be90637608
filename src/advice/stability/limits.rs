//! What the maps say in a line each: how fast a flow may be. The warnings of `psmrt check` and the report
//! take it from here.

use std::sync::OnceLock;

use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::coupling::InternalFluid;
use psmrt_reference::partial_saturation::Weighting;

use super::Outcome;
use crate::table::{Table, TableError};

/// The maps that the warnings rest on, as they are committed.
const SHEAR_LAYER: &str = include_str!("../../../golden/stability/shear_layer.csv");
const BED: &str = include_str!("../../../golden/stability/bed_force.csv");
const MOVERS: &str = include_str!("../../../golden/stability/movers.csv");

/// Columns that a line of a map has alike.
const LINE: [&str; 5] = ["engine", "collision", "weight", "variant", "tau"];

/// How far a line goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Frontier {
    /// Engine, collision, weight and variant, as the map spells them.
    pub line: [String; 4],
    /// Relaxation time.
    pub tau: f64,
    /// Largest value below which all runs live; `None` if none does.
    pub lives: Option<f64>,
    /// Largest value up to which no run is wrong; `None` if the smallest is.
    pub right: Option<f64>,
    /// Reynolds number that the run at `lives` has reached, if the map has it.
    pub reynolds: Option<f64>,
    /// Smallest value whose run was stopped; `None` if none was.
    pub stopped: Option<f64>,
}

/// The frontiers of a map. Errors if it is none.
pub fn frontiers(map: &Table) -> Result<Vec<Frontier>, TableError> {
    let number = |name: &str| {
        let found = map.columns.iter().position(|column| column == name);
        found.ok_or_else(|| TableError(format!("a map of stability has no column {name:?}")))
    };
    let line: Vec<usize> = LINE.into_iter().map(number).collect::<Result<_, _>>()?;
    let [value, outcome, reynolds] = [number("value")?, number("outcome")?, number("reynolds")?];
    let key = |row: &Vec<String>| -> Vec<String> { line.iter().map(|&i| row[i].clone()).collect() };
    let mut keys: Vec<Vec<String>> = Vec::new();
    for row in &map.rows {
        if !keys.contains(&key(row)) {
            keys.push(key(row));
        }
    }
    let real = |text: &str| {
        let wrong = || TableError(format!("a map of stability holds {text:?}"));
        text.parse::<f64>().map_err(|_| wrong())
    };
    keys.into_iter()
        .map(|line| {
            let rows = map.rows.iter().filter(|row| key(row) == line);
            let mut runs = rows
                .map(|row| {
                    let word = &row[outcome];
                    let wrong = || TableError(format!("no outcome is called {word:?}"));
                    let outcome = Outcome::of(word).ok_or_else(wrong)?;
                    Ok((real(&row[value])?, outcome, row[reynolds].parse().ok()))
                })
                .collect::<Result<Vec<(f64, Outcome, Option<f64>)>, TableError>>()?;
            runs.sort_by(|a, b| a.0.total_cmp(&b.0));
            let alive = || runs.iter().take_while(|run| run.1.lived());
            let sound = || alive().take_while(|run| run.1 != Outcome::Wrong);
            let tau = real(&line[4])?;
            let [engine, collision, weight, variant, _] = <[String; 5]>::try_from(line)
                .map_err(|_| TableError("a line has five keys".to_owned()))?;
            Ok(Frontier {
                line: [engine, collision, weight, variant],
                tau,
                lives: alive().last().map(|run| run.0),
                right: sound().last().map(|run| run.0),
                reynolds: alive().last().and_then(|run| run.2),
                stopped: runs.iter().find(|run| !run.1.lived()).map(|run| run.0),
            })
        })
        .collect()
}

/// A flow that the warnings compare a scene with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measured {
    /// A fluid alone: the shear layer.
    Fluid,
    /// A dense bed with this weight: the ordered bed; the velocity is the superficial one.
    Bed(Weighting),
}

/// How fast a flow may be, cells per step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Largest velocity that survived.
    pub lives: f64,
    /// Largest velocity that was not wrong; `None` if all were, or if accuracy was not judged by
    /// velocity.
    pub right: Option<f64>,
}

impl Limit {
    /// The largest velocity that survives and that the map does not call wrong. Where it calls all wrong
    /// (beds at large tau, on its own grid of 13 cells per diameter), velocity is not what is wrong.
    pub fn most(&self) -> f64 {
        self.right.map_or(self.lives, |right| right.min(self.lives))
    }
}

impl Measured {
    /// What the map says of a collision: the smaller of the limits at the measured relaxation times on
    /// either side. `None` where nothing was measured: rates of one's own, tau beyond the map.
    pub fn limit(self, collision: &Collision) -> Option<Limit> {
        self.limit_of(Preset::of(collision)?, collision.tau())
    }

    /// The same of a model.
    pub fn limit_of(self, model: Preset, tau: f64) -> Option<Limit> {
        // Plans ask for them again and again.
        static FLUID: OnceLock<Vec<Frontier>> = OnceLock::new();
        static BEDS: OnceLock<Vec<Frontier>> = OnceLock::new();
        let (known, text, weight) = match self {
            Measured::Fluid => (&FLUID, SHEAR_LAYER, "none"),
            Measured::Bed(Weighting::NobleTorczynski) => (&BEDS, BED, "NT"),
            Measured::Bed(Weighting::SolidFraction) => (&BEDS, BED, "eps"),
        };
        let read = || Table::parse("golden/stability", text).and_then(|map| frontiers(&map));
        let all = known.get_or_init(|| read().unwrap_or_default());
        let mut own: Vec<&Frontier> = all
            .iter()
            .filter(|one| one.line[0] == "reference" && one.line[1] == model.word())
            .filter(|one| one.line[2] == weight)
            .collect();
        own.sort_by(|a, b| a.tau.total_cmp(&b.tau));
        let above = own.iter().position(|one| one.tau >= tau)?;
        let is_measured = own[above].tau - tau < 1e-9;
        let around = &own[if is_measured { above } else { above.saturating_sub(1) }..=above];
        let lives = around.iter().filter_map(|one| one.lives).fold(f64::INFINITY, f64::min);
        let right = around.iter().map(|one| one.right.unwrap_or(0.0)).fold(f64::INFINITY, f64::min);
        lives.is_finite().then_some(Limit { lives, right: Some(right).filter(|&u| u > 0.0) })
    }
}

/// How light a free grain may be.
#[derive(Clone, Debug, PartialEq)]
struct Lightest {
    variant: String,
    tau: f64,
    /// Smallest density over that of the fluid down to which all were right; `None` if the heaviest was not.
    ratio: Option<f64>,
}

/// What the map of free grains says, by relaxation time. Plans ask for it thousands of times.
fn movers() -> &'static [Lightest] {
    static ALL: OnceLock<Vec<Lightest>> = OnceLock::new();
    ALL.get_or_init(|| {
        let table = Table::parse("golden/stability/movers.csv", MOVERS);
        let own =
            table.and_then(|table| table.with(&[("engine", "reference")])).unwrap_or_default();
        let [variant, tau, value, outcome] = [3, 4, 5, 6];
        let real = |row: &[String], column: usize| row[column].parse().unwrap_or(f64::NAN);
        let mut all: Vec<Lightest> = Vec::new();
        for row in &own.rows {
            let is_known =
                |one: &Lightest| one.variant == row[variant] && one.tau == real(row, tau);
            if all.iter().any(is_known) {
                continue;
            }
            let line = own.rows.iter().filter(|o| o[variant] == row[variant] && o[tau] == row[tau]);
            let mut runs: Vec<(f64, &str)> =
                line.map(|other| (real(other, value), other[outcome].as_str())).collect();
            runs.sort_by(|a, b| b.0.total_cmp(&a.0));
            let right = runs.iter().take_while(|run| run.1 == Outcome::Right.word());
            let (variant, tau) = (row[variant].clone(), real(row, tau));
            all.push(Lightest { variant, tau, ratio: right.last().map(|run| run.0) });
        }
        all.sort_by(|a, b| a.tau.total_cmp(&b.tau));
        all
    })
}

/// The smallest density of a free grain, over that of the fluid, down to which all were right at the measured
/// relaxation times on either side. `None` beyond the map.
pub fn lightest(inside: InternalFluid, tau: f64) -> Option<f64> {
    let variant = match inside {
        InternalFluid::Lagged => "lagged",
        InternalFluid::Kept => "kept",
    };
    let own: Vec<&Lightest> = movers().iter().filter(|one| one.variant == variant).collect();
    let above = own.iter().position(|one| one.tau >= tau - 1e-9)?;
    let is_measured = (own[above].tau - tau).abs() < 1e-9;
    let below = if is_measured { above } else { above.checked_sub(1)? };
    Some(own[below].ratio?.max(own[above].ratio?))
}

/// The relaxation times of that map.
pub fn taus_of_movers() -> Vec<f64> {
    let mut taus: Vec<f64> = movers().iter().map(|one| one.tau).collect();
    taus.dedup();
    taus
}
