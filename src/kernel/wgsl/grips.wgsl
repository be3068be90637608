// How solids hold the fluid of their cells before its next collision: the force and torque on a solid as a linear
// function of the velocity that it will have there (loads.wgsl), with b = GAIN B_s.

// The numbers of the solids that are asked for, after how many they are
@group(0) @binding(BIND_CellList) var<storage, read> wanted: array<u32>;

fn asked() -> u32 {
    return wanted[0];
}

fn solid_of(row: u32) -> u32 {
    return wanted[row + 1u];
}

// (b j, B_s), (r × b j, b ρ), (b ρ r, 0), then b ρ times (xx, yy, zz, 0) and (xy, yz, xz, 0) of r rᵀ
fn terms(motion: Solid, touch: u32) -> array<vec4<f32>, COLUMNS> {
    let share = shares_at(touch);
    if (share.x == 0u) {
        // It is outside the box.
        return array<vec4<f32>, COLUMNS>();
    }
    let h = observed(coordinates(share.x - 1u));
    let r = bitcast<vec3<f32>>(share.yzw);
    let b = GAIN * weights[touch];
    let push = b * momentum(h);
    let b_rho = b * (1.0 + sum(h));
    let s = b_rho * r;
    return array<vec4<f32>, COLUMNS>(
        vec4<f32>(push, weights[touch]),
        vec4<f32>(cross(r, push), b_rho),
        vec4<f32>(s, 0.0),
        vec4<f32>(s * r, 0.0),
        vec4<f32>(s * r.yzx, 0.0),
    );
}
