//! Work shared out item by item; each result depends on its item alone, not on the threads.

use rayon::prelude::*;

/// Below this many items the work is over before a second thread has woken up.
const SERIAL: usize = 1024;

/// Calls `work(number, item)` for each item.
pub(crate) fn for_each<T: Send>(items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    if items.len() < SERIAL {
        items.iter_mut().enumerate().for_each(|(number, item)| work(number, item));
    } else {
        items.par_iter_mut().with_min_len(128).enumerate().for_each(|(number, item)| {
            work(number, item);
        });
    }
}
