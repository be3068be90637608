//! How far psmrt is off, quantity by quantity: mean and spread of what it finds over what it should.

use psmrt::table::Table;
use psmrt_report::{Agreement, Axis, DataTable, Figure, Marker, Series, Style};

use super::{Number, Quantity};

/// So many numbers have a band.
const ENOUGH: usize = 6;

/// How numbers of a kind lie about their references.
struct Spread {
    kind: Quantity,
    ratios: Vec<f64>,
    /// Mean of the logarithms of the ratios.
    bias: f64,
    /// Their standard deviation; `None` of one number.
    scatter: Option<f64>,
}

impl Spread {
    fn of(kind: Quantity, numbers: &[Number]) -> Self {
        let own = numbers.iter().filter(|number| number.kind == kind);
        let ratios: Vec<f64> = own.map(Number::ratio).collect();
        let n = ratios.len() as f64;
        let bias = ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / n;
        let squares: f64 = ratios.iter().map(|ratio| (ratio.ln() - bias).powi(2)).sum();
        let scatter = (ratios.len() > 1).then(|| (squares / (n - 1.0)).sqrt());
        Spread { kind, ratios, bias, scatter }
    }

    /// Two standard deviations to either side of the bias, as ratios; none of few numbers, of which a deviation says little.
    fn band(&self) -> Option<[f64; 2]> {
        let two = 2.0 * self.scatter.filter(|_| self.ratios.len() >= ENOUGH)?;
        Some([(self.bias - two).exp(), (self.bias + two).exp()])
    }
}

/// What the page says of it.
pub fn agreement(numbers: &[Number]) -> Agreement {
    let spreads: Vec<Spread> =
        Quantity::ALL.into_iter().map(|kind| Spread::of(kind, numbers)).collect();
    let mut figures = vec![ratios(numbers, &spreads)];
    figures.extend(spreads.iter().filter_map(|spread| against_reference(numbers, spread)));
    Agreement {
        about: vec![
            "Numbers of the suite that an independent source gives a value for, psmrt's with the solid operator of each study (graded \
             viscosity in arrays and in creeping beds, full bounce-back in shafts and lifted beds, else the paper's), on the finest committed grid of each flow: bias is the mean of psmrt's value over the reference, less 1 \
             (of the logarithms); scatter the standard deviation about that mean. The reference's own uncertainty is not taken off: \
             of beds and of experiments it is most of the scatter. The two arrays to which the operator was fitted are left out; \
             numbers of one bed at several Reynolds numbers are not independent of each other."
                .to_owned(),
        ],
        table: table(&spreads, numbers),
        figures,
    }
}

/// All numbers as a table, to stand beside the page.
pub fn rows(numbers: &[Number]) -> Table {
    let mut table = Table::new(&[
        "quantity",
        "of",
        "case",
        "source",
        "reference",
        "reference_uncertainty",
        "cells",
        "psmrt",
        "ratio",
    ]);
    for number in numbers {
        let (cells, found) = number.finest();
        table.add(vec![
            number.kind.words().to_owned(),
            number.of.clone(),
            number.case.to_owned(),
            number.source.to_owned(),
            format!("{:.6e}", number.reference),
            number.uncertainty.to_string(),
            cells.to_string(),
            format!("{found:.6e}"),
            format!("{:.4}", number.ratio()),
        ]);
    }
    table
}

fn table(spreads: &[Spread], numbers: &[Number]) -> DataTable {
    let percent = |share: f64| format!("{:+.1}\u{a0}%", 100.0 * share);
    let row = |spread: &Spread| {
        let own: Vec<&Number> =
            numbers.iter().filter(|number| number.kind == spread.kind).collect();
        let most = own.iter().map(|number| number.uncertainty).fold(0.0, f64::max);
        let worst = own.iter().max_by(|a, b| {
            let off = |number: &Number| number.ratio().ln().abs();
            off(a).total_cmp(&off(b))
        });
        vec![
            spread.kind.words().to_owned(),
            spread.ratios.len().to_string(),
            percent(spread.bias.exp() - 1.0),
            spread.scatter.map_or("one number".to_owned(), |s| format!("{:.1}\u{a0}%", 100.0 * s)),
            if most == 0.0 { "exact".to_owned() } else { format!("{:.1}\u{a0}%", 100.0 * most) },
            worst.map_or(String::new(), |worst| {
                format!("{} ({})", percent(worst.ratio() - 1.0), worst.of)
            }),
        ]
    };
    DataTable {
        caption: "Bias and scatter by quantity".to_owned(),
        columns: ["quantity", "numbers", "bias", "scatter", "references known to", "farthest off"]
            .map(str::to_owned)
            .to_vec(),
        rows: spreads.iter().map(row).collect(),
    }
}

