// The populations of the listed cells before their next collision, 19 to a cell.

@group(0) @binding(BIND_Seen) var<storage, read_write> seen: array<f32>;

@compute @workgroup_size(64)
fn observe(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = id.x + id.y * ROW;
    if (number >= task.count) {
        return;
    }
    let h = observed(coordinates(listed(number)));
    for (var a = 0u; a < 19u; a++) {
        seen[19u * number + a] = h[a];
    }
}
