//! Wrong scenes: each gives one message with file, line, key, value, what is allowed and what to
//! do; exit code 2; no panic; nothing made.

mod cli;

use std::path::Path;

use cli::{Folder, psmrt_in, stderr, stdout};
use psmrt::scene::Scene;
use psmrt_reference::solids::Shape;

/// A scene that runs: each wrong one differs from it in one place.
const GOOD: &str = include_str!("cli/good.toml");

/// A wrong scene: what is replaced in [`GOOD`] by what; the key; what is said.
struct Bad(&'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const BAD: &[Bad] = &[
    // Names.
    Bad("density = 1000.0", "densty = 1000.0", "fluid.densty", "did you mean `density`?"),
    Bad("[fluid]", "[fluids]", "fluids", "did you mean `fluid`?"),
    Bad("s_e = 1.1", "s_nu = 1.1", "collision.s_nu", "has no key `s_nu`"),
    Bad("dx = 2.5e-5", "dx = 2.5e-5\ncolour = 3", "domain.colour", "has no key `colour`"),
    Bad("\"velocity_inlet\",", "\"velocity_inlt\",", "faces.x_low.kind", "did you mean `velocity_inlet`?"),
    Bad("model = \"mrt\"", "model = \"MRT\"", "collision.model", "known"),
    Bad("name = \"box\"\nkind = \"box\"", "name = \"box\"\nkind = \"bx\"", "records[0].kind", "did you mean `box`?"),
    Bad("axis = \"x\"", "axis = \"w\"", "records[1].axis", "x, y, z"),
    Bad("kind = \"reference\"", "kind = \"cuda\"", "engine.kind", "reference"),
    Bad("formats = [\"vti\"]", "formats = [\"hdf5\"]", "records[2].formats", "vti, npy"),
    // First guesses.
    Bad("y_high.kind = \"free_slip\"", "y_high = \"symmetry\"", "faces.y_high", "write `y_high.kind = \"free_slip\"`"),
    Bad("[engine]\nkind = \"reference\"", "[engine]\nkind = \"gpu\"", "engine.kind", "psmrt calls it \"wgpu\""),
    Bad("title = \"good\"", "compare = \"plane_poiseuille\"", "compare", "write `compare.exact = \"plane_poiseuille\"`"),
    Bad("[engine]\nkind = \"reference\"", "[stop.engine]", "stop.engine", "did you mean `engine`?"),
    Bad("record = \"box\"\ncolumn = \"density\"\ntolerance = 1e-6", "", "stop.steady.record", "Name of a record"),
    Bad("[stop.steady]\nrecord = \"box\"\ncolumn = \"density\"\ntolerance = 1e-6", "steady = true", "stop.steady", "tolerance = 1e-6"),
    Bad("[checkpoint]\nevery_steps = 1000", "[checkpoint.every_steps]", "checkpoint.every_steps", "not a section"),
    Bad("[initial]\nvelocity = [1e-3, 0.0, 0.0]", "[initial]\nvelocity = 1e-3", "initial.velocity", "three values [x, y, z]"),
    Bad("[checkpoint]", "[grains.more]\n[checkpoint]", "grains[2].more", "has no key `more`"),
    Bad("[[records]]\nname = \"box\"\nkind = \"box\"\nevery_steps = 100\n[[records]]\nname = \"line\"\nkind = \"profile\"\naxis = \"x\"\npoint = [0.0, 2.5e-4, 2.5e-4]\n[[records]]", "[records]", "records", "write [[records]]"),
    Bad("[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-6", "", "fluid", "kinematic_viscosity = 1e-6"),
    Bad("[stop]\ntime = 0.01\n[stop.steady]\nrecord = \"box\"\ncolumn = \"density\"\ntolerance = 1e-6", "", "stop", "[stop]\n"),
    Bad("kinematic_viscosity = 1e-6", "dynamic_viscosity = 1e-3", "fluid.dynamic_viscosity", "kinematic = dynamic / density; write `kinematic_viscosity = 1e-6`"),
    Bad("kinematic_viscosity = 1e-6", "mu = 1e-3", "fluid.mu", "write `kinematic_viscosity = 1e-6`"),
    Bad("kinematic_viscosity = 1e-6", "nu = 1e-6", "fluid.nu", "psmrt calls it `kinematic_viscosity`"),
    Bad("diameter = 2e-4", "radius = 1e-4", "grains[0].radius", "write `diameter = 2e-4`"),
    Bad("tau = 0.8", "dx = 1e-5", "time.dx", "did you mean `domain.dx`?"),
    Bad("kind = \"velocity_inlet\"", "kind = \"inlet\"", "faces.x_low.kind", "\"velocity_inlet\" and \"pressure\""),
    Bad("kind = \"pressure\"", "kind = \"outlet\"", "faces.x_high.kind", "\"pressure\" and \"free_outflow\""),
    Bad("kind = \"wall\"", "kind = \"no_slip\"", "faces.y_low.kind", "psmrt calls it \"wall\""),
    Bad("kind = \"wall\"", "kind = \"no-slip\"", "faces.y_low.kind", "psmrt calls it \"wall\""),
    Bad("kind = \"wall\"", "kind = \"bounce_back\"", "faces.y_low.kind", "psmrt calls it \"wall\""),
    Bad("kind = \"wall\"", "kind = \"slip\"", "faces.y_low.kind", "psmrt calls it \"free_slip\""),
    Bad("kind = \"wall\"", "kind = \"outflow\"", "faces.y_low.kind", "psmrt calls it \"free_outflow\""),
    Bad("kind = \"wall\"", "kind = \"Wall\"", "faces.y_low.kind", "psmrt calls it \"wall\""),
    Bad("model = \"mrt\"", "model = \"BGK\"", "collision.model", "psmrt calls it \"srt\""),
    Bad("density = 1000.0", "density = \"1000\"", "fluid.density", "leave out the quotation marks: 1000"),
    Bad("every_steps = 100\n", "every_steps = 1e2\n", "records[0].every_steps", "write 100"),
    Bad("formats = [\"vti\"]", "formats = \"vti\"", "records[2].formats", "write [\"vti\"]"),
    Bad("steps = 1000\n[stop]", "steps = 99999999999999999999\n[stop]", "", "9223372036854775807 is the limit"),
    Bad("density = 1000.0", "density = 1e999", "", "1.8e308 is the limit"),
    // Lists of a wrong length.
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [1e-3, 5e-4, 5e-4, 9.0]", "domain.size", "three values [x, y, z]; 4 are given"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "cells = [8, 8, 8, 99]", "domain.cells", "three values [x, y, z]; 4 are given"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [1e-3, 5e-4]", "domain.size", "three values [x, y, z]; 2 are given"),
    Bad("acceleration = [0.0, 0.0, 0.0]", "acceleration = [0.0, 0.0, 0.0, 1.0]", "body_force.acceleration", "4 are given"),
    Bad("acceleration = [0.0, 0.0, -9.81]", "acceleration = []", "gravity.acceleration", "0 are given"),
    Bad("spin = [0.0, 1.0, 0.0]", "spin = [0.0, 1.0, 0.0, 0.0]", "grains[1].spin", "4 are given"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3\ndiameter_range = [1e-4, 2e-4, 3e-4]", "grains[0].diameter_range", "two values [low, high]; 3 are given"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"array\"\ncounts = [1, 1, 1, 1]", "grains[0].counts", "4 are given"),
    Bad("velocity = [1e-3, 0.0, 0.0] }\nx_high", "velocity = [1e-3, 0.0, \"0\"] }\nx_high", "faces.x_low.velocity", "a number"),
    // Types.
    Bad("density = 1000.0", "density = \"1000\"", "fluid.density", "a number"),
    Bad("tau = 0.8", "tau = true", "time.tau", "a number"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [1e-3, 5e-4]", "domain.size", "[x, y, z]"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = 1e-3", "domain.size", "[x, y, z]"),
    Bad("every_steps = 100\n", "every_steps = 100.5\n", "records[0].every_steps", "a whole number"),
    Bad("[body_force]\nacceleration = [0.0, 0.0, 0.0]", "[[body_force]]\nacceleration = [0.0, 0.0, 0.0]", "body_force", "only one such section"),
    Bad("y_high.kind = \"free_slip\"", "y_high = \"free_slip\"", "faces.y_high", "write `y_high.kind = \"free_slip\"`"),
    // Missing.
    Bad("dx = 2.5e-5\n", "", "domain.dx", "Edge of a cell, m"),
    Bad("kinematic_viscosity = 1e-6\n", "", "fluid.kinematic_viscosity", "m2/s"),
    Bad("tau = 0.8\n", "", "time", "`dt` (s), `tau`"),
    Bad("magic = 0.25\n", "", "collision.magic", "0.1875"),
    Bad("size = [1e-3, 5e-4, 5e-4]\n", "", "domain", "size = [x, y, z]"),
    Bad("diameter = 2e-4\n", "", "grains[0].diameter", "in m"),
    Bad("centre = [3e-4, 2.5e-4, 2.5e-4]\n", "", "grains[0].centre", "in m"),
    Bad("axis = \"x\"\n", "", "records[1].axis", "a profile or slice needs it"),
    Bad("spin = [0.0, 1.0, 0.0]\n", "", "grains[1].motion", "rad/s"),
    Bad("samples = 4\n", "", "solid.samples", "sampled"),
    Bad("time = 0.01\n", "", "stop", "`steps`"),
    Bad("velocity = [1e-3, 0.0, 0.0] }\nx_high", "}\nx_high", "faces.x_low.velocity", "m/s"),
    Bad(", pressure = 0.0", "", "faces.x_high.pressure", "Pa"),
    // Values.
    Bad("density = 1000.0", "density = -1000.0", "fluid.density", "above 0"),
    Bad("density = 1000.0", "density = nan", "fluid.density", "positive and finite"),
    Bad("kinematic_viscosity = 1e-6", "kinematic_viscosity = inf", "fluid.kinematic_viscosity", "positive and finite"),
    Bad("kinematic_viscosity = 1e-6", "kinematic_viscosity = 0", "fluid.kinematic_viscosity", "above 0"),
    Bad("dx = 2.5e-5", "dx = -2.5e-5", "domain.dx", "above 0"),
    Bad("dx = 2.5e-5", "dx = 2.4e-5", "domain.size", "whole number"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [1e-3, -5e-4, 5e-4]", "domain.size", "above 0"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [1e9, 5e-4, 5e-4]", "domain.size", "too many"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [260.0, 5e-4, 5e-4]", "domain.size", "this machine has"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "size = [1e300, 1e300, 1e300]", "domain.size", "too many"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "cells = [40, 0, 20]", "domain.cells", "at least 1"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "cells = [40, -3, 20]", "domain.cells", "at least 1"),
    Bad("size = [1e-3, 5e-4, 5e-4]", "cells = [9000000000, 9000000000, 9]", "domain.cells", "too many"),
    Bad("tau = 0.8", "tau = 0.5", "time.tau", "above 0.5"),
    Bad("tau = 0.8", "tau = nan", "time.tau", "above 0.5"),
    Bad("tau = 0.8", "dt = 0.0", "time.dt", "above 0"),
    Bad("tau = 0.8", "dt = 1e-30", "time.dt", "tau"),
    Bad("tau = 0.8", "lattice_velocity = 0.9\nreference_velocity = 1e-3", "time.lattice_velocity", "at most 0.2"),
    Bad("magic = 0.25", "magic = -0.25", "collision.magic", "positive"),
    Bad("s_e = 1.1", "s_e = 2.0", "collision.s_e", "between 0 and 2"),
    Bad("acceleration = [0.0, 0.0, 0.0]", "acceleration = [0.0, nan, 0.0]", "body_force.acceleration", "finite"),
    Bad("acceleration = [0.0, 0.0, 0.0]", "acceleration = [0.0, 1e9, 0.0]", "body_force.acceleration", "weaker"),
    Bad("samples = 4", "samples = 0", "solid.samples", "between 1 and 100"),
    Bad("time = 0.01", "time = 1e-9", "stop.time", "half a time step"),
    Bad("time = 0.01", "time = 1e300", "stop.time", "time steps"),
    Bad("time = 0.01", "steps = 0", "stop.steps", "at least 1"),
    Bad("tolerance = 1e-6", "tolerance = 1.5", "stop.steady.tolerance", "between 0 and 1"),
    Bad("every_steps = 1000", "every_steps = -1", "checkpoint.every_steps", "at least 1"),
    Bad("every_steps = 1000", "every_minutes = 0.0", "checkpoint.every_minutes", "above 0"),
    Bad("formats = [\"vti\"]", "formats = []", "records[2].formats", "empty"),
    Bad("name = \"line\"", "name = \"a/b\"", "records[1].name", "letters"),
    Bad("name = \"line\"", "name = \"box\"", "records[1].name", "another record"),
    Bad("point = [0.0, 2.5e-4, 2.5e-4]", "point = [0.0, 9e-4, 2.5e-4]", "records[1].point", "outside the box"),
    // Too fast.
    Bad("velocity = [1e-3, 0.0, 0.0] }\nx_high", "velocity = [9.0, 0.0, 0.0] }\nx_high", "faces.x_low.velocity", "Mach"),
    Bad("spin = [0.0, 1.0, 0.0]", "spin = [0.0, 1e6, 0.0]", "grains[1].spin", "cells per time step"),
    Bad("pressure = 0.0", "pressure = 1e6", "faces.x_high.pressure", "Pa are allowed"),
    // Contradictions.
    Bad("tau = 0.8", "tau = 0.8\ndt = 1e-5", "time.tau", "exactly one"),
    Bad("tau = 0.8", "tau = 0.8\nlattice_velocity = 0.05", "time.lattice_velocity", "exactly one"),
    Bad("tau = 0.8", "tau = 0.8\nreference_velocity = 0.05", "time.reference_velocity", "belongs to"),
    Bad("dx = 2.5e-5", "dx = 2.5e-5\ncells = [40, 20, 20]", "domain.cells", "one of them"),
    Bad("model = \"mrt\"", "model = \"srt\"", "collision.rates", "belongs to"),
    Bad("rates = \"magic\"", "rates = \"dhumieres\"", "collision.magic", "belongs to"),
    Bad("every_steps = 100\n", "every_steps = 100\nevery = 1.0\n", "records[0].every_steps", "one of them"),
    Bad("y_high.kind = \"free_slip\"", "y_high = { kind = \"free_slip\", velocity = [1e-3, 0.0, 0.0] }", "faces.y_high.velocity", "belongs to"),
    Bad("pressure = 0.0 }", "pressure = 0.0, velocity = [0.0, 0.0, 0.0] }", "faces.x_high.velocity", "belongs to"),
    Bad("y_high.kind = \"free_slip\"", "", "faces.y_low", "periodic"),
    Bad("kind = \"pressure\", pressure = 0.0", "kind = \"wall\"", "faces.x_low", "no face lets it out"),
    Bad("kind = \"velocity_inlet\", velocity = [1e-3, 0.0, 0.0] }\nx_high = { kind = \"pressure\", pressure = 0.0", "kind = \"wall\" }\nx_high = { kind = \"free_outflow\"", "faces.x_high", "nothing determines the flow"),
    Bad("\"wall\", velocity = [1e-3, 0.0, 0.0]", "\"wall\", velocity = [0.0, 1e-3, 0.0]", "faces.y_low.velocity", "its own plane"),
    Bad("axis = \"x\"\npoint", "axis = \"x\"\nformats = [\"vti\"]\npoint", "records[1].formats", "belongs to"),
    Bad("axis = \"x\"\npoint", "axis = \"x\"\nquantity = \"speed\"\npoint", "records[1].quantity", "belongs to"),
    Bad("axis = \"x\"\npoint", "axis = \"x\"\nrange = [0.0, 1.0]\npoint", "records[1].range", "belongs to"),
    Bad("kind = \"profile\"", "kind = \"slice\"\nrange = [1.0, 0.5]", "records[1].range", "must be above its first"),
    Bad("kind = \"profile\"", "kind = \"slice\"\nrange = [0.0, inf]", "records[1].range", "must be finite"),
    Bad("record = \"box\"", "record = \"line\"", "stop.steady.record", "not of kind `box`"),
    Bad("record = \"box\"", "record = \"boks\"", "stop.steady.record", "no record of that name"),
    Bad("every_steps = 100\n", "", "stop.steady.record", "add `every_steps = 100`"),
    Bad("column = \"density\"", "column = \"mass\"", "stop.steady.column", "superficial_velocity_x"),
    Bad("name = \"box\"\nkind = \"box\"", "name = \"box\"\nkind = \"loads\"", "stop.steady.column", "force_x, force_y, force_z"),
    Bad("[engine]", "[compare]\nexact = \"plane_poiseuille\"\n[engine]", "compare.exact", "no plane Poiseuille flow"),
    // Grains.
    Bad("diameter = 2e-4", "diameter = -2e-4", "grains[0].diameter", "above 0"),
    Bad("diameter = 2e-4", "diameter = 4e-5", "grains[0].diameter", "cells across"),
    Bad("diameter = 2e-4", "diameter = 2e-4\nlattice = \"sc\"", "grains[0].lattice", "belongs to"),
    Bad("diameter = 2e-4", "diameter = 2e-4\nspin = [0.0, 0.0, 1.0]", "grains[0].spin", "belongs to"),
    Bad("centre = [3e-4, 2.5e-4, 2.5e-4]", "centre = [3e-3, 2.5e-4, 2.5e-4]", "grains[0].centre", "outside the box"),
    Bad("centre = [3e-4, 2.5e-4, 2.5e-4]", "centre = [5e-5, 2.5e-4, 2.5e-4]", "grains[0].centre", "sticks"),
    Bad("centre = [3e-4, 2.5e-4, 2.5e-4]", "centre = [8e-4, 2.5e-4, 2.5e-4]", "grains[1].centre", "overlap"),
    Bad("centre = [3e-4, 2.5e-4, 2.5e-4]", "centre = [inf, 2.5e-4, 2.5e-4]", "grains[0].centre", "finite"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"csv\"", "grains[0].file", "relative"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"csv\"\nfile = \"none.csv\"", "grains[0].file", "cannot be read"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"array\"\nlattice = \"sc\"\nsolid_fraction = 0.2", "grains[0].counts", "cubes"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"array\"\nlattice = \"sc\"\ncounts = [2, 1, 1]\nsolid_fraction = 1.2", "grains[0].solid_fraction", "0.5236"),
    // Generated grains.
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ndiameter = 1e-4", "grains[0].count", "`solid_fraction`"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 0\ndiameter = 1e-4", "grains[0].count", "at least 1"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3", "grains[0].diameter", "`diameter_range`"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3\nsolid_fraction = 0.1\ndiameter = 1e-4", "grains[0].solid_fraction", "one of them"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\nsolid_fraction = 0.9\ndiameter = 1e-4", "grains[0].solid_fraction", "0.74"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\nsolid_fraction = 0.1\ndiameter = 1e-9", "grains[0].diameter", "cells across"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\nsolid_fraction = 0.45\ndiameter = 1e-4", "grains[0].kind", "random places run out"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3\ndiameter = 1e-4\nseed = -1", "grains[0].seed", "at least 0"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3\ndiameter = 1e-4\ngap = -1e-6", "grains[0].gap", "not negative"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3\ndiameter_range = [2e-4, 1e-4]", "grains[0].diameter_range", "smaller first"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"random\"\ncount = 3\ndiameter = 6e-4", "grains[0].count", "do not fit"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"bed\"\ncount = 3\ndiameter = 1e-4", "grains[0].kind", "z_low"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"bed\"\ndiameter = 1e-4", "grains[0].count", "number of grains"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"bed\"\ncount = 30000\ndiameter = 1e-4", "grains[0].count", "20000 is the limit"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"bed\"\ncount = 3\ndiameter = 1e-4\nsolid_fraction = 0.3", "grains[0].solid_fraction", "belongs to"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\nseed = 3\ndiameter = 2e-4", "grains[0].seed", "belongs to"),
    Bad("kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4", "kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\npacking_friction = 0.3\ndiameter = 2e-4", "grains[0].packing_friction", "belongs to"),
    // Free grains.
    Bad("density = 2650.0", "", "grains[2].density", "quartz"),
    Bad("density = 2650.0", "density = -2650.0", "grains[2].density", "above 0"),
    Bad("density = 2650.0", "density = 2.65", "grains[2].density", "kg/m3"),
    Bad("density = 2650.0", "density = 2650.0\nvelocity = [0.0, 9.0, 0.0]", "grains[2].velocity", "Mach"),
    Bad("diameter = 2e-4", "diameter = 2e-4\ndensity = 2650.0", "grains[0].density", "belongs to"),
    Bad("motion = \"free\"\ndensity = 2650.0", "", "gravity", "no grain of the scene is free"),
    Bad("motion = \"free\"\ndensity = 2650.0\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\nform = \"reduced\"", "", "contact", "no grain of the scene is free"),
    Bad("acceleration = [0.0, 0.0, -9.81]", "acceleration = [0.0, 0.0, -9.81e9]", "gravity.acceleration", "shorter time step"),
    Bad("acceleration = [0.0, 0.0, -9.81]", "acceleration = [0.0, 0.0, nan]", "gravity.acceleration", "finite"),
    Bad("acceleration = [0.0, 0.0, -9.81]", "", "gravity.acceleration", "m/s2"),
    Bad("form = \"reduced\"", "form = \"reducd\"", "gravity.form", "did you mean `reduced`?"),
    Bad("duration = 6e-4", "duration = 0.0", "contact.duration", "above 0"),
    Bad("duration = 6e-4", "duration = 6e-4\nstiffness = 3.0", "contact.duration", "one of them"),
    Bad("duration = 6e-4", "damping = 6e-4", "contact.damping", "belongs to `stiffness`"),
    Bad("duration = 6e-4", "stiffness = 1.0\ndamping = 1e-6", "contact.restitution", "one of them"),
    Bad("duration = 6e-4", "stiffness = -1.0", "contact.stiffness", "above 0"),
    Bad("duration = 6e-4\nrestitution = 0.6", "stiffness = 1.0\ndamping = -1e-6", "contact.damping", "negative"),
    Bad("restitution = 0.6", "restitution = 1.1", "contact.restitution", "between 0.01 and 1"),
    Bad("restitution = 0.6", "restitution = 0.0", "contact.restitution", "between 0.01 and 1"),
    Bad("friction = 0.4", "friction = 0.0", "contact.tangential_ratio", "belongs to"),
    Bad("friction = 0.4", "friction = -0.4", "contact.friction", "negative"),
    Bad("tangential_ratio = 0.3", "tangential_ratio = 0.0", "contact.tangential_ratio", "positive"),
    Bad("rolling_resistance = 0.05", "rolling_resistance = inf", "contact.rolling_resistance", "finite"),
    Bad("rolling_resistance = 0.05", "rolling_resistance = 0.05\nsubsteps = 0", "contact.substeps", "between 1"),
    Bad("rolling_resistance = 0.05", "substeps = 1", "contact.substeps", "2 sub-steps or more"),
    Bad("duration = 6e-4", "duration = 1e-12", "contact.duration", "sub-steps"),
    Bad("internal_fluid = \"lagged\"", "internal_fluid = \"implicit\"", "coupling.internal_fluid", "lagged, kept"),
    Bad("internal_fluid = \"lagged\"", "average_loads = 2", "coupling.average_loads", "true or false"),
    Bad("[coupling]", "[lubrication]\n[coupling]", "lubrication", "mirror plane"),
    Bad("y_high.kind = \"free_slip\"", "y_high.kind = \"wall\"\n[lubrication]\nsmallest_gap = -1e-9", "lubrication.smallest_gap", "above 0"),
    Bad("y_high.kind = \"free_slip\"", "y_high.kind = \"wall\"\n[lubrication]\ncutoff_gap = 1e-9", "lubrication.cutoff_gap", "a thousandth"),
    Bad("centre = [5e-4, 2.5e-4, 2.5e-4]", "centre = [5e-4, 4.9e-4, 2.5e-4]", "grains[2].centre", "its own image"),
    Bad("centre = [5e-4, 2.5e-4, 2.5e-4]", "centre = [5e-4, 5e-4, 2.5e-4]", "grains[0].centre", "all centres on the plane or none"),
    Bad("column = \"density\"", "column = \"kinetic_energy\"", "stop.steady.column", "superficial_velocity_x"),
    Bad("motion = \"free\"\ndensity = 2650.0\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\nform = \"reduced\"\n[contact]\nduration = 6e-4\nrestitution = 0.6\nfriction = 0.4\ntangential_ratio = 0.3\nrolling_resistance = 0.05\n[coupling]\ninternal_fluid = \"lagged\"", "[[records]]\nname = \"m\"\nkind = \"grain_means\"", "records[0].kind", "no free grains"),
    // Not TOML.
    Bad("density = 1000.0", "density = ", "", "not valid TOML"),
    Bad("density = 1000.0", "density = 1000.0\ndensity = 1000.0", "", "not valid TOML"),
    Bad("[fluid]", "[fluid", "", "not valid TOML"),
    Bad("density = 1000.0", "density = 1000 kg", "", "not valid TOML"),
];

