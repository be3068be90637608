//! The keys of lists of grains that other programs have written.

use schemars::JsonSchema;
use serde::Deserialize;

/// Which columns of a list are what: for tables of other programs, whose names and units are theirs. The names stand in its first
/// line, and are given here as they stand there; columns that are not named here are left out. `x`, `y`, `z` and one of `radius`
/// and `diameter` are needed. Example: `columns = { x = "X [mm]", y = "Y [mm]", z = "Z [mm]", radius = "R [mm]", lengths_in = 1e-3,
/// delimiter = "semicolon" }`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ColumnsSection {
    /// Name of the column with the place along x.
    pub x: String,
    /// Name of the column with the place along y.
    pub y: String,
    /// Name of the column with the place along z.
    pub z: String,
    /// Name of the column with the diameter.
    pub diameter: Option<String>,
    /// Name of the column with the radius, instead of the diameter.
    pub radius: Option<String>,
    /// Name of the column with the density.
    pub density: Option<String>,
    /// Name of the column with the velocity along x, for free grains; all three together.
    pub velocity_x: Option<String>,
    /// Name of the column with the velocity along y.
    pub velocity_y: Option<String>,
    /// Name of the column with the velocity along z.
    pub velocity_z: Option<String>,
    /// Name of the column with the angular velocity about x (rad/s), for free grains; all three together.
    pub spin_x: Option<String>,
    /// Name of the column with the angular velocity about y (rad/s).
    pub spin_y: Option<String>,
    /// Name of the column with the angular velocity about z (rad/s).
    pub spin_z: Option<String>,
    /// Metres in the file's unit of length, of places, diameters and radii: 1e-3 for mm; 1 where absent. A unit in the name of a column,
    /// `X [mm]`, goes before it, and so for velocities and densities.
    pub lengths_in: Option<f64>,
    /// m/s in the file's unit of velocity: 1e-3 for mm/s; 1 where absent.
    pub velocities_in: Option<f64>,
    /// kg/m3 in the file's unit of density: 1000 for g/cm3; 1 where absent.
    pub densities_in: Option<f64>,
    /// What separates columns: `comma` (the default), `semicolon`, `tab` or `blanks` (spaces and tabs, any number of them). Decimals
    /// have points.
    #[serde(default)]
    pub delimiter: DelimiterName,
}

/// What separates the columns of a list.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum DelimiterName {
    /// `,`
    #[default]
    Comma,
    /// `;`
    Semicolon,
    /// A tabulator.
    Tab,
    /// Spaces and tabulators.
    Blanks,
}
