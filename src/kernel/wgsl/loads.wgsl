// Force and torque on each solid during the last step, and Σ B_s, the volume in which a body force does not
// act on the fluid.
//
// The solid operators change the momentum of a cell by GAIN B_s (ρ u_s - j), with the momentum j before the
// collision: that is what the solid loses.

// The record of the cell of each touch
@group(0) @binding(BIND_Links) var<storage, read> links: array<u32>;

fn asked() -> u32 {
    return SOLIDS;
}

fn solid_of(row: u32) -> u32 {
    return row;
}

// (force, B_s), (torque, 0)
fn terms(motion: Solid, touch: u32) -> array<vec4<f32>, COLUMNS> {
    let arm = bitcast<vec3<f32>>(shares_at(touch).yzw);
    // j and ρ - 1 of the cell
    let moment = bitcast<vec4<f32>>(moments_at(links[touch]));
    // u_s = U + ω × r
    let u = motion.velocity + cross(motion.spin, arm);
    // F = Σ GAIN B_s (j - ρ u_s),  T = Σ r × F
    let push = GAIN * weights[touch] * (moment.xyz - (1.0 + moment.w) * u);
    return array<vec4<f32>, COLUMNS>(
        vec4<f32>(push, weights[touch]),
        vec4<f32>(cross(arm, push), 0.0),
    );
}
