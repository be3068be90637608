//! `psmrt info` and `psmrt schema`: what this program is, what it runs on, what scenes may hold.

use serde_json::{Value, json};

use super::say::say;
use crate::engine::EngineName;
use crate::kernel::{AdapterFacts, adapters};
use crate::{machine, provenance};

/// The program: version, commit and whether the sources had been changed since, compiler's target.
pub(super) fn program() -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "commit": provenance::COMMIT,
        "modified": provenance::sources_changed(),
        "target": format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
        "debug_assertions": cfg!(debug_assertions),
    })
}

/// The machine: processor, threads, memory.
pub(super) fn machine() -> Value {
    json!({
        "processor": machine::processor(),
        "threads": machine::threads(),
        "memory_bytes": machine::memory_bytes(),
    })
}

/// Prints it.
pub fn info(json: bool) {
    let (program, machine) = (program(), machine());
    let engines =
        EngineName::ALL.map(|engine| json!({ "name": engine.word(), "what": engine.about() }));
    let engines = json!(engines);
    let adapters = adapters();
    if json {
        let adapters: Vec<Value> = adapters.iter().map(adapter_facts).collect();
        let all = json!({
            "program": program, "machine": machine, "engines": engines, "adapters": adapters,
        });
        say(&all.to_string());
        return;
    }
    let text = |value: &Value| match value {
        Value::String(text) => text.clone(),
        Value::Null => "unknown".to_owned(),
        other => other.to_string(),
    };
    say(&format!("psmrt      {}", text(&program["version"])));
    let modified = match program["modified"].as_bool() {
        Some(true) => " and changes that are not committed",
        _ => "",
    };
    say(&format!("commit     {}{modified}", text(&program["commit"])));
    say(&format!("target     {}", text(&program["target"])));
    say(&format!("processor  {}", text(&machine["processor"])));
    say(&format!("threads    {}", text(&machine["threads"])));
    say(&format!("memory     {}", machine::memory_words()));
    for (number, engine) in EngineName::ALL.into_iter().enumerate() {
        let title = if number == 0 { "engines" } else { "" };
        say(&format!("{title:<11}{} ({})", engine.word(), engine.about()));
    }
    if adapters.is_empty() {
        say("adapters   none: a Vulkan, Metal or DX12 driver is needed, or Mesa's software Vulkan");
    }
    for (number, adapter) in adapters.iter().enumerate() {
        say(&format!(
            "{}{} ({}, {}; {}); largest binding {} MiB, {} bindings",
            if number == 0 { "adapters   " } else { "           " },
            adapter.name,
            adapter.kind,
            adapter.backend,
            adapter.driver,
            adapter.max_binding_bytes >> 20,
            adapter.max_bindings,
        ));
    }
}

/// An adapter for scripts.
fn adapter_facts(adapter: &AdapterFacts) -> Value {
    json!({
        "name": adapter.name,
        "kind": adapter.kind,
        "backend": adapter.backend,
        "driver": adapter.driver,
        "max_buffer_bytes": adapter.max_buffer_bytes,
        "max_binding_bytes": adapter.max_binding_bytes,
        "max_bindings": adapter.max_bindings,
    })
}

/// Prints the JSON schema of scene files, or the reference for people.
pub fn schema(markdown: bool) {
    if markdown {
        say(super::scene_reference::reference().trim_end());
    } else {
        say(&format!("{:#}", crate::scene::schema::schema()));
    }
}
