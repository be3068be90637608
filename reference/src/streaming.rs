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
    let [nx, ny, _] = domain.cells();
    for_each_plane(f, nx * ny, |z, plane| {
        let along_z = upstream(domain, 2, z, nx * ny);
        for y in 0..ny {
            let along_y = upstream(domain, 1, y, nx);
            for x in 0..nx {
                let along_x = upstream(domain, 0, x, 1);
                let cell = &mut plane[x + nx * y];
                for a in 0..Q {
                    let [cx, cy, cz] = C[a].map(|component| (component + 1) as usize);
                    // f_a(x, t+1) = f*_a(x - c_a, t)
                    cell[a] = match (along_x[cx], along_y[cy], along_z[cz]) {
                        (Some(x), Some(y), Some(z)) => post[x + y + z][a],
                        _ => entering(domain, slow_means, post, [x, y, z], a),
                    };
                }
            }
        }
    });
}

/// Where a population that arrives at coordinate `x` of an axis comes from, for the components -1, 0 and 1 of its
/// direction: `stride` times the coordinate there, round the domain where it is periodic; `None` where it comes in at another
/// face.
fn upstream(domain: &Domain, axis: usize, x: usize, stride: usize) -> [Option<usize>; 3] {
    let last = domain.cells()[axis] - 1;
    let wrapped = |x: usize| domain.is_periodic(axis).then_some(x);
    let above = if x < last { Some(x + 1) } else { wrapped(0) };
    let below = if x > 0 { Some(x - 1) } else { wrapped(last) };
    [above, Some(x), below].map(|from| from.map(|x| stride * x))
}
