//! The nineteen directions of D3Q19 and their numbering: vocabulary that every engine shares.
//!
//! The order is named [`ORDER`]: rest, then the six faces of the cube in pairs `+x -x +y -y +z -z`,
//! then its twelve edges in the planes xy, xz, yz. It is the order in which d'Humières et al.
//! (Phil. Trans. R. Soc. A 360, 437, 2002) list `e_alpha` and in which their matrix `M` is printed.
//!
//! ```text
//!  plane z = 0          plane z = +1         plane z = -1
//!   8   3   7            .  15   .            .  17   .        y
//!   2   0   1           12   5  11           14   6  13        |
//!  10   4   9            .  16   .            .  18   .        +-- x
//! ```

/// Number of directions.
pub const Q: usize = 19;

/// Name of the direction order, written into every file that holds populations.
pub const ORDER: &str = "dhumieres2002";

/// Direction `c_a` in cells per step: `C[a] = [x, y, z]`.
pub const C: [[i32; 3]; Q] = [
    [0, 0, 0],
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
    [1, 1, 0],
    [-1, 1, 0],
    [1, -1, 0],
    [-1, -1, 0],
    [1, 0, 1],
    [-1, 0, 1],
    [1, 0, -1],
    [-1, 0, -1],
    [0, 1, 1],
    [0, -1, 1],
    [0, 1, -1],
    [0, -1, -1],
];

/// Number of the direction opposite to `a`: `C[OPPOSITE[a]] = -C[a]`.
pub const OPPOSITE: [usize; Q] = [0, 2, 1, 4, 3, 6, 5, 10, 9, 8, 7, 14, 13, 12, 11, 18, 17, 16, 15];

/// Number of the direction `c`.
///
/// # Panics
/// If `c` is not one of the nineteen directions: a mistake in the calling code, not in a scene.
pub fn number_of(c: [i32; 3]) -> usize {
    C.iter().position(|&known| known == c).unwrap_or_else(|| unreachable!("{c:?} is not in D3Q19"))
}