fn check(folder: &Folder, name: &str) -> std::process::Output {
    psmrt_in(&folder.path(""), &["check", name])
}

#[test]
fn the_scene_that_the_wrong_ones_differ_from_is_right() {
    let folder = Folder::new("good");
    folder.write("scene.toml", GOOD);
    let output = check(&folder, "scene.toml");
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn each_wrong_scene_gets_one_message_with_its_place_and_remedy() {
    assert!(BAD.len() >= 60);
    let folder = Folder::new("bad");
    let mut wrong = Vec::new();
    for Bad(from, to, key, told) in BAD {
        let at = GOOD.find(from).unwrap_or_else(|| panic!("{from}"));
        let name = "wrong.toml";
        folder.write(name, format!("{}{to}{}", &GOOD[..at], &GOOD[at + from.len()..]));
        let output = psmrt_in(&folder.path(""), &["run", name]);
        let said = stderr(&output);
        let case = format!("{from:?} -> {to:?}:\n{said}");
        for (right, claim) in [
            (output.status.code() == Some(2), "exit code 2"),
            (said.matches("error: ").count() == 1, "one message"),
            (said.starts_with(&format!("error: {key}")), "the key comes first"),
            (said.contains(told), told),
            (said.contains("--> wrong.toml:"), "file and line"),
            (said.contains("= help: "), "a remedy"),
            (folder.entries() == [name], "nothing is made"),
        ] {
            if !right {
                wrong.push(format!("not so: {claim}, in {case}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_line_is_that_of_the_value() {
    let folder = Folder::new("line");
    folder.write("wrong.toml", GOOD.replace("tau = 0.8", "tau = 0.4"));
    let output = psmrt_in(&folder.path(""), &["check", "wrong.toml", "--json"]);
    let said: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let error = &said["error"];
    assert_eq!(error["file"], "wrong.toml");
    assert_eq!(error["line"], 9);
    assert_eq!(error["key"], "time.tau");
    assert_eq!(error["value"], "0.4");
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = Folder::new("no_scene");
    folder.write("empty.toml", "");
    folder.write("blank.toml", " \n\n");
    folder.write("binary.toml", [0x7f, b'E', b'L', b'F', 0xff, 0xfe, 0, 1]);
    folder.write("nul.toml", [0; 64]);
    folder.write("long.toml", "a".repeat(1 << 20));
    folder.write("deep.toml", "a = ".to_owned() + &"[".repeat(100_000));
    folder.write("comment.toml", "# nothing\n");
    let before = folder.entries();
    for name in before.iter().map(String::as_str).chain(["absent.toml", "."]) {
        let output = psmrt_in(&folder.path(""), &["run", name]);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{name}: {said:.2000}");
        assert!(said.contains(name) && said.contains("help: "), "{name}: {said:.2000}");
    }
    assert_eq!(folder.entries(), before);
}

#[test]
fn wrong_changes_on_the_command_line_are_refused() {
    let folder = Folder::new("set");
    folder.write("scene.toml", GOOD);
    for (change, told) in [
        ("time.tau", "has no `=`"),
        ("=3", "names no key"),
        ("grains[7].diameter=1e-4", "no such section"),
        ("time.tau=0.5", "above 0.5"),
        ("time.tua=0.6", "did you mean `tau`?"),
        ("title.x=1", "no such"),
        ("tau=0.6", "did you mean `time.tau`?"),
        ("y_high.kind=\"wall\"", "did you mean `faces.y_high`?"),
        ("records[0]=5", "a section, not a value"),
        ("records[0].=5", "is no key"),
        ("records[0x]=5", "is no key"),
        ("records[-1].name=a", "is no key"),
        ("grains[0]={ kind = \"sphere\" }", "grains[0].centre"),
        ("grains[0].diameter.x=1", "no such key"),
        ("records={ name = \"z\", kind = \"box\" }", "write [[records]]"),
        ("grains=5", "write [[grains]]"),
        ("domain.cells=[8, 8, 8, 99]", "4 are given"),
    ] {
        let output = psmrt_in(&folder.path(""), &["run", "scene.toml", "--set", change]);
        assert_eq!(output.status.code(), Some(2), "{change}");
        assert!(stderr(&output).contains(told), "{change}: {}", stderr(&output));
    }
    let twice = ["check", "scene.toml", "--set", "time.tau=0.7", "--set", "time . tau=0.9"];
    let engine = ["check", "scene.toml", "--set", "engine.kind=reference", "--engine", "wgpu"];
    for arguments in [twice, engine] {
        let output = psmrt_in(&folder.path(""), &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains("set twice"), "{arguments:?}: {}", stderr(&output));
    }
    assert_eq!(folder.entries(), ["scene.toml"]);
}

#[test]
fn a_section_set_on_the_command_line_replaces_the_section() {
    let grain = "grains[0]={kind=\"sphere\",centre=[3e-4,2.5e-4,2.5e-4],diameter=1.5e-4}";
    let changes = [grain, "records[1]={name=\"z\",kind=\"box\"}", "stop.steps=7"].map(String::from);
    let scene = Scene::from_bytes("s", GOOD.as_bytes().to_vec(), Path::new(""), &changes).unwrap();
    let solids = &scene.setup.solid_phase.as_ref().unwrap().solids;
    // 1.5e-4 m and twice 1e-4 m in cells of 2.5e-5 m.
    let expected = [3.0, 2.0, 2.0].map(|radius| Shape::Sphere { radius });
    assert_eq!(solids.len(), 3);
    for (solid, right) in solids.iter().zip(expected) {
        assert_eq!(format!("{:.9?}", solid.shape), format!("{right:.9?}"));
    }
    let names: Vec<&str> = scene.records.iter().map(|record| record.name.as_str()).collect();
    assert_eq!(names, ["box", "z", "all"]);
    assert_eq!(scene.stop.steps, 7);
}

#[test]
fn a_folder_with_something_in_it_is_never_written_to() {
    let folder = Folder::new("occupied");
    folder.write("scene.toml", GOOD);
    let output = psmrt_in(&folder.path(""), &["run", "scene.toml", "--out", "."]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("not empty"), "{}", stderr(&output));
    assert_eq!(folder.entries(), ["scene.toml"]);
}
