// One step of the listed cells (or of all), with faces and solids.

@compute @workgroup_size(64)
fn step_listed(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = id.x + id.y * ROW;
    if (number >= task.count) {
        return;
    }
    let at = coordinates(listed(number));
    let h = observed(at);
//#if OUTGOING
    keep_outgoing(at);
//#end
//#if LOADS
    keep_moments_of(at.x, at.y, at.z, h);
//#end
//#if MANY
    keep(at.x, at.y, at.z, collided(h, solid_part_of_listed(number, at.x, at.y, at.z)));
//#else
//#if SOLIDS
    keep(at.x, at.y, at.z, collided(h, solid_part(at.x, at.y, at.z)));
//#else
    keep(at.x, at.y, at.z, collided(h));
//#end
//#end
}
