// One step of every cell: stream, as if all faces were periodic, and collide. Cells at other faces come
// out wrong; step_listed.wgsl does them again.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y, 1)
fn step(@builtin(global_invocation_id) id: vec3<u32>) {
//#if RAGGED
    if (id.x >= NX || id.y >= NY) {
        return;
    }
//#end
    let h = wrapped(id.x, id.y, id.z);
//#if LOADS
    keep_moments_of(id.x, id.y, id.z, h);
//#end
//#if SOLIDS
    keep(id.x, id.y, id.z, collided(h, solid_part(id.x, id.y, id.z)));
//#else
    keep(id.x, id.y, id.z, collided(h));
//#end
}
