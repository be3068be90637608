//! The text of a scene with a way of computing it put in.

use psmrt_reference::collision::Preset;
use std::path::Path;

use toml_edit::{DocumentMut, value};

use super::options::PlanOption;
use crate::advice::tradeoff::model::SolidMethod;
use crate::engine::EngineName;
use crate::scene::Scene;
use crate::scene::edit::{put_on_grid, scale_steps, section, set_tau};

/// The text of `scene` computed in this way, with `comment` above it; files that it names are looked for
/// in `folder`, in which the scene stood. Errors if the text cannot be read again, which a scene that was
/// loaded can.
pub fn text(
    scene: &Scene,
    folder: &Path,
    option: &PlanOption,
    comment: &str,
) -> Result<String, toml_edit::TomlError> {
    let mut document = scene.text.parse::<DocumentMut>()?;
    put_on_grid(&mut document, option.cells, option.si_dx);
    set_tau(&mut document, option.tau);
    document.remove("collision");
    match option.collision {
        Preset::DHumieres => {}
        Preset::Srt => {
            section(&mut document, "collision").insert("model", value("srt"));
        }
        Preset::Trt => {
            let collision = section(&mut document, "collision");
            collision.insert("rates", value("magic"));
            collision.insert("magic", value(3.0 / 16.0));
        }
    }
    if scene.setup.solid_phase.is_some() {
        // Named, so that the plan stays what it is whatever is chosen where no operator is named.
        let solid = section(&mut document, "solid");
        solid.insert("operator", value(option.solid.operator().word()));
        if option.solid == SolidMethod::Graded {
            solid.remove("weighting");
        }
    }
    let engine = section(&mut document, "engine");
    engine.insert("kind", value(option.engine.kind().word()));
    match option.engine {
        EngineName::CpuSingle => engine.insert("precision", value("single")),
        EngineName::Reference | EngineName::Cpu | EngineName::Wgpu => engine.remove("precision"),
    };
    // What is given in steps stays the same in seconds.
    let si_dt = (option.tau - 0.5) / 3.0 * option.si_dx * option.si_dx
        / (psmrt_reference::lattice::viscosity(scene.setup.collision.tau())
            * scene.units.si_viscosity());
    scale_steps(&mut document, scene.units.si_dt / si_dt);
    for copy in &scene.attachments {
        let Some(item) = crate::scene::find_mut(document.as_item_mut(), &copy.key) else {
            continue;
        };
        let file = folder.join(item.as_str().unwrap_or_default());
        let file = std::path::absolute(&file).unwrap_or(file);
        *item = value(file.display().to_string());
    }
    let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
    Ok(format!("{comment}\n{document}"))
}
