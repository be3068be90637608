// Where cells lie: VECTORS vectors of WIDTH cells in a row along x, cells that lie VECTORS apart.

// The place in its row of the cell at x.
fn along(x: u32) -> u32 {
    return (x % VECTORS) * WIDTH + x / VECTORS;
}

// x, y, z of the cell at a place.
fn coordinates(place: u32) -> vec3<u32> {
    let in_row = place % ROW_PLACES;
    let row = place / ROW_PLACES;
    return vec3<u32>(in_row / WIDTH + (in_row % WIDTH) * VECTORS, row % NY, row / NY);
}

// Whether there is a cell at a place: the last quarter of a row may be shorter than the others.
fn is_cell(place: u32) -> bool {
    return coordinates(place).x < NX;
}
