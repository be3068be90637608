//! A scene that needs more memory than there is says so before it starts.

#![cfg(target_os = "linux")]

use std::process::Command;

use crate::cli::{Folder, stderr};
use crate::common::Budget;
use crate::scenes::water;

const SECTIONS: &str = "[[records]]\nname = \"box\"\nkind = \"box\"\nevery_steps = 1\n[checkpoint]\n\
                        every_steps = 1\n[stop]\nsteps = 2\n";

#[test]
fn a_run_within_any_limit_of_memory_either_ends_well_or_is_refused_with_figures() {
    // Three runs that fit.
    Budget::oracle(1_572_864).spend(3 * 2 * 64 * 64 * 64);
    let folder = Folder::new("memory");
    folder.write("scene.toml", water([64, 64, 64], 1e-5, SECTIONS));
    let mut codes = Vec::new();
    for mebibytes in [60, 100, 150, 200, 1000] {
        let out = format!("out_{mebibytes}");
        let script = format!(
            "ulimit -c 0; ulimit -v {}; exec {} run scene.toml --out {out}",
            mebibytes * 1024,
            env!("CARGO_BIN_EXE_psmrt")
        );
        let output = Command::new("sh")
            .args(["-c", &script])
            .env("RAYON_NUM_THREADS", "2")
            .current_dir(folder.path(""))
            .output()
            .unwrap();
        let said = stderr(&output);
        codes.push(output.status.code());
        match output.status.code() {
            Some(0) => {}
            Some(2) => {
                // 19 numbers of 8 bytes in each of 64³ cells.
                for part in ["64 x 64 x 64 cells", "populations 38.0 MiB", "ulimit -v", "domain.dx"]
                {
                    assert!(said.contains(part), "{mebibytes} MiB: {part}: {said}");
                }
                assert!(!folder.path(&out).exists(), "{mebibytes} MiB");
            }
            code => panic!("{mebibytes} MiB: ended with {code:?}: {said}"),
        }
    }
    assert!(codes[0] == Some(2) && codes[4] == Some(0), "{codes:?}");
}
