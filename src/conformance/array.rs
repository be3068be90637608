//! Arrays of numbers with a shape, and answers: named arrays.

use std::collections::BTreeMap;

use psmrt_reference::directions::Q;
use psmrt_reference::lattice::{Populations, Vec3};

use crate::npy::{self, NpyError};

/// An array in C order (the last index runs fastest).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Array {
    /// Lengths along the axes; empty for a single number.
    pub shape: Vec<usize>,
    /// The values.
    pub values: Vec<f64>,
}

impl Array {
    /// An array of that shape.
    ///
    /// # Panics
    /// If the shape does not hold as many values: a mistake in the calling code.
    pub fn new(shape: impl Into<Vec<usize>>, values: Vec<f64>) -> Self {
        let shape = shape.into();
        assert_eq!(shape.iter().product::<usize>(), values.len(), "values for shape {shape:?}");
        Array { shape, values }
    }

    /// That of a NumPy file.
    pub fn of_npy(bytes: &[u8]) -> Result<Self, NpyError> {
        npy::read(bytes).map(|(shape, values)| Array { shape, values })
    }

    /// Values along one axis.
    pub fn list(values: Vec<f64>) -> Self {
        Array { shape: vec![values.len()], values }
    }

    /// A single number.
    pub fn number(value: f64) -> Self {
        Array { shape: Vec::new(), values: vec![value] }
    }

    /// Vectors, of shape `[n, 3]`.
    pub fn vectors(vectors: &[Vec3]) -> Self {
        let values = vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect();
        Array { shape: vec![vectors.len(), 3], values }
    }

    /// Populations (or moments) of several cells, of shape `[n, 19]`.
    pub fn cells(cells: &[Populations]) -> Self {
        Array { shape: vec![cells.len(), Q], values: cells.iter().flatten().copied().collect() }
    }

    /// Populations of a domain of `[nx, ny, nz]` cells, x fastest, of shape `[nz, ny, nx, 19]`.
    ///
    /// # Panics
    /// If there are not as many cells: a mistake in the calling code.
    pub fn populations([nx, ny, nz]: [usize; 3], cells: &[Populations]) -> Self {
        Array::new([nz, ny, nx, Q], cells.iter().flatten().copied().collect())
    }
}

/// What a candidate answers to one problem: arrays by name. What is left out counts as not attempted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers(pub BTreeMap<String, Array>);

impl Answers {
    /// No answers yet.
    pub fn new() -> Self {
        Answers::default()
    }

    /// These and one more.
    #[must_use]
    pub fn with(mut self, name: &str, array: Array) -> Self {
        self.0.insert(name.to_owned(), array);
        self
    }

    /// The answer of that name.
    pub fn get(&self, name: &str) -> Option<&Array> {
        self.0.get(name)
    }
}
