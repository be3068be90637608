//! The acceptance cases on the kernel: the same scenes and the same claims as on the oracle.

use crate::common::Budget;
use crate::trials::{self, Claim};
use psmrt::engine::EngineName;
use psmrt_validation::cases::{Bench, CASES, Golden, steadiness};
use std::path::Path;

fn holds(name: &str, budget: &mut Budget) {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    let case = CASES.iter().find(|case| case.name == name).unwrap();
    let mut bench = Bench::new(&golden, EngineName::Wgpu, Some(trials::gpu().unwrap()), |_| {});
    let rows = bench.measure(case).unwrap_or_else(|error| panic!("{name}: {error}"));
    budget.spend(bench.cell_updates());
    let steady = steadiness(bench.engine_name().word(), &bench.settled());
    for claim in (case.judge)(&Golden::of(case, &golden), &rows).unwrap().iter().chain(&steady) {
        println!("{name}: {}: {:.3e}", claim.what, claim.measured);
        assert!(claim.holds(), "{name}: {claim:?}");
    }
}

fn poiseuille_flow_holds_its_claims() {
    holds("poiseuille", &mut Budget::kernel(5_000_000));
}

fn flow_in_a_duct_holds_its_claims() {
    holds("duct", &mut Budget::kernel(6_000_000));
}

fn a_sphere_in_a_stream_holds_its_claims() {
    holds("sphere_drag", &mut Budget::kernel(62_000_000));
}

fn seepage_through_a_bed_holds_its_claims() {
    holds("seepage", &mut Budget::kernel(28_000_000));
}

fn permeability_holds_its_claims() {
    holds("permeability", &mut Budget::kernel(95_000_000));
}

fn sphere_arrays_hold_their_claims() {
    holds("sphere_arrays", &mut Budget::kernel(90_000_000));
}

fn a_settling_grain_holds_its_claims() {
    holds("stokes_settling", &mut Budget::kernel(24_500_000));
}

fn a_settling_suspension_holds_its_claims() {
    holds("suspension", &mut Budget::kernel(19_700_000));
}

fn a_sphere_in_a_tank_holds_its_claims() {
    holds("ten_cate", &mut Budget::kernel(18_000_000));
}

fn a_settling_cloud_holds_its_claims() {
    holds("cloud_settling", &mut Budget::kernel(66_000_000));
}

/// The trials.
pub const CLAIMS: &[Claim] = &[
    ("poiseuille_flow_holds_its_claims", poiseuille_flow_holds_its_claims),
    ("flow_in_a_duct_holds_its_claims", flow_in_a_duct_holds_its_claims),
    ("a_sphere_in_a_stream_holds_its_claims", a_sphere_in_a_stream_holds_its_claims),
    ("seepage_through_a_bed_holds_its_claims", seepage_through_a_bed_holds_its_claims),
    ("permeability_holds_its_claims", permeability_holds_its_claims),
    ("sphere_arrays_hold_their_claims", sphere_arrays_hold_their_claims),
    ("a_settling_grain_holds_its_claims", a_settling_grain_holds_its_claims),
    ("a_settling_suspension_holds_its_claims", a_settling_suspension_holds_its_claims),
    ("a_sphere_in_a_tank_holds_its_claims", a_sphere_in_a_tank_holds_its_claims),
    ("a_settling_cloud_holds_its_claims", a_settling_cloud_holds_its_claims),
];
