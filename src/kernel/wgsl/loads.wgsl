// Force and torque on each solid during the last step.
//
// Both solid operators change the momentum of a cell by B_s (ρ u_s - j), with the momentum j before the
// collision: that is what the solid loses. `impulses` works this out for every share (the part of one
// cell that one solid covers), `gather` adds up the shares of each solid, which lie in a row, always in
// the same order.

struct Share {
    cell: u32,
    // Number of the solid
    solid: u32,
    // B_s
    weight: f32,
    // From the solid's centre to the cell's
    arm_x: f32,
    arm_y: f32,
    arm_z: f32,
}

@group(0) @binding(60) var<storage, read> shares: array<Share>;
// F of each share
@group(0) @binding(61) var<storage, read_write> pushes: array<vec4<f32>>;
// Velocity and spin of each solid
@group(0) @binding(62) var<storage, read> motions: array<vec4<f32>>;

@compute @workgroup_size(64)
fn impulses(@builtin(global_invocation_id) id: vec3<u32>) {
    let number = id.x + id.y * ROW;
    if (number >= task.count) {
        return;
    }
    let share = shares[number];
    let h = observed(coordinates(share.cell));
    let rho = 1.0 + sum(h);
    let arm = vec3<f32>(share.arm_x, share.arm_y, share.arm_z);
    // u_s = U + ω × r
    let u = motions[2u * share.solid].xyz + cross(motions[2u * share.solid + 1u].xyz, arm);
    // F = B_s (j - ρ u_s)
    pushes[number] = vec4<f32>(share.weight * (momentum(h) - rho * u), 0.0);
}
