// The populations of the listed cells before their next collision, 19 to a cell, and the weight B of that collision.

@group(0) @binding(BIND_Seen) var<storage, read_write> seen: array<f32>;

@compute @workgroup_size(64)
fn observe(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = id.x + id.y * ROW;
    if (number >= task.count) {
        return;
    }
    let at = coordinates(listed(number));
    let h = observed(at);
    for (var a = 0u; a < 19u; a++) {
        seen[20u * number + a] = h[a];
    }
//#if SOLIDS
    seen[20u * number + 19u] = solid_part(at.x, at.y, at.z).weight;
//#else
    seen[20u * number + 19u] = 0.0;
//#end
}
