// A solid that may move. Its touches, the parts of cells that it covers, are numbered on from `first`.
struct Solid {
    // Lowest cell of the box about the ball; of a solid of given cells, one near its centre.
    base: vec3<i32>,
    // Of the ball; 0 of a solid of given cells.
    radius: f32,
    // From the centre to that of the lowest cell.
    offset: vec3<f32>,
    first: u32,
    velocity: vec3<f32>,
    // Its first row of cells, or its first given cell.
    rows: u32,
    spin: vec3<f32>,
    // Cells along each side of the box; number of given cells.
    side: u32,
}
