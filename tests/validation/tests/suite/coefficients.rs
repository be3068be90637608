//! The tables by which `psmrt check` and `psmrt plan` predict are what the golden tables make.

use psmrt::advice::coefficients::parse;
use psmrt::table::Table;
use psmrt_validation::tradeoff::coefficients::{coefficients, runs};
use std::path::Path;

fn product(name: &str) -> Table {
    let advice = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../src/advice");
    Table::read(&advice.join(name)).unwrap()
}

#[test]
fn coefficients_of_the_product_are_those_that_the_golden_tables_make() {
    let (own, made) = (product("coefficients.csv"), coefficients().unwrap());
    assert_eq!(own.columns, made.columns);
    assert_eq!(own.rows.len(), made.rows.len(), "rows: make them with cargo validate coefficients");
    let mut numbers = 0;
    for (own, made) in own.rows.iter().zip(&made.rows) {
        let but_numbers = |row: &[String]| [&row[..2], &row[3..]].concat();
        assert_eq!(but_numbers(own), but_numbers(made), "make it with cargo validate coefficients");
        let [own_groups, made_groups] = [own, made].map(|row| parse(&row[2]).unwrap());
        let shape = |groups: &[Vec<Option<f64>>]| groups.iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(shape(&own_groups), shape(&made_groups), "{own:?} and now {made:?}");
        for (one, other) in own_groups.iter().flatten().zip(made_groups.iter().flatten()) {
            numbers += 1;
            // Fits end where steps change the sum of squares by a part in 1e14, so the parameters by one in 1e7; the
            // mathematical libraries of machines differ in the last digit. What no fit is in is the same.
            let fitted = own[0].starts_with("grains") || own[0] == "plates";
            let allowed = if fitted { 1e-5 } else { 0.0 };
            let same = match (one, other) {
                (Some(a), Some(b)) => (a - b).abs() <= allowed * a.abs().max(0.1),
                (None, None) => true,
                _ => false,
            };
            assert!(same, "{}, {}: {one:?} and now {other:?}", own[0], own[1]);
        }
    }
    assert!(numbers > 200, "only {numbers} numbers were compared: has the table changed its form?");
}

#[test]
fn runs_of_the_product_are_those_of_the_golden_tables() {
    let (own, made) = (product("runs.csv"), runs().unwrap());
    assert_eq!(own, made, "make them with cargo validate coefficients");
}

#[test]
fn the_table_of_coefficients_is_small_and_says_of_each_row_what_it_is_and_where_from() {
    let own = product("coefficients.csv");
    assert!(own.rows.len() <= 48, "{} rows are more than one can review", own.rows.len());
    for row in &own.rows {
        let source = &row[4];
        let is_there = source
            .split(' ')
            .filter(|word| word.starts_with("golden/"))
            .all(|file| Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file).is_file());
        assert!(source.contains("golden/") && is_there, "{row:?} has no source");
        assert!(row[3].len() > 10, "{row:?}: what are its numbers?");
    }
}
