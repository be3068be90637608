//! Streaming as WGSL: which population enters a cell along each direction, with the faces of the
//! scene's box and no others.
//!
//! The kernel keeps the populations as they are after a collision, less their weights. A cell pulls
//! `f*_a` from `x - c_a`; where the link crosses a face the rule of the face stands in its place. Rules
//! act on single links, half-way between nodes:
//!
//! - a link that crosses walls or inlets is bounced back with the sum of their velocities;
//! - else one that crosses a face of given pressure is bounced back with its sign turned;
//! - else one that crosses a developed one takes what the cell inside that it would come from sends on, at the
//!   density that is as far beyond the face's as that cell's is on this side; where the face lets sound out, its
//!   density is that of `outgoing.rs`;
//! - else each crossed face in turn wraps (periodic), mirrors (free slip) or clamps (outflow) the place
//!   that the link comes from.

use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::domain::{Domain, Face};

use super::bindings::Binding;
use super::driven;
use super::layout::{Layout, Store};
use super::numbers::literal;
use super::outgoing;

/// The populations of a shader: WGSL functions `own` and `wrapped`, and `keep` if it writes.
pub(super) fn access(layout: &Layout, writes: bool) -> String {
    let mut text = bindings(layout, writes);
    text += "\n// The populations of a cell.\nfn own(x: u32, y: u32, z: u32) -> array<f32, 19> {\n";
    text += "    var h: array<f32, 19>;\n";
    text += HERE;
    for a in 0..Q {
        text += &format!("    h[{a}] = {};\n", old(layout, a, &["x0", "y0", "z0"]));
    }
    text += "    return h;\n}\n\n// f_a(x) = f*_a(x - c_a), all faces taken for periodic.\n";
    text += "fn wrapped(x: u32, y: u32, z: u32) -> array<f32, 19> {\n    var h: array<f32, 19>;\n";
    text += HERE;
    text += NEIGHBOURS;
    for a in 0..Q {
        let from = std::array::from_fn(|axis| place(axis, C[a][axis]));
        text += &format!("    h[{a}] = {};\n", old(layout, a, &from));
    }
    text += "    return h;\n}\n";
    if writes {
        text += &keep(layout);
    }
    text
}

/// The populations' bindings.
fn bindings(layout: &Layout, writes: bool) -> String {
    let kind = |access: &str| match layout.store {
        Store::Buffers => (format!("<storage, {access}>"), "array<f32>".to_owned()),
        Store::Textures => {
            let access = if access == "read" { "read" } else { "write" };
            (String::new(), format!("texture_storage_3d<r32float, {access}>"))
        }
    };
    let mut text = String::new();
    for binding in 0..layout.bindings() {
        let (space, what) = kind("read");
        let number = Binding::Old.number() + binding;
        text += &format!("@group(0) @binding({number}) var{space} old_{binding}: {what};\n");
        if writes {
            let (space, what) = kind("read_write");
            let number = Binding::New.number() + binding;
            text += &format!("@group(0) @binding({number}) var{space} new_{binding}: {what};\n");
        }
    }
    text
}

/// WGSL function `keep`: writes the populations of a cell.
fn keep(layout: &Layout) -> String {
    let mut text =
        String::from("\nfn keep(x: u32, y: u32, z: u32, post: array<f32, 19>) {\n") + HERE;
    for a in 0..Q {
        let (binding, start) = layout.direction(a);
        text += &match layout.store {
            Store::Buffers => {
                format!("    new_{binding}[{start}u + (x0 + y0 + z0)] = post[{a}];\n")
            }
            Store::Textures => format!(
                "    textureStore(new_{binding}, vec3<u32>(x0, y0, {start}u + z0), \
                 vec4<f32>(post[{a}], 0.0, 0.0, 0.0));\n"
            ),
        };
    }
    text + "}\n"
}

