//! The order in which a candidate numbers the nineteen directions.

use psmrt_reference::directions::{C, Q};
use thiserror::Error;

/// A numbering of the directions of D3Q19.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DirectionOrder {
    /// The candidate's number `k` belongs to the kit's number `kit_number[k]`.
    kit_number: [usize; Q],
}

/// A list of directions that is no order of D3Q19.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OrderError {
    /// Not nineteen.
    #[error("directions lists {count} directions; D3Q19 has 19, rest included")]
    Count {
        /// Their number.
        count: usize,
    },
    /// One that is not in D3Q19.
    #[error(
        "directions[{number}] = {direction:?} is not one of D3Q19's: components are -1, 0 or 1, at most two of them not 0"
    )]
    Foreign {
        /// Its number.
        number: usize,
        /// The direction as given.
        direction: [i32; 3],
    },
    /// One given twice.
    #[error("directions[{number}] = {direction:?} is listed a second time")]
    Twice {
        /// Number of the second.
        number: usize,
        /// The direction.
        direction: [i32; 3],
    },
}

impl Default for DirectionOrder {
    /// The kit's own order.
    fn default() -> Self {
        DirectionOrder { kit_number: std::array::from_fn(|a| a) }
    }
}

impl DirectionOrder {
    /// The order in which `directions` lists them. Errors unless it lists each of D3Q19 once.
    pub fn new(directions: &[[i32; 3]]) -> Result<Self, OrderError> {
        if directions.len() != Q {
            return Err(OrderError::Count { count: directions.len() });
        }
        let mut kit_number = [0; Q];
        for (number, &direction) in directions.iter().enumerate() {
            let Some(a) = C.iter().position(|&known| known == direction) else {
                return Err(OrderError::Foreign { number, direction });
            };
            if kit_number[..number].contains(&a) {
                return Err(OrderError::Twice { number, direction });
            }
            kit_number[number] = a;
        }
        Ok(DirectionOrder { kit_number })
    }

    /// Number in the kit of the candidate's number `own`.
    pub fn in_kit(&self, own: usize) -> usize {
        self.kit_number[own]
    }

    /// The directions in this order.
    pub fn directions(&self) -> [[i32; 3]; Q] {
        self.kit_number.map(|a| C[a])
    }
}
