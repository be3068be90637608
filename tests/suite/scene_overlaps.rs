//! Grains of a scene that overlap are found, wherever they lie.

use std::fmt::Write;

use proptest::prelude::*;
use psmrt::scene::Scene;

use crate::scenes::water;

const DX: f64 = 1e-5;

/// A scene in a box of `cells`, periodic along x, with grains at `balls` (centres and diameters in cells)
/// from a list. All lie in the box and none cuts a wall.
fn load(cells: [usize; 3], balls: &[([f64; 3], f64)]) -> Result<Scene, String> {
    let folder = tempfile::tempdir().unwrap();
    let mut list = "x (m),y (m),z (m),diameter (m)\n".to_owned();
    for ([x, y, z], d) in balls {
        writeln!(list, "{:e},{:e},{:e},{:e}", x * DX, y * DX, z * DX, d * DX).unwrap();
    }
    std::fs::write(folder.path().join("grains.csv"), list).unwrap();
    let walls: String =
        ["y_low", "y_high", "z_low", "z_high"].map(|f| format!("{f}.kind = \"wall\"\n")).concat();
    let rest = format!(
        "[faces]\n{walls}[[grains]]\nkind = \"csv\"\nfile = \"grains.csv\"\n[[records]]\n\
         name = \"box\"\nkind = \"box\"\nevery_steps = 1\n[stop]\nsteps = 1\n"
    );
    let text = water(cells, DX, &rest).into_bytes();
    Scene::from_bytes("scene.toml", text, folder.path(), &[]).map_err(|error| error.to_string())
}

/// By how much the deepest pair overlaps, in diameters of its smaller grain, counted pair by pair and
/// image by image.
fn deepest(length: f64, balls: &[([f64; 3], f64)]) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for (i, (p, d)) in balls.iter().enumerate() {
        for (q, e) in &balls[..i] {
            for image in [-length, 0.0, length] {
                let apart =
                    ((p[0] - q[0] + image).powi(2) + (p[1] - q[1]).powi(2) + (p[2] - q[2]).powi(2))
                        .sqrt();
                deepest = deepest.max((0.5 * (d + e) - apart) / d.min(*e));
            }
        }
    }
    deepest
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Some of 2 to 14 grains between 2 and 18 cells overlap in about half of these boxes.
    #[test]
    fn grains_overlap_where_pairs_counted_one_by_one_do(
        unit in prop::collection::vec((prop::array::uniform3(0.0..1.0), 0.0..1.0_f64), 2..14),
    ) {
        let sides = [40.0, 64.0, 20.0];
        let ball = |(at, size): &([f64; 3], f64)| {
            let d = 2.0 * 9.0_f64.powf(*size);
            let within = |i: usize| 0.5 * d + at[i] * (sides[i] - d);
            ([sides[0] * at[0], within(1), within(2)], d)
        };
        let balls: Vec<_> = unit.iter().map(ball).collect();
        let (depth, scene) = (deepest(sides[0], &balls), load([40, 64, 20], &balls));
        match scene {
            // The list's digits leave 1e-15: the limit of 0.01 is met from either side.
            Ok(_) => prop_assert!(depth < 0.01 + 1e-9, "{balls:?} overlap by {depth} and pass"),
            Err(error) => prop_assert!(
                error.contains("overlap") && depth > 0.01 - 1e-9,
                "{balls:?} overlap by {depth} of a diameter, and the scene fails with {error}"
            ),
        }
    }
}

/// Side of a layer of grains, in grains of 4 cells that lie 5 apart.
const SIDE: u32 = 40;

/// Grains side by side in a layer one grain thick across axis `thin`, the last one moved along the layer by
/// `shift` cells.
fn layer(thin: usize, shift: f64) -> Result<Scene, String> {
    let mut cells = [SIDE as usize * 5; 3];
    cells[thin] = 5;
    let mut balls: Vec<_> = (0..SIDE * SIDE)
        .map(|i| {
            let mut at = [2.5; 3];
            at[(thin + 1) % 3] += 5.0 * f64::from(i % SIDE);
            at[(thin + 2) % 3] += 5.0 * f64::from(i / SIDE);
            (at, 4.0)
        })
        .collect();
    balls.last_mut().unwrap().0[(thin + 1) % 3] -= shift;
    load(cells, &balls)
}

#[test]
fn one_overlap_in_a_layer_of_grains_is_found_across_any_axis() {
    for axis in 0..3 {
        let apart = layer(axis, 0.0);
        assert!(apart.is_ok(), "a layer across axis {axis} without overlap is refused: {apart:?}");
        // The gap of one cell closes, and then half a cell of the diameter of 4.
        let deep = layer(axis, 1.5);
        assert!(
            deep.as_ref().is_err_and(|error| error.contains("overlap")),
            "the last grain of a layer across axis {axis} overlaps its neighbour by an eighth of a \
             diameter: {deep:?}"
        );
    }
}
