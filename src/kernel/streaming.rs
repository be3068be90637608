//! Streaming as WGSL: which population enters a cell along each direction, with the faces of the
//! scene's box and no others.
//!
//! The kernel keeps the populations as they are after a collision, less their weights. A cell pulls
//! `f*_a` from `x - c_a`; where the link crosses a face the rule of the face stands in its place. Rules
//! act on single links, half-way between nodes:
//!
//! - a link that crosses walls or inlets is bounced back with the sum of their velocities;
//! - else one that crosses a face of given pressure is bounced back with its sign turned;
//! - else each crossed face in turn wraps (periodic), mirrors (free slip) or clamps (outflow) the place
//!   that the link comes from.

use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::domain::{Domain, Face};

use super::layout::Layout;
use super::numbers::literal;

/// The populations of a shader that works on one cell at a time: WGSL functions `own` and `wrapped`, and
/// `keep` if it writes.
pub(super) fn access(layout: &Layout, writes: bool) -> String {
    let mut text = bindings(layout, "f32", "f32", writes);
    text += "\n// The populations at a place.\nfn own(place: u32) -> array<f32, 19> {\n";
    text += "    var h: array<f32, 19>;\n";
    for a in 0..Q {
        text += &format!("    h[{a}] = {};\n", old(layout, a, "place"));
    }
    text += "    return h;\n}\n\n// f_a(x) = f*_a(x - c_a), all faces taken for periodic.\n";
    text += "fn wrapped(x: u32, y: u32, z: u32) -> array<f32, 19> {\n    var h: array<f32, 19>;\n";
    text += NEIGHBOURS;
    for a in 0..Q {
        let from = std::array::from_fn(|axis| place(axis, C[a][axis]));
        text += &format!("    h[{a}] = {};\n", old(layout, a, &sum(&from)));
    }
    text += "    return h;\n}\n";
    if writes {
        text += &keep(layout, 1);
    }
    text
}

/// The populations of a shader that works on a vector of cells at once: WGSL functions `wrapped` and
/// `keep`.
pub(super) fn vector_access(layout: &Layout) -> String {
    let mut text = bindings(layout, "quad", "real", true);
    text += if layout.pairs { UNPACKED_PAIRS } else { UNPACKED };
    text += "\n// f_a(x) = f*_a(x - c_a), all faces taken for periodic.\n";
    text +=
        "fn wrapped(x: u32, y: u32, z: u32) -> array<real, 19> {\n    var h: array<real, 19>;\n";
    text += VECTOR_NEIGHBOURS;
    for a in 0..Q {
        let from = std::array::from_fn(|axis| place(axis, C[a][axis]));
        let (binding, start) = layout.direction(a);
        let start = start / layout.width;
        text += &format!("    h[{a}] = unpacked(old_{binding}[{start}u + {}]);\n", sum(&from));
    }
    if layout.width == 4 {
        // What comes from beyond an end of the row comes from the neighbour quarter of the row.
        for (c, condition, turned) in [(1, "x == 0u", "wxyz"), (-1, "x == VECTORS - 1u", "yzwx")] {
            text += &format!("    if ({condition}) {{\n");
            for a in (0..Q).filter(|&a| C[a][0] == c) {
                text += &format!("        h[{a}] = h[{a}].{turned};\n");
            }
            text += "    }\n";
        }
    }
    text + "    return h;\n}\n" + &keep(layout, layout.width)
}

/// What is read as it is.
const UNPACKED: &str = "fn unpacked(value: real) -> real {
    return value;
}
";

/// Four values that are read as two pairs.
const UNPACKED_PAIRS: &str = "fn unpacked(pairs: vec2<u64>) -> vec4<f32> {
    let low = vec2<u32>(u32(pairs.x), u32(pairs.y));
    let high = vec2<u32>(u32(pairs.x >> 32u), u32(pairs.y >> 32u));
    return bitcast<vec4<f32>>(vec4<u32>(low.x, high.x, low.y, high.y));
}
";

/// The populations' bindings, as arrays of these elements.
fn bindings(layout: &Layout, read: &str, written: &str, writes: bool) -> String {
    let mut text = String::new();
    for binding in 0..layout.bindings() {
        text += &format!(
            "@group(0) @binding({binding}) var<storage, read> old_{binding}: array<{read}>;\n"
        );
        if writes {
            text += &format!(
                "@group(0) @binding({}) var<storage, read_write> new_{binding}: array<{written}>;\n",
                20 + binding
            );
        }
    }
    text
}

/// WGSL function `keep`: writes the populations of a place, or of the vector of that number.
fn keep(layout: &Layout, width: u32) -> String {
    let mut text = String::from("\nfn keep(place: u32, post: array<real, 19>) {\n");
    for a in 0..Q {
        let (binding, start) = layout.direction(a);
        text += &format!("    new_{binding}[{}u + place] = post[{a}];\n", start / width);
    }
    text + "}\n"
}

