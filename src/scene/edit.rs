//! Changes of the text of a scene: another grid, another relaxation time, sections that are made where they are absent.

use toml_edit::{Array, DocumentMut, Item, Table, TableLike, value};

/// Puts a scene on a grid of that many cells of that edge, m.
pub(crate) fn put_on_grid(document: &mut DocumentMut, cells: [usize; 3], si_dx: f64) {
    let domain = section(document, "domain");
    domain.insert("dx", value(si_dx));
    if domain.contains_key("cells") {
        let cells = cells.iter().map(|&n| i64::try_from(n).unwrap_or(i64::MAX));
        domain.insert("cells", value(cells.collect::<Array>()));
    } else {
        let lengths = cells.iter().map(|&n| n as f64 * si_dx);
        domain.insert("size", value(lengths.collect::<Array>()));
    }
}

/// Gives a scene a relaxation time, whatever its time step came from.
pub(crate) fn set_tau(document: &mut DocumentMut, tau: f64) {
    let time = section(document, "time");
    for key in ["dt", "lattice_velocity", "reference_velocity"] {
        time.remove(key);
    }
    time.insert("tau", value(tau));
}

/// Multiplies what is given in steps, so that it stays the same in seconds.
pub(crate) fn scale_steps(document: &mut DocumentMut, factor: f64) {
    let scale = |item: &mut Item| {
        if let Some(number) = item.as_integer() {
            let scaled = (number as f64 * factor).round().max(1.0);
            #[expect(clippy::cast_possible_truncation, reason = "numbers of steps")]
            let scaled = scaled as i64;
            *item = value(scaled);
        }
    };
    if let Some(item) = document.get_mut("stop").and_then(|stop| stop.get_mut("steps")) {
        scale(item);
    }
    for table in tables(document, "records") {
        if let Some(item) = table.get_mut("every_steps") {
            scale(item);
        }
    }
}

/// A section, made where it is absent.
pub(crate) fn section<'a>(document: &'a mut DocumentMut, name: &str) -> &'a mut dyn TableLike {
    let item = document.entry(name).or_insert(Item::Table(Table::new()));
    if item.as_table_like().is_none() {
        *item = Item::Table(Table::new());
    }
    match item.as_table_like_mut() {
        Some(table) => table,
        None => unreachable!("it was made a table above"),
    }
}

/// The tables of an array of tables; none where it is absent.
pub(crate) fn tables<'a>(document: &'a mut DocumentMut, name: &str) -> Vec<&'a mut Table> {
    let item = document.get_mut(name).and_then(Item::as_array_of_tables_mut);
    item.map_or_else(Vec::new, |array| array.iter_mut().collect())
}
