//! The columns of the tables that records are: what a scene may name, and what is written.

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its unit; empty for a bare number.
    pub unit: &'static str,
}

impl Column {
    /// A column of that name and unit.
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        Column { name, unit }
    }

    /// Name and unit, as the first line of a table has them.
    pub fn title(&self) -> String {
        match self.unit {
            "" => self.name.to_owned(),
            unit => format!("{} ({unit})", self.name),
        }
    }
}

/// The columns of a record of kind `box`, after time and step.
pub const BOX_COLUMNS: [Column; 5] = [
    Column::new("density", "kg/m3"),
    Column::new("superficial_velocity_x", "m/s"),
    Column::new("superficial_velocity_y", "m/s"),
    Column::new("superficial_velocity_z", "m/s"),
    Column::new("max_speed", "m/s"),
];

/// The columns of a record of kind `profile`, after time and step.
pub const PROFILE_COLUMNS: [Column; 8] = [
    Column::new("position", "m"),
    Column::new("pressure", "Pa"),
    Column::new("velocity_x", "m/s"),
    Column::new("velocity_y", "m/s"),
    Column::new("velocity_z", "m/s"),
    Column::new("x", "m"),
    Column::new("y", "m"),
    Column::new("z", "m"),
];

/// The columns of a record of kind `loads`, after time and step.
pub const LOAD_COLUMNS: [Column; 20] = [
    Column::new("grain", ""),
    Column::new("x", "m"),
    Column::new("y", "m"),
    Column::new("z", "m"),
    Column::new("diameter", "m"),
    Column::new("velocity_x", "m/s"),
    Column::new("velocity_y", "m/s"),
    Column::new("velocity_z", "m/s"),
    Column::new("spin_x", "rad/s"),
    Column::new("spin_y", "rad/s"),
    Column::new("spin_z", "rad/s"),
    FORCE_COLUMNS[0],
    FORCE_COLUMNS[1],
    FORCE_COLUMNS[2],
    Column::new("torque_x", "N m"),
    Column::new("torque_y", "N m"),
    Column::new("torque_z", "N m"),
    // What the body force lacks in the cells of the grain: the buoyancy in the pressure gradient that it
    // stands for.
    Column::new("displaced_force_x", "N"),
    Column::new("displaced_force_y", "N"),
    Column::new("displaced_force_z", "N"),
];

/// The columns of a record of loads that can be summed over the grains and become steady.
pub const FORCE_COLUMNS: [Column; 3] =
    [Column::new("force_x", "N"), Column::new("force_y", "N"), Column::new("force_z", "N")];

/// The columns of a record of kind `grain_means`, after time and step.
pub const GRAIN_MEAN_COLUMNS: [Column; 10] = [
    Column::new("x", "m"),
    Column::new("y", "m"),
    Column::new("z", "m"),
    Column::new("velocity_x", "m/s"),
    Column::new("velocity_y", "m/s"),
    Column::new("velocity_z", "m/s"),
    Column::new("max_speed", "m/s"),
    Column::new("kinetic_energy", "J"),
    Column::new("contacts", ""),
    Column::new("largest_overlap", ""),
];

/// The columns of a record of kind `layers`, after time and step.
pub const LAYER_COLUMNS: [Column; 13] = [
    Column::new("low", "m"),
    Column::new("high", "m"),
    Column::new("porosity", ""),
    Column::new("pressure", "Pa"),
    Column::new("hydraulic_gradient", ""),
    Column::new("velocity_x", "m/s"),
    Column::new("velocity_y", "m/s"),
    Column::new("velocity_z", "m/s"),
    Column::new("grains", ""),
    Column::new("coordination_number", ""),
    Column::new("effective_stress_x", "Pa"),
    Column::new("effective_stress_y", "Pa"),
    Column::new("effective_stress_z", "Pa"),
];

/// The columns of a record of kind `walls`, after time and step.
pub const WALL_COLUMNS: [Column; 7] = [
    Column::new("face", ""),
    Column::new("fluid_force_x", "N"),
    Column::new("fluid_force_y", "N"),
    Column::new("fluid_force_z", "N"),
    Column::new("grain_force_x", "N"),
    Column::new("grain_force_y", "N"),
    Column::new("grain_force_z", "N"),
];

/// The columns of a record of kind `contact_means`, after time and step.
pub const CONTACT_MEAN_COLUMNS: [Column; 15] = [
    Column::new("contacts", ""),
    Column::new("coordination_number", ""),
    Column::new("normal_force", "N"),
    Column::new("fabric_xx", ""),
    Column::new("fabric_yy", ""),
    Column::new("fabric_zz", ""),
    Column::new("fabric_xy", ""),
    Column::new("fabric_xz", ""),
    Column::new("fabric_yz", ""),
    Column::new("stress_xx", "Pa"),
    Column::new("stress_yy", "Pa"),
    Column::new("stress_zz", "Pa"),
    Column::new("stress_xy", "Pa"),
    Column::new("stress_xz", "Pa"),
    Column::new("stress_yz", "Pa"),
];

/// The columns of a record of kind `permeability`, after time and step.
pub const PERMEABILITY_COLUMNS: [Column; 16] = [
    Column::new("superficial_velocity", "m/s"),
    Column::new("pressure_gradient", "Pa/m"),
    Column::new("hydraulic_gradient", ""),
    Column::new("permeability", "m2"),
    Column::new("permeability_darcy", "darcy"),
    Column::new("hydraulic_conductivity", "m/s"),
    Column::new("k_over_d2", ""),
    Column::new("porosity", ""),
    Column::new("bed_low", "m"),
    Column::new("bed_high", "m"),
    Column::new("diameter", "m"),
    Column::new("reynolds", ""),
    Column::new("psi", ""),
    Column::new("kozeny_carman", "m2"),
    Column::new("beetstra", "m2"),
    Column::new("tang", "m2"),
];

/// The records that are tables: kind and columns, after time and step.
pub fn tables() -> [(&'static str, &'static [Column]); 8] {
    [
        ("box", &BOX_COLUMNS),
        ("profile", &PROFILE_COLUMNS),
        ("loads", &LOAD_COLUMNS),
        ("grain_means", &GRAIN_MEAN_COLUMNS),
        ("layers", &LAYER_COLUMNS),
        ("walls", &WALL_COLUMNS),
        ("contact_means", &CONTACT_MEAN_COLUMNS),
        ("permeability", &PERMEABILITY_COLUMNS),
    ]
}
