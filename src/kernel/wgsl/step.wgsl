// One step of every cell: stream, as if all faces were periodic, and collide. Cells at other faces
// come out wrong; step_listed.wgsl does them again.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y, 1)
fn step(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= NX || id.y >= NY || id.z >= NZ) {
        return;
    }
    let here = id.x + NX * (id.y + NY * id.z);
    let h = wrapped(id.x, id.y, id.z);
//#if SOLIDS
    let post = collided(h, solid_part(here));
//#else
    let post = collided(h);
//#end
    keep(here, post);
}
