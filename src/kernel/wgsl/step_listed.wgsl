// One step of the listed cells (or of all), with faces and solids.

@compute @workgroup_size(64)
fn step_listed(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = id.x + id.y * ROW;
    if (number >= task.count) {
        return;
    }
    let here = listed(number);
    if (!is_cell(here)) {
        return;
    }
    let h = observed(here);
//#if SOLIDS
    keep(here, collided(h, solid_part(here)));
//#else
    keep(here, collided(h));
//#end
}