/// WGSL function `entering`: the same as `wrapped`, with the faces. `walls_move`: whether walls or inlets have velocities;
/// `writes`: whether the shader makes steps.
pub(super) fn faces(domain: &Domain, layout: &Layout, walls_move: bool, writes: bool) -> String {
    let mut rules = String::new();
    let mut needed = Needs::Nothing;
    for a in 1..Q {
        let mut word = "if";
        for crossed in crossings(a) {
            let Some(rule) = rule(domain, layout, walls_move, a, &crossed) else { continue };
            needed = needed.max(rule.needs);
            let conditions: Vec<&str> =
                crossed.iter().map(|&axis| AT_FACE[axis][usize::from(C[a][axis] < 0)]).collect();
            rules += &format!(
                "    {word} ({}) {{\n        h[{a}] = {};\n    }}",
                conditions.join(" && "),
                rule.expression
            );
            word = " else if";
        }
        if word != "if" {
            rules += "\n";
        }
    }
    let mut text = String::new();
    if rules.contains("carried_over(") || outgoing::has_any(domain) {
        text += CARRIED_OVER;
    }
    text += &outgoing::text(domain, writes);
    text += "// What enters a cell along each direction.\n";
    text += "fn entering(x: u32, y: u32, z: u32) -> array<f32, 19> {\n";
    text += "    var h = wrapped(x, y, z);\n";
    if !rules.is_empty() {
        text += HERE;
        text += NEIGHBOURS;
        text += match needed {
            Needs::Nothing => "",
            Needs::Density => "    let rho = 1.0 + sum(own(x, y, z));\n",
            Needs::Velocity => {
                "    let here = own(x, y, z);\n    let rho = 1.0 + sum(here);\n    \
                 let u = momentum(here) / rho;\n    let u2 = dot(u, u);\n"
            }
        };
        text += &rules;
    }
    text + "    return h;\n}\n"
}

/// Parts of the place of a cell: in a buffer they add up to its number, in a texture they are its
/// coordinates.
const HERE: &str = "    let x0 = x;
    let y0 = STEP_Y * y;
    let z0 = STEP_Z * z;
";

/// The same of its neighbours, wrapped round the box.
const NEIGHBOURS: &str = "    let xm = select(x - 1u, NX - 1u, x == 0u);
    let xp = select(x + 1u, 0u, x == NX - 1u);
    let ym = STEP_Y * select(y - 1u, NY - 1u, y == 0u);
    let yp = STEP_Y * select(y + 1u, 0u, y == NY - 1u);
    let zm = STEP_Z * select(z - 1u, NZ - 1u, z == 0u);
    let zp = STEP_Z * select(z + 1u, 0u, z == NZ - 1u);
";

/// What a cell sends on beyond a face of density 1 + `drho_w`, along `c` of weight `w`; `f` is its own population.
const CARRIED_OVER: &str = "
fn carried_over(h: array<f32, 19>, f: f32, c: vec3<f32>, w: f32, drho_w: f32) -> f32 {
    let drho = sum(h);
    let u = momentum(h) / (1.0 + drho);
    let cu = dot(c, u);
    // f_a(x) = f*_a(x') + 2 (ρ_w - ρ') w_a [1 + 3 c_a·u' + 9/2 (c_a·u')² - 3/2 u'²]
    return f + 2.0 * (drho_w - drho) * w * (1.0 + 3.0 * cu + 4.5 * cu * cu - 1.5 * dot(u, u));
}

";

/// Whether a cell lies at the low and the high face of each axis.
const AT_FACE: [[&str; 2]; 3] =
    [["x == 0u", "x == NX - 1u"], ["y == 0u", "y == NY - 1u"], ["z == 0u", "z == NZ - 1u"]];

/// The part of a place along an axis, one cell against the component `c` of a direction.
fn place(axis: usize, c: i32) -> &'static str {
    let names = [["x0", "xm", "xp"], ["y0", "ym", "yp"], ["z0", "zm", "zp"]][axis];
    match c {
        1 => names[1],
        -1 => names[2],
        _ => names[0],
    }
}

/// The coordinate of that cell along the axis.
fn coordinate(axis: usize, c: i32) -> String {
    let (x, n) = (["x", "y", "z"][axis], ["NX", "NY", "NZ"][axis]);
    match c {
        1 => format!("select({x} - 1u, {n} - 1u, {x} == 0u)"),
        -1 => format!("select({x} + 1u, 0u, {x} == {n} - 1u)"),
        _ => x.to_owned(),
    }
}

/// Population `a` of the cell whose place has these parts.
fn old(layout: &Layout, a: usize, [x, y, z]: &[&str; 3]) -> String {
    let (binding, start) = layout.direction(a);
    match layout.store {
        Store::Buffers => format!("old_{binding}[{start}u + ({x} + {y} + {z})]"),
        Store::Textures => {
            format!("textureLoad(old_{binding}, vec3<u32>({x}, {y}, {start}u + {z})).x")
        }
    }
}

/// The sets of axes along which direction `a` can cross a face, the larger first.
fn crossings(a: usize) -> Vec<Vec<usize>> {
    let along: Vec<usize> = (0..3).filter(|&axis| C[a][axis] != 0).collect();
    let alone = along.iter().map(|&axis| vec![axis]);
    if along.len() > 1 {
        std::iter::once(along.clone()).chain(alone).collect()
    } else {
        alone.collect()
    }
}

/// What a rule needs to know of the cell besides its populations, the more the later.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Needs {
    Nothing,
    /// Its density, where a face has a velocity.
    Density,
    /// Density and velocity.
    Velocity,
}

