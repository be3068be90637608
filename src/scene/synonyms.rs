//! Words of neighbouring codes and textbooks for what scenes call otherwise.

/// Keys: another name, and psmrt's.
const KEYS: [(&str, &str); 33] = [
    ("nu", "kinematic_viscosity"),
    ("rho", "density"),
    ("delta_x", "dx"),
    ("spacing", "dx"),
    ("cell_size", "dx"),
    ("resolution", "cells"),
    ("delta_t", "dt"),
    ("time_step", "dt"),
    ("timestep", "dt"),
    ("relaxation_time", "tau"),
    ("center", "centre"),
    ("position", "centre"),
    ("angular_velocity", "spin"),
    ("omega", "spin"),
    ("force", "acceleration"),
    ("type", "kind"),
    ("interval", "every"),
    ("max_steps", "steps"),
    ("end_time", "time"),
    ("lambda", "magic"),
    ("young", "youngs_modulus"),
    ("young_modulus", "youngs_modulus"),
    ("elastic_modulus", "youngs_modulus"),
    ("poisson", "poisson_ratio"),
    ("poissons_ratio", "poisson_ratio"),
    ("coefficient_of_restitution", "restitution"),
    ("nonreflecting", "non_reflecting"),
    ("non_reflective", "non_reflecting"),
    ("absorbing", "non_reflecting"),
    ("characteristic", "non_reflecting"),
    ("wave_transmissive", "non_reflecting"),
    ("sponge", "non_reflecting"),
    ("memory_time", "memory"),
];

/// Words: another name, and psmrt's, several where they have to be told apart.
const WORDS: [(&str, &[&str]); 70] = [
    // Faces.
    ("no_slip", &["wall"]),
    ("noslip", &["wall"]),
    ("bounce_back", &["wall"]),
    ("bounceback", &["wall"]),
    ("solid", &["wall"]),
    ("moving_wall", &["wall"]),
    ("slip", &["free_slip"]),
    ("freeslip", &["free_slip"]),
    ("full_slip", &["free_slip"]),
    ("symmetry", &["free_slip"]),
    ("symmetric", &["free_slip"]),
    ("mirror", &["free_slip"]),
    ("specular", &["free_slip"]),
    ("inlet", &["velocity_inlet", "pressure"]),
    ("inflow", &["velocity_inlet"]),
    ("velocity", &["velocity_inlet"]),
    ("fixed_velocity", &["velocity_inlet"]),
    ("pressure_inlet", &["pressure"]),
    ("outlet", &["pressure", "free_outflow"]),
    ("pressure_outlet", &["pressure"]),
    ("fixed_pressure", &["pressure"]),
    ("outflow", &["free_outflow"]),
    ("zero_gradient", &["free_outflow"]),
    ("neumann", &["free_outflow"]),
    ("open", &["free_outflow"]),
    ("dirichlet", &["velocity_inlet", "pressure"]),
    ("cyclic", &["periodic"]),
    // The collision.
    ("bgk", &["srt"]),
    ("lbgk", &["srt"]),
    ("trt", &["mrt", "magic"]),
    ("default", &["dhumieres"]),
    // Grains.
    ("list", &["csv"]),
    ("file", &["csv"]),
    ("lattice", &["array"]),
    ("packed", &["bed", "random"]),
    ("packing", &["bed", "random"]),
    ("suspension", &["random"]),
    ("simple_cubic", &["sc"]),
    ("body_centred", &["bcc"]),
    ("body_centered", &["bcc"]),
    ("face_centred", &["fcc"]),
    ("face_centered", &["fcc"]),
    ("held", &["fixed"]),
    ("static", &["fixed"]),
    ("towed", &["prescribed"]),
    ("imposed", &["prescribed"]),
    ("moving", &["free", "prescribed"]),
    ("mobile", &["free"]),
    ("linear", &["solid_fraction"]),
    ("nt", &["noble_torczynski"]),
    // Delimiters.
    (",", &["comma"]),
    (";", &["semicolon"]),
    ("space", &["blanks"]),
    ("spaces", &["blanks"]),
    ("whitespace", &["blanks"]),
    ("tabulator", &["tab"]),
    // Records.
    ("mean", &["box"]),
    ("means", &["box"]),
    ("line", &["profile"]),
    ("force", &["loads"]),
    ("forces", &["loads"]),
    ("picture", &["slice"]),
    ("image", &["slice"]),
    ("vtk", &["vti", "fields"]),
    ("numpy", &["npy"]),
    // Engines.
    ("native", &["cpu"]),
    ("oracle", &["reference"]),
    ("gpu", &["wgpu"]),
    ("cuda", &["wgpu"]),
    ("vulkan", &["wgpu"]),
];

fn plain(name: &str) -> String {
    name.trim().to_lowercase().replace(['-', ' '], "_")
}

/// psmrt's key for `name`, if it is among the `known`.
pub(super) fn key_of<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let name = plain(name);
    let target = |wanted: &str| known.iter().copied().find(|key| *key == wanted);
    target(&name).or_else(|| {
        KEYS.iter().filter(|(other, _)| *other == name).find_map(|(_, key)| target(key))
    })
}

/// psmrt's words for `word`, those that are among the `known`.
pub(super) fn words_of<'a>(word: &str, known: &[&'a str]) -> Vec<&'a str> {
    let word = plain(word);
    let same = known.iter().copied().filter(|known| *known == word);
    let others = WORDS.iter().filter(|(other, _)| *other == word);
    let others = others.flat_map(|(_, ours)| ours.iter());
    same.chain(others.filter_map(|ours| known.iter().copied().find(|known| known == ours)))
        .collect()
}
