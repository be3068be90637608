//! The numbers that matter, which the report opens with: what an independent source says, what psmrt finds on its finest
//! committed grid, and how uncertain both are.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use psmrt_report::{Headline, Picture};

use super::Number;
use psmrt::convergence::convergence;

/// The rows of the first table.
pub fn headlines(numbers: &[Number]) -> Vec<Headline> {
    numbers.iter().filter_map(|number| Some(headline(number, number.on_front?))).collect()
}

/// A picture of what is computed.
pub fn picture() -> Picture {
    Picture {
        png_base64: STANDARD.encode(include_bytes!("../../../../docs/grains_in_water.png")),
        caption: "Grains that settle, coloured by how fast they fall, and the vertical velocity of the water between them \
                  (docs/grains_in_water.toml)"
            .to_owned(),
    }
}

/// Above this grid uncertainty a small error says nothing.
const TOO_COARSE: f64 = 0.03;

fn headline(number: &Number, quantity: &str) -> Headline {
    let Number { case, source, reference, uncertainty, .. } = *number;
    let (cells, found) = number.finest();
    let error = number.ratio() - 1.0;
    let gci = convergence(&number.grids).map(|found| found.gci);
    let is_within = match gci {
        None => Some(error.abs() <= uncertainty),
        Some(gci) if error.abs() > (uncertainty.powi(2) + gci.powi(2)).sqrt() => Some(false),
        Some(gci) => (gci <= TOO_COARSE).then_some(true),
    };
    Headline {
        quantity: quantity.to_owned(),
        reference: match uncertainty {
            0.0 => format!("{reference:.4}"),
            _ => format!("{reference:.4} ± {:.1} %", 100.0 * uncertainty),
        },
        source: source.to_owned(),
        found: format!("{found:.4} ({cells:.0} cells)"),
        error: format!("{:+.2} %", 100.0 * error),
        uncertainty: match gci {
            Some(gci) => format!("{:.2} %", 100.0 * gci),
            None => "not three different ones".to_owned(),
        },
        is_within,
        case: case.to_owned(),
    }
}
