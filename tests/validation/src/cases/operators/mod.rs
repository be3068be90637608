//! The operators of the solid beside each other: where inertia counts, where grains move, in arrays of every density.
//!
//! | file | what it runs |
//! |---|---|
//! | `set.rs`, `sets.rs` | the tables that `cargo validate operators` makes |
//! | `stream.rs` | a sphere in a stream |
//! | `beds.rs` | regular and random beds, creeping and not |
//! | `spinning.rs`, `towed.rs` | a sphere that spins; one that is towed or settles, and how evenly |
//! | `limits.rs` | how fast the flow through a bed may be |
//! | `falls.rs` | ten Cate's settling sphere |
//! | `yardstick.rs` | what runs are held to where no exact value is known |
//! | `claims.rs`, `bed_claims.rs`, `figures.rs` | what is claimed, and what is shown |

mod bed_claims;
mod beds;
mod claims;
mod falls;
mod figures;
mod limits;
mod set;
mod sets;
mod spinning;
mod stream;
mod towed;
mod yardstick;

use psmrt_report::Figure;

use super::{Bench, Case, CaseError, Claim, Golden};
use crate::tradeoff::row::Row;
use psmrt::table::Table;
use yardstick::{in_duct, streams};

pub use set::Set;
pub use sets::SETS;

/// The paper's operator, full bounce-back and graded viscosity, as scenes spell them.
const BOUNCE_BACK: &str = "bounce_back";
const FULL: &str = "full_bounce_back";
const GRADED: &str = "graded_viscosity";

/// All of them.
const OPERATORS: [&str; 3] = [BOUNCE_BACK, FULL, GRADED];

/// Their weights, as tables of the trade-off study spell them.
const WEIGHTS: [&str; 3] = ["NT", "NT", "graded"];

/// Viscosity of all scenes, m2/s.
const SI_VISCOSITY: f64 = 1e-6;

/// The operators beside each other.
pub const CASE: Case = Case {
    name: "operators",
    title: "The operators of the solid: inertia, motion, arrays of every density",
    about: &[
        "What happens in cells that a solid fills, wholly or in part, is a choice: the paper's non-equilibrium bounce-back (SC1), full \
         bounce-back (SC3), or graded viscosity, of psmrt's own making. The trade-off study compares them in creeping flow \
         through beds; here are a sphere in the paper's stream and beds at Reynolds numbers to 130, spheres that spin, are towed \
         and settle, and regular arrays from 0.1 to 0.7 of solid. d'Humieres' rates but where SRT is named, double precision \
         but where single is.",
        "Yardsticks: in creeping flow exact values. In the stream exact for Re -> 0, else what the paper's operator leads to on 12 and \
         16 cells per diameter (case sphere_drag). In beds where inertia counts what the two finest grids of all three operators \
         lead to, extrapolated as second order and corrected by what the same is off in creeping flow: 2 % in the face-centred, 3.5 % in the simple array, 5.4 % in the random bed.",
        "Graded viscosity has the smaller error than the paper's operator, or one at most 1.5 % of the drag larger, in the stream at \
         every Re, in every creeping array, and in beds as long as the fluid crosses a cell slowly, U dx/nu below 2. Where it is faster and \
         the grid coarse, cut cells, which hold the fluid by their viscosity alone, let it in: at 10.5 cells per diameter and Re 130 \
         in the densest bed its drag is 10 to 12 % too small at tau 0.503 to 0.51. There the paper's error goes from +10 to \
         -12 %, and is the smaller one by 9 % where it passes through zero, at 0.505. And the force on a grain that is towed is \
         noisy with graded viscosity: about 1 % at 12 cells, from one step to the next.",
        "The drag's error falls at second order with the paper's, by its leak. That of graded viscosity falls until a first-order \
         part is left, walls up to 0.06 cells in the fluid (golden/ps_channel_wall/graded.csv): 1 to 1.5 % too much drag in simple \
         arrays of 14 to 24 cells per diameter and more.",
    ],
    scenes: &[],
    literature: &["../sphere_drag/duct.csv"],
    rows: "stream.csv",
    studies: &[
        "beds.csv",
        "limits.csv",
        "arrays.csv",
        "spinning.csv",
        "towed.csv",
        "ten_cate.csv",
        "../sphere_drag/study.csv",
    ],
    units: "errors relative; lattice_velocity and max_speed in cells per step; sizes in cells",
    full: "cargo validate operators --out golden/operators made these rows, with spinning.toml and towed.toml beside them; half an \
           hour, and it can be cut off",
    measure,
    judge,
    draw,
};

/// What the claims and figures rest on.
struct Tables {
    stream: Table,
    beds: Vec<Row>,
    limits: Vec<Row>,
    arrays: Vec<Row>,
    spinning: Table,
    towed: Table,
    ten_cate: Table,
}

impl Tables {
    fn of(golden: &Golden, stream: &Table) -> Result<Self, CaseError> {
        Ok(Tables {
            stream: stream.clone(),
            beds: Row::of_table(&golden.table("beds.csv")?)?,
            limits: Row::of_table(&golden.table("limits.csv")?)?,
            arrays: Row::of_table(&golden.table("arrays.csv")?)?,
            spinning: golden.table("spinning.csv")?,
            towed: golden.table("towed.csv")?,
            ten_cate: golden.table("ten_cate.csv")?,
        })
    }
}

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    bench.literature(CASE.name, CASE.rows)
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    claims::all(golden, &Tables::of(golden, rows)?)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let duct = in_duct(&golden.table("../sphere_drag/duct.csv")?)?;
    let known = streams(&golden.table("../sphere_drag/study.csv")?, duct)?;
    figures::all(&Tables::of(golden, rows)?, &known)
}
