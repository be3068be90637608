//! What a sweep is asked to vary: keys with their values, all combinations of them, and what each run is called.

use std::collections::HashSet;

use toml_edit::{DocumentMut, Value};

use super::CommandError;
use crate::quote::shown;

/// More runs are refused: a value too many in each of several lists is a mistake.
const MOST_RUNS: usize = 10_000;

/// A folder's name may be so long; a run of a longer one is numbered instead.
const LONGEST_NAME: usize = 120;

/// A key and the values that it takes in turn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    pub key: String,
    pub values: Vec<String>,
}

impl Axis {
    /// From `key=value,value,...`. Values are those of a list in TOML, so that a vector is written in brackets; words may
    /// stand without quotation marks.
    pub fn parse(text: &str) -> Result<Self, CommandError> {
        let wrong = |problem: &str| {
            CommandError::Usage(format!(
                "--over {}: {problem}; write it as --over time.tau=0.55,0.6 or --over \
                 body_force.acceleration=[0.1,0,0],[0.2,0,0]",
                shown(text)
            ))
        };
        let (key, list) = text.split_once('=').ok_or_else(|| wrong("it has no `=`"))?;
        let key = key.trim();
        if key.is_empty() {
            return Err(wrong("it names no key"));
        }
        let document = format!("values = [{list}]").parse::<DocumentMut>().ok();
        let of_toml = document.as_ref().and_then(|document| document["values"].as_array());
        let values: Vec<String> = match of_toml {
            Some(values) => values.iter().map(written).collect(),
            None => list.split(',').map(|word| word.trim().to_owned()).collect(),
        };
        if values.is_empty() || values.iter().any(String::is_empty) {
            return Err(wrong("it lacks a value"));
        }
        let different: HashSet<&String> = values.iter().collect();
        if different.len() < values.len() {
            return Err(wrong("a value stands there twice"));
        }
        Ok(Axis { key: key.to_owned(), values })
    }
}

fn written(value: &Value) -> String {
    value.to_string().trim().to_owned()
}

/// A run of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Planned {
    /// Its folder's name.
    pub name: String,
    /// The values of the keys, in their order.
    pub values: Vec<String>,
}

impl Planned {
    /// The changes of the scene, as `--set` has them.
    pub fn changes(&self, axes: &[Axis]) -> Vec<String> {
        axes.iter().zip(&self.values).map(|(axis, value)| format!("{}={value}", axis.key)).collect()
    }
}

/// All combinations; the last key varies fastest. Errors if there are too many.
pub(super) fn combinations(axes: &[Axis]) -> Result<Vec<Planned>, CommandError> {
    let count =
        axes.iter().try_fold(1_usize, |product, axis| product.checked_mul(axis.values.len()));
    let count = count.filter(|&count| count <= MOST_RUNS).ok_or_else(|| {
        CommandError::Usage(format!(
            "--over: that would be more than {MOST_RUNS} runs; give fewer values, or several sweeps"
        ))
    })?;
    let mut all: Vec<Vec<String>> = vec![Vec::new()];
    for axis in axes {
        let with = |values: &Vec<String>| -> Vec<Vec<String>> {
            let one = |value: &String| [values.as_slice(), std::slice::from_ref(value)].concat();
            axis.values.iter().map(one).collect()
        };
        all = all.iter().flat_map(with).collect();
    }
    let names: Vec<String> = all.iter().map(|values| name(axes, values)).collect();
    let are_fit = names.iter().collect::<HashSet<_>>().len() == count
        && names.iter().all(|name| name.len() <= LONGEST_NAME);
    let named = |(number, values): (usize, Vec<String>)| Planned {
        name: if are_fit { names[number].clone() } else { format!("run_{:04}", number + 1) },
        values,
    };
    Ok(all.into_iter().enumerate().map(named).collect())
}

/// The keys and their values, without what is no part of a file's name everywhere.
fn name(axes: &[Axis], values: &[String]) -> String {
    let of = |(axis, value): (&Axis, &String)| {
        let kept = |c: char| if c.is_ascii_alphanumeric() || ".-+".contains(c) { c } else { '_' };
        let value: String = value.trim_matches('"').chars().map(kept).collect();
        let key: String = axis.key.chars().map(kept).collect();
        format!("{key}={value}")
    };
    axes.iter().zip(values).map(of).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_a_list_and_words_need_no_quotation_marks() {
        let values = |text: &str| Axis::parse(text).unwrap().values;
        assert_eq!(values("time.tau=0.55, 0.6"), ["0.55", "0.6"]);
        assert_eq!(values("a.b=[1,0,0],[2, 0, 0]"), ["[1,0,0]", "[2, 0, 0]"]);
        assert_eq!(values("collision.model=srt,mrt"), ["srt", "mrt"]);
        for wrong in ["time.tau", "=1,2", "time.tau=", "time.tau=1,1", "model=srt,,mrt"] {
            let error = Axis::parse(wrong).unwrap_err().to_string();
            assert!(error.contains("--over time.tau=0.55,0.6"), "{wrong}: {error}");
        }
    }

    #[test]
    fn all_combinations_have_names_of_their_own() {
        let axes =
            ["time.tau=0.55,0.6", "f.x=[1,0,0],[1_0_0]"].map(|text| Axis::parse(text).unwrap());
        let all = combinations(&axes).unwrap();
        assert_eq!(all.len(), 4);
        assert_eq!(all[1].changes(&axes), ["time.tau=0.55", "f.x=[1_0_0]"]);
        // Two would be called the same.
        assert_eq!(all[3].name, "run_0004");
        let all = combinations(&axes[..1]).unwrap();
        assert_eq!(all[1].name, "time.tau=0.6");
        let many: Vec<String> = (0..101).map(|number| number.to_string()).collect();
        let many = Axis { key: "k".to_owned(), values: many };
        assert!(combinations(&[many.clone(), many]).is_err());
    }
}
