//! Streaming: every population moves one cell along its direction (left side of Eq. 1).

use crate::boundary::entering;
use crate::directions::{C, Q};
use crate::domain::Domain;
use crate::lattice::Populations;
use crate::non_reflecting::SlowMeans;
use crate::planes::for_each_plane;

/// Fills `f` at time `t + 1` from the post-collision populations `post` at time `t`.
pub fn stream(
    domain: &Domain,
    slow_means: &SlowMeans,
    post: &[Populations],
    f: &mut [Populations],
) {
    let [nx, ny, nz] = domain.cells();
    for_each_plane(f, nx * ny, |z, plane| {
        for y in 0..ny {
            for x in 0..nx {
                let cell = [x, y, z];
                let here = domain.index(cell);
                let interior = [(x, nx), (y, ny), (z, nz)].iter().all(|&(i, n)| i > 0 && i + 1 < n);
                for a in 0..Q {
                    // f_a(x, t+1) = f*_a(x - c_a, t)
                    plane[x + nx * y][a] = if interior {
                        let [cx, cy, cz] = C[a].map(|component| component as isize);
                        let offset = cx + nx as isize * (cy + ny as isize * cz);
                        post[here.wrapping_add_signed(-offset)][a]
                    } else if crosses(cell, [nx, ny, nz], a) {
                        entering(domain, slow_means, post, cell, a)
                    } else {
                        let from = std::array::from_fn(|axis| {
                            cell[axis].wrapping_add_signed(-C[a][axis] as isize)
                        });
                        post[domain.index(from)][a]
                    };
                }
            }
        }
    });
}

/// Whether direction `a` enters cell `x` from outside a domain of `n` cells.
fn crosses(x: [usize; 3], n: [usize; 3], a: usize) -> bool {
    (0..3).any(|axis| match C[a][axis] {
        1 => x[axis] == 0,
        -1 => x[axis] + 1 == n[axis],
        _ => false,
    })
}