/// WGSL function `entering`: the same as `wrapped`, with the faces.
pub(super) fn faces(domain: &Domain, layout: &Layout) -> String {
    let mut rules = String::new();
    let mut needs_own = false;
    for a in 1..Q {
        let mut word = "if";
        for crossed in crossings(a) {
            let Some(rule) = rule(domain, layout, a, &crossed) else { continue };
            needs_own |= rule.needs_own;
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
    let mut text = String::from("// What enters a cell along each direction.\n");
    text += "fn entering(x: u32, y: u32, z: u32) -> array<f32, 19> {\n";
    text += "    var h = wrapped(x, y, z);\n";
    if !rules.is_empty() {
        text += NEIGHBOURS;
        text += "    let here_place = x0 + y0 + z0;\n";
        if needs_own {
            text += "    let here = own(here_place);\n    let drho = sum(here);\n";
            text += "    let rho = 1.0 + drho;\n    let u = momentum(here) / rho;\n";
            text += "    let u2 = dot(u, u);\n";
        }
        text += &rules;
    }
    text + "    return h;\n}\n"
}

/// Parts of the places of a cell and its neighbours, wrapped round the box.
const NEIGHBOURS: &str = "    let x0 = along(x);
    let y0 = ROW_PLACES * y;
    let z0 = ROW_PLACES * NY * z;
    let xm = along(select(x - 1u, NX - 1u, x == 0u));
    let xp = along(select(x + 1u, 0u, x == NX - 1u));
    let ym = ROW_PLACES * select(y - 1u, NY - 1u, y == 0u);
    let yp = ROW_PLACES * select(y + 1u, 0u, y == NY - 1u);
    let zm = ROW_PLACES * NY * select(z - 1u, NZ - 1u, z == 0u);
    let zp = ROW_PLACES * NY * select(z + 1u, 0u, z == NZ - 1u);
";

/// The same for the numbers of vectors; x is that in the row.
const VECTOR_NEIGHBOURS: &str = "    let x0 = x;
    let y0 = VECTORS * y;
    let z0 = VECTORS * NY * z;
    let xm = select(x - 1u, VECTORS - 1u, x == 0u);
    let xp = select(x + 1u, 0u, x == VECTORS - 1u);
    let ym = VECTORS * select(y - 1u, NY - 1u, y == 0u);
    let yp = VECTORS * select(y + 1u, 0u, y == NY - 1u);
    let zm = VECTORS * NY * select(z - 1u, NZ - 1u, z == 0u);
    let zp = VECTORS * NY * select(z + 1u, 0u, z == NZ - 1u);
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

fn sum(parts: &[&str; 3]) -> String {
    format!("({} + {} + {})", parts[0], parts[1], parts[2])
}

/// Population `a` of a cell.
fn old(layout: &Layout, a: usize, cell: &str) -> String {
    let (binding, start) = layout.direction(a);
    format!("old_{binding}[{start}u + {cell}]")
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

/// What enters, as WGSL.
struct Rule {
    expression: String,
    /// Whether it needs density and velocity of the cell.
    needs_own: bool,
}

/// What enters along `a` where the link crosses faces along these axes; `None` if all are periodic.
fn rule(domain: &Domain, layout: &Layout, a: usize, crossed: &[usize]) -> Option<Rule> {
    let c = C[a].map(f64::from);
    let w = weight(a);
    let mut wall: Option<[f64; 3]> = None;
    let mut pressure = None;
    let mut from: [&str; 3] = std::array::from_fn(|axis| place(axis, C[a][axis]));
    let mut direction = C[a];
    let mut is_periodic = true;
    for &axis in crossed {
        let face = domain.faces().axis(axis)[usize::from(C[a][axis] < 0)];
        is_periodic &= face == Face::Periodic;
        match face {
            Face::Periodic => {}
            Face::FreeSlip => {
                from[axis] = place(axis, 0);
                direction[axis] = -direction[axis];
            }
            Face::FreeOutflow => from[axis] = place(axis, 0),
            Face::Wall { velocity } | Face::VelocityInlet { velocity } => {
                let sum = wall.get_or_insert([0.0; 3]);
                (0..3).for_each(|i| sum[i] += velocity[i]);
            }
            Face::Pressure { density } => pressure = Some(density),
        }
    }
    if is_periodic {
        return None;
    }
    let back = old(layout, OPPOSITE[a], "here_place");
    Some(match (wall, pressure) {
        (Some(u), _) => {
            // f_a = f*_-a + 6 w_a ρ (c_a·u_w)
            let gain = 6.0 * w * (0..3).map(|i| c[i] * u[i]).sum::<f64>();
            if gain == 0.0 {
                Rule { expression: back, needs_own: false }
            } else {
                Rule { expression: format!("{back} + rho * {}", literal(gain)), needs_own: true }
            }
        }
        (None, Some(density)) => {
            // f_a = -f*_-a + 2 w_a ρ_w [1 + 9/2 (c_a·u)² - 3/2 u²], less the weights of both
            let cu: Vec<String> =
                (0..3).map(|i| format!("{} * u.{}", literal(c[i]), ["x", "y", "z"][i])).collect();
            let cu = format!("({})", cu.join(" + "));
            let expression = format!(
                "{} + {} * (4.5 * {cu} * {cu} - 1.5 * u2) - {back}",
                literal(2.0 * w * (density - 1.0)),
                literal(2.0 * w * density)
            );
            Rule { expression, needs_own: true }
        }
        (None, None) => {
            let from = sum(&from);
            let number = C.iter().position(|&known| known == direction).unwrap_or(a);
            Rule { expression: old(layout, number, &from), needs_own: false }
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
