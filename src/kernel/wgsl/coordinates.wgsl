// x, y, z of a cell.
fn coordinates(cell: u32) -> vec3<u32> {
    return vec3<u32>(cell % NX, cell / NX % NY, cell / (NX * NY));
}
