//! The reference of all keys of a scene, as Markdown: `psmrt schema --markdown` prints it.

use psmrt_reference::collision::Preset;
use psmrt_reference::partial_saturation::Weighting;
use serde_json::Value;

use crate::advice::stability::limits::Measured;
use crate::scene::columns::tables;
use crate::scene::schema::{Kind, description, schema};

/// The reference: all sections and keys as Markdown, in the order of the schema.
pub fn reference() -> String {
    let root = schema();
    let mut text = String::from(REFERENCE_HEAD);
    let mut sections = vec![(String::new(), root)];
    let mut next = 0;
    while let Some((path, node)) = sections.get(next).cloned() {
        next += 1;
        let title = if path.is_empty() { "The top level".to_owned() } else { format!("`{path}`") };
        text.push_str(&format!("\n## {title}\n\n{}\n\n", description(node)));
        text.push_str("| key | value | needed | meaning |\n|---|---|---|---|\n");
        let needed: Vec<&str> = node["required"]
            .as_array()
            .map_or_else(Vec::new, |names| names.iter().filter_map(Value::as_str).collect());
        for (name, key) in node["properties"].as_object().into_iter().flatten() {
            let kind = Kind::of(root, key);
            if let Kind::Section(inner)
            | Kind::Sections(inner)
            | Kind::InTime { section: inner, .. } = kind
            {
                let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                // Faces are alike: one table is enough.
                if !sections.iter().any(|(_, known)| std::ptr::eq(*known, inner)) {
                    sections.push((path, inner));
                }
            }
            let value = kind.words();
            let needed = if needed.contains(&name.as_str()) { "yes" } else { "" };
            let meaning = description(key).replace('|', "\\|");
            text.push_str(&format!("| `{name}` | {value} | {needed} | {meaning} |\n"));
        }
    }
    text.push_str(RECORDS_HEAD);
    for (kind, columns) in tables() {
        let titles: Vec<String> = columns.iter().map(|column| column.title()).collect();
        text.push_str(&format!("- `{kind}`: {}\n", titles.join(", ")));
    }
    text.push_str(LIMITS_HEAD);
    for tau in [0.501, 0.51, 0.55, 0.6, 1.0] {
        let mut cells = vec![format!("{tau}")];
        let nt = Measured::Bed(Weighting::NobleTorczynski);
        for (measured, model) in [Measured::Fluid, nt]
            .into_iter()
            .flat_map(|m| [(m, Preset::Srt), (m, Preset::DHumieres)])
        {
            let limit = measured.limit_of(model, tau);
            cells.push(limit.map_or_else(String::new, |limit| format!("{}", limit.lives)));
        }
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    text
}

const LIMITS_HEAD: &str = "
## Up to what velocity a flow is stable

The largest velocity, in cells per time step, at which runs of the maps in `golden/stability` stayed stable: that of
a shear layer, and the superficial velocity through an ordered bed of porosity 0.4. `psmrt check` warns of scenes
beyond. Accuracy ends earlier: errors of compressibility are negligible below 0.05 only.

| tau | shear layer, SRT | shear layer, MRT | bed, SRT | bed, MRT |
|---|---|---|---|---|
";

const RECORDS_HEAD: &str = "
## Columns of the records

All tables begin with `time (s),step`. The superficial velocity is the mean mass flux, grains
included, over the density of the fluid. `spin` is the angular velocity. Force and torque are those of the fluid
(hydrodynamic: viscous stress and pressure) on the grain in the last step; of a grain whose centre lies on a mirror
plane, on the half that is computed. Under a body force G (per volume, [body_force] or from [gravity]) they leave out
the buoyancy in the pressure gradient that G stands for: in a cell in which grains have the weight `B`, G acts on the
share `1 - B` only. `displaced_force` is the rest, `G ΣB` over the cells of the grain at its present position (0
without a body force). Force and displaced force of all grains add up to the driving force of the whole domain, G V,
less the rate of change of the fluid's momentum and the force on walls; in a steady periodic domain the sum is G V to
round-off. Positions of moving grains are not wrapped at periodic faces. Pressure is that above the fluid
at its reference density.
`grain_means` are means and sums over the free grains; contacts are those between grains and with faces,
and the overlap is divided by the mean diameter of the two.
In `layers` pressure and velocity are means over the pores (over the cells, each with the share of it that no grain covers), so the
velocity times the porosity is about the superficial one; `hydraulic_gradient` is (G - dp/dx)/(rho g) along the axis, between
the layers on either side, with the fluid's density rho and g the acceleration of [gravity], or 9.81 m/s2 without; grains are those
with their centres in the layer, their coordination number is the mean count of contacts, faces included. An effective
stress is -sum(F l)/V over the contacts, F the force on a grain and l the part within the layer of the branch from its centre to the
other's or to the face (Love and Weber); compression is positive. Over a whole layer of a bed at rest it is the weight, less
buoyancy, of what lies above, over the area. The stress of the grains' motion is left out.
In `walls` the fluid's force is that of the last step, pressure being that above the reference density; there is none (NaN) at faces
through which the fluid flows, where grains are still stopped as by a sieve. Contacts are looked at as they are at that moment:
springs and dashpots, without lubrication.
In `contact_means` the contacts are those between grains, the coordination number counts faces too; the fabric is the mean of n_i n_j,
n the unit normals, and the stress that of `layers`, over the whole domain.
The files of `contacts` hold a line for each contact, from centre to centre or to the face (`other grain` -1), with its force.

`permeability` is Darcy's law, `k = ρ ν U/(dP/L)`: U is the superficial velocity along the axis, dP/L what drives the
fluid through the bed per length, as pressure and body force together. Along a periodic axis the body force over the
whole period acts on the length of the bed; between two open faces it is the drop from one plane of cells to another, over
the length of the bed between them (the planes lie half of the largest grain outside of the bed, or at the faces). The
bed reaches along the axis from `bed_low` to `bed_high`: the stretch around the fullest slab, as thick as the largest
grain, in which such slabs hold at least half as much, where it has a solid fraction of 0.3 or more, holds the volume of
four grains or more and is 5 % denser than the domain; else the bed is the whole domain. `porosity` is 1 less the volume
of the grains there over the bed's volume from side to side of the domain, and `diameter` d is Σd³/Σd² (Sauter's
mean). `hydraulic_gradient` i is dP/L over ρ g and `hydraulic_conductivity` K is k g/ν, g being that of [gravity] and 9.81
m/s2 where there is none; a darcy is 9.869e-13 m2. `reynolds` is U d/(ν (1 - porosity)), `psi` is
(dP/L) d porosity³/(ρ U² (1 - porosity)). Beside them what laws for equal spheres give at this porosity and Re:
Kozeny & Carman's with 180, Beetstra et al. (2007) and Tang et al. (2015). Where Re is above 1 inertia counts, and k is
that at this Re only. All are values of now: of a flow that is not steady yet, or of grains that move, they are no
property of the bed. Before anything drives the flow k is not a number (`NaN`), and before it moves psi means nothing (it may be `inf`).

";

const REFERENCE_HEAD: &str = "# Scene files, key by key

Made by `psmrt schema --markdown` from the comments in the code; do not edit. TOML, SI units. What is
absent costs nothing. `psmrt check` says what a scene will be. Scenes to start from: `golden/`.
";
