// Force and torque on each solid during the last step, and Σ B_s, the volume in which a body force does not
// act on the fluid.
//
// The solid operators change the momentum of a cell by GAIN B_s (ρ u_s - j), with the momentum j before the
// collision: that is what the solid loses. A workgroup adds up the touches of one solid (the parts of
// cells that it covers), each invocation every LANES-th, then a tree. The order of the sums depends on
// nothing but where the solid is, so that two runs give the same bits.

// B_s of each touch
@group(0) @binding(BIND_Weights) var<storage, read> weights: array<f32>;
@group(0) @binding(BIND_Solids) var<storage, read> solids: array<Solid>;
// Touches of each solid
@group(0) @binding(BIND_Counts) var<storage, read> counts: array<u32>;
// (force, Σ B_s) and (torque, 0) of each solid
@group(0) @binding(BIND_Loads) var<storage, read_write> loads: array<vec4<f32>>;
// The record of the cell of each touch
@group(0) @binding(BIND_Links) var<storage, read> links: array<u32>;

var<workgroup> force: array<vec3<f32>, LANES>;
var<workgroup> torque: array<vec3<f32>, LANES>;
var<workgroup> volume: array<f32, LANES>;

@compute @workgroup_size(LANES)
fn gather(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let solid = group.x + group.y * 65535u;
    let is_solid = solid < SOLIDS;
    var f = vec3<f32>(0.0);
    var t = vec3<f32>(0.0);
    var v = f32(0.0);
    if (is_solid) {
        let motion = solids[solid];
        for (var i = lane; i < counts[solid]; i += LANES) {
            let number = motion.first + i;
            let arm = bitcast<vec3<f32>>(shares_at(number).yzw);
            // j and ρ - 1 of the cell
            let moment = bitcast<vec4<f32>>(moments_at(links[number]));
            // u_s = U + ω × r
            let u = motion.velocity + cross(motion.spin, arm);
            // F = Σ GAIN B_s (j - ρ u_s),  T = Σ r × F
            let push = GAIN * weights[number] * (moment.xyz - (1.0 + moment.w) * u);
            f += push;
            t += cross(arm, push);
            v += weights[number];
        }
    }
    force[lane] = f;
    torque[lane] = t;
    volume[lane] = v;
    workgroupBarrier();
    for (var half = LANES / 2u; half > 0u; half /= 2u) {
        if (lane < half) {
            force[lane] += force[lane + half];
            torque[lane] += torque[lane + half];
            volume[lane] += volume[lane + half];
        }
        workgroupBarrier();
    }
    if (is_solid && lane == 0u) {
        loads[2u * solid] = vec4<f32>(force[0], volume[0]);
        loads[2u * solid + 1u] = vec4<f32>(torque[0], 0.0);
    }
}
