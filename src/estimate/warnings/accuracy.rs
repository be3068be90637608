//! Warnings of grids that are too coarse for the grains.

use super::warning;
use crate::estimate::{Warning, diameters};
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let tau = scene.setup.collision.tau();
    let Some((low, _)) = diameters(scene) else { return Vec::new() };
    // Figures: golden/sphere_arrays/study.csv, SC at 0.065, MRT with d'Humieres' rates, weight NT.
    if low < 8.0 {
        let reason = format!(
            "a grain is {low:.1} cells across: its drag is too small by tens of percent, the more the \
             larger tau is (in a dilute array at 4 cells by 17 % at tau 0.6, 25 % at 0.8, 32 % at 1, 44 % \
             at 1.5; at 8 cells by 3, 6, 9 and 14 %)"
        );
        return vec![warning(
            reason,
            "use 8 cells or more (a smaller `domain.dx`), and tau of 0.6 to 0.8",
        )];
    }
    if low < 16.0 && tau >= 1.5 {
        let reason = format!(
            "tau = {tau:.2} with grains of fewer than 16 cells: their drag is too small (in a dilute array \
             at 8 cells by 14 % at tau 1.5 and 20 % at 2, but 6 % at 0.8)"
        );
        return vec![warning(reason, "use a shorter time step (a smaller `time.tau`)")];
    }
    Vec::new()
}
