//! Remedies remedy: what a message says to write, written, gets past that message. And numbers beyond
//! all proportion are refused before they become scales.

use std::path::Path;

use crate::bad_scenes::{BAD, GOOD};
use psmrt::scene::{Scene, SceneError};
use toml_edit::{DocumentMut, Item, Value};

fn load(text: &str, changes: &[String]) -> Result<Scene, Box<SceneError>> {
    Scene::from_bytes("scene.toml", text.as_bytes().to_vec(), Path::new(""), changes)
}

/// What a remedy says to write as `key = value`.
fn assignments(remedy: &str) -> impl Iterator<Item = (String, String)> {
    remedy.split('`').skip(1).step_by(2).filter_map(|code| {
        let (key, value) = code.split_once(" = ")?;
        let is_key = key.chars().all(|c| c.is_ascii_alphanumeric() || "._[]".contains(c));
        (is_key && value.parse::<Value>().is_ok()).then(|| (key.to_owned(), value.to_owned()))
    })
}

/// The sections that a scene may have.
fn is_section(name: &str) -> bool {
    let name = name.split('[').next().unwrap_or(name);
    psmrt::scene::schema::schema()["properties"].get(name).is_some()
}

/// The text without a key, or nothing changed if there is no such key.
fn without(text: &str, key: &str) -> String {
    let Ok(mut document) = text.parse::<DocumentMut>() else { return text.to_owned() };
    let mut item: &mut Item = document.as_item_mut();
    let steps: Vec<&str> = key.split(['.', '[', ']']).filter(|step| !step.is_empty()).collect();
    let Some((last, parents)) = steps.split_last() else { return text.to_owned() };
    for step in parents {
        let inner = match step.parse::<usize>() {
            Ok(number) => item.get_mut(number),
            Err(_) => item.get_mut(*step),
        };
        let Some(inner) = inner else { return text.to_owned() };
        item = inner;
    }
    if let Some(table) = item.as_table_like_mut() {
        table.remove(last);
    }
    document.to_string()
}

/// The outcome with `key = value` written as the message about `error` says.
fn remedied(
    text: &str,
    error: &SceneError,
    key: &str,
    value: &str,
) -> Result<Scene, Box<SceneError>> {
    let parent = error.key.rsplit_once('.').map_or("", |(parent, _)| parent);
    let (path, text) = if is_section(key.split('.').next().unwrap_or(key)) && key.contains('.') {
        (key.to_owned(), text.to_owned())
    } else {
        let missing = error.problem.contains("missing") || error.problem.contains("only once");
        let parent = if error.problem.contains("nothing says") { &error.key } else { parent };
        let text = if missing { text.to_owned() } else { without(text, &error.key) };
        (if parent.is_empty() { key.to_owned() } else { format!("{parent}.{key}") }, text)
    };
    // "Instead of what sets it now".
    let others = ["time.dt", "time.tau", "time.lattice_velocity", "time.reference_velocity"];
    let text = match path.as_str() {
        "time.dt" => others.iter().fold(text, |text, other| without(&text, other)),
        _ => text,
    };
    load(&text, &[format!("{path}={value}")])
}

#[test]
fn what_a_message_says_to_write_gets_past_that_message() {
    let mut tried = 0;
    let mut wrong = Vec::new();
    for bad in BAD {
        let text = bad.text();
        let Err(error) = load(&text, &[]) else { panic!("{} is right", bad.1) };
        for (key, value) in assignments(&error.remedy) {
            tried += 1;
            if let Err(again) = remedied(&text, &error, &key, &value)
                && (&again.key, &again.problem) == (&error.key, &error.problem)
            {
                wrong.push(format!("{key} = {value}:\n{error}\n{again}"));
            }
        }
        // Sections to paste.
        if let Some((_, section)) = error.remedy.split_once("for example\n") {
            tried += 1;
            let name = section.lines().next().unwrap_or("").trim_matches(['[', ']']);
            let text = format!("{}\n{section}\n", without(&text, name));
            if let Err(again) = load(&text, &[])
                && (&again.key, &again.problem) == (&error.key, &error.problem)
            {
                wrong.push(format!("{section}:\n{error}\n{again}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(tried >= 40, "only {tried} remedies were tried: has their form changed?");
}

#[test]
fn a_grid_of_scales_within_the_limits_is_numbers_throughout() {
    // The corners of what is allowed. Each scale is a product of powers of these three and tau, so
    // that it is largest and smallest in a corner.
    for dx in ["1e-12", "1e6"] {
        for viscosity in ["1e-15", "1e15"] {
            for density in ["1e-6", "1e9"] {
                for tau in ["0.5000000001", "1e4"] {
                    let text = format!(
                        "[domain]\ncells = [4, 4, 4]\ndx = {dx}\n[fluid]\ndensity = {density}\n\
                         kinematic_viscosity = {viscosity}\n[time]\ntau = {tau}\n[stop]\nsteps = 3\n"
                    );
                    let scene = load(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
                    let scales = scene.units.si_all();
                    assert!(scales.iter().all(|scale| scale.is_normal()), "{text}{scales:?}");
                    assert!(scene.units.si_dt.is_normal(), "{text}");
                }
            }
        }
    }
}

#[test]
fn what_is_just_above_a_limit_is_shown_above_it() {
    // 0.2000001 cells per time step: dx/dt = 1 m/s, so that 0.2 would be the limit in m/s.
    let at = |speed: &str| {
        let changes = [
            "time={dt=2.5e-5}",
            "body_force.acceleration=[0.0,0.0,0.0]",
            "gravity.acceleration=[0.0,0.0,0.0]",
            "contact={}",
            &format!("initial.velocity=[{speed},0.0,0.0]"),
        ];
        load(GOOD, &changes.map(String::from))
    };
    let error = at("0.2000001").unwrap_err();
    assert_eq!(error.key, "initial.velocity");
    assert!(error.problem.contains("0.2000001 cells"), "{error}");
    if let Err(error) = at("0.1999999") {
        assert_ne!(error.key, "initial.velocity", "{error}");
    }
}