/// What enters, as WGSL.
struct Rule {
    expression: String,
    needs: Needs,
}

/// What enters along `a` where the link crosses faces along these axes; `None` if all are periodic.
fn rule(
    domain: &Domain,
    layout: &Layout,
    walls_move: bool,
    a: usize,
    crossed: &[usize],
) -> Option<Rule> {
    let c = C[a].map(f64::from);
    let w = weight(a);
    let mut walls = Vec::new();
    // Faces that the flow inside is carried over: their axis, and whether the density follows the sound.
    let (mut pressure, mut carried) = (None, Vec::new());
    // Against which the cell lies that the link comes from.
    let mut along = C[a];
    let mut from: [&str; 3] = std::array::from_fn(|axis| place(axis, C[a][axis]));
    let mut direction = C[a];
    let mut is_periodic = true;
    for &axis in crossed {
        let is_high = C[a][axis] < 0;
        let face = domain.faces().axis(axis)[usize::from(is_high)];
        is_periodic &= face == Face::Periodic;
        match face {
            Face::Periodic => {}
            Face::FreeSlip => {
                from[axis] = place(axis, 0);
                along[axis] = 0;
                direction[axis] = -direction[axis];
            }
            Face::FreeOutflow => {
                from[axis] = place(axis, 0);
                along[axis] = 0;
            }
            Face::DevelopedPressure { .. } => {
                from[axis] = place(axis, 0);
                along[axis] = 0;
                carried.push((axis, false));
            }
            Face::NonReflectingPressure { .. } => {
                from[axis] = place(axis, 0);
                along[axis] = 0;
                carried.push((axis, true));
            }
            Face::Wall { .. } | Face::VelocityInlet { .. } => {
                walls.push(driven::face(axis, is_high) + ".xyz");
            }
            Face::Pressure { .. } => pressure = Some(driven::face(axis, is_high) + ".w"),
        }
    }
    if is_periodic {
        return None;
    }
    let back = old(layout, OPPOSITE[a], &["x0", "y0", "z0"]);
    Some(match (walls.is_empty(), pressure) {
        (false, _) if !walls_move => Rule { expression: back, needs: Needs::Nothing },
        (false, _) => {
            // f_a = f*_-a + 6 w_a ρ (c_a·u_w)
            let c = c.map(literal).join(", ");
            let gain = format!("dot(vec3<f32>({c}), {})", walls.join(" + "));
            let expression = format!("{back} + {} * rho * {gain}", literal(6.0 * w));
            Rule { expression, needs: Needs::Density }
        }
        (true, Some(drho)) => {
            // f_a = -f*_-a + 2 w_a ρ_w [1 + 9/2 (c_a·u)² - 3/2 u²], less the weights of both
            let cu: Vec<String> =
                (0..3).map(|i| format!("{} * u.{}", literal(c[i]), ["x", "y", "z"][i])).collect();
            let cu = format!("({})", cu.join(" + "));
            let expression = format!(
                "{w} * ({drho} + (1.0 + {drho}) * (4.5 * {cu} * {cu} - 1.5 * u2)) - {back}",
                w = literal(2.0 * w)
            );
            Rule { expression, needs: Needs::Velocity }
        }
        (true, None) => {
            let number = C.iter().position(|&known| known == direction).unwrap_or(a);
            let sent = old(layout, number, &from);
            let expression = if carried.is_empty() {
                sent
            } else {
                let at: [String; 3] = std::array::from_fn(|axis| coordinate(axis, along[axis]));
                let (at, c) = (at.join(", "), direction.map(|c| literal(f64::from(c))).join(", "));
                let drho = |&(axis, follows_sound): &(usize, bool)| {
                    let is_high = C[a][axis] < 0;
                    if follows_sound {
                        let function = outgoing::function(axis, is_high);
                        format!("{function}(own({at}), vec3<u32>({at}))")
                    } else {
                        driven::face(axis, is_high) + ".w"
                    }
                };
                let sum = carried.iter().map(drho).collect::<Vec<_>>().join(" + ");
                // Where two such faces meet, the mean of their densities.
                let share = literal(1.0 / carried.len() as f64);
                let w = literal(w);
                format!("carried_over(own({at}), {sent}, vec3<f32>({c}), {w}, {share} * ({sum}))")
            };
            Rule { expression, needs: Needs::Nothing }
        }
    })
}

/// Weight of direction `a`: 1/3 at rest, 1/18 along an axis, 1/36 between two.
pub(super) fn weight(a: usize) -> f64 {
    match C[a].iter().filter(|&&c| c != 0).count() {
        0 => 1.0 / 3.0,
        1 => 1.0 / 18.0,
        _ => 1.0 / 36.0,
    }
}
