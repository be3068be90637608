//! Rows of named columns, as CSV files hold them.

use std::path::Path;

use thiserror::Error;

/// A table that cannot be read or lacks something, in words.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{0}")]
pub struct TableError(pub String);

/// A table of text; numbers are parsed where they are used.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Rows, each as long as the columns.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table.
    pub fn new(columns: &[&str]) -> Self {
        Table { columns: columns.iter().map(|&name| name.to_owned()).collect(), rows: Vec::new() }
    }

    /// Reads a CSV file whose lines that start with `#` are comments. Errors if it cannot be read.
    pub fn read(path: &Path) -> Result<Self, TableError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|error| TableError(format!("{name}: {error}")))?;
        Self::parse(&name, &text)
    }

    /// The same from a file's text; `name` is what messages call it.
    pub fn parse(name: &str, text: &str) -> Result<Self, TableError> {
        let wrong = |error: csv::Error| TableError(format!("{name}: {error}"));
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let columns = reader.headers().map_err(wrong)?.iter().map(str::to_owned).collect();
        let rows = reader
            .records()
            .map(|row| Ok(row.map_err(wrong)?.iter().map(str::to_owned).collect()))
            .collect::<Result<_, TableError>>()?;
        Ok(Table { columns, rows })
    }

    /// The rows as the text of a CSV file.
    pub fn to_csv(&self) -> String {
        let field = |field: &String| match field.contains([',', '"']) {
            true => format!("\"{}\"", field.replace('"', "\"\"")),
            false => field.clone(),
        };
        let lines = std::iter::once(&self.columns).chain(&self.rows);
        let line = |line: &Vec<String>| line.iter().map(field).collect::<Vec<_>>().join(",") + "\n";
        lines.map(line).collect()
    }

    /// Adds a row.
    pub fn add(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    /// Adds the rows of another table with the same columns.
    pub fn append(&mut self, other: Table) {
        if self.columns.is_empty() {
            self.columns = other.columns;
        }
        self.rows.extend(other.rows);
    }

    /// The number of a column. Errors if there is no such column.
    fn column(&self, name: &str) -> Result<usize, TableError> {
        let found = self.columns.iter().position(|column| column == name);
        found.ok_or_else(|| TableError(format!("no column {name:?} in {:?}", self.columns)))
    }

    /// The rows whose columns have these values.
    pub fn with(&self, wanted: &[(&str, &str)]) -> Result<Table, TableError> {
        let wanted = wanted
            .iter()
            .map(|&(name, value)| Ok((self.column(name)?, value)))
            .collect::<Result<Vec<_>, TableError>>()?;
        let rows = self.rows.iter().filter(|row| wanted.iter().all(|(i, value)| row[*i] == *value));
        Ok(Table { columns: self.columns.clone(), rows: rows.cloned().collect() })
    }

    /// The values of a column, in the order of the rows. Errors if one is no number.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, TableError> {
        let column = self.column(name)?;
        let number = |row: &Vec<String>| {
            let problem = || TableError(format!("column {name:?} holds {:?}", row[column]));
            row[column].parse().map_err(|_| problem())
        };
        self.rows.iter().map(number).collect()
    }

    /// The values of a column where there are any, in the order of the rows. Errors if one is no number.
    pub fn numbers_where_given(&self, name: &str) -> Result<Vec<f64>, TableError> {
        let column = self.column(name)?;
        let rows = self.rows.iter().filter(|row| !row[column].is_empty());
        Table { columns: self.columns.clone(), rows: rows.cloned().collect() }.numbers(name)
    }

    /// The one value of a column. Errors unless there is exactly one row.
    pub fn number(&self, name: &str) -> Result<f64, TableError> {
        match self.numbers(name)?[..] {
            [value] => Ok(value),
            ref values => Err(TableError(format!("{} rows for {name:?}", values.len()))),
        }
    }

    /// Pairs of two columns: points of a curve.
    pub fn points(&self, x: &str, y: &str) -> Result<Vec<(f64, f64)>, TableError> {
        Ok(self.numbers(x)?.into_iter().zip(self.numbers(y)?).collect())
    }

    /// Pairs of words of two columns.
    pub fn words(&self, one: &str, two: &str) -> Result<Vec<(&str, &str)>, TableError> {
        let (one, two) = (self.column(one)?, self.column(two)?);
        Ok(self.rows.iter().map(|row| (row[one].as_str(), row[two].as_str())).collect())
    }

    /// The different values of a column, in the order in which they first stand there.
    pub fn values(&self, name: &str) -> Result<Vec<String>, TableError> {
        let column = self.column(name)?;
        let mut values: Vec<String> = Vec::new();
        for row in &self.rows {
            if !values.contains(&row[column]) {
                values.push(row[column].clone());
            }
        }
        Ok(values)
    }
}
