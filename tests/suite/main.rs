//! All tests that need no device and no other language, as one binary: `cargo test --test suite scene_lists::`
//! runs those of a file.
//!
//! They run side by side in one process, so none changes its environment or its working directory; the
//! program is run as a process of its own, in a folder of the test's own (`cli::Folder`).

#[path = "../cli/mod.rs"]
mod cli;
#[path = "../common/mod.rs"]
mod common;
#[path = "../conformance/mod.rs"]
mod conformance;
#[path = "../driven/mod.rs"]
mod driven;
#[path = "../edges/mod.rs"]
mod edges;
#[path = "../implicit/mod.rs"]
mod implicit;
#[path = "../mixed/mod.rs"]
mod mixed;
#[path = "../moving_bodies/mod.rs"]
mod moving_bodies;
#[path = "../scenes/mod.rs"]
mod scenes;
#[path = "../surfaces/mod.rs"]
mod surfaces;

mod agreement;
mod bad_scenes;
mod bed_records;
mod bits;
mod bodies;
mod bodies_in_flow;
mod circles;
mod cli_folder;
mod cli_info;
mod cli_memory;
mod cli_pack;
mod cli_permeability;
mod cli_prints;
mod cli_resume;
mod cli_resume_refused;
mod cli_run;
mod cli_sweep;
mod cli_viscosity;
mod closed_columns;
mod conformance_files;
mod conformance_oracle;
mod cpu_engine;
mod diagnosis;
mod drive;
mod dry;
mod dry_refused;
mod exact_text;
mod extremes;
mod going_on;
mod image_files;
mod images;
mod implicit_coupling;
mod in_time;
mod kernel_coverage;
mod load_means;
mod mapped_lists;
mod meshes;
mod oscillating;
mod packing;
mod packing_places;
mod permeability;
mod plan;
mod point_files;
mod predictions;
mod records;
mod scene_bad_input;
mod scene_check;
mod scene_contacts;
mod scene_free;
mod scene_gravity;
mod scene_hertz;
mod scene_lists;
mod scene_mutations;
mod scene_open_faces;
mod scene_outputs;
mod scene_overlaps;
mod scene_remedies;
mod scene_ways;
mod starts;
mod steady;
mod tidy;