/// All ratios, side by side.
fn ratios(numbers: &[Number], spreads: &[Spread]) -> Figure {
    let names = Quantity::ALL.map(Quantity::word);
    let mut figure = Figure::new(
        "psmrt over the reference, by quantity",
        Axis::of_names(&names),
        Axis::linear("psmrt over reference").range(0.7, 1.35),
    );
    let (mut exact, mut known, mut bars) = (Vec::new(), Vec::new(), Vec::new());
    for (place, spread) in spreads.iter().enumerate() {
        let own: Vec<&Number> =
            numbers.iter().filter(|number| number.kind == spread.kind).collect();
        for (i, number) in own.iter().enumerate() {
            // Side by side; the bias stands right of them.
            let x = place as f64 + 0.65 + 0.45 * (i as f64 + 0.5) / own.len() as f64;
            if number.uncertainty == 0.0 {
                exact.push((x, number.ratio()));
            } else {
                known.push((x, number.ratio()));
                bars.push(number.uncertainty * number.ratio());
            }
        }
    }
    let mean = |spread: &Spread| {
        let place = Quantity::ALL.iter().position(|kind| *kind == spread.kind).unwrap_or(0);
        (place as f64 + 1.28, spread.bias.exp())
    };
    let width =
        spreads.iter().map(|spread| spread.band().map_or(0.0, |[low, high]| 0.5 * (high - low)));
    let line = vec![(0.5, 1.0), (names.len() as f64 + 0.5, 1.0)];
    figure = figure
        .with(Series::new("", Style::Reference, line))
        .with(Series::new("exact reference", Style::Points(Some(Marker::Circle)), exact))
        .with(
            Series::new(
                "reference with its uncertainty (bar)",
                Style::Points(Some(Marker::Ring)),
                known,
            )
            .with_errors(bars),
        )
        .with(
            Series::new(
                "bias; of six numbers and more with two standard deviations",
                Style::Points(Some(Marker::Diamond)),
                spreads.iter().map(mean).collect(),
            )
            .with_errors(width.collect()),
        );
    figure.size(1100, 520).note("each point is one number of a case, on the finest committed grid")
}

/// Values found against references, if these differ enough for a line.
fn against_reference(numbers: &[Number], spread: &Spread) -> Option<Figure> {
    let own = numbers.iter().filter(|number| number.kind == spread.kind);
    let points: Vec<(f64, f64)> = own.map(|number| (number.reference, number.finest().1)).collect();
    let low = points.iter().map(|point| point.0).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|point| point.0).fold(0.0, f64::max);
    let [least, most] = spread.band()?;
    if high < 1.5 * low {
        return None;
    }
    let ends = [0.8 * low, 1.25 * high];
    let line = |factor: f64| ends.map(|x| (x, factor * x)).to_vec();
    let figure = Figure::new(
        format!("{}: psmrt against the reference", spread.kind.words()),
        Axis::log("reference, each in its case's unit").range(ends[0], ends[1]),
        Axis::log("psmrt"),
    );
    Some(
        figure
            .with(Series::new("equal", Style::Reference, line(1.0)))
            .with(Series::dashed("bias, and two standard deviations", line(least)).with_colour(1))
            .with(Series::line("bias", line(spread.bias.exp())).with_colour(1))
            .with(Series::dashed("bias, and two standard deviations", line(most)).with_colour(1))
            .with(Series::points("numbers", points).with_colour(0)),
    )
}

#[cfg(test)]
mod tests {
    use super::{Spread, agreement};
    use crate::numbers::{Number, Quantity};

    fn number(reference: f64, found: f64) -> Number {
        Number {
            kind: Quantity::Drag,
            of: "a sphere".to_owned(),
            case: "sphere_drag",
            source: "",
            reference,
            uncertainty: 0.0,
            grids: vec![(8.0, 0.0), (16.0, found)],
            on_front: None,
        }
    }

    #[test]
    fn bias_and_scatter_are_mean_and_deviation_of_the_logarithms_on_the_finest_grid() {
        // Ratios 1.1/1.2 and 1.1*1.2: a mean of 1.1, a deviation of ln 1.2 times the square root of 2.
        let numbers = [number(2.0, 2.0 * 1.1 / 1.2), number(30.0, 30.0 * 1.1 * 1.2)];
        let spread = Spread::of(Quantity::Drag, &numbers);
        assert!((spread.bias.exp() - 1.1).abs() < 1e-12, "bias {}", spread.bias.exp());
        let deviation = 2.0_f64.sqrt() * 1.2_f64.ln();
        let found = spread.scatter.unwrap();
        assert!((found - deviation).abs() < 1e-12, "scatter {found}, expected {deviation}");
        let row = &agreement(&numbers).table.rows[1];
        assert_eq!(row[..3], ["drag of spheres", "2", "+10.0\u{a0}%"], "{row:?}");
        assert!(row[5].starts_with("+32.0\u{a0}%"), "the farthest off is the second: {row:?}");
    }
}
