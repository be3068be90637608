//! What the maps say in a line each: how fast a flow may be, and how light a free grain.

use super::Outcome;
use psmrt::table::{Table, TableError};

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

/// How light a free grain may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Lightest {
    /// What becomes of the fluid inside, as the map spells it.
    pub variant: String,
    /// Relaxation time.
    pub tau: f64,
    /// Smallest density over that of the fluid down to which all were right; `None` if the heaviest was not.
    pub ratio: Option<f64>,
}

/// What the map of free grains says of the oracle, by relaxation time. Errors if it is no such map.
pub fn lightest(map: &Table) -> Result<Vec<Lightest>, TableError> {
    let own = map.with(&[("engine", "reference")])?;
    let [variant, tau, value, outcome] = [3, 4, 5, 6];
    let real = |row: &[String], column: usize| row[column].parse().unwrap_or(f64::NAN);
    let mut all: Vec<Lightest> = Vec::new();
    for row in &own.rows {
        let is_known = |one: &Lightest| one.variant == row[variant] && one.tau == real(row, tau);
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
    Ok(all)
}
