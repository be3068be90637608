// One step of every vector of cells: stream, as if all faces were periodic, and collide. Cells at other
// faces come out wrong; step_listed.wgsl does them again.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y, 1)
fn step(@builtin(global_invocation_id) id: vec3<u32>) {
//#if RAGGED
    if (id.x >= VECTORS || id.y >= NY) {
        return;
    }
//#end
    let here = id.x + VECTORS * (id.y + NY * id.z);
    let h = wrapped(id.x, id.y, id.z);
//#if SOLIDS
    keep(here, collided(h, solid_part(here)));
//#else
    keep(here, collided(h));
//#end
}
