// Adds up the shares of each solid: a workgroup to a solid, each invocation every LANES-th share, then
// a tree. The order of the sums depends on nothing but the list, so that two runs give the same bits.

struct Share {
    cell: u32,
    solid: u32,
    weight: f32,
    arm_x: f32,
    arm_y: f32,
    arm_z: f32,
}

@group(0) @binding(0) var<storage, read> shares: array<Share>;
@group(0) @binding(1) var<storage, read> pushes: array<vec4<f32>>;
// First share of each solid, and the number of all shares
@group(0) @binding(2) var<storage, read> starts: array<u32>;
// Force and torque of each solid
@group(0) @binding(3) var<storage, read_write> loads: array<vec4<f32>>;

const LANES = 64u;
var<workgroup> force: array<vec3<f32>, LANES>;
var<workgroup> torque: array<vec3<f32>, LANES>;

@compute @workgroup_size(64)
fn gather(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let solid = group.x + group.y * 65535u;
    let is_solid = solid + 1u < arrayLength(&starts);
    var f = vec3<f32>(0.0);
    var t = vec3<f32>(0.0);
    if (is_solid) {
        for (var number = starts[solid] + lane; number < starts[solid + 1u]; number += LANES) {
            let push = pushes[number].xyz;
            let arm = vec3<f32>(shares[number].arm_x, shares[number].arm_y, shares[number].arm_z);
            // F = Σ F_i,  T = Σ r_i × F_i
            f += push;
            t += cross(arm, push);
        }
    }
    force[lane] = f;
    torque[lane] = t;
    workgroupBarrier();
    for (var half = LANES / 2u; half > 0u; half /= 2u) {
        if (lane < half) {
            force[lane] += force[lane + half];
            torque[lane] += torque[lane + half];
        }
        workgroupBarrier();
    }
    if (is_solid && lane == 0u) {
        loads[2u * solid] = vec4<f32>(force[0], 0.0);
        loads[2u * solid + 1u] = vec4<f32>(torque[0], 0.0);
    }
}
