//! Which solids fill which cells, so that no two of them fill the same.

/// The part of a volume that two solids may have in common: of the smaller of both.
pub const MAY_SHARE: f64 = 0.01;

/// No solid.
const NONE: u32 = u32::MAX;

/// How much of each cell is filled, and by which solid most of it.
#[derive(Clone, Debug)]
pub struct Filled {
    share: Vec<f32>,
    by: Vec<u32>,
    /// Volume of each solid that has been added, cells.
    volumes: Vec<(usize, f64)>,
}

/// Two solids that fill the same cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Common {
    /// The number of the one that was there.
    pub other: usize,
    /// What both fill, over the volume of the smaller one.
    pub share: f64,
}

impl Filled {
    /// Nothing, in so many cells.
    pub fn none(cells: usize) -> Self {
        Filled { share: vec![0.0; cells], by: vec![NONE; cells], volumes: Vec::new() }
    }

    /// The first solid that has too much in common with one that fills `cells`.
    pub fn common(&self, cells: &[(usize, f64)]) -> Option<Common> {
        let mut both = vec![0.0; self.volumes.len()];
        for &(cell, share) in cells {
            let excess = f64::from(self.share[cell]) + share - 1.0;
            if excess > 0.0 && self.by[cell] != NONE {
                both[self.by[cell] as usize] += excess;
            }
        }
        let own: f64 = cells.iter().map(|(_, share)| share).sum();
        let shares = both
            .iter()
            .zip(&self.volumes)
            .map(|(common, &(other, volume))| Common { other, share: common / own.min(volume) });
        shares.into_iter().find(|common| common.share > MAY_SHARE)
    }

    /// Adds solid `number`, which fills these cells. What it gives back takes it away again.
    pub fn add(&mut self, number: usize, cells: &[(usize, f64)]) -> Added {
        let place = u32::try_from(self.volumes.len()).unwrap_or(NONE);
        self.volumes.push((number, cells.iter().map(|(_, share)| share).sum()));
        let mut before = Vec::with_capacity(cells.len());
        for &(cell, share) in cells {
            before.push((cell, self.share[cell], self.by[cell]));
            #[expect(clippy::cast_possible_truncation, reason = "a share")]
            let share = share as f32;
            if share >= self.share[cell] {
                self.by[cell] = place;
            }
            self.share[cell] += share;
        }
        Added { before }
    }

    /// Takes away the solid that was added last.
    pub fn remove(&mut self, added: Added) {
        self.volumes.pop();
        for (cell, share, by) in added.before.into_iter().rev() {
            (self.share[cell], self.by[cell]) = (share, by);
        }
    }
}

/// A solid that has been added: how its cells were before.
#[derive(Clone, Debug)]
pub struct Added {
    before: Vec<(usize, f32, u32)>,
}
