//! The full form of the sphere that oscillates: grids, operators, relaxation times and boxes.
//!
//! Adds one row per run to `golden/oscillating/study.csv` as it goes; runs that have a row are left out, so that it can
//! be cut off and started again. A quarter of an hour on two cores.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example oscillating_study
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt_validation::cases::{Bench, OscillatingSphere, Study};

const BASE: OscillatingSphere =
    OscillatingSphere { radius: 6, side: 12, layer: 0.5, tau: 0.6, operator: "bounce_back" };

fn main() -> Result<(), Box<dyn Error>> {
    let mut runs = vec![
        OscillatingSphere { side: 8, ..BASE },
        OscillatingSphere { side: 16, ..BASE },
        OscillatingSphere { tau: 0.8, ..BASE },
        OscillatingSphere { tau: 0.55, ..BASE },
        OscillatingSphere { tau: 0.52, ..BASE },
    ];
    runs.extend([8, 12, 16].map(|side| OscillatingSphere { radius: 4, side, layer: 1.0, ..BASE }));
    for operator in ["bounce_back", "full_bounce_back"] {
        runs.extend([4, 6, 8].map(|radius| OscillatingSphere { radius, operator, ..BASE }));
    }
    // The shortest first: a run takes the fifth power of the radius, with a given layer.
    let cost = |run: &OscillatingSphere| {
        let lengths = f64::from(run.radius).powi(5) * f64::from(run.side).powi(3);
        lengths * run.layer.powi(2) / (run.tau - 0.5)
    };
    runs.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let mut bench = Bench::new(Path::new("golden"), EngineName::CpuSingle, None, |_| {});
    let study = Study::new("golden/oscillating/study.csv");
    for run in runs {
        let start = run.start();
        if study.row(&format!("{start},"))?.is_none() {
            study.add(&run.row(&mut bench)?)?;
            println!("{start}");
        }
    }
    Ok(())
}
